/* test_aliases.c - the same memory in VP sets of other ratios, against a plain array of bits.
 *
 * The oracle is each physical processor's memory, a byte for each bit, and the rule of
 * machine.h that gives each VP its bits. */
#include "support.h"

#include "sample.h"
#include "values/values.h"

enum { PROCESSORS = 16, BITS_MOST = 1 << 14, SETS = 12, VIEWS_MOST = 8 };

struct view {
    uint32_t id, bits;
    int set;
    /* Bit b of VP r is bit r / parts * outer + r % parts * inner + start + b of its physical
     * processor's memory. */
    uint64_t start, parts, outer, inner;
};

static struct machine *machine;
static int sets[SETS];
static unsigned char memory[PROCESSORS][BITS_MOST];
static uint64_t state = 1;

static uint64_t next(uint64_t below)
{
    return sample_linear(&state) % below;
}

static uint64_t ratio_of(int set)
{
    return machine_vpset_ratio(machine, set);
}

/* The bit of element n. */
static unsigned char *bit_of(const struct view *v, uint64_t n, uint64_t bit)
{
    uint64_t address = machine_send_address(machine, v->set, n), ratio = ratio_of(v->set);
    uint64_t processor = address / ratio, r = address % ratio;

    return &memory[processor]
                  [v->start + r / v->parts * v->outer + r % v->parts * v->inner + bit];
}

static void write_all(const struct view *v, uint32_t at, struct machine_type type)
{
    uint64_t count = machine_vpset_count(machine, v->set);
    size_t bytes = machine_element_bytes(type);
    unsigned char *dense = malloc(count * bytes);
    uint64_t seed = next(1000000);

    for (uint64_t n = 0; n < count; n++) {
        wide x = support_word(type, seed, n);
        support_element_set(dense, type, n, x);
        for (uint32_t b = 0; b < type.width; b++)
            *bit_of(v, n, at + b) = (unsigned char)(x >> b & 1);
    }
    assert_ok(machine_field_upload(machine, v->id + at, type, dense), machine);
    free(dense);
}

static void check_all(const struct view *v, uint32_t at, struct machine_type type,
                      const char *what)
{
    uint64_t count = machine_vpset_count(machine, v->set);
    unsigned char *dense = malloc(count * machine_element_bytes(type));

    assert_ok(machine_field_download(machine, v->id + at, type, dense), machine);
    for (uint64_t n = 0; n < count; n++) {
        wide x = support_element(dense, type, n), expected = 0;
        for (uint32_t b = 0; b < type.width; b++)
            expected |= (wide)*bit_of(v, n, at + b) << b;
        if (x != expected)
            fail_msg("%s: ratio %d, %u bits: element %d, bits %u..: %llx is not %llx", what,
                     (int)ratio_of(v->set), v->bits, (int)n, at, (unsigned long long)x,
                     (unsigned long long)expected);
    }
    free(dense);
}

static struct view root_make(int set, uint32_t bits)
{
    struct view v = {.bits = bits, .set = set, .parts = 1, .outer = bits};

    memset(memory, 0, sizeof memory);
    v.id = machine_field_allocate(machine, set, bits, MACHINE_HEAP);
    assert_true(v.id != MACHINE_NO_FIELD);
    return v;
}

/* Makes an alias of a whole field, or of a part of a field that is no alias itself. */
static struct view alias_make(const struct view *of, uint32_t offset, int set)
{
    uint64_t from = ratio_of(of->set), to = ratio_of(set);
    struct view v = {.set = set, .start = of->start + offset, .parts = 1};

    if (to == from)
        v = (struct view){0, of->bits - offset, set, v.start, of->parts, of->outer, of->inner};
    else if (to % from == 0) {
        v.bits = (of->bits - offset) / (uint32_t)(to / from);
        v.parts = to / from;
        v.outer = of->parts == 1 ? of->outer : of->inner;
        v.inner = v.bits;
    } else if (from % to == 0) {
        v.bits = of->bits * (uint32_t)(from / to) - offset;
        v.outer = of->bits * (from / to);
    } else {
        v.bits = (uint32_t)((of->bits * from - offset) / to);
        v.outer = v.bits;
    }
    v.id = machine_alias_make(machine, of->id + offset, set);
    if (v.id == MACHINE_NO_FIELD)
        fail_msg("%s", machine_error(machine));
    return v;
}

/* Chooses among few types, so that few kernels have to be compiled. */
static struct machine_type some_type(uint32_t most)
{
    uint64_t pick = next(6);

