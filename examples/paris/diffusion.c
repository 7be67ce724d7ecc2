/* diffusion.c - ink that spreads in wet paper, on a display of 24 bits.
 *
 *     lutetia cc diffusion.c -o diffusion && lutetia display ./diffusion [steps [height width]]
 *
 * The order is that of a program of 1990: the display, the VP set, the fields, the paper's
 * colour, ink and water; then, again and again, water flows, ink flows where it is wet, an
 * image is made and sent to the frame buffer, and some water dries.
 *
 * Shows: CMFB_write_rgb_news_always, which takes three channels and hides the shuffle.  What
 * flows out of a fiber flows into its neighbour, so no ink is lost: the program adds it up. */
#include <stdio.h>
#include <stdlib.h>
#include <math.h>
#include <cm/cmfb.h>

#define SINGLE 23, 8
#define BITS 32

static int sizes[2];
static CM_field_id_t water, ink[3], paper[3], image[3], flow, other, wet;

/* A flow of `what` from each fiber to the next one along an axis, where both are wet. */
void disperse (what, axis, rate)
    CM_field_id_t what;
    int axis;
    double rate;
{
    CM_get_from_news_1L (flow, what, axis, CM_upward, BITS);
    CM_f_subtract_3_1L (flow, what, flow, SINGLE);
    CM_f_multiply_constant_2_1L (flow, rate, SINGLE);
    CM_get_from_news_1L (wet, water, axis, CM_upward, BITS);
    CM_f_min_2_1L (wet, water, SINGLE);
    CM_f_multiply_2_1L (flow, wet, SINGLE);
    CM_get_from_news_1L (other, flow, axis, CM_downward, BITS);
    CM_f_subtract_2_1L (what, flow, SINGLE);
    CM_f_add_2_1L (what, other, SINGLE);
}

/* value = amount in the rectangle */
void put (field, amount, top, left, bottom, right)
    CM_field_id_t field;
    double amount;
    int top, left, bottom, right;
{
    CM_field_id_t place = CM_allocate_stack_field (16);

    CM_set_context ();
    CM_my_news_coordinate_1L (place, 0, 16);
    CM_u_ge_constant_1L (place, top, 16);
    CM_logand_context_with_test ();
    CM_u_lt_constant_1L (place, bottom, 16);
    CM_logand_context_with_test ();
    CM_my_news_coordinate_1L (place, 1, 16);
    CM_u_ge_constant_1L (place, left, 16);
    CM_logand_context_with_test ();
    CM_u_lt_constant_1L (place, right, 16);
    CM_logand_context_with_test ();
    CM_f_move_constant_1L (field, amount, SINGLE);
    CM_set_context ();
    CM_deallocate_stack_through (place);
}

/* The paper's colour less what the ink takes away, as 8 bits. */
void make_image ()
{
    int i;

    for (i = 0; i < 3; i++) {
        CM_f_subtract_3_1L (flow, paper[i], ink[i], SINGLE);
        CM_f_max_constant_2_1L (flow, 0.0, SINGLE);
        CM_f_multiply_constant_2_1L (flow, 255.0, SINGLE);
        CM_u_f_round_2_2L (image[i], flow, 8, SINGLE);
    }
}

double ink_of_all ()
{
    return CM_global_f_add_1L (ink[0], SINGLE) + CM_global_f_add_1L (ink[1], SINGLE)
        + CM_global_f_add_1L (ink[2], SINGLE);
}

int main (argc, argv)
    int argc;
    char **argv;
{
    int steps, height, width, i, k, right;
    double before, after;
    CMFB_display_id_t display;
    CM_field_id_t grain;

    steps = argc > 1 ? atoi (argv[1]) : 240;
    height = argc > 3 ? atoi (argv[2]) : 256;
    width = argc > 3 ? atoi (argv[3]) : 384;
    if (steps < 0 || height < 16 || width < 16) {
        fprintf (stderr, "usage: diffusion [steps [height width]], at least 16 by 16 fibers\n");
        return 2;
    }
    CM_init ();
    display = CMFB_attach_display ("");
    CMFB_initialize_display (display, 24, width, height);
    sizes[0] = height;
    sizes[1] = width;
    CM_set_vp_set (CM_allocate_vp_set (CM_create_geometry (sizes, 2)));
    CM_set_context ();
    water = CM_allocate_stack_field (BITS);
    flow = CM_allocate_stack_field (BITS);
    other = CM_allocate_stack_field (BITS);
    wet = CM_allocate_stack_field (BITS);
    grain = CM_allocate_stack_field (8);
    for (i = 0; i < 3; i++) {
        ink[i] = CM_allocate_stack_field (BITS);
        paper[i] = CM_allocate_stack_field (BITS);
        image[i] = CM_allocate_stack_field (8);
        CM_f_move_zero_1L (ink[i], SINGLE);
        CM_u_random_1L (grain, 8, 200);         /* the paper is speckled */
        CM_f_u_float_2_2L (paper[i], grain, 8, SINGLE);
        CM_f_multiply_constant_2_1L (paper[i], 0.0003, SINGLE);
        CM_f_add_constant_2_1L (paper[i], 0.9 - 0.03 * i, SINGLE);
    }
    CM_u_random_1L (grain, 8, 200);             /* and takes up water unevenly */
    CM_f_u_float_2_2L (water, grain, 8, SINGLE);
    CM_f_multiply_constant_2_1L (water, 0.0015, SINGLE);
    CM_f_add_constant_2_1L (water, 0.7, SINGLE);
    for (i = 0; i < 3; i++)                     /* three bars: each takes another colour away */
        put (ink[i], 0.8, height / 5, width * (2 + 3 * i) / 12, height * 4 / 5,
             width * (4 + 3 * i) / 12);
    put (ink[0], 0.7, height * 2 / 5, width / 8, height / 2, width * 7 / 8);
    before = ink_of_all ();

    for (i = 0; i < steps; i++) {
        disperse (water, 0, 0.2);
        disperse (water, 1, 0.2);
        for (k = 0; k < 3; k++) {
            disperse (ink[k], 0, 0.24);
            disperse (ink[k], 1, 0.24);
        }
        make_image ();
        CMFB_write_rgb_news_always (display, 0, image[0], image[1], image[2], 0, 0);
        CM_f_multiply_constant_2_1L (water, 0.997, SINGLE);
    }
    after = ink_of_all ();
    right = fabs (after - before) <= 1e-4 * before;
    printf ("no ink is lost: %s (%g of %g)\n", right ? "yes" : "no", after - before, before);
    return !right;
}
