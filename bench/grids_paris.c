/* grids_paris.c - Life and heat written in plain C/Paris; see grids.h. */
#include "grids.h"

#include <cm/paris.h>

enum { SUM = 4, COORDINATE = 16, SIGNIFICAND = 23, EXPONENT = 8, FLOAT = 32 };

static void grid_select(int width, int height)
{
    unsigned int dimensions[2] = {(unsigned int)height, (unsigned int)width};
    CM_set_vp_set(CM_allocate_vp_set(CM_create_geometry(dimensions, 2)));
    CM_set_context();
}

/* ---- Life ---- */

void life_paris_allocate(struct life_paris *l, int width, int height)
{
    grid_select(width, height);
    l->alive = CM_allocate_heap_field(1);
    l->sum = CM_allocate_heap_field(SUM);
    l->side = CM_allocate_heap_field(SUM);
}

/* With the cell itself counted, a sum of three of nine is life, and four changes nothing. */
void life_paris_step(const struct life_paris *l)
{
    CM_u_move_2L(l->sum, l->alive, SUM, 1);
    for (unsigned int axis = 0; axis < 2; axis++) {
        CM_u_move_1L(l->side, l->sum, SUM);
        CM_get_from_news_1L(l->sum, l->sum, axis, CM_upward, SUM);
        CM_u_add_2_1L(l->sum, l->side, SUM);
        CM_get_from_news_1L(l->side, l->side, axis, CM_downward, SUM);
        CM_u_add_2_1L(l->sum, l->side, SUM);
    }
    CM_u_eq_constant_1L(l->sum, 3, SUM);
    CM_logand_context_with_test();
    CM_set_bit(l->alive);
    CM_invert_context();
    CM_u_ne_constant_1L(l->sum, 4, SUM);
    CM_logand_context_with_test();
    CM_clear_bit(l->alive);
    CM_set_context();
}

/* ---- heat ---- */

void heat_paris_allocate(struct heat_paris *h, int width, int height)
{
    const int last[2] = {height - 1, width - 1};
    grid_field *const floats[] = {&h->heat, &h->up, &h->down, &h->side, &h->corners};
    grid_select(width, height);
    for (unsigned int i = 0; i < sizeof floats / sizeof *floats; i++)
        *floats[i] = CM_allocate_heap_field(FLOAT);
    h->inside = CM_allocate_heap_field(1);
    CM_field_id_t coordinate = CM_allocate_stack_field(COORDINATE);
    for (unsigned int axis = 0; axis < 2; axis++) {
        CM_my_news_coordinate_1L(coordinate, axis, COORDINATE);
        CM_u_gt_constant_1L(coordinate, 0, COORDINATE);
        CM_logand_context_with_test();
        CM_u_lt_constant_1L(coordinate, (unsigned long)last[axis], COORDINATE);
        CM_logand_context_with_test();
    }
    CM_store_context(h->inside);
    CM_set_context();
    CM_deallocate_stack_through(coordinate);
}

/* The rim is computed, too, and then keeps its old values. */
void heat_paris_step(const struct heat_paris *h)
{
    CM_get_from_news_1L(h->up, h->heat, 0, CM_upward, FLOAT);
    CM_get_from_news_1L(h->down, h->heat, 0, CM_downward, FLOAT);
    CM_get_from_news_1L(h->corners, h->up, 1, CM_upward, FLOAT);
    CM_get_from_news_1L(h->side, h->up, 1, CM_downward, FLOAT);
    CM_f_add_2_1L(h->corners, h->side, SIGNIFICAND, EXPONENT);
    CM_get_from_news_1L(h->side, h->down, 1, CM_upward, FLOAT);
    CM_f_add_2_1L(h->corners, h->side, SIGNIFICAND, EXPONENT);
    CM_get_from_news_1L(h->side, h->down, 1, CM_downward, FLOAT);
    CM_f_add_2_1L(h->corners, h->side, SIGNIFICAND, EXPONENT);

    CM_f_add_2_1L(h->up, h->down, SIGNIFICAND, EXPONENT);
    CM_get_from_news_1L(h->side, h->heat, 1, CM_upward, FLOAT);
    CM_f_add_2_1L(h->up, h->side, SIGNIFICAND, EXPONENT);
    CM_get_from_news_1L(h->side, h->heat, 1, CM_downward, FLOAT);
    CM_f_add_2_1L(h->up, h->side, SIGNIFICAND, EXPONENT);
    CM_f_multiply_constant_2_1L(h->up, 4.0, SIGNIFICAND, EXPONENT);
    CM_f_add_2_1L(h->up, h->corners, SIGNIFICAND, EXPONENT);
    CM_f_multiply_constant_3_1L(h->side, h->heat, 20.0, SIGNIFICAND, EXPONENT);
    CM_f_subtract_2_1L(h->up, h->side, SIGNIFICAND, EXPONENT);
    CM_f_multiply_constant_2_1L(h->up, HEAT_RATE, SIGNIFICAND, EXPONENT);

    CM_load_context(h->inside);
    CM_f_add_2_1L(h->heat, h->up, SIGNIFICAND, EXPONENT);
    CM_set_context();
}
