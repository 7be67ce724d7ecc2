/* listing.c - one step of water and pigments through wet paper: the C/Paris program that is
 * measured.
 *
 * This is the thesis's dispersion step, instruction for instruction, so it gives the same
 * bits, temporaries and flags included (tests/listings). Each fiber computes its inflow
 * across the face towards the lower neighbour. Its outflow across the other face is the
 * upper neighbour's inflow, which it gets from there.
 */
#include "listing.h"

static void rectangle_enter(const struct listing *l)
{
    CM_store_context(l->caller_context);
    CM_s_ge_constant_1L(l->x, l->x0, l->coordinate_bits);
    CM_logand_context_with_test();
    CM_s_lt_constant_1L(l->x, l->x1, l->coordinate_bits);
    CM_logand_context_with_test();
    CM_s_ge_constant_1L(l->y, l->y0, l->coordinate_bits);
    CM_logand_context_with_test();
    CM_s_lt_constant_1L(l->y, l->y1, l->coordinate_bits);
    CM_logand_context_with_test();
}

/* inward = (what the lower neighbour has more than we) * absorbency */
static void gradient(const struct listing *l, CM_field_id_t substance, unsigned int axis)
{
    const unsigned int s = l->significand, e = l->exponent;

    CM_get_from_news_1L(l->inflow, substance, axis, CM_downward, s + e + 1);
    CM_f_subtract_3_1L(l->inward, l->inflow, substance, s, e);
    CM_f_multiply_2_1L(l->inward, l->absorbency, s, e);
}

/* Multiplies flows along gravity and divides flows against it. */
static void gravitate(const struct listing *l)
{
    const unsigned int s = l->significand, e = l->exponent;

    CM_store_context(l->kept_context);
    CM_f_gt_zero_1L(l->inward, s, e);
    CM_logand_context_with_test();
    CM_f_multiply_constant_2_1L(l->inward, l->gravity, s, e);
    CM_load_context(l->kept_context);

    CM_store_context(l->kept_context);
    CM_f_lt_zero_1L(l->inward, s, e);
    CM_logand_context_with_test();
    CM_f_divide_constant_2_1L(l->inward, l->gravity, s, e);
    CM_load_context(l->kept_context);
}

/* A fiber's outflow is the inflow of the upper neighbour; contents are clamped to 0..1. */
static void flow(const struct listing *l, CM_field_id_t substance, unsigned int axis)
{
    const unsigned int s = l->significand, e = l->exponent;

    CM_get_from_news_1L(l->outward, l->inward, axis, CM_upward, s + e + 1);
    CM_f_add_2_1L(substance, l->inward, s, e);
    CM_f_subtract_2_1L(substance, l->outward, s, e);
    CM_f_min_constant_2_1L(substance, 1.0, s, e);
    CM_f_max_constant_2_1L(substance, 0.0, s, e);
}

static void disperse(const struct listing *l, unsigned int axis)
{
    const unsigned int s = l->significand, e = l->exponent;

    rectangle_enter(l);
    gradient(l, l->water, axis);
    gravitate(l);
    flow(l, l->water, axis);
    for (int i = 0; i < 3; i++) {
        gradient(l, l->pigment[i], axis);
        CM_f_multiply_2_1L(l->inward, l->water, s, e); /* pigment goes where it is wet */
        CM_f_multiply_constant_2_1L(l->inward, l->molecular_weight[i], s, e);
        gravitate(l);
        flow(l, l->pigment[i], axis);
    }
    CM_load_context(l->caller_context);
}

void listing_step(const struct listing *l)
{
    disperse(l, l->axis_x);
    disperse(l, l->axis_y);
}

void listing_allocate(struct listing *l)
{
    unsigned int dimensions[2] = {(unsigned int)l->height, (unsigned int)l->width};
    CM_field_id_t *const floats[] = {&l->water,      &l->absorbency, &l->pigment[0],
                                     &l->pigment[1], &l->pigment[2], &l->inflow,
                                     &l->inward,     &l->outward};

    CM_set_vp_set(CM_allocate_vp_set(CM_create_geometry(dimensions, 2)));
    l->axis_y = 0;
    l->axis_x = 1;
    l->x0 = l->y0 = 2;
    l->x1 = l->width - 2;
    l->y1 = l->height - 2;
    l->significand = 23;
    l->exponent = 8;
    l->coordinate_bits = 16;
    for (unsigned int n = 0; n < sizeof floats / sizeof floats[0]; n++)
        *floats[n] = CM_allocate_heap_field(l->significand + l->exponent + 1);
    l->x = CM_allocate_heap_field(l->coordinate_bits);
    l->y = CM_allocate_heap_field(l->coordinate_bits);
    l->caller_context = CM_allocate_heap_field(1);
    l->kept_context = CM_allocate_heap_field(1);
    CM_my_news_coordinate_1L(l->x, l->axis_x, l->coordinate_bits);
    CM_my_news_coordinate_1L(l->y, l->axis_y, l->coordinate_bits);
}
