/* rolling.h - the diffusion step in rolling rows, both axes in one pass, one or several steps
 * at a time: the yardsticks, in OpenCL and in C.
 *
 *     struct diffusion_rolling *r =
 *         diffusion_rolling_create(&scene, NULL, DIFFUSION_TIME_TILED, NULL);
 *     diffusion_rolling_steps(r, 16);
 *     diffusion_rolling_read(r, DIFFUSION_WATER, array);
 *
 * Rows are processed from the last to the first. When the pass along x of row y - 1 is done,
 * the pass along y of row y can be done. The outflow of a fiber is the inflow of the next one,
 * which was computed just before: it is kept in a register along x, and in a row buffer along
 * y.
 *
 *       y - 1   x   read, moved along x, kept --+
 *       y       y   kept by the row before -----+--> moved along y: written
 *       y + 1       its flow in is row y's flow out
 *
 * With several steps at a time, each step has such rows of its own, and is one row behind the
 * step before it. So a row is read once and written once, steps_count steps later.
 *
 *       row     y     y+1     y+2     y+3
 *       step    0      1       2       3       one after the other, then all go to y - 1
 *
 * The sheet is divided into strips of columns, whose rows fit a cache, and into bands of rows.
 * A tile of both is computed with rims around it, which are discarded: steps_count fibers
 * towards lower neighbours and steps_count + 1 towards upper ones, as far as a flow reaches. A
 * rim is a vector of 16, hence at most 15 steps. Tiles read one copy of the sheet and write the
 * other. The single pass needs no rim, and goes in place.
 *
 * The bits are those of the listing. The result is the larger of flow * gravity and flow /
 * gravity (gravity is 1 or more; else the smaller), since rounding keeps the order. An
 * absorbency of 0 makes flows of 0, which change nothing, so the end of the rectangle costs no
 * mask.
 *
 * Errors. Functions that can fail return NULL or false, and bench_error() says why. The
 * rectangle must leave the first row and the first column out: nothing here wraps. Threads.
 * One at a time.
 */
#ifndef LUTETIA_BENCH_ROLLING_H
#define LUTETIA_BENCH_ROLLING_H

#include "scene.h"

/* ---- where the fibers are ---- */

enum {
    ROLLING_LANES = 16,      /* of a vector */
    ROLLING_STEPS_MAX = 15,  /* at a time */
    ROLLING_ROWS_COUNT = 12, /* that a step keeps: along x, flows, written; of each field */
};

/* The rectangle only, with the row and the column before it; fiber (0, 0) of the rectangle is
 * at `origin` of each plane. Columns beyond the rectangle are 0. In floats. */
struct rolling_layout {
    int width, height; /* of the rectangle */
    int columns;       /* width, rounded up to whole vectors */
    int absorbency;    /* its plane; before it one or two copies of the four fields */
    size_t pitch, plane, origin, count;
};

bool rolling_layout_init(struct rolling_layout *l, const struct diffusion_scene *s,
                         int copies_count);
/* Shape: planes holds l->count floats. */
void rolling_fill(const struct rolling_layout *l, const struct diffusion_scene *s,
                  float *planes);
/* From one plane, and from the scene what lies outside the rectangle. out: row-major. */
void rolling_read(const struct rolling_layout *l, const struct diffusion_scene *s, int field,
                  const float *plane, float *out);

/* How the sheet is cut. */
struct rolling_tiling {
    int steps_count; /* at a time, 1..ROLLING_STEPS_MAX */
    int strips_count, bands_count;
};

/* Floats from row to row of a step's rows, and of all rows that a tile needs. */
size_t rolling_row_floats(const struct rolling_layout *l, const struct rolling_tiling *t);
size_t rolling_tile_floats(const struct rolling_layout *l, const struct rolling_tiling *t);
/* Fits t to the sheet: strips of at least four vectors, bands of at least a row. */
void rolling_tiling_clamp(struct rolling_tiling *t, const struct rolling_layout *l);
/* Finds the fastest of the tilings whose rows about fit the second-level cache; run takes
 * t->steps_count steps and leaves the sheet as it is. */
bool rolling_tune(const struct rolling_layout *l, int threads_count,
                  bool (*run)(void *context, const struct rolling_tiling *t), void *context,
                  struct rolling_tiling *best);

/* ---- OpenCL (hand_rolling.c, bench/kernels/diffusion_rolling.cl) ---- */

enum diffusion_rolling_kind {
    DIFFUSION_SINGLE_PASS,
    DIFFUSION_SINGLE_PASS_RELAXED, /* multiplies by 1 / gravity, folds constants: other bits */
    DIFFUSION_TIME_TILED,
    DIFFUSION_TIME_TILED_RELAXED
};

struct diffusion_rolling;
/* device: as in diffusion_hand_create(). tiling: NULL: chosen by a short measurement. */
struct diffusion_rolling *diffusion_rolling_create(const struct diffusion_scene *s,
                                                   const char *device,
                                                   enum diffusion_rolling_kind kind,
                                                   const struct rolling_tiling *tiling);
void diffusion_rolling_destroy(struct diffusion_rolling *r);
bool diffusion_rolling_steps(struct diffusion_rolling *r, int steps_count);
bool diffusion_rolling_read(struct diffusion_rolling *r, int field, float *out);
const struct rolling_tiling *diffusion_rolling_tiling(const struct diffusion_rolling *r);

/* ---- C with OpenMP (openmp_rolling.c) ---- */

struct diffusion_openmp_rolling;
struct diffusion_openmp_rolling *
diffusion_openmp_rolling_create(const struct diffusion_scene *s,
                                const struct rolling_tiling *tiling);
void diffusion_openmp_rolling_destroy(struct diffusion_openmp_rolling *o);
bool diffusion_openmp_rolling_steps(struct diffusion_openmp_rolling *o, int steps_count);
void diffusion_openmp_rolling_read(const struct diffusion_openmp_rolling *o, int field,
                                   float *out);
const struct rolling_tiling *
diffusion_openmp_rolling_tiling(const struct diffusion_openmp_rolling *o);

#endif
