/* edges_kernel.h - outlines to nodes through an affine map, included by edges_plain.c,
 * edges_avx2.c and edges_avx512.c with
 *     LANES    floats in a vector
 *     KERNEL   the function's name
 *
 * Segments are polynomials, x0 + t (c + t (b + t a)), kept as eight arrays. A group of them is
 * gone through three times, without branches that depend on what they are: a processor would
 * guess those wrong half of the time.
 *
 *     measure    LANES at once: mapped; how long, how far across, how flat. Vertical ones are
 *                left out, horizontal lines are their ends
 *     plan       LANES at once: as many of Gauss's nodes as its row of the filter's table of
 *                errors says; a long one takes them on several pieces, or evenly spaced ones
 *                where those are fewer
 *     put        eight nodes of a segment at once */
#include "edges_internal.h"
#include "lanes.h"
#include "outline.h"

#include <string.h>

/* Nodes are put eight at a time: in one or two vectors. */
enum { WIDE = LANES < 8 ? LANES : 8 };
#if LANES > 8
typedef float wide __attribute__((vector_size(32)));
typedef float wide_loose __attribute__((vector_size(32), aligned(4), may_alias));
#else
typedef vector wide;
typedef vector_loose wide_loose;
#endif

INLINE wide wide_min(wide a, wide b)
{
#if LANES > 8
    return (wide)_mm256_min_ps((__m256)a, (__m256)b);
#else
    return vector_min(a, b);
#endif
}

INLINE wide wide_max(wide a, wide b)
{
#if LANES > 8
    return (wide)_mm256_max_ps((__m256)a, (__m256)b);
#else
    return vector_max(a, b);
#endif
}

enum { GROUP = 64 };

struct group {
    float x[GROUP], cx[GROUP], bx[GROUP], ax[GROUP];
    float y[GROUP], cy[GROUP], by[GROUP], ay[GROUP];
    float bx_twice[GROUP], ax_thrice[GROUP]; /* of the speed along x */
    float across[GROUP], square[GROUP];      /* square: of the length */
    float spacings_square[GROUP];            /* of the length in spacings of even nodes */
    int row[GROUP];                          /* of the table of errors */
    float allowed[GROUP];                    /* an error that is larger is too large */
    int large[GROUP];                        /* how many of the row are */
    float least[GROUP];                      /* nodes that it takes anyway */
    int pieces[GROUP];
    /* The plan. A turn puts up to eight nodes: those of a piece, or the next of evenly spaced
     * ones. */
    int turns[GROUP];
    float part[GROUP],
        step[GROUP]; /* t is a rule's place times part, and the turn times step */
    float weight[GROUP];
    int rule[2][GROUP]; /* of the first turn, of the others: where it begins in the tables */
    int most[GROUP], left[GROUP]; /* nodes in a turn; of evenly spaced ones in all, else many */
    uint64_t nodes;               /* a bit for each that has some */
};

/* Nodes and the ends of lines are put there; with the least and the most of both, by lanes. */
struct target {
    float *x, *y, *weight;
    int count;
    wide x0, x1, y0, y1;
    vector left, right, top, bottom;
};

INLINE void put(float *to, vector v)
{
    *(vector_loose *)to = v;
}

INLINE void put_ints(int *to, ints v)
{
    *(ints_loose *)to = v;
}

INLINE ints load_ints(const int *at)
{
    return *(const ints_loose *)at;
}

/* ---- measure ---- */

/* Where rows of the table of errors begin for a length, by its fourth power in quarters of a
 * pixel. */
INLINE ints row_of(vector fourth_power)
{
    const vector none = {0};
    vector limited = vector_min(vector_max(fourth_power, none + 0.5f),
                                none + (float)(1 << (FONT_LENGTHS - 2)));
    return (((ints)limited >> 23) - 126) * FONT_NODES_MAX;
}

INLINE void lines_put(struct font_edges *e, struct target *to, choice lines, float side,
                      vector x, vector x_end, vector y)
{
    const vector far = (vector){0} + INFINITY;
    int i = e->lines_count;
    store_chosen((side > 0 ? e->line_x0 : e->line_x1) + i, lines, x);
    store_chosen((side > 0 ? e->line_x1 : e->line_x0) + i, lines, x_end);
    store_chosen(e->line_y + i, lines, y);
    to->left = vector_min(to->left, chosen(lines, vector_min(x, x_end), far));
    to->right = vector_max(to->right, chosen(lines, vector_max(x, x_end), -far));
    to->top = vector_min(to->top, chosen(lines, y, far));
    to->bottom = vector_max(to->bottom, chosen(lines, y, -far));
    e->lines_count = i + bits_count(choice_bits(lines));
}

