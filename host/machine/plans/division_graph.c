/* division_graph.c - which targets can be computed in blocks, and the drafts of both portions:
 * see division.h. */
#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "base/errors.h"
#include "plans/far.h"
#include "values/graph.h"

/* ---- what can be in blocks ---- */

enum { NEVER = -1 };

static bool is_number(const struct machine_value *v)
{
    return v->op == NODE_CONSTANT && !v->buffer;
}

static bool is_place(int op)
{
    return op == NODE_COORDINATE || op == NODE_INDEX || op == NODE_SEND_ADDRESS ||
           op == NODE_RANDOM;
}

/* How many planes far the node looks; NEVER: it cannot be computed in blocks. Crosses stay in
 * their row. */
static int looks(struct machine *m, const struct machine_value *v, const int *of)
{
    const struct cut *c = v->set ? sequencers_cut(m, v->set) : NULL;
    int far = 0;
    if (is_number(v))
        return 0;
    if (!c)
        return NEVER;
    if (v->buffer || is_place(v->op))
        return 0;
    const struct vpset *s = &m->values->sets[v->set];
    if (!op_has(v->op, OP_ALONE) && v->op != NODE_SHIFT &&
        !(v->op == NODE_CROSS && s->rank > 1))
        return NEVER;
    for (int k = 0; k < node_ops[v->op].inputs; k++) {
        const struct machine_value *in = v->in[k];
        if (of[in->local] == NEVER || (!is_number(in) && in->set != v->set))
            return NEVER;
        far = of[in->local] > far ? of[in->local] : far;
    }
    if (v->op == NODE_SHIFT && v->axis == 0)
        far += abs(v->detail);
    return far <= c->ghosts ? far : NEVER;
}

/* ---- drafts ---- */

static struct machine_value *operation(struct portion *g, int op, int width, int detail,
                                       struct machine_value *a, struct machine_value *b)
{
    const struct machine_value key = {.op = (uint8_t)op,
                                      .type = MACHINE_UINT(width),
                                      .set = a->set,
                                      .detail = detail,
                                      .in = {a, b, NULL}};
    return portion_draft(g, key, (struct draft_from){DRAFT_MADE, 0, 0});
}

static struct machine_value *number(struct portion *g, int width, uint64_t x,
                                    struct draft_from from)
{
    const struct machine_value key = {
        .op = NODE_CONSTANT, .type = MACHINE_UINT(width), .imm = {x, 0}};
    return portion_draft(g, key, from);
}

static struct machine_value *fixed(struct portion *g, int width, uint64_t x)
{
    return number(g, width, x, (struct draft_from){DRAFT_MADE, 0, 0});
}

static struct machine_value *resized(struct portion *g, struct machine_value *v, int width)
{
    return width == v->type.width  ? v
           : width < v->type.width ? operation(g, NODE_EXTRACT, width, 0, v, NULL)
                                   : operation(g, NODE_ZERO_EXTEND, width, 0, v, NULL);
}

/* A processor's place in the whole set: along the first axis, or (times: processors of a plane)
 * its index. */
static struct machine_value *place(struct machine *m, struct portion *g,
                                   const struct machine_value *v, int node, bool index)
{
    const struct vpset *s = &m->values->sets[v->set];
    const struct cut *c = sequencers_cut(m, v->set);
    const uint64_t times = index ? s->count / c->length : 1, all = c->length * times;
    const struct machine_value key = {
        .op = index ? NODE_INDEX : NODE_COORDINATE, .type = MACHINE_UINT(32), .set = v->set};
    struct machine_value *x = portion_draft(g, key, (struct draft_from){DRAFT_MADE, node, 0}),
                         *first =
                             number(g, 32, 0, (struct draft_from){DRAFT_FIRST, node, times}),
                         *length = fixed(g, 32, all);
    x = operation(g, MACHINE_ADD, 32, 0, x, first);
    for (uint64_t most = c->height + c->length - 1; most > c->length; most -= c->length)
        x = operation(g, MACHINE_UMIN, 32, 0, x, operation(g, MACHINE_SUB, 32, 0, x, length));
    return x;
}

static struct machine_value *shifted_down(struct portion *g, struct machine_value *v, int by)
{
    const int width = v->type.width;
    return resized(g, operation(g, NODE_EXTRACT, width - by, by, v, NULL), width);
}

