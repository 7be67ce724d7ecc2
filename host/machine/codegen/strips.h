/* strips.h - one kernel for several stages: a strip of columns, line by line.
 *
 * An array that one stage stores for the next stage's neighbours need not exist as a whole:
 * each work-item goes down a strip, and each stage handles a row as soon as the rows that it
 * reads have been computed.
 *
 *     i = row that the strip has come to, here from the highest down
 *
 *     stage 0  at row i          reads arrays            keeps a
 *     stage 1  at row i - 1      reads arrays, a         keeps b, and writes an array
 *     stage 2  at row i - 3      reads a, b              writes an array
 *
 *     delay   how many rows a stage is behind: enough for the lowest row that it looks at
 *     above   how many rows above its strip a stage begins, since later ones look at those;
 *             below, left, right: likewise
 *
 * Consecutive stages form *passes*: each pass is one loop over the columns of a row, VECTOR at
 * a time. Values that a stage of a pass has just computed are in variables, for the other
 * stages of the pass. Along the row a stage may run some vectors ahead of stages that read its
 * values at larger offsets; the earlier vectors that these need stay in variables, too:
 *
 *     x                x + VECTOR
 *     [ c0_1        ][ v7        ]      v7: computed now, c0_1: v7 of the turn before
 *         [ wanted      ]               lanes of both, put together
 *
 * Rows are taken from the lowest up, or from the highest down, columns from right to left, or
 * from left to right: in the directions that keep least. Values that a stage computes together
 * are a *unit*, which has a delay of its own.
 *
 * Other rows, and the results of other passes, are kept in *rings* of a few rows as wide as the
 * strip, which stay in the caches. So a value with several readers is computed once, and many
 * steps of a stencil can go through the caches at once; see Hegarty et al., "Darkroom"
 * (SIGGRAPH 2014), for the same among image filters.
 *
 * If strips are as wide as rows, an array may be written in place of one that is read and not
 * needed afterwards: each row is written after the strip has read the old row for the last
 * time. Rows that strips read of each other, their *borders*, are copied before; see
 * borders.cl.
 *
 * The margin beyond a strip is computed twice, by both neighbours, and kept in rings only. The
 * sheet is a torus: rows beyond its ends are rows of it, and columns are in the halos of
 * arrays, which must be wide enough for all stages together. Where a strip is as wide as a row,
 * the rows of its rings are tori, too (s->whole): each gets halos when it is complete, and only
 * values in variables are computed twice.
 *
 * Vectors begin where x is a multiple of VECTOR; lanes beyond a row's halos hold arbitrary
 * values, which are never used.
 *
 * Stages that compute the same again and again are turns of a loop, and each turn is a pass:
 * a function, which all turns with the same text share.
 */
#ifndef LUTETIA_MACHINE_STRIPS_H
#define LUTETIA_MACHINE_STRIPS_H

#include "codegen/body.h"

struct stage {
    struct accesses looks; /* of it alone */
    int pass;
};

/* Values that a stage stores, and that are computed together. */
struct unit {
    struct accesses looks; /* of it alone */
    int stage;
    int delay, above, below, left, right;
    int ahead; /* vectors, the way that x goes */
};

struct output {
    int node;
    bool array; /* else its ring */
    bool asks;  /* the first of those that are stored together */
};

/* Rings with the same number of rows: the first rows of all of them, one after the other,
 * then the second rows, and so on. So a pass addresses one row of many rings by one pointer
 * and constant offsets. */
struct rings {
    int rows;
    int at;    /* in the strip's memory, bytes for each column */
    int bytes; /* of a row of all of them, for each column */
};

/* Of some rings, the row that is so many below a pass's: where that of the first ring begins
 * that the pass looks at. */
struct ring_row {
    int rings, down, first;
};

