/* codegen.h - the text of a kernel, and its arguments. */
#ifndef LUTETIA_MACHINE_CODEGEN_H
#define LUTETIA_MACHINE_CODEGEN_H

#include "plan/plan.h"

/* Which stored arrays may be written in place of which loaded ones: see strips.h. */
enum { BORDERS_MOST = 16 };

struct in_place {
    int leaves[BORDERS_MOST]; /* nodes whose borders can be copied */
    int leaves_count;
    struct {
        int output, leaf; /* nodes */
        int border;       /* of the leaf, in leaves */
    } * pairs;
    int pairs_count, pairs_capacity;
    int above, below; /* rows of a border */
    int bytes;        /* of an element of each leaf, all together */
    bool pays;        /* all arrays together are larger than the caches */
};

enum kernel_argument_kind {
    ARGUMENT_INPUT,
    ARGUMENT_OUTPUT,
    ARGUMENT_CONSTANT,
    ARGUMENT_SECOND,
    ARGUMENT_BORDERS, /* of strips: which arrays are written in place */
    ARGUMENT_SCRATCH, /* of strips */
    ARGUMENT_CLAIMS,  /* the device's, and what it is told: see claims.cl */
    ARGUMENT_CLAIM,
    ARGUMENT_NUMBER /* of no node: see numbers.h */
};

struct kernel_argument {
    uint8_t kind; /* enum kernel_argument_kind; SECOND: imm.hi of the node */
    uint8_t size; /* of a constant or number, bytes */
    int32_t node;
    uint64_t number; /* of NUMBER */
};

struct kernel_text {
    char *text; /* without the prelude; numbers of rows are marked: see numbers.h */
    char options[160];
    struct kernel_argument *arguments;
    int arguments_count;
    int vector;
    bool wide, soft, formats, wraps, math;
    bool claims;        /* work-groups claim their places: claims.h */
    bool has_boxes;     /* has boxes, or would have them if requested */
    int ops, loads;     /* emitted */
    size_t strip_bytes; /* memory that each strip needs; 0: not in strips */
    int strip_margin;   /* rows that each computes besides its own */
    int strip_columns;  /* columns of each strip but the last, which also takes the rest */
    int group;          /* of a tile: work-items; 0: not in tiles */
    int tile_width, tile_height;
    struct in_place in_place;
    int cost; /* node_cost() of these operations, and of coordinates and random numbers */
};

/* One kernel that stores the given nodes, all of one stage and VP set. false: out of memory. */
bool rows_emit(const struct plan_graph *g, const int *stores, int stores_count,
               const struct vpset *set, const struct device_shape *shape,
               struct kernel_text *out);
/* strips_text.c: one kernel for all stages; the nodes are of one VP set with two axes.
 * False: impossible. */
bool strips_emit(const struct plan_graph *g, const int *stores, int count,
                 const struct vpset *set, const struct device_shape *shape,
                 struct kernel_text *out);
/* tiles_text.c: likewise, on scalar work-items. */
bool tiles_emit(const struct plan_graph *g, const int *stores, int count,
                const struct vpset *set, const struct device_shape *shape,
                struct kernel_text *out);
void kernel_text_finish(struct kernel_text *k);

#endif
