/* paper_openmp.c - the paper's full rule in plain C with OpenMP: one pass over the sheet a
 * step, in place.
 *
 * A thread has a band of rows and goes down it. A fiber's own part of a step (sinking in,
 * settling, drying) is done a row ahead of the flows, into a ring of three rows. The ring stays
 * in the caches with all terms of the faces:
 *
 *     row y - 1   written                       up:  what flows over its upper face, kept for row y
 *     row y       flows over its faces  -------->    written, in place
 *     row y + 1   own part done, in the ring
 *     row y + 2   as it was
 *
 * The rows just outside of a band (one above, one below) are computed by both threads, before
 * either writes. All fields of a row are adjacent in memory: one stream instead of fifty. Each
 * loop goes along a row, and is vectorised by the compiler.
 *
 * The operations are those of host/paper/model/step.c in the same order, except that sums of
 * whole numbers below 2^24 are exact in any order.
 */
#include "paper_openmp.h"
#include "paper_openmp_rounding.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness.h"

#ifdef _OPENMP
#include <omp.h>
#endif

/* Rows of the ring: amounts that flow, then what the faces are made of. */
enum { R_ROOM, R_FILM, R_LEVEL, R_DEPTH, R_WET, R_ENTRY, R_LEFT, R_TERMS };
/* Rows of faces. */
enum { P_OUT, P_IN, P_CREEP, P_CREEP_OUT, P_CREEP_IN, P_ROWS };

/* A thread's buffers: rows of pitch floats. */
struct band {
    float *memory;
    float *ring[4];   /* flowing + R_TERMS rows each; the fourth is of the row after the band */
    float *around[2]; /* old values: of the row above, and of this row */
    float *after;     /* ... of the row after the band */
    float *part, *wet, *dry, *damp; /* of a row's own part */
    float *x_faces, *y_faces;       /* P_ROWS rows each */
    float *up;                      /* flowing rows: what goes over the upper face */
    float *over;                    /* along x */
};

static float *row_of(const struct paper_openmp *o, float *rows, int number)
{
    return rows + (size_t)number * o->pitch + MARGIN;
}

/* ---- a fiber's own part ---- */

struct own {
    float *depth, *creep; /* new surface water and water */
    float *terms[R_TERMS];
    uint32_t *dried;
    float *around; /* new */
};

/* Absorbs and dries water; keeps the terms of the pigments in the band's rows. */
INLINE void own_water(const struct paper_openmp *o, const struct band *b, int y,
                      const struct own *to, const float *above, const float *here,
                      const float *below, bool edge)
{
    const struct paper_air *air = &o->config.air;
    const int width = o->config.width;
    const float *surface = field_row(o, F_SURFACE_WATER, y), *water = field_row(o, F_WATER, y);
    const float *absorbency = field_row(o, F_ABSORBENCY, y),
                *capacity = field_row(o, F_CAPACITY, y);
    float *part_row = b->part, *wet_row = b->wet, *dry_row = b->dry, *damp_row = b->damp;
    float *depth = to->depth, *creep = to->creep, *around = to->around,
          *room = to->terms[R_ROOM];
    uint32_t *dried = to->dried;
    const float unit = PAPER_GRAINS, absorption = (float)air->absorption;
    const double grains = air->humidity * PAPER_GRAINS;
    const float damp_least = (float)-floor(air->damp * PAPER_GRAINS);
    const double relax_exact = 1 / (1 + 4 * air->edge_width * air->edge_width);
    const float relax = (float)relax_exact, stay = (float)(1 - relax_exact);
    const float loss_edge = (float)(grains * air->edge), loss_all = (float)grains;
#pragma omp simd
    for (int x = 0; x < width; x++) {
        float s = surface[x], w = water[x];
        float taken = absorbency[x] * absorption * s;
        taken = greatest(least(taken, capacity[x] * unit - w), 0.0f);
        taken = whole_of(taken, s);
        part_row[x] = taken / greatest(s, 1.0f);
        s -= taken;
        w += taken;
        float wet = least(s, 1.0f), dry = 1.0f - wet;
        wet_row[x] = wet;
        dry_row[x] = dry;
        damp_row[x] = least(w, 1.0f) * dry;

        float loss = loss_all;
        if (edge) {
            float wetness = least(greatest(w + damp_least, 0.0f) + s, 1.0f);
            float sum = here[x + 1] + here[x - 1], mean = below[x] + above[x];
            mean = (mean + sum) * 0.25f * stay + wetness * relax;
            mean = greatest(mean + -1e-6f, 0.0f);
            around[x] = mean;
            loss = greatest(1.0f - mean, 0.0f) * wetness * loss_edge + loss_all;
        }
        float above_loss = whole_of(least(loss, s), s);
        s -= above_loss;
        float below_loss = whole_of(least(loss * dry, w), w);
        w -= below_loss;
        dried[x] = (dried[x] + (uint32_t)(int32_t)above_loss + (uint32_t)(int32_t)below_loss) &
                   0x7fffffffu;
        depth[x] = s;
        creep[x] = w;
        room[x] = s;
    }
}

