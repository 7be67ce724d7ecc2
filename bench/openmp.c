/* openmp.c - the step in plain C: for each row and axis a loop of flows and a loop that moves
 * them, in place.
 *
 * Along x rows are independent, so threads share the rows. A flow from the left needs the
 * neighbour's old value, so all flows of a row are computed before any is applied. Along y
 * threads share the columns: a strip is processed from its last row to its first. The flows of
 * the row below are kept in a buffer, and the row above still has its old values when it is
 * read.
 *
 *         rows  -+--------+      flow[0..3](x+1) or below[0..3](x)
 *                | in(x) >|> out(x) = in(x+1)
 *                +--------+
 * Rows have a margin of 16 floats at both ends, which holds the other end's fibers: the sheet
 * wraps.
 */
#include "scene.h"

#include <stdlib.h>
#include <string.h>

#include "harness.h"

enum { MARGIN = 16, STRIP = 512, PLANE_SKEW = 7 * 16 };

struct diffusion_openmp {
    struct diffusion_scene scene; /* its arrays are not ours */
    size_t pitch;                 /* floats from row to row */
    float *memory;
    float *absorbency, *field[DIFFUSION_FIELDS_COUNT]; /* fiber (0, 0) */
};

struct diffusion_openmp *diffusion_openmp_create(const struct diffusion_scene *s)
{
    struct diffusion_openmp *o = calloc(1, sizeof *o);
    if (!o) {
        bench_fail("no memory");
        return NULL;
    }
    o->scene = *s;
    o->pitch = ((size_t)s->width + 2 * MARGIN + 15) / 16 * 16;
    if (o->pitch % 1024 == 0)
        o->pitch += 16;
    /* Planes that begin at the same offset from a page would compete for the same cache
     * sets. */
    size_t plane = (o->pitch * (size_t)s->height + 1023) / 1024 * 1024 + PLANE_SKEW;
    o->memory = aligned_alloc(
        4096, (plane * (DIFFUSION_FIELDS_COUNT + 1) * sizeof(float) + 4095) / 4096 * 4096);
    if (!o->memory) {
        bench_fail("no memory for a sheet of %dx%d", s->width, s->height);
        free(o);
        return NULL;
    }
    o->absorbency = o->memory + MARGIN;
    for (int i = 0; i < DIFFUSION_FIELDS_COUNT; i++)
        o->field[i] = o->absorbency + plane * (size_t)(i + 1);
#pragma omp parallel for schedule(static)
    for (int y = 0; y < s->height; y++) {
        size_t bytes = (size_t)s->width * sizeof(float), row = (size_t)y * o->pitch;
        memcpy(o->absorbency + row, s->absorbency + (size_t)y * (size_t)s->width, bytes);
        for (int i = 0; i < DIFFUSION_FIELDS_COUNT; i++)
            memcpy(o->field[i] + row, s->field[i] + (size_t)y * (size_t)s->width, bytes);
    }
    return o;
}

void diffusion_openmp_destroy(struct diffusion_openmp *o)
{
    if (o)
        free(o->memory);
    free(o);
}

void diffusion_openmp_read(const struct diffusion_openmp *o, int field, float *out)
{
    for (int y = 0; y < o->scene.height; y++)
        memcpy(out + (size_t)y * (size_t)o->scene.width, o->field[field] + (size_t)y * o->pitch,
               (size_t)o->scene.width * sizeof(float));
}

/* Computes both and selects one, since vectors cannot branch. gravity > 0, so the product
 * keeps the sign. */
static inline float gravitate(float flow, float gravity)
{
    float along = flow * gravity, against = flow / gravity;
    return flow > 0.0f ? along : against;
}

static inline float moved(float amount, float in, float out)
{
    float t = amount + in;
    t = t - out;
    t = t < 1.0f ? t : 1.0f;
    return t > 0.0f ? t : 0.0f;
}

/* What flows into fibers x0..x1-1 of a row from those step before, and the new water, which
 * the pigments' flows need. below: the water's flow out of each; NULL: out of each flows what
 * flows into the next of the row, and that is computed again. */
