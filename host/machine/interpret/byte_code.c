/* byte_code.c - a plan's nodes become byte code: see byte_code.h. */
#include "interpret/byte_code.h"

#include <stdlib.h>
#include <string.h>

#include "base/arrays.h"
#include "base/errors.h"
#include "device/shape.h"
#include "interpret/node_loops.h"
#include "interpret/picks.h"

enum { NO_PLACE = -1 };

/* While a program is made. */
struct making {
    struct byte_code *p;
    const struct device_shape *shape;
    const struct plan_graph *g;
    const struct vpset *set;
    int stage, processors_log2;
    int *place; /* of a node */
    int *owner; /* the node whose place it shares; most: itself */
    int *last;  /* of an owner: the last node that takes it */
    bool *needed, *output;
    struct picks *picks;
    bool streams;             /* what is stored goes past the caches */
    int *idle[LANES_CLASSES]; /* registers in use no more: places */
    int idle_count[LANES_CLASSES], idle_capacity[LANES_CLASSES];
};

/* ---- places ---- */

/* The place of a node's values. No place is read before it is set. */
static int place_read(const struct making *k, int node)
{
    const int place = k->place[node];
    INVARIANT(k->p->failed || (place >= 0 && place < k->p->places_count));
    return place;
}

static int register_get(struct making *k, enum lanes_class c)
{
    c = lanes_bits_of(c);
    if (k->idle_count[c])
        return k->idle[c][--k->idle_count[c]];
    return byte_code_place(k->p, PLACE_REGISTER, (int)lanes_bytes(c));
}

static void register_put(struct making *k, int place)
{
    if (k->p->failed || k->p->places[place].kind != PLACE_REGISTER)
        return;
    int c = 0;
    while (lanes_bytes((enum lanes_class)c) != k->p->places[place].bytes)
        c++;
    if (k->idle_count[c] == k->idle_capacity[c])
        k->idle[c] =
            array_more(k->idle[c], &k->idle_capacity[c], sizeof *k->idle[c], &k->p->failed);
    if (!k->p->failed)
        k->idle[c][k->idle_count[c]++] = place;
}

/* A chain of shifts: along each axis so far. */
static int place_moved(struct making *k, int node)
{
    struct byte_code *p = k->p;
    const struct vpset *set = k->set;
    enum lanes_class c = lanes_class_of(k->g->nodes[node].type);
    int32_t *further = calloc((size_t)set->rank, sizeof *further);
    if (!further) {
        p->failed = true;
        return 0;
    }
    for (; k->g->nodes[node].op == NODE_SHIFT && !k->g->nodes[node].leaf;
         node = k->g->nodes[node].in[0]) {
        const struct plan_node *n = &k->g->nodes[node];
        further[n->axis] =
            (int32_t)(((int64_t)further[n->axis] + n->detail) % set->dimensions[n->axis]);
    }
    byte_code_argument_add(p, ARGUMENT_INPUT, node);
    p->moves = true;
    return byte_code_place_add(p, (struct place){.kind = PLACE_MOVED,
                                                 .bytes = (uint8_t)lanes_bytes(c),
                                                 .node = node,
                                                 .offset = byte_code_room(p, lanes_bits_of(c)),
                                                 .further = further});
}

/* An array's other blocks, whose processors' indices differ in a number's bits. */
static int place_crossed(struct making *k, int node, int bits)
{
    byte_code_argument_add(k->p, ARGUMENT_INPUT, node);
    return byte_code_place_add(k->p, (struct place){.kind = PLACE_CROSSED,
                                                    .bytes = (uint8_t)lanes_bytes(
                                                        lanes_class_of(k->g->nodes[node].type)),
                                                    .node = node,
                                                    .offset = byte_code_room(k->p, LANES_U8),
                                                    .bits = bits});
}

/* What is not computed here. */
static int place_given(struct making *k, int node)
{
    const struct plan_node *n = &k->g->nodes[node];
    enum lanes_class c = lanes_class_of(n->type);
    struct place place = {.bytes = (uint8_t)lanes_bytes(c), .node = node};
    if (n->constant) {
        place.kind = PLACE_NUMBER;
        place.offset = byte_code_room(k->p, lanes_bits_of(c));
    } else {
        place.kind = PLACE_ARRAY;
        byte_code_argument_add(k->p, ARGUMENT_INPUT, node);
    }
    return byte_code_place_add(k->p, place);
}

