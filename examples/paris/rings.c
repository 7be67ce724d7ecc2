/* rings.c - a picture of 8 bits with colours of its own, put together of four.
 *
 *     lutetia cc rings.c -o rings && lutetia display -o rings.png ./rings [height width]
 *
 * Two stones fell into a pond: rings of both, added up.  A machine that had room for a quarter
 * of the display computed the quarters one after the other, and wrote each to its place.
 *
 * Shows: offsets in writes; the shuffle done by hand, and a raw write.  Each pixel is compared
 * with a plain loop's. */
#include <stdio.h>
#include <stdlib.h>
#include <math.h>
#include <cm/cmfb.h>

#define SINGLE 23, 8

static int sizes[2], zero[2], axes[2] = { 0, 1 };
static unsigned char red[256], green[256], blue[256];

void colours ()
{
    int i;

    for (i = 0; i < 256; i++) {                 /* ink on old paper */
        red[i] = 20 + i * 228 / 255;
        green[i] = 24 + i * 212 / 255;
        blue[i] = 60 + i * 130 / 255;
    }
}

/* distance = the root of (row - y)^2 + (column - x)^2 */
void distance (result, row, column, y, x)
    CM_field_id_t result, row, column;
    double y, x;
{
    CM_field_id_t square = CM_allocate_stack_field (32);

    CM_f_subtract_constant_3_1L (result, row, y, SINGLE);
    CM_f_multiply_2_1L (result, result, SINGLE);
    CM_f_subtract_constant_3_1L (square, column, x, SINGLE);
    CM_f_multiply_2_1L (square, square, SINGLE);
    CM_f_add_2_1L (result, square, SINGLE);
    CM_f_sqrt_1_1L (result, SINGLE);
    CM_deallocate_stack_through (square);
}

/* The same for the front end, in floats. */
float plain_distance (row, column, y, x)
    double row, column, y, x;
{
    float a = (float) row - (float) y, b = (float) column - (float) x;

    a *= a;
    b *= b;
    a += b;
    return (float) sqrt ((double) a);
}

int plain (row, column, height, width)
    int row, column, height, width;
{
    float sum = plain_distance ((double) row, (double) column, height * 0.35, width * 0.3);
    int ring = (int) (sum * 6.0f) & 255;

    sum = plain_distance ((double) row, (double) column, height * 0.7, width * 0.75);
    ring = (ring > 127 ? 255 - ring : ring);
    return ring + (((int) (sum * 6.0f) & 255) > 127 ? 255 - ((int) (sum * 6.0f) & 255)
                                                    : ((int) (sum * 6.0f) & 255));
}

/* tent = 6 distance mod 256, up to 127 and down again */
void ring (tent, far)
    CM_field_id_t tent, far;
{
    CM_field_id_t whole = CM_allocate_stack_field (32);

    CM_f_multiply_constant_2_1L (far, 6.0, SINGLE);
    CM_u_f_truncate_2_2L (whole, far, 32, SINGLE);
    CM_u_move_1L (tent, whole, 8);
    CM_u_gt_constant_1L (tent, 127, 8);
    CM_logand_context_with_test ();
    CM_lognot_1_1L (tent, 8);                   /* 255 - tent */
    CM_set_context ();
    CM_deallocate_stack_through (whole);
}

int main (argc, argv)
    int argc;
    char **argv;
{
    int height, width, part, i, k, top, left, wrong = 0;
    unsigned char *quarter;
    CMFB_display_id_t display;
    CM_field_id_t row, column, far, tent, picture;

    height = argc > 2 ? atoi (argv[1]) : 256;
    width = argc > 2 ? atoi (argv[2]) : 384;
    if (height < 8 || width < 8) {
        fprintf (stderr, "usage: rings [height width], at least 8 by 8 pixels\n");
        return 2;
    }
    height &= ~1;
    width &= ~1;
    CM_init ();
    display = CMFB_attach_display ("");
    CMFB_initialize_display (display, 8, width, height);
    colours ();
    CMFB_write_color_map (display, 0, 256, red, green, blue);
    sizes[0] = height / 2;
    sizes[1] = width / 2;
    CM_set_vp_set (CM_allocate_vp_set (CM_create_geometry (sizes, 2)));
    CM_set_context ();
    row = CM_allocate_stack_field (32);
    column = CM_allocate_stack_field (32);
    far = CM_allocate_stack_field (32);
    tent = CM_allocate_stack_field (8);
    picture = CM_allocate_stack_field (8);
    quarter = (unsigned char *) malloc (height / 2 * (width / 2));
    for (part = 0; part < 4; part++) {
        top = part / 2 * (height / 2);
        left = part % 2 * (width / 2);
        CM_my_news_coordinate_1L (far, 0, 32);
        CM_f_u_float_2_2L (row, far, 32, SINGLE);
        CM_f_add_constant_2_1L (row, (double) top, SINGLE);
        CM_my_news_coordinate_1L (far, 1, 32);
        CM_f_u_float_2_2L (column, far, 32, SINGLE);
        CM_f_add_constant_2_1L (column, (double) left, SINGLE);
        distance (far, row, column, height * 0.35, width * 0.3);
        ring (picture, far);
        distance (far, row, column, height * 0.7, width * 0.75);
        ring (tent, far);
        CM_u_add_2_1L (picture, tent, 8);
        CM_u_read_from_news_array_1L (quarter, zero, zero, sizes, axes, picture, 8, 2, sizes,
                                      CM_8_bit);
        for (i = 0; i < height / 2; i++)
            for (k = 0; k < width / 2; k++)
                wrong += quarter[i * (width / 2) + k] != plain (top + i, left + k, height, width);
        CMFB_shuffle_from_news_always (display, picture, picture, 8);
        CMFB_write_always (display, 0, picture, left, top);
    }
    printf ("same as a plain loop: %s\n", wrong ? "no" : "yes");
    return wrong != 0;
}