    if (most < 32 || pick == 0)
        return MACHINE_BIT;
    return pick == 1 ? MACHINE_F32 : MACHINE_UINT(32);
}

static void make_sets(void)
{
    static const struct {
        int rank, lengths[3];
        enum machine_order order;
    } shapes[SETS] = {
        {1, {16}, MACHINE_SEND_ORDER},      {1, {32}, MACHINE_SEND_ORDER},
        {1, {64}, MACHINE_SEND_ORDER},      {1, {128}, MACHINE_SEND_ORDER},
        {2, {4, 4}, MACHINE_NEWS_ORDER},    {2, {2, 32}, MACHINE_NEWS_ORDER},
        {3, {4, 4, 3}, MACHINE_SEND_ORDER}, {1, {48}, MACHINE_NEWS_ORDER},
        {2, {8, 16}, MACHINE_SEND_ORDER},   {2, {8, 8}, MACHINE_NEWS_ORDER},
        {3, {8, 2, 8}, MACHINE_NEWS_ORDER}, {1, {64}, MACHINE_NEWS_ORDER},
    };

    for (int i = 0; i < SETS; i++) {
        sets[i] = machine_vpset_create_ordered(machine, shapes[i].lengths, shapes[i].rank,
                                               shapes[i].order);
        assert_true(sets[i] > 0);
    }
}

static void stores_are_seen_from_all_sides(void **unused)
{
    (void)unused;
    for (int round = 0; round < 4; round++) {
        struct view views[VIEWS_MOST];
        static const uint32_t lengths[] = {32, 192, 768, 384, 768, 1, 768, 1536};
        int count = 1, set = sets[next(SETS)];

        views[0] = root_make(set, lengths[next(8)]);
        for (int tries = 0; tries < 6; tries++) {
            const struct view *of = &views[next((uint64_t)count)];
            uint32_t offset =
                of == views && next(4) == 0 ? (uint32_t)next(of->bits) / 32 * 32 : 0;
            int to = sets[next(SETS)];
            bool tiles = of->bits &&
                         (of == views || of->inner * of->parts == of->outer ||
                          ratio_of(to) == ratio_of(of->set)) &&
                         !(offset && ratio_of(of->set) % ratio_of(to) &&
                           ratio_of(to) % ratio_of(of->set));
            if (of != views && ratio_of(to) != ratio_of(of->set) &&
                (of->parts == 1 ? of->outer : of->inner) != of->bits)
                tiles = false;
            if (of != views && ratio_of(to) < ratio_of(of->set))
                tiles = false;
            if (of != views && ratio_of(to) % ratio_of(of->set))
                tiles = false;
            if (!tiles)
                continue;
            machine_begin(machine);
            views[count] = alias_make(of, offset, to);
            count += views[count].bits > 0;
        }
        for (int step = 0; step < 14; step++) {
            const struct view *v = &views[next((uint64_t)count)];
            struct machine_type type = some_type(v->bits);
            uint32_t at = next(2) ? 0 : (uint32_t)next(v->bits - type.width + 1) / 32 * 32;
            machine_begin(machine);
            if (next(5) < 2)
                write_all(v, at, type);
            else
                check_all(v, at, type, "random");
        }
        for (int i = 0; i < count; i++) {
            machine_begin(machine);
            for (uint32_t at = 0; at < views[i].bits; at += 32)
                check_all(&views[i], at,
                          MACHINE_UINT(views[i].bits - at < 32 ? views[i].bits - at : 32),
                          "end");
        }
        machine_begin(machine);
        assert_ok(machine_field_deallocate(machine, views[0].id), machine);
        for (int i = 0; i < count; i++)
            assert_false(
                machine_field_lookup(machine, views[i].id, &(struct machine_field_info){0}));
    }
}

/* A loop in the set of ratio 1 stores elements one after the other. The set of ratio R computes
 * with them, and a second loop fetches them. */
