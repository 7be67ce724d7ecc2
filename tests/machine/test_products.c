/* test_products.c - a product within a sum's loop has the bits of a product and a sum, in each
 * instruction set, with all lanes of its factors or the first ones alone. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tables.h"

enum { LANES = 203 };

static uint32_t chance = 1;

static double number(void)
{
    chance = chance * 1664525u + 1013904223u;
    return (double)(int32_t)chance / 12345.678;
}

static void sums_are_rounded_twice(void **state)
{
    static float f[3][LANES], product[LANES], sum[LANES], joined[LANES];
    static double d[3][LANES], dproduct[LANES], dsum[LANES], djoined[LANES];
    const struct tables t = tables_here();
    (void)state;
    for (int turn = 0; turn < 16 * t.count; turn++) {
        const struct lanes_table *table = t.of[turn / 16];
        const struct lanes_step s = {
            .to = 3, .in = {0, 1, 2}, .detail = turn % 4, .axis = (uint8_t)(turn / 4 % 4)};
        for (int k = 0; k < 3; k++)
            for (int i = 0; i < LANES; i++)
                d[k][i] = f[k][i] = (float)number();
        for (int i = 0; i < LANES; i++) {
            const int a = s.axis & 1 ? 0 : i, b = s.axis & 2 ? 0 : i;
            product[i] = f[0][a] * f[1][b];
            dproduct[i] = d[0][a] * d[1][b];
        }
        for (int i = 0; i < LANES; i++) { /* from memory: no compiler joins these */
            sum[i] = s.detail % 2 ? f[2][i] - product[i] : f[2][i] + product[i];
            dsum[i] = s.detail % 2 ? d[2][i] - dproduct[i] : d[2][i] + dproduct[i];
            sum[i] = s.detail == 3 ? -sum[i] : sum[i];
            dsum[i] = s.detail == 3 ? -dsum[i] : dsum[i];
        }
        void *at[] = {f[0], f[1], f[2], joined}, *dat[] = {d[0], d[1], d[2], djoined};
        table->of[LANES_PRODUCT_SUM][LANES_F32](&s, at, LANES);
        table->of[LANES_PRODUCT_SUM][LANES_F64](&s, dat, LANES);
        assert_memory_equal(joined, sum, sizeof sum);
        assert_memory_equal(djoined, dsum, sizeof dsum);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sums_are_rounded_twice),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
