/* painter.c - a C/Paris program that writes to displays: an 8 bit one of 40x30 with five
 * pictures of columns and rows, the last of them seen by a spin; and one of 24 bits, 21x17, if
 * it is asked for.
 *
 *     painter FILE end|wait|leave [two]     once all is shown, FILE holds its pid; `leave`: the
 *                                           display is detached, too */
#include <cm/cmfb.h>

#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

int main(int argc, char **argv)
{
    unsigned int sizes[2] = {30, 40};
    if (argc < 3)
        return 2;
    CM_init();
    CM_set_vp_set(CM_allocate_vp_set(CM_create_geometry(sizes, 2)));
    CM_field_id_t row = CM_allocate_heap_field(24), column = CM_allocate_heap_field(24);
    CM_my_news_coordinate_1L(row, 0, 24);
    CM_my_news_coordinate_1L(column, 1, 24);
    CMFB_display_id_t display = CMFB_attach_display("");
    CMFB_initialize_display(display, 8, 40, 30);
    for (int i = 0; i < 4; i++) {
        CM_u_add_2_1L(row, column, 8);
        CMFB_write_news_always(display, 0, row, 0, 0);
        usleep(10000);
    }
    CM_u_multiply_constant_2_1L(column, 6, 8);
    CMFB_write_news_always(display, 1, column, 0, 0);
    CMFB_spin(display);
    if (argc > 3) {
        CMFB_display_id_t second = CMFB_attach_display("second");
        CMFB_initialize_display(second, 24, 21, 17);
        CM_u_multiply_constant_2_1L(column, 1111, 24);
        CMFB_write_news_always(second, 0, column, 0, 0);
    }
    if (strcmp(argv[2], "leave") == 0)
        CMFB_detach_display(display);
    FILE *file = fopen(argv[1], "w");
    if (!file)
        return 3;
    fprintf(file, "%ld\n", (long)getpid());
    fclose(file);
    while (strcmp(argv[2], "wait") == 0)
        pause();
    return 0;
}
