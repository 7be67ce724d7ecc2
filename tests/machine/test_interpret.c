/* test_interpret.c - the interpreter of byte code. Under every instruction set each loop gives
 * the bits of the loop that goes lane by lane. Blocks find their neighbours, in rows shorter
 * and longer than a block. A plan is interpreted until compiling its kernels pays. */
#include "support.h"

#include <math.h>

#include "plans/plans.h"
#include "tables.h"
#include "values/graph.h"

enum { LANES = 67 };

/* ---- loops ---- */

static lanes_wide ones(int width)
{
    return width >= 128 ? ~(lanes_wide)0 : ((lanes_wide)1 << width) - 1;
}

/* Room for the lanes of an operand. */
struct lanes {
    _Alignas(64) unsigned char bytes[LANES * 16];
};

static void lanes_fill(struct lanes *l, struct machine_type type, uint64_t seed)
{
    for (uint64_t i = 0; i < LANES; i++)
        support_element_set(l->bytes, type, i, support_word(type, seed, i));
}

static bool is_nan(struct machine_type type, wide x)
{
    if (type.kind != MACHINE_FLOAT)
        return false;
    return type.width == 32 ? (x & 0x7fffffff) > 0x7f800000
                            : (x & INT64_MAX) > UINT64_C(0x7ff0000000000000);
}

/* Two NaNs count as equal here, because a step of its own gives all NaNs the same bits. */
static void lanes_same(const struct lanes *a, const struct lanes *b, struct machine_type type,
                       const struct lanes_step *s, int table)
{
    for (uint64_t i = 0; i < LANES; i++) {
        wide x = support_element(a->bytes, type, i), y = support_element(b->bytes, type, i);
        if (x != y && !(is_nan(type, x) && is_nan(type, y)))
            fail_msg(
                "operation %d on %d bits to %d, table %d, lane %d: %llx, lane by lane %llx",
                s->op, s->from.width, type.width, table, (int)i, (unsigned long long)x,
                (unsigned long long)y);
    }
}

/* Fills in counts of shifts: -128 to 128, with those near multiples of the width among them;
 * counts of rotations are below the width. All lanes get count k; where k is 0, each lane gets
 * another count. */
static void counts_fill(struct lanes *l, bool below_width, int width, int k)
{
    for (int lane = 0; lane < LANES; lane++) {
        int i = k ? k - 1 : lane;
        int32_t n = i < 20 ? (i % 4 - 1) * width + i / 4 - 2 : (i * 37) % 257 - 128;
        n = n < -128 ? -128 : n > 128 ? 128 : n;
        n = below_width ? (n + 2 * 128 * width) % width : n;
        memcpy(l->bytes + 4 * lane, &n, sizeof n);
    }
}

static int steps_tried;

static void step_try(const struct tables *t, struct lanes_step s, lanes_function *const *loops,
                     struct machine_type second)
{
    static struct lanes in[3], out[2];
    void *at[] = {in[0].bytes, in[1].bytes, in[2].bytes, out[0].bytes};
    bool selects = s.op == NODE_SELECT;
    s.mask = ones(s.type.width);
    s.in[1] = 1;
    s.in[2] = 2;
    s.to = 3;
    lanes_fill(&in[0], selects ? MACHINE_BIT : s.from, 1);
    lanes_fill(&in[1], selects ? s.type : second, 2);
    for (uint64_t i = 0; i < LANES && op_is_integer(s.op);
         i += 3) /* small divisors: quotients above 0, and divisions by 0 */
        support_element_set(in[1].bytes, second, i,
                            support_word(MACHINE_UINT(3), 4, i) & ones(second.width));
    lanes_fill(&in[2], s.type, 3);
    if (node_ops[s.op].fold == FOLD_SHIFT)
        counts_fill(&in[1], s.op == MACHINE_ROTATE, s.from.width, s.detail);
    memset(&out[1], 0x55, sizeof out[1]);
    at[3] = out[1].bytes;
    lane_each(&s, at, LANES);
    at[3] = out[0].bytes;
    for (int i = 0; i < t->count; i++) {
        memset(&out[0], 0xaa, sizeof out[0]);
        loops[i](&s, at, LANES);
        lanes_same(&out[0], &out[1], s.type, &s, i);
        steps_tried++;
    }
}

