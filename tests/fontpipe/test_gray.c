/* test_gray.c - compares gray with its definition in double precision ("gold"): sizes, places
 * between pixels, filters, angles, faces, shears and distortions, with all instruction sets. */
#include "support.h"

#include <gold.h>
#include <gray.h>

#include <math.h>
#include <stdlib.h>

static const char *const faces[] = {"DejaVuSans", "EBGaramond12-Italic",
                                    "NimbusSans-Regular.otf"};
static const char *const filters[] = {"gaussian-fast", "box", "cone", "mitchell"};
enum { FACES = 3, FILTERS = 4, ANGLES = 12, LETTERS = 94 };

struct fixture {
    struct font_face *face[FACES];
    struct font_filter *filter[FILTERS];
    double units[FACES];
};

static int fixture_make(void **state)
{
    static struct fixture f;
    for (int i = 0; i < FACES; i++) {
        struct font_face_info info;
        f.face[i] = face_open(faces[i]);
        font_face_describe(f.face[i], &info);
        f.units[i] = info.units_per_em;
    }
    for (int i = 0; i < FILTERS; i++)
        f.filter[i] = filter_make(filters[i]);
    *state = &f;
    return 0;
}

static int fixture_destroy(void **state)
{
    struct fixture *f = *state;
    for (int i = 0; i < FACES; i++)
        font_face_close(f->face[i]);
    for (int i = 0; i < FILTERS; i++)
        font_filter_destroy(f->filter[i]);
    return 0;
}

/* Draws and compares. Adds the differences of bytes, and of values before rounding, to the
 * sums. */
static void compare(const struct font_outline *outline, const struct font_map *map,
                    const struct font_filter *filter, double x, double y,
                    struct font_difference *bytes, struct font_difference *exact)
{
    struct font_edges edges = {0};
    struct font_gray gray = {0};
    assert_font(font_edges_build(&edges, outline, map, filter));
    assert_font(font_gray_draw_exact(&gray, &edges, filter, x, y));
    if (gray.pixels) {
        int left = gray.left_px - 2, top = gray.top_px - 2;
        int width = gray.width_px + 4, height = gray.height_px + 4;
        double *gold = malloc(sizeof(double) * (size_t)width * (size_t)height);
        assert_non_null(gold);
        assert_font(font_gold_draw(outline, map, filter, x, y, left, top, width, height, gold));
        font_gold_compare(&gray, false, left, top, width, height, gold, bytes);
        font_gold_compare(&gray, true, left, top, width, height, gold, exact);
        free(gold);
    }
    font_gray_finish(&gray);
    font_edges_finish(&edges);
}

static void sums_check(const char *what, const struct font_difference *bytes,
                       const struct font_difference *exact)
{
    double ink = 100 * fabs(exact->ink / exact->ink_gold - 1);
    print_message("%s: at most %.3f of 255, before rounding %.3f, %.1f dB; ink %.4f%%\n", what,
                  bytes->max, exact->max, font_difference_psnr(exact), ink);
    assert_true(bytes->pixels_count > 1000);
    assert_true(bytes->max <= 1.0);
    assert_true(font_difference_psnr(exact) >= 65);
    assert_true(ink <= 0.05);
}

/* 256 places, 12 angles, 4 filters and 3 faces, each many times in changing combinations. */
static void gray_is_gold_at_any_place_and_angle(void **state)
{
    const struct fixture *f = *state;
    struct font_difference bytes[FILTERS] = {{0}}, exact[FILTERS] = {{0}};
    static const double sizes[] = {12.25, 9.6, 24, 17.3};
    for (int k = 0; k < 768; k++) {
        int face = k % FACES, filter = (k / FACES) % FILTERS, angle = (k * 7 / 5) % ANGLES;
        int letter = (k * 31) % LETTERS;
        double size = sizes[(k / 11) % 4];
        struct font_outline outline;
        assert_font(font_face_outline(
            f->face[face], font_face_glyph(f->face[face], 33 + (uint32_t)letter), &outline));
        struct font_map map = font_map_then(font_map_size(size, f->units[face]),
                                            font_map_rotation(angle * 30 + (k % 2 ? 0 : 7)));
        compare(&outline, &map, f->filter[filter], (k * 5 % 256 % 16) / 16.0,
                (k * 5 % 256 / 16) / 16.0, &bytes[filter], &exact[filter]);
        font_outline_finish(&outline);
    }
    for (int i = 0; i < FILTERS; i++)
        sums_check(filters[i], &bytes[i], &exact[i]);
}

