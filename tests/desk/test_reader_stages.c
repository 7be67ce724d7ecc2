/* test_reader_stages.c - demonstrations in the reader's window, on an Xvfb with recorded input:
 * they run, are set, rest where they are not seen, and say what is wrong; and documents that
 * are made to be hard. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <display.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <jail.h>

#include "../skip.h"
#include "reader_played.h"
#include "xvfb.h"

static void demonstrations_write(void)
{
    played_write("live.md",
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
    int changed; /* of its pictures, those that were other than the one before */
};

static struct stage_told stage_told(const char *name, const char *stage)
{
    struct stage_told t;
    const char *line = played_told(name, stage);
    if (sscanf(line, "%9s %9s %d %d %d %d %d %d", t.seen, t.runs, &t.pictures, &t.x, &t.y,
               &t.width, &t.height, &t.changed) != 8)
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
             played_path("before"), played_path("live.png"), played_path("runs"),
             played_path("wrong"), played_path("after"));
    played_run(lines, played_path("live.md"));
    played_well();
    struct stage_told t = stage_told("before", "stage1");
    assert_string_equal(t.seen, "seen");
    assert_string_equal(t.runs, "rests");
    assert_string_equal(stage_told("before", "stage3").runs, "rests");
    t = stage_told("runs", "stage1");
    assert_string_equal(t.runs, "runs");
    assert_true(t.pictures >= 5 && t.width == 200 && t.height == 60);
    assert_string_equal(played_told("runs", "line1"), "at 0");
    assert_string_equal(stage_told("runs", "stage2").runs, "rests");
    struct display_image image; /* magenta, somewhere: all of the picture's pixels */
    assert_int_equal(display_png_read_rgb(played_path("live.png"), &image), DISPLAY_OK);
    int pixels = 0;
    for (int i = 0; i < image.width_px * image.height_px; i++) {
        const uint8_t *p = image.pixels + 3 * i;
        pixels += p[0] > 250 && p[1] < 5 && p[2] > 250;
    }
    display_image_destroy(&image);
    assert_true(pixels >= 198 * 58 && pixels <= 200 * 60);
    /* five seconds of computing may be more than two minutes where others compute, too */
    assert_true(strstr(played_told("wrong", "line2"), "stopped after 5 seconds") ||
                strstr(played_told("wrong", "line2"), "has not answered"));
    assert_non_null(strstr(played_told("wrong", "line3"), "live:1:"));
    assert_string_equal(stage_told("wrong", "stage2").runs, "rests");
    assert_string_equal(stage_told("wrong", "stage1").runs, "runs");
    assert_string_equal(stage_told("after", "stage1").runs, "rests");
    assert_string_equal(played_told("after", "line1"), "Stopped.");
    /* a hand in it: its place was told above */
    snprintf(lines, sizeof lines,
             "0.4 stage 1\n0.4 await 1 1\n0.5 down %d %d 1\n0.5 up %d %d\n0.5 await 1 6\n"
             "0.6 tell %s\n0.6 key Left\n0.6 await 1 12\n0.7 tell %s\n0.7 key Escape\n0.7 key "
             "End\n0.7 await 1 18\n0.8 tell %s\n",
             t.x + 50, t.y + 20, t.x + 50, t.y + 20, played_path("down"), played_path("key"),
             played_path("end"));
    played_run(lines, played_path("live.md"));
    played_well();
    assert_string_equal(played_told("down", "line1"), "at 50.0");
    assert_string_equal(played_told("key", "line1"), "at Left");
    assert_string_equal(played_told("end", "line1"), "at Left");
}

/* Its controls stand under its picture, the text below them; what a hand sets reaches the
 * script, and a stopped one keeps its rows. */
