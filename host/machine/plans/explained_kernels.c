/* explained_kernels.c - see explained.h. */
#include "plans/explained.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/parts.h"
#include "base/types.h"
#include "plans/plans.h"

void explained_nodes(struct machine *m, struct machine_value *const *nodes,
                     struct machine_value *const *wanted, int wanted_count,
                     explained_where *where)
{
    m->plans->describing = (struct describing){
        .nodes = nodes, .wanted = wanted, .wanted_count = wanted_count, .where = where};
}

const char *explained_made(bool quick, bool boxed, bool lifted)
{
    static const char *const made[2][3] = {
        {"quick", "boxed", "optimised"},
        {"quick, for any numbers", "boxed, for any numbers", "optimised, for any numbers"}};
    return made[lifted][quick ? 0 : boxed ? 1 : 2];
}

void explained_split(struct machine *m)
{
    m->plans->describing.parts += m->plans->describing.parts ? 1 : 2;
}

void explained_improved(struct machine *m)
{
    watch_sums(m)->facts.plans_improved++;
}

/* The last operation, ignoring selects by the context. */
static const char *operation_of(const struct plan_graph *g, int node)
{
    const struct plan_node *n = &g->nodes[node];
    while (!n->leaf && !n->constant &&
           (n->op == NODE_SELECT || n->op == NODE_REINTERPRET || n->op == NODE_PACK))
        n = &g->nodes[n->in[n->op == NODE_SELECT ? 1 : 0]];
    return n->leaf ? "copy" : n->constant ? "number" : node_ops[n->op].name;
}

static enum machine_cut why_of(const struct describing *e, const struct plan_graph *g, int node)
{
    for (int i = 0; i < e->wanted_count; i++)
        if (e->wanted[i] == e->nodes[node])
            return MACHINE_CUT_LOOKED_AT;
    if (g->nodes[node].target)
        return MACHINE_CUT_LIVE;
    for (int i = 0; i < g->count; i++) {
        const struct plan_node *n = &g->nodes[i];
        if ((n->op == NODE_SHIFT || n->op == NODE_CROSS) && !n->leaf && n->in[0] == node &&
            n->stage > g->nodes[node].stage)
            return MACHINE_CUT_NEIGHBOURS;
    }
    return MACHINE_CUT_LATER;
}

/* The number of neighbours' values that a stage computes itself instead of loading them. */
static int shifts_computed(const struct plan_graph *g, const int *stores, int stores_count,
                           int stage)
{
    int count = 0;
    bool *needed = calloc((size_t)g->count, sizeof *needed);
    for (int i = 0; needed && i < stores_count; i++)
        needed[stores[i]] = g->nodes[stores[i]].stage == stage;
    for (int i = g->count - 1; needed && i >= 0; i--) {
        const struct plan_node *n = &g->nodes[i];
        if (!needed[i] || n->constant || plan_loads(n, stage))
            continue;
        for (int k = 0; k < node_ops[n->op].inputs; k++) {
            int in = plan_input(g, n, k, stage);
            needed[in] = true;
            count += n->op == NODE_SHIFT && !g->nodes[in].constant &&
                     !plan_loads(&g->nodes[in], stage) &&
                     g->nodes[in].generator > GENERATOR_CHEAP;
        }
    }
    free(needed);
    return count;
}

/* "field 64 = FADD, FMUL for neighbours, 3 more" */
static char *name_of(const struct machine_explained_store *stores, int count)
{
    enum { SHOWN = 3 };
    char text[SHOWN * 100 + 20] = "";
    size_t length = 0;
    int shown = 0, all = 0;
    for (int i = 0; i < count; i++) {
        const struct machine_explained_store *s = &stores[i];
        all += !s->in_ring;
        if (s->in_ring || shown == SHOWN)
            continue;
        const char *of = s->why == MACHINE_CUT_NEIGHBOURS ? " for neighbours"
                         : s->why == MACHINE_CUT_LATER    ? " for a later kernel"
                         : *s->where                      ? ""
                                                          : " to look at";
        length += (size_t)snprintf(text + length, sizeof text - length, "%s%s%s%s%s",
                                   shown++ ? ", " : "", s->where, *s->where ? " = " : "",
                                   s->operation, of);
    }
    if (all > SHOWN)
        snprintf(text + length, sizeof text - length, ", %d more", all - SHOWN);
    return strdup(text);
}

