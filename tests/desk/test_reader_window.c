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
#include <sys/stat.h>
#include <unistd.h>

#include "reader_played.h"
#include "xvfb.h"

static void documents_write(void)
{
    FILE *file = fopen(played_path("one.md"), "w");
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
    assert_int_equal(mkdir(played_path("deep"), 0700), 0);
    played_write("two.md", "# Two\n\nNear.\n\n## Far\n\nWhat is far.\n");
}

static void line_is_kept(void **state)
{
    char lines[2000];
    (void)state;
    snprintf(lines, sizeof lines,
             "0.2 go Reed25\n0.3 scroll 33\n0.4 tell %s\n0.5 window 500 700\n0.8 size 26\n1 "
             "column 20\n1.2 dark 1\n"
             "1.3 window 1100 600\n1.6 size 12\n1.7 column 34\n1.9 tell %s\n",
             played_path("before"), played_path("after"));
    played_run(lines, played_path("one.md"));
    played_well();
    assert_string_equal(played_told("before", "top"), played_told("after", "top"));
    assert_string_not_equal(played_told("before", "top"), "0");
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
        played_path("note"), played_path("two"), played_path("back"), played_path("below"),
        played_path("again"));
    played_run(lines, played_path("one.md"));
    played_well();
    assert_string_equal(played_told("note", "open"), "1");
    assert_non_null(strstr(played_told("two", "file"), "two.md"));
    assert_non_null(strstr(played_told("back", "file"), "one.md"));
    assert_non_null(strstr(played_told("below", "line"), "Chapter 30"));
    assert_string_equal(played_told("again", "top"), played_told("back", "top"));
}

/* Two readers' notes beside each other; one's are hidden; HTML says whose they are. The window
 * is closed with theirs open. */
static void readers_have_layers(void **state)
{
    char lines[1500];
    (void)state;
    played_write("layers.md", "# Layers\n\nOne word, and another word.\n");
    snprintf(
        lines, sizeof lines,
        "0.3 select One word\n0.4 note Mine.\n0.5 layer Anna\n0.6 select another\n0.7 note "
        "Hers.\n0.8 tell %s\n0.9 layer \n1 hide Anna\n1.2 tell %s\n1.3 hide Anna\n1.4 "
        "tell %s\n1.5 action layers\n1.7 action layers\n1.8 action "
        "layers\n",
        played_path("both"), played_path("mine"), played_path("again"));
    played_run(lines, played_path("layers.md"));
    played_well();
    assert_string_equal(played_told("both", "remarks"), "2");
    assert_string_equal(played_told("mine", "remarks"), "1");
    assert_string_equal(played_told("again", "remarks"), "2");
    played.arguments[3] = "--remarks";
    played.arguments[4] = "-o";
    played.arguments[5] = played_path("layers.html");
    played.arguments[6] = NULL;
    played_window();
    char html[60000];
    FILE *file = fopen(played_path("layers.html"), "r");
    assert_non_null(file);
    html[fread(html, 1, sizeof html - 1, file)] = '\0';
    fclose(file);
    assert_non_null(strstr(html, "<b>Anna</b>: <q>another</q>"));
    assert_null(strstr(html, "</b>: <q>One word"));
}

/* Which layers are hidden and which is written is the reader's own, and there the next time;
 * the notes' file knows nothing of it. */
