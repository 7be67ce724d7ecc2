/* Scans, spreads, reductions and ranks: rows of the families combine and rank, and instructions
 * that count.
 *
 * Context. Inactive processors neither take part nor change; overflow does not change. Bit
 * fields of any length are combined in pieces.
 */
#include "paris_state.h"

/* ---- checks ---- */

static bool direction_good(unsigned int direction)
{
    if (direction <= CM_downward)
        return true;
    paris_fail("direction: must be CM_upward (0) or CM_downward (1) (got %d)", (int)direction);
    return false;
}

/* Fills in the segments of a scan. */
static bool segments_load(struct machine *m, unsigned int smode, CM_field_id_t sbit,
                          struct machine_scan *how)
{
    static const enum machine_segments modes[] = {[CM_none] = MACHINE_UNSEGMENTED,
                                                  [CM_start_bit] = MACHINE_START_BIT,
                                                  [CM_segment_bit] = MACHINE_SEGMENT_BIT};
    if (smode > CM_segment_bit) {
        paris_fail(
            "smode: must be CM_none (0), CM_start_bit (1) or CM_segment_bit (2) (got %d)",
            (int)smode);
        return false;
    }
    how->segments = modes[smode];
    how->bits = NULL;
    if (smode == CM_none)
        return true;
    how->bits = paris_load_bit(m, sbit, "sbit", MACHINE_EVERYWHERE);
    return how->bits != NULL;
}

static bool scan_load(struct machine *m, unsigned int axis, unsigned int direction,
                      unsigned int inclusion, unsigned int smode, CM_field_id_t sbit,
                      struct machine_scan *how)
{
    if (!paris_check_axis(axis) || !direction_good(direction))
        return false;
    if (inclusion > CM_inclusive) {
        paris_fail("inclusion: must be CM_exclusive (0) or CM_inclusive (1) (got %d)",
                   (int)inclusion);
        return false;
    }
    how->axis = (int)axis;
    how->downward = direction == CM_downward;
    how->exclusive = inclusion == CM_exclusive;
    return segments_load(m, smode, sbit, how);
}

static bool coordinate_good(const char *role, unsigned int axis, unsigned int coordinate)
{
    struct machine *m = paris_the.machine;
    int length = machine_vpset_length(m, machine_vpset_current(m), (int)axis);
    if (coordinate < (unsigned int)length)
        return true;
    paris_fail("%s: must be 0..%d on axis %u (got %d)", role, length - 1, axis,
               (int)coordinate);
    return false;
}

/* ---- operands in pieces ---- */

struct pieces {
    struct paris_operand dest, source; /* the present one */
    unsigned int left, step;
};

/* Plain bits are divided into pieces; a complex number is two floats; others are one piece.
 * False: an error, which has been reported, or (length 0) nothing to do. */
static bool pieces_begin(struct pieces *p, int parts, struct paris_operand dest,
                         struct paris_operand source)
{
    struct machine_type type;
    unsigned int bits = paris_operand_bits(dest);
    struct paris_operand all_dest = paris_b(dest.field, bits * (unsigned int)parts),
                         all_source = paris_b(source.field, bits * (unsigned int)parts);
    *p = (struct pieces){dest, source, (unsigned int)parts, bits};
    if (dest.letter != 'b' && !paris_type(dest, "dest", &type))
        return false;
    if (!paris_check_operand(all_dest, "dest") || !paris_check_operand(all_source, "source") ||
        !paris_check_overlap(all_dest, all_source))
        return false;
    if (dest.letter == 'b') {
        p->step = bits <= PARIS_INTEGER_MAX ? bits : PARIS_PIECE;
        p->left = bits ? (bits - 1) / p->step + 1 : 0;
        if (p->left)
            p->dest.len = p->source.len = p->step;
    }
    return p->left > 0;
}