/* x ^ x >> by, times a number. */
static struct machine_value *mixed(struct portion *g, struct machine_value *x, int by,
                                   uint64_t times)
{
    x = operation(g, MACHINE_XOR, 64, 0, x, shifted_down(g, x, by));
    return times ? operation(g, MACHINE_MUL, 64, 0, x, fixed(g, 64, times)) : x;
}

/* As random_bits() of the prelude and the loop `draw` of byte code. */
static struct machine_value *drawn(struct portion *g, const struct machine_value *v, int node,
                                   struct machine_value *index)
{
    const int width = v->type.width;
    struct machine_value *x = resized(g, index, 64), *limit;
    x = operation(g, MACHINE_MUL, 64, 0, x, fixed(g, 64, UINT64_C(0x9e3779b97f4a7c15)));
    x = operation(g, MACHINE_ADD, 64, 0, x,
                  number(g, 64, 0, (struct draft_from){DRAFT_LOW, node, 0}));
    x = mixed(g, x, 30, UINT64_C(0xbf58476d1ce4e5b9));
    x = mixed(g, x, 27, UINT64_C(0x94d049bb133111eb));
    x = mixed(g, x, 31, 0);
    if (v->detail == 0)
        return width < 64 ? operation(g, NODE_EXTRACT, width, 64 - width, x, NULL) : x;
    limit = number(g, 64, 0, (struct draft_from){DRAFT_HIGH, node, 0});
    if (v->detail == 1) {
        x = operation(g, MACHINE_MUL, 64, 0, shifted_down(g, x, 32), limit);
        return resized(g, shifted_down(g, x, 32), width);
    }
    x = operation(g, MACHINE_MUL, 128, 0, resized(g, x, 128), resized(g, limit, 128));
    return resized(g, operation(g, NODE_EXTRACT, 64, 64, x, NULL), width);
}

/* The processor that a dealt geometry has at the index. */
static struct machine_value *dealt(const struct machine *m, struct portion *g,
                                   const struct machine_value *v, struct machine_value *index)
{
    const int bits = m->values->processors_log2;
    const uint64_t mask = (UINT64_C(1) << bits) - 1;
    struct machine_value *x = operation(g, MACHINE_AND, 32, 0, index, fixed(g, 32, mask));
    x = operation(g, MACHINE_MUL, 32, 0, x, fixed(g, 32, m->values->sets[v->set].ratio));
    x = operation(g, MACHINE_ADD, 32, 0, x, bits ? shifted_down(g, index, bits) : index);
    return resized(g, x, v->type.width);
}

/* What is made of a processor's place; NULL: it is the same in blocks. */
static struct machine_value *place_draft(struct machine *m, struct portion *g,
                                         const struct machine_value *v, int node)
{
    if (v->op == NODE_COORDINATE)
        return v->axis ? NULL : resized(g, place(m, g, v, node, false), v->type.width);
    struct machine_value *index = place(m, g, v, node, true);
    return v->op == NODE_RANDOM         ? drawn(g, v, node, index)
           : v->op == NODE_SEND_ADDRESS ? dealt(m, g, v, index)
                                        : resized(g, index, v->type.width);
}

static struct machine_value *draft_of(struct machine *m, struct division *d, struct portion *g,
                                      const struct machine_value *v, int node,
                                      struct machine_value *const *drafts)
{
    struct machine_value key = *v;
    if (g != &d->whole && !v->buffer && is_place(v->op)) {
        struct machine_value *made = place_draft(m, g, v, node);
        if (made)
            return made;
    }
    for (int k = 0; k < 3; k++)
        key.in[k] = !v->buffer && k < node_ops[v->op].inputs ? drafts[v->in[k]->local] : NULL;
    key.buffer = v->buffer ? &d->stand_in : NULL;
    /* a draw's key is as much its number as a constant's */
    const bool numbered = is_number(v) || (!v->buffer && v->op == NODE_RANDOM);
    return portion_draft(g, key,
                         (struct draft_from){v->buffer  ? DRAFT_LEAF
                                             : numbered ? DRAFT_NUMBER
                                                        : DRAFT_MADE,
                                             node, 0});
}

