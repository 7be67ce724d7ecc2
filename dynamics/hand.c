/* hand.c - see hand.h. */
#include "hand.h"
#include "internal.h"

#include <math.h>

#define TWANG_STRAIN 0.02

static enum dyn_status place_check(const struct dyn_network *n, int mass, double x, double y)
{
    enum dyn_status status = dyn_mass_check(n, mass);
    if (status == DYN_OK)
        status = dyn_control_check(&dyn_mass_fields[0], x);
    if (status == DYN_OK)
        status = dyn_control_check(&dyn_mass_fields[1], y);
    return status;
}

static void put(struct dyn_network *n, int mass, double x, double y)
{
    n->state[mass] = (struct dyn_state){x, y, 0, 0};
}

/* Reports a twang of a released mass. */
static void twang(struct dyn_network *n, int mass)
{
    double most = TWANG_STRAIN;
    int of = -1;
    for (int i = 0; i < n->springs_count; i++) {
        double strain =
            n->end[i][0] == mass || n->end[i][1] == mass ? fabs(dyn_spring_strain(n, i)) : 0;
        if (strain > most) {
            most = strain;
            of = i;
        }
    }
    if (of >= 0)
        dyn_event_add(n, (struct dyn_event){.kind = DYN_TWANG,
                                            .time_s = n->time_s,
                                            .mass = mass,
                                            .spring = of,
                                            .strength = most,
                                            .x = n->state[mass].x,
                                            .y = n->state[mass].y});
}

struct dyn_pull *dyn_pull_of(struct dyn_network *n, int mass)
{
    for (int i = 0; i < n->pulls_count; i++)
        if (n->pulls[i].mass == mass)
            return &n->pulls[i];
    return NULL;
}

static void pull_remove(struct dyn_network *n, int mass)
{
    struct dyn_pull *pull = dyn_pull_of(n, mass);
    if (!pull)
        return;
    n->pulls_count--;
    for (; pull < n->pulls + n->pulls_count; pull++)
        pull[0] = pull[1];
    n->changed = true;
}

enum dyn_status dyn_mass_hold(struct dyn_network *n, int mass, double x, double y)
{
    enum dyn_status status = place_check(n, mass, x, y);
    if (status != DYN_OK)
        return status;
    put(n, mass, x, y);
    if (!(n->hold[mass] & DYN_HELD)) {
        n->hold[mass] |= DYN_HELD;
        n->changed = true;
    }
    return DYN_OK;
}

enum dyn_status dyn_mass_release(struct dyn_network *n, int mass)
{
    enum dyn_status status = dyn_mass_check(n, mass);
    if (status != DYN_OK || !(n->hold[mass] & DYN_HELD))
        return status;
    n->hold[mass] &= (uint8_t)~DYN_HELD;
    n->changed = true;
    if (n->hold[mass] == DYN_FREE)
        twang(n, mass);
    return DYN_OK;
}

enum dyn_status dyn_pull_begin(struct dyn_network *n, int mass, double x, double y,
                               double constant)
{
    enum dyn_status status = place_check(n, mass, x, y);
    if (status == DYN_OK)
        status = dyn_control_check(&dyn_spring_fields[0], constant);
    if (status != DYN_OK)
        return status;
    struct dyn_pull *pull = dyn_pull_of(n, mass);
    if (!pull && n->pulls_count == DYN_PULLS_MAX)
        return dyn_fail(DYN_TOO_LARGE, "at most %d masses are pulled at a time", DYN_PULLS_MAX);
    if (!pull)
        pull = &n->pulls[n->pulls_count++];
    double weight = dyn_mass_row(n, MASS_MASS)[mass] * n->world.mass;
    *pull = (struct dyn_pull){mass, x, y, constant, 2.0 / 3 * sqrt(constant * weight)};
    n->changed = true;
    return DYN_OK;
}

enum dyn_status dyn_pull_move(struct dyn_network *n, int mass, double x, double y)
{
    enum dyn_status status = place_check(n, mass, x, y);
    if (status != DYN_OK)
        return status;
    struct dyn_pull *pull = dyn_pull_of(n, mass);
    if (!pull)
        return dyn_fail(DYN_BAD_ARGUMENT, "nobody pulls mass %d", mass);
    pull->x = x;
    pull->y = y;
    return DYN_OK;
}

enum dyn_status dyn_pull_end(struct dyn_network *n, int mass)
{
    enum dyn_status status = dyn_mass_check(n, mass);
    if (status != DYN_OK || !dyn_pull_of(n, mass))
        return status;
    pull_remove(n, mass);
    twang(n, mass);
    return DYN_OK;
}

