/* warm_up.c - some instructions of each common kind, before the program's first.
 *
 * Code that runs for the first time takes a multiple of its time: it comes from memory, through
 * pages that the processor has not looked up, and none of its branches has been met. A warm-up
 * of the code that most programs use takes CM_init a fraction of what the driver takes to open.
 * Its VP set and fields are gone when it ends (machine_empty()). */
#include "paris_state.h"

enum { WORD = 32, SMALL = 16, COUNT = 96, VECTORS = 4 };

struct warm_up {
    CM_geometry_id_t geometry;
    CM_field_id_t vector[VECTORS], real[2], small, address, bit;
};

static bool begin(struct warm_up *w)
{
    unsigned int dimensions[1] = {COUNT};
    *w = (struct warm_up){.geometry = CM_create_geometry(dimensions, 1)};
    CM_vp_set_id_t set = w->geometry ? CM_allocate_vp_set(w->geometry) : 0;
    if (!set)
        return false;
    CM_set_vp_set(set);
    CM_set_context();
    for (int i = 0; i < VECTORS; i++)
        w->vector[i] = CM_allocate_heap_field(WORD);
    for (int i = 0; i < 2; i++)
        w->real[i] = CM_allocate_stack_field(WORD);
    w->small = CM_allocate_stack_field(SMALL);
    w->address = CM_allocate_heap_field(CM_current_send_address_length);
    w->bit = CM_allocate_heap_field(1);
    return w->bit != CM_no_field;
}

static void elementwise(const struct warm_up *w)
{
    const CM_field_id_t *v = w->vector;
    CM_my_news_coordinate_1L(v[0], 0, WORD);
    CM_u_multiply_constant_3_1L(v[1], v[0], 2654435761u, WORD);
    CM_u_add_constant_2_1L(v[1], 12345, WORD);
    CM_u_add_3_1L(v[2], v[0], v[1], WORD);
    CM_u_subtract_3_1L(v[3], v[2], v[0], WORD);
    CM_u_multiply_3_1L(v[2], v[3], v[1], WORD);
    CM_u_min_3_1L(v[3], v[2], v[1], WORD);
    CM_s_max_3_1L(v[2], v[3], v[0], WORD);
    CM_s_add_2_1L(v[3], v[1], WORD);
    CM_logxor_3_1L(v[2], v[3], v[1], WORD);
    CM_logand_2_1L(v[2], v[0], WORD);
    CM_u_add_constant_3_1L(v[3], v[2], 7, WORD);
    CM_u_mod_constant_3_1L(v[3], v[0], 7, WORD);
    CM_u_move_2L(w->small, v[1], SMALL, WORD);
    CM_u_add_constant_2_1L(w->small, 1, SMALL);
}

static void under_a_context(const struct warm_up *w)
{
    const CM_field_id_t *v = w->vector;
    CM_u_eq_constant_1L(v[3], 0, WORD);
    CM_store_test(w->bit);
    CM_u_lt_1L(v[1], v[2], WORD);
    CM_logand_context_with_test();
    CM_u_move_1L(v[3], v[0], WORD);
    CM_u_move_zero_1L(v[2], WORD);
    CM_set_context();
    CM_load_context(w->bit);
    CM_u_add_2_1L(v[2], v[1], WORD);
    CM_set_context();
}

static void reals(const struct warm_up *w)
{
    const CM_field_id_t *r = w->real;
    CM_f_u_float_2_2L(r[0], w->vector[0], WORD, 23, 8);
    CM_f_multiply_constant_2_1L(r[0], 0.25, 23, 8);
    CM_get_from_news_1L(r[1], r[0], 0, CM_upward, WORD);
    CM_f_subtract_2_1L(r[1], r[0], 23, 8);
    CM_f_add_2_1L(r[0], r[1], 23, 8);
    CM_f_multiply_3_1L(r[1], r[0], r[0], 23, 8);
    CM_f_gt_constant_1L(r[1], 0.5, 23, 8);
    CM_global_f_add_1L(r[1], 23, 8);
}

static void between_processors(const struct warm_up *w)
{
    const CM_field_id_t *v = w->vector;
    CM_u_move_constant_1L(v[3], COUNT - 1, WORD);
    CM_u_subtract_2_1L(v[3], v[0], WORD);
    CM_make_news_coordinate_1L(w->geometry, w->address, 0, v[3], WORD);
    CM_send_1L(v[2], w->address, v[1], WORD, CM_no_field);
    CM_send_with_u_add_1L(v[2], w->address, v[0], WORD, CM_no_field);
    CM_get_1L(v[3], w->address, v[2], WORD);
    CM_scan_with_u_add_1L(v[2], v[1], 0, WORD, CM_upward, CM_inclusive, CM_none, CM_no_field);
    CM_scan_with_u_add_1L(v[2], v[1], 0, WORD, CM_upward, CM_inclusive, CM_segment_bit, w->bit);
    CM_u_move_zero_1L(v[2], WORD);
    CM_load_context(v[1]);
    CM_enumerate_1L(v[3], 0, WORD, CM_upward, CM_exclusive, CM_none, CM_no_field);
    CM_make_news_coordinate_1L(w->geometry, w->address, 0, v[3], WORD);
    CM_send_1L(v[2], w->address, v[1], WORD, CM_no_field);
    CM_set_context();
}

static void looks(const struct warm_up *w)
{
    const CM_field_id_t *v = w->vector;
    CM_sendaddr_t one = CM_fe_make_news_coordinate(w->geometry, 0, COUNT / 2);
    CM_u_write_to_processor_1L(one, v[2], 5, WORD);
    CM_u_read_from_processor_1L(one, v[2], WORD);
    CM_global_u_add_1L(v[2], WORD);
    CM_global_u_max_1L(v[1], WORD);
    CM_global_logior_1L(v[3], WORD);
    CM_global_count_context();
}

bool paris_warm_up(void)
{
    static bool done;
    struct warm_up w;
    const char *call = paris_the.call;
    if (done || !machine_warms_up(paris_the.machine))
        return true;
    done = true;
    if (begin(&w)) {
        elementwise(&w);
        under_a_context(&w);
        between_processors(&w);
        reals(&w);
        looks(&w);
    }
    paris_sets_forget();
    if (machine_empty(paris_the.machine) != MACHINE_OK)
        return false;
    paris_sets_reset();
    paris_the.call = call;
    return true;
}
