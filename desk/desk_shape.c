/* desk_shape.c - what a hand is helped with: a steadied way, straight lines and ellipses. */
#include "desk.h"

#include <math.h>

#define LATE_S 0.25 /* how far a way lags behind the hand at full steadying */

void desk_steady(struct desk *d, double time_s, double *x, double *y)
{
    const double late_s = LATE_S * d->settings.value[STUDIO_STEADY];
    if (late_s > 0) {
        const double share = 1 - exp(-fmax(0, time_s - d->steady_s) / late_s);
        d->steady_x += share * (*x - d->steady_x);
        d->steady_y += share * (*y - d->steady_y);
        *x = d->steady_x;
        *y = d->steady_y;
    }
    desk_steady_begin(d, time_s, *x, *y);
}

void desk_steady_begin(struct desk *d, double time_s, double x, double y)
{
    d->steady_s = time_s;
    d->steady_x = x;
    d->steady_y = y;
}

/* ---- lines and ellipses ---- */

bool desk_shapes(const struct desk *d)
{
    return (int)d->settings.value[STUDIO_SHAPE] != STUDIO_SHAPE_FREE &&
           studio_tools[desk_tool(d)].swept;
}

/* The shape's place at a part 0..1 of its way. */
struct studio_place desk_shape_at(const struct desk *d, struct studio_place to, double part)
{
    const double along = to.x - d->down_x, down = to.y - d->down_y;
    if ((int)d->settings.value[STUDIO_SHAPE] == STUDIO_SHAPE_LINE)
        return (struct studio_place){d->down_x + part * along, d->down_y + part * down};
    const double angle = 2 * G_PI * part - G_PI / 2;
    return (struct studio_place){d->down_x + along / 2 * (1 + cos(angle)),
                                 d->down_y + down / 2 * (1 + sin(angle))};
}

double desk_shape_length(const struct desk *d, struct studio_place to)
{
    return (int)d->settings.value[STUDIO_SHAPE] == STUDIO_SHAPE_LINE
               ? hypot(to.x - d->down_x, to.y - d->down_y)
               : G_PI / 2 * (fabs(to.x - d->down_x) + fabs(to.y - d->down_y));
}
