/* dyn_machine_program.h - the program's fields: dyn_machine.c, dyn_machine_program.c. */
#ifndef LUTETIA_DYN_MACHINE_PROGRAM_H
#define LUTETIA_DYN_MACHINE_PROGRAM_H

#include <cm/paris.h>
#include <internal.h>

enum { REAL_S = 52, REAL_E = 11, REAL_BITS = 64, ADDRESS_BITS = 32 };
#define REAL REAL_S, REAL_E
#define DYN_MACHINE_BROKEN                                                                     \
    1e300 /* a broken spring's limit; of one that never breaks it is 1e200 */
#define DYN_MACHINE_NEVER 1e200

/* Of a mass, in the order of struct dyn_state. */
enum { STATE_X, STATE_Y, STATE_VX, STATE_VY, STATES };

struct dyn_masses {
    CM_geometry_id_t geometry;
    CM_vp_set_id_t set;
    int count;
    CM_field_id_t state[STATES], force[2];
    CM_field_id_t kick, keep, push[2], restitution, friction;
    CM_field_id_t speed, after, back, context;
};

struct dyn_springs {
    CM_geometry_id_t geometry;
    CM_vp_set_id_t set;
    int count;
    CM_field_id_t address[2]; /* of its masses */
    CM_field_id_t k, k_rest, c, limit;
    CM_field_id_t d[STATES], other, length, inverse, pull;
};

struct dyn_machine {
    struct dyn_masses masses;
    struct dyn_springs springs;
    double h, speed_limit, slow_speed;
    double least_x, most_x, least_y, most_y;
    int parts;
    double dt_s;
    int32_t *which;            /* of each spring: its number in the network */
    int of_masses, of_springs; /* the network's counts */
    int steps;                 /* made since the network's time was read */
};

/* dyn_machine_program.c: one part of a step. */
void dyn_machine_part(const struct dyn_machine *m);

#endif
