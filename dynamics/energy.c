/* energy.c - see energy.h. */
#include "energy.h"
#include "internal.h"

#include <math.h>

struct dyn_energy dyn_network_energy(const struct dyn_network *n)
{
    struct dyn_energy e = {0};
    const struct dyn_world *w = &n->world;
    double ground = w->floor_on > 0 ? w->floor : 0;
    for (int i = 0; i < n->masses_count; i++) {
        const struct dyn_state *s = &n->state[i];
        double mass = dyn_mass_row(n, MASS_MASS)[i] * w->mass;
        if (n->hold[i] != DYN_FREE)
            continue;
        e.motion += 0.5 * mass * (s->vx * s->vx + s->vy * s->vy);
        e.gravity += mass * w->gravity * dyn_mass_row(n, MASS_GRAVITY)[i] * (s->y - ground);
    }
    for (int i = 0; i < n->springs_count; i++) {
        const struct dyn_state *a = &n->state[n->end[i][0]], *b = &n->state[n->end[i][1]];
        double dx = b->x - a->x, dy = b->y - a->y;
        double longer = sqrt(dx * dx + dy * dy) - dyn_spring_row(n, SPRING_REST)[i] * w->rest;
        if (!n->broken[i])
            e.springs +=
                0.5 * dyn_spring_row(n, SPRING_CONSTANT)[i] * w->stiffness * longer * longer;
    }
    for (int i = 0; i < n->pulls_count; i++) {
        const struct dyn_pull *p = &n->pulls[i];
        double dx = p->x - n->state[p->mass].x, dy = p->y - n->state[p->mass].y;
        e.pulls += 0.5 * p->constant * (dx * dx + dy * dy);
    }
    return e;
}
