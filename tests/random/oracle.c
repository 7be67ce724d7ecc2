/* oracle.c - the Paris machine over plain bit arrays: every bit of every field is a byte.
 *
 *     field: bits[processor * width + bit]
 *
 * An instruction reads all its sources for all processors, then stores under the context. The
 * code is as plain as possible, because it defines what the lazy machine must compute.
 * `sabotage` makes one operation wrong, to test the detector.
 */
#include <stdlib.h>
#include <string.h>

#include "oracle_number.h"
#include "oracle_random.h"

struct oracle_field {
    uint8_t *bits; /* NULL: no such field */
    int width, set, order;
    bool heap;
};

struct oracle_set {
    uint64_t count;
    uint8_t *context, *test, *overflow;
};

struct oracle {
    const struct program *p;
    struct trace *out;
    struct oracle_set sets[PROGRAM_SETS];
    struct oracle_field fields[PROGRAM_SLOTS];
    int set, allocations;
    uint64_t draws;
    enum sabotage sabotage;
};

static void *zeros(uint64_t count)
{
    void *p = calloc(count ? count : 1, 1);

    if (!p)
        abort();
    return p;
}

/* ---- memory ---- */

static wide get(const struct oracle *o, const struct operand *x, uint64_t processor)
{
    const struct oracle_field *f = &o->fields[x->slot];
    const uint8_t *bits = f->bits + processor * (uint64_t)f->width + x->offset;
    wide value = 0;

    for (int k = 0; k < x->bits; k++)
        value |= (wide)bits[k] << k;
    return value;
}

static void put(struct oracle *o, const struct operand *x, uint64_t processor, wide value)
{
    struct oracle_field *f = &o->fields[x->slot];
    uint8_t *bits = f->bits + processor * (uint64_t)f->width + x->offset;

    for (int k = 0; k < x->bits; k++)
        bits[k] = value >> k & 1;
}

static uint64_t processors(const struct oracle *o)
{
    return o->sets[o->set].count;
}

static wide widened(const struct oracle *o, const struct operand *x, uint64_t processor,
                    bool is_signed)
{
    wide value = get(o, x, processor);

    return is_signed ? (wide)wide_signed(value, x->bits) : value;
}

/* ---- the neighbour ---- */

static uint64_t neighbour(const struct oracle *o, uint64_t index, int axis, int step)
{
    const struct geometry *g = &o->p->sets[o->set];
    uint64_t stride = 1, length = (uint64_t)g->lengths[axis], coordinate;

    for (int k = axis + 1; k < g->rank; k++)
        stride *= (uint64_t)g->lengths[k];
    coordinate = index / stride % length;
    if (o->sabotage == SABOTAGE_NEWS && coordinate + 1 == length && step > 0)
        return index;
    return index - coordinate * stride +
           (coordinate + length + (uint64_t)step) % length * stride;
}

static uint64_t coordinate_of(const struct oracle *o, uint64_t index, int axis)
{
    const struct geometry *g = &o->p->sets[o->set];

    for (int k = g->rank - 1; k > axis; k--)
        index /= (uint64_t)g->lengths[k];
    return index % (uint64_t)g->lengths[axis];
}

/* ---- instructions ---- */