static void demonstrations_have_controls(void **state)
{
    char lines[1500];
    (void)state;
    played_write("controls.md",
                 "# Controls\n\n```lua live 200x60\n"
                 "local a = control{name = 'speed', least = 0, most = 4, usual = 1.5}\n"
                 "local c = control{name = 'ink', choices = 'blue red green'}\n"
                 "local b = control{name = 'wet', curve = 'switch'}\n"
                 "function draw() print(a(), c(), b()) return '#ff00ff' end\n"
                 "```\n\n```lua live 200x60\nfunction draw() return '#00ff00' end\n```\n");
    snprintf(
        lines, sizeof lines,
        "0.4 tell %s\n0.5 stage 1\n0.5 await 1 5\n0.6 tell %s\n0.7 set 1 1 2.5\n0.7 set 1 2 "
        "2\n0.7 set 1 3 1\n0.7 await 1 20\n0.8 picture %s\n0.8 tell %s\n0.9 stage 1\n1 "
        "tell %s\n",
        played_path("before"), played_path("runs"), played_path("controls.png"),
        played_path("set"), played_path("after"));
    played_run(lines, played_path("controls.md"));
    played_well();
    assert_string_equal(played_told("runs", "line1"), "1.5 blue false");
    assert_string_equal(played_told("runs", "control1"), "1.5 speed");
    assert_string_equal(played_told("set", "line1"), "2.5 green true");
    assert_string_equal(played_told("set", "control1"), "2.5 speed");
    assert_string_equal(played_told("set", "control2"), "2 ink");
    assert_string_equal(played_told("set", "control3"), "1 wet");
    assert_string_equal(played_told("after", "line1"), "Stopped.");
    const struct stage_told before = stage_told("before", "stage2"),
                            runs = stage_told("runs", "stage2"),
                            after = stage_told("after", "stage2");
    assert_true(runs.y > before.y + 60 && runs.y < before.y + 250); /* three rows of widgets */
    assert_int_equal(after.y, runs.y);
}

/* A program in C/Paris: its lights are seen, what it prints, and its mistakes; with other text
 * on the disk it is compiled anew, and one that could not be, too. (security.md 39) */
static void programs_run(void **state)
{
#define PROGRAM(first, second)                                                                 \
    "# Programs\n\n```c paris 100x100\n#include <cm/paris.h>\n#include <stdio.h>\n"            \
    "int main ()\n{\n    for (;;) {\n        CM_field_id_t f;\n        CM_init ();\n"          \
    "        f = CM_allocate_stack_field (1);\n        CM_u_move_constant_1L (f, 1, 1);\n"     \
    "        puts (\"" first "\");\n        for (;;)\n            CM_latch_leds (f);\n    "    \
    "}\n}\n```\n\n```c paris 100x100\n" second "\n```\n"
    char lines[2000];
    (void)state;
    if (!jail_possible())
        skip_because("this kernel has no Landlock");
    played_write("program.md", PROGRAM("one", "int main ()\n{\n    return nothing;\n}"));
    snprintf(lines, sizeof lines,
             "0.4 tell %s\n0.5 stage 1\n0.5 await 1 40\n0.6 stage 2\n0.6 await 2 1000000\n"
             "0.7 tell %s\n6 await 1 40\n6 await 2 40\n6.1 tell %s\n6.1 stage 1\n6.3 tell %s\n",
             played_path("before"), played_path("runs"), played_path("anew"),
             played_path("after"));
    unlink(played_path("runs")); /* another test's */
    const pid_t writer = fork(); /* another program */
    if (writer == 0) {
        while (access(played_path("runs"), F_OK) != 0)
            usleep(100000);
        usleep(300000);
        played_write("program.md",
                     PROGRAM("another", "#include <stdio.h>\nint main () { puts (\"good\"); "
                                        "for (;;) putchar (10); }"));
        _exit(EXIT_SUCCESS);
    }
    played_run(lines, played_path("program.md"));
    waitpid(writer, NULL, 0);
    played_well();
    assert_string_equal(stage_told("before", "stage1").runs, "rests");
    assert_string_equal(stage_told("runs", "stage1").runs, "runs");
    assert_string_equal(played_told("runs", "printed1.1"), "one");
    assert_string_equal(stage_told("runs", "stage2").runs, "rests");
    assert_non_null(strstr(played_told("runs", "line2"), "It has ended: it was not compiled"));
    assert_non_null(strstr(played_told("runs", "printed2.1"), "program.c:3:"));
    assert_string_equal(stage_told("anew", "stage1").runs, "runs");
    assert_string_equal(played_told("anew", "printed1.1"), "another");
    assert_string_equal(stage_told("anew", "stage2").runs, "runs");
    assert_string_equal(played_told("after", "line1"), "Stopped.");
#undef PROGRAM
}

