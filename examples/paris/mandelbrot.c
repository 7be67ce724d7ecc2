/* mandelbrot.c - the Mandelbrot set, a processor for each point of the picture.
 *
 *     lutetia cc mandelbrot.c -o mandelbrot && ./mandelbrot [most [height width]]
 *
 * z = z * z + c until |z| > 2, at most `most` times; the number of turns gives the colour in
 * mandelbrot.ppm.
 *
 * Shows: a context that shrinks.  A point that has escaped becomes inactive and keeps its
 * numbers.  From time to time the front end asks how many are active (CM_global_count_context),
 * and stops when none has escaped for long.  Every 37th row is compared with a plain loop's. */
#include <stdio.h>
#include <stdlib.h>
#include <math.h>
#include <cm/paris.h>
#include "picture.h"

#define SINGLE 23, 8
#define COUNT 16
#define ASK 4        /* turns from one question to the next */
#define PATIENCE 200 /* turns without an escape before we stop */

static int sizes[2], zero[2], axes[2] = { 0, 1 };
static double west = -0.7815, north = 0.1332, side = 0.0085; /* the part of the plane */

/* field = start + coordinate * pitch */
void place (field, axis, start, pitch)
    CM_field_id_t field;
    int axis;
    double start, pitch;
{
    CM_field_id_t whole = CM_allocate_stack_field (32);

    CM_my_news_coordinate_1L (whole, axis, 32);
    CM_f_u_float_2_2L (field, whole, 32, SINGLE);
    CM_f_multiply_constant_2_1L (field, pitch, SINGLE);
    CM_f_add_constant_2_1L (field, start, SINGLE);
    CM_deallocate_stack_through (whole);
}

int plain_count (cx, cy, most)
    float cx, cy;
    int most;
{
    float x = cx, y = cy, xx, yy, xy;
    int count = 0;

    while (count < most) {
        xx = x * x;
        yy = y * y;
        if (xx + yy > 4.0f)
            break;
        xy = x * y;
        x = xx - yy;
        x = x + cx;
        y = xy + xy;
        y = y + cy;
        count++;
    }
    return count;
}

/* The colour of a count: from blue through white to brown and back, slower for larger
 * counts. */
void colour (count, pixel)
    int count;
    unsigned char *pixel;
{
    double phase = 2.2 * log (1.0 + count);

    pixel[0] = 128.0 - 127.0 * cos (phase);
    pixel[1] = 128.0 - 127.0 * cos (phase + 0.6);
    pixel[2] = 128.0 - 127.0 * cos (phase + 1.4);
}

void draw (counts, height, width)
    unsigned short *counts;
    int height, width;
{
    unsigned char *picture = (unsigned char *) malloc (3 * height * width);
    int k;

    for (k = 0; k < height * width; k++)
        colour (counts[k], &picture[3 * k]);
    write_picture ("mandelbrot.ppm", picture, width, height, 3);
    free (picture);
}

/* The number of points, in every 37th row, for which a plain loop gives another count. */
int compare (counts, height, width, pitch, most)
    unsigned short *counts;
    int height, width, most;
    double pitch;
{
    int row, column, wrong = 0;
    float px, py;

    for (row = 0; row < height; row += 37)
        for (column = 0; column < width; column++) {
            px = column;
            py = row;
            px *= (float) pitch;
            px += (float) west;
            py *= (float) pitch;
            py += (float) north;
            wrong += plain_count (px, py, most) != counts[row * width + column];
        }
    return wrong;
}

int main (argc, argv)
    int argc;
    char **argv;
{
    int most, height, width, turn, last = 0, wrong;
    unsigned int left = 0, before;
    unsigned short *counts;
    double pitch;
    CM_field_id_t cx, cy, x, y, xx, yy, count;

    most = argc > 1 ? atoi (argv[1]) : 5000;
    height = argc > 3 ? atoi (argv[2]) : 480;
    width = argc > 3 ? atoi (argv[3]) : 640;
    if (most < 1 || most > 65535 || height < 1 || width < 1) {
        fprintf (stderr, "usage: mandelbrot [most [height width]], most from 1 to 65535\n");
        return 2;
    }
    pitch = side / width;
    CM_init ();
    sizes[0] = height;
    sizes[1] = width;
    CM_set_vp_set (CM_allocate_vp_set (CM_create_geometry (sizes, 2)));
    cx = CM_allocate_stack_field (32);
    cy = CM_allocate_stack_field (32);
    x = CM_allocate_stack_field (32);
    y = CM_allocate_stack_field (32);
    xx = CM_allocate_stack_field (32);
    yy = CM_allocate_stack_field (32);
    count = CM_allocate_stack_field (COUNT);
    CM_set_context ();
    place (cx, 1, west, pitch);
    place (cy, 0, north, pitch);
    CM_f_move_1L (x, cx, SINGLE);
    CM_f_move_1L (y, cy, SINGLE);
    CM_u_move_zero_1L (count, COUNT);

    for (turn = 0; turn < most; turn++) {
        CM_f_multiply_3_1L (xx, x, x, SINGLE);
        CM_f_multiply_3_1L (yy, y, y, SINGLE);
        CM_f_multiply_2_1L (y, x, SINGLE);   /* x * y */
        CM_f_add_3_1L (x, xx, yy, SINGLE);
        CM_f_le_constant_1L (x, 4.0, SINGLE);
        CM_logand_context_with_test ();      /* the others are done */
        CM_f_subtract_3_1L (x, xx, yy, SINGLE);
        CM_f_add_2_1L (x, cx, SINGLE);
        CM_f_add_2_1L (y, y, SINGLE);
        CM_f_add_2_1L (y, cy, SINGLE);
        CM_u_add_constant_2_1L (count, 1, COUNT);
        if (turn % ASK == ASK - 1) {
            before = left;
            left = CM_global_count_context ();
            if (left != before)
                last = turn;
            else if (turn - last >= PATIENCE)
                most = turn + 1;
        }
    }
    printf ("%u of %d points are left after %d turns\n", CM_global_count_context (),
            height * width, most);
    CM_set_context ();
    counts = (unsigned short *) malloc (height * width * sizeof (short));
    CM_u_read_from_news_array_1L (counts, zero, zero, sizes, axes, count, COUNT, 2, sizes,
                                  CM_16_bit);
    draw (counts, height, width);
    wrong = compare (counts, height, width, pitch, most);
    printf ("same as a plain loop: %s\n", wrong ? "no" : "yes");
    return wrong != 0;
}
