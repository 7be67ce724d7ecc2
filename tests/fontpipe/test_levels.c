/* test_levels.c - master, rectangles and edits of levels: an edit makes the levels that depend
 * on it again, and no others. */
#include "support.h"

#include <gold.h>
#include <levels.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void outline_load(const char *font, uint32_t character, struct font_outline *o)
{
    struct font_face *face = face_open(font);
    assert_font(font_face_outline(face, font_face_glyph(face, character), o));
    font_face_close(face);
}

/* A pixel of the master is black if its centre is inside. */
static void masters_are_what_is_inside(void **state)
{
    (void)state;
    struct font_outline o;
    struct font_master m = {0};
    long wrong = 0, points = 0;
    outline_load("EBGaramond12-Italic", '&', &o);
    assert_font(font_master_make(&m, &o, 220));
    double scale = 220 / o.units_per_em;
    for (int y = m.top_px - 2; y < m.top_px + m.height_px + 2; y += 3)
        for (int x = m.left_px - 2; x < m.left_px + m.width_px + 2; x++) {
            double px = (x + 0.5) / scale, py = -(y + 0.5) / scale;
            int winding = 0;
            for (int i = 0; i < o.segments_count; i++) {
                struct font_point a = o.segments[i].p[0];
                for (int k = 1; k <= 32; k++) {
                    struct font_point b = font_segment_at(&o.segments[i], k / 32.0, NULL);
                    if ((a.y <= py) != (b.y <= py) &&
                        a.x + (b.x - a.x) * ((py - a.y) / (b.y - a.y)) < px)
                        winding += b.y > a.y ? 1 : -1;
                    a = b;
                }
            }
            points++;
            wrong += font_master_at(&m, x, y) != (winding != 0);
        }
    assert_true(wrong * 2000 <= points); /* those on the edge itself */
    font_master_finish(&m);
    font_outline_finish(&o);
}

/* Rectangles cover each black pixel once and no white one, and are as many as in the thesis. */
static void rectangles_are_the_master(void **state)
{
    (void)state;
    struct font_face *face = face_open("DejaVuSans");
    long count = 0;
    struct font_master m = {0}, again = {0};
    struct font_rectangles r = {0};
    for (uint32_t c = 33; c < 127; c++) {
        struct font_outline o;
        assert_font(font_face_outline(face, font_face_glyph(face, c), &o));
        assert_font(font_master_make(&m, &o, 860));
        assert_font(font_rectangles_make(&r, &m));
        count += r.count;
        if (c % 7 == 0) {
            long area = 0;
            assert_font(font_master_make(&again, &o, 860));
            memset(again.bits, 0,
                   sizeof(uint64_t) * (size_t)again.row_words * (size_t)again.height_px);
            for (int i = 0; i < r.count; i++) {
                struct font_rectangle q = r.items[i];
                area += (long)(q.x1 - q.x0) * (q.y1 - q.y0);
                font_master_fill(&again, q.x0, q.y0, q.x1 - q.x0, q.y1 - q.y0, true);
            }
            assert_int_equal(area, font_master_ink(&m));
            assert_memory_equal(again.bits, m.bits,
                                sizeof(uint64_t) * (size_t)m.row_words * (size_t)m.height_px);
        }
        font_outline_finish(&o);
    }
    print_message("%.0f rectangles a glyph\n", (double)count / 94);
    assert_true(count / 94 >= 300 && count / 94 <= 400);
    font_rectangles_finish(&r);
    font_master_finish(&m);
    font_master_finish(&again);
    font_face_close(face);
}

static double gray_difference(const struct font_gray *a, const struct font_gray *b)
{
    double worst = 0;
    for (int y = -40; y < 20; y++)
        for (int x = -10; x < 50; x++) {
            int v[2] = {0, 0};
            for (int n = 0; n < 2; n++) {
                const struct font_gray *g = n ? b : a;
                int c = x - g->left_px, r = y - g->top_px;
                if (c >= 0 && r >= 0 && c < g->width_px && r < g->height_px)
                    v[n] = g->pixels[r * g->pitch + c];
            }
            worst = fmax(worst, abs(v[0] - v[1]));
        }
    return worst;
}

