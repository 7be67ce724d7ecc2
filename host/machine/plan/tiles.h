/* tiles.h - one kernel for several stages on a device of scalar work-items: tiles of the sheet
 * in local memory.
 *
 * An array that one stage stores for the next stage's neighbours need not exist as a whole. A
 * work-group makes a tile of width x height processors: all of its work-items go together
 * through one stage after the other, over the tile and the margin around it that later stages
 * read. Between two stages is a work-group barrier.
 *
 *      stage 0                    stage 1                    stage 2
 *      +---------------------+
 *      |   above             |    +-----------------+
 *      |   +-------------+   |    | +-------------+ |       +-------------+
 *      |   |    tile     |   |    | |    tile     | |       |    tile     |     arrays in global memory are
 *      | l |             | r |    | |             | |       |             |     written in the tile alone
 *      |   +-------------+   |    | +-------------+ |       +-------------+
 *      |   below             |    +-----------------+
 *      +---------------------+
 *        | in local memory: a      ^ |  reads a, keeps b     ^   reads a, b
 *        +-------------------------+ +-----------------------+
 *
 * The margin around a tile is also computed by its neighbours. The sheet is a torus: rows and
 * columns beyond its ends are rows and columns of it, so a tile and its margin may be larger
 * than the sheet. Arrays have no halos where work-items are scalar: their columns are wrapped.
 * Local memory is never wrapped.
 *
 * Arrays in local memory share it by the time that they are needed: each lives from the stage
 * that stores it to the last one that loads it.
 *
 * Turns of a loop are stages like others: those with the same text share a function. The
 * cost model (tiles.c) chooses the size of tiles and the number of turns: larger tiles
 * compute less twice, but use more local memory.
 */
#ifndef LUTETIA_MACHINE_TILES_H
#define LUTETIA_MACHINE_TILES_H

#include "values/geometry.h"

struct tile_stage {
    int left, right, above, below; /* how many processors around the tile it handles, too */
    double ns; /* of one processor: operations, and what is moved to and from local memory */
    double far_ns; /* ... arrays that no stage before it has loaded */
};

struct tile_array {
    int bytes;       /* of an element */
    int stage, last; /* in which it is stored, and loaded for the last time */
    bool stays;      /* it is in global memory, too: in the next turn of a loop it is there */
    int at;          /* decided: where in local memory */
};

/* A stage looks at what another has stored, or at arrays in global memory (from -1): so far
 * from where it is. */
struct tile_look {
    int to, from;
    int left, right, above, below;
};

struct tiling {
    struct tile_stage *stages;
    int stages_count, stages_capacity;
    struct tile_array *arrays; /* in the order of stages */
    int arrays_count, arrays_capacity;
    struct tile_look *looks;
    int looks_count, looks_capacity;
    double stored_ns;        /* of one processor: arrays that are stored in global memory */
    struct tile_stage reach; /* how far all stages together look at arrays in global memory */
    /* decided */
    int width, height;
    int bytes; /* of local memory */
    double ns; /* of one run */
};

/* Of so many stages, about which nothing is known yet. */
void tiling_begin(struct tiling *t, int stages);
/* Returns its number. */
int tiling_array(struct tiling *t, struct tile_array array);
/* Stages are told of in any order. */
void tiling_look(struct tiling *t, struct tile_look look);
/* Each stage's columns and rows around the tile, when all is known. */
void tiling_extents(struct tiling *t);
/* Chooses the tile with the shortest time. placed: also the place of each array. False: none
 * fits. */
bool tiles_choose(struct tiling *t, const struct vpset *set, const struct device_shape *shape,
                  bool placed);
/* How many turns of a loop, of which one is that, are best evaluated at once: those that take
 * least time each, and less than other_ns, which one takes in another way; at most twice as
 * many as usual. 1: that is best one by one. */
int tiles_turns(const struct tiling *t, const struct vpset *set,
                const struct device_shape *shape, double other_ns);
void tiling_finish(struct tiling *t);

#endif
