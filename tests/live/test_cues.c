/* test_cues.c - lists of cues on a stage: when they happen, what they do, and what is refused,
 * with its line. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <control_table.h>
#include <cues.h>
#include <cues_file.h>

#include "../display/scratch.h"
#include "../stage/scene_springs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static struct font_face *face;
static struct stage *stage;
static char scenes[64], said[500];

static const char *scene_play(void *context, int number)
{
    (void)context;
    snprintf(scenes + strlen(scenes), sizeof scenes - strlen(scenes), "%d ", number);
    return number == 9 ? "it was not kept" : NULL;
}

static void say(void *context, const char *text)
{
    (void)context;
    snprintf(said, sizeof said, "%s", text);
}

static const char *file_of(const char *text)
{
    const char *path = scratch_path("evening.cues");
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
    return path;
}

static struct cues *cues_of(const char *text)
{
    const struct cues_def def = {
        .path = file_of(text), .stage = stage, .scene = scene_play, .tell = say};
    struct cues *cues;
    if (cues_open(&def, &cues) != STAGE_OK)
        fail_msg("%s", stage_error());
    return cues;
}

static double now(const char *name)
{
    int count;
    const struct control *rows = stage_controls(stage, &count);
    const struct control *row = stage_control_find(rows, count, name);
    assert_non_null(row);
    return control_read(row, stage);
}

static int setup(void **state)
{
    (void)state;
    stage = scene_springs("word", 1, face);
    scenes[0] = said[0] = '\0';
    return 0;
}

static int teardown(void **state)
{
    (void)state;
    stage_destroy(stage);
    return 0;
}

static void cues_happen_in_time(void **state)
{
    (void)state;
    struct cues *cues = cues_of("# an evening\n\n"
                                "0.5 set gravity=3\n"
                                "  1\tscene 2\r\n"
                                "+0.5 scene 3   \n"
                                "2 set gravity=7\n");
    cues_frame(cues, 0);
    assert_true(now("gravity") != 3);
    cues_frame(cues, 0.5);
    assert_true(now("gravity") == 3);
    cues_frame(cues, 1.4999);
    assert_string_equal(scenes, "2 ");
    cues_frame(cues, 1.5);
    assert_string_equal(scenes, "2 3 ");
    cues_go(cues); /* nothing waits */
    cues_frame(cues, 1.9);
    assert_true(now("gravity") == 3);
    cues_frame(cues, 100);
    assert_true(now("gravity") == 7);
    cues_frame(cues, 200);
    assert_string_equal(scenes, "2 3 ");
    cues_close(cues);
}

/* All that became due between two pictures happens in its order, and is counted from when it
 * was due, not from the picture. */
static void late_pictures_lose_nothing(void **state)
{
    (void)state;
    struct cues *cues = cues_of("0 scene 1\n+1 scene 2\n+1 scene 3\n+1 scene 4\n");
    cues_frame(cues, 2.7);
    assert_string_equal(scenes, "1 2 3 ");
    cues_frame(cues, 2.99);
    assert_string_equal(scenes, "1 2 3 ");
    cues_frame(cues, 3);
    assert_string_equal(scenes, "1 2 3 4 ");
    cues_close(cues);
}

static void some_wait_for_somebody(void **state)
{
    (void)state;
    struct cues *cues = cues_of("0 scene 1\ngo scene 2\n+2 scene 3\ngo scene 4\ngo scene 5\n");
    cues_frame(cues, 50);
    assert_string_equal(scenes, "1 ");
    cues_go(cues);
    cues_frame(cues, 60);
    cues_frame(cues, 61.9);
    assert_string_equal(scenes, "1 2 ");
    cues_go(cues); /* before it waits: it does not wait then */
    cues_frame(cues, 61.95);
    assert_string_equal(scenes, "1 2 ");
    cues_frame(cues, 62);
    assert_string_equal(scenes, "1 2 3 4 ");
    for (int i = 0; i < 5; i++) /* more than there are */
        cues_go(cues);
    cues_frame(cues, 63);
    cues_frame(cues, 64);
    assert_string_equal(scenes, "1 2 3 4 5 ");
    cues_close(cues);
}

/* A control goes along its slider's way, and ends at the very value; a later cue takes it
 * over. */
static void controls_fade(void **state)
{
    (void)state;
    int count;
    const struct control *rows = stage_controls(stage, &count);
    const struct control *row = stage_control_find(rows, count, "stiffness");
    assert_non_null(row);
    struct cues *cues = cues_of("0 set stiffness=2\n0 set stiffness=200 fade 4\n"
                                "+6 set stiffness=5 fade 10\n+1 set stiffness=0.5\n");
    double before = 0;
    for (int i = 0; i <= 40; i++) {
        cues_frame(cues, i / 10.0);
        const double along = control_along(row, now("stiffness"));
        const double wanted = control_along(row, 2) +
                              i / 40.0 * (control_along(row, 200) - control_along(row, 2));
        assert_true(fabs(along - wanted) < 1e-9);
        assert_true(now("stiffness") > before);
        before = now("stiffness");
    }
    assert_true(now("stiffness") == 200);
    cues_frame(cues, 6.5);
    assert_true(now("stiffness") < 200 && now("stiffness") > 5);
    cues_frame(cues, 7);
    assert_true(now("stiffness") == 0.5);
    cues_frame(cues, 12);
    assert_true(now("stiffness") == 0.5);
    cues_close(cues);
}

