/* strips.h - one kernel for several stages: a strip of columns, line by line.
 *
 * What one stage stores for the neighbours of the next need not exist as a whole: each work-item goes down
 * a strip, and each stage handles a row as soon as the rows that it looks at have been made.
 *
 *     i = row that the strip has come to, here from the highest down
 *
 *     stage 0  at row i          reads arrays            keeps a
 *     stage 1  at row i - 1      reads arrays, a         keeps b, and writes an array
 *     stage 2  at row i - 3      reads a, b              writes an array
 *
 *     delay   how many rows a stage is behind: enough for the lowest row that it looks at
 *     above   how many rows above its strip a stage begins, since later ones look at those; below,
 *             left, right: likewise
 *
 * Stages that follow each other are *passes*: each pass is one loop over the columns of a row, VECTOR at a time.
 * What a stage of a pass has just computed others of the pass find in variables. Along the row a stage may be some
 * vectors ahead of those that look further on than it; what they want of earlier vectors stays in variables, too:
 *
 *     x                x + VECTOR
 *     [ c0_1        ][ v7        ]      v7: computed now, c0_1: v7 of the turn before
 *         [ wanted      ]               lanes of both, put together
 *
 * Rows are taken from the lowest up, or from the highest down, columns from right to left, or from left to right:
 * whichever way round keeps least. Of one stage, what is computed together is a *unit*, which has a delay of its own.
 *
 * Other rows, and what other passes have made, are kept in *rings* of a few rows as wide as the strip, which stay
 * in the caches. So a value that several look at is computed once, and many steps of a stencil can go through the
 * caches at once; see Hegarty et al., "Darkroom" (SIGGRAPH 2014), for the same among image filters.
 *
 * Where strips are as wide as rows, an array may take the memory of one that is read and that nobody wants any more:
 * each of its rows is written after the last time that the strip reads what was there. What strips read of each
 * other's rows, their *borders*, is copied before; see borders.cl.
 *
 * What lies beyond a strip is computed twice, by both neighbours, and kept in rings only. The sheet is a torus:
 * rows beyond its ends are rows of it, and columns are in the halos of arrays, which must be wide enough for all
 * stages together. Where a strip is as wide as a row, the rows of its rings are tori, too (s->whole): each
 * gets halos when it has been made, and nothing is computed twice but what stays in variables.
 *
 * Vectors begin where x is a multiple of VECTOR; lanes that are beyond a row's halos hold anything, and nobody looks
 * at them.
 *
 * Stages that compute the same again and again are turns of a loop, and each turn is a pass: a function,
 * which all turns with the same text share. */
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

/* Rings of so many rows: the first row of all of them, one after the other, then the second .. So what a pass looks at
 * in one row of many rings is at one address and a number. */
struct rings {
    int rows;
    int at;    /* in the strip's memory, bytes for each column */
    int bytes; /* of a row of all of them, for each column */
};

/* Of some rings, the row that is so many below a pass's: where that of the first ring begins that the pass looks at. */
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

/* What is stored, in stages' order. Without memory s->failed is set; strips_finish() in any case. */
void strips_init(struct strips *s, const struct plan_graph *g, const int *stores, int count,
                 const struct vpset *set, const struct device_shape *shape, int vector);
void strips_finish(struct strips *s);

/* Looks at what stages look at, and decides on passes, rows, columns and rings. False: it cannot be done in strips, or
 * memory is out. */
bool strips_schedule(struct strips *s);
/* Once passes have their text: the margin that they need. False: more than there is around arrays. */
bool strips_find_margin(struct strips *s);
/* As many columns as leave the rings near, but not so few that what strips compute twice counts; all strips about as
 * wide. */
int strips_columns(const struct strips *s);
/* Those of a ring's row: as wide as a strip, of which the last takes what is left, too, and both margins. They are part
 * of the text: of few numbers, so that sheets of many sizes have the same. */
int strips_near_columns(const struct strips *s, int columns);

/* ---- strips_pass.c ---- */

/* -1: it has none. */
int strips_border_of(const struct strips *s, int node);
bool strips_in_places(const struct strips *s, int output);
bool strips_has_boxes(const struct strips *s, const struct emitter *e);
void strips_pass_make(struct strips *s, int number);

/* ---- prefetch.c ---- */

/* What the next turn of the loop over columns is going to want of the next row. */
void prefetch_columns(const struct strips *s, struct pass *pass, struct text *t);
/* What is looked at outside of boxes only: a vector or two of a row, each of which would be waited for. */
void prefetch_outside(const struct strips *s, struct pass *pass, struct text *t);
/* What is looked at beyond the columns that a loop goes over. */
void prefetch_beyond(const struct strips *s, struct pass *pass, struct text *t);
/* Rows one after the other: which rows there are, and what a turn fetches of them. */
void prefetch_rows(const struct strips *s, struct pass *pass, struct text *before,
                   struct text *turn);
int prefetch_arrays(const struct strips *s, const struct pass *pass);

#endif
