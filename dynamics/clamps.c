/* clamps.c - see clamps.h. Keys are sorted by mass, then time, so a mass's keys are
 * contiguous. */
#include "clamps.h"
#include "clamps_internal.h"
#include "internal.h"

#include <array.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum dyn_status dyn_clamps_create(struct dyn_clamps **out)
{
    *out = calloc(1, sizeof **out);
    return *out ? DYN_OK : dyn_fail(DYN_NO_MEMORY, "no memory for clamps");
}

void dyn_clamps_destroy(struct dyn_clamps *c)
{
    if (!c)
        return;
    free(c->keys);
    free(c);
}

int dyn_clamps_count(const struct dyn_clamps *c)
{
    return c->count;
}

/* Finds the first key that is not before the given mass and time. */
static int key_find(const struct dyn_clamps *c, int mass, double time_s)
{
    int low = 0, high = c->count;
    while (low < high) {
        int middle = (low + high) / 2;
        const struct dyn_key *k = &c->keys[middle];
        if (k->mass < mass || (k->mass == mass && k->time_s < time_s))
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static enum dyn_status key_put(struct dyn_clamps *c, struct dyn_key key)
{
    int at = key_find(c, key.mass, key.time_s);
    if (at < c->count && c->keys[at].mass == key.mass && c->keys[at].time_s == key.time_s) {
        c->keys[at] = key;
        return DYN_OK;
    }
    if (c->count == DYN_KEYS_MAX)
        return dyn_fail(DYN_TOO_LARGE, "there are at most %d keys", DYN_KEYS_MAX);
    if (!array_reserve(&c->keys, &c->capacity, c->count + 1, sizeof *c->keys))
        return dyn_fail(DYN_NO_MEMORY, "no memory for %d keys", c->count + 1);
    memmove(c->keys + at + 1, c->keys + at, (size_t)(c->count - at) * sizeof *c->keys);
    c->keys[at] = key;
    c->count++;
    return DYN_OK;
}

static enum dyn_status key_look(int mass, double time_s)
{
    if (mass < 0 || mass >= DYN_MASSES_MAX)
        return dyn_fail(DYN_BAD_ARGUMENT, "there is no mass %d", mass);
    if (!(time_s >= -DYN_TIME_MAX && time_s <= DYN_TIME_MAX))
        return dyn_fail(DYN_BAD_ARGUMENT, "a key's time must be %g..%g s (got %g)",
                        -DYN_TIME_MAX, DYN_TIME_MAX, time_s);
    return DYN_OK;
}

enum dyn_status dyn_clamps_key(struct dyn_clamps *c, int mass, double time_s, double x,
                               double y)
{
    enum dyn_status status = key_look(mass, time_s);
    if (status == DYN_OK)
        status = dyn_control_check(dyn_mass_field_find("x"), x);
    if (status == DYN_OK)
        status = dyn_control_check(dyn_mass_field_find("y"), y);
    return status == DYN_OK ? key_put(c, (struct dyn_key){mass, time_s, x, y, false}) : status;
}

enum dyn_status dyn_clamps_free(struct dyn_clamps *c, int mass, double time_s)
{
    enum dyn_status status = key_look(mass, time_s);
    return status == DYN_OK ? key_put(c, (struct dyn_key){mass, time_s, 0, 0, true}) : status;
}

/* ---- where ---- */

static bool leads(const struct dyn_clamps *c, int at, int mass)
{
    return at >= 0 && at < c->count && c->keys[at].mass == mass && !c->keys[at].free;
}

/* The velocity at a key: the mean velocity between its neighbours, 0 at an end. */
static void speed_at(const struct dyn_clamps *c, int at, int mass, double v[2])
{
    v[0] = v[1] = 0;
    if (!leads(c, at - 1, mass) || !leads(c, at + 1, mass))
        return;
    const struct dyn_key *a = &c->keys[at - 1], *b = &c->keys[at + 1];
    v[0] = (b->x - a->x) / (b->time_s - a->time_s);
    v[1] = (b->y - a->y) / (b->time_s - a->time_s);
}

bool dyn_clamps_at(const struct dyn_clamps *c, int mass, double time_s, double *x, double *y)
{
    int after = key_find(c, mass, time_s);
    if (leads(c, after, mass) && c->keys[after].time_s == time_s) {
        *x = c->keys[after].x;
        *y = c->keys[after].y;
        return true;
    }
    if (!leads(c, after - 1, mass) ||
        (after < c->count && c->keys[after].mass == mass && c->keys[after].time_s == time_s))
        return false; /* not clamped yet, or just released */
    const struct dyn_key *a = &c->keys[after - 1];
    *x = a->x;
    *y = a->y;
    if (!leads(c, after, mass))
        return true;
    const struct dyn_key *b = &c->keys[after];
    double va[2], vb[2], span = b->time_s - a->time_s, t = (time_s - a->time_s) / span;
    speed_at(c, after - 1, mass, va);
    speed_at(c, after, mass, vb);
    double h00 = (1 + 2 * t) * (1 - t) * (1 - t), h10 = t * (1 - t) * (1 - t) * span;
    double h01 = t * t * (3 - 2 * t), h11 = t * t * (t - 1) * span;
    *x = h00 * a->x + h10 * va[0] + h01 * b->x + h11 * vb[0];
    *y = h00 * a->y + h10 * va[1] + h01 * b->y + h11 * vb[1];
    return true;
}

/* ---- steps ---- */

#define FLIES_WITHIN_S 0.05

/* Releases the mass, which was clamped until the key at `last`. */
static void let_go(const struct dyn_clamps *c, struct dyn_network *n, int last, double time_s)
{
    const struct dyn_key *b = &c->keys[last], *a = b - 1;
    dyn_mass_release(n, b->mass);
    if (n->hold[b->mass] != DYN_FREE || !leads(c, last - 1, b->mass) ||
        time_s - b->time_s > FLIES_WITHIN_S)
        return;
    double limit = n->world.speed_limit, span = b->time_s - a->time_s;
    n->state[b->mass].vx = fmin(fmax((b->x - a->x) / span, -limit), limit);
    n->state[b->mass].vy = fmin(fmax((b->y - a->y) / span, -limit), limit);
}

/* Moves each mass that has keys to its place at the step's end. */
static void lead(const struct dyn_clamps *c, struct dyn_network *n, double dt_s)
{
    double to = n->time_s + dt_s;
    for (int i = 0; i < c->count; i++) {
        int mass = c->keys[i].mass, next;
        double x, y;
        if (i > 0 && c->keys[i - 1].mass == mass)
            continue;
        if (dyn_clamps_at(c, mass, to, &x, &y)) {
            dyn_mass_hold(n, mass, fmin(fmax(x, -DYN_EDGE), DYN_EDGE),
                          fmin(fmax(y, -DYN_EDGE), DYN_EDGE));
            continue;
        }
        /* the key that released it: the last one not after `to` */
        next = key_find(c, mass, to);
        next -= !(next < c->count && c->keys[next].mass == mass && c->keys[next].time_s == to);
        if ((n->hold[mass] & DYN_HELD) && leads(c, next - 1, mass) &&
            c->keys[next].time_s > n->time_s)
            let_go(c, n, next - 1, c->keys[next].time_s);
    }
}

enum dyn_status dyn_clamps_step(const struct dyn_clamps *c, struct dyn_network *n, double dt_s,
                                int count)
{
    enum dyn_status status = dyn_network_step(n, dt_s, 0);
    if (status == DYN_OK && c->count)
        status = dyn_mass_check(n, c->keys[c->count - 1].mass);
    if (status == DYN_OK && count < 0)
        return dyn_network_step(n, dt_s, count);
    for (; status == DYN_OK && count > 0; count--) {
        lead(c, n, dt_s);
        status = dyn_network_step(n, dt_s, 1);
    }
    return status;
}
