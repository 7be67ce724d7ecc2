/* matrix.c - the product of two matrices, a processor for each of the n^3 multiplications.
 *
 *     lutetia cc matrix.c -o matrix && ./matrix [n]
 *
 * Shows: three axes, spreads and a reduction.  Processor (i, j, k) computes a[i][k] * b[k][j].
 * The front end writes a into the plane j = 0 and b into the plane i = 0.  Two spreads copy
 * each number to all processors that need it.  After one multiplication and one sum along k,
 * c[i][j] is in the plane k = 0. Compared with three plain loops. */
#include <stdio.h>
#include <stdlib.h>
#include <math.h>
#include <cm/paris.h>

#define DOUBLE 52, 11

int main (argc, argv)
    int argc;
    char **argv;
{
    static int zero[3], a_axes[2] = { 0, 2 }, b_axes[2] = { 2, 1 }, c_axes[2] = { 0, 1 };
    int n, sizes[3], i, j, k, right;
    double *a, *b, *c, sum, worst = 0.0;
    CM_field_id_t left, other;

    n = argc > 1 ? atoi (argv[1]) : 100;
    if (n < 1 || n > 1000) {
        fprintf (stderr, "usage: matrix [n], from 1 to 1000\n");
        return 2;
    }
    sizes[0] = sizes[1] = sizes[2] = n;
    a = (double *) malloc (n * n * sizeof (double));
    b = (double *) malloc (n * n * sizeof (double));
    c = (double *) malloc (n * n * sizeof (double));
    for (i = 0; i < n * n; i++) {
        a[i] = rand () / (double) RAND_MAX;
        b[i] = rand () / (double) RAND_MAX;
    }

    CM_init ();
    CM_set_vp_set (CM_allocate_vp_set (CM_create_geometry (sizes, 3)));
    left = CM_allocate_heap_field (64);
    other = CM_allocate_heap_field (64);
    CM_set_context ();
    CM_f_write_to_news_array_1L (a, zero, zero, sizes, a_axes, left, DOUBLE, 2, sizes,
                                 CM_float_double);
    CM_f_write_to_news_array_1L (b, zero, zero, sizes, b_axes, other, DOUBLE, 2, sizes,
                                 CM_float_double);
    CM_spread_with_copy_1L (left, left, 1, 64, 0);
    CM_spread_with_copy_1L (other, other, 0, 64, 0);
    CM_f_multiply_2_1L (left, other, DOUBLE);
    CM_spread_with_f_add_1L (left, left, 2, DOUBLE);
    CM_f_read_from_news_array_1L (c, zero, zero, sizes, c_axes, left, DOUBLE, 2, sizes,
                                  CM_float_double);

    for (i = 0; i < n; i++)
        for (j = 0; j < n; j++) {
            sum = 0.0;
            for (k = 0; k < n; k++)
                sum += a[i * n + k] * b[k * n + j];
            if (!(fabs (sum - c[i * n + j]) <= worst))
                worst = fabs (sum - c[i * n + j]);
        }
    right = worst <= 1e-13 * n;
    printf ("%d by %d, at most %.2g from plain loops\n", n, n, worst);
    printf ("same as plain loops: %s\n", right ? "yes" : "no");
    return !right;
}
