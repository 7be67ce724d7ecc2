/* test_events.c - checks, bytes, scales and logs of events, which follow from their rows. */
#include "wind.h"

#include <log.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

static const double three[3] = {1, -2, 0.5};

static struct wind breeze(void)
{
    return (struct wind){.speed = 7,
                         .from = {0.25, -0.5},
                         .height = 100,
                         .seed = UINT64_C(0xfedcba9876543210),
                         .gusts = true,
                         .name = "sirocco",
                         .leaves_count = 3,
                         .leaves = three};
}

static void ranges_are_checked_by_row(void **state)
{
    (void)state;
    char text[100] = "";
    struct wind wind = breeze();
    assert_true(members_check(&wind_members, &wind, "the wind's ", "", text, sizeof text));
    wind.from[1] = -1.5;
    assert_false(
        members_check(&wind_members, &wind, "the wind's ", " at noon", text, sizeof text));
    assert_string_equal(text, "the wind's direction must be -1..1 (got -1.5 at noon)");
    wind = breeze();
    wind.height = 501;
    assert_false(members_check(&wind_members, &wind, "", "", text, sizeof text));
    assert_string_equal(text, "height must be 1..500 (got 501)");
    wind = breeze();
    wind.speed = NAN;
    assert_false(members_check(&wind_members, &wind, "", "", text, sizeof text));
    assert_string_equal(text, "speed must be 0..40 (got nan)");
}

static void bytes_come_back(void **state)
{
    (void)state;
    struct wind wind = breeze(), *back;
    struct event_bytes b = {0};
    event_encode(&b, &wind_kind, &wind, NULL);
    assert_false(b.short_of_memory);
    assert_int_equal(b.count, 3 * 8 + 8 + 8 + 1 + 16 + 4 + 3 * 8);
    assert_memory_equal(b.at + 32, "\x10\x32\x54\x76\x98\xba\xdc\xfe", 8); /* low byte first */
    assert_int_equal(event_decode(b.at, b.count, &wind_kind, NULL, (void **)&back),
                     EVENT_DECODED);
    assert_memory_equal(&back->from, &wind.from, sizeof wind.from);
    assert_true(back->speed == 7 && back->height == 100 && back->seed == wind.seed);
    assert_true(back->gusts && back->leaves_count == 3 && back->leaves != wind.leaves);
    assert_memory_equal(back->leaves, three, sizeof three);
    assert_string_equal(back->name, "sirocco");
    event_free(&wind_kind, back);
    /* every shorter encoding is damaged, and so is a longer one */
    for (size_t count = 0; count < b.count; count++) {
        assert_int_equal(event_decode(b.at, count, &wind_kind, NULL, (void **)&back),
                         EVENT_DAMAGED);
        assert_null(back);
    }
    event_put_number(&b, 0, 1);
    assert_int_equal(event_decode(b.at, b.count, &wind_kind, NULL, (void **)&back),
                     EVENT_DAMAGED);
    b.at[41 + 15] = 'x'; /* text whose last byte is no 0 */
    memset(b.at + 41, 'x', 16);
    assert_int_equal(event_decode(b.at, b.count - 1, &wind_kind, NULL, (void **)&back),
                     EVENT_DAMAGED);
    free(b.at);
}

static void numbers_are_scaled_as_their_rows_say(void **state)
{
    (void)state;
    double context = 10;
    struct event_scaling scaling = {.length = 2, .pace = 4, .context = &context};
    struct wind wind = breeze();
    double *leaves = malloc(sizeof three);
    assert_non_null(leaves);
    memcpy(leaves, three, sizeof three);
    wind.leaves = leaves;
    assert_true(members_scale(&wind_members, &wind, &scaling));
    assert_true(wind.speed == 28 && wind.from[0] == 0.125 && wind.from[1] == -0.25);
    assert_true(wind.height == 200 && leaves[1] == -40);
    assert_true(members_scale(&wind_members, &wind, &scaling));
    assert_true(members_scale(&wind_members, &wind, &scaling));
    assert_true(wind.speed == 40 && wind.height == 500); /* the rows' most */
    free(leaves);
}

static void log_keeps_splits_and_cuts(void **state)
{
    (void)state;
    static const struct members none = {NULL, 0};
    static const struct event_kind step_kind = {"step", "", 0, &none};
    struct event_log log = {0};
    struct event_record record, *tail;
    struct wind wind = breeze(), *back;
    double many[WIND_LEAVES_MAX] = {0};
    int tail_count;
    wind.leaves = many;
    wind.leaves_count = WIND_LEAVES_MAX;
    for (int i = 0; i < 200; i++) {
        wind.height = 1 + i;
        bool step = i % 2;
        assert_true(event_record_make(&record, step, step ? &step_kind : &wind_kind,
                                      step ? NULL : &wind, NULL));
        record.steps = step ? 10 : 0;
        assert_true(event_log_append(&log, record));
    }
    assert_int_equal(log.count, 200);
    assert_true(log.records[0].stored < log.records[0].raw / 4); /* zeros are deflated */
    assert_true(log.records[0].digest != log.records[2].digest);
    assert_int_equal(event_record_digest(&log.records[2]), log.records[2].digest);
    assert_int_equal(
        event_record_arguments(&log.records[198], &wind_kind, NULL, (void **)&back),
        EVENT_DECODED);
    assert_int_equal(back->height, 199);
    assert_int_equal(back->leaves_count, WIND_LEAVES_MAX);
    event_free(&wind_kind, back);

    assert_true(event_log_split(&log, 1, 3));
    assert_int_equal(log.count, 201);
    assert_int_equal(log.records[1].steps, 3);
    assert_int_equal(log.records[2].steps, 7);
    double bytes = log.bytes;
    assert_true(event_log_take_away(&log, 100, &tail, &tail_count));
    assert_int_equal(log.count, 100);
    assert_int_equal(tail_count, 101);
    assert_true(event_log_put_back(&log, tail, tail_count));
    assert_int_equal(log.count, 201);
    assert_true(log.bytes == bytes);
    event_log_cut(&log, 1);
    assert_int_equal(log.count, 1);
    assert_true(log.bytes == (double)(log.records[0].stored + sizeof record));
    log.records[0].bytes[log.records[0].stored / 2] ^= 0x55;
    assert_int_equal(event_record_arguments(&log.records[0], &wind_kind, NULL, (void **)&back),
                     EVENT_DAMAGED);
    event_log_free(&log);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ranges_are_checked_by_row),
        cmocka_unit_test(bytes_come_back),
        cmocka_unit_test(numbers_are_scaled_as_their_rows_say),
        cmocka_unit_test(log_keeps_splits_and_cuts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