static const int widths[] = {1, 2, 7, 8, 9, 15, 16, 17, 31, 32, 33, 63, 64, 65, 100, 127, 128};
enum { WIDTHS = sizeof widths / sizeof *widths };

static struct machine_type type_number(int i)
{
    return i < WIDTHS ? MACHINE_UINT(widths[i]) : i == WIDTHS ? MACHINE_F32 : MACHINE_F64;
}

static void each_loop_gives_what_lane_by_lane_gives(void **state)
{
    const struct tables t = tables_here();
    (void)state;
    for (int op = 0; op < NODE_OP_COUNT; op++)
        for (int i = 0; i < WIDTHS + 2; i++) {
            struct machine_type type = type_number(i);
            enum lanes_class c = lanes_class_of(type);
            lanes_function *loops[3];
            for (int k = 0; k < t.count; k++)
                loops[k] = t.of[k]->of[op][c];
            if (!loops[0] || (op_is_integer(op) && type.width == 1))
                continue;
            step_try(&t,
                     (struct lanes_step){.op = (uint16_t)op,
                                         .from = type,
                                         .type = node_ops[op].gives == GIVES_BIT ? MACHINE_BIT
                                                                                 : type},
                     loops, type);
            for (int k = 1; k <= LANES && node_ops[op].fold == FOLD_SHIFT; k++)
                step_try(&t,
                         (struct lanes_step){
                             .op = (uint16_t)op, .from = type, .type = type, .detail = k},
                         loops, type);
        }
    assert_true(steps_tried > 200);
}

/* Likewise of an array that is larger than the caches, in blocks of any length. */
static void what_is_fetched_is_in_a_large_array(void **state)
{
    enum { MOST = 200, BYTES = (8 << 20) + 400 };
    const struct tables t = tables_here();
    const struct lanes_step s = {.op = LANES_FETCH, .in = {0, 1, 2}, .to = 3};
    static uint32_t places[MOST], count[1];
    static unsigned char out[16 * MOST];
    unsigned char *array = malloc(BYTES), none[16] = {0};
    void *at[] = {places, array, count, out};
    (void)state;
    assert_non_null(array);
    for (size_t i = 0; i < BYTES; i++)
        array[i] = (unsigned char)(i * 151 + i / 4096);
    for (int k = 0; k < t.count; k++)
        for (int c = 0; c < LANES_INTEGERS; c++)
            for (int n = 0; n <= MOST; n += n < 40 ? 1 : 19) {
                const size_t bytes = lanes_bytes((enum lanes_class)c);
                count[0] = (uint32_t)(BYTES / bytes);
                for (int i = 0; i < n; i++)
                    places[i] =
                        (uint32_t)support_word(MACHINE_UINT(32), (uint64_t)n, (uint64_t)i) %
                        (count[0] + count[0] / 8);
                for (int i = 0; i < n; i += 50)
                    places[i] = i ? UINT32_MAX : count[0] - 1;
                t.of[k]->of[LANES_FETCH][c](&s, at, n);
                for (int i = 0; i < n; i++)
                    assert_memory_equal(out + (size_t)i * bytes,
                                        places[i] < count[0] ? array + places[i] * bytes : none,
                                        bytes);
            }
    free(array);
}

/* Fetches from places inside and outside an array, of every class of lanes. */
static void what_is_fetched_is_in_the_array(void **state)
{
    const struct tables t = tables_here();
    enum { PLACES = 100 };
    static uint32_t places[LANES], count[LANES];
    static _Alignas(64) unsigned char array[16 * PLACES], out[16 * LANES];
    void *at[] = {places, array, count, out};
    const struct lanes_step s = {.op = LANES_FETCH, .in = {0, 1, 2}, .to = 3};
    (void)state;
    for (int i = 0; i < LANES; i++) {
        places[i] = i % 7 == 3 ? UINT32_MAX - (uint32_t)i : (uint32_t)(i * 37 % (PLACES + 5));
        count[i] = PLACES;
    }
    for (size_t i = 0; i < sizeof array; i++)
        array[i] = (unsigned char)(i * 151 + 1);
    for (int k = 0; k < t.count; k++)
        for (int c = 0; c < LANES_INTEGERS; c++) {
            static const unsigned char none[16];
            size_t bytes = lanes_bytes((enum lanes_class)c);
            assert_non_null(t.of[k]->of[LANES_FETCH][c]);
            memset(out, 0x55, sizeof out);
            t.of[k]->of[LANES_FETCH][c](&s, at, LANES);
            for (int i = 0; i < LANES; i++)
                assert_memory_equal(out + (size_t)i * bytes,
                                    places[i] < PLACES ? array + places[i] * bytes : none,
                                    bytes);
        }
}

