/* stages.c - which nodes byte code stores, and in which stage: see byte_code.h. */
#include "interpret/byte_code.h"

/* What a chain of shifts begins with. */
static int root_of(const struct plan_graph *g, int node)
{
    while (g->nodes[node].op == NODE_SHIFT && !g->nodes[node].leaf)
        node = g->nodes[node].in[0];
    return node;
}

/* Each stage makes it anew: it is read from what is stored anyway, or is a cheap function of
 * places. Were that stored, later plans would find it in memory, and no kernel of theirs could
 * tell from a test of coordinates which rows it concerns. */
static bool is_free(const struct plan_node *n)
{
    return n->op == NODE_SHIFT || n->generator <= GENERATOR_CHEAP;
}

static bool computes(const struct plan_node *n)
{
    return !n->leaf && !n->constant;
}

void byte_code_stages(struct plan_graph *g)
{
    for (int i = 0; i < g->count; i++) {
        struct plan_node *n = &g->nodes[i];
        n->stage = 0;
        n->stored = n->target;
        for (int k = 0; k < 3; k++)
            n->instead[k] = -1;
        if (!computes(n))
            continue;
        if (n->op == NODE_SHIFT) {
            struct plan_node *root = &g->nodes[root_of(g, i)];
            n->stage = computes(root) ? root->stage + 1 : 0;
            root->stored = root->stored || computes(root);
            continue;
        }
        for (int k = 0; k < node_ops[n->op].inputs; k++) {
            const struct plan_node *in = &g->nodes[n->in[k]];
            if (computes(in) && in->stage > n->stage)
                n->stage = in->stage;
        }
    }
    for (int i = 0; i < g->count; i++) {
        const struct plan_node *n = &g->nodes[i];
        for (int k = 0; computes(n) && n->op != NODE_SHIFT && k < node_ops[n->op].inputs; k++) {
            struct plan_node *in = &g->nodes[n->in[k]];
            if (computes(in) && in->stage < n->stage && !is_free(in))
                in->stored = true;
        }
    }
}