/* Advances to the next piece; total is the length of all plain bits. */
static bool pieces_next(struct pieces *p, unsigned int total)
{
    if (--p->left == 0)
        return false;
    p->dest.field += p->step;
    p->source.field += p->step;
    if (p->dest.letter == 'b' && p->left == 1 && total % p->step)
        p->dest.len = p->source.len = total % p->step;
    return true;
}

/* ---- families ---- */

void paris_scan(const struct paris_instruction *self, int parts, struct paris_operand dest,
                struct paris_operand source, unsigned int axis, unsigned int direction,
                unsigned int inclusion, unsigned int smode, CM_field_id_t sbit)
{
    struct machine *m = paris_begin(self->name);
    struct machine_scan how = {.op = self->op};
    struct pieces p;
    if (!scan_load(m, axis, direction, inclusion, smode, sbit, &how) ||
        !pieces_begin(&p, parts, dest, source))
        return;
    struct machine_value *v;
    do
        v = paris_load(m, p.source, "source", MACHINE_WHERE_ACTIVE);
    while (v && paris_store(m, p.dest, machine_scan(m, &how, v), MACHINE_WHERE_ACTIVE) &&
           pieces_next(&p, dest.len));
}

/* The value for all processors on a line along the axis; NULL: an error, which has been
 * reported. */
static struct machine_value *spread(struct machine *m, const struct paris_instruction *self,
                                    struct paris_operand source, unsigned int axis,
                                    unsigned int coordinate)
{
    bool copies = self->op == MACHINE_SCAN_COPY;
    struct machine_value *v =
        paris_load(m, source, "source", copies ? MACHINE_EVERYWHERE : MACHINE_WHERE_ACTIVE);
    if (!v)
        return NULL;
    v = copies ? machine_spread_coordinate(m, (int)axis, (int)coordinate, v)
               : machine_spread(m, self->op, UINT32_C(1) << axis, v);
    if (!v)
        paris_fail_machine();
    return v;
}

void paris_spread(const struct paris_instruction *self, int parts, struct paris_operand dest,
                  struct paris_operand source, unsigned int axis, unsigned int coordinate)
{
    struct machine *m = paris_begin(self->name);
    struct pieces p;
    if (!paris_check_axis(axis) || !coordinate_good("coordinate", axis, coordinate) ||
        !pieces_begin(&p, parts, dest, source))
        return;
    struct machine_value *v;
    do
        v = spread(m, self, p.source, axis, coordinate);
    while (v && paris_store(m, p.dest, v, MACHINE_WHERE_ACTIVE) && pieces_next(&p, dest.len));
}

void paris_multispread(const struct paris_instruction *self, int parts,
                       struct paris_operand dest, struct paris_operand source,
                       unsigned int axis_mask)
{
    struct machine *m = paris_begin(self->name);
    int rank = machine_vpset_rank(m, machine_vpset_current(m));
    struct pieces p;
    if (axis_mask >> rank) {
        paris_fail("axis_mask: there are only %d axes in this VP set (got 0x%x)", rank,
                   axis_mask);
        return;
    }
    if (!pieces_begin(&p, parts, dest, source))
        return;
    struct machine_value *v;
    do
        v = paris_load(m, p.source, "source", MACHINE_WHERE_ACTIVE);
    while (v &&
           paris_store(m, p.dest, machine_spread(m, self->op, axis_mask, v),
                       MACHINE_WHERE_ACTIVE) &&
           pieces_next(&p, dest.len));
}

/* Splits a row-major position among the mask's axes into coordinates on these. */
static bool multi_coordinate_split(struct machine *m, unsigned int axis_mask,
                                   unsigned int position, int *coordinates)
{
    int set = machine_vpset_current(m), rank = machine_vpset_rank(m, set);
    unsigned int left = position;
    if (axis_mask >> rank) {
        paris_fail("axis_mask: there are only %d axes in this VP set (got 0x%x)", rank,
                   axis_mask);
        return false;
    }
    for (int axis = rank - 1; axis >= 0; axis--)
        if (axis_mask >> axis & 1) {
            unsigned int length = (unsigned int)machine_vpset_length(m, set, axis);
            coordinates[axis] = (int)(left % length);
            left /= length;
        }
    if (left)
        paris_fail("multi_coordinate: there is no position %u on the axes of the mask 0x%x",
                   position, axis_mask);
    return left == 0;
}

