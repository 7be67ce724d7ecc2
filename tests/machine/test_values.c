/* test_values.c - every operation on values against plain C, over widths below, at and above
 * those of machine words.
 *
 * All operations of one width are one evaluation: each stores into a field, then all fields are
 * downloaded. */
#include "support.h"

#include <math.h>

static const int widths[] = {1, 2, 7, 8, 13, 16, 31, 32, 33, 48, 63, 64, 65, 100, 127, 128};
enum { WIDTHS = sizeof widths / sizeof widths[0], COUNT = 5 * 43 };

static struct machine *machine;

static int group_setup(void **state)
{
    (void)state;
    machine = support_machine(0);
    support_set(machine, 2, 5, 43);
    return 0;
}

static int group_teardown(void **state)
{
    (void)state;
    machine_destroy(machine);
    return 0;
}

struct binary_case {
    const char *name;
    enum machine_op op;
    struct machine_type type;
};

static wide word_a(struct machine_type type, uint64_t n)
{
    return support_word(type, 1, n);
}

static wide word_b(struct machine_type type, uint64_t n)
{
    /* often equal to a, so that comparisons also find equal numbers */
    return n % 5 == 0 ? word_a(type, n) : support_word(type, 2, n);
}

static uint32_t upload(struct machine_type type, wide (*word)(struct machine_type, uint64_t))
{
    char *array = calloc(COUNT, 16);
    uint32_t field = machine_field_allocate(machine, machine_vpset_current(machine), type.width,
                                            MACHINE_HEAP);

    assert_non_null(array);
    for (uint64_t n = 0; n < COUNT; n++)
        support_element_set(array, type, n, word(type, n));
    assert_ok(machine_field_upload(machine, field, type, array), machine);
    free(array);
    return field;
}

/* ---- bits ---- */

static wide expected_bits(const void *data, uint64_t n)
{
    const struct binary_case *c = data;
    int w = c->type.width;
    wide a = word_a(c->type, n), b = word_b(c->type, n);

    return support_integer(c->op, w, a, b);
}

#define CASE(op)                                                                               \
    {                                                                                          \
#op, MACHINE_##op,                                                                     \
        {                                                                                      \
            0, 0, 0, 0                                                                         \
        }                                                                                      \
    }

static void all_operations(const struct binary_case *ops, size_t count,
                           struct machine_type type, support_expected expected,
                           enum machine_op last_unary)
{
    uint32_t a = upload(type, word_a), b = upload(type, word_b), results[32];

    for (size_t k = 0; k < count; k++) {
        struct machine_value *x, *y, *r;

        machine_begin(machine);
        x = support_value(machine, a, type);
        y = support_value(machine, b, type);
        r = ops[k].op <= last_unary ? machine_unary(machine, ops[k].op, x)
                                    : machine_binary(machine, ops[k].op, x, y);
        if (!r)
            fail_msg("%s of %d bits: %s", ops[k].name, type.width, machine_error(machine));
        results[k] = machine_field_allocate(machine, machine_vpset_current(machine),
                                            machine_value_type(r).width, MACHINE_HEAP);
        assert_ok(machine_field_store(machine, results[k], r, MACHINE_EVERYWHERE), machine);
    }
    assert_ok(machine_finish(machine), machine); /* one evaluation for all of them */
    for (size_t k = 0; k < count; k++) {
        struct binary_case c = ops[k];
        struct machine_field_info info;
        char what[64];

        c.type = type;
        assert_true(machine_field_lookup(machine, results[k], &info));
        snprintf(what, sizeof what, "%s of %d bits", c.name, type.width);
        support_expect_field(machine, results[k],
                             info.bits == 1 && type.width != 1 ? MACHINE_BIT
                             : type.kind == MACHINE_FLOAT && info.bits > 1
                                 ? type
                                 : MACHINE_UINT(info.bits),
                             expected, &c, what);
        assert_ok(machine_field_deallocate(machine, results[k]), machine);
    }
    assert_ok(machine_field_deallocate(machine, a), machine);
    assert_ok(machine_field_deallocate(machine, b), machine);
}