INLINE void own_pigment(const struct paper_openmp *o, const struct band *b, int y, int pigment,
                        float *new_surface, float *new_infused, float *new_fixed, float *room,
                        bool limited)
{
    const struct paper_pigment *p = &o->config.pigments[pigment];
    const int width = o->config.width, field = F_PIGMENTS + 3 * pigment;
    const float *surface = field_row(o, field, y), *infused = field_row(o, field + 1, y),
                *fixed = field_row(o, field + 2, y), *height = field_row(o, F_HEIGHT, y);
    const float *part_row = b->part, *wet_row = b->wet, *dry_row = b->dry, *damp_row = b->damp;
    const double pace = o->config.air.settling * p->density;
    const float weight = (float)fmax(p->weight[0], p->weight[1]);
    const float down_slope = (float)(-pace * p->granulation), down_least = (float)pace;
    const float up_slope = (float)(pace / p->staining * p->granulation),
                up_least = (float)(pace / p->staining * (1 - p->granulation));
#pragma omp simd
    for (int x = 0; x < width; x++) {
        float s = surface[x], i = infused[x], f = fixed[x];
        float moved = whole_of(part_row[x] * weight * s, s);
        s -= moved;
        i += moved;
        float rate = height[x] * down_slope + down_least;
        float up = height[x] * up_slope + up_least;
        if (limited) {
            rate = greatest(least(rate, 1.0f), 0.0f);
            up = greatest(least(up, 1.0f), 0.0f);
        }
        up = whole_of(up * f, f);
        float seeped = rate * i;
        float down = whole_of(greatest(rate, dry_row[x]) * s, s);
        down -= up * wet_row[x];
        s -= down;
        f += down;
        seeped = whole_of(seeped * damp_row[x], i);
        up = up * damp_row[x] - seeped;
        i += up;
        f -= up;
        new_surface[x] = s;
        new_infused[x] = i;
        new_fixed[x] = f;
        room[x] = room[x] + f + i + s;
    }
}

/* What the faces are made of. */
INLINE void own_terms(const struct paper_openmp *o, int y, const struct own *to)
{
    const struct paper_air *air = &o->config.air;
    const int width = o->config.width;
    const float *height = field_row(o, F_HEIGHT, y), *capacity = field_row(o, F_CAPACITY, y);
    const float *depth = to->depth, *creep = to->creep;
    float *room = to->terms[R_ROOM], *film = to->terms[R_FILM], *level = to->terms[R_LEVEL],
          *shallow = to->terms[R_DEPTH], *wet = to->terms[R_WET], *entry = to->terms[R_ENTRY],
          *left = to->terms[R_LEFT];
    const float load = (float)(15.0 * PAPER_GRAINS),
                load_part = (float)(2 / (15.0 * PAPER_GRAINS));
    const float to_unit = (float)(1.0 / PAPER_GRAINS), to_film = (float)(1 / air->film),
                relief = (float)air->relief, pinning = (float)air->pinning;
    const float damp_least = (float)-floor(air->damp * PAPER_GRAINS), unit = PAPER_GRAINS;
#pragma omp simd
    for (int x = 0; x < width; x++) {
        float s = depth[x], w = creep[x];
        room[x] = least(greatest((load - room[x]) * load_part, 0.0f), 1.0f);
        float d = s * to_unit;
        shallow[x] = d;
        film[x] = least(d * to_film, 1.0f);
        level[x] = height[x] * relief + d;
        wet[x] = least(greatest(w + damp_least, 0.0f) + s, 1.0f);
        entry[x] = (height[x] + 0.5f) * pinning;
        left[x] = greatest((capacity[x] * unit - w) * 0.25f, 0.0f);
    }
}

