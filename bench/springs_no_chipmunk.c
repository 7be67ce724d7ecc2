/* springs_no_chipmunk.c - replaces springs_chipmunk where Chipmunk is missing. */
#include <stddef.h>

#include "springs_scene.h"

const bool springs_chipmunk_built = false;

struct springs_chipmunk *springs_chipmunk_create(const struct springs_scene *s)
{
    (void)s;
    return NULL;
}

void springs_chipmunk_destroy(struct springs_chipmunk *p)
{
    (void)p;
}

void springs_chipmunk_step(struct springs_chipmunk *p, double dt_s, int count)
{
    (void)p;
    (void)dt_s;
    (void)count;
}

void springs_chipmunk_state(const struct springs_chipmunk *p, int mass, double state[4])
{
    (void)p;
    (void)mass;
    for (int i = 0; i < 4; i++)
        state[i] = 0;
}
