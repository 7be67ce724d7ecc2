/* test_page.c - pages: lines against a search of all ways to break; carets, selections,
 * marks. */
#include "page_texts.h"

#include <breaks.h>
#include <page.h>
#include <setup.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- breaking ---- */

struct way {
    const struct break_place *places;
    const double *widths;
    int count, widths_count;
    const struct break_rules *rules;
    double best;
};

/* What a short last line costs, and one that has no word's beginning in it. */
static double last_line_cost(const struct way *w, int from)
{
    const struct break_place *a = &w->places[from], *b = &w->places[w->count - 1];
    bool words = !a->flagged;
    for (int i = from + 1; i < w->count - 1; i++)
        words = words || !w->places[i].flagged;
    return (b->end.px - a->next.px < w->rules->runt_px ? 44100 : 0) +
           (w->rules->whole_word && !words ? 1e9 : 0);
}

/* Tries all ways to break from a place on. */
static void ways_try(struct way *w, int from, int line, int fitness, int ladder,
                     double demerits)
{
    if (from == w->count - 1) {
        w->best = fmin(w->best, demerits);
        return;
    }
    for (int to = from + 1; to < w->count; to++) {
        bool last = to == w->count - 1;
        double width = w->widths[line < w->widths_count ? line : w->widths_count - 1];
        double r = breaks_ratio(&w->places[from], &w->places[to], width, w->rules, last);
        int next;
        int ladders = w->places[to].flagged ? ladder + 1 : 0;
        bool high = w->rules->ladder_max && ladders > w->rules->ladder_max;
        if (r >= -1 && !high &&
            fmin(100 * fabs(r * r * r), BREAK_INFINITE) <= w->rules->tolerance) {
            double more =
                breaks_demerits(&w->places[from], &w->places[to], r, fitness, &next, last);
            more += last && from > 0 ? last_line_cost(w, from) : 0;
            ways_try(w, to, line + 1, next, ladders, demerits + more);
        }
        if (!last && w->places[to].penalty <= -BREAK_INFINITE)
            return;
    }
}

static void paragraphs_are_broken_best(void **state)
{
    (void)state;
    uint32_t seed = 20261123;
    int found = 0;
    for (int turn = 0; turn < 3000; turn++) {
        enum { MOST = 15 };
        struct break_place places[MOST];
        double widths[3];
        int count = 4 + (int)(random_unit(&seed) * (MOST - 4)), chosen[MOST], lines;
        struct break_sum sum = {0};
        memset(places, 0, sizeof places);
        for (int i = 1; i < count; i++) {
            sum.px += 10 + 40 * random_unit(&seed);
            places[i].end = sum;
            if (random_unit(&seed) < (turn % 7 == 0 ? 0.8 : 0.3)) {
                places[i].flagged = true;
                places[i].penalty = 50;
                places[i].end.px += 4;
            } else {
                sum.px += 5;
                sum.stretch += 2.5 + random_unit(&seed);
                sum.shrink += 1.6;
            }
            if (random_unit(&seed) < 0.04)
                places[i].penalty = -BREAK_INFINITE;
            places[i].next = sum;
        }
        for (int i = 0; i < 3; i++)
            widths[i] = 70 + 60 * random_unit(&seed);
        struct break_rules rules = {.tolerance = turn % 3 ? 500 : BREAK_INFINITE,
                                    .emergency_px = turn % 2 ? 0 : 12,
                                    .last_fills = turn % 5 != 0,
                                    .ladder_max = turn % 7 == 0 ? 1 + turn % 3 : 0,
                                    .runt_px = turn % 4 == 1 ? 60 : 0,
                                    .whole_word = turn % 3 == 2};
        int widths_count = 1 + turn % 3;
        double demerits = 0;
        assert_true(breaks_find(places, count, widths, widths_count, &rules, chosen, &lines,
                                &demerits));
        struct way way = {places, widths, count, widths_count, &rules, INFINITY};
        ways_try(&way, 0, 0, 2, 0, 0);
        assert_int_equal(lines > 0, isfinite(way.best));
        if (!lines)
            continue;
        found++;
        if (fabs(demerits - way.best) > 1e-6 * fabs(way.best))
            fail_msg("turn %d: %g demerits, %g are the fewest", turn, demerits, way.best);
        assert_int_equal(chosen[lines - 1], count - 1);
    }
    assert_true(found > 1000);
}

/* In a narrow column words are divided, rather than that spaces become wide; never in more than
 * three lines in a row. */
