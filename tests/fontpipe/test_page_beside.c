/* test_page_beside.c - what stands beside paragraphs, and obstacles: lines keep away from them,
 * each paragraph stands somewhere, and nothing stands on anything else. */
#include "page_texts.h"

#include <math.h>
#include <string.h>

enum { PARAGRAPHS = 14, BOXES = 400, FIGURES = 8 };

struct figure {
    int id, owner;
    struct page_beside beside;
};

static const double gap = 6, least = 70;

static struct page_template columns(double width, double height, int count)
{
    struct page_template page = {
        .width_px = 60 + count * (width + 20), .height_px = height + 40, .frames_count = count};
    for (int i = 0; i < count; i++)
        page.frames[i] = (struct page_frame){.x = 30 + i * (width + 20),
                                             .y = 20,
                                             .width = width,
                                             .height = height,
                                             .foot_gap_px = 8};
    return page;
}

static int paragraph_put(struct page_text *t, uint32_t *seed, int words)
{
    char text[6000];
    struct page_manner manner = page_manner_default();
    int id;
    const int bytes = (int)page_random_text(seed, text, words);
    manner.align = random_next(seed) % 2 ? FONT_ALIGN_JUSTIFY : FONT_ALIGN_START;
    manner.leading_px = random_next(seed) % 2 ? 18 : 0;
    manner.left_px = (double)(random_next(seed) % 3) * 10;
    manner.keep_with_next = random_next(seed) % 6 == 0;
    manner.below = random_next(seed) % 8 == 0;
    assert_font(page_paragraph_add(t, 0, -1, text, (size_t)bytes,
                                   (int)(random_next(seed) % PAGE_STYLES), &manner, &id));
    return id;
}

static void figure_put(struct page_text *t, uint32_t *seed, int owner, double column,
                       struct figure *f)
{
    char text[400];
    struct page_manner manner = page_manner_default();
    const int bytes = (int)page_random_text(seed, text, 2 + (int)(random_next(seed) % 12));
    *f = (struct figure){.owner = owner};
    f->beside = (struct page_beside){
        .side = random_next(seed) % 2 ? PAGE_SIDE_LEFT : PAGE_SIDE_RIGHT,
        .width_px = 30 + floor(random_unit(seed) * (column - least - gap - 60)),
        .gap_px = gap,
        .least_px = least};
    manner.before_px = 3;
    manner.after_px = 4;
    assert_font(page_beside_add(t, owner, &f->beside, text, (size_t)bytes, 0, &manner, &f->id));
}

/* The boxes of a paragraph's letters on a page. */
static int boxes_of(struct page_text *t, int id, int page, struct page_box *boxes)
{
    size_t bytes;
    int count;
    page_paragraph_text(t, id, &bytes);
    assert_font(page_select(t, (struct page_place){id, 0}, (struct page_place){id, (int)bytes},
                            page, boxes, BOXES, &count));
    assert_true(count <= BOXES);
    return count;
}

static bool apart(const struct page_box *a, const struct page_box *b, double by)
{
    const double near = 0.02;
    return a->x + a->width + by <= b->x + near || b->x + b->width + by <= a->x + near ||
           a->y + a->height <= b->y + near || b->y + b->height <= a->y + near;
}

/* All boxes of a page are apart, and those of lines keep the gap from figures. */
static void page_is_apart(struct page_text *t, int page, const int *ids, int count,
                          const struct figure *figures, int figures_count, int turn)
{
    static struct page_box boxes[BOXES * 8];
    static int of[BOXES * 8];
    int all = 0;
    for (int i = 0; i < count + figures_count && all + BOXES < BOXES * 8; i++) {
        const int n =
            boxes_of(t, i < count ? ids[i] : figures[i - count].id, page, boxes + all);
        for (int k = 0; k < n; k++)
            of[all + k] = i;
        all += n;
    }
    for (int a = 0; a < all; a++)
        for (int b = 0; b < a; b++) {
            const bool beside = (of[a] >= count) != (of[b] >= count);
            if (of[a] != of[b] && !apart(&boxes[a], &boxes[b], beside ? gap : 0))
                fail_msg("turn %d, page %d: paragraph %d at %g, %g, %gx%g stands on %d at %g, "
                         "%g, %gx%g",
                         turn, page, of[a], boxes[a].x, boxes[a].y, boxes[a].width,
                         boxes[a].height, of[b], boxes[b].x, boxes[b].y, boxes[b].width,
                         boxes[b].height);
        }
}

