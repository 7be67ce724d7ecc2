/* near.c - see near.h. */
#include "ops/near.h"

#include <string.h>

#include "base/errors.h"
#include "base/parts.h"
#include "base/scalar.h"
#include "base/types.h"
#include "interpret/joins.h"
#include "interpret/lanes.h"
#include "values/make.h"
#include "watch/watch.h"

enum { DEEPEST = 12, LANES = 16 };

typedef unsigned __int128 u128;

bool near_begin(struct machine *m, const struct device_buffer *b, double *start)
{
    if (!device_is_near(m, b))
        return false;
    *start = m->watch ? clock_s() : device_work_begin(m);
    return true;
}

void near_end(struct machine *m, const char *what, double start)
{
    device_work_end(m, start);
    if (m->watch)
        watch_near(m, what, start);
}

/* ---- one processor ---- */

static struct machine_scalar cut(unsigned __int128 x, int width)
{
    return scalar_cut(scalar_narrow(x), width);
}

static bool in_memory(const struct vpset *s, const struct machine_value *v, uint64_t index,
                      struct machine_scalar *out)
{
    size_t element = type_bytes(v->type);
    const unsigned char *at = v->buffer->host;
    if (!at)
        return false;
    at += geometry_place(s, index) * element;
    *out = (struct machine_scalar){0, 0};
    memcpy(&out->lo, at, element < 8 ? element : 8);
    if (element > 8)
        memcpy(&out->hi, at + 8, 8);
    return true;
}

/* Whether an operation only says which bits of its operands the result has. */
static bool moves_bits(int op)
{
    switch (op) {
    case NODE_SELECT:
    case NODE_REINTERPRET:
    case NODE_ZERO_EXTEND:
    case NODE_SIGN_EXTEND:
    case NODE_EXTRACT:
    case NODE_CONCAT:
        return true;
    default: /* the device computes it */
        return false;
    }
}

/* The value of one processor, if it is in memory, a number, a place, or made of such by moving
 * bits. */
static bool moved(const struct vpset *s, const struct machine_value *v, uint64_t index,
                  int depth, struct machine_scalar *out)
{
    struct machine_scalar a, b;
    if (v->buffer)
        return in_memory(s, v, index, out);
    if (v->op == NODE_CONSTANT) {
        *out = v->imm;
        return true;
    }
    if (v->op == NODE_INDEX || v->op == NODE_COORDINATE) {
        *out = cut(v->op == NODE_INDEX ? index : geometry_coordinate(s, v->axis, index),
                   v->type.width);
        return true;
    }
    if (!depth || !moves_bits(v->op) || !moved(s, v->in[0], index, depth - 1, &a))
        return false;
    if (v->op == NODE_SELECT)
        return moved(s, v->in[a.lo & 1 ? 1 : 2], index, depth - 1, out);
    int width = v->in[0]->type.width;
    u128 x = scalar_wide(a);
    if (v->op == NODE_SIGN_EXTEND && (x >> (width - 1) & 1))
        x |= ~(u128)0 << (width - 1);
    if (v->op == NODE_EXTRACT)
        x >>= v->detail;
    if (v->op == NODE_CONCAT) {
        if (!moved(s, v->in[1], index, depth - 1, &b))
            return false;
        x |= scalar_wide(b) << width;
    }
    *out = cut(x, v->type.width);
    return true;
}

bool near_read(struct machine *m, int set, const struct machine_value *v, uint64_t index,
               struct machine_scalar *out)
{
    return m->settings.near && m->device->is_pocl && !m->watch && !device_settle(m) &&
           moved(&m->values->sets[set], v, index, DEEPEST, out);
}

/* ---- of floats: sixteen lanes by column, then halves of them ---- */

#define FLOATS_LOOP(type, join)                                                                \
    {                                                                                          \
        for (; i + LANES <= count; i += LANES)                                                 \
            for (int lane = 0; lane < LANES; lane++) {                                         \
                const type x =                                                                 \
                    context && !context[i + (size_t)lane] ? none : p[i + (size_t)lane];        \
                sums[lane] = join(sums[lane], x);                                              \
            }                                                                                  \
        for (int lane = 0; i < count; i++, lane++) {                                           \
            const type x = context && !context[i] ? none : p[i];                               \
            sums[lane] = join(sums[lane], x);                                                  \
        }                                                                                      \
        for (int apart = LANES / 2; apart; apart /= 2)                                         \
            for (int lane = 0; lane < apart; lane++)                                           \
                sums[lane] = join(sums[lane], sums[lane + apart]);                             \
    }

