/* life.c - Conway's Life on a torus, a processor for each cell.
 *
 *     lutetia cc life.c -o life && ./life [generations [height width]]
 *
 * Five cells, the R-pentomino, take 1103 generations to settle down as 116.  A cell that dies
 * keeps a glow that fades, so that the picture life.pgm shows where something has happened.
 *
 * Shows: NEWS.  Nine cells are summed with four fetches: first three cells above each other,
 * then three such sums beside each other.  The cell itself is counted.  With a sum of 3 it
 * lives, with 4 it stays as it is, else it is dead: two comparisons that narrow the context.
 * The lights on the front of the machine show the living cells (`lutetia leds ./life`).  At the
 * end every cell is compared with a plain loop's. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cm/paris.h>
#include "picture.h"

#define SUM 4  /* bits for 0..9 */
#define GLOW 8
#define FLAME 160
#define EMBERS 30 /* the glow that stays */

static char *pattern[] = {
    ".OO",
    "OO.",
    ".O." };

static int sizes[2], zero[2], axes[2] = { 0, 1 };

/* Computes the next generation in alive, and lets glow fade. */
void step (alive, glow, sum, side)
    CM_field_id_t alive, glow, sum, side;
{
    int axis;

    CM_u_move_2L (sum, alive, SUM, 1);
    for (axis = 0; axis < 2; axis++) {
        CM_u_move_1L (side, sum, SUM);
        CM_get_from_news_1L (sum, sum, axis, CM_upward, SUM);
        CM_u_add_2_1L (sum, side, SUM);
        CM_get_from_news_1L (side, side, axis, CM_downward, SUM);
        CM_u_add_2_1L (sum, side, SUM);
    }
    CM_u_eq_constant_1L (sum, 3, SUM);
    CM_logand_context_with_test ();
    CM_set_bit (alive);
    CM_invert_context ();
    CM_u_ne_constant_1L (sum, 4, SUM);
    CM_logand_context_with_test ();
    CM_clear_bit (alive);

    CM_set_context ();
    CM_u_gt_constant_1L (glow, EMBERS, GLOW);
    CM_logand_context_with_test ();
    CM_u_subtract_constant_2_1L (glow, 1, GLOW);
    CM_load_context (alive);
    CM_u_move_constant_1L (glow, FLAME, GLOW);
    CM_set_context ();
}

/* The next generation by a plain loop over the cells. */
void plain_step (old, new, height, width)
    unsigned char *old, *new;
    int height, width;
{
    unsigned char *above, *here, *below;
    int row, column, left, right, sum;

    for (row = 0; row < height; row++) {
        above = old + (row + height - 1) % height * width;
        here = old + row * width;
        below = old + (row + 1) % height * width;
        for (column = 0; column < width; column++) {
            left = column ? column - 1 : width - 1;
            right = column < width - 1 ? column + 1 : 0;
            sum = above[left] + above[column] + above[right] + here[left] + here[column]
                  + here[right] + below[left] + below[column] + below[right];
            *new++ = sum == 3 || (sum == 4 && here[column]);
        }
    }
}

int main (argc, argv)
    int argc;
    char **argv;
{
    int generations, height, width, cells, i, row, column, right;
    unsigned int population = 0, most = 0;
    unsigned char *first, *now, *other, *swap;
    CM_field_id_t alive, glow, sum, side;

    generations = argc > 1 ? atoi (argv[1]) : 1103;
    height = argc > 3 ? atoi (argv[2]) : 500;
    width = argc > 3 ? atoi (argv[3]) : 500;
    if (generations < 0 || height < 3 || width < 3) {
        fprintf (stderr, "usage: life [generations [height width]], at least 3 by 3 cells\n");
        return 2;
    }
    cells = height * width;
    first = (unsigned char *) calloc (cells, 1);
    now = (unsigned char *) malloc (cells);
    other = (unsigned char *) malloc (cells);
    for (row = 0; row < 3; row++)
        for (column = 0; column < 3; column++)
            first[(row + (height - 3) / 2) * width + column + (width - 3) / 2] =
                pattern[row][column] == 'O';

    CM_init ();
    sizes[0] = height;
    sizes[1] = width;
    CM_set_vp_set (CM_allocate_vp_set (CM_create_geometry (sizes, 2)));
    alive = CM_allocate_heap_field (1);
    glow = CM_allocate_heap_field (GLOW);
    sum = CM_allocate_stack_field (SUM);
    side = CM_allocate_stack_field (SUM);
    CM_set_context ();
    CM_u_write_to_news_array_1L (first, zero, zero, sizes, axes, alive, 1, 2, sizes, CM_8_bit);
    CM_u_move_zero_1L (glow, GLOW);
    for (i = 0; i < generations; i++) {
        step (alive, glow, sum, side);
        CM_latch_leds (alive);
        population = CM_global_count_bit (alive);
        if (population > most)
            most = population;
    }
    printf ("after %d generations %u of %d cells live; once it was %u\n", generations,
            population, cells, most);

    CM_u_read_from_news_array_1L (now, zero, zero, sizes, axes, alive, 1, 2, sizes, CM_8_bit);
    CM_load_context (alive);
    CM_u_move_constant_1L (glow, 255, GLOW);
    CM_u_read_from_news_array_1L (other, zero, zero, sizes, axes, glow, GLOW, 2, sizes, CM_8_bit);
    write_picture ("life.pgm", other, width, height, 1);

    for (i = 0; i < generations; i++) {
        plain_step (first, other, height, width);
        swap = first, first = other, other = swap;
    }
    right = memcmp (first, now, cells) == 0;
    printf ("same as a plain loop: %s\n", right ? "yes" : "no");
    return !right;
}