/* Computes row y into the ring's row. own: the row belongs to the band, and fields that do
 * not flow are written. */
static void own_part(const struct paper_openmp *o, const struct band *b, int y, float *ring,
                     const float *above, const float *here, const float *below, bool own)
{
    const int width = o->config.width, flowing = o->flowing;
    struct own to = {.depth = row_of(o, ring, 0), .creep = row_of(o, ring, 1)};
    float *spare = b->x_faces; /* for output that belongs to another thread */
    for (int i = 0; i < R_TERMS; i++)
        to.terms[i] = row_of(o, ring, flowing + i);
    to.dried = (uint32_t *)(void *)(own ? field_row(o, F_DRIED, y) : row_of(o, spare, 0));
    to.around = own ? field_row(o, F_AROUND, y) : row_of(o, spare, 1);
    if (o->config.air.humidity > 0 && o->config.air.edge > 0)
        own_water(o, b, y, &to, above, here, below, true);
    else
        own_water(o, b, y, &to, above, here, below, false);
    if (own)
        margins_fill(to.around, width, 1);
    for (int i = 0; i < o->config.pigments_count; i++) {
        const struct paper_pigment *p = &o->config.pigments[i];
        double pace = o->config.air.settling * p->density;
        float *surface = row_of(o, ring, 2 + 2 * i), *infused = row_of(o, ring, 3 + 2 * i),
              *fixed = own ? field_row(o, F_PIGMENTS + 3 * i + 2, y) : row_of(o, spare, 2);
        if (pace > 0.5 || pace / p->staining > 0.5)
            own_pigment(o, b, y, i, surface, infused, fixed, to.terms[R_ROOM], true);
        else /* rates are within 0..1 */
            own_pigment(o, b, y, i, surface, infused, fixed, to.terms[R_ROOM], false);
    }
    own_terms(o, y, &to);
    for (int i = 0; i < flowing + R_TERMS; i++)
        margins_fill(row_of(o, ring, i), width, 1);
}

/* ---- between fibers ---- */

