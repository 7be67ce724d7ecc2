/* springs_chipmunk.c - the same network in Chipmunk: see springs_scene.h. */
#include <chipmunk/chipmunk.h>
#include <stdlib.h>

#include "springs_scene.h"

const bool springs_chipmunk_built = true;

struct springs_chipmunk {
    cpSpace *space;
    cpBody **bodies;
    cpConstraint **springs;
    int masses_count, springs_count;
};

struct springs_chipmunk *springs_chipmunk_create(const struct springs_scene *s)
{
    struct springs_chipmunk *p = calloc(1, sizeof *p);
    if (p) {
        p->bodies = calloc((size_t)s->masses_count, sizeof(cpBody *));
        p->springs = calloc((size_t)s->springs_count, sizeof(cpConstraint *));
        p->space = cpSpaceNew();
    }
    if (!p || !p->bodies || !p->springs || !p->space) {
        springs_chipmunk_destroy(p);
        return NULL;
    }
    cpSpaceSetIterations(p->space, 1);
    cpSpaceSetGravity(p->space, cpv(0, -s->gravity));
    for (int i = 0; i < s->masses_count; i++) {
        const struct springs_mass *m = &s->masses[i];
        cpBody *body = m->fixed ? cpBodyNewStatic() : cpBodyNew(m->mass, (cpFloat)INFINITY);
        cpBodySetPosition(body, cpv(m->x, m->y));
        if (!m->fixed) {
            cpBodySetVelocity(body, cpv(m->vx, m->vy));
            cpSpaceAddBody(p->space, body);
        }
        p->bodies[p->masses_count++] = body;
    }
    for (int i = 0; i < s->springs_count; i++) {
        const struct springs_spring *spring = &s->springs[i];
        if (s->masses[spring->a].fixed && s->masses[spring->b].fixed)
            continue; /* Chipmunk refuses springs between immovable masses */
        p->springs[p->springs_count++] = cpSpaceAddConstraint(
            p->space,
            cpDampedSpringNew(p->bodies[spring->a], p->bodies[spring->b], cpvzero, cpvzero,
                              spring->rest_length, spring->constant, spring->damping));
    }
    return p;
}

void springs_chipmunk_destroy(struct springs_chipmunk *p)
{
    if (!p)
        return;
    for (int i = 0; i < p->springs_count; i++) {
        cpSpaceRemoveConstraint(p->space, p->springs[i]);
        cpConstraintFree(p->springs[i]);
    }
    for (int i = 0; i < p->masses_count; i++) {
        if (cpSpaceContainsBody(p->space, p->bodies[i]))
            cpSpaceRemoveBody(p->space, p->bodies[i]);
        cpBodyFree(p->bodies[i]);
    }
    if (p->space)
        cpSpaceFree(p->space);
    free(p->bodies);
    free(p->springs);
    free(p);
}

void springs_chipmunk_step(struct springs_chipmunk *p, double dt_s, int count)
{
    for (; count > 0; count--)
        cpSpaceStep(p->space, dt_s);
}

void springs_chipmunk_state(const struct springs_chipmunk *p, int mass, double state[4])
{
    cpVect at = cpBodyGetPosition(p->bodies[mass]), v = cpBodyGetVelocity(p->bodies[mass]);
    state[0] = at.x;
    state[1] = at.y;
    state[2] = v.x;
    state[3] = v.y;
}
