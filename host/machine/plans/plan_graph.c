/* plan_graph.c - the graph of a request, and the arrays that a plan of it stores: what kernels
 * and byte code have in common. */
#include <stdlib.h>

#include "base/arrays.h"
#include "base/errors.h"
#include "plans/plans.h"

/* ---- what is reached, and its signature: reach.h ---- */

bool reach_grow(struct reach *r)
{
    bool failed = false;
    if (r->count == r->capacity)
        r->nodes = array_more(r->nodes, &r->capacity, sizeof *r->nodes, &failed);
    if (!failed && r->length + REACH_WORDS > (uint32_t)r->signature_capacity)
        r->signature =
            array_more(r->signature, &r->signature_capacity, sizeof *r->signature, &failed);
    return !failed;
}

bool reach_ends(struct reach *r, const struct targets *t)
{
    for (int i = 0; i < t->count; i++) {
        if (!reach_grow(r))
            return false;
        r->signature[r->length++] = UINT32_C(0x80000000) | t->values[i]->local;
    }
    return true;
}

void reach_finish(struct reach *r)
{
    free(r->nodes);
    free(r->signature);
}

bool targets_add(struct targets *t, struct machine_value *v)
{
    bool failed = false;
    if (t->count == t->capacity)
        t->values = array_more(t->values, &t->capacity, sizeof *t->values, &failed);
    if (!failed)
        t->values[t->count++] = v;
    return !failed;
}

/* ---- the plan's graph ---- */

bool plan_graph_init(struct plan_graph *g, const struct plan_request *q)
{
    const struct reach *r = q->reach;
    const struct targets *t = q->targets;
    *g = (struct plan_graph){.nodes = calloc((size_t)r->count, sizeof *g->nodes),
                             .count = r->count};
    for (int i = 0; g->nodes && i < r->count; i++) {
        const struct machine_value *v = r->nodes[i];
        struct plan_node *n = &g->nodes[i];
        *n = (struct plan_node){.op = v->buffer ? NODE_BUFFER : v->op,
                                .type = v->type,
                                .axis = v->axis,
                                .generator = v->buffer ? GENERATOR_NONE : v->generator,
                                .maybe_nan = v->maybe_nan,
                                .leaf = v->buffer != NULL,
                                .constant = v->op == NODE_CONSTANT && !v->buffer,
                                .set = v->set,
                                .detail = v->detail};
        for (int k = 0; !v->buffer && k < node_ops[v->op].inputs; k++) {
            INVARIANT(v->in[k]->local < (uint32_t)i); /* operands before users, so no circle */
            n->in[k] = (int32_t)v->in[k]->local;
        }
    }
    for (int i = 0; g->nodes && i < t->count; i++)
        g->nodes[t->values[i]->local].target = true;
    return g->nodes != NULL;
}

int plan_stores(const struct plan_graph *g, int stage, int set, int *stores)
{
    int count = 0;
    for (int i = 0; i < g->count; i++)
        if (g->nodes[i].stored && (stage < 0 || g->nodes[i].stage == stage) &&
            g->nodes[i].set == set)
            stores[count++] = i;
    return count;
}

/* In strips, values that only neighbours read are in no array. */
void plan_arrays(const struct machine *m, struct plan *p, const struct plan_graph *g,
                 const int *stores, int count)
{
    for (int i = 0; i < count; i++) {
        const struct plan_node *n = &g->nodes[stores[i]];
        if (g->strips && !n->target)
            continue;
        p->arrays[p->stored_count] =
            (struct array){geometry_rows(&m->values->sets[n->set], n->type), p->launches_count,
                           p->launches_count};
        p->stored[p->stored_count++] = stores[i];
    }
}

/* If a stage was split, each launch stores a part. */
void plan_last_launches(struct plan *p)
{
    for (int i = 0; i < p->stored_count; i++)
        for (int l = p->arrays[i].first + 1; l < p->launches_count; l++)
            for (int k = 0; k < p->launches[l].arguments_count; k++) {
                const struct kernel_argument *a = &p->launches[l].arguments[k];
                if ((a->kind == ARGUMENT_INPUT || a->kind == ARGUMENT_OUTPUT) &&
                    a->node == p->stored[i])
                    p->arrays[i].last = l;
            }
}
