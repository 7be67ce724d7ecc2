/* scan.c - scans and spreads along an axis, by hand-written kernels; does not wait.
 *
 * Operands are converted to forms for which few kernels suffice (kernels/scan.cl): minimum and
 * maximum of any type become a minimum of unsigned integers in another order; "and" becomes
 * "or" of complements; elements have 32, 64 or 128 bits. Integers of more than 16 bits are used
 * as they are in memory. Other conversions are ordinary values, which are fused with the
 * operations around them.
 *
 * Lines along an axis that is not cut into blocks (sequencers/) lie in one block each: every
 * block's arrays are scanned by themselves, ghosts too. Along the one that is cut, columns of
 * all blocks are brought together, scanned, and put back; where there is one axis, what comes
 * before each block is found first (lines_chain()). */
#include <string.h>

#include "ops/scan.h"

#include "base/errors.h"
#include "base/scalar.h"
#include "base/types.h"
#include "memory/memory.h"
#include "ops/spreads.h"
#include "run/materialise.h"
#include "sequencers/sequencers.h"
#include "values/graph.h"

/* ---- what is combined, and how it is shown ---- */

struct form {
    struct machine_type type; /* of the original value */
    int width;                /* of the original value */
    const struct element *element;
    enum lines_op op;
    bool ordered_floats;
    struct machine_scalar identity, flip, cut; /* as unsigned integers: see kernels/scan.cl */
};

static const struct element *bits_element(int width)
{
    return &lines_elements[width <= 32   ? LINES_UINT32
                           : width <= 64 ? LINES_UINT64
                                         : LINES_UINT128];
}

static struct machine_value *flipped(struct machine *m, struct machine_value *v,
                                     struct machine_scalar by)
{
    if (!v || !(by.lo | by.hi))
        return v;
    return machine_binary(m, MACHINE_XOR, v, machine_constant(m, v->type, by));
}

/* Floats of other formats are computed in double. */
static struct machine_value *native_float(struct machine *m, struct machine_value *v)
{
    return machine_to_float(m, v, v->type.width == 32 ? MACHINE_F32 : MACHINE_F64, false);
}

struct machine_value *float_order(struct machine *m, struct machine_value *v, uint64_t nan)
{
    int width = v->type.width;
    struct machine_value *is_nan = machine_binary(m, MACHINE_FNE, v, v);
    struct machine_value *bits = machine_reinterpret(m, v, MACHINE_UINT(width));
    struct machine_value *negative = machine_extract(m, bits, width - 1, 1);
    struct machine_value *order = machine_select(
        m, negative, machine_unary(m, MACHINE_NOT, bits), flipped(m, bits, scalar_sign(width)));
    struct machine_scalar last = {nan, 0};
    return machine_select(m, is_nan, machine_constant(m, MACHINE_UINT(width), last), order);
}

static struct machine_value *float_unordered(struct machine *m, struct machine_value *order)
{
    int width = order->type.width;
    struct machine_value *bits = machine_select(m, machine_extract(m, order, width - 1, 1),
                                                flipped(m, order, scalar_sign(width)),
                                                machine_unary(m, MACHINE_NOT, order));
    return machine_reinterpret(m, bits, width == 32 ? MACHINE_F32 : MACHINE_F64);
}

static bool op_fits(enum machine_scan_op c, struct machine_type type)
{
    bool of_floats = c == MACHINE_SCAN_FADD || c == MACHINE_SCAN_FMUL ||
                     c == MACHINE_SCAN_FMIN || c == MACHINE_SCAN_FMAX;
    return c == MACHINE_SCAN_COPY || of_floats == (type.kind == MACHINE_FLOAT);
}

