/* heat.c - the heat equation on a plate, a processor for each point.
 *
 *     lutetia cc heat.c -o heat && ./heat [steps [height width]]
 *
 * The rim is held at 0, a hot bar and a hot disk at 1; heat flows between them.  The picture
 * heat.ppm shows the last step, with lines of equal temperature.
 *
 * Shows: floats, NEWS, and the context as boundary condition.  Points whose temperature is
 * given are made inactive once, before the loop.  At the end every point is compared with a
 * plain loop's. */
#include <stdio.h>
#include <stdlib.h>
#include <math.h>
#include <cm/paris.h>
#include "picture.h"

#define SINGLE 23, 8
#define CONDUCTIVITY 0.2

static int sizes[2], zero[2], axes[2] = { 0, 1 };

/* 1: held at `temperature`. */
int held (row, column, height, width, temperature)
    int row, column, height, width;
    float *temperature;
{
    int down, across, radius;

    *temperature = 0.0;
    if (row == 0 || column == 0 || row == height - 1 || column == width - 1)
        return 1;
    *temperature = 1.0;
    down = row - height * 2 / 3;
    across = column - width * 2 / 3;
    radius = height / 8;
    if (down * down + across * across <= radius * radius)
        return 1;
    if (row > height / 4 && row < height / 2 && column > width / 5 && column < width / 5 + 4)
        return 1;
    *temperature = 0.0;
    return 0;
}

void step (heat, sum, side)
    CM_field_id_t heat, sum, side;
{
    CM_get_from_news_1L (sum, heat, 0, CM_upward, 32);
    CM_get_from_news_1L (side, heat, 0, CM_downward, 32);
    CM_f_add_2_1L (sum, side, SINGLE);
    CM_get_from_news_1L (side, heat, 1, CM_upward, 32);
    CM_f_add_2_1L (sum, side, SINGLE);
    CM_get_from_news_1L (side, heat, 1, CM_downward, 32);
    CM_f_add_2_1L (sum, side, SINGLE);
    CM_f_multiply_constant_3_1L (side, heat, 4.0, SINGLE);
    CM_f_subtract_2_1L (sum, side, SINGLE);
    CM_f_multiply_constant_2_1L (sum, CONDUCTIVITY, SINGLE);
    CM_f_add_2_1L (heat, sum, SINGLE);
}

void plain_step (old, new, fixed, height, width)
    float *old, *new;
    char *fixed;
    int height, width;
{
    int row, column, k;

    for (row = 1; row < height - 1; row++)
        for (column = 1; column < width - 1; column++) {
            k = row * width + column;
            new[k] = old[k];
            if (!fixed[k])
                new[k] += (old[k + width] + old[k - width] + old[k + 1] + old[k - 1]
                           - 4.0f * old[k]) * (float) CONDUCTIVITY;
        }
}

/* The colour of a temperature: black, red, yellow, white; a dark line at each tenth. */
void colour (heat, pixel)
    float heat;
    unsigned char *pixel;
{
    float x = 3.0 * (heat < 0.0 ? 0.0 : heat > 1.0 ? 1.0 : heat);
    int i;

    if (heat > 0.01 && heat < 0.99 && fabs (heat * 10.0 - floor (heat * 10.0 + 0.5)) < 0.06)
        x *= 0.6;
    for (i = 0; i < 3; i++, x -= 1.0)
        pixel[i] = x <= 0.0 ? 0 : x >= 1.0 ? 255 : (int) (255.0 * x);
}

int main (argc, argv)
    int argc;
    char **argv;
{
    int steps, height, width, points, i, k, right;
    float *first, *now, *other, *swap, worst;
    unsigned char *picture;
    char *fixed;
    CM_field_id_t heat, free_point, sum, side;

    steps = argc > 1 ? atoi (argv[1]) : 4000;
    height = argc > 3 ? atoi (argv[2]) : 256;
    width = argc > 3 ? atoi (argv[3]) : 320;
    if (steps < 0 || height < 16 || width < 16) {
        fprintf (stderr, "usage: heat [steps [height width]], at least 16 by 16 points\n");
        return 2;
    }
    points = height * width;
    first = (float *) malloc (points * sizeof (float));
    other = (float *) malloc (points * sizeof (float));
    now = (float *) malloc (points * sizeof (float));
    fixed = malloc (points);
    picture = (unsigned char *) malloc (3 * points);
    for (k = 0; k < points; k++) {
        fixed[k] = held (k / width, k % width, height, width, &first[k]);
        other[k] = first[k];
    }

    CM_init ();
    sizes[0] = height;
    sizes[1] = width;
    CM_set_vp_set (CM_allocate_vp_set (CM_create_geometry (sizes, 2)));
    heat = CM_allocate_heap_field (32);
    free_point = CM_allocate_heap_field (1);
    sum = CM_allocate_stack_field (32);
    side = CM_allocate_stack_field (32);
    CM_set_context ();
    CM_f_write_to_news_array_1L (first, zero, zero, sizes, axes, heat, SINGLE, 2, sizes,
                                 CM_float_single);
    CM_u_write_to_news_array_1L (fixed, zero, zero, sizes, axes, free_point, 1, 2, sizes,
                                 CM_8_bit);
    CM_lognot_1_1L (free_point, 1);
    CM_logand_context (free_point);
    printf ("%u of %d points are free\n", CM_global_count_context (), points);
    for (i = 0; i < steps; i++)
        step (heat, sum, side);
    printf ("warmest free point after %d steps: %.6f\n", steps, CM_global_f_max_1L (heat, SINGLE));
    CM_f_read_from_news_array_1L (now, zero, zero, sizes, axes, heat, SINGLE, 2, sizes,
                                  CM_float_single);
    for (k = 0; k < points; k++)
        colour (now[k], &picture[3 * k]);
    write_picture ("heat.ppm", picture, width, height, 3);

    for (i = 0; i < steps; i++) {
        plain_step (first, other, fixed, height, width);
        swap = first, first = other, other = swap;
    }
    worst = 0.0;
    for (k = 0; k < points; k++)
        if (!(fabs (first[k] - now[k]) <= worst))
            worst = fabs (first[k] - now[k]);
    right = worst < 1e-5;
    printf ("same as a plain loop: %s (at most %g apart)\n", right ? "yes" : "no", worst);
    return !right;
}
