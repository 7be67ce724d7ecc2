/* dyn_machine_program.h - the program's fields, for dyn_machine.c and dyn_machine_program.c. */
#ifndef LUTETIA_DYN_MACHINE_PROGRAM_H
#define LUTETIA_DYN_MACHINE_PROGRAM_H

#include <cm/paris.h>
#include <internal.h>

enum { REAL_S = 52, REAL_E = 11, REAL_BITS = 64, ADDRESS_BITS = 32 };
#define REAL REAL_S, REAL_E
#define DYN_MACHINE_NEVER 1e200 /* the limit of springs that do not break */

/* The numbers of a mass, in the order of struct dyn_state. */
enum { STATE_X, STATE_Y, STATE_VX, STATE_VY, STATES };

/* Springs that a mass gets the forces of: those of which it is the first end, and those of
 * which it is the second. */
enum { SLOTS_MOST = 8 };

struct dyn_masses {
    CM_geometry_id_t geometry;
    CM_vp_set_id_t set;
    int count;
    CM_field_id_t state[STATES], force[2];
    CM_field_id_t kick, keep, push[2], restitution, friction;
    CM_field_id_t gained[2], bounces; /* in the part; a bit. Where something can bounce */
    int slots[2];                     /* in use */
    CM_field_id_t slot
        [2]
        [SLOTS_MOST]; /* where the spring is; one that pulls at nothing where there is none */
};

struct dyn_springs {
    CM_geometry_id_t geometry;
    CM_vp_set_id_t set;
    int count;                /* the network's springs; one more pulls at nothing */
    CM_field_id_t address[2]; /* the addresses of its masses */
    CM_field_id_t sends[2];   /* 1: the mass has no slot left for it, so the force is sent */
    bool any_sends[2];
    CM_field_id_t k, k_rest, c, limit;
    CM_field_id_t broken; /* a bit */
    bool any_breaks;      /* else limit and broken are nobody's */
};

/* Which spring a processor has, of the packed ones, and its masses, that of the lower number
 * first. */
struct dyn_order {
    int count;
    int32_t *packed, *end[2];
};

struct dyn_machine {
    struct dyn_masses masses;
    struct dyn_springs springs;
    double h, speed_limit, slow_speed;
    struct dyn_bound {
        double at;
        bool side;       /* masses bounce there; else it is the plane's edge, where they stop */
    } least[2], most[2]; /* along x, y */
    struct dyn_network *bouncing; /* a copy, which makes the bounces; NULL: nothing bounces */
    double *values;               /* room for all that it needs of the masses */
    int parts;
    double dt_s;
    uint32_t *broken;          /* each spring's bit, as it was read last */
    int32_t *which;            /* each spring's number in the network */
    struct dyn_order order;    /* each spring's place among the packed ones */
    int of_masses, of_springs; /* the network's counts */
    int steps;                 /* steps since the network's time was read */
};

/* dyn_machine_order.c. False: no memory. */
bool dyn_machine_deal(const struct dyn_packed *packed, int count, struct dyn_order *out);
void dyn_order_free(struct dyn_order *order);

/* dyn_machine_program.c: one part of a step, but for the bounces. */
void dyn_machine_part(const struct dyn_machine *m);

#endif
