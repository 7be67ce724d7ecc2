/* seen.c - a program's lights and displays as a picture: see keeper.h. What comes through its
 * pipes may be anything. */
#include "keeper.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static int light_take(void *context, const struct light_frame *frame)
{
    struct seen *s = context;
    s->last = *frame;
    s->display = 0;
    s->taken = true;
    return 1;
}

static int display_take(void *context, const struct display_change *change)
{
    struct seen *s = context;
    if (!change->seen && !change->opened)
        return 1;
    s->display = change->number;
    s->taken = s->taken || change->seen;
    return 1;
}

bool seen_make(struct seen *s, int width_px, int height_px)
{
    *s = (struct seen){.width_px = width_px, .height_px = height_px};
    s->lights = (struct light_reader){.take = light_take, .context = s};
    s->displays = (struct display_reader){.take = display_take, .context = s};
    s->rgb = calloc(3 * (size_t)width_px, (size_t)height_px);
    return s->rgb != NULL;
}

/* ---- taking ---- */

/* The next state of the lights. */
static bool lights_take(struct seen *s, int lights)
{
    while (lights >= 0 && !s->taken) {
        const size_t all =
            s->lights.begun ? LIGHT_RECORDING_FRAME_BYTES : LIGHT_RECORDING_LINE_BYTES;
        uint8_t bytes[LIGHT_RECORDING_FRAME_BYTES];
        const ssize_t got =
            read(lights, bytes, all > s->lights.held ? all - s->lights.held : 1);
        if (got <= 0)
            return true;
        if (light_reader_feed(&s->lights, bytes, (size_t)got) != DISPLAY_OK)
            return false;
    }
    return true;
}

/* The next change of what a display shows; of pieces up to so many bytes. */
static bool displays_take(struct seen *s, int displays)
{
    enum { STEP = 32, MOST = 64 << 20 };
    for (size_t all = 0; displays >= 0 && !s->taken && all < MOST; all += STEP) {
        if (s->at == s->held) {
            const ssize_t got = read(displays, s->bytes, sizeof s->bytes);
            if (got <= 0)
                return true;
            s->held = (size_t)got;
            s->at = 0;
        }
        const size_t left = s->held - s->at, step = left < STEP ? left : STEP;
        if (display_reader_feed(&s->displays, s->bytes + s->at, step) != DISPLAY_OK)
            return false;
        s->at += step;
    }
    return true;
}

bool seen_take(struct seen *s, int lights, int displays, bool *came, const char **why)
{
    s->taken = false;
    const bool good = lights_take(s, lights) && (s->taken || displays_take(s, displays));
    *came = s->taken;
    s->drawn = s->drawn && !s->taken;
    *why = good ? NULL : display_error();
    return good;
}

/* ---- drawing ---- */

/* Into the picture's middle. */
static void image_put(struct seen *s, const struct display_image *image)
{
    const int left = (s->width_px - image->width_px) / 2,
              top = (s->height_px - image->height_px) / 2;
    for (int y = 0; y < image->height_px; y++)
        memcpy(s->rgb + 3 * ((size_t)(y + top) * (size_t)s->width_px + (size_t)left),
               image->pixels + 3 * (size_t)y * (size_t)image->width_px,
               3 * (size_t)image->width_px);
}

static bool lights_draw(struct seen *s)
{
    struct display_image image = {0};
    struct front_panel_config config = front_panel_config_default();
    config.width_px = s->width_px > FRONT_PANEL_SIDE_MIN ? s->width_px : FRONT_PANEL_SIDE_MIN;
    config.height_px =
        s->height_px > FRONT_PANEL_SIDE_MIN ? s->height_px : FRONT_PANEL_SIDE_MIN;
    config.view = FRONT_PANEL_FRONT;
    if (config.width_px != s->width_px || config.height_px != s->height_px)
        return true; /* too small for doors */
    if (!s->panel && front_panel_create(&config, &s->panel) != DISPLAY_OK)
        return false;
    if (front_panel_draw(s->panel, s->last.lights, &image) != DISPLAY_OK)
        return false;
    image_put(s, &image);
    display_image_destroy(&image);
    return true;
}

/* The mean of an image's pixels below one of the picture's. */
static void pixel_mean(const struct display_image *image, double x, double y, double step,
                       uint8_t *to)
{
    const int left = (int)x, top = (int)y,
              right = (int)fmin(image->width_px, fmax(left + 1, floor(x + step))),
              bottom = (int)fmin(image->height_px, fmax(top + 1, floor(y + step)));
    long sum[3] = {0}, count = 0;
    for (int v = top; v < bottom; v++)
        for (int u = left; u < right; u++, count++)
            for (int k = 0; k < 3; k++)
                sum[k] += image->pixels[3 * ((size_t)v * (size_t)image->width_px + (size_t)u) +
                                        (size_t)k];
    for (int k = 0; k < 3; k++)
        to[k] = (uint8_t)(count ? sum[k] / count : 0);
}

/* As large as there is room: pixels become whole squares, or means where it is larger. */
static bool display_draw(struct seen *s, const struct display_screen *screen)
{
    struct display_image image = {0};
    if (display_screen_picture(screen, &image) != DISPLAY_OK)
        return false;
    const double scale = fmin(s->width_px / (double)image.width_px,
                              s->height_px / (double)image.height_px),
                 step = scale >= 1 ? 1 / floor(scale) : 1 / scale;
    const int width = (int)fmin(s->width_px, fmax(1, floor(image.width_px / step + 1e-6))),
              height = (int)fmin(s->height_px, fmax(1, floor(image.height_px / step + 1e-6))),
              left = (s->width_px - width) / 2, top = (s->height_px - height) / 2;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++)
            pixel_mean(&image, fmin(image.width_px - 1, x * step + 1e-9),
                       fmin(image.height_px - 1, y * step + 1e-9), step,
                       s->rgb +
                           3 * ((size_t)(y + top) * (size_t)s->width_px + (size_t)(x + left)));
    display_image_destroy(&image);
    return true;
}

bool seen_draw(struct seen *s)
{
    const struct display_screen *screen =
        s->display ? &s->displays.screens[s->display - 1] : NULL;
    if (s->drawn)
        return true;
    memset(s->rgb, 0, 3 * (size_t)s->width_px * (size_t)s->height_px);
    s->drawn = screen && screen->there ? display_draw(s, screen) : lights_draw(s);
    return s->drawn;
}
