/* test_template.c - templates: what is read, written and refused; where a grid's columns are in
 * windows of any width; columns that are dragged. */
#include <reader_document.h>
#include <reader_template.h>

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
/* clang-format on */

#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../sample.h"
#include "../skip.h"

static struct reader_template parsed(const char *text)
{
    struct reader_template t;
    if (reader_template_parse(text, strlen(text), "own", &t) != READER_OK)
        fail_msg("%s", reader_error());
    return t;
}

static void same(const struct reader_template *a, const struct reader_template *b)
{
    char *one = reader_template_text(a), *two = reader_template_text(b);
    assert_string_equal(one, two);
    free(one);
    free(two);
}

static void what_is_written_is_read(void **state)
{
    (void)state;
    for (int i = 0; reader_template_names[i]; i++) {
        struct reader_template t, again;
        assert_int_equal(reader_template_named(reader_template_names[i], &t), READER_OK);
        assert_string_equal(t.name, reader_template_names[i]);
        assert_int_equal(reader_template_open(reader_template_names[i], &again), READER_OK);
        same(&t, &again);
    }
    static const char text[] =
        "# a comment\n\n  name  marsh\ncolumns 2* 20..34.25 9.5\ngutter 1.25\ntext 2\nnotes 3\n"
        "figures 1-2\nbeside  round right 40%\nsize note 0.8\ncolour ink #010203 #fefdfc";
    struct reader_template t = parsed(text), again;
    char *written = reader_template_text(&t);
    assert_string_equal(written,
                        "name marsh\ncolumns 2* 20..34.25 9.5\ngutter 1.25\ntext 2\nnotes 3\n"
                        "headings 2\nfigures 1-2\ndemonstrations 2\ntables 2\n"
                        "beside right 40% round\nsize note 0.8\n"
                        "colour ink #010203 #fefdfc\n");
    assert_int_equal(reader_template_parse(written, strlen(written), "own", &again), READER_OK);
    assert_memory_equal(&t, &again, sizeof t);
    free(written);
}

/* The same digits, where numbers are written with a comma. */
static void numbers_are_of_no_locale(void **state)
{
    (void)state;
    if (!setlocale(LC_NUMERIC, "de_DE.UTF-8"))
        skip_because("the locale de_DE.UTF-8 is not installed");
    struct reader_template t = parsed("columns 30.5\ntext 1");
    char *written = reader_template_text(&t);
    setlocale(LC_NUMERIC, "C");
    assert_non_null(strstr(written, "columns 30.5\n"));
    assert_true(t.columns[0].least_em == 30.5);
    free(written);
}

static void what_is_wrong_is_said(void **state)
{
    static const struct {
        const char *text, *says;
    } cases[] = {
        {"", "own:0: a template says its 'columns', and which of them are 'text'"},
        {"columns 30", "which of them are 'text'"},
        {"text 1\ncolumns 30", "own:1: 'columns' comes before 'text'"},
        {"colums 30", "own:1: there is no 'colums' (known: name, columns, gutter, text, notes, "
                      "headings, figures, demonstrations, tables, beside, size, colour)"},
        {"columns 0\ntext 1", "1..200 ems wide"},
        {"columns nan\ntext 1", "(got 'nan')"},
        {"columns inf*\ntext 1", "(got 'inf*')"},
        {"columns 1e3\ntext 1", "(got '1e3')"},
        {"columns -3\ntext 1", "(got '-3')"},
        {"columns 30..20\ntext 1", "(got '30..20')"},
        {"columns 0*\ntext 1", "(got '0*')"},
        {"columns 20 20\ncolumns 20", "own:2: 'columns' stands once"},
        {"columns 20\ntext 2", "own:2: a place is columns of the grid's 1..1"},
        {"columns 20 20\ntext 2 1", "from the left to the right"},
        {"columns 20 20\ntext 1-2 2", "none on another"},
        {"columns 20 20\ntext 1\nnotes 1", "notes stand beside text"},
        {"columns 9 9 9\ntext 1 2\nnotes 3", "a place for each column of text: 2 (got 1)"},
        {"columns 9 9 9 9\ntext 1 2\nnotes 3 3", "beside each other"},
        {"columns 20\ntext 1\ngutter 0", "a gutter is 0.2..20 ems (got '0')"},
        {"columns 20\ntext 1\nsize note 9", "0.4..4"},
        {"columns 20\ntext 1\nsize nose 1", "of heading-1, heading-2"},
        {"columns 20\ntext 1\ncolour ink red #000000", "#rrggbb"},
        {"columns 20\ntext 1\ncolour inc #000000 #000000", "of paper, ink"},
        {"columns 20\ntext 1\nbeside", "as 'beside right 40%'"},
        {"columns 20\ntext 1\nbeside up", "left or right"},
        {"columns 20\ntext 1\nbeside left 95%", "10%..90%"},
        {"columns 20\ntext 1\nname a b", "a name is one word"},
        {"columns 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1\ntext 1",
         "own:1: a grid has 1..16 columns"},
    };
    (void)state;
    struct reader_template t;
    memset(&t, 7, sizeof t);
    const struct reader_template before = t;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const int status =
            (int)reader_template_parse(cases[i].text, strlen(cases[i].text), "own", &t);
        assert_int_equal(status, READER_BAD_ARGUMENT);
        if (!strstr(reader_error(), cases[i].says) || strchr(reader_error(), '\n'))
            fail_msg("'%s' says: %s", cases[i].text, reader_error());
    }
    assert_memory_equal(&t, &before, sizeof t);
    assert_int_equal(reader_template_named("bok", &t), READER_BAD_ARGUMENT);
    assert_string_equal(reader_error(),
                        "templates are screen, book and two-columns (got 'bok')");
    assert_int_equal(reader_template_open("/nonexistent/a", &t), READER_FAILED);
    assert_non_null(strstr(reader_error(), "built in are screen, book and two-columns"));
    /* ten thousand columns */
    char *many = malloc(30000);
    strcpy(many, "columns");
    for (int i = 0; i < 10000; i++)
        strcpy(many + 7 + 2 * i, " 9");
    assert_int_equal(reader_template_parse(many, strlen(many), "own", &t), READER_BAD_ARGUMENT);
    assert_non_null(strstr(reader_error(), "a grid has 1..16 columns"));
    free(many);
    assert_int_equal(reader_template_parse("", READER_TEMPLATE_BYTES_MAX + 1, "own", &t),
                     READER_TOO_LARGE);
}

