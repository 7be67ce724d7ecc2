/* substitutes.c - finds stored values that may replace others, which then need not be
 * stored. */
#include "plan/substitutes.h"

#include <stdlib.h>

#include "base/errors.h"
#include "base/node_ops.h"

/* Conditions that hold wherever a value is read, none of them an AND; at most this many are
 * kept. */
enum { CONDITIONS = 8 };

struct conditions {
    int32_t of[CONDITIONS];
    int count; /* UNSEEN: nobody looks */
};

static bool is_and(const struct plan_graph *g, int32_t condition)
{
    return g->nodes[condition].op == MACHINE_AND && !g->nodes[condition].leaf;
}

static bool conditions_say(const struct plan_graph *g, const struct conditions *c,
                           int32_t condition)
{
    if (is_and(g, condition))
        return conditions_say(g, c, g->nodes[condition].in[0]) &&
               conditions_say(g, c, g->nodes[condition].in[1]);
    for (int i = 0; i < c->count; i++)
        if (c->of[i] == condition)
            return true;
    return false;
}

static void conditions_add(const struct plan_graph *g, struct conditions *c, int32_t condition)
{
    if (is_and(g, condition)) {
        conditions_add(g, c, g->nodes[condition].in[0]);
        conditions_add(g, c, g->nodes[condition].in[1]);
    } else if (c->count < CONDITIONS && !conditions_say(g, c, condition)) {
        c->of[c->count++] = condition;
    }
}

void substitutes_find(struct plan_graph *g)
{
    enum { UNSEEN = -1 };
    struct conditions *where = malloc((size_t)g->count * sizeof *where);
    int32_t *select = malloc((size_t)g->count * sizeof *select); /* of a node: its select */
    NEEDS_MEMORY(where && select);
    for (int i = 0; i < g->count; i++) {
        where[i].count = g->nodes[i].target ? 0 : UNSEEN;
        select[i] = -1;
        for (int k = 0; k < 3; k++)
            g->nodes[i].instead[k] = -1;
    }
    for (int i = g->count - 1; i >= 0; i--) {
        const struct plan_node *n = &g->nodes[i];
        for (int k = 0; !n->leaf && k < node_ops[n->op].inputs; k++) {
            struct conditions here = where[i], *w = &where[n->in[k]];
            if (!op_reads_own(n->op, k) || here.count == UNSEEN)
                here.count = 0;
            if (n->op == NODE_SELECT && k == 1)
                conditions_add(g, &here, n->in[0]);
            if (w->count == UNSEEN) {
                *w = here;
                continue;
            }
            int kept = 0;
            for (int c = 0; c < w->count; c++)
                if (conditions_say(g, &here, w->of[c]))
                    w->of[kept++] = w->of[c];
            w->count = kept;
        }
        if (n->op == NODE_SELECT && !n->leaf)
            select[n->in[1]] = i;
    }
    for (int i = 0; i < g->count; i++) {
        struct plan_node *n = &g->nodes[i];
        if (where[i].count == UNSEEN) /* no target wants it, so it may be anything */
            continue;
        for (int k = 0; !n->leaf && k < node_ops[n->op].inputs; k++) {
            int32_t s = select[n->in[k]];
            if (s < 0 || s == i || !op_reads_own(n->op, k))
                continue;
            int32_t condition = g->nodes[s].in[0];
            struct conditions here = where[i];
            if (n->op == NODE_SELECT && k == 1)
                conditions_add(g, &here, n->in[0]);
            if (conditions_say(g, &here, condition))
                n->instead[k] = s;
        }
    }
    free(where);
    free(select);
}
