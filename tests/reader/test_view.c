/* test_view.c - a document as a column that is scrolled: passages stand below each other as
 * they do on a page that is high enough, whatever was looked at before; the line that is being
 * read stays, however often the width, the size and the font change. */
#include <reader_document.h>
#include <reader_view.h>

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
#include "without_library.h"

static struct reader_document *document;

/* A long document of all kinds of blocks; each paragraph begins with its own number. */
static char *long_text(int paragraphs)
{
    static const char *const words[] = {
        "water",  "marsh",   "reed",  "heron", "*slow*", "river", "**deep**", "mud",
        "`code`", "evening", "light", "over",  "the",    "a",     "and",      "of"};
    uint64_t state = 7;
    char *text = NULL;
    size_t bytes = 0;
    FILE *out = open_memstream(&text, &bytes);
    for (int i = 0; i < paragraphs; i++) {
        if (i % 17 == 0)
            fprintf(out, "%s Chapter %d\n\n", i % 51 ? "##" : "#", i);
        if (i % 23 == 5)
            fprintf(out, "| a%d | b |\n|---|--:|\n| one | 2 |\n| three | 44 |\n\n", i);
        if (i % 29 == 3)
            fprintf(out, "```\nint x%d = 0;\n\n\twhile (x)\n```\n\n", i);
        if (i % 13 == 2)
            fprintf(out, "- item %d\n- and $x^2_%d$ more[^n%d]\n\n", i, i, i);
        fprintf(out, "N%d", i);
        for (int k = 0, n = 5 + (int)(sample_word(&state) % 120); k < n; k++)
            fprintf(out, " %s", words[sample_word(&state) % 16]);
        fprintf(out, ".\n\n");
        if (i % 13 == 2)
            fprintf(out, "[^n%d]: A note of number %d, *short*.\n\n", i, i);
    }
    fclose(out);
    return text;
}

static struct reader_document *read_text(const char *text)
{
    struct reader_document *d;
    assert_int_equal(reader_document_create(&d), READER_OK);
    if (reader_document_add(d, text, strlen(text)) != READER_OK ||
        reader_document_plain(d) != READER_OK)
        fail_msg("%s", reader_error());
    return d;
}

static struct reader_pages_setup usual_setup(void)
{
    struct reader_pages_setup setup = reader_pages_setup_default();
    setup.font = "DejaVuSerif";
    setup.width_px = 700;
    setup.height_px = 600;
    setup.margin_px = 40;
    setup.size_px = 15;
    return setup;
}

static struct reader_view *view_of(struct reader_document *d,
                                   const struct reader_pages_setup *setup)
{
    struct reader_view *view;
    if (reader_view_create(d, setup, &view) != READER_OK)
        fail_msg("%s", reader_error());
    return view;
}

static const struct reader_shown *look(struct reader_view *view, int *count)
{
    const struct reader_shown *shown;
    if (reader_view_look(view, &shown, count) != READER_OK)
        fail_msg("%s", reader_error());
    return shown;
}

static size_t byte_of(const char *text)
{
    size_t begin, end;
    if (!reader_document_search(document, text, 0, true, &begin, &end))
        fail_msg("'%s' is not in the document", text);
    return begin;
}

/* The box of a letter; it is seen. */
static struct reader_box box_of(struct reader_view *view, size_t byte)
{
    struct reader_box box = {0};
    assert_true(reader_view_boxes(view, byte, byte + 1, &box, 1) >= 1);
    return box;
}

/* ---- what stands where ---- */

/* Passages follow each other without gaps, and the window is full. */
static void passages_follow(void **state)
{
    (void)state;
    const struct reader_pages_setup setup = usual_setup();
    struct reader_view *view = view_of(document, &setup);
    for (int turn = 0; turn < 60; turn++) {
        int count;
        const struct reader_shown *shown = look(view, &count);
        assert_true(count > 0);
        assert_true(shown[0].y_px <= 0);
        for (int i = 1; i < count; i++) {
            assert_int_equal(shown[i].passage, shown[i - 1].passage + 1);
            assert_true(fabs(shown[i].y_px - (shown[i - 1].y_px + shown[i - 1].height_px)) <=
                        1e-9);
            assert_true(shown[i].begin >= shown[i - 1].end);
        }
        assert_true(shown[count - 1].y_px + shown[count - 1].height_px >= setup.height_px);
        reader_view_scroll(view, turn < 40 ? 517 : -213);
    }
    reader_view_destroy(view);
}

