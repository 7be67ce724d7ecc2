/* test_page.c - pages: lines against a search of all ways to break; edited texts, with keeps, notes, shapes, tabs and vertical
 * lines, against texts set anew; carets. */
#include "support.h"

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

/* Tries all ways to break from a place on. */
static void ways_try(struct way *w, int from, int line, int fitness, double demerits)
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
        if (r >= -1 && fmin(100 * fabs(r * r * r), BREAK_INFINITE) <= w->rules->tolerance) {
            double more =
                breaks_demerits(&w->places[from], &w->places[to], r, fitness, &next, last);
            ways_try(w, to, line + 1, next, demerits + more);
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
            if (random_unit(&seed) < 0.3) {
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
                                    .last_fills = turn % 5 != 0};
        int widths_count = 1 + turn % 3;
        double demerits = 0;
        assert_true(breaks_find(places, count, widths, widths_count, &rules, chosen, &lines,
                                &demerits));
        struct way way = {places, widths, count, widths_count, &rules, INFINITY};
        ways_try(&way, 0, 0, 2, 0);
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

/* ---- texts ---- */

static const char *const words[] = {"water",
                                    "the",
                                    "of",
                                    "paper,",
                                    "printer",
                                    "difficult.",
                                    "fi",
                                    "waffles",
                                    "AVATAR",
                                    "\xd8\xa7\xd9\x84\xd9\x85\xd8\xa7\xd8\xa1",
                                    "\xd7\x9e\xd7\x99\xd7\x9d",
                                    "\xd0\xb2\xd0\xbe\xd0\xb4\xd0\xb0",
                                    "\xce\xbd\xce\xb5\xcf\x81\xcf\x8c",
                                    "e\xcc\x81l\xc3\xa8ve",
                                    "extraordinary",
                                    "(brackets)",
                                    "1990",
                                    "co-operate",
                                    ("un\xc2\xad"
                                     "seen"),
                                    "\xe2\x80\x9cquoted\xe2\x80\x9d",
                                    "\xd8\xa8\xd9\x90\xd8\xb3\xd9\x92\xd9\x85",
                                    "a\tb",
                                    "line\nend",
                                    "\xe0\xb8\x99\xe0\xb9\x89\xe0\xb8\xb3",
                                    "\xf0\x9f\x98\x80\xf0\x9f\x87\xa9\xf0\x9f\x87\xaa",
                                    "\xe4\xb8\x80\xe4\xba\x8c\xe4\xb8\x89",
                                    "\xff"};
enum { WORDS = sizeof words / sizeof *words, WORDS_NEAR = 8 };
/* So many of them are used: the first few need no other font than the styles', of which some are large. */
static uint32_t words_used = WORDS;

static size_t random_text(uint32_t *seed, char *out, int count)
{
    size_t bytes = 0;
    for (int i = 0; i < count; i++) {
        const char *w = words[random_next(seed) % words_used];
        memcpy(out + bytes, w, strlen(w));
        bytes += strlen(w);
        if (i + 1 < count)
            out[bytes++] = ' ';
    }
    return bytes;
}

enum { STYLES = 4 };

static struct page_text *text_begin(void)
{
    struct page_text *t;
    assert_font(page_text_create(&t));
    for (int i = 0; i < STYLES; i++) {
        static const char *const fonts[STYLES] = {"DejaVuSerif", "DejaVuSans",
                                                  "EBGaramond12-Italic", "DejaVuSans-Bold"};
        struct page_style style = page_style_default();
        int id;
        style.font = fonts[i];
        style.size_px = 10 + 3 * i;
        style.language = "en";
        style.inked = i == 3;
        style.ink = font_ink_plain(1, 0, 0, 0.5);
        style.raise_px = i == 1 ? 2 : 0;
        assert_font(page_style_add(t, &style, &id));
        assert_int_equal(id, i);
    }
    return t;
}

static const double diamond[] = {200, 80, 280, 180, 200, 280, 120, 180};

static void columns_set(struct page_text *t, bool shaped)
{
    struct page_template page = {.width_px = 400, .height_px = 400, .frames_count = 2};
    page.frames[0] = (struct page_frame){.x = 20,
                                         .y = 20,
                                         .width = 170,
                                         .height = 360,
                                         .foot_gap_px = 8,
                                         .margin_x = -60,
                                         .margin_width = 70};
    page.frames[1] = page.frames[0];
    page.frames[1].x = 210;
    page.shapes_count = shaped;
    page.shapes[0] = (struct page_shape){
        .points = diamond, .points_count = 4, .distance_px = 5, .least_px = 40};
    assert_font(page_templates_set(t, &page, 1));
}

static struct page_manner random_manner(uint32_t *seed)
{
    struct page_manner m = page_manner_default();
    m.align = (enum font_align)(random_next(seed) % 5);
    m.hyphenate = random_next(seed) % 2;
    m.protrude = random_next(seed) % 2;
    m.expand = random_next(seed) % 3 ? 0 : 0.02;
    m.indent_px = random_next(seed) % 2 * 12;
    m.before_px = random_next(seed) % 3 * 4;
    m.keep_with_next = random_next(seed) % 6 == 0;
    m.keep_together = random_next(seed) % 6 == 0;
    m.begins_column = random_next(seed) % 12 == 0;
    m.leading_px = 18;
    m.tabs[0] = (struct page_tab){60, PAGE_TAB_RIGHT};
    m.tabs_count = 1;
    return m;
}

/* ---- edited texts against texts set anew ---- */

enum { NOTES = 3 };

struct model {
    int id;
    char *text;
    int bytes, first_style;
    uint8_t *styles; /* of each byte */
    struct page_manner manner;
    int notes[NOTES], notes_count; /* where: each says the word of its number */
};
enum { MODELS = 60, MODEL_BYTES = 4000 };

static void pages_compare(struct page_text *a, struct page_text *b, int turn)
{
    int pages, others;
    assert_font(page_count(a, &pages));
    assert_font(page_count(b, &others));
    if (pages != others)
        fail_msg("turn %d: %d pages, from scratch %d", turn, pages, others);
    for (int k = 0; k < pages; k++) {
        struct font_layout p, q;
        assert_font(page_layout(a, k, &p));
        assert_font(page_layout(b, k, &q));
        if (p.glyphs_count != q.glyphs_count)
            fail_msg("turn %d, page %d: %d glyphs, from scratch %d", turn, k, p.glyphs_count,
                     q.glyphs_count);
        for (int i = 0; i < p.glyphs_count; i++) {
            const struct font_placed *g = &p.glyphs[i], *h = &q.glyphs[i];
            struct font_face_info gi, hi;
            font_face_describe(g->face, &gi);
            font_face_describe(h->face, &hi);
            if (g->glyph != h->glyph || g->x_px != h->x_px || g->y_px != h->y_px ||
                g->size_px != h->size_px || g->cluster != h->cluster || g->line != h->line ||
                !g->ink != !h->ink || !g->map != !h->map || strcmp(gi.path, hi.path) != 0)
                fail_msg("turn %d, page %d, glyph %d: %u at %g, %g, from scratch %u at %g, %g",
                         turn, k, i, g->glyph, g->x_px, g->y_px, h->glyph, h->x_px, h->y_px);
        }
        font_layout_finish(&p);
        font_layout_finish(&q);
    }
}

static int random_boundary(uint32_t *seed, const struct model *m)
{
    int at = (int)(random_unit(seed) * (m->bytes + 1));
    at = at > m->bytes ? m->bytes : at;
    while (at < m->bytes && ((unsigned char)m->text[at] & 0xc0) == 0x80)
        at++;
    return at;
}

/* A note at the foot of its column. */
static void note_put(struct page_text *t, int id, int byte)
{
    static const char text[] =
        "of the note, which says so much that it has one line or has several lines";
    struct page_manner manner = page_manner_default();
    int note;
    manner.leading_px = 13;
    assert_font(
        page_note_add(t, id, byte, PAGE_NOTE_FOOT, text, sizeof text - 1, 0, &manner, &note));
}

static void model_replace(struct page_text *t, struct model *m, uint32_t *seed)
{
    char put[400];
    int a = random_boundary(seed, m), b = random_boundary(seed, m);
    if (a > b) {
        int swap = a;
        a = b;
        b = swap;
    }
    if (random_next(seed) % 3 || b - a == m->bytes)
        b = a; /* mostly put in; never all taken out */
    int bytes = (int)random_text(seed, put, 1 + (int)(random_next(seed) % 6));
    if (m->bytes - (b - a) + bytes > MODEL_BYTES)
        return;
    assert_font(page_text_replace(t, m->id, a, b - a, put, (size_t)bytes));
    for (int i = 0; i < m->notes_count; i++)
        if (m->notes[i] >= b && m->notes[i] > a)
            m->notes[i] += bytes - (b - a);
        else if (m->notes[i] > a)
            m->notes[i] = a;
    uint8_t style = m->styles[a > 0 ? a - 1 : 0];
    memmove(m->text + a + bytes, m->text + b, (size_t)(m->bytes - b));
    memmove(m->styles + a + bytes, m->styles + b, (size_t)(m->bytes - b));
    memcpy(m->text + a, put, (size_t)bytes);
    memset(m->styles + a, style, (size_t)bytes);
    m->bytes += bytes - (b - a);
}

static void model_add(struct page_text *t, struct model *models, int *count, uint32_t *seed)
{
    int at = (int)(random_next(seed) % (uint32_t)(*count + 1));
    memmove(models + at + 1, models + at, (size_t)(*count - at) * sizeof *models);
    struct model *m = &models[at];
    *m = (struct model){.manner = random_manner(seed),
                        .first_style = (int)(random_next(seed) % STYLES)};
    m->text = malloc(MODEL_BYTES + 400);
    m->styles = malloc(MODEL_BYTES + 400);
    m->bytes = (int)random_text(seed, m->text, 3 + (int)(random_next(seed) % 60));
    memset(m->styles, m->first_style, (size_t)m->bytes);
    assert_font(page_paragraph_add(t, 0, at, m->text, (size_t)m->bytes, m->first_style,
                                   &m->manner, &m->id));
    ++*count;
}

static void model_note(struct page_text *t, struct model *m, uint32_t *seed)
{
    if (m->notes_count == NOTES)
        return;
    int byte = random_boundary(seed, m), at = m->notes_count++;
    while (at > 0 && m->notes[at - 1] > byte) {
        m->notes[at] = m->notes[at - 1];
        at--;
    }
    m->notes[at] = byte;
    note_put(t, m->id, byte);
}

static struct page_text *text_from(const struct model *models, int count, bool shaped)
{
    struct page_text *t = text_begin();
    for (int i = 0; i < count; i++) {
        const struct model *m = &models[i];
        int id;
        assert_font(page_paragraph_add(t, 0, -1, m->text, (size_t)m->bytes, m->first_style,
                                       &m->manner, &id));
        for (int begin = 0; begin < m->bytes;) {
            int end = begin;
            while (end < m->bytes && m->styles[end] == m->styles[begin])
                end++;
            assert_font(page_paragraph_style(t, id, begin, end, m->styles[begin]));
            begin = end;
        }
        for (int k = 0; k < m->notes_count; k++)
            note_put(t, id, m->notes[k]);
    }
    columns_set(t, shaped);
    return t;
}

static void model_change(struct page_text *t, struct model *models, int *count, uint32_t *seed)
{
    struct model *m = &models[random_next(seed) % (uint32_t)*count];
    struct font_layout layout;
    uint32_t what = random_next(seed) % 10;
    if (random_next(seed) % 16 == 0)
        model_note(t, m, seed);
    if (what == 0 && *count < MODELS) {
        model_add(t, models, count, seed);
    } else if (what == 1 && *count > 5) {
        assert_font(page_paragraph_remove(t, m->id));
        free(m->text);
        free(m->styles);
        memmove(m, m + 1, (size_t)(&models[*count] - (m + 1)) * sizeof *m);
        --*count;
    } else if (what == 2) {
        m->manner = random_manner(seed);
        assert_font(page_paragraph_manner(t, m->id, &m->manner));
    } else if (what == 3) {
        int a = random_boundary(seed, m), b = random_boundary(seed, m);
        int style = (int)(random_next(seed) % STYLES);
        if (a < b) {
            assert_font(page_paragraph_style(t, m->id, a, b, style));
            memset(m->styles + a, style, (size_t)(b - a));
        }
    } else if (what == 4) { /* seen, somewhere */
        int pages;
        if (random_next(seed) % 2)
            assert_font(page_count(t, &pages));
        if (page_layout(t, (int)(random_next(seed) % 4), &layout) == FONT_OK)
            font_layout_finish(&layout);
    } else {
        model_replace(t, m, seed);
    }
}

static void models_free(struct model *models, int count)
{
    for (int i = 0; i < count; i++) {
        free(models[i].text);
        free(models[i].styles);
    }
}

static void edited_is_as_from_scratch(void **state)
{
    (void)state;
    for (int round = 0; round < 6; round++) {
        static struct model models[MODELS + 1];
        uint32_t seed = 77u + (uint32_t)round * 1000003u;
        bool shaped = round % 2;
        int count = 0;
        struct page_text *t = text_begin();
        columns_set(t, shaped);
        for (int i = 0; i < 12; i++)
            model_add(t, models, &count, &seed);
        for (int turn = 0; turn < 120; turn++) {
            model_change(t, models, &count, &seed);
            if (turn % 12)
                continue;
            struct page_text *fresh = text_from(models, count, shaped);
            pages_compare(t, fresh, turn);
            page_text_destroy(fresh);
        }
        models_free(models, count);
        page_text_destroy(t);
    }
}

/* Each edit is followed by a look at some page, and all other pages are left as they are: runs of 3 to 26 edits, of which each page is
 * compared at the end. LUTETIA_PAGE_RUNS says how many runs; every third has a shape that lines go around. */
static void pages_left_unfilled_are_not_stale(void **state)
{
    (void)state;
    const char *asked = getenv("LUTETIA_PAGE_RUNS");
    int runs = asked ? atoi(asked) : 100;
    for (int run = 0; run < runs; run++) {
        static struct model models[MODELS + 1];
        uint32_t seed = 1234567u + (uint32_t)run * 2654435761u;
        bool shaped = run % 3 == 2;
        int count = 0, pages;
        words_used = run % 30 == 0 ? WORDS : WORDS_NEAR;
        struct page_text *t = text_begin();
        columns_set(t, shaped);
        for (int i = 0; i < 14; i++)
            model_add(t, models, &count, &seed);
        if (run % 2)
            assert_font(page_count(t, &pages));
        for (int edits = 3 + (int)(random_next(&seed) % 24); edits > 0; edits--) {
            struct font_layout layout;
            struct page_place place = {models[random_next(&seed) % (uint32_t)count].id, 0};
            int page;
            model_change(t, models, &count, &seed);
            uint32_t look = random_next(&seed) % 3;
            if (look == 0 && page_layout(t, (int)(random_next(&seed) % 5), &layout) == FONT_OK)
                font_layout_finish(&layout);
            else if (look == 1 && page_find(t, place, &page) == FONT_OK &&
                     page_layout(t, page, &layout) == FONT_OK)
                font_layout_finish(&layout);
        }
        struct page_text *fresh = text_from(models, count, shaped);
        pages_compare(t, fresh, run);
        page_text_destroy(fresh);
        models_free(models, count);
        page_text_destroy(t);
    }
    words_used = WORDS;
}

/* ---- pointing ---- */

static struct page_text *one_column(double width, const char *text, size_t bytes,
                                    const struct page_manner *manner, int *id)
{
    struct page_text *t = text_begin();
    struct page_template page = {.width_px = width + 20, .height_px = 2000, .frames_count = 1};
    page.frames[0] = (struct page_frame){.x = 10, .y = 10, .width = width, .height = 1980};
    assert_font(page_templates_set(t, &page, 1));
    assert_font(page_paragraph_add(t, 0, -1, text, bytes, 1, manner, id));
    return t;
}

/* Hitting a caret's place gives a text place with the same caret; where the direction does not change, the same text place. */
static void carets_and_hits_agree(void **state)
{
    (void)state;
    uint32_t seed = 4711;
    long same = 0, all = 0;
    for (int turn = 0; turn < 150; turn++) {
        char text[1000];
        int id;
        size_t bytes = random_text(&seed, text, 1 + (int)(random_next(&seed) % 25));
        struct page_manner manner = random_manner(&seed);
        manner.begins_column = false;
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

/* Two adjacent selections are together as wide as one selection of both, and a line's boxes do not overlap. */
static void selections_add_up(void **state)
{
    (void)state;
    uint32_t seed = 99;
    for (int turn = 0; turn < 120; turn++) {
        char text[1000];
        int id, count, parts[2];
        size_t bytes = random_text(&seed, text, 2 + (int)(random_next(&seed) % 20));
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
    /* A selection from a Latin word into an Arabic one has two boxes, because Arabic begins at the right. */
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
        cmocka_unit_test(edited_is_as_from_scratch),
        cmocka_unit_test(pages_left_unfilled_are_not_stale),
        cmocka_unit_test(carets_and_hits_agree),
        cmocka_unit_test(places_are_hit_again),
        cmocka_unit_test(selections_add_up),
        cmocka_unit_test(marks_stay_at_their_letters),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
