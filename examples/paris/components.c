/* components.c - the connected components of an image, a processor for each pixel.
 *
 *     lutetia cc components.c -o components && ./components [seed [height width]]
 *
 * The image is random, ink in 59 of 100 pixels: about where pieces begin to hang together all
 * across it. components.ppm shows each piece in its own colour.
 *
 * Shows: scans and sends.  Each pixel begins with its own send address as its label.  A round
 * has two parts. First, runs of ink along both axes take their least label, by segmented scans
 * up and down.  Then each pixel sends its new label to the owner of its old one; the owner
 * keeps the least, and all pixels get it from the owner.  So a whole piece learns at once what
 * one of its pixels has found.  A spiral takes a few rounds, not as many as it is long.  The
 * labels are compared with those of a flood fill. */
#include <stdio.h>
#include <stdlib.h>
#include <cm/paris.h>
#include "picture.h"

#define LABEL 32
#define INK 38860 /* of 65536 */

static int sizes[2], zero[2], axes[2] = { 0, 1 };

/* start = 1 where a run of ink along the axis begins, and in every pixel without ink. */
void find_starts (start, ink, axis)
    CM_field_id_t start, ink;
    int axis;
{
    CM_field_id_t place = CM_allocate_stack_field (32);

    CM_get_from_news_1L (start, ink, axis, CM_downward, 1);
    CM_lognand_2_1L (start, ink, 1);
    CM_my_news_coordinate_1L (place, axis, 32);
    CM_u_eq_zero_1L (place, 32);
    CM_logior_test (start);
    CM_store_test (start);
    CM_deallocate_stack_through (place);
}

/* Every pixel of ink gets the least label of its component; returns how many rounds that
 * took. */
int find_labels (label, ink)
    CM_field_id_t label, ink;
{
    CM_field_id_t start[2], old = CM_allocate_stack_field (LABEL);
    CM_field_id_t least = CM_allocate_stack_field (LABEL);
    int axis, rounds = 0;

    for (axis = 0; axis < 2; axis++) {
        start[axis] = CM_allocate_stack_field (1);
        find_starts (start[axis], ink, axis);
    }
    CM_u_move_zero_1L (label, LABEL);
    CM_my_send_address (label);
    CM_load_context (ink);
    do {
        CM_u_move_1L (old, label, LABEL);
        for (axis = 0; axis < 2; axis++) {
            CM_scan_with_u_min_1L (label, label, axis, LABEL, CM_upward, CM_inclusive,
                                   CM_segment_bit, start[axis]);
            CM_scan_with_u_min_1L (label, label, axis, LABEL, CM_downward, CM_inclusive,
                                   CM_segment_bit, start[axis]);
        }
        CM_u_move_1L (least, label, LABEL);
        CM_send_with_u_min_1L (least, old, label, LABEL, CM_no_field);
        CM_get_1L (label, old, least, LABEL);
        CM_u_ne_1L (label, old, LABEL);
        rounds++;
    } while (CM_global_logior_test ());
    CM_set_context ();
    CM_deallocate_stack_through (old);
    return rounds;
}

/* Labels by flood fill on the front end: plain[k] is the least address in the component of
 * pixel k. */
int flood (ink, address, plain, height, width)
    unsigned char *ink;
    unsigned int *address, *plain;
    int height, width;
{
    static int down[4] = { -1, 1, 0, 0 }, across[4] = { 0, 0, -1, 1 };
    int *queue = (int *) malloc (height * width * sizeof (int));
    char *seen = calloc (height * width, 1);
    int k, i, n, next, head, tail, row, column, pieces = 0;
    unsigned int least;

    for (k = 0; k < height * width; k++) {
        if (!ink[k] || seen[k])
            continue;
        pieces++;
        head = tail = 0;
        queue[tail++] = k;
        seen[k] = 1;
        least = address[k];
        while (head < tail) {
            i = queue[head++];
            if (address[i] < least)
                least = address[i];
            for (n = 0; n < 4; n++) {
                row = i / width + down[n];
                column = i % width + across[n];
                next = row * width + column;
                if (row >= 0 && column >= 0 && row < height && column < width && ink[next]
                    && !seen[next]) {
                    seen[next] = 1;
                    queue[tail++] = next;
                }
            }
        }
        for (i = 0; i < tail; i++)
            plain[queue[i]] = least;
    }
    free (queue);
    free (seen);
    return pieces;
}

int main (argc, argv)
    int argc;
    char **argv;
{
    int seed, height, width, k, rounds, pieces, wrong = 0;
    unsigned int *label, *address, *plain, mixed;
    unsigned char *ink, *picture;
    CM_field_id_t ink_field, label_field, noise;

    seed = argc > 1 ? atoi (argv[1]) : 1;
    height = argc > 3 ? atoi (argv[2]) : 384;
    width = argc > 3 ? atoi (argv[3]) : 512;
    if (height < 1 || width < 1) {
        fprintf (stderr, "usage: components [seed [height width]]\n");
        return 2;
    }
    CM_init ();
    sizes[0] = height;
    sizes[1] = width;
    CM_set_vp_set (CM_allocate_vp_set (CM_create_geometry (sizes, 2)));
    ink_field = CM_allocate_heap_field (1);
    label_field = CM_allocate_heap_field (LABEL);
    noise = CM_allocate_stack_field (16);
    CM_set_context ();
    CM_initialize_random_generator (seed);
    CM_u_random_1L (noise, 16, 0);
    CM_u_lt_constant_1L (noise, INK, 16);
    CM_store_test (ink_field);

    label = (unsigned int *) malloc (height * width * sizeof (int));
    address = (unsigned int *) malloc (height * width * sizeof (int));
    plain = (unsigned int *) malloc (height * width * sizeof (int));
    ink = (unsigned char *) malloc (height * width);
    picture = (unsigned char *) calloc (height * width, 3);
    CM_u_move_zero_1L (label_field, LABEL);
    CM_my_send_address (label_field);
    CM_u_read_from_news_array_1L (address, zero, zero, sizes, axes, label_field, LABEL, 2, sizes,
                                  CM_32_bit);
    rounds = find_labels (label_field, ink_field);
    CM_u_read_from_news_array_1L (label, zero, zero, sizes, axes, label_field, LABEL, 2, sizes,
                                  CM_32_bit);
    CM_u_read_from_news_array_1L (ink, zero, zero, sizes, axes, ink_field, 1, 2, sizes, CM_8_bit);
    for (k = 0; k < height * width; k++) {
        if (!ink[k])
            continue;
        mixed = label[k] * 2654435761u;
        picture[3 * k] = 64 + (mixed >> 24) * 3 / 4;
        picture[3 * k + 1] = 64 + (mixed >> 16 & 255) * 3 / 4;
        picture[3 * k + 2] = 64 + (mixed >> 8 & 255) * 3 / 4;
    }
    write_picture ("components.ppm", picture, width, height, 3);

    pieces = flood (ink, address, plain, height, width);
    for (k = 0; k < height * width; k++)
        wrong += ink[k] && label[k] != plain[k];
    printf ("%d pieces, found in %d rounds\n", pieces, rounds);
    printf ("same as a flood fill: %s\n", wrong ? "no" : "yes");
    return wrong != 0;
}