/* What cannot be done while it plays is said, and the rest goes on. */
static void what_cannot_be_done_is_said(void **state)
{
    (void)state;
    struct cues *cues = cues_of("0 scene 9\n1 text \"other words\"\n2 scene 1\n");
    cues_frame(cues, 0);
    assert_string_equal(said, "cue of line 1: it was not kept");
    cues_frame(cues, 1); /* these words are made by hand, and cannot be made anew */
    assert_non_null(strstr(said, "cue of line 2: "));
    cues_frame(cues, 2);
    assert_string_equal(scenes, "9 1 ");
    cues_close(cues);
}

/* A list of controls is whole: it ends with the last one. */
static void all_are_named(struct stage *of)
{
    int count;
    const struct control *rows = stage_controls(of, &count);
    for (int i = 0; i < count; i++) {
        char name[70];
        snprintf(name, sizeof name, " %s%s", rows[i].name, i + 1 < count ? "," : "");
        if (!strstr(stage_error(), name))
            fail_msg("%s is not in: %s", rows[i].name, stage_error());
    }
}

static void wrong_lists_are_refused_with_their_line(void **state)
{
    (void)state;
    static const struct {
        const char *text, *says;
        bool film, no_scenes;
    } wrong[] = {
        {"", "there is no cue", false, false},
        {"# only this\n", "there is no cue", false, false},
        {"0 scene 1\nsoon scene 2\n", ":2: a line begins with seconds", false, false},
        {"-1 scene 1\n", ":1: a line begins with", false, false},
        {"nan scene 1\n", ":1: a line begins with", false, false},
        {"2 scene 1\n1 scene 2\n", ":2: times do not go back", false, false},
        {"1 scene 1\n+3 scene 2\n3 scene 3\n", ":3: times do not go back", false, false},
        {"go scene 1\n1 scene 2\n", ":2: behind a go", false, false},
        {"0 dance 1\n", ":1: there is no cue 'dance'; there are text, scene and set", false,
         false},
        {"0 scene 0\n", ":1: scene goes with", false, false},
        {"0 scene 1.5\n", ":1: scene goes with", false, false},
        {"0 scene 1 2\n", ":1: there is something behind", false, false},
        {"0 text hi\n", ":1: text goes with", false, false},
        {"0 text \"hi\n", ":1: text goes with", false, false},
        {"0 text \"h\\i\"\n", ":1: text goes with", false, false},
        {"0 text \"\"\n", ":1: a stage's text is UTF-8, 1 to 1000 bytes", false, false},
        {"0 text \"\xff\xfe\"\n", ":1: a stage's text is UTF-8", false, false},
        {"0 text \"\x1b[2J\"\n", ":1: a stage's text is UTF-8", false, false},
        {"0 set gravity\n", ":1: set goes with", false, false},
        {"0 set gravity=\n", ":1: set goes with", false, false},
        {"0 set gravity=1 fade\n", ":1: fade goes with", false, false},
        {"0 set gravity=1 slowly\n", ":1: there is something behind", false, false},
        {"0 set levity=1\n", ":1: there is no control 'levity'; there are", false, false},
        {"0 set gravity=1e9\n", ":1: gravity must be", false, false},
        {"0 set gravity=much\n", ":1: gravity must be", false, false},
        {"0 scene 1\ngo scene 2\n", ":2: a film waits for nobody", true, false},
        {"0 scene 1\n", ":1: there are no scenes", false, true},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        struct cues *cues;
        const struct cues_def def = {.path = file_of(wrong[i].text),
                                     .stage = stage,
                                     .is_film = wrong[i].film,
                                     .scene = wrong[i].no_scenes ? NULL : scene_play};
        assert_int_equal(cues_open(&def, &cues), STAGE_BAD_FILE);
        assert_null(cues);
        if (!strstr(stage_error(), wrong[i].says))
            fail_msg("'%s': %s", wrong[i].text, stage_error());
        if (strstr(stage_error(), "there are rate"))
            all_are_named(stage);
    }
    const struct cues_def nowhere = {.path = "/no/where.cues", .stage = stage};
    struct cues *cues;
    assert_int_equal(cues_open(&nowhere, &cues), STAGE_BAD_FILE);
}

static void lists_last_until_the_last_fade(void **state)
{
    (void)state;
    struct cues_text text;
    assert_int_equal(cues_file_read(file_of("1 set gravity=1 fade 9\n+2 scene 1\ngo scene 1\n"
                                            "+3 text \"a \\\"b\\\"\\nc\\\\\"\n"),
                                    &text),
                     STAGE_OK);
    assert_int_equal(text.count, 4);
    assert_true(cues_text_seconds(&text) == 10);
    assert_string_equal(text.cues[3].text, "a \"b\"\nc\\");
    cues_text_finish(&text);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
    const struct CMUnitTest tests[] = {
        TEST(cues_happen_in_time),
        TEST(late_pictures_lose_nothing),
        TEST(some_wait_for_somebody),
        TEST(controls_fade),
        TEST(what_cannot_be_done_is_said),
        TEST(wrong_lists_are_refused_with_their_line),
        TEST(lists_last_until_the_last_fade),
    };
    if (font_face_open("DejaVuSans", 0, &face) != FONT_OK)
        return 1;
    const int failed = cmocka_run_group_tests_name("live_cues", tests, NULL, NULL);
    font_face_close(face);
    return failed;
}
