/* roll.c - rolls up loops over slices: see reshape.h. */
#include <stdlib.h>

#include "base/errors.h"
#include "memory/memory.h"
#include "run/roll.h"
#include "run/slices.h"
#include "values/graph.h"

enum { LIFT_NODES = 1 << 18 };

/* The value of the finer set whose k slices these are; NULL: none can be had without a
 * kernel. */
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
    if (a->buffer || !op_has(a->op, OP_ALONE))
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

/* Computes the value that k equal expressions were rolled up into, and makes each expression
 * a slice of it. So other holders of the expressions do not compute them one by one. */
static bool unroll(struct machine *m, struct machine_value *whole,
                   struct machine_value *const *y, uint32_t k, enum run_why why)
{
    if (node_is_leaf(whole) || node_is_cheap(whole) || whole == y[0])
        return true;
    const struct wish wish = {&whole, 1, WISH_VALUES};
    enum machine_status status = evaluation_run(m, &wish, why);
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

bool roll_lift(struct machine *m, struct machine_value *const *y, uint32_t k, int set,
               enum run_why why, struct machine_value **whole)
{
    int budget = LIFT_NODES;
    *whole = lift(m, y, k, set, &budget);
    return !*whole || unroll(m, *whole, y, k, why);
}

static bool waits(const struct machine_value *v)
{
    return !node_is_leaf(v) && v->op != NODE_SLICE && !node_is_cheap(v);
}

/* Finds a first slice in v; NULL: none. */
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

/* Whether k slots were written by a loop, completely or up to some place; in the latter case
 * the slots up to that place hold what the others have as an operand. *partial: only the
 * beginning of a loop was found. False: error set. */
static bool roll_slots(struct machine *m, const struct slot *slots, uint32_t k, int set,
                       enum run_why why, bool *partial)
{
    struct machine_value **y = malloc(k * sizeof *y), *whole = NULL;
    const struct machine_value *last = slots[k - 1].value;
    uint32_t cut = 0;
    bool good = y != NULL;
    if (!good)
        machine_fail(m, MACHINE_NO_MEMORY, "not enough memory to evaluate");
    while (cut < k - 1 && !same_shape(slots[cut].value, last))
        cut++;
    *partial = *partial || cut >= SLICES_BLOCK;
    for (int n = 0; good && waits(last) && n < (cut ? 3 : 1) && !whole; n++) {
        bool there = true;
        for (uint32_t i = 0; i < k && there; i++) {
            y[i] = i < cut ? slots[i].value->in[n] : slots[i].value;
            there = y[i] && type_equal(y[i]->type, last->type);
        }
        good = !there || roll_lift(m, y, k, set, why, &whole);
    }
    free(y);
    return good;
}

bool roll_waiting(struct machine *m, enum run_why why, bool *partial)
{
    *partial = false;
    if (!m->run->sliced)
        return true;
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
            if (k < 2 || k > there) { /* a loop that fills a new field has only begun */
                *partial = *partial || (k > there && there >= SLICES_BLOCK);
                k = k > there ? there : 1;
                continue;
            }
            bool even = slots[k - 1].offset == slots[0].offset + (k - 1) * slots[0].bits;
            for (uint32_t n = 1; n < k && even; n++)
                even = slots[n].bits == slots[0].bits;
            if (even)
                good = roll_slots(m, slots, k, slice->in[0]->set, why, partial);
            else
                k = 1;
        }
    }
    return good;
}
