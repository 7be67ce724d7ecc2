/* fonts_thorough.c - see fonts_thorough.h.
 *
 * Each combination of place, angle, filter and face is drawn once, with varying letters and
 * sizes. The table also has the error of rounding alone: that of gold, rounded to bytes.
 */
#include "fonts_thorough.h"

#include <edges.h>
#include <face.h>
#include <gold.h>
#include <gray.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { FACES = 3, FILTERS = 4, ANGLES = 12, PLACES = 256, LETTERS = 94, KINDS = 4 };

static const char *const faces[FACES] = {"DejaVuSans", "EBGaramond12-Italic",
                                         "NimbusSans-Regular.otf"};
static const char *const filters[FILTERS] = {"gaussian-fast", "box", "cone", "mitchell"};
static const char *const kinds[KINDS] = {"rotated", "sheared", "projective", "bilinear"};

struct sums {
    struct font_difference bytes, exact, gold_bytes;
    double worst_glyph_db; /* before rounding */
};

struct thorough {
    struct font_face *face[FACES];
    struct font_filter *filter[FILTERS];
    struct font_outline outlines[FACES][LETTERS];
    double units[FACES];
    struct font_edges edges;
    struct font_gray gray;
    struct sums sums[KINDS][FILTERS];
};

static bool font_wrong(void)
{
    return bench_fail("%s", font_error());
}

static bool thorough_open(struct thorough *t)
{
    for (int i = 0; i < FILTERS; i++)
        if (font_filter_create_named(filters[i], &t->filter[i]) != FONT_OK)
            return font_wrong();
    for (int i = 0; i < FACES; i++) {
        struct font_face_info info;
        if (font_face_open(faces[i], 0, &t->face[i]) != FONT_OK)
            return font_wrong();
        font_face_describe(t->face[i], &info);
        t->units[i] = info.units_per_em;
        for (int k = 0; k < LETTERS; k++)
            if (font_face_outline(t->face[i], font_face_glyph(t->face[i], 33 + (uint32_t)k),
                                  &t->outlines[i][k]) != FONT_OK)
                return font_wrong();
    }
    for (int kind = 0; kind < KINDS; kind++)
        for (int i = 0; i < FILTERS; i++)
            t->sums[kind][i].worst_glyph_db = 200;
    return true;
}

static void thorough_close(struct thorough *t)
{
    for (int i = 0; i < FACES; i++) {
        for (int k = 0; k < LETTERS; k++)
            font_outline_finish(&t->outlines[i][k]);
        font_face_close(t->face[i]);
    }
    for (int i = 0; i < FILTERS; i++)
        font_filter_destroy(t->filter[i]);
    font_edges_finish(&t->edges);
    font_gray_finish(&t->gray);
}

static bool glyph_compare(struct thorough *t, const struct font_outline *outline,
                          const struct font_map *map, const struct font_filter *filter,
                          double x, double y, struct sums *sums)
{
    if (font_edges_build(&t->edges, outline, map, filter) != FONT_OK ||
        font_gray_draw_exact(&t->gray, &t->edges, filter, x, y) != FONT_OK)
        return font_wrong();
    if (!t->gray.pixels)
        return true;
    int left = t->gray.left_px - 1, top = t->gray.top_px - 1;
    int width = t->gray.width_px + 2, height = t->gray.height_px + 2;
    double *gold = malloc(sizeof *gold * (size_t)width * (size_t)height);
    if (!gold)
        return bench_fail("no memory for gold");
    bool ok =
        font_gold_draw(outline, map, filter, x, y, left, top, width, height, gold) == FONT_OK;
    if (ok) {
        struct font_difference one = {0};
        font_gold_compare(&t->gray, false, left, top, width, height, gold, &sums->bytes);
        font_gold_compare(&t->gray, true, left, top, width, height, gold, &sums->exact);
        font_gold_compare(&t->gray, true, left, top, width, height, gold, &one);
        font_gold_bytes_compare(gold, width * height, &sums->gold_bytes);
        sums->worst_glyph_db = fmin(sums->worst_glyph_db, font_difference_psnr(&one));
    }
    free(gold);
    return ok || font_wrong();
}

