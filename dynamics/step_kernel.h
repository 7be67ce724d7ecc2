/* step_kernel.h - steps, included by step_plain.c, step_avx2.c and step_avx512.c with
 *     LANES    doubles in a vector: 1, 4 or 8
 *     KERNEL   the function's name
 *
 * A part of a step is two passes: over the springs, whose forces are added to their ends,
 * and over the masses, which are moved and reflected at the sides. Formulas: step.h. All
 * instruction sets do the same operations in the same order, none fused, so that the bits
 * are the same.
 */
#include "turn.h"

#include <string.h>

/* Reports which of LANES springs snap, and lets them pull no more. */
INLINE lanes snaps_tell(struct dyn_job *job, int i, lanes_mask over, lanes length, lanes pull)
{
    double lengths[LANES];
    lanes_store(lengths, length);
    for (unsigned snaps = lanes_bits(over); snaps; snaps &= snaps - 1) {
        int lane = __builtin_ctz(snaps);
        job->on_snap(job, i + lane, lengths[lane]);
    }
    return lanes_pick(over, lanes_all(0), pull);
}

/* breaks: some springs can; carries: many have the first end of the spring before. */
INLINE void springs_pass(struct dyn_job *job, const bool breaks, const bool carries)
{
    const struct dyn_packed *s = &job->springs;
    const lanes none = lanes_all(0), one = lanes_all(1);
    struct carried carried = carried_none();
    for (int i = 0; i < s->count; i += LANES) {
        const int32_t *a = s->at[0] + i, *b = s->at[1] + i;
        struct lanes_state d = states_difference(job->state, a, b);
        lanes length = lanes_sqrt(d.x * d.x + d.y * d.y);
        lanes inverse = lanes_pick(lanes_less(none, length), one / length, none);
        lanes pull = (lanes_load(s->k + i) - lanes_load(s->k_rest + i) * inverse) +
                     lanes_load(s->c + i) * (d.x * d.vx + d.y * d.vy) * inverse * inverse;
        if (breaks) {
            lanes_mask over = lanes_less(lanes_load(s->limit + i), length);
            if (__builtin_expect(lanes_bits(over) != 0, 0))
                pull = snaps_tell(job, i, over, length, pull);
        }
        struct lanes_force f = {pull * d.x, pull * d.y};
        forces_add(job->force, a, b, f, carries ? &carried : NULL);
    }
    carried_store(job->force, carried);
}

/* Notes what bounces.c makes of it: `which` of LANES masses meet the side. */
static void bounces_note(struct dyn_job *job, int i, enum dyn_side side, unsigned which,
                         struct lanes_force gained)
{
    double x[LANES], y[LANES];
    lanes_store(x, gained.x);
    lanes_store(y, gained.y);
    for (; which; which &= which - 1) {
        int lane = __builtin_ctz(which);
        job->bounces[job->bounces_count++] =
            (struct dyn_bounce){i + lane, side, {x[lane], y[lane]}};
    }
}

/* Stops at one side, or at the plane's edge, what does not bounce, and notes what does: p is
 * the place across it and v the velocity, t the velocity along it. inwards: 1 if p grows
 * inwards, else -1. */
INLINE void side_meet(struct dyn_job *job, int i, enum dyn_side side, double at, int inwards,
                      lanes *p, lanes *v, lanes *t, struct lanes_force gained)
{
    lanes across = side <= DYN_CEILING ? gained.y : gained.x;
    const lanes none = lanes_all(0), bound = lanes_all(at);
    lanes beyond = inwards > 0 ? bound - *p : *p - bound;
    lanes speed = inwards > 0 ? -*v : *v;
    lanes_mask hit = lanes_both(lanes_less(none, beyond), lanes_less(none, speed));
    if (!lanes_bits(hit))
        return;
    const double slow = fabs(at) < DYN_EDGE ? job->slow_speed : INFINITY;
    lanes e = lanes_load(job->restitution + i);
    lanes had = inwards > 0 ? -(*v - across) : *v - across;
    lanes_mask comes =
        lanes_either(lanes_less(none, had), lanes_less(lanes_all(DYN_ELASTIC), e));
    lanes_mask bounces =
        lanes_both(lanes_both(hit, comes),
                   lanes_both(lanes_less(lanes_all(slow), speed), lanes_less(none, e)));
    unsigned noted = lanes_bits(bounces);
    lanes grip = lanes_load(job->friction + i) * speed;
    lanes slid = *t - lanes_max(lanes_min(*t, grip), -grip);
    *p = lanes_pick(bounces, *p, lanes_pick(hit, bound, *p));
    *v = lanes_pick(bounces, *v, lanes_pick(hit, none, *v));
    *t = lanes_pick(bounces, *t, lanes_pick(hit, slid, *t));
    if (__builtin_expect(noted != 0, 0))
        bounces_note(job, i, side, noted, gained);
}

