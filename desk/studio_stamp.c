/* studio_stamp.c - see studio_stamp.h. */
#include "studio_stamp.h"

#include "studio_session_internal.h"

#include <display.h>
#include <separate.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define DEGREES 57.295779513082323
#define BYTES_MOST 1e9 /* of a picture that is read */
enum { SAMPLES_LEAST = 2, SAMPLES_MOST = 16, GRAYS = 256 };

/* ---- reading ---- */

enum paper_status studio_stamp_read(const char *path, struct studio_stamp *out)
{
    struct display_image image;
    *out = (struct studio_stamp){0};
    if (display_png_bytes(path, 3) > BYTES_MOST)
        return studio_session_failed(PAPER_BAD_FILE,
                                     "%s: too large a picture; make it smaller first", path);
    if (display_png_read_rgb(path, &image) != DISPLAY_OK)
        return studio_session_failed(PAPER_BAD_FILE, "%s", display_error());
    *out = (struct studio_stamp){image.width_px, image.height_px, image.pixels, strdup(path)};
    if (out->path)
        return PAPER_OK;
    studio_stamp_free(out);
    return studio_session_failed(PAPER_NO_MEMORY, "no memory for a picture's name");
}

void studio_stamp_free(struct studio_stamp *stamp)
{
    free(stamp->rgb);
    free(stamp->path);
    *stamp = (struct studio_stamp){0};
}

/* ---- placing ---- */

struct placing {
    const struct studio_stamp *stamp;
    double x, y;        /* its middle, fibers */
    double pixels;      /* of the picture to a fiber */
    double c, s;        /* pixels of the picture for a fiber, along it and across */
    int samples;        /* each way in a fiber */
    float light[GRAYS]; /* of a display value */
};

static const uint8_t *pixel_of(const struct studio_stamp *stamp, int x, int y)
{
    x = x < 0 ? 0 : x >= stamp->width ? stamp->width - 1 : x;
    y = y < 0 ? 0 : y >= stamp->height ? stamp->height - 1 : y;
    return stamp->rgb + 3 * ((size_t)y * (size_t)stamp->width + (size_t)x);
}

/* Adds the picture's light at a place of the sheet, between its pixels' middles. False: it does
 * not lie there. */
static bool light_add(const struct placing *p, double x, double y, double sum[3])
{
    const double right = x - p->x, below = y - p->y,
                 u = p->c * right + p->s * below + p->stamp->width / 2.0,
                 v = p->c * below - p->s * right + p->stamp->height / 2.0;
    if (!(u >= 0 && v >= 0 && u < p->stamp->width && v < p->stamp->height))
        return false;
    const int column = (int)floor(u - 0.5), row = (int)floor(v - 0.5);
    const double along = u - 0.5 - column, down = v - 0.5 - row;
    const uint8_t *q[4] = {pixel_of(p->stamp, column, row), pixel_of(p->stamp, column + 1, row),
                           pixel_of(p->stamp, column, row + 1),
                           pixel_of(p->stamp, column + 1, row + 1)};
    for (int i = 0; i < 3; i++) {
        const double upper =
            (1 - along) * (double)p->light[q[0][i]] + along * (double)p->light[q[1][i]];
        const double lower =
            (1 - along) * (double)p->light[q[2][i]] + along * (double)p->light[q[3][i]];
        sum[i] += (1 - down) * upper + down * lower;
    }
    return true;
}

/* The mean light of the picture in a fiber; returns how much of it the picture covers. */
static double fiber_light(const struct placing *p, int x, int y, double light[3])
{
    const int n = p->samples;
    int hits = 0;
    light[0] = light[1] = light[2] = 0;
    for (int i = 0; i < n * n; i++)
        hits += light_add(p, x + (i % n + 0.5) / n, y + (i / n + 0.5) / n, light);
    for (int i = 0; i < 3 && hits > 0; i++)
        light[i] /= hits;
    return (double)hits / (n * n);
}

static uint8_t byte_of(double value)
{
    return (uint8_t)lrint(255 * fmin(1, fmax(0, value)));
}

/* How dark it is to the eye: a display value, by the luminance (IEC 61966-2-1). */
static double darkness(const double light[3], bool negative)
{
    const double luminance = 0.2126 * light[0] + 0.7152 * light[1] + 0.0722 * light[2],
                 display = paper_light_display(fmin(1, luminance));
    return negative ? display : 1 - display;
}

