/* The router: sends, gets, and moves between VP sets. Messages longer than an integer are
 * sent in pieces; collisions have the same winner for all pieces. */
#include <stdlib.h>

#include "paris_state.h"

bool paris_check_field_anywhere(CM_field_id_t field, unsigned int bits, const char *role)
{
    struct machine_field_info info;
    if (machine_field_lookup(paris_the.machine, field, &info)) {
        if (paris_runs_over(field, bits, role))
            return true;
        if (bits <= info.bits - info.offset)
            return true;
        paris_fail("%s: %u bits reach beyond its field, which has %u from here (%u in all): "
                   "allocate a longer one",
                   role, bits, info.bits - info.offset, info.bits);
        return false;
    }
    paris_fail(
        field == CM_no_field
            ? "%s: is CM_no_field: allocate it with CM_allocate_stack_field or "
              "CM_allocate_heap_field"
            : "%s: %u is not a field: it was never allocated, has been deallocated, or an "
              "offset led out of it",
        role, field);
    return false;
}

static int vp_set_of(CM_field_id_t field)
{
    struct machine_field_info info;
    return machine_field_lookup(paris_the.machine, field, &info) ? info.vpset : 0;
}

/* The bits of the field that are an address of the VP set. The machine uses only as many
 * bits as an address has, so a slightly longer field is used as it is. */
static struct machine_value *load_address(struct machine *m, CM_field_id_t field, int vp_set)
{
    struct machine_field_info info;
    unsigned int bits = (unsigned int)machine_address_bits(m, vp_set);
    if (!paris_check_field(field, 1, "send_address") ||
        !paris_check_field_anywhere(field, 1, "send_address"))
        return NULL;
    machine_field_lookup(m, field, &info);
    unsigned int there = info.bits - info.offset;
    if (there < bits || there <= 32)
        bits = there;
    struct machine_value *v =
        machine_field_value(m, field, MACHINE_UINT(bits), MACHINE_WHERE_ACTIVE);
    uint64_t wrong = 0;
    if (v && paris_the.safety && machine_addresses_check(m, v, vp_set, &wrong) != MACHINE_OK)
        v = NULL;
    if (!v)
        paris_fail_machine();
    if (!wrong)
        return v;
    paris_fail(
        "send_address: in %llu active processors it is that of no processor of VP set %d, "
        "which has %llu",
        (unsigned long long)wrong, vp_set, (unsigned long long)machine_vpset_count(m, vp_set));
    return NULL;
}

static bool check_notify(CM_field_id_t notify, int vp_set)
{
    if (notify == CM_no_field)
        return true;
    if (!paris_check_field_anywhere(notify, 1, "notify"))
        return false;
    if (vp_set_of(notify) == vp_set)
        return true;
    paris_fail("notify: the bit belongs to VP set %d, dest to %d: they must be in the same one",
               vp_set_of(notify), vp_set);
    return false;
}

/* ---- the pieces of long messages ---- */

struct pieces {
    struct machine_value **values;
    unsigned int count, step, bits;
};

static bool pieces_begin(struct pieces *p, unsigned int bits)
{
    p->bits = bits;
    p->step = bits <= PARIS_INTEGER_MAX ? bits : PARIS_PIECE;
    p->count = (bits + p->step - 1) / p->step;
    p->values = calloc(p->count, sizeof *p->values);
    if (!p->values)
        paris_fail_memory("not enough memory for a message of %u bits", bits);
    return p->values != NULL;
}

static unsigned int piece_bits(const struct pieces *p, unsigned int i)
{
    unsigned int at = i * p->step;
    return p->bits - at < p->step ? p->bits - at : p->step;
}

/* All pieces are read before one is stored, since fields may overlap. */
static bool pieces_load(struct machine *m, struct pieces *p, CM_field_id_t source,
                        enum machine_scope scope)
{
    for (unsigned int i = 0; i < p->count; i++) {
        p->values[i] =
            machine_field_value(m, source + i * p->step, MACHINE_UINT(piece_bits(p, i)), scope);
        if (!p->values[i]) {
            paris_fail_machine();
            return false;
        }
    }
    return true;
}

