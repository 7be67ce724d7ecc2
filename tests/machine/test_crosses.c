/* test_crosses.c - gets from the processor whose index differs in some bits. The interpreter's
 * loops give the lanes that they should; which gets are crosses is found, and which are choices
 * of two neighbours; and programs of crosses, neighbours and choices come to the same bits in
 * every tier as with gets that are calls of the router. */
#include "support.h"

#include "interpret/byte_code.h"
#include "tables.h"
#include "values/places.h"
#include "values/values.h"

static uint32_t chance = 1;

static uint32_t below(uint32_t n)
{
    chance = chance * 1664525u + 1013904223u;
    return (chance >> 8) % n;
}

/* ---- loops ---- */

enum { LANES = 2 * CROSS_NEAR };

static void each_lane_is_the_one_across(void **state)
{
    static _Alignas(64) unsigned char from[16 * LANES], to[16 * LANES + 64];
    const struct tables t = tables_here();
    (void)state;
    for (size_t i = 0; i < sizeof from; i++)
        from[i] = (unsigned char)below(256);
    for (int i = 0; i < t.count; i++)
        for (int c = 0; c < LANES_INTEGERS; c++)
            for (int bits = 0; bits < CROSS_NEAR; bits++) {
                uint32_t number[] = {(uint32_t)bits | (below(2) << 20)};
                void *at[] = {from, to, number};
                const size_t bytes = lanes_bytes((enum lanes_class)c);
                const int n = bits % 3 ? CROSS_NEAR : LANES;
                const struct lanes_step s = {.op = LANES_CROSS, .to = 1, .in = {0, 2}};
                memset(to, 0x55, sizeof to);
                t.of[i]->of[LANES_CROSS][c](&s, at, n);
                for (int k = 0; k < n; k++)
                    assert_memory_equal(to + (size_t)k * bytes,
                                        from + (size_t)(k ^ bits) * bytes, bytes);
                for (size_t k = (size_t)n * bytes; k < sizeof to; k++)
                    assert_int_equal(to[k], 0x55);
            }
}

/* ---- which are ---- */

/* All places of a row have one in it, and whole blocks have whole blocks. */
static bool stays(int width, uint32_t bits)
{
    if (width % CROSS_NEAR)
        return false;
    for (uint32_t x = 0; x < (uint32_t)width; x++)
        if ((x ^ bits) >= (uint32_t)width)
            return false;
    return true;
}

static void a_cross_stays_in_its_row(void **state)
{
    static const int widths[] = {1, 256, 512, 513, 700, 1024, 1536, 2048, 3072, 5000, 5120};
    (void)state;
    for (size_t i = 0; i < sizeof widths / sizeof *widths; i++) {
        const struct vpset s = {.width = widths[i]};
        for (uint32_t bits = 1; bits < 8192; bits++)
            assert_int_equal(places_cross_can(&s, bits), stays(widths[i], bits));
        assert_false(places_cross_can(&s, UINT32_C(1) << 30));
        assert_false(places_cross_can(&s, UINT32_C(1) << 31));
    }
    const struct vpset all = {.width = 1 << 30};
    assert_true(places_cross_can(&all, 1 << 29));
    assert_false(places_cross_can(&all, 1 << 30));
}

static struct machine *machine_as(const char *interpret, const char *gather)
{
    setenv("LUTETIA_INTERPRET", interpret, 1);
    setenv("LUTETIA_GATHER", gather, 1);
    struct machine *m = support_machine(0);
    unsetenv("LUTETIA_INTERPRET");
    unsetenv("LUTETIA_GATHER");
    return m;
}

/* Makes and selects a set. In NEWS order addresses are no indices: subgrids, or dealt. */
static int set_make(struct machine *m, bool news, int rank, const int *lengths)
{
    const int set = machine_vpset_create_ordered(
        m, lengths, rank, news ? MACHINE_NEWS_ORDER : MACHINE_SEND_ORDER);
    assert_true(set > 0);
    assert_ok(machine_vpset_select(m, set), m);
    return set;
}

static struct machine_value *number(struct machine *m, int width, uint64_t x)
{
    return machine_constant(m, MACHINE_UINT(width), support_scalar(x));
}

static struct machine_value *own(struct machine *m, int width)
{
    return machine_self_address(m, width);
}

/* What a get of a field of 32 bits by this address is: the bits of a cross; -1: no cross. */
static int crossed(struct machine *m, uint32_t field, struct machine_value *address)
{
    struct machine_value *v = machine_get(m, address, field, MACHINE_UINT(32));
    assert_non_null(v);
    return v->op == NODE_CROSS ? (int)v->in[1]->imm.lo : -1;
}

