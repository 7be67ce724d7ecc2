/* test_session.c - sessions: random actions are replayed to the bit; texts that are no sessions
 * are refused. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <session.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../display/scratch.h"
#include "scene_springs.h"

static struct font_face *face;

static struct stage *stage_make(void)
{
    struct stage_draw_list list = {0};
    struct stage *stage = scene_springs("word", 1, face);
    stage_picture(stage, 640, 480, 1, &list);
    stage_draw_finish(&list);
    assert_int_equal(stage_frame(stage, 0, NULL), STAGE_OK);
    return stage;
}

static const struct dyn_state *states(struct stage *stage)
{
    struct stage_actor actor = stage_actor(stage);
    return dyn_network_states(stage_springs_network(&actor));
}

static uint64_t chance_state;

static uint32_t chance(uint32_t below)
{
    chance_state = chance_state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)(chance_state >> 33) % below;
}

/* Does random actions of every kind that a person can do. */
static void deed_by_chance(struct stage *stage)
{
    static const char *const sets[] = {"gravity=3", "gravity=-2.5", "stiffness=3", "rate=0.5",
                                       "rate=1",    "hand=1000",    "floor_on=off"};
    double x_px = chance(640), y_px = chance(480);
    uint32_t what = chance(20);
    if (what < 14)
        stage_hand(stage, (enum stage_event_kind)chance(4), x_px, y_px, chance(5) / 4.0,
                   (int)chance(2), chance(2));
    else if (what < 16)
        assert_int_equal(stage_set(stage, sets[chance(7)]), STAGE_OK);
    else if (what < 18)
        assert_int_equal(stage_mark(stage), STAGE_OK);
    else if (what == 18)
        stage_undo(stage);
    else if (chance(4) == 0)
        assert_int_equal(stage_reset(stage), STAGE_OK);
    else
        stage_mark_drop(stage);
}

/* A session is recorded at one frame rate and replayed at another. Written again it is the same
 * text. */
static void sessions_are_done_again_to_the_bit(void **state)
{
    (void)state;
    for (int run = 0; run < 6; run++) {
        const char *path = scratch_path("a.session"), *again = scratch_path("b.session");
        struct stage *played = stage_make();
        chance_state = (uint64_t)run;
        double now_s = 0;
        for (int i = 0; i < 400; i++) {
            deed_by_chance(played);
            now_s += chance(3) / 77.0;
            assert_int_equal(stage_frame(played, now_s, NULL), STAGE_OK);
        }
        assert_int_equal(stage_set(played, "rate=1"), STAGE_OK);
        assert_int_equal(stage_frame(played, now_s + 0.2, NULL), STAGE_OK);
        int64_t steps = stage_clock(played)->steps_count;
        if (stage_session_save(played, path) != STAGE_OK)
            fail_msg("%s", stage_error());

        struct stage *other = scene_springs("word", 1, face);
        if (stage_session_replay(other, path) != STAGE_OK)
            fail_msg("%s", stage_error());
        for (int i = 0; stage_clock(other)->steps_count < steps; i++) {
            struct frame_clock *clock = stage_clock(other);
            clock->paused = true; /* one step at a time: other frames than the recorded ones */
            frame_clock_single(clock);
            assert_int_equal(stage_frame(other, i / 30.0, NULL), STAGE_OK);
        }
        assert_memory_equal(states(played), states(other), 16 * sizeof(struct dyn_state));
        assert_int_equal(stage_session_save(other, again), STAGE_OK);
        FILE *one = fopen(path, "rb"), *two = fopen(again, "rb");
        long lines = 0;
        for (int a = 0, b = 0; a != EOF; lines += a == '\n') {
            a = fgetc(one);
            b = fgetc(two);
            if (a != b)
                fail_msg("run %d: line %ld differs", run, lines + 1);
        }
        assert_in_range(lines, 60, 1000);
        fclose(one);
        fclose(two);
        stage_destroy(played);
        stage_destroy(other);
    }
}

