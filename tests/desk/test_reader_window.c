/* test_reader_window.c - the reader's window on an Xvfb, played recorded input in place of a
 * hand: it scrolls, opens notes, follows links and goes back, finds, selects, keeps the line
 * that is read; and what it says when something is wrong. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <display.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "../lutetia/child.h"
#include "xvfb.h"

static char folder[] = "/tmp/lutetia-reader-XXXXXX";
static struct child child;

static const char *in_folder(const char *name)
{
    static char paths[8][128];
    static int next;
    char *path = paths[next++ % 8];
    snprintf(path, sizeof paths[0], "%s/%s", folder, name);
    return path;
}

static void file_write(const char *name, const char *text)
{
    FILE *file = fopen(in_folder(name), "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static void documents_write(void)
{
    FILE *file = fopen(in_folder("one.md"), "w");
    assert_non_null(file);
    fputs("# One\n\nA word[^a] and [the other](two.md#far), [below](#chapter-30), "
          "[bad](file:///etc/passwd).\n\n"
          "[^a]: What the note says, with *more*[^b].\n\n[^b]: And a deeper one.\n\n",
          file);
    for (int i = 0; i < 60; i++)
        fprintf(file,
                "## Chapter %d\n\nParagraph %d has some words that go on over a line or two, "
                "so that there is "
                "something to be set when the window is as narrow as it is now and then. "
                "Reed%d.\n\n",
                i, i, i);
    fclose(file);
    file_write("two.md", "# Two\n\nNear.\n\n## Far\n\nWhat is far.\n");
}

/* The latest time of these lines. */
static double last_s(const char *lines)
{
    double last = 0;
    for (const char *at = lines; *at; at += *at == '\n') {
        const double time = atof(at);
        last = time > last ? time : last;
        at += strcspn(at, "\n");
    }
    return last;
}

/* Runs the window with these lines, and closes it. */
static void reader_run(const char *lines, const char *document)
{
    char all[4096];
    snprintf(all, sizeof all, "%s\n%g close\n", lines, last_s(lines) + 0.3);
    file_write("hand.events", all);
    memset(&child, 0, sizeof child);
    const char *const arguments[] = {
        getenv("LUTETIA"),       "read", document, "--theme", "light", "--play",
        in_folder("hand.events")};
    memcpy(child.arguments, arguments, sizeof arguments);
    child.variables[0] = "GTK_A11Y=none"; /* no bus is needed for this */
    child.variables[1] = "GSK_RENDERER=cairo";
    child_run(&child);
}

/* The value of a line of what the window told. */
static const char *told(const char *name, const char *what)
{
    static char lines[4][512];
    static int next;
    char *line = lines[next++ % 4];
    FILE *file = fopen(in_folder(name), "r");
    const size_t length = strlen(what);
    if (!file)
        fail_msg("%s was not told: %s", name, child.errors);
    while (fgets(line, sizeof lines[0], file))
        if (strncmp(line, what, length) == 0 && line[length] == ' ') {
            fclose(file);
            line[strcspn(line, "\n")] = '\0';
            return line + length + 1;
        }
    fail_msg("%s says nothing of %s", name, what);
    return "";
}

static void runs_well(void)
{
    if (child.status != 0 || child.errors[0])
        print_message("%s", child.errors);
    assert_int_equal(child.status, 0);
    assert_string_equal(child.errors, "");
}

static void line_is_kept(void **state)
{
    char lines[2000];
    (void)state;
    snprintf(lines, sizeof lines,
             "0.2 go Reed25\n0.3 scroll 33\n0.4 tell %s\n0.5 window 500 700\n0.8 size 26\n1 "
             "column 20\n1.2 dark 1\n"
             "1.3 window 1100 600\n1.6 size 12\n1.7 column 34\n1.9 tell %s\n",
             in_folder("before"), in_folder("after"));
    reader_run(lines, in_folder("one.md"));
    runs_well();
    assert_string_equal(told("before", "top"), told("after", "top"));
    assert_string_not_equal(told("before", "top"), "0");
}

static void notes_links_and_back(void **state)
{
    char lines[2000];
    (void)state;
    snprintf(
        lines, sizeof lines,
        "0.2 key Tab\n0.3 key Return\n0.4 tell %s\n0.5 key Tab\n0.5 key Return\n0.7 tell %s\n"
        "0.8 action back\n1 tell %s\n1.1 follow below\n1.3 tell %s\n1.4 action back\n1.6 tell "
        "%s\n",
        in_folder("note"), in_folder("two"), in_folder("back"), in_folder("below"),
        in_folder("again"));
    reader_run(lines, in_folder("one.md"));
    runs_well();
    assert_string_equal(told("note", "open"), "1");
    assert_non_null(strstr(told("two", "file"), "two.md"));
    assert_non_null(strstr(told("back", "file"), "one.md"));
    assert_non_null(strstr(told("below", "line"), "Chapter 30"));
    assert_string_equal(told("again", "top"), told("back", "top"));
}