/* A figure begins on its paragraph's page, at its side, and not above it. */
static void figure_is_placed(struct page_text *t, const struct figure *f,
                             const struct page_template *page, int turn)
{
    struct page_caret own, owner;
    int number, other;
    assert_font(page_find(t, (struct page_place){f->id, 0}, &number));
    assert_font(page_find(t, (struct page_place){f->owner, 0}, &other));
    if (number != other)
        fail_msg("turn %d: a figure is on page %d, its paragraph on %d", turn, number, other);
    assert_font(page_caret_get(t, (struct page_place){f->id, 0}, false, &own));
    assert_font(page_caret_get(t, (struct page_place){f->owner, 0}, false, &owner));
    bool found = false;
    for (int i = 0; i < page->frames_count; i++) {
        const struct page_frame *frame = &page->frames[i];
        const double x = f->beside.side == PAGE_SIDE_LEFT
                             ? frame->x
                             : frame->x + frame->width - f->beside.width_px;
        found = found || (own.x0 >= x - 0.1 && own.x0 <= x + f->beside.width_px + 0.1);
    }
    if (!found)
        fail_msg("turn %d: a figure stands at %g, which is no side", turn, own.x0);
}

static void lines_flow_around_figures(void **state)
{
    (void)state;
    for (int turn = 0; turn < 60; turn++) {
        uint32_t seed = 4711u + (uint32_t)turn * 2654435761u;
        struct figure figures[FIGURES];
        int ids[PARAGRAPHS], count = 0, pages;
        const double width = 220 + (double)(random_next(&seed) % 300);
        const struct page_template page =
            columns(width, 300 + (double)(random_next(&seed) % 400), 1 + turn % 2);
        struct page_text *t = page_text_begin();
        page_words_used = PAGE_WORDS_NEAR;
        for (int i = 0; i < PARAGRAPHS; i++) {
            ids[i] = paragraph_put(t, &seed, 1 + (int)(random_next(&seed) % 90));
            for (int n = (int)(random_next(&seed) % 3); n > 0 && count < FIGURES; n--)
                if (random_next(&seed) % 2)
                    figure_put(t, &seed, ids[i], width, &figures[count++]);
        }
        assert_font(page_templates_set(t, &page, 1));
        assert_font(page_count(t, &pages));
        for (int k = 0; k < pages; k++)
            page_is_apart(t, k, ids, PARAGRAPHS, figures, count, turn);
        for (int i = 0; i < count; i++)
            figure_is_placed(t, &figures[i], &page, turn);
        for (int i = 0; i < PARAGRAPHS; i++) {
            int number;
            assert_font(page_find(t, (struct page_place){ids[i], 0}, &number));
        }
        page_text_destroy(t);
    }
}

/* A round obstacle in the middle: lines go on at its other side, none of their letters is in
 * it, and those at its corners are longer than those at its middle. */
