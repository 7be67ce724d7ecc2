/* accesses.c - see accesses.h. The walk's order is that of codegen/body.c. */
#include "plan/accesses.h"

#include <stdlib.h>
#include <string.h>

#include "base/arrays.h"
#include "base/errors.h"
#include "base/node_ops.h"

enum { CHAINS = 256, NUMBER = 1 << 24, CANONICAL = 1 << 25, LOADED = 1 << 26 };

/* A value that has been computed: of a node, in a row and column. */
struct computed {
    int32_t node, row, dx;
    bool canonical;
    uint32_t name, next; /* next: in its chain, + 1 */
};

struct accesses_seen {
    struct computed *list;
    int count, capacity;
    uint32_t chains[CHAINS];
    int *number; /* of a node that is a number: which, + 1 */
    int numbers;
};

void accesses_begin(struct accesses *a, const struct plan_graph *g, const struct vpset *set,
                    int stage)
{
    *a = (struct accesses){.g = g, .set = set, .stage = stage};
    a->seen = calloc(1, sizeof *a->seen);
    a->rows = calloc(8, sizeof *a->rows);
    a->rows_capacity = 8;
    a->rows_count = 1;
    if (a->seen)
        a->seen->number = calloc((size_t)g->count, sizeof *a->seen->number);
    a->failed = !a->seen || !a->seen->number || !a->rows;
}

void accesses_end(struct accesses *a)
{
    if (a->seen) {
        free(a->seen->list);
        free(a->seen->number);
    }
    free(a->seen);
    a->seen = NULL;
}

void accesses_finish(struct accesses *a)
{
    accesses_end(a);
    free(a->list);
    free(a->rows);
    free(a->form);
}

/* ---- the form ---- */

static void say(struct accesses *a, uint32_t x)
{
    if (a->form_count == a->form_capacity)
        a->form = array_more(a->form, &a->form_capacity, sizeof *a->form, &a->failed);
    if (!a->failed)
        a->form[a->form_count++] = x;
}

static void say_type(struct accesses *a, struct machine_type t)
{
    say(a, (uint32_t)t.kind << 24 | (uint32_t)t.width << 16 | (uint32_t)t.s << 8 | t.e);
}

bool accesses_same(const struct accesses *a, const struct accesses *b)
{
    return a->form_count == b->form_count &&
           (!a->form_count ||
            !memcmp(a->form, b->form, (size_t)a->form_count * sizeof *a->form));
}

/* ---- rows ---- */

static int row_moved(struct accesses *a, int from, int axis, int distance)
{
    struct row_offset wanted = a->rows[from];
    wanted.d[axis] = (wanted.d[axis] + distance) % a->set->dimensions[axis];
    for (int i = 0; i < a->rows_count; i++)
        if (!memcmp(&a->rows[i], &wanted, sizeof wanted))
            return i;
    if (a->rows_count == a->rows_capacity)
        a->rows = array_more(a->rows, &a->rows_capacity, sizeof *a->rows, &a->failed);
    if (a->failed)
        return 0;
    a->rows[a->rows_count] = wanted;
    return a->rows_count++;
}

/* Offsets are modulo the height. */
int row_down(const struct vpset *set, const struct row_offset *row)
{
    int height = set->dimensions[0], down = row->d[0] % height;
    return down > height / 2 ? down - height : down < -(height / 2) ? down + height : down;
}

int accesses_down(const struct accesses *a, const struct access *p)
{
    return row_down(a->set, &a->rows[p->row]);
}

/* ---- what is known ---- */

static uint32_t chain_of(int node, int row, int dx)
{
    uint32_t h =
        (uint32_t)node * 0x9e3779b1u ^ (uint32_t)row * 0x85ebca6bu ^ (uint32_t)dx * 0xc2b2ae35u;
    return h >> 24;
}

static const struct computed *find(const struct accesses_seen *s, int node, int row, int dx,
                                   bool canonical)
{
    for (uint32_t i = s->chains[chain_of(node, row, dx)]; i; i = s->list[i - 1].next) {
        const struct computed *c = &s->list[i - 1];
        if (c->node == node && c->row == row && c->dx == dx && c->canonical == canonical)
            return c;
    }
    return NULL;
}

static uint32_t keep(struct accesses *a, int node, int row, int dx, bool canonical)
{
    struct accesses_seen *s = a->seen;
    if (s->count == s->capacity)
        s->list = array_more(s->list, &s->capacity, sizeof *s->list, &a->failed);
    if (a->failed)
        return 0;
    uint32_t h = chain_of(node, row, dx), name = (uint32_t)s->count;
    s->list[s->count] = (struct computed){node, row, dx, canonical, name, s->chains[h]};
    s->chains[h] = (uint32_t)++s->count;
    return name;
}

/* ---- the walk ---- */

static bool takes_two_words(struct machine_type t)
{
    return t.kind == MACHINE_BITS && t.width > 64;
}

static uint32_t number_of(struct accesses *a, int node)
{
    struct accesses_seen *s = a->seen;
    struct machine_type type = a->g->nodes[node].type;
    if (!s->number[node]) {
        s->number[node] = ++s->numbers;
        say_type(a, type);
        a->wide = a->wide || takes_two_words(type);
    }
    return NUMBER | (uint32_t)s->number[node];
}

