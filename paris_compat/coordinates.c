/* Computes send addresses from coordinates, and coordinates from send addresses, in the
 * processors, for any geometry.
 *
 * Computations use 64-bit integers, or 32-bit ones where no bit of the result depends on more.
 * Division by a constant is a multiplication: for n < 2^31 and a divisor d, with k = 31 + the
 * least s for which d <= 2^s, n / d is n * (2^k / d
 * + 1) >> k.
 */
#include "paris_state.h"

enum { WIDTH = 64 };

static struct machine_value *number(struct machine *m, uint64_t x)
{
    return machine_constant(m, MACHINE_UINT(WIDTH), (struct machine_scalar){x, 0});
}

static struct machine_value *times(struct machine *m, struct machine_value *a, uint64_t factor)
{
    return factor == 1 ? a : machine_binary(m, MACHINE_MUL, a, number(m, factor));
}

static struct machine_value *quotient(struct machine *m, struct machine_value *n, uint64_t d)
{
    int shift = 0;
    if (d == 1)
        return n;
    while (UINT64_C(1) << shift < d)
        shift++;
    int k = (d & (d - 1)) ? 31 + shift : shift;
    if (d & (d - 1))
        n = machine_binary(m, MACHINE_MUL, n, number(m, (UINT64_C(1) << k) / d + 1));
    return machine_resize(m, machine_extract(m, n, k, WIDTH - k), WIDTH, false);
}

static struct machine_value *rest(struct machine *m, struct machine_value *n, uint64_t d)
{
    if (d == 1)
        return number(m, 0);
    if ((d & (d - 1)) == 0) {
        int bits = 0;
        while (UINT64_C(1) << bits < d)
            bits++;
        return machine_resize(m, machine_resize(m, n, bits, false), WIDTH, false);
    }
    return machine_binary(m, MACHINE_SUB, n, times(m, quotient(m, n, d), d));
}

/* ---- addresses and row-major indices ---- */

static struct machine_value *index_of(struct machine *m, const struct paris_geometry *g,
                                      struct machine_value *address)
{
    if (g->layout.blocks)
        return machine_resize(
            m, machine_layout_index_value(m, &g->layout, machine_resize(m, address, 32, false)),
            WIDTH, false);
    if (g->layout.order == MACHINE_SEND_ORDER || g->ratio == 1)
        return address;
    return machine_binary(m, MACHINE_ADD, quotient(m, address, g->ratio),
                          times(m, rest(m, address, g->ratio), CM_physical_processors_limit));
}

/* The lowest 32 bits of the address of an index of at most 32 bits: the number of processors is
 * a power of two. */
static struct machine_value *short_address_of(struct machine *m, const struct paris_geometry *g,
                                              struct machine_value *index)
{
    int log2 = 0;
    while (UINT64_C(1) << log2 < CM_physical_processors_limit)
        log2++;
    if (g->layout.blocks)
        return machine_layout_address_value(m, &g->layout, index);
    if (g->layout.order == MACHINE_SEND_ORDER || g->ratio == 1)
        return index;
    if (log2 == 0 || log2 >= 32) /* all are its virtual ones, or it has none */
        return index;
    struct machine_value *vp =
        machine_resize(m, machine_extract(m, index, log2, 32 - log2), 32, false);
    struct machine_value *processor =
        machine_resize(m, machine_resize(m, index, log2, false), 32, false);
    struct machine_value *ratio =
        machine_constant(m, MACHINE_UINT(32), (struct machine_scalar){g->ratio, 0});
    return machine_binary(m, MACHINE_ADD, vp, machine_binary(m, MACHINE_MUL, processor, ratio));
}