#define FLOATS(name, type)                                                                     \
    static uint64_t name(const struct near_sum *w, const void *numbers,                        \
                         const unsigned char *context, size_t count)                           \
    {                                                                                          \
        const type *p = numbers;                                                               \
        type none, sums[LANES];                                                                \
        size_t i = 0;                                                                          \
        uint64_t bits = 0;                                                                     \
        memcpy(&none, &w->identity.lo, sizeof none);                                           \
        for (int lane = 0; lane < LANES; lane++)                                               \
            sums[lane] = none;                                                                 \
        if (w->op == REDUCE_ADD)                                                               \
            FLOATS_LOOP(type, JOIN_ADD)                                                        \
        else if (w->op == REDUCE_LEAST)                                                        \
            FLOATS_LOOP(type, JOIN_LEAST)                                                      \
        else {                                                                                 \
            INVARIANT(w->op == REDUCE_GREATEST);                                               \
            FLOATS_LOOP(type, JOIN_GREATEST)                                                   \
        }                                                                                      \
        memcpy(&bits, &sums[0], sizeof none);                                                  \
        return bits;                                                                           \
    }

FLOATS(run_floats, float)
FLOATS(run_doubles, double)

/* ---- of pairs of 64 bits ---- */

static u128 joined_wide(enum reduction_op op, u128 a, u128 x)
{
    switch (op) {
    case REDUCE_AND:
        return JOIN_AND(a, x);
    case REDUCE_OR:
        return JOIN_OR(a, x);
    case REDUCE_XOR:
        return JOIN_XOR(a, x);
    case REDUCE_ADD:
        return JOIN_ADD(a, x);
    case REDUCE_LEAST:
        return JOIN_LEAST(a, x);
    case REDUCE_GREATEST:
        return JOIN_GREATEST(a, x);
    }
    INVARIANT(false);
}

static u128 run_wide(const struct near_sum *w, const u128 *p, const unsigned char *context,
                     size_t count)
{
    const u128 none = scalar_wide(w->identity), flip = scalar_wide(w->flip);
    u128 sum = none;
    for (size_t i = 0; i < count; i++)
        sum = joined_wide(w->op, sum, !context || context[i] ? p[i] ^ flip : none);
    return sum;
}

/* ---- all runs ---- */

struct summing {
    const struct vpset *set;
    const struct near_sum *what;
    struct lanes_sum integers;
    size_t run, runs; /* columns of one; of a row */
    struct machine_scalar *sums;
    int parts;
};

static struct machine_scalar run_sum(const struct summing *g, size_t row, size_t i)
{
    const struct near_sum *what = g->what;
    const struct vpset *s = g->set;
    size_t x = i * g->run, width = (size_t)s->width, at = row * s->pitch + (size_t)s->halo + x,
           count = width - x < g->run ? width - x : g->run;
    const unsigned char *c =
        what->context ? (const unsigned char *)what->context->host + at : NULL;
    const void *p = (const char *)what->numbers->host + at * what->element;
    if (what->element == 16)
        return scalar_narrow(run_wide(what, p, c, count));
    uint64_t bits = !what->is_float      ? lanes_table()->sum(&g->integers, p, c, count)
                    : what->element == 4 ? run_floats(what, p, c, count)
                                         : run_doubles(what, p, c, count);
    return (struct machine_scalar){bits, 0};
}

static void part_sum(void *of, int part, int worker)
{
    const struct summing *g = of;
    size_t all = g->runs * (size_t)g->set->rows, first = all * (size_t)part / (size_t)g->parts,
           end = all * (size_t)(part + 1) / (size_t)g->parts;
    (void)worker;
    for (size_t i = first, row = i / g->runs, k = i % g->runs; i < end; i++) {
        g->sums[i] = run_sum(g, row, k++);
        if (k == g->runs) {
            k = 0;
            row++;
        }
    }
}

bool near_sums(struct machine *m, const struct vpset *s, const struct near_sum *what,
               size_t run, struct machine_scalar *sums)
{
    if (!m->device->is_pocl || !what->numbers->host ||
        (what->context && !what->context->host) || device_settle_for(m, "reducing"))
        return false;
    struct summing g = {
        .set = s,
        .what = what,
        .integers = {.op = what->op,
                     .element = what->element,
                     .plain = what->plain,
                     .none = what->identity.lo,
                     .flip = what->flip.lo,
                     .sign = what->extends ? UINT64_C(1) << (what->width - 1) : 0},
        .run = run,
        .runs = ((size_t)s->width + run - 1) / run,
        .sums = sums,
        .parts = device_parts(m, 1e-9 * m->device->shape.reduce_ns * (double)s->count)};
    const double start = device_work_begin(m);
    crew_run(m->device->crew, g.parts, part_sum, &g);
    device_work_end(m, start);
    return true;
}
