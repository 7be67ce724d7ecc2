/* paint_colour.c - a glyph's picture through a map onto another: what each pixel covers of it
 * is averaged, as light. */
#include "paint_internal.h"

#include <math.h>
#include <stdlib.h>

enum { SAMPLES_MAX = 12, NEWTON_STEPS = 8 };

/* From a place on the picture to the glyph's pixels around its origin, and on to the page. */
struct way {
    const struct font_map *map;
    double scale, left, top, x, y;
};

static bool way_go(const struct way *w, double u, double v, struct font_point *to, double j[4])
{
    struct font_point from = {(w->left + u) * w->scale, (v - w->top) * w->scale};
    if (!font_map_point(w->map, from, to, j))
        return false;
    to->x += w->x;
    to->y += w->y;
    for (int k = 0; k < 4; k++)
        j[k] *= w->scale;
    return true;
}

/* The place on the picture that comes to (x, y); *u and *v: from where it is looked for. */
static bool way_back(const struct way *w, double x, double y, double *u, double *v)
{
    for (int n = 0; n < NEWTON_STEPS; n++) {
        struct font_point at;
        double j[4];
        if (!way_go(w, *u, *v, &at, j))
            return false;
        double dx = x - at.x, dy = y - at.y, det = j[0] * j[3] - j[1] * j[2];
        if (!(fabs(det) > 1e-12))
            return false;
        *u += (dx * j[3] - dy * j[1]) / det;
        *v += (dy * j[0] - dx * j[2]) / det;
        if (w->map->kind == FONT_AFFINE || fabs(dx) + fabs(dy) < 1e-4)
            return isfinite(*u) && isfinite(*v);
    }
    return false;
}

bool font_blend_picture_box(const struct font_colour_picture *from, const struct font_map *map,
                            double size_px, double x, double y, struct font_box *box)
{
    const struct way w = {map, size_px / from->em_px, from->left_px, from->top_px, x, y};
    enum { ALONG = 8 };
    *box = (struct font_box){INFINITY, INFINITY, -INFINITY, -INFINITY};
    for (int i = 0; i <= ALONG; i++)
        for (int k = 0; k <= ALONG; k++) {
            struct font_point at;
            double j[4];
            if (!way_go(&w, (double)from->width_px * i / ALONG,
                        (double)from->height_px * k / ALONG, &at, j))
                return false;
            box->x0 = fmin(box->x0, at.x);
            box->y0 = fmin(box->y0, at.y);
            box->x1 = fmax(box->x1, at.x);
            box->y1 = fmax(box->y1, at.y);
        }
    return true;
}

/* Light times cover, and cover, of the picture's pixel that holds a place; nothing beyond its
 * sides. */
static void sample_add(const struct font_painter *p, const struct font_colour_picture *from,
                       double u, double v, float sum[4])
{
    if (!(u >= 0 && v >= 0 && u < from->width_px && v < from->height_px))
        return;
    const uint8_t *at = from->bgra + 4 * ((size_t)v * (size_t)from->width_px + (size_t)u);
    if (!at[3])
        return;
    float cover = (float)at[3] * (1 / 255.0f);
    for (int c = 0; c < 3; c++) {
        int number = at[2 - c] * 255 / at[3];
        sum[c] += cover * p->to_light[number > 255 ? 255 : number];
    }
    sum[3] += cover;
}

/* The picture on its way, the pixels that it may touch, and how often each is looked at along
 * each side. */
struct passage {
    struct way way;
    double u, v; /* its middle: from where places are looked for */
    int left, top, right, bottom, looks;
};

/* False: there is nothing. */
static bool passage_make(const struct font_colour_picture *from, const struct font_map *map,
                         double size_px, double x, double y, int width, int height,
                         struct passage *out)
{
    struct font_box box;
    struct font_point at;
    double j[4];
    *out =
        (struct passage){.way = {map, size_px / from->em_px, from->left_px, from->top_px, x, y},
                         .u = from->width_px / 2.0,
                         .v = from->height_px / 2.0};
    if (!font_blend_picture_box(from, map, size_px, x, y, &box) ||
        !way_go(&out->way, out->u, out->v, &at, j))
        return false;
    /* As many places within a pixel as it covers of the picture's, along each side. */
    double shrunk = 1 / sqrt(fmax(fabs(j[0] * j[3] - j[1] * j[2]), 1e-6));
    out->looks = (int)fmin(SAMPLES_MAX, fmax(4, 2 * ceil(shrunk / 2)));
    out->left = (int)fmin(width, fmax(0, floor(box.x0)));
    out->top = (int)fmin(height, fmax(0, floor(box.y0)));
    out->right = (int)fmax(0, fmin(width, ceil(box.x1)));
    out->bottom = (int)fmax(0, fmin(height, ceil(box.y1)));
    return out->left < out->right && out->top < out->bottom;
}

/* Light times cover, and cover, of a pixel. */
static void pixel_get(const struct font_painter *p, const struct font_colour_picture *from,
                      const struct passage *w, int column, int row, float out[4])
{
    int n = w->looks;
    float sum[4] = {0};
    for (int k = 0; k < n * n; k++) {
        double px = column + (k % n + 0.5) / n, py = row + (k / n + 0.5) / n;
        double u = w->u, v = w->v;
        if (way_back(&w->way, px, py, &u, &v))
            sample_add(p, from, u, v, sum);
    }
    for (int c = 0; c < 4; c++)
        out[c] = sum[c] / (float)(n * n);
}

static uint8_t number_of(const struct font_painter *p, float light)
{
    return p->to_number[(int)(sqrtf(fminf(1, light)) * TO_NUMBER + 0.5f)];
}

void font_blend_picture(const struct font_painter *p, const struct font_colour_picture *from,
                        const struct font_map *map, double size_px, double x, double y,
                        double cover, struct font_picture *to)
{
    struct passage w;
    if (!passage_make(from, map, size_px, x, y, to->width_px, to->height_px, &w))
        return;
    for (int row = w.top; row < w.bottom; row++)
        for (int column = w.left; column < w.right; column++) {
            uint8_t *below = to->rgb + (size_t)row * (size_t)to->pitch + 3 * (size_t)column;
            float sum[4], part = (float)cover;
            pixel_get(p, from, &w, column, row, sum);
            for (int c = 0; c < 3 && sum[3] > 0; c++)
                below[c] =
                    number_of(p, p->to_light[below[c]] * (1 - sum[3] * part) + sum[c] * part);
        }
}

enum font_status font_tile_draw(const struct font_painter *p,
                                const struct font_colour_picture *from,
                                const struct font_map *map, double size_px, double x, double y,
                                double cover, int width, int height, struct font_tile *out)
{
    struct passage w;
    *out = (struct font_tile){0};
    if (!passage_make(from, map, size_px, x, y, width, height, &w))
        return FONT_OK;
    struct font_tile tile = {w.left, w.top, w.right - w.left, w.bottom - w.top, NULL};
    uint8_t *at = tile.rgba = calloc((size_t)tile.width_px * (size_t)tile.height_px, 4);
    if (!at)
        return font_fail(FONT_NO_MEMORY, "no memory for a glyph's picture");
    for (int row = w.top; row < w.bottom; row++)
        for (int column = w.left; column < w.right; column++, at += 4) {
            float sum[4];
            pixel_get(p, from, &w, column, row, sum);
            for (int c = 0; c < 3 && sum[3] > 0; c++)
                at[c] = number_of(p, sum[c] / sum[3]);
            at[3] = (uint8_t)lrint(255 * fmin(1, (double)sum[3] * cover));
        }
    *out = tile;
    return FONT_OK;
}
