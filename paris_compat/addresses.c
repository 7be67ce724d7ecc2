/* Send addresses and NEWS coordinates on the front end. */
#include "paris_state.h"

static uint64_t axis_stride(const struct paris_geometry *g, unsigned int axis)
{
    uint64_t stride = 1;
    for (int i = g->rank - 1; i > (int)axis; i--)
        stride *= (uint64_t)g->dimensions[i];
    return stride;
}

static bool axis_good(const struct paris_geometry *g, unsigned int axis)
{
    if (g && axis < (unsigned int)g->rank)
        return true;
    if (g)
        paris_fail("axis: must be 0..%d in this geometry (got %d)", g->rank - 1, (int)axis);
    return false;
}

static bool coordinate_good(const struct paris_geometry *g, unsigned int axis,
                            unsigned int *coordinate)
{
    unsigned int length = (unsigned int)g->dimensions[axis];
    if (*coordinate < length)
        return true;
    if (paris_let_pass("coordinate: must be 0..%u on axis %u; %u is taken modulo", length - 1,
                       axis, *coordinate)) {
        *coordinate %= length;
        return true;
    }
    paris_fail("coordinate: must be 0..%d on axis %u (got %d)", g->dimensions[axis] - 1, axis,
               (int)*coordinate);
    return false;
}

static bool address_index(const struct paris_geometry *g, unsigned int send_address,
                          uint64_t *index)
{
    *index = paris_index_let_pass(g, send_address);
    if (*index != UINT64_MAX)
        return true;
    paris_fail("send_address: there is no processor %u in this geometry of %llu", send_address,
               (unsigned long long)g->count);
    return false;
}

unsigned int CM_fe_make_news_coordinate(CM_geometry_id_t geometry, unsigned int axis,
                                        unsigned int coordinate)
{
    paris_the.call = "CM_fe_make_news_coordinate";
    const struct paris_geometry *g = paris_geometry_of(geometry);
    if (!axis_good(g, axis) || !coordinate_good(g, axis, &coordinate))
        return 0;
    return (unsigned int)paris_address_of_index(g, coordinate * axis_stride(g, axis));
}

unsigned int CM_fe_deposit_news_coordinate(CM_geometry_id_t geometry, unsigned int send_address,
                                           unsigned int axis, unsigned int coordinate)
{
    paris_the.call = "CM_fe_deposit_news_coordinate";
    const struct paris_geometry *g = paris_geometry_of(geometry);
    uint64_t index;
    if (!axis_good(g, axis) || !coordinate_good(g, axis, &coordinate) ||
        !address_index(g, send_address, &index))
        return 0;
    uint64_t stride = axis_stride(g, axis);
    uint64_t old = index / stride % (uint64_t)g->dimensions[axis];
    return (unsigned int)paris_address_of_index(g, index - old * stride + coordinate * stride);
}

unsigned int CM_fe_extract_news_coordinate(CM_geometry_id_t geometry, unsigned int axis,
                                           unsigned int send_address)
{
    paris_the.call = "CM_fe_extract_news_coordinate";
    const struct paris_geometry *g = paris_geometry_of(geometry);
    uint64_t index;
    if (!axis_good(g, axis) || !address_index(g, send_address, &index))
        return 0;
    return (unsigned int)(index / axis_stride(g, axis) % (uint64_t)g->dimensions[axis]);
}

unsigned int CM_fe_to_gray_code(unsigned int value)
{
    return value ^ value >> 1;
}

unsigned int CM_fe_from_gray_code(unsigned int code)
{
    for (unsigned int shift = 1; shift < 32; shift *= 2)
        code ^= code >> shift;
    return code;
}

/* ---- on the machine ---- */

unsigned int paris_address_room(struct machine *m, CM_field_id_t dest, unsigned int bits)
{
    struct machine_field_info info;
    if (bits >= 32 || !machine_field_lookup(m, dest, &info) || info.bits - info.offset < 32)
        return bits;
    struct machine_value *above =
        machine_field_value(m, dest + bits, MACHINE_UINT(32 - bits), MACHINE_EVERYWHERE);
    return above && machine_value_is_zero(above) ? 32 : bits;
}

static void my_send_address(const char *name, CM_field_id_t dest, enum machine_scope scope)
{
    struct machine *m = paris_begin(name);
    const struct paris_geometry *g = paris_geometry_current();
    unsigned int bits = paris_address_room(m, dest, paris_address_bits(g));
    paris_store(m, paris_u(dest, bits), machine_self_address(m, (int)bits), scope);
}

void CM_my_send_address(CM_field_id_t dest)
{
    my_send_address("CM_my_send_address", dest, MACHINE_WHERE_ACTIVE);
}

void CM_my_send_address_always(CM_field_id_t dest)
{
    my_send_address("CM_my_send_address_always", dest, MACHINE_EVERYWHERE);
}

void paris_my_coordinate(const struct paris_instruction *self, CM_field_id_t dest,
                         unsigned int axis, unsigned int len)
{
    struct machine *m = paris_begin(self->name);
    struct machine_type type;
    if (paris_check_axis(axis) && paris_type(paris_u(dest, len), "dest", &type))
        paris_store(m, paris_u(dest, len), machine_coordinate(m, (int)axis, (int)len),
                    self->scope);
}
