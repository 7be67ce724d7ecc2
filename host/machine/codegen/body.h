/* body.h - the text of what a kernel computes, for all shapes: see rows.c, strips_text.c and tiles_text.c.
 *
 * Each (node, offset) is one variable of the loop over a row's columns; offsets along the last axis are columns,
 * along the others another row. */
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
    uint32_t next; /* in its chain, + 1 */
};

/* Several stages in one loop over a row's columns, where each finds what another has just computed. In the row
 * that a stage has come to its values are in variables: the vector at hand, and earlier ones from the turns of
 * the loop before, which are called c<number>_<how many before>. */
struct together {
    int first;        /* stage: what earlier ones store is loaded */
    const int *down;  /* of a node that is stored: the row it is computed in, from ours */
    const int *ahead; /* how many vectors further right than x; below 0: to the left */
    int direction;    /* 1: x goes from left to right, -1: from right to left */
    int vector;
    const bool *bits_matter; /* of a node: somebody may look at the bits of a NaN in it */
    struct carried {
        int node, back; /* so many earlier vectors of it are wanted */
    } * carried;
    int carried_count, carried_capacity;
};

struct emitter {
    const struct plan_graph *g;
    const struct vpset *set;
    int stage;
    struct text body, rows, pointers, constants;
    struct text row_tests, column_tests; /* whether a vector is inside all boxes */
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
    bool bare; /* pointers are somebody else's: only which there are is noted */
    bool near; /* what earlier stages stored is where NEAR() says: see tiles.h */
    struct together *together; /* NULL: a stage alone */
    int ops, loads, cost;
};

/* Text for nodes of that stage. False: out of memory. */
bool emitter_init(struct emitter *e, const struct plan_graph *g, const struct vpset *set,
                  int stage);
void emitter_finish(struct emitter *e);

struct operand {
    char text[24];
};

/* The node's value in that row and column; canonical: a NaN in it has the bits that are stored. */
struct operand emit_value(struct emitter *e, int node, int row, int dx, bool canonical);
/* A comparison of a coordinate with a number. */
bool emit_is_box(const struct plan_graph *g, const struct plan_node *n);
/* The row at that distance along an axis from ours, which is row 0. */
int emit_row(struct emitter *e, int axis, int distance);
void emit_argument(struct arguments *to, int kind, int node, int size, bool *failed);
/* "int c0 = ...": coordinates along all axes but the last, where rows need them. */
void emit_axes(const struct emitter *e, struct text *t);
/* How far down the row is that the pointer looks at, the short way round; of two axes. */
int emit_rows_down(const struct emitter *e, const struct access *p);
/* How a kernel's argument is declared that is a number, or its upper half; *count: numbers so far. */
void emit_number(struct text *t, const struct plan_graph *g, const struct kernel_argument *a,
                 int *count);
/* Arrays and numbers that one part of a kernel takes are the kernel's arguments, too, once each. number: of a node
 * that is a number, + 1; of an array that is read, anything. *count: numbers so far. */
void emit_collect(struct arguments *to, const struct emitter *e, int *number, int *count,
                  bool *failed);
/* The numbers that a part takes: as it declares them, and as the kernel passes them. */
void emit_numbers(struct text *t, const struct emitter *e);
void emit_numbers_passed(struct text *t, const struct emitter *e, const int *number);
/* The end of a kernel's text and its arguments: good: out has them; else they are freed. */
void emit_hand_over(bool good, struct text *t, struct arguments *a, struct kernel_text *out);
/* What the prelude is told. */
void emit_options(struct kernel_text *k, int halo, bool wraps, bool streams, int lane);
/* Stores that pass the caches by pay where the arrays, of so many bytes, do not fit anyway. */
bool emit_streams(const struct device_shape *shape, const struct vpset *set, int vector,
                  double bytes);

#endif
