/* scan.c - scans and spreads along an axis, by hand-written kernels; does not wait.
 *
 * Operands are converted to forms for which few kernels suffice (kernels/scan.cl): minimum and
 * maximum of any type become a minimum of unsigned integers in another order; "and" becomes
 * "or" of complements; elements have 32, 64 or 128 bits. Integers of more than 16 bits are used
 * as they are in memory. Other conversions are ordinary values, which are fused with the
 * operations around them. Long lines are divided into runs: see kernels/scan.cl. For floats
 * machine_scan() specifies the length of a run; else the device does.
 */
#include "ops/scan.h"

#include <math.h>
#include <stdio.h>

#include "base/errors.h"
#include "base/scalar.h"
#include "base/types.h"
#include "kernels.h"
#include "memory/memory.h"
#include "ops/near.h"
#include "ops/near_lines.h"
#include "ops/near_loops.h"
#include "ops/spreads.h"
#include "run/materialise.h"
#include "values/graph.h"

enum { RUN_FLOATS = 512, LANES = 16 };
enum { JOINS, FINISHES, FILLS };
enum { UINT32, UINT64, UINT128, FLOAT32, FLOAT64 };

static const struct element elements[] = {
    [UINT32] = {"uint", "int", 0, 4},      [UINT64] = {"ulong", "long", 0, 8},
    [UINT128] = {"ulong2", "long", 2, 16}, [FLOAT32] = {"float", "int", 1, 4},
    [FLOAT64] = {"double", "long", 1, 8},
};

/* ---- lines and launches ---- */

static struct device_buffer *buffer_for(struct machine *m, const struct element *e)
{
    const struct vpset *s = &m->values->sets[m->values->set_current];
    return device_rows_get(m, geometry_rows(s, MACHINE_UINT(8 * (int)e->bytes)));
}

struct lines lines_of(const struct vpset *s, int axis, bool downward)
{
    struct lines l = {.base = (cl_ulong)s->halo,
                      .inner_stride = s->pitch,
                      .inner = (size_t)s->rows,
                      .outer = 1,
                      .length = s->dimensions[axis],
                      .columns = 1,
                      .width = s->width,
                      .halo = s->halo,
                      .along = axis == s->rank - 1};
    size_t step = 1;
    if (!l.along) {
        l.columns = s->width;
        l.inner = 1;
        for (int a = axis + 1; a < s->rank - 1; a++)
            l.inner *= (size_t)s->dimensions[a];
        l.outer = s->rows / l.inner / (size_t)l.length;
        step = l.inner * s->pitch;
        l.outer_stride = step * (size_t)l.length;
    }
    l.step = (cl_long)step;
    if (downward) {
        l.base += step * (size_t)(l.length - 1);
        l.step = -l.step;
    }
    return l;
}

static struct kernel_call part(struct machine *m, int number, const struct element *e,
                               int lanes)
{
    char options[96];
    snprintf(options, sizeof options, "-DPART=%d -DTYPE=%s -DMASK=%s -DKIND=%d -DLANES=%d",
             number, e->name, e->mask, e->kind, lanes);
    return call_begin(m, kernel_scan_cl, options, "scan");
}

/* How many neighbouring lines a work-item handles. */
static int lanes_of(const struct lines *l, const struct element *e)
{
    return !l->along && l->columns >= LANES && e->kind != 2 ? LANES : 1;
}

static size_t rows_of(const struct lines *l, int lanes)
{
    return l->inner * (((size_t)l->columns + (size_t)lanes - 1) / (size_t)lanes);
}

static int run_of(const struct machine *m, const struct lines *l, const struct element *e)
{
    if (e->kind == 1)
        return RUN_FLOATS;
    if (m->device->shape.scan_run)
        return m->device->shape.scan_run;
    int runs = 4 * m->device->units, run = (l->length - 1) / runs + 1,
        least = m->device->shape.scan_run_least;
    return run < least ? least : run;
}

static enum machine_status scan_runs(struct machine *m, const struct lines *l,
                                     const struct line_scan *j, int run, int runs,
                                     struct device_buffer *totals, struct device_buffer *firsts)
{
    const struct element *e = j->element;
    int lanes = lanes_of(l, e);
    struct kernel_call c = part(m, 0, e, lanes);
    call_lines(&c, l, run);
    call_lines_rows(&c, l);
    const int numbers[] = {(int)j->op, j->exclusive, j->context != NULL, j->bits != NULL,
                           j->starts,  j->backward,  totals != NULL};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        call_int(&c, numbers[i]);
    call_argument(&c, e->bytes, &j->identity);
    call_argument(&c, e->bytes, &j->flip);
    call_argument(&c, e->bytes, &j->cut);
    call_buffer(&c, j->in);
    call_buffer(&c, j->context ? j->context : j->in);
    call_buffer(&c, j->bits ? j->bits : j->in);
    call_buffer(&c, j->out);
    call_buffer(&c, totals ? totals : j->out);
    call_buffer(&c, totals ? firsts : j->out);
    return call_start_3d(&c, m, (size_t)runs, rows_of(l, lanes), l->outer, "scanning");
}