static bool conversion_is(int op, struct machine_type from, struct machine_type to)
{
    bool a = from.kind == MACHINE_FLOAT, b = to.kind == MACHINE_FLOAT;
    switch (op) {
    case NODE_ZERO_EXTEND:
        return !a && !b;
    case NODE_SIGN_EXTEND:
        return !a && !b && to.width >= from.width;
    case NODE_U_TO_F:
    case NODE_S_TO_F:
        return !a && b;
    case NODE_F_TO_U:
    case NODE_F_TO_S:
        return a && !b;
    default:
        return a && b && op == NODE_F_TO_F;
    }
}

static void each_conversion_gives_what_lane_by_lane_gives(void **state)
{
    const struct tables t = tables_here();
    int before = steps_tried;
    (void)state;
    for (int op = 0; op < NODE_OP_COUNT; op++)
        for (int i = 0; i < WIDTHS + 2; i++)
            for (int j = 0; j < WIDTHS + 2; j++) {
                struct machine_type from = type_number(i), to = type_number(j);
                lanes_function *loops[3];
                for (int k = 0; k < t.count; k++)
                    loops[k] = t.of[k]->convert[op][lanes_class_of(from)][lanes_class_of(to)];
                if (!loops[0] || !conversion_is(op, from, to))
                    continue;
                step_try(&t,
                         (struct lanes_step){.op = (uint16_t)op,
                                             .from = from,
                                             .type = to,
                                             .detail = op == NODE_ZERO_EXTEND && i > 2 ? 3 : 0},
                         loops, from);
            }
    assert_true(steps_tried - before > 1000);
}

/* Short formats are rounded by adding and subtracting a constant; all others by the code of
 * kernels/soft.cl only. */
static void short_formats_round_as_whole_numbers_do(void **state)
{
    const struct tables t = tables_here();
    static struct lanes in, out[2];
    (void)state;
    for (int s = 1; s <= 24; s++)
        for (int e = 2; e <= 9; e++) {
            struct lanes_step step = {
                .op = LANES_FIT, .from = MACHINE_SOFT(s, e), .type = MACHINE_SOFT(s, e)};
            void *at[] = {in.bytes};
            step.mask = ~(lanes_wide)0;
            lanes_fill(&in, MACHINE_F64, (uint64_t)(16 * s + e));
            for (int i = 0; i < LANES; i += 2) { /* near the format's numbers */
                double x =
                    ldexp((double)(int64_t)(support_word(MACHINE_UINT(40), 9, (uint64_t)i)),
                          i / 2 - 50);
                memcpy(in.bytes + 8 * i, &x, sizeof x);
            }
            out[0] = in;
            lane_each(&step, at, LANES);
            out[1] = in;
            for (int i = 0; i < t.count; i++) {
                in = out[0];
                t.of[i]->of[LANES_FIT][LANES_F64](&step, at, LANES);
                lanes_same(&in, &out[1], MACHINE_F64, &step, i);
            }
        }
}

/* ---- blocks ---- */

static struct machine *interpreting(const char *how)
{
    setenv("LUTETIA_INTERPRET", how, 1);
    struct machine *m = support_machine(0);
    unsetenv("LUTETIA_INTERPRET");
    return m;
}

static uint64_t interpreted(struct machine *m)
{
    struct machine_stats now;
    machine_stats_get(m, &now);
    return now.interpreted;
}

struct neighbour {
    int rank, dimensions[3], axis, distance, second, second_distance;
    struct machine_type type;
};