/* Each line's upper edge, from where the passage begins, by the letter that it begins with. */
static void same_lines(struct reader_view *a, struct reader_view *b, int passage, int of)
{
    struct font_layout one, other;
    assert_int_equal(reader_view_layout(a, passage, &one), READER_OK);
    assert_int_equal(reader_view_layout(b, of, &other), READER_OK);
    assert_int_equal(one.glyphs_count, other.glyphs_count);
    for (int i = 0; i < one.glyphs_count; i++) {
        assert_int_equal(one.glyphs[i].glyph, other.glyphs[i].glyph);
        assert_true(fabs(one.glyphs[i].x_px - (other.glyphs[i].x_px)) <= 1e-6);
        assert_true(fabs(one.glyphs[i].y_px - (other.glyphs[i].y_px)) <= 1e-6);
    }
    font_layout_finish(&one);
    font_layout_finish(&other);
}

/* Wherever one comes from, a passage is set in the same way: scrolled to, jumped to, from above
 * and from below, after another width. */
static void ways_do_not_matter(void **state)
{
    (void)state;
    struct reader_pages_setup setup = usual_setup(), narrow = setup;
    struct reader_view *way = view_of(document, &setup);
    uint64_t random = 3;
    narrow.width_px = 333;
    for (int turn = 0; turn < 40; turn++) {
        const double part = (double)(sample_word(&random) % 1000) / 1000;
        if (turn % 3)
            reader_view_go_part(way, part);
        else
            reader_view_scroll(way, 4000 * (part - 0.5));
        if (turn % 5 == 4) {
            assert_int_equal(reader_view_set(way, &narrow), READER_OK);
            assert_int_equal(reader_view_set(way, &setup), READER_OK);
        }
        int count, fresh_count;
        const struct reader_shown *shown = look(way, &count);
        struct reader_view *fresh = view_of(document, &setup);
        assert_int_equal(
            reader_view_go(fresh, shown[0].begin, shown[0].y_px + shown[0].text_px), READER_OK);
        const struct reader_shown *as = look(fresh, &fresh_count);
        for (int i = 0; i < count && i < fresh_count; i++)
            if (as[i].passage == shown[i].passage) {
                assert_true(fabs(as[i].height_px - (shown[i].height_px)) <= 1e-9);
                same_lines(way, fresh, shown[i].passage, as[i].passage);
            }
        reader_view_destroy(fresh);
    }
    reader_view_destroy(way);
}

/* The middle is there without what stands above it. */
static void begins_anywhere(void **state)
{
    (void)state;
    const struct reader_pages_setup setup = usual_setup();
    struct reader_view *view = view_of(document, &setup);
    int count;
    assert_int_equal(reader_view_go(view, byte_of("N400 "), 10), READER_OK);
    look(view, &count);
    assert_true(reader_view_set_count(view) < 40);
    assert_true(fabs(box_of(view, byte_of("N400 ")).y - (10)) <= 1);
    reader_view_destroy(view);
}

/* ---- what stays ---- */

/* After 1,000 changes of width, size and font the same line is at the top: the letter that it
 * begins with has not moved up or down. */
static void line_stays(void **state)
{
    (void)state;
    struct reader_pages_setup setup = usual_setup();
    struct reader_view *view = view_of(document, &setup);
    static const char *const fonts[] = {"DejaVuSerif", "DejaVuSans"};
    uint64_t random = 11;
    size_t top, now;
    int count;
    reader_view_go_part(view, 0.37);
    reader_view_scroll(view, 7);
    look(view, &count);
    assert_int_equal(reader_view_top(view, &top), READER_OK);
    const struct reader_box before = box_of(view, top);
    assert_true(before.y >= -0.02 && before.y < 40);
    for (int turn = 0; turn < 1000; turn++) {
        setup.width_px = 200 + (double)(sample_word(&random) % 1300);
        setup.height_px = 200 + (double)(sample_word(&random) % 800);
        setup.margin_px = 10 + (double)(sample_word(&random) % 30);
        if (turn % 4 == 0)
            setup.size_px = 9 + (double)(sample_word(&random) % 20);
        if (turn % 50 == 0)
            setup.font = fonts[sample_word(&random) % 2];
        if (turn == 999)
            setup = usual_setup();
        assert_int_equal(reader_view_set(view, &setup), READER_OK);
        if (turn % 10 == 9) {
            look(view, &count);
            assert_true(fabs(box_of(view, top).y - (before.y)) <= 1.01);
        }
        assert_int_equal(reader_view_top(view, &now), READER_OK);
        assert_int_equal(now, top);
    }
    reader_view_destroy(view);
}

