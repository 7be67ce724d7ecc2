/* Compares the float families (float_... in instructions.tab) on the device with the oracle:
 * every row in every form, in the formats 23,8 and 52,11.
 *
 * All cases share operands in fields that are filled once, and every dest is a copy of one
 * field. So a function is computed once for all its forms, and the machine compiles few
 * kernels. A function with long code is tested at one width in each form. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "device.h"
#include "oracle_floats.h"

enum paris_test_shape {
    PARIS_TEST_FLOAT_UNARY,
    PARIS_TEST_FLOAT_BINARY,
    PARIS_TEST_FLOAT_BY_INTEGER,
    PARIS_TEST_FLOAT_PAIR,
    PARIS_TEST_FLOAT_PART,
    PARIS_TEST_FLOAT_MADE,
    PARIS_TEST_FLOAT_TEST,
    PARIS_TEST_FLOAT_SWAP
};

struct paris_test_args {
    CM_field_id_t dest, source, source1, source2, source3;
    unsigned int slen, slen2, dlen, s, e;
    unsigned long value_u;
    long value_s;
    double value_f, source2_value, source3_value;
};

struct paris_test_row {
    const char *name;
    enum paris_test_shape shape;
    char type, source_type;
    const char *op;
    int operands, lengths, constant, zero, always;
    char other;
    void (*call)(struct paris_test_args *);
};

#include "paris_test_floats.h"

enum { ROW_COUNT = sizeof paris_test_rows / sizeof paris_test_rows[0], BATCH = 36 };

/* The operands of a width, and the state before each case. */
struct operands {
    number before[COUNT], a[COUNT], b[COUNT], c[COUNT], whole[COUNT];
    number context[COUNT], test[COUNT], overflow[COUNT];
    CM_field_id_t f_before, f_a, f_b, f_c, f_whole, f_context, f_test, f_overflow;
};
static struct operands the;

struct trial {
    const struct paris_test_row *row;
    struct paris_test_args args;
    int width, dlen, whole_len; /* widths of the float, of dest, of an integer operand */
    CM_field_id_t first, dest, source, test, overflow;
};
static struct trial batch[BATCH];
static int batch_count, failures, cases_count;

static bool is_integer_dest(const struct paris_test_row *row)
{
    return row->shape == PARIS_TEST_FLOAT_PART;
}

/* ---- comparing ---- */

static void wrong(const struct trial *t, int i, const char *what, number got, number wanted)
{
    if (failures++ < 30)
        fprintf(stderr,
                "%s (%d bits) processor %d: %s is %llx:%llx, wanted %llx:%llx (context %d, "
                "before %llx, sources %llx %llx %llx, integer %llx)\n",
                t->row->name, t->width, i, what, (unsigned long long)(got >> 64),
                (unsigned long long)got, (unsigned long long)(wanted >> 64),
                (unsigned long long)wanted, (int)the.context[i],
                (unsigned long long)the.before[i], (unsigned long long)the.a[i],
                (unsigned long long)the.b[i], (unsigned long long)the.c[i],
                (unsigned long long)the.whole[i]);
}

static struct oracle_float wanted_of(const struct trial *t, int i)
{
    const struct paris_test_row *row = t->row;
    int w = t->width;
    bool in_place =
        row->operands ==
        (row->shape == PARIS_TEST_FLOAT_UNARY || row->shape == PARIS_TEST_FLOAT_MADE ? 1 : 2);
    number x = in_place ? the.before[i] : the.a[i], y = in_place ? the.a[i] : the.b[i];
    number value = oracle_float_bits(w, t->args.value_f);
    switch (row->shape) {
    case PARIS_TEST_FLOAT_UNARY:
        return oracle_function(row->op, w, x, 0);
    case PARIS_TEST_FLOAT_BINARY:
        return oracle_function(row->op, w, x, row->constant ? value : y);
    case PARIS_TEST_FLOAT_BY_INTEGER: {
        bool is_signed = row->source_type == 's';
        number n = row->constant
                       ? is_signed ? (number)(__int128)t->args.value_s : (number)t->args.value_u
                       : the.whole[i];
        return oracle_by_integer(row->op, w, x, n, row->constant ? 128 : t->whole_len,
                                 is_signed);
    }
    case PARIS_TEST_FLOAT_PAIR: {
        double y2 = row->constant == 1 ? t->args.value_f : t->args.source2_value;
        double z2 = row->constant == 2 ? t->args.value_f : t->args.source3_value;
        return oracle_pair(row->op, w, the.a[i],
                           row->constant & 1 ? oracle_float_bits(w, y2) : the.b[i],
                           row->constant & 2 ? oracle_float_bits(w, z2) : the.c[i]);
    }
    case PARIS_TEST_FLOAT_MADE:
        return oracle_made(row->op, w, x);
    case PARIS_TEST_FLOAT_PART: {
        struct oracle_result r = oracle_part(row->op, w, the.a[i], t->dlen, row->type == 's');
        return (struct oracle_float){r.bits, 0, r.overflow};
    }
    case PARIS_TEST_FLOAT_SWAP:
        return (struct oracle_float){the.a[i], 0, false};
    case PARIS_TEST_FLOAT_TEST:
        break;
    }
    return (struct oracle_float){the.before[i], 0, false};
}

