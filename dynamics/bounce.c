/* bounce.c - see bounce.h. */
#include "bounce.h"

#include <array.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MEET_ROUNDS = 6, TURN_ROUNDS = 2, LEAPS_MOST = 8 };

/* The motion of a mass that bounces, across the side (positive inwards). */
struct dyn_met {
    double place, speed; /* at the part's end, from the side; in its middle */
    double r;            /* the fraction of the part before it bounces */
    double jump_speed,
        jump_place; /* jumps of the masses that hang on it: times h2 K/m, h3 K/m */
    double grip,
        heard; /* by how much friction can change the speed along; how fast it leaves */
};

/* ---- preparing ---- */

bool dyn_bounces_possible(const struct dyn_world *w)
{
    return w->restitution > 0 &&
           (w->floor_on > 0 || w->ceiling_on > 0 || w->left_on > 0 || w->right_on > 0);
}

bool dyn_bounces_prepare(struct dyn_network *n)
{
    struct dyn_prepared *p = &n->prepared;
    struct dyn_ends *e = &p->ends;
    int masses = (int)dyn_masses_padded(n->masses_count), springs = p->springs.count;
    if (!dyn_bounces_possible(&n->world))
        return true;
    if (!array_reserve(&e->from, &e->from_capacity, masses + 2, sizeof *e->from) ||
        !array_reserve(&e->at, &e->at_capacity, 2 * springs + 1, sizeof *e->at) ||
        !array_reserve(&p->bounces, &p->bounces_capacity, 2 * masses, sizeof *p->bounces) ||
        !array_reserve(&p->met, &p->met_capacity, 2 * masses, sizeof *p->met))
        return false;
    memset(e->from, 0, ((size_t)masses + 2) * sizeof *e->from);
    for (int end = 0; end < 2; end++)
        for (int i = 0; i < springs; i++)
            e->from[dyn_packed_end(&p->springs, end, i) + 2]++;
    for (int i = 2; i < masses + 2; i++)
        e->from[i] += e->from[i - 1];
    for (int i = 0; i < springs; i++)
        for (int end = 0; end < 2; end++)
            e->at[e->from[dyn_packed_end(&p->springs, end, i) + 1]++] = i;
    return true;
}

void dyn_bounces_finish(struct dyn_prepared *p)
{
    free(p->ends.from);
    free(p->ends.at);
    free(p->bounces);
    free(p->met);
}

/* ---- where it is ---- */

/* Coordinates of a side: axis 0 is across, inwards; 1 is along. */
struct frame {
    bool vertical;
    double inwards, bound;
};

static struct frame frame_of(const struct dyn_job *job, enum dyn_side side)
{
    const double bounds[] = {[DYN_FLOOR] = job->least_y,
                             [DYN_CEILING] = job->most_y,
                             [DYN_LEFT] = job->least_x,
                             [DYN_RIGHT] = job->most_x};
    return (struct frame){side == DYN_FLOOR || side == DYN_CEILING,
                          side == DYN_FLOOR || side == DYN_LEFT ? 1 : -1, bounds[side]};
}

/* Turns x and y to across and along, and back. */
static void frame_turn(const struct frame *f, double x, double y, double *across, double *along)
{
    *across = f->inwards * (f->vertical ? y : x);
    *along = f->vertical ? x : y;
}

/* The stiffness between a mass and what hangs on it by a spring: across and across, across
 * and along. */
struct stiff {
    double nn, nt;
};

static int other_end(const struct dyn_packed *s, int spring, int mass)
{
    int first = dyn_packed_end(s, 0, spring);
    return first == mass ? dyn_packed_end(s, 1, spring) : first;
}

/* At the fraction r of the part; `at` is the mass. */
static struct stiff stiff_find(const struct dyn_job *job, const struct frame *f, int spring,
                               const struct dyn_state *at, const struct dyn_state *other,
                               double r)
{
    const struct dyn_packed *s = &job->springs;
    double back = (1 - r) * job->h, n, t;
    frame_turn(f, other->x - at->x - back * (other->vx - at->vx),
               other->y - at->y - back * (other->vy - at->vy), &n, &t);
    double square = n * n + t * t;
    if (!(square > 0))
        return (struct stiff){0, 0};
    /* A spring pressed together pushes aside, with more than its k where it is short. */
    double k = s->k[spring], push = fmin(s->k_rest[spring] / sqrt(square), 2 * k);
    return (struct stiff){k - push + push * n * n / square, push * n * t / square};
}

/* ---- on the way ---- */

/* A mass on its way to a side, from the side; gain: h a; turn: h2 J; stiff: h2 K/m. */
struct way {
    double h, from, speed, gain, turn, stiff;
};