static void multispread_copy(const char *name, CM_field_id_t dest, CM_field_id_t source,
                             unsigned int axis_mask, unsigned int len,
                             unsigned int multi_coordinate)
{
    struct machine *m = paris_begin(name);
    int rank = machine_vpset_rank(m, machine_vpset_current(m));
    int coordinates[MACHINE_AXES_MAX];
    struct pieces p;
    if (!multi_coordinate_split(m, axis_mask, multi_coordinate, coordinates) ||
        !pieces_begin(&p, 1, paris_b(dest, len), paris_b(source, len)))
        return;
    struct machine_value *v;
    do {
        v = paris_load(m, p.source, "source", MACHINE_EVERYWHERE);
        for (int axis = 0; v && axis < rank; axis++)
            if (axis_mask >> axis & 1)
                v = machine_spread_coordinate(m, axis, coordinates[axis], v);
    } while (v && paris_store(m, p.dest, v, MACHINE_WHERE_ACTIVE) && pieces_next(&p, len));
}

void CM_multispread_copy_1L(CM_field_id_t dest, CM_field_id_t source, unsigned int axis_mask,
                            unsigned int len, unsigned int multi_coordinate)
{
    multispread_copy("CM_multispread_copy_1L", dest, source, axis_mask, len, multi_coordinate);
}

void CM_multispread_with_copy_1L(CM_field_id_t dest, CM_field_id_t source,
                                 unsigned int axis_mask, unsigned int len,
                                 unsigned int multi_coordinate)
{
    multispread_copy("CM_multispread_with_copy_1L", dest, source, axis_mask, len,
                     multi_coordinate);
}

void paris_reduce(const struct paris_instruction *self, int parts, struct paris_operand dest,
                  struct paris_operand source, unsigned int axis, unsigned int to_coordinate,
                  unsigned int from_coordinate)
{
    struct machine *m = paris_begin(self->name);
    struct pieces p;
    if (!paris_check_axis(axis) || !coordinate_good("to_coordinate", axis, to_coordinate) ||
        !coordinate_good("from_coordinate", axis, from_coordinate) ||
        !pieces_begin(&p, parts, dest, source))
        return;
    struct machine_scalar number = {to_coordinate, 0};
    struct machine_value *there =
        machine_binary(m, MACHINE_EQ, machine_coordinate(m, (int)axis, 32),
                       machine_constant(m, MACHINE_UINT(32), number));
    struct machine_value *v, *old;
    do {
        v = spread(m, self, p.source, axis, from_coordinate);
        old = v ? paris_load(m, p.dest, "dest", MACHINE_WHERE_ACTIVE) : NULL;
    } while (v && old &&
             paris_store(m, p.dest, machine_select(m, there, v, old), MACHINE_WHERE_ACTIVE) &&
             pieces_next(&p, dest.len));
}

void paris_rank(const struct paris_instruction *self, struct paris_operand dest,
                struct paris_operand source, unsigned int axis, unsigned int direction,
                unsigned int smode, CM_field_id_t sbit)
{
    struct machine *m = paris_begin(self->name);
    struct machine_scan how = {0};
    struct machine_type type;
    if (!paris_check_axis(axis) || !direction_good(direction) ||
        !segments_load(m, smode, sbit, &how) || !paris_check_dest(dest, source, source, &type))
        return;
    struct machine_value *v = paris_load(m, source, "source", MACHINE_WHERE_ACTIVE);
    if (!v)
        return;
    v = machine_rank(m, (int)axis, direction == CM_downward, source.letter == 's', how.segments,
                     how.bits, v);
    paris_store(m, dest, machine_resize(m, v, (int)dest.len, false), MACHINE_WHERE_ACTIVE);
}

