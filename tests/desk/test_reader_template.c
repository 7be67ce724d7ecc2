/* test_reader_template.c - the reader's templates in its window: chosen, their lines dragged,
 * their colours and sizes set, undone, and kept in files. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "reader_played.h"
#include "xvfb.h"

/* Two columns and their notes; lines that are dragged, and taken by keys; the file that they
 * are kept in. A narrow window has one column, where a note of the margin opens in place. */
static void templates_are_chosen_and_dragged(void **state)
{
    char lines[2000];
    (void)state;
    played_write("wide.md", "# Wide\n\nOne word[^margin:a] of the first.\n\nTwo words of the "
                            "second.\n\nThree of the third.\n\n[^margin:a]: Beside it.\n");
    played_write("bad.template", "columns 30\ntext 2\n");
    snprintf(lines, sizeof lines,
             "0.1 window 1500 700\n0.3 template two-columns\n0.5 tell %s\n",
             played_path("two"));
    played_run(lines, played_path("wide.md"));
    const double edge = atof(played_told("two", "edge"));
    snprintf(
        lines, sizeof lines,
        "0.1 window 1500 700\n0.3 template two-columns\n0.6 action grid\n0.7 down %g 300 1\n"
        "0.8 move %g 300\n0.9 up %g 300\n1 tell %s\n1.02 action undo\n1.04 tell %s\n1.06 "
        "action redo\n1.08 tell %s\n1.1 key Tab\n1.2 key Right\n1.3 key "
        "Escape\n1.4 save-template %s\n1.5 template book\n1.6 tell %s\n1.7 template "
        "%s\n1.8 tell %s\n1.9 window 600 700\n2.1 key Tab\n2.2 key Return\n2.4 tell %s\n",
        edge, edge - 20, edge - 20, played_path("dragged"), played_path("undone"),
        played_path("redone"), played_path("own.template"), played_path("book"),
        played_path("own.template"), played_path("own"), played_path("narrow"));
    played_run(lines, played_path("wide.md"));
    played_well();
    assert_string_equal(played_told("two", "grid"), "2 4");
    assert_string_equal(played_told("book", "grid"), "1 3");
    assert_string_equal(played_told("own", "grid"), "2 4");
    assert_string_equal(played_told("narrow", "grid"), "1 1");
    assert_string_equal(played_told("narrow", "open"), "1");
    assert_true(atof(played_told("dragged", "edge")) < edge - 10);
    assert_string_equal(played_told("redone", "edge"), played_told("dragged", "edge"));
    assert_true(atof(played_told("undone", "edge")) == edge);
    played_run("0.3 action grid\n", played_path("wide.md"));
    played_well();
    snprintf(lines, sizeof lines, "0.3 template %s\n", played_path("bad.template"));
    played_run(lines, played_path("wide.md"));
    played_says(0, "bad.template:2: a place is columns of the grid's 1..1");
}

/* The file that a template was saved in has that line, or has not. */
static void template_has(const char *name, const char *line, bool has)
{
    char text[2000] = "";
    FILE *file = fopen(played_path(name), "r");
    assert_non_null(file);
    assert_true(fread(text, 1, sizeof text - 1, file) > 0);
    fclose(file);
    if ((strstr(text, line) != NULL) != has)
        fail_msg("%s: '%s' is %s in:\n%s", name, line, has ? "not" : "still", text);
}

/* Colours and sizes are set in the panel, undone and done again, and kept in a template; what
 * is set quickly in a row is one undo. */
static void colours_and_sizes_are_set(void **state)
{
    char lines[2000];
    (void)state;
    played_write("coloured.md", "# Coloured\n\nOne word[^a].\n\n[^a]: A note.\n");
    snprintf(lines, sizeof lines,
             "0.1 window 1100 700\n0.3 action panel\n0.5 panel ink #b09060\n0.6 panel "
             "heading-1 2.6\n0.7 panel heading-1 2.7\n0.8 panel note 0.7\n0.9 save-template "
             "%s\n1 action undo\n1.1 save-template %s\n1.2 action undo\n1.3 save-template "
             "%s\n1.4 action redo\n1.5 save-template %s\n1.6 action dark\n1.7 panel paper "
             "#102030\n1.8 save-template %s\n1.9 action panel\n2 panel nonsense 3\n",
             played_path("set.template"), played_path("one.template"),
             played_path("two.template"), played_path("redone.template"),
             played_path("dark.template"));
    played_run(lines, played_path("coloured.md"));
    played_says(0, "there is no such colour or size");
    template_has("set.template", "colour ink #b09060 #dbd9d1", true);
    template_has("set.template", "size heading-1 2.7", true);
    template_has("set.template", "size note 0.7", true);
    template_has("one.template", "size note", false);
    template_has("one.template", "size heading-1 2.7", true);
    template_has("two.template", "size heading-1", false);
    template_has("two.template", "colour ink #b09060", true);
    template_has("redone.template", "size heading-1 2.7", true);
    template_has("dark.template", "colour paper #fefcf8 #102030", true);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(templates_are_chosen_and_dragged),
        cmocka_unit_test(colours_and_sizes_are_set),
    };
    if (!screen_start("1280x900x24"))
        return 77;
    return cmocka_run_group_tests(tests, played_begin, played_end);
}
