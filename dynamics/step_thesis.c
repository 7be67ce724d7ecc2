/* step_thesis.c - the thesis's step. Source: its appendix 7.1; see docs/springs.md.
 *
 * Each operation is in the order of the listing, in doubles, so that results are the same to
 * the bit. The listing takes a spring's angle and length as given. Here they are those of
 * the line from the second end to the first; with the listing's signs, a spring that is too
 * long then pulls.
 */
#include "internal.h"

#include <math.h>

static void forces_of_springs(struct dyn_network *n)
{
    const struct dyn_world *w = &n->world;
    for (int i = 0; i < n->springs_count; i++) {
        if (n->broken[i])
            continue;
        int first = n->end[i][0], second = n->end[i][1];
        double dx = n->state[first].x - n->state[second].x;
        double dy = n->state[first].y - n->state[second].y;
        double theta = atan2(dy, dx), length = sqrt(dx * dx + dy * dy);
        double k = dyn_spring_row(n, SPRING_CONSTANT)[i] * w->stiffness;
        double rest = dyn_spring_row(n, SPRING_REST)[i] * w->rest;
        double strain = dyn_spring_row(n, SPRING_BREAKING)[i] * w->breaking;
        if (rest > 0 && length > rest * (1 + strain)) {
            dyn_snap(n, i, (length - rest) / rest, n->time_s);
            continue;
        }
        double fx = cos(theta) * k * (length - rest);
        double fy = sin(theta) * k * (length - rest);
        n->force[first].x -= fx;
        n->force[first].y -= fy;
        n->force[second].x += fx;
        n->force[second].y += fy;
    }
}

/* The floor: reverses the velocity of a mass that moves down. */
static void floor_meet(struct dyn_network *n, int i)
{
    const struct dyn_world *w = &n->world;
    struct dyn_state *s = &n->state[i];
    if (!(w->floor_on > 0 && s->y < w->floor && s->vy < 0))
        return;
    s->vy = -w->restitution * s->vy;
    if (s->vy > w->clank_speed)
        dyn_event_add(n, (struct dyn_event){.kind = DYN_CLANK,
                                            .side = DYN_FLOOR,
                                            .time_s = n->time_s,
                                            .mass = i,
                                            .spring = -1,
                                            .strength = s->vy,
                                            .x = s->x,
                                            .y = s->y});
}

void dyn_thesis_step(struct dyn_network *n, double dt_s)
{
    const struct dyn_world *w = &n->world;
    forces_of_springs(n);
    for (int i = 0; i < n->masses_count; i++) {
        struct dyn_state *s = &n->state[i];
        struct dyn_force f = n->force[i];
        double mass = dyn_mass_row(n, MASS_MASS)[i] * w->mass;
        n->force[i] = (struct dyn_force){0, 0};
        if (n->hold[i] != DYN_FREE) {
            s->vx = s->vy = 0;
            continue;
        }
        if (!(w->floor_on > 0) || s->y > w->floor)
            f.y -= w->gravity * dyn_mass_row(n, MASS_GRAVITY)[i] * mass;
        double drag = w->drag + dyn_mass_row(n, MASS_DRAG)[i];
        f.x -= s->vx * drag;
        f.y -= s->vy * drag;
        double ax = f.x / mass, ay = f.y / mass;
        s->vx += ax * dt_s;
        s->vy += ay * dt_s;
        floor_meet(n, i);
        s->x += s->vx * dt_s + 0.5 * ax * dt_s * dt_s;
        s->y += s->vy * dt_s + 0.5 * ay * dt_s * dt_s;
    }
}