static struct machine_value *address_of(struct machine *m, const struct paris_geometry *g,
                                        struct machine_value *index)
{
    if (g->layout.blocks)
        return machine_resize(
            m, machine_layout_address_value(m, &g->layout, machine_resize(m, index, 32, false)),
            WIDTH, false);
    if (g->layout.order == MACHINE_SEND_ORDER || g->ratio == 1)
        return index;
    return machine_binary(m, MACHINE_ADD, quotient(m, index, CM_physical_processors_limit),
                          times(m, rest(m, index, CM_physical_processors_limit), g->ratio));
}

static uint64_t stride_of(const struct paris_geometry *g, unsigned int axis)
{
    uint64_t stride = 1;
    for (int i = g->rank - 1; i > (int)axis; i--)
        stride *= (uint64_t)g->dimensions[i];
    return stride;
}

static struct machine_value *coordinate_of(struct machine *m, const struct paris_geometry *g,
                                           struct machine_value *index, unsigned int axis)
{
    struct machine_value *n = quotient(m, index, stride_of(g, axis));
    return axis == 0 ? n : rest(m, n, (uint64_t)g->dimensions[axis]);
}

/* ---- operands ---- */

static const struct paris_geometry *geometry_of(CM_geometry_id_t id, unsigned int axis)
{
    const struct paris_geometry *g = paris_geometry_of(id);
    if (g && axis >= (unsigned int)g->rank) {
        paris_fail("axis: must be 0..%d in this geometry (got %d)", g->rank - 1, (int)axis);
        return NULL;
    }
    return g;
}

static struct machine_value *load(struct machine *m, CM_field_id_t field, unsigned int len,
                                  const char *role, int width)
{
    if (len > 32) {
        paris_fail("%s: length must be 1..32 bits (got %u)", role, len);
        return NULL;
    }
    struct machine_value *v = paris_load(m, paris_u(field, len), role, MACHINE_WHERE_ACTIVE);
    return v ? machine_resize(m, v, width, false) : NULL;
}

static struct machine_value *load_address(struct machine *m, const struct paris_geometry *g,
                                          CM_field_id_t field)
{
    return load(m, field, paris_address_bits(g), "send_address", WIDTH);
}

static void store_address(struct machine *m, const struct paris_instruction *self,
                          const struct paris_geometry *g, CM_field_id_t dest,
                          struct machine_value *address)
{
    unsigned int bits = paris_address_room(m, dest, paris_address_bits(g));
    paris_store(m, paris_u(dest, bits), machine_resize(m, address, (int)bits, false),
                self->scope);
}

/* ---- the instructions ---- */

void paris_coordinate_make(const struct paris_instruction *self, CM_geometry_id_t geometry,
                           CM_field_id_t dest, unsigned int axis, CM_field_id_t coordinate,
                           unsigned int slen)
{
    struct machine *m = paris_begin(self->name);
    const struct paris_geometry *g = geometry_of(geometry, axis);
    uint64_t stride = g ? stride_of(g, axis) : 0;
    struct machine_value *v =
        g ? load(m, coordinate, slen, "coordinate", stride == 1 ? 32 : WIDTH) : NULL;
    if (!v)
        return;
    struct machine_value *turned =
        g->rank == 1 ? machine_address_turned(m, &g->layout, machine_self_address(m, 32), 0, v)
                     : NULL;
    if (turned) {
        store_address(m, self, g, dest, turned);
        return;
    }
    struct machine_value *address =
        stride == 1 ? short_address_of(m, g, v) : address_of(m, g, times(m, v, stride));
    address = machine_resize(m, address, (int)paris_address_bits(g), false);
    if (g->rank == 1 && address)
        machine_layout_note(m, &g->layout, v, address);
    store_address(m, self, g, dest, address);
}

