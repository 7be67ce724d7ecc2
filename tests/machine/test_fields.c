/* test_fields.c - VP sets, fields, flags and context: which bits a store changes, and what a
 * later read returns. */
#include "support.h"

static struct machine *machine;
static int set;

enum { ROWS = 3, COLUMNS = 41, COUNT = ROWS * COLUMNS };

static int setup(void **state)
{
    (void)state;
    machine = support_machine(0);
    set = support_set(machine, 2, ROWS, COLUMNS);
    return 0;
}

static int teardown(void **state)
{
    (void)state;
    machine_destroy(machine);
    return 0;
}

static wide expected_zero(const void *data, uint64_t n)
{
    (void)data;
    (void)n;
    return 0;
}

static struct machine_value *bits(int width, uint64_t value)
{
    return machine_constant(machine, MACHINE_UINT(width), (struct machine_scalar){value, 0});
}

/* ---- VP sets ---- */

static void vpset_knows_its_shape(void **state)
{
    int other;

    (void)state;
    other = machine_vpset_create(machine, (int[]){4, 5, 6}, 3);
    assert_true(other > 0 && other != set);
    assert_int_equal(machine_vpset_current(machine), set);
    assert_int_equal(machine_vpset_rank(machine, other), 3);
    assert_int_equal(machine_vpset_length(machine, other, 1), 5);
    assert_int_equal(machine_vpset_count(machine, other), 120);
    assert_int_equal(machine_vpset_ratio(machine, other), 8); /* ceil(120 / 16) */
    assert_ok(machine_vpset_destroy(machine, other), machine);
    assert_int_not_equal(machine_vpset_select(machine, other), MACHINE_OK);
}

static void vpset_addresses_go_there_and_back(void **state)
{
    uint64_t ratio = machine_vpset_ratio(machine, set);

    (void)state;
    assert_int_equal(machine_processors_count(machine), 16);
    for (uint64_t n = 0; n < COUNT; n++) {
        assert_int_equal(machine_send_address(machine, set, n), n % 16 * ratio + n / 16);
        assert_int_equal(machine_index(machine, set, machine_send_address(machine, set, n)), n);
    }
    /* 123 of 128 places are used: the last five processors have no eighth VP */
    assert_true(machine_index(machine, set, 15 * ratio + 7) == UINT64_MAX);
    assert_true(machine_index(machine, set, 16 * ratio) == UINT64_MAX);
}

static void vpset_of_one_works(void **state)
{
    int one = support_set(machine, 4, 1, 1, 1, 1);
    uint32_t f = machine_field_allocate(machine, one, 128, MACHINE_STACK);

    (void)state;
    machine_begin(machine);
    assert_ok(machine_field_store(machine, f,
                                  machine_unary(machine, MACHINE_NOT,
                                                support_value(machine, f, MACHINE_UINT(128))),
                                  MACHINE_WHERE_ACTIVE),
              machine);
    struct machine_scalar got;
    assert_ok(machine_field_read(machine, f, MACHINE_UINT(128), 0, &got), machine);
    assert_true(got.lo == UINT64_MAX && got.hi == UINT64_MAX);
}

/* ---- fields ---- */

static void field_is_zero_when_new_and_when_allocated_again(void **state)
{
    (void)state;
    for (int round = 0; round < 3; round++) {
        uint32_t f = machine_field_allocate(machine, set, 33, MACHINE_STACK);

        support_expect_field(machine, f, MACHINE_UINT(33), expected_zero, NULL, "a new field");
        machine_begin(machine);
        assert_ok(machine_field_store(machine, f, bits(33, UINT64_MAX), MACHINE_EVERYWHERE),
                  machine);
        assert_ok(machine_finish(machine), machine);
        assert_ok(machine_field_deallocate_through(machine, f), machine);
        assert_false(machine_field_lookup(machine, f, &(struct machine_field_info){0}));
    }
}

static void field_lookup_knows_parts(void **state)
{
    uint32_t f = machine_field_allocate(machine, set, 24, MACHINE_HEAP);
    struct machine_field_info info;

    (void)state;
    assert_true(machine_field_lookup(machine, f + 16, &info));
    assert_int_equal(info.base, f);
    assert_int_equal(info.bits, 24);
    assert_int_equal(info.offset, 16);
    assert_int_equal(info.vpset, set);
    assert_int_equal(info.region, MACHINE_HEAP);
    assert_false(machine_field_lookup(machine, f + 24, &info));
    assert_false(machine_field_lookup(machine, MACHINE_NO_FIELD, &info));
    assert_ok(machine_field_deallocate(machine, f), machine);
}

