/* hand_graph.c - see hand_graph.h. */
#include "hand_graph.h"

#include <string.h>

#include "base/node_ops.h"

int hand_below(struct hand_graph *h, int n)
{
    h->chance = h->chance * 1664525u + 1013904223u;
    return (int)((h->chance >> 8) % (uint32_t)n);
}

void hand_begin(struct hand_graph *h, uint32_t seed)
{
    memset(h, 0, sizeof *h);
    h->g.nodes = h->nodes;
    h->chance = seed * 2654435761u + 12345u;
}

static int add(struct hand_graph *h, struct plan_node n)
{
    for (int k = 0; k < 3; k++)
        n.instead[k] = -1;
    n.set = n.constant ? 0 : 1;
    h->nodes[h->g.count] = n;
    return h->g.count++;
}

int hand_leaf(struct hand_graph *h, struct machine_type type)
{
    return add(h,
               (struct plan_node){
                   .op = NODE_BUFFER, .type = type, .leaf = true, .generator = GENERATOR_NONE});
}

int hand_number(struct hand_graph *h, struct machine_type type)
{
    return add(h, (struct plan_node){.op = NODE_CONSTANT, .type = type, .constant = true});
}

static uint8_t generator_of(const struct hand_graph *h, const struct plan_node *n)
{
    int sum = node_cost(n->op, n->type);
    for (int k = 0; k < node_ops[n->op].inputs; k++)
        sum += h->nodes[n->in[k]].generator;
    return sum < GENERATOR_NONE ? (uint8_t)sum : GENERATOR_NONE;
}

int hand_coordinate(struct hand_graph *h, int axis, int width)
{
    struct plan_node n = {
        .op = NODE_COORDINATE, .type = MACHINE_UINT(width), .axis = (uint8_t)axis};
    n.generator = generator_of(h, &n);
    return add(h, n);
}

int hand_node(struct hand_graph *h, int op, struct machine_type type, int a, int b, int c)
{
    struct plan_node n = {.op = (uint8_t)op, .type = type, .in = {a, b, c}};
    n.generator = generator_of(h, &n);
    if (type.kind == MACHINE_FLOAT)
        n.maybe_nan = node_ops[op].nan == NAN_ANY ||
                      (node_ops[op].nan != NAN_STRANGE && hand_below(h, 2));
    return add(h, n);
}

int hand_shift(struct hand_graph *h, int a, int axis, int distance)
{
    int i = hand_node(h, NODE_SHIFT, h->nodes[a].type, a, 0, 0);
    h->nodes[i].axis = (uint8_t)axis;
    h->nodes[i].detail = distance;
    h->nodes[i].maybe_nan = h->nodes[a].maybe_nan;
    return i;
}

/* ---- by chance ---- */

static struct machine_type type_by_chance(struct hand_graph *h)
{
    static const struct machine_type types[] = {
        {MACHINE_BITS, 1, 0, 0},    {MACHINE_BITS, 1, 0, 0},    {MACHINE_BITS, 5, 0, 0},
        {MACHINE_BITS, 8, 0, 0},    {MACHINE_BITS, 16, 0, 0},   {MACHINE_BITS, 32, 0, 0},
        {MACHINE_BITS, 40, 0, 0},   {MACHINE_BITS, 64, 0, 0},   {MACHINE_BITS, 100, 0, 0},
        {MACHINE_FLOAT, 32, 0, 0},  {MACHINE_FLOAT, 32, 0, 0},  {MACHINE_FLOAT, 64, 0, 0},
        {MACHINE_FLOAT, 64, 20, 8}, {MACHINE_FLOAT, 64, 40, 10}};
    /* one graph has few types, so that most nodes can be operands of each other */
    return types[(h->kind + 5 * hand_below(h, 3)) % (int)(sizeof types / sizeof *types)];
}

static bool same_type(struct machine_type a, struct machine_type b)
{
    return a.kind == b.kind && a.width == b.width && a.s == b.s && a.e == b.e;
}

/* Chooses a node of the type, mostly a recent one. Makes a leaf or a number where it finds
 * none. */
static int of_type(struct hand_graph *h, struct machine_type type)
{
    for (int tries = 0; tries < 12 && h->g.count; tries++) {
        int back = 1 + hand_below(h, tries < 6 && h->g.count > 12 ? 12 : h->g.count);
        if (same_type(h->nodes[h->g.count - back].type, type))
            return h->g.count - back;
    }
    return hand_below(h, 4) ? hand_leaf(h, type) : hand_number(h, type);
}

static int varying(struct hand_graph *h, struct machine_type type)
{
    int i = of_type(h, type);
    return h->nodes[i].constant ? hand_leaf(h, type) : i;
}

static void operation_by_chance(struct hand_graph *h, struct machine_type t)
{
    static const struct machine_type count = {MACHINE_BITS, 32, 0, 0};
    int op = hand_below(h, MACHINE_OP_COUNT_PUBLIC);
    while ((node_ops[op].takes == TAKES_FLOATS) != (t.kind == MACHINE_FLOAT))
        op = hand_below(h, MACHINE_OP_COUNT_PUBLIC);
    if (node_ops[op].spell == SPELL_INTEGER && t.width == 1)
        t = MACHINE_UINT(8);
    int a = varying(h, t), b = 0;
    if (node_ops[op].inputs == 2)
        b = of_type(h, node_ops[op].fold == FOLD_SHIFT ? count : t);
    hand_node(h, op, node_ops[op].gives == GIVES_BIT ? MACHINE_BIT : t, a, b, 0);
}