static void gray_is_gold_when_large(void **state)
{
    const struct fixture *f = *state;
    struct font_difference bytes = {0}, exact = {0};
    for (int k = 0; k < 9; k++) {
        struct font_outline outline;
        int face = k % FACES;
        assert_font(font_face_outline(
            f->face[face], font_face_glyph(f->face[face], (uint32_t) "Ag&"[k / 3]), &outline));
        struct font_map map = font_map_size(72, f->units[face]);
        compare(&outline, &map, f->filter[k % 2 ? 3 : 0], k / 9.0, 0.4, &bytes, &exact);
        font_outline_finish(&outline);
    }
    sums_check("72 px", &bytes, &exact);
}

static void gray_is_gold_sheared_and_distorted(void **state)
{
    const struct fixture *f = *state;
    static const enum font_map_kind kinds[] = {FONT_AFFINE, FONT_PROJECTIVE, FONT_BILINEAR,
                                               FONT_SMOOTH};
    struct font_difference bytes[4] = {{0}}, exact[4] = {{0}};
    /* the second square almost has a dent: there a smooth map differs from the other kinds */
    const struct font_point corners[2][4] = {{{3, 2}, {41, 8}, {37, 35}, {0, 30}},
                                             {{3, 2}, {41, 8}, {23.5, 19.5}, {0, 30}}};
    for (int k = 0; k < 144; k++) {
        struct font_outline outline;
        int face = k % FACES, kind = k / 3 % 4;
        assert_font(font_face_outline(
            f->face[face], font_face_glyph(f->face[face], 33 + (uint32_t)(k * 17 % LETTERS)),
            &outline));
        struct font_map map = font_map_size(24, f->units[face]);
        if (kind == 0) {
            map = font_map_then(map, font_map_shear(0.5 - k / 144.0));
        } else {
            struct font_map warp;
            assert_font(
                font_map_corners(kinds[kind], -4, -24, 28, 8, corners[kind == 3], &warp));
            assert_int_equal(warp.kind, kinds[kind]);
            assert_font(font_map_compose(&map, &warp, &map));
        }
        compare(&outline, &map, f->filter[k / 9 % FILTERS], k % 16 / 16.0, k / 16 / 16.0,
                &bytes[kind], &exact[kind]);
        font_outline_finish(&outline);
    }
    sums_check("sheared", &bytes[0], &exact[0]);
    sums_check("projective", &bytes[1], &exact[1]);
    sums_check("bilinear", &bytes[2], &exact[2]);
    sums_check("smooth", &bytes[3], &exact[3]);
}

/* A map of any kind after affine ones, twice, is what both do to a point; and letters through
 * it are gold's. */
static void maps_follow_each_other(void **state)
{
    const struct fixture *f = *state;
    static const enum font_map_kind kinds[] = {FONT_PROJECTIVE, FONT_BILINEAR, FONT_SMOOTH};
    const struct font_point corners[3][4] = {{{2, 4}, {70, 9}, {63, 52}, {7, 44}},
                                             {{2, 4}, {50, -9}, {63, 52}, {17, 34}},
                                             {{2, 4}, {70, 9}, {40, 30}, {7, 44}}};
    struct font_difference bytes = {0}, exact = {0};
    struct font_outline letter;
    assert_font(font_face_outline(f->face[1], font_face_glyph(f->face[1], 'g'), &letter));
    for (int k = 0; k < 3 * 24; k++) {
        struct font_map bent, turned = font_map_rotation(15 * (k / 3)), both, all;
        struct font_map slanted = font_map_shear(k % 5 * 0.2);
        assert_font(font_map_corners(kinds[k % 3], 0, -40, 60, 12, corners[k % 3], &bent));
        turned.m[2] = k % 4;
        slanted.m[5] = -1.5 * (k % 3);
        assert_font(font_map_compose(&turned, &bent, &both));
        assert_font(font_map_compose(&slanted, &both, &all));
        for (int i = 0; i < 20; i++) {
            struct font_point at = {i % 5 * 3.1 - 4, i / 5 * 2.3 - 3}, one, two;
            double j[4], c[4], chain[4], a[4];
            assert_true(font_map_point(&slanted, at, &one, j));
            assert_true(font_map_point(&turned, one, &one, a));
            if (!font_map_point(&bent, one, &one, c))
                continue;
            assert_true(font_map_point(&all, at, &two, chain));
            assert_true(fabs(one.x - two.x) < 1e-9 && fabs(one.y - two.y) < 1e-9);
            for (int row = 0; row < 2; row++) /* the chain rule */
                for (int column = 0; column < 2; column++) {
                    double inner[2];
                    for (int q = 0; q < 2; q++)
                        inner[q] = a[2 * q] * j[column] + a[2 * q + 1] * j[2 + column];
                    assert_true(fabs(c[2 * row] * inner[0] + c[2 * row + 1] * inner[1] -
                                     chain[2 * row + column]) < 1e-9);
                }
        }
        struct font_map size = font_map_size(24, f->units[1]), letters;
        assert_font(font_map_compose(&size, &all, &letters));
        struct font_edges edges = {0};
        if (font_edges_build(&edges, &letter, &letters, f->filter[0]) == FONT_OK)
            compare(&letter, &letters, f->filter[k % FILTERS], 0, 0, &bytes, &exact);
        font_edges_finish(&edges);
    }
    sums_check("turned, then bent", &bytes, &exact);
    font_outline_finish(&letter);
}