static void finds_and_selects(void **state)
{
    char lines[2000];
    (void)state;
    snprintf(lines, sizeof lines,
             "0.2 search REED4\n0.4 tell %s\n0.5 action search-next\n0.6 tell %s\n"
             "0.7 action all\n0.8 tell %s\n0.9 key Escape\n1 key End\n1.2 tell %s\n1.3 key "
             "Home\n1.5 glide 300\n2.6 tell %s\n",
             in_folder("found"), in_folder("next"), in_folder("all"), in_folder("end"),
             in_folder("glide"));
    reader_run(lines, in_folder("one.md"));
    runs_well();
    assert_string_equal(told("found", "hits"), "11"); /* 4, 40 to 49 */
    assert_string_equal(told("found", "hit"), "0");
    assert_string_equal(told("next", "hit"), "1");
    assert_string_equal(told("all", "selected"), "# One");
    assert_true(atof(told("end", "above")) > 1000);
    const double above = atof(told("glide", "above"));
    assert_true(above > 290 && above < 310);
}

/* What stays is moved: scrolled by some lines, hardly anything is painted anew. */
static void only_new_lines_are_painted(void **state)
{
    char lines[4000] = "0.2 go Reed10\n0.6 tell ";
    (void)state;
    strcat(lines, in_folder("still"));
    strcat(lines, "\n");
    for (int i = 0; i < 20; i++)
        strcat(lines, "0.7 scroll 1\n");
    strcat(lines, "1 tell ");
    strcat(lines, in_folder("moved"));
    reader_run(lines, in_folder("one.md"));
    runs_well();
    assert_true(atol(told("moved", "painted")) - atol(told("still", "painted")) <= 2);
    assert_string_not_equal(told("moved", "above"), told("still", "above"));
}

/* The picture is the text: both themes, nothing empty. */
static void picture_is_seen(void **state)
{
    char lines[1000];
    struct display_image light, dark;
    (void)state;
    snprintf(lines, sizeof lines, "0.3 picture %s\n0.4 dark 1\n0.7 picture %s\n",
             in_folder("light.png"), in_folder("dark.png"));
    reader_run(lines, in_folder("one.md"));
    runs_well();
    assert_int_equal(display_png_read_rgb(in_folder("light.png"), &light), DISPLAY_OK);
    assert_int_equal(display_png_read_rgb(in_folder("dark.png"), &dark), DISPLAY_OK);
    int ink = 0, lit = 0; /* pixels */
    for (int y = 120; y < light.height_px - 20; y++)
        for (int x = 20; x < light.width_px - 40; x++) {
            ink += light.pixels[3 * (y * light.width_px + x)] < 140;
            lit += dark.pixels[3 * (y * dark.width_px + x)] > 150;
        }
    assert_true(ink > 1500 && ink < 100000);
    assert_true(lit > 1500 && lit < 100000);
    display_image_destroy(&light);
    display_image_destroy(&dark);
}

/* ---- demonstrations ---- */

static void demonstrations_write(void)
{
    file_write("live.md",
               "# Live\n\n```lua live 200x60\n"
               "local n, x0 = 0, 0\n"
               "function step() n = n + 1 end\n"
               "function draw() print('at', x0) return {n > 0 and 1 or 0, 0, 1} end\n"
               "function pointer(what, x, y) if what == 'down' then x0 = x end end\n"
               "function key(name) x0 = name end\n"
               "```\n\n"
               "```lua live 200x60\nfunction draw() while true do end end\n```\n\n"
               "```lua live 200x60\nthis is no Lua\n```\n\nThe end.\n");
}

/* Of a stage that was told: whether it runs, its pictures, its place. */
struct stage_told {
    char seen[10], runs[10];
    int pictures, x, y, width, height;
};

static struct stage_told stage_told(const char *name, const char *stage)
{
    struct stage_told t;
    const char *line = told(name, stage);
    if (sscanf(line, "%9s %9s %d %d %d %d %d", t.seen, t.runs, &t.pictures, &t.x, &t.y,
               &t.width, &t.height) != 7)
        fail_msg("%s %s", stage, line);
    return t;
}

/* Nothing runs before its button is pressed; then it is seen, hears, rests again, and says so
 * where it never ends or fails. (security.md 36) */
