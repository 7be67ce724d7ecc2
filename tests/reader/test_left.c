/* test_left.c - what readers left, on pages: boxes behind words, ink at its word, typed notes
 * at the foot or in the margin, and behind all else what has no words any more. */
#include <reader_pages.h>

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
/* clang-format on */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "../sample.h"
#include "without_library.h"

static char path[] = "/tmp/lutetia-left-XXXXXX";
static const char marsh[] =
    "# The marsh\n\nBefore it was a *town it was* a marsh[^1].\n\n- The river "
    "ran slowly.\n\n| reeds | eels |\n|---|---|\n| many | few |\n\nGone "
    "soon.\n\n[^1]: Small herons.\n";

struct left {
    struct reader_document *document;
    struct reader_remarks *remarks;
    struct reader_pages *pages;
    int count;
};

static struct left begin_file(const char *markdown, size_t bytes, bool keep)
{
    struct left l = {0};
    if (!keep)
        unlink(path);
    if (reader_document_create(&l.document) != READER_OK ||
        reader_document_add(l.document, markdown, bytes) != READER_OK ||
        reader_document_refer(l.document) != READER_OK ||
        reader_document_plain(l.document) != READER_OK ||
        reader_remarks_open(path, &l.remarks) != READER_OK ||
        reader_remarks_find(l.remarks, l.document->plain, l.document->plain_bytes) != READER_OK)
        fail_msg("%s", reader_error());
    return l;
}

static void add(struct left *l, enum reader_remark_kind kind, char *text, const char *quotation)
{
    static struct reader_ink_point points[] = {{0, 0, 1, 0}, {1, 0.5f, 1, 0.1f}};
    const bool ink = kind == READER_REMARK_INK;
    const struct reader_remark what = {.kind = kind,
                                       .text = text,
                                       .points = ink ? points : NULL,
                                       .points_count = ink ? 2 : 0,
                                       .width = 0.25,
                                       .rgba = 0xff000080};
    const char *at = strstr(l->document->plain, quotation);
    int index;
    assert_non_null(at);
    if (reader_remarks_add(l->remarks, &what, l->document->plain, l->document->plain_bytes,
                           (size_t)(at - l->document->plain),
                           (size_t)(at - l->document->plain) + strlen(quotation),
                           &index) != READER_OK)
        fail_msg("%s", reader_error());
}

static void make(struct left *l, double notes_px)
{
    struct reader_pages_setup setup = reader_pages_setup_default();
    setup.font = "DejaVuSerif";
    setup.size_px = 12;
    setup.running = false;
    setup.notes_px = notes_px;
    setup.remarks = l->remarks;
    if (reader_pages_make(l->document, &setup, &l->pages) != READER_OK)
        fail_msg("%s", reader_error());
    assert_int_equal(page_count(reader_pages_text(l->pages), &l->count), FONT_OK);
}

static void finish(struct left *l)
{
    reader_pages_destroy(l->pages);
    reader_remarks_close(l->remarks);
    reader_document_destroy(l->document);
}

/* All that the pages say; the caller frees it. */
static char *said(struct left *l)
{
    char *all = NULL;
    size_t bytes;
    FILE *f = open_memstream(&all, &bytes);
    assert_non_null(f);
    for (int page = 0; page < l->count; page++) {
        struct font_layout layout;
        struct page_said s;
        assert_int_equal(page_layout_said(reader_pages_text(l->pages), page, &layout, &s),
                         FONT_OK);
        fwrite(s.utf8, 1, s.bytes, f);
        font_layout_finish(&layout);
        page_said_finish(&s);
    }
    fclose(f);
    return all;
}

/* Where the first letter of a text stands on the first page, and whose it is in the end. */
static struct font_placed letter(struct left *l, const char *text, size_t behind)
{
    struct font_layout layout;
    struct page_said s;
    struct font_placed found = {0};
    assert_int_equal(page_layout_said(reader_pages_text(l->pages), 0, &layout, &s), FONT_OK);
    const char *at = strstr(s.utf8, text);
    if (!at)
        fail_msg("%s is not said in %s", text, s.utf8);
    for (int i = 0; at && i < layout.glyphs_count; i++)
        if (layout.glyphs[i].cluster == (int)(at - s.utf8 + (long)behind))
            found = layout.glyphs[i];
    font_layout_finish(&layout);
    page_said_finish(&s);
    return found;
}