/* ---- notes ---- */

static void notes_open_in_place(void **state)
{
    (void)state;
    const struct reader_pages_setup setup = usual_setup();
    struct reader_view *view = view_of(document, &setup);
    const size_t sign = byte_of("more1"), note = byte_of("A note of number 2,");
    struct reader_box box;
    int count;
    size_t top, now;
    const struct reader_span *span = reader_document_span(document, sign + 4);
    assert_non_null(span);
    assert_true(span->look & READER_NOTE);
    assert_int_equal(reader_view_go(view, sign, 100), READER_OK);
    look(view, &count);
    assert_int_equal(reader_view_boxes(view, note, note + 1, &box, 1), 0);
    assert_int_equal(reader_view_top(view, &top), READER_OK);
    assert_int_equal(reader_view_note(view, span->note, sign + 4), READER_OK);
    look(view, &count);
    assert_true(reader_view_note_open(view, span->note));
    assert_true(box_of(view, note).y > box_of(view, sign).y);
    assert_true(box_of(view, note).y < box_of(view, byte_of("N2 ")).y);
    assert_int_equal(reader_view_top(view, &now), READER_OK);
    assert_int_equal(now, top);
    assert_int_equal(reader_view_note(view, span->note, sign + 4), READER_OK);
    look(view, &count);
    assert_int_equal(reader_view_boxes(view, note, note + 1, &box, 1), 0);
    assert_int_equal(reader_view_note(view, 4711, sign), READER_BAD_ARGUMENT);
    reader_view_destroy(view);
}

/* Where there is a margin, it stands there. */
static void notes_open_in_margin(void **state)
{
    (void)state;
    struct reader_pages_setup setup = usual_setup();
    setup.width_px = 1000;
    setup.notes_px = 220;
    struct reader_view *view = view_of(document, &setup);
    const size_t sign = byte_of("more1"), note = byte_of("A note of number 2,");
    int count;
    assert_int_equal(reader_view_go(view, sign, 100), READER_OK);
    assert_int_equal(
        reader_view_note(view, reader_document_span(document, sign + 4)->note, sign + 4),
        READER_OK);
    look(view, &count);
    assert_true(box_of(view, note).x > 700);
    reader_view_scroll(view, 5000); /* and away, and back */
    look(view, &count);
    reader_view_destroy(view);
}

/* ---- pointing ---- */

/* Each letter is hit in the middle of its box. */
static void letters_are_hit(void **state)
{
    (void)state;
    const struct reader_pages_setup setup = usual_setup();
    struct reader_view *view = view_of(document, &setup);
    int count, tried = 0;
    reader_view_go_part(view, 0.2);
    const struct reader_shown *shown = look(view, &count);
    const size_t begin = shown[0].begin, end = shown[count - 1].end;
    for (size_t byte = begin; byte < end; byte++) {
        struct reader_box box;
        size_t hit;
        bool inside;
        if (document->plain[byte] <= ' ' ||
            reader_view_boxes(view, byte, byte + 1, &box, 1) != 1 || box.width < 3)
            continue;
        const struct reader_span *span = reader_document_span(document, byte);
        if (!span || (span->look & READER_FORMULA))
            continue;
        assert_true(reader_view_hit(view, box.x + box.width / 2, box.y + box.height / 2, &hit,
                                    &inside));
        assert_true(inside);
        if (hit != byte) {
            print_message("%zu hit as %zu: '%.12s'\n", byte, hit, document->plain + byte);
            fail();
        }
        tried++;
    }
    assert_true(tried > 300);
    reader_view_destroy(view);
}