/* Into rows of faces: those between row `lower` of the ring and row `upper`, step fibers further; from x = first on. */
INLINE void faces_make(const struct paper_openmp *o, float *faces, float *lower, float *upper,
                       int step, const float *face, int axis, int first, bool pull)
{
    const struct paper_air *air = &o->config.air;
    const int width = o->config.width, flowing = o->flowing;
    const float *a_depth = row_of(o, lower, flowing + R_DEPTH),
                *b_depth = row_of(o, upper, flowing + R_DEPTH) + step;
    const float *a_level = row_of(o, lower, flowing + R_LEVEL),
                *b_level = row_of(o, upper, flowing + R_LEVEL) + step;
    const float *a_film = row_of(o, lower, flowing + R_FILM),
                *b_film = row_of(o, upper, flowing + R_FILM) + step;
    const float *a_room = row_of(o, lower, flowing + R_ROOM),
                *b_room = row_of(o, upper, flowing + R_ROOM) + step;
    const float *a_wet = row_of(o, lower, flowing + R_WET),
                *b_wet = row_of(o, upper, flowing + R_WET) + step;
    const float *a_entry = row_of(o, lower, flowing + R_ENTRY),
                *b_entry = row_of(o, upper, flowing + R_ENTRY) + step;
    const float *a_left = row_of(o, lower, flowing + R_LEFT),
                *b_left = row_of(o, upper, flowing + R_LEFT) + step;
    const float *a_water = row_of(o, lower, 1), *b_water = row_of(o, upper, 1) + step;
    float *out_row = row_of(o, faces, P_OUT), *in_row = row_of(o, faces, P_IN),
          *creep_row = row_of(o, faces, P_CREEP),
          *creep_out_row = row_of(o, faces, P_CREEP_OUT),
          *creep_in_row = row_of(o, faces, P_CREEP_IN);
    const float spread = (float)air->spread, spread4 = (float)(4 * air->spread),
                gravity = (float)(air->gravity[axis] / 2), seep = (float)(air->seep[axis] / 2),
                carry = (float)air->carry, drift = (float)((1 - air->carry) / PAPER_GRAINS);
    const bool pinned = air->pinning > 0;
#pragma omp simd
    for (int x = first; x < width; x++) {
        float d = (a_level[x] - b_level[x]) * spread;
        float both = b_depth[x] + a_depth[x];
        d = d / (both * spread4 + 1.0f);
        if (pull)
            d += both * gravity;
        d *= least(face[x] * 1e6f, 1.0f);
        float out = least(greatest(d, 0.0f), 0.125f), in = greatest(least(d, 0.0f), -0.125f);
        out = out * a_film[x] * b_room[x];
        in = in * b_film[x] * a_room[x];
        if (pinned) {
            out *= least(greatest((a_depth[x] - b_entry[x]) * 4.0f, 0.0f) + b_wet[x], 1.0f);
            in *= least(greatest((b_depth[x] - a_entry[x]) * 4.0f, 0.0f) + a_wet[x], 1.0f);
        }
        out_row[x] = out;
        in_row[x] = in;

        float here = a_water[x], there = b_water[x], flow = here - there;
        if (pull)
            flow += (here + there) * seep;
        flow *= face[x];
        flow = least(least(flow, b_left[x]), here * 0.125f);
        flow = greatest(greatest(flow, -a_left[x]), there * -0.125f);
        flow = whole(flow);
        creep_row[x] = flow;
        float moved = least(here, there) * drift * face[x];
        float creep_out = greatest(flow, 0.0f) / greatest(here, 1.0f) * carry + moved;
        float creep_in = least(flow, 0.0f) / greatest(there, 1.0f) * carry - moved;
        creep_out_row[x] = least(creep_out, 0.125f) * b_room[x];
        creep_in_row[x] = greatest(creep_in, -0.125f) * a_room[x];
    }
}

static void faces_along(const struct paper_openmp *o, float *faces, float *lower, float *upper,
                        int step, const float *face, int axis, int first)
{
    if (o->config.air.gravity[axis] != 0 || o->config.air.seep[axis] != 0)
        faces_make(o, faces, lower, upper, step, face, axis, first, true);
    else
        faces_make(o, faces, lower, upper, step, face, axis, first, false);
}

/* Which faces amount q of the ring flows over, and its weight there. */
struct way {
    int out, in;
    float weight;
};

static struct way way_of(const struct paper_openmp *o, int q, int axis)
{
    if (q < 2 || q % 2 == 0)
        return (struct way){P_OUT, P_IN, 1};
    return (struct way){P_CREEP_OUT, P_CREEP_IN,
                        (float)o->config.pigments[(q - 2) / 2].weight[axis]};
}

/* over = the flow from lower to upper, plus WHOLE: differences are unchanged, and exact. */
INLINE void flow_make(float *over, const float *out, const float *in, const float *lower,
                      const float *upper, float weight, bool weighed, int first, int width)
{
#pragma omp simd
    for (int x = first; x < width; x++)
        over[x] = (weighed ? lower[x] * (out[x] * weight) + upper[x] * (in[x] * weight)
                           : lower[x] * out[x] + upper[x] * in[x]) +
                  WHOLE;
}

/* Moves amount q of row y: along x, then over the upper faces; the inflow from below was
 * kept in up. */