static void own_addresses_with_some_bits_turned_are_found(void **state)
{
    (void)state;
    static const int line[] = {1536}, two[] = {4, 1024};
    struct machine *m = machine_as("2", "1");
    set_make(m, false, 1, line);
    uint32_t f = support_field(m, MACHINE_UINT(32), 1),
             kept = machine_field_allocate(m, machine_vpset_current(m), 40, MACHINE_HEAP);
    struct machine_value *a = machine_binary(m, MACHINE_XOR, own(m, 32), number(m, 32, 260));
    assert_int_equal(crossed(m, f, a), 260);
    a = machine_binary(m, MACHINE_XOR, number(m, 32, 5), a);
    assert_int_equal(crossed(m, f, a), 257);
    a = machine_binary(m, MACHINE_XOR, machine_coordinate(m, 0, 11), number(m, 11, 3));
    assert_int_equal(crossed(m, f, a), 3);
    a = machine_concat(m, machine_extract(m, own(m, 32), 0, 11), number(m, 5, 9));
    assert_int_equal(crossed(m, f, machine_binary(m, MACHINE_XOR, a, number(m, 16, 1))), 1);
    /* bits above an address do not matter */
    a = machine_binary(m, MACHINE_XOR, own(m, 32), number(m, 32, 0x30000007));
    assert_int_equal(crossed(m, f, a), 7);
    /* some would be nobody's, some bits are missing, or it is something else */
    a = machine_binary(m, MACHINE_XOR, own(m, 32), number(m, 32, 512));
    assert_int_equal(crossed(m, f, a), -1);
    a = machine_binary(m, MACHINE_XOR, own(m, 10), number(m, 10, 1));
    assert_int_equal(crossed(m, f, a), -1);
    a = machine_binary(m, MACHINE_ADD, own(m, 32), number(m, 32, 1));
    assert_int_equal(crossed(m, f, a), -1);
    a = machine_binary(m, MACHINE_XOR, own(m, 32), support_value(m, f, MACHINE_UINT(32)));
    assert_int_equal(crossed(m, f, a), -1);
    /* one's own number is itself */
    assert_ok(machine_field_store(m, kept, own(m, 40), MACHINE_EVERYWHERE), m);
    assert_int_equal(crossed(m, f, machine_field_value(m, kept, MACHINE_UINT(40), 0)), -1);
    /* addresses of another set */
    set_make(m, false, 1, line);
    a = machine_binary(m, MACHINE_XOR, own(m, 32), number(m, 32, 1));
    assert_int_equal(crossed(m, f, a), -1);
    /* of two axes a coordinate is no address */
    set_make(m, false, 2, two);
    f = support_field(m, MACHINE_UINT(32), 1);
    a = machine_binary(m, MACHINE_XOR, machine_coordinate(m, 1, 32), number(m, 32, 1));
    assert_int_equal(crossed(m, f, a), -1);
    support_machine_destroy(m);
}

static void own_addresses_are_known_until_they_are_overwritten(void **state)
{
    static const int line[] = {4096}, square[] = {8, 1024}, odd[] = {3 * 1024};
    (void)state;
    struct machine *m = machine_as("2", "1");
    for (int i = 0; i < 2; i++) {
        const int set = set_make(m, true, i + 1, i ? square : line);
        const struct vpset *s = vpset_get(m, set);
        uint32_t f = support_field(m, MACHINE_UINT(32), 1),
                 me = machine_field_allocate(m, set, 32, MACHINE_HEAP);
        assert_ok(machine_field_store(m, me, own(m, 32), MACHINE_EVERYWHERE), m);
        assert_ok(machine_flush(m), m); /* it is in memory now */
        for (uint64_t bit = 1; bit < s->count; bit *= 2) {
            struct machine_value *a = machine_binary(
                m, MACHINE_XOR, support_value(m, me, MACHINE_UINT(32)), number(m, 32, bit));
            const uint64_t across = machine_layout_index(&s->layout, bit);
            assert_int_equal(crossed(m, f, a),
                             places_cross_can(s, (uint32_t)across) ? (int)across : -1);
        }
        assert_ok(machine_field_write(m, me, MACHINE_UINT(32), 77, support_scalar(5)), m);
        struct machine_value *a = machine_binary(
            m, MACHINE_XOR, support_value(m, me, MACHINE_UINT(32)), number(m, 32, 1));
        assert_int_equal(crossed(m, f, a), -1);
    }
    set_make(m, true, 1, odd);
    uint32_t f = support_field(m, MACHINE_UINT(32), 1);
    struct machine_value *a = machine_binary(m, MACHINE_XOR, own(m, 32), number(m, 32, 1));
    assert_int_equal(crossed(m, f, a), -1);
    support_machine_destroy(m);
}