enum dyn_status dyn_mass_tack(struct dyn_network *n, int mass)
{
    enum dyn_status status = dyn_mass_check(n, mass);
    if (status != DYN_OK)
        return status;
    pull_remove(n, mass);
    bool stuck = n->hold[mass] & DYN_STUCK;
    n->hold[mass] = DYN_STUCK;
    n->changed = true;
    put(n, mass, n->state[mass].x, n->state[mass].y);
    if (!stuck)
        dyn_event_add(n, (struct dyn_event){.kind = DYN_CLICK,
                                            .time_s = n->time_s,
                                            .mass = mass,
                                            .spring = -1,
                                            .strength = 1,
                                            .x = n->state[mass].x,
                                            .y = n->state[mass].y});
    return DYN_OK;
}

enum dyn_status dyn_mass_untack(struct dyn_network *n, int mass)
{
    enum dyn_status status = dyn_mass_check(n, mass);
    if (status == DYN_OK) {
        n->hold[mass] &= (uint8_t)~DYN_STUCK;
        n->changed = true;
    }
    return status;
}

enum dyn_status dyn_mass_place(struct dyn_network *n, int mass, double x, double y)
{
    enum dyn_status status = place_check(n, mass, x, y);
    if (status == DYN_OK)
        put(n, mass, x, y);
    return status;
}

enum dyn_status dyn_mass_clamp(struct dyn_network *n, int mass, double x, double y)
{
    enum dyn_status status = dyn_mass_place(n, mass, x, y);
    return status == DYN_OK ? dyn_mass_tack(n, mass) : status;
}

/* ---- springs ---- */

enum dyn_status dyn_spring_cut(struct dyn_network *n, int spring)
{
    enum dyn_status status = dyn_spring_check(n, spring);
    if (status != DYN_OK || n->broken[spring])
        return status;
    dyn_snap(n, spring, dyn_spring_strain(n, spring), n->time_s);
    return DYN_OK;
}

/* Twice the signed area of the triangle. */
static double triangle(double ax, double ay, double bx, double by, double cx, double cy)
{
    return (bx - ax) * (cy - ay) - (cx - ax) * (by - ay);
}

enum dyn_status dyn_network_cut(struct dyn_network *n, double x0, double y0, double x1,
                                double y1, int *cut)
{
    if (!isfinite(x0 + y0 + x1 + y1))
        return dyn_fail(DYN_BAD_ARGUMENT, "a cut goes from a point to a point");
    *cut = 0;
    for (int i = 0; i < n->springs_count; i++) {
        const struct dyn_state *a = &n->state[n->end[i][0]], *b = &n->state[n->end[i][1]];
        double from = triangle(x0, y0, x1, y1, a->x, a->y);
        double to = triangle(x0, y0, x1, y1, b->x, b->y);
        double begin = triangle(a->x, a->y, b->x, b->y, x0, y0);
        double end = triangle(a->x, a->y, b->x, b->y, x1, y1);
        if (!n->broken[i] && (from < 0) != (to < 0) && (begin < 0) != (end < 0)) {
            dyn_spring_cut(n, i);
            ++*cut;
        }
    }
    return DYN_OK;
}

enum dyn_status dyn_spring_pluck(struct dyn_network *n, int spring, double speed)
{
    enum dyn_status status = dyn_spring_check(n, spring);
    if (status == DYN_OK)
        status = dyn_control_check(&dyn_mass_fields[2], speed);
    if (status != DYN_OK || n->broken[spring])
        return status;
    int ends[2] = {n->end[spring][0], n->end[spring][1]};
    struct dyn_state *a = &n->state[ends[0]], *b = &n->state[ends[1]];
    double dx = b->x - a->x, dy = b->y - a->y, length = sqrt(dx * dx + dy * dy);
    if (!(length > 0))
        return DYN_OK;
    for (int i = 0; i < 2; i++)
        if (n->hold[ends[i]] == DYN_FREE) {
            n->state[ends[i]].vx += (i ? -1 : 1) * speed * dy / length;
            n->state[ends[i]].vy -= (i ? -1 : 1) * speed * dx / length;
        }
    dyn_event_add(n, (struct dyn_event){.kind = DYN_TWANG,
                                        .time_s = n->time_s,
                                        .mass = -1,
                                        .spring = spring,
                                        .strength = fabs(dyn_spring_strain(n, spring)),
                                        .x = (a->x + b->x) / 2,
                                        .y = (a->y + b->y) / 2});
    return DYN_OK;
}