/* ---- send ---- */

static void send_pieces(struct machine *m, CM_field_id_t dest, struct machine_value *address,
                        CM_field_id_t source, unsigned int len, enum machine_combiner combiner,
                        CM_field_id_t notify)
{
    struct pieces p;
    if (!pieces_begin(&p, len))
        return;
    bool good = pieces_load(m, &p, source, MACHINE_WHERE_ACTIVE);
    for (unsigned int i = 0; i < p.count && good; i++) {
        good = machine_send(m, dest + i * p.step, address, p.values[i], combiner,
                            i == 0 ? notify : MACHINE_NO_FIELD) == MACHINE_OK;
        if (!good)
            paris_fail_machine();
    }
    if (good)
        paris_tell_lost(m, address, vp_set_of(dest));
    free(p.values);
}

void paris_send(const struct paris_instruction *self, struct paris_operand dest,
                CM_field_id_t send_address, struct paris_operand source, CM_field_id_t notify)
{
    struct machine *m = paris_begin(self->name);
    unsigned int len = paris_operand_bits(source);
    struct machine_type type = MACHINE_BIT;
    bool number = source.letter != 'b';
    if (len == 0 || (number && !paris_type(source, "source", &type)) ||
        !paris_check_field(source.field, len, "source") ||
        !paris_check_field_anywhere(source.field, len, "source") ||
        !paris_check_field_anywhere(dest.field, len, "dest") ||
        (vp_set_of(dest.field) == CM_current_vp_set && !paris_check_overlap(dest, source)))
        return;
    int vp_set = vp_set_of(dest.field);
    struct machine_value *address =
        check_notify(notify, vp_set) ? load_address(m, send_address, vp_set) : NULL;
    if (!address)
        return;
    if (!number) {
        send_pieces(m, dest.field, address, source.field, len, self->op, notify);
        return;
    }
    struct machine_value *v = paris_load(m, source, "source", MACHINE_WHERE_ACTIVE);
    if (v && machine_send(m, dest.field, address, v, self->op, notify) != MACHINE_OK)
        paris_fail_machine();
    else if (v)
        paris_tell_lost(m, address, vp_set);
}

void CM_send_with_c_add_1L(CM_field_id_t dest, CM_field_id_t send_address, CM_field_id_t source,
                           unsigned int s, unsigned int e, CM_field_id_t notify)
{
    struct machine *m = paris_begin("CM_send_with_c_add_1L");
    unsigned int half = s + e + 1;
    struct machine_type type;
    if (!paris_type(paris_f(source, s, e), "source", &type) ||
        !paris_check_field(source, 2 * half, "source") ||
        !paris_check_field_anywhere(source, 2 * half, "source") ||
        !paris_check_field_anywhere(dest, 2 * half, "dest"))
        return;
    int vp_set = vp_set_of(dest);
    struct machine_value *address =
        check_notify(notify, vp_set) ? load_address(m, send_address, vp_set) : NULL;
    struct machine_value *re =
        address ? paris_load(m, paris_f(source, s, e), "source", MACHINE_WHERE_ACTIVE) : NULL;
    struct machine_value *im =
        re ? paris_load(m, paris_f(source + half, s, e), "source", MACHINE_WHERE_ACTIVE) : NULL;
    if (im && (machine_send(m, dest, address, re, MACHINE_COMBINE_FADD, notify) != MACHINE_OK ||
               machine_send(m, dest + half, address, im, MACHINE_COMBINE_FADD,
                            MACHINE_NO_FIELD) != MACHINE_OK))
        paris_fail_machine();
    else if (im)
        paris_tell_lost(m, address, vp_set);
}

/* ---- get ---- */