static bool apart(double x, double width, double other, double other_width)
{
    return x >= other + other_width - 1e-6 || x + width <= other + 1e-6;
}

/* All within the window, text and notes apart. */
static void grid_is_sound(const struct reader_grid *g, double width_px)
{
    assert_true(g->texts >= 1 && g->texts <= READER_TEXTS_MAX);
    for (int i = 0; i < g->texts + READER_WIDES; i++) {
        const struct reader_region *r = i < g->texts ? &g->text[i] : &g->wide[i - g->texts];
        assert_true(r->x >= 0 && r->width > 0 && r->x + r->width <= width_px + 1e-6);
        assert_true(r->notes_width == 0 || (r->notes_x >= 0 && r->notes_width > 0 &&
                                            r->notes_x + r->notes_width <= width_px + 1e-6 &&
                                            apart(r->x, r->width, r->notes_x, r->notes_width)));
        for (int k = 0; k < i && i < g->texts; k++)
            assert_true(apart(r->x, r->width, g->text[k].x, g->text[k].width));
    }
    for (int i = 1; i < g->columns_count; i++)
        assert_true(g->columns[i].x >= g->columns[i - 1].x + g->columns[i - 1].width);
}

static void grids_are_in_their_windows(void **state)
{
    uint64_t random = 5;
    (void)state;
    for (int turn = 0; turn < 20000; turn++) {
        struct reader_template t;
        struct reader_grid g;
        assert_int_equal(
            reader_template_named(reader_template_names[sample_word(&random) % 3], &t),
            READER_OK);
        const double em = 4 + (double)(sample_word(&random) % 80),
                     width = (double)(sample_word(&random) % 5000);
        for (int k = 0; k < 6; k++)
            reader_template_drag(&t, (int)(sample_word(&random) % 5) - 1,
                                 (int)(sample_word(&random) % 5) - 1,
                                 (double)(sample_word(&random) % 40) - 20);
        reader_template_grid(&t, width, em, sample_word(&random) % 2, &g);
        grid_is_sound(&g, fmax(width, 4 * em));
        char *text = reader_template_text(&t); /* what was dragged is read again */
        struct reader_template again;
        if (reader_template_parse(text, strlen(text), "own", &again) != READER_OK)
            fail_msg("%s\n%s", reader_error(), text);
        free(text);
    }
}

/* What the reader's one column was before there were templates. */
static void the_screen_is_as_it_was(void **state)
{
    struct reader_template t;
    (void)state;
    assert_int_equal(reader_template_named("screen", &t), READER_OK);
    for (int width = 100; width < 3000; width += 7)
        for (double em = 8; em < 40; em += 3.7) {
            struct reader_grid g;
            const bool wide = width >= 49 * em;
            const double notes = wide ? 13 * em : 0, all = fmax(width, 4 * em),
                         column = fmin(34 * em, all - 2.4 * em - notes),
                         margin = floor((all - notes - fmax(column, 2 * em)) / 2);
            if (wide && width < 49.5 * em) /* the column was a little narrower then */
                continue;
            reader_template_grid(&t, width, em, true, &g);
            if (fabs(g.text[0].x - margin) >= 1e-9)
                fail_msg("%d %g: %g %g", width, em, g.text[0].x, margin);
            assert_true(fabs(g.text[0].width - (all - 2 * margin - notes)) < 1e-6);
            assert_true((g.text[0].notes_width > 0) == wide);
            if (wide)
                assert_true(fabs(g.text[0].notes_x - (all - margin - notes + 0.8 * em)) < 1e-6);
        }
}

