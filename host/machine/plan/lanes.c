/* lanes.c - how narrow the lanes of a kernel can be. */
#include "plan/lanes.h"

#include <stdlib.h>

#include "base/node_ops.h"

enum { NARROWEST = 8, NARROW_MOST = 16 };

int lanes_of_node(const struct plan_graph *g, int node, bool loaded)
{
    const struct plan_node *n = &g->nodes[node];
    if (n->type.kind != MACHINE_BITS || n->type.width > NARROW_MOST)
        return LANE_WIDE;
    int lane = n->type.width > NARROWEST ? NARROW_MOST : NARROWEST;
    if (loaded || n->constant)
        return lane;
    bool of_bits = g->nodes[n->in[0]].type.width == 1;
    if (n->op == NODE_SHIFT)
        return lane;
    if (n->op == NODE_ZERO_EXTEND && n->type.width == 1)
        return LANE_WIDE;
    return op_has(n->op, of_bits ? OP_NARROW_BITS : OP_NARROW) ? lane : LANE_WIDE;
}

int lanes_of_kernel(const struct plan_graph *g, const int *stores, int count, int stage)
{
    bool *needed = calloc((size_t)g->count, sizeof *needed);
    int lane = needed ? NARROWEST : LANE_WIDE;
    for (int i = 0; needed && i < count; i++)
        needed[stores[i]] = true;
    for (int i = g->count - 1; i >= 0 && lane < LANE_WIDE; i--) {
        const struct plan_node *n = &g->nodes[i];
        if (!needed[i])
            continue;
        bool loads = stage < 0 ? n->leaf : plan_loads(n, stage);
        int own = lanes_of_node(g, i, loads);
        lane = own > lane ? own : lane;
        for (int k = 0; !loads && k < node_ops[n->op].inputs; k++) {
            needed[n->in[k]] = true;
            if (n->instead[k] >= 0)
                needed[n->instead[k]] = true;
        }
    }
    free(needed);
    return lane;
}
