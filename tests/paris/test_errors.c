/* Wrong calls. In safety mode a message names the call, the argument and the remedy. Without
 * safety mode no call harms the host, and calls that the machine cannot carry out still get a
 * message. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "device.h"

/* Fields: of the current VP set, of another one, on the heap, and a deallocated one. */
static CM_field_id_t f, foreign, heap, dead;
static CM_vp_set_id_t other_set;
static int vector[2] = {0, 0}, beyond[2] = {ROWS + 1, COLUMNS}, dimensions[2] = {ROWS, COLUMNS},
           axes[2] = {0, 1};
static unsigned char array[COUNT];

#define V(v) ((CM_vector_t){.ints = v})

static void add_dead(void)
{
    CM_u_add_2_1L(f, dead, 8);
}
static void add_none(void)
{
    CM_u_add_2_1L(CM_no_field, f, 8);
}
static void add_foreign(void)
{
    CM_s_add_2_1L(f, foreign, 8);
}
static void add_nothing(void)
{
    CM_u_add_2_1L(f, f, 0);
}
static void add_129(void)
{
    CM_u_add_2_1L(f, f, 129);
}
static void add_beyond(void)
{
    CM_u_add_2_1L(f, f, 100);
}
static void add_overlap(void)
{
    CM_u_add_2_1L(f, f + 4, 8);
}
static void add_big_constant(void)
{
    CM_u_add_constant_2_1L(f, 256, 8);
}
static void signed_one_bit(void)
{
    CM_s_negate_1_1L(f, 1);
}
static void allocate_no_bits(void)
{
    CM_allocate_heap_field(0);
}
static void float_odd(void)
{
    CM_f_add_2_1L(f, f, 53, 8);
}
static void float_beyond(void)
{
    CM_f_add_2_1L(f, f, 52, 11);
}
static void compare_dead(void)
{
    CM_f_gt_zero_1L(dead, 23, 8);
}
static void move_dead(void)
{
    CM_u_move_1L(dead, f, 8);
}
static void logical_beyond(void)
{
    CM_logand_2_1L(f, f, 1000);
}
static void load_dead(void)
{
    CM_load_context(dead);
}
static void store_foreign(void)
{
    CM_store_test(foreign);
}
static void news_axis(void)
{
    CM_get_from_news_1L(f, f, 2, 0, 8);
}
static void news_axis_minus(void)
{
    CM_get_from_news_1L(f, f, (unsigned)-1, 0, 8);
}
static void news_direction(void)
{
    CM_send_to_news_1L(f, f, 1, 2, 8);
}
static void coordinate_axis(void)
{
    CM_my_news_coordinate_1L(f, 9, 8);
}
static void read_address(void)
{
    CM_u_read_from_processor_1L(80, f, 8);
}
static void write_address(void)
{
    CM_u_write_to_processor_1L((unsigned)-1, f, 1, 8);
}
static void write_dead(void)
{
    CM_f_write_to_processor_1L(0, dead, 1, 23, 8);
}
static void array_end(void)
{
    CM_u_write_to_news_array_1L(array, V(vector), V(vector), V(beyond), V(axes), f, 8, 2,
                                V(dimensions), CM_8_bit);
}
static void array_axis(void)
{
    CM_u_read_from_news_array_1L(array, V(vector), V(vector), V(dimensions), V(vector), f, 8, 2,
                                 V(dimensions), 1);
}
static void array_format(void)
{
    CM_u_write_to_news_array_1L(array, V(vector), V(vector), V(dimensions), V(axes), f, 8, 2,
                                V(dimensions), 9);
}
static void array_float_format(void)
{
    CM_f_write_to_news_array_1L(array, V(vector), V(vector), V(dimensions), V(axes), f, 23, 8,
                                2, V(dimensions), CM_8_bit);
}
static void array_null(void)
{
    CM_u_write_to_news_array_1L(NULL, V(vector), V(vector), V(dimensions), V(axes), f, 8, 2,
                                V(dimensions), 1);
}
static void array_no_vector(void)
{
    CM_u_write_to_news_array_1L(array, V(NULL), V(vector), V(dimensions), V(axes), f, 8, 2,
                                V(dimensions), 1);
}
static void array_rank(void)
{
    CM_u_write_to_news_array_1L(array, V(vector), V(vector), V(dimensions), V(axes), f, 8, 3,
                                V(dimensions), 1);
}
static void allocate_too_much(void)
{
    CM_allocate_heap_field(0xffffffffu);
}
static void allocate_nowhere(void)
{
    CM_allocate_heap_field_vp_set(8, 77);
}
static void deallocate_twice(void)
{
    CM_deallocate_heap_field(dead);
}
static void deallocate_stack_as_heap(void)
{
    CM_deallocate_heap_field(f);
}
static void deallocate_heap_as_stack(void)
{
    CM_deallocate_stack_through(heap);
}
static void deallocate_none(void)
{
    CM_deallocate_stack_through(CM_no_field);
}
static void geometry_rank(void)
{
    CM_create_geometry(V(dimensions), 0);
}
static void geometry_rank_32(void)
{
    CM_create_geometry(V(dimensions), 32);
}
static void geometry_length(void)
{
    CM_create_geometry(V(vector), 2);
}
static void geometry_null(void)
{
    CM_create_geometry(V(NULL), 2);
}
static void geometry_none(void)
{
    CM_geometry_axis_length(99, 0);
}
static void geometry_axis(void)
{
    CM_geometry_axis_length(CM_current_geometry, 2);
}
static void geometry_used(void)
{
    CM_deallocate_geometry(CM_current_geometry);
}
static void set_none(void)
{
    CM_set_vp_set(0);
}
static void set_far(void)
{
    CM_set_vp_set(1000000);
}
static void vp_set_none(void)
{
    CM_allocate_vp_set(-3);
}
static void coordinate_far(void)
{
    CM_fe_make_news_coordinate(CM_current_geometry, 0, ROWS);
}
static void extract_far(void)
{
    CM_fe_extract_news_coordinate(CM_current_geometry, 0, 1u << 30);
}
static void random_limit(void)
{
    CM_u_random_1L(f, 8, 1000);
}
static void timer_far(void)
{
    CM_timer_start(64);
}
static void global_dead(void)
{
    CM_global_u_add_1L(dead, 8);
}
static void leds_dead(void)
{
    CM_latch_leds(dead);
}
static void attach_odd(void)
{
    CM_attach_to_processors(100);
}