/* One that runs and is edited in the page is compiled anew when the hand rests; one that rests
 * is not. */
static void edited_programs_are_compiled(void **state)
{
    static const char program[] =
        "# Edited\n\n```c paris 100x100\n#include <stdio.h>\nint main ()\n{\n    for (;;)\n"
        "        puts (\"one\");\n}\n```\n\n```c paris 100x100\nint main () { return 0; "
        "}\n```\n";
    char lines[2000];
    (void)state;
    if (!jail_possible())
        skip_because("this kernel has no Landlock");
    played_write("edited.md", program);
    snprintf(
        lines, sizeof lines,
        "0.4 stage 1\n0.4 await 1 40\n0.5 tell %s\n0.6 action edit\n0.7 select one\n0.8 type "
        "twenty\n0.8 tell %s\n0.8 await 2 40\n0.8 tell %s\n0.9 action undo\n1 tell %s\n",
        played_path("first"), played_path("meanwhile"), played_path("second"),
        played_path("undone"));
    played_run(lines, played_path("edited.md"));
    played_well();
    assert_string_equal(played_told("first", "printed1.1"), "one");
    /* it is the second one now: it was seen again behind the other */
    assert_string_equal(stage_told("meanwhile", "stage1").runs, "rests");
    assert_string_equal(stage_told("second", "stage1").runs, "rests");
    assert_string_equal(stage_told("second", "stage2").runs, "runs");
    assert_string_equal(played_told("second", "printed2.1"), "twenty");
    assert_string_equal(stage_told("undone", "stage2").runs, "rests");
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
             played_path("runs"), played_path("stopped"));
    played_run(lines, played_path("live.md"));
    played_well();
    assert_string_equal(stage_told("runs", "stage1").runs, "runs");
    assert_string_equal(played_told("runs", "line1"), "at x");
    assert_string_equal(stage_told("stopped", "stage1").runs, "rests");
    assert_string_equal(played_told("stopped", "line1"), "Stopped.");
}

/* Three run at a time, and compute only while they are seen: of those that are not, one gives
 * its place to the next. (security.md 36) */
static void three_run_and_rest_unseen(void **state)
{
    static const char live[] =
        "```lua live 200x40\nfunction draw() return '#ff00ff' end\n```\n\n";
    char lines[1500];
    (void)state;
    FILE *file = fopen(played_path("five.md"), "w");
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
        played_path("three"), played_path("far"), played_path("later"), played_path("back"));
    played_run(lines, played_path("five.md"));
    played_well();
    for (int i = 1; i <= 3; i++) {
        char name[20];
        snprintf(name, sizeof name, "stage%d", i);
        assert_string_equal(stage_told("three", name).runs, "runs");
        assert_string_equal(stage_told("far", name).seen, "unseen");
        assert_int_equal(stage_told("far", name).pictures, stage_told("later", name).pictures);
    }
    assert_string_equal(stage_told("three", "stage4").runs, "rests");
    assert_non_null(strstr(played_told("three", "line4"), "Three demonstrations run already"));
    assert_string_equal(stage_told("far", "stage1").runs, "rests"); /* it was the first */
    assert_string_equal(stage_told("far", "stage2").runs, "runs");
    assert_string_equal(stage_told("far", "stage5").runs, "runs");
    assert_true(stage_told("later", "stage5").pictures >= 30);
    assert_int_equal(stage_told("later", "stage5").changed, 1); /* it stands still */
    assert_true(stage_told("back", "stage2").pictures >= 20);
    assert_string_equal(stage_told("back", "stage5").seen, "unseen");
}