static inline __attribute__((always_inline)) void
flows(const struct diffusion_scene *s, const float *a, const float *const field[],
      ptrdiff_t step, const float *below, int x0, int x1, float *const in[], float *wet)
{
    const float *w = field[0], *p0 = field[1], *p1 = field[2], *p2 = field[3];
    float *in0 = in[0], *in1 = in[1], *in2 = in[2], *in3 = in[3];
    const float g = s->gravity, m0 = s->molecular_weight[0], m1 = s->molecular_weight[1],
                m2 = s->molecular_weight[2];
#pragma omp simd
    for (int x = x0; x < x1; x++) {
        float flow = gravitate((w[x - step] - w[x]) * a[x], g);
        float out = below ? below[x] : gravitate((w[x] - w[x + 1]) * a[x + 1], g);
        float water = moved(w[x], flow, out);
        in0[x] = flow;
        wet[x] = water;
        in1[x] = gravitate((p0[x - step] - p0[x]) * a[x] * water * m0, g);
        in2[x] = gravitate((p1[x - step] - p1[x]) * a[x] * water * m1, g);
        in3[x] = gravitate((p2[x - step] - p2[x]) * a[x] * water * m2, g);
    }
}

static void move(float *restrict field, const float *restrict in, const float *restrict out,
                 int x0, int x1)
{
#pragma omp simd
    for (int x = x0; x < x1; x++)
        field[x] = moved(field[x], in[x], out[x]);
}

static void dry(float *water, const float *wet, float humidity, int x0, int x1)
{
#pragma omp simd
    for (int x = x0; x < x1; x++) {
        float t = wet[x] - humidity;
        water[x] = t > 0.0f ? t : 0.0f;
    }
}

/* The neighbour above the last fiber of the rectangle; -1 if it takes no part. */
static int beyond(int end, int begin, int length)
{
    int k = end % length;
    return k >= begin && k < end ? k : -1;
}

static void row_x(const struct diffusion_openmp *o, int y, float *buffer)
{
    const struct diffusion_scene *s = &o->scene;
    size_t row = (size_t)y * o->pitch;
    float *a = o->absorbency + row, *w = o->field[0] + row;
    float *in[DIFFUSION_FIELDS_COUNT],
        *wet = buffer + MARGIN + DIFFUSION_FIELDS_COUNT * o->pitch;
    const float *from[DIFFUSION_FIELDS_COUNT];
    int last = s->x1 - 1, next = beyond(s->x1, s->x0, s->width);

    for (int i = 0; i < DIFFUSION_FIELDS_COUNT; i++) {
        float *f = o->field[i] + row;
        in[i] = buffer + MARGIN + (size_t)i * o->pitch;
        f[-1] = f[s->width - 1];
        f[s->width] = f[0];
        from[i] = f;
    }
    a[s->width] = a[0];
    flows(s, a, from, 1, NULL, s->x0, s->x1, in, wet);
    /* the last fiber's outflow is the first's inflow, or nothing; its water, and values that
     * depend on it, were provisional */
    in[0][s->x1] = next >= 0 ? in[0][next] : 0.0f;
    wet[last] = moved(w[last], in[0][last], in[0][s->x1]);
    for (int i = 1; i < DIFFUSION_FIELDS_COUNT; i++) {
        float *p = o->field[i] + row;
        in[i][last] = gravitate((p[last - 1] - p[last]) * a[last] * wet[last] *
                                    s->molecular_weight[i - 1],
                                s->gravity);
        in[i][s->x1] = next >= 0 ? in[i][next] : 0.0f;
    }
    memcpy(w + s->x0, wet + s->x0, (size_t)(s->x1 - s->x0) * sizeof *w);
    for (int i = 1; i < DIFFUSION_FIELDS_COUNT; i++)
        move(o->field[i] + row, in[i], in[i] + 1, s->x0, s->x1);
}

