/* paper_openmp.h - the memory layout of the peer's sheet: all fields of a row are adjacent.
 *
 *     a row:  | surface water | water | dried | ... | fixed 5 |     each | margin | width fibers | margin |
 */
#ifndef LUTETIA_BENCH_PAPER_OPENMP_H
#define LUTETIA_BENCH_PAPER_OPENMP_H

#include "paper_peer.h"

#include <stddef.h>

enum { MARGIN = 16, LANES = 16, PAGE_BYTES = 4096 };

/* Fields of a row, then three for each pigment. */
enum {
    F_SURFACE_WATER,
    F_WATER,
    F_DRIED, /* whole numbers */
    F_AROUND,
    F_HEIGHT,
    F_ABSORBENCY,
    F_CAPACITY,
    F_FACE_X,
    F_FACE_Y,
    F_RESIST,
    F_PIGMENTS
};

struct paper_openmp {
    struct paper_peer_config config;
    int fields_count, flowing; /* amounts that flow: 2 + 2 * pigments */
    size_t pitch;              /* floats from field to field */
    size_t stride;             /* ... from row to row */
    float *memory;
};

static inline float *field_row(const struct paper_openmp *o, int field, int y)
{
    int height = o->config.height;
    y = y < 0 ? y + height : y >= height ? y - height : y; /* at most three rows beyond */
    return o->memory + (size_t)y * o->stride + (size_t)field * o->pitch + MARGIN;
}

static inline void margins_fill(float *row, int width, int reach)
{
    for (int i = 0; i < reach; i++) {
        row[-1 - i] = row[width - 1 - i];
        row[width + i] = row[i];
    }
}

#endif
