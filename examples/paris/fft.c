/* fft.c - the fast Fourier transform, a processor for each sample.
 *
 *     lutetia cc fft.c -o fft && ./fft [log2 of the number of samples]
 *
 * Shows: complex numbers and butterflies.  In pass b each processor is paired with the one
 * whose coordinate differs in bit b (CM_get_from_power_two).  The lower one takes the sum, the
 * upper one the difference times a root of unity that it computes itself.  After all passes the
 * coefficients are in bit-reversed order; a send to the reversed address puts them right.
 *
 * Compared with a direct transform of some coefficients, and transformed back. */
#include <stdio.h>
#include <stdlib.h>
#include <math.h>
#include <cm/paris.h>

#define DOUBLE 52, 11
#define PI 3.14159265358979323846
#define ADDRESS 32

static int counts[1], zero[1], axis[1];

/* The transform without normalisation; sign -1: forward, 1: back. */
void transform (value, bits, sign)
    CM_field_id_t value; /* complex: real part, imaginary part */
    int bits, sign;
{
    CM_field_id_t place = CM_allocate_stack_field (ADDRESS), low = CM_allocate_stack_field (ADDRESS);
    CM_field_id_t other = CM_allocate_stack_field (128), root = CM_allocate_stack_field (128);
    CM_field_id_t angle = CM_allocate_stack_field (64), address = CM_allocate_stack_field (ADDRESS);
    int b;

    CM_my_news_coordinate_1L (place, 0, ADDRESS);
    for (b = bits - 1; b >= 0; b--) {
        CM_get_from_power_two_1L (other, value, 0, b, CM_upward, 128);
        CM_load_context (CM_add_offset_to_field_id (place, b));
        CM_get_from_power_two_1L (other, value, 0, b, CM_downward, 128);
        CM_c_subtract_3_1L (value, other, value, DOUBLE);
        if (b > 0) { /* the place's lower b bits number the root */
            CM_u_move_2L (low, place, ADDRESS, b);
            CM_f_u_float_2_2L (angle, low, ADDRESS, DOUBLE);
            CM_f_multiply_constant_2_1L (angle, sign * PI / (1 << b), DOUBLE);
            CM_f_cos_2_1L (root, angle, DOUBLE);
            CM_f_sin_2_1L (CM_add_offset_to_field_id (root, 64), angle, DOUBLE);
            CM_c_multiply_2_1L (value, root, DOUBLE);
        }
        CM_invert_context ();
        CM_c_add_2_1L (value, other, DOUBLE);
        CM_set_context ();
    }
    for (b = 0; b < bits; b++)
        CM_u_move_1L (CM_add_offset_to_field_id (low, b),
                      CM_add_offset_to_field_id (place, bits - 1 - b), 1);
    CM_make_news_coordinate_1L (CM_current_geometry, address, 0, low, bits);
    CM_send_1L (value, address, value, 128, CM_no_field);
    CM_deallocate_stack_through (place);
}

void write_value (part, value)
    double *part[2];
    CM_field_id_t value;
{
    int i;

    for (i = 0; i < 2; i++)
        CM_f_write_to_news_array_1L (part[i], zero, zero, counts, axis,
                                     CM_add_offset_to_field_id (value, 64 * i), DOUBLE, 1, counts,
                                     CM_float_double);
}

void read_value (part, value)
    double *part[2];
    CM_field_id_t value;
{
    int i;

    for (i = 0; i < 2; i++)
        CM_f_read_from_news_array_1L (part[i], zero, zero, counts, axis,
                                      CM_add_offset_to_field_id (value, 64 * i), DOUBLE, 1, counts,
                                      CM_float_double);
}

/* The distance of coefficient k in `got` from its value by the definition. */
double apart (given, got, count, k)
    double *given[2], *got[2];
    int count, k;
{
    double real = 0.0, imaginary = 0.0, c, s;
    int i;

    for (i = 0; i < count; i++) {
        c = cos (2.0 * PI * ((double) i * k - floor ((double) i * k / count) * count) / count);
        s = sin (2.0 * PI * ((double) i * k - floor ((double) i * k / count) * count) / count);
        real += given[0][i] * c + given[1][i] * s;
        imaginary += given[1][i] * c - given[0][i] * s;
    }
    return fabs (real - got[0][k]) + fabs (imaginary - got[1][k]);
}

int main (argc, argv)
    int argc;
    char **argv;
{
    int bits, count, i, k, right;
    double *given[2], *got[2], worst = 0.0, back = 0.0, d;
    CM_field_id_t value;

    bits = argc > 1 ? atoi (argv[1]) : 14;
    if (bits < 1 || bits > 24) {
        fprintf (stderr, "usage: fft [bits], for 2^bits samples, bits from 1 to 24\n");
        return 2;
    }
    count = counts[0] = 1 << bits;
    for (i = 0; i < 2; i++) {
        given[i] = (double *) malloc (count * sizeof (double));
        got[i] = (double *) malloc (count * sizeof (double));
    }
    for (i = 0; i < count; i++) {
        given[0][i] = rand () / (double) RAND_MAX - 0.5;
        given[1][i] = rand () / (double) RAND_MAX - 0.5;
    }
    CM_init ();
    CM_set_vp_set (CM_allocate_vp_set (CM_create_geometry (counts, 1)));
    value = CM_allocate_heap_field (128);
    CM_set_context ();
    write_value (given, value);
    transform (value, bits, -1);
    read_value (got, value);
    for (i = 0; i < 100; i++) {
        k = count <= 100 ? i % count : (int) (rand () / (RAND_MAX + 1.0) * count);
        d = apart (given, got, count, k);
        worst = d > worst ? d : worst;
    }
    transform (value, bits, 1);
    read_value (got, value);
    for (i = 0; i < count; i++)
        for (k = 0; k < 2; k++) {
            d = fabs (got[k][i] / count - given[k][i]);
            back = d > back ? d : back;
        }
    printf ("%d samples: %.2g from the direct transform, %.2g after there and back\n", count,
            worst, back);
    right = worst < 1e-10 * count && back < 1e-12;
    printf ("same as a direct transform: %s\n", right ? "yes" : "no");
    return !right;
}
