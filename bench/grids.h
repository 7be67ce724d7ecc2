/* grids.h - Conway's Life and the heat equation, as C/Paris programs and in C with OpenMP: what
 * `lutetia bench life` and `lutetia bench heat` compare.
 *
 *     struct life_paris life;
 *     life_paris_allocate(&life, width, height);
 *     ...fill life.alive...
 *     life_paris_step(&life);
 *
 * Life is on a torus. Heat: the rim of a plate is held at its temperature, and inside
 *
 *     h += rate * (corners + 4 * edges - 20 * h)
 *
 * of the eight neighbours, in single precision and in the order of heat_paris_step, so that the
 * bits are the same. */
#ifndef LUTETIA_BENCH_GRIDS_H
#define LUTETIA_BENCH_GRIDS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* ---- C/Paris (grids_paris.c): clients of <cm/paris.h> and of nothing else ---- */

/* CM_field_id_t, without its header. */
typedef unsigned int grid_field;

struct life_paris {
    grid_field alive; /* one bit */
    grid_field sum, side;
};

/* Each makes a VP set of height by width, selects it, and allocates on its heap. */
void life_paris_allocate(struct life_paris *l, int width, int height);
void life_paris_step(const struct life_paris *l);

struct heat_paris {
    grid_field heat; /* a single float */
    grid_field up, down, side, corners, inside;
};

void heat_paris_allocate(struct heat_paris *h, int width, int height);
void heat_paris_step(const struct heat_paris *h);

/* ---- C with OpenMP (grids_openmp.c) ---- */

static const double HEAT_RATE = 0.03; /* as a float, in both */

struct grid_openmp;
/* Errors: NULL, bench_error(). start: row-major, width by height. */
struct grid_openmp *life_openmp_create(int width, int height, const uint8_t *start);
void life_openmp_steps(struct grid_openmp *g, int steps_count);
void life_openmp_read(const struct grid_openmp *g, uint8_t *out);
/* 64 cells in a word. Shape: width a multiple of 64. */
struct grid_openmp *life_bits_create(int width, int height, const uint8_t *start);
void life_bits_steps(struct grid_openmp *g, int steps_count);
void life_bits_read(const struct grid_openmp *g, uint8_t *out);
struct grid_openmp *heat_openmp_create(int width, int height, const float *start);
void heat_openmp_steps(struct grid_openmp *g, int steps_count);
void heat_openmp_read(const struct grid_openmp *g, float *out);
void grid_openmp_destroy(struct grid_openmp *g); /* takes NULL */

#endif
