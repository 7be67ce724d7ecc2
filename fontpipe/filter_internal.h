/* filter_internal.h - a filter's tables, as the kernels read them.
 *
 * A point at x adds h(X - x) to the pixel whose centre is X. With a = x - first - radius + 1/2
 * (see gray.c), i = floor(a) and p = a - i, the pixels i .. i + taps - 1 are reached, and the
 * k-th from there by k + 1 - p - radius. Rows are the same, one more of them: what a row adds
 * to the one above it, H(k + 1 - p - radius) - H(k - p - radius).
 *
 * Each table has FONT_PHASES rows for p = 0, 1/32, ..; a row is the values there and, behind
 * them, the differences to the next. Taps are surrounded by what belongs beyond them, so that
 * 16 values at any offset are one load:
 *
 *     x: 16 zeros, taps, zeros up to 32          h: 16 zeros, taps, then the total up to 48
 *     y: rows, zeros up to 16
 */
#ifndef LUTETIA_FONT_FILTER_INTERNAL_H
#define LUTETIA_FONT_FILTER_INTERNAL_H

#include "filter.h"

enum {
    FONT_PHASES = 32,
    FONT_X_ROW = 32, /* floats; twice that with the differences */
    FONT_H_ROW = 48,
    FONT_Y_ROW = 16,
    FONT_TERMS_MAX = 8,
    FONT_TERM_FLOATS = FONT_PHASES * 2 * (FONT_X_ROW + FONT_H_ROW + FONT_Y_ROW),
    FONT_NODES_MAX = 8,
    FONT_LENGTHS = 20, /* a quarter of a pixel, times the fourth root of 2 each */
    FONT_SLANTS = 6
};
#define FONT_LENGTH_LAST 6.727f /* the longest of them */

/* One product: the profile as its integral at evenly spaced knots, and the density there. */
struct font_filter_term {
    double weight; /* 1 or -1 */
    double *integral, *density;
};

/* How pictures are made: by the tables or by patches from nodes and lines, or from arcs. */
enum font_filter_way {
    FONT_BY_TABLES,
    FONT_BY_AREAS,
    FONT_BY_DISCS,
    FONT_BY_PATCHES /* nodes by patches, lines by tables */
};

/* A kind of filter: a row of the table in filter_profiles_by_name.c is all there is of it. */
struct font_filter_kind {
    const char *name;
    enum { FONT_TAKES_RADIUS, FONT_TAKES_SIGMA_RADIUS, FONT_TAKES_SAMPLES } takes;
    bool round; /* f along a radius is its profile; else h, and f is a product */
    double radius_px, sigma_px; /* its usual ones */
    /* At a distance from the centre within the radius. */
    double (*profile)(const struct font_filter *f, double v);
    /* Of round ones, where there are closed forms: the profile's integral along the chord at a
     * distance v from the centre, from its beginning at -half up to `to`; and over the disc of
     * radius 1. Else NULL and 0. */
    double (*chord)(const struct font_filter *f, double v, double half, double to);
    double volume;
    /* The fast way, of radii from the least to the most, or tables. */
    enum font_filter_way way;
    double way_least_px, way_most_px;
};
extern const struct font_filter_kind font_filter_kinds[];
extern const int font_filter_kinds_count;

/* What a filter is made of. */
struct font_filter_def {
    const struct font_filter_kind *kind;
    double radius_px; /* 0.25..4 */
    double sigma_px;  /* of a Gaussian */
    const double *samples;
    int samples_count; /* 2..256, the first in the centre, the last at the radius */
};
enum font_status font_filter_create(const struct font_filter_def *def,
                                    struct font_filter **out);