/* Runs a stage: JOINS, FINISHES or FILLS. The last takes what is in sums. */
static enum machine_status scan_stage(struct machine *m, const struct lines *l,
                                      const struct line_scan *j, int stage, int run, int runs,
                                      struct origin from, struct device_buffer *totals,
                                      struct device_buffer *firsts)
{
    const struct element *e = j->element;
    int lanes = stage == FILLS && e->kind == 0 ? lanes_of(l, e) : 1;
    struct kernel_call c = part(m, 1, e, 1);
    call_lines(&c, l, run);
    call_lines_rows(&c, l);
    const int numbers[] = {lanes, stage, runs, (int)j->op, j->sums != NULL};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        call_int(&c, numbers[i]);
    call_argument(&c, e->bytes, &j->identity);
    call_argument(&c, e->bytes, &j->flip);
    call_argument(&c, e->bytes, &j->cut);
    call_ulong(&c, from.base);
    call_ulong(&c, from.inner);
    call_ulong(&c, from.outer);
    call_buffer(&c, j->out);
    call_buffer(&c, totals ? totals : j->out);
    call_buffer(&c, firsts ? firsts : j->out);
    call_buffer(&c, j->sums ? j->sums : j->out);
    if (stage == JOINS)
        return call_start_3d(&c, m, (size_t)l->columns, l->inner * l->outer, 1, "scanning");
    return call_start_3d(&c, m, (size_t)runs, rows_of(l, lanes), l->outer, "scanning");
}

static double elements_of(const struct lines *l)
{
    return (double)lines_count(l) * (double)l->length;
}

/* How many parts to make of lines. Those that are fewer than the threads are cut, and then read
 * twice (near_lines.c): that pays where the threads are at work anyway, and have parts of the
 * line in their caches; else in long loops, or for more threads than two. */
static int parts_of(const struct machine *m, const struct lines *l, const struct line_scan *j)
{
    const struct device_shape *shape = &m->device->shape;
    const size_t threads = (size_t)crew_size(m->device->crew);
    const bool vectors = near_loops_by_vectors(j, (ptrdiff_t)l->step);
    const double ns = vectors ? shape->scan_vector_ns : shape->scan_ns;
    struct crew_costs costs = shape->share;
    if (lines_count(l) < threads)
        costs.asleep = vectors && threads < 3 ? INFINITY : shape->scan_cut_ns;
    return device_parts_at(m, 1e-9 * ns * elements_of(l), &costs);
}

static enum machine_status scan_lines(struct machine *m, const struct lines *l,
                                      const struct line_scan *j)
{
    const struct element *e = j->element;
    int run = run_of(m, l, e), runs = (l->length - 1) / run + 1;
    double start;
    if (near_begin(m, j->out, &start)) {
        near_lines_scan(m->device->crew, parts_of(m, l, j), l, j, run);
        near_end(m, "scanning", start);
        return MACHINE_OK;
    }
    bool joins = runs > 1 || j->sums;
    size_t count = (size_t)runs * lines_count(l);
    const struct origin none = {0, 0, 0};
    struct device_buffer *totals = joins ? device_buffer_get(m, count * e->bytes) : NULL;
    struct device_buffer *firsts =
        totals ? device_buffer_get(m, count * sizeof(cl_uint)) : NULL;
    enum machine_status status = joins && !firsts ? m->status : MACHINE_OK;
    if (!status)
        status = scan_runs(m, l, j, run, runs, totals, firsts);
    if (!status && joins)
        status = scan_stage(m, l, j, JOINS, run, runs, none, totals, firsts);
    if (!status && runs > 1 && !j->sums)
        status = scan_stage(m, l, j, FINISHES, run, runs, none, totals, firsts);
    if (totals)
        device_buffer_unref(m, totals);
    if (firsts)
        device_buffer_unref(m, firsts);
    device_flush(m);
    return status;
}

enum machine_status lines_sum_up(struct machine *m, struct device_buffer *b, size_t lines,
                                 size_t length)
{
    struct lines l = {.step = 1,
                      .inner_stride = length,
                      .inner = lines,
                      .outer = 1,
                      .length = (cl_int)length,
                      .columns = 1,
                      .width = (cl_int)length,
                      .along = 1};
    struct line_scan j = {.element = &elements[UINT32],
                          .op = LINES_ADD,
                          .exclusive = true,
                          .cut = {UINT32_MAX, 0},
                          .in = b,
                          .out = b};
    return scan_lines(m, &l, &j);
}