static void field_deallocate_through_takes_the_stack_above(void **state)
{
    uint32_t a = machine_field_allocate(machine, set, 8, MACHINE_STACK);
    uint32_t b = machine_field_allocate(machine, set, 8, MACHINE_STACK);
    uint32_t heap = machine_field_allocate(machine, set, 8, MACHINE_HEAP);
    uint32_t c = machine_field_allocate(machine, set, 8, MACHINE_STACK);
    struct machine_field_info info;

    (void)state;
    assert_ok(machine_field_deallocate_through(machine, b), machine);
    assert_true(machine_field_lookup(machine, a, &info));
    assert_false(machine_field_lookup(machine, b, &info));
    assert_false(machine_field_lookup(machine, c, &info));
    assert_true(machine_field_lookup(machine, heap, &info));
}

/* A pixel of three channels is written whole, one channel is changed, and a read crosses the
 * channels' borders. */
static wide expected_pixel(const void *data, uint64_t n)
{
    wide whole = support_word(MACHINE_UINT(24), 9, n);

    (void)data;
    return (whole & 0xff00ff) | 0x5a00;
}

static wide expected_across(const void *data, uint64_t n)
{
    return expected_pixel(data, n) >> 5 & wide_mask(13);
}

static void field_parts_are_written_and_read_at_any_offset(void **state)
{
    uint32_t f = support_field(machine, MACHINE_UINT(24), 9);

    (void)state;
    machine_begin(machine);
    assert_ok(machine_field_store(machine, f + 8, bits(8, 0x5a), MACHINE_EVERYWHERE), machine);
    support_expect_field(machine, f, MACHINE_UINT(24), expected_pixel, NULL, "the whole pixel");
    support_expect_field(machine, f + 5, MACHINE_UINT(13), expected_across, NULL,
                         "13 bits from bit 5");
    assert_ok(machine_field_deallocate(machine, f), machine);
}

static wide expected_float_bits(const void *data, uint64_t n)
{
    (void)data;
    return number_real((double)n * 0.5, 32);
}

static void field_of_floats_reads_as_bits(void **state)
{
    uint32_t f = machine_field_allocate(machine, set, 32, MACHINE_HEAP);
    struct machine_value *x;

    (void)state;
    machine_begin(machine);
    x = machine_to_float(machine, machine_self_index(machine, 32), MACHINE_F32, false);
    x = machine_binary(machine, MACHINE_FMUL, x,
                       machine_constant_float(machine, MACHINE_F32, 0.5));
    assert_ok(machine_field_store(machine, f, x, MACHINE_EVERYWHERE), machine);
    support_expect_field(machine, f, MACHINE_UINT(32), expected_float_bits, NULL,
                         "floats as words");
}

static void field_moves_keep_the_bits_of_nan(void **state)
{
    uint32_t a = machine_field_allocate(machine, set, 32, MACHINE_HEAP);
    uint32_t b = machine_field_allocate(machine, set, 32, MACHINE_HEAP);
    uint32_t words[COUNT], got[COUNT];

    (void)state;
    for (uint32_t n = 0; n < COUNT; n++)
        words[n] = (n % 2 ? 0xff800001u : 0x7fc00000u) + n;
    assert_ok(machine_field_upload(machine, a, MACHINE_F32, words), machine);
    machine_begin(machine);
    assert_ok(machine_field_store(machine, b, support_value(machine, a, MACHINE_F32),
                                  MACHINE_WHERE_ACTIVE),
              machine);
    assert_ok(machine_field_download(machine, b, MACHINE_F32, got), machine);
    assert_memory_equal(words, got, sizeof words);
    machine_begin(machine);
    assert_ok(machine_field_store(
                  machine, b,
                  machine_shift(machine, support_value(machine, a, MACHINE_F32), 0, ROWS),
                  MACHINE_WHERE_ACTIVE),
              machine);
    assert_ok(machine_field_download(machine, b, MACHINE_F32, got), machine);
    assert_memory_equal(words, got, sizeof words);
}

static void field_reads_and_writes_one_processor(void **state)
{
    static const int widths[] = {1, 8, 13, 32, 64, 65, 128};

    (void)state;
    for (size_t k = 0; k < sizeof widths / sizeof widths[0]; k++) {
        struct machine_type type = MACHINE_UINT(widths[k]);
        uint32_t f = support_field(machine, type, 3);

        for (uint64_t n = 0; n < COUNT; n += 17) {
            struct machine_scalar got, value = support_scalar(support_word(type, 4, n));

            assert_ok(machine_field_read(machine, f, type, n, &got), machine);
            assert_true(got.lo == (uint64_t)support_word(type, 3, n));
            assert_ok(machine_field_write(machine, f, type, n, value), machine);
            assert_ok(machine_field_read(machine, f, type, n, &got), machine);
            assert_true(got.lo == value.lo && got.hi == value.hi);
            if (n + 1 < COUNT) {
                assert_ok(machine_field_read(machine, f, type, n + 1, &got), machine);
                assert_true(got.lo == (uint64_t)support_word(type, 3, n + 1));
            }
        }
        assert_ok(machine_field_deallocate(machine, f), machine);
    }
}