/* gained: what velocities gain in a part. */
INLINE void sides_meet(struct dyn_job *job, int i, struct lanes_state *s,
                       struct lanes_force gained)
{
    const unsigned below = lanes_bits(lanes_less(s->y, lanes_all(job->least_y)));
    const unsigned above = lanes_bits(lanes_less(lanes_all(job->most_y), s->y));
    const unsigned left = lanes_bits(lanes_less(s->x, lanes_all(job->least_x)));
    const unsigned right = lanes_bits(lanes_less(lanes_all(job->most_x), s->x));
    if (!(below | above | left | right))
        return;
    if (below)
        side_meet(job, i, DYN_FLOOR, job->least_y, 1, &s->y, &s->vy, &s->vx, gained);
    if (above)
        side_meet(job, i, DYN_CEILING, job->most_y, -1, &s->y, &s->vy, &s->vx, gained);
    if (left)
        side_meet(job, i, DYN_LEFT, job->least_x, 1, &s->x, &s->vx, &s->vy, gained);
    if (right)
        side_meet(job, i, DYN_RIGHT, job->most_x, -1, &s->x, &s->vx, &s->vy, gained);
}

/* Computes velocities from forces; if `moves`, also places from velocities, and sets forces
 * to 0. */
INLINE void masses_pass(struct dyn_job *job, bool moves)
{
    const lanes limit = lanes_all(job->speed_limit), h = lanes_all(job->h);
    const lanes whole = lanes_all(job->verlet ? 2 : 1); /* a part has so many kicks */
    for (int i = 0; i < job->masses; i += LANES) {
        struct lanes_state s = states_load(job->state + i);
        struct lanes_force f = forces_load(job->force + i);
        lanes keep = lanes_load(job->keep + i), kick = lanes_load(job->kick + i);
        struct lanes_force gained = {s.vx, s.vy};
        s.vx = keep * s.vx + kick * f.x + lanes_load(job->push_x + i);
        s.vy = keep * s.vy + kick * f.y + lanes_load(job->push_y + i);
        s.vx = lanes_max(lanes_min(s.vx, limit), -limit);
        s.vy = lanes_max(lanes_min(s.vy, limit), -limit);
        if (moves) {
            s.x = s.x + h * s.vx;
            s.y = s.y + h * s.vy;
            gained.x = whole * (s.vx - gained.x);
            gained.y = whole * (s.vy - gained.y);
            sides_meet(job, i, &s, gained);
            forces_clear(job->force + i);
        }
        states_store(job->state + i, s);
    }
    if (moves && job->bounces_count)
        job->bounce(job);
}

INLINE void forces_find(struct dyn_job *job)
{
    const struct dyn_packed *s = &job->springs;
    if (s->breaks)
        springs_pass(job, true, false);
    else if (s->carries)
        springs_pass(job, false, true);
    else
        springs_pass(job, false, false);
    if (job->pull)
        job->pull(job);
}

INLINE void part_verlet(struct dyn_job *job)
{
    masses_pass(job, true);
    forces_find(job);
    masses_pass(job, false);
}

INLINE void part_symplectic(struct dyn_job *job)
{
    forces_find(job);
    masses_pass(job, true);
}

void KERNEL(struct dyn_job *job)
{
    while (job->steps > 0 && !job->stop) {
        double begin_s = job->time_s;
        if (job->verlet)
            forces_find(job);
        for (int part = 0; part < job->parts; part++) {
            job->time_s = begin_s + (part + 1) * job->h;
            if (job->verlet)
                part_verlet(job);
            else
                part_symplectic(job);
        }
        if (job->verlet)
            memset(job->force, 0, (size_t)job->masses * sizeof *job->force);
        job->time_s = begin_s + job->dt_s;
        job->steps--;
    }
}
