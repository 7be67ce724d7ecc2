/* scene.h - the initial sheet of all implementations of the diffusion step, and their common
 * interface.
 *
 *     struct diffusion_scene scene;
 *     if (!diffusion_scene_init(&scene, 1024, 1024))
 *         ...bench_error()
 *     struct diffusion_openmp *o = diffusion_openmp_create(&scene);
 *     diffusion_openmp_steps(o, 8);
 *     diffusion_openmp_read(o, DIFFUSION_WATER, array);
 *
 * The step: along x, then along y, for the water and then for each pigment p, in the fibers of
 * the rectangle,
 *
 *     inward(k)  = gravitate(absorbency(k) * (p(k-1) - p(k)) [* water(k) * molecular_weight])
 *     p(k)       = max(min(p(k) + inward(k) - inward(k+1), 1), 0)
 *
 * where gravitate multiplies what is above zero by gravity and divides the rest by it.
 * Fibers outside the rectangle keep what they hold, and their inward is 0. The sheet wraps.
 * All in single precision, in this order: every implementation gives the same bits. Errors.
 * Functions that can fail return false or NULL, and bench_error() says why.
 */
#ifndef LUTETIA_BENCH_SCENE_H
#define LUTETIA_BENCH_SCENE_H

#include <stdbool.h>
#include <stddef.h>

enum { DIFFUSION_WATER, DIFFUSION_PIGMENT, DIFFUSION_FIELDS_COUNT = 4 };

struct diffusion_scene {
    int width, height; /* in fibers, 4 or more each */
    /* The rectangle that takes part: x0 <= x < x1, y0 <= y < y1; not empty. */
    int x0, y0, x1, y1;
    float gravity; /* above zero */
    float molecular_weight[3];
    float humidity; /* water that every fiber loses after a step; 0 in the listing, and
                   * supported by openmp.c only */
    /* initial values: row-major, width by height */
    float *absorbency, *field[DIFFUSION_FIELDS_COUNT]; /* water, three pigments */
};

/* A wet sheet with blots of pigment, the same for the same size; the rectangle leaves two
 * fibers at each edge. */
bool diffusion_scene_init(struct diffusion_scene *s, int width, int height);
void diffusion_scene_finish(struct diffusion_scene *s);

/* ---- plain C with OpenMP (openmp.c): two loops a row and axis, in place ---- */

struct diffusion_openmp;
struct diffusion_openmp *diffusion_openmp_create(const struct diffusion_scene *s);
void diffusion_openmp_destroy(struct diffusion_openmp *o);
void diffusion_openmp_steps(struct diffusion_openmp *o, int steps_count);
/* field: 0..DIFFUSION_FIELDS_COUNT - 1; out: row-major, width by height. */
void diffusion_openmp_read(const struct diffusion_openmp *o, int field, float *out);

/* ---- hand-written OpenCL, one kernel an axis (hand.c, bench/kernels/diffusion_per_axis.cl)
 * ---- */

enum diffusion_shape { DIFFUSION_SHAPE_BEST, DIFFUSION_IN_PLACE, DIFFUSION_STREAMING };

struct diffusion_hand;
/* Device: part of its name or its index, or NULL: LUTETIA_DEVICE, else the first. BEST: in
 * place if the sheet fits the last-level cache and the rectangle does not touch the edges,
 * else streaming. */
struct diffusion_hand *diffusion_hand_create(const struct diffusion_scene *s,
                                             const char *device, enum diffusion_shape shape);
void diffusion_hand_destroy(struct diffusion_hand *h);
/* Waits for the last step. */
bool diffusion_hand_steps(struct diffusion_hand *h, int steps_count);
bool diffusion_hand_read(struct diffusion_hand *h, int field, float *out);

#endif