static void amount_flow(const struct paper_openmp *o, const struct band *b, int q, float *here,
                        float *next, float *to)
{
    const int width = o->config.width;
    struct way along = way_of(o, q, 0), upwards = way_of(o, q, 1);
    float *over = row_of(o, b->over, 0), *up = row_of(o, b->up, q);
    const float *amount = row_of(o, here, q), *above = row_of(o, next, q);
    const float *out = row_of(o, b->y_faces, upwards.out),
                *in = row_of(o, b->y_faces, upwards.in);
    if (along.out == P_CREEP_OUT)
        flow_make(over, row_of(o, b->x_faces, along.out), row_of(o, b->x_faces, along.in),
                  amount, amount + 1, along.weight, true, -1, width);
    else
        flow_make(over, row_of(o, b->x_faces, along.out), row_of(o, b->x_faces, along.in),
                  amount, amount + 1, 1, false, -1, width);
    const float weight = upwards.weight;
#pragma omp simd
    for (int x = 0; x < width; x++) {
        float flow = amount[x] * (out[x] * weight) + above[x] * (in[x] * weight) + WHOLE;
        float sum = over[x - 1] - over[x];
        sum += up[x] - flow;
        up[x] = flow;
        to[x] = amount[x] + sum;
    }
}

static void water_creep(const struct paper_openmp *o, const struct band *b, float *here,
                        float *to)
{
    const int width = o->config.width;
    float *up = row_of(o, b->up, 1);
    const float *amount = row_of(o, here, 1), *over = row_of(o, b->x_faces, P_CREEP),
                *flow = row_of(o, b->y_faces, P_CREEP);
#pragma omp simd
    for (int x = 0; x < width; x++) {
        to[x] = amount[x] + (up[x] - flow[x] + over[x - 1] - over[x]);
        up[x] = flow[x];
    }
}

/* The place of the ring's amount q in the sheet. */
static int field_of_amount(int q)
{
    return q == 0 ? F_SURFACE_WATER : q == 1 ? F_WATER : F_PIGMENTS + 3 * ((q - 2) / 2) + q % 2;
}

/* Streams as short as a row are too short for the hardware prefetcher. */
static void row_prefetch(const struct paper_openmp *o, int field, int y)
{
    const float *row = field_row(o, field, y);
    for (int x = 0; x < o->config.width; x += LANES)
        __builtin_prefetch(row + x, 1, 2);
}

/* Meanwhile prefetches the row two further, a few fields at a time. */
static void row_flow(const struct paper_openmp *o, const struct band *b, int y, float *here,
                     float *next)
{
    faces_along(o, b->x_faces, here, here, 1, field_row(o, F_FACE_X, y), 0, -1);
    faces_along(o, b->y_faces, here, next, 0, field_row(o, F_FACE_Y, y), 1, 0);
    for (int q = 0, fetched = 0; q < o->flowing; q++) {
        for (; fetched < o->fields_count * (q + 1) / o->flowing; fetched++)
            row_prefetch(o, fetched, y + 2);
        if (q == 1)
            water_creep(o, b, here, field_row(o, F_WATER, y));
        else
            amount_flow(o, b, q, here, next, field_row(o, field_of_amount(q), y));
    }
}

/* Computes the flow into the band from the row below it. */
static void band_begin(const struct paper_openmp *o, const struct band *b, int y, float *below,
                       float *first)
{
    const int width = o->config.width;
    faces_along(o, b->y_faces, below, first, 0, field_row(o, F_FACE_Y, y - 1), 1, 0);
    for (int q = 0; q < o->flowing; q++) {
        struct way way = way_of(o, q, 1);
        if (q == 1)
            memcpy(row_of(o, b->up, 1), row_of(o, b->y_faces, P_CREEP),
                   (size_t)width * sizeof(float));
        else
            flow_make(row_of(o, b->up, q), row_of(o, b->y_faces, way.out),
                      row_of(o, b->y_faces, way.in), row_of(o, below, q), row_of(o, first, q),
                      way.weight, true, 0, width);
    }
}

static void row_keep(const struct paper_openmp *o, float *to, const float *row)
{
    memcpy(to - MARGIN, row - MARGIN, o->pitch * sizeof *to);
}

