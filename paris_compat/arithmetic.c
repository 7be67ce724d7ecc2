/* Arithmetic, comparisons and conversions: rows of the families binary, unary, compare,
 * convert.
 *
 * Integers of several lengths. Sources are extended to the longest of the lengths with zeros
 * or the sign, the operation is done at that length, and the result is truncated to dest's
 * length. Overflow is 1 if the true result does not fit in dest. Constants are truncated to
 * their length.
 */
#include "paris_state.h"

/* The overflow flag is also 1 if the result, computed at a greater width, does not fit in
 * dest. */
static bool overflow_narrow(struct machine *m, struct machine_value *wide, unsigned int len,
                            bool is_signed)
{
    if (!wide || machine_value_type(wide).width <= len)
        return true;
    struct machine_value *so_far =
        machine_flag_value(m, MACHINE_OVERFLOW, MACHINE_WHERE_ACTIVE);
    struct machine_value *lost = paris_lost(m, wide, len, is_signed);
    if (!so_far)
        return false;
    return paris_flag_put(m, MACHINE_OVERFLOW,
                          lost ? machine_binary(m, MACHINE_OR, so_far, lost) : NULL,
                          MACHINE_WHERE_ACTIVE);
}

void paris_binary(const struct paris_instruction *self, struct paris_operand dest,
                  struct paris_operand a, struct paris_operand b)
{
    struct machine *m = paris_begin(self->name);
    struct machine_type type;
    struct machine_value *x, *y;
    bool is_integer = dest.letter != 'f', is_signed = dest.letter == 's';
    if (!self->swap && paris_direct(m, self->op, self->overflow, dest, a, b))
        return;
    if (is_integer ? !paris_load_widest(m, self, dest, a, b, is_signed, &x, &y)
                   : !paris_check_dest(dest, a, b, &type) ||
                         !paris_load_two(m, self, dest, a, b, &x, &y))
        return;
    if (self->swap) {
        struct machine_value *t = x;
        x = y;
        y = t;
    }
    struct machine_value *result = machine_binary(m, self->op, x, y);
    bool is_function = machine_op_is_function(self->op);
    if (self->overflow &&
        (!(is_function ? paris_float_overflow(m, self->op, x, y, result)
                       : machine_overflow_record(m, self->op, is_signed, x, y) == MACHINE_OK) ||
         (is_integer && !overflow_narrow(m, result, dest.len, is_signed)))) {
        paris_fail_machine();
        return;
    }
    if (is_integer)
        result = paris_resize(m, result, dest.len, is_signed);
    paris_store(m, dest, result, self->scope);
}

/* Unsigned, only the negative of zero fits. */
static bool overflow_negated(struct machine *m, struct machine_value *x, bool is_signed)
{
    if (is_signed)
        return machine_overflow_record(m, MACHINE_NEG, true, x, NULL) == MACHINE_OK;
    struct machine_value *zero =
        machine_constant(m, machine_value_type(x), (struct machine_scalar){0, 0});
    return zero && machine_overflow_record(m, MACHINE_SUB, false, zero, x) == MACHINE_OK;
}

void paris_unary(const struct paris_instruction *self, struct paris_operand dest,
                 struct paris_operand a)
{
    struct machine *m = paris_begin(self->name);
    struct machine_type type;
    if (!paris_check_dest(dest, a, a, &type))
        return;
    struct machine_value *x = paris_load(m, a, "source", self->scope);
    if (!x)
        return;
    if (dest.letter == 'f') {
        struct machine_value *y = machine_unary(m, self->op, x);
        if (self->overflow && !paris_float_overflow(m, self->op, x, NULL, y))
            paris_fail_machine();
        else
            paris_store(m, dest, y, self->scope);
        return;
    }
    bool is_signed = dest.letter == 's';
    x = paris_resize(m, x, paris_longest(dest.len, a.len), is_signed);
    if (!x) {
        paris_fail_machine();
        return;
    }
    struct machine_value *result =
        self->op == PARIS_OP_ABS ? paris_absolute(m, x) : machine_unary(m, self->op, x);
    if (self->overflow && (!overflow_negated(m, x, is_signed) ||
                           !overflow_narrow(m, result, dest.len, is_signed))) {
        paris_fail_machine();
        return;
    }
    paris_store(m, dest, paris_resize(m, result, dest.len, is_signed), self->scope);
}

