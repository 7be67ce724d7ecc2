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
    /* two of each that neighbours look at while it changes */
    F_SIZING,
    F_CURRENT,
    F_WET,
    F_WET_OTHER,
    F_AROUND_OTHER,
    F_SPEED_X,
    F_SPEED_Y,
    F_EASE_X,
    F_EASE_Y,
    F_SWIRL,
    F_PIGMENTS
};

/* What a step leaves from pass to pass, a row for each row of the sheet. */
enum {
    T_PART,
    T_STIRRED,
    T_LOAD,
    T_ROOM,
    T_DEPTH,
    T_LEVEL,
    T_DEEP,
    T_INVERSE,
    T_SWIRLED,
    T_SATURATED,
    T_THRESHOLD,
    T_LEFT,
    T_THIN,
    /* along x, then along y: water out, in; pigments out, in; pigments in fibers out, in */
    T_FACES,
    T_CREEP_X = T_FACES + 12,
    T_CREEP_Y,
    T_TERMS,
    T_CORNERS = T_TERMS,
    T_BELOW,
    T_ALONG,
    T_UP /* one for each amount that flows */
};

struct paper_openmp {
    struct paper_peer_config config;
    int fields_count, flowing; /* amounts that flow: 2 + 2 * pigments */
    size_t pitch;              /* floats from field to field */
    size_t stride;             /* ... from row to row */
    float *memory;
    int wet_now, wet_next, around_now, around_next; /* fields; they change places */
    size_t terms_stride;
    float *terms;
};

static inline float *field_row(const struct paper_openmp *o, int field, int y)
{
    int height = o->config.height;
    y = y < 0 ? y + height : y >= height ? y - height : y; /* at most three rows beyond */
    return o->memory + (size_t)y * o->stride + (size_t)field * o->pitch + MARGIN;
}

static inline float *term_row(const struct paper_openmp *o, int term, int y)
{
    int height = o->config.height;
    y = y < 0 ? y + height : y >= height ? y - height : y;
    return o->terms + (size_t)y * o->terms_stride + (size_t)term * o->pitch + MARGIN;
}

/* Where amount q of those that flow is kept: water above and below, then each pigment's. */
static inline int flow_field(int q)
{
    return q == 0 ? F_SURFACE_WATER : q == 1 ? F_WATER : F_PIGMENTS + 3 * ((q - 2) / 2) + q % 2;
}

/* paper_openmp_flow.c */
void paper_openmp_flow_start(struct paper_openmp *o);

static inline void margins_fill(float *row, int width, int reach)
{
    for (int i = 0; i < reach; i++) {
        row[-1 - i] = row[width - 1 - i];
        row[width + i] = row[i];
    }
}

#endif