static void bits_operations_agree_at_every_width(void **state)
{
    static const struct binary_case ops[] = {
        CASE(NOT), CASE(NEG), CASE(AND),  CASE(OR),   CASE(XOR),  CASE(ADD),
        CASE(SUB), CASE(MUL), CASE(UMIN), CASE(UMAX), CASE(SMIN), CASE(SMAX),
        CASE(EQ),  CASE(NE),  CASE(ULT),  CASE(ULE),  CASE(SLT),  CASE(SLE),
    };

    (void)state;
    for (int k = 0; k < WIDTHS; k++)
        all_operations(ops, sizeof ops / sizeof ops[0], MACHINE_UINT(widths[k]), expected_bits,
                       MACHINE_NEG);
}

/* ---- floats ---- */

static wide rounded(double (*to_integer)(double), uint64_t a, int bits)
{
    return number_real(to_integer(number_value(a, bits)), bits);
}

static wide expected_float(const void *data, uint64_t n)
{
    static const uint8_t arithmetic[] = {
        [MACHINE_FNEG] = OP_NEGATE, [MACHINE_FABS] = OP_ABS,      [MACHINE_FSQRT] = OP_SQRT,
        [MACHINE_FADD] = OP_ADD,    [MACHINE_FSUB] = OP_SUBTRACT, [MACHINE_FMUL] = OP_MULTIPLY,
        [MACHINE_FDIV] = OP_DIVIDE, [MACHINE_FMIN] = OP_MIN,      [MACHINE_FMAX] = OP_MAX,
        [MACHINE_FEQ] = OP_EQ,      [MACHINE_FNE] = OP_NE,        [MACHINE_FLT] = OP_LT,
        [MACHINE_FLE] = OP_LE,      [MACHINE_FGT] = OP_GT,        [MACHINE_FGE] = OP_GE};
    const struct binary_case *c = data;
    int bits = c->type.width;
    uint64_t a = (uint64_t)word_a(c->type, n), b = (uint64_t)word_b(c->type, n);
    bool ignored;

    switch ((int)c->op) {
    case MACHINE_FFLOOR:
        return rounded(floor, a, bits);
    case MACHINE_FCEIL:
        return rounded(ceil, a, bits);
    case MACHINE_FTRUNC:
        return rounded(trunc, a, bits);
    case MACHINE_FROUND:
        return rounded(rint, a, bits);
    default:
        break;
    }
    if (c->op >= MACHINE_FEQ)
        return number_compare_float((enum op)arithmetic[c->op], bits, a, b);
    return number_float((enum op)arithmetic[c->op], bits, a, b, &ignored);
}

static void float_operations_agree(void **state)
{
    static const struct binary_case ops[] = {
        CASE(FNEG),   CASE(FABS),   CASE(FSQRT), CASE(FFLOOR), CASE(FCEIL),
        CASE(FTRUNC), CASE(FROUND), CASE(FADD),  CASE(FSUB),   CASE(FMUL),
        CASE(FDIV),   CASE(FMIN),   CASE(FMAX),  CASE(FEQ),    CASE(FNE),
        CASE(FLT),    CASE(FLE),    CASE(FGT),   CASE(FGE),
    };

    (void)state;
    all_operations(ops, sizeof ops / sizeof ops[0], MACHINE_F32, expected_float,
                   MACHINE_FROUND);
    all_operations(ops, sizeof ops / sizeof ops[0], MACHINE_F64, expected_float,
                   MACHINE_FROUND);
}

/* ---- shapes of bits ---- */

struct shape_case {
    struct machine_type from, to;
    int offset;
    bool is_signed;
};

static wide expected_resize(const void *data, uint64_t n)
{
    const struct shape_case *c = data;
    wide a = word_a(c->from, n);

    return (c->is_signed ? (wide)wide_signed(a, c->from.width) : a) & wide_mask(c->to.width);
}

static wide expected_extract(const void *data, uint64_t n)
{
    const struct shape_case *c = data;

    return word_a(c->from, n) >> c->offset & wide_mask(c->to.width);
}