/* A copy of gray that stays valid when the levels draw again. */
static struct font_gray gray_copy(const struct font_gray *g)
{
    struct font_gray copy = *g;
    size_t bytes = (size_t)g->pitch * (size_t)g->height_px;
    copy.pixels = malloc(bytes);
    memcpy(copy.pixels, g->pixels, bytes);
    return copy;
}

/* Counts rectangles by a plain loop over pixels: a run of a row begins a rectangle if the row
 * above has no such run. */
static int cuts_count(const struct font_master *m, bool columns)
{
    int count = 0, along = columns ? m->height_px : m->width_px,
        across = columns ? m->width_px : m->height_px;
#define BLACK(i, k)                                                                            \
    (columns ? font_master_at(m, m->left_px + (k), m->top_px + (i))                            \
             : font_master_at(m, m->left_px + (i), m->top_px + (k)))
    for (int k = 0; k < across; k++)
        for (int i = 0, end; i < along; i = end + 1) {
            bool same = !BLACK(i - 1, k - 1);
            for (end = i; end < along && BLACK(end, k); end++)
                same = same && BLACK(end, k - 1);
            count += end > i && !(same && !BLACK(end, k - 1));
        }
#undef BLACK
    return count;
}

/* The master is cut into rows or columns, whichever gives fewer rectangles. The masters are
 * noise in blocks, of odd sizes and across word boundaries. */
static void masters_are_cut_the_better_way(void **state)
{
    (void)state;
    uint32_t random = 20260;
    struct font_rectangles r = {0};
    int ways[2] = {0, 0};
    for (int n = 0; n < 200; n++) {
        int width = 1 + (int)(random_next(&random) % 200),
            height = 1 + (int)(random_next(&random) % 60);
        struct font_master m = {.em_px = 100,
                                .left_px = -7,
                                .top_px = 5,
                                .width_px = width,
                                .height_px = height,
                                .row_words = (width + 63) / 64};
        size_t bytes = (size_t)m.row_words * (size_t)height * sizeof *m.bits;
        m.bits = calloc(1, bytes);
        uint64_t *once = calloc(1, bytes);
        assert_true(m.bits && once);
        for (int i = 0; i < 20; i++)
            font_master_fill(&m, (int)(random_next(&random) % (uint32_t)width) - 7,
                             (int)(random_next(&random) % (uint32_t)height) + 5,
                             1 + (int)(random_next(&random) % 70),
                             1 + (int)(random_next(&random) % 20), random_next(&random) % 3);
        assert_font(font_rectangles_make(&r, &m));
        int rows = cuts_count(&m, false), columns = cuts_count(&m, true);
        assert_int_equal(r.count, columns < rows ? columns : rows);
        assert_int_equal(r.columns, columns < rows);
        ways[r.columns]++;
        long area = 0;
        struct font_master covered = m;
        covered.bits = once;
        for (int i = 0; i < r.count; i++) {
            struct font_rectangle q = r.items[i];
            area += (long)(q.x1 - q.x0) * (q.y1 - q.y0);
            font_master_fill(&covered, q.x0, q.y0, q.x1 - q.x0, q.y1 - q.y0, true);
        }
        assert_int_equal(area, font_master_ink(&m));
        assert_memory_equal(once, m.bits, bytes);
        free(once);
        font_master_finish(&m);
    }
    assert_true(ways[0] > 20 && ways[1] > 20);
    font_rectangles_finish(&r);
}

/* Rectangles are merged, and one is moved. */
static void rectangles_edit(struct font_levels *l)
{
    const struct font_gray *gray;
    assert_font(font_levels_gray(l, 0.2, 0.4, &gray));
    int gone;
    const struct font_rectangles *r;
    assert_font(font_levels_rectangles(l, &r));
    int before = r->count;
    assert_font(font_levels_rectangles_merge(l, 1, &gone));
    assert_true(gone > before / 4 && r->count == before - gone);
    struct font_gray retouched = gray_copy(gray);
    assert_font(font_levels_gray(l, 0.2, 0.4, &gray));
    assert_true(gray_difference(gray, &retouched) <= 6);
    struct font_rectangle moved = r->items[0];
    moved.x1 += 300;
    moved.y1 += 60;
    assert_font(font_levels_rectangle_set(l, 0, moved));
    assert_font(font_levels_gray(l, 0.2, 0.4, &gray));
    assert_true(gray_difference(gray, &retouched) > 50);
    assert_int_equal(font_levels_rectangle_set(l, 1 << 20, moved), FONT_BAD_ARGUMENT);
    free(retouched.pixels);
}