static void hidden_layers_are_kept(void **state)
{
    char lines[1500], notes[2][20000];
    size_t bytes[2];
    (void)state;
    played_write("hidden.md", "# Layers\n\nOne word, and another word.\n");
    snprintf(lines, sizeof lines,
             "0.2 select One word\n0.3 note Mine.\n0.4 layer Ben\n0.5 select another\n0.6 note "
             "His.\n0.7 layer Anna\n0.8 select and\n0.9 note Hers.\n");
    played_run(lines, played_path("hidden.md"));
    played_well();
    for (int i = 0; i < 2; i++) {
        FILE *file = fopen(played_path("hidden.md.notes"), "r");
        assert_non_null(file);
        bytes[i] = fread(notes[i], 1, sizeof notes[i], file);
        fclose(file);
        snprintf(lines, sizeof lines, "0.3 hide Ben\n0.4 hide \n0.5 tell %s\n",
                 played_path("one"));
        if (i == 0)
            played_run(lines, played_path("hidden.md"));
    }
    assert_true(bytes[0] == bytes[1] && memcmp(notes[0], notes[1], bytes[0]) == 0);
    assert_string_equal(played_told("one", "remarks"), "1");
    snprintf(lines, sizeof lines,
             "0.3 tell %s\n0.4 select word\n0.5 note Hers, too.\n0.6 hide Ben\n0.7 tell %s\n"
             "0.8 layer \n0.9 tell %s\n",
             played_path("again"), played_path("two"), played_path("all"));
    played_run(lines, played_path("hidden.md"));
    played_well();
    assert_string_equal(played_told("again", "remarks"), "1");
    assert_string_equal(played_told("two", "remarks"), "3");
    assert_string_equal(played_told("all", "remarks"), "4"); /* what is written is seen */
}

/* From a citation to its entry, and from there back. */
static void bibliographies_lead_back(void **state)
{
    char lines[1000], text[12000], *at = text;
    (void)state;
    at = stpcpy(at, "# Books\n\n");
    for (int i = 0; i < 80; i++)
        at += sprintf(at, "Paragraph %d%s.\n\n", i, i == 3 ? " cites [[#](#small)]" : "");
    stpcpy(at,
           "<a id=\"bibliography\"></a>\n\n- <a id=\"small\"></a>Small\n- Eel\n\nBehind.\n");
    played_write("books.md", text);
    snprintf(lines, sizeof lines,
             "0.2 follow 2]\n0.4 tell %s\n0.5 follow \xe2\x86\x91\n0.7 tell %s\n",
             played_path("entry"), played_path("cites"));
    played_run(lines, played_path("books.md"));
    played_well();
    assert_string_not_equal(played_told("entry", "top"), "0");
    assert_non_null(strstr(played_told("cites", "line"), "Paragraph 3 cites [2]"));
    unlink(played_path("books.md"));
}

static void finds_and_selects(void **state)
{
    char lines[2000];
    (void)state;
    snprintf(lines, sizeof lines,
             "0.2 search REED4\n0.4 tell %s\n0.5 action search-next\n0.6 tell %s\n"
             "0.7 action all\n0.8 tell %s\n0.9 key Escape\n1 key End\n1.2 tell %s\n1.3 key "
             "Home\n1.5 glide 300\n2.6 tell %s\n",
             played_path("found"), played_path("next"), played_path("all"), played_path("end"),
             played_path("glide"));
    played_run(lines, played_path("one.md"));
    played_well();
    assert_string_equal(played_told("found", "hits"), "11"); /* 4, 40 to 49 */
    assert_string_equal(played_told("found", "hit"), "0");
    assert_string_equal(played_told("next", "hit"), "1");
    assert_string_equal(played_told("all", "selected"), "# One");
    assert_true(atof(played_told("end", "above")) > 1000);
    const double above = atof(played_told("glide", "above"));
    assert_true(above > 290 && above < 310);
}

/* A link to a file of the document stays in it; one to another file, and back, opens the other
 * one and then all of the first. */