/* ---- steps ---- */

static double step_ns(const struct device_shape *shape, lanes_function *run, int op)
{
    bool is_node = op < NODE_OP_COUNT;
    if (run == lane_each)
        return is_node && op_is_math(op) ? shape->each_math_ns : shape->each_ns;
    return shape->loop_ns +
           (is_node && op_is_integer(op) ? shape->loop_cost_ns * node_ops[op].cost : 0);
}

static struct lanes_step *step_add(struct making *k, lanes_function *run, int op, int to)
{
    static struct lanes_step none;
    struct byte_code *p = k->p;
    if (p->steps_count == p->steps_capacity)
        p->steps = array_more(p->steps, &p->steps_capacity, sizeof *p->steps, &p->failed);
    if (p->failed)
        return &none;
    struct lanes_step *s = &p->steps[p->steps_count++];
    p->lane_s += 1e-9 * step_ns(k->shape, run, op);
    p->each = p->each || run == lane_each;
    *s = (struct lanes_step){
        .run = run, .op = (uint16_t)op, .to = (uint16_t)to, .mask = ~(lanes_wide)0};
    return s;
}

/* One operand, of one type, becomes another. */
static struct lanes_step *step_one(struct making *k, lanes_function *run, int op, int to,
                                   struct machine_type type, int in, struct machine_type from,
                                   int detail)
{
    struct lanes_step *s = step_add(k, run ? run : lane_each, op, to);
    s->in[0] = (uint16_t)in;
    s->from = from;
    s->type = type;
    s->detail = detail;
    s->mask = lanes_mask(type);
    return s;
}

/* Bits of one width as those of another, from bit `down` on. */
static void step_resized(struct making *k, int to, struct machine_type type, int in,
                         struct machine_type from, int down)
{
    step_one(
        k, lanes_find_conversion(NODE_ZERO_EXTEND, lanes_class_of(from), lanes_class_of(type)),
        NODE_ZERO_EXTEND, to, type, in, from, down);
}

static void step_copied(struct making *k, int to, struct machine_type type, int in)
{
    step_one(k, lanes_find(LANES_COPY, lanes_bits_of(lanes_class_of(type))), LANES_COPY, to,
             type, in, type, 0);
}

/* A function of places: an index of 32 bits first. */
static void step_generated(struct making *k, const struct plan_node *n, int node, int to)
{
    struct machine_type index = MACHINE_UINT(32), drawn = MACHINE_UINT(64);
    bool direct = n->type.width == 32 && (n->op == NODE_COORDINATE || n->op == NODE_INDEX);
    int at = direct ? to : register_get(k, LANES_U32);
    struct lanes_step *s = step_add(k, NULL, n->op == NODE_COORDINATE ? n->op : NODE_INDEX, at);
    s->axis = n->axis;
    if (direct)
        return;
    if (n->op == NODE_SEND_ADDRESS) {
        int placed = register_get(k, LANES_U32);
        step_one(k, lanes_find(LANES_PLACE, LANES_U32), LANES_PLACE, placed, index, at, index,
                 k->processors_log2);
        k->p->steps[k->p->steps_count - 1].mask = k->set->ratio;
        step_resized(k, to, n->type, placed, index, 0);
        register_put(k, placed);
    } else if (n->op == NODE_RANDOM) {
        int number = byte_code_place_add(
                k->p, (struct place){.kind = PLACE_DRAW,
                                     .bytes = 8,
                                     .node = node,
                                     .offset = byte_code_room(k->p, LANES_U64)}),
            random = register_get(k, LANES_U64);
        s = step_add(k, lanes_find(LANES_DRAW, LANES_U32), LANES_DRAW, random);
        s->in[0] = (uint16_t)at;
        s->in[1] = (uint16_t)number;
        s->from = index;
        s->type = n->type;
        s->detail = n->detail;
        step_resized(k, to, n->type, random, drawn, 0);
        register_put(k, random);
    } else {
        step_resized(k, to, n->type, at, index, 0);
    }
    register_put(k, at);
}