static void refusals_change_nothing(struct font_levels *l)
{
    const struct font_gray *gray;
    struct font_levels_made made, after;
    font_levels_made_get(l, &made);
    assert_int_equal(font_levels_filter_set(l, "no such"), FONT_BAD_ARGUMENT);
    assert_int_equal(font_levels_size_set(l, NAN), FONT_BAD_ARGUMENT);
    assert_int_equal(font_levels_size_set(l, -3), FONT_BAD_ARGUMENT);
    assert_int_equal(font_levels_master_em_set(l, 0), FONT_BAD_ARGUMENT);
    assert_font(font_levels_gray(l, 0.2, 0.4, &gray));
    font_levels_made_get(l, &after);
    assert_memory_equal(&made, &after, sizeof made);
}

static void edits_flow_down_and_no_further(void **state)
{
    (void)state;
    struct font_outline o;
    struct font_levels *l;
    const struct font_gray *gray;
    struct font_levels_made made;
    outline_load("DejaVuSans", 'B', &o);
    assert_font(font_levels_create(&o, 1000, 24, "gaussian-fast", &l));

    /* Gray is drawn straight from the outline, and the same place is not drawn again. */
    assert_font(font_levels_gray(l, 0.2, 0.4, &gray));
    assert_font(font_levels_gray(l, 0.2, 0.4, &gray));
    struct font_gray exact = gray_copy(gray);
    font_levels_made_get(l, &made);
    assert_true(made.masters == 0 && made.rectangles == 0 && made.edges == 1 &&
                made.grays == 1);

    /* The thesis's way, by a master of 40 pixels to one, within the master's precision. */
    font_levels_use_master(l, true);
    assert_font(font_levels_gray(l, 0.2, 0.4, &gray));
    assert_true(gray_difference(gray, &exact) <= 4);
    struct font_gray from_master = gray_copy(gray);
    font_levels_made_get(l, &made);
    assert_true(made.masters == 1 && made.rectangles == 1 && made.edges == 2 &&
                made.grays == 2);

    /* Another filter makes only gray again; another size makes edges and gray. */
    assert_font(font_levels_filter_set(l, "cone"));
    assert_font(font_levels_gray(l, 0.2, 0.4, &gray));
    assert_true(gray_difference(gray, &from_master) > 4);
    font_levels_made_get(l, &made);
    assert_true(made.masters == 1 && made.rectangles == 1 && made.edges == 2 &&
                made.grays == 3);
    assert_font(font_levels_size_set(l, 30));
    assert_font(font_levels_gray(l, 0.2, 0.4, &gray));
    assert_font(font_levels_size_set(l, 24));
    assert_font(font_levels_filter_set(l, "gaussian-fast"));
    assert_font(font_levels_gray(l, 0.2, 0.4, &gray));
    assert_true(gray_difference(gray, &from_master) == 0);
    font_levels_made_get(l, &made);
    assert_true(made.masters == 1 && made.rectangles == 1 && made.edges == 4 &&
                made.grays == 5);

    /* Retouching the master makes its rectangles again, but not the master. */
    const struct font_master *m;
    assert_font(font_levels_master(l, &m));
    long ink = font_master_ink(m);
    assert_font(font_levels_master_fill(l, 230, -620, 160, 140, true));
    assert_true(font_master_ink(m) > ink);
    font_levels_use_master(l, false); /* an edited master is used all the same */
    assert_font(font_levels_gray(l, 0.2, 0.4, &gray));
    assert_true(gray_difference(gray, &from_master) > 100);
    font_levels_made_get(l, &made);
    assert_true(made.masters == 1 && made.rectangles == 2);

    rectangles_edit(l);

    /* Setting the outline again drops the edits. */
    assert_font(font_levels_outline_set(l, &o));
    assert_font(font_levels_gray(l, 0.2, 0.4, &gray));
    assert_true(gray_difference(gray, &exact) == 0);

    refusals_change_nothing(l);

    free(exact.pixels);
    free(from_master.pixels);
    font_levels_destroy(l);
    font_outline_finish(&o);
}

