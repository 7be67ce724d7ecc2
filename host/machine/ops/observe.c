/* observe.c - what the front end reads and writes: whole fields, single processors,
 * reductions. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "access/beyond.h"
#include "access/settle.h"
#include "base/errors.h"
#include "base/scalar.h"
#include "base/types.h"
#include "kernels.h"
#include "memory/call_set.h"
#include "memory/memory.h"
#include "ops/gather.h"
#include "ops/near.h"
#include "ops/observe.h"
#include "run/evaluate.h"
#include "run/materialise.h"
#include "run/notes.h"
#include "values/graph.h"
#include "values/make.h"

enum {
    REDUCE_RUN = 4096
}; /* columns; fixes the order of float addition, see machine_reduce() */

struct field *observe_field(struct machine *m, uint32_t id, struct machine_type type,
                            uint32_t *offset)
{
    settle(m);
    int bits = machine_type_bits(type);
    struct field *beyond = beyond_field(m, id, (uint32_t)bits);
    if (beyond) {
        *offset = id - beyond->base;
        return beyond;
    }
    struct field *f = field_find(m, id, offset);
    if (f && *offset + (uint32_t)bits > f->bits) {
        machine_fail(m, MACHINE_BAD_ARGUMENT,
                     "%d bits from bit %u on run over the end of a field of %u bits", bits,
                     *offset, f->bits);
        return NULL;
    }
    return f;
}

/* An element again and again: what there is already is copied, twice as much each time. */
static void repeat_put(unsigned char *out, size_t bytes, struct machine_scalar x,
                       size_t element)
{
    materialise_put(out, x, element);
    for (size_t done = element; done < bytes; done += done < bytes - done ? done : bytes - done)
        memcpy(out + done, out, done < bytes - done ? done : bytes - done);
}

enum machine_status observe_out(struct machine *m, int set, struct machine_value *v, void *out,
                                const char *what)
{
    const struct vpset *s = &m->values->sets[set];
    size_t element = type_bytes(v->type);
    if (v->op == NODE_CONSTANT && !v->buffer) {
        repeat_put(out, s->count * element, v->imm, element);
        return MACHINE_OK;
    }
    /* Bits of floats are in the field's own array: another one would leave the field
     * waiting. */
    v = materialise(m, set, graph_same_bits(m, v));
    if (!v)
        return m->status;
    if (v->buffer->host && m->settings.near) {
        if (m->watch)
            watch_bytes(m, s->count * element);
        if (device_settle_for(m, what))
            return m->status;
        const unsigned char *rows = v->buffer->host;
        for (uint64_t row = 0; row < s->rows; row++)
            memcpy((unsigned char *)out + row * (size_t)s->width * element,
                   rows + (row * s->pitch + (size_t)s->halo) * element,
                   (size_t)s->width * element);
        return MACHINE_OK;
    }
    size_t from[3] = {(size_t)s->halo * element, 0, 0}, to[3] = {0, 0, 0};
    size_t region[3] = {(size_t)s->width * element, s->rows, 1};
    double start = device_wait_begin(m);
    cl_int error = s->pitch == (size_t)s->width
                       ? clEnqueueReadBuffer(m->device->queue, device_mem(v->buffer), CL_TRUE,
                                             0, s->count * element, out, 0, NULL, NULL)
                       : clEnqueueReadBufferRect(m->device->queue, device_mem(v->buffer),
                                                 CL_TRUE, from, to, region, s->pitch * element,
                                                 0, region[0], 0, out, 0, NULL, NULL);
    if (m->watch)
        watch_bytes(m, s->count * element);
    return device_wait_end(m, error, start, what);
}

enum machine_status machine_field_download(struct machine *m, uint32_t field,
                                           struct machine_type type, void *out)
{
    uint32_t offset;
    struct field *f = observe_field(m, field, type, &offset);
    struct machine_value *v =
        f ? machine_field_value(m, field, type, MACHINE_EVERYWHERE) : NULL;
    return v ? observe_out(m, f->vpset, v, out, "reading a field") : m->status;
}

