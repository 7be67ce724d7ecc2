/* byte_code.c - a plan's nodes become byte code: see byte_code.h. */
#include "interpret/byte_code.h"

#include <stdlib.h>
#include <string.h>

#include "base/arrays.h"
#include "base/scalar.h"
#include "device/shape.h"

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
    bool streams;             /* what is stored goes past the caches */
    int *idle[LANES_CLASSES]; /* registers in use no more: places */
    int idle_count[LANES_CLASSES], idle_capacity[LANES_CLASSES];
};

/* ---- stages ---- */

/* What a chain of shifts begins with. */
static int root_of(const struct plan_graph *g, int node)
{
    while (g->nodes[node].op == NODE_SHIFT && !g->nodes[node].leaf)
        node = g->nodes[node].in[0];
    return node;
}

/* Each stage makes it anew: it is read from what is stored anyway, or is a cheap function of places. Were that stored, later
 * plans would find it in memory, and no kernel of theirs could tell from a test of coordinates which rows it concerns. */
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

/* ---- places ---- */

static int place_add(struct byte_code *p, struct place place)
{
    if (p->places_count == p->places_capacity)
        p->places = array_more(p->places, &p->places_capacity, sizeof *p->places, &p->failed);
    if (p->failed) {
        free(place.further);
        return 0;
    }
    p->places[p->places_count] = place;
    return p->places_count++;
}

/* Room for a block of lanes; each begins a line of the caches. */
static size_t room(struct byte_code *p, enum lanes_class c)
{
    size_t at = p->registers_bytes;
    p->registers_bytes += BLOCK_LANES * lanes_bytes(c) + 64;
    return at;
}

