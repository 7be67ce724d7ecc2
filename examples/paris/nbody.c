/* nbody.c - stars that pull each other, a processor for each.
 *
 *     lutetia cc nbody.c -o nbody && ./nbody [steps [stars]]
 *
 * Two turning clouds fall towards each other; nbody.pgm shows their paths from above.
 *
 * Shows: the ring.  A copy of all stars' places and masses moves round, from neighbour to
 * neighbour along the only axis.  At each stop every processor adds the pull of the star whose
 * copy it holds.  After a whole turn each star has met all others.  The first step's pulls are
 * compared with a plain double loop's, and the energy at the end with that at the beginning. */
#include <stdio.h>
#include <stdlib.h>
#include <math.h>
#include <cm/paris.h>
#include "picture.h"

#define SINGLE 23, 8
#define SOFT 0.01  /* added to the squared distance, so that no pull is infinite */
#define DT 0.01
#define SIDE 400   /* of the picture */
#define AXES 3

static int count, counts[1], zero[1], axis[1];
static CM_field_id_t place[AXES], speed[AXES], pull[AXES], mass, guest[AXES + 1], offset[AXES];
static CM_field_id_t near, term;

CM_field_id_t upload (values)
    float *values;
{
    CM_field_id_t field = CM_allocate_heap_field (32);

    CM_f_write_to_news_array_1L (values, zero, zero, counts, axis, field, SINGLE, 1, counts,
                                 CM_float_single);
    return field;
}

void download (values, field)
    float *values;
    CM_field_id_t field;
{
    CM_f_read_from_news_array_1L (values, zero, zero, counts, axis, field, SINGLE, 1, counts,
                                  CM_float_single);
}

/* pull = sum over all others of mass * offset / distance^3 */
void pulls ()
{
    int stop, a;

    for (a = 0; a < AXES; a++) {
        CM_f_move_1L (guest[a], place[a], SINGLE);
        CM_f_move_zero_1L (pull[a], SINGLE);
    }
    CM_f_move_1L (guest[AXES], mass, SINGLE);
    for (stop = 1; stop < count; stop++) {
        for (a = 0; a <= AXES; a++)
            CM_get_from_news_1L (guest[a], guest[a], 0, CM_upward, 32);
        CM_f_move_constant_1L (near, SOFT, SINGLE);
        for (a = 0; a < AXES; a++) {
            CM_f_subtract_3_1L (offset[a], guest[a], place[a], SINGLE);
            CM_f_multiply_3_1L (term, offset[a], offset[a], SINGLE);
            CM_f_add_2_1L (near, term, SINGLE);
        }
        CM_f_sqrt_2_1L (term, near, SINGLE);
        CM_f_multiply_2_1L (term, near, SINGLE);
        CM_f_divide_3_1L (term, guest[AXES], term, SINGLE);
        for (a = 0; a < AXES; a++) {
            CM_f_multiply_2_1L (offset[a], term, SINGLE);
            CM_f_add_2_1L (pull[a], offset[a], SINGLE);
        }
    }
}

/* speed += pull * time */
void kick (time)
    double time;
{
    int a;

    for (a = 0; a < AXES; a++) {
        CM_f_multiply_constant_3_1L (term, pull[a], time, SINGLE);
        CM_f_add_2_1L (speed[a], term, SINGLE);
    }
}

void drift (time)
    double time;
{
    int a;

    for (a = 0; a < AXES; a++) {
        CM_f_multiply_constant_3_1L (term, speed[a], time, SINGLE);
        CM_f_add_2_1L (place[a], term, SINGLE);
    }
}

/* The energy of all stars, computed on the front end in double; `first` gets the pulls on star
 * 0. */
double energy (values, first)
    float *values[2 * AXES + 1]; /* places, speeds, mass */
    double *first;
{
    double sum = 0.0, d, distance;
    int i, j, a;

    for (a = 0; a < AXES; a++)
        first[a] = 0.0;
    for (i = 0; i < count; i++) {
        for (a = 0; a < AXES; a++)
            sum += 0.5 * values[AXES * 2][i] * values[AXES + a][i] * values[AXES + a][i];
        for (j = i + 1; j < count; j++) {
            distance = SOFT;
            for (a = 0; a < AXES; a++) {
                d = values[a][j] - values[a][i];
                distance += d * d;
            }
            distance = sqrt (distance);
            sum -= (double) values[AXES * 2][i] * values[AXES * 2][j] / distance;
            for (a = 0; a < AXES && i == 0; a++)
                first[a] += values[AXES * 2][j] * (values[a][j] - values[a][0])
                            / (distance * distance * distance);
        }
    }
    return sum;
}