/* Compares gray with gold for the rarer filters. */
static void gray_is_gold_with_other_filters(void **state)
{
    const struct fixture *f = *state;
    static const char *const names[] = {
        "pillbox",        "pillbox:1.3",    "gaussian-slow",           "lanczos",
        "gaussian:1,3.4", "gaussian:1.2,4", "samples:1.5,1,0.9,0.3,0", "round:1,1,1,0.5,0.1"};
    for (size_t n = 0; n < sizeof names / sizeof *names; n++) {
        struct font_difference bytes = {0}, exact = {0};
        struct font_filter *filter = filter_make(names[n]);
        for (int k = 0; k < 24; k++) {
            struct font_outline outline;
            int face = k % FACES;
            assert_font(font_face_outline(
                f->face[face],
                font_face_glyph(f->face[face], 33 + (uint32_t)(k * 29 % LETTERS)), &outline));
            struct font_map map = font_map_size(k % 2   ? 12.25
                                                : k % 4 ? 24
                                                        : 61,
                                                f->units[face]);
            compare(&outline, &map, filter, k / 24.0, 0.37, &bytes, &exact);
            font_outline_finish(&outline);
        }
        sums_check(names[n], &bytes, &exact);
        font_filter_destroy(filter);
    }
}

/* Curves of a hundredth of a pixel, many of them in a pixel, are as wide as they are: what they
 * lacked would be missing all the way down. */
static void motes_are_whole(void **state)
{
    (void)state;
    struct font_filter *lanczos = filter_make("lanczos");
    struct font_difference bytes = {0}, exact = {0};
    struct font_outline outline = {.units_per_em = 1000};
    assert_font(font_outline_move(&outline, 0, 0));
    assert_font(font_outline_line(&outline, 900, 0));
    assert_font(font_outline_line(&outline, 900, 800));
    for (int i = 0; i < 20; i++) { /* steps */
        double x = 900 - 3 * i, y = 800 + 5 * i;
        assert_font(font_outline_cubic(&outline, x - 1, y, x - 1, y + 1, x - 2, y + 1));
        assert_font(font_outline_line(&outline, x - 3, y + 5));
    }
    assert_font(font_outline_line(&outline, 0, 900));
    assert_font(font_outline_prepare(&outline, FONT_NONZERO));
    struct font_map map = font_map_size(5, 1000);
    for (int k = 0; k < 16; k++)
        compare(&outline, &map, lanczos, k % 4 / 4.0, k / 4 / 4.0, &bytes, &exact);
    sums_check("motes", &bytes, &exact);
    font_outline_finish(&outline);
    font_filter_destroy(lanczos);
}

/* A picture that is drawn in bands agrees with gold. */
static void bands_join(void **state)
{
    const struct fixture *f = *state;
    struct font_outline outline = {0};
    outline.units_per_em = 1000;
    assert_font(font_outline_move(&outline, 0, 0));
    assert_font(font_outline_line(&outline, 900, 30));
    assert_font(font_outline_quad(&outline, 500, 400, 880, 900));
    assert_font(font_outline_line(&outline, 40, 870));
    assert_font(font_outline_prepare(&outline, FONT_NONZERO));
    struct font_filter *lanczos = filter_make("lanczos");
    const struct font_filter *const both[] = {f->filter[0], lanczos};
    for (int k = 0; k < 2; k++) {
        struct font_difference bytes = {0}, exact = {0}, tall_bytes = {0}, tall_exact = {0};
        struct font_map map = font_map_size(600, 1000);
        compare(&outline, &map, both[k], 0.3, 0.6, &bytes, &exact);
        sums_check("600 px", &bytes, &exact);
        /* A picture that is narrow and higher than a band: its rows of sums lie closer
         * together. */
        struct font_map tall = {FONT_AFFINE, {0.009, 0, 0, 0, -2.5, 0}};
        compare(&outline, &tall, both[k], 0.3, 0.6, &tall_bytes, &tall_exact);
        sums_check("narrow and tall", &tall_bytes, &tall_exact);
    }
    font_outline_finish(&outline);
    font_filter_destroy(lanczos);
}