/* Columns x0..x1-1 of the rectangle, at most STRIP of them. */
static void strip_y(const struct diffusion_openmp *o, int x0, int x1)
{
    const struct diffusion_scene *s = &o->scene;
    float flow[2][DIFFUSION_FIELDS_COUNT][STRIP], wet[STRIP],
        above[DIFFUSION_FIELDS_COUNT][STRIP];
    int count = x1 - x0, next = beyond(s->y1, s->y0, s->height);
    ptrdiff_t pitch = (ptrdiff_t)o->pitch;
    size_t bytes = (size_t)count * sizeof(float);
    float *top[DIFFUSION_FIELDS_COUNT];

    memset(flow, 0, sizeof flow);
    for (int i = 0; i < DIFFUSION_FIELDS_COUNT; i++) {
        top[i] = o->field[i] + x0;
        /* the row above the first, while it has its old values */
        memcpy(above[i], top[i] + (s->y0 ? s->y0 - 1 : s->height - 1) * pitch, bytes);
    }
    if (next >= 0) { /* row 0 follows the last row: its inflow, from old rows */
        const float *a = o->absorbency + x0;
        for (int x = 0; x < count; x++) {
            flow[1][0][x] =
                gravitate((top[0][x] - top[0][pitch + x]) * a[pitch + x], s->gravity);
            flow[0][0][x] = gravitate((above[0][x] - top[0][x]) * a[x], s->gravity);
            float water = moved(top[0][x], flow[0][0][x], flow[1][0][x]);
            for (int i = 1; i < DIFFUSION_FIELDS_COUNT; i++)
                flow[0][i][x] = gravitate((above[i][x] - top[i][x]) * a[x] * water *
                                              s->molecular_weight[i - 1],
                                          s->gravity);
        }
    }
    for (int y = s->y1 - 1, now = 1; y >= s->y0; y--, now = !now) {
        float(*in)[STRIP] = flow[now], (*out)[STRIP] = flow[!now];
        float *f[DIFFUSION_FIELDS_COUNT], *into[DIFFUSION_FIELDS_COUNT];
        const float *from[DIFFUSION_FIELDS_COUNT];
        for (int i = 0; i < DIFFUSION_FIELDS_COUNT; i++) {
            into[i] = in[i];
            f[i] = top[i] + y * pitch;
            from[i] = f[i];
        }
        ptrdiff_t step = pitch;
        float first[DIFFUSION_FIELDS_COUNT][2][STRIP];
        if (y == 0) { /* the row above has changed: keep the old values of two rows side by
                       * side */
            for (int i = 0; i < DIFFUSION_FIELDS_COUNT; i++) {
                memcpy(first[i][0], above[i], bytes);
                memcpy(first[i][1], f[i], bytes);
                from[i] = first[i][1];
            }
            step = STRIP;
        }
        flows(s, o->absorbency + x0 + y * pitch, from, step, out[0], 0, count, into, wet);
        if (s->humidity > 0)
            dry(f[0], wet, s->humidity, 0, count);
        else
            memcpy(f[0], wet, bytes);
        for (int i = 1; i < DIFFUSION_FIELDS_COUNT; i++)
            move(f[i], in[i], out[i], 0, count);
    }
}

/* Fibers outside of the rectangle also dry. */
static void rim_dry(const struct diffusion_openmp *o, int y)
{
    const struct diffusion_scene *s = &o->scene;
    float *water = o->field[0] + (size_t)y * o->pitch;
    bool inside = y >= s->y0 && y < s->y1;
    dry(water, water, s->humidity, 0, inside ? s->x0 : s->width);
    if (inside)
        dry(water, water, s->humidity, s->x1, s->width);
}

void diffusion_openmp_steps(struct diffusion_openmp *o, int steps_count)
{
    const struct diffusion_scene *s = &o->scene;
    int strips_count = (s->x1 - s->x0 + STRIP - 1) / STRIP;
    if (strips_count < bench_threads_count())
        strips_count = bench_threads_count();
#pragma omp parallel
    {
        size_t bytes = (o->pitch * (DIFFUSION_FIELDS_COUNT + 1) * sizeof(float) + 63) / 64 * 64;
        float *buffer = aligned_alloc(64, bytes);
        if (!buffer)
            abort();
        for (int step = 0; step < steps_count; step++) {
#pragma omp for schedule(static)
            for (int y = s->y0; y < s->y1; y++)
                row_x(o, y, buffer);
#pragma omp for schedule(dynamic, 1)
            for (int i = 0; i < strips_count; i++) {
                int span = s->x1 - s->x0;
                strip_y(o, s->x0 + (int)((long)span * i / strips_count),
                        s->x0 + (int)((long)span * (i + 1) / strips_count));
            }
#pragma omp for schedule(static)
            for (int y = 0; y < (s->humidity > 0 ? s->height : 0); y++)
                rim_dry(o, y);
        }
        free(buffer);
    }
}