static void resize_extends_and_cuts(void **state)
{
    static const int pairs[][2] = {{1, 2},    {5, 64},  {13, 8},  {32, 33},
                                   {64, 128}, {65, 32}, {128, 1}, {31, 100}};

    (void)state;
    for (size_t k = 0; k < sizeof pairs / sizeof pairs[0]; k++)
        for (int is_signed = 0; is_signed < 2; is_signed++) {
            struct shape_case c = {MACHINE_UINT(pairs[k][0]), MACHINE_UINT(pairs[k][1]), 0,
                                   is_signed};
            uint32_t a = upload(c.from, word_a);

            machine_begin(machine);
            support_later(machine,
                          machine_resize(machine, support_value(machine, a, c.from), c.to.width,
                                         is_signed),
                          expected_resize, &c, sizeof c, "resize");
            assert_ok(machine_field_deallocate(machine, a), machine);
        }
    support_check(machine);
}

static void extract_takes_the_bits_at_the_offset(void **state)
{
    static const int cases[][3] = {{32, 0, 8},   {33, 32, 1},   {64, 31, 2},
                                   {128, 60, 9}, {128, 64, 64}, {100, 33, 67}};

    (void)state;
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
        struct shape_case c = {MACHINE_UINT(cases[k][0]), MACHINE_UINT(cases[k][2]),
                               cases[k][1], false};
        uint32_t a = upload(c.from, word_a);

        machine_begin(machine);
        support_later(
            machine,
            machine_extract(machine, support_value(machine, a, c.from), c.offset, c.to.width),
            expected_extract, &c, sizeof c, "extract");
        assert_ok(machine_field_deallocate(machine, a), machine);
    }
    support_check(machine);
}

static wide expected_concat(const void *data, uint64_t n)
{
    const struct shape_case *c = data;

    return word_a(c->from, n) | word_b(c->to, n) << c->from.width;
}

static void concat_puts_the_second_above_the_first(void **state)
{
    static const int cases[][2] = {{1, 1},   {8, 24},  {31, 2}, {32, 32},
                                   {64, 64}, {1, 127}, {70, 10}};

    (void)state;
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
        struct shape_case c = {MACHINE_UINT(cases[k][0]), MACHINE_UINT(cases[k][1]), 0, false};
        uint32_t a = upload(c.from, word_a), b = upload(c.to, word_b);

        machine_begin(machine);
        support_later(machine,
                      machine_concat(machine, support_value(machine, a, c.from),
                                     support_value(machine, b, c.to)),
                      expected_concat, &c, sizeof c, "concat");
        assert_ok(machine_field_deallocate(machine, a), machine);
        assert_ok(machine_field_deallocate(machine, b), machine);
    }
    support_check(machine);
}

static wide expected_same(const void *data, uint64_t n)
{
    return word_a(*(const struct machine_type *)data, n);
}

static void reinterpret_keeps_every_bit(void **state)
{
    struct machine_type words = MACHINE_UINT(32), longs = MACHINE_UINT(64);
    uint32_t a = upload(words, word_a), b = upload(longs, word_a);

    (void)state;
    machine_begin(machine);
    support_expect(machine,
                   machine_reinterpret(machine, support_value(machine, a, words), MACHINE_F32),
                   expected_same, &words, "bits as single");
    support_expect(machine,
                   machine_reinterpret(machine, support_value(machine, b, longs), MACHINE_F64),
                   expected_same, &longs, "bits as double");
    assert_ok(machine_field_deallocate(machine, a), machine);
    assert_ok(machine_field_deallocate(machine, b), machine);
}

static wide expected_select(const void *data, uint64_t n)
{
    struct machine_type type = *(const struct machine_type *)data;

    return word_a(MACHINE_BIT, n) ? word_a(type, n) : word_b(type, n);
}

static void select_chooses_by_the_bit(void **state)
{
    static const int kinds[] = {1, 8, 32, 64, 128};
    uint32_t bit = upload(MACHINE_BIT, word_a);

    (void)state;
    for (size_t k = 0; k < 5; k++) {
        struct machine_type type = MACHINE_UINT(kinds[k]);
        uint32_t a = upload(type, word_a), b = upload(type, word_b);

        machine_begin(machine);
        support_later(machine,
                      machine_select(machine, support_value(machine, bit, MACHINE_BIT),
                                     support_value(machine, a, type),
                                     support_value(machine, b, type)),
                      expected_select, &type, sizeof type, "select");
        assert_ok(machine_field_deallocate(machine, a), machine);
        assert_ok(machine_field_deallocate(machine, b), machine);
    }
    support_check(machine);
    assert_ok(machine_field_deallocate(machine, bit), machine);
}