static void several_files_are_one(void **state)
{
    char lines[1000], hand[128];
    (void)state;
    FILE *file = fopen(played_path("deep/links.md"), "w");
    assert_non_null(file);
    fputs("# Links\n\nTo [the far one](../two.md#far), to [itself](#twice), to "
          "[others](../three.md).\n\n## Twice\n\nHere.\n\n",
          file);
    for (int i = 0; i < 30; i++)
        fprintf(file, "Paragraph %d.\n\n", i);
    fclose(file);
    played_write("three.md", "# Three\n\nAlone.\n\n## Twice\n\nElsewhere.\n");
    snprintf(lines, sizeof lines,
             "0.1 window 400 200\n0.2 follow far one\n0.4 tell %s\n0.5 follow itself\n0.7 tell "
             "%s\n0.8 follow others\n1 tell %s\n1.1 action back\n1.3 tell %s\n1.5 close\n",
             played_path("far"), played_path("itself"), played_path("others"),
             played_path("again"));
    played_write("several.events", lines);
    memset(&played, 0, sizeof played);
    snprintf(hand, sizeof hand, "%s", played_path("several.events"));
    const char *const arguments[] = {
        getenv("LUTETIA"), "read", played_path("two.md"), played_path("deep/links.md"),
        "--play",          hand};
    memcpy(played.arguments, arguments, sizeof arguments);
    played_window();
    assert_non_null(strstr(played_told("far", "file"), "/two.md"));
    assert_string_equal(played_told("far", "line"), "Far  What is far.  # Links  To the far o");
    assert_non_null(strstr(played_told("itself", "file"), "/links.md"));
    assert_non_null(strstr(played_told("itself", "line"), "Twice  Here."));
    assert_non_null(strstr(played_told("others", "file"), "/three.md"));
    assert_non_null(strstr(played_told("again", "file"), "/links.md"));
    assert_string_equal(played_told("again", "top"), played_told("itself", "top"));
}

/* A file that includes others and is beside none of them: links lead through all. */
static void included_files_are_read(void **state)
{
    char lines[1000];
    (void)state;
    FILE *file = fopen(played_path("deep/part.md"), "w");
    assert_non_null(file);
    fputs("## Part\n\nTo [the end](../main.md#end), and see [#](#end).\n\n", file);
    for (int i = 0; i < 30; i++)
        fprintf(file, "Part %d.\n\n", i);
    fclose(file);
    file = fopen(played_path("main.md"), "w");
    assert_non_null(file);
    fputs("# Main\n\n[Part](deep/part.md \"include\")\n\n## End\n\n", file);
    for (int i = 0; i < 30; i++)
        fprintf(file, "Over %d.\n\n", i);
    fclose(file);
    snprintf(lines, sizeof lines,
             "0.1 window 400 200\n0.2 go To the end\n0.4 tell %s\n0.5 follow the end\n"
             "0.7 tell %s\n0.8 action back\n0.9 follow End.\n1.1 tell %s\n",
             played_path("part"), played_path("end"), played_path("referred"));
    played_run(lines, played_path("main.md"));
    played_well();
    assert_non_null(strstr(played_told("part", "file"), "/deep/part.md"));
    assert_non_null(strstr(played_told("part", "line"), "To the end, and see End."));
    assert_non_null(strstr(played_told("end", "file"), "/main.md"));
    assert_string_equal(played_told("end", "line"), "End  Over 0.  Over 1.  Over 2.  Over 3. ");
    assert_string_equal(played_told("referred", "top"), played_told("end", "top"));
    /* what is not there is said, and the rest is read */
    played_write("lacks.md", "# Lacks\n\n[Part](none.md \"include\")\n");
    played_run("", played_path("lacks.md"));
    played_says(0, "lacks.md:3: none.md is not included: No such file");
}

/* Without a file it is the manual: all of it, with notes that are kept among the reader's own
 * data. */