static uint64_t neighbour_index(const struct neighbour *b, uint64_t n)
{
    int c[3];
    for (int a = b->rank - 1; a >= 0; a--) {
        c[a] = (int)(n % (uint64_t)b->dimensions[a]);
        n /= (uint64_t)b->dimensions[a];
    }
    const int axes[2] = {b->axis, b->second}, far[2] = {b->distance, b->second_distance};
    for (int i = 0; i < 2; i++) {
        int length = b->dimensions[axes[i]];
        c[axes[i]] = ((c[axes[i]] + far[i]) % length + length) % length;
    }
    for (int a = 0; a < b->rank; a++)
        n = n * (uint64_t)b->dimensions[a] + (uint64_t)c[a];
    return n;
}

static wide neighbour_is(const void *data, uint64_t n)
{
    const struct neighbour *b = data;
    return support_word(b->type, 7, neighbour_index(b, n));
}

/* The neighbour's value of an expression that has to be computed first. */
static wide neighbour_negated_is(const void *data, uint64_t n)
{
    const struct neighbour *b = data;
    return ~support_word(b->type, 7, neighbour_index(b, n)) & ones(b->type.width);
}

static wide index_is(const void *data, uint64_t n)
{
    (void)data;
    return n;
}

/* how: by the front end, or by the device itself. */
static void neighbours_check(const char *how, struct neighbour b, int rank,
                             const int *dimensions)
{
    struct machine *m = interpreting(how);
    static const int far[] = {0, 1, -1, 5, -17, 40, 1000};
    int set = rank == 1   ? support_set(m, 1, dimensions[0])
              : rank == 2 ? support_set(m, 2, dimensions[0], dimensions[1])
                          : support_set(m, 3, dimensions[0], dimensions[1], dimensions[2]);
    assert_true(set > 0);
    uint32_t f = support_field(m, b.type, 7);
    for (int i = 0; i < 7; i++)
        for (int axis = 0; axis < rank; axis++) {
            b.rank = rank;
            memcpy(b.dimensions, dimensions, (size_t)rank * sizeof *dimensions);
            b.axis = axis;
            b.distance = far[i];
            b.second = rank - 1 - axis;
            b.second_distance = far[6 - i];
            struct machine_value *v = support_value(m, f, b.type);
            v = machine_shift(m, machine_shift(m, v, axis, b.distance), b.second,
                              b.second_distance);
            support_later(m, v, neighbour_is, &b, sizeof b, "a neighbour");
            if (b.type.kind == MACHINE_BITS) {
                v = machine_unary(m, MACHINE_NOT, support_value(m, f, b.type));
                v = machine_shift(m, machine_shift(m, v, axis, b.distance), b.second,
                                  b.second_distance);
                support_later(m, v, neighbour_negated_is, &b, sizeof b,
                              "a neighbour's computed value");
            }
        }
    support_later(m, machine_self_index(m, 40), index_is, NULL, 0, "an index");
    support_check(m);
    assert_true(interpreted(m) > 0);
    support_machine_destroy(m);
}

static void blocks_find_their_neighbours(void **state)
{
    static const struct {
        int rank, dimensions[3];
    } shapes[] = {{1, {1}},       {1, {15}},       {1, {500}},       {1, {3001}},
                  {2, {7, 5}},    {2, {33, 40}},   {2, {3, 700}},    {2, {1, 1025}},
                  {3, {3, 4, 5}}, {3, {4, 5, 30}}, {3, {2, 3, 600}}, {2, {90, 1}}};
    static const struct machine_type types[] = {{MACHINE_BITS, 1, 0, 0},
                                                {MACHINE_BITS, 12, 0, 0},
                                                {MACHINE_FLOAT, 32, 0, 0},
                                                {MACHINE_BITS, 64, 0, 0},
                                                {MACHINE_BITS, 90, 0, 0}};
    (void)state;
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++)
        for (int how = 0; how < 2; how++)
            neighbours_check(how ? "3" : "2", (struct neighbour){.type = types[i % 5]},
                             shapes[i].rank, shapes[i].dimensions);
}

/* ---- promotion ---- */

static void run_often(struct machine *m, uint32_t f, int times)
{
    for (int i = 0; i < times; i++) {
        struct machine_value *v = support_value(m, f, MACHINE_F32);
        v = machine_unary(m, MACHINE_FEXP, machine_unary(m, MACHINE_FNEG, v));
        assert_ok(machine_field_store(m, f, v, MACHINE_EVERYWHERE), m);
        struct machine_scalar x;
        machine_begin(m);
        assert_ok(machine_field_read(m, f, MACHINE_F32, 3, &x), m);
        machine_begin(m);
    }
}