static bool overflows(const struct paris_test_row *row)
{
    static const char *const none[] = {"sin",   "cos",     "tan",      "asin",  "acos",
                                       "atan",  "tanh",    "asinh",    "acosh", "atan2",
                                       "floor", "ceiling", "truncate", "round", "signum"};
    for (size_t i = 0; i < sizeof none / sizeof none[0]; i++)
        if (!strcmp(row->op, none[i]))
            return false;
    return row->shape <= PARIS_TEST_FLOAT_PART || strstr(row->op, "vax");
}

static void compare(const struct trial *t)
{
    number dest[COUNT], source[COUNT], test[COUNT], overflow[COUNT];
    bool swap = t->row->shape == PARIS_TEST_FLOAT_SWAP;
    device_get(t->dest, t->dlen, dest);
    device_get(t->overflow, 1, overflow);
    if (t->test)
        device_get(t->test, 1, test);
    if (swap)
        device_get(t->source, t->dlen, source);
    int seen = failures;
    for (int i = 0; i < COUNT && failures == seen; i++) {
        struct oracle_float w = wanted_of(t, i);
        bool active = the.context[i] != 0, stored = active || t->row->always;
        number before = is_integer_dest(t->row) ? 0 : the.before[i];
        if (!stored)
            w = (struct oracle_float){before, 0, false};
        if (w.ulp ? !oracle_float_near(t->width, dest[i], w.bits, w.ulp) : dest[i] != w.bits)
            wrong(t, i, "dest", dest[i], w.bits);
        number flag = active && overflows(t->row) ? w.overflow : the.overflow[i];
        if (overflow[i] != flag)
            wrong(t, i, "overflow", overflow[i], flag);
        if (t->test) {
            flag = active ? oracle_float_test(t->row->op, t->width, the.a[i]) : the.test[i];
            if (test[i] != flag)
                wrong(t, i, "test", test[i], flag);
        }
        if (swap && source[i] != (stored ? the.before[i] : the.a[i]))
            wrong(t, i, "source", source[i], stored ? the.before[i] : the.a[i]);
    }
}

static void batch_finish(void)
{
    if (!batch_count)
        return;
    if (machine_finish(paris_machine()) != MACHINE_OK)
        fail_msg("%s: %s", batch[0].row->name, machine_error(paris_machine()));
    for (int i = 0; i < batch_count; i++)
        compare(&batch[i]);
    CM_deallocate_stack_through(batch[0].first);
    batch_count = 0;
}

/* ---- running ---- */

static CM_field_id_t filled(int width, const number *numbers)
{
    CM_field_id_t field = CM_allocate_heap_field((unsigned int)width);
    device_put(field, width, numbers);
    return field;
}

static void operands_make(int width)
{
    device_floats(the.before, width);
    device_floats(the.a, width);
    device_floats(the.b, width);
    device_floats(the.c, width);
    device_integers(the.whole, 100);
    for (int i = 0; i < COUNT; i += 2) /* results inside the range */
        the.whole[i] = (number)(__int128)((int)(device_random() % 80) - 40) & oracle_mask(100);
    for (int i = 0; i < COUNT; i += 3) {
        the.before[i] = oracle_float_bits(width, (double)(int64_t)device_random() * 0x1p-60);
        the.a[i] = oracle_float_bits(width, (double)(int64_t)device_random() * 0x1p-62);
    }
    the.whole[1] = ((number)1 << 53) + 1;
    the.a[1] = the.before[1] = oracle_float_bits(width, -1 - 0x1p-23);
    device_mask(the.context, 2);
    device_mask(the.test, 2);
    device_mask(the.overflow, 2);
    the.f_before = filled(width, the.before);
    the.f_a = filled(width, the.a);
    the.f_b = filled(width, the.b);
    the.f_c = filled(width, the.c);
    the.f_whole = filled(100, the.whole);
    the.f_context = filled(1, the.context);
    the.f_test = filled(1, the.test);
    the.f_overflow = filled(1, the.overflow);
}