static void take_arguments(struct machine_explained_kernel *f, const struct plan_graph *g,
                           const struct kernel_text *k)
{
    for (int i = 0; i < k->arguments_count; i++) {
        const struct kernel_argument *a = &k->arguments[i];
        int bytes = (int)type_bytes(g->nodes[a->node].type);
        if (a->kind == ARGUMENT_INPUT) {
            f->arrays_read++;
            f->bytes_read += bytes;
        } else if (a->kind == ARGUMENT_OUTPUT) {
            f->arrays_written++;
            f->bytes_written += bytes;
        }
    }
}

struct kernel_note *explained_kernel(struct machine *m, const struct device_kernel *kernel,
                                     const struct plan_graph *g, const int *stores,
                                     int stores_count, const struct kernel_text *k,
                                     const char *made)
{
    struct describing *e = &m->plans->describing;
    int set = g->nodes[stores[0]].set;
    struct kernel_note *n = /* a new kernel has no note yet */
        sums_note(watch_sums(m), kernel ? kernel->id : 0, kernel ? NULL : "", set,
                  m->values->sets[set].count);
    bool split = e->parts > 0;
    e->parts -= split;
    if (!n || n->facts.generated)
        return n;
    struct machine_explained_store *list = calloc((size_t)stores_count, sizeof *list);
    if (!list)
        return n;
    for (int i = 0; i < stores_count; i++) {
        list[i] = (struct machine_explained_store){.why = why_of(e, g, stores[i]),
                                                   .in_ring =
                                                       g->strips && !g->nodes[stores[i]].target,
                                                   .type = g->nodes[stores[i]].type,
                                                   .operation = operation_of(g, stores[i])};
        if (e->where)
            e->where(m, e->nodes[stores[i]], list[i].where, sizeof list[i].where);
    }
    char *name = name_of(list, stores_count);
    if (name) {
        free(n->name);
        n->name = name;
    }
    struct machine_explained_kernel *f = &n->facts;
    f->name = n->name;
    f->generated = true;
    f->made = made;
    f->stores = list;
    f->stores_count = stores_count;
    f->operations = k->ops;
    f->operations_cost = k->cost;
    for (int i = 0; i < stores_count; i++) {
        int stage = g->nodes[stores[i]].stage;
        f->stages = stage >= f->stages ? stage + 1 : f->stages;
        f->rings += list[i].in_ring;
    }
    for (int stage = g->strips ? 0 : f->stages - 1; stage < f->stages; stage++)
        f->shifts_computed += shifts_computed(g, stores, stores_count, stage);
    f->stages = g->strips ? f->stages : 1;
    f->tile_width = k->tile_width;
    f->tile_height = k->tile_height;
    f->split = split;
    /* Single lanes take as long as a whole vector; so do narrow lanes, of which there are
     * more. */
    double lanes = (double)m->device->shape.vector / k->vector;
    f->operations_s =
        1e-9 * m->device->shape.op_ns * k->cost * lanes * (double)m->values->sets[set].count;
    f->plan = g->considered;
    f->predicted_s =
        split ? 0 : 1e-9 * (g->strips ? g->cost_ns : g->nodes[stores[0]].kernel_ns);
    take_arguments(f, g, k);
    return n;
}

struct kernel_note *explained_built(struct machine *m, struct kernel_note *note,
                                    const struct device_kernel *kernel)
{
    struct kernel_note *known = NULL;
    if (!note)
        return NULL;
    for (struct kernel_note *n = watch_sums(m)->notes; n && kernel && !known; n = n->next)
        if (n->kernel == kernel->id && n->facts.vpset == note->facts.vpset &&
            n->facts.processors == note->facts.processors)
            known = n;
    note->kernel = known || !kernel ? 0 : kernel->id;
    return known ? known : note;
}