static void step_joined(struct making *k, const struct plan_node *n, int to, const int in[3])
{
    struct machine_type low = k->g->nodes[n->in[0]].type, high = k->g->nodes[n->in[1]].type;
    enum lanes_class c = lanes_class_of(n->type);
    int a = register_get(k, c), b = register_get(k, c);
    step_resized(k, a, n->type, in[0], low, 0);
    step_resized(k, b, n->type, in[1], high, 0);
    struct lanes_step *s = step_add(k, lanes_find(LANES_JOIN, c), LANES_JOIN, to);
    s->in[0] = (uint16_t)a;
    s->in[1] = (uint16_t)b;
    s->from = s->type = n->type;
    s->detail = low.width;
    register_put(k, a);
    register_put(k, b);
}

/* What is in an array at a place: nobody's lanes in particular, so the array is taken as it
 * is. */
static void step_fetched(struct making *k, const struct plan_node *n, int to, const int in[3])
{
    enum lanes_class c = lanes_bits_of(lanes_class_of(n->type));
    int array = byte_code_place_add(k->p, (struct place){.kind = PLACE_WHOLE,
                                                         .bytes = (uint8_t)lanes_bytes(c),
                                                         .node = n->in[1]});
    byte_code_argument_add(k->p, ARGUMENT_INPUT, n->in[1]);
    struct lanes_step *s = step_add(k, lanes_find(LANES_FETCH, c), LANES_FETCH, to);
    s->in[0] = (uint16_t)in[0];
    s->in[1] = (uint16_t)array;
    s->in[2] = (uint16_t)in[2];
    s->from = MACHINE_UINT(32);
    s->type = n->type;
    k->p->lane_s += 1e-9 * k->shape->gather_ns;
}

/* An element of the array in each processor: the index is one of 32 bits. */
static void step_picked(struct making *k, const struct plan_node *n, int to,
                        const struct pick *pick)
{
    struct machine_type from = k->g->nodes[pick->index].type, index = MACHINE_UINT(32);
    enum lanes_class c = lanes_bits_of(lanes_class_of(n->type));
    int at = place_read(k, pick->index),
        widened = lanes_class_of(from) == LANES_U32 ? NO_PLACE : register_get(k, LANES_U32);
    if (widened != NO_PLACE)
        step_resized(k, at = widened, index, place_read(k, pick->index), from, 0);
    uint16_t *list = malloc((2 * (size_t)pick->count + 1) * sizeof *list);
    if (!list) {
        k->p->failed = true;
        return;
    }
    for (int i = 0; i < pick->count; i++) {
        list[2 * i] = (uint16_t)place_read(k, pick->keys[i]);
        list[2 * i + 1] = (uint16_t)place_read(k, pick->values[i]);
    }
    list[2 * pick->count] = (uint16_t)place_read(k, pick->rest);
    struct lanes_step *s = step_add(k, lanes_find(LANES_PICK, c), LANES_PICK, to);
    s->in[0] = (uint16_t)at;
    s->from = from;
    s->type = n->type;
    s->detail = pick->count;
    s->list = list;
    if (k->p->failed) /* nobody has the list */
        free(list);
    k->p->lane_s += 1e-9 * k->shape->pick_ns;
    if (widened != NO_PLACE)
        register_put(k, widened);
}

/* A choice within a choice that leaves the same as it is: one choice, where both bits hold. */
static void step_chosen(struct making *k, const struct plan_node *n, int to,
                        const struct plan_node *inner)
{
    const struct machine_type bit = MACHINE_UINT(1);
    int both = register_get(k, LANES_U8);
    struct lanes_step *s = step_add(k, lanes_find(MACHINE_AND, LANES_U8), MACHINE_AND, both);
    s->in[0] = (uint16_t)place_read(k, n->in[0]);
    s->in[1] = (uint16_t)place_read(k, inner->in[0]);
    s->from = s->type = bit;
    s->mask = 1;
    s = step_add(k, lanes_find(NODE_SELECT, lanes_bits_of(lanes_class_of(n->type))),
                 NODE_SELECT, to);
    s->in[0] = (uint16_t)both;
    s->in[1] = (uint16_t)place_read(k, inner->in[1]);
    s->in[2] = (uint16_t)place_read(k, n->in[2]);
    s->from = bit;
    s->type = n->type;
    s->mask = lanes_mask(n->type);
    register_put(k, both);
}