/* ---- coordinates turned ---- */

/* One's own address with the coordinate along the axis turned by these bits; NULL: it is not
 * found. */
static struct machine_value *turned(struct machine *m, struct machine_value *address, int axis,
                                    uint32_t bits)
{
    const struct vpset *s = vpset_get(m, machine_vpset_current(m));
    return machine_address_turned(
        m, &s->layout, address, axis,
        machine_binary(m, MACHINE_XOR, machine_coordinate(m, axis, 32), number(m, 32, bits)));
}

/* The addresses of all processors are those of the front end's sums, also when two axes are
 * turned one after the other. */
static void turned_coordinates_give_the_addresses_they_should(void **state)
{
    static const int shapes[][3] = {{4096}, {64, 64}, {16, 8, 32}, {1, 128, 2}, {512, 4}};
    (void)state;
    struct machine *m = machine_as("2", "1");
    for (size_t shape = 0; shape < 5; shape++)
        for (int news = 0; news < 2; news++) {
            const int *d = shapes[shape], rank = d[2] ? 3 : d[1] ? 2 : 1;
            const int set = set_make(m, news, rank, d);
            const uint64_t count = vpset_get(m, set)->count;
            uint32_t f = machine_field_allocate(m, set, 40, MACHINE_HEAP),
                     any = support_field(m, MACHINE_UINT(32), 1), *there;
            there = malloc(count * sizeof *there);
            assert_non_null(there);
            for (int turn = 0; turn < 12; turn++) {
                const int first = (int)below((uint32_t)rank),
                          second = (int)below((uint32_t)rank);
                const uint32_t a = below((uint32_t)d[first]), b = below((uint32_t)d[second]);
                struct machine_value *v = turned(m, own(m, 32), first, a);
                if (turn % 3 == 2) { /* from memory */
                    assert_non_null(v);
                    assert_ok(machine_field_store(m, f, v, MACHINE_EVERYWHERE), m);
                    assert_ok(machine_flush(m), m);
                    v = machine_field_value(m, f, v->type, MACHINE_EVERYWHERE);
                }
                v = turned(m, v, second, b);
                assert_non_null(v);
                assert_ok(machine_field_store(m, f, machine_resize(m, v, 32, false),
                                              MACHINE_EVERYWHERE),
                          m);
                assert_ok(machine_field_download(m, f, MACHINE_UINT(32), there), m);
                for (uint64_t i = 0; i < count; i++) {
                    uint64_t index = 0, left = i, stride = 1;
                    for (int k = rank - 1; k >= 0; k--) {
                        uint64_t x = left % (uint64_t)d[k];
                        x ^= k == second ? b : k == first ? a : 0;
                        index += x * stride;
                        stride *= (uint64_t)d[k];
                        left /= (uint64_t)d[k];
                    }
                    assert_int_equal(there[i], machine_send_address(m, set, index));
                }
            }
            /* beyond the axis, another axis' coordinate, and a part of one are not known */
            assert_null(turned(m, own(m, 32), 0, (uint32_t)d[0]));
            assert_null(machine_address_turned(m, &vpset_get(m, set)->layout,
                                               support_value(m, any, MACHINE_UINT(32)), 0,
                                               machine_coordinate(m, 0, 32)));
            if (d[0] > 2)
                assert_null(machine_address_turned(m, &vpset_get(m, set)->layout, own(m, 32), 0,
                                                   machine_coordinate(m, 0, 1)));
            if (rank > 1 && d[1] > 1)
                assert_null(machine_address_turned(m, &vpset_get(m, set)->layout, own(m, 32), 0,
                                                   machine_coordinate(m, 1, 32)));
            free(there);
        }
    /* where addresses are dealt in turn, or sides are no powers of two, it is not tried */
    static const int odd[] = {3, 1024};
    set_make(m, true, 2, odd);
    assert_null(turned(m, own(m, 32), 1, 1));
    support_machine_destroy(m);
}