static void demonstrations_run(void **state)
{
    char lines[2000];
    (void)state;
    demonstrations_write();
    snprintf(lines, sizeof lines,
             "0.4 tell %s\n0.5 stage 1\n0.5 await 1 5\n0.5 picture %s\n0.6 tell %s\n"
             "0.6 stage 2\n0.6 stage 3\n0.6 await 2 1\n0.6 await 3 1\n0.7 tell %s\n0.7 stage "
             "1\n0.8 tell %s\n",
             in_folder("before"), in_folder("live.png"), in_folder("runs"), in_folder("wrong"),
             in_folder("after"));
    reader_run(lines, in_folder("live.md"));
    runs_well();
    struct stage_told t = stage_told("before", "stage1");
    assert_string_equal(t.seen, "seen");
    assert_string_equal(t.runs, "rests");
    assert_string_equal(stage_told("before", "stage3").runs, "rests");
    t = stage_told("runs", "stage1");
    assert_string_equal(t.runs, "runs");
    assert_true(t.pictures >= 5 && t.width == 200 && t.height == 60);
    assert_string_equal(told("runs", "line1"), "at 0");
    assert_string_equal(stage_told("runs", "stage2").runs, "rests");
    struct display_image image; /* magenta, somewhere: all of the picture's pixels */
    assert_int_equal(display_png_read_rgb(in_folder("live.png"), &image), DISPLAY_OK);
    int pixels = 0;
    for (int i = 0; i < image.width_px * image.height_px; i++) {
        const uint8_t *p = image.pixels + 3 * i;
        pixels += p[0] > 250 && p[1] < 5 && p[2] > 250;
    }
    display_image_destroy(&image);
    assert_true(pixels >= 198 * 58 && pixels <= 200 * 60);
    /* five seconds of computing may be more than two minutes where others compute, too */
    assert_true(strstr(told("wrong", "line2"), "stopped after 5 seconds") ||
                strstr(told("wrong", "line2"), "has not answered"));
    assert_non_null(strstr(told("wrong", "line3"), "live:1:"));
    assert_string_equal(stage_told("wrong", "stage2").runs, "rests");
    assert_string_equal(stage_told("wrong", "stage1").runs, "runs");
    assert_string_equal(stage_told("after", "stage1").runs, "rests");
    assert_string_equal(told("after", "line1"), "Stopped.");
    /* a hand in it: its place was told above */
    snprintf(lines, sizeof lines,
             "0.4 stage 1\n0.4 await 1 1\n0.5 down %d %d 1\n0.5 up %d %d\n0.5 await 1 6\n"
             "0.6 tell %s\n0.6 key Left\n0.6 await 1 12\n0.7 tell %s\n0.7 key Escape\n0.7 key "
             "End\n0.7 await 1 18\n0.8 tell %s\n",
             t.x + 50, t.y + 20, t.x + 50, t.y + 20, in_folder("down"), in_folder("key"),
             in_folder("end"));
    reader_run(lines, in_folder("live.md"));
    runs_well();
    assert_string_equal(told("down", "line1"), "at 50.0");
    assert_string_equal(told("key", "line1"), "at Left");
    assert_string_equal(told("end", "line1"), "at Left");
}

/* By keys alone: Tab comes to it, Return runs it and gives it the keys, and after Escape
 * Return stops it. */
static void demonstrations_are_reached_by_keys(void **state)
{
    char lines[1000];
    (void)state;
    demonstrations_write();
    snprintf(lines, sizeof lines,
             "0.5 key Tab\n0.6 key Return\n0.6 await 1 2\n0.6 key x\n0.6 await 1 6\n0.7 tell "
             "%s\n0.7 key Escape\n0.8 key Return\n0.9 tell %s\n",
             in_folder("runs"), in_folder("stopped"));
    reader_run(lines, in_folder("live.md"));
    runs_well();
    assert_string_equal(stage_told("runs", "stage1").runs, "runs");
    assert_string_equal(told("runs", "line1"), "at x");
    assert_string_equal(stage_told("stopped", "stage1").runs, "rests");
    assert_string_equal(told("stopped", "line1"), "Stopped.");
}

/* Three run at a time, and compute only while they are seen: of those that are not, one gives
 * its place to the next. (security.md 36) */
