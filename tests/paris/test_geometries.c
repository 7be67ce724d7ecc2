/* test_geometries.c - inquiries of geometries, addresses in both orders, and flags of VP
 * sets. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "device.h"

static void geometry_inquiries_answer(void **unused)
{
    (void)unused;
    unsigned int dimensions[4] = {2, 3, 4, 5};
    CM_geometry_id_t g = CM_create_geometry((CM_vector_t){.unsigneds = dimensions}, 4);
    assert_int_equal(CM_geometry_rank(g), 4);
    assert_int_equal(CM_geometry_total_processors(g), 120);
    assert_int_equal(CM_geometry_total_vp_ratio(g), 8); /* of 16 processors */
    for (unsigned int axis = 0; axis < 4; axis++)
        assert_int_equal(CM_geometry_axis_length(g, axis), dimensions[axis]);
    assert_int_equal(CM_geometry_coordinate_length(g, 3), 3);
    assert_int_equal(CM_geometry_send_address_length(g), 7);
    assert_int_equal(CM_intern_geometry((CM_vector_t){.unsigneds = dimensions}, 4), g);
    CM_deallocate_geometry(g);
}

static void addresses_name_processors(void **unused)
{
    (void)unused;
    CM_geometry_id_t g = CM_vp_set_geometry(CM_current_vp_set);
    unsigned int bits = CM_geometry_send_address_length(g);
    CM_field_id_t address = CM_allocate_stack_field(bits), row = CM_allocate_stack_field(8),
                  column = CM_allocate_stack_field(8);
    CM_my_send_address(address);
    CM_my_news_coordinate_1L(row, 0, 8);
    CM_my_news_coordinate_1L(column, 1, 8);
    bool seen[16 * 5] = {false};
    for (unsigned int y = 0; y < ROWS; y++)
        for (unsigned int x = 0; x < COLUMNS; x++) {
            unsigned int a =
                CM_fe_deposit_news_coordinate(g, CM_fe_make_news_coordinate(g, 0, y), 1, x);
            assert_true(a < 80 && !seen[a]);
            seen[a] = true;
            assert_int_equal(CM_u_read_from_processor_1L(a, address, bits), a);
            assert_int_equal(CM_u_read_from_processor_1L(a, row, 8), y);
            assert_int_equal(CM_u_read_from_processor_1L(a, column, 8), x);
            assert_int_equal(CM_fe_extract_news_coordinate(g, 0, a), y);
            assert_int_equal(CM_fe_extract_news_coordinate(g, 1, a), x);
        }
    for (unsigned int i = 0; i < 100; i++)
        assert_int_equal(CM_fe_from_gray_code(CM_fe_to_gray_code(i * 7919)), i * 7919);
    CM_deallocate_stack_through(address);
}

static void send_order_is_the_address(void **unused)
{
    (void)unused;
    CM_vp_set_id_t before = CM_current_vp_set;
    struct CM_axis_descriptor axis = {.length = 64, .weight = 1, .ordering = CM_send_order};
    CM_axis_descriptor_t axes[1] = {&axis};
    CM_geometry_id_t g = CM_create_detailed_geometry(axes, 1);
    CM_vp_set_id_t set = CM_allocate_vp_set(g);
    CM_set_vp_set(set);
    assert_int_equal(CM_geometry_axis_ordering(g, 0), CM_send_order);
    CM_field_id_t a = CM_allocate_heap_field(32), c = CM_allocate_heap_field(32);
    CM_my_send_address(a);
    CM_my_news_coordinate_1L(c, 0, 32);
    CM_u_ne_1L(a, c, 32);
    assert_int_equal(CM_global_count_test(), 0);
    CM_u_write_to_processor_1L(37, c, 1000, 32);
    CM_u_eq_constant_1L(a, 37, 32);
    CM_logand_context_with_test();
    assert_int_equal(CM_global_u_max_1L(c, 32), 1000);
    CM_set_context();
    CM_set_vp_set(before);
    CM_deallocate_vp_set(set);
    CM_deallocate_geometry(g);
    assert_false(CM_is_vp_set_valid(set));
}

static void flags_belong_to_their_vp_set(void **unused)
{
    (void)unused;
    CM_vp_set_id_t first = CM_current_vp_set;
    int dimension = 10;
    CM_vp_set_id_t second =
        CM_allocate_vp_set(CM_create_geometry((CM_vector_t){.ints = &dimension}, 1));
    CM_clear_context();
    CM_set_vp_set(second);
    assert_int_equal(CM_global_count_context(), 10);
    CM_set_vp_set(first);
    assert_int_equal(CM_global_count_context(), 0);
    assert_int_equal(CM_global_logior_context(), 0);
    CM_invert_context();
    assert_int_equal(CM_global_count_context(), COUNT);
    assert_int_equal(CM_global_logand_context(), 1);
    CM_deallocate_vp_set(second);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(geometry_inquiries_answer),
        cmocka_unit_test(addresses_name_processors),
        cmocka_unit_test(send_order_is_the_address),
        cmocka_unit_test(flags_belong_to_their_vp_set),
    };
    return cmocka_run_group_tests(tests, device_setup, NULL);
}