/* ---- searching ---- */

static void search_folds(void **state)
{
    (void)state;
    struct reader_document *d =
        read_text("# Über *Wasser*\n\nÉtang et\nroseaux.\n\n```\n# no\n```\n\nüBER");
    size_t begin, end, next;
    assert_true(reader_document_search(d, "über wasser", 0, true, &begin, &end));
    assert_int_equal(begin, 2);
    assert_true(reader_document_search(d, "ÜBER", end, true, &next, &end));
    assert_true(next > begin);
    assert_false(reader_document_search(d, "über", end, true, &next, &end));
    assert_true(reader_document_search(d, "über", d->plain_bytes, false, &next, &end));
    assert_true(reader_document_search(d, "über", next, false, &begin, &end));
    assert_int_equal(begin, 2);
    assert_true(reader_document_search(d, "ÉTANG ET ROSEAUX", 0, true, &begin, &end));
    assert_false(reader_document_search(d, "", 0, true, &begin, &end));
    assert_string_equal(d->plain,
                        "# Über Wasser\n\nÉtang et roseaux.\n\n```\n# no\n```\n\nüBER\n\n");
    reader_document_destroy(d);
}

/* ---- what is hard ---- */

static void hard_documents(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "",        " ",        "***",        "# ",
        "[^a]",    "- ",       "![](x.png)", "| a |\n|---|\n",
        "> > > >", "```\n```", "$$x$$",      "[^a]\n\n[^a]: b[^a] c",
        "\xff\xfe"};
    struct reader_pages_setup setup = usual_setup();
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        struct reader_document *d = read_text(texts[i]);
        struct reader_view *view = view_of(d, &setup);
        int count;
        size_t byte;
        bool inside;
        look(view, &count);
        reader_view_scroll(view, 1e7);
        look(view, &count);
        reader_view_scroll(view, -1e7);
        look(view, &count);
        reader_view_go_part(view, 0.5);
        assert_int_equal(reader_view_go(view, d->plain_bytes, 3), READER_OK);
        look(view, &count);
        reader_view_hit(view, 30, 30, &byte, &inside);
        assert_int_equal(reader_view_top(view, &byte), READER_OK);
        for (int k = 0; k < d->notes_count; k++)
            assert_int_equal(reader_view_note(view, k, 0), READER_OK);
        look(view, &count);
        reader_view_destroy(view);
        reader_document_destroy(d);
    }
}

/* What ink hangs on: the word under a point, also in headings, cells, code and captions. */
static void words_of_all_kinds_are_hit(void **state)
{
    (void)state;
    static const char *const words[] = {"heading", "second",   "Some",    "fifth",  "return",
                                        "quoted",  "bulleted", "caption", "centred"};
    struct reader_document *d = read_text(
        "# A heading of the first level\n\n## One of the second\n\nSome words.\n\n"
        "| one | two |\n|---|---|\n| four | fifth cell |\n\n```c\nint a;\n    return "
        "a;\n```\n\n"
        "> quoted\n\n- bulleted\n\n![a caption](none.png)\n\n<p align=center>centred</p>\n");
    struct reader_pages_setup setup = usual_setup();
    for (int turn = 0; turn < 4; turn++) {
        setup.width_px = turn % 2 ? 260 : 800;
        setup.size_px = turn / 2 ? 26 : 13, setup.height_px = 4000;
        struct reader_view *view = view_of(d, &setup);
        look(view, &(int){0});
        for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
            size_t begin, end, byte;
            bool inside;
            struct reader_box box;
            assert_true(reader_document_search(d, words[i], 0, true, &begin, &end) &&
                        reader_view_boxes(view, begin, begin + 1, &box, 1) >= 1);
            assert_true(reader_view_hit(view, box.x + box.width / 2, box.y + box.height / 2,
                                        &byte, &inside));
            assert_true(inside && byte == begin);
        }
        reader_view_destroy(view);
    }
    reader_document_destroy(d);
}

/* Where scripts live there is room for their pictures over their text: as wide as their fences
 * say or as the column is, at every width; without a strip there is none. */
