/* test_log.c - what the server tells is bounded, and what was left out is told. (security.md
 * 23) */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include <server_log.h>

struct told {
    uint32_t lines, left_out;
    size_t longest;
    char last[LOG_LINE_BYTES];
};

static void take(void *context, const char *line)
{
    struct told *t = context;
    unsigned int more;
    if (sscanf(line, "(%u lines were left out", &more) == 1)
        t->left_out += more;
    else
        t->lines++;
    t->longest = strlen(line) > t->longest ? strlen(line) : t->longest;
    snprintf(t->last, sizeof t->last, "%s", line);
}

static void usual_lines_are_told(void **state)
{
    (void)state;
    struct told t = {0};
    struct server_log log;
    log_begin(&log, take, &t);
    for (uint64_t i = 0; i < 1000; i++) /* two in a minute */
        log_tell_at(&log, i * UINT64_C(30000000000), "device %d", (int)i);
    assert_int_equal(t.lines, 1000);
    assert_int_equal(t.left_out, 0);
    for (uint32_t i = 0; i < LOG_AT_ONCE; i++)
        log_tell_at(&log, UINT64_C(1000000000000000), "device %u", i);
    assert_int_equal(t.lines, 1000 + LOG_AT_ONCE);
    assert_int_equal(t.left_out, 0);
}

static void a_bad_contact_fills_no_disk(void **state)
{
    (void)state;
    enum { DAY_S = 86400, HERTZ = 20 };
    struct told t = {0};
    struct server_log log;
    log_begin(&log, take, &t);
    for (uint64_t i = 0; i < (uint64_t)DAY_S * HERTZ; i++)
        log_tell_at(&log, i * 1000000000 / HERTZ, "%s", i % 2 ? "device is there" : "away");
    assert_in_range(t.lines, DAY_S / LOG_EVERY_S, DAY_S / LOG_EVERY_S + LOG_AT_ONCE);
    log_tell_at(&log, (uint64_t)2 * DAY_S * 1000000000, "the last");
    assert_string_equal(t.last, "the last");
    assert_int_equal(t.lines + t.left_out, DAY_S * HERTZ + 1);
    /* and a line has an end */
    char name[2000];
    memset(name, 'x', sizeof name - 1);
    name[sizeof name - 1] = '\0';
    log_tell(&log, "%s", name);
    assert_in_range(t.longest, 1, LOG_LINE_BYTES - 1);
    log_begin(&log, NULL, NULL);
    log_tell(&log, "nobody hears it");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(usual_lines_are_told),
        cmocka_unit_test(a_bad_contact_fills_no_disk),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
