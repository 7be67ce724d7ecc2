/* slices.c - values cut into slices, and loops over slices rolled up again: see reshape.h. */
#include "internal.h"

#include <stdlib.h>

#include "alias/reshape.h"

enum { LIFT_NODES = 1 << 18 };

/* ---- slices ---- */

bool reshape_unpack(struct machine *m, struct machine_value *slice)
{
    struct machine_value *fine = slice->in[0], *out[RESHAPE_BLOCK] = {NULL};
    const struct vpset *f = &m->values->sets[fine->set], *s = &m->values->sets[slice->set];
    uint32_t k = (uint32_t)slice->imm.lo, wanted = 0;
    int first = slice->detail / RESHAPE_BLOCK * RESHAPE_BLOCK, count = (int)k - first;
    struct machine_value key = *slice;
    struct device_buffer *b[RESHAPE_BLOCK] = {NULL}, *any = NULL;
    count = count < RESHAPE_BLOCK ? count : RESHAPE_BLOCK;
    for (int i = 0; i < count; i++) {
        key.detail = first + i;
        out[i] = first + i == slice->detail ? slice : graph_find(m, &key);
        if (!out[i] || out[i]->buffer)
            continue;
        b[i] = device_rows_get(m, observe_rows(s, slice->type));
        if (!b[i]) {
            for (; i >= 0; i--)
                if (b[i])
                    device_buffer_unref(m, b[i]);
            return false;
        }
        any = b[i];
        wanted |= 1u << i;
    }
    struct kernel_call c = reshape_call(m, slice->type, "slices");
    call_set(&c, m, f);
    call_set(&c, m, s);
    call_uint(&c, call_processors_run(m));
    call_uint(&c, k);
    call_uint(&c, (uint64_t)first);
    call_uint(&c, (uint64_t)count);
    call_uint(&c, wanted);
    call_buffer(&c, fine->buffer);
    for (int i = 0; i < RESHAPE_BLOCK; i++)
        call_buffer(&c, b[i] ? b[i] : any);
    enum machine_status status = call_processors(&c, m, (size_t)s->ratio, "reshaping");
    for (int i = 0; i < RESHAPE_BLOCK; i++)
        if (b[i] && status)
            device_buffer_unref(m, b[i]);
        else if (b[i])
            graph_materialised(m, out[i], b[i]);
    return status == MACHINE_OK;
}

struct machine_value *reshape_slice(struct machine *m, struct machine_value *fine, int set,
                                    uint32_t k, uint32_t i)
{
    if (fine->op == NODE_CONSTANT || (k == 1 && fine->set == set))
        return fine;
    m->run->sliced = true;
    struct machine_value key = {.op = NODE_SLICE,
                                .type = fine->type,
                                .set = (uint16_t)set,
                                .detail = (int32_t)i,
                                .imm = {k, 0},
                                .in = {fine, NULL, NULL}};
    return graph_node(m, &key);
}

bool reshape_forget_set(struct machine *m, int set)
{
    for (uint32_t i = 0; i < m->values->table_size; i++)
        for (struct machine_value *v = m->values->table[i]; v; v = v->next)
            if (v->op == NODE_SLICE && !v->buffer && (v->set == set || v->in[0]->set == set) &&
                !reshape_unpack(m, v))
                return false;
    for (uint32_t i = 0; i < m->values->table_size; i++)
        for (struct machine_value *v = m->values->table[i], *next; v; v = next) {
            next = v->next;
            if ((v->op == NODE_SLICE && (v->set == set || v->in[0]->set == set)) ||
                (v->buffer && v->set == set)) {
                graph_forget(m, v);
                next = m->values->table[i]; /* its input may have gone with it */
            }
        }
    return true;
}

