/* openmp_rolling.c - rolling rows in C, with the compiler's vector types; see rolling.h.
 *
 * One function is one row of one step, for all columns of a strip; it is inlined for the
 * first row of a walk, an inner one, and the one at the edge.
 */
#include "rolling.h"

#include <stdlib.h>
#include <string.h>
#ifdef __AVX512F__
#include <immintrin.h>
#endif

#include "harness.h"

typedef float vector __attribute__((vector_size(64), may_alias));
typedef float vector_anywhere __attribute__((vector_size(64), aligned(4), may_alias));

#define INLINE static inline __attribute__((always_inline))
#define LANES ROLLING_LANES
#define LOAD(at) (*(const vector *)(at))
#define LOAD_ANY(at) (*(const vector_anywhere *)(at))
#define STORE(at, v) (*(vector *)(at) = (v))

struct diffusion_openmp_rolling {
    struct diffusion_scene scene; /* its arrays are not ours */
    struct rolling_layout layout;
    struct rolling_tiling tiling;
    float *memory; /* the planes */
    int now;       /* the copy that holds the sheet: plane 0 or 4 */
};

/* ---- vectors ---- */

INLINE vector all_lanes(float x)
{
    return (vector){x, x, x, x, x, x, x, x, x, x, x, x, x, x, x, x};
}

#ifdef __AVX512F__
#define STORE_PAST(at, v) _mm512_stream_ps(at, (__m512)(v))

INLINE vector least(vector a, vector b)
{
    return (vector)_mm512_min_ps((__m512)a, (__m512)b);
}

INLINE vector greatest(vector a, vector b)
{
    return (vector)_mm512_max_ps((__m512)a, (__m512)b);
}

/* Lanes 1..15 of a, then lane 0 of b: the vector one fiber further on. */
INLINE vector further(vector a, vector b)
{
    return (vector)_mm512_alignr_epi32((__m512i)b, (__m512i)a, 1);
}

INLINE void stores_settle(void)
{
    _mm_sfence();
}
#else
#define STORE_PAST STORE

INLINE vector least(vector a, vector b)
{
    for (int i = 0; i < ROLLING_LANES; i++)
        a[i] = a[i] < b[i] ? a[i] : b[i];
    return a;
}

INLINE vector greatest(vector a, vector b)
{
    for (int i = 0; i < ROLLING_LANES; i++)
        a[i] = a[i] > b[i] ? a[i] : b[i];
    return a;
}

INLINE vector further(vector a, vector b)
{
    return (vector){a[1], a[2],  a[3],  a[4],  a[5],  a[6],  a[7],  a[8],
                    a[9], a[10], a[11], a[12], a[13], a[14], a[15], b[0]};
}

INLINE void stores_settle(void)
{
}
#endif

/* ---- one row ---- */

struct constants {
    vector gravity, weight[3];
    bool rises; /* gravity is 1 or more */
};

struct rows { /* of the four fields: that of field i begins at first + i * apart */
    float *first;
    size_t apart;
};

INLINE vector flow_in(vector lower, vector here, vector absorbency, vector water, int i,
                      struct constants c)
{
    vector t = (lower - here) * absorbency;
    if (i)
        t = t * water * c.weight[i - 1];
    vector along = t * c.gravity, against = t / c.gravity;
    return c.rises ? greatest(along, against) : least(along, against);
}

INLINE vector moved(vector amount, vector in, vector out)
{
    vector t = amount + in;
    t = t - out;
    return greatest(least(t, all_lanes(1.0f)), all_lanes(0.0f));
}

#define __global
#include "kernels/diffusion_row.cl"