static void fibers_fill(const struct placing *p, bool negative, struct studio_printed *out)
{
    for (int row = 0; row < out->screen.height_px; row++)
        for (int column = 0; column < out->screen.width_px; column++) {
            const size_t at = (size_t)row * (size_t)out->screen.width_px + (size_t)column;
            double light[3];
            const double cover = fiber_light(p, out->x + column, out->y + row, light);
            out->screen.gray[at] = cover > 0 ? byte_of(cover * darkness(light, negative)) : 0;
            if (!out->rgb)
                continue;
            out->cover[at] = byte_of(cover);
            for (int i = 0; i < 3; i++)
                out->rgb[3 * at + (size_t)i] = byte_of(paper_light_display(fmin(1, light[i])));
        }
}

/* The fibers that it touches, of those on the sheet. False: none. */
static bool box_make(const struct placing *p, const struct paper_sheet_config *config,
                     struct studio_printed *out)
{
    const double wide = p->stamp->width / p->pixels / 2,
                 high = p->stamp->height / p->pixels / 2, c = fabs(p->c / p->pixels),
                 s = fabs(p->s / p->pixels), across = c * wide + s * high,
                 down = s * wide + c * high;
    double left = floor(p->x - across), top = floor(p->y - down), right = ceil(p->x + across),
           bottom = ceil(p->y + down);
    if (config) {
        left = fmax(0, left);
        top = fmax(0, top);
        right = fmin(config->width, right);
        bottom = fmin(config->height, bottom);
    }
    if (!(right > left && bottom > top))
        return false;
    out->x = (int)left;
    out->y = (int)top;
    out->screen.width_px = (int)(right - left);
    out->screen.height_px = (int)(bottom - top);
    return true;
}

enum paper_status studio_stamp_place(const struct studio_stamp *stamp,
                                     const struct studio_settings *settings, double x, double y,
                                     const struct paper_sheet_config *config,
                                     struct studio_printed *out)
{
    const double *value = settings->value, angle = -value[STUDIO_STAMP_ANGLE] / DEGREES;
    const int longer = stamp->width > stamp->height ? stamp->width : stamp->height;
    struct placing p = {
        .stamp = stamp, .x = x, .y = y, .pixels = longer / value[STUDIO_STAMP_SIZE]};
    p.c = p.pixels * cos(angle);
    p.s = p.pixels * sin(angle);
    p.samples = (int)fmin(SAMPLES_MOST, fmax(SAMPLES_LEAST, ceil(p.pixels)));
    for (int i = 0; i < GRAYS; i++)
        p.light[i] = (float)paper_light_linear(i / 255.0);
    *out = (struct studio_printed){0};
    if (!box_make(&p, config, out))
        return PAPER_OK;
    const size_t count = (size_t)out->screen.width_px * (size_t)out->screen.height_px;
    const bool colours = (int)value[STUDIO_STAMP_AS] == STUDIO_STAMP_COLOURS;
    out->screen.gray = malloc(count);
    out->rgb = colours ? malloc(3 * count) : NULL;
    out->cover = colours ? malloc(count) : NULL;
    if (!out->screen.gray || (colours && !(out->rgb && out->cover))) {
        studio_printed_free(out);
        return studio_session_failed(PAPER_NO_MEMORY, "no memory for a picture on the sheet");
    }
    fibers_fill(&p, value[STUDIO_STAMP_NEGATIVE] != 0, out);
    return PAPER_OK;
}

void studio_printed_free(struct studio_printed *printed)
{
    paper_screen_destroy(&printed->screen);
    free(printed->rgb);
    free(printed->cover);
    *printed = (struct studio_printed){0};
}

/* ---- in its own colours ---- */

enum paper_status studio_printed_separate(const struct studio_printed *printed,
                                          const struct paper_sheet_config *config, double water,
                                          struct paper_print *print, float **planes)
{
    const struct paper_separation s = paper_separation_of(config);
    const size_t count = (size_t)printed->screen.width_px * (size_t)printed->screen.height_px;
    float *amount[PAPER_PIGMENTS_MAX];
    *print = (struct paper_print){.x = printed->x,
                                  .y = printed->y,
                                  .width = printed->screen.width_px,
                                  .height = printed->screen.height_px};
    *planes = calloc(count * (size_t)(1 + s.pigments_count), sizeof **planes);
    if (!*planes)
        return studio_session_failed(PAPER_NO_MEMORY, "no memory for a picture's colours");
    for (int i = 0; i < s.pigments_count; i++)
        amount[i] = *planes + count * (size_t)(1 + i);
    const enum paper_status status = paper_separate(&s, printed->rgb, count, amount);
    for (size_t at = 0; at < count && status == PAPER_OK; at++) {
        const float part = (float)printed->cover[at] / 255;
        (*planes)[at] = part * (float)water;
        for (int i = 0; i < s.pigments_count; i++)
            amount[i][at] *= part;
    }
    if (water > 0)
        print->amount[0] = *planes;
    for (int i = 0; i < s.pigments_count; i++)
        print->amount[1 + i] = amount[i];
    return status;
}