struct machine_value *reshape_lay_out(struct machine *m, struct machine_value *v, int set,
                                      const struct vpset *to)
{
    v = observe_materialise(m, set, v);
    struct device_buffer *b = v ? device_rows_get(m, observe_rows(to, v->type)) : NULL;
    if (!b)
        return NULL;
    struct kernel_call c = reshape_call(m, v->type, "slices");
    call_set(&c, m, &m->values->sets[set]);
    call_set(&c, m, to);
    call_uint(&c, call_processors_run(m));
    call_uint(&c, 1); /* one slice, all of it */
    call_uint(&c, 0);
    call_uint(&c, 1);
    call_uint(&c, 1);
    call_buffer(&c, v->buffer);
    for (int i = 0; i < RESHAPE_BLOCK; i++)
        call_buffer(&c, b);
    enum machine_status status = call_processors(&c, m, (size_t)to->ratio, "reshaping");
    if (!status) {
        struct machine_value *out = graph_buffer_node(m, v->type, set, b);
        out->strange_nan = v->strange_nan;
        return out;
    }
    device_buffer_unref(m, b);
    return NULL;
}

/* ---- rolling up ---- */

/* Does to each processor's number alone what it does. */
static bool is_elementwise(const struct machine_value *v)
{
    return v->op < MACHINE_OP_COUNT_PUBLIC || v->op == NODE_SELECT ||
           (v->op >= NODE_ZERO_EXTEND && v->op <= NODE_OVERFLOW_FDIV);
}

/* The one value of the finer set whose k slices these are; NULL: there is none to be had for
 * nothing. */
static struct machine_value *lift(struct machine *m, struct machine_value *const *y, uint32_t k,
                                  int set, int *budget)
{
    const struct machine_value *a = y[0];
    if ((*budget -= (int)k) < 0)
        return NULL;
    if (k == 1 && a->set == set)
        return y[0];
    if (a->op == NODE_CONSTANT) {
        for (uint32_t i = 1; i < k; i++)
            if (y[i] != a)
                return NULL;
        return y[0];
    }
    if (a->op == NODE_SLICE) {
        if (a->in[0]->set != set || a->imm.lo != k)
            return NULL;
        for (uint32_t i = 0; i < k; i++)
            if (y[i]->op != NODE_SLICE || y[i]->in[0] != a->in[0] || y[i]->imm.lo != k ||
                y[i]->detail != (int32_t)i)
                return NULL;
        return a->in[0];
    }
    if (a->buffer || !is_elementwise(a))
        return NULL;
    for (uint32_t i = 1; i < k; i++)
        if (y[i]->op != a->op || y[i]->buffer || !type_equal(y[i]->type, a->type) ||
            y[i]->detail != a->detail || y[i]->axis != a->axis || y[i]->imm.lo != a->imm.lo ||
            y[i]->imm.hi != a->imm.hi)
            return NULL;
    struct machine_value key = {.op = a->op,
                                .type = a->type,
                                .axis = a->axis,
                                .set = (uint16_t)set,
                                .detail = a->detail,
                                .imm = a->imm};
    struct machine_value **in = malloc(k * sizeof *in);
    bool good = in != NULL;
    for (int n = 0; n < node_ops[a->op].inputs && good; n++) {
        for (uint32_t i = 0; i < k; i++)
            in[i] = y[i]->in[n];
        key.in[n] = lift(m, in, k, set, budget);
        good = key.in[n] != NULL;
    }
    free(in);
    return good ? graph_node(m, &key) : NULL;
}

/* What k equal expressions have been rolled up into is computed, alone, and each of them is from now on a
 * slice of it: whoever else holds them need not compute them one by one. */
static bool unroll(struct machine *m, struct machine_value *whole,
                   struct machine_value *const *y, uint32_t k)
{
    if (node_is_leaf(whole) || node_is_cheap(whole) || whole == y[0])
        return true;
    uint64_t evaluated = m->run->stores_evaluated;
    m->run->stores_evaluated = m->run->stores; /* nobody else is looked at */
    enum machine_status status = run_evaluate(m, &whole, 1, false);
    m->run->stores_evaluated = evaluated;
    for (uint32_t i = 0; i < k && !status; i++) {
        struct machine_value key = {.op = NODE_SLICE,
                                    .type = y[i]->type,
                                    .set = y[i]->set,
                                    .detail = (int32_t)i,
                                    .imm = {k, 0},
                                    .in = {whole, NULL, NULL}};
        if (!y[i]->buffer && y[i]->op != NODE_SLICE && y[i]->interned)
            graph_become(m, y[i], &key);
    }
    return status == MACHINE_OK;
}

