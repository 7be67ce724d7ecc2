/* proof.c - a word's contrast, edges, errors and reach: see proof.h. */
#include "proof.h"
#include "filter_internal.h"
#include "internal.h"
#include "paint.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PIXELS_MAX = 1 << 20, MARGIN = 8 };

/* A word's pixels, and the same `fine` times as fine. */
struct word {
    int width, height, fine;
    double x, y; /* of the layout's origin */
};

static enum font_status word_measure(struct font_painter *painter,
                                     const struct font_proof_def *def, struct word *w)
{
    struct font_box box;
    enum font_status status = font_painter_measure(painter, def->layout, NULL, 0, 0, &box);
    if (status != FONT_OK)
        return status;
    if (!(box.x1 > box.x0))
        return font_fail(FONT_BAD_ARGUMENT, "there is no ink to be measured");
    double margin = ceil(MARGIN + def->x_height_px);
    double width = box.x1 - box.x0 + 2 * margin, height = box.y1 - box.y0 + 2 * margin;
    if (!(width * height <= PIXELS_MAX))
        return font_fail(FONT_TOO_LARGE, "a word of %.0fx%.0f pixels is too large", width,
                         height);
    *w = (struct word){(int)width, (int)height, def->x_height_px > 9 ? 2 : 4, margin - box.x0,
                       margin - box.y0};
    return FONT_OK;
}

/* The word's cover, of 1, `fine` times as fine. */
static enum font_status word_draw(struct font_painter *painter,
                                  const struct font_layout *layout, const struct word *w,
                                  int fine, float *out)
{
    const struct font_map larger = {FONT_AFFINE, {fine, 0, 0, 0, fine, 0}};
    size_t count = (size_t)(w->width * fine) * (size_t)(w->height * fine);
    struct font_cover cover = {w->width * fine, w->height * fine, w->width * fine,
                               calloc(count, 1)};
    if (!cover.gray)
        return font_fail(FONT_NO_MEMORY, "no memory for a proof");
    enum font_status status = font_painter_cover(painter, layout, fine > 1 ? &larger : NULL,
                                                 w->x * fine, w->y * fine, &cover);
    for (size_t i = 0; i < count; i++)
        out[i] = (float)cover.gray[i] / 255;
    free(cover.gray);
    return status;
}

/* Weighs each column's values by taps around them; rows and columns change places, so that
 * twice is both ways. */
static void columns_weigh(const float *from, int width, int height, const float *taps,
                          int reach, float *to)
{
    enum { SOME = 64 };
    for (int r = 0; r < height; r++)
        for (int c = 0; c < width; c += SOME) {
            float sums[SOME] = {0};
            int some = width - c < SOME ? width - c : SOME;
            int first = r - reach < 0 ? reach - r : 0,
                last = r + reach >= height ? reach + height - 1 - r : 2 * reach;
            for (int k = first; k <= last; k++) {
                const float *row = from + (size_t)(r + k - reach) * (size_t)width + c;
                const float tap = taps[k];
                for (int i = 0; i < some; i++)
                    sums[i] += tap * row[i];
            }
            for (int i = 0; i < some; i++)
                to[(size_t)(c + i) * (size_t)height + (size_t)r] = sums[i];
        }
}

enum { TAPS_MAX = 2048 };

/* Blurs by a Gaussian in place; room: as large. */
static void blur(float *values, int width, int height, double sigma, float *room)
{
    float taps[2 * TAPS_MAX + 1];
    int reach = (int)fmin(TAPS_MAX, ceil(4 * sigma));
    double sum = 0;
    if (!(sigma > 0.05))
        return;
    for (int k = -reach; k <= reach; k++)
        sum += exp(-0.5 * k * k / (sigma * sigma));
    for (int k = -reach; k <= reach; k++)
        taps[k + reach] = (float)(exp(-0.5 * k * k / (sigma * sigma)) / sum);
    columns_weigh(values, width, height, taps, reach, room);
    columns_weigh(room, height, width, taps, reach, values);
}

static double mean_square(const float *values, size_t count)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++)
        sum += (double)values[i] * (double)values[i];
    return sum / (double)count;
}

/* Takes away what is wider than half the letters' height. */
static void details_keep(float *fine, const struct word *w, double x_height_px, float *room,
                         float *copy)
{
    const int width = w->width * w->fine, height = w->height * w->fine;
    size_t count = (size_t)width * (size_t)height;
    memcpy(copy, fine, count * sizeof *copy);
    blur(copy, width, height, w->fine * x_height_px / 2, room);
    for (size_t i = 0; i < count; i++)
        fine[i] -= copy[i];
}

/* What is left of the details' contrast behind an eye's blur, in pixels. */
static double left_of(const float *fine, const struct word *w, double sigma_px, float *room,
                      float *copy)
{
    const int width = w->width * w->fine, height = w->height * w->fine;
    size_t count = (size_t)width * (size_t)height;
    memcpy(copy, fine, count * sizeof *copy);
    blur(copy, width, height, w->fine * sigma_px, room);
    return mean_square(copy, count);
}

