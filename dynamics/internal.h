/* internal.h - shared by the simulation's files.
 *
 * Parameters as set by the user are separate from those that a step reads:
 *
 *     mass_field[]   spring_field[]   world          as set: fields.c, network.c
 *          \              |             /
 *           prepare.c: scaled by the world, springs that are broken left out, stiff ones softened, h found
 *                         |
 *     kick keep push ...  springs: end, k, k_rest, c, limit      as read: step_kernel.h
 *                         |
 *     state (x y vx vy of each mass)    force (fx fy of each mass)
 *
 * Parameters are structures of arrays, read by vectors. States and forces are arrays of
 * structures: a mass's state is 32 bytes, a force 16. So a spring reads the state of an end by
 * one load, and adds a force by one load and store, where separate arrays of x, y, vx and vy
 * would take four. Vectors are transposed between the two forms in registers.
 *
 * Arrays of masses are padded to a whole number of vectors of 8, with at least one dummy mass:
 * number masses_count, which is fixed, and is both ends of the springs that pad the last
 * vector. */
#ifndef LUTETIA_DYN_INTERNAL_H
#define LUTETIA_DYN_INTERNAL_H

#include "events.h"
#include "fields.h"
#include "hand.h"
#include "network.h"
#include "step.h"

#include <error_text.h>

#include <stdint.h>

#define DYN_SPEED_MAX 1e4
#define DYN_TIME_MAX 1e12 /* s; of networks in files */
#define DYN_EDGE 1e6      /* edge of the plane: masses stop there */

/* Keeps the text for dyn_error() and returns the status. */
extern _Thread_local struct error_text dyn_last_error;
#define dyn_fail(status, ...)                                                                  \
    ((enum dyn_status)error_text_fail(&dyn_last_error, (int)(status), __VA_ARGS__))

/* Makes room for count elements, aligned to 64 bytes, of an array with room for *capacity;
 * its content stays. The room grows by doubling. False: no memory; nothing has changed. */
bool dyn_array_reserve(void **array, size_t *capacity, size_t count, size_t element_bytes);

/* ---- as set ---- */

enum dyn_mass_parameter {
    MASS_MASS,
    MASS_DRAG,
    MASS_GRAVITY,
    MASS_RESTITUTION,
    MASS_FRICTION,
    MASS_PARAMETERS
};
enum dyn_spring_parameter {
    SPRING_CONSTANT,
    SPRING_REST,
    SPRING_DAMPING,
    SPRING_BREAKING,
    SPRING_PARAMETERS
};

/* ---- as read ---- */

struct dyn_force {
    double x, y;
};

/* A hand's spring. */
struct dyn_pull {
    int mass;
    double x, y, constant, damping;
};

/* A mass's force is so many times its number from the first force, in bytes, and its state
 * twice as far from the first state. Springs keep that instead of the number, which costs no
 * operation when they read a state or add a force. */
enum {
    DYN_FORCE_BYTES = sizeof(struct dyn_force),
    DYN_MASSES_MOST = INT32_MAX / DYN_FORCE_BYTES
};
_Static_assert(sizeof(struct dyn_state) == 2 * DYN_FORCE_BYTES, "a state is two forces long");

/* The springs that are not broken; count is a multiple of 8. */
struct dyn_packed {
    int32_t *at[2];                 /* the places of their masses' forces */
    double *k, *k_rest, *c, *limit; /* limit: the length at which it breaks */
    int32_t *which;                 /* the spring's number; -1 for padding */
    int count;
    bool breaks;  /* some limit is finite */
    bool carries; /* a third or more have the first end of the spring before */
};

static inline int dyn_packed_end(const struct dyn_packed *s, int end, int spring)
{
    return (int)((uint32_t)s->at[end][spring] / DYN_FORCE_BYTES);
}

/* A mass of more restitution bounces again and again; others rest where a leap would be shorter
 * than a part. */
#define DYN_ELASTIC 0.95

/* A mass that has met a side in this part: bounce.h. */
struct dyn_bounce {
    int mass;
    enum dyn_side side;
    double gained[2]; /* what its velocity gained in the part */
};

/* Mass i has the packed springs at[from[i]] .. at[from[i + 1] - 1]. */
struct dyn_ends {
    int32_t *from, *at;
    int from_capacity, at_capacity;
};