void paris_compare(const struct paris_instruction *self, struct paris_operand a,
                   struct paris_operand b)
{
    struct machine *m = paris_begin(self->name);
    struct paris_operand test = a;
    test.field = CM_no_field;
    if (!self->swap && paris_direct(m, self->op, false, test, a, b))
        return;
    struct machine_value *x = paris_load(m, a, "source1", MACHINE_WHERE_ACTIVE);
    struct machine_value *y =
        x ? paris_load(m, b, b.is_constant ? "value" : "source2", MACHINE_WHERE_ACTIVE) : NULL;
    if (!x || !y)
        return;
    if (a.letter != 'f') {
        unsigned int width = paris_longest(a.len, b.len);
        x = paris_resize(m, x, width, a.letter == 's');
        y = paris_resize(m, y, width, a.letter == 's');
    }
    struct machine_value *result = NULL;
    if (x && y)
        result =
            self->swap ? machine_binary(m, self->op, y, x) : machine_binary(m, self->op, x, y);
    paris_flag_put(m, MACHINE_TEST, result, MACHINE_WHERE_ACTIVE);
}

/* ---- conversions ---- */

void paris_to_float(const struct paris_instruction *self, struct paris_operand dest,
                    struct paris_operand a)
{
    struct machine *m = paris_begin(self->name);
    struct machine_type type;
    if (!paris_type(dest, "dest", &type) || !paris_check_overlap(dest, a))
        return;
    struct machine_value *x = paris_load(m, a, "source", self->scope);
    if (x)
        paris_store(m, dest, machine_to_float(m, x, type, a.letter == 's'), self->scope);
}

static double power_of_two(unsigned int n)
{
    double x = 1;
    for (; n; n--)
        x += x;
    return x;
}

/* Overflow is 1 if the whole number x does not fit in len bits; a NaN never fits. */
static bool overflow_range(struct machine *m, struct machine_value *x, unsigned int len,
                           bool is_signed)
{
    struct machine_type type = machine_value_type(x);
    struct machine_value *low =
        machine_constant_float(m, type, is_signed ? -power_of_two(len - 1) : 0);
    struct machine_value *high =
        machine_constant_float(m, type, power_of_two(is_signed ? len - 1 : len));
    if (!low || !high)
        return false;
    struct machine_value *above = machine_binary(m, MACHINE_FGE, x, low);
    struct machine_value *below = machine_binary(m, MACHINE_FLT, x, high);
    struct machine_value *fits =
        above && below ? machine_binary(m, MACHINE_AND, above, below) : NULL;
    return paris_flag_put(m, MACHINE_OVERFLOW,
                          fits ? machine_unary(m, MACHINE_NOT, fits) : NULL,
                          MACHINE_WHERE_ACTIVE);
}

void paris_to_bits(const struct paris_instruction *self, struct paris_operand dest,
                   struct paris_operand a)
{
    struct machine *m = paris_begin(self->name);
    struct machine_type type;
    if (!paris_check_dest(dest, a, a, &type))
        return;
    bool is_signed = dest.letter == 's';
    struct machine_value *x = paris_load(m, a, "source", self->scope);
    if (!x)
        return;
    if (machine_value_type(x).s) /* a whole number may not fit another format */
        x = machine_to_float(m, x, MACHINE_F64, false);
    x = machine_unary(m, self->op, x);
    struct machine_value *result = x ? machine_to_bits(m, x, (int)dest.len, is_signed) : NULL;
    if (result && overflow_range(m, x, dest.len, is_signed))
        paris_store(m, dest, result, self->scope);
    else if (!result)
        paris_fail_machine();
}