static void loops_over_elements_agree(int log_ratio, bool computes)
{
    int r = 1 << log_ratio, length = PROCESSORS * r;
    int fine = machine_vpset_create_ordered(machine, &length, 1, MACHINE_SEND_ORDER);
    uint32_t bits = (uint32_t)r * 32, in, out, alias;
    uint32_t *dense = malloc((size_t)length * sizeof *dense);

    assert_ok(machine_vpset_select(machine, sets[0]), machine);
    in = machine_field_allocate(machine, sets[0], bits, MACHINE_STACK);
    out = machine_field_allocate(machine, sets[0], bits, MACHINE_STACK);
    for (int i = 0; i < r; i++) {
        machine_begin(machine);
        for (int p = 0; p < PROCESSORS; p++)
            dense[p] = (uint32_t)(p * r + i) * 2654435761u;
        if (r <= 64 || i % 64 == 5)
            assert_ok(
                machine_field_upload(machine, in + 32 * (uint32_t)i, MACHINE_UINT(32), dense),
                machine);
    }
    for (int i = 0; computes && i < r; i++) { /* twice each */
        machine_begin(machine);
        struct machine_value *v = machine_field_value(machine, in + 32 * (uint32_t)i,
                                                      MACHINE_UINT(32), MACHINE_EVERYWHERE);
        v = machine_binary(machine, MACHINE_ADD, v, v);
        assert_ok(machine_field_store(machine, in + 32 * (uint32_t)i, v, MACHINE_EVERYWHERE),
                  machine);
    }
    machine_begin(machine);
    alias = machine_alias_make(machine, in, fine);
    assert_ok(machine_vpset_select(machine, fine), machine);
    struct machine_value *v =
        machine_field_value(machine, alias, MACHINE_UINT(32), MACHINE_EVERYWHERE);
    v = machine_binary(machine, MACHINE_ADD, v, machine_self_address(machine, 32));
    assert_ok(machine_field_store(machine, alias, v, MACHINE_EVERYWHERE), machine);
    assert_ok(machine_vpset_select(machine, sets[0]), machine);
    for (int i = 0; i < r; i++) {
        machine_begin(machine);
        v = machine_field_value(machine, in + 32 * (uint32_t)i, MACHINE_UINT(32),
                                MACHINE_EVERYWHERE);
        v = machine_binary(machine, MACHINE_ADD, v, v);
        assert_ok(machine_field_store(machine, out + 32 * (uint32_t)i, v, MACHINE_EVERYWHERE),
                  machine);
    }
    for (int i = 0; i < r; i++) { /* in place */
        machine_begin(machine);
        v = machine_field_value(machine, out + 32 * (uint32_t)i, MACHINE_UINT(32),
                                MACHINE_EVERYWHERE);
        v = machine_binary(machine, MACHINE_ADD, v, v);
        assert_ok(machine_field_store(machine, out + 32 * (uint32_t)i, v, MACHINE_EVERYWHERE),
                  machine);
    }
    machine_begin(machine);
    assert_ok(machine_alias_remove(machine, alias), machine);
    alias = machine_alias_make(machine, out, fine);
    assert_ok(machine_field_download(machine, alias, MACHINE_UINT(32), dense), machine);
    for (int n = 0; n < length; n++) {
        bool stored = r <= 64 || n % r % 64 == 5;
        uint32_t expected = stored ? (uint32_t)n * 2654435761u * (computes ? 2 : 1) : 0;
        if (dense[n] != 4 * (expected + (uint32_t)n))
            fail_msg("ratio %d: element %d is %x, not %x", r, n, dense[n],
                     4 * (expected + (uint32_t)n));
    }
    machine_begin(machine);
    assert_ok(machine_field_deallocate_through(machine, in), machine);
    assert_ok(machine_vpset_destroy(machine, fine), machine);
    free(dense);
}

static void elements_go_out_and_come_back_for_every_ratio(void **unused)
{
    (void)unused;
    for (int log_ratio = 0; log_ratio <= 12; log_ratio++)
        loops_over_elements_agree(log_ratio, log_ratio <= 3);
}

/* Words that are written in the set of ratio 1 are read as single bits in the set of ratio
 * r. */
static void words_become_bits_for_every_ratio(void **unused)
{
    (void)unused;
    for (int log_ratio = 1; log_ratio <= 12; log_ratio++) {
        int r = 1 << log_ratio, length = PROCESSORS * r;
        int fine = machine_vpset_create_ordered(machine, &length, 1, MACHINE_SEND_ORDER);
        unsigned char *dense = malloc((size_t)length);
        uint32_t f = machine_field_allocate(machine, sets[0], (uint32_t)r, MACHINE_STACK),
                 alias;
        uint64_t words[PROCESSORS];

        for (int at = 0; at < r; at += 64) {
            int width = r - at < 64 ? r - at : 64;
            for (uint64_t p = 0; p < PROCESSORS; p++)
                words[p] = (p + 1) * SAMPLE_GOLDEN * (uint64_t)(at + 1) >> (64 - width);
            machine_begin(machine);
            unsigned char small[PROCESSORS * 8];
            size_t bytes = machine_element_bytes(MACHINE_UINT(width));
            for (size_t p = 0; p < PROCESSORS; p++)
                memcpy(small + p * bytes, &words[p], bytes);
            assert_ok(
                machine_field_upload(machine, f + (uint32_t)at, MACHINE_UINT(width), small),
                machine);
        }
        machine_begin(machine);
        alias = machine_alias_make(machine, f, fine);
        assert_ok(machine_field_download(machine, alias, MACHINE_BIT, dense), machine);
        for (int n = 0; n < length; n++) {
            int p = n / r, at = n % r / 64 * 64, width = r - at < 64 ? r - at : 64;
            uint64_t word =
                (uint64_t)(p + 1) * SAMPLE_GOLDEN * (uint64_t)(at + 1) >> (64 - width);
            if (dense[n] != (word >> n % r % 64 & 1))
                fail_msg("ratio %d: bit %d is %d", r, n, dense[n]);
        }
        machine_begin(machine);
        assert_ok(machine_field_deallocate_through(machine, f), machine);
        assert_ok(machine_vpset_destroy(machine, fine), machine);
        free(dense);
    }
}

