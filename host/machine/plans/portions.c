/* portions.c - portions of divisions, made and freed: see division.h. */
#include <stdlib.h>

#include "base/errors.h"
#include "plans/division.h"
#include "plans/reach.h"
#include "values/graph.h"

struct machine_value *portion_draft(struct portion *g, struct machine_value key,
                                    struct draft_from from)
{
    struct machine_value *v = malloc(sizeof *v);
    NEEDS_MEMORY(v);
    *v = key;
    v->generator = v->buffer ? GENERATOR_NONE : graph_generator(v);
    if (g->reach.count == g->from_capacity) {
        g->from_capacity = g->from_capacity ? 2 * g->from_capacity : 64;
        g->from = realloc(g->from, (size_t)g->from_capacity * sizeof *g->from);
        NEEDS_MEMORY(g->from);
    }
    g->from[g->reach.count] = from;
    const int inputs = v->buffer ? 0 : node_ops[v->op].inputs;
    NEEDS_MEMORY(reach_add(g->machine, &g->reach, v, inputs));
    return v;
}

void portion_free(struct portion *g)
{
    for (int i = 0; i < g->reach.count; i++)
        free(g->reach.nodes[i]);
    reach_finish(&g->reach);
    free(g->from);
    free(g->targets.values);
    free(g->target_nodes);
}