static const struct {
    const char *call; /* as the message begins */
    const char *word; /* the argument that the message names */
    void (*make)(void);
    bool only_in_safety_mode;
} wrong[] = {
    {"CM_u_add_2_1L", "source", add_dead, false},
    {"CM_u_add_2_1L", "dest", add_none, false},
    {"CM_s_add_2_1L", "VP set", add_foreign, false},
    {"CM_u_add_2_1L", "length", add_nothing, false},
    {"CM_u_add_2_1L", "length", add_129, false},
    {"CM_u_add_2_1L", "bits", add_beyond, false},
    {"CM_u_add_2_1L", "overlap", add_overlap, true},
    {"CM_u_add_constant_2_1L", "value", add_big_constant, true},
    {"CM_s_negate_1_1L", "length", signed_one_bit, false},
    {"CM_f_add_2_1L", "significand", float_odd, false},
    {"CM_f_add_2_1L", "bits", float_beyond, false},
    {"CM_f_gt_zero_1L", "source", compare_dead, false},
    {"CM_u_move_1L", "dest", move_dead, false},
    {"CM_logand_2_1L", "bits", logical_beyond, false},
    {"CM_load_context", "source", load_dead, false},
    {"CM_store_test", "VP set", store_foreign, false},
    {"CM_get_from_news_1L", "axis", news_axis, false},
    {"CM_get_from_news_1L", "axis", news_axis_minus, false},
    {"CM_send_to_news_1L", "direction", news_direction, false},
    {"CM_my_news_coordinate_1L", "axis", coordinate_axis, false},
    {"CM_u_read_from_processor_1L", "send_address", read_address, false},
    {"CM_u_write_to_processor_1L", "send_address", write_address, false},
    {"CM_f_write_to_processor_1L", "dest", write_dead, false},
    {"CM_u_write_to_news_array_1L", "end_vector", array_end, false},
    {"CM_u_read_from_news_array_1L", "axis_vector", array_axis, false},
    {"CM_u_write_to_news_array_1L", "format", array_format, false},
    {"CM_f_write_to_news_array_1L", "format", array_float_format, false},
    {"CM_u_write_to_news_array_1L", "array", array_null, false},
    {"CM_u_write_to_news_array_1L", "vector", array_no_vector, false},
    {"CM_u_write_to_news_array_1L", "rank", array_rank, false},
    {"CM_allocate_heap_field", "", allocate_too_much, false},
    {"CM_allocate_heap_field", "1 bit", allocate_no_bits, false},
    {"CM_allocate_heap_field_vp_set", "vp_set", allocate_nowhere, false},
    {"CM_deallocate_heap_field", "", deallocate_twice, false},
    {"CM_deallocate_heap_field", "", deallocate_stack_as_heap, false},
    {"CM_deallocate_stack_through", "", deallocate_heap_as_stack, false},
    {"CM_deallocate_stack_through", "", deallocate_none, false},
    {"CM_create_geometry", "rank", geometry_rank, false},
    {"CM_create_geometry", "rank", geometry_rank_32, false},
    {"CM_create_geometry", "dimensions", geometry_length, false},
    {"CM_create_geometry", "dimensions", geometry_null, false},
    {"CM_geometry_axis_length", "geometry", geometry_none, false},
    {"CM_geometry_axis_length", "axis", geometry_axis, false},
    {"CM_deallocate_geometry", "geometry", geometry_used, false},
    {"CM_set_vp_set", "vp_set", set_none, false},
    {"CM_set_vp_set", "vp_set", set_far, false},
    {"CM_allocate_vp_set", "geometry", vp_set_none, false},
    {"CM_fe_make_news_coordinate", "coordinate", coordinate_far, false},
    {"CM_fe_extract_news_coordinate", "send_address", extract_far, false},
    {"CM_u_random_1L", "limit", random_limit, true},
    {"CM_timer_start", "timer", timer_far, false},
    {"CM_global_u_add_1L", "source", global_dead, false},
    {"CM_latch_leds", "source", leds_dead, false},
    {"CM_attach_to_processors", "count", attach_odd, false},
};

