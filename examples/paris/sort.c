/* sort.c - a million keys sorted twice, a processor for each.
 *
 *     lutetia cc sort.c -o sort && ./sort [log2 of the number of keys]
 *
 * Shows: two ways to sort.
 *
 * Bitonic: in round k, blocks of 2^k keys that rise and then fall become blocks that only rise
 * or only fall.  Each processor compares its key with that of the processor 2^(k-1) away, then
 * 2^(k-2), ... 1 (CM_get_from_power_two).  One of the two is to have the lesser key, the other
 * the greater; both take the other's key where that is not so.  No addresses are needed.
 *
 * By rank: CM_u_rank_2L gives each processor the place of its key among all; a send moves the
 * key there.
 *
 * Both are compared with the front end's qsort. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cm/paris.h>

#define KEY 32

static int counts[1], zero[1], axis[1];

/* test = bit b of the place is 1 */
void test_bit (place, b)
    CM_field_id_t place;
    int b;
{
    CM_field_id_t bit = CM_allocate_stack_field (KEY);

    CM_logand_constant_3_1L (bit, place, 1 << b, KEY);
    CM_u_ne_zero_1L (bit, KEY);
    CM_deallocate_stack_through (bit);
}

/* Sorts key; returns the number of exchanged pairs. */
double bitonic (key, bits)
    CM_field_id_t key;
    int bits;
{
    CM_field_id_t place = CM_allocate_stack_field (KEY), other = CM_allocate_stack_field (KEY);
    CM_field_id_t takes_greater = CM_allocate_stack_field (1);
    double exchanges = 0.0;
    int k, b;

    CM_my_news_coordinate_1L (place, 0, KEY);
    for (k = 1; k <= bits; k++)
        for (b = k - 1; b >= 0; b--) {
            /* Bit b of the place: the upper one of a pair.  Bit k: the block is to fall. */
            CM_get_from_power_two_1L (other, key, 0, b, CM_upward, KEY);
            test_bit (place, b);
            CM_store_test (takes_greater);
            CM_load_context (takes_greater);
            CM_get_from_power_two_1L (other, key, 0, b, CM_downward, KEY);
            CM_set_context ();
            test_bit (place, k);
            CM_logxor_test (takes_greater);
            CM_store_test (takes_greater);

            CM_u_ne_1L (key, other, KEY);
            CM_logand_context_with_test ();
            CM_u_gt_1L (key, other, KEY);
            CM_logxor_test (takes_greater);
            CM_logand_context_with_test ();
            CM_u_move_1L (key, other, KEY);
            exchanges += CM_global_count_context () / 2;
            CM_set_context ();
        }
    CM_deallocate_stack_through (place);
    return exchanges;
}

void by_rank (key, bits)
    CM_field_id_t key;
    int bits;
{
    CM_field_id_t rank = CM_allocate_stack_field (bits), address = CM_allocate_stack_field (KEY);

    CM_u_rank_2L (rank, key, 0, bits, KEY, CM_upward, CM_none, CM_no_field);
    CM_make_news_coordinate_1L (CM_current_geometry, address, 0, rank, bits);
    CM_send_1L (key, address, key, KEY, CM_no_field);
    CM_deallocate_stack_through (rank);
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
    int bits, count, way, i, right = 1;
    unsigned int *keys, *sorted;
    CM_field_id_t key;

    bits = argc > 1 ? atoi (argv[1]) : 20;
    if (bits < 1 || bits > 24) {
        fprintf (stderr, "usage: sort [bits], for 2^bits keys, bits from 1 to 24\n");
        return 2;
    }
    count = counts[0] = 1 << bits;
    keys = (unsigned int *) malloc (count * sizeof (int));
    sorted = (unsigned int *) malloc (count * sizeof (int));
    for (i = 0; i < count; i++)
        keys[i] = (unsigned int) rand () << 16 ^ rand ();

    CM_init ();
    CM_set_vp_set (CM_allocate_vp_set (CM_create_geometry (counts, 1)));
    key = CM_allocate_heap_field (KEY);
    CM_set_context ();
    for (way = 0; way < 2; way++) {
        CM_u_write_to_news_array_1L (keys, zero, zero, counts, axis, key, KEY, 1, counts,
                                     CM_32_bit);
        if (way == 0)
            printf ("%.0f exchanges\n", bitonic (key, bits));
        else
            by_rank (key, bits);
        CM_u_read_from_news_array_1L (sorted, zero, zero, counts, axis, key, KEY, 1, counts,
                                      CM_32_bit);
        if (way == 0)
            qsort (keys, count, sizeof (int), (int (*) ()) compare);
        i = memcmp (keys, sorted, count * sizeof (int)) == 0;
        printf ("%d keys %s, sorted: %s\n", count, way ? "by rank" : "bitonic", i ? "yes" : "no");
        right = right && i;
    }
    return !right;
}