static void operands_free(void)
{
    const CM_field_id_t all[] = {the.f_before, the.f_a,       the.f_b,    the.f_c,
                                 the.f_whole,  the.f_context, the.f_test, the.f_overflow};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        CM_deallocate_heap_field(all[i]);
}

static void trial_run(const struct paris_test_row *row, int width, int dlen, int whole_len)
{
    struct trial *t = &batch[batch_count++];
    unsigned int s = width == 32 ? 23 : 52, e = width == 32 ? 8 : 11;
    bool test = row->shape == PARIS_TEST_FLOAT_TEST;
    *t = (struct trial){.row = row, .width = width, .dlen = dlen, .whole_len = whole_len};
    t->first = t->dest = CM_allocate_stack_field((unsigned int)dlen);
    t->source = the.f_a;
    t->overflow = CM_allocate_stack_field(1);
    t->test = test ? CM_allocate_stack_field(1) : 0;
    if (!is_integer_dest(row))
        CM_f_move_always_1L(t->dest, the.f_before, s, e);
    if (row->shape == PARIS_TEST_FLOAT_SWAP) {
        t->source = CM_allocate_stack_field((unsigned int)width);
        CM_f_move_always_1L(t->source, the.f_a, s, e);
    }
    t->args = (struct paris_test_args){
        .dest = t->dest,
        .source = t->source,
        .source1 = the.f_a,
        .source2 = the.f_b,
        .source3 = the.f_c,
        .slen = (unsigned int)whole_len,
        .slen2 = (unsigned int)whole_len,
        .dlen = (unsigned int)dlen,
        .s = s,
        .e = e,
        .value_u = 5,
        .value_s = -3,
        .value_f = 1.75,
        .source2_value = -0.375,
        .source3_value = 3.5,
    };
    if (row->shape == PARIS_TEST_FLOAT_BY_INTEGER && row->operands == 2 && !row->constant)
        t->args.source = the.f_whole;
    if (row->shape == PARIS_TEST_FLOAT_BY_INTEGER)
        t->args.source2 = the.f_whole;
    CM_load_test_always(the.f_test);
    CM_load_overflow_always(the.f_overflow);
    CM_load_context(the.f_context);
    row->call(&t->args);
    if (test)
        CM_store_test_always(t->test);
    CM_store_overflow_always(t->overflow);
    CM_set_context();
    cases_count++;
    if (batch_count == BATCH)
        batch_finish();
}

/* Functions with long code are tested in single where dest is the source, else in double. */
static bool takes(const struct paris_test_row *row, int width)
{
    bool is_long = row->shape <= PARIS_TEST_FLOAT_BY_INTEGER && strcmp(row->op, "scale") != 0;
    if (!is_long || getenv("PARIS_TEST_FULL"))
        return true;
    int in_place = row->shape == PARIS_TEST_FLOAT_UNARY ? 1 : 2;
    return (row->operands == in_place) == (width == 32);
}

static void rows_run(int width)
{
    static const int part_lengths[] = {12, 8, 33, 54, 128, 64, 25};
    failures = 0;
    operands_make(width);
    for (int r = 0; r < ROW_COUNT; r++) {
        const struct paris_test_row *row = &paris_test_rows[r];
        if (!takes(row, width))
            continue;
        if (is_integer_dest(row))
            for (int k = 0; k < 2; k++)
                trial_run(row, width, part_lengths[(2 * r + k) % 7], 1);
        else
            trial_run(row, width, width,
                      row->source_type == 's' ? width == 32 ? 12 : 100
                      : width == 32           ? 64
                                              : 53);
    }
    batch_finish();
    operands_free();
    printf("%d cases\n", cases_count);
    assert_int_equal(failures, 0);
}

static void singles_are_the_oracles(void **unused)
{
    (void)unused;
    rows_run(32);
}

static void doubles_are_the_oracles(void **unused)
{
    (void)unused;
    rows_run(64);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(singles_are_the_oracles),
        cmocka_unit_test(doubles_are_the_oracles),
    };
    return cmocka_run_group_tests(tests, device_setup, NULL);
}
