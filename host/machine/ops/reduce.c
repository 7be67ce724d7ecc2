/* reduce.c - reductions: one number of each run of columns, by the front end or the device,
 * and these joined in an order that is always the same.
 *
 * An array in blocks has the same runs: a row is in one block, and a block of a set with one
 * axis begins where a run does. So the blocks' runs, one block after the other, are those of
 * the array in one piece. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/errors.h"
#include "base/scalar.h"
#include "base/types.h"
#include "kernels.h"
#include "memory/call_set.h"
#include "memory/memory.h"
#include "ops/near.h"
#include "ops/sums_far.h"
#include "ranks/ranks.h"
#include "run/evaluate.h"
#include "run/materialise.h"
#include "sequencers/sequencers.h"
#include "values/graph.h"
#include "values/make.h"

enum {
    REDUCE_RUN = 4096
}; /* columns; fixes the order of float addition, see machine_reduce() */

struct reduction_info {
    enum reduction_op op;
    bool is_float, is_signed;
};

static const struct reduction_info reductions[] = {
    [MACHINE_REDUCE_AND] = {REDUCE_AND, false, false},
    [MACHINE_REDUCE_OR] = {REDUCE_OR, false, false},
    [MACHINE_REDUCE_XOR] = {REDUCE_XOR, false, false},
    [MACHINE_REDUCE_ADD] = {REDUCE_ADD, false, false},
    [MACHINE_REDUCE_UMIN] = {REDUCE_LEAST, false, false},
    [MACHINE_REDUCE_UMAX] = {REDUCE_GREATEST, false, false},
    [MACHINE_REDUCE_SMIN] = {REDUCE_LEAST, false, true},
    [MACHINE_REDUCE_SMAX] = {REDUCE_GREATEST, false, true},
    [MACHINE_REDUCE_FADD] = {REDUCE_ADD, true, false},
    [MACHINE_REDUCE_FMIN] = {REDUCE_LEAST, true, false},
    [MACHINE_REDUCE_FMAX] = {REDUCE_GREATEST, true, false},
};

static struct machine_scalar identity_of(const struct reduction_info *info,
                                         struct machine_type type)
{
    struct machine_scalar x = {0, 0};
    if (info->is_float && info->op != REDUCE_ADD) {
        if (type.width == 32)
            x.lo = info->op == REDUCE_LEAST ? 0x7f800000u : 0xff800000u;
        else
            x.lo = info->op == REDUCE_LEAST ? 0x7ff0000000000000u : 0xfff0000000000000u;
    } else if (info->op == REDUCE_AND || (info->op == REDUCE_LEAST && !info->is_float)) {
        x = scalar_ones(type.width);
    }
    return x;
}

static float as_float(uint64_t bits)
{
    uint32_t low = (uint32_t)bits;
    float f;
    memcpy(&f, &low, sizeof f);
    return f;
}

static double as_double(uint64_t bits)
{
    double d;
    memcpy(&d, &bits, sizeof d);
    return d;
}

#define COMBINE_FLOATS(type, from, to)                                                         \
    static struct machine_scalar combine_##type(enum reduction_op op, struct machine_scalar a, \
                                                struct machine_scalar b)                       \
    {                                                                                          \
        type x = from(a.lo), y = from(b.lo);                                                   \
        INVARIANT(op == REDUCE_ADD || op == REDUCE_LEAST || op == REDUCE_GREATEST);            \
        type r = op == REDUCE_ADD     ? x + y                                                  \
                 : op == REDUCE_LEAST ? (y < x ? y : x)                                        \
                                      : (y > x ? y : x);                                       \
        to bits;                                                                               \
        memcpy(&bits, &r, sizeof bits);                                                        \
        return (struct machine_scalar){bits, 0};                                               \
    }

COMBINE_FLOATS(float, as_float, uint32_t)
COMBINE_FLOATS(double, as_double, uint64_t)

static struct machine_scalar combine_bits(enum reduction_op op, struct machine_scalar a,
                                          struct machine_scalar b)
{
    bool less = a.hi < b.hi || (a.hi == b.hi && a.lo < b.lo);
    switch (op) {
    case REDUCE_AND:
        return (struct machine_scalar){a.lo & b.lo, a.hi & b.hi};
    case REDUCE_OR:
        return (struct machine_scalar){a.lo | b.lo, a.hi | b.hi};
    case REDUCE_XOR:
        return (struct machine_scalar){a.lo ^ b.lo, a.hi ^ b.hi};
    case REDUCE_ADD:
        return (struct machine_scalar){a.lo + b.lo, a.hi + b.hi + (a.lo + b.lo < a.lo)};
    case REDUCE_LEAST:
        return less ? a : b;
    case REDUCE_GREATEST:
        return less ? b : a;
    }
    INVARIANT(false);
}