static void conversion_by_chance(struct hand_graph *h, struct machine_type t)
{
    if (t.kind == MACHINE_FLOAT) {
        int op = hand_below(h, 2) ? NODE_U_TO_F : NODE_S_TO_F;
        hand_node(h, op, t, varying(h, MACHINE_UINT(hand_below(h, 2) ? 16 : 40)), 0, 0);
        return;
    }
    int width = t.width + 1 + hand_below(h, 20);
    width = width > 128 ? 128 : width;
    switch (hand_below(h, 4)) {
    case 0:
        hand_node(h, NODE_ZERO_EXTEND, MACHINE_UINT(width), varying(h, t), 0, 0);
        break;
    case 1:
        hand_node(h, NODE_SIGN_EXTEND, MACHINE_UINT(width), varying(h, t), 0, 0);
        break;
    case 2:
        if (t.width > 1) {
            int i = hand_node(h, NODE_EXTRACT, MACHINE_UINT(1 + hand_below(h, t.width - 1)),
                              varying(h, t), 0, 0);
            h->nodes[i].detail = hand_below(h, t.width - h->nodes[i].type.width);
        }
        break;
    default:
        if (t.width <= 64)
            hand_node(h, NODE_CONCAT, MACHINE_UINT(2 * t.width), varying(h, t), varying(h, t),
                      0);
    }
}

static void node_by_chance(struct hand_graph *h, int rank)
{
    struct machine_type t = type_by_chance(h);
    switch (hand_below(h, 12)) {
    case 0:
        hand_leaf(h, t);
        break;
    case 1:
        if (hand_below(h, 2))
            hand_coordinate(h, hand_below(h, rank), hand_below(h, 2) ? 8 : 32);
        else
            hand_number(h, t);
        break;
    case 2:
    case 3:
        hand_shift(h, varying(h, t), hand_below(h, rank),
                   hand_below(h, 2) ? 1 + hand_below(h, 2) : -1 - hand_below(h, 2));
        break;
    case 4: {
        int c = varying(h, MACHINE_BIT), a = of_type(h, t), b = of_type(h, t);
        hand_node(h, NODE_SELECT, t, c, a, b);
        break;
    }
    case 5:
        conversion_by_chance(h, t);
        break;
    case 6:
        if (t.kind == MACHINE_FLOAT)
            hand_node(h, NODE_OVERFLOW_FADD + hand_below(h, 4), MACHINE_BIT, varying(h, t),
                      of_type(h, t), 0);
        else
            hand_node(h, NODE_OVERFLOW_UADD + hand_below(h, 6), MACHINE_BIT, varying(h, t),
                      of_type(h, t), 0);
        break;
    default:
        operation_by_chance(h, t);
        break;
    }
}

void hand_by_chance(struct hand_graph *h, int count, int rank)
{
    int last = h->g.count + count;
    h->kind = hand_below(h, 14);
    while (h->g.count < last)
        node_by_chance(h, rank);
    int targets = 1 + hand_below(h, 4);
    for (int i = h->g.count - 1; i >= 0 && targets; i--)
        if (!h->nodes[i].leaf && !h->nodes[i].constant) {
            h->nodes[i].target = true;
            targets--;
        }
}

void hand_prune(struct hand_graph *h)
{
    bool wanted[HAND_NODES_MOST];
    int place[HAND_NODES_MOST], count = 0;
    for (int i = h->g.count - 1; i >= 0; i--)
        wanted[i] = h->nodes[i].target;
    for (int i = h->g.count - 1; i >= 0; i--)
        for (int k = 0; wanted[i] && !h->nodes[i].leaf && k < node_ops[h->nodes[i].op].inputs;
             k++)
            wanted[h->nodes[i].in[k]] = true;
    for (int i = 0; i < h->g.count; i++) {
        if (!wanted[i])
            continue;
        place[i] = count;
        struct plan_node n = h->nodes[i];
        for (int k = 0; k < 3; k++)
            n.in[k] = !n.leaf && k < node_ops[n.op].inputs ? place[n.in[k]] : 0;
        h->nodes[count++] = n;
    }
    h->g.count = count;
}

/* ---- the VP set and the device that a graph is planned for ---- */

struct vpset hand_set(int rank, const int *dimensions, int halo)
{
    struct vpset s = {.used = true, .rank = rank, .halo = halo, .count = 1};
    for (int i = 0; i < rank; i++) {
        s.dimensions[i] = dimensions[i];
        s.count *= (uint64_t)dimensions[i];
    }
    s.width = dimensions[rank - 1];
    s.rows = s.count / (uint64_t)s.width;
    s.pitch = (size_t)(s.width + 2 * halo);
    return s;
}

struct device_shape hand_shape(void)
{
    return (struct device_shape){.vector = 8,
                                 .halo = 32,
                                 .op_ns = 0.1,
                                 .byte_ns = 0.3,
                                 .near_byte_ns = 0.03,
                                 .launch_ns = 5000,
                                 .near_bytes = 1 << 20,
                                 .strip_columns = 512,
                                 .strip_least = 128,
                                 .pass_cost = 600,
                                 .arrays_foreseen = 16,
                                 .fetch_bytes = 4 << 20,
                                 .stream_bytes = 48 << 20,
                                 .in_place_bytes = 12 << 20,
                                 .run_columns = 512,
                                 .strips_each = 4,
                                 .units = 2,
                                 .turns = 8,
                                 .narrow = true,
                                 .keeps_nan = true};
}