/* Converts the value to the kernels' form, ignoring context and segments. */
static struct machine_value *formed(struct machine *m, enum machine_scan_op c,
                                    struct machine_value *v, struct form *f)
{
    *f = (struct form){.type = v->type, .width = v->type.width};
    if (v->type.kind == MACHINE_FLOAT && !(v = native_float(m, v)))
        return NULL;
    if (c == MACHINE_SCAN_FADD || c == MACHINE_SCAN_FMUL) {
        bool single = f->width == 32;
        f->element = &lines_elements[single ? LINES_FLOAT32 : LINES_FLOAT64];
        f->op = c == MACHINE_SCAN_FADD ? LINES_ADD : LINES_MULTIPLY;
        if (f->op == LINES_MULTIPLY)
            f->identity.lo = single ? 0x3f800000u : 0x3ff0000000000000u;
        return v ? in_memory(m, v) : NULL;
    }
    f->element = bits_element(f->width);
    f->cut = scalar_ones(f->width);
    struct machine_scalar all = scalar_ones(f->width), sign = scalar_sign(f->width);
    switch (c) {
    case MACHINE_SCAN_FMIN:
    case MACHINE_SCAN_FMAX:
        /* the identity is +infinity in one order and -infinity in the reverse: the same key */
        f->ordered_floats = true;
        f->op = LINES_MIN;
        f->identity.lo = f->width == 32 ? 0xff800000u : 0xfff0000000000000u;
        if (c == MACHINE_SCAN_FMAX)
            f->flip = all;
        v = float_order(m, v, (f->identity.lo ^ f->flip.lo) & all.lo);
        break;
    case MACHINE_SCAN_AND:
        f->op = LINES_OR;
        f->flip = all;
        break;
    case MACHINE_SCAN_OR:
        f->op = LINES_OR;
        break;
    case MACHINE_SCAN_XOR:
        f->op = LINES_XOR;
        break;
    case MACHINE_SCAN_ADD:
        f->op = LINES_ADD;
        break;
    case MACHINE_SCAN_UMIN:
    case MACHINE_SCAN_UMAX:
    case MACHINE_SCAN_SMIN:
    case MACHINE_SCAN_SMAX:
        f->op = LINES_MIN;
        f->identity = all;
        if (c == MACHINE_SCAN_UMAX || c == MACHINE_SCAN_SMAX)
            f->flip = all;
        if (c == MACHINE_SCAN_SMIN || c == MACHINE_SCAN_SMAX) {
            f->flip.lo ^= sign.lo;
            f->flip.hi ^= sign.hi;
        }
        break;
    case MACHINE_SCAN_COPY:
    case MACHINE_SCAN_FADD:
    case MACHINE_SCAN_FMUL:
        v = v ? machine_reinterpret(m, v, MACHINE_UINT(v->type.width)) : NULL;
        f->op = LINES_COPY;
        break;
    }
    v = v ? in_memory(m, v) : NULL;
    return v && type_bytes(v->type) != f->element->bytes ? machine_resize(m, v, 32, false) : v;
}

/* Converts a kernel's result back to the original type. */
static struct machine_value *shown(struct machine *m, const struct form *f, int set,
                                   struct device_buffer *b)
{
    struct machine_type plain = f->width == 32 ? MACHINE_F32 : MACHINE_F64;
    if (f->element->kind == 1)
        return machine_to_float(m, graph_buffer_node(m, plain, set, b), f->type, false);
    if (f->op == LINES_COPY && f->type.kind == MACHINE_FLOAT)
        return machine_to_float(m, graph_buffer_node(m, plain, set, b), f->type, false);
    struct machine_type stored = MACHINE_UINT(f->width > 16 ? f->width : 32);
    struct machine_value *v =
        machine_resize(m, graph_buffer_node(m, stored, set, b), f->width, false);
    if (v && f->ordered_floats)
        v = machine_to_float(m, float_unordered(m, v), f->type, false);
    return v;
}

static struct machine_value *wrong(struct machine *m, const char *what)
{
    machine_fail(m, MACHINE_BAD_ARGUMENT, "%s", what);
    return NULL;
}

bool scan_arguments_good(struct machine *m, const struct vpset *s, int axis,
                         const struct machine_value *value, const struct machine_value *bits)
{
    const char *what = NULL;
    if (axis < 0 || axis >= s->rank)
        what = "there is no such axis";
    else if ((value->set && value->set != m->values->set_current) ||
             (bits && bits->set && bits->set != m->values->set_current))
        what = "the value belongs to another VP set";
    else if (bits && !type_equal(bits->type, MACHINE_BIT))
        what = "segments begin at bits";
    return !what || wrong(m, what);
}

static bool is_constant(const struct machine_value *v, uint64_t bits)
{
    return v->op == NODE_CONSTANT && !v->buffer && v->imm.lo == bits && !v->imm.hi;
}

/* ---- work on one array, or on each block's ---- */

static struct machine_type type_of(const struct element *e)
{
    return MACHINE_UINT(8 * (int)e->bytes);
}