static struct machine_scalar combine(enum reduction_op op, struct machine_type type,
                                     struct machine_scalar a, struct machine_scalar b)
{
    if (type.kind == MACHINE_BITS)
        return combine_bits(op, a, b);
    return type.width == 32 ? combine_float(op, a, b) : combine_double(op, a, b);
}

/* Runs' numbers joined, each with its neighbour, until one is left. */
static struct machine_scalar join_runs(enum reduction_op op, struct machine_type type,
                                       struct machine_scalar *sums, size_t count)
{
    while (count > 1) {
        for (size_t i = 0; i < count / 2; i++)
            sums[i] = combine(op, type, sums[2 * i], sums[2 * i + 1]);
        if (count % 2)
            sums[count / 2] = sums[count - 1];
        count = (count + 1) / 2;
    }
    return sums[0];
}

/* What was made longer, if the value is that and not in memory; else the value. */
static struct machine_value *made_longer(struct machine_value *v)
{
    const bool is = !v->buffer && v->type.kind != MACHINE_FLOAT && v->type.width <= 64 &&
                    (v->op == NODE_ZERO_EXTEND || v->op == NODE_SIGN_EXTEND) &&
                    v->in[0]->type.width < v->type.width;
    return is ? v->in[0] : v;
}

/* ---- runs ---- */

/* A set whose rows begin where a block's own ones do: nothing else is seen of its arrays. */
static struct vpset own_rows(struct machine *m, int set, int block)
{
    struct band band = sequencers_band(m, set, block);
    INVARIANT(band.at <= INT32_MAX);
    band.set.halo = (int)band.at;
    return band.set;
}

static size_t runs_of(const struct vpset *s)
{
    return s->count ? ((size_t)s->width + REDUCE_RUN - 1) / REDUCE_RUN * s->rows : 0;
}

/* Whether no block cuts a run. */
static bool runs_are_whole(struct machine *m, int set)
{
    const struct cut *c = sequencers_cut(m, set);
    for (int i = 0; i < m->sequencers->count && m->values->sets[set].rank == 1; i++)
        if (c->first[i] % REDUCE_RUN && c->first[i] < c->length)
            return false;
    return true;
}

/* Makes ready what is reduced: the arrays of both (context NULL: there is none) in blocks, or
 * both in one piece. far_too: other ranks' blocks may be, too. False: error set. */
static bool arrays_ready(struct machine *m, int set, struct machine_value *in,
                         struct machine_value *context, bool *in_blocks, bool far_too)
{
    struct machine_value *const values[2] = {in, context};
    *in_blocks = false;
    if (!sequencers_have(m, values, 2))
        return true;
    *in_blocks = (sequencers_are_near(m) || far_too) && runs_are_whole(m, set);
    for (int i = 0; i < 2; i++)
        if (values[i] &&
            (*in_blocks ? sequencers_divide(m, values[i]->buffer, set, values[i]->type, 0)
                        : sequencers_whole(m, values[i]->buffer)))
            return false;
    return true;
}

/* What is reduced of a block. */
static struct near_sum block_sum(const struct near_sum *what, int block)
{
    struct near_sum w = *what;
    w.numbers = what->numbers->blocks->of[block];
    w.context = what->context ? what->context->blocks->of[block] : NULL;
    return w;
}

/* near_sums() of all blocks, one after the other; those of other ranks have been asked for, and
 * are taken in their turn. */
static bool blocks_sums(struct machine *m, int set, const struct near_sum *what,
                        struct machine_scalar *sums)
{
    const bool far = m->sequencers->far;
    bool good = true;
    for (int i = 1; far && i < m->sequencers->count; i++) {
        const struct vpset own = own_rows(m, set, i);
        const struct near_sum w = block_sum(what, i);
        if (own.count)
            sums_far_ask(i, &own, &w, REDUCE_RUN, runs_of(&own));
    }
    if (far)
        ranks_flush();
    for (int i = 0; i < m->sequencers->count; i++) {
        const struct vpset own = own_rows(m, set, i);
        const struct near_sum w = block_sum(what, i);
        if (own.count && far && i)
            sums_far_take(i, sums, runs_of(&own));
        else if (own.count && good)
            good = near_sums(m, &own, &w, REDUCE_RUN, sums);
        sums += runs_of(&own);
    }
    return good;
}

static bool is_everywhere(const struct machine_value *context)
{
    return !context || value_is_one_bit(context);
}

/* On the front end: of numbers in memory that are few, or were only made longer since, in
 * processors that a context in memory says. False: it is not so. */