/* Slices that are copied through an alias share the old values: no kernel runs to copy or
 * reshape them. */
static void copies_of_slices_cost_nothing(void **unused)
{
    (void)unused;
    struct machine_stats before, after;
    int length = PROCESSORS * 8;
    uint32_t f, g, alias, back;
    int fine = machine_vpset_create_ordered(machine, &length, 1, MACHINE_SEND_ORDER);

    machine_begin(machine);
    f = machine_field_allocate(machine, sets[0], 256, MACHINE_HEAP);
    g = machine_field_allocate(machine, sets[0], 256, MACHINE_HEAP);
    alias = machine_alias_make(machine, f, fine);
    struct view v = {.id = alias, .bits = 32, .set = fine, .parts = 1, .outer = 32};
    memset(memory, 0, sizeof memory);
    write_all(&v, 0, MACHINE_UINT(32));
    machine_stats_get(machine, &before);
    for (uint32_t i = 0; i < 8; i++) {
        machine_begin(machine);
        struct machine_value *x =
            machine_field_value(machine, f + 32 * i, MACHINE_UINT(32), MACHINE_EVERYWHERE);
        assert_ok(machine_field_store(machine, g + 32 * i, x, MACHINE_EVERYWHERE), machine);
    }
    back = machine_alias_make(machine, g, fine);
    v.id = back;
    check_all(&v, 0, MACHINE_UINT(32), "copy");
    machine_stats_get(machine, &after);
    assert_int_equal(before.kernels_run, after.kernels_run);
    /* The alias's VP set is destroyed; the memory keeps its contents. */
    machine_begin(machine);
    assert_ok(machine_vpset_destroy(machine, fine), machine);
    assert_false(machine_field_lookup(machine, alias, &(struct machine_field_info){0}));
    struct view w = {.id = g, .bits = 256, .set = sets[0], .parts = 1, .outer = 256};
    for (uint32_t i = 0; i < 8; i++)
        check_all(&w, 32 * i, MACHINE_UINT(32), "what stays");
    assert_ok(machine_field_deallocate(machine, f), machine);
    assert_ok(machine_field_deallocate(machine, g), machine);
}

static void missing_processors_have_no_memory(void **unused)
{
    (void)unused;
    int length = 41; /* ratio 3, of 48 places */
    int odd = machine_vpset_create_ordered(machine, &length, 1, MACHINE_SEND_ORDER);
    struct view all = root_make(sets[0], 24), part = alias_make(&all, 0, odd);

    assert_int_equal(part.bits, 8);
    write_all(&all, 0, MACHINE_UINT(24));
    check_all(&part, 0, MACHINE_UINT(8), "41 of 48");
    write_all(&part, 0, MACHINE_UINT(8));
    for (int n = 41; n < 48; n++)
        memset(&memory[n / 3][n % 3 * 8], 0, 8);
    check_all(&all, 0, MACHINE_UINT(24), "the others are 0");
    assert_ok(machine_field_deallocate(machine, all.id), machine);
    assert_ok(machine_vpset_destroy(machine, odd), machine);
}

/* The bits of the processor that is so much further along the last axis. Rows of arrays hold
 * their other ends, too. */