static void three_run_and_rest_unseen(void **state)
{
    static const char live[] =
        "```lua live 200x40\nfunction draw() return '#ff00ff' end\n```\n\n";
    char lines[1500];
    (void)state;
    FILE *file = fopen(in_folder("five.md"), "w");
    assert_non_null(file);
    for (int i = 0; i < 4; i++)
        fputs(live, file);
    for (int i = 0; i < 60; i++)
        fprintf(file, "Paragraph %d.\n\n", i);
    fprintf(file, "Here.\n\n%s", live);
    fclose(file);
    snprintf(
        lines, sizeof lines,
        "0.5 stage 1\n0.5 stage 2\n0.5 stage 3\n0.5 stage 4\n0.5 await 1 3\n0.5 await 2 "
        "3\n0.5 await 3 3\n0.5 tell %s\n0.6 go Here.\n0.9 stage 1\n0.9 await 1 3\n0.9 tell "
        "%s\n0.9 await 1 30\n0.9 tell %s\n1 key Home\n1.2 await 2 20\n1.2 tell %s\n",
        in_folder("three"), in_folder("far"), in_folder("later"), in_folder("back"));
    reader_run(lines, in_folder("five.md"));
    runs_well();
    for (int i = 1; i <= 3; i++) {
        char name[20];
        snprintf(name, sizeof name, "stage%d", i);
        assert_string_equal(stage_told("three", name).runs, "runs");
        assert_string_equal(stage_told("far", name).seen, "unseen");
        assert_int_equal(stage_told("far", name).pictures, stage_told("later", name).pictures);
    }
    assert_string_equal(stage_told("three", "stage4").runs, "rests");
    assert_non_null(strstr(told("three", "line4"), "Three demonstrations run already"));
    assert_string_equal(stage_told("far", "stage1").runs, "rests"); /* it was the first */
    assert_string_equal(stage_told("far", "stage2").runs, "runs");
    assert_string_equal(stage_told("far", "stage5").runs, "runs");
    assert_true(stage_told("later", "stage5").pictures >= 30);
    assert_true(stage_told("back", "stage2").pictures >= 20);
    assert_string_equal(stage_told("back", "stage5").seen, "unseen");
}

/* ---- notes ---- */

static void notes_remove(void)
{
    unlink(in_folder("one.md.notes"));
    unlink(in_folder("one.md.notes-wal"));
    unlink(in_folder("one.md.notes-shm"));
}

/* Highlights, words and ink are there again, where they were; erased ones come back by undo. */
static void notes_are_kept(void **state)
{
    char lines[3000];
    (void)state;
    notes_remove();
    snprintf(lines, sizeof lines,
             "0.2 select A word\n0.3 action highlight\n0.4 select Paragraph 0\n0.4 note Is it "
             "so?\n0.5 action pen\n"
             "0.6 press 300 150 0.3\n0.62 drag 320 160 0.5\n0.64 drag 340 150 0.9\n0.66 lift "
             "340 150\n0.8 tell %s\n"
             "0.9 action undo\n1 tell %s\n1.1 action redo\n1.2 tell %s\n",
             in_folder("drawn"), in_folder("undone"), in_folder("redone"));
    reader_run(lines, in_folder("one.md"));
    runs_well();
    assert_string_equal(told("drawn", "remarks"), "3");
    assert_string_equal(told("drawn", "ink"), "300.0 150.0");
    assert_string_equal(told("undone", "remarks"), "2");
    assert_string_equal(told("redone", "remarks"), "3");
    snprintf(
        lines, sizeof lines,
        "0.2 tell %s\n0.3 size 24\n0.5 tell %s\n0.6 size 17\n0.8 tell %s\n0.9 action eraser\n"
        "1 press 320 160 1\n1.05 lift 320 160\n1.2 tell %s\n1.25 action undo\n1.3 action "
        "move-ink\n"
        "1.4 press 300 150 1\n1.5 drag 330 190 1\n1.55 lift 330 190\n1.7 tell %s\n1.8 action "
        "play-back\n",
        in_folder("again"), in_folder("large"), in_folder("small"), in_folder("erased"),
        in_folder("moved"));
    reader_run(lines, in_folder("one.md"));
    runs_well();
    assert_string_equal(told("again", "remarks"), "3");
    assert_string_equal(told("again", "ink"), "300.0 150.0");
    assert_string_not_equal(told("large", "ink"), "300.0 150.0");
    assert_string_equal(told("small", "ink"), "300.0 150.0");
    assert_string_equal(told("erased", "remarks"), "2");
    assert_string_equal(told("moved", "ink"), "330.0 190.0");
}

/* Another program changes the file while it is read: the notes go with their words, or are
 * orphans. */