/* Whether an element in memory has bits that the type has not. */
static bool is_masked(struct machine_type type)
{
    return type.kind != MACHINE_FLOAT && (size_t)type.width != 8 * type_bytes(type);
}

void observe_mask(unsigned char *data, uint64_t count, struct machine_type type)
{
    size_t element = type_bytes(type);
    if (!is_masked(type))
        return;
    for (uint64_t i = 0; i < count; i++) {
        struct machine_scalar x = {0, 0};
        unsigned char *at = data + i * element;
        memcpy(&x.lo, at, element < 8 ? element : 8);
        if (element > 8)
            memcpy(&x.hi, at + 8, 8);
        materialise_put(at, scalar_cut(x, type.width), element);
    }
}

enum machine_status machine_field_upload(struct machine *m, uint32_t field,
                                         struct machine_type type, const void *in)
{
    uint32_t offset;
    struct field *f = observe_field(m, field, type, &offset);
    if (!f)
        return m->status;
    uint64_t count = m->values->sets[f->vpset].count;
    size_t bytes = count * type_bytes(type);
    unsigned char *masked = is_masked(type) ? malloc(bytes) : NULL;
    if (!masked && is_masked(type))
        return machine_fail(m, MACHINE_NO_MEMORY,
                            "not enough memory to write a field of %zu bytes", bytes);
    if (masked) {
        memcpy(masked, in, bytes);
        observe_mask(masked, count, type);
    }
    struct machine_value *v = materialise_upload(m, f->vpset, type, masked ? masked : in);
    free(masked);
    return v ? machine_field_store(m, field, v, MACHINE_EVERYWHERE) : m->status;
}

enum machine_status machine_field_read(struct machine *m, uint32_t field,
                                       struct machine_type type, uint64_t index,
                                       struct machine_scalar *out)
{
    uint32_t offset;
    struct field *f = observe_field(m, field, type, &offset);
    if (!f)
        return m->status;
    if (index >= m->values->sets[f->vpset].count)
        return machine_fail(m, MACHINE_BAD_ARGUMENT, "there is no processor %llu",
                            (unsigned long long)index);
    struct machine_value *v = machine_field_value(m, field, type, MACHINE_EVERYWHERE);
    *out = (struct machine_scalar){0, 0};
    if (!v)
        return m->status;
    if (near_read(m, f->vpset, v, index, out))
        return MACHINE_OK;
    v = materialise(m, f->vpset, v);
    if (!v)
        return m->status;
    size_t element = type_bytes(type);
    unsigned char raw[16] = {0};
    enum machine_status status =
        device_read(m, v->buffer, geometry_place(&m->values->sets[f->vpset], index) * element,
                    raw, element, "reading a processor");
    memcpy(&out->lo, raw, 8);
    memcpy(&out->hi, raw + 8, 8);
    return status;
}

/* Copies the content to a buffer with no other reference. */
static struct machine_value *own_copy(struct machine *m, int set, struct machine_value *v)
{
    struct rows rows = geometry_rows(&m->values->sets[set], v->type);
    struct device_buffer *b = device_rows_get(m, rows);
    if (!b)
        return NULL;
    if (device_copy(m, v->buffer, b, rows.bytes, "copying a field")) {
        device_buffer_unref(m, b);
        return NULL;
    }
    return graph_buffer_node(m, v->type, set, b);
}

struct machine_value *observe_own(struct machine *m, const struct field *f, uint32_t offset,
                                  struct machine_value *v)
{
    values_before_change(m);
    if (v->op == NODE_BUFFER)
        known_addresses_changed(m, v->buffer);
    /* The slot's reference, and those of this call. An evaluation within an instruction may
     * have entered a state, so what the instruction made before and what the field holds are
     * two values with one array. */
    if (v->op != NODE_BUFFER || v->own_address || v->buffer->refs > 1 || v->buffer->blocks ||
        v->refs > graph_borrowed(m, v) + 1 || !field_holds(f, offset, v))
        return own_copy(m, f->vpset, v);
    return v;
}