/* The map of the n-th picture of a kind. */
static bool map_make(int kind, int angle, int n, double size_px, double units,
                     struct font_map *map)
{
    *map = font_map_size(size_px, units);
    if (kind == 0) {
        *map = font_map_then(*map, font_map_rotation(angle * 360.0 / ANGLES));
        return true;
    }
    if (kind == 1) {
        *map = font_map_then(*map, font_map_shear(0.6 - 1.2 * (n % 97) / 96));
        return true;
    }
    double s = size_px, lean = 0.1 + 0.2 * (n % 13) / 12;
    const struct font_point corners[4] = {
        {lean * s, 0}, {(1.4 - lean / 2) * s, 0.25 * s}, {1.3 * s, 1.3 * s}, {0, 1.1 * s}};
    struct font_map warp;
    return font_map_corners(kind == 2 ? FONT_PROJECTIVE : FONT_BILINEAR, -0.2 * s, -s, 1.2 * s,
                            0.4 * s, corners, &warp) == FONT_OK &&
           font_map_compose(map, &warp, map) == FONT_OK;
}

static bool kind_run(struct thorough *t, int kind)
{
    static const double sizes[] = {12.25, 24, 9.6, 17.3, 12.25, 24, 72};
    int n = 0;
    for (int angle = 0; angle < (kind == 0 ? ANGLES : 1); angle++)
        for (int filter = 0; filter < FILTERS; filter++)
            for (int face = 0; face < FACES; face++)
                for (int place = 0; place < PLACES; place++, n++) {
                    struct font_map map;
                    double size_px = sizes[n % 7];
                    if (!map_make(kind, angle, n, size_px, t->units[face], &map))
                        return font_wrong();
                    if (!glyph_compare(t, &t->outlines[face][n * 31 % LETTERS], &map,
                                       t->filter[filter], place % 16 / 16.0, place / 16 / 16.0,
                                       &t->sums[kind][filter]))
                        return false;
                }
    return true;
}

static void number_add(struct bench_report *r, const char *what, const char *of_case,
                       double value, const char *unit)
{
    bench_report_add(r, what, of_case, (struct bench_sample){value, value}, 1, unit);
}

static double ink_off(const struct font_difference *d)
{
    return 100 * fabs(d->ink / d->ink_gold - 1);
}

/* Adds the rows of a kind, with its filters' largest errors; false if these are too large. */
static bool kind_report(const struct thorough *t, int kind, struct bench_report *r)
{
    double max = 0, exact_max = 0, bytes_db = 200, exact_db = 200, glyph_db = 200,
           gold_db = 200, ink = 0;
    for (int i = 0; i < FILTERS; i++) {
        const struct sums *s = &t->sums[kind][i];
        max = fmax(max, s->bytes.max);
        exact_max = fmax(exact_max, s->exact.max);
        bytes_db = fmin(bytes_db, font_difference_psnr(&s->bytes));
        exact_db = fmin(exact_db, font_difference_psnr(&s->exact));
        gold_db = fmin(gold_db, font_difference_psnr(&s->gold_bytes));
        glyph_db = fmin(glyph_db, s->worst_glyph_db);
        ink = fmax(ink, ink_off(&s->exact));
        printf("%-10s %-13s at most %.3f of 255, %.1f dB (bytes of gold %.3f, %.1f dB); "
               "unrounded %.3f, %.1f dB, worst glyph %.1f dB; ink %.4f%%\n",
               kinds[kind], filters[i], s->bytes.max, font_difference_psnr(&s->bytes),
               s->gold_bytes.max, font_difference_psnr(&s->gold_bytes), s->exact.max,
               font_difference_psnr(&s->exact), s->worst_glyph_db, ink_off(&s->exact));
    }
    fflush(stdout);
    number_add(r, "bytes max error", kinds[kind], max, "/255");
    number_add(r, "bytes psnr", kinds[kind], bytes_db, "dB");
    number_add(r, "bytes of gold psnr", kinds[kind], gold_db, "dB");
    number_add(r, "unrounded max error", kinds[kind], exact_max, "/255");
    number_add(r, "unrounded psnr", kinds[kind], exact_db, "dB");
    number_add(r, "unrounded psnr, worst glyph", kinds[kind], glyph_db, "dB");
    number_add(r, "ink off by", kinds[kind], ink, "%");
    if (max <= 1 && exact_db >= 65 && ink <= 0.05)
        return true;
    return bench_fail("%s: %.3f of 255 and %.1f dB, ink off by %.4f%%: less exact than 1 of "
                      "255, 65 dB and 0.05%%",
                      kinds[kind], max, exact_db, ink);
}

bool fonts_thorough_run(struct bench_report *r)
{
    struct thorough *t = calloc(1, sizeof *t);
    if (!t)
        return bench_fail("no memory");
    bool ok = thorough_open(t), exact = true;
    for (int kind = 0; ok && kind < KINDS; kind++) {
        ok = kind_run(t, kind);
        exact = ok && kind_report(t, kind, r) && exact;
    }
    thorough_close(t);
    free(t);
    return ok && exact;
}
