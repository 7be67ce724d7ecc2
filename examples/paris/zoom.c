/* zoom.c - a fractal that the frame buffer makes larger and moves about.
 *
 *     lutetia cc zoom.c -o zoom && lutetia display ./zoom [steps [height width]]
 *
 * The Mandelbrot set is computed once, on an axis of symmetry.  Then the display alone works: a
 * zoom of 1 to 8, with the place that is looked at held in the middle by the pan, and a way
 * along the border.
 *
 * Shows: CMFB_set_zoom, CMFB_set_pan.  Above and below the real axis a plain comparison finds
 * the same picture. */
#include <stdio.h>
#include <stdlib.h>
#include <math.h>
#include <cm/cmfb.h>

#define SINGLE 23, 8

static int sizes[2], zero[2], axes[2] = { 0, 1 };
static unsigned char red[256], green[256], blue[256];

/* field = (coordinate - middle) * pitch + start */
void place (field, axis, middle, pitch, start)
    CM_field_id_t field;
    int axis;
    double middle, pitch, start;
{
    CM_field_id_t whole = CM_allocate_stack_field (32);

    CM_my_news_coordinate_1L (whole, axis, 32);
    CM_f_u_float_2_2L (field, whole, 32, SINGLE);
    CM_f_subtract_constant_2_1L (field, middle, SINGLE);
    CM_f_multiply_constant_2_1L (field, pitch, SINGLE);
    CM_f_add_constant_2_1L (field, start, SINGLE);
    CM_deallocate_stack_through (whole);
}

/* count = turns until the point has escaped, 255 at most */
void mandelbrot (count, cx, cy)
    CM_field_id_t count, cx, cy;
{
    CM_field_id_t x, y, xx, yy;
    int turn;

    x = CM_allocate_stack_field (32);
    y = CM_allocate_stack_field (32);
    xx = CM_allocate_stack_field (32);
    yy = CM_allocate_stack_field (32);
    CM_f_move_1L (x, cx, SINGLE);
    CM_f_move_1L (y, cy, SINGLE);
    CM_u_move_zero_1L (count, 8);
    for (turn = 0; turn < 255; turn++) {
        CM_f_multiply_3_1L (xx, x, x, SINGLE);
        CM_f_multiply_3_1L (yy, y, y, SINGLE);
        CM_f_multiply_2_1L (y, x, SINGLE);
        CM_f_add_3_1L (x, xx, yy, SINGLE);
        CM_f_le_constant_1L (x, 4.0, SINGLE);
        CM_logand_context_with_test ();
        CM_f_subtract_3_1L (x, xx, yy, SINGLE);
        CM_f_add_2_1L (x, cx, SINGLE);
        CM_f_add_2_1L (y, y, SINGLE);
        CM_f_add_2_1L (y, cy, SINGLE);
        CM_u_add_constant_2_1L (count, 1, 8);
    }
    CM_set_context ();
    CM_deallocate_stack_through (x);
}

void colours ()
{
    int i;
    double phase;

    for (i = 0; i < 255; i++) {
        phase = 2.0 * log (1.0 + i);
        red[i] = 128 - 127 * cos (phase);
        green[i] = 128 - 127 * cos (phase + 0.5);
        blue[i] = 128 - 127 * cos (phase + 1.2);
    }
}

int main (argc, argv)
    int argc;
    char **argv;
{
    int steps, height, width, i, k, zoom, right;
    double way;
    unsigned char *all;
    CMFB_display_id_t display;
    CM_field_id_t cx, cy, count;

    steps = argc > 1 ? atoi (argv[1]) : 480;
    height = argc > 3 ? atoi (argv[2]) : 257;
    width = argc > 3 ? atoi (argv[3]) : 384;
    if (steps < 1 || height < 9 || width < 9) {
        fprintf (stderr, "usage: zoom [steps [height width]], at least 9 by 9 pixels\n");
        return 2;
    }
    height |= 1;                                /* a row in the middle */
    CM_init ();
    display = CMFB_attach_display ("");
    CMFB_initialize_display (display, 8, width, height);
    colours ();
    CMFB_write_color_map (display, 0, 256, red, green, blue);
    sizes[0] = height;
    sizes[1] = width;
    CM_set_vp_set (CM_allocate_vp_set (CM_create_geometry (sizes, 2)));
    CM_set_context ();
    cx = CM_allocate_stack_field (32);
    cy = CM_allocate_stack_field (32);
    count = CM_allocate_stack_field (8);
    place (cx, 1, width / 2.0, 2.4 / height, -0.7);
    place (cy, 0, (double) (height / 2), 2.4 / height, 0.0);
    mandelbrot (count, cx, cy);
    CMFB_write_news_always (display, 0, count, 0, 0);
    for (i = 1; i <= steps; i++) {
        way = 3.0 * i / steps;                  /* the zoom doubles three times */
        zoom = (int) (pow (2.0, way) + 0.5);
        CMFB_set_zoom (display, zoom, zoom);
        CMFB_set_pan (display, (int) (width * (0.5 - 0.0042 * way) - 0.5 * width / zoom),
                      (int) (height * (0.5 + 0.0200 * way) - 0.5 * height / zoom));
    }
    all = (unsigned char *) malloc (height * width);
    CM_u_read_from_news_array_1L (all, zero, zero, sizes, axes, count, 8, 2, sizes, CM_8_bit);
    right = 1;
    for (i = 0; i < height; i++)
        for (k = 0; k < width; k++)
            right = right && all[i * width + k] == all[(height - 1 - i) * width + k];
    printf ("the same above and below: %s\n", right ? "yes" : "no");
    return !right;
}