static void step_canonical(struct making *k, const struct plan_node *n, int to)
{
    if (n->maybe_nan)
        step_one(k, lanes_find(LANES_CANONICAL, lanes_class_of(n->type)), LANES_CANONICAL, to,
                 n->type, to, n->type, 0);
}

/* A sum or difference and the product that is one of its operands. */
static void step_product_sum(struct making *k, const struct plan_node *n, int to, int product)
{
    const struct plan_node *t = &k->g->nodes[n->in[product]];
    struct lanes_step *s = step_add(k, lanes_find(LANES_PRODUCT_SUM, lanes_class_of(n->type)),
                                    LANES_PRODUCT_SUM, to);
    s->in[0] = (uint16_t)place_read(k, t->in[0]);
    s->in[1] = (uint16_t)place_read(k, t->in[1]);
    s->in[2] = (uint16_t)place_read(k, n->in[1 - product]);
    s->from = s->type = n->type;
    s->detail = (product ? 0 : 2) + (n->op == MACHINE_FSUB);
    step_canonical(k, n, to);
}

static void step_operation(struct making *k, const struct plan_node *n, int to, const int in[3])
{
    struct machine_type from = k->g->nodes[n->in[0]].type;
    enum lanes_class c = lanes_class_of(n->type);
    if (n->op == NODE_CONCAT) {
        step_joined(k, n, to, in);
        return;
    }
    lanes_function *loop = node_loop(n, from);
    struct lanes_step *s = step_add(k, loop ? loop : lane_each, n->op, to);
    for (int i = 0; i < node_ops[n->op].inputs; i++)
        s->in[i] = (uint16_t)in[i];
    s->from = from;
    s->type = n->type;
    s->detail = n->op == NODE_EXTRACT ? n->detail : 0;
    if (node_ops[n->op].fold == FOLD_SHIFT) /* all by one number? */
        s->detail = k->g->nodes[n->in[1]].constant;
    s->mask = lanes_mask(n->type);
    if (node_rounds(n, from))
        step_one(k, type_is_short(n->type) ? lanes_find(LANES_FIT, c) : NULL, LANES_FIT, to,
                 n->type, to, n->type, 0);
    if (n->op != NODE_SELECT)
        step_canonical(k, n, to);
}

/* ---- nodes ---- */

/* What its steps take, k-th; a chain of shifts takes what it begins with. */
static bool loads(const struct making *k, int node)
{
    return plan_loads(&k->g->nodes[node], k->stage);
}

/* Whether it takes operand j lane by lane; else from memory. */
static bool takes(const struct plan_node *n, int j)
{
    const bool crosses = n->detail == CROSS_LANES || (j == 1 && n->detail == CROSS_BOTH);
    return n->op == NODE_GATHER ? j != 1 : n->op != NODE_CROSS || crosses;
}

enum { OPERANDS_MOST = 2 * PICK_MOST + 2 };

/* The nodes that a node's steps take lane by lane. Returns how many. */
static int operands_find(const struct making *k, int node, const struct pick *pick,
                         int operands[OPERANDS_MOST])
{
    const struct plan_node *n = &k->g->nodes[node];
    const int inner = pick ? -1 : picks_inner(k->picks, node),
              product = picks_product(k->picks, node);
    int count = 0;
    if (pick) {
        operands[count++] = pick->index;
        operands[count++] = pick->rest;
        for (int i = 0; i < pick->count; i++) {
            operands[count++] = pick->keys[i];
            operands[count++] = pick->values[i];
        }
        return count;
    }
    if (product >= 0) {
        for (int j = 0; j < 2; j++)
            operands[count++] = k->g->nodes[n->in[product]].in[j];
        operands[count++] = n->in[1 - product];
        return count;
    }
    for (int j = 0; j < node_ops[n->op].inputs; j++)
        if (takes(n, j) && n->in[j] != inner)
            operands[count++] = n->in[j];
    for (int j = 0; inner >= 0 && j < 2; j++)
        operands[count++] = k->g->nodes[inner].in[j];
    return count;
}

