/* works_paris.h - what the programs of works.h in C/Paris have in common. */
#ifndef LUTETIA_BENCH_WORKS_PARIS_H
#define LUTETIA_BENCH_WORKS_PARIS_H

#include <cm/paris.h>

#include "works.h"

enum { WORD = 32, LONG = 64, FIELDS = 8, S = 23, E = 8, LONG_S = 52, LONG_E = 11 };

/* A grid of the multigrid. */
struct work_grid {
    CM_geometry_id_t geometry;
    CM_vp_set_id_t set;
    CM_field_id_t u, f, sum, other; /* f: what u is solved for */
    CM_field_id_t finer, coarser;   /* addresses in the grids before and after it */
    int side;
};

struct work_paris {
    enum work work;
    int n, side;
    CM_geometry_id_t geometry, bins_geometry;
    CM_vp_set_id_t set, bins_set;
    CM_field_id_t in, odd, f[FIELDS], bit, array, bins, bins_odd;
    struct work_grid grids[WORK_GRIDS];
    uint32_t *words, *moved; /* on the front end; moved: what a transposition comes to */
};

/* works_common_paris.c */
/* The sum of all, each times 2 place + 1. x is overwritten. */
uint32_t work_paris_weighed(CM_field_id_t x, CM_field_id_t odd);
/* 12 bits of what it begins with, as a float from 0 to 1. */
void work_part_make(const struct work_paris *p, CM_field_id_t dest, unsigned int shift);

/* works_sets_paris.c */
bool work_fourier_prepare(struct work_paris *p);
uint32_t work_paris_fourier(const struct work_paris *p, uint32_t turn);
void work_multigrid_prepare(struct work_paris *p);
uint32_t work_paris_multigrid(const struct work_paris *p, uint32_t turn);
uint32_t work_paris_vectors(const struct work_paris *p, uint32_t turn);
uint32_t work_paris_few(const struct work_paris *p, uint32_t turn);

#endif