struct font_filter {
    char name[64];
    struct font_filter_def def;
    double *samples;
    double radius, scale; /* scale: what f is multiplied with for an integral of 1 */
    int taps;             /* in x; taps + 1 in y */
    int terms_count, knots;
    struct font_filter_term terms[FONT_TERMS_MAX];
    float *tables; /* for each term x, h, y; aligned to 64 bytes */
    bool round;
    /* Of an edge of unit dx: what m nodes on a length are wrong by at most, by its slant: |dy|
     * up to font_slants[s] of |dx|. */
    float node_error[FONT_SLANTS][FONT_LENGTHS][FONT_NODES_MAX]; /* [m - 1] */
    /* By slant; two more, for whole vectors. Of an edge as flat as its slant can be: how many
     * pieces with FONT_NODES_MAX nodes each; and how many evenly spaced nodes on a long one (0:
     * none). */
    float pieces_per_px[FONT_SLANTS + 2], even_per_px[FONT_SLANTS + 2];
    bool use_nodes; /* else steps, where it is drawn by tables */
    enum font_filter_way way;
    float piece_tolerance; /* of nodes: FONT_PIECE_TOLERANCE, or what patches allow */
    float *patches;        /* see gray_patch.h; NULL but for FONT_BY_PATCHES */
    float arc_span_px,
        arc_bend_px; /* how far an arc may go along x and y, and beside its chord */
    double step_px;
    struct font_filter_info info;
};

static inline const float *font_filter_x(const struct font_filter *f, int term)
{
    return f->tables + term * FONT_TERM_FLOATS;
}

static inline const float *font_filter_h(const struct font_filter *f, int term)
{
    return font_filter_x(f, term) + FONT_PHASES * 2 * FONT_X_ROW;
}

static inline const float *font_filter_y(const struct font_filter *f, int term)
{
    return font_filter_h(f, term) + FONT_PHASES * 2 * FONT_H_ROW;
}

/* filter_integrals.c: the profile, 0 beyond the radius. */
double font_filter_profile(const struct font_filter *f, double v);
/* A term's density and integral at v, in double precision. */
double font_term_density(const struct font_filter *f, int term, double v);
double font_term_integral(const struct font_filter *f, int term, double v);

/* filter_measure.c */
static const double font_slants[FONT_SLANTS] = {0.2, 0.5, 1,
                                                2,   5,   30}; /* the last: steeper ones too */
void font_filter_measure(struct font_filter *f);

/* filter_round.c: fills the terms of a round filter. */
enum font_status font_filter_decompose(struct font_filter *f);

/* Gauss-Legendre on 0..1: m nodes and their weights, m = 1..FONT_NODES_MAX. */
extern const double font_gauss_at[FONT_NODES_MAX + 1][FONT_NODES_MAX];
extern const double font_gauss_weight[FONT_NODES_MAX + 1][FONT_NODES_MAX];

/* Evenly spaced nodes on 0..1, in the middles of as many parts: weights of the first three and,
 * turned around, of the last, over the others'. The middles' rule is wrong by h^2 / 24 of the
 * slope at the ends, which is what three values say it is. */
enum { FONT_EVEN_LEAST = 6 };
extern const float font_even_weight[3];

/* What an edge may be wrong by for each of its pieces: a tenth of a 255th at nodes, half of
 * that in steps, of which there are more. */
#define FONT_PIECE_TOLERANCE 4e-4
#define FONT_STEP_TOLERANCE 2e-4
#define FONT_PATCH_TOLERANCE 2e-4

/* Patches are for FONT_PATCH_PHASES places of a node between two pixels each way, and the end;
 * a patch is four rows of four values. */
enum {
    FONT_PATCH_PHASES = 16,
    FONT_PATCH_TAPS = 3,
    FONT_PATCH_ROW = 4,
    FONT_PATCH_FLOATS = (FONT_PATCH_TAPS + 1) * FONT_PATCH_ROW
};

/* filter_choose.c: the brightness of a display's spot at a distance along one axis. */
double font_display_spot(enum font_display display, double v);

/* filter_patch.c: errors: NO_MEMORY. */
enum font_status font_patches_make(struct font_filter *f);

#endif