static int register_get(struct making *k, enum lanes_class c)
{
    c = lanes_bits_of(c);
    if (k->idle_count[c])
        return k->idle[c][--k->idle_count[c]];
    return place_add(k->p, (struct place){.kind = PLACE_REGISTER,
                                          .bytes = (uint8_t)lanes_bytes(c),
                                          .node = -1,
                                          .offset = room(k->p, c)});
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

static void argument_add(struct byte_code *p, int kind, int node)
{
    for (int i = 0; i < p->arguments_count; i++)
        if (p->arguments[i].kind == kind && p->arguments[i].node == node)
            return;
    if (p->arguments_count == p->arguments_capacity)
        p->arguments =
            array_more(p->arguments, &p->arguments_capacity, sizeof *p->arguments, &p->failed);
    if (!p->failed)
        p->arguments[p->arguments_count++] =
            (struct kernel_argument){.kind = (uint8_t)kind, .node = node};
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
    argument_add(p, ARGUMENT_INPUT, node);
    p->moves = true;
    return place_add(p, (struct place){.kind = PLACE_MOVED,
                                       .bytes = (uint8_t)lanes_bytes(c),
                                       .node = node,
                                       .offset = room(p, lanes_bits_of(c)),
                                       .further = further});
}

/* What is not computed here. */
static int place_given(struct making *k, int node)
{
    const struct plan_node *n = &k->g->nodes[node];
    enum lanes_class c = lanes_class_of(n->type);
    struct place place = {.bytes = (uint8_t)lanes_bytes(c), .node = node};
    if (n->constant) {
        place.kind = PLACE_NUMBER;
        place.offset = room(k->p, lanes_bits_of(c));
    } else {
        place.kind = PLACE_ARRAY;
        argument_add(k->p, ARGUMENT_INPUT, node);
    }
    return place_add(k->p, place);
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
    *s = (struct lanes_step){
        .run = run, .op = (uint16_t)op, .to = (uint16_t)to, .mask = ~(lanes_wide)0};
    return s;
}

static lanes_wide mask_of(struct machine_type t)
{
    struct machine_scalar ones = scalar_ones(t.width);
    return (lanes_wide)ones.hi << 64 | ones.lo;
}

/* One operand, of one type, becomes another. */
static void step_one(struct making *k, lanes_function *run, int op, int to,
                     struct machine_type type, int in, struct machine_type from, int detail)
{
    struct lanes_step *s = step_add(k, run ? run : lane_each, op, to);
    s->in[0] = (uint16_t)in;
    s->from = from;
    s->type = type;
    s->detail = detail;
    s->mask = mask_of(type);
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
        int number = place_add(k->p, (struct place){.kind = PLACE_DRAW,
                                                    .bytes = 8,
                                                    .node = node,
                                                    .offset = room(k->p, LANES_U64)}),
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

static bool is_short(struct machine_type t)
{
    return t.s <= 24 && t.e <= 9;
}

/* Floats of other formats: what is not as with doubles, but for being rounded again. */
static bool is_soft(const struct plan_node *n, struct machine_type from)
{
    struct machine_type t = n->type.s ? n->type : from;
    if (!t.s)
        return false;
    switch (n->op) {
    case MACHINE_FADD:
    case MACHINE_FSUB:
    case MACHINE_FMUL:
    case MACHINE_FDIV:
    case MACHINE_FSQRT:
        return !is_short(t);
    case NODE_OVERFLOW_FADD:
    case NODE_OVERFLOW_FSUB:
    case NODE_OVERFLOW_FMUL:
    case NODE_OVERFLOW_FDIV:
    case NODE_PACK:
    case NODE_UNPACK:
        return true;
    case NODE_U_TO_F:
    case NODE_S_TO_F:
        return from.width > 32;
    default:
        return false;
    }
}

static bool rounds(const struct plan_node *n)
{
    return n->type.s && n->op != MACHINE_FNEG && n->op != MACHINE_FABS &&
           n->op != MACHINE_FMIN && n->op != MACHINE_FMAX && n->op != NODE_SELECT;
}

static lanes_function *loop_of(const struct plan_node *n, struct machine_type from)
{
    enum lanes_class a = lanes_class_of(from), to = lanes_class_of(n->type);
    if (is_soft(n, from))
        return NULL;
    if (n->op == NODE_SELECT)
        return lanes_find(n->op, lanes_bits_of(to));
    lanes_function *loop = lanes_find_conversion(n->op, a, to);
    return loop ? loop : lanes_find(n->op, a);
}

/* What is in an array at a place: nobody's lanes in particular, so the array is taken as it is. */
static void step_fetched(struct making *k, const struct plan_node *n, int to, const int in[3])
{
    enum lanes_class c = lanes_bits_of(lanes_class_of(n->type));
    int array = place_add(k->p, (struct place){.kind = PLACE_WHOLE,
                                               .bytes = (uint8_t)lanes_bytes(c),
                                               .node = n->in[1]});
    argument_add(k->p, ARGUMENT_INPUT, n->in[1]);
    struct lanes_step *s = step_add(k, lanes_find(LANES_FETCH, c), LANES_FETCH, to);
    s->in[0] = (uint16_t)in[0];
    s->in[1] = (uint16_t)array;
    s->in[2] = (uint16_t)in[2];
    s->from = MACHINE_UINT(32);
    s->type = n->type;
    k->p->lane_s += 1e-9 * k->shape->gather_ns;
}

static void step_operation(struct making *k, const struct plan_node *n, int to, const int in[3])
{
    struct machine_type from = k->g->nodes[n->in[0]].type;
    enum lanes_class c = lanes_class_of(n->type);
    if (n->op == NODE_CONCAT) {
        step_joined(k, n, to, in);
        return;
    }
    lanes_function *loop = loop_of(n, from);
    struct lanes_step *s = step_add(k, loop ? loop : lane_each, n->op, to);
    for (int i = 0; i < node_ops[n->op].inputs; i++)
        s->in[i] = (uint16_t)in[i];
    s->from = from;
    s->type = n->type;
    s->detail = n->op == NODE_EXTRACT ? n->detail : 0;
    if (node_ops[n->op].fold == FOLD_SHIFT) /* all by one number? */
        s->detail = k->g->nodes[n->in[1]].constant;
    s->mask = mask_of(n->type);
    if (rounds(n))
        step_one(k, is_short(n->type) ? lanes_find(LANES_FIT, c) : NULL, LANES_FIT, to, n->type,
                 to, n->type, 0);
    if (n->maybe_nan && n->op != NODE_SELECT)
        step_one(k, lanes_find(LANES_CANONICAL, c), LANES_CANONICAL, to, n->type, to, n->type,
                 0);
}

/* ---- nodes ---- */

/* What its steps take, k-th; a chain of shifts takes what it begins with. */
static bool loads(const struct making *k, int node)
{
    return plan_loads(&k->g->nodes[node], k->stage);
}

/* Whether it takes operand j lane by lane; else whole, from memory. */
static bool takes(const struct plan_node *n, int j)
{
    return n->op != NODE_GATHER || j != 1;
}

static void find_needed(struct making *k, const int *stores, int count)
{
    const struct plan_graph *g = k->g;
    for (int i = 0; i < count; i++)
        k->needed[stores[i]] = k->output[stores[i]] = true;
    for (int i = g->count - 1; i >= 0; i--) {
        const struct plan_node *n = &g->nodes[i];
        k->owner[i] = i;
        k->place[i] = NO_PLACE;
        if (!k->needed[i] || n->constant || loads(k, i) || n->op == NODE_SHIFT)
            continue;
        for (int j = 0; j < node_ops[n->op].inputs; j++)
            k->needed[n->in[j]] = k->needed[n->in[j]] || takes(n, j);
    }
    for (int i = 0; i < g->count; i++) {
        const struct plan_node *n = &g->nodes[i];
        if (!k->needed[i] || n->constant || loads(k, i) || n->op == NODE_SHIFT)
            continue;
        if (n->op == NODE_REINTERPRET && !k->output[i])
            k->owner[i] = k->owner[n->in[0]];
        for (int j = 0; j < node_ops[n->op].inputs; j++)
            if (takes(n, j))
                k->last[k->owner[n->in[j]]] = i;
    }
}

static int place_of_array(struct making *k, int node)
{
    argument_add(k->p, ARGUMENT_OUTPUT, node);
    return place_add(k->p, (struct place){.kind = PLACE_ARRAY,
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

/* A block of results from a register to the array, past the caches. */
static void step_streamed(struct making *k, int node)
{
    const struct machine_type type = k->g->nodes[node].type;
    if (!k->output[node] || !k->streams)
        return;
    step_one(k, lanes_find(LANES_STREAM, lanes_bits_of(lanes_class_of(type))), LANES_STREAM,
             place_of_array(k, node), type, k->place[node], type, 0);
    if (k->last[node] <= node) /* nobody else takes it */
        register_put(k, k->place[node]);
}

static void node_compute(struct making *k, int node)
{
    const struct plan_node *n = &k->g->nodes[node];
    int in[3] = {0, 0, 0};
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
    for (int j = 0; j < node_ops[n->op].inputs; j++)
        in[j] = takes(n, j) ? k->place[n->in[j]] : 0;
    if (k->owner[node] != node) {
        k->place[node] = in[0];
        return;
    }
    int to = k->place[node] = place_of_result(k, node);
    if (node_ops[n->op].inputs == 0) {
        step_generated(k, n, node, to);
    } else if (n->op == NODE_GATHER) {
        step_fetched(k, n, to, in);
    } else if (n->op == NODE_REINTERPRET) {
        step_copied(k, to, n->type, in[0]);
    } else {
        step_operation(k, n, to, in);
    }
    step_streamed(k, node);
    k->p->ops++;
    k->p->cost += node_cost(n->op, n->type);
    for (int j = 0; j < node_ops[n->op].inputs; j++) {
        int owner = takes(n, j) ? k->owner[n->in[j]] : node;
        if (owner != node && k->last[owner] == node) {
            k->last[owner] = -1; /* once, if it is two operands */
            register_put(k, k->place[owner]);
        }
    }
}

static int operands_of(const struct lanes_step *s)
{
    if (s->op < NODE_OP_COUNT)
        return node_ops[s->op].inputs;
    return s->op == LANES_FETCH ? 3 : s->op == LANES_JOIN || s->op == LANES_DRAW ? 2 : 1;
}

/* Which step is the first that takes an array. */
static void arrays_ahead(struct byte_code *p)
{
    bool *taken = calloc((size_t)p->places_count, sizeof *taken);
    for (int i = 0; taken && i < p->steps_count; i++) {
        struct lanes_step *s = &p->steps[i];
        int inputs = s->run ? operands_of(s) : 0;
        for (int k = 0; k < 4; k++) {
            int place = k == 3 ? s->to : s->in[k];
            if (s->op != LANES_STREAM && (k < inputs || k == 3) &&
                p->places[place].kind == PLACE_ARRAY && !taken[place]) {
                taken[place] = true;
                s->ahead |= (uint8_t)(1u << k);
            }
        }
    }
    free(taken);
}

/* Whether the arrays are so large that nothing of them is in the caches when somebody looks at them next. */
static bool are_streamed(const struct making *k)
{
    double bytes = 0;
    for (int i = 0; i < k->g->count; i++)
        if (k->needed[i] && !k->g->nodes[i].constant && (k->output[i] || loads(k, i)))
            bytes += (double)type_bytes(k->g->nodes[i].type) * (double)k->set->count;
    return shape_streams_lanes(k->shape, bytes);
}

void byte_code_free(struct byte_code *p)
{
    if (!p)
        return;
    for (int i = 0; i < p->places_count; i++)
        free(p->places[i].further);
    free(p->places);
    free(p->steps);
    free(p->arguments);
    free(p);
}

struct byte_code *byte_code_make(const struct device_shape *shape, const struct plan_graph *g,
                                 const int *stores, int count, const struct vpset *set,
                                 int processors_log2, bool streams)
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
                       .output = calloc(nodes, sizeof *k.output)};
    bool good = p && k.place && k.owner && k.last && k.needed && k.output;
    if (good) {
        find_needed(&k, stores, count);
        p->streams = k.streams = streams && are_streamed(&k);
        for (int i = 0; i < g->count && !p->failed; i++)
            if (k.needed[i])
                node_compute(&k, i);
        for (int i = 0; i < p->arguments_count; i++)
            p->lane_bytes += (int)type_bytes(g->nodes[p->arguments[i].node].type);
        good = !p->failed && p->places_count <= UINT16_MAX;
        if (good && set->count >= shape->ahead_from)
            arrays_ahead(p);
    }
    for (int c = 0; c < LANES_CLASSES; c++)
        free(k.idle[c]);
    free(k.place);
    free(k.owner);
    free(k.last);
    free(k.needed);
    free(k.output);
    if (!good) {
        byte_code_free(p);
        return NULL;
    }
    return p;
}