static void changed_elsewhere(void **state)
{
    char lines[2000], command[400];
    (void)state;
    notes_remove();
    unlink(in_folder("before")); /* another test's */
    snprintf(command, sizeof command, "cp %s %s", in_folder("one.md"), in_folder("kept.md"));
    assert_int_equal(system(command), 0);
    snprintf(lines, sizeof lines,
             "0.2 select Reed3.\n0.3 action highlight\n0.4 select Paragraph 0 has\n0.4 note "
             "Gone soon\n0.5 go Reed20\n0.6 tell %s\n"
             "3 tell %s\n",
             in_folder("before"), in_folder("after"));
    snprintf(command, sizeof command,
             "(while [ ! -s %s ]; do sleep 0.05; done; sed -i -e '1i More before it.\\n' -e "
             "'s/Paragraph 0 has/There are/' %s) &",
             in_folder("before"), in_folder("one.md"));
    assert_int_equal(system(command), 0);
    reader_run(lines, in_folder("one.md"));
    runs_well();
    assert_string_equal(told("before", "orphans"), "0");
    assert_string_equal(told("after", "remarks"), "2");
    assert_string_equal(told("after", "orphans"), "1");
    assert_string_equal(told("after", "line"), told("before", "line"));
    assert_string_not_equal(told("after", "top"), told("before", "top"));
    snprintf(command, sizeof command, "mv %s %s", in_folder("kept.md"), in_folder("one.md"));
    assert_int_equal(system(command), 0);
}

/* A notes file that is none is said, and left; the document is read all the same. */
static void foreign_notes_are_said(void **state)
{
    char lines[1000];
    (void)state;
    notes_remove();
    file_write("one.md.notes", "a letter that somebody put here, long enough to be looked at");
    snprintf(lines, sizeof lines, "0.2 select A word\n0.3 tell %s\n", in_folder("foreign"));
    reader_run(lines, in_folder("one.md"));
    assert_int_equal(child.status, 0);
    assert_non_null(strstr(child.errors, "one.md.notes: "));
    assert_non_null(strstr(child.errors, "it is left as it is"));
    assert_string_equal(told("foreign", "remarks"), "0");
    char first[20] = "";
    FILE *file = fopen(in_folder("one.md.notes"), "r");
    assert_non_null(file);
    assert_non_null(fgets(first, sizeof first, file));
    assert_memory_equal(first, "a letter that", 13);
    fclose(file);
    notes_remove();
}

/* ---- what is wrong ---- */

static void says(int status, const char *what)
{
    if (child.status != status || !strstr(child.errors, what))
        print_message("%d: %s", child.status, child.errors);
    assert_int_equal(child.status, status);
    const char *line = strstr(child.errors, "lutetia read: ");
    assert_non_null(line);
    assert_non_null(strstr(line, what));
    assert_null(strstr(line + 1, "lutetia read: "));
}

static void wrong_is_one_line(void **state)
{
    (void)state;
    reader_run("0 jump", in_folder("one.md"));
    says(1, "hand.events:1: no such word: 'jump'");
    reader_run("0 down 1", in_folder("one.md"));
    says(1, "hand.events:1: 'down' has 3 numbers");
    reader_run("0.2 follow bad", in_folder("one.md"));
    says(0, "file:///etc/passwd is not followed");
    reader_run("", "/no/such.md");
    says(1, "/no/such.md: ");
    reader_run("", "-");
    says(2, "give -o FILE");
    const char *const arguments[] = {getenv("LUTETIA"), "read", in_folder("one.md"),
                                     "--columns", "2"};
    memset(&child, 0, sizeof child);
    memcpy(child.arguments, arguments, sizeof arguments);
    child_run(&child);
    says(2, "--columns");
    child.arguments[3] = NULL;
    child.variables[0] = "DISPLAY=:4711";
    child.variables[1] = "WAYLAND_DISPLAY=";
    child_run(&child);
    says(1, "no display");
}

static int folder_make(void **state)
{
    (void)state;
    if (!mkdtemp(folder))
        return -1;
    setenv("XDG_DATA_HOME", folder, 1);
    documents_write();
    return 0;
}

static int folder_remove(void **state)
{
    char command[160];
    (void)state;
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return system(command);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(line_is_kept),
        cmocka_unit_test(notes_links_and_back),
        cmocka_unit_test(finds_and_selects),
        cmocka_unit_test(only_new_lines_are_painted),
        cmocka_unit_test(notes_are_kept),
        cmocka_unit_test(changed_elsewhere),
        cmocka_unit_test(foreign_notes_are_said),
        cmocka_unit_test(picture_is_seen),
        cmocka_unit_test(demonstrations_run),
        cmocka_unit_test(demonstrations_are_reached_by_keys),
        cmocka_unit_test(three_run_and_rest_unseen),
        cmocka_unit_test(wrong_is_one_line),
    };
    if (!screen_start("1280x900x24"))
        return 77;
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
