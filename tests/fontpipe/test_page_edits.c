/* test_page_edits.c - edited texts, with keeps, notes, shapes, tabs, figures and obstacles
 * beside them, against the same texts set from scratch. */
#include "page_texts.h"

#include <stdlib.h>
#include <string.h>

static const double diamond[] = {200, 80, 280, 180, 200, 280, 120, 180};

static bool besides;   /* the run has some */
static double grid_px; /* of the frames of the run; paragraphs' leading is 18 */

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
    page.frames[0].grid_px = grid_px;
    page.frames[1] = page.frames[0];
    page.frames[1].x = 210;
    page.shapes_count = shaped;
    page.shapes[0] = (struct page_shape){
        .points = diamond, .points_count = 4, .distance_px = 5, .least_px = 40};
    assert_font(page_templates_set(t, &page, 1));
}

enum { NOTES = 3, BESIDES = 2 };

struct model {
    int id;
    char *text;
    int bytes, first_style;
    uint8_t *styles; /* of each byte */
    struct page_manner manner;
    int notes[NOTES], notes_count; /* where: each says the word of its number */
    uint32_t besides[BESIDES];     /* what stands beside it, by a number each */
    int besides_count;
    uint32_t obstacle; /* 0: none */
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

/* What stands beside a paragraph, made of a number: at either side, round or not. */
static void beside_put(struct page_text *t, int id, uint32_t number)
{
    static const char text[] = "beside of it some words";
    struct page_manner manner = page_manner_default();
    struct page_row rows[9];
    struct page_beside beside = {.side = number % 2 ? PAGE_SIDE_LEFT : PAGE_SIDE_RIGHT,
                                 .width_px = 40 + number % 50,
                                 .gap_px = number % 7,
                                 .least_px = 50,
                                 .rows = rows,
                                 .rows_count = number % 3 ? 0 : 9};
    int beside_id;
    for (int i = 0; i < 9; i++)
        rows[i] = (struct page_row){i, beside.width_px - 3 * i};
    manner.before_px = number % 5;
    assert_font(page_beside_add(t, id, &beside, text, sizeof text - 1, 0, &manner, &beside_id));
}

static void obstacle_put(struct page_text *t, int id, uint32_t number)
{
    const struct page_row rows[3] = {{0, 30 + number % 20}, {5, 60}, {20, 10}};
    const struct page_obstacle obstacle = {.x_px = number % 140,
                                           .y_px = number % 60,
                                           .height_px = 30 + number % 90,
                                           .gap_px = 4,
                                           .least_px = 40,
                                           .rows = rows,
                                           .rows_count = 3};
    assert_font(page_obstacles_set(t, id, &obstacle, number ? 1 : 0));
}

static void model_beside(struct page_text *t, struct model *m, uint32_t *seed)
{
    if (random_next(seed) % 2) {
        m->obstacle = m->obstacle ? 0 : random_next(seed);
        obstacle_put(t, m->id, m->obstacle);
    } else if (m->besides_count < BESIDES) {
        m->besides[m->besides_count++] = random_next(seed);
        beside_put(t, m->id, m->besides[m->besides_count - 1]);
    }
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
    int bytes = (int)page_random_text(seed, put, 1 + (int)(random_next(seed) % 6));
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
    *m = (struct model){.manner = page_random_manner(seed),
                        .first_style = (int)(random_next(seed) % PAGE_STYLES)};
    m->text = malloc(MODEL_BYTES + 400);
    m->styles = malloc(MODEL_BYTES + 400);
    m->bytes = (int)page_random_text(seed, m->text, 3 + (int)(random_next(seed) % 60));
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
    struct page_text *t = page_text_begin();
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
        for (int k = 0; k < m->besides_count; k++)
            beside_put(t, id, m->besides[k]);
        if (m->obstacle)
            obstacle_put(t, id, m->obstacle);
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
    if (besides && random_next(seed) % 12 == 0)
        model_beside(t, m, seed);
    if (what == 0 && *count < MODELS) {
        model_add(t, models, count, seed);
    } else if (what == 1 && *count > 5) {
        assert_font(page_paragraph_remove(t, m->id));
        free(m->text);
        free(m->styles);
        memmove(m, m + 1, (size_t)(&models[*count] - (m + 1)) * sizeof *m);
        --*count;
    } else if (what == 2) {
        m->manner = page_random_manner(seed);
        assert_font(page_paragraph_manner(t, m->id, &m->manner));
    } else if (what == 3) {
        int a = random_boundary(seed, m), b = random_boundary(seed, m);
        int style = (int)(random_next(seed) % PAGE_STYLES);
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
        grid_px = round % 3 == 2 ? 18 : 0;
        besides = round >= 3;
        int count = 0;
        struct page_text *t = page_text_begin();
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

/* Each edit is followed by a look at some page, and all other pages are left as they are: runs
 * of 3 to 26 edits, of which each page is compared at the end. LUTETIA_PAGE_RUNS says how many
 * runs; every third has a shape that lines go around. */
static void pages_left_unfilled_are_not_stale(void **state)
{
    (void)state;
    const char *asked = getenv("LUTETIA_PAGE_RUNS");
    const uint32_t all = page_words_used;
    int runs = asked ? atoi(asked) : 100;
    for (int run = 0; run < runs; run++) {
        static struct model models[MODELS + 1];
        uint32_t seed = 1234567u + (uint32_t)run * 2654435761u;
        bool shaped = run % 3 == 2;
        grid_px = run % 4 == 3 ? 18 : 0;
        besides = run % 5 >= 3;
        int count = 0, pages;
        page_words_used = run % 30 == 0 ? all : PAGE_WORDS_NEAR;
        struct page_text *t = page_text_begin();
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
    page_words_used = all;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(edited_is_as_from_scratch),
        cmocka_unit_test(pages_left_unfilled_are_not_stale),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