static bool reduce_near(struct machine *m, int set, struct machine_value *v,
                        struct machine_value *context, const struct reduction_info *info,
                        struct machine_scalar identity, struct machine_scalar *out)
{
    const struct vpset *s = &m->values->sets[set];
    struct near_sum w = {.op = info->op,
                         .is_float = v->type.kind == MACHINE_FLOAT,
                         .flip = info->is_signed ? scalar_sign(v->type.width)
                                                 : (struct machine_scalar){0, 0},
                         .identity = identity};
    struct machine_value *in = made_longer(v);
    bool all = is_everywhere(context), in_blocks = false;
    if (!m->settings.near)
        return false;
    w.extends = in != v && v->op == NODE_SIGN_EXTEND;
    if (!in->buffer || (in->type.kind == MACHINE_FLOAT) != w.is_float ||
        (!all && !context->buffer) ||
        (m->sequencers &&
         !arrays_ready(m, set, in, all ? NULL : context, &in_blocks, m->sequencers->far_near)))
        return false;
    w.plain = in == v || (info->op == REDUCE_ADD && !w.extends);
    w.width = in->type.width;
    w.element = type_bytes(in->type);
    w.numbers = in->buffer;
    w.context = all ? NULL : context->buffer;
    size_t count = runs_of(s);
    struct machine_scalar few[64], *sums = count <= 64 ? few : malloc(count * sizeof *sums);
    bool good = sums && (in_blocks ? blocks_sums(m, set, &w, sums)
                                   : near_sums(m, s, &w, REDUCE_RUN, sums));
    if (good)
        *out = join_runs(info->op, v->type, sums, count);
    if (sums != few)
        free(sums);
    return good;
}

static enum machine_status device_sums(struct machine *m, const struct vpset *s,
                                       const struct device_buffer *in, struct machine_type type,
                                       enum reduction_op op, struct machine_scalar identity,
                                       struct machine_scalar *sums)
{
    bool is_float = type.kind == MACHINE_FLOAT, wide = type_bytes(type) == 16;
    const char *real = type.width == 32 ? "float" : "double";
    char options[96];
    snprintf(options, sizeof options, "-DKIND=%d -DOP=%d -DELEMENT=%s -DACC=%s",
             wide ? 2 : is_float, op,
             is_float ? real
             : wide   ? "ulong"
                      : call_element(type_bytes(type)),
             is_float ? real : "ulong");
    struct kernel_call c = call_begin(m, kernel_reduce_cl, options, "reduce");
    size_t count = runs_of(s), element = is_float ? type_bytes(type) : wide ? 16 : 8;
    struct device_buffer *b = c.kernel ? device_buffer_get(m, count * element) : NULL;
    unsigned char *raw = b ? malloc(count * element) : NULL;
    if (!raw) {
        if (b)
            device_buffer_unref(m, b);
        return m->status ? m->status
                         : machine_fail(m, MACHINE_NO_MEMORY, "not enough memory to reduce");
    }
    call_layout(&c, s);
    call_int(&c, REDUCE_RUN);
    call_argument(&c, element > 8 ? 8 : element, &identity.lo);
    if (wide)
        call_ulong(&c, identity.hi);
    call_buffer(&c, in);
    call_buffer(&c, b);
    double start = device_wait_begin(m);
    enum machine_status status = call_start(&c, m, count / s->rows, s->rows, "reducing");
    cl_int error = status ? CL_SUCCESS
                          : clEnqueueReadBuffer(m->device->queue, device_mem(b), CL_TRUE, 0,
                                                count * element, raw, 0, NULL, NULL);
    if (m->watch)
        watch_bytes(m, count * element);
    enum machine_status waited = device_wait_end(m, error, start, "reducing");
    status = status ? status : waited;
    for (size_t i = 0; i < count && !status; i++) {
        sums[i] = (struct machine_scalar){0, 0};
        memcpy(&sums[i].lo, raw + i * element, element < 8 ? element : 8);
        if (wide)
            memcpy(&sums[i].hi, raw + i * element + 8, 8);
    }
    device_buffer_unref(m, b);
    free(raw);
    return status;
}

/* By the device: an array in one piece, or block by block. */
static enum machine_status reduce_buffer(struct machine *m, int set, struct machine_value *v,
                                         enum reduction_op op, struct machine_scalar identity,
                                         struct machine_scalar *out)
{
    const struct vpset *s = &m->values->sets[set];
    bool in_blocks;
    if (!arrays_ready(m, set, v, NULL, &in_blocks, false))
        return m->status;
    const size_t count = runs_of(s);
    struct machine_scalar *sums = malloc(count * sizeof *sums), *at = sums;
    enum machine_status status =
        sums ? MACHINE_OK : machine_fail(m, MACHINE_NO_MEMORY, "not enough memory to reduce");
    for (int i = 0; in_blocks && i < m->sequencers->count && !status; i++) {
        const struct vpset own = own_rows(m, set, i);
        if (own.count)
            status = device_sums(m, &own, v->buffer->blocks->of[i], v->type, op, identity, at);
        at += runs_of(&own);
    }
    if (!in_blocks && !status)
        status = device_sums(m, s, v->buffer, v->type, op, identity, sums);
    if (!status)
        *out = join_runs(op, v->type, sums, count);
    free(sums);
    return status;
}