static wide expected_doubled(const void *data, uint64_t n)
{
    (void)data;
    return 2 * support_word(MACHINE_UINT(32), 3, n) & 0xff;
}

static wide expected_doubled_and_written(const void *data, uint64_t n)
{
    return n == 5 ? 0x21 : expected_doubled(data, n);
}

/* A second field may share the value of a part of this field: a write to the part leaves the
 * second field alone. */
static void write_to_a_part_leaves_its_copies_alone(void **state)
{
    (void)state;
    uint32_t whole = support_field(machine, MACHINE_UINT(32), 3),
             part = machine_field_allocate(machine, set, 8, MACHINE_HEAP);
    struct machine_value *x =
        machine_field_value(machine, whole, MACHINE_UINT(32), MACHINE_EVERYWHERE);
    machine_field_store(machine, whole, machine_binary(machine, MACHINE_ADD, x, x),
                        MACHINE_EVERYWHERE);
    machine_begin(machine);
    struct machine_value *low =
        machine_field_value(machine, whole, MACHINE_UINT(8), MACHINE_EVERYWHERE);
    machine_field_store(machine, part, low, MACHINE_EVERYWHERE);
    machine_begin(machine);
    machine_field_write(machine, whole, MACHINE_UINT(8), 5, (struct machine_scalar){0x21, 0});
    machine_begin(machine);
    support_expect_field(machine, part, MACHINE_UINT(8), expected_doubled, NULL, "the copy");
    support_expect_field(machine, whole, MACHINE_UINT(8), expected_doubled_and_written, NULL,
                         "the part");
}

static void upload_does_not_change_what_was_taken_before(void **state)
{
    uint32_t a = support_field(machine, MACHINE_UINT(32), 1);
    uint32_t b = machine_field_allocate(machine, set, 32, MACHINE_HEAP);
    uint32_t zeros[COUNT] = {0}, got[COUNT];

    (void)state;
    machine_begin(machine);
    assert_ok(machine_field_store(machine, b, support_value(machine, a, MACHINE_UINT(32)),
                                  MACHINE_EVERYWHERE),
              machine);
    assert_ok(machine_field_upload(machine, a, MACHINE_UINT(32), zeros), machine);
    assert_ok(machine_field_download(machine, b, MACHINE_UINT(32), got), machine);
    for (uint64_t n = 0; n < COUNT; n++)
        assert_true(got[n] == (uint32_t)support_word(MACHINE_UINT(32), 1, n));
}

/* ---- context and flags ---- */

static wide expected_stripes(const void *data, uint64_t n)
{
    (void)data;
    return n % COLUMNS % 3 == 0 ? 7 : support_word(MACHINE_UINT(32), 1, n);
}

static void context_keeps_inactive_processors_as_they_were(void **state)
{
    uint32_t f = support_field(machine, MACHINE_UINT(32), 1);
    uint32_t stripes = machine_field_allocate(machine, set, 1, MACHINE_HEAP);
    uint8_t on[COUNT];

    (void)state;
    for (int n = 0; n < COUNT; n++)
        on[n] = n % COLUMNS % 3 == 0;
    assert_ok(machine_field_upload(machine, stripes, MACHINE_BIT, on), machine);
    machine_begin(machine);
    assert_ok(machine_flag_store(machine, MACHINE_CONTEXT,
                                 support_value(machine, stripes, MACHINE_BIT),
                                 MACHINE_EVERYWHERE),
              machine);
    machine_begin(machine);
    assert_ok(machine_field_store(machine, f, bits(32, 7), MACHINE_WHERE_ACTIVE), machine);
    support_expect_field(machine, f, MACHINE_UINT(32), expected_stripes, NULL,
                         "a store under a context");
    machine_begin(machine);
    assert_ok(machine_field_store(machine, f, bits(32, 0), MACHINE_EVERYWHERE), machine);
    support_expect_field(machine, f, MACHINE_UINT(32), expected_zero, NULL,
                         "a store everywhere");
}