static struct device_buffer *array_for(struct machine *m, const struct vpset *s,
                                       const struct element *e)
{
    return device_rows_get(m, geometry_rows(s, type_of(e)));
}

/* ---- scans ---- */

struct scan_work {
    struct line_scan scan; /* without arrays */
    int axis;
    bool downward;
};

/* Of elements, the context, and bits. */
static struct device_buffer *scan_work(struct machine *m, const struct vpset *s,
                                       struct device_buffer *const *in, const void *of)
{
    const struct scan_work *w = of;
    const struct lines l = lines_of(s, w->axis, w->downward);
    struct line_scan j = w->scan;
    j.in = in[0];
    j.context = in[1];
    j.bits = in[2];
    j.out = array_for(m, s, j.element);
    if (j.out && lines_scan(m, &l, &j)) {
        device_buffer_unref(m, j.out);
        return NULL;
    }
    return j.out;
}

struct machine_value *scan_boundaries(struct machine *m, const struct machine_scan *how)
{
    struct machine_value *bits = how->bits;
    if (how->segments == MACHINE_UNSEGMENTED || !bits)
        return NULL;
    if (how->segments == MACHINE_START_BIT)
        return machine_binary(m, MACHINE_AND, bits,
                              flag_held(m, m->values->set_current, MACHINE_CONTEXT));
    return bits;
}

struct machine_value *scan_where(struct machine *m, const struct machine_scan *how,
                                 struct machine_value *value, struct machine_value *context)
{
    struct vpset *s = vpset_get(m, m->values->set_current);
    bool segmented = how->segments != MACHINE_UNSEGMENTED;
    if (!value || !context || !s || (segmented && !how->bits))
        return NULL;
    if (!scan_arguments_good(m, s, how->axis, value, segmented ? how->bits : NULL))
        return NULL;
    if (!op_fits(how->op, value->type))
        return wrong(m, "this scan does not take values of this type");
    if (!is_constant(context, 1))
        value = materialise_instead(m, value, context);
    const bool ranks = how->op == MACHINE_SCAN_ADD && is_constant(value, 1) && !segmented &&
                       how->exclusive && !how->downward;
    struct form f;
    struct machine_value *values[3] = {formed(m, how->op, value, &f)};
    int count = 1, masked = 0, bits = 0;
    if (!is_constant(context, 1))
        values[masked = count++] = context;
    if (segmented && !is_constant(how->bits, 0))
        values[bits = count++] = how->bits;
    if (!values[0] || !materialise_all_in_blocks(m, m->values->set_current, values, count))
        return NULL;
    s = &m->values->sets[m->values->set_current];
    const struct scan_work w = {
        .scan = {.element = f.element,
                 .op = f.op,
                 .exclusive = how->exclusive,
                 .streams = shape_streams_lanes(
                     &m->device->shape, 2 * (double)s->count * (double)f.element->bytes),
                 .starts = how->segments == MACHINE_START_BIT,
                 .backward = bits && how->segments == MACHINE_SEGMENT_BIT && how->downward,
                 .identity = f.identity,
                 .flip = f.flip,
                 .cut = f.cut},
        .axis = how->axis,
        .downward = how->downward};
    struct machine_value *const in[3] = {values[0], masked ? values[masked] : NULL,
                                         bits ? values[bits] : NULL};
    struct device_buffer *out =
        sequencers_have(m, in, 3) && lines_can_chain(m, &w.scan, how->downward)
            ? lines_chain(m, type_of(f.element), &w.scan, how->downward, in)
            : lines_worked(m, type_of(f.element), in, 3, how->axis == 0,
                           &(struct lines_job){LINES_SCANS, scan_work, &w, sizeof w});
    if (!out)
        return NULL;
    struct machine_value *v = shown(m, &f, m->values->set_current, out);
    if (v && ranks && s->rank == 1 && masked && values[masked]->buffer)
        known_ranks_note(m, v, values[masked]);
    return v;
}

struct machine_value *machine_scan(struct machine *m, const struct machine_scan *how,
                                   struct machine_value *value)
{
    struct vpset *s = vpset_get(m, m->values->set_current);
    return s ? scan_where(m, how, value, flag_held(m, m->values->set_current, MACHINE_CONTEXT))
             : NULL;
}

/* ---- spreads ---- */