static void stages_have_room(void **state)
{
    (void)state;
    static const char text[] = "One.\n\n```lua live 400x100\nfirst line\nsecond\n```\n\n"
                               "> ```lua live\n> quoted\n> ```\n\n```lua\ndead\n```\n\nLast.\n";
    struct reader_document *d = read_text(text);
    struct reader_pages_setup setup = usual_setup();
    for (int width = 120; width <= 1200; width += 60) {
        setup.width_px = width;
        setup.height_px = 3000;
        setup.margin_px = 20;
        setup.stage_strip_px = 30;
        struct reader_view *view = view_of(d, &setup);
        int count, stages = 0;
        const struct reader_shown *shown = look(view, &count);
        assert_int_equal(count, 5);
        for (int i = 0; i < count; i++) {
            struct reader_stage stage;
            struct reader_box code = {0};
            if (!reader_view_stage(view, &shown[i], 0, &stage))
                continue;
            stages++;
            const struct reader_block *block = &d->blocks[stage.block];
            assert_true(block->kind == READER_LIVE && stage.block == i);
            const double column = width - 40, in = block->quotes ? 1.5 * setup.size_px : 0,
                         room = column - fmin(column / 2, in) - fmin(column / 4, in);
            assert_true(fabs(stage.width - fmin(block->stage_width, floor(room))) <= 1);
            assert_true(fabs(stage.height / stage.width -
                             (double)block->stage_height / block->stage_width) < 0.02);
            assert_true(stage.x >= 20 - 0.5 && stage.x + stage.width <= width - 20 + 0.5);
            assert_true(stage.y >= shown[i].y_px - 0.5);
            /* the strip is between the picture and the text */
            assert_true(reader_view_boxes(view, block->at, block->at + 1, &code, 1) >= 1);
            assert_true(code.y >= stage.y + stage.height + 30 - 1);
            assert_true(code.y <= stage.y + stage.height + 30 + 2 * setup.size_px);
        }
        assert_int_equal(stages, 2);
        setup.stage_strip_px = 0;
        assert_int_equal(reader_view_set(view, &setup), READER_OK);
        shown = look(view, &count);
        for (int i = 0; i < count; i++) {
            struct reader_stage stage;
            assert_false(reader_view_stage(view, &shown[i], 0, &stage));
        }
        reader_view_destroy(view);
    }
    reader_document_destroy(d);
}

/* Where only a part of a stage's picture is seen, what is read is there, and stays. */
static void stages_are_read(void **state)
{
    (void)state;
    static const char text[] =
        "# One\n\nTwo.\n\n```lua live 400x400\nfirst\nsecond\nthird\n```\n"
        "\nFour.\n\nFive.\n";
    struct reader_document *d = read_text(text);
    struct reader_pages_setup setup = usual_setup();
    const struct reader_block *stage = &d->blocks[2];
    setup.stage_strip_px = 30;
    for (int high = 60; high <= 300; high += 60) {
        setup.width_px = 700;
        setup.height_px = high;
        struct reader_view *view = view_of(d, &setup);
        size_t top = 0, still = 0;
        assert_int_equal(reader_view_go(view, stage->at, 300), READER_OK); /* its first line */
        assert_int_equal(reader_view_top(view, &top), READER_OK);
        assert_int_equal(top, stage->at);
        setup.width_px = 500;
        assert_int_equal(reader_view_set(view, &setup), READER_OK);
        assert_int_equal(reader_view_top(view, &still), READER_OK);
        assert_int_equal(still, top);
        reader_view_destroy(view);
    }
    reader_document_destroy(d);
}

/* Each line of the text under a stage's picture can be the one that is read, and stays at other
 * widths, though the picture stands further to the left. */
