/* Converts operands to values, and stores values in fields, with the checks of safety mode. */
#include "paris_state.h"

/* ---- types ---- */

bool paris_type(struct paris_operand a, const char *role, struct machine_type *type)
{
    if (a.letter == 'f') {
        if (a.len >= 1 && a.len <= CM_maximum_significand_length && a.e >= 2 &&
            a.e <= CM_maximum_exponent_length) {
            *type = machine_float_type((int)a.len, (int)a.e);
            return true;
        }
        paris_fail("%s: a float's significand must be 1..%d bits and its exponent 2..%d (got "
                   "%u, %u)",
                   role, CM_maximum_significand_length, CM_maximum_exponent_length, a.len, a.e);
        return false;
    }
    unsigned int least = a.letter == 's' ? 2 : 1;
    if (a.letter == 's' && a.len == 1 &&
        paris_let_pass("%s: a number of one bit with a sign", role))
        least = 1;
    if (a.len < least || a.len > PARIS_INTEGER_MAX) {
        paris_fail("%s: length must be %u..%d bits (got %u)", role, least, PARIS_INTEGER_MAX,
                   a.len);
        return false;
    }
    *type = MACHINE_UINT(a.len);
    return true;
}

/* ---- safety mode ---- */

bool paris_check_field(CM_field_id_t field, unsigned int bits, const char *role)
{
    /* Long fields are stored in pieces: the first must not be stored if the last cannot be. */
    if (paris_the.lenient && paris_runs_over(field, bits, role))
        return true;
    if (!paris_the.safety && bits <= PARIS_INTEGER_MAX) {
        int set = paris_the.lenient ? 0 : machine_field_vpset(paris_the.machine, field);
        if (!set || set == CM_current_vp_set)
            return true; /* the machine reports other errors */
    }
    return paris_check_field_wholly(field, bits, role);
}

bool paris_check_field_wholly(CM_field_id_t field, unsigned int bits, const char *role)
{
    struct machine_field_info info;
    if (field == CM_no_field) {
        paris_fail("%s: is CM_no_field: allocate it with CM_allocate_stack_field or "
                   "CM_allocate_heap_field",
                   role);
        return false;
    }
    if (!machine_field_lookup(paris_the.machine, field, &info)) {
        paris_fail("%s: %u is not a field: it was never allocated, has been deallocated, or an "
                   "offset led out of it",
                   role, field);
        return false;
    }
    if (info.vpset != machine_vpset_current(paris_the.machine)) {
        paris_fail(
            "%s: the field belongs to VP set %d, but %d is current: call CM_set_vp_set first",
            role, info.vpset, machine_vpset_current(paris_the.machine));
        return false;
    }
    if (bits > info.bits - info.offset) {
        paris_fail("%s: %u bits reach beyond its field, which has %u from here (%u in all): "
                   "allocate a longer one",
                   role, bits, info.bits - info.offset, info.bits);
        return false;
    }
    return true;
}

static bool check_constant(struct paris_operand a, const char *role)
{
    long i = (long)a.value.bits;
    if (a.letter == 'u' && a.len < 64 && a.value.bits >> a.len) {
        paris_fail("%s: the constant %lu does not fit in %u bits", role, a.value.bits, a.len);
        return false;
    }
    if (a.letter == 's' && a.len < 64 && (i >= 1L << (a.len - 1) || i < -(1L << (a.len - 1)))) {
        paris_fail("%s: the constant %ld does not fit in %u bits with a sign", role, i, a.len);
        return false;
    }
    return true;
}

bool paris_check_operand(struct paris_operand a, const char *role)
{
    if (a.is_constant)
        return !paris_the.safety || check_constant(a, role);
    return paris_check_field(a.field, paris_operand_bits(a), role);
}

bool paris_check_overlap(struct paris_operand dest, struct paris_operand source)
{
    if (!paris_the.safety || source.is_constant || dest.field == source.field)
        return true;
    unsigned int d = paris_operand_bits(dest), s = paris_operand_bits(source);
    if (dest.field < source.field + s && source.field < dest.field + d) {
        paris_fail(
            "dest and source overlap in part: they must be the same field or share no bits");
        return false;
    }
    return true;
}

bool paris_check_dest(struct paris_operand dest, struct paris_operand a, struct paris_operand b,
                      struct machine_type *type)
{
    return paris_type(dest, "dest", type) && paris_check_operand(dest, "dest") &&
           paris_check_overlap(dest, a) && paris_check_overlap(dest, b);
}