static void narrow_columns_are_divided(void **state)
{
    (void)state;
    static const char text[] =
        "The water of a marsh carries pigment through the fibers of a sheet; what it leaves at "
        "its rim dries dark, and extraordinary hyphenation demonstrates itself wherever a "
        "representative of communication finds no satisfactory arrangement within the "
        "measurement of a newspaper's column.";
    struct page_text *t = page_text_begin();
    struct page_template page = {.width_px = 170, .height_px = 480, .frames_count = 1};
    struct page_manner m = page_manner_default();
    int pages, id, lines = 0, divided = 0;
    page.frames[0] = (struct page_frame){.x = 10, .y = 10, .width = 130, .height = 460};
    m.align = FONT_ALIGN_JUSTIFY;
    m.hyphenate = true;
    assert_font(page_templates_set(t, &page, 1));
    for (int i = 0; i < 6; i++)
        assert_font(page_paragraph_add(t, 0, -1, text + 4 * i, sizeof text - 1 - 4 * (size_t)i,
                                       0, &m, &id));
    assert_font(page_count(t, &pages));
    for (int k = 0, ladder = 0; k < pages; k++) {
        struct font_layout l;
        assert_font(page_layout(t, k, &l));
        for (int i = 0; i < l.glyphs_count; i++) {
            const struct font_placed *g = &l.glyphs[i];
            bool last = i + 1 == l.glyphs_count || g[1].line != g->line;
            bool hyphen = g->glyph == font_face_glyph(g->face, '-') ||
                          g->glyph == font_face_glyph(g->face, 0x2010);
            lines += last;
            divided += last && hyphen;
            ladder = last ? (hyphen ? ladder + 1 : 0) : ladder;
            assert_true(ladder <= 3);
        }
        font_layout_finish(&l);
    }
    print_message("%d of %d lines are divided\n", divided, lines);
    assert_true(4 * divided > lines);
    page_text_destroy(t);
}

/* ---- pointing ---- */

static struct page_text *one_column(double width, const char *text, size_t bytes,
                                    const struct page_manner *manner, int *id)
{
    struct page_text *t = page_text_begin();
    struct page_template page = {.width_px = width + 20, .height_px = 2000, .frames_count = 1};
    page.frames[0] = (struct page_frame){.x = 10, .y = 10, .width = width, .height = 1980};
    assert_font(page_templates_set(t, &page, 1));
    assert_font(page_paragraph_add(t, 0, -1, text, bytes, 1, manner, id));
    return t;
}

/* Hitting a caret's place gives a text place with the same caret; where the direction does not
 * change, the same text place. */
static void carets_and_hits_agree(void **state)
{
    (void)state;
    uint32_t seed = 4711;
    long same = 0, all = 0;
    for (int turn = 0; turn < 150; turn++) {
        char text[1000];
        int id;
        size_t bytes = page_random_text(&seed, text, 1 + (int)(random_next(&seed) % 25));
        struct page_manner manner = page_random_manner(&seed);
        manner.begins_column = false;
        manner.begins_page = 0;
        struct page_text *t = one_column(120 + 10 * (turn % 20), text, bytes, &manner, &id);
        struct page_place at = {id, 0};
        do {
            for (int before = 0; before < 2; before++) {
                struct page_caret a, b;
                struct page_place hit;
                bool edge;
                assert_font(page_caret_get(t, at, before, &a));
                assert_int_equal(a.page, 0);
                assert_true(a.y1 > a.y0 && a.x0 == a.x1);
                assert_font(page_hit(t, 0, a.x0, (a.y0 + a.y1) / 2, &hit, &edge));
                assert_int_equal(hit.paragraph, id);
                assert_font(page_caret_get(t, hit, edge, &b));
                if (fabs(a.x0 - b.x0) > 0.01 || a.y0 != b.y0)
                    fail_msg("turn %d, byte %d (%d): caret at %g, %g; hit byte %d (%d): caret "
                             "at %g, %g",
                             turn, at.byte, before, a.x0, a.y0, hit.byte, edge, b.x0, b.y0);
                same += hit.byte == at.byte;
                all++;
            }
        } while (page_place_step(t, &at, true));
        assert_int_equal(at.byte, bytes);
        while (page_place_step(t, &at, false))
            ;
        assert_int_equal(at.byte, 0);
        page_text_destroy(t);
    }
    /* The other places are in white space at lines' ends, and where two directions meet. */
    assert_true((double)same > 0.8 * (double)all);
}

/* In one line of Latin letters each caret's place hits exactly its own text place. */
static void places_are_hit_again(void **state)
{
    (void)state;
    static const char text[] = "waffles, e\xcc\x81l\xc3\xa8ve fi AVATAR office";
    struct page_manner manner = page_manner_default();
    struct page_place at, hit;
    struct page_caret caret;
    double last = -1;
    bool edge;
    int id;
    struct page_text *t = one_column(900, text, strlen(text), &manner, &id);
    assert_font(page_paragraph_style(t, id, 0, (int)strlen(text), 2)); /* with ligatures */
    at = (struct page_place){id, 0};
    do {
        assert_font(page_caret_get(t, at, false, &caret));
        assert_true(caret.x0 > last); /* within ligatures, too */
        last = caret.x0;
        assert_font(page_hit(t, 0, caret.x0, caret.y0 + 1, &hit, &edge));
        assert_int_equal(hit.byte, at.byte);
    } while (page_place_step(t, &at, true));
    page_text_destroy(t);
}