void paris_coordinate_deposit(const struct paris_instruction *self, CM_geometry_id_t geometry,
                              CM_field_id_t dest, unsigned int axis, unsigned int coordinate,
                              unsigned int slen)
{
    struct machine *m = paris_begin(self->name);
    const struct paris_geometry *g = geometry_of(geometry, axis);
    struct machine_value *v = NULL, *index = g ? load_address(m, g, dest) : NULL;
    if (!index)
        return;
    if (self->op == 0) {
        v = load(m, coordinate, slen, "coordinate", WIDTH);
    } else if (coordinate >= (unsigned int)g->dimensions[axis] &&
               !paris_let_pass("value: must be 0..%d on axis %u; %u is taken modulo",
                               g->dimensions[axis] - 1, axis, coordinate)) {
        paris_fail("value: must be 0..%d on axis %u (got %u)", g->dimensions[axis] - 1, axis,
                   coordinate);
    } else {
        v = number(m, coordinate % (unsigned int)g->dimensions[axis]);
    }
    struct machine_value *turned =
        v ? machine_address_turned(m, &g->layout, index, (int)axis, v) : NULL;
    if (turned)
        store_address(m, self, g, dest, turned);
    if (turned || !v)
        return;
    index = index_of(m, g, index);
    v = machine_binary(m, MACHINE_SUB, v, coordinate_of(m, g, index, axis));
    v = times(m, v, stride_of(g, axis));
    store_address(m, self, g, dest, address_of(m, g, machine_binary(m, MACHINE_ADD, index, v)));
}

void paris_coordinate_extract(const struct paris_instruction *self, CM_geometry_id_t geometry,
                              CM_field_id_t dest, unsigned int axis, CM_field_id_t send_address,
                              unsigned int dlen)
{
    struct machine *m = paris_begin(self->name);
    const struct paris_geometry *g = geometry_of(geometry, axis);
    struct machine_value *v = g ? load_address(m, g, send_address) : NULL;
    struct machine_type type;
    if (!v || !paris_type(paris_u(dest, dlen), "dest", &type))
        return;
    v = coordinate_of(m, g, index_of(m, g, v), axis);
    paris_store(m, paris_u(dest, dlen), machine_resize(m, v, (int)dlen, false), self->scope);
}

void CM_extract_multi_coordinate_1L(CM_geometry_id_t geometry, CM_field_id_t dest,
                                    unsigned int axis_mask, CM_field_id_t send_address,
                                    unsigned int dlen)
{
    struct machine *m = paris_begin("CM_extract_multi_coordinate_1L");
    const struct paris_geometry *g = paris_geometry_of(geometry);
    struct machine_value *v = g ? load_address(m, g, send_address) : NULL, *sum = NULL;
    struct machine_type type;
    if (!v || !paris_type(paris_u(dest, dlen), "dest", &type))
        return;
    v = index_of(m, g, v);
    for (unsigned int axis = 0; axis < (unsigned int)g->rank; axis++)
        if (axis_mask >> axis & 1) {
            struct machine_value *c = coordinate_of(m, g, v, axis);
            sum = sum ? machine_binary(m, MACHINE_ADD,
                                       times(m, sum, (uint64_t)g->dimensions[axis]), c)
                      : c;
        }
    sum = sum ? sum : number(m, 0);
    paris_store(m, paris_u(dest, dlen), machine_resize(m, sum, (int)dlen, false),
                MACHINE_WHERE_ACTIVE);
}

unsigned int CM_fe_extract_multi_coordinate(CM_geometry_id_t geometry, unsigned int axis_mask,
                                            unsigned int send_address)
{
    paris_the.call = "CM_fe_extract_multi_coordinate";
    const struct paris_geometry *g = paris_geometry_of(geometry);
    uint64_t sum = 0, index = g ? paris_index_let_pass(g, send_address) : 0;
    if (!g)
        return 0;
    if (index == UINT64_MAX) {
        paris_fail("send_address: there is no processor %u in this geometry of %llu",
                   send_address, (unsigned long long)g->count);
        return 0;
    }
    for (unsigned int axis = 0; axis < (unsigned int)g->rank; axis++)
        if (axis_mask >> axis & 1)
            sum = sum * (uint64_t)g->dimensions[axis] +
                  index / stride_of(g, axis) % (uint64_t)g->dimensions[axis];
    return (unsigned int)sum;
}
