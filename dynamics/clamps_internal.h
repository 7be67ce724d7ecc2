/* clamps_internal.h - struct dyn_clamps, for clamps.c and clamps_file.c. */
#ifndef LUTETIA_DYN_CLAMPS_INTERNAL_H
#define LUTETIA_DYN_CLAMPS_INTERNAL_H

#include "clamps.h"

struct dyn_key {
    int mass;
    double time_s, x, y;
    bool free; /* let go */
};

struct dyn_clamps {
    struct dyn_key *keys;
    int count, capacity;
};

#endif