static const char good[] =
    "session 1\n# by hand\nbegin 00000000000000ff\n0 mark\n0 hand down 0.5 1.5 0.2 0 0 1\n\n"
    "12 hand move 1 2 0.2 0.75 0 0\n13 hand up 1 2 0.2 0 0 0\n"
    "13 set gravity -3.5\n14 load 0123456789abcdef  a b.springs\n20 "
    "undo\n20 reset\n21 drop\nend\n";

static enum stage_status parse(const char *text, size_t bytes, struct stage_session *session)
{
    static struct stage *stage;
    if (!stage)
        stage = stage_make();
    int count;
    const struct control *rows = stage_controls(stage, &count);
    enum stage_status status = stage_session_parse(text, bytes, "t", rows, count, session);
    if (!bytes) {
        stage_destroy(stage);
        stage = NULL;
    }
    return status;
}

static void texts_are_read(void **state)
{
    (void)state;
    struct stage_session s;
    if (parse(good, sizeof good - 1, &s) != STAGE_OK)
        fail_msg("%s", stage_error());
    assert_int_equal(s.count, 9);
    assert_string_equal(s.files[s.deeds[5].file].path, " a b.springs");
    assert_true(s.files[0].digest == 0x0123456789abcdefu);
    assert_int_equal(s.deeds[1].kind, STAGE_DEED_HAND);
    assert_true(s.deeds[1].event.y == 1.5 && s.deeds[1].event.modifiers == 1);
    assert_true(s.deeds[2].step == 12 && s.deeds[2].event.pressure == 0.75);
    assert_true(s.deeds[4].value == -3.5);
    stage_session_finish(&s);
}

/* Steps are 0.1 s here, at the rate that holds. */
static void sessions_last(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        double rate, seconds;
    } sessions[] = {{"session 1\nend\n", 1, 0},
                    {"session 1\nend 20\n", 0.5, 4},
                    {"session 1\n10 mark\nend\n", 1, 1},
                    {"session 1\n10 set rate 2\nend 20\n", 1, 1.5},
                    {"session 1\n10 mark\n10 set rate 2\n20 undo\nend 30\n", 1, 2.5},
                    {"session 1\n10 mark\n10 set rate 2\n10 drop\n20 undo\nend 30\n", 1, 2},
                    {"session 1\n0 set rate 2\n10 reset\n20 undo\nend 30\n", 4, 1.25},
                    {"session 1\n0 set gravity 2\nend 30\n", 1, 3}};
    for (size_t i = 0; i < sizeof sessions / sizeof *sessions; i++) {
        struct stage_session s;
        if (parse(sessions[i].text, strlen(sessions[i].text), &s) != STAGE_OK)
            fail_msg("%s", stage_error());
        const double seconds = stage_session_seconds(&s, sessions[i].rate, 0.1, 0);
        if (fabs(seconds - sessions[i].seconds) > 1e-9)
            fail_msg("%zu: %g for %g", i, seconds, sessions[i].seconds);
        stage_session_finish(&s);
    }
}