/* Pieces so long that FONT_NODES_MAX nodes suffice for each. */
INLINE void measure_longer(struct group *q, int at, const struct font_filter *f, vector square,
                           vector pieces_per_px, ints slants, vector across)
{
    vector length = vector_root(square);
    ints pieces = __builtin_convertvector(length * pieces_per_px, ints) + 1;
    vector count = __builtin_convertvector(pieces, vector), quarters = length * 4 / count;
    quarters *= quarters;
    put_ints(q->pieces + at, pieces);
    put_ints(q->row + at, slants + row_of(quarters * quarters));
    /* The pieces' errors add up where they lie above each other, but not all with one sign. */
    put(q->allowed + at, vector_root(count) * f->piece_tolerance / across);
}

INLINE void errors_count(struct group *q, int at, const struct font_filter *f)
{
    for (int k = at; k < at + LANES; k++) {
        const float *row = &f->node_error[0][0][0] + q->row[k];
#if LANES > 4
        __m256 allowed = _mm256_set1_ps(q->allowed[k]);
        int large =
            _mm256_movemask_ps(_mm256_cmp_ps(allowed, _mm256_loadu_ps(row), _CMP_LT_OQ));
        q->large[k] = bits_count((unsigned)large);
#else
        vector allowed = (vector){0} + q->allowed[k];
        unsigned large = choice_bits(less(allowed, load(row)));
        q->large[k] = bits_count(large | choice_bits(less(allowed, load(row + 4))) << 4);
#endif
    }
}

/* LANES segments, and how fast each is along x and y, without a sign: at its beginning,
 * between, and at its end. */
struct mapped {
    vector x, cx, bx, ax, y, cy, by, ay;
    vector dx[3], dy[3];
    vector chord_x, chord_y; /* from end to end */
    vector square;           /* of the largest speed: no segment is longer */
};

INLINE struct mapped map(const struct font_edges_job *job, int first)
{
    const float *p = job->outline->polynomials + first, *m = job->m;
    int stride = job->outline->polynomials_stride;
    vector x = load(p), y = load(p + stride);
    vector cx = load(p + 2 * stride), cy = load(p + 3 * stride);
    vector bx = load(p + 4 * stride), by = load(p + 5 * stride);
    vector ax = load(p + 6 * stride), ay = load(p + 7 * stride);
    struct mapped s = {.x = x * m[0] + y * m[1] + m[2], .y = x * m[3] + y * m[4] + m[5]};
    s.cx = cx * m[0] + cy * m[1];
    s.cy = cx * m[3] + cy * m[4];
    s.bx = bx * m[0] + by * m[1];
    s.by = bx * m[3] + by * m[4];
    s.ax = ax * m[0] + ay * m[1];
    s.ay = ax * m[3] + ay * m[4];
    vector sx = s.cx + s.bx, sy = s.cy + s.by;
    vector ex = sx + s.bx + s.ax * 3, ey = sy + s.by + s.ay * 3;
    s.dx[0] = vector_absolute(s.cx);
    s.dy[0] = vector_absolute(s.cy);
    s.dx[1] = vector_absolute(sx);
    s.dy[1] = vector_absolute(sy);
    s.dx[2] = vector_absolute(ex);
    s.dy[2] = vector_absolute(ey);
    s.chord_x = sx + s.ax;
    s.chord_y = sy + s.ay;
    s.square =
        vector_max(vector_max(s.cx * s.cx + s.cy * s.cy, sx * sx + sy * sy), ex * ex + ey * ey);
    return s;
}

