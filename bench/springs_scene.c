/* springs_scene.c - see springs_scene.h. */
#include "springs_scene.h"

#include <math.h>
#include <stdlib.h>

#include "harness.h"

static bool scene_begin(struct springs_scene *s, int masses, int springs)
{
    *s = (struct springs_scene){.gravity = 9.81};
    s->masses = calloc((size_t)masses, sizeof *s->masses);
    s->springs = calloc((size_t)springs, sizeof *s->springs);
    if (s->masses && s->springs)
        return true;
    springs_scene_finish(s);
    return bench_fail("no memory for %d masses and %d springs", masses, springs);
}

void springs_scene_finish(struct springs_scene *s)
{
    free(s->masses);
    free(s->springs);
    *s = (struct springs_scene){0};
}

static void spring_add(struct springs_scene *s, int a, int b, double constant, double damping)
{
    const struct springs_mass *p = &s->masses[a], *q = &s->masses[b];
    s->springs[s->springs_count++] =
        (struct springs_spring){a, b, constant, hypot(q->x - p->x, q->y - p->y), damping};
}

bool springs_scene_grid(struct springs_scene *s, int width, int height)
{
    if (!scene_begin(s, width * height, 4 * width * height))
        return false;
    for (int i = 0; i < width * height; i++, s->masses_count++)
        s->masses[i] = (struct springs_mass){.x = i % width,
                                             .y = height - i / width,
                                             .vx = i < width ? 0 : 0.01 * (i % 7),
                                             .mass = 1,
                                             .fixed = i < width};
    for (int i = 0; i < width * height; i++) {
        bool right = i % width + 1 < width, down = i / width + 1 < height;
        if (right)
            spring_add(s, i, i + 1, 2000, 2);
        if (down)
            spring_add(s, i, i + width, 2000, 2);
        if (right && down) {
            spring_add(s, i, i + width + 1, 2000, 2);
            spring_add(s, i + 1, i + width, 2000, 2);
        }
    }
    return true;
}

bool springs_scene_word(struct springs_scene *s, int letters)
{
    static const int ends[8][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0},
                                   {0, 2}, {1, 3}, {1, 4}, {2, 7}};
    if (!scene_begin(s, 4 * letters, 8 * letters))
        return false;
    s->has_floor = true;
    s->restitution = 0.6;
    s->friction = 0.3;
    for (int i = 0; i < 4 * letters; i++, s->masses_count++)
        s->masses[i] =
            (struct springs_mass){.x = 0.7 * (i / 4) + (i % 4 == 1 || i % 4 == 2 ? 0.5 : 0),
                                  .y = 1 + 0.02 * (i / 4) + (i % 4 > 1 ? 0.7 : 0),
                                  .mass = 0.25};
    for (int i = 0; i < letters; i++)
        for (int k = 0; k < (i + 1 < letters ? 8 : 6); k++)
            spring_add(s, 4 * i + ends[k][0], 4 * i + ends[k][1], 700, 1);
    return true;
}
