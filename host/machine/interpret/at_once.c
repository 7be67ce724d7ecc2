/* at_once.c - see at_once.h.
 *
 * Operands are arrays, numbers, and small functions of these two and of places, which are
 * computed into registers on the stack, a block of lanes at a time. Halos are lanes like
 * others: theirs are the operands' halos.
 *
 *     key:  ADD (array, number)          the loop, over all lanes of the arrays
 *     key:  MUL (place, number)          a block of places, the loop, the next block */
#include "interpret/at_once.h"

#include "base/errors.h"
#include "base/scalar.h"
#include "base/types.h"
#include "interpret/byte_code.h"
#include "interpret/generate.h"
#include "interpret/lanes.h"
#include "values/graph.h"

/* Depth: of functions in an operand. Each node there has three operands at most in registers,
 * and a place's index. */
enum { DEPTH = 4, REGISTERS = 4 * DEPTH + 4, REGISTER_BYTES = BLOCK_LANES * 8 };

struct doing {
    const struct lanes_table *table;
    const struct vpset *set;
    size_t first; /* element of the arrays */
    int lanes, used;
    _Alignas(64) unsigned char registers[REGISTERS][REGISTER_BYTES];
};

/* ---- what can be computed ---- */

static lanes_function *loop_of(const struct lanes_table *t, const struct machine_value *v)
{
    const enum lanes_class from = lanes_class_of(v->in[0]->type), to = lanes_class_of(v->type);
    if (v->op == NODE_SELECT)
        return t->of[v->op][lanes_bits_of(to)];
    if (v->op == NODE_CONCAT)
        return t->of[LANES_JOIN][to];
    lanes_function *loop =
        t->convert[v->op == NODE_EXTRACT ? NODE_ZERO_EXTEND : v->op][from][to];
    return loop ? loop : t->of[v->op][from];
}

static const struct machine_value *same_bits(const struct machine_value *v)
{
    while (v->op == NODE_REINTERPRET && !v->buffer)
        v = v->in[0];
    return v;
}

static bool type_can(struct machine_type t)
{
    return !t.s && t.width <= 64;
}

static bool is_place(const struct machine_value *v)
{
    return v->op == NODE_COORDINATE || v->op == NODE_INDEX;
}

/* Some of an operand's bits, or more. Who takes them makes them himself. */
static bool is_view(const struct machine_value *v)
{
    return v->op == NODE_ZERO_EXTEND || v->op == NODE_SIGN_EXTEND || v->op == NODE_EXTRACT;
}

static lanes_function *operation_can(const struct lanes_table *t, const struct machine_value *v,
                                     int depth);

static bool operand_can(const struct lanes_table *t, const struct machine_value *v, int depth)
{
    if (!type_can(v->type))
        return false;
    if (!v->buffer)
        v = same_bits(v);
    if (v->buffer)
        return v->buffer->host;
    if (v->op == NODE_CONSTANT)
        return true;
    if (!depth || !(node_is_cheap(v) || is_view(v)))
        return false;
    return is_place(v) || operation_can(t, v, depth - 1);
}

/* The operation's loop; NULL: it cannot be computed so. */
static lanes_function *operation_can(const struct lanes_table *t, const struct machine_value *v,
                                     int depth)
{
    const struct node_op_info *op = &node_ops[v->op];
    if (!(op->flags & OP_ALONE) || !op->inputs || !type_can(v->type))
        return NULL;
    for (int i = 0; i < op->inputs; i++)
        if (!operand_can(t, v->in[i], depth))
            return NULL;
    return loop_of(t, v);
}

/* ---- a block ---- */

static void *register_get(struct doing *d)
{
    INVARIANT(d->used < REGISTERS);
    return d->registers[d->used++];
}

/* Bits of one width as those of another. */
static void resize(const struct doing *d, void *to, struct machine_type type, void *in,
                   struct machine_type from)
{
    void *const at[2] = {in, to};
    const struct lanes_step s = {
        .op = NODE_ZERO_EXTEND, .to = 1, .from = from, .type = type, .mask = lanes_mask(type)};
    d->table->convert[NODE_ZERO_EXTEND][lanes_class_of(from)][lanes_class_of(type)](&s, at,
                                                                                    d->lanes);
}

static void place_run(struct doing *d, const struct machine_value *v, void *to)
{
    const int axis = v->op == NODE_INDEX ? -1 : v->axis;
    if (v->type.width == 32) {
        generate_lanes(d->set, axis, d->first, to, d->lanes);
        return;
    }
    void *index = register_get(d);
    generate_lanes(d->set, axis, d->first, index, d->lanes);
    resize(d, to, v->type, index, MACHINE_UINT(32));
}

static struct lanes_step step_of(const struct machine_value *v)
{
    struct lanes_step s = {.op = v->op,
                           .to = 3,
                           .in = {0, 1, 2},
                           .from = v->in[0]->type,
                           .type = v->type,
                           .mask = lanes_mask(v->type)};
    if (v->op == NODE_EXTRACT)
        s.detail = v->detail;
    else if (v->op == NODE_CONCAT)
        s.detail = v->in[0]->type.width;
    else if (node_ops[v->op].fold == FOLD_SHIFT) /* all by one number? */
        s.detail = v->in[1]->op == NODE_CONSTANT;
    return s;
}

/* at: the operands, and where the result goes. */
static void step_run(struct doing *d, const struct lanes_step *s, lanes_function *loop,
                     const struct machine_value *v, void *at[4])
{
    int used = d->used;
    for (int i = 0; i < 2 && v->op == NODE_CONCAT; i++) {
        void *part = register_get(d);
        resize(d, part, v->type, at[i], v->in[i]->type);
        at[i] = part;
    }
    loop(s, at, d->lanes);
    if (v->maybe_nan && v->op != NODE_SELECT)
        d->table->of[LANES_CANONICAL][lanes_class_of(v->type)](s, at, d->lanes);
    d->used = used;
}

