/* waves.c - drops that fall on water between walls, as a film.
 *
 *     lutetia cc waves.c -o waves && lutetia display --film waves.mp4 ./waves [steps [height width]]
 *
 * Each point goes by its neighbours' heights; the light comes from the left.  A picture is
 * drawn into the buffer that is not seen, and shown by a spin, so the film never has half a
 * picture.
 *
 * Shows: two buffers, 24 bits in one field.  The drops lie evenly about the middle column, and
 * so must the waves. */
#include <stdio.h>
#include <stdlib.h>
#include <cm/cmfb.h>

#define SINGLE 23, 8

static int sizes[2], zero[2], axes[2] = { 0, 1 };
static CM_field_id_t now, last, sum, side, image, inside;

void step ()
{
    CM_get_from_news_1L (sum, now, 0, CM_upward, 32);
    CM_get_from_news_1L (side, now, 0, CM_downward, 32);
    CM_f_add_2_1L (sum, side, SINGLE);
    CM_get_from_news_1L (side, now, 1, CM_upward, 32);
    CM_f_move_1L (image + 32, side, SINGLE);
    CM_get_from_news_1L (side, now, 1, CM_downward, 32);
    CM_f_add_2_1L (side, image + 32, SINGLE);   /* left and right in one sum: even to the bit */
    CM_f_add_2_1L (sum, side, SINGLE);
    CM_f_multiply_constant_2_1L (sum, 0.5, SINGLE);
    CM_f_subtract_2_1L (sum, last, SINGLE);
    CM_f_multiply_constant_2_1L (sum, 0.998, SINGLE);
    CM_f_move_1L (last, now, SINGLE);
    CM_load_context (inside);                   /* the walls do not move */
    CM_f_move_1L (now, sum, SINGLE);
    CM_set_context ();
}

/* part = base + gain * slope, as 8 bits */
void shade (part, slope, base, gain)
    CM_field_id_t part, slope;
    double base, gain;
{
    CM_f_multiply_constant_3_1L (sum, slope, gain, SINGLE);
    CM_f_add_constant_2_1L (sum, base, SINGLE);
    CM_f_max_constant_2_1L (sum, 0.0, SINGLE);
    CM_f_min_constant_2_1L (sum, 255.0, SINGLE);
    CM_u_f_round_2_2L (part, sum, 8, SINGLE);
}

void draw (display)
    CMFB_display_id_t display;
{
    CM_get_from_news_1L (side, now, 1, CM_upward, 32);
    CM_f_subtract_2_1L (side, now, SINGLE);
    shade (image, side, 40.0, 1400.0);
    shade (image + 8, side, 90.0, 1600.0);
    shade (image + 16, side, 140.0, 1800.0);
    CMFB_write_news_always (display, !CMFB_buffer_seen (display), image, 0, 0);
    CMFB_spin (display);
}

/* Front end: a bell of that radius. */
void drop (heights, row, column, radius, width)
    float *heights;
    int row, column, radius, width;
{
    int i, k;
    double low;

    for (i = -radius; i <= radius; i++)
        for (k = -radius; k <= radius; k++) {
            low = 1.0 - (double) (i * i + k * k) / (radius * radius);
            if (low > 0.0)
                heights[(row + i) * width + column + k] = 0.9 * low * low;
        }
}

int main (argc, argv)
    int argc;
    char **argv;
{
    int steps, height, width, i, k, right;
    float *heights;
    CMFB_display_id_t display;
    CM_field_id_t place;

    steps = argc > 1 ? atoi (argv[1]) : 300;
    height = argc > 3 ? atoi (argv[2]) : 240;
    width = argc > 3 ? atoi (argv[3]) : 321;
    if (steps < 0 || height < 32 || width < 33) {
        fprintf (stderr, "usage: waves [steps [height width]], at least 32 by 33 points\n");
        return 2;
    }
    width |= 1;
    CM_init ();
    display = CMFB_attach_display ("");
    CMFB_initialize_display (display, 24, width, height);
    sizes[0] = height;
    sizes[1] = width;
    CM_set_vp_set (CM_allocate_vp_set (CM_create_geometry (sizes, 2)));
    CM_set_context ();
    now = CM_allocate_stack_field (32);
    last = CM_allocate_stack_field (32);
    sum = CM_allocate_stack_field (32);
    side = CM_allocate_stack_field (32);
    image = CM_allocate_stack_field (64);
    inside = CM_allocate_stack_field (1);
    place = CM_allocate_stack_field (16);
    for (i = 0; i < 2; i++) {                   /* all but the rim */
        CM_my_news_coordinate_1L (place, i, 16);
        CM_u_gt_zero_1L (place, 16);
        CM_logand_context_with_test ();
        CM_u_lt_constant_1L (place, sizes[i] - 1, 16);
        CM_logand_context_with_test ();
    }
    CM_store_context (inside);
    CM_set_context ();
    heights = (float *) calloc (height * width, sizeof (float));
    drop (heights, height / 3, width / 2, height / 8, width);
    drop (heights, height * 2 / 3, width / 4, height / 12, width);
    drop (heights, height * 2 / 3, width - 1 - width / 4, height / 12, width);
    CM_f_write_to_news_array_1L (heights, zero, zero, sizes, axes, now, SINGLE, 2, sizes,
                                 CM_float_single);
    CM_f_move_1L (last, now, SINGLE);
    for (i = 0; i < steps; i++) {
        step ();
        if (i % 2 == 1)
            draw (display);
    }
    CM_f_read_from_news_array_1L (heights, zero, zero, sizes, axes, now, SINGLE, 2, sizes,
                                  CM_float_single);
    right = 1;
    for (i = 0; i < height; i++)
        for (k = 0; k < width; k++)
            right = right && heights[i * width + k] == heights[i * width + width - 1 - k];
    printf ("the halves are the same: %s\n", right ? "yes" : "no");
    return !right;
}
