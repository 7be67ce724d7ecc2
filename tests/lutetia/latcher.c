/* latcher.c - a C/Paris program that shows lights: the diagonal of a set of 64x64, then a
 * chequered board.
 *
 *     latcher FILE end     latches both, a moment apart, and ends
 *     latcher FILE wait    latches both and waits for a signal; from the first latch on, FILE
 *                          holds its pid */
#include <cm/paris.h>

#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

int main(int argc, char **argv)
{
    unsigned int sizes[2] = {64, 64};
    if (argc != 3)
        return 2;
    CM_init();
    CM_set_vp_set(CM_allocate_vp_set(CM_create_geometry(sizes, 2)));
    CM_field_id_t row = CM_allocate_heap_field(8), column = CM_allocate_heap_field(8);
    CM_field_id_t bit = CM_allocate_heap_field(1);
    CM_my_news_coordinate_1L(row, 0, 8);
    CM_my_news_coordinate_1L(column, 1, 8);
    CM_set_context();
    CM_u_eq_1L(row, column, 8);
    CM_store_test(bit);
    CM_latch_leds(bit);
    FILE *file = fopen(argv[1], "w");
    if (!file)
        return 3;
    fprintf(file, "%ld\n", (long)getpid());
    fclose(file);
    usleep(50000);
    CM_logxor_2_1L(row, column, 8);
    CM_latch_leds_always(row);
    puts("both");
    fflush(stdout);
    while (strcmp(argv[2], "wait") == 0)
        pause();
    return 0;
}