static void wrong_texts_are_refused(void **state)
{
    (void)state;
    static const struct {
        const char *text, *said;
    } wrong[] = {
        {"springs 1\n", "t:1: must be `session 1`"},
        {"session 1\n0 mark\n", "t:3: must be `end`"},
        {"session 1\n5 mark\n4 mark\nend\n", "t:3: must be STEP"},
        {"session 1\n5 mark\nend 4\n", "t:3: must be `end STEP`"},
        {"session 1\n5 mark\nend of it\n", "t:3: must be `end STEP`"},
        {"session 1\n-1 mark\nend\n", "t:2: must be STEP"},
        {"session 1\nmark\nend\n", "t:2: must be STEP"},
        {"session 1\n0 jump\nend\n", "t:2: must be hand, set, load"},
        {"session 1\n0 mark it\nend\n", "t:2: must be hand, set, load"},
        {"session 1\n0 set gravita 3\nend\n", "t:2: must be a control that there is"},
        {"session 1\n0 set gravity 1e9\nend\n", "t:2: must be a value within"},
        {"session 1\n0 set gravity nan\nend\n", "t:2: must be a value within"},
        {"session 1\n0 set gravity\nend\n", "t:2: must be `STEP set NAME VALUE`"},
        {"session 1\n0 hand wave 0 0 0 0 0 0\nend\n", "t:2: must be `STEP hand down|move"},
        {"session 1\n0 hand down 0 0 -1 0 0 0\nend\n", "t:2: must be `STEP hand down|move"},
        {"session 1\n0 hand down 0 0 0 0 0 0 0\nend\n", "t:2: must be `STEP hand down|move"},
        {"session 1\n0 load 0123456789abcdef\nend\n", "t:2: must be `STEP load DIGEST FILE`"},
        {"session 1\n0 load 0123456789ABCDEF a\nend\n", "t:2: must be `STEP load DIGEST FILE`"},
        {"session 1\nbegin 12\nend\n", "t:2: must be `begin DIGEST`"},
        {"session 1\n0 mark\nbegin 0123456789abcdef\nend\n", "t:3: must be `begin DIGEST`"},
        {"session 1\n0 load 123 a\nend\n", "t:2: must be `STEP load DIGEST FILE`"},
        {"session 1\n99999999999999999999 mark\nend\n", "t:2: must be STEP"},
    };
    struct stage_session s;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        assert_int_equal(parse(wrong[i].text, strlen(wrong[i].text), &s), STAGE_BAD_FILE);
        assert_null(s.deeds);
        if (strncmp(stage_error(), wrong[i].said, strlen(wrong[i].said)) != 0)
            fail_msg("%s", stage_error());
    }
    char *line = malloc(5000);
    memset(line, 'x', 5000);
    assert_int_equal(parse(line, 5000, &s), STAGE_BAD_FILE);
    free(line);
    struct stage *stage = stage_make();
    assert_int_equal(stage_session_replay(stage, "/no/such"), STAGE_BAD_FILE);
    assert_non_null(strstr(stage_error(), "/no/such: cannot be read: No such"));
    assert_int_equal(stage_session_save(stage, "/no/folder/a"), STAGE_BAD_FILE);
    stage_destroy(stage);
}

/* A good text with random changes is read and replayed without harm, or refused in one line. */
static void bytes_by_chance_are_read_or_refused(void **state)
{
    (void)state;
    int read = 0, runs = 20000;
    chance_state = 3;
    for (int i = 0; i < runs; i++) {
        size_t length = chance(4) ? sizeof good - 1 : chance(sizeof good - 1);
        char *bytes = malloc(length ? length : 1); /* exact: finds reads beyond it */
        struct stage_session s;
        memcpy(bytes, good, length);
        for (uint32_t k = chance(4); length && k > 0; k--)
            bytes[chance((uint32_t)length)] =
                chance(2) ? "0123456789. \n-exa"[chance(17)] : (char)chance(256);
        enum stage_status status = parse(bytes, length, &s);
        assert_true(status == STAGE_OK || status == STAGE_BAD_FILE);
        read += status == STAGE_OK;
        assert_null(strchr(stage_error(), '\n'));
        stage_session_finish(&s);
        free(bytes);
    }
    assert_in_range(read, runs / 10, runs * 9 / 10);
}

static void frames_until(struct stage *stage, int64_t steps)
{
    for (int i = 0; stage_clock(stage)->steps_count < steps; i++) {
        struct frame_clock *clock = stage_clock(stage);
        clock->paused = true;
        frame_clock_single(clock);
        if (stage_frame(stage, i / 30.0, NULL) != STAGE_OK)
            fail_msg("%s", stage_error());
    }
}

