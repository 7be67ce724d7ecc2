/* splatter.c - drops from a shaken brush. */
#include "arguments/rows.h"
#include "model/brush_internal.h"
#include "techniques.h"

#include <math.h>
#include <stdlib.h>

#define PI 3.14159265358979323846

struct drop {
    double x, y, radius, length; /* radius: across; length: ratio of length to width */
    double c, s;                 /* the direction along */
    double strength;             /* 0..1 */
};

/* Most drops fall near, within the radius, and few far. Large drops are rare, and drops that
 * fly far are small. */
static struct drop drop_make(const struct paper_splatter *s, int i)
{
    uint64_t n = (uint64_t)i;
    double away = sqrt(-2 * log(1 - 0.99 * sheet_chance(s->seed, n, 1))) * s->radius / 2;
    double angle = 2 * PI * sheet_chance(s->seed, n, 2);
    double large = pow(sheet_chance(s->seed, n, 3), 4);
    double c = cos(s->toward), sn = sin(s->toward);
    double along = away * cos(angle), across = away * sin(angle);
    if (s->thrown > 0) /* drops that are thrown harder fly further */
        along = fabs(along) * (1 + s->thrown);
    struct drop d = {.x = s->x + c * along - sn * across,
                     .y = s->y + sn * along + c * across,
                     .radius = s->size[0] + (s->size[1] - s->size[0]) * large,
                     .length = 1 + s->thrown * (0.3 + 0.7 * sheet_chance(s->seed, n, 4)),
                     .c = c,
                     .s = sn,
                     .strength = 0.55 + 0.45 * sheet_chance(s->seed, n, 5)};
    if (s->thrown > 0) { /* a drop's long axis points away from its origin */
        double fx = d.x - s->x + c * s->radius, fy = d.y - s->y + sn * s->radius;
        double far = hypot(fx, fy);
        d.c = far > 0 ? fx / far : c;
        d.s = far > 0 ? fy / far : sn;
    }
    return d;
}

static void drop_draw(const struct drop *d, struct paper_screen *screen)
{
    double reach = d->radius * d->length + 1;
    int x1 = (int)fmax(0, floor(d->x - reach)), y1 = (int)fmax(0, floor(d->y - reach));
    int x2 = (int)fmin(screen->width_px, ceil(d->x + reach));
    int y2 = (int)fmin(screen->height_px, ceil(d->y + reach));
    for (int row = y1; row < y2; row++)
        for (int column = x1; column < x2; column++) {
            double x = column + 0.5 - d->x, y = row + 0.5 - d->y;
            double u = (d->c * x + d->s * y) / d->length, v = d->c * y - d->s * x;
            double inside = fmin(1, d->radius + 0.5 - hypot(u, v));
            uint8_t *at =
                &screen->gray[(size_t)row * (size_t)screen->width_px + (size_t)column];
            uint8_t gray = (uint8_t)lround(255 * d->strength * fmax(0, inside));
            if (gray > *at)
                *at = gray;
        }
}

enum paper_status paper_sheet_splatter(struct paper_sheet *p, const struct paper_splatter *s)
{
    enum paper_status status =
        paper_members_check(&paper_splatter_members, s, "splatter's ", "");
    if (status == PAPER_OK && !(s->size[1] >= s->size[0]))
        status = paper_fail(PAPER_BAD_ARGUMENT,
                            "splatter's most size must be %g or more, its least (got %g)",
                            s->size[0], s->size[1]);
    if (status != PAPER_OK)
        return status;
    struct paper_screen screen = {.width_px = p->page.grid.width,
                                  .height_px = p->page.grid.height};
    screen.gray = calloc((size_t)screen.width_px, (size_t)screen.height_px);
    if (!screen.gray)
        return paper_fail(PAPER_NO_MEMORY, "no memory for splatter");
    for (int i = 0; i < s->drops; i++) {
        struct drop d = drop_make(s, i);
        if (paper_within(d.x, -1e7, 1e7) && paper_within(d.y, -1e7, 1e7))
            drop_draw(&d, &screen);
    }
    status = paper_sheet_put(p, &screen, 0, 0, s->amount);
    free(screen.gray);
    return status;
}
