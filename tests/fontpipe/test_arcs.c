/* test_arcs.c - some filters have faster code of their own. Compares it with the general code,
 * which draws the same edges by tables: letters and random outlines at any place, size, angle
 * and distortion, with all instruction sets. */
#include "support.h"

#include <gray.h>

#include <math.h>
#include <stdlib.h>

static const char *const filters[] = {"box",         "pillbox", "pillbox:1.3",
                                      "pillbox:2.4", "cone",    "cone:0.8"};
static const char *const faces[] = {"DejaVuSans", "EBGaramond12-Italic", "C059-Roman.otf"};
enum { FILTERS = sizeof filters / sizeof *filters, FACES = 3, LETTERS = 94 };

struct fixture {
    struct font_filter *filter[FILTERS];
    struct font_outline letters[FACES][LETTERS];
    double units[FACES];
};

static int fixture_make(void **state)
{
    static struct fixture f;
    for (int i = 0; i < FILTERS; i++)
        f.filter[i] = filter_make(filters[i]);
    for (int i = 0; i < FACES; i++) {
        struct font_face *face = face_open(faces[i]);
        struct font_face_info info;
        font_face_describe(face, &info);
        f.units[i] = info.units_per_em;
        for (int k = 0; k < LETTERS; k++)
            assert_font(font_face_outline(face, font_face_glyph(face, 33 + (uint32_t)k),
                                          &f.letters[i][k]));
        font_face_close(face);
    }
    *state = &f;
    return 0;
}

static int fixture_destroy(void **state)
{
    struct fixture *f = *state;
    for (int i = 0; i < FILTERS; i++)
        font_filter_destroy(f->filter[i]);
    for (int i = 0; i < FACES; i++)
        for (int k = 0; k < LETTERS; k++)
            font_outline_finish(&f->letters[i][k]);
    return 0;
}

static int pixel(const struct font_gray *g, int x, int y)
{
    x -= g->left_px;
    y -= g->top_px;
    return x < 0 || y < 0 || x >= g->width_px || y >= g->height_px
               ? 0
               : g->pixels[y * g->pitch + x];
}

/* The largest difference between two pictures, which may cover different areas. */
static int difference(const struct font_gray *a, const struct font_gray *b)
{
    int worst = 0;
    int left = a->left_px < b->left_px ? a->left_px : b->left_px;
    int top = a->top_px < b->top_px ? a->top_px : b->top_px;
    int right_a = a->left_px + a->width_px, right_b = b->left_px + b->width_px;
    int bottom_a = a->top_px + a->height_px, bottom_b = b->top_px + b->height_px;
    for (int y = top; y < (bottom_a > bottom_b ? bottom_a : bottom_b); y++)
        for (int x = left; x < (right_a > right_b ? right_a : right_b); x++) {
            int d = abs(pixel(a, x, y) - pixel(b, x, y));
            worst = d > worst ? d : worst;
        }
    return worst;
}

struct pictures {
    struct font_edges fast, slow;
    struct font_gray fast_gray, slow_gray;
};

/* Draws both ways; fails where they differ by more than 1 of 255. */
static int compare(struct pictures *p, const struct font_outline *o, const struct font_map *map,
                   const struct font_filter *filter, double x, double y)
{
    assert_font(font_edges_build(&p->fast, o, map, filter));
    assert_font(font_edges_build_tabled(&p->slow, o, map, filter));
    assert_int_equal(p->slow.arcs_count, 0);
    assert_font(font_gray_draw(&p->fast_gray, &p->fast, filter, x, y));
    assert_font(font_gray_draw(&p->slow_gray, &p->slow, filter, x, y));
    return difference(&p->fast_gray, &p->slow_gray);
}

static void pictures_finish(struct pictures *p)
{
    font_edges_finish(&p->fast);
    font_edges_finish(&p->slow);
    font_gray_finish(&p->fast_gray);
    font_gray_finish(&p->slow_gray);
}