/* The drafts of all that these targets need. */
static void portion_make(struct machine *m, struct division *d, struct portion *g,
                         const struct plan_request *q, const bool *wanted)
{
    const int count = q->reach->count;
    bool *needed = malloc((size_t)count * sizeof *needed);
    struct machine_value **drafts = calloc((size_t)count, sizeof *drafts);
    g->target_nodes = malloc((size_t)count * sizeof *g->target_nodes);
    NEEDS_MEMORY(needed && drafts && g->target_nodes);
    memcpy(needed, wanted, (size_t)count * sizeof *needed);
    for (int i = count - 1; i >= 0; i--) {
        const struct machine_value *v = q->reach->nodes[i];
        for (int k = 0; needed[i] && !v->buffer && k < node_ops[v->op].inputs; k++)
            needed[v->in[k]->local] = true;
    }
    for (int i = 0; i < count; i++) {
        if (needed[i])
            drafts[i] = draft_of(m, d, g, q->reach->nodes[i], i, drafts);
        if (wanted[i]) {
            g->target_nodes[g->targets.count] = i;
            NEEDS_MEMORY(targets_add(&g->targets, drafts[i]));
        }
    }
    NEEDS_MEMORY(reach_ends(&g->reach, &g->targets));
    free(needed);
    free(drafts);
}

/* ---- the division ---- */

void division_free(struct division *d)
{
    if (!d)
        return;
    for (int i = 0; i < d->blocks_count; i++)
        portion_free(&d->blocks[i]);
    free(d->blocks);
    portion_free(&d->whole);
    if (d->far)
        division_far_forget(d);
    free(d->reaches);
    free(d->needs);
    free(d);
}

void division_forget_plans(struct division *d)
{
    for (int i = 0; i < d->blocks_count; i++)
        d->blocks[i].plan = NULL;
    d->whole.plan = NULL;
}

const struct plan *division_in_blocks(const struct plan *p)
{
    return p->division->whole.targets.count ? NULL : p->division->blocks[0].plan;
}

/* How far each target in blocks looks, and what each set's arrays need for that. */
static void reaches_note(struct machine *m, struct division *d, const struct plan_request *q,
                         const int *of)
{
    d->turns_most = INT_MAX;
    d->needs_count = m->values->sets_count;
    const struct portion *g = &d->blocks[0];
    d->reaches = malloc((size_t)g->targets.count * sizeof *d->reaches);
    d->needs = calloc((size_t)d->needs_count, sizeof *d->needs);
    NEEDS_MEMORY(d->reaches && d->needs);
    for (int i = 0; i < g->targets.count; i++) {
        const int node = g->target_nodes[i], set = q->reach->nodes[node]->set;
        d->reaches[i] = of[node];
        d->needs[set] = of[node] > d->needs[set] ? of[node] : d->needs[set];
        const int turns = of[node] ? sequencers_cut(m, set)->ghosts / of[node] : INT_MAX;
        d->turns_most = turns < d->turns_most ? turns : d->turns_most;
    }
}

struct division *division_make(struct machine *m, const struct plan_request *q)
{
    const int count = q->reach->count;
    int *of = malloc((size_t)count * sizeof *of), in_blocks = 0;
    bool *blocks = calloc((size_t)count, sizeof *blocks),
         *whole = calloc((size_t)count, sizeof *whole);
    struct division *d = calloc(1, sizeof *d);
    NEEDS_MEMORY(of && blocks && whole && d);
    for (int i = 0; i < count; i++)
        of[i] = looks(m, q->reach->nodes[i], of);
    for (int i = 0; i < q->targets->count; i++) {
        const struct machine_value *v = q->targets->values[i];
        const bool is = of[v->local] != NEVER && v->set;
        (is ? blocks : whole)[v->local] = true;
        in_blocks += is;
    }
    d->stand_in.host = m->device->is_pocl ? &d->stand_in : NULL;
    d->blocks_count = m->sequencers->machines_count;
    d->blocks = calloc((size_t)d->blocks_count, sizeof *d->blocks);
    NEEDS_MEMORY(d->blocks);
    d->whole.machine = m;
    for (int i = 0; i < d->blocks_count && in_blocks; i++) {
        d->blocks[i].machine = m->sequencers->machines[i];
        portion_make(m, d, &d->blocks[i], q, blocks);
    }
    if (in_blocks) {
        portion_make(m, d, &d->whole, q, whole);
        reaches_note(m, d, q, of);
        if (m->sequencers->far)
            division_far_plan(d);
    }
    free(of);
    free(blocks);
    free(whole);
    if (in_blocks)
        return d;
    division_free(d);
    return NULL;
}