bool paris_check_axis(unsigned int axis)
{
    int rank = machine_vpset_rank(paris_the.machine, machine_vpset_current(paris_the.machine));
    if (axis < (unsigned int)rank)
        return true;
    paris_fail("axis: must be 0..%d in this VP set (got %d)", rank - 1, (int)axis);
    return false;
}

/* ---- values ---- */

struct machine_value *paris_load(struct machine *m, struct paris_operand a, const char *role,
                                 enum machine_scope scope)
{
    struct machine_type type;
    if (!paris_type(a, role, &type) || !paris_check_operand(a, role))
        return NULL;
    struct machine_value *v;
    if (!a.is_constant) {
        v = machine_field_value(m, a.field, type, scope);
    } else if (a.letter == 'f') {
        v = machine_constant_float(m, type, a.value.number);
    } else {
        v = machine_constant(m, type, paris_constant_bits(a));
    }
    if (!v)
        paris_fail_machine();
    return v;
}

bool paris_load_two(struct machine *m, const struct paris_instruction *self,
                    struct paris_operand dest, struct paris_operand a, struct paris_operand b,
                    struct machine_value **x, struct machine_value **y)
{
    *x = paris_load(m, a, a.field == dest.field ? "dest" : "source1", self->scope);
    *y = *x ? paris_load(m, b, b.is_constant ? "value" : "source2", self->scope) : NULL;
    return *y != NULL;
}

bool paris_direct(struct machine *m, enum machine_op op, bool overflow,
                  struct paris_operand dest, struct paris_operand a, struct paris_operand b)
{
    if (paris_the.safety || a.is_constant || a.len != dest.len || b.len != dest.len ||
        a.e != dest.e || b.e != dest.e)
        return false;
    bool is_float = dest.letter == 'f';
    struct machine_type type =
        is_float ? machine_float_type((int)dest.len, (int)dest.e) : MACHINE_UINT((int)dest.len);
    struct machine_direct d = {.op = op,
                               .type = type,
                               .dest = dest.field,
                               .a = a.field,
                               .b = b.is_constant ? MACHINE_NO_FIELD : b.field,
                               .overflow = overflow,
                               .is_signed = dest.letter == 's'};
    if (b.is_constant)
        d.number = is_float ? machine_float_bits(type, b.value.number) : paris_constant_bits(b);
    else if (!b.field)
        return false;
    return machine_direct(m, &d);
}

bool paris_load_widest(struct machine *m, const struct paris_instruction *self,
                       struct paris_operand dest, struct paris_operand a,
                       struct paris_operand b, bool y_signed, struct machine_value **x,
                       struct machine_value **y)
{
    struct machine_type type;
    unsigned int width = paris_longest(dest.len, paris_longest(a.len, b.len));
    if (!paris_check_dest(dest, a, b, &type) || !paris_load_two(m, self, dest, a, b, x, y))
        return false;
    *x = paris_resize(m, *x, width, dest.letter == 's');
    *y = paris_resize(m, *y, width, y_signed);
    if (!*x || !*y)
        paris_fail_machine();
    return *x && *y;
}

bool paris_store(struct machine *m, struct paris_operand dest, struct machine_value *value,
                 enum machine_scope scope)
{
    struct machine_type type;
    if (!paris_check_operand(dest, "dest"))
        return false;
    /* rounds a result computed in double to its format */
    if (dest.letter == 'f' && value && machine_value_type(value).kind == MACHINE_FLOAT) {
        if (!paris_type(dest, "dest", &type))
            return false;
        value = machine_to_float(paris_the.machine, value, type, false);
    }
    if (!value || machine_field_store(m, dest.field, value, scope) != MACHINE_OK) {
        paris_fail_machine();
        return false;
    }
    return true;
}

struct machine_value *paris_load_bit(struct machine *m, CM_field_id_t field, const char *role,
                                     enum machine_scope scope)
{
    if (!paris_check_field(field, 1, role))
        return NULL;
    struct machine_value *v = machine_field_value(m, field, MACHINE_BIT, scope);
    if (!v)
        paris_fail_machine();
    return v;
}

bool paris_store_bit(struct machine *m, CM_field_id_t field, struct machine_value *value,
                     enum machine_scope scope)
{
    return paris_store(m, paris_b(field, 1), value, scope);
}

bool paris_flag_put(struct machine *m, enum machine_flag flag, struct machine_value *value,
                    enum machine_scope scope)
{
    if (value && machine_flag_store(m, flag, value, scope) == MACHINE_OK)
        return true;
    paris_fail_machine();
    return false;
}
