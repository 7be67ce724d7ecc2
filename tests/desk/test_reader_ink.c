/* test_reader_ink.c - ink in the reader's window, played recorded input in place of a hand:
 * strokes are chosen, several at once, moved, scaled, grouped, by pointer and by keys; undone,
 * kept, and taken along when the text is set anew. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "reader_played.h"
#include "xvfb.h"

struct chosen {
    int count;
    double x, y, width, height;
};

static struct chosen chosen(const char *told)
{
    struct chosen c = {0};
    assert_true(sscanf(played_told(told, "chosen"), "%d %lf %lf %lf %lf", &c.count, &c.x, &c.y,
                       &c.width, &c.height) >= 1);
    return c;
}

/* As near as what is told: a tenth of a pixel; widths of strokes are left out. */
static void is_near(double value, double expected, double within)
{
    if (!(fabs(value - expected) <= within))
        fail_msg("%g is not %g", value, expected);
}

static void chosen_is(const char *told, int count, double x, double y, double width,
                      double height)
{
    const struct chosen c = chosen(told);
    assert_int_equal(c.count, count);
    if (!count)
        return;
    is_near(c.x, x, 3);
    is_near(c.y, y, 3);
    is_near(c.width, width, 5);
    is_near(c.height, height, 5);
}

static void notes_remove(void)
{
    unlink(played_path("one.md.notes"));
    unlink(played_path("one.md.notes-wal"));
    unlink(played_path("one.md.notes-shm"));
}

/* Two strokes: across, from 200, 300, and down, from 300, 340. */
#define TWO                                                                                    \
    "0.2 action pen\n0.3 press 200 300 0.5\n0.31 drag 250 300 0.5\n0.32 drag 300 300 "         \
    "0.5\n0.33 lift 300 300\n0.35 press 300 340 0.5\n0.36 drag 300 380 0.5\n0.37 drag 300 420" \
    " 0.5\n0.38 lift 300 420\n0.4 action move-ink\n"

static void strokes_are_chosen_and_moved(void **state)
{
    char lines[4000];
    (void)state;
    notes_remove();
    snprintf(lines, sizeof lines,
             TWO "0.5 press 250 302 1\n0.51 lift 250 302\n0.6 tell %s\n"
                 "0.7 press-more 301 380 1\n0.71 lift 301 380\n0.8 tell %s\n"
                 "0.9 press 301 380 1\n0.91 drag 321 400 1\n0.92 lift 341 410\n1 tell %s\n"
                 "1.1 action undo\n1.2 tell %s\n1.3 press-more 250 300 1\n1.31 lift 250 300\n"
                 "1.4 tell %s\n1.5 key Escape\n1.6 press 190 290 1\n1.61 drag 310 430 1\n"
                 "1.62 lift 320 430\n1.7 tell %s\n1.8 key Escape\n1.85 tell %s\n",
             played_path("one"), played_path("two"), played_path("moved"),
             played_path("undone"), played_path("less"), played_path("framed"),
             played_path("none"));
    played_run(lines, played_path("one.md"));
    played_well();
    chosen_is("one", 1, 200, 300, 100, 0);
    chosen_is("two", 2, 200, 300, 100, 120);
    chosen_is("moved", 2, 240, 330, 100, 120);
    chosen_is("undone", 2, 200, 300, 100, 120);
    chosen_is("less", 1, 300, 340, 0, 80);
    chosen_is("framed", 2, 200, 300, 100, 120);
    chosen_is("none", 0, 0, 0, 0, 0);
}

/* At a corner both sides grow alike and the opposite one stays, at a side one does; undone;
 * kept in the file; and grown with the letters. */
static void strokes_are_scaled(void **state)
{
    char lines[4000];
    (void)state;
    notes_remove();
    snprintf(lines, sizeof lines,
             TWO "0.5 action all\n0.55 tell %s\n0.6 press 305 425 1\n0.61 drag 350 480 1\n"
                 "0.62 lift 405 545\n0.7 tell %s\n0.8 action undo\n0.85 tell %s\n0.9 action "
                 "redo\n1 press 405 420 1\n1.01 lift 305 420\n1.1 tell %s\n1.2 picture %s\n",
             played_path("whole"), played_path("scaled"), played_path("undone"),
             played_path("flat"), played_path("scaled.png"));
    played_run(lines, played_path("one.md"));
    played_well();
    chosen_is("whole", 2, 200, 300, 100, 120);
    chosen_is("scaled", 2, 200, 300, 200, 240);
    chosen_is("undone", 2, 200, 300, 100, 120);
    chosen_is("flat", 2, 200, 300, 100, 240);
    snprintf(lines, sizeof lines,
             "0.2 action move-ink\n0.3 action all\n0.4 tell %s\n0.5 size 34\n0.8 tell %s\n",
             played_path("kept"), played_path("large"));
    played_run(lines, played_path("one.md"));
    played_well();
    chosen_is("kept", 2, 200, 300, 100, 240);
}