static struct font_map map_random(uint32_t *random, double size_px, double units)
{
    struct font_map map = font_map_size(size_px, units);
    uint32_t kind = random_next(random) % 8;
    if (kind == 0)
        map = font_map_then(map, font_map_rotation(90 * (double)(random_next(random) % 4)));
    else if (kind < 3)
        map = font_map_then(map, font_map_rotation(360 * random_unit(random)));
    else if (kind == 3)
        map = font_map_then(map, font_map_shear(random_unit(random) - 0.5));
    else if (kind == 4) { /* mirrored */
        struct font_map mirror = {FONT_AFFINE, {-1, 0, 0, 0, 1, 0}};
        map = font_map_then(map, mirror);
    } else if (kind == 5) {
        double s = size_px, lean = 0.3 * random_unit(random);
        const struct font_point corners[4] = {
            {lean * s, 0}, {(1.4 - lean / 2) * s, 0.25 * s}, {1.3 * s, 1.3 * s}, {0, 1.1 * s}};
        struct font_map warp;
        assert_font(font_map_corners(random_next(random) % 2 ? FONT_PROJECTIVE : FONT_BILINEAR,
                                     -0.2 * s, -s, 1.2 * s, 0.4 * s, corners, &warp));
        assert_font(font_map_compose(&map, &warp, &map));
    }
    return map;
}

/* Draws a usual size, or any other. */
static double size_random(uint32_t *random, double most)
{
    return random_next(random) % 3 == 0 ? 8 * (1 + random_next(random) % 4)
                                        : 5 * pow(most / 5, random_unit(random));
}

static double place_random(uint32_t *random)
{
    return random_next(random) % 3 == 0 ? (random_next(random) % 4) / 4.0 : random_unit(random);
}

static void letters_are_drawn_as_by_tables(void **state)
{
    const struct fixture *f = *state;
    struct pictures p = {.fast = {0}};
    uint32_t random = 20261123;
    for (int i = 0; i < FILTERS; i++) {
        int worst = 0;
        for (int n = 0; n < (i == 0 ? 1200 : 300); n++) {
            uint32_t face = random_next(&random) % FACES;
            uint32_t letter = random_next(&random) % LETTERS;
            double size = size_random(&random, n % 16 ? 60 : 400);
            struct font_map map = map_random(&random, size, f->units[face]);
            double x = place_random(&random), y = place_random(&random);
            int d = compare(&p, &f->letters[face][letter], &map, f->filter[i], x, y);
            if (d > 1)
                fail_msg("%s: %s '%c' at %g px, (%g, %g): %d of 255", filters[i], faces[face],
                         (int)(33 + letter), size, x, y, d);
            worst = d > worst ? d : worst;
        }
        print_message("%s: at most %d of 255\n", filters[i], worst);
        assert_true(worst > 0); /* two ways, not one */
    }
    pictures_finish(&p);
}

/* Draws contours of lines and curves of all kinds; some have their points on whole pixels. */
static void outline_random(struct font_outline *o, uint32_t *random)
{
    bool whole = random_next(random) % 2;
    int contours = 1 + (int)(random_next(random) % 3);
    for (int c = 0; c < contours; c++) {
        int segments = 2 + (int)(random_next(random) % 5);
        double q[6];
        for (int s = 0; s <= segments; s++) {
            for (int k = 0; k < 6; k++) {
                q[k] = 24 * random_unit(random);
                q[k] = whole ? rint(2 * q[k]) / 2 : q[k];
            }
            uint32_t kind = s == 0 ? 3 : random_next(random) % 3;
            assert_font(kind == 3   ? font_outline_move(o, q[0], q[1])
                        : kind == 0 ? font_outline_line(o, q[0], q[1])
                        : kind == 1
                            ? font_outline_quad(o, q[0], q[1], q[2], q[3])
                            : font_outline_cubic(o, q[0], q[1], q[2], q[3], q[4], q[5]));
        }
        assert_font(font_outline_close(o));
    }
    o->units_per_em = 24;
}

