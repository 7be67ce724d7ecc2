/* shape.h - what generated code should look like on a device, and what things cost there. */
#ifndef LUTETIA_MACHINE_SHAPE_H
#define LUTETIA_MACHINE_SHAPE_H

#include "machine.h"

struct device_shape {              /* what generated code should look like there */
    int vector;                    /* lanes of 32 bits in a work-item; 1 on a GPU */
    int halo;                      /* columns of padding, where vectors are used */
    double op_ns;                  /* cost model: one vector instruction, for an element */
    double byte_ns;                /* ... one byte to or from memory */
    double near_byte_ns;           /* ... to or from a cache, or local memory */
    int near_bytes;                /* of a cache, which rings should not fill */
    int strip_columns;             /* the most, a multiple of the vector */
    bool no_strips, always_strips; /* or tiles: see plan.c; for tests */
    int run_columns;               /* of a work-item: a multiple of the vector, but on a GPU */
    int strips_each;               /* for each unit */
    int units;                     /* that compute at the same time */
    int group;                     /* of a tile: work-items; 0: there are no tiles */
    int local_bytes;               /* of local memory, for a work-group */
    int tile_width, tile_height;   /* forced; 0: free */
    int turns;                     /* of a loop at once */
    bool narrow;                   /* kernels may have lanes of 8 or 16 bits */
    bool keeps_nan;                /* see enum op_nan */
    bool streams;                  /* large arrays are stored past the caches */
    double launch_ns;              /* ... a launch */
};

/* What is usual on a GPU, but for what the device tells. */
struct device_shape shape_gpu(void);

#endif