/* ---- written by hand in the table ---- */

static void enumerate(const char *name, CM_field_id_t dest, unsigned int axis, unsigned int len,
                      unsigned int direction, unsigned int inclusion, unsigned int smode,
                      CM_field_id_t sbit)
{
    struct machine *m = paris_begin(name);
    struct machine_scan how = {.op = MACHINE_SCAN_ADD};
    struct machine_type type;
    if (!scan_load(m, axis, direction, inclusion, smode, sbit, &how) ||
        !paris_type(paris_u(dest, len), "dest", &type) ||
        !paris_check_operand(paris_u(dest, len), "dest"))
        return;
    if (machine_enumerate(m, &how, dest, (int)len))
        paris_fail_machine();
}

void CM_enumerate_1L(CM_field_id_t dest, unsigned int axis, unsigned int len,
                     unsigned int direction, unsigned int inclusion, unsigned int smode,
                     CM_field_id_t sbit)
{
    enumerate("CM_enumerate_1L", dest, axis, len, direction, inclusion, smode, sbit);
}

void CM_enumerate(CM_field_id_t dest, unsigned int axis, unsigned int len,
                  unsigned int direction, unsigned int inclusion, unsigned int smode,
                  CM_field_id_t sbit)
{
    enumerate("CM_enumerate", dest, axis, len, direction, inclusion, smode, sbit);
}

void CM_spread_from_processor_1L(CM_field_id_t dest, CM_sendaddr_t send_address,
                                 CM_field_id_t source, unsigned int len)
{
    struct machine *m = paris_begin("CM_spread_from_processor_1L");
    uint64_t index = paris_index_of_address(paris_geometry_current(), send_address);
    struct pieces p;
    if (index == UINT64_MAX) {
        paris_fail("send_address: there is no processor %u in this VP set", send_address);
        return;
    }
    if (!pieces_begin(&p, 1, paris_b(dest, len), paris_b(source, len)))
        return;
    struct machine_value *v;
    do
        v = paris_load(m, p.source, "source", MACHINE_EVERYWHERE);
    while (v &&
           paris_store(m, p.dest, machine_spread_index(m, index, v), MACHINE_WHERE_ACTIVE) &&
           pieces_next(&p, len));
}

/* The longest is as long as the OR of all, with negative numbers complemented. */
static unsigned int longest_integer(const char *name, struct paris_operand source)
{
    struct machine *m = paris_begin(name);
    struct machine_scalar out = {0, 0};
    struct machine_value *v = paris_load(m, source, "source", MACHINE_WHERE_ACTIVE);
    if (!v)
        return 0;
    if (source.letter == 's') {
        struct machine_value *sign = machine_extract(m, v, (int)source.len - 1, 1);
        v = machine_select(m, sign, machine_unary(m, MACHINE_NOT, v), v);
    }
    if (!v || machine_reduce(m, MACHINE_REDUCE_OR, v, &out) != MACHINE_OK) {
        paris_fail_machine();
        return 0;
    }
    unsigned int length = out.hi ? 64 : 0;
    for (uint64_t x = out.hi ? out.hi : out.lo; x; x >>= 1)
        length++;
    return length;
}

unsigned int CM_global_u_max_u_intlen_1L(CM_field_id_t source, unsigned int len)
{
    return longest_integer("CM_global_u_max_u_intlen_1L", paris_u(source, len));
}

unsigned int CM_global_u_max_s_intlen_1L(CM_field_id_t source, unsigned int len)
{
    return longest_integer("CM_global_u_max_s_intlen_1L", paris_s(source, len));
}

unsigned int CM_global_u_max_u_intlen(CM_field_id_t source, unsigned int len)
{
    return longest_integer("CM_global_u_max_u_intlen", paris_u(source, len));
}

unsigned int CM_global_u_max_s_intlen(CM_field_id_t source, unsigned int len)
{
    return longest_integer("CM_global_u_max_s_intlen", paris_s(source, len));
}