/* The value of an instruction that has a destination, in one processor. */
static wide value_of(struct oracle *o, const struct instruction *in, uint64_t n,
                     bool *overflows)
{
    const struct row_info *info = &row_table[in->row];
    bool is_signed = info->number == NUMBER_S;
    enum op op = (enum op)info->op;
    int bits = in->d.bits;

    switch ((int)info->shape) {
    case INT_1:
        return number_integer(op, is_signed, widened(o, &in->d, n, is_signed), 0, bits,
                              overflows);
    case INT_MOVE:
    case INT_MOVE_2L:
        return number_integer(op, is_signed, widened(o, &in->a, n, is_signed), 0, bits,
                              overflows);
    case INT_2:
        return number_integer(op, is_signed, widened(o, &in->d, n, is_signed),
                              widened(o, &in->a, n, is_signed), bits, overflows) ^
               (o->sabotage == SABOTAGE_SUBTRACT && op == OP_SUBTRACT && n == 1);
    case INT_3:
    case INT_3_3L:
        return number_integer(op, is_signed, widened(o, &in->a, n, is_signed),
                              widened(o, &in->b, n, is_signed), bits, overflows);
    case INT_CONSTANT_2:
        return number_integer(op, is_signed, widened(o, &in->d, n, is_signed),
                              (wide)in->constant, bits, overflows);
    case INT_CONSTANT_3:
        return number_integer(op, is_signed, widened(o, &in->a, n, is_signed),
                              (wide)in->constant, bits, overflows);
    case INT_MOVE_CONSTANT:
        return (wide)in->constant & wide_mask(bits);
    case INT_TO_FLOAT:
        return number_from_integer(is_signed, widened(o, &in->a, n, is_signed), bits);
    case FLOAT_TO_INT:
        return number_to_integer(op, is_signed, (uint64_t)get(o, &in->a, n), in->a.bits, bits,
                                 overflows);
    case FLOAT_1:
        return number_float(op, bits, (uint64_t)get(o, &in->d, n), 0, overflows);
    case FLOAT_MOVE:
        return number_float(op, bits, (uint64_t)get(o, &in->a, n), 0, overflows);
    case FLOAT_2:
        return number_float(op, bits, (uint64_t)get(o, &in->d, n), (uint64_t)get(o, &in->a, n),
                            overflows);
    case FLOAT_3:
        return number_float(op, bits, (uint64_t)get(o, &in->a, n), (uint64_t)get(o, &in->b, n),
                            overflows);
    case FLOAT_CONSTANT_2:
        return number_float(op, bits, (uint64_t)get(o, &in->d, n), number_real(in->real, bits),
                            overflows);
    case FLOAT_CONSTANT_3:
        return number_float(op, bits, (uint64_t)get(o, &in->a, n), number_real(in->real, bits),
                            overflows);
    case FLOAT_MOVE_2L:
        return number_resize_float((uint64_t)get(o, &in->a, n), in->a.bits, bits);
    case FLOAT_MOVE_CONSTANT:
        return number_real(in->real, bits);
    case BIT_STORE:
        switch ((int)info->op) {
        case OP_STORE_CONTEXT:
            return o->sets[o->set].context[n];
        case OP_STORE_TEST:
            return o->sets[o->set].test[n];
        case OP_STORE_OVERFLOW:
            return o->sets[o->set].overflow[n];
        default:
            return info->op == OP_SET_BIT;
        }
    case NEWS:
        /* a get reads the neighbour in its direction; a send is a get in the opposite
         * direction */
        if (info->op == OP_GET_NEWS)
            return get(o, &in->a, neighbour(o, n, in->axis, in->direction ? -1 : 1));
        return get(o, &in->a, neighbour(o, n, in->axis, in->direction ? 1 : -1));
    case COORDINATE:
        return coordinate_of(o, n, in->axis);
    case RANDOM:
        return oracle_random(o->p->seed, o->draws, n, bits, (uint64_t)in->constant);
    default:
        abort();
    }
}

static bool stores(const struct oracle *o, const struct instruction *in, uint64_t n)
{
    const struct row_info *info = &row_table[in->row];
    const uint8_t *context = o->sets[o->set].context;

    if (info->op == OP_SEND_NEWS) /* the sender's context decides */
        return context[neighbour(o, n, in->axis, in->direction ? 1 : -1)];
    return info->always || context[n];
}

/* dest = value: computes all processors' values first, then stores them. */
static void assign(struct oracle *o, const struct instruction *in)
{
    struct oracle_set *set = &o->sets[o->set];
    wide *values = zeros(set->count * sizeof(wide));
    bool *overflows = zeros(set->count * sizeof(bool));

    for (uint64_t n = 0; n < set->count; n++) {
        overflows[n] = set->overflow[n];
        values[n] = value_of(o, in, n, &overflows[n]);
    }
    for (uint64_t n = 0; n < set->count; n++) {
        if (stores(o, in, n))
            put(o, &in->d, n, values[n]);
        if (set->context[n])
            set->overflow[n] = overflows[n];
    }
    free(values);
    free(overflows);
}