/* A point far beside the page is on the line at its height, however far lines are moved in. */
static void far_points_hit_their_lines(void **state)
{
    (void)state;
    static const double xs[] = {-1e6, -50, 1e6};
    struct page_manner manner = page_manner_default();
    manner.align = FONT_ALIGN_LEFT;
    manner.left_px = 17;
    int ids[3];
    struct page_text *t = one_column(400, "abc def", 7, &manner, &ids[0]);
    for (int i = 1; i < 3; i++) {
        manner.left_px = i == 1 ? 0 : 17;
        manner.right_px = i == 1 ? 17 : 0;
        assert_font(page_paragraph_add(t, 0, -1, "abc def", 7, 1, &manner, &ids[i]));
    }
    for (int i = 0; i < 9; i++) {
        struct page_caret caret;
        struct page_place place;
        bool edge;
        assert_font(page_caret_get(t, (struct page_place){ids[i / 3], 0}, false, &caret));
        assert_font(page_hit(t, 0, xs[i % 3], (caret.y0 + caret.y1) / 2, &place, &edge));
        assert_int_equal(place.paragraph, ids[i / 3]);
        assert_int_equal(place.byte, xs[i % 3] < 0 ? 0 : 7);
    }
    page_text_destroy(t);
}

static double boxes_width(struct page_text *t, int id, int from, int to, int *count)
{
    struct page_box boxes[200];
    double width = 0;
    assert_font(page_select(t, (struct page_place){id, from}, (struct page_place){id, to}, 0,
                            boxes, 200, count));
    assert_in_range(*count, 0, 200);
    for (int i = 0; i < *count; i++)
        width += boxes[i].width;
    return width;
}

/* Two adjacent selections are together as wide as one selection of both, and a line's boxes do
 * not overlap. */
static void selections_add_up(void **state)
{
    (void)state;
    uint32_t seed = 99;
    for (int turn = 0; turn < 120; turn++) {
        char text[1000];
        int id, count, parts[2];
        size_t bytes = page_random_text(&seed, text, 2 + (int)(random_next(&seed) % 20));
        struct page_manner manner = page_manner_default();
        manner.align = (enum font_align)(turn % 5);
        struct page_text *t = one_column(140 + 15 * (turn % 17), text, bytes, &manner, &id);
        struct page_place middle = {id, 0};
        for (int steps = (int)(random_next(&seed) % (uint32_t)bytes); steps > 0; steps--)
            page_place_step(t, &middle, true);
        double whole = boxes_width(t, id, 0, (int)bytes, &count);
        double first = boxes_width(t, id, 0, middle.byte, &parts[0]);
        double second = boxes_width(t, id, middle.byte, (int)bytes, &parts[1]);
        assert_true(fabs(whole - first - second) < 0.05);
        assert_true(count > 0 && parts[0] + parts[1] >= count);
        page_text_destroy(t);
    }
    /* A selection from a Latin word into an Arabic one has two boxes, because Arabic begins at
     * the right. */
    static const char both[] = "abc \xd8\xa7\xd9\x84\xd9\x85\xd8\xa7\xd8\xa1 def";
    struct page_manner manner = page_manner_default();
    int id, count;
    struct page_text *t = one_column(500, both, strlen(both), &manner, &id);
    boxes_width(t, id, 1, 8, &count);
    assert_int_equal(count, 2);
    boxes_width(t, id, 0, (int)strlen(both), &count);
    assert_int_equal(count, 1);
    page_text_destroy(t);
}

static void marks_stay_at_their_letters(void **state)
{
    (void)state;
    struct page_manner manner = page_manner_default();
    struct page_place place;
    int id, other, marks[3];
    struct page_text *t = one_column(300, "The water rises", 15, &manner, &id);
    assert_font(page_mark_add(t, (struct page_place){id, 4}, false, &marks[0]));
    assert_font(page_mark_add(t, (struct page_place){id, 4}, true, &marks[1]));
    assert_font(page_mark_add(t, (struct page_place){id, 10}, false, &marks[2]));
    assert_font(page_text_replace(t, id, 4, 0, "old ", 4));
    assert_true(page_mark_get(t, marks[0], &place) && place.byte == 4);
    assert_true(page_mark_get(t, marks[1], &place) && place.byte == 8);
    assert_true(page_mark_get(t, marks[2], &place) && place.byte == 14);
    assert_font(page_text_replace(t, id, 0, 4, "", 0));
    assert_true(page_mark_get(t, marks[2], &place) && place.byte == 10);
    assert_font(page_paragraph_add(t, 0, 0, "Before", 6, 0, &manner, &other));
    assert_true(page_mark_get(t, marks[2], &place) && place.paragraph == id &&
                place.byte == 10);
    assert_font(page_paragraph_remove(t, id));
    assert_false(page_mark_get(t, marks[2], &place));
    page_text_destroy(t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(paragraphs_are_broken_best),
        cmocka_unit_test(narrow_columns_are_divided),
        cmocka_unit_test(carets_and_hits_agree),
        cmocka_unit_test(places_are_hit_again),
        cmocka_unit_test(far_points_hit_their_lines),
        cmocka_unit_test(selections_add_up),
        cmocka_unit_test(marks_stay_at_their_letters),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