static void load(struct accesses *a, int node, int row, int dx)
{
    int i = 0;
    while (i < a->count && (a->list[i].node != node || a->list[i].row != row))
        i++;
    if (i == a->count && a->count == a->capacity)
        a->list = array_more(a->list, &a->capacity, sizeof *a->list, &a->failed);
    if (a->failed)
        return;
    if (i == a->count)
        a->list[a->count++] = (struct access){.node = node, .row = row};
    struct access *p = &a->list[i];
    p->low = dx < p->low ? dx : p->low;
    p->high = dx > p->high ? dx : p->high;
    a->loads++;
    say(a, LOADED | (uint32_t)i);
    say(a, (uint32_t)dx);
    say_type(a, a->g->nodes[node].type);
}

bool accesses_holds_bits(const struct plan_graph *g, int node)
{
    const struct plan_node *n = &g->nodes[node];
    if (!n->maybe_nan)
        return true;
    if (n->leaf || n->op != NODE_SELECT)
        return (n->op == NODE_SHIFT || n->op == NODE_CROSS) && !n->leaf
                   ? accesses_holds_bits(g, n->in[0])
                   : n->leaf;
    return accesses_holds_bits(g, n->in[1]) || accesses_holds_bits(g, n->in[2]);
}

static uint32_t walk(struct accesses *a, int node, int row, int dx, bool canonical);

/* A function of the place; of draws, of a number besides. */
static void generate(struct accesses *a, const struct plan_node *n, int row, int dx)
{
    bool by_column = n->op != NODE_COORDINATE || n->axis == a->set->rank - 1;
    say(a, n->op);
    say(a, n->axis);
    say(a, (uint32_t)n->detail);
    say_type(a, n->type);
    say(a, by_column ? (uint32_t)dx : (uint32_t)a->rows[row].d[n->axis]);
    say(a, (uint32_t)row);
    if (n->op == NODE_RANDOM)
        say(a, (uint32_t)++a->seen->numbers);
    a->cost += node_cost(n->op, n->type);
}

static void operate(struct accesses *a, const struct plan_node *n, int row, int dx,
                    bool canonical)
{
    uint32_t in[3] = {0};
    int inputs = node_ops[n->op].inputs;
    INVARIANT(n->op != NODE_GATHER &&
              n->op != NODE_CROSS); /* choose.c: kernels that are asked about have none */
    for (int k = 0; k < inputs; k++) {
        bool want = n->op == NODE_SELECT ? canonical : node_reads_bits(n->op);
        in[k] = walk(a, plan_input(a->g, n, k, a->stage), row, dx, want);
    }
    struct machine_type from = a->g->nodes[n->in[0]].type;
    enum op_soft soft = op_soft(n->op, n->type, from);
    a->ops++;
    a->cost += node_cost(n->op, n->type);
    a->wide = a->wide || takes_two_words(from) ||
              (node_ops[n->op].spell == SPELL_OVERFLOW && soft == OP_SOFT_NOT &&
               from.kind == MACHINE_BITS && from.width > 32);
    a->soft = a->soft || soft == OP_SOFT_LANES;
    say(a, n->op);
    say(a, (uint32_t)n->detail);
    say_type(a, n->type);
    for (int k = 0; k < inputs; k++)
        say(a, in[k]);
}

/* Returns what its value is called in the form. */
static uint32_t walk(struct accesses *a, int node, int row, int dx, bool canonical)
{
    const struct plan_node *n = &a->g->nodes[node];
    if (a->failed)
        return 0;
    if (n->constant)
        return number_of(a, node);
    bool loads = plan_loads(n, a->stage);
    canonical = n->maybe_nan && canonical && !loads;
    const struct computed *known = find(a->seen, node, row, dx, canonical);
    if (known)
        return known->name;
    a->wide = a->wide || takes_two_words(n->type);
    if (loads) {
        load(a, node, row, dx);
    } else if (n->op == NODE_SHIFT) {
        bool along_row = n->axis == a->set->rank - 1;
        int moved = along_row ? row : row_moved(a, row, n->axis, n->detail);
        return walk(a, n->in[0], moved, along_row ? dx + n->detail : dx, canonical);
    } else if (canonical && !(n->op == NODE_SELECT && accesses_holds_bits(a->g, node))) {
        uint32_t bare = walk(a, node, row, dx, false);
        say(a, CANONICAL | bare);
    } else if (node_ops[n->op].inputs == 0) {
        generate(a, n, row, dx);
    } else {
        operate(a, n, row, dx, canonical);
    }
    return a->failed ? 0 : keep(a, node, row, dx, canonical);
}

void accesses_add(struct accesses *a, int node, bool canonical)
{
    walk(a, node, 0, 0, canonical);
}

void accesses_find_bits(const struct plan_graph *g, bool *bits_matter)
{
    for (int i = g->count - 1; i >= 0; i--) {
        const struct plan_node *n = &g->nodes[i];
        bool bits = node_reads_bits(n->op) ||
                    ((n->op == NODE_SELECT || n->op == NODE_SHIFT || n->op == NODE_CROSS) &&
                     (n->target || bits_matter[i]));
        for (int k = 0; bits && !n->leaf && k < node_ops[n->op].inputs; k++) {
            bits_matter[n->in[k]] = true;
            if (n->instead[k] >= 0)
                bits_matter[n->instead[k]] = true;
        }
    }
}