static void fine_masters_are_nearly_exact(void **state)
{
    (void)state;
    struct font_outline o;
    struct font_levels *l;
    outline_load("DejaVuSans", 'g', &o);
    const struct font_gray *gray;
    struct font_map map = font_map_size(12.25, o.units_per_em);
    assert_font(font_levels_create(&o, 1000, 12.25, "gaussian-fast", &l));
    font_levels_use_master(l, true);
    assert_font(font_levels_gray(l, 0.3, 0.6, &gray));
    int w = gray->width_px, h = gray->height_px;
    double *gold = malloc(sizeof(double) * (size_t)w * (size_t)h);
    struct font_difference d = {0};
    assert_font(font_gold_draw(&o, &map, font_levels_filter(l), 0.3, 0.6, gray->left_px,
                               gray->top_px, w, h, gold));
    font_gold_compare(gray, false, gray->left_px, gray->top_px, w, h, gold, &d);
    assert_true(d.max < 2);
    free(gold);
    font_levels_destroy(l);
    font_outline_finish(&o);
}

/* A master is written as a picture, retouched there and read again. It differs only where it
 * was retouched, and the levels below are made from it. */
static void masters_are_retouched_as_pictures(void **state)
{
    (void)state;
    enum { MARGIN = 7 };
    struct font_outline o;
    struct font_levels *l;
    const struct font_master *m;
    const struct font_gray *gray;
    struct font_levels_made made;
    struct font_master read = {0};
    outline_load("EBGaramond12-Italic", 'k', &o);
    assert_font(font_levels_create(&o, 500, 24, "gaussian-fast", &l));
    font_levels_use_master(l, true);
    assert_font(font_levels_gray(l, 0, 0, &gray));
    struct font_gray before = gray_copy(gray);
    assert_font(font_levels_master(l, &m));
    struct font_master_frame frame = {m->em_px,
                                      m->left_px - MARGIN,
                                      m->top_px - MARGIN,
                                      m->width_px + 2 * MARGIN,
                                      m->height_px + 2 * MARGIN,
                                      m->advance_px};
    uint8_t *picture = malloc((size_t)frame.width_px * (size_t)frame.height_px);
    assert_non_null(picture);
    font_master_to_picture(m, MARGIN, picture);
    assert_font(font_master_from_picture(&read, &frame, picture));
    assert_int_equal(font_master_differs(m, &read), 0);
    assert_int_equal(font_master_ink(m), font_master_ink(&read));
    assert_font(font_levels_master_set(l, &read));
    assert_font(font_levels_gray(l, 0, 0, &gray));
    assert_int_equal(gray_difference(gray, &before), 0);
    /* The picture gets ink in its margin, beyond the master's box. */
    for (int r = 0; r < 40; r++)
        memset(picture + (size_t)r * (size_t)frame.width_px, 20, 40);
    assert_font(font_master_from_picture(&read, &frame, picture));
    assert_true(font_master_at(&read, frame.left_px, frame.top_px));
    assert_int_equal(font_master_differs(m, &read),
                     font_master_ink(&read) - font_master_ink(m));
    font_levels_use_master(l, false); /* an edited master is used all the same */
    assert_font(font_levels_master_set(l, &read));
    assert_font(font_levels_gray(l, 0, 0, &gray));
    assert_true(gray->width_px >= before.width_px && gray->pixels[2 * gray->pitch + 2] > 50);
    font_levels_made_get(l, &made);
    assert_true(made.masters == 1 && made.rectangles == 3 && made.filters == 1);
    /* Wrong arguments. */
    frame.em_px = 0;
    assert_int_equal(font_master_from_picture(&read, &frame, picture), FONT_BAD_ARGUMENT);
    assert_int_equal(font_levels_master_set(l, &read), FONT_BAD_ARGUMENT);
    free(before.pixels);
    free(picture);
    font_levels_destroy(l);
    font_outline_finish(&o);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(masters_are_what_is_inside),
        cmocka_unit_test(rectangles_are_the_master),
        cmocka_unit_test(masters_are_cut_the_better_way),
        cmocka_unit_test(edits_flow_down_and_no_further),
        cmocka_unit_test(masters_are_retouched_as_pictures),
        cmocka_unit_test(fine_masters_are_nearly_exact),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