/* Instruction sets differ only by rounding. */
static void instruction_sets_agree(void **state)
{
    const struct fixture *f = *state;
    struct font_gray best = {0}, other = {0};
    struct font_edges edges = {0};
    static const double sizes[] = {12.25, 40};
    for (int k = 0; k < 2 * FILTERS; k++)
        for (int letter = 0; letter < LETTERS; letter += 3) {
            struct font_outline outline;
            assert_font(font_face_outline(
                f->face[0], font_face_glyph(f->face[0], 33 + (uint32_t)letter), &outline));
            struct font_map map = font_map_size(sizes[k / FILTERS], f->units[0]);
            const struct font_filter *filter = f->filter[k % FILTERS];
            assert_font(font_edges_build(&edges, &outline, &map, filter));
            enum font_simd top = font_simd_use(FONT_SIMD_AVX512);
            assert_font(font_gray_draw_exact(&best, &edges, filter, 0.2, 0.9));
            for (int simd = FONT_SIMD_PLAIN; simd < (int)top; simd++) {
                font_simd_use((enum font_simd)simd);
                assert_font(font_gray_draw_exact(&other, &edges, filter, 0.2, 0.9));
                assert_int_equal(other.width_px, best.width_px);
                assert_int_equal(other.height_px, best.height_px);
                for (int r = 0; r < best.height_px; r++)
                    for (int c = 0; c < best.width_px; c++)
                        if (fabsf(best.exact[r * best.pitch + c] -
                                  other.exact[r * best.pitch + c]) > 2e-5f)
                            fail_msg("%c, %s: %g and %g", 33 + letter,
                                     font_simd_name((enum font_simd)simd),
                                     (double)best.exact[r * best.pitch + c],
                                     (double)other.exact[r * best.pitch + c]);
            }
            font_simd_use(FONT_SIMD_AVX512);
            font_outline_finish(&outline);
        }
    font_gray_finish(&best);
    font_gray_finish(&other);
    font_edges_finish(&edges);
}

/* Checks gold itself by counting the points of a fine grid that are inside, weighed by the
 * filter. */
static void gold_is_what_counting_gives(void **state)
{
    const struct fixture *f = *state;
    enum { FINE = 48, WIDTH = 16, HEIGHT = 14 };
    /* A triangle with a hole; the tests for inside are written by hand. */
    struct font_outline o = {.units_per_em = 1};
    assert_font(font_outline_move(&o, 1.3, 1.2));
    assert_font(font_outline_line(&o, 2.1, 8.9));
    assert_font(font_outline_line(&o, 9.7, 3.1));
    assert_font(font_outline_prepare(&o, FONT_NONZERO));
    struct font_map map = {FONT_AFFINE, {1, 0, 3, 0, 1, 2.5}};
    for (int n = 0; n < FILTERS; n++) {
        double gold[WIDTH * HEIGHT], worst = 0;
        assert_font(font_gold_draw(&o, &map, f->filter[n], 0, 0, 0, 0, WIDTH, HEIGHT, gold));
        for (int j = 0; j < HEIGHT; j++)
            for (int i = 0; i < WIDTH; i++) {
                double sum = 0;
                for (int b = -2 * FINE; b < 3 * FINE; b++)
                    for (int a = -2 * FINE; a < 3 * FINE; a++) {
                        double x = i + (a + 0.5) / FINE, y = j + (b + 0.5) / FINE;
                        double px = x - 3, py = y - 2.5;
                        bool inside = (2.1 - 1.3) * (py - 1.2) - (8.9 - 1.2) * (px - 1.3) < 0 &&
                                      (9.7 - 2.1) * (py - 8.9) - (3.1 - 8.9) * (px - 2.1) < 0 &&
                                      (1.3 - 9.7) * (py - 3.1) - (1.2 - 3.1) * (px - 9.7) < 0;
                        if (inside)
                            sum += font_filter_at(f->filter[n], i + 0.5 - x, j + 0.5 - y);
                    }
                worst = fmax(worst, fabs(sum / (FINE * FINE) - gold[j * WIDTH + i]));
            }
        print_message("%s: counting differs by %.4f of 255\n", filters[n], 255 * worst);
        assert_true(worst < 0.004);
    }
    font_outline_finish(&o);
}

