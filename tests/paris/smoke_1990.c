/* clang-format off */
/* A program in the style of 1990: K&R definitions, implicit int, field ids in ints, names
 * pasted by macros. It must compile with -std=gnu89 -Wall without a warning, by gcc and clang.
 * It returns 0 when all is right. */
#include <stdio.h>
#include <stdlib.h>
#include <cm/paris.h>

#define WIDTH 24
#define HEIGHT 10
#define SIG_EXP 23, 8
#define GLUE3(a, b, c) a##b##c
#define MAKE_ADD(name, type, lengths)                                   \
    void name (dest, source)                                            \
        int dest, source;                                               \
    {                                                                   \
        GLUE3 (CM, type, add_2_1L) (dest, source, lengths);             \
    }

MAKE_ADD (add_bytes, _u_, 8)
MAKE_ADD (add_floats, _f_, SIG_EXP)

static int failures = 0;

static void check (what, right)
    char *what;
    int right;
{
    if (!right) {
        fprintf (stderr, "wrong: %s\n", what);
        failures++;
    }
}

static int scale (field, factor)
    int field;
    float factor;
{
    CM_f_multiply_constant_2_1L (field, factor, SIG_EXP);
    return field;
}

static void picture ()
{
    unsigned char buff[WIDTH * HEIGHT], back[WIDTH * HEIGHT];
    int dimension_vector[2], offset_vector[2], start_vector[2], end_vector[2], axis_vector[2];
    int i, byte;

    for (i = 0; i < WIDTH * HEIGHT; i++)
        buff[i] = i;
    dimension_vector[0] = HEIGHT;
    dimension_vector[1] = WIDTH;
    offset_vector[0] = offset_vector[1] = 0;
    start_vector[0] = start_vector[1] = 0;
    end_vector[0] = HEIGHT;
    end_vector[1] = WIDTH;
    axis_vector[0] = 0;
    axis_vector[1] = 1;

    byte = CM_allocate_stack_field (8);
    CM_u_write_to_news_array_1L (buff, offset_vector, start_vector, end_vector, axis_vector,
                                 byte, 8, 2, dimension_vector, 1);
    CM_get_from_news_1L (byte, byte, 1, 0, 8);
    CM_u_read_from_news_array_1L (back, offset_vector, start_vector, end_vector, axis_vector,
                                  byte, 8, 2, dimension_vector, 1);
    check ("a byte from the right",
           back[0] == 1 && back[WIDTH - 1] == 0 && back[WIDTH] == WIDTH + 1);
    add_bytes (byte, byte);
    check ("twice a byte", CM_u_read_from_processor_1L (0, byte, 8) == 2);
    CM_deallocate_stack_through (byte);
}

main ()
{
    int geometry, vp_set, f, g, dims[2];

    CM_init ();
    check ("attached", CM_attached ());
    check ("processors", CM_physical_processors_limit > 0);
    dims[0] = HEIGHT;
    dims[1] = WIDTH;
    geometry = CM_create_geometry (dims, 2);
    vp_set = CM_allocate_vp_set (geometry);
    CM_set_vp_set (vp_set);
    CM_set_context ();

    f = CM_allocate_heap_field (32);
    g = CM_allocate_heap_field (32);
    CM_f_move_constant_1L (f, 1.5, SIG_EXP);
    CM_f_move_constant_1L (g, 0.25, SIG_EXP);
    add_floats (f, g);
    scale (f, 2.0);
    check ("a sum of floats", CM_global_f_max_1L (f, SIG_EXP) == 3.5);

    CM_my_news_coordinate_1L (g, 1, 32);
    CM_u_lt_constant_1L (g, (unsigned) 3, 32);
    CM_logand_context_with_test ();
    check ("three columns", CM_global_count_context () == 3 * HEIGHT);
    CM_u_write_to_processor (0, g, 77, 32);
    check ("one processor", CM_u_read_from_processor (0, g, 32) == 77);
    CM_set_context ();
    picture ();

    if (failures == 0)
        printf ("smoke_1990: %d processors, all right\n",
                CM_geometry_total_processors (geometry));
    return failures != 0;
}
