/* The transcendental operations on the device give the bits of kernels/math.cl as C: in double
 * and single, at any vector width, fused with other operations or alone, for operands of all
 * sizes. All operations of one width are one kernel. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/node_ops.h"
#include "sample.h"
#include "values/math_ops.h"

enum { COLUMNS = 272, ROWS = 16, COUNT = COLUMNS * ROWS };

/* The operations that the table of operations calls functions. */
static enum machine_op functions[MACHINE_OP_COUNT_PUBLIC];
static int functions_count;

static int functions_find(void **none)
{
    (void)none;
    for (int op = 0; op < MACHINE_OP_COUNT_PUBLIC; op++)
        if (machine_op_is_function(op))
            functions[functions_count++] = (enum machine_op)op;
    return functions_count > 0 ? 0 : -1;
}

static uint64_t state = SAMPLE_SHIFTED_BEGIN;

static uint64_t any(void)
{
    return sample_shifted(&state);
}

static uint64_t number(int i, int width)
{
    static const double special[] = {0,   -0.0,     1,         -1,        0.5,   -0.5, 2,
                                     -3,  INFINITY, -INFINITY, NAN,       1e300, 710,  -745.5,
                                     0.1, 0x1p-30,  0x1p-1074, -0x1p-126, 1e22,  3,    1.5};
    enum { SPECIALS = sizeof special / sizeof special[0] };
    double x;
    if (i < SPECIALS * SPECIALS && width == 0)
        x = special[i / SPECIALS];
    else if (i < SPECIALS * SPECIALS)
        x = special[i % SPECIALS];
    else if (i % 3 == 0)
        return any();
    else
        x = ldexp((double)(any() >> 11) * 0x1p-52 - 1,
                  (int)(any() % 24) - (i % 3 == 1 ? 4 : 16));
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static struct machine *start(int eager)
{
    struct machine *m = NULL;
    struct machine_config config = machine_config_default();
    config.eager = eager;
    if (machine_create(&config, &m) != MACHINE_OK) {
        fprintf(stderr, "skipped: %s\n", machine_error(m));
        exit(77);
    }
    int dimensions[2] = {ROWS, COLUMNS};
    machine_vpset_select(m, machine_vpset_create(m, dimensions, 2));
    return m;
}

static uint64_t a[COUNT], b[COUNT], r[COUNT];
static uint32_t small[COUNT];

static void upload(struct machine *m, uint32_t field, struct machine_type type, uint64_t *x)
{
    for (int i = 0; i < COUNT && type.width == 32; i++)
        small[i] = (uint32_t)x[i];
    assert_int_equal(
        machine_field_upload(m, field, type, type.width == 32 ? (void *)small : (void *)x),
        MACHINE_OK);
}

/* Compares every ops_step-th operation: singles use the same functions, with conversions around
 * them. */
static void compare(int width, int eager, int ops_step)
{
    struct machine *m = start(eager);
    struct machine_type type = width == 32 ? MACHINE_F32 : MACHINE_F64;
    int set = machine_vpset_current(m);
    uint32_t fa = machine_field_allocate(m, set, 64, MACHINE_HEAP),
             fb = machine_field_allocate(m, set, 64, MACHINE_HEAP), f[MACHINE_OP_COUNT_PUBLIC];
    for (int i = 0; i < COUNT; i++) {
        a[i] = number(i, 0);
        b[i] = number(i, 1);
        if (width == 32 && i % 3) {
            double x, y;
            memcpy(&x, &a[i], sizeof x);
            memcpy(&y, &b[i], sizeof y);
            float p = (float)x, q = (float)y;
            memcpy(&small[0], &p, sizeof p);
            memcpy(&small[1], &q, sizeof q);
            a[i] = small[0];
            b[i] = small[1];
        }
    }
    for (int i = 0; i < COUNT && width == 32; i++) {
        a[i] &= UINT32_MAX;
        b[i] &= UINT32_MAX;
    }
    upload(m, fa, type, a);
    upload(m, fb, type, b);
    for (int k = 0; k < functions_count; k += ops_step) {
        enum machine_op op = functions[k];
        f[k] = machine_field_allocate(m, set, 64, MACHINE_HEAP);
        machine_begin(m);
        struct machine_value *x = machine_field_value(m, fa, type, MACHINE_EVERYWHERE),
                             *y = machine_field_value(m, fb, type, MACHINE_EVERYWHERE);
        struct machine_value *v =
            node_ops[op].inputs == 1 ? machine_unary(m, op, x) : machine_binary(m, op, x, y);
        assert_non_null(v);
        assert_int_equal(machine_field_store(m, f[k], v, MACHINE_EVERYWHERE), MACHINE_OK);
    }
    int wrong = 0;
    for (int k = 0; k < functions_count; k += ops_step) {
        void *out = width == 32 ? (void *)small : (void *)r;
        if (machine_field_download(m, f[k], type, out) != MACHINE_OK)
            fail_msg("%s", machine_error(m));
        for (int i = 0; i < COUNT; i++) {
            struct machine_scalar x = {a[i], 0}, y = {b[i], 0}, wanted;
            uint64_t got = width == 32 ? small[i] : r[i];
            assert_true(math_fold((int)functions[k], type, x, y, &wanted));
            if (got != wanted.lo && wrong++ < 20)
                fprintf(stderr, "%s of %d bits (%llx, %llx): %llx, on the front end %llx\n",
                        node_ops[functions[k]].name, width, (unsigned long long)a[i],
                        (unsigned long long)b[i], (unsigned long long)got,
                        (unsigned long long)wanted.lo);
        }
    }
    struct machine_stats stats;
    machine_stats_get(m, &stats);
    printf("%d bits%s: %llu kernels\n", width, eager ? ", eager" : "",
           (unsigned long long)stats.kernels_built);
    machine_destroy(m);
    assert_int_equal(wrong, 0);
}

static void doubles_have_the_front_ends_bits(void **unused)
{
    (void)unused;
    compare(64, 0, 1);
}

static void singles_have_the_front_ends_bits(void **unused)
{
    (void)unused;
    compare(32, 0, 3);
}

static void alone_they_have_them_too(void **unused)
{
    (void)unused;
    compare(64, 1, 8);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(doubles_have_the_front_ends_bits),
        cmocka_unit_test(singles_have_the_front_ends_bits),
        cmocka_unit_test(alone_they_have_them_too),
    };
    return cmocka_run_group_tests(tests, functions_find, NULL);
}