static void lines_flow_around_obstacles(void **state)
{
    (void)state;
    enum { ROWS = 60 };
    const double width = 500, x = 150, y = 40, side = 180;
    const struct page_template page = columns(width, 600, 1);
    struct page_row rows[ROWS];
    struct page_obstacle obstacle = {.x_px = x,
                                     .y_px = y,
                                     .height_px = side,
                                     .gap_px = 5,
                                     .least_px = 40,
                                     .rows = rows,
                                     .rows_count = ROWS};
    struct page_box boxes[BOXES];
    uint32_t seed = 99;
    int left = 0, right = 0;
    for (int i = 0; i < ROWS; i++) {
        const double up = 2 * (i + 0.5) / ROWS - 1, reach = side / 2 * sqrt(1 - up * up);
        rows[i] = (struct page_row){side / 2 - reach, side / 2 + reach};
    }
    struct page_text *t = page_text_begin();
    page_words_used = PAGE_WORDS_NEAR;
    const int first = paragraph_put(t, &seed, 60), second = paragraph_put(t, &seed, 200);
    const struct page_manner plain = page_manner_default();
    assert_font(page_paragraph_manner(t, first, &plain));
    assert_font(page_templates_set(t, &page, 1));
    assert_font(page_obstacles_set(t, first, &obstacle, 1));
    for (int p = 0; p < 2; p++) {
        const int count = boxes_of(t, p ? second : first, 0, boxes);
        for (int i = 0; i < count; i++) {
            const struct page_box *b = &boxes[i];
            const double cx = 30 + x + side / 2, cy = 20 + y + side / 2;
            const double dx = fmax(0, fmax(b->x - cx, cx - b->x - b->width)),
                         dy = fmax(0, fmax(b->y - cy, cy - b->y - b->height));
            if (hypot(dx, dy) < side / 2 - 1)
                fail_msg("a line at %g, %g, %gx%g is in the circle", b->x, b->y, b->width,
                         b->height);
            left += b->x + b->width < cx && fabs(b->y - cy) < side / 2;
            right += b->x > cx && fabs(b->y - cy) < side / 2;
        }
    }
    assert_true(left >= 5 && right >= 5);
    assert_font(page_obstacles_set(t, first, NULL, 0)); /* and without it, lines are whole */
    const int count = boxes_of(t, first, 0, boxes);
    for (int i = 1; i < count; i++)
        assert_true(boxes[i].y > boxes[i - 1].y - 1e-6);
    page_text_destroy(t);
}

static void what_is_no_box_is_refused(void **state)
{
    (void)state;
    struct page_text *t = page_text_begin();
    const struct page_manner manner = page_manner_default();
    const struct page_row row = {0, NAN};
    const struct page_beside bad[] = {{.width_px = 0},
                                      {.width_px = NAN},
                                      {.width_px = 50, .gap_px = -1},
                                      {.width_px = 50, .least_px = NAN},
                                      {.width_px = 50, .rows = &row, .rows_count = 1},
                                      {.width_px = 50, .rows_count = 1},
                                      {.width_px = 50, .rows = &row, .rows_count = -1}};
    const struct page_obstacle none = {.height_px = 10}, flat = {.rows = &row, .rows_count = 1};
    int id, other;
    assert_font(page_paragraph_add(t, 0, -1, "text", 4, 0, &manner, &id));
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        assert_int_equal(page_beside_add(t, id, &bad[i], "a", 1, 0, &manner, &other),
                         FONT_BAD_ARGUMENT);
    const struct page_beside good = {.width_px = 50};
    assert_int_equal(page_beside_add(t, id + 7, &good, "a", 1, 0, &manner, &other),
                     FONT_BAD_ARGUMENT);
    assert_font(page_beside_add(t, id, &good, "a", 1, 0, &manner, &other));
    assert_int_equal(page_beside_add(t, other, &good, "a", 1, 0, &manner, &other),
                     FONT_BAD_ARGUMENT);
    assert_int_equal(page_obstacles_set(t, id, &none, 1), FONT_BAD_ARGUMENT);
    assert_int_equal(page_obstacles_set(t, id, &flat, 1), FONT_BAD_ARGUMENT);
    assert_int_equal(page_obstacles_set(t, id + 7, NULL, 0), FONT_BAD_ARGUMENT);
    page_text_destroy(t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_flow_around_figures),
        cmocka_unit_test(lines_flow_around_obstacles),
        cmocka_unit_test(what_is_no_box_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