/* Fills each line with one of its elements, given by `from`. */
static enum machine_status fill_lines(struct machine *m, const struct lines *l,
                                      const struct element *e, struct device_buffer *from,
                                      struct origin origin, struct device_buffer *out)
{
    /* floats are copied as integers */
    const struct element *same = &elements[e->bytes == 4   ? UINT32
                                           : e->bytes == 8 ? UINT64
                                                           : UINT128];
    double start;
    if (near_begin(m, out, &start)) {
        int parts = device_parts(m, 1e-9 * m->device->shape.fill_ns * elements_of(l));
        near_lines_fill(m->device->crew, parts, l, e->bytes, from, origin, out);
        near_end(m, "scanning", start);
        return MACHINE_OK;
    }
    struct line_scan j = {.element = same, .out = out, .sums = from};
    int run = m->device->shape.fill_run, runs = (l->length - 1) / run + 1;
    return scan_stage(m, l, &j, FILLS, run, runs, origin, NULL, NULL);
}

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
    return &elements[width <= 32 ? UINT32 : width <= 64 ? UINT64 : UINT128];
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
        f->element = &elements[single ? FLOAT32 : FLOAT64];
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

/* ---- scans ---- */

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
    if (!values[0] || !materialise_all(m, m->values->set_current, values, count))
        return NULL;
    s = &m->values->sets[m->values->set_current];
    struct device_buffer *out = buffer_for(m, f.element);
    if (!out)
        return NULL;
    struct lines l = lines_of(s, how->axis, how->downward);
    struct line_scan j = {
        .element = f.element,
        .op = f.op,
        .exclusive = how->exclusive,
        .streams = shape_streams_lanes(&m->device->shape,
                                       2 * (double)s->count * (double)f.element->bytes),
        .starts = how->segments == MACHINE_START_BIT,
        .backward = bits && how->segments == MACHINE_SEGMENT_BIT && how->downward,
        .identity = f.identity,
        .flip = f.flip,
        .cut = f.cut,
        .in = values[0]->buffer,
        .context = masked ? values[masked]->buffer : NULL,
        .bits = bits ? values[bits]->buffer : NULL,
        .out = out};
    if (scan_lines(m, &l, &j)) {
        device_buffer_unref(m, out);
        return NULL;
    }
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
    bool masked = !is_constant(context, 1);
    if (!values[0] || !materialise_all(m, m->values->set_current, values, 1 + masked))
        return NULL;
    s = &m->values->sets[m->values->set_current];
    struct device_buffer *out = values[0]->buffer;
    device_buffer_ref(out);
    for (int axis = s->rank - 1; axis >= 0; axis--) {
        if (!(axes >> axis & 1))
            continue;
        struct lines l = lines_of(s, axis, false);
        struct device_buffer *in = out;
        struct device_buffer *sums = device_buffer_get(m, lines_count(&l) * f.element->bytes);
        out = sums ? buffer_for(m, f.element) : NULL;
        struct line_scan j = {.element = f.element,
                              .op = f.op,
                              .identity = f.identity,
                              .flip = f.flip,
                              .cut = f.cut,
                              .in = in,
                              .context = masked ? values[1]->buffer : NULL,
                              .out = out,
                              .sums = sums};
        struct origin from = {0, (cl_ulong)l.columns, l.inner * (cl_ulong)l.columns};
        bool good =
            out && !scan_lines(m, &l, &j) && !fill_lines(m, &l, f.element, sums, from, out);
        masked = false; /* all processors have an element now */
        device_buffer_unref(m, in);
        if (sums)
            device_buffer_unref(m, sums);
        if (!good) {
            if (out)
                device_buffer_unref(m, out);
            return NULL;
        }
    }
    device_flush(m);
    return shown(m, &f, m->values->set_current, out);
}

/* Fills the lines with elements of the value itself. */
static struct machine_value *spread_copy(struct machine *m, const struct lines *l,
                                         struct origin from, struct machine_value *value)
{
    struct form f;
    struct machine_value *v = formed(m, MACHINE_SCAN_COPY, value, &f);
    if (!v || !materialise_all(m, m->values->set_current, &v, 1))
        return NULL;
    struct device_buffer *out = buffer_for(m, f.element);
    if (!out)
        return NULL;
    if (fill_lines(m, l, f.element, v->buffer, from, out)) {
        device_buffer_unref(m, out);
        return NULL;
    }
    device_flush(m);
    return shown(m, &f, m->values->set_current, out);
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
    struct lines l = lines_of(s, axis, false);
    struct origin from = {l.base + (cl_ulong)coordinate * (cl_ulong)l.step, l.inner_stride,
                          l.outer_stride};
    return spread_copy(m, &l, from, value);
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
    uint64_t width = (uint64_t)s->width;
    struct lines l = lines_of(s, s->rank - 1, false);
    struct origin from = {index / width * s->pitch + l.base + index % width, 0, 0};
    return spread_copy(m, &l, from, value);
}