static double way_place(const struct way *w, double r)
{
    return w->from +
           w->h * (r * w->speed + 0.5 * r * r * w->gain + (r * r * r - r) * w->turn / 6);
}

static double way_moment(const struct way *w, double r)
{
    return w->speed + r * w->gain + 0.5 * r * r * w->turn;
}

/* Newton's next, where it is within the bounds. */
static double between(double next, double early, double late)
{
    return next >= early && next <= late ? next : 0.5 * (early + late);
}

/* The fraction of the part at which it comes to the side; it is beyond at the part's end. */
static double way_meets(const struct way *w)
{
    double early = 0, late = 1;
    double r = between(w->from / (w->from - way_place(w, 1)), early, late);
    if (w->from <= 0 && w->speed - w->turn / 6 <= 0)
        return 0;
    for (int i = 0; i < MEET_ROUNDS; i++) {
        double place = way_place(w, r);
        if (place > 0)
            early = r;
        else
            late = r;
        double before = r;
        r = between(r - place / (w->h * (way_moment(w, r) - w->turn / 6)), early, late);
        if (r == before)
            break; /* and so it would stay */
    }
    return r;
}

/* Turn and stiffness, as they are where it meets the side. */
static void way_turns(const struct dyn_job *job, const struct frame *f, int mass,
                      struct way *way)
{
    const struct dyn_prepared *p = &job->network->prepared;
    const struct dyn_state *at = &job->state[mass];
    double r = way_meets(way), own = way_moment(way, r), ignored, along;
    double scale = way->h * way->h * p->inverse[mass], stiff = 0, turn = 0;
    frame_turn(f, at->vx, at->vy, &ignored, &along);
    for (int i = p->ends.from[mass]; i < p->ends.from[mass + 1]; i++) {
        int spring = p->ends.at[i];
        const struct dyn_state *other = &job->state[other_end(&job->springs, spring, mass)];
        struct stiff k = stiff_find(job, f, spring, at, other, r);
        double n, t;
        frame_turn(f, other->vx, other->vy, &n, &t);
        stiff += k.nn;
        turn += k.nn * (n - own) + k.nt * (t - along);
    }
    way->stiff = scale * stiff;
    way->turn = scale * turn;
}

/* ---- bouncing ---- */

/* A mass that has just bounced. */
struct leap {
    double r, speed, gain, turn, moment;
};

/* It meets the side at r with the moment p. */
static struct leap leap_find(const struct way *w, double r, double gain, double turn, double p,
                             double e, struct dyn_met *met)
{
    double in = fmin(p - turn / 6, 0), out = -e * in;
    double after = (out + (turn + w->stiff * p) / 6) / (1 + w->stiff / 6);
    double left = 1 - r;
    met->grip += out - in;
    met->heard = fmax(met->heard, out);
    met->jump_speed -= 0.5 * r * left * (after - p);
    met->jump_place += (left * left * left - left) / 6 * (after - p);
    return (struct leap){r, out, gain, turn - w->stiff * (after - p), after};
}

/* How fast it went on the way from the side, on the average, t after the leap. */
static double leap_mean(const struct leap *l, double t)
{
    return l->speed + 0.5 * t * l->gain + t * t * l->turn / 6;
}

/* When it is back at the side, where it is so before the part's end. */
static double leap_ends(const struct leap *l)
{
    double early = 0, late = 1 - l->r, t = between(-2 * l->speed / l->gain, early, late);
    for (int i = 0; i < MEET_ROUNDS; i++) {
        double mean = leap_mean(l, t);
        if (mean > 0)
            early = t;
        else
            late = t;
        double before = t;
        t = between(t - mean / (0.5 * l->gain + t * l->turn / 3), early, late);
        if (t == before)
            break;
    }
    return t;
}