struct pass {
    struct emitter e;
    struct together together;
    struct text text, span; /* of its functions, but for their names */
    int same;               /* the first pass with that text */
    int first, last;        /* stages */
    int delay;              /* of the first of its rows */
    int above, below;       /* rows */
    int before, after;      /* columns, whole vectors */
    bool even; /* all that it stores is of columns first - columns .. last - columns - 1 of x */
    int columns;
    struct output *outputs;
    int outputs_count;
    bool *inside; /* of a node: it is looked at inside all boxes, too */
    struct ring_row *ring_rows;
    int ring_rows_count, ring_rows_capacity;
};

struct strips {
    const struct plan_graph *g;
    const struct vpset *set;
    const struct device_shape *shape;
    const int *stores;
    int stores_count, vector, lane;
    struct stage *stages;
    int stages_count;
    struct unit *units; /* stage by stage */
    int units_count;
    int *unit; /* of a node that is stored */
    struct pass *passes;
    int passes_count;
    int downward, rightward; /* 1, or -1: rows from the lowest up, columns from right to left */
    int *down, *ahead;       /* of nodes that are stored: see struct together */
    bool *bits_matter;
    int *ring_rows; /* of a node: how many; 0: no ring */
    bool whole;     /* the strip is as wide as the row: rings have halos */
    int *wraps;     /* of a ring, bits: whose halos are looked at */
    int *ring_at;   /* of a node: where in the row of its rings, in bytes for each column */
    int *rings_of;  /* of a node */
    struct rings *rings;
    int rings_count, rings_capacity;
    int *number; /* of a node that is a number, + 1; of an array that is read */
    int memory;  /* of a strip, bytes for each column */
    struct in_place in_place;
    int margin; /* columns of a ring on both sides of the strip's */
    struct arguments arguments;
    int constants_count;
    bool failed;
};

enum { WRAPS_LEFT = 1, WRAPS_RIGHT = 2 };

/* ---- strips_schedule.c ---- */

/* What is stored, in stages' order. Without memory s->failed is set; strips_finish() in any
 * case. */
void strips_init(struct strips *s, const struct plan_graph *g, const int *stores, int count,
                 const struct vpset *set, const struct device_shape *shape, int vector);
void strips_finish(struct strips *s);

/* Finds what stages read, and decides on passes, rows, columns and rings. False: strips are
 * impossible, or memory is short. */
bool strips_schedule(struct strips *s);
/* Once passes have their text: computes the margin that they need. False: more than the
 * halos of arrays. */
bool strips_find_margin(struct strips *s);
/* The widest strips whose rings stay near, but not so narrow that the doubly computed
 * margins cost much; all strips have about the same width. */
int strips_columns(const struct strips *s);
/* Columns of a ring's row: the widest strip (the last one also takes the remainder) and both
 * margins. The number is part of the kernel's text, so it is rounded to few values; sheets
 * of many sizes then share a kernel. */
int strips_near_columns(const struct strips *s, int columns);

/* ---- strips_pass.c ---- */

/* -1: it has none. */
int strips_border_of(const struct strips *s, int node);
bool strips_in_places(const struct strips *s, int output);
bool strips_has_boxes(const struct strips *s, const struct emitter *e);
void strips_pass_make(struct strips *s, int number);

/* ---- prefetch.c ---- */

/* Prefetches what the next iteration of the loop over columns needs of the next row. */
void prefetch_columns(const struct strips *s, struct pass *pass, struct text *t);
/* Prefetches what is read outside of boxes only: a vector or two of a row, for each of which
 * the CPU would wait. */
void prefetch_outside(const struct strips *s, struct pass *pass, struct text *t);
/* Prefetches what is read beyond the loop's columns. */
void prefetch_beyond(const struct strips *s, struct pass *pass, struct text *t);
/* Prefetches rows one after the other: the list of rows, and the pieces for an iteration. */
void prefetch_rows(const struct strips *s, struct pass *pass, struct text *before,
                   struct text *turn);
int prefetch_arrays(const struct strips *s, const struct pass *pass);

#endif