static void flags_begin_as_documented_and_belong_to_their_set(void **state)
{
    uint8_t got[COUNT];
    uint32_t f = machine_field_allocate(machine, set, 1, MACHINE_HEAP);

    (void)state;
    for (int flag = MACHINE_CONTEXT; flag <= MACHINE_OVERFLOW; flag++) {
        machine_begin(machine);
        assert_ok(machine_field_store(
                      machine, f,
                      machine_flag_value(machine, (enum machine_flag)flag, MACHINE_EVERYWHERE),
                      MACHINE_EVERYWHERE),
                  machine);
        assert_ok(machine_field_download(machine, f, MACHINE_BIT, got), machine);
        for (int n = 0; n < COUNT; n++)
            assert_int_equal(got[n], flag == MACHINE_CONTEXT);
    }
    machine_begin(machine);
    assert_ok(machine_flag_store(machine, MACHINE_CONTEXT, bits(1, 0), MACHINE_EVERYWHERE),
              machine);
    int other = support_set(machine, 1, COUNT);
    uint32_t g = machine_field_allocate(machine, other, 1, MACHINE_HEAP);
    machine_begin(machine);
    assert_ok(machine_field_store(machine, g, bits(1, 1), MACHINE_WHERE_ACTIVE), machine);
    assert_ok(machine_field_download(machine, g, MACHINE_BIT, got), machine);
    for (int n = 0; n < COUNT; n++)
        assert_int_equal(got[n], 1);
}

struct overflow_case {
    enum machine_op op;
    enum op oracle;
    bool is_signed;
    int width;
};

static wide expected_overflow(const void *data, uint64_t n)
{
    const struct overflow_case *c = data;
    struct machine_type type = MACHINE_UINT(c->width);
    wide a = support_word(type, 1, n), b = support_word(type, 2, n);
    bool overflows = false;

    if (c->is_signed) {
        a = (wide)wide_signed(a, c->width);
        b = (wide)wide_signed(b, c->width);
    }
    number_integer(c->oracle, c->is_signed, a, b, c->width, &overflows);
    return overflows;
}

static void overflow_says_what_does_not_fit(void **state)
{
    static const int widths[] = {2, 8, 31, 32, 33, 64, 65, 128};
    static const struct overflow_case ops[] = {
        {MACHINE_ADD, OP_ADD, false, 0},      {MACHINE_ADD, OP_ADD, true, 0},
        {MACHINE_SUB, OP_SUBTRACT, false, 0}, {MACHINE_SUB, OP_SUBTRACT, true, 0},
        {MACHINE_MUL, OP_MULTIPLY, false, 0}, {MACHINE_MUL, OP_MULTIPLY, true, 0},
        {MACHINE_NEG, OP_NEGATE, true, 0}};

    (void)state;
    for (size_t w = 0; w < sizeof widths / sizeof widths[0]; w++) {
        struct machine_type type = MACHINE_UINT(widths[w]);
        uint32_t fa = support_field(machine, type, 1), fb = support_field(machine, type, 2);

        for (size_t k = 0; k < sizeof ops / sizeof ops[0]; k++) {
            struct overflow_case c = ops[k];
            char what[64];

            c.width = widths[w];
            snprintf(what, sizeof what, "overflow of op %d, %s, %d bits", (int)c.op,
                     c.is_signed ? "signed" : "unsigned", c.width);
            machine_begin(machine);
            assert_ok(machine_overflow_record(
                          machine, c.op, c.is_signed, support_value(machine, fa, type),
                          c.op == MACHINE_NEG ? NULL : support_value(machine, fb, type)),
                      machine);
            support_later(machine,
                          machine_flag_value(machine, MACHINE_OVERFLOW, MACHINE_EVERYWHERE),
                          expected_overflow, &c, sizeof c, what);
        }
        support_check(machine);
    }
}

int main(void)
{
#define CASE(test) cmocka_unit_test_setup_teardown(test, setup, teardown)
    const struct CMUnitTest tests[] = {
        CASE(vpset_knows_its_shape),
        CASE(vpset_addresses_go_there_and_back),
        CASE(vpset_of_one_works),
        CASE(field_is_zero_when_new_and_when_allocated_again),
        CASE(field_lookup_knows_parts),
        CASE(field_deallocate_through_takes_the_stack_above),
        CASE(field_parts_are_written_and_read_at_any_offset),
        CASE(field_of_floats_reads_as_bits),
        CASE(field_moves_keep_the_bits_of_nan),
        CASE(field_reads_and_writes_one_processor),
        CASE(write_to_a_part_leaves_its_copies_alone),
        CASE(upload_does_not_change_what_was_taken_before),
        CASE(context_keeps_inactive_processors_as_they_were),
        CASE(flags_begin_as_documented_and_belong_to_their_set),
        CASE(overflow_says_what_does_not_fit),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
