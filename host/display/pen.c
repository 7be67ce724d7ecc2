/* pen.c - see pen.h. Interprets the reports that pen_x11.c receives. */
#include "pen.h"

#include <math.h>

static bool is_set(const unsigned char *mask, int bytes, int bit)
{
    return bit >= 0 && bit / 8 < bytes && (mask[bit / 8] >> bit % 8 & 1);
}

/* The new value of a valuator; false: it did not change. */
static bool value_of(const struct pen_axis *axis, const unsigned char *mask, int bytes,
                     const double *values, double *value)
{
    int before = 0;
    if (!is_set(mask, bytes, axis->number) || !(axis->most > axis->least))
        return false;
    for (int i = 0; i < axis->number; i++)
        before += is_set(mask, bytes, i);
    *value = values[before];
    return isfinite(*value);
}

static double clamped(double value, double least, double most)
{
    return value < least ? least : value > most ? most : value;
}

static void tilt_read(const struct pen_axis *axis, const unsigned char *mask, int bytes,
                      const double *values, double *tilt)
{
    double value, reach = fmax(fabs(axis->least), fabs(axis->most));
    if (value_of(axis, mask, bytes, values, &value))
        *tilt = clamped(value / reach, -1, 1);
}

void pen_report(const struct pen_axes *axes, const unsigned char *mask, int mask_bytes,
                const double *values, struct pen_state *state)
{
    double value;
    const struct pen_axis *p = &axes->pressure;
    state->is_pen = p->number >= 0;
    if (!state->is_pen) {
        state->pressure = state->tilt_x = state->tilt_y = 0;
        return;
    }
    if (value_of(p, mask, mask_bytes, values, &value))
        state->pressure = clamped((value - p->least) / (p->most - p->least), 0, 1);
    tilt_read(&axes->tilt_x, mask, mask_bytes, values, &state->tilt_x);
    tilt_read(&axes->tilt_y, mask, mask_bytes, values, &state->tilt_y);
}