/* row() with all its invariants known at compile time. */
static void row_of_kind(enum row_kind kind, bool past, struct rows old,
                        const float *upper_absorbency, const float *absorbency,
                        struct rows along, struct rows flow, struct rows out, int x0, int x1,
                        const struct constants *c, vector carry[4])
{
    struct constants rising = *c, falling = *c;
    rising.rises = true;
    falling.rises = false;
#define ROW(kind, past, known)                                                                 \
    row(kind, past, old, upper_absorbency, absorbency, along, flow, out, x0, x1, known, carry)
    if (!c->rises && kind == ROW_FIRST)
        ROW(ROW_FIRST, false, falling);
    else if (!c->rises && kind == ROW_EDGE)
        ROW(ROW_EDGE, false, falling);
    else if (!c->rises)
        ROW(ROW_INNER, false, falling);
    else if (kind == ROW_FIRST)
        ROW(ROW_FIRST, false, rising);
    else if (kind == ROW_EDGE)
        ROW(ROW_EDGE, false, rising);
    else if (past)
        ROW(ROW_INNER, true, rising);
    else
        ROW(ROW_INNER, false, rising);
#undef ROW
}

/* ---- one tile ---- */

struct tile {
    int left, xa, xb, right; /* columns with their rims: left..right - 1 */
    int ya, yb;
};

static struct tile tile_of(const struct diffusion_openmp_rolling *o,
                           const struct rolling_tiling *t, int index)
{
    int strip = index % t->strips_count, band = index / t->strips_count,
        vectors = o->layout.columns / ROLLING_LANES;
    struct tile m = {
        .xa = vectors * strip / t->strips_count * ROLLING_LANES,
        .xb = vectors * (strip + 1) / t->strips_count * ROLLING_LANES,
        .ya = (int)((long)o->layout.height * band / t->bands_count),
        .yb = (int)((long)o->layout.height * (band + 1) / t->bands_count),
    };
    m.left = m.xa ? m.xa - ROLLING_LANES : 0;
    m.right =
        m.xb + ROLLING_LANES < o->layout.columns ? m.xb + ROLLING_LANES : o->layout.columns;
    return m;
}

/* Row y of one step of a tile; k: where row y - 1 is in a plane. rows: the twelve that the step
 * keeps. */
static void tile_row(const struct diffusion_openmp_rolling *o, const struct tile *m,
                     const struct constants *c, float *rows, size_t row_floats, bool handed,
                     bool first, bool to_sheet, int y)
{
    const struct rolling_layout *l = &o->layout;
    ptrdiff_t k = (ptrdiff_t)l->origin + (y - 1) * (ptrdiff_t)l->pitch;
    const float *a = o->memory + (size_t)l->absorbency * l->plane + k, *b = a + l->pitch;
    struct rows old = {o->memory + (size_t)o->now * l->plane + k, l->plane};
    struct rows along = {rows, row_floats}, flow = {rows + 4 * row_floats, row_floats},
                out = {rows + 8 * row_floats, row_floats};
    vector carry[4] = {{0}};
    enum row_kind kind = first ? ROW_FIRST : y == 0 ? ROW_EDGE : ROW_INNER;
    if (handed && y > 0) { /* by the step before, whose rows lie before ours */
        struct rows theirs = {rows - 4 * row_floats, row_floats};
        for (size_t i = 0; i < DIFFUSION_FIELDS_COUNT;
             i++) /* the column that does not change */
            theirs.first[i * theirs.apart + (size_t)m->left - 1] =
                old.first[(ptrdiff_t)(i * old.apart) + m->left - 1];
        old = theirs;
    }
    if (!to_sheet) {
        row_of_kind(kind, false, old, a, b, along, flow, out, m->left, m->right, c, carry);
        return;
    }
    row_of_kind(kind, false, old, a, b, along, flow, out, m->xb, m->right, c, carry);
    out = (struct rows){o->memory + (size_t)(DIFFUSION_FIELDS_COUNT - o->now) * l->plane + k +
                            l->pitch,
                        l->plane};
    row_of_kind(kind, true, old, a, b, along, flow, out, m->xa, m->xb, c, carry);
}

