/* cycle.c - a picture that is drawn once, and moves by its colours.
 *
 *     lutetia cc cycle.c -o cycle && lutetia display ./cycle [steps [height width]]
 *
 * Four waves are added up in 8 bits; then only the colour map turns, by a row at a time.
 *
 * Shows: CMFB_write_color_map and CMFB_cycle_color_map.  After as many turns as the map has
 * rows the colours are those of the beginning. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <math.h>
#include <cm/cmfb.h>

#define SINGLE 23, 8

static int sizes[2];
static unsigned char red[256], green[256], blue[256], now[3][256];

/* sum = sum + sine of (a x + b y) */
void wave (sum, x, y, a, b)
    CM_field_id_t sum, x, y;
    double a, b;
{
    CM_field_id_t phase = CM_allocate_stack_field (32), more = CM_allocate_stack_field (32);

    CM_f_multiply_constant_3_1L (phase, x, a, SINGLE);
    CM_f_multiply_constant_3_1L (more, y, b, SINGLE);
    CM_f_add_2_1L (phase, more, SINGLE);
    CM_f_sin_1_1L (phase, SINGLE);
    CM_f_add_2_1L (sum, phase, SINGLE);
    CM_deallocate_stack_through (phase);
}

void colours ()
{
    int i;
    double phase;

    for (i = 0; i < 256; i++) {
        phase = 6.283185307 * i / 256;
        red[i] = 128 + 127 * sin (phase);
        green[i] = 110 + 100 * sin (phase + 1.3);
        blue[i] = 120 + 120 * sin (2 * phase + 2.6);
    }
}

int main (argc, argv)
    int argc;
    char **argv;
{
    int steps, height, width, i, right;
    CMFB_display_id_t display;
    CM_field_id_t x, y, whole, sum, picture;

    steps = argc > 1 ? atoi (argv[1]) : 512;
    height = argc > 3 ? atoi (argv[2]) : 256;
    width = argc > 3 ? atoi (argv[3]) : 384;
    if (steps < 0 || height < 8 || width < 8) {
        fprintf (stderr, "usage: cycle [steps [height width]], at least 8 by 8 pixels\n");
        return 2;
    }
    CM_init ();
    display = CMFB_attach_display ("");
    CMFB_initialize_display (display, 8, width, height);
    colours ();
    CMFB_write_color_map (display, 0, 256, red, green, blue);
    sizes[0] = height;
    sizes[1] = width;
    CM_set_vp_set (CM_allocate_vp_set (CM_create_geometry (sizes, 2)));
    CM_set_context ();
    x = CM_allocate_stack_field (32);
    y = CM_allocate_stack_field (32);
    whole = CM_allocate_stack_field (32);
    sum = CM_allocate_stack_field (32);
    picture = CM_allocate_stack_field (8);
    CM_my_news_coordinate_1L (whole, 1, 32);
    CM_f_u_float_2_2L (x, whole, 32, SINGLE);
    CM_my_news_coordinate_1L (whole, 0, 32);
    CM_f_u_float_2_2L (y, whole, 32, SINGLE);
    CM_f_move_zero_1L (sum, SINGLE);
    wave (sum, x, y, 0.043, 0.011);
    wave (sum, x, y, -0.017, 0.051);
    wave (sum, x, y, 0.029, -0.037);
    CM_f_multiply_3_1L (y, sum, sum, SINGLE);      /* bent by the others */
    wave (sum, x, y, 0.023, 0.9);
    CM_f_add_constant_2_1L (sum, 4.0, SINGLE);
    CM_f_multiply_constant_2_1L (sum, 31.9, SINGLE);
    CM_u_f_truncate_2_2L (picture, sum, 8, SINGLE);
    CMFB_write_news_always (display, 0, picture, 0, 0);
    for (i = 0; i < steps; i++)
        CMFB_cycle_color_map (display, 0, 256, 1);
    CMFB_cycle_color_map (display, 0, 256, -(steps % 256));
    CMFB_read_color_map (display, 0, 256, now[0], now[1], now[2]);
    right = memcmp (now[0], red, 256) == 0 && memcmp (now[1], green, 256) == 0
        && memcmp (now[2], blue, 256) == 0;
    printf ("the colours are those of the beginning: %s\n", right ? "yes" : "no");
    return !right;
}
