/* works_common_paris.c - see works_paris.h. */
#include "works_paris.h"

void work_part_make(const struct work_paris *p, CM_field_id_t dest, unsigned int shift)
{
    CM_f_u_float_2_2L(dest, p->in + shift, 12, S, E);
    CM_f_multiply_constant_2_1L(dest, 1.0 / 4096, S, E);
}

uint32_t work_paris_weighed(CM_field_id_t x, CM_field_id_t odd)
{
    CM_u_multiply_2_1L(x, odd, WORD);
    return CM_global_u_add_1L(x, WORD);
}
