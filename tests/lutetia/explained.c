/* explained.c - a program whose kernels and bytes are known by hand, for test_explain.py.
 *
 *     explained N          N times: water += flow, then a read of one processor
 *     explained forever    the same until it is killed; prints "running" after the first read
 *     explained nothing    makes no machine
 *     explained twice      a step on one machine, and a step on another
 *
 * A step is one kernel that reads 8 bytes and writes 4 for each of 32 x 512 processors, with
 * one operation. The first read compiles it. Written in C of 1990, for `lutetia cc`. */
#include <cm/paris.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ROWS = 32, COLUMNS = 512 };

static CM_field_id_t water, flow;

static void begin(void)
{
    static float first[ROWS * COLUMNS], second[ROWS * COLUMNS];
    int sizes[2] = {ROWS, COLUMNS}, zero[2] = {0, 0}, axes[2] = {0, 1}, i;
    for (i = 0; i < ROWS * COLUMNS; i++) {
        first[i] = (float)(i % 100);
        second[i] = 0.5f;
    }
    CM_init();
    CM_set_vp_set(CM_allocate_vp_set(CM_create_geometry(sizes, 2)));
    water = CM_allocate_heap_field(32);
    flow = CM_allocate_heap_field(32);
    CM_set_context();
    CM_f_write_to_news_array_1L(first, zero, zero, sizes, axes, water, 23, 8, 2, sizes,
                                CM_float_single);
    CM_f_write_to_news_array_1L(second, zero, zero, sizes, axes, flow, 23, 8, 2, sizes,
                                CM_float_single);
}

static double step(void)
{
    CM_f_add_2_1L(water, flow, 23, 8);
    return CM_f_read_from_processor_1L(0, water, 23, 8);
}

int main(int argc, char **argv)
{
    const char *mode = argc > 1 ? argv[1] : "1";
    double seen;
    int i;
    if (strcmp(mode, "nothing") == 0)
        return 0;
    begin();
    seen = step();
    if (strcmp(mode, "forever") == 0) {
        puts("running");
        fflush(stdout);
        for (;;)
            step();
    }
    if (strcmp(mode, "twice") == 0) {
        CM_detach();
        begin();
        seen = step();
    }
    for (i = 1; i < atoi(mode); i++)
        seen = step();
    printf("water %.1f\n", seen);
    return argc > 2 ? atoi(argv[2]) : 0;
}