static void tile_steps(const struct diffusion_openmp_rolling *o, const struct rolling_tiling *t,
                       int index, float *scratch)
{
    const struct diffusion_scene *s = &o->scene;
    const struct constants c = {all_lanes(s->gravity),
                                {all_lanes(s->molecular_weight[0]),
                                 all_lanes(s->molecular_weight[1]),
                                 all_lanes(s->molecular_weight[2])},
                                s->gravity >= 1.0f};
    const struct tile m = tile_of(o, t, index);
    const int steps = t->steps_count;
    size_t row_floats = rolling_row_floats(&o->layout, t);
    memset(scratch, 0, rolling_tile_floats(&o->layout, t) * sizeof *scratch);
    float *own = scratch + ROLLING_LANES - m.left;
    /* Step n has row yb + steps - turn + n in hand. */
    for (int turn = -1; turn <= m.yb - m.ya + 2 * steps - 1; turn++)
        for (int n = 0; n < steps; n++) {
            int y = m.yb + steps - turn + n, last = m.yb + steps - n,
                first = m.ya - (steps - 1 - n);
            if (last > o->layout.height - 1)
                last = o->layout.height - 1;
            if (y > last + 1 || y < first || y < 0)
                continue;
            tile_row(o, &m, &c, own + (size_t)n * ROLLING_ROWS_COUNT * row_floats, row_floats,
                     n > 0, y > last, n == steps - 1 && y < m.yb, y);
        }
}

/* From the copy at hand to the other. */
static bool pass(void *context, const struct rolling_tiling *t)
{
    const struct diffusion_openmp_rolling *o = context;
    int tiles_count = t->strips_count * t->bands_count;
    bool ok = true;
#pragma omp parallel
    {
        float *scratch =
            aligned_alloc(4096, rolling_tile_floats(&o->layout, t) * sizeof *scratch);
        if (!scratch)
#pragma omp atomic write
            ok = false;
#pragma omp for schedule(dynamic, 1)
        for (int i = 0; i < tiles_count; i++)
            if (scratch)
                tile_steps(o, t, i, scratch);
        stores_settle();
        free(scratch);
    }
    return ok || bench_fail("no memory for the rows of a tile");
}

/* ---- what is offered ---- */

struct diffusion_openmp_rolling *
diffusion_openmp_rolling_create(const struct diffusion_scene *s,
                                const struct rolling_tiling *tiling)
{
    struct diffusion_openmp_rolling *o = calloc(1, sizeof *o);
    if (!o) {
        bench_fail("no memory");
        return NULL;
    }
    o->scene = *s;
    bool ok = rolling_layout_init(&o->layout, s, 2);
    if (ok) {
        size_t bytes = (o->layout.count * sizeof(float) + 4095) / 4096 * 4096;
        o->memory = aligned_alloc(4096, bytes);
        ok = o->memory || bench_fail("no memory for a sheet of %dx%d", s->width, s->height);
    }
    if (ok)
        rolling_fill(&o->layout, s, o->memory);
    if (ok && tiling) {
        o->tiling = *tiling;
        rolling_tiling_clamp(&o->tiling, &o->layout);
    } else if (ok) {
        ok = rolling_tune(&o->layout, bench_threads_count(), pass, o, &o->tiling);
    }
    if (ok)
        return o;
    diffusion_openmp_rolling_destroy(o);
    return NULL;
}

void diffusion_openmp_rolling_destroy(struct diffusion_openmp_rolling *o)
{
    if (o)
        free(o->memory);
    free(o);
}

bool diffusion_openmp_rolling_steps(struct diffusion_openmp_rolling *o, int steps_count)
{
    for (int left = steps_count; left > 0;) {
        struct rolling_tiling t = o->tiling;
        if (t.steps_count > left)
            t.steps_count = left;
        if (!pass(o, &t))
            return false;
        o->now = DIFFUSION_FIELDS_COUNT - o->now;
        left -= t.steps_count;
    }
    return true;
}

void diffusion_openmp_rolling_read(const struct diffusion_openmp_rolling *o, int field,
                                   float *out)
{
    rolling_read(&o->layout, &o->scene, field,
                 o->memory + (size_t)(o->now + field) * o->layout.plane, out);
}

const struct rolling_tiling *
diffusion_openmp_rolling_tiling(const struct diffusion_openmp_rolling *o)
{
    return &o->tiling;
}