static void lines_of_stages_are_kept(void **state)
{
    (void)state;
    static const char *const lines[] = {"first", "second", "third", "fourth", "fifth"};
    char text[1000] = "# One\n\nTwo.\n\n```lua live 400x400\nfirst\nsecond\nthird\n```\n\n"
                      "> ```lua live 300x200\n> fourth\n> fifth\n> ```\n\n";
    for (int i = 0; i < 40; i++) /* so that the window is full below each of them */
        strcat(text, "After.\n\n");
    struct reader_document *d = read_text(text);
    struct reader_pages_setup setup = usual_setup();
    setup.stage_strip_px = 30;
    setup.height_px = 300;
    for (int i = 0; i < 5; i++) {
        struct reader_view *view = view_of(d, &setup);
        size_t begin, end, top = 0;
        assert_true(reader_document_search(d, lines[i], 0, true, &begin, &end));
        assert_int_equal(reader_view_go(view, begin, 0), READER_OK);
        for (int width = 700; width >= 300; width -= 100) {
            int count;
            struct reader_pages_setup narrow = setup;
            narrow.width_px = width;
            assert_int_equal(reader_view_set(view, &narrow), READER_OK);
            assert_int_equal(reader_view_top(view, &top), READER_OK);
            assert_int_equal(top, begin);
            look(view, &count);
            assert_true(fabs(box_of(view, begin).y) < 2); /* whole pixels, twice */
        }
        reader_view_destroy(view);
    }
    reader_document_destroy(d);
}

/* Room for controls is made under one picture, and goes again; the line that is read stays. */
static void stages_have_controls(void **state)
{
    (void)state;
    static const char text[] = "One.\n\n```lua live 400x100\nfirst\n```\n\nTwo.\n\n"
                               "```lua live 400x100\nsecond\n```\n\nLast.\n";
    struct reader_document *d = read_text(text);
    struct reader_pages_setup setup = usual_setup();
    setup.width_px = 800;
    setup.height_px = 3000;
    setup.stage_strip_px = 30;
    struct reader_view *view = view_of(d, &setup);
    struct reader_stage before[2] = {{0}}, after[2];
    const double rooms[] = {0, 70, 120, 0};
    for (int k = 0; k < 4; k++) {
        int count, stages = 0;
        assert_int_equal(reader_view_stage_room(view, 1, rooms[k]), READER_OK);
        const struct reader_shown *shown = look(view, &count);
        for (int i = 0; i < count; i++)
            stages += reader_view_stage(view, &shown[i], 0, &after[stages]);
        assert_int_equal(stages, 2);
        if (k == 0)
            memcpy(before, after, sizeof before);
        assert_true(after[0].y == before[0].y && after[0].height == before[0].height);
        assert_true(fabs(after[1].y - before[1].y - rooms[k]) <= 1);
    }
    assert_int_equal(reader_view_stage_room(view, -1, 1), READER_BAD_ARGUMENT);
    assert_int_equal(reader_view_stage_room(view, d->blocks_count, 1), READER_BAD_ARGUMENT);
    assert_int_equal(reader_view_stage_room(view, 1, -1), READER_BAD_ARGUMENT);
    /* the line that is read, behind the stage */
    size_t top = 0, still = 0;
    setup.height_px = 60;
    assert_int_equal(reader_view_set(view, &setup), READER_OK);
    assert_int_equal(reader_view_go(view, d->blocks[2].at, 10), READER_OK);
    assert_int_equal(reader_view_top(view, &top), READER_OK);
    assert_int_equal(reader_view_stage_room(view, 1, 500), READER_OK);
    assert_int_equal(reader_view_top(view, &still), READER_OK);
    assert_true(top == still && top == d->blocks[2].at);
    reader_view_destroy(view);
    reader_document_destroy(d);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(passages_follow),
        cmocka_unit_test(ways_do_not_matter),
        cmocka_unit_test(begins_anywhere),
        cmocka_unit_test(line_stays),
        cmocka_unit_test(notes_open_in_place),
        cmocka_unit_test(notes_open_in_margin),
        cmocka_unit_test(words_of_all_kinds_are_hit),
        cmocka_unit_test(letters_are_hit),
        cmocka_unit_test(search_folds),
        cmocka_unit_test(hard_documents),
        cmocka_unit_test(stages_have_room),
        cmocka_unit_test(stages_have_controls),
        cmocka_unit_test(stages_are_read),
        cmocka_unit_test(lines_of_stages_are_kept),
    };
    if (without_library())
        return 77;
    setlocale(LC_CTYPE, "C.UTF-8");
    char *text = long_text(600);
    document = read_text(text);
    free(text);
    const int status = cmocka_run_group_tests(tests, NULL, NULL);
    reader_document_destroy(document);
    return status;
}
