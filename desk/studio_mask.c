/* studio_mask.c - see studio_mask.h. */
#include "studio_mask.h"

#include <math.h>
#include <stdlib.h>

struct box {
    int left, top, right, bottom;
};

static int clipped(double value, int most)
{
    return (int)fmin(most, fmax(0, value));
}

static struct box box_of(const struct studio_disc *a, const struct studio_disc *b, int width,
                         int height)
{
    const double soft = 1;
    return (struct box){
        clipped(floor(fmin(a->x - a->radius, b->x - b->radius) - soft), width),
        clipped(floor(fmin(a->y - a->radius, b->y - b->radius) - soft), height),
        clipped(ceil(fmax(a->x + a->radius, b->x + b->radius) + soft), width),
        clipped(ceil(fmax(a->y + a->radius, b->y + b->radius) + soft), height),
    };
}

/* How much of the fiber at x, y a piece of the way covers, 0..1. */
static double covered(const struct studio_disc *a, const struct studio_disc *b, double x,
                      double y)
{
    const double along_x = b->x - a->x, along_y = b->y - a->y,
                 length = along_x * along_x + along_y * along_y;
    double part = length > 0 ? ((x - a->x) * along_x + (y - a->y) * along_y) / length : 0;
    part = fmin(1, fmax(0, part));
    const double away = hypot(x - a->x - part * along_x, y - a->y - part * along_y),
                 radius = a->radius + part * (b->radius - a->radius);
    return fmin(1, fmax(0, radius - away + 0.5));
}

static void piece_draw(struct paper_screen *screen, const struct box *all,
                       const struct studio_disc *a, const struct studio_disc *b)
{
    const struct box box = box_of(a, b, all->right, all->bottom);
    for (int y = box.top; y < box.bottom; y++) {
        uint8_t *row = screen->gray + (size_t)(y - all->top) * (size_t)screen->width_px;
        for (int x = box.left; x < box.right; x++) {
            const uint8_t gray = (uint8_t)lrint(255 * covered(a, b, x + 0.5, y + 0.5));
            if (gray > row[x - all->left])
                row[x - all->left] = gray;
        }
    }
}

enum paper_status studio_mask_sweep(const struct studio_disc *discs, int count, int width,
                                    int height, struct paper_screen *screen, int *x, int *y)
{
    struct box all = {width, height, 0, 0};
    *screen = (struct paper_screen){0};
    for (int i = 0; i < count; i++) {
        const struct box box = box_of(&discs[i], &discs[i], width, height);
        all.left = box.left < all.left ? box.left : all.left;
        all.top = box.top < all.top ? box.top : all.top;
        all.right = box.right > all.right ? box.right : all.right;
        all.bottom = box.bottom > all.bottom ? box.bottom : all.bottom;
    }
    if (all.left >= all.right || all.top >= all.bottom)
        return PAPER_OK;
    *x = all.left;
    *y = all.top;
    screen->width_px = all.right - all.left;
    screen->height_px = all.bottom - all.top;
    screen->gray = calloc((size_t)screen->width_px * (size_t)screen->height_px, 1);
    if (!screen->gray) {
        *screen = (struct paper_screen){0};
        return PAPER_NO_MEMORY;
    }
    for (int i = 0; i < count; i++)
        piece_draw(screen, &all, &discs[i ? i - 1 : 0], &discs[i]);
    return PAPER_OK;
}
