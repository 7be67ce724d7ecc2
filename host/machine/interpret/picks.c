/* picks.c - see picks.h. */
#include "interpret/picks.h"

#include <stdlib.h>

#include "interpret/lanes.h"

struct picks {
    const struct plan_graph *g;
    int stage;
    bool wanted;
    int *uses;        /* of a node: operands that it is */
    struct pick **of; /* by node */
};

struct picks *picks_create(const struct plan_graph *g, int stage, bool wanted)
{
    const size_t nodes = (size_t)g->count;
    struct picks *p = calloc(1, sizeof *p);
    if (!p)
        return NULL;
    *p = (struct picks){.g = g,
                        .stage = stage,
                        .wanted = wanted,
                        .uses = calloc(nodes, sizeof *p->uses),
                        .of = calloc(nodes, sizeof *p->of)};
    if (!p->uses || !p->of) {
        picks_free(p);
        return NULL;
    }
    for (int i = 0; i < g->count; i++)
        for (int k = 0; !g->nodes[i].leaf && k < node_ops[g->nodes[i].op].inputs; k++)
            p->uses[g->nodes[i].in[k]]++;
    return p;
}

void picks_free(struct picks *p)
{
    if (!p)
        return;
    for (int i = 0; p->of && i < p->g->count; i++)
        free(p->of[i]);
    free(p->of);
    free(p->uses);
    free(p);
}

static bool is_computed(const struct picks *p, int node, int op)
{
    const struct plan_node *n = &p->g->nodes[node];
    return n->op == op && !plan_loads(n, p->stage);
}

/* A choice that only the one around it takes. */
static bool is_inner(const struct picks *p, int node)
{
    return is_computed(p, node, NODE_SELECT) && p->uses[node] == 1 && !p->g->nodes[node].stored;
}

/* What a choice compares with a constant; -1: it does not. */
static int compared(const struct picks *p, int choice, int *key)
{
    const struct plan_node *nodes = p->g->nodes;
    const int bit = nodes[choice].in[0];
    if (!is_computed(p, bit, MACHINE_EQ))
        return -1;
    const int a = nodes[bit].in[0], b = nodes[bit].in[1];
    const bool first = nodes[a].constant;
    if (first == nodes[b].constant || nodes[a].type.width > 32)
        return -1;
    *key = first ? a : b;
    return first ? b : a;
}

const struct pick *picks_find(struct picks *p, int node)
{
    const struct plan_node *nodes = p->g->nodes;
    struct pick found = {.rest = node};
    int key;
    if (p->of[node] || !p->wanted || !is_computed(p, node, NODE_SELECT))
        return p->of[node];
    while (found.count < PICK_MOST && (!found.count || is_inner(p, found.rest))) {
        const int index = compared(p, found.rest, &key);
        if (index < 0 || (found.count && index != found.index))
            break;
        found.index = index;
        found.keys[found.count] = key;
        found.values[found.count++] = nodes[found.rest].in[1];
        found.rest = nodes[found.rest].in[2];
    }
    if (found.count < PICK_LEAST || !(p->of[node] = malloc(sizeof found)))
        return NULL;
    *p->of[node] = found;
    return p->of[node];
}

const struct pick *picks_at(const struct picks *p, int node)
{
    return p->of[node];
}

int picks_inner(const struct picks *p, int node)
{
    const struct plan_node *n = &p->g->nodes[node];
    return n->op == NODE_SELECT && !n->leaf && is_inner(p, n->in[1]) &&
                   p->g->nodes[n->in[1]].in[2] == n->in[2]
               ? n->in[1]
               : -1;
}

int picks_product(const struct picks *p, int node)
{
    const struct plan_node *n = &p->g->nodes[node];
    const bool sums = is_computed(p, node, MACHINE_FADD) || is_computed(p, node, MACHINE_FSUB);
    for (int k = 2; p->wanted && sums && !n->type.s && k--;) {
        const struct plan_node *t = &p->g->nodes[n->in[k]];
        if (is_computed(p, n->in[k], MACHINE_FMUL) && p->uses[n->in[k]] == 1 && !t->stored &&
            !t->maybe_nan && !t->type.s && t->type.width == n->type.width)
            return k;
    }
    return -1;
}