static void manual_is_opened(void **state)
{
    char lines[1000];
    (void)state;
    snprintf(lines, sizeof lines,
             "0.2 tell %s\n0.3 select Connection Machine\n0.4 key h\n0.5 action contents\n0.7 "
             "picture %s\n0.8 search hyphenate\n1 key End\n1.3 tell %s\n1.5 close\n",
             played_path("begin"), played_path("manual.png"), played_path("end"));
    played_write("manual.events", lines);
    memset(&played, 0, sizeof played);
    const char *const arguments[] = {getenv("LUTETIA"), "read", "--play",
                                     played_path("manual.events")};
    memcpy(played.arguments, arguments, sizeof arguments);
    played_window();
    assert_non_null(strstr(played_told("begin", "file"), "/README.md"));
    assert_non_null(strstr(played_told("end", "file"), "/docs/paris-reference.md"));
    assert_true(atof(played_told("end", "above")) > 100000);
    assert_true(atoi(played_told("end", "hits")) > 3);
    assert_string_equal(played_told("end", "remarks"), "1");
    assert_int_equal(access(played_path("lutetia/manual.notes"), F_OK), 0);
}

/* What stays is moved: scrolled by some lines, hardly anything is painted anew. */
static void only_new_lines_are_painted(void **state)
{
    char lines[4000] = "0.2 go Reed10\n0.6 tell ";
    (void)state;
    strcat(lines, played_path("still"));
    strcat(lines, "\n");
    for (int i = 0; i < 20; i++)
        strcat(lines, "0.7 scroll 1\n");
    strcat(lines, "1 tell ");
    strcat(lines, played_path("moved"));
    played_run(lines, played_path("one.md"));
    played_well();
    assert_true(atol(played_told("moved", "painted")) - atol(played_told("still", "painted")) <=
                2);
    assert_string_not_equal(played_told("moved", "above"), played_told("still", "above"));
}

/* An Xvfb has OpenGL by the processors or none: cairo draws the window there, unless somebody
 * says what else does. */
static void cairo_draws_where_processors_would(void **state)
{
    char lines[200];
    (void)state;
    snprintf(lines, sizeof lines, "0.3 tell %s", played_path("told"));
    played_run(lines, played_path("one.md"));
    played_well();
    assert_string_equal(played_told("told", "renderer"), "GskCairoRenderer");
    played.variables[1] = "GSK_RENDERER=gl";
    child_run(&played);
    assert_string_not_equal(played_told("told", "renderer"), "GskCairoRenderer");
}

/* The picture is the text: both themes, nothing empty. */
static void picture_is_seen(void **state)
{
    char lines[1000];
    struct display_image light, dark;
    (void)state;
    snprintf(lines, sizeof lines, "0.3 picture %s\n0.4 dark 1\n0.7 picture %s\n",
             played_path("light.png"), played_path("dark.png"));
    played_run(lines, played_path("one.md"));
    played_well();
    assert_int_equal(display_png_read_rgb(played_path("light.png"), &light), DISPLAY_OK);
    assert_int_equal(display_png_read_rgb(played_path("dark.png"), &dark), DISPLAY_OK);
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

/* ---- notes ---- */

static void notes_remove(void)
{
    unlink(played_path("one.md.notes"));
    unlink(played_path("one.md.notes-wal"));
    unlink(played_path("one.md.notes-shm"));
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
             played_path("drawn"), played_path("undone"), played_path("redone"));
    played_run(lines, played_path("one.md"));
    played_well();
    assert_string_equal(played_told("drawn", "remarks"), "3");
    assert_string_equal(played_told("drawn", "ink"), "300.0 150.0");
    assert_string_equal(played_told("undone", "remarks"), "2");
    assert_string_equal(played_told("redone", "remarks"), "3");
    snprintf(
        lines, sizeof lines,
        "0.2 tell %s\n0.3 size 24\n0.5 tell %s\n0.6 size 17\n0.8 tell %s\n0.9 action eraser\n"
        "1 press 320 160 1\n1.05 lift 320 160\n1.2 tell %s\n1.25 action undo\n1.3 action "
        "move-ink\n"
        "1.4 press 300 150 1\n1.5 drag 330 190 1\n1.55 lift 330 190\n1.7 tell %s\n1.8 action "
        "play-back\n",
        played_path("again"), played_path("large"), played_path("small"), played_path("erased"),
        played_path("moved"));
    played_run(lines, played_path("one.md"));
    played_well();
    assert_string_equal(played_told("again", "remarks"), "3");
    assert_string_equal(played_told("again", "ink"), "300.0 150.0");
    assert_string_not_equal(played_told("large", "ink"), "300.0 150.0");
    assert_string_equal(played_told("small", "ink"), "300.0 150.0");
    assert_string_equal(played_told("erased", "remarks"), "2");
    assert_string_equal(played_told("moved", "ink"), "330.0 190.0");
}