static void compare(struct oracle *o, const struct instruction *in)
{
    const struct row_info *info = &row_table[in->row];
    struct oracle_set *set = &o->sets[o->set];
    bool is_signed = info->number == NUMBER_S, result = false;

    for (uint64_t n = 0; n < set->count; n++) {
        switch ((int)info->shape) {
        case INT_COMPARE:
        case INT_COMPARE_2L:
            result = number_compare_integer((enum op)info->op, is_signed,
                                            widened(o, &in->a, n, is_signed),
                                            widened(o, &in->b, n, is_signed));
            break;
        case INT_COMPARE_CONSTANT:
            result =
                number_compare_integer((enum op)info->op, is_signed,
                                       widened(o, &in->a, n, is_signed), (wide)in->constant);
            break;
        case INT_COMPARE_ZERO:
            result = number_compare_integer((enum op)info->op, is_signed,
                                            widened(o, &in->a, n, is_signed), 0);
            break;
        case FLOAT_COMPARE:
            result =
                number_compare_float((enum op)info->op, in->a.bits, (uint64_t)get(o, &in->a, n),
                                     (uint64_t)get(o, &in->b, n));
            break;
        case FLOAT_COMPARE_CONSTANT:
            result =
                number_compare_float((enum op)info->op, in->a.bits, (uint64_t)get(o, &in->a, n),
                                     number_real(in->real, in->a.bits));
            break;
        case FLOAT_COMPARE_ZERO:
            result = number_compare_float((enum op)info->op, in->a.bits,
                                          (uint64_t)get(o, &in->a, n), 0);
            break;
        default:
            abort();
        }
        if (set->context[n])
            set->test[n] = result;
    }
}

static void flag(struct oracle *o, const struct instruction *in)
{
    const struct row_info *info = &row_table[in->row];
    struct oracle_set *set = &o->sets[o->set];

    for (uint64_t n = 0; n < set->count; n++) {
        bool bit = info->shape == BIT_LOAD && get(o, &in->a, n) != 0;

        switch ((int)info->op) {
        case OP_SET_CONTEXT:
            set->context[n] = 1;
            break;
        case OP_CLEAR_CONTEXT:
            set->context[n] = 0;
            break;
        case OP_INVERT_CONTEXT:
            set->context[n] = !set->context[n];
            break;
        case OP_AND_CONTEXT_TEST:
            set->context[n] &= set->test[n];
            break;
        case OP_LOAD_CONTEXT:
            set->context[n] = o->sabotage == SABOTAGE_CONTEXT && n == 0 ? 1 : bit;
            break;
        case OP_AND_CONTEXT:
            set->context[n] = set->context[n] && bit;
            break;
        case OP_LOAD_TEST:
            set->test[n] = set->context[n] ? bit : set->test[n];
            break;
        case OP_LOAD_OVERFLOW:
            set->overflow[n] = set->context[n] ? bit : set->overflow[n];
            break;
        default:
            abort();
        }
    }
}

/* ---- observation ---- */

static wide identity(enum op op, bool is_signed, int bits)
{
    switch ((int)op) {
    case OP_MIN:
        return is_signed ? wide_mask(bits - 1) : wide_mask(bits);
    case OP_MAX:
        return is_signed ? (wide)1 << (bits - 1) : 0;
    case OP_AND:
        return wide_mask(bits);
    default:
        return 0;
    }
}

static void global_integer(struct oracle *o, const struct instruction *in)
{
    const struct row_info *info = &row_table[in->row];
    bool is_signed = info->number == NUMBER_S, ignored;
    wide total = identity((enum op)info->op, is_signed, in->a.bits);

    for (uint64_t n = 0; n < processors(o); n++)
        if (o->sets[o->set].context[n]) {
            if (is_signed)
                total = (wide)wide_signed(total, in->a.bits);
            total = number_integer((enum op)info->op, is_signed, total,
                                   widened(o, &in->a, n, is_signed), in->a.bits, &ignored);
        }
    trace_add(o->out, (uint64_t)total);
}

static void global_float(struct oracle *o, const struct instruction *in)
{
    enum op op = (enum op)row_table[in->row].op;
    const struct geometry *g = &o->p->sets[o->set];
    uint64_t *values = zeros(processors(o) * sizeof *values), total;
    bool *active = zeros(processors(o));

    for (uint64_t n = 0; n < processors(o); n++) {
        values[n] = (uint64_t)get(o, &in->a, n);
        active[n] = o->sets[o->set].context[n];
    }
    total = number_float_reduce(op, values, active, processors(o), g->lengths[g->rank - 1],
                                in->a.bits);
    trace_real(o->out, number_value(total, in->a.bits));
    free(values);
    free(active);
}

static void observe(struct oracle *o, const struct operand *x)
{
    for (uint64_t n = 0; n < processors(o); n++)
        trace_add(o->out, (uint64_t)get(o, x, n));
}

/* ---- the front end's writes, and fields ---- */