struct spread_work {
    struct line_scan scan; /* without arrays */
    uint32_t axes;
};

/* Along one axis. NULL: error set. */
static struct device_buffer *spread_along(struct machine *m, const struct vpset *s, int axis,
                                          struct line_scan j)
{
    const struct lines l = lines_of(s, axis, false);
    const struct origin from = {0, (cl_ulong)l.columns, l.inner * (cl_ulong)l.columns};
    j.sums = device_buffer_get(m, lines_count(&l) * j.element->bytes);
    j.out = j.sums ? array_for(m, s, j.element) : NULL;
    const bool good =
        j.out && !lines_scan(m, &l, &j) && !lines_fill(m, &l, j.element, j.sums, from, j.out);
    if (j.sums)
        device_buffer_unref(m, j.sums);
    if (j.out && !good)
        device_buffer_unref(m, j.out);
    return good ? j.out : NULL;
}

/* Of elements, and the context. */
static struct device_buffer *spread_work(struct machine *m, const struct vpset *s,
                                         struct device_buffer *const *in, const void *of)
{
    const struct spread_work *w = of;
    struct line_scan j = w->scan;
    struct device_buffer *out = in[0];
    device_buffer_ref(out);
    j.context = in[1];
    for (int axis = s->rank - 1; axis >= 0 && out; axis--) {
        if (!(w->axes >> axis & 1))
            continue;
        struct device_buffer *before = out;
        j.in = before;
        out = spread_along(m, s, axis, j);
        j.context = NULL; /* all processors have an element now */
        device_buffer_unref(m, before);
    }
    return out;
}

/* Along the axis that is cut apart from the others. NULL: error set. */
static struct device_buffer *spread_all(struct machine *m, struct spread_work *w,
                                        struct machine_value *value,
                                        struct machine_value *context)
{
    const struct element *e = w->scan.element;
    struct machine_value *in[2] = {value, context};
    const uint32_t axes = w->axes;
    const struct lines_job job = {LINES_SPREADS, spread_work, w, sizeof *w};
    if (axes == 1 || !(axes & 1) || !sequencers_have(m, in, 2))
        return lines_worked(m, type_of(e), in, 2, axes & 1, &job);
    w->axes = axes & ~UINT32_C(1);
    struct device_buffer *out = lines_worked(m, type_of(e), in, 2, false, &job);
    if (!out)
        return NULL;
    w->axes = 1;
    in[0] = graph_buffer_node(m, type_of(e), m->values->set_current, out);
    in[1] = NULL;
    return lines_worked(m, type_of(e), in, 2, true, &job);
}

struct machine_value *machine_spread(struct machine *m, enum machine_scan_op op, uint32_t axes,
                                     struct machine_value *value)
{
    struct vpset *s = vpset_get(m, m->values->set_current);
    if (!value || !s || !scan_arguments_good(m, s, 0, value, NULL))
        return NULL;
    if (s->rank < 32 && axes >> s->rank)
        return wrong(m, "there is no such axis");
    if (op == MACHINE_SCAN_COPY || !op_fits(op, value->type))
        return wrong(m, "this spread does not take values of this type");
    if (!axes)
        return value;
    struct form f;
    struct machine_value *context = flag_held(m, m->values->set_current, MACHINE_CONTEXT);
    struct machine_value *values[2] = {formed(m, op, value, &f), context};
    const bool masked = !is_constant(context, 1);
    if (!values[0] || !materialise_all_in_blocks(m, m->values->set_current, values, 1 + masked))
        return NULL;
    struct spread_work w = {.scan = {.element = f.element,
                                     .op = f.op,
                                     .identity = f.identity,
                                     .flip = f.flip,
                                     .cut = f.cut},
                            .axes = axes};
    struct device_buffer *out = spread_all(m, &w, values[0], masked ? values[1] : NULL);
    if (!out)
        return NULL;
    device_flush(m);
    return shown(m, &f, m->values->set_current, out);
}

/* Lines that are filled with one element each. */
struct fill_work {
    const struct element *element;
    int axis;
    size_t coordinate;          /* along the axis, of the elements */
    bool one;                   /* one for all lines: */
    size_t place;               /* in the array */
    struct device_buffer *from; /* the array; NULL: the one at hand */
};