static void random_outlines_are_drawn_as_by_tables(void **state)
{
    const struct fixture *f = *state;
    struct pictures p = {.fast = {0}};
    uint32_t random = 7;
    for (int n = 0; n < 400; n++) {
        struct font_outline o = {0};
        outline_random(&o, &random);
        assert_font(font_outline_prepare(&o, FONT_NONZERO));
        struct font_map map = {FONT_AFFINE, {1, 0, 0, 0, 1, 0}};
        double x = place_random(&random), y = place_random(&random);
        for (int i = 0; i < FILTERS; i++) {
            int d = compare(&p, &o, &map, f->filter[i], x, y);
            if (d > 1)
                fail_msg("%s: outline %d at (%g, %g): %d of 255", filters[i], n, x, y, d);
        }
        font_outline_finish(&o);
    }
    pictures_finish(&p);
}

static void instruction_sets_agree(void **state)
{
    const struct fixture *f = *state;
    struct pictures p = {.fast = {0}};
    struct font_gray best = {0};
    uint32_t random = 99;
    for (int n = 0; n < 200; n++) {
        const struct font_outline *o =
            &f->letters[random_next(&random) % FACES][random_next(&random) % LETTERS];
        double size = size_random(&random, 100);
        struct font_map map = map_random(&random, size, o->units_per_em);
        const struct font_filter *filter = f->filter[n % FILTERS];
        double x = place_random(&random), y = place_random(&random);
        font_simd_use(FONT_SIMD_AVX512);
        assert_font(font_edges_build(&p.fast, o, &map, filter));
        assert_font(font_gray_draw(&best, &p.fast, filter, x, y));
        for (int simd = FONT_SIMD_PLAIN; simd <= FONT_SIMD_AVX2; simd++) {
            font_simd_use((enum font_simd)simd);
            assert_font(font_edges_build(&p.slow, o, &map, filter));
            assert_font(font_gray_draw(&p.slow_gray, &p.slow, filter, x, y));
            assert_int_equal(best.width_px, p.slow_gray.width_px);
            assert_true(difference(&best, &p.slow_gray) <= 1);
        }
        font_simd_use(FONT_SIMD_AVX512);
    }
    font_gray_finish(&best);
    pictures_finish(&p);
}

/* Pictures whose sums need several bands, with arcs far longer than a band. */
static void large_pictures_are_drawn_in_bands(void **state)
{
    const struct fixture *f = *state;
    struct pictures p = {.fast = {0}};
    for (int i = 0; i < FILTERS; i++)
        for (int n = 0; n < 2; n++) {
            const struct font_outline *o = &f->letters[n][n ? '&' - 33 : 'W' - 33];
            struct font_map map = font_map_size(900, f->units[n]);
            assert_true(compare(&p, o, &map, f->filter[i], 0.3, 0.6) <= 1);
            assert_true(p.fast_gray.height_px > 500);
        }
    pictures_finish(&p);
}

static void edges_of_another_filter_are_refused(void **state)
{
    const struct fixture *f = *state;
    struct font_filter *other = filter_make("gaussian-fast");
    struct font_edges edges = {0};
    struct font_gray gray = {0};
    struct font_map map = font_map_size(12, f->units[0]);
    assert_font(font_edges_build(&edges, &f->letters[0][32], &map, f->filter[0]));
    assert_int_equal(font_gray_draw(&gray, &edges, other, 0, 0), FONT_BAD_ARGUMENT);
    assert_true(gray.width_px == 0 && gray.pixels == NULL);
    /* The edges can be drawn after they are built again for the other filter. */
    assert_font(font_edges_build(&edges, &f->letters[0][32], &map, other));
    assert_font(font_gray_draw(&gray, &edges, other, 0, 0));
    assert_true(gray.width_px > 0);
    font_edges_finish(&edges);
    font_gray_finish(&gray);
    font_filter_destroy(other);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(letters_are_drawn_as_by_tables),
        cmocka_unit_test(random_outlines_are_drawn_as_by_tables),
        cmocka_unit_test(instruction_sets_agree),
        cmocka_unit_test(large_pictures_are_drawn_in_bands),
        cmocka_unit_test(edges_of_another_filter_are_refused),
    };
    return cmocka_run_group_tests(tests, fixture_make, fixture_destroy);
}
