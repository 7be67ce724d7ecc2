/* test_scaled.c - a value multiplied by g where it is above 0 and divided by g where it is
 * below 0 equals the larger or the smaller of product and quotient. scaled_by_sign() in
 * values/simplify.c replaces it so, for the factors for which that holds. The bits are those of
 * the recorded operations, one by one, and of plain C. */
#include <math.h>

#include "machine_explained.h"
#include "support.h"

enum { COLUMNS = 48 };
enum {
    PLAIN = 7,
    SCALED = 5
}; /* operations: x - 0, then compare, multiply, select, compare, divide, select; or the
                                   product, the quotient, one comparison and one select */

static const double factors[] = {1.25,     1,       0.5,      3,   0x1p-1060, 0x1p-140,
                                 0x1p1000, 0x1p120, INFINITY, NAN, -1.25,     0};

static double number(struct machine_type type, int n)
{
    static const double some[] = {0.0, -0.0, NAN,     INFINITY, -INFINITY, 1,     -1,
                                  0.1, -0.1, 1e-3,    -1e-3,    7.3,       -7.3,  1e30,
                                  3,   -3,   0x1p-30, -0x1p-30, 1 / 3.0,   -1e30, -1 / 3.0};
    const int count = (int)(sizeof some / sizeof some[0]);
    const bool single = type.width == 32;
    const double least = single ? 0x1p-149 : 0x1p-1074,
                 most = single ? 0x1.fffffep127 : 0x1.fffffffffffffp1023;
    const double more[] = {least, -least, 3 * least, -3 * least,
                           most,  -most,  most / 2,  -most / 2};
    const double normal = single ? 0x1p-126 : 0x1p-1022;

    return n < count       ? some[n]
           : n < count + 8 ? more[n - count]
           : n % 2         ? normal * (1 + n)
                           : -normal * (n - 20) / 7;
}

static wide bits_of(struct machine_type type, double x)
{
    union {
        float f;
        double d;
        uint32_t u;
        uint64_t l;
    } b = {.l = 0};

    if (type.width == 32)
        b.f = (float)x;
    else
        b.d = x;
    if (isnan(x))
        return type.width == 32 ? 0xffc00000u : UINT64_C(0xfff8000000000000);
    return type.width == 32 ? b.u : b.l;
}

static double expected(struct machine_type type, double x, double factor)
{
    if (type.width == 32) {
        volatile float t = (float)x - 0.0f, g = (float)factor;
        if (t > 0)
            t = t * g;
        if (t < 0)
            t = t / g;
        return t;
    }
    volatile double t = x - 0.0, g = factor;
    if (t > 0)
        t = t * g;
    if (t < 0)
        t = t / g;
    return t;
}

static struct machine_value *constant(struct machine *m, struct machine_type type, double x)
{
    return machine_constant_float(m, type, x);
}

static void store(struct machine *m, uint32_t field, struct machine_value *v)
{
    assert_ok(machine_field_store(m, field, v, MACHINE_WHERE_ACTIVE), m);
    machine_begin(m);
}

/* Where the field compares so with 0: field = field op factor. */
static void scale(struct machine *m, uint32_t field, struct machine_type type,
                  enum machine_op compare, enum machine_op op, double factor)
{
    struct machine_value *v = support_value(m, field, type);
    struct machine_value *where = machine_binary(m, compare, v, constant(m, type, 0));

    store(m, field,
          machine_select(m, where, machine_binary(m, op, v, constant(m, type, factor)), v));
}

static uint64_t operations_run(struct machine *m)
{
    const struct machine_explained *x = machine_explain(m, false);
    uint64_t count = 0;

    assert_non_null(x);
    for (int i = 0; i < x->kernels_count; i++)
        count += x->kernels[i].runs * (uint64_t)x->kernels[i].operations;
    return count;
}

static void check(struct machine *m, struct machine_type type, double factor, bool eager)
{
    const size_t bytes = machine_element_bytes(type);
    const int set = machine_vpset_current(m);
    const uint32_t x = machine_field_allocate(m, set, type.width, MACHINE_HEAP);
    const uint32_t t = machine_field_allocate(m, set, type.width, MACHINE_HEAP);
    char *array = malloc(COLUMNS * bytes);
    const bool holds = factor > 0 && isfinite(type.width == 32 ? (float)factor : factor) &&
                       (type.width == 64 || (float)factor > 0);
    uint64_t before, run;

    assert_non_null(array);
    for (int n = 0; n < COLUMNS; n++)
        support_element_set(array, type, (uint64_t)n, bits_of(type, number(type, n)));
    assert_ok(machine_field_upload(m, x, type, array), m);
    before = operations_run(m);
    store(m, t,
          machine_binary(m, MACHINE_FSUB, support_value(m, x, type), constant(m, type, 0)));
    scale(m, t, type, MACHINE_FGT, MACHINE_FMUL, factor);
    scale(m, t, type, MACHINE_FLT, MACHINE_FDIV, factor);
    assert_ok(machine_field_download(m, t, type, array), m);
    run = operations_run(m) - before;
    if (!eager && run != (holds ? SCALED : PLAIN))
        fail_msg("%d bits, factor %g: %d operations", type.width, factor, (int)run);
    for (int n = 0; n < COLUMNS; n++) {
        const double in = number(type, n);
        const wide is = support_element(array, type, (uint64_t)n),
                   wanted = bits_of(type, expected(type, in, factor));
        if (is != wanted)
            fail_msg("%d bits, %s: %a by %g is %llx, not %llx", type.width,
                     eager ? "eager" : "fused", in, factor, (unsigned long long)is,
                     (unsigned long long)wanted);
    }
    free(array);
    machine_field_deallocate(m, x);
    machine_field_deallocate(m, t);
}

static void check_all(int eager)
{
    struct machine_config config = machine_config_default();
    struct machine *m;

    config.eager = eager;
    config.explain = 1;
    assert_ok(machine_create(&config, &m), m);
    support_set(m, 2, 1, COLUMNS);
    for (size_t i = 0; i < sizeof factors / sizeof factors[0]; i++) {
        check(m, MACHINE_F32, factors[i], eager);
        check(m, MACHINE_F64, factors[i], eager);
    }
    machine_destroy(m);
}

static void scaled_by_sign_fused(void **state)
{
    (void)state;
    check_all(0);
}

static void scaled_by_sign_eager(void **state)
{
    (void)state;
    check_all(1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scaled_by_sign_fused),
        cmocka_unit_test(scaled_by_sign_eager),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