void paris_get(const struct paris_instruction *self, CM_field_id_t dest,
               CM_field_id_t send_address, CM_field_id_t source, unsigned int len)
{
    struct machine *m = paris_begin(self->name);
    struct pieces p;
    if (len == 0 || !paris_check_field(dest, len, "dest") ||
        !paris_check_field_anywhere(dest, len, "dest") ||
        !paris_check_field_anywhere(source, len, "source"))
        return;
    struct machine_value *address = load_address(m, send_address, vp_set_of(source));
    if (!address || !pieces_begin(&p, len))
        return;
    bool good = true;
    for (unsigned int i = 0; i < p.count && good; i++) {
        p.values[i] =
            machine_get(m, address, source + i * p.step, MACHINE_UINT(piece_bits(&p, i)));
        good = p.values[i] != NULL;
    }
    for (unsigned int i = 0; i < p.count && good; i++)
        good = machine_field_store(m, dest + i * p.step, p.values[i], MACHINE_WHERE_ACTIVE) ==
               MACHINE_OK;
    if (!good)
        paris_fail_machine();
    free(p.values);
}

/* ---- fixed patterns ---- */

void paris_power_two(const struct paris_instruction *self, CM_field_id_t dest,
                     CM_field_id_t source, unsigned int axis, unsigned int log2_distance,
                     unsigned int direction, unsigned int len)
{
    struct machine *m = paris_begin(self->name);
    struct pieces p;
    if (direction > CM_downward) {
        paris_fail("direction: must be CM_upward (0) or CM_downward (1) (got %d)",
                   (int)direction);
        return;
    }
    if (len == 0 || !paris_check_axis(axis) || !paris_check_field(dest, len, "dest") ||
        !paris_check_field(source, len, "source"))
        return;
    int length = machine_vpset_length(m, machine_vpset_current(m), (int)axis);
    if (log2_distance > 30) {
        paris_fail("log2_distance: must be 0..30 (got %u)", log2_distance);
        return;
    }
    int distance = (int)((1u << log2_distance) % (unsigned int)length);
    if (!pieces_begin(&p, len))
        return;
    bool good = pieces_load(m, &p, source, MACHINE_EVERYWHERE);
    for (unsigned int i = 0; i < p.count && good; i++) {
        struct machine_value *v = machine_shift(m, p.values[i], (int)axis,
                                                direction == CM_upward ? distance : -distance);
        good = paris_store(m, paris_b(dest + i * p.step, piece_bits(&p, i)), v, self->scope);
    }
    free(p.values);
}

/* A send in which every processor sends to its own address. */
void paris_cross_move(const struct paris_instruction *self, CM_field_id_t dest,
                      CM_field_id_t source, unsigned int len)
{
    struct machine *m = paris_begin(self->name);
    if (len == 0 || !paris_check_field(source, len, "source") ||
        !paris_check_field_anywhere(source, len, "source") ||
        !paris_check_field_anywhere(dest, len, "dest"))
        return;
    int here = machine_vpset_current(m), there = vp_set_of(dest);
    if (machine_vpset_count(m, here) != machine_vpset_count(m, there)) {
        paris_fail(
            "dest: its VP set has %llu processors, the current one %llu: they must be as "
            "many",
            (unsigned long long)machine_vpset_count(m, there),
            (unsigned long long)machine_vpset_count(m, here));
        return;
    }
    struct machine_value *address = machine_self_address(m, machine_address_bits(m, here));
    struct machine_value *all = machine_constant(m, MACHINE_BIT, (struct machine_scalar){1, 0});
    struct machine_value *context = machine_flag_value(m, MACHINE_CONTEXT, MACHINE_EVERYWHERE);
    bool always = self->scope == MACHINE_EVERYWHERE;
    if (always && !paris_flag_put(m, MACHINE_CONTEXT, all, MACHINE_EVERYWHERE))
        return;
    send_pieces(m, dest, address, source, len, MACHINE_COMBINE_OVERWRITE, MACHINE_NO_FIELD);
    if (always)
        paris_flag_put(m, MACHINE_CONTEXT, context, MACHINE_EVERYWHERE);
}
