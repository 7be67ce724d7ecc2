/* plans.h - what a plan is: for plan_kernels.c, which makes them, and plan_run.c, which runs them. */
#ifndef LUTETIA_MACHINE_PLANS_H
#define LUTETIA_MACHINE_PLANS_H

#include "internal.h"

/* How well a plan's kernels are made: what runs once on little is not worth a second of compiling. */
enum quality { QUICK, OPTIMISED, BOXED };

struct launch {
    cl_kernel kernel;         /* NULL: it is compiled in the background */
    int number;               /* ... there */
    struct kernel_note *note; /* for those who watch; may be NULL */
    int set, vector;
    size_t strip_bytes; /* 0: not in strips */
    int strip_margin, strip_columns;
    int group, tile_width, tile_height; /* group 0: not in tiles */
    struct in_place in_place;
    struct kernel_argument *arguments;
    int arguments_count;
};

/* What a plan stores. Of launches: the one that stores it, and the last that takes it. */
struct array {
    struct rows rows;
    int first, last;
};

struct plan {
    uint32_t *signature;
    uint32_t signature_length;
    uint64_t hash;
    struct launch *launches;
    int launches_count;
    int *stored; /* nodes that get a buffer, in the order of the launches */
    struct array *arrays;
    int stored_count;
    uint32_t version;
    uint64_t worked; /* processors it has run on, all runs together */
    uint64_t work;   /* ... in one run */
    enum quality quality;
    bool could_be_optimised, could_be_boxed, could_be_strips;
    int turns_most;
    double predicted_s;  /* of a run */
    bool later;          /* its kernels are compiled in the background */
    struct plan *better; /* that one's are; it takes this one's place */
    bool empty;          /* there is nothing yet but a better one */
    bool hopeless;       /* of many turns, that cannot be one kernel */
    struct plan *next;
};

/* ---- plan_run.c ---- */

/* Columns of a work-item; tiles along a row. */
size_t plan_run_columns(const struct machine *m, int vector);
size_t plan_tiles_across(const struct vpset *set, int tile_width);
/* New values are to be written over old ones, where nobody wants those. */
bool plan_in_place_wanted(const struct machine *m, const struct plan *p);

#endif