/* Another program changes the file while it is read: the notes go with their words, or are
 * orphans. */
static void changed_elsewhere(void **state)
{
    char lines[2000], command[400];
    (void)state;
    notes_remove();
    unlink(played_path("before")); /* another test's */
    snprintf(command, sizeof command, "cp %s %s", played_path("one.md"),
             played_path("kept.md"));
    assert_int_equal(system(command), 0);
    snprintf(lines, sizeof lines,
             "0.2 select Reed3.\n0.3 action highlight\n0.4 select Paragraph 0 has\n0.4 note "
             "Gone soon\n0.5 go Reed20\n0.6 tell %s\n"
             "3 tell %s\n",
             played_path("before"), played_path("after"));
    snprintf(command, sizeof command,
             "(while [ ! -s %s ]; do sleep 0.05; done; sed -i -e '1i More before it.\\n' -e "
             "'s/Paragraph 0 has/There are/' %s) &",
             played_path("before"), played_path("one.md"));
    assert_int_equal(system(command), 0);
    played_run(lines, played_path("one.md"));
    played_well();
    assert_string_equal(played_told("before", "orphans"), "0");
    assert_string_equal(played_told("after", "remarks"), "2");
    assert_string_equal(played_told("after", "orphans"), "1");
    assert_string_equal(played_told("after", "line"), played_told("before", "line"));
    assert_string_not_equal(played_told("after", "top"), played_told("before", "top"));
    snprintf(command, sizeof command, "mv %s %s", played_path("kept.md"),
             played_path("one.md"));
    assert_int_equal(system(command), 0);
}

/* A notes file that is none is said, and left; the document is read all the same. */
static void foreign_notes_are_said(void **state)
{
    char lines[1000];
    (void)state;
    notes_remove();
    played_write("one.md.notes",
                 "a letter that somebody put here, long enough to be looked at");
    snprintf(lines, sizeof lines, "0.2 select A word\n0.3 tell %s\n", played_path("foreign"));
    played_run(lines, played_path("one.md"));
    assert_int_equal(played.status, 0);
    assert_non_null(strstr(played.errors, "one.md.notes: "));
    assert_non_null(strstr(played.errors, "it is left as it is"));
    assert_string_equal(played_told("foreign", "remarks"), "0");
    char first[20] = "";
    FILE *file = fopen(played_path("one.md.notes"), "r");
    assert_non_null(file);
    assert_non_null(fgets(first, sizeof first, file));
    assert_memory_equal(first, "a letter that", 13);
    fclose(file);
    notes_remove();
}

/* All pages, small: the one that is read is chosen, hits are seen in them, keys riffle through
 * them, and Return goes to a page. */