static void nonsense_is_refused(void **state)
{
    const struct fixture *f = *state;
    struct font_outline outline;
    struct font_edges edges = {0};
    struct font_gray gray = {0};
    assert_font(font_face_outline(f->face[0], font_face_glyph(f->face[0], 'A'), &outline));
    struct font_map map = font_map_size(NAN, 2048);
    assert_int_equal(font_edges_build(&edges, &outline, &map, f->filter[0]), FONT_BAD_ARGUMENT);
    map = font_map_size(1e9, 2048);
    assert_int_equal(font_edges_build(&edges, &outline, &map, f->filter[0]), FONT_TOO_LARGE);
    assert_font(font_gray_draw(&gray, &edges, f->filter[0], 0, 0));
    assert_null(gray.pixels);
    map = font_map_size(0, 2048);
    assert_font(font_edges_build(&edges, &outline, &map, f->filter[0]));
    assert_font(font_gray_draw(&gray, &edges, f->filter[0], 0, 0));
    assert_null(gray.pixels);
    map = font_map_size(12, 2048);
    assert_font(font_edges_build(&edges, &outline, &map, f->filter[0]));
    assert_int_equal(font_gray_draw(&gray, &edges, f->filter[0], INFINITY, 0),
                     FONT_BAD_ARGUMENT);
    assert_int_equal(font_gray_draw(&gray, &edges, f->filter[0], 0, 1e8), FONT_BAD_ARGUMENT);
    /* Size -12 mirrors the glyph in both directions, like a rotation by 180 degrees. */
    map = font_map_size(-12, 2048);
    assert_font(font_edges_build(&edges, &outline, &map, f->filter[0]));
    assert_font(font_gray_draw(&gray, &edges, f->filter[0], 0, 0));
    assert_non_null(gray.pixels);
    font_outline_finish(&outline);
    font_edges_finish(&edges);
    font_gray_finish(&gray);
}

/* A thread that asks for plain instructions gets their bits, whatever other threads use. */
static void plain_here_is_plain(void **state)
{
    const struct fixture *f = *state;
    struct font_gray gray[2] = {{0}};
    struct font_edges edges[2] = {{0}};
    for (int letter = 0; letter < LETTERS; letter += 7) {
        struct font_outline outline;
        struct font_map map = font_map_size(17.3, f->units[1]);
        assert_font(font_face_outline(
            f->face[1], font_face_glyph(f->face[1], 33 + (uint32_t)letter), &outline));
        for (int way = 0; way < 2; way++) {
            font_simd_use(way ? FONT_SIMD_AVX512 : FONT_SIMD_PLAIN);
            font_simd_plain_here(way == 1);
            assert_font(font_edges_build(&edges[way], &outline, &map, f->filter[0]));
            assert_font(font_gray_draw_exact(&gray[way], &edges[way], f->filter[0], 0.3, 0.8));
            font_simd_plain_here(false);
        }
        font_simd_use(FONT_SIMD_AVX512);
        assert_true(gray[0].width_px == gray[1].width_px &&
                    gray[0].height_px == gray[1].height_px);
        for (int r = 0; r < gray[0].height_px; r++)
            assert_memory_equal(gray[0].exact + r * gray[0].pitch,
                                gray[1].exact + r * gray[1].pitch,
                                sizeof(float) * (size_t)gray[0].width_px);
        font_outline_finish(&outline);
    }
    for (int way = 0; way < 2; way++) {
        font_edges_finish(&edges[way]);
        font_gray_finish(&gray[way]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gold_is_what_counting_gives),
        cmocka_unit_test(gray_is_gold_at_any_place_and_angle),
        cmocka_unit_test(gray_is_gold_when_large),
        cmocka_unit_test(gray_is_gold_sheared_and_distorted),
        cmocka_unit_test(gray_is_gold_with_other_filters),
        cmocka_unit_test(maps_follow_each_other),
        cmocka_unit_test(motes_are_whole),
        cmocka_unit_test(bands_join),
        cmocka_unit_test(instruction_sets_agree),
        cmocka_unit_test(plain_here_is_plain),
        cmocka_unit_test(nonsense_is_refused),
    };
    return cmocka_run_group_tests(tests, fixture_make, fixture_destroy);
}
