/* types.c - the types of values. Numbers of other formats are converted by kernels/soft.cl,
 * compiled as C. */
#include "base/types.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#include "soft.cl"
#pragma GCC diagnostic pop

size_t machine_element_bytes(struct machine_type type)
{
    return type_bytes(type);
}

struct machine_type machine_float_type(int s, int e)
{
    if (s == 23 && e == 8)
        return MACHINE_F32;
    return s == 52 && e == 11 ? MACHINE_F64 : MACHINE_SOFT(s, e);
}

int machine_type_bits(struct machine_type type)
{
    return type_field_bits(type);
}

bool type_format_good(struct machine_type type)
{
    return type.kind == MACHINE_FLOAT && type.width == 64 && type.s >= 1 && type.s <= 52 &&
           type.e >= 2 && type.e <= 11;
}

uint64_t type_rounded(uint64_t x, struct machine_type type)
{
    return soft_fit(x, type.s, type.e);
}

uint64_t type_packed_bits(uint64_t x, struct machine_type type)
{
    return soft_pack(x, type.s, type.e);
}

uint64_t type_unpacked_bits(uint64_t x, struct machine_type type)
{
    return soft_unpack(x, type.s, type.e);
}