static void wrong_calls_explain_themselves(void **unused)
{
    (void)unused;
    CM_set_safety_mode(1);
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        device_message[0] = '\0';
        wrong[i].make();
        device_said(wrong[i].call, wrong[i].word);
    }
}

static void wrong_calls_are_without_effect(void **unused)
{
    (void)unused;
    number before[COUNT], after[COUNT];
    device_integers(before, 32);
    device_put(f, 32, before);
    paris_safety_usual();
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        device_message[0] = '\0';
        if (wrong[i].only_in_safety_mode)
            continue;
        wrong[i].make();
        if (!device_message[0])
            fail_msg("wrong call %zu of %s says nothing", i, wrong[i].call);
    }
    device_get(f, 32, after);
    assert_memory_equal(before, after, sizeof before);
    assert_int_equal(CM_global_count_context(), COUNT);
}

/* Correct calls get no message in safety mode. */
static void right_calls_are_let_through(void **unused)
{
    (void)unused;
    CM_set_safety_mode(1);
    device_message[0] = '\0';
    CM_s_add_constant_2_1L(f, -128, 8);
    CM_u_add_3_1L(f, f, CM_add_offset_to_field_id(f, 8), 8);
    CM_lognot_1_1L(f, 0);
    CM_u_move_constant_1L(f, 255, 8);
    CM_add_offset_to_field_id(f, 32); /* one step too many, and not used */
    assert_string_equal(device_message, "");
    paris_safety_usual();
}

static int start(void **unused)
{
    (void)unused;
    device_start(-1);
    CM_set_error_handler(device_error_catch);
    CM_vp_set_id_t here = CM_current_vp_set;
    int line = 7;
    other_set = CM_allocate_vp_set(CM_create_geometry(V(&line), 1));
    f = CM_allocate_heap_field(32);
    f = CM_allocate_stack_field(32);
    CM_set_vp_set(other_set);
    foreign = CM_allocate_stack_field(32);
    CM_my_news_coordinate_1L(foreign, 0, 32);
    CM_set_vp_set(here);
    dead = CM_allocate_heap_field(32);
    CM_deallocate_heap_field(dead);
    heap = CM_allocate_heap_field(32);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wrong_calls_explain_themselves),
        cmocka_unit_test(wrong_calls_are_without_effect),
        cmocka_unit_test(right_calls_are_let_through),
    };
    return cmocka_run_group_tests(tests, start, NULL);
}