static void boxes_and_ink_are_at_their_words(void **state)
{
    (void)state;
    struct left l = begin_file(marsh, strlen(marsh), false);
    struct font_drawing d = {0};
    add(&l, READER_REMARK_HIGHLIGHT, "", "town it");
    add(&l, READER_REMARK_HIGHLIGHT, "", "wn it was");
    add(&l, READER_REMARK_TYPED, "why", "few");
    add(&l, READER_REMARK_INK, "", "river");
    add(&l, READER_REMARK_HIGHLIGHT, "", "slowly");
    assert_int_equal(reader_remarks_erase(l.remarks, 4, true), READER_OK);
    make(&l, 0);
    assert_int_equal(reader_pages_left(l.pages, 0, &d), READER_OK);
    /* What two of them cover is one box behind another, none over another. */
    assert_int_equal(d.boxes_count, 3);
    const struct font_placed town = letter(&l, "town it was", 0),
                             behind = letter(&l, "town it was", 11),
                             it = letter(&l, "town it was", 7), few = letter(&l, "few", 0),
                             river = letter(&l, "river", 0);
    assert_true(fabs(d.boxes[0].x - town.x_px) < 0.5);
    assert_true(fabs(d.boxes[0].x + d.boxes[0].width - d.boxes[1].x) < 0.01);
    assert_true(fabs(d.boxes[1].x - it.x_px) < 0.5);
    assert_true(fabs(d.boxes[1].x + d.boxes[1].width - behind.x_px) < 0.5);
    assert_true(d.boxes[0].y < town.y_px && d.boxes[0].y + d.boxes[0].height > town.y_px);
    assert_true(d.boxes[2].x <= few.x_px && d.boxes[2].y < few.y_px &&
                d.boxes[2].rgba[2] > 0.9);
    assert_int_equal(d.strokes_count, 1);
    assert_int_equal(d.strokes[0].points_count, 2);
    const struct font_drawing_point *p = d.strokes[0].points;
    assert_true(fabs(p[0].x - river.x_px) < 1.5 && p[0].y < river.y_px &&
                p[0].y > river.y_px - 20);
    assert_true(fabs(p[1].x - p[0].x - 12) < 0.01 && fabs(p[1].y - p[0].y - 6) < 0.01);
    assert_true(fabs(p[1].width_px - 3) < 0.01 &&
                fabs(d.strokes[0].rgba[3] - 128 / 255.0) < 1e-9);
    finish(&l);
}

/* A stroke that is scaled, moved, and hangs on the words of another one of its group. */
static void ink_is_scaled_and_grouped(void **state)
{
    (void)state;
    struct left l = begin_file(marsh, strlen(marsh), false);
    struct font_drawing d = {0};
    add(&l, READER_REMARK_INK, "", "river");
    add(&l, READER_REMARK_INK, "", "town it");
    struct reader_arranged to[2] = {reader_remarks_arranged(l.remarks, 0),
                                    reader_remarks_arranged(l.remarks, 1)};
    to[0].scale_x = 2;
    to[0].scale_y = 0.5;
    to[0].hangs = to[0].group = to[1].group = 1;
    to[0].x = 3;
    assert_int_equal(reader_remarks_arrange(l.remarks, to, 2), READER_OK);
    make(&l, 0);
    assert_int_equal(reader_pages_left(l.pages, 0, &d), READER_OK);
    assert_int_equal(d.strokes_count, 2);
    const struct font_drawing_point *p = d.strokes[0].points, *on = d.strokes[1].points;
    assert_true(fabs(p[0].x - on[0].x - 36) < 0.01 && fabs(p[0].y - on[0].y) < 0.01);
    assert_true(fabs(p[1].x - p[0].x - 24) < 0.01 && fabs(p[1].y - p[0].y - 3) < 0.01);
    assert_true(fabs(p[1].width_px - 3) < 0.01);
    finish(&l);
}

static void typed_notes_stand_at_the_foot_or_beside(void **state)
{
    (void)state;
    for (int margin = 0; margin < 2; margin++) {
        struct left l = begin_file(marsh, strlen(marsh), false);
        add(&l, READER_REMARK_TYPED, "Which\ntown?\t\x01 \xff.", "town it");
        add(&l, READER_REMARK_TYPED, "one leg", "herons");
        make(&l, margin ? 140 : 0);
        char *all = said(&l);
        assert_non_null(
            strstr(all, "\xe2\x80\x9ctown it\xe2\x80\x9d Which\ntown?   \xef\xbf\xbd."));
        /* That to a note stands behind all else. */
        const char *others = strstr(all, "Readers\xe2\x80\x99 other notes\n");
        assert_non_null(others);
        assert_non_null(strstr(others, "The marsh: \xe2\x80\x9cherons\xe2\x80\x9d one leg"));
        const struct font_placed note = letter(&l, "Which\n", 0),
                                 town = letter(&l, "town it was", 0);
        if (margin)
            assert_true(note.x_px > 600 - 64 - 140 && fabs(note.y_px - town.y_px) < 3);
        else
            assert_true(note.y_px > 700);
        free(all);
        finish(&l);
    }
}

