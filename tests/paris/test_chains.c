/* Long chains of choices between values, each used twice, give kernels that compile in a time
 * that grows with their length. (clang looks through the initial values of constant variables,
 * and through both arms of a choice.) */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "paris_internal.h"
#include <cm/paris.h>

enum { CHAIN = 40, SIDE = 64 };

static CM_geometry_id_t geometry;

static void begin_as(const char *vector)
{
    static unsigned int sides[2] = {SIDE, SIDE};
    struct machine_config config = machine_config_default();
    setenv("LUTETIA_INTERPRET", "0", 1);
    setenv("LUTETIA_VECTOR", vector, 1);
    config.processors_count = 16;
    assert_true(paris_reset(&config));
    geometry = CM_create_geometry(sides, 2);
    CM_set_vp_set(CM_allocate_vp_set(geometry));
    CM_set_context();
}

static CM_sendaddr_t place(int row, int column)
{
    CM_sendaddr_t at = CM_fe_deposit_news_coordinate(geometry, 0, 0, (unsigned int)row);
    return CM_fe_deposit_news_coordinate(geometry, at, 1, (unsigned int)column);
}

/* Two numbers, of which each in turn becomes the greater, or the lesser, of both: one more
 * choice a call. */
static void floats_choose(const char *vector)
{
    CM_field_id_t coordinate, a, b;
    begin_as(vector);
    coordinate = CM_allocate_heap_field(32);
    a = CM_allocate_heap_field(32);
    b = CM_allocate_heap_field(32);
    CM_my_news_coordinate_1L(coordinate, 0, 32);
    CM_f_u_float_2_2L(a, coordinate, 32, 23, 8);
    CM_my_news_coordinate_1L(coordinate, 1, 32);
    CM_f_u_float_2_2L(b, coordinate, 32, 23, 8);
    for (int i = 0; i < CHAIN; i++) {
        CM_f_max_2_1L(a, b, 23, 8);
        CM_f_min_2_1L(b, a, 23, 8);
    }
    for (int row = 0; row < SIDE; row += 7)
        for (int column = 0; column < SIDE; column += 3) {
            const CM_sendaddr_t at = place(row, column);
            assert_float_equal((float)CM_f_read_from_processor_1L(at, a, 23, 8),
                               (float)(row > column ? row : column), 0);
            assert_float_equal((float)CM_f_read_from_processor_1L(at, b, 23, 8), (float)column,
                               0);
        }
}

static void integers_choose(const char *vector)
{
    CM_field_id_t a, b;
    begin_as(vector);
    a = CM_allocate_heap_field(32);
    b = CM_allocate_heap_field(32);
    CM_my_news_coordinate_1L(a, 0, 32);
    CM_my_news_coordinate_1L(b, 1, 32);
    for (int i = 0; i < CHAIN; i++) {
        CM_s_max_2_1L(a, b, 32);
        CM_s_min_2_1L(b, a, 32);
    }
    for (int row = 0; row < SIDE; row += 7)
        for (int column = 0; column < SIDE; column += 3) {
            assert_int_equal(CM_s_read_from_processor_1L(place(row, column), a, 32),
                             row > column ? row : column);
            assert_int_equal(CM_s_read_from_processor_1L(place(row, column), b, 32), column);
        }
}

static void one_at_a_time(void **context)
{
    (void)context;
    floats_choose("1");
    integers_choose("1");
}

static void by_vectors(void **context)
{
    (void)context;
    floats_choose("4");
    floats_choose("16");
    integers_choose("16");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(one_at_a_time),
                                       cmocka_unit_test(by_vectors)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