static void narrow_windows_have_one_column(void **state)
{
    struct reader_template t;
    struct reader_grid g;
    (void)state;
    assert_int_equal(reader_template_named("two-columns", &t), READER_OK);
    reader_template_grid(&t, 1600, 17, true, &g);
    assert_int_equal(g.texts, 2);
    assert_true(g.text[0].notes_width > 0 && g.text[1].notes_width > 0);
    assert_true(g.text[0].notes_x < g.text[0].x && g.text[1].notes_x > g.text[1].x);
    reader_template_grid(&t, 800, 17, true, &g); /* notes give way first */
    assert_int_equal(g.texts, 2);
    assert_true(g.text[0].notes_width == 0);
    reader_template_grid(&t, 500, 17, true, &g);
    assert_int_equal(g.texts, 1);
    reader_template_grid(&t, 20, 17, true, &g);
    assert_int_equal(g.texts, 1);
    grid_is_sound(&g, 4 * 17);
}

static void columns_are_dragged(void **state)
{
    (void)state;
    struct reader_template t = parsed("columns 20 20 1*\ntext 1");
    reader_template_drag(&t, 0, 1, 5); /* one takes what the other one gives */
    assert_true(t.columns[0].least_em == 25 && t.columns[1].least_em == 15);
    reader_template_drag(&t, 0, 1, 500);
    assert_true(t.columns[0].least_em == 39 && t.columns[1].least_em == 1);
    reader_template_drag(&t, 0, -1, -500);
    assert_true(t.columns[0].least_em == 1);
    const struct reader_template before = t;
    reader_template_drag(&t, 2, -1, 4); /* a share stays one */
    reader_template_drag(&t, 7, -1, 4);
    reader_template_drag(&t, -1, 0, 4);
    reader_template_drag(&t, 0, 1, NAN);
    reader_template_drag(&t, 0, 1, INFINITY);
    assert_memory_equal(&t, &before, sizeof t);
    assert_true(reader_template_text_em(&t) == 1);
    reader_template_text_set(&t, 40);
    assert_true(reader_template_text_em(&t) == 40);
}

/* In a window where columns are narrower than they may be, too, a line goes where it is
 * dragged. */
static void lines_go_where_they_are_dragged(void **state)
{
    const double em = 17;
    (void)state;
    for (int width = 1150; width < 1700; width += 50) {
        struct reader_template t;
        struct reader_grid g, now;
        assert_int_equal(reader_template_named("two-columns", &t), READER_OK);
        reader_template_grid(&t, width, em, true, &g);
        reader_template_settle(&t, &g, em);
        reader_template_drag(&t, 3, -1, -2);
        reader_template_grid(&t, width, em, true, &now);
        assert_true(fabs(g.columns[3].x + g.columns[3].width - em - now.columns[3].x -
                         now.columns[3].width) < 2);
        reader_template_drag(&t, 1, 2, 1);
        reader_template_grid(&t, width, em, true, &g);
        assert_true(fabs(g.columns[2].x - now.columns[2].x - em) < 2);
    }
}

/* WCAG's AA for small letters, in both themes; black on white is 21, and equal colours 1. */
static void usual_colours_are_read_well(void **state)
{
    (void)state;
    struct reader_colours own = *reader_colours_of(false);
    for (int dark = 0; dark < 2; dark++)
        for (int i = 0; i < READER_COLOURS; i++) {
            const double ratio = reader_colour_contrast(reader_colours_of(dark), i);
            if (!(ratio >= READER_CONTRAST_LEAST))
                fail_msg("%s, %s: %.2f : 1", dark ? "dark" : "light", reader_colour_names[i],
                         ratio);
        }
    for (int c = 0; c < 3; c++) {
        own.paper[c] = 1;
        own.ink[c] = 0;
        own.link[c] = 1;
    }
    assert_true(fabs(reader_colour_contrast(&own, 0) - 21) < 1e-9);
    assert_true(fabs(reader_colour_contrast(&own, 1) - 21) < 1e-9);
    assert_true(fabs(reader_colour_contrast(&own, 2) - 1) < 1e-9);
    double rgb[3] = {0, 0, 0};
    char text[8];
    assert_false(reader_colour_read("#12345", rgb));
    assert_false(reader_colour_read("#12345g", rgb));
    assert_true(reader_colour_read("#12aBf0", rgb));
    reader_colour_text(rgb, text);
    assert_string_equal(text, "#12abf0");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_written_is_read),
        cmocka_unit_test(usual_colours_are_read_well),
        cmocka_unit_test(numbers_are_of_no_locale),
        cmocka_unit_test(what_is_wrong_is_said),
        cmocka_unit_test(grids_are_in_their_windows),
        cmocka_unit_test(the_screen_is_as_it_was),
        cmocka_unit_test(narrow_windows_have_one_column),
        cmocka_unit_test(columns_are_dragged),
        cmocka_unit_test(lines_go_where_they_are_dragged),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
