/* generate.c - see generate.h. */
#include "interpret/generate.h"

#include "interpret/lanes.h"

/* Along an axis that is not the last. */
static uint32_t coordinate(const struct vpset *s, uint64_t row, int axis)
{
    for (int a = s->rank - 2; a > axis; a--)
        row /= (uint64_t)s->dimensions[a];
    return (uint32_t)(row % (uint64_t)s->dimensions[axis]);
}

void generate_row(const struct vpset *s, int axis, uint64_t row, int x, uint32_t *to, int lanes)
{
    bool along = axis < 0 || axis == s->rank - 1;
    uint32_t first = axis < 0 ? (uint32_t)row * (uint32_t)s->width
                     : along  ? 0
                              : coordinate(s, row, axis);
    if (!along) {
        lanes_table()->fill(to, &first, sizeof first, (size_t)lanes);
        return;
    }
    while (lanes > 0) { /* as far as the row goes, then from its beginning */
        const int from = generate_wrapped(x, s->width), left = s->width - from,
                  part = left < lanes ? left : lanes;
        lanes_table()->count(to, first + (uint32_t)from, part);
        to += part;
        x += part;
        lanes -= part;
    }
}

void generate_lanes(const struct vpset *s, int axis, size_t first, uint32_t *to, int lanes)
{
    while (lanes > 0) {
        const size_t row = first / s->pitch, column = first % s->pitch,
                     left = s->pitch - column;
        const int part = left < (size_t)lanes ? (int)left : lanes;
        generate_row(s, axis, row, (int)column - s->halo, to, part);
        to += part;
        first += (size_t)part;
        lanes -= part;
    }
}