static void operand_run(struct doing *d, const struct machine_value *v, void *to);

/* Where an operand is, in a register or not. */
static void *operand(struct doing *d, const struct machine_value *v)
{
    v = same_bits(v);
    if (v->buffer)
        return (char *)v->buffer->host + d->first * type_bytes(v->type);
    void *to = register_get(d);
    operand_run(d, v, to);
    return to;
}

static void operand_run(struct doing *d, const struct machine_value *v, void *to)
{
    int used = d->used;
    if (v->op == NODE_CONSTANT) {
        d->table->fill(to, &v->imm, type_bytes(v->type), (size_t)d->lanes);
    } else if (is_place(v)) {
        place_run(d, v, to);
    } else {
        const struct lanes_step s = step_of(v);
        void *at[4] = {[3] = to};
        for (int i = 0; i < node_ops[v->op].inputs; i++)
            at[i] = operand(d, v->in[i]);
        step_run(d, &s, loop_of(d->table, v), v, at);
    }
    d->used = used;
}

/* ---- all of them ---- */

/* An operation of arrays and numbers: what stays the same from block to block is made once; of
 * arrays alone there is one block. */
static void arrays_run(struct doing *d, const struct machine_value *v, lanes_function *loop,
                       size_t all, char *to)
{
    const struct lanes_step s = step_of(v);
    const int inputs = node_ops[v->op].inputs;
    const struct machine_value *in[3];
    char *begin[4] = {[3] = to};
    size_t bytes[4] = {[3] = type_bytes(v->type)}, block = all;
    for (int i = 0; i < inputs; i++) {
        in[i] = same_bits(v->in[i]);
        bytes[i] = type_bytes(in[i]->type);
        begin[i] = in[i]->buffer ? in[i]->buffer->host : NULL;
        if (!begin[i] || v->op == NODE_CONCAT)
            block = all < BLOCK_LANES ? all : BLOCK_LANES;
    }
    d->lanes = (int)block;
    for (int i = 0; i < inputs; i++)
        if (in[i]->op == NODE_CONSTANT) {
            begin[i] = register_get(d);
            operand_run(d, in[i], begin[i]);
            bytes[i] = 0;
        }
    for (d->first = 0; d->first < all; d->first += block) {
        const int used = d->used;
        void *at[4] = {[3] = to + d->first * bytes[3]};
        d->lanes = all - d->first < block ? (int)(all - d->first) : (int)block;
        for (int i = 0; i < inputs; i++)
            at[i] = begin[i] ? begin[i] + d->first * bytes[i] : operand(d, in[i]);
        step_run(d, &s, loop, v, at);
        d->used = used;
    }
}

static void places_run(struct doing *d, const struct machine_value *v, size_t all, char *to)
{
    for (d->first = 0; d->first < all; d->first += BLOCK_LANES) {
        d->lanes = all - d->first < BLOCK_LANES ? (int)(all - d->first) : BLOCK_LANES;
        place_run(d, v, to + d->first * type_bytes(v->type));
    }
}

/* Of an operation, by that loop, or where that is NULL of a place. NULL: it cannot be; there is
 * no error. */
static struct device_buffer *array_of(struct machine *m, const struct machine_value *key,
                                      lanes_function *loop)
{
    const struct vpset *s = &m->values->sets[key->set];
    if (device_settle(m))
        return NULL;
    struct device_buffer *b = device_rows_get(m, geometry_rows(s, key->type));
    if (!b || !b->host) {
        if (b)
            device_buffer_unref(m, b);
        machine_error_clear(m);
        return NULL;
    }
    const double start = device_work_begin(m);
    struct doing d;
    d.table = lanes_table();
    d.set = s;
    d.used = 0;
    if (loop)
        arrays_run(&d, key, loop, s->rows * s->pitch, b->host);
    else
        places_run(&d, key, s->rows * s->pitch, b->host);
    device_work_end(m, start);
    return b;
}

static bool is_small(const struct machine *m, const struct machine_value *v)
{
    const struct vpset *s = &m->values->sets[v->set];
    return s->rows * s->pitch <= m->device->shape.at_once_lanes;
}

/* By a test of places later kernels see which rows it concerns. */
static bool stays(const struct machine_value *key)
{
    return is_view(key) || (key->type.width == 1 && graph_generator(key) <= GENERATOR_CHEAP);
}

struct machine_value *at_once_operation(struct machine *m, struct machine_value *key)
{
    lanes_function *loop = is_small(m, key) ? operation_can(lanes_table(), key, DEPTH) : NULL;
    if (!loop || stays(key))
        return NULL;
    graph_derive_nan(m, key);
    struct device_buffer *b = array_of(m, key, loop);
    if (!b)
        return NULL;
    struct machine_value *v = graph_buffer_node(m, key->type, key->set, b);
    v->strange_nan = key->strange_nan;
    return v;
}

static bool fills(struct machine *m, struct machine_value *v)
{
    if (!v->set || !is_small(m, v) || !type_can(v->type))
        return false;
    lanes_function *loop = is_place(v) ? NULL : operation_can(lanes_table(), v, DEPTH);
    struct device_buffer *b = is_place(v) || loop ? array_of(m, v, loop) : NULL;
    if (b)
        graph_materialised(m, v, b);
    return b;
}

bool at_once_looked(struct machine *m, struct machine_value *v)
{
    return v->buffer || ((node_is_cheap(v) || is_view(v)) && fills(m, v));
}

bool at_once_stored(struct machine *m, struct machine_value *v)
{
    return v->buffer || (is_view(v) && !node_is_cheap(v) && fills(m, v));
}