static void turned_coordinates_along_other_axes_are_neighbours(void **state)
{
    static const int square[] = {64, 512};
    (void)state;
    struct machine *m = machine_as("2", "1");
    for (int news = 0; news < 2; news++) {
        set_make(m, news, 2, square);
        uint32_t f = support_field(m, MACHINE_UINT(32), 1);
        struct machine_value *v =
            machine_get(m, turned(m, own(m, 32), 0, 16), f, MACHINE_UINT(32));
        assert_int_equal(v->op, NODE_SELECT);
        v = machine_get(m, turned(m, own(m, 32), 0, 32), f, MACHINE_UINT(32));
        assert_int_equal(v->op, NODE_SHIFT); /* both neighbours are the same one */
        v = machine_get(m, turned(m, own(m, 32), 0, 3), f, MACHINE_UINT(32));
        assert_int_equal(v->op, NODE_GATHER);
        assert_int_equal(crossed(m, f, turned(m, own(m, 32), 1, 256)), 256);
    }
    support_machine_destroy(m);
}

/* ---- programs ---- */

enum { STEPS = 24, MOST = 1 << 14, WIDTHS = 64 };

struct step {
    int kind; /* of `steps_do` */
    uint32_t bits;
    uint64_t seed;
};
struct crossing {
    int rank, lengths[2];
    bool news; /* in NEWS order */
    struct machine_type type;
    struct step steps[STEPS];
    int count;
};

static void program_make(struct crossing *p, int turn)
{
    static const int shapes[][2] = {{1024},   {1536}, {4096},     {4, 1024}, {3, 1536},
                                    {8, 512}, {MOST}, {128, 128}, {64, 32},  {512, 8}};
    enum { SHAPES = sizeof shapes / sizeof *shapes };
    static const struct machine_type types[] = {
        MACHINE_UINT(32), MACHINE_BIT, MACHINE_UINT(8),   MACHINE_F32,     MACHINE_UINT(13),
        MACHINE_UINT(64), MACHINE_F64, MACHINE_UINT(100), MACHINE_UINT(47)};
    *p = (struct crossing){.type = types[turn % 9], .count = 3 + (int)below(STEPS - 3)};
    memcpy(p->lengths, shapes[turn % SHAPES], sizeof p->lengths);
    p->rank = p->lengths[1] ? 2 : 1;
    p->news = turn / SHAPES % 2;
    const uint32_t last = (uint32_t)p->lengths[p->rank - 1];
    for (int i = 0; i < p->count; i++) {
        const int kind = (int)below(11);
        uint32_t bits = below(3) ? UINT32_C(1) << below(14) : below(MOST);
        while (bits && last % (UINT32_C(2) << (31 - __builtin_clz(bits))))
            bits /= 2;
        p->steps[i] = (struct step){kind, bits, below(1000)};
    }
}

/* What the field x holds after the program, in `out`. */
static void program_run(struct machine *m, const struct crossing *p, void *out)
{
    const struct machine_type t = p->type;
    const int set = set_make(m, p->news, p->rank, p->lengths);
    uint32_t x = support_field(m, t, 1), y = support_field(m, t, 2),
             me = machine_field_allocate(m, set, 32, MACHINE_HEAP);
    assert_ok(machine_field_store(m, me, own(m, 32), MACHINE_EVERYWHERE), m);
    for (int i = 0; i < p->count; i++) {
        const struct step *s = &p->steps[i];
        struct machine_value *a = support_value(m, x, t), *b = support_value(m, y, t), *got,
                             *bit = machine_extract(m, support_value(m, me, MACHINE_UINT(32)),
                                                    (int)(s->seed % 10), 1);
        if (s->kind == 0) { /* somebody looks */
            struct machine_scalar seen;
            assert_ok(machine_field_read(m, x, t, s->seed, &seen), m);
            continue;
        }
        if (s->kind == 1) {
            got = machine_shift(m, a, p->rank - 1, (int)(s->seed % 40) - 20);
        } else {
            struct machine_value *at = NULL;
            if (s->kind > 7) {
                const int axis = (int)(s->seed % (uint64_t)p->rank);
                at = turned(m, support_value(m, me, MACHINE_UINT(32)), axis,
                            1u << s->seed % 14 & ((uint32_t)p->lengths[axis] - 1));
            }
            if (!at)
                at = machine_binary(m, MACHINE_XOR, support_value(m, me, MACHINE_UINT(32)),
                                    number(m, 32, s->bits));
            got = machine_get(m, at, s->kind % 2 ? x : y, t);
        }
        assert_non_null(got);
        if (t.kind == MACHINE_FLOAT && s->kind < 5)
            got = machine_binary(m, s->kind == 2 ? MACHINE_FADD : MACHINE_FMAX, got, b);
        else if (t.kind == MACHINE_BITS && s->kind < 5)
            got = machine_binary(m, s->kind == 2 ? MACHINE_ADD : MACHINE_XOR, got, a);
        got = machine_select(m, bit, got, s->kind == 7 ? b : a);
        assert_ok(machine_field_store(m, s->seed % 3 ? x : y, got, MACHINE_EVERYWHERE), m);
    }
    assert_ok(machine_field_download(m, x, t, out), m);
    assert_ok(machine_vpset_destroy(m, set), m);
}