/* Of a line; of a curve that bends where it is flattest, else on the whole. */
INLINE ints slant_of(const struct mapped *s, choice bends)
{
    const vector tiny = (vector){0} + 1e-9f;
    vector dx = s->dx[0] + tiny, dx1 = s->dx[1] + tiny, dx2 = s->dx[2] + tiny, dy = s->dy[0];
    choice flatter = less(s->dy[1] * dx, dy * dx1);
    dx = chosen(flatter, dx1, dx);
    dy = chosen(flatter, s->dy[1], dy);
    flatter = less(s->dy[2] * dx, dy * dx2);
    dx = chosen(bends, chosen(flatter, dx2, dx), s->dx[0] + s->dx[1] + s->dx[2]);
    dy = chosen(bends, chosen(flatter, s->dy[2], dy), s->dy[0] + s->dy[1] + s->dy[2]);
    ints slant = {0};
    for (int k = 0; k < FONT_SLANTS - 1; k++)
        slant = raised(slant, less(dx * (float)font_slants[k], dy), 1);
    return slant;
}

/* Curves of the group from `at` on, or the chords of motes. */
INLINE void curves_put(struct group *q, int at, const struct mapped *s, choice mote)
{
    const vector none = {0};
    vector bx = chosen(mote, none, s->bx), ax = chosen(mote, none, s->ax);
    put(q->x + at, s->x);
    put(q->y + at, s->y);
    put(q->cx + at, chosen(mote, s->chord_x, s->cx));
    put(q->cy + at, chosen(mote, s->chord_y, s->cy));
    put(q->bx + at, bx);
    put(q->by + at, chosen(mote, none, s->by));
    put(q->ax + at, ax);
    put(q->ay + at, chosen(mote, none, s->ay));
    put(q->bx_twice + at, bx * 2);
    put(q->ax_thrice + at, ax * 3);
}

/* The segments from `first` on, which are the group's from `at` on; lines are put. */
INLINE void measure(struct group *q, int at, const struct font_edges_job *job, int first,
                    struct target *to)
{
    const struct font_filter *f = job->filter;
    const vector none = {0};
    const struct mapped s = map(job, first);
    vector across = (s.dx[0] + s.dx[1] + s.dx[2]) * (1 / 3.0f);
    vector down = (s.dy[0] + s.dy[1] + s.dy[2]) * (1 / 3.0f);
    vector bend = s.bx * s.bx + s.by * s.by;
    choice cubic = less(none, s.ax * s.ax + s.ay * s.ay), curved = cubic | less(none, bend);
    choice bends = cubic | less(none + 9, s.square); /* short quadratics bend little */
    choice some = less(none, across);
    choice lines = but_not(but_not(some, curved), less(none + FONT_FLAT_PX, down));
    choice nodes = but_not(some, lines);
    q->nodes |= (uint64_t)choice_bits(nodes) << at;

    ints slant = slant_of(&s, bends), slants = slant * (FONT_LENGTHS * FONT_NODES_MAX);
    vector even_per_px = of_table(f->even_per_px, slant);
    vector pieces_per_px = of_table(f->pieces_per_px, slant);
    put_ints(q->row + at, slants + row_of(s.square * s.square * 256));
    put_ints(q->pieces + at, (ints){0} + 1);
    put(q->allowed + at, f->piece_tolerance / across);
    put(q->across + at, across);
    put(q->square + at, s.square);
    /* Short curves take none that are evenly spaced. */
    vector spacings_square = s.square * (even_per_px * even_per_px);
    put(q->spacings_square + at, chosen(but_not(curved, bends), none, spacings_square));
    choice longer = nodes & less(none + 1, s.square * (pieces_per_px * pieces_per_px));
    if (choice_bits(longer))
        measure_longer(q, at, f, s.square, pieces_per_px, slants, across);
    errors_count(q, at, f);
    lines_put(job->edges, to, lines, job->side, s.x, s.x + s.cx, s.y + s.cy * 0.5f);

    /* So many nodes that the area under the curve is exact, one more where a quadratic turns
     * around; specks can do with less. Of motes one node's weight must be all of the dx, which
     * a cubic's speed at its middle is not. */
    choice mote = less(s.square, none + FONT_MOTE_PX * FONT_MOTE_PX);
    choice speck = less(s.square, none + FONT_SPECK_PX * FONT_SPECK_PX);
    choice two = but_not(curved, mote);
    choice three = but_not(cubic, speck) | but_not(less(none + FONT_BEND_PX2, bend), cubic);
    put(q->least + at, chosen(two, chosen(three, none + 3, none + 2), none + 1));
    curves_put(q, at, &s, mote);
}