/* What is made to be hard is shown, searched and scrolled to its end at any width; links that
 * run something are refused, and a picture that would take all memory is told by its name. */
static void hostile_documents_are_shown(void **state)
{
    static const unsigned char bomb[] = {
        0x89, 'P',  'N',  'G',  13,   10,   26,   10, 0, 0, 0, 13, 'I',  'H',  'D',  'R', 0x7f,
        0xff, 0xff, 0xff, 0x7f, 0xff, 0xff, 0xff, 8,  6, 0, 0, 0,  0x12, 0x34, 0x56, 0x78};
    char lines[1000];
    (void)state;
    FILE *file = fopen(played_path("bomb.png"), "wb");
    assert_non_null(file);
    fwrite(bomb, 1, sizeof bomb, file);
    fclose(file);
    file = fopen(played_path("hostile.md"), "wb");
    assert_non_null(file);
    fputs("# Hostile\n\n[run it](javascript:alert(1)), [data](data:text/html,x), "
          "[up](../../../../etc/passwd).\n\n![a bomb](bomb.png)\n\n![up](../../x.png)\n\n",
          file);
    for (int i = 0; i < 1000; i++)
        fputs("> ", file);
    fputs("deep\n\n", file);
    for (int i = 0; i < 300; i++)
        fprintf(file, "%*s- item\n", 2 * i, "");
    for (int i = 0; i < 2000; i++)
        fprintf(file, "\n[^n%d]: note[^n%d]\n", i, i + 1);
    fputs("\nnotes[^n0]\n\n", file);
    for (int i = 0; i < 200000; i++)
        fputc('x', file);
    fputs("\n\n\xff\xfe \xe2\x80\xae turned \xf0\x9f\x91\xa9\xe2\x80\x8d", file);
    fwrite("zero\0zero\n\n", 1, 11, file);
    for (int i = 0; i < 40; i++)
        fputs("|a", file);
    fputs("|\n", file);
    for (int i = 0; i < 40; i++)
        fputs("|-", file);
    fputs("|\n\n$$\\frac{", file);
    for (int i = 0; i < 2000; i++)
        fputs("{\\sqrt", file);
    fputs("$$\n\nThe end of it.\n", file);
    fclose(file);
    snprintf(
        lines, sizeof lines,
        "0.2 follow run it\n0.3 window 200 300\n0.5 search xxxxxxxxxx\n0.6 action "
        "search-next\n0.7 action all\n0.8 size 40\n0.9 key End\n1.1 tell %s\n1.2 window 1200 "
        "900\n1.4 size 9\n1.5 go The end\n1.7 tell %s\n",
        played_path("narrow"), played_path("wide"));
    played_run(lines, played_path("hostile.md"));
    played_says(0, "javascript:alert(1) is not followed");
    assert_true(atof(played_told("narrow", "above")) > 1000);
    assert_true(atoi(played_told("narrow", "hits")) > 1000);
    assert_true(atoi(played_told("wide", "shown")) > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(demonstrations_run),
        cmocka_unit_test(demonstrations_have_controls),
        cmocka_unit_test(programs_run),
        cmocka_unit_test(edited_programs_are_compiled),
        cmocka_unit_test(demonstrations_are_reached_by_keys),
        cmocka_unit_test(three_run_and_rest_unseen),
        cmocka_unit_test(hostile_documents_are_shown),
    };
    if (!screen_start("1280x900x24"))
        return 77;
    return cmocka_run_group_tests(tests, played_begin, played_end);
}