static struct machine_stats stats_after(const char *how, int processors, int times, void *out)
{
    struct machine *m = interpreting(how);
    struct machine_stats now;
    assert_true(support_set(m, 1, processors) > 0);
    uint32_t f = support_field(m, MACHINE_F32, 1);
    run_often(m, f, times);
    machine_stats_get(m, &now);
    assert_ok(machine_field_download(m, f, MACHINE_F32, out), m);
    support_machine_destroy(m);
    return now;
}

static void a_small_plan_is_never_compiled(void **state)
{
    static float out[2][64];
    (void)state;
    struct machine_stats small = stats_after("1", 64, 3000, out[0]),
                         never = stats_after("0", 64, 3000, out[1]);
    assert_int_equal(small.kernels_built, 0);
    assert_true(small.interpreted >= 2900);
    assert_int_equal(never.interpreted, 0);
    assert_true(never.kernels_built > 0);
    assert_memory_equal(out[0], out[1], sizeof out[0]);
}

static void a_plan_that_costs_more_than_compiling_is_compiled(void **state)
{
    enum { MANY = 1 << 18, TIMES = 200 };
    float *out[2] = {calloc(MANY, sizeof(float)), calloc(MANY, sizeof(float))};
    (void)state;
    assert_true(out[0] && out[1]);
    struct machine_stats worth = stats_after("1", MANY, TIMES, out[0]),
                         never = stats_after("2", MANY, TIMES, out[1]);
    assert_true(worth.interpreted > 0 && worth.interpreted < TIMES);
    assert_true(worth.kernels_built > 0);
    assert_int_equal(never.kernels_built, 0);
    assert_memory_equal(out[0], out[1], MANY * sizeof(float));
    free(out[0]);
    free(out[1]);
}

/* Makes a plan for each number: each of its bits chooses a sum or an exclusive or. */
static void of_many_plans_the_oldest_go(void **state)
{
    enum { BITS = 14 };
    const struct machine_type word = MACHINE_UINT(32);
    (void)state;
    struct machine *m = interpreting("1");
    assert_true(support_set(m, 1, 5) > 0);
    uint32_t f = support_field(m, word, 1);
    for (uint32_t k = 0, x = 1, y = 1; k < 1u << BITS; k++) {
        struct machine_value *v = support_value(m, f, word), *one = v;
        struct machine_scalar read;
        for (int bit = 0; bit < BITS; bit++) {
            v = machine_binary(m, k >> bit & 1 ? MACHINE_ADD : MACHINE_XOR, v,
                               bit % 2 ? one : machine_unary(m, MACHINE_NOT, one));
            y = k >> bit & 1 ? y + (bit % 2 ? x : ~x) : y ^ (bit % 2 ? x : ~x);
        }
        assert_ok(machine_field_store(m, f, v, MACHINE_EVERYWHERE), m);
        machine_begin(m);
        assert_ok(machine_field_read(m, f, word, 2, &read), m);
        machine_begin(m);
        if (k == 0) /* what the field held before is not 1 */
            y = (uint32_t)read.lo;
        assert_int_equal(read.lo, y);
        assert_true(m->plans->count <= 8192 + 4096 + 1);
        x = y;
    }
    assert_true(m->plans->built >= 1u << BITS);
    support_machine_destroy(m);
}

/* A comparison of coordinates stays a node of its own, even where byte code needs it in a
 * second stage or from a neighbour. It is not replaced by an array, so that later kernels see
 * which rows it selects. */