static bool band_create(const struct paper_openmp *o, struct band *b)
{
    int rows = 4 * (o->flowing + R_TERMS) + 3 + 4 + 2 * P_ROWS + o->flowing + 1;
    size_t bytes = (size_t)rows * o->pitch * sizeof(float);
    float *at = b->memory =
        aligned_alloc(PAGE_BYTES, (bytes + PAGE_BYTES - 1) / PAGE_BYTES * PAGE_BYTES);
    if (!at)
        return false;
    memset(at, 0, bytes);
    for (int i = 0; i < 4; i++, at += (size_t)(o->flowing + R_TERMS) * o->pitch)
        b->ring[i] = at;
    float **const single[] = {&b->around[0], &b->around[1], &b->after, &b->part,
                              &b->wet,       &b->dry,       &b->damp};
    for (size_t i = 0; i < sizeof single / sizeof *single; i++, at += o->pitch)
        *single[i] = at + MARGIN;
    b->x_faces = at;
    b->y_faces = at + P_ROWS * o->pitch;
    b->up = at + 2 * P_ROWS * o->pitch;
    b->over = at + (size_t)(2 * P_ROWS + o->flowing) * o->pitch;
    return true;
}

static void band_before(const struct paper_openmp *o, struct band *b, int y0, int y1)
{
    own_part(o, b, y0 - 1, b->ring[2], field_row(o, F_AROUND, y0 - 2),
             field_row(o, F_AROUND, y0 - 1), field_row(o, F_AROUND, y0), false);
    own_part(o, b, y1, b->ring[3], field_row(o, F_AROUND, y1 - 1), field_row(o, F_AROUND, y1),
             field_row(o, F_AROUND, y1 + 1), false);
    row_keep(o, b->around[1], field_row(o, F_AROUND, y0 - 1));
    row_keep(o, b->after, field_row(o, F_AROUND, y1));
}

/* One row ahead; afterwards around[1] holds the old values of row y. */
static void band_own(const struct paper_openmp *o, struct band *b, int y, int y1)
{
    float *above = b->around[1];
    b->around[1] = b->around[0];
    b->around[0] = above;
    row_keep(o, b->around[1], field_row(o, F_AROUND, y));
    own_part(o, b, y, b->ring[y % 3], above, b->around[1],
             y + 1 == y1 ? b->after : field_row(o, F_AROUND, y + 1), true);
}

static void band_step(const struct paper_openmp *o, struct band *b, int y0, int y1)
{
    float *below = b->ring[2]; /* belongs to row y0 - 1: must not be overwritten by row y0 */
    if (y0 % 3 == 2) {
        b->ring[2] = b->ring[0];
        b->ring[0] = below;
    }
    band_own(o, b, y0, y1);
    band_begin(o, b, y0, below, b->ring[y0 % 3]);
    for (int y = y0; y < y1; y++) {
        if (y + 1 < y1)
            band_own(o, b, y + 1, y1);
        row_flow(o, b, y, b->ring[y % 3], y + 1 < y1 ? b->ring[(y + 1) % 3] : b->ring[3]);
    }
}

void paper_openmp_steps(struct paper_openmp *o, int steps_count)
{
    int bands = bench_threads_count(), height = o->config.height;
    if (o->config.model > 1) {
        paper_openmp_flow_steps(o, steps_count);
        return;
    }
    bands = bands < height / 3 ? bands : height / 3;
#pragma omp parallel num_threads(bands)
    {
        int number = 0, count = 1;
#ifdef _OPENMP
        number = omp_get_thread_num();
        count = omp_get_num_threads();
#endif
        int y0 = (int)((long)height * number / count),
            y1 = (int)((long)height * (number + 1) / count);
        struct band b;
        if (!band_create(o, &b))
            abort();
        for (int step = 0; step < steps_count; step++) {
            band_before(o, &b, y0, y1);
#pragma omp barrier
            band_step(o, &b, y0, y1);
#pragma omp barrier
        }
        free(b.memory);
    }
}
