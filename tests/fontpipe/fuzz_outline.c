/* fuzz_outline.c - see fuzz_outline.h. With libFuzzer it is the target. */
#include "fuzz_outline.h"

#include <gray.h>
#include <levels.h>

#include "../must.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct input {
    const uint8_t *at, *end;
};

static uint8_t byte(struct input *in)
{
    return in->at < in->end ? *in->at++ : 0;
}

/* Reads a number: mostly a small integer, so that points coincide; sometimes any float. */
static double number(struct input *in)
{
    uint8_t kind = byte(in);
    if (kind < 0xf0)
        return (int8_t)kind * 8 + (kind & 1 ? byte(in) / 32.0 : 0);
    uint8_t raw[4];
    float value;
    for (int i = 0; i < 4; i++)
        raw[i] = byte(in);
    memcpy(&value, raw, sizeof value);
    return (double)value;
}

static enum font_status outline_read(struct input *in, struct font_outline *o)
{
    enum font_status status = FONT_OK;
    int steps = byte(in);
    while (steps-- > 0 && in->at < in->end) {
        uint8_t kind = byte(in) % 8;
        double n[6];
        for (int i = 0; i < (kind == 0 ? 2 : kind < 4 ? 2 : kind < 6 ? 4 : 6); i++)
            n[i] = number(in);
        enum font_status one = kind == 0  ? font_outline_move(o, n[0], n[1])
                               : kind < 4 ? font_outline_line(o, n[0], n[1])
                               : kind < 6 ? font_outline_quad(o, n[0], n[1], n[2], n[3])
                               : kind < 7
                                   ? font_outline_cubic(o, n[0], n[1], n[2], n[3], n[4], n[5])
                                   : font_outline_close(o);
        status = one == FONT_BAD_ARGUMENT ? status : one; /* refused points are left out */
    }
    return status;
}

static void map_read(struct input *in, struct font_map *map)
{
    uint8_t kind = byte(in);
    *map = font_map_size(kind % 64 + byte(in) / 256.0, 1000);
    if (kind & 64)
        *map = font_map_then(*map, font_map_rotation(number(in)));
    if (kind & 128) {
        struct font_point corners[4];
        struct font_map warp;
        for (int i = 0; i < 4; i++) {
            corners[i].x = number(in) / 16;
            corners[i].y = number(in) / 16;
        }
        if (font_map_corners(kind & 1    ? FONT_SMOOTH
                             : kind & 32 ? FONT_PROJECTIVE
                                         : FONT_BILINEAR,
                             0, -kind, kind, 0, corners, &warp) == FONT_OK)
            (void)font_map_compose(map, &warp, map);
    }
}

static void gray_check(const struct font_gray *g, const struct font_filter *filter)
{
    struct font_filter_info info;
    font_filter_describe(filter, &info);
    must(g->width_px >= 0 && g->height_px >= 0 && (!g->width_px) == (!g->pixels));
    must(g->pitch >= g->width_px && g->pitch % 16 == 0);
    /* Where nothing is covered twice, a pixel lies between empty and full, except for the
     * filter's overshoot. */
    float slack = (float)(0.06 + 4 * info.undershoot);
    for (int r = 0; g->exact && r < g->height_px; r++)
        for (int c = 0; c < g->width_px; c++) {
            float v = g->exact[r * g->pitch + c];
            must(isfinite(v));
            must(v > -slack && v < 1 + slack);
        }
}

/* All instruction sets give the same picture. */
static void sets_check(const struct font_edges *e, const struct font_filter *f, double x,
                       double y, const struct font_gray *best)
{
    struct font_gray plain = {0};
    font_simd_use(FONT_SIMD_PLAIN);
    must(font_gray_draw_exact(&plain, e, f, x, y) == FONT_OK);
    font_simd_use(FONT_SIMD_AVX512);
    must(plain.width_px == best->width_px && plain.height_px == best->height_px);
    for (int r = 0; r < plain.height_px; r++)
        for (int c = 0; c < plain.width_px; c++)
            must(fabsf(plain.exact[r * plain.pitch + c] - best->exact[r * best->pitch + c]) <
                 2e-3f);
    font_gray_finish(&plain);
}

static bool levels_check(const struct font_outline *o, struct input *in)
{
    struct font_levels *l;
    const struct font_gray *gray;
    bool ink = false;
    if (font_levels_create(o, 16 + byte(in), 1 + byte(in) / 8.0, "box", &l) != FONT_OK)
        return false;
    font_levels_use_master(l, true);
    if (font_levels_gray(l, byte(in) / 256.0, 0, &gray) == FONT_OK)
        ink = gray->pixels != NULL;
    if (font_levels_master_fill(l, byte(in) - 128, byte(in) - 128, byte(in), byte(in),
                                byte(in) & 1) == FONT_OK &&
        font_levels_rectangles_merge(l, byte(in) % 4, NULL) == FONT_OK)
        (void)font_levels_gray(l, 0, 0, &gray);
    font_levels_destroy(l);
    return ink;
}

int fuzz_outline(const uint8_t *bytes, size_t count)
{
    static const char *const names[] = {"gaussian-fast", "box",     "cone",
                                        "mitchell",      "pillbox", "lanczos"};
    enum { FILTERS = sizeof names / sizeof *names };
    static struct font_filter *filters[FILTERS];
    struct input in = {bytes, bytes + count};
    struct font_outline o = {.units_per_em = 1000, .advance = 500};
    struct font_edges edges = {0};
    struct font_gray gray = {0};
    struct font_map map;
    int ink = 0;
    const int which = byte(&in) % FILTERS;
    if (!filters[which])
        must(font_filter_create_named(names[which], &filters[which]) == FONT_OK);
    const struct font_filter *filter = filters[which];
    enum font_fill rule = byte(&in) & 1 ? FONT_EVEN_ODD : FONT_NONZERO;
    double x = byte(&in) / 256.0, y = byte(&in) / 256.0, bold = byte(&in) - 128;
    bool tame = true;
    map_read(&in, &map);
    enum font_status status = outline_read(&in, &o);
    /* Coordinates far larger than the em leave floats without precision for a pixel. */
    struct font_box box = font_outline_box(&o);
    tame = fabs(box.x0) < 4000 && fabs(box.x1) < 4000 && fabs(box.y0) < 4000 &&
           fabs(box.y1) < 4000 && map.kind == FONT_AFFINE;
    if (status == FONT_OK && bold > 100)
        status = font_outline_embolden(&o, bold, bold);
    if (status == FONT_OK)
        status = font_outline_prepare(&o, rule);
    if (status == FONT_OK && font_edges_build(&edges, &o, &map, filter) == FONT_OK &&
        (edges.x1 - edges.x0 + 20) * (edges.y1 - edges.y0 + 20) < 4e6f && /* none: infinite */
        font_gray_draw_exact(&gray, &edges, filter, x, y) == FONT_OK) {
        ink = gray.pixels != NULL;
        if (tame) {
            gray_check(&gray, filter);
            sets_check(&edges, filter, x, y, &gray);
        }
    }
    if (status == FONT_OK && byte(&in) % 4 == 0)
        ink |= levels_check(&o, &in);
    font_gray_finish(&gray);
    font_edges_finish(&edges);
    font_outline_finish(&o);
    return ink;
}

#ifdef LUTETIA_FUZZ_TARGET
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    fuzz_outline(bytes, count);
    return 0;
}
#endif
