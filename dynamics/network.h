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
 * Units. Lengths are in units of the caller's choice (of springy words: an em), y upwards;
 * seconds; masses in kg, so that forces are in kg units/s2.
 *
 * Masses and springs are numbered from 0 in the order in which they were added, and keep their
 * numbers. All their parameters can be changed at any time: by dyn_mass_set() and
 * dyn_spring_set(), or field by field (fields.h), for one or for all. Common parameters are in
 * struct dyn_world (spring_controls.h).
 *
 * A mass is free, or stuck (tacked to its place), or held (by a hand), or both; only a free one
 * moves.
 *
 * Errors: functions that can fail return a status and leave one line in dyn_error(). Others
 * cannot fail.
 *
 * Ownership: what is passed is copied, and stays the caller's. Threads: a network belongs to
 * one thread at a time. */
#ifndef LUTETIA_DYN_NETWORK_H
#define LUTETIA_DYN_NETWORK_H

#include "spring_controls.h"
#include "status.h"

#include <stdbool.h>

/* DYN_DEGREE_MAX: the most springs on one mass. */
enum { DYN_MASSES_MAX = 4 << 20, DYN_SPRINGS_MAX = 16 << 20, DYN_DEGREE_MAX = 4096 };

enum dyn_hold { DYN_FREE = 0, DYN_STUCK = 1, DYN_HELD = 2 };

struct dyn_mass {
    double x, y, vx, vy;
    double mass;
    double drag;        /* kg/s; added to the world's drag */
    double gravity;     /* factor of the world's gravity */
    double restitution; /* factor of the world's restitution; the product is at most 1 */
    double friction;    /* factor of the world's friction */
    unsigned hold;      /* bits of enum dyn_hold */
};

struct dyn_spring {
    int end[2];
    double constant;        /* kg/s2 */
    double rest_length;     /* length at which it exerts no force */
    double damping;         /* kg/s, along the spring */
    double breaking_strain; /* breaks above (length - rest length) / rest length; INFINITY:
                          * never */
    bool broken;            /* exerts no force any more */
};

/* Place and velocity of a mass, for drawing. */
struct dyn_state {
    double x, y, vx, vy;
};

struct dyn_network;

/* The fields' usual values. A spring has no ends yet; its rest length becomes the distance
 * of its ends when it is added. */
struct dyn_mass dyn_mass_usual(void);
struct dyn_spring dyn_spring_usual(void);
#define DYN_REST_AS_PLACED (-1.0)

/* An empty network in a world of usual values. Errors: NO_MEMORY; *out is then NULL. Owns: the
 * caller destroys *out. */
enum dyn_status dyn_network_create(struct dyn_network **out);
void dyn_network_destroy(struct dyn_network *n); /* NULL is fine */

/* Copies the whole network with its time and events. Both compute the same bits from then on.
 * Errors: NO_MEMORY; `to` is unchanged. */
enum dyn_status dyn_network_copy(struct dyn_network *to, const struct dyn_network *from);
/* The same, but the events that wait in `to` stay there, and those of `from` are not copied: to
 * keep a state and return to it. Errors: NO_MEMORY; `to` is unchanged. */
enum dyn_status dyn_network_copy_state(struct dyn_network *to, const struct dyn_network *from);

/* index: gets its number; NULL is fine. Errors: BAD_ARGUMENT (a number outside of its
 * field's range, see fields.h; a spring from a mass to itself or to one that is not there),
 * TOO_LARGE, NO_MEMORY; the network is unchanged. */
enum dyn_status dyn_mass_add(struct dyn_network *n, const struct dyn_mass *mass, int *index);
enum dyn_status dyn_spring_add(struct dyn_network *n, const struct dyn_spring *spring,
                               int *index);

/* Removes all but the first so many masses and springs, and springs of removed masses. The
 * counts are at most the present ones. */
void dyn_network_truncate(struct dyn_network *n, int masses_count, int springs_count);

/* How many there are, broken springs too. */
int dyn_masses_count(const struct dyn_network *n);
int dyn_springs_count(const struct dyn_network *n);

/* The indices must be valid. */
struct dyn_mass dyn_mass_get(const struct dyn_network *n, int index);
struct dyn_spring dyn_spring_get(const struct dyn_network *n, int index);

/* Errors: as for adding; a spring's ends do not change. */
enum dyn_status dyn_mass_set(struct dyn_network *n, int index, const struct dyn_mass *mass);
enum dyn_status dyn_spring_set(struct dyn_network *n, int index,
                               const struct dyn_spring *spring);

/* The states of all masses; valid until one is added; NULL before the first. */
const struct dyn_state *dyn_network_states(const struct dyn_network *n);

/* (length - rest length) / rest length, with the world's rest scale; 0 for a broken spring
 * and for one without a rest length. */
double dyn_spring_strain(const struct dyn_network *n, int index);

/* The mass nearest to the point, if within the distance, else -1; of several the first. */
int dyn_network_nearest(const struct dyn_network *n, double x, double y, double within);
/* The unbroken spring nearest to the point, likewise. */
int dyn_network_nearest_spring(const struct dyn_network *n, double x, double y, double within);

/* The common parameters; never NULL, valid as long as the network. Errors: BAD_ARGUMENT: a
 * value outside of its control's range; nothing changes. */
const struct dyn_world *dyn_network_world(const struct dyn_network *n);
enum dyn_status dyn_network_world_set(struct dyn_network *n, const struct dyn_world *world);

/* The time that has been stepped through, from 0 or from what was set. */
double dyn_network_time_s(const struct dyn_network *n);
void dyn_network_time_set(struct dyn_network *n, double time_s);

#endif