static void write_data(struct oracle *o, const struct instruction *in)
{
    enum shape shape = (enum shape)row_table[in->row].shape;

    for (uint64_t n = 0; n < processors(o); n++)
        if (shape == WRITE_ARRAY)
            put(o, &in->d, n, data_word(in->where, n) & wide_mask(in->d.bits));
        else if (shape == WRITE_FLOATS)
            put(o, &in->d, n, number_real(data_real(in->where, n), in->d.bits));
        else if (n == in->where)
            put(o, &in->d, n,
                shape == WRITE_PROCESSOR ? (wide)in->constant
                                         : number_real(in->real, in->d.bits));
}

static void drop(struct oracle_field *f)
{
    free(f->bits);
    f->bits = NULL;
}

static void manage_field(struct oracle *o, const struct instruction *in)
{
    const struct row_info *info = &row_table[in->row];
    struct oracle_field *f = &o->fields[in->d.slot];

    if (info->shape == ALLOCATE) {
        f->bits = zeros(processors(o) * in->d.bits);
        f->width = in->d.bits;
        f->set = o->set;
        f->order = o->allocations++;
        f->heap = info->op == OP_HEAP;
    } else if (f->heap) {
        drop(f);
    } else {
        int order = f->order;

        for (int k = 0; k < PROGRAM_SLOTS; k++)
            if (o->fields[k].bits && !o->fields[k].heap && o->fields[k].order >= order)
                drop(&o->fields[k]);
    }
}

static void step(struct oracle *o, const struct instruction *in)
{
    switch ((int)row_table[in->row].shape) {
    case ALLOCATE:
    case DEALLOCATE:
        manage_field(o, in);
        return;
    case SELECT_SET:
        o->set = in->set;
        return;
    case OBSERVE:
        observe(o, &in->a);
        return;
    case WRITE_ARRAY:
    case WRITE_FLOATS:
    case WRITE_PROCESSOR:
    case WRITE_PROCESSOR_FLOAT:
        write_data(o, in);
        return;
    case READ_PROCESSOR:
        trace_add(o->out, (uint64_t)get(o, &in->a, in->where));
        return;
    case INT_GLOBAL:
        global_integer(o, in);
        return;
    case FLOAT_GLOBAL:
        global_float(o, in);
        return;
    case INT_COMPARE:
    case INT_COMPARE_2L:
    case INT_COMPARE_CONSTANT:
    case INT_COMPARE_ZERO:
    case FLOAT_COMPARE:
    case FLOAT_COMPARE_CONSTANT:
    case FLOAT_COMPARE_ZERO:
        compare(o, in);
        return;
    case FLAG:
    case BIT_LOAD:
        flag(o, in);
        return;
    default:
        assign(o, in);
        if (row_table[in->row].shape == RANDOM)
            o->draws++;
        return;
    }
}

/* Adds to the trace what the program leaves: the flags of all sets and all fields. */
static void dump(struct oracle *o)
{
    for (o->set = 0; o->set < o->p->sets_count; o->set++) {
        const struct oracle_set *set = &o->sets[o->set];

        for (uint64_t n = 0; n < set->count; n++)
            trace_add(o->out, set->context[n]);
        for (uint64_t n = 0; n < set->count; n++)
            trace_add(o->out, set->test[n]);
        for (uint64_t n = 0; n < set->count; n++)
            trace_add(o->out, set->overflow[n]);
        for (int k = 0; k < PROGRAM_SLOTS; k++)
            if (o->fields[k].bits && o->fields[k].set == o->set)
                for (int at = 0; at < o->fields[k].width; at += 64) {
                    int left = o->fields[k].width - at;
                    struct operand x = {(uint8_t)k, (uint8_t)at,
                                        (uint8_t)(left < 64 ? left : 64)};

                    observe(o, &x);
                }
    }
}

void oracle_run(const struct program *p, struct trace *out, enum sabotage sabotage)
{
    struct oracle o = {.p = p, .out = out, .sabotage = sabotage};

    for (int k = 0; k < p->sets_count; k++) {
        struct oracle_set *set = &o.sets[k];

        set->count = geometry_count(&p->sets[k]);
        set->context = zeros(set->count);
        set->test = zeros(set->count);
        set->overflow = zeros(set->count);
        memset(set->context, 1, set->count);
    }
    for (int n = 0; n < p->count; n++) {
        out->step = n;
        step(&o, &p->code[n]);
    }
    out->step = p->count;
    dump(&o);
    for (int k = 0; k < PROGRAM_SLOTS; k++)
        drop(&o.fields[k]);
    for (int k = 0; k < p->sets_count; k++) {
        free(o.sets[k].context);
        free(o.sets[k].test);
        free(o.sets[k].overflow);
    }
}