bool reshape_lift(struct machine *m, struct machine_value *const *y, uint32_t k, int set,
                  struct machine_value **whole)
{
    int budget = LIFT_NODES;
    *whole = lift(m, y, k, set, &budget);
    return !*whole || unroll(m, *whole, y, k);
}

/* ---- rolling up what waits ---- */

static bool waits(const struct machine_value *v)
{
    return !node_is_leaf(v) && v->op != NODE_SLICE && !node_is_cheap(v);
}

/* A first slice somewhere in v; NULL: none is found. */
static const struct machine_value *first_slice(const struct machine_value *v, int *budget)
{
    if (v->op == NODE_SLICE)
        return v->detail == 0 ? v : NULL;
    if (v->buffer || --*budget < 0)
        return NULL;
    for (int n = 0; n < node_ops[v->op].inputs; n++) {
        const struct machine_value *found = first_slice(v->in[n], budget);
        if (found)
            return found;
    }
    return NULL;
}

static bool same_shape(const struct machine_value *a, const struct machine_value *b)
{
    return a->op == b->op && type_equal(a->type, b->type) && a->detail == b->detail &&
           a->height == b->height;
}

/* k slots that a loop has gone through, or is going through: then those before the place where it is hold
 * what the others do as an operand. *partial: it has only begun. False: error set. */
static bool roll_slots(struct machine *m, const struct slot *slots, uint32_t k, int set,
                       bool *partial)
{
    struct machine_value **y = malloc(k * sizeof *y), *whole = NULL;
    const struct machine_value *last = slots[k - 1].value;
    uint32_t cut = 0;
    bool good = y != NULL;
    if (!good)
        machine_fail(m, MACHINE_NO_MEMORY, "not enough memory to evaluate");
    while (cut < k - 1 && !same_shape(slots[cut].value, last))
        cut++;
    *partial = *partial || cut >= RESHAPE_BLOCK;
    for (int n = 0; good && waits(last) && n < (cut ? 3 : 1) && !whole; n++) {
        bool there = true;
        for (uint32_t i = 0; i < k && there; i++) {
            y[i] = i < cut ? slots[i].value->in[n] : slots[i].value;
            there = y[i] && type_equal(y[i]->type, last->type);
        }
        good = !there || reshape_lift(m, y, k, set, &whole);
    }
    free(y);
    return good;
}

bool reshape_roll(struct machine *m, bool *partial)
{
    *partial = false;
    if (!m->run->sliced || m->run->rolling)
        return true;
    m->run->rolling = true;
    bool good = true;
    for (int i = 0; i < m->memory->fields_count && good; i++) {
        const struct field *f = m->memory->fields[i];
        uint32_t k;
        for (int at = 0; at < f->slots_count && good; at += (int)k) {
            const struct slot *slots = &f->slots[at];
            int budget = 64;
            const struct machine_value *slice =
                waits(slots[0].value) ? first_slice(slots[0].value, &budget) : NULL;
            k = slice ? (uint32_t)slice->imm.lo : 1;
            uint32_t there = (uint32_t)(f->slots_count - at);
            if (k < 2 || k > there) { /* a loop that fills a new field has not come far */
                *partial = *partial || (k > there && there >= RESHAPE_BLOCK);
                k = k > there ? there : 1;
                continue;
            }
            bool even = slots[k - 1].offset == slots[0].offset + (k - 1) * slots[0].bits;
            for (uint32_t n = 1; n < k && even; n++)
                even = slots[n].bits == slots[0].bits;
            if (even)
                good = roll_slots(m, slots, k, slice->in[0]->set, partial);
            else
                k = 1;
        }
    }
    m->run->rolling = false;
    return good;
}