/* ---- plan ---- */

/* Those for which no row of the table suffices (next to none) are cut into more pieces. */
static void segments_cut(struct group *q, const struct font_filter *f, int at, unsigned which)
{
    for (; which; which &= which - 1) {
        int k = at + __builtin_ctz(which);
        int slant = q->row[k] / (FONT_LENGTHS * FONT_NODES_MAX);
        q->large[k] =
            font_nodes_needed(f, sqrtf(q->square[k]), q->across[k], slant, &q->pieces[k]) - 1;
    }
}

INLINE void plan(struct group *q, int at, const struct font_filter *f, float side)
{
    const vector none = {0}, many = none + 1e9f, later = none + FONT_RULE_EVEN_LATER;
    const vector least_even = none + FONT_EVEN_LEAST * FONT_EVEN_LEAST;
    vector large = __builtin_convertvector(load_ints(q->large + at), vector);
    vector pieces = __builtin_convertvector(load_ints(q->pieces + at), vector);
    vector m = vector_max(large + 1, load(q->least + at));
    vector square = load(q->spacings_square + at);
    choice even = less(least_even, square) & less(square, m * pieces * (m * pieces));
    choice cut = but_not(less(none + FONT_NODES_MAX, m), even);
    if (choice_bits(cut)) {
        segments_cut(q, f, at, choice_bits(cut) & (unsigned)(q->nodes >> at));
        large = __builtin_convertvector(load_ints(q->large + at), vector);
        pieces = __builtin_convertvector(load_ints(q->pieces + at), vector);
        m = vector_max(large + 1, load(q->least + at));
    }
    ints spaced = __builtin_convertvector(vector_root(square), ints) + 1;
    vector count = __builtin_convertvector(spaced, vector);
    vector part = (none + 1) / chosen(even, count, pieces);
    put(q->part + at, part);
    put(q->step + at, chosen(even, part * 8, part));
    put(q->weight + at, part * side);
#define PUT_WHOLE(member, v) put_ints(q->member + at, __builtin_convertvector(v, ints))
    PUT_WHOLE(turns, chosen(even, (count + 7) * 0.125f, pieces));
    PUT_WHOLE(most, chosen(even, none + 8, m));
    PUT_WHOLE(left, chosen(even, count, many));
    PUT_WHOLE(rule[0], chosen(even, none, m * 8));
    PUT_WHOLE(rule[1], chosen(even, later * 8, m * 8));
#undef PUT_WHOLE
}

/* ---- put ---- */

/* A number in all lanes. Not by adding 0, which would be done: it makes 0 of -0. */
#define WIDE_OF(number) ((number) - (wide){0})

INLINE wide wide_load(const float *at)
{
    return *(const wide_loose *)at;
}

/* Copies of a segment's numbers: those in memory are read again after each store, as far as a
 * compiler knows. What is beyond a turn's nodes is at the beginning of their piece, or at t =
 * 1. */
INLINE void segment_put(struct target *to, const struct group *q, int k)
{
    const wide x0 = WIDE_OF(q->x[k]), y0 = WIDE_OF(q->y[k]);
    const wide cx = WIDE_OF(q->cx[k]), bx = WIDE_OF(q->bx[k]), ax = WIDE_OF(q->ax[k]);
    const wide cy = WIDE_OF(q->cy[k]), by = WIDE_OF(q->by[k]), ay = WIDE_OF(q->ay[k]);
    const wide bx_twice = WIDE_OF(q->bx_twice[k]), ax_thrice = WIDE_OF(q->ax_thrice[k]);
    const wide part = WIDE_OF(q->part[k]), step = WIDE_OF(q->step[k]);
    const wide weight = WIDE_OF(q->weight[k]);
    const float *places = font_rule_places + q->rule[0][k];
    const float *weights = font_rule_weights + q->rule[0][k];
    /* Counted: steps that are added up would add up what they are rounded by. */
    wide turn = WIDE_OF(0.0f);
    int left = q->left[k], most = q->most[k];
    for (int turns = q->turns[k];;) {
        const float *ends = font_even_ends + 11 - (left < 11 ? left : 11);
        for (int p = 0; p < 8; p += WIDE) {
            wide t = wide_min(wide_load(places + p) * part + turn * step, WIDE_OF(1.0f));
            wide x = x0 + t * (cx + t * (bx + t * ax)), y = y0 + t * (cy + t * (by + t * ay));
            wide speed = cx + t * (bx_twice + t * ax_thrice);
            *(wide_loose *)(to->x + to->count + p) = x;
            *(wide_loose *)(to->y + to->count + p) = y;
            *(wide_loose *)(to->weight + to->count + p) =
                speed * (wide_load(weights + p) * weight * wide_load(ends + p));
            to->x0 = wide_min(x, to->x0);
            to->x1 = wide_max(x, to->x1);
            to->y0 = wide_min(y, to->y0);
            to->y1 = wide_max(y, to->y1);
        }
        to->count += left < most ? left : most;
        if (--turns == 0)
            break;
        left -= 8;
        turn += 1;
        weights = font_rule_weights + q->rule[1][k];
    }
}

