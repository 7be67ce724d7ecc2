/* network.h - masses and the springs between them.
 *
 *     struct dyn_network *network;
 *     if (dyn_network_create(&network) != DYN_OK)
 *         die(dyn_error());
 *     struct dyn_mass mass = dyn_mass_usual();
 *     mass.y = 2;
 *     int a, b;
 *     dyn_mass_add(network, &mass, &a);
 *     mass.x = 1;
 *     dyn_mass_add(network, &mass, &b);
 *     struct dyn_spring spring = dyn_spring_usual();
 *     spring.end[0] = a, spring.end[1] = b;
 *     dyn_spring_add(network, &spring, NULL);
 *     dyn_network_step(network, 1.0 / 240, 240);       // step.h
 *     dyn_network_destroy(network);
 *
 * Units. Lengths are in units of the caller's choice (of springy words: an em), y upwards; seconds; masses in kg, so that
 * forces are in kg units/s2.
 *
 * Masses and springs are numbered from 0 in the order in which they were added, and keep their numbers. Everything about
 * them can be changed at any time: by dyn_mass_set() and dyn_spring_set(), or field by field (fields.h), for one or for all.
 * What is common to all is in struct dyn_world (controls.h).
 *
 * A mass is free, or stuck (tacked to its place), or held (by a hand), or both; only a free one moves.
 *
 * Threads. A network belongs to one thread at a time. */
#ifndef LUTETIA_DYN_NETWORK_H
#define LUTETIA_DYN_NETWORK_H

#include "controls.h"
#include "status.h"

#include <stdbool.h>

/* DYN_DEGREE_MAX: springs on one mass. */
enum { DYN_MASSES_MAX = 4 << 20, DYN_SPRINGS_MAX = 16 << 20, DYN_DEGREE_MAX = 4096 };

enum dyn_hold { DYN_FREE = 0, DYN_STUCK = 1, DYN_HELD = 2 };

struct dyn_mass {
    double x, y, vx, vy;
    double mass;
    double drag;        /* kg/s; its own, beside the world's */
    double gravity;     /* of the world's */
    double restitution; /* of the world's; the product counts to 1 */
    double friction;    /* of the world's */
    unsigned hold;      /* bits of enum dyn_hold */
};

struct dyn_spring {
    int end[2];
    double constant;    /* kg/s2 */
    double rest_length; /* where it exerts no force */
    double damping;     /* kg/s, along the spring */
    double
        breaking_strain; /* (length - rest length) / rest length that it bears; INFINITY: any */
    bool broken;         /* exerts no force any more */
};

/* Where a mass is and how fast it goes: what drawing needs of it. */
struct dyn_state {
    double x, y, vx, vy;
};

struct dyn_network;

/* The fields' usual values; of a spring, no ends, and a rest length that is where its ends are when it is added. */
struct dyn_mass dyn_mass_usual(void);
struct dyn_spring dyn_spring_usual(void);
#define DYN_REST_AS_PLACED (-1.0)

enum dyn_status dyn_network_create(struct dyn_network **out);
void dyn_network_destroy(struct dyn_network *n); /* NULL is fine */

/* Makes `to` what `from` is, its time and events included: to keep a state and to return to it. Both go on to the same
 * bits. Errors: NO_MEMORY; `to` is as it was. */
enum dyn_status dyn_network_copy(struct dyn_network *to, const struct dyn_network *from);

/* index: where its number is put; NULL is fine. Errors: BAD_ARGUMENT (a number outside of its field's range, see fields.h;
 * a spring from a mass to itself or to one that is not there), TOO_LARGE, NO_MEMORY; the network is as it was. */
enum dyn_status dyn_mass_add(struct dyn_network *n, const struct dyn_mass *mass, int *index);
enum dyn_status dyn_spring_add(struct dyn_network *n, const struct dyn_spring *spring,
                               int *index);

/* Takes away all but the first so many masses and springs, and springs of masses that go. The counts are at most those there are. */
void dyn_network_truncate(struct dyn_network *n, int masses_count, int springs_count);

int dyn_masses_count(const struct dyn_network *n);
int dyn_springs_count(const struct dyn_network *n);

/* The indices must be ones that were given. */
struct dyn_mass dyn_mass_get(const struct dyn_network *n, int index);
struct dyn_spring dyn_spring_get(const struct dyn_network *n, int index);

/* Errors: as for adding; a spring's ends stay what they are. */
enum dyn_status dyn_mass_set(struct dyn_network *n, int index, const struct dyn_mass *mass);
enum dyn_status dyn_spring_set(struct dyn_network *n, int index,
                               const struct dyn_spring *spring);

/* Of all masses; valid until one is added. */
const struct dyn_state *dyn_network_states(const struct dyn_network *n);

/* (length - rest length) / rest length, by the world's rest scale; 0 for a broken one and one without a rest length. */
double dyn_spring_strain(const struct dyn_network *n, int index);

/* The mass next to the point, if one is within the distance; else -1. Of several the first. */
int dyn_network_nearest(const struct dyn_network *n, double x, double y, double within);
/* The spring (that is not broken) next to the point, likewise. */
int dyn_network_nearest_spring(const struct dyn_network *n, double x, double y, double within);

/* What is common to all. Errors: BAD_ARGUMENT: a value outside of its control's range; nothing changes. */
const struct dyn_world *dyn_network_world(const struct dyn_network *n);
enum dyn_status dyn_network_world_set(struct dyn_network *n, const struct dyn_world *world);

double dyn_network_time_s(const struct dyn_network *n);
void dyn_network_time_set(struct dyn_network *n, double time_s);

#endif
