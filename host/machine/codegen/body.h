/* body.h - the text of what a kernel computes, for all shapes: see rows.c, strips_text.c and
 * tiles_text.c.
 *
 * Each (node, offset) is one variable of the loop over a row's columns; offsets along the last
 * axis are columns, along the others another row. */
#ifndef LUTETIA_MACHINE_BODY_H
#define LUTETIA_MACHINE_BODY_H

#include "codegen/codegen.h"
#include "codegen/text.h"
#include "plan/accesses.h"

struct arguments {
    struct kernel_argument *list;
    int count, capacity;
};

struct variable {
    int32_t node, row, dx;
    bool canonical;
    int name;
    uint32_t next; /* next node in its hash chain, + 1 */
};

/* Several stages in one loop over a row's columns, where each can use values that another
 * has just computed. In its present row, a stage's values are in variables: the present
 * vector, and vectors of earlier iterations, called c<number>_<iterations before>. */
struct together {
    int first;        /* first stage: results of earlier stages are loaded */
    const int *down;  /* of a node that is stored: the row it is computed in, from ours */
    const int *ahead; /* vectors further right than x; negative: to the left */
    int direction;    /* 1: x goes from left to right, -1: from right to left */
    int vector;
    const bool *bits_matter; /* by node: the bits of a NaN in it may be read */
    struct carried {
        int node, back; /* the number of earlier vectors needed */
    } * carried;
    int carried_count, carried_capacity;
};

struct emitter {
    const struct plan_graph *g;
    const struct vpset *set;
    int stage;
    struct text body, rows, pointers, constants;
    struct text row_tests, column_tests; /* tests whether a vector is inside all boxes */
    struct variable *variables;
    uint32_t variables_count, variables_capacity, chains[1024];
    struct row_offset *row_offsets;
    int rows_count, rows_capacity;
    struct access *seen_pointers;
    int pointers_count, pointers_capacity;
    int *input_number, *constant_number; /* of a node: + 1 */
    struct arguments arguments;
    int inputs, constants_count, names;
    int lane;  /* bits: 32, or as plan/lanes.h says */
    int reach; /* furthest column */
    bool wide, soft, formats, math, integers, axes_used, failed;
    bool bare; /* pointers are supplied by the caller: only the set of rows is recorded */
    bool near; /* results of earlier stages are at NEAR(): see tiles.h */
    struct together *together; /* NULL: a single stage */
    int ops, loads, cost;
};

/* Text for nodes of that stage. False: out of memory. */
bool emitter_init(struct emitter *e, const struct plan_graph *g, const struct vpset *set,
                  int stage);
void emitter_finish(struct emitter *e);

struct operand {
    char text[24];
};

/* Emits the node's value in that row and column; canonical: NaNs have the bits that are
 * stored. */
struct operand emit_value(struct emitter *e, int node, int row, int dx, bool canonical);
/* A comparison of a coordinate with a number. */
bool emit_is_box(const struct plan_graph *g, const struct plan_node *n);
/* Returns the number of the row at that distance along an axis from the present row, which
 * is row 0. */
int emit_row(struct emitter *e, int axis, int distance);
void emit_argument(struct arguments *to, int kind, int node, int size, bool *failed);
/* Emits "int c0 = ...": coordinates along all axes but the last, as far as rows need them. */
void emit_axes(const struct emitter *e, struct text *t);
/* How far below the present row the pointer's row is, the shorter way round; for two axes. */
int emit_rows_down(const struct emitter *e, const struct access *p);
/* Declares a kernel's argument for a constant, or for its upper half; *count: constants so
 * far. */
void emit_number(struct text *t, const struct plan_graph *g, const struct kernel_argument *a,
                 int *count);
/* Adds a part's arrays and constants to the kernel's arguments, once each. number: by node,
 * of constants, + 1; for arrays any value. *count: constants so far. */
void emit_collect(struct arguments *to, const struct emitter *e, int *number, int *count,
                  bool *failed);
/* A part's constants: as parameters in its declaration, and as arguments of its call. */
void emit_numbers(struct text *t, const struct emitter *e);
void emit_numbers_passed(struct text *t, const struct emitter *e, const int *number);
/* Completes a kernel's text and arguments: if good, `out` gets them; else they are freed. */
void emit_hand_over(bool good, struct text *t, struct arguments *a, struct kernel_text *out);
/* Sets the build options for the prelude. */
void emit_options(struct kernel_text *k, int halo, bool wraps, bool streams, int lane);
/* Whether stores should bypass the caches, because the arrays, of that many bytes, do not
 * fit them. */
bool emit_streams(const struct device_shape *shape, const struct vpset *set, int vector,
                  double bytes);

#endif
