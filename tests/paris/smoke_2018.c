/* Includes the header of C/Paris in strict C17 with -Wpedantic. It must compile without a
 * warning, and returns 0 when all is right. */
#include <cm/paris.h>

#include <stdio.h>

int main(void)
{
    const unsigned int dimensions[3] = {3, 5, 7};
    CM_init();
    CM_set_safety_mode(1);
    CM_geometry_id_t geometry = CM_create_geometry((CM_vector_t){.unsigneds = dimensions}, 3);
    CM_set_vp_set(CM_allocate_vp_set(geometry));
    CM_field_id_t wide = CM_allocate_stack_field(128);
    CM_u_move_constant_1L(wide, 0xfedcba9876543210ul, 128);
    CM_u_multiply_constant_2_1L(wide, 3, 128);
    CM_field_id_t high = CM_add_offset_to_field_id(wide, 64);
    int wrong = CM_u_read_from_processor_1L(4, high, 64) != 2;
    CM_timer_clear(0);
    CM_timer_start(0);
    CM_timer_stop(0);
    wrong |= CM_timer_read_elapsed(0) < 0;
    printf("smoke_2018: %s\n", wrong ? "wrong" : "all right");
    return wrong;
}
