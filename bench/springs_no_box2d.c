/* springs_no_box2d.c - replaces springs_box2d where Box2D is missing. */
#include <stddef.h>

#include "springs_scene.h"

const bool springs_box2d_built = false;

struct springs_box2d *springs_box2d_create(const struct springs_scene *s)
{
    (void)s;
    return NULL;
}

void springs_box2d_destroy(struct springs_box2d *p)
{
    (void)p;
}

void springs_box2d_step(struct springs_box2d *p, double dt_s, int count)
{
    (void)p;
    (void)dt_s;
    (void)count;
}

void springs_box2d_state(const struct springs_box2d *p, int mass, double state[4])
{
    (void)p;
    (void)mass;
    for (int i = 0; i < 4; i++)
        state[i] = 0;
}