static void tests_of_coordinates_keep_their_definition(void **state)
{
    enum { SIDE = 40 };
    (void)state;
    for (int shifted = 0; shifted < 2; shifted++) {
        struct machine *m = interpreting("2");
        assert_true(support_set(m, 2, SIDE, SIDE) > 0);
        uint32_t f = support_field(m, MACHINE_F32, 1);
        struct machine_value *x = support_value(m, f, MACHINE_F32),
                             *edge = machine_binary(
                                 m, MACHINE_ULT, machine_coordinate(m, 0, 8),
                                 machine_constant(m, MACHINE_UINT(8),
                                                  (struct machine_scalar){17, 0}));
        struct machine_value *negative = machine_unary(m, MACHINE_FNEG, x),
                             *where = shifted ? machine_shift(m, edge, 0, 1) : edge;
        x = machine_select(m, edge, negative, x); /* the first stage */
        x = machine_select(m, where, machine_shift(m, x, 0, 1), x);
        graph_ref(edge);
        assert_ok(machine_field_store(m, f, x, MACHINE_EVERYWHERE), m);
        machine_begin(m);
        assert_ok(machine_flush(m), m);
        assert_true(interpreted(m) > 0);
        assert_null(edge->buffer);
        assert_int_equal(edge->op, MACHINE_ULT);
        graph_unref(m, edge);
        support_machine_destroy(m);
    }
}

/* ---- lines ---- */

static uint32_t joined(enum reduction_op op, uint32_t a, uint32_t b)
{
    return op == REDUCE_ADD     ? a + b
           : op == REDUCE_LEAST ? (b < a ? b : a)
           : op == REDUCE_OR    ? a | b
                                : a ^ b;
}

static void scan_try(lanes_scan_function *scan, struct lanes_scan s, int n)
{
    uint32_t acc = 12345, out[LANES] = {0};
    s.out = out;
    uint32_t total = scan(&s, (size_t)n, acc);
    for (int i = 0; i < n; i++) {
        const bool active = !s.context || s.context[i],
                   begins = s.bits && s.bits[i] && (active || !s.starts);
        const uint32_t old = begins ? s.none : acc;
        acc = joined(s.op, old, active ? s.in[i] ^ s.flip : s.none);
        if (out[i] != (((s.exclusive ? old : acc) & s.cut) ^ s.flip))
            fail_msg("operation %d of %d numbers: lane %d is %x", (int)s.op, n, i, out[i]);
    }
    assert_int_equal(total, acc);
}

static void scans_by_vectors_give_what_a_loop_gives(void **state)
{
    static const enum reduction_op ops[] = {REDUCE_ADD, REDUCE_LEAST, REDUCE_OR, REDUCE_XOR};
    static struct lanes in, context, bits;
    struct tables t = tables_here();
    (void)state;
    lanes_fill(&in, MACHINE_UINT(32), 1);
    for (int k = 0; k < 4 * 16 * LANES; k++) {
        const enum reduction_op op = ops[k % 4];
        const int flags = k / 4 % 16, n = k / 64 + 1;
        lanes_fill(&context, MACHINE_BIT, (uint64_t)k);
        for (uint64_t i = 0; i < LANES; i++)
            bits.bytes[i] =
                (uint32_t)support_word(MACHINE_UINT(32), (uint64_t)k, i) % (uint32_t)n == 0;
        for (int i = 0; i < t.count; i++)
            if (t.of[i]->scan)
                scan_try(t.of[i]->scan,
                         (struct lanes_scan){
                             .in = (const uint32_t *)(const void *)in.bytes,
                             .context = flags & 1 ? context.bytes : NULL,
                             .bits = flags & 2 ? bits.bytes : NULL,
                             .op = op,
                             .exclusive = flags & 4,
                             .starts = flags & 8,
                             .none = op == REDUCE_LEAST ? UINT32_MAX : 0,
                             .flip = op == REDUCE_OR || op == REDUCE_LEAST ? UINT32_MAX : 0,
                             .cut = n % 3 ? UINT32_MAX : 0xfffff},
                         n);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_loop_gives_what_lane_by_lane_gives),
        cmocka_unit_test(each_conversion_gives_what_lane_by_lane_gives),
        cmocka_unit_test(what_is_fetched_is_in_the_array),
        cmocka_unit_test(what_is_fetched_is_in_a_large_array),
        cmocka_unit_test(scans_by_vectors_give_what_a_loop_gives),
        cmocka_unit_test(short_formats_round_as_whole_numbers_do),
        cmocka_unit_test(blocks_find_their_neighbours),
        cmocka_unit_test(tests_of_coordinates_keep_their_definition),
        cmocka_unit_test(a_small_plan_is_never_compiled),
        cmocka_unit_test(of_many_plans_the_oldest_go),
        cmocka_unit_test(a_plan_that_costs_more_than_compiling_is_compiled),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
