/* charged.c - letters as a painter fills them: with a thin wash first, and while they are wet
 * with drops of strong colour, here and there. */
#include "drawing.h"
#include "model/brush_internal.h"
#include "techniques.h"

#include <math.h>
#include <stdlib.h>

#define TURN 6.28318530717958647693
enum { CORNERS = 24, DROPS_MOST = 120 };
#define THIN 0.42           /* of the pigments, in the wash */
#define STRONG 0.6          /* and in the drops */
#define DROPS_WATER 0.1     /* of the water */
#define DROPS_IN_SQUARE 3.2 /* of a letter's size */
#define RADIUS_LEAST 0.14   /* of a letter's size, of a drop's middle */
#define RADIUS_MORE 0.22
/* A drop has no edge: it is put in so many times, wider and wider. With hard edges eddies made
 * spots of them, in letters as large as a hand. */
enum { RINGS = 4 };
#define RING_WIDER 0.07 /* of a letter's size */
#define FROM_TOP 0.15   /* of the screen's height: the tips of letters stay light */

/* What the drops are drawn from: discs over the screen, joined. */
static void drops_draw(struct event_bytes *b, const struct paper_screen *screen, int left,
                       int top, double size, double wider, uint64_t seed)
{
    const double squares = screen->width_px * (double)screen->height_px / (size * size);
    const int count = (int)fmax(1, fmin(DROPS_MOST, ceil(squares * DROPS_IN_SQUARE)));
    for (int i = 0; i < count; i++) {
        const uint64_t n = (uint64_t)i;
        const double x = left + screen->width_px * sheet_chance(seed, n, 1),
                     y = top + screen->height_px *
                                   (FROM_TOP + (1 - FROM_TOP) * sheet_chance(seed, n, 2)),
                     radius =
                         size * (wider + RADIUS_LEAST + RADIUS_MORE * sheet_chance(seed, n, 3));
        double corners[2 * CORNERS];
        for (int k = 0; k < CORNERS; k++) {
            corners[2 * k] = x + radius * cos(TURN * k / CORNERS);
            corners[2 * k + 1] = y + radius * sin(TURN * k / CORNERS);
        }
        paper_drawing_polygon(b, corners, CORNERS);
        if (i > 0)
            paper_drawing_join(b, '+');
    }
}

/* The screen, where the drops fall: both keep what they were drawn from. */
static enum paper_status drops_put(struct paper_sheet *p, const struct paper_screen *screen,
                                   int x, int y, const double *amount, double size,
                                   double wider, uint64_t seed)
{
    struct event_bytes b = {0};
    struct paper_screen drops, both = *screen;
    struct paper_drawing drawing = {.scale = 1};
    int left, top;
    drops_draw(&b, screen, x, y, size, wider, seed);
    both.gray = calloc((size_t)screen->height_px, (size_t)screen->width_px);
    enum paper_status status = PAPER_OK;
    if (b.short_of_memory || !both.gray)
        status = paper_fail(PAPER_NO_MEMORY, "no memory for drops of colour");
    if (status == PAPER_OK)
        status =
            paper_drawing_screen(&(struct paper_drawing){b.at, b.count, 1}, 1,
                                 p->page.grid.width, p->page.grid.height, &drops, &left, &top);
    if (status == PAPER_OK) {
        for (int row = 0; row < drops.height_px; row++)
            for (int column = 0; column < drops.width_px; column++) {
                const int to_x = left + column - x, to_y = top + row - y;
                if (to_x < 0 || to_y < 0 || to_x >= both.width_px || to_y >= both.height_px)
                    continue;
                const size_t at = (size_t)to_y * (size_t)both.width_px + (size_t)to_x,
                             from = (size_t)row * (size_t)drops.width_px + (size_t)column;
                both.gray[at] =
                    (uint8_t)paper_gray_join('*', screen->gray[at], drops.gray[from]);
            }
        paper_screen_destroy(&drops);
        both.drawing = NULL;
        if (screen->drawing && screen->drawing->scale == 1) {
            event_put_bytes(&b, screen->drawing->bytes, screen->drawing->count);
            paper_drawing_join(&b, '*');
            drawing.bytes = b.at;
            drawing.count = b.count;
            both.drawing = b.short_of_memory ? NULL : &drawing;
        }
        status = paper_sheet_put(p, &both, x, y, amount);
    }
    free(both.gray);
    free(b.at);
    return status;
}

enum paper_status paper_sheet_put_charged(struct paper_sheet *p,
                                          const struct paper_screen *screen, int x, int y,
                                          const double *amount, double size)
{
    double wash[1 + PAPER_PIGMENTS_MAX] = {amount[0]},
                    strong[1 + PAPER_PIGMENTS_MAX] = {DROPS_WATER / RINGS * amount[0]};
    if (!(size >= 1))
        return paper_fail(PAPER_BAD_ARGUMENT, "a letter's size must be 1 or more (got %g)",
                          size);
    for (int i = 1; i <= p->config.pigments_count; i++) {
        wash[i] = THIN * amount[i];
        strong[i] = STRONG / RINGS * amount[i];
    }
    enum paper_status status = paper_sheet_put(p, screen, x, y, wash);
    for (int i = 0; i < RINGS && status == PAPER_OK && screen->gray; i++)
        status = drops_put(p, screen, x, y, strong, size, i * RING_WIDER, p->config.seed);
    return status;
}