static void pages_are_seen_small(void **state)
{
    char lines[1500];
    int pages = 0, at = 0, marks = 0;
    (void)state;
    notes_remove();
    snprintf(
        lines, sizeof lines,
        "0.3 go Paragraph 50 has\n0.4 action miniatures\n0.6 tell %s\n0.7 search Paragraph "
        "5\n0.9 picture %s\n0.9 tell %s\n1 key Home\n1.1 key Right\n1.1 key plus\n1.2 tell "
        "%s\n1.3 key Return\n1.4 tell %s\n1.5 action miniatures\n1.6 key Escape\n1.7 tell "
        "%s\n",
        played_path("small"), played_path("small.png"), played_path("found"),
        played_path("second"), played_path("gone"), played_path("closed"));
    played_run(lines, played_path("one.md"));
    played_well();
    assert_int_equal(
        sscanf(played_told("small", "miniatures"), "%d at %d marks %d", &pages, &at, &marks),
        3);
    assert_true(pages > 3 && at > 1 && at <= pages && marks == 0);
    assert_int_equal(
        sscanf(played_told("found", "miniatures"), "%d at %d marks %d", &pages, &at, &marks),
        3);
    assert_true(marks >= atoi(played_told("found", "hits")) && marks > 5);
    assert_int_equal(sscanf(played_told("second", "miniatures"), "%d at %d", &pages, &at), 2);
    assert_int_equal(at, 2);
    assert_string_equal(played_told("gone", "miniatures"), "closed");
    assert_true(atoi(played_told("gone", "top")) > 0 &&
                atoi(played_told("gone", "top")) < atoi(played_told("small", "top")));
    assert_string_equal(played_told("closed", "miniatures"), "closed");
}

/* ---- what is wrong ---- */

static void wrong_is_one_line(void **state)
{
    (void)state;
    played_run("0 jump", played_path("one.md"));
    played_says(1, "hand.events:1: no such word: 'jump'");
    played_run("0 key Lefft", played_path("one.md"));
    played_says(1, "hand.events:1: no key is called 'Lefft'; there are a letter, Left, ");
    played_run("0 strike Control+Shift+Lefft", played_path("one.md"));
    played_says(1, "hand.events:1: no key is called 'Lefft'; there are ");
    played_run("0 strike Ctrl+Left", played_path("one.md"));
    played_says(1, "'Ctrl' is not held with a key; Shift and Control are");
    played_run("0.2 key F35", played_path("one.md"));
    played_says(0, "nothing is done by the key F35");
    played_run("0 down 1", played_path("one.md"));
    played_says(1, "hand.events:1: 'down' has 3 numbers");
    played_run("0.2 follow bad", played_path("one.md"));
    played_says(0, "file:///etc/passwd is not followed");
    played_run("", "/no/such.md");
    played_says(1, "/no/such.md: ");
    played_run("", "-");
    played_says(2, "give -o FILE");
    const char *const arguments[] = {getenv("LUTETIA"), "read", played_path("one.md"),
                                     "--columns", "2"};
    memset(&played, 0, sizeof played);
    memcpy(played.arguments, arguments, sizeof arguments);
    child_run(&played);
    played_says(2, "--columns");
    played.arguments[3] = NULL;
    played.variables[0] = "DISPLAY=:4711";
    played.variables[1] = "WAYLAND_DISPLAY=";
    child_run(&played);
    played_says(1, "no display");
}

static int begin(void **state)
{
    const int status = played_begin(state);
    if (status == 0)
        documents_write();
    return status;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(line_is_kept),
        cmocka_unit_test(notes_links_and_back),
        cmocka_unit_test(readers_have_layers),
        cmocka_unit_test(hidden_layers_are_kept),
        cmocka_unit_test(bibliographies_lead_back),
        cmocka_unit_test(finds_and_selects),
        cmocka_unit_test(several_files_are_one),
        cmocka_unit_test(included_files_are_read),
        cmocka_unit_test(manual_is_opened),
        cmocka_unit_test(only_new_lines_are_painted),
        cmocka_unit_test(notes_are_kept),
        cmocka_unit_test(changed_elsewhere),
        cmocka_unit_test(pages_are_seen_small),
        cmocka_unit_test(foreign_notes_are_said),
        cmocka_unit_test(cairo_draws_where_processors_would),
        cmocka_unit_test(picture_is_seen),
        cmocka_unit_test(wrong_is_one_line),
    };
    if (!screen_start("1280x900x24"))
        return 77;
    return cmocka_run_group_tests(tests, begin, played_end);
}
