/* screens.c - Life on one display, and what it leaves behind on another.
 *
 *     lutetia cc screens.c -o screens && lutetia display ./screens [generations [height width]]
 *
 * The first display has 8 bits: cells that live are bright, those that died fade.  The second
 * one has 24 bits: red counts the generations that a cell has lived, green its births.
 *
 * Shows: two displays of one program, one twice as large as its picture by the zoom.  Every
 * generation that a cell lived is counted twice, on the machine cell by cell and by the front
 * end as a sum. */
#include <stdio.h>
#include <stdlib.h>
#include <cm/cmfb.h>

static int sizes[2];
static CM_field_id_t alive, count, side, glow, lived, image;

void generation ()
{
    int axis;

    CM_u_move_1L (count, alive, 4);
    for (axis = 0; axis < 2; axis++) {          /* sums of three, and then of nine */
        CM_get_from_news_1L (side, count, axis, CM_upward, 4);
        CM_get_from_news_1L (side + 4, count, axis, CM_downward, 4);
        CM_u_add_2_1L (count, side, 4);
        CM_u_add_2_1L (count, side + 4, 4);
    }
    CM_u_add_2_1L (count, alive, 4);            /* 3 with itself: stays; 5, 6, 7: others */
    CM_u_move_1L (side, alive, 4);              /* what was */
    CM_u_move_zero_1L (alive, 4);
    CM_u_subtract_2_1L (count, side, 4);
    CM_u_eq_constant_1L (count, 3, 4);
    CM_logand_context_with_test ();
    CM_u_move_constant_1L (alive, 1, 4);        /* three in the nine */
    CM_set_context ();
    CM_u_eq_constant_1L (count, 4, 4);
    CM_logand_context_with_test ();
    CM_u_move_1L (alive, side, 4);              /* four: as it was */
    CM_set_context ();
}

void colour ()
{
    CM_u_subtract_constant_2_1L (glow, 3, 8);   /* fades, to 0 at last */
    CM_load_test (glow + 7);                    /* bit 7: above 127, or below zero */
    CM_u_gt_constant_1L (glow, 220, 8);
    CM_logand_context_with_test ();
    CM_u_move_zero_1L (glow, 8);
    CM_set_context ();
    CM_u_eq_constant_1L (alive, 1, 4);
    CM_logand_context_with_test ();
    CM_u_move_constant_1L (glow, 220, 8);
    CM_u_add_constant_2_1L (lived, 1, 32);
    CM_u_lt_constant_1L (image, 254, 8);
    CM_logand_context_with_test ();
    CM_u_add_constant_2_1L (image, 2, 8);
    CM_u_eq_zero_1L (side, 4);                  /* it is new */
    CM_logand_context_with_test ();
    CM_u_lt_constant_1L (image + 8, 246, 8);
    CM_logand_context_with_test ();
    CM_u_add_constant_2_1L (image + 8, 9, 8);
    CM_set_context ();
}

int main (argc, argv)
    int argc;
    char **argv;
{
    int generations, height, width, i, right;
    unsigned int all = 0;
    CMFB_display_id_t cells, traces;

    generations = argc > 1 ? atoi (argv[1]) : 300;
    height = argc > 3 ? atoi (argv[2]) : 160;
    width = argc > 3 ? atoi (argv[3]) : 240;
    if (generations < 0 || height < 8 || width < 8) {
        fprintf (stderr, "usage: screens [generations [height width]], at least 8 by 8 cells\n");
        return 2;
    }
    CM_init ();
    cells = CMFB_attach_display ("cells");
    CMFB_initialize_display (cells, 8, width * 2, height * 2);
    CMFB_set_zoom (cells, 2, 2);
    traces = CMFB_attach_display ("traces");
    CMFB_initialize_display (traces, 24, width, height);
    sizes[0] = height;
    sizes[1] = width;
    CM_set_vp_set (CM_allocate_vp_set (CM_create_geometry (sizes, 2)));
    CM_set_context ();
    alive = CM_allocate_stack_field (4);
    count = CM_allocate_stack_field (4);
    side = CM_allocate_stack_field (8);
    glow = CM_allocate_stack_field (8);
    lived = CM_allocate_stack_field (32);
    image = CM_allocate_stack_field (24);
    CM_u_move_zero_1L (glow, 8);
    CM_u_move_zero_1L (lived, 32);
    CM_u_move_zero_1L (image, 24);
    CM_u_move_zero_1L (alive, 4);
    CM_u_random_1L (glow, 8, 4);                /* a quarter lives */
    CM_u_eq_zero_1L (glow, 8);
    CM_logand_context_with_test ();
    CM_u_move_constant_1L (alive, 1, 4);
    CM_set_context ();
    CM_u_move_zero_1L (glow, 8);
    for (i = 0; i < generations; i++) {
        generation ();
        colour ();
        CMFB_write_news_always (cells, 0, glow, 0, 0);
        CMFB_write_news_always (traces, 0, image, 0, 0);
        all += CM_global_u_add_1L (alive, 4);
    }
    right = all == CM_global_u_add_1L (lived, 32);
    printf ("%u lives are counted by both: %s\n", all, right ? "yes" : "no");
    return !right;
}