/* Both strokes; paragraphs that stand beside them are set together, which moves them by part of
 * a pixel each. */
static void chosen_about(const char *told, double x, double y)
{
    const struct chosen c = chosen(told);
    assert_int_equal(c.count, 2);
    is_near(c.x, x, 3);
    is_near(c.y, y, 8);
    is_near(c.width, 100, 5);
    is_near(c.height, 120, 5);
}

/* Text keeps away from what says so, goes with it when it is moved, at once where it is in
 * another paragraph, and again when the file is opened; undone at once. */
static void text_flows_around_ink(void **state)
{
    char lines[4000];
    (void)state;
    notes_remove();
    snprintf(lines, sizeof lines,
             TWO "0.5 action all\n0.55 tell %s\n0.6 key f\n0.7 tell %s\n0.8 picture %s\n"
                 "0.9 press 301 380 1\n0.91 drag 330 500 1\n0.92 lift 341 560\n1 tell %s\n"
                 "1.1 action undo\n1.2 tell %s\n1.3 action undo\n1.35 action all\n"
                 "1.4 tell %s\n1.5 action redo\n1.55 action all\n1.6 tell %s\n",
             played_path("over"), played_path("around"), played_path("around.png"),
             played_path("moved"), played_path("back"), played_path("undone"),
             played_path("again"));
    played_run(lines, played_path("one.md"));
    played_well();
    chosen_is("over", 2, 200, 300, 100, 120);
    assert_true(atoi(played_told("over", "under")) > 2);
    chosen_about("around", 200, 300);
    assert_string_equal(played_told("around", "under"), "0");
    chosen_about("moved", 240, 480);
    assert_string_equal(played_told("moved", "under"), "0");
    assert_true(atoi(played_told("undone", "under")) > 2);
    chosen_about("again", 200, 300);
    assert_string_equal(played_told("again", "under"), "0");
    snprintf(lines, sizeof lines,
             "0.2 action move-ink\n0.3 action all\n0.4 tell %s\n0.5 key f\n0.6 tell %s\n",
             played_path("kept"), played_path("ended"));
    played_run(lines, played_path("one.md"));
    played_well();
    chosen_about("kept", 200, 300);
    assert_string_equal(played_told("kept", "under"), "0");
    chosen_about("ended", 200, 300);
    assert_true(atoi(played_told("ended", "under")) > 2);
}

/* A group is taken at once, hangs on one word, so that it stays whole in a narrow window, and
 * is parted again; by keys alone. */
static void strokes_are_grouped_by_keys(void **state)
{
    char lines[4000];
    (void)state;
    notes_remove();
    snprintf(
        lines, sizeof lines,
        TWO "0.5 key Tab\n0.55 tell %s\n0.6 key a\n0.62 key g\n0.65 key Escape\n0.7 key Tab\n"
            "0.75 tell %s\n0.8 key Right\n0.82 key Down\n0.85 tell %s\n0.9 key plus\n0.95 tell "
            "%s\n1 strike Shift+Left\n1.05 tell %s\n",
        played_path("first"), played_path("group"), played_path("moved"), played_path("larger"),
        played_path("narrower"));
    played_run(lines, played_path("one.md"));
    played_well();
    chosen_is("first", 1, 200, 300, 100, 0);
    chosen_is("group", 2, 200, 300, 100, 120);
    chosen_is("moved", 2, 204.25, 304.25, 100, 120);
    chosen_is("larger", 2, 199, 298, 110, 132);
    chosen_is("narrower", 2, 204, 298, 100, 132);
    snprintf(lines, sizeof lines,
             "0.2 action move-ink\n0.3 key Tab\n0.4 tell %s\n0.5 window 420 900\n0.8 tell "
             "%s\n0.9 key G\n0.95 tell %s\n1 key Escape\n1.1 key Tab\n1.2 tell %s\n1.3 action "
             "undo\n1.4 key Tab\n1.5 tell %s\n1.6 key Delete\n1.65 tell %s\n1.7 action undo\n"
             "1.8 tell %s\n",
             played_path("again"), played_path("narrow"), played_path("parted"),
             played_path("alone"), played_path("back"), played_path("erased"),
             played_path("had"));
    played_run(lines, played_path("one.md"));
    played_well();
    const struct chosen wide = chosen("again"), narrow = chosen("narrow");
    assert_int_equal(narrow.count, 2);
    assert_true(fabs(narrow.x - wide.x) > 5 || fabs(narrow.y - wide.y) > 5); /* it went */
    is_near(narrow.width, wide.width, 0.5);
    is_near(narrow.height, wide.height, 0.5);
    chosen_is("parted", 2, narrow.x, narrow.y, narrow.width, narrow.height); /* stays there */
    assert_int_equal(chosen("alone").count, 1);
    assert_int_equal(chosen("back").count, 2);
    assert_string_equal(played_told("erased", "remarks"), "0");
    assert_string_equal(played_told("had", "remarks"), "2");
}