enum machine_status machine_field_write(struct machine *m, uint32_t field,
                                        struct machine_type type, uint64_t index,
                                        struct machine_scalar value)
{
    uint32_t offset;
    if (type.s && type_good(type)) {
        value = (struct machine_scalar){type_packed_bits(value.lo, type), 0};
        type = MACHINE_UINT(machine_type_bits(type));
    }
    struct field *f = observe_field(m, field, type, &offset);
    if (!f)
        return m->status;
    const struct vpset *s = &m->values->sets[f->vpset];
    if (index >= s->count)
        return machine_fail(m, MACHINE_BAD_ARGUMENT, "there is no processor %llu",
                            (unsigned long long)index);
    struct machine_value *v = machine_field_value(m, field, type, MACHINE_EVERYWHERE);
    enum machine_status status;
    if (v && f->base + offset == field && !beyond_field(m, field, (uint32_t)type.width) &&
        gather_write(m, f, offset, v, index, value, &status))
        return status;
    v = v ? materialise(m, f->vpset, v) : NULL;
    if (!v)
        return m->status;
    bool strange = v->strange_nan || materialise_has_strange_nan(type, &value.lo, 1);
    v = observe_own(m, f, offset, v);
    if (!v)
        return m->status;
    v->strange_nan = strange;
    size_t element = type_bytes(type), places[3];
    unsigned char raw[16];
    materialise_put(raw, scalar_cut(value, type.width), element);
    int count = gather_places(s, index, places);
    for (int i = 0; i < count; i++)
        if (device_write(m, v->buffer, places[i] * element, raw, element,
                         "writing a processor"))
            return m->status;
    return machine_field_store(m, field, v, MACHINE_EVERYWHERE);
}

/* ---- reductions ---- */

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

static bool is_everywhere(const struct machine_value *context)
{
    return !context || value_is_one_bit(context);
}

/* On the front end: of numbers in memory that are few, or were only made longer since, in
 * processors that a context in memory says. False: it is not so. */
static bool reduce_near(struct machine *m, const struct vpset *s, struct machine_value *v,
                        const struct machine_value *context, const struct reduction_info *info,
                        struct machine_scalar identity, struct machine_scalar *out)
{
    struct near_sum w = {.op = info->op,
                         .is_float = v->type.kind == MACHINE_FLOAT,
                         .flip = info->is_signed ? scalar_sign(v->type.width)
                                                 : (struct machine_scalar){0, 0},
                         .identity = identity};
    const struct machine_value *in = made_longer(v);
    bool all = is_everywhere(context);
    if (!m->settings.near)
        return false;
    w.extends = in != v && v->op == NODE_SIGN_EXTEND;
    if (!in->buffer || (in->type.kind == MACHINE_FLOAT) != w.is_float ||
        (!all && !context->buffer))
        return false;
    w.plain = in == v || (info->op == REDUCE_ADD && !w.extends);
    w.width = in->type.width;
    w.element = type_bytes(in->type);
    w.numbers = in->buffer;
    w.context = all ? NULL : context->buffer;
    size_t count = ((size_t)s->width + REDUCE_RUN - 1) / REDUCE_RUN * s->rows;
    struct machine_scalar few[64], *sums = count <= 64 ? few : malloc(count * sizeof *sums);
    bool good = sums && near_sums(m, s, &w, REDUCE_RUN, sums);
    if (good)
        *out = join_runs(info->op, v->type, sums, count);
    if (sums != few)
        free(sums);
    return good;
}