/* What a display shows of pixels: each a spot, on the fine grid. */
static void show(const float *pixels, const struct word *w, enum font_display display,
                 float *room, float *fine)
{
    enum { REACH = 3 };
    const int width = w->width * w->fine, height = w->height * w->fine;
    const float *from = pixels;
    float *to = room;
    for (int way = 0; way < 2; way++) { /* rows become longer, and change places with columns */
        int have = way ? w->height : w->width, wide = way ? height : width,
            high = way ? width : w->height;
        for (int r = 0; r < high; r++)
            for (int c = 0; c < wide; c++) {
                double at = (c + 0.5) / w->fine, sum = 0, all = 0;
                for (int k = (int)at - REACH; k <= (int)at + REACH; k++) {
                    double part = font_display_spot(display, at - k - 0.5);
                    all += part;
                    if (k >= 0 && k < have)
                        sum += part * (double)from[r * have + k];
                }
                to[c * high + r] = (float)(sum / all); /* paper is as light everywhere */
            }
        from = room;
        to = fine;
    }
}

static double edge_width(const struct font_filter *f)
{
    double at[2];
    for (int i = 0; i < 2; i++) {
        double low = -FONT_FILTER_RADIUS_MAX, high = FONT_FILTER_RADIUS_MAX;
        for (int n = 0; n < 40; n++) {
            double middle = (low + high) / 2;
            if (font_filter_edge(f, middle) < (i ? 0.9 : 0.1))
                low = middle;
            else
                high = middle;
        }
        at[i] = low;
    }
    return at[1] - at[0];
}

static void pixels_compare(const float *pixels, const float *exact, size_t count,
                           struct font_proof *out)
{
    double ink = 0, square = 0, error = 0;
    long inked = 0;
    for (size_t i = 0; i < count; i++) {
        double c = (double)pixels[i], d = c - (double)exact[i];
        ink += c;
        square += c * c;
        error += d * d;
        inked += pixels[i] > 0 || exact[i] > 0;
    }
    out->contrast = ink > 0 ? square / ink : 0;
    out->error = inked ? 255 * sqrt(error / (double)inked) : 0;
}

/* The blur at which as much is left as of the word without pixels at its limit, over that
 * limit's. */
static double reach_find(const float *fine, const float *ideal, const struct word *w,
                         double x_height_px, float *room, float *copy)
{
    const double limit = x_height_px / 5; /* an arc minute where the x-height has five */
    double least = left_of(ideal, w, limit, room, copy), low = 0, high = 2 * limit;
    if (left_of(fine, w, 0, room, copy) <= least)
        return 0;
    for (int n = 0; n < 10; n++) {
        double middle = (low + high) / 2;
        if (left_of(fine, w, middle, room, copy) > least)
            low = middle;
        else
            high = middle;
    }
    return low / limit;
}

enum font_status font_proof_make(const struct font_proof_def *def, struct font_proof *out)
{
    struct font_painter_def painting = font_painter_def_default();
    struct font_painter *painter = NULL, *exact = NULL;
    struct word w = {0};
    float *memory = NULL;
    *out = (struct font_proof){0};
    if (!(def->x_height_px > 0.5))
        return font_fail(FONT_BAD_ARGUMENT, "letters of %g pixels are too small to be measured",
                         def->x_height_px);
    painting.filter = def->filter;
    painting.without_own = !def->own;
    enum font_status status = font_painter_create(&painting, &painter);
    painting.filter = "box";
    painting.without_own = true;
    if (status == FONT_OK)
        status = font_painter_create(&painting, &exact);
    if (status == FONT_OK)
        status = word_measure(painter, def, &w);
    size_t count = (size_t)w.width * (size_t)w.height, fine = count * (size_t)(w.fine * w.fine);
    if (status == FONT_OK && !(memory = malloc((2 * count + 4 * fine) * sizeof *memory)))
        status = font_fail(FONT_NO_MEMORY, "no memory for a proof");
    float *pixels = memory, *cover = memory + count, *shown = cover + count,
          *ideal = shown + fine, *room = ideal + fine, *copy = room + fine;
    if (status == FONT_OK)
        status = word_draw(painter, def->layout, &w, 1, pixels);
    if (status == FONT_OK)
        status = word_draw(exact, def->layout, &w, 1, cover);
    if (status == FONT_OK)
        status = word_draw(exact, def->layout, &w, w.fine, ideal);
    if (status == FONT_OK) {
        pixels_compare(pixels, cover, count, out);
        out->edge_px = edge_width(font_painter_filter(painter));
        show(pixels, &w, def->display, room, shown);
        details_keep(shown, &w, def->x_height_px, room, copy);
        details_keep(ideal, &w, def->x_height_px, room, copy);
        out->reach = reach_find(shown, ideal, &w, def->x_height_px, room, copy);
    }
    free(memory);
    font_painter_destroy(painter);
    font_painter_destroy(exact);
    return status;
}
