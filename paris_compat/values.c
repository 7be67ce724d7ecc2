/* Integers of several lengths, for several families. NULL arguments give NULL results: the
 * machine has recorded the error. */
#include "paris_state.h"

struct machine_value *paris_number(struct machine *m, int width, int64_t x)
{
    return machine_constant(m, MACHINE_UINT(width), scalar_signed(x));
}

struct machine_value *paris_resize(struct machine *m, struct machine_value *v,
                                   unsigned int width, bool is_signed)
{
    if (!v || machine_value_type(v).width == width)
        return v;
    return machine_resize(m, v, (int)width, is_signed);
}

struct machine_value *paris_lost(struct machine *m, struct machine_value *v, unsigned int len,
                                 bool is_signed)
{
    if (!v)
        return NULL;
    unsigned int width = machine_value_type(v).width;
    if (width <= len)
        return paris_number(m, 1, 0);
    struct machine_value *kept = paris_resize(m, v, len, is_signed);
    return machine_binary(m, MACHINE_NE, v, paris_resize(m, kept, width, is_signed));
}

struct machine_value *paris_absolute(struct machine *m, struct machine_value *x)
{
    struct machine_value *sign = machine_extract(m, x, machine_value_type(x).width - 1, 1);
    return machine_select(m, sign, machine_unary(m, MACHINE_NEG, x), x);
}