static void find_needed(struct making *k, const int *stores, int count)
{
    int operands[OPERANDS_MOST];
    const struct plan_graph *g = k->g;
    for (int i = 0; i < count; i++)
        k->needed[stores[i]] = k->output[stores[i]] = true;
    for (int i = g->count - 1; i >= 0; i--) {
        const struct plan_node *n = &g->nodes[i];
        k->owner[i] = i;
        k->place[i] = NO_PLACE;
        if (!k->needed[i] || n->constant || loads(k, i) || n->op == NODE_SHIFT)
            continue;
        for (int j = operands_find(k, i, picks_find(k->picks, i), operands); j--;)
            k->needed[operands[j]] = true;
    }
    for (int i = 0; i < g->count; i++) {
        const struct plan_node *n = &g->nodes[i];
        if (!k->needed[i] || n->constant || loads(k, i) || n->op == NODE_SHIFT)
            continue;
        if (n->op == NODE_REINTERPRET && !k->output[i])
            k->owner[i] = k->owner[n->in[0]];
        for (int j = operands_find(k, i, picks_at(k->picks, i), operands); j--;)
            k->last[k->owner[operands[j]]] = i;
    }
}

static int place_of_array(struct making *k, int node)
{
    byte_code_argument_add(k->p, ARGUMENT_OUTPUT, node);
    return byte_code_place_add(k->p, (struct place){.kind = PLACE_ARRAY,
                                                    .bytes = (uint8_t)lanes_bytes(
                                                        lanes_class_of(k->g->nodes[node].type)),
                                                    .node = node});
}

static int place_of_result(struct making *k, int node)
{
    return k->output[node] && !k->streams
               ? place_of_array(k, node)
               : register_get(k, lanes_class_of(k->g->nodes[node].type));
}

/* Other blocks, and within a block other lanes. */
static void node_cross(struct making *k, int node, const int in[3])
{
    const struct plan_node *n = &k->g->nodes[node];
    const enum lanes_class c = lanes_bits_of(lanes_class_of(n->type));
    const int op = n->detail == CROSS_BLOCKS ? LANES_COPY : LANES_CROSS;
    INVARIANT(takes(n, 0) || loads(k, n->in[0]));
    const int from = takes(n, 0) ? in[0] : place_crossed(k, n->in[0], n->in[1]);
    const bool names = op == LANES_COPY && !k->output[node];
    k->p->crosses |= !loads(k, n->in[0]);
    const int to = k->place[node] = names ? from : place_of_result(k, node);
    if (!names)
        step_one(k, lanes_find(op, c), op, to, n->type, from, n->type, 0)->in[1] =
            (uint16_t)in[1];
}

/* A block of results from a register to the array, past the caches. */
static void step_streamed(struct making *k, int node)
{
    const struct machine_type type = k->g->nodes[node].type;
    if (!k->output[node] || !k->streams)
        return;
    step_one(k, lanes_find(LANES_STREAM, lanes_bits_of(lanes_class_of(type))), LANES_STREAM,
             place_of_array(k, node), type, place_read(k, node), type, 0);
    if (k->last[node] <= node) /* nobody else takes it */
        register_put(k, place_read(k, node));
}

/* A node's steps into its place: all but what only names another place. */
static void node_steps(struct making *k, int node, const int in[3])
{
    const struct plan_node *n = &k->g->nodes[node];
    const struct pick *pick = picks_at(k->picks, node);
    const int inner = picks_inner(k->picks, node), product = picks_product(k->picks, node),
              to = place_of_result(k, node);
    k->place[node] = to;
    if (node_ops[n->op].inputs == 0)
        step_generated(k, n, node, to);
    else if (n->op == NODE_GATHER)
        step_fetched(k, n, to, in);
    else if (n->op == NODE_REINTERPRET)
        step_copied(k, to, n->type, in[0]);
    else if (pick)
        step_picked(k, n, to, pick);
    else if (inner >= 0)
        step_chosen(k, n, to, &k->g->nodes[inner]);
    else if (product >= 0)
        step_product_sum(k, n, to, product);
    else
        step_operation(k, n, to, in);
}