/* ---- conversions ---- */

static wide expected_to_float(const void *data, uint64_t n)
{
    const struct shape_case *c = data;
    wide a = word_a(c->from, n);

    if (c->from.kind == MACHINE_FLOAT)
        return number_resize_float((uint64_t)a, c->from.width, c->to.width);
    return number_from_integer(
        c->is_signed, c->is_signed ? (wide)wide_signed(a, c->from.width) : a, c->to.width);
}

static wide expected_to_bits(const void *data, uint64_t n)
{
    const struct shape_case *c = data;
    bool ignored;

    return number_to_integer(OP_TRUNCATE, c->is_signed, (uint64_t)word_a(c->from, n),
                             c->from.width, c->to.width, &ignored);
}

static void conversions_round_and_stop_at_the_ends(void **state)
{
    (void)state;
    for (int k = 0; k < WIDTHS; k++) {
        for (int way = 0; way < 4; way++) {
            bool is_signed = way & 1;
            struct machine_type real = way & 2 ? MACHINE_F64 : MACHINE_F32;
            struct shape_case to_float = {MACHINE_UINT(widths[k]), real, 0, is_signed};
            struct shape_case to_bits = {real, MACHINE_UINT(widths[k]), 0, is_signed};
            uint32_t a = upload(to_float.from, word_a), b = upload(real, word_a);
            char what[64];

            snprintf(what, sizeof what, "%d bits, %s, to float of %d", widths[k],
                     is_signed ? "signed" : "unsigned", real.width);
            machine_begin(machine);
            support_later(machine,
                          machine_to_float(machine, support_value(machine, a, to_float.from),
                                           real, is_signed),
                          expected_to_float, &to_float, sizeof to_float, what);
            snprintf(what, sizeof what, "float of %d to %d bits, %s", real.width, widths[k],
                     is_signed ? "signed" : "unsigned");
            support_later(
                machine,
                machine_to_bits(machine, support_value(machine, b, real), widths[k], is_signed),
                expected_to_bits, &to_bits, sizeof to_bits, what);
            assert_ok(machine_field_deallocate(machine, a), machine);
            assert_ok(machine_field_deallocate(machine, b), machine);
        }
        support_check(machine);
    }
}

static void floats_change_their_length(void **state)
{
    struct shape_case narrow = {MACHINE_F64, MACHINE_F32, 0, false},
                      widen = {MACHINE_F32, MACHINE_F64, 0, false};
    uint32_t a = upload(MACHINE_F64, word_a), b = upload(MACHINE_F32, word_a);

    (void)state;
    machine_begin(machine);
    support_expect(
        machine,
        machine_to_float(machine, support_value(machine, a, MACHINE_F64), MACHINE_F32, false),
        expected_to_float, &narrow, "double to single");
    support_expect(
        machine,
        machine_to_float(machine, support_value(machine, b, MACHINE_F32), MACHINE_F64, false),
        expected_to_float, &widen, "single to double");
    assert_ok(machine_field_deallocate(machine, a), machine);
    assert_ok(machine_field_deallocate(machine, b), machine);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bits_operations_agree_at_every_width),
        cmocka_unit_test(float_operations_agree),
        cmocka_unit_test(resize_extends_and_cuts),
        cmocka_unit_test(extract_takes_the_bits_at_the_offset),
        cmocka_unit_test(concat_puts_the_second_above_the_first),
        cmocka_unit_test(reinterpret_keeps_every_bit),
        cmocka_unit_test(select_chooses_by_the_bit),
        cmocka_unit_test(conversions_round_and_stop_at_the_ends),
        cmocka_unit_test(floats_change_their_length),
    };

    return cmocka_run_group_tests(tests, group_setup, group_teardown);
}
