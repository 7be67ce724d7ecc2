/* gold.c - see gold.h. A pixel is the integral along the outline of G(X - x, Y - y) dy, where G
 * is f's integral over x: ink to the right of an edge that rises in the picture. Columns right
 * of the filter's reach get all of G's row at once, so the sums are differences between
 * columns. */
#include "gold.h"
#include "filter_internal.h"
#include "internal.h"

#include <math.h>
#include <stdlib.h>

static const double step_px = 1.0 / 96;

struct gold {
    const struct font_filter *filter;
    double *sums; /* differences between columns, width + 1 a row */
    int width, height;
    double side;
};

/* From (x0, y0) to (x1, y1), in pixels from the picture's corner, a step that is all but
 * straight. */
static void step_add(struct gold *g, double x0, double y0, double x1, double y1)
{
    const struct font_filter *f = g->filter;
    double r = f->radius, x = 0.5 * (x0 + x1), y = 0.5 * (y0 + y1), dy = y1 - y0;
    int top = (int)fmax(0, ceil(y - r - 0.5 - fabs(dy)));
    int bottom = (int)fmin(g->height - 1, floor(y + r - 0.5 + fabs(dy)));
    int left = (int)fmax(0, ceil(x - r - 0.5)), right = (int)floor(x + r - 0.5) + 1;
    right = right < left
                ? left
                : right; /* left of the picture: all of it counts from the first column on */
    double columns[2 * FONT_FILTER_RADIUS_MAX + 4], whole = 0;
    if (!f->round) {
        for (int i = left; i <= right; i++)
            columns[i - left] = font_term_integral(f, 0, i + 0.5 - x);
        whole = 1;
    }
    for (int j = top; j <= bottom; j++) {
        double *row = g->sums + (size_t)j * (size_t)(g->width + 1);
        double v = j + 0.5 - y, weight, before = 0;
        /* A product's integral along y is exact; round filters take the middle. */
        if (f->round) {
            weight = dy * g->side;
            whole = font_filter_row_integral(f, r, v);
        } else {
            weight = (font_term_integral(f, 0, j + 0.5 - y0) -
                      font_term_integral(f, 0, j + 0.5 - y1)) *
                     g->side;
        }
        if (weight == 0 || whole == 0)
            continue;
        for (int i = left; i <= right && i <= g->width; i++) {
            double here =
                f->round ? font_filter_row_integral(f, i + 0.5 - x, v) : columns[i - left];
            if (i == right)
                here = whole; /* from here on all of it */
            row[i] += weight * (here - before);
            before = here;
        }
    }
}

static enum font_status segment_add(struct gold *g, const struct font_segment *s,
                                    const struct font_map *map, double ox, double oy)
{
    struct font_point before, here, tried;
    double j[4], longest = 0;
    if (!font_map_point(map, s->p[0], &before, j))
        return font_fail(FONT_BAD_ARGUMENT, "the distortion sends a glyph beyond the horizon");
    tried = before;
    for (int k = 1; k <= 16; k++) {
        if (!font_map_point(map, font_segment_at(s, k / 16.0, NULL), &here, j))
            return font_fail(FONT_BAD_ARGUMENT,
                             "the distortion sends a glyph beyond the horizon");
        longest = fmax(longest, hypot(here.x - tried.x, here.y - tried.y));
        tried = here;
    }
    int n = (int)fmin(ceil(longest * 16 / step_px) + 1, 4e6);
    for (int k = 1; k <= n; k++) {
        font_map_point(map, font_segment_at(s, (double)k / n, NULL), &here, j);
        step_add(g, before.x + ox, before.y + oy, here.x + ox, here.y + oy);
        before = here;
    }
    return FONT_OK;
}

enum font_status font_gold_draw(const struct font_outline *outline, const struct font_map *map,
                                const struct font_filter *filter, double x_px, double y_px,
                                int left, int top, int width, int height, double *pixels)
{
    struct gold g = {.filter = filter, .width = width, .height = height};
    size_t row = (size_t)(width > 0 ? width : 0) + 1;
    if (width <= 0 || height <= 0 || !outline->prepared)
        return font_fail(FONT_BAD_ARGUMENT, "gold needs a picture and a prepared outline");
    if (outline->tangled)
        return font_fail(FONT_TOO_LARGE, "an outline is too tangled for gold");
    g.sums = calloc(row * (size_t)height, sizeof *g.sums);
    if (!g.sums)
        return font_fail(FONT_NO_MEMORY, "no memory for gold");
    struct font_box box = font_outline_box(outline);
    struct font_point middle = {(box.x0 + box.x1) / 2, (box.y0 + box.y1) / 2}, to;
    double j[4] = {0};
    font_map_point(map, middle, &to, j);
    /* Ink is to the right of segments with turn 1, y upwards; turned over by the map. Where it
     * is to the right and the edge rises in the picture (y falls), the integral counts -dy. */
    g.side = outline->turn * (j[0] * j[3] - j[1] * j[2] < 0 ? -1 : 1);
    enum font_status status = FONT_OK;
    for (int i = 0; i < outline->segments_count && status == FONT_OK; i++)
        status = segment_add(&g, &outline->segments[i], map, x_px - left, y_px - top);
    for (int r = 0; r < height && status == FONT_OK; r++) {
        double sum = 0;
        for (int c = 0; c < width; c++) {
            sum += g.sums[(size_t)r * row + (size_t)c];
            pixels[(size_t)r * (size_t)width + (size_t)c] = sum;
        }
    }
    free(g.sums);
    return status;
}

void font_gold_compare(const struct font_gray *gray, bool exact, int left, int top, int width,
                       int height, const double *gold, struct font_difference *sum)
{
    for (int r = 0; r < height; r++)
        for (int c = 0; c < width; c++) {
            int x = left + c - gray->left_px, y = top + r - gray->top_px;
            double have = 0, want = gold[(size_t)r * (size_t)width + (size_t)c];
            if (gray->pixels && x >= 0 && y >= 0 && x < gray->width_px && y < gray->height_px) {
                size_t at = (size_t)y * (size_t)gray->pitch + (size_t)x;
                have = exact ? (double)gray->exact[at] : gray->pixels[at] / 255.0;
            }
            if (!exact)
                want = fmin(fmax(want, 0), 1); /* as bytes must be */
            sum->max = fmax(sum->max, 255 * fabs(have - want));
            sum->square_sum += (have - want) * (have - want);
            sum->ink += have;
            sum->ink_gold += want;
            sum->pixels_count++;
        }
}

void font_gold_bytes_compare(const double *gold, int count, struct font_difference *sum)
{
    for (int i = 0; i < count; i++) {
        double want = fmin(fmax(gold[i], 0), 1), have = rint(255 * want) / 255;
        sum->max = fmax(sum->max, 255 * fabs(have - want));
        sum->square_sum += (have - want) * (have - want);
        sum->ink += have;
        sum->ink_gold += want;
        sum->pixels_count++;
    }
}

double font_difference_psnr(const struct font_difference *d)
{
    if (!d->pixels_count || d->square_sum == 0)
        return 200;
    return -10 * log10(d->square_sum / (double)d->pixels_count);
}