/* Puts what was made longer into memory as it was before: it takes less room, and a field may
 * hold it. True: it is there, and the front end may be able to reduce it now. */
static bool brought_near(struct machine *m, struct machine_value *value,
                         const struct machine_value *context)
{
    struct machine_value *in = made_longer(value);
    if (in == value || in->buffer || !m->settings.near || !m->device->is_pocl ||
        !(is_everywhere(context) || context->buffer))
        return false;
    return evaluate_in_blocks(m, &in, 1, false) == MACHINE_OK && in->buffer;
}

/* Computes what a field holds and the context, where the value, or what was made longer, is no
 * more than that. True: the front end may be able to reduce it now. */
static bool held_near(struct machine *m, struct machine_value **value,
                      struct machine_value *context)
{
    struct machine_value *in = made_longer(*value), *held = in;
    if (m->settings.near && m->device->is_pocl && !is_everywhere(context))
        held = materialise_instead(m, in, context);
    struct machine_value *values[] = {held, context};
    if (held == in || evaluate_in_blocks(m, values, 2, false) || !held->buffer ||
        !context->buffer)
        return false;
    if (in != *value)
        held = machine_resize(m, held, (*value)->type.width, (*value)->op == NODE_SIGN_EXTEND);
    *value = held;
    return held != NULL;
}

/* Selected under the context by an evaluation, and then on the device unless that is slower. */
static enum machine_status reduce_far(struct machine *m, int set, struct machine_value *value,
                                      struct machine_value *context,
                                      const struct reduction_info *info,
                                      struct machine_scalar identity,
                                      struct machine_scalar *out)
{
    struct machine_type type = value->type;
    if (info->is_signed) /* in another order: the sign bit turned over */
        value = machine_binary(m, MACHINE_XOR, value,
                               machine_constant(m, type, scalar_sign(type.width)));
    struct machine_value *none = machine_constant(m, type, identity);
    value = value && none ? machine_select(m, context, value, none) : NULL;
    value = value ? materialise_in_blocks(m, set, value) : NULL;
    struct reduction_info unsigned_order = {info->op, info->is_float, false};
    if (!value)
        return m->status;
    return reduce_near(m, set, value, NULL, &unsigned_order, identity, out)
               ? MACHINE_OK
               : reduce_buffer(m, set, value, info->op, identity, out);
}

static enum machine_status reduce_end(const struct reduction_info *info,
                                      struct machine_type type, struct machine_scalar *out)
{
    struct machine_scalar sign = scalar_sign(type.width);
    if (info->is_signed) {
        out->lo ^= sign.lo;
        out->hi ^= sign.hi;
    }
    *out = scalar_cut(*out, type.width);
    if (info->is_float && type.width == 32 && isnan(as_float(out->lo)))
        out->lo = NAN_32;
    if (info->is_float && type.width == 64 && isnan(as_double(out->lo)))
        out->lo = NAN_64;
    if (type.s)
        out->lo = type_rounded(out->lo, type);
    return MACHINE_OK;
}

enum machine_status machine_reduce(struct machine *m, enum machine_reduction op,
                                   struct machine_value *value, struct machine_scalar *out)
{
    const int set = m->values->set_current;
    if (!value || !vpset_get(m, set))
        return m->status;
    if ((unsigned)op >= sizeof reductions / sizeof *reductions ||
        reductions[op].is_float != (value->type.kind == MACHINE_FLOAT))
        return machine_fail(m, MACHINE_BAD_ARGUMENT,
                            "this reduction does not take values of this type");
    if (value->set && value->set != set)
        return machine_fail(m, MACHINE_BAD_ARGUMENT, "the value belongs to another VP set");
    const struct reduction_info *info = &reductions[op];
    struct machine_type type = value->type;
    struct machine_scalar identity = identity_of(info, type);
    struct machine_value *context = flag_held(m, set, MACHINE_CONTEXT);
    if (!reduce_near(m, set, value, context, info, identity, out) &&
        !(held_near(m, &value, context) &&
          reduce_near(m, set, value, context, info, identity, out)) &&
        !(brought_near(m, value, context) &&
          reduce_near(m, set, value, context, info, identity, out)) &&
        reduce_far(m, set, value, context, info, identity, out))
        return m->status;
    return reduce_end(info, type, out);
}