static void file_append(const char *path, const char *text)
{
    FILE *file = fopen(path, "a");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

static void session_refused(const char *session, const char *said)
{
    struct stage *stage = scene_springs("word", 1, face);
    assert_int_equal(stage_session_replay(stage, session), STAGE_BAD_FILE);
    if (!strstr(stage_error(), said) || strchr(stage_error(), '\n'))
        fail_msg("%s", stage_error());
    stage_destroy(stage);
}

/* A session loads a network and goes on; it is replayed to the bit, and refused once the file
 * has changed or gone. A file that cannot be loaded is no part of it. */
static void sessions_load_files_again(void **state)
{
    (void)state;
    char path[4096], session[4096], bad[4096];
    snprintf(path, sizeof path, "%s", scratch_path("a loaded word.springs"));
    snprintf(session, sizeof session, "%s", scratch_path("c.session"));
    snprintf(bad, sizeof bad, "%s", scratch_path("bad.springs"));
    file_append(bad, "springs 1\n");
    struct stage *played = stage_make();
    frames_until(played, 40);
    assert_int_equal(stage_save(played, path), STAGE_OK);
    frames_until(played, 90);
    assert_int_equal(stage_load(played, bad), STAGE_BAD_FILE);
    assert_int_equal(stage_load(played, path), STAGE_OK);
    assert_int_equal(stage_set(played, "gravity=3"), STAGE_OK);
    frames_until(played, 150);
    assert_int_equal(stage_session_save(played, session), STAGE_OK);

    struct stage *other = scene_springs("word", 1, face);
    if (stage_session_replay(other, session) != STAGE_OK)
        fail_msg("%s", stage_error());
    frames_until(other, 150);
    assert_memory_equal(states(played), states(other), 16 * sizeof(struct dyn_state));
    stage_destroy(other);
    stage_destroy(played);

    struct stage *late = scene_springs("word", 1, face); /* the file changes while it runs */
    assert_int_equal(stage_session_replay(late, session), STAGE_OK);
    frames_until(late, 50);
    file_append(path, "# other bytes\n");
    enum stage_status status = STAGE_OK;
    for (int i = 0; i < 60 && status == STAGE_OK; i++) {
        frame_clock_single(stage_clock(late));
        status = stage_frame(late, 10 + i / 30.0, NULL);
    }
    assert_int_equal(status, STAGE_BAD_FILE);
    assert_non_null(strstr(stage_error(), "has changed since the session"));
    stage_destroy(late);

    const char *wordless = scratch_path("d.session");
    file_append(wordless, "session 1\nbegin 0123456789abcdef\nend\n");
    struct stage *others = scene_springs("word", 1, face);
    assert_int_equal(stage_session_replay(others, wordless), STAGE_OK);
    assert_int_equal(stage_frame(others, 0, NULL), STAGE_BAD_FILE);
    assert_non_null(strstr(stage_error(), "began with other words"));
    stage_destroy(others);

    session_refused(session, "a loaded word.springs, which has changed since the session");
    assert_int_equal(remove(path), 0);
    session_refused(session, "a loaded word.springs, which cannot be read: No such file");
}

/* A wheel that is turned for hours: a step has one value of a control, and who saves no session
 * keeps none. */
static void what_is_set_live_is_not_kept_for_ever(void **unused)
{
    (void)unused;
    struct stage_session s = {0};
    for (int i = 0; i < 100000; i++) {
        struct stage_deed set = {
            .kind = STAGE_DEED_SET, .step = i / 1000, .control = 3, .value = i};
        stage_session_add(&s, &set);
    }
    assert_int_equal(s.count, 100);
    for (int i = 0; i < 100; i++)
        assert_true(s.deeds[i].step == i && s.deeds[i].value == 1000 * i + 999);
    stage_session_add(&s,
                      &(struct stage_deed){.kind = STAGE_DEED_SET, .step = 99, .control = 4});
    stage_session_add(&s,
                      &(struct stage_deed){.kind = STAGE_DEED_SET, .step = 99, .control = 3});
    stage_session_add(&s, &(struct stage_deed){.kind = STAGE_DEED_MARK, .step = 99});
    stage_session_add(&s,
                      &(struct stage_deed){.kind = STAGE_DEED_SET, .step = 99, .control = 3});
    assert_int_equal(s.count, 104);
    stage_session_finish(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sessions_are_done_again_to_the_bit),
        cmocka_unit_test(texts_are_read),
        cmocka_unit_test(sessions_last),
        cmocka_unit_test(wrong_texts_are_refused),
        cmocka_unit_test(bytes_by_chance_are_read_or_refused),
        cmocka_unit_test(sessions_load_files_again),
        cmocka_unit_test(what_is_set_live_is_not_kept_for_ever),
    };
    if (font_face_open("DejaVuSans", 0, &face) != FONT_OK)
        return 1;
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    struct stage_session unused;
    parse("", 0, &unused);
    font_face_close(face);
    return failed;
}