static void what_has_no_words_is_told_at_the_end(void **state)
{
    (void)state;
    struct left l = begin_file(marsh, strlen(marsh), false);
    add(&l, READER_REMARK_TYPED, "soon gone", "Gone soon");
    add(&l, READER_REMARK_INK, "", "Gone soon");
    add(&l, READER_REMARK_HIGHLIGHT, "", "Gone soon");
    finish(&l);
    char *shorter = strdup(marsh);
    assert_non_null(shorter);
    memset(strstr(shorter, "Gone soon."), ' ', strlen("Gone soon."));
    l = begin_file(shorter, strlen(shorter), true);
    make(&l, 0);
    char *all = said(&l);
    const char *others = strstr(all, "Readers\xe2\x80\x99 other notes\n");
    struct font_drawing d = {0};
    assert_non_null(others);
    assert_non_null(strstr(others, "The marsh: \xe2\x80\x9cGone soon\xe2\x80\x9d soon gone"));
    assert_non_null(strstr(others, "\xe2\x80\x9cGone soon\xe2\x80\x9d [ink]"));
    assert_int_equal(reader_pages_left(l.pages, 0, &d), READER_OK);
    assert_int_equal(d.boxes_count + d.strokes_count, 0);
    free(all);
    free(shorter);
    finish(&l);
}

/* As only a file that somebody made could have it. */
static void remarks_within_letters_are_set(void **state)
{
    (void)state;
    static const char text[] = "\xc3\xa9\xe6\xb0\xb4\xc3\xa9l\xc3\xa9\n";
    for (size_t begin = 0; begin < sizeof text - 2; begin++)
        for (size_t end = begin; end < sizeof text - 1; end++) {
            struct left l = begin_file(text, sizeof text - 1, false);
            struct font_drawing d = {0};
            static struct reader_ink_point point = {0, 0, 1, 0};
            int index;
            for (int k = 0; k < 3; k++) {
                const struct reader_remark what = {.kind = (enum reader_remark_kind)k,
                                                   .text = "n",
                                                   .points = &point,
                                                   .points_count = k == READER_REMARK_INK};
                assert_int_equal(reader_remarks_add(l.remarks, &what, l.document->plain,
                                                    l.document->plain_bytes, begin, end,
                                                    &index),
                                 READER_OK);
            }
            make(&l, 0);
            assert_int_equal(reader_pages_left(l.pages, 0, &d), READER_OK);
            finish(&l);
        }
}

/* A note of a megabyte, hundreds at one place, remarks that cover all: each is there. */
static void many_and_long_remarks_are_set(void **state)
{
    (void)state;
    enum { LONG = READER_TYPED_MAX - 8, MANY = 300 };
    struct left l = begin_file(marsh, strlen(marsh), false);
    char *typed = malloc(LONG + 1);
    uint64_t seed = 7;
    struct font_drawing d = {0};
    assert_non_null(typed);
    for (int i = 0; i < LONG; i++)
        typed[i] = sample_word(&seed) % 6 ? "abcdefghijklmnopqrstuvwxyz"[i % 26] : ' ';
    memcpy(typed + LONG - 8, " the end", 8);
    typed[LONG] = '\0';
    add(&l, READER_REMARK_TYPED, typed, "slowly");
    for (int i = 0; i < MANY; i++) {
        char text[20];
        snprintf(text, sizeof text, "note%d", i);
        add(&l, READER_REMARK_TYPED, text, "few");
        add(&l, READER_REMARK_HIGHLIGHT, "", "Before it was a town it was a marsh");
        add(&l, READER_REMARK_INK, "", "many");
    }
    make(&l, 0);
    char *all = said(&l);
    assert_non_null(strstr(all, "the end"));
    for (int i = 0; i < MANY; i++) {
        char text[24];
        snprintf(text, sizeof text, "note%d\n", i);
        if (!strstr(all, text))
            fail_msg("there is no %s", text);
    }
    int boxes = 0, strokes = 0;
    for (int page = 0; page < l.count; page++) {
        assert_int_equal(reader_pages_left(l.pages, page, &d), READER_OK);
        boxes += d.boxes_count;
        strokes += d.strokes_count;
    }
    assert_true(boxes < 20);
    assert_int_equal(strokes, MANY);
    free(all);
    free(typed);
    finish(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(boxes_and_ink_are_at_their_words),
        cmocka_unit_test(ink_is_scaled_and_grouped),
        cmocka_unit_test(typed_notes_stand_at_the_foot_or_beside),
        cmocka_unit_test(what_has_no_words_is_told_at_the_end),
        cmocka_unit_test(remarks_within_letters_are_set),
        cmocka_unit_test(many_and_long_remarks_are_set),
    };
    const int file = mkstemp(path);
    if (without_library())
        return 77;
    if (file < 0 || close(file) != 0)
        return 1;
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    unlink(path);
    return failed;
}