static const struct tier {
    const char *interpret, *gather;
    int every; /* of so many programs one */
} tiers[] = {{"2", "0", 1}, {"2", "1", 1}, {"1", "1", 1}, {"3", "1", 10}, {"0", "1", 10}};
enum { TIERS = sizeof tiers / sizeof *tiers };

/* NaNs of the program beside that of an operation: what is stored of the first has their bits,
 * however it is come by. */
static void a_crossed_nan_keeps_its_bits(void **state)
{
    enum { COUNT = 1024, ACROSS = 5 };
    static const int line[] = {COUNT};
    static const char *const interpret[] = {"2", "2", "0"}, *const gather[] = {"0", "1", "1"};
    static uint32_t in[COUNT], out[COUNT];
    (void)state;
    for (int i = 0; i < 3; i++) {
        struct machine *m = machine_as(interpret[i], gather[i]);
        const int set = set_make(m, false, 1, line);
        for (uint32_t n = 0; n < COUNT; n++)
            in[n] = UINT32_C(0x7f800001) + 977 * n; /* most of them signal */
        uint32_t x = machine_field_allocate(m, set, 32, MACHINE_HEAP),
                 y = machine_field_allocate(m, set, 32, MACHINE_HEAP);
        assert_ok(machine_field_upload(m, x, MACHINE_F32, in), m);
        struct machine_value *a = support_value(m, x, MACHINE_F32),
                             *sum = machine_binary(m, MACHINE_FADD, a, a),
                             *odd = machine_extract(m, own(m, 32), 0, 1),
                             *both = machine_select(m, odd, a, sum),
                             *at = machine_binary(m, MACHINE_XOR, own(m, 32),
                                                  number(m, 32, ACROSS));
        assert_ok(machine_field_store(m, y, both, MACHINE_EVERYWHERE), m);
        struct machine_value *got = machine_get(m, at, y, MACHINE_F32);
        assert_ok(machine_field_store(m, y, got, MACHINE_EVERYWHERE), m);
        assert_ok(machine_field_download(m, y, MACHINE_F32, out), m);
        for (uint32_t n = 0; n < COUNT; n++)
            assert_int_equal(out[n], (n ^ ACROSS) % 2 ? in[n ^ ACROSS] : UINT32_C(0xffc00000));
        support_machine_destroy(m);
    }
}

static int programs = 63;

static void programs_come_to_the_same_in_every_tier(void **state)
{
    static unsigned char first[16 * MOST], then[16 * MOST];
    struct machine *m[TIERS];
    (void)state;
    for (int i = 0; i < TIERS; i++)
        m[i] = machine_as(tiers[i].interpret, tiers[i].gather);
    for (int turn = 0; turn < programs; turn++) {
        struct crossing p;
        chance = (uint32_t)turn;
        program_make(&p, turn);
        memset(first, 0, sizeof first);
        program_run(m[0], &p, first);
        for (int i = 1; i < TIERS; i++) {
            if (turn % tiers[i].every)
                continue;
            memset(then, 0, sizeof then);
            program_run(m[i], &p, then);
            if (memcmp(first, then, sizeof first))
                fail_msg("program %d differs with LUTETIA_INTERPRET=%s", turn,
                         tiers[i].interpret);
        }
    }
    for (int i = 0; i < TIERS; i++)
        support_machine_destroy(m[i]);
}

/* [programs] */
int main(int argc, char **argv)
{
    if (argc > 1)
        programs = atoi(argv[1]);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_lane_is_the_one_across),
        cmocka_unit_test(a_cross_stays_in_its_row),
        cmocka_unit_test(own_addresses_with_some_bits_turned_are_found),
        cmocka_unit_test(own_addresses_are_known_until_they_are_overwritten),
        cmocka_unit_test(turned_coordinates_give_the_addresses_they_should),
        cmocka_unit_test(turned_coordinates_along_other_axes_are_neighbours),
        cmocka_unit_test(a_crossed_nan_keeps_its_bits),
        cmocka_unit_test(programs_come_to_the_same_in_every_tier),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