static struct device_buffer *fill_work(struct machine *m, const struct vpset *s,
                                       struct device_buffer *const *in, const void *of)
{
    const struct fill_work *w = of;
    const struct lines l = lines_of(s, w->axis, false);
    const struct origin every = {l.base + w->coordinate * (cl_ulong)l.step, l.inner_stride,
                                 l.outer_stride},
                        one = {w->place, 0, 0};
    struct device_buffer *out = array_for(m, s, w->element);
    if (out &&
        lines_fill(m, &l, w->element, w->from ? w->from : in[0], w->one ? one : every, out)) {
        device_buffer_unref(m, out);
        return NULL;
    }
    return out;
}

struct device_buffer *scan_told(struct machine *m, const struct vpset *s,
                                struct device_buffer *const *in, enum lines_kind kind,
                                const void *bytes, size_t count)
{
    struct scan_work scan;
    struct spread_work spread;
    struct fill_work fill;
    if (kind == LINES_SCANS && count == sizeof scan) {
        memcpy(&scan, bytes, count);
        return lines_element_in(&scan) ? scan_work(m, s, in, &scan) : NULL;
    }
    if (kind == LINES_SPREADS && count == sizeof spread) {
        memcpy(&spread, bytes, count);
        return lines_element_in(&spread) ? spread_work(m, s, in, &spread) : NULL;
    }
    if (kind == LINES_FILLS && count == sizeof fill) {
        memcpy(&fill, bytes, count);
        return lines_element_in(&fill) ? fill_work(m, s, in, &fill) : NULL;
    }
    return NULL;
}

/* With elements of the value itself: of that processor (`one`), or of those at its place on
 * the axis. */
static struct machine_value *spread_copy(struct machine *m, int axis, bool one, uint64_t index,
                                         struct machine_value *value)
{
    const int set = m->values->set_current;
    struct form f;
    struct machine_value *v = formed(m, MACHINE_SCAN_COPY, value, &f), *in[3] = {NULL};
    if (!v || !materialise_all_in_blocks(m, set, &v, 1))
        return NULL;
    const struct vpset *s = &m->values->sets[set];
    struct fill_work w = {.element = f.element, .axis = axis, .one = one};
    if (m->sequencers && !sequencers_are_near(m) && (one || axis == 0) &&
        sequencers_whole(m, v->buffer))
        return NULL;
    in[0] = v;
    if (sequencers_has(m, v) && (one || axis == 0)) {
        const struct owned owned = sequencers_owner(m, v->buffer, index);
        w.from = owned.b;
        w.coordinate = owned.plane;
        w.place = owned.place;
        in[0] = NULL; /* no block's own array */
    } else {
        w.coordinate = geometry_coordinate(s, axis, index);
        w.place = geometry_place(s, index);
    }
    struct device_buffer *out =
        w.from ? sequencers_each(m, set, type_of(f.element), in, 1, fill_work, &w, NULL)
               : lines_worked(m, type_of(f.element), &v, 1, false,
                              &(struct lines_job){LINES_FILLS, fill_work, &w, sizeof w});
    if (!out)
        return NULL;
    device_flush(m);
    return shown(m, &f, set, out);
}

struct machine_value *machine_spread_coordinate(struct machine *m, int axis, int coordinate,
                                                struct machine_value *value)
{
    struct vpset *s = vpset_get(m, m->values->set_current);
    if (!value || !s || !scan_arguments_good(m, s, axis, value, NULL))
        return NULL;
    if (coordinate < 0 || coordinate >= s->dimensions[axis])
        return wrong(m, "there is no such coordinate on the axis");
    struct machine_value *spread = spreads_axis(m, axis, coordinate, value);
    if (spread || m->status)
        return spread;
    uint64_t index = (uint64_t)coordinate;
    for (int a = axis + 1; a < s->rank; a++)
        index *= (uint64_t)s->dimensions[a];
    return spread_copy(m, axis, false, index, value);
}

struct machine_value *machine_spread_index(struct machine *m, uint64_t index,
                                           struct machine_value *value)
{
    struct vpset *s = vpset_get(m, m->values->set_current);
    if (!value || !s || !scan_arguments_good(m, s, 0, value, NULL))
        return NULL;
    if (index >= s->count)
        return wrong(m, "there is no such processor");
    struct machine_value *spread = spreads_index(m, index, value);
    if (spread || m->status)
        return spread;
    return spread_copy(m, s->rank - 1, true, index, value);
}