static void check_moved(const struct view *v, uint32_t at, uint32_t width, int distance)
{
    const struct machine_type type = MACHINE_UINT(width);
    const uint64_t count = machine_vpset_count(machine, v->set);
    machine_begin(machine);
    assert_ok(machine_vpset_select(machine, v->set), machine);
    const int last = machine->values->sets[v->set].rank - 1;
    const uint64_t row = (uint64_t)machine->values->sets[v->set].width;
    const uint32_t f = machine_field_allocate(machine, v->set, width, MACHINE_HEAP);
    struct machine_value *x =
        machine_field_value(machine, v->id + at, type, MACHINE_EVERYWHERE);
    assert_ok(machine_field_store(machine, f, machine_shift(machine, x, last, distance),
                                  MACHINE_EVERYWHERE),
              machine);
    unsigned char *dense = malloc(count * machine_element_bytes(type));
    assert_ok(machine_field_download(machine, f, type, dense), machine);
    for (uint64_t n = 0; n < count; n++) {
        const uint64_t x0 = n % row,
                       there = n - x0 + (x0 + row + (uint64_t)(int64_t)distance) % row;
        wide expected = 0;
        for (uint32_t b = 0; b < width; b++)
            expected |= (wide)*bit_of(v, there, at + b) << b;
        if (support_element(dense, type, n) != expected)
            fail_msg("ratio %d, bits %u..%u moved by %d: element %d", (int)ratio_of(v->set), at,
                     at + width - 1, distance, (int)n);
    }
    free(dense);
    assert_ok(machine_field_deallocate(machine, f), machine);
}

static void neighbours_see_what_aliases_hold(void **unused)
{
    (void)unused;
    for (int from = 0; from < SETS; from++)
        for (int to = 0; to < SETS; to++) {
            static const uint32_t lengths[] = {8, 32};
            const uint64_t a = ratio_of(sets[from]), b = ratio_of(sets[to]);
            const uint32_t width = lengths[to % 2];
            if (b < a || (from * SETS + to) % 5) /* few kernels are compiled */
                continue;
            struct view all = root_make(sets[from], width * (uint32_t)b),
                        fine = alias_make(&all, 0, sets[to]);
            for (uint32_t at = 0; at + width <= all.bits; at += width)
                write_all(&all, at, MACHINE_UINT(width));
            check_moved(&fine, 0, width, 1);
            write_all(&fine, 0, MACHINE_UINT(width));
            check_moved(&all, all.bits - width, width, -2);
            check_moved(&all, 0, width, 3);
            machine_begin(machine);
            assert_ok(machine_field_deallocate(machine, all.id), machine);
        }
}

static void wrong_aliases_are_refused(void **unused)
{
    (void)unused;
    uint32_t f = machine_field_allocate(machine, sets[0], 64, MACHINE_HEAP);
    uint32_t nothing = machine_field_allocate(machine, sets[0], 0, MACHINE_STACK);
    uint32_t alias = machine_alias_make(machine, f, sets[1]);

    assert_true(nothing != MACHINE_NO_FIELD);
    assert_true(machine_alias_make(machine, nothing, sets[2]) != MACHINE_NO_FIELD);
    assert_ok(machine_field_deallocate_through(machine, nothing), machine);
    assert_true(machine_is_alias(machine, alias) && !machine_is_alias(machine, f));
    assert_int_equal(machine_alias_remove(machine, f), MACHINE_BAD_ARGUMENT);
    assert_int_equal(machine_field_deallocate(machine, alias), MACHINE_BAD_ARGUMENT);
    assert_int_equal(machine_alias_make(machine, f, 999), MACHINE_NO_FIELD);
    assert_ok(machine_alias_change(machine, alias, f + 32), machine);
    assert_ok(machine_alias_remove(machine, alias), machine);
    assert_int_equal(machine_alias_remove(machine, alias), MACHINE_BAD_ARGUMENT);
    assert_int_equal(machine_alias_make(machine, alias, sets[0]), MACHINE_NO_FIELD);
    machine_error_clear(machine);
    assert_ok(machine_field_deallocate(machine, f), machine);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stores_are_seen_from_all_sides),
        cmocka_unit_test(elements_go_out_and_come_back_for_every_ratio),
        cmocka_unit_test(words_become_bits_for_every_ratio),
        cmocka_unit_test(copies_of_slices_cost_nothing),
        cmocka_unit_test(missing_processors_have_no_memory),
        cmocka_unit_test(neighbours_see_what_aliases_hold),
        cmocka_unit_test(wrong_aliases_are_refused),
    };
    int failed = 0;

    for (int eager = 0; eager < 2; eager++) {
        machine = support_machine(eager);
        make_sets();
        failed += cmocka_run_group_tests_name(eager ? "eager" : "lazy", tests, NULL, NULL);
        if (eager == 0)
            state = 1;
        support_machine_destroy(machine);
    }
    return failed;
}