/* Spots of a scaled stroke of a group are taken out where they are seen, and its pieces are of
 * the group. */
static void pieces_stay_in_the_group(void **state)
{
    char lines[4000];
    (void)state;
    notes_remove();
    snprintf(lines, sizeof lines,
             TWO "0.5 action all\n0.6 press 305 425 1\n0.62 lift 405 545\n0.65 key g\n"
                 "0.7 key E\n0.8 press 300 290 1\n0.81 drag 300 310 1\n0.82 lift 300 310\n"
                 "0.9 key m\n1 press 220 300 1\n1.01 lift 220 300\n1.1 tell %s\n",
             played_path("cut"));
    played_run(lines, played_path("one.md"));
    played_well();
    assert_string_equal(played_told("cut", "remarks"), "3");
    chosen_is("cut", 3, 200, 300, 200, 240);
}

/* A spot in the middle of a stroke, whose points are far apart, leaves two; beside it nothing
 * happens; one undo has the stroke back. */
static void spots_are_erased(void **state)
{
    char lines[2000];
    (void)state;
    notes_remove();
    snprintf(lines, sizeof lines,
             "0.2 action pen\n0.3 press 200 300 0.5\n0.32 drag 400 300 0.5\n0.34 lift 400 300\n"
             "0.5 key E\n0.6 press 300 340 1\n0.62 lift 300 340\n0.7 tell %s\n"
             "0.8 press 300 280 1\n0.82 drag 300 320 1\n0.84 lift 300 320\n1 tell %s\n"
             "1.1 action undo\n1.2 tell %s\n1.3 action redo\n1.4 tell %s\n"
             "1.5 press 190 300 1\n1.52 drag 410 300 1\n1.54 lift 410 300\n1.6 tell %s\n"
             "1.7 action undo\n1.8 action undo\n1.9 tell %s\n",
             played_path("beside"), played_path("cut"), played_path("undone"),
             played_path("redone"), played_path("gone"), played_path("whole"));
    played_run(lines, played_path("one.md"));
    played_well();
    assert_string_equal(played_told("beside", "remarks"), "1");
    assert_string_equal(played_told("cut", "remarks"), "2");
    const double x = atof(played_told("cut", "ink")); /* where the last one begins */
    assert_true(x > 307 && x < 311);
    assert_string_equal(played_told("undone", "remarks"), "1");
    assert_string_equal(played_told("undone", "ink"), "200.0 300.0");
    assert_string_equal(played_told("redone", "remarks"), "2");
    assert_string_equal(played_told("gone", "remarks"), "0");
    assert_string_equal(played_told("whole", "remarks"), "1");
}

/* A stroke that is cut after another one was drawn is played before that still. */
static void pieces_are_played_first(void **state)
{
    char lines[2000];
    (void)state;
    notes_remove();
    snprintf(
        lines, sizeof lines,
        "0.2 action pen\n0.3 press 200 300 0.5\n0.301 drag 400 300 0.5\n0.302 lift 400 300\n"
        "0.5 press 220 340 0.5\n0.501 drag 420 340 0.5\n0.502 lift 420 340\n0.6 tell %s\n"
        "0.7 key E\n0.8 press 300 280 1\n0.82 drag 300 320 1\n0.84 lift 300 320\n"
        "1 tell %s\n1.1 action undo\n1.2 tell %s\n",
        played_path("drawn"), played_path("cut"), played_path("undone"));
    played_run(lines, played_path("one.md"));
    played_well();
    assert_string_equal(played_told("drawn", "played"), "200 220");
    int first = 0, second = 0, third = 0;
    assert_int_equal(sscanf(played_told("cut", "played"), "%d %d %d", &first, &second, &third),
                     3);
    assert_int_equal(first, 200);
    assert_true(second > 307 && second < 311);
    assert_int_equal(third, 220);
    assert_string_equal(played_told("undone", "played"), "200 220");
}

static int begin(void **state)
{
    const int status = played_begin(state);
    char text[9000] = "# One\n\n";
    char *at = text + strlen(text);
    for (int i = 0; i < 40; i++)
        at += sprintf(at,
                      "Paragraph %d has some words that go on over a line or two, so that "
                      "there is something to be set when the window is narrow.\n\n",
                      i);
    if (status == 0)
        played_write("one.md", text);
    return status;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(strokes_are_chosen_and_moved),
        cmocka_unit_test(strokes_are_scaled),
        cmocka_unit_test(text_flows_around_ink),
        cmocka_unit_test(strokes_are_grouped_by_keys),
        cmocka_unit_test(pieces_stay_in_the_group),
        cmocka_unit_test(spots_are_erased),
        cmocka_unit_test(pieces_are_played_first),
    };
    if (!screen_start("1280x900x24"))
        return 77;
    return cmocka_run_group_tests(tests, begin, played_end);
}
