/* stage_loop.c - see stage_loop.h. */
#include "stage_loop.h"

#include <ink.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define KEPT_BYTES_MAX ((size_t)1 << 31)

enum stage_status stage_loop_begin(struct stage_loop *l, double loop_s, double seconds, int fps)
{
    *l = (struct stage_loop){.loop = (int)lround(loop_s * fps),
                             .count = (int)lround(seconds * fps)};
    if (l->loop < 1 || l->loop >= l->count)
        return stage_fail(STAGE_BAD_ARGUMENT,
                          "a loop's fade is a picture at least, and shorter than the film "
                          "(got %g of %g s)",
                          loop_s, seconds);
    l->kept = calloc((size_t)l->loop, sizeof *l->kept);
    return l->kept ? STAGE_OK : stage_fail(STAGE_NO_MEMORY, "no memory for a loop");
}

void stage_loop_finish(struct stage_loop *l)
{
    for (int i = 0; l->kept && i < l->loop; i++)
        display_image_destroy(&l->kept[i]);
    free(l->kept);
    *l = (struct stage_loop){0};
}

static enum stage_status picture_keep(struct stage_loop *l, int frame,
                                      const struct display_image *image)
{
    const size_t bytes =
        (size_t)image->width_px * (size_t)image->height_px * (size_t)image->channels;
    struct display_image *kept = &l->kept[frame];
    *kept = *image;
    kept->pixels = NULL;
    if (bytes * (size_t)l->loop > KEPT_BYTES_MAX)
        return stage_fail(STAGE_NO_MEMORY,
                          "a loop keeps the pictures of its fade: at most %zu MB (these: %zu)",
                          KEPT_BYTES_MAX >> 20, (bytes * (size_t)l->loop) >> 20);
    if (display_image_create(kept) != DISPLAY_OK)
        return stage_fail(STAGE_NO_MEMORY, "%s", display_error());
    memcpy(kept->pixels, image->pixels, bytes);
    return STAGE_OK;
}

bool stage_loop_take(struct stage_loop *l, int frame, struct display_image *image,
                     enum stage_status *status)
{
    if (frame < l->loop) {
        *status = picture_keep(l, frame, image);
        return false;
    }
    if (frame >= l->count) {
        const int at = frame - l->count;
        stage_loop_fade(image, &l->kept[at], (at + 1.0) / (l->loop + 1));
    }
    return true;
}

/* ---- by light ---- */

static uint8_t number_of(double light)
{
    return (uint8_t)lround(255 * fmin(1, fmax(0, font_number(light, 0))));
}

void stage_loop_fade(struct display_image *from, const struct display_image *into, double part)
{
    const size_t pixels = (size_t)from->width_px * (size_t)from->height_px;
    const int channels = from->channels, colours = channels == 4 ? 3 : channels;
    double light[256];
    for (int i = 0; i < 256; i++)
        light[i] = font_light(i / 255.0, 0); /* by sRGB's curve */
    for (size_t i = 0; i < pixels; i++) {
        uint8_t *a = from->pixels + i * (size_t)channels;
        const uint8_t *b = into->pixels + i * (size_t)channels;
        if (!memcmp(a, b, (size_t)channels))
            continue;
        const double covers_a = (1 - part) * (channels == 4 ? a[3] / 255.0 : 1),
                     covers_b = part * (channels == 4 ? b[3] / 255.0 : 1);
        const double covers = covers_a + covers_b;
        for (int c = 0; c < colours && covers > 0; c++)
            a[c] = number_of((covers_a * light[a[c]] + covers_b * light[b[c]]) / covers);
        if (channels == 4)
            a[3] = (uint8_t)lround(255 * covers);
    }
}