double uniform () /* -1 to 1 */
{
    return 2.0 * (rand () / (RAND_MAX + 1.0)) - 1.0;
}

/* Draws star i in a turning ball of radius 1; odd stars are in a second ball, which turns the
 * other way. */
void invent (i, values)
    int i;
    float *values[2 * AXES + 1];
{
    double side = i % 2 ? 1.0 : -1.0, x, y, z;

    do
        x = uniform (), y = uniform (), z = uniform ();
    while (x * x + y * y + z * z > 1.0);
    values[0][i] = x + 1.3 * side;
    values[1][i] = y + 0.5 * side;
    values[2][i] = z * 0.2;
    values[3][i] = -0.5 * y - 0.3 * side;
    values[4][i] = 0.5 * x;
    values[5][i] = 0.0;
    values[6][i] = 1.0 / count;
}

void draw (picture, values)
    unsigned char *picture;
    float *values[2 * AXES + 1];
{
    int i, x, y;

    for (i = 0; i < count; i++) {
        x = SIDE / 2 + SIDE / 5.0 * values[0][i];
        y = SIDE / 2 - SIDE / 5.0 * values[1][i];
        if (x >= 0 && y >= 0 && x < SIDE && y < SIDE && picture[y * SIDE + x] < 246)
            picture[y * SIDE + x] += 10;
    }
}

int main (argc, argv)
    int argc;
    char **argv;
{
    int steps, i, a, right;
    float *values[2 * AXES + 1], *measured;
    double before, after, expected[AXES], apart = 0.0, size = 0.0;
    unsigned char *picture;

    steps = argc > 1 ? atoi (argv[1]) : 500;
    count = argc > 2 ? atoi (argv[2]) : 256;
    if (steps < 0 || count < 2) {
        fprintf (stderr, "usage: nbody [steps [stars]], at least 2 stars\n");
        return 2;
    }
    counts[0] = count;
    picture = (unsigned char *) calloc (SIDE, SIDE);
    measured = (float *) malloc (count * sizeof (float));
    for (a = 0; a < 2 * AXES + 1; a++)
        values[a] = (float *) malloc (count * sizeof (float));
    for (i = 0; i < count; i++)
        invent (i, values);
    before = energy (values, expected);

    CM_init ();
    CM_set_vp_set (CM_allocate_vp_set (CM_create_geometry (counts, 1)));
    CM_set_context ();
    for (a = 0; a < AXES; a++) {
        place[a] = upload (values[a]);
        speed[a] = upload (values[AXES + a]);
        pull[a] = CM_allocate_heap_field (32);
        guest[a] = CM_allocate_stack_field (32);
        offset[a] = CM_allocate_stack_field (32);
    }
    mass = upload (values[2 * AXES]);
    guest[AXES] = CM_allocate_stack_field (32);
    near = CM_allocate_stack_field (32);
    term = CM_allocate_stack_field (32);

    pulls ();
    for (a = 0; a < AXES; a++) {
        download (measured, pull[a]);
        apart += fabs (measured[0] - expected[a]);
        size += fabs (expected[a]);
    }
    for (i = 0; i < steps; i++) { /* half a kick, a drift, half a kick */
        kick (DT / 2);
        drift (DT);
        pulls ();
        kick (DT / 2);
        download (values[0], place[0]);
        download (values[1], place[1]);
        draw (picture, values);
    }
    for (a = 0; a < AXES; a++) {
        download (values[a], place[a]);
        download (values[AXES + a], speed[a]);
    }
    after = energy (values, expected);
    write_picture ("nbody.pgm", picture, SIDE, SIDE, 1);
    printf ("first pull: %.2g of it off; energy: %.6f, then %.6f\n", apart / size, before, after);
    right = apart <= 1e-5 * size && fabs (after - before) <= 1e-3 * fabs (before);
    printf ("same as a plain loop: %s\n", right ? "yes" : "no");
    return !right;
}