struct dyn_prepared {
    double *kick, *keep, *push_x, *push_y;    /* v = keep v + kick f + push */
    double *restitution, *friction, *inverse; /* inverse: 1/m; 0 if the mass is fixed */
    struct dyn_packed springs;
    struct dyn_ends ends;       /* bounce.c: where something can bounce */
    struct dyn_bounce *bounces; /* room for as many as there can be in a part */
    struct dyn_met *met;
    int bounces_capacity, met_capacity;
    double pull_soft[DYN_PULLS_MAX]; /* the part of each pull's strength that is left */
    double dt_s, h;
    struct dyn_plan plan;
    /* One block each, cut up. */
    double *mass_block, *spring_block;
    size_t mass_capacity, spring_capacity;
};

struct dyn_network {
    struct dyn_world world;
    double time_s;
    int masses_count, springs_count;
    size_t masses_capacity, springs_capacity, ends_capacity, flags_capacity, holds_capacity;
    /* A number for each mass. */
    struct dyn_state *state;
    struct dyn_force *force; /* zeros between steps */
    size_t state_capacity, force_capacity;
    double *mass_field; /* MASS_PARAMETERS rows of masses_capacity */
    uint8_t *hold;
    int32_t *degree; /* springs on it */
    size_t degree_capacity;
    /* A number for each spring. */
    int32_t (*end)[2];
    double *spring_field; /* SPRING_PARAMETERS rows of springs_capacity */
    uint8_t *broken;
    /* Others. */
    struct dyn_pull pulls[DYN_PULLS_MAX];
    int pulls_count;
    struct dyn_event *events; /* a ring */
    int events_first, events_count;
    long long events_lost;
    struct dyn_prepared prepared;
    bool changed; /* prepared parameters are out of date */
};

static inline double *dyn_mass_row(const struct dyn_network *n, int row)
{
    return n->mass_field + (size_t)row * n->masses_capacity;
}

static inline double *dyn_spring_row(const struct dyn_network *n, int row)
{
    return n->spring_field + (size_t)row * n->springs_capacity;
}

/* The number of masses including padding. */
static inline size_t dyn_masses_padded(int count)
{
    return ((size_t)count + 1 + 7) / 8 * 8;
}

/* prepare.c: computes the parameters that a step of dt_s reads, if something changed.
 * Errors: NO_MEMORY. */
enum dyn_status dyn_prepare(struct dyn_network *n, double dt_s);
void dyn_prepared_finish(struct dyn_prepared *p);

/* events.c: appends an event; side, mass and spring as given. */
void dyn_event_add(struct dyn_network *n, struct dyn_event event);
/* Breaks the spring, with that strain, at that time. */
void dyn_snap(struct dyn_network *n, int spring, double strain, double time_s);

/* network.c: sets all parameters, unchecked. */
void dyn_mass_put(struct dyn_network *n, int index, const struct dyn_mass *mass);
void dyn_spring_put(struct dyn_network *n, int index, const struct dyn_spring *spring);

/* hand.c: the mass's pull; NULL: none. */
struct dyn_pull *dyn_pull_of(struct dyn_network *n, int mass);

/* fields.c: checks that the mass exists. */
enum dyn_status dyn_mass_check(const struct dyn_network *n, int mass);
enum dyn_status dyn_spring_check(const struct dyn_network *n, int spring);

/* step_thesis.c: one step with the prepared parameters. */
void dyn_thesis_step(struct dyn_network *n, double dt_s);

/* ---- kernels ---- */

struct dyn_job {
    struct dyn_state *state;
    struct dyn_force *force;
    const double *kick, *keep, *push_x, *push_y, *restitution, *friction;
    int masses; /* a multiple of 8 */
    struct dyn_packed springs;
    double h, dt_s; /* the length of a part, and of a step */
    double least_x, most_x, least_y,
        most_y; /* the places of the sides; infinite where there are none */
    double slow_speed, clank_speed, speed_limit;
    struct dyn_bounce *bounces; /* those of the part, in the order of masses */
    int bounces_count;
    bool verlet;      /* kick, keep and push are for half of h */
    int parts, steps; /* parts in each of the steps */
    bool stop; /* stop after the step in which it was set; `steps` holds the remaining steps */
    double time_s; /* the time at the part's end */
    struct dyn_network *network;
    void (*bounce)(struct dyn_job *job); /* makes them, at the part's end */
    void (*on_snap)(struct dyn_job *job, int packed, double length);
    void (*pull)(struct dyn_job *job); /* adds pulls to the forces; NULL: no pulls */
};

/* step.c: a job of that many of the prepared steps. */
struct dyn_job dyn_job_make(struct dyn_network *n, int steps);

void dyn_kernel_plain(struct dyn_job *job);
void dyn_kernel_avx2(struct dyn_job *job);
void dyn_kernel_avx512(struct dyn_job *job);

#endif