static void node_compute(struct making *k, int node)
{
    const struct plan_node *n = &k->g->nodes[node];
    const struct pick *pick = picks_at(k->picks, node);
    int in[3] = {0, 0, 0}, operands[OPERANDS_MOST];
    if (n->constant || loads(k, node)) {
        k->place[node] = place_given(k, node);
        return;
    }
    if (n->op == NODE_SHIFT) {
        int moved = place_moved(k, node);
        k->place[node] = moved;
        if (k->output[node]) {
            step_copied(k, k->place[node] = place_of_result(k, node), n->type, moved);
            step_streamed(k, node);
        }
        return;
    }
    /* Steps of several nodes find their operands themselves: the nodes in between have no
     * places. */
    const bool of_one =
        !pick && picks_inner(k->picks, node) < 0 && picks_product(k->picks, node) < 0;
    for (int j = 0; of_one && j < node_ops[n->op].inputs; j++)
        in[j] = takes(n, j) ? place_read(k, n->in[j]) : 0;
    if (k->owner[node] != node) {
        k->place[node] = in[0];
        return;
    }
    if (n->op == NODE_CROSS)
        node_cross(k, node, in);
    else
        node_steps(k, node, in);
    step_streamed(k, node);
    k->p->ops++;
    k->p->cost += node_cost(n->op, n->type);
    for (int j = operands_find(k, node, pick, operands); j--;) {
        int owner = k->owner[operands[j]];
        if (k->last[owner] == node) {
            k->last[owner] = -1; /* once, if it is two operands */
            register_put(k, place_read(k, owner));
        }
    }
}

/* Whether the arrays are so large that nothing of them is in the caches when somebody looks at
 * them next. */
static bool are_streamed(const struct making *k)
{
    double bytes = 0;
    for (int i = 0; i < k->g->count; i++)
        if (k->needed[i] && !k->g->nodes[i].constant && (k->output[i] || loads(k, i)))
            bytes += (double)type_bytes(k->g->nodes[i].type) * (double)k->set->count;
    return shape_streams_lanes(k->shape, bytes);
}

struct byte_code *byte_code_make(const struct device_shape *shape, const struct plan_graph *g,
                                 const int *stores, int count, const struct vpset *set,
                                 int processors_log2, bool at_hand)
{
    size_t nodes = (size_t)g->count;
    struct byte_code *p = calloc(1, sizeof *p);
    struct making k = {.p = p,
                       .shape = shape,
                       .g = g,
                       .set = set,
                       .stage = g->nodes[stores[0]].stage,
                       .processors_log2 = processors_log2,
                       .place = calloc(nodes, sizeof *k.place),
                       .owner = calloc(nodes, sizeof *k.owner),
                       .last = calloc(nodes, sizeof *k.last),
                       .needed = calloc(nodes, sizeof *k.needed),
                       .output = calloc(nodes, sizeof *k.output),
                       .picks = picks_create(g, g->nodes[stores[0]].stage, at_hand)};
    bool good = p && k.place && k.owner && k.last && k.needed && k.output && k.picks;
    if (good) {
        find_needed(&k, stores, count);
        p->streams = k.streams = at_hand && are_streamed(&k);
        for (int i = 0; i < g->count && !p->failed; i++)
            if (k.needed[i])
                node_compute(&k, i);
        for (int i = 0; i < p->arguments_count; i++)
            p->lane_bytes += (int)type_bytes(g->nodes[p->arguments[i].node].type);
        good = !p->failed && p->places_count <= UINT16_MAX;
        p->far = set->count >= shape->ahead_from;
        if (good && at_hand) {
            byte_code_along(p, set);
            byte_code_guards(p);
        }
        good = good && !p->failed && p->places_count <= UINT16_MAX;
        if (good && set->width > BLOCK_LANES)
            byte_code_ahead(p);
    }
    for (int c = 0; c < LANES_CLASSES; c++)
        free(k.idle[c]);
    free(k.place);
    free(k.owner);
    free(k.last);
    free(k.needed);
    free(k.output);
    picks_free(k.picks);
    if (!good) {
        byte_code_free(p);
        return NULL;
    }
    return p;
}
