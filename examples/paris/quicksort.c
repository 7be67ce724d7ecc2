/* quicksort.c - quicksort of all parts at the same time, a processor for each key.
 *
 *     lutetia cc quicksort.c -o quicksort && ./quicksort [number of keys]
 *
 * Shows: segments.  Every part that is still to be sorted is a segment of the only axis, and
 * each call works on all segments at once.  The first key of a segment, the pivot, is copied to
 * the others.  Each key is less, equal or greater, counts the keys of its kind before it, and
 * is sent to its place.  A new segment starts where one kind ends and the next begins.  The
 * loop ends when every key is at most its right neighbour: after as many rounds as the
 * recursion would be deep.  Compared with qsort. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cm/paris.h>

#define KEY 32
#define KIND 2   /* 0: less than the pivot, 1: equal, 2: greater */
#define PLACE 32

static int counts[1], zero[1], axis[1];
static CM_field_id_t start; /* 1: a segment begins here */

/* Copies the value of each segment's last processor to the whole segment. */
void from_last (dest, source)
    CM_field_id_t dest, source;
{
    CM_scan_with_copy_1L (dest, source, 0, PLACE, CM_downward, CM_inclusive, CM_segment_bit, start);
}

int sorted (key, side)
    CM_field_id_t key, side;
{
    int yes;

    CM_my_news_coordinate_1L (side, 0, PLACE);
    CM_u_lt_constant_1L (side, counts[0] - 1, PLACE);
    CM_logand_context_with_test ();
    CM_get_from_news_1L (side, key, 0, CM_upward, KEY);
    CM_u_gt_1L (key, side, KEY);
    yes = !CM_global_logior_test ();
    CM_set_context ();
    return yes;
}

int quicksort (key)
    CM_field_id_t key; /* KEY bits, then KIND bits for this function */
{
    CM_field_id_t kind = CM_add_offset_to_field_id (key, KEY), pivot, base, place, total, address;
    int k, rounds = 0;

    start = CM_allocate_stack_field (1);
    pivot = CM_allocate_stack_field (KEY);
    base = CM_allocate_stack_field (PLACE);
    place = CM_allocate_stack_field (PLACE);
    total = CM_allocate_stack_field (PLACE);
    address = CM_allocate_stack_field (PLACE);
    CM_my_news_coordinate_1L (base, 0, PLACE);
    CM_u_eq_zero_1L (base, PLACE);
    CM_store_test (start);
    while (!sorted (key, pivot)) {
        rounds++;
        CM_scan_with_copy_1L (pivot, key, 0, KEY, CM_upward, CM_inclusive, CM_segment_bit, start);
        CM_u_move_constant_1L (kind, 1, KIND);
        CM_u_lt_1L (key, pivot, KEY);
        CM_logand_context_with_test ();
        CM_u_move_constant_1L (kind, 0, KIND);
        CM_set_context ();
        CM_u_gt_1L (key, pivot, KEY);
        CM_logand_context_with_test ();
        CM_u_move_constant_1L (kind, 2, KIND);
        CM_set_context ();

        /* base: where the keys of this kind begin, the same in the whole segment */
        CM_my_news_coordinate_1L (base, 0, PLACE);
        CM_scan_with_copy_1L (base, base, 0, PLACE, CM_upward, CM_inclusive, CM_segment_bit, start);
        for (k = 0; k < 3; k++) {
            CM_u_move_zero_1L (total, PLACE);
            CM_u_eq_constant_1L (kind, k, KIND);
            CM_logand_context_with_test ();
            CM_enumerate_1L (place, 0, PLACE, CM_upward, CM_exclusive, CM_segment_bit, start);
            CM_u_add_2_1L (place, base, PLACE);
            CM_u_move_constant_1L (total, 1, PLACE);
            CM_set_context ();
            CM_scan_with_u_add_1L (total, total, 0, PLACE, CM_upward, CM_inclusive,
                                   CM_segment_bit, start);
            from_last (total, total);
            CM_u_add_2_1L (base, total, PLACE);
        }
        CM_make_news_coordinate_1L (CM_current_geometry, address, 0, place, PLACE);
        CM_send_1L (key, address, key, KEY + KIND, CM_no_field);

        CM_get_from_news_1L (place, kind, 0, CM_downward, KIND);
        CM_u_ne_1L (place, kind, KIND);
        CM_logior_test (start);
        CM_store_test (start);
    }
    CM_deallocate_stack_through (start);
    return rounds;
}

int compare (a, b)
    unsigned int *a, *b;
{
    return *a < *b ? -1 : *a > *b;
}

int main (argc, argv)
    int argc;
    char **argv;
{
    int count, i, rounds, right;
    unsigned int *keys, *result;
    CM_field_id_t key;

    count = argc > 1 ? atoi (argv[1]) : 65536;
    if (count < 1) {
        fprintf (stderr, "usage: quicksort [how many]\n");
        return 2;
    }
    counts[0] = count;
    keys = (unsigned int *) malloc (count * sizeof (int));
    result = (unsigned int *) malloc (count * sizeof (int));
    for (i = 0; i < count; i++)
        keys[i] = (unsigned int) rand () << 16 ^ rand ();
    CM_init ();
    CM_set_vp_set (CM_allocate_vp_set (CM_create_geometry (counts, 1)));
    key = CM_allocate_heap_field (KEY + KIND);
    CM_set_context ();
    CM_u_write_to_news_array_1L (keys, zero, zero, counts, axis, key, KEY, 1, counts, CM_32_bit);
    rounds = quicksort (key);
    CM_u_read_from_news_array_1L (result, zero, zero, counts, axis, key, KEY, 1, counts, CM_32_bit);
    qsort (keys, count, sizeof (int), (int (*) ()) compare);
    right = memcmp (keys, result, count * sizeof (int)) == 0;
    printf ("%d keys in %d rounds, sorted: %s\n", count, rounds, right ? "yes" : "no");
    return !right;
}