static struct dyn_met bounce_find(const struct dyn_job *job, const struct dyn_bounce *b)
{
    const struct dyn_state *s = &job->state[b->mass];
    struct frame f = frame_of(job, b->side);
    struct dyn_met met = {0};
    double place, middle, gain, ignored, e = job->restitution[b->mass];
    frame_turn(&f, s->x, s->y, &place, &ignored);
    frame_turn(&f, s->vx, s->vy, &middle, &ignored);
    frame_turn(&f, b->gained[0], b->gained[1], &gain, &ignored);
    place -= f.inwards * f.bound;
    struct way way = {.h = job->h,
                      .from = place - job->h * middle,
                      .speed = middle - 0.5 * gain,
                      .gain = gain};
    way.from = fmax(way.from, 0);
    for (int i = 0; i < TURN_ROUNDS; i++)
        way_turns(job, &f, b->mass, &way);
    double r = met.r = way_meets(&way);
    struct leap leap =
        leap_find(&way, r, gain + r * way.turn, way.turn, way_moment(&way, r), e, &met);
    for (int i = 0; i < LEAPS_MOST && leap_mean(&leap, 1 - leap.r) < 0; i++) {
        double t = leap_ends(&leap);
        leap = leap_find(&way, leap.r + t, leap.gain + t * leap.turn, leap.turn,
                         leap.moment + t * leap.gain + 0.5 * t * t * leap.turn, e, &met);
    }
    double left = 1 - leap.r;
    met.place = way.h * left * leap_mean(&leap, left);
    met.speed = leap.moment + (0.5 - leap.r) * leap.gain - 0.5 * leap.r * left * leap.turn;
    if (met.place < 0) { /* so many leaps are a rest: half of a gain on, its speed is 0 */
        met.place = 0;
        met.speed = -0.5 * e * leap.gain;
    }
    met.speed = fmax(fmin(met.speed, job->speed_limit), -job->speed_limit);
    met.grip *= job->friction[b->mass];
    return met;
}

/* Adds what changes across and along. */
static void state_change(const struct frame *f, struct dyn_state *s, double place, double speed,
                         double across, double along, double limit)
{
    double x = f->vertical ? along : f->inwards * across;
    double y = f->vertical ? f->inwards * across : along;
    s->x += place * x;
    s->y += place * y;
    s->vx = fmax(fmin(s->vx + speed * x, limit), -limit);
    s->vy = fmax(fmin(s->vy + speed * y, limit), -limit);
}

/* Those that hang on it, and itself along the side. */
static void others_feel(struct dyn_job *job, const struct frame *f, int mass,
                        const struct dyn_met *m)
{
    const struct dyn_prepared *p = &job->network->prepared;
    const struct dyn_state before = job->state[mass];
    double speed = job->h * job->h * m->jump_speed;
    double place = job->h * job->h * job->h * m->jump_place, along = 0;
    for (int i = p->ends.from[mass]; i < p->ends.from[mass + 1]; i++) {
        int spring = p->ends.at[i], other = other_end(&job->springs, spring, mass);
        struct stiff k = stiff_find(job, f, spring, &before, &job->state[other], m->r);
        state_change(f, &job->state[other], place, speed, p->inverse[other] * k.nn,
                     p->inverse[other] * k.nt, job->speed_limit);
        along -= p->inverse[mass] * k.nt;
    }
    state_change(f, &job->state[mass], place, speed, 0, along, job->speed_limit);
}

static void bounce_make(struct dyn_job *job, const struct dyn_bounce *b,
                        const struct dyn_met *m)
{
    struct dyn_state *s = &job->state[b->mass];
    struct frame f = frame_of(job, b->side);
    others_feel(job, &f, b->mass, m);
    double *place = f.vertical ? &s->y : &s->x, *speed = f.vertical ? &s->vy : &s->vx;
    double *along = f.vertical ? &s->vx : &s->vy;
    *place = f.bound + f.inwards * m->place;
    *speed = f.inwards * m->speed;
    *along -= fmax(fmin(*along, m->grip), -m->grip);
    if (m->heard > job->clank_speed)
        dyn_event_add(job->network, (struct dyn_event){.kind = DYN_CLANK,
                                                       .side = b->side,
                                                       .time_s = job->time_s,
                                                       .mass = b->mass,
                                                       .spring = -1,
                                                       .strength = m->heard,
                                                       .x = s->x,
                                                       .y = s->y});
}

/* By masses, each mass's by sides: vectors find them in groups. */
static void bounces_sort(struct dyn_bounce *bounces, int count)
{
    for (int i = 1; i < count; i++) {
        struct dyn_bounce b = bounces[i];
        int k = i;
        for (; k > 0 && (bounces[k - 1].mass > b.mass ||
                         (bounces[k - 1].mass == b.mass && bounces[k - 1].side > b.side));
             k--)
            bounces[k] = bounces[k - 1];
        bounces[k] = b;
    }
}

void dyn_bounces_make(struct dyn_job *job)
{
    struct dyn_met *met = job->network->prepared.met;
    bounces_sort(job->bounces, job->bounces_count);
    for (int i = 0; i < job->bounces_count; i++)
        met[i] = bounce_find(job, &job->bounces[i]);
    for (int i = 0; i < job->bounces_count; i++)
        bounce_make(job, &job->bounces[i], &met[i]);
    job->bounces_count = 0;
}