static enum font_status target_grow(struct font_edges *e, struct target *to, int more)
{
    e->nodes_count = to->count;
    enum font_status status = font_nodes_reserve(e, more);
    to->x = e->node_x;
    to->y = e->node_y;
    to->weight = e->node_weight;
    return status;
}

INLINE enum font_status group_put(struct font_edges *e, struct target *to,
                                  const struct group *q)
{
    for (uint64_t set = q->nodes; set; set &= set - 1) {
        int k = __builtin_ctzll(set);
        if (to->count + 8 * q->turns[k] > e->nodes_capacity) {
            enum font_status status = target_grow(e, to, 8 * q->turns[k]);
            if (status != FONT_OK)
                return status;
        }
        segment_put(to, q, k);
    }
    return FONT_OK;
}

/* ---- all of them ---- */

/* The least of all lanes. */
INLINE float least_of(vector lanes, wide v)
{
#if LANES == 16
    v = wide_min(v, __builtin_shufflevector(lanes, lanes, 0, 1, 2, 3, 4, 5, 6, 7));
    v = wide_min(v, __builtin_shufflevector(lanes, lanes, 8, 9, 10, 11, 12, 13, 14, 15));
#else
    v = wide_min(v, lanes);
#endif
#if LANES > 4
    v = wide_min(v, __builtin_shufflevector(v, v, 4, 5, 6, 7, 0, 1, 2, 3));
    v = wide_min(v, __builtin_shufflevector(v, v, 2, 3, 0, 1, 6, 7, 4, 5));
    v = wide_min(v, __builtin_shufflevector(v, v, 1, 0, 3, 2, 5, 4, 7, 6));
#else
    v = wide_min(v, __builtin_shufflevector(v, v, 2, 3, 0, 1));
    v = wide_min(v, __builtin_shufflevector(v, v, 1, 0, 3, 2));
#endif
    return v[0];
}

INLINE void bounds_put(struct font_edges *e, const struct target *to)
{
    e->x0 = least_of(to->left, to->x0);
    e->y0 = least_of(to->top, to->y0);
    e->x1 = -least_of(-to->right, -to->x1);
    e->y1 = -least_of(-to->bottom, -to->y1);
}

enum font_status KERNEL(const struct font_edges_job *job)
{
    struct font_edges *e = job->edges;
    const wide far = WIDE_OF(INFINITY);
    const vector far_lanes = (vector){0} + INFINITY;
    struct group q __attribute__((aligned(64)));
    struct target to = {e->node_x, e->node_y, e->node_weight, 0,         far,       -far, far,
                        -far,      far_lanes, -far_lanes,     far_lanes, -far_lanes};
    for (int first = 0; first < job->outline->segments_count; first += GROUP) {
        int count = job->outline->segments_count - first;
        count = count < GROUP ? count : GROUP;
        enum font_status status = FONT_OK;
        if (e->lines_count + GROUP > e->lines_capacity)
            status = font_lines_reserve(e, GROUP);
        if (status != FONT_OK)
            return status;
        q.nodes = 0;
        for (int at = 0; at < count; at += LANES)
            measure(&q, at, job, first + at, &to);
        for (int at = 0; at < count; at += LANES)
            plan(&q, at, job->filter, job->side);
        status = group_put(e, &to, &q);
        if (status != FONT_OK)
            return status;
    }
    e->nodes_count = to.count;
    bounds_put(e, &to);
    return FONT_OK;
}
