/* accesses.h - what a stage of a kernel looks at, found by a walk of the graph.
 *
 * The walk goes from what a stage stores down to what it finds in memory, and keeps where it
 * is: shifts along the last axis move it by columns, shifts along another axis to another row.
 *
 *     stored in this stage        a(x) + west(b)(x) + north(b)(x)
 *     found in memory             a: row 0, columns 0..0     b: row 0, columns -1..-1
 *                                 b: row 1 (one up), columns 0..0
 *
 * From this follow which rows and columns stages must be behind each other
 * (codegen/strips_schedule.c), how large the surroundings of a tile are (codegen/tiles_text.c),
 * what both cost, and which stages are turns of one loop. Codegen goes the same way and writes;
 * the test `machine_accesses` compares the two. */
#ifndef LUTETIA_MACHINE_ACCESSES_H
#define LUTETIA_MACHINE_ACCESSES_H

#include "plan/plan.h"

struct row_offset {
    int d[MACHINE_AXES_MAX]; /* the last axis is always 0 here */
};

/* A node in memory that is looked at, in one row. */
struct access {
    int node, row; /* row: among the rows of whoever found it */
    int low, high; /* columns that are looked at, from where we are */
};

struct accesses {
    const struct plan_graph *g;
    const struct vpset *set;
    int stage;
    struct access *list;
    int count, capacity;
    struct row_offset *rows; /* rows[0]: where we are */
    int rows_count, rows_capacity;
    int ops, loads, cost; /* as of struct kernel_text */
    bool wide, soft;      /* 128 bits, or float operations that go lane by lane */
    bool failed;          /* no memory */
    /* What is computed, step by step, as numbers: stages with the same are written alike. */
    uint32_t *form;
    int form_count, form_capacity;
    struct accesses_seen *seen; /* while it is made; NULL later */
};

void accesses_begin(struct accesses *a, const struct plan_graph *g, const struct vpset *set,
                    int stage);
/* The stage wants the node where we are, too. canonical: a NaN in it with the bits that are
 * stored. */
void accesses_add(struct accesses *a, int node, bool canonical);
/* All is known: what only accesses_add() needs goes. */
void accesses_end(struct accesses *a);
void accesses_finish(struct accesses *a);
bool accesses_same(const struct accesses *a, const struct accesses *b);
/* How far down an access's row is, the short way round; of two axes. */
int accesses_down(const struct accesses *a, const struct access *p);
int row_down(const struct vpset *set, const struct row_offset *row);

/* Whose NaNs are looked at bit by bit when they have been kept for a later stage. In arrays all
 * are canonical. */
void accesses_find_bits(const struct plan_graph *g, bool *bits_matter);
/* Some of it may be a NaN whose bits are the program's, not an operation's. */
bool accesses_holds_bits(const struct plan_graph *g, int node);

#endif
