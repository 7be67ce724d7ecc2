/* diffusion_oracle.c - see diffusion_oracle.h. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "diffusion_oracle.h"

void oracle_scene_init(struct diffusion_scene *s, int width, int height, const int rim[4])
{
    assert_true(diffusion_scene_init(s, width, height));
    s->x0 = rim[0];
    s->y0 = rim[1];
    s->x1 = s->width - rim[2];
    s->y1 = s->height - rim[3];
}

static size_t neighbour(const struct diffusion_scene *s, int x, int y, int axis, int distance)
{
    if (axis == 0)
        x = (x + distance + s->width) % s->width;
    else
        y = (y + distance + s->height) % s->height;
    return (size_t)y * (size_t)s->width + (size_t)x;
}

#define EACH_ACTIVE(s)                                                                         \
    for (int y = (s)->y0; y < (s)->y1; y++)                                                    \
        for (int x = (s)->x0; x < (s)->x1; x++)

static void oracle_substance(struct oracle *o, int which, int axis)
{
    const struct diffusion_scene *s = o->s;
    float *f = o->field[which];

    EACH_ACTIVE(s) o->inflow[neighbour(s, x, y, 0, 0)] = f[neighbour(s, x, y, axis, -1)];
    EACH_ACTIVE(s)
    {
        size_t k = neighbour(s, x, y, 0, 0);
        float t = o->inflow[k] - f[k];

        t *= s->absorbency[k];
        if (which) {
            t *= o->field[DIFFUSION_WATER][k];
            t *= s->molecular_weight[which - 1];
        }
        if (t > 0.0f)
            t *= s->gravity;
        if (t < 0.0f)
            t /= s->gravity;
        o->inward[k] = t;
    }
    EACH_ACTIVE(s)
    o->outward[neighbour(s, x, y, 0, 0)] = o->inward[neighbour(s, x, y, axis, 1)];
    EACH_ACTIVE(s)
    {
        size_t k = neighbour(s, x, y, 0, 0);
        float t = f[k] + o->inward[k];

        t -= o->outward[k];
        t = t < 1.0f ? t : 1.0f;
        f[k] = t > 0.0f ? t : 0.0f;
    }
}

void oracle_init(struct oracle *o, const struct diffusion_scene *s)
{
    size_t count = (size_t)s->width * (size_t)s->height, bytes = count * sizeof(float);
    float **const temporaries[] = {&o->inflow, &o->inward, &o->outward};

    o->s = s;
    for (int i = 0; i < DIFFUSION_FIELDS_COUNT; i++) {
        o->field[i] = malloc(bytes);
        assert_non_null(o->field[i]);
        memcpy(o->field[i], s->field[i], bytes);
    }
    for (int i = 0; i < 3; i++) {
        *temporaries[i] = calloc(count, sizeof(float));
        assert_non_null(*temporaries[i]);
    }
}

void oracle_steps(struct oracle *o, int steps_count)
{
    for (int step = 0; step < steps_count; step++)
        for (int axis = 0; axis < 2; axis++)
            for (int i = 0; i < DIFFUSION_FIELDS_COUNT; i++)
                oracle_substance(o, i, axis);
}

void oracle_finish(struct oracle *o)
{
    for (int i = 0; i < DIFFUSION_FIELDS_COUNT; i++)
        free(o->field[i]);
    free(o->inflow);
    free(o->inward);
    free(o->outward);
}

void oracle_compare(const struct oracle *o, const char *what, int field, const float *mine)
{
    const struct diffusion_scene *s = o->s;

    for (int y = 0; y < s->height; y++)
        for (int x = 0; x < s->width; x++) {
            size_t k = neighbour(s, x, y, 0, 0);
            if (memcmp(&mine[k], &o->field[field][k], sizeof mine[k]))
                fail_msg("%s, %dx%d, rectangle %d..%d by %d..%d: field %d, row %d, column %d: "
                         "%a, the "
                         "oracle has %a",
                         what, s->width, s->height, s->x0, s->x1, s->y0, s->y1, field, y, x,
                         (double)mine[k], (double)o->field[field][k]);
        }
}