static enum machine_status reduce_buffer(struct machine *m, const struct vpset *s,
                                         struct machine_value *v, enum reduction_op op,
                                         struct machine_scalar identity,
                                         struct machine_scalar *out)
{
    bool is_float = v->type.kind == MACHINE_FLOAT, wide = type_bytes(v->type) == 16;
    const char *real = v->type.width == 32 ? "float" : "double";
    char options[96];
    snprintf(options, sizeof options, "-DKIND=%d -DOP=%d -DELEMENT=%s -DACC=%s",
             wide ? 2 : is_float, op,
             is_float ? real
             : wide   ? "ulong"
                      : call_element(type_bytes(v->type)),
             is_float ? real : "ulong");
    struct kernel_call c = call_begin(m, kernel_reduce_cl, options, "reduce");
    size_t runs = ((size_t)s->width + REDUCE_RUN - 1) / REDUCE_RUN, count = runs * s->rows;
    size_t element = is_float ? type_bytes(v->type) : wide ? 16 : 8;
    struct device_buffer *b = c.kernel ? device_buffer_get(m, count * element) : NULL;
    unsigned char *raw = b ? malloc(count * element) : NULL;
    struct machine_scalar *sums = raw ? malloc(count * sizeof *sums) : NULL;
    if (!sums) {
        if (b)
            device_buffer_unref(m, b);
        free(raw);
        return m->status ? m->status
                         : machine_fail(m, MACHINE_NO_MEMORY, "not enough memory to reduce");
    }
    call_layout(&c, s);
    call_int(&c, REDUCE_RUN);
    call_argument(&c, element > 8 ? 8 : element, &identity.lo);
    if (wide)
        call_ulong(&c, identity.hi);
    call_buffer(&c, v->buffer);
    call_buffer(&c, b);
    double start = device_wait_begin(m);
    enum machine_status status = call_start(&c, m, runs, s->rows, "reducing");
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
    if (!status)
        *out = join_runs(op, v->type, sums, count);
    device_buffer_unref(m, b);
    free(raw);
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
    return evaluate_values(m, &in, 1, false) == MACHINE_OK && in->buffer;
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
    if (held == in || evaluate_values(m, values, 2, false) || !held->buffer || !context->buffer)
        return false;
    if (in != *value)
        held = machine_resize(m, held, (*value)->type.width, (*value)->op == NODE_SIGN_EXTEND);
    *value = held;
    return held != NULL;
}

/* Selected under the context by an evaluation, and then on the device unless that is slower. */
static enum machine_status
reduce_far(struct machine *m, const struct vpset *s, struct machine_value *value,
           struct machine_value *context, const struct reduction_info *info,
           struct machine_scalar identity, struct machine_scalar *out)
{
    struct machine_type type = value->type;
    if (info->is_signed) /* in another order: the sign bit turned over */
        value = machine_binary(m, MACHINE_XOR, value,
                               machine_constant(m, type, scalar_sign(type.width)));
    struct machine_value *none = machine_constant(m, type, identity);
    value = value && none ? machine_select(m, context, value, none) : NULL;
    value = value ? materialise(m, m->values->set_current, value) : NULL;
    struct reduction_info unsigned_order = {info->op, info->is_float, false};
    if (!value)
        return m->status;
    return reduce_near(m, s, value, NULL, &unsigned_order, identity, out)
               ? MACHINE_OK
               : reduce_buffer(m, s, value, info->op, identity, out);
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
    struct vpset *s = vpset_get(m, m->values->set_current);
    if (!value || !s)
        return m->status;
    if ((unsigned)op >= sizeof reductions / sizeof *reductions ||
        reductions[op].is_float != (value->type.kind == MACHINE_FLOAT))
        return machine_fail(m, MACHINE_BAD_ARGUMENT,
                            "this reduction does not take values of this type");
    if (value->set && value->set != m->values->set_current)
        return machine_fail(m, MACHINE_BAD_ARGUMENT, "the value belongs to another VP set");
    const struct reduction_info *info = &reductions[op];
    struct machine_type type = value->type;
    struct machine_scalar identity = identity_of(info, type);
    struct machine_value *context = flag_held(m, m->values->set_current, MACHINE_CONTEXT);
    if (!reduce_near(m, s, value, context, info, identity, out) &&
        !(held_near(m, &value, context) &&
          reduce_near(m, s, value, context, info, identity, out)) &&
        !(brought_near(m, value, context) &&
          reduce_near(m, s, value, context, info, identity, out)) &&
        reduce_far(m, s, value, context, info, identity, out))
        return m->status;
    return reduce_end(info, type, out);
}
