/* Quotients, remainders, powers, shifts and counts of integers: rows of the families integer,
 * integer1, power, shift, rotate.
 *
 * Lengths are treated as in arithmetic.c: sources are extended to the longest of the lengths,
 * the operation is done at that length, the result is truncated to dest's. Overflow is 1 if the
 * true result does not fit in dest, or is undefined (a divisor of zero, the square root of a
 * negative number, zero to a negative power), else 0; it is computed only if it is read. The
 * result then is:
 *     for a division by zero, the quotient 0 and the remainder the dividend
 *     0 for the square root of a negative number, and for zero to a negative power
 *     the low bits of the true result, otherwise
 * A negative exponent gives the power's integer part: 0, but for the powers of 1 and -1.
 */
#include "paris_state.h"

static struct machine_value *is_number(struct machine *m, struct machine_value *v, int x)
{
    return v ? machine_binary(m, MACHINE_EQ, v, paris_number(m, machine_value_type(v).width, x))
             : NULL;
}

static struct machine_value *is_least(struct machine *m, struct machine_value *v)
{
    struct machine_type type = machine_value_type(v);
    return machine_binary(m, MACHINE_EQ, v, machine_constant(m, type, scalar_sign(type.width)));
}

static struct machine_value *sign_of(struct machine *m, struct machine_value *v)
{
    return v ? machine_extract(m, v, machine_value_type(v).width - 1, 1) : NULL;
}

static struct machine_value *both(struct machine *m, struct machine_value *a,
                                  struct machine_value *b)
{
    return machine_binary(m, MACHINE_AND, a, b);
}

static struct machine_value *either(struct machine *m, struct machine_value *a,
                                    struct machine_value *b)
{
    return machine_binary(m, MACHINE_OR, a, b);
}

/* Stores the flag (NULL: an error that the machine has recorded), then dest. */
static void finish(struct machine *m, const struct paris_instruction *self,
                   struct paris_operand dest, struct machine_value *result, bool is_signed,
                   struct machine_value *overflow)
{
    if (!result || !overflow ||
        (self->overflow && machine_overflow_record_value(m, overflow) != MACHINE_OK)) {
        paris_fail_machine();
        return;
    }
    paris_store(m, dest, paris_resize(m, result, dest.len, is_signed), self->scope);
}

/* ---- quotients ---- */

static bool is_signed_quotient(int op)
{
    return op == MACHINE_SDIV || op == MACHINE_SFLOOR || op == MACHINE_SCEIL ||
           op == MACHINE_SROUND;
}

void paris_integer(const struct paris_instruction *self, struct paris_operand dest,
                   struct paris_operand a, struct paris_operand b)
{
    struct machine *m = paris_begin(self->name);
    struct machine_value *x, *y;
    bool is_signed = dest.letter == 's';
    if (!paris_load_widest(m, self, dest, a, b, is_signed, &x, &y))
        return;
    struct machine_value *result = machine_binary(m, self->op, x, y);
    struct machine_value *overflow =
        either(m, is_number(m, y, 0), paris_lost(m, result, dest.len, is_signed));
    if (is_signed_quotient(self->op) && x && y)
        overflow = either(m, overflow, both(m, is_least(m, x), is_number(m, y, -1)));
    finish(m, self, dest, result, is_signed, overflow);
}

/* ---- powers ---- */

/* x to the negative y. */
static struct machine_value *inverse_power(struct machine *m, struct machine_value *x,
                                           struct machine_value *y, bool is_signed)
{
    unsigned int width = machine_value_type(x).width;
    struct machine_value *one = paris_number(m, (int)width, 1),
                         *none = paris_number(m, (int)width, 0);
    struct machine_value *others = none;
    if (is_signed) {
        struct machine_value *minus = machine_select(m, machine_extract(m, y, 0, 1), x, one);
        others = machine_select(m, is_number(m, x, -1), minus, none);
    }
    return others ? machine_select(m, is_number(m, x, 1), one, others) : NULL;
}

void paris_power(const struct paris_instruction *self, struct paris_operand dest,
                 struct paris_operand a, struct paris_operand b)
{
    struct machine *m = paris_begin(self->name);
    struct machine_value *x, *y;
    bool is_signed = dest.letter == 's', may_invert = b.letter == 's';
    if (!paris_load_widest(m, self, dest, a, b, may_invert, &x, &y))
        return;
    struct machine_value *result = machine_binary(m, MACHINE_POW, x, y);
    struct machine_value *overflow =
        machine_binary(m, is_signed ? MACHINE_SPOW_BEYOND : MACHINE_UPOW_BEYOND, x, y);
    if (may_invert && result && overflow) {
        struct machine_value *negative = sign_of(m, y),
                             *inverse = inverse_power(m, x, y, is_signed);
        result = machine_select(m, negative, inverse, result);
        overflow = machine_select(m, negative, is_number(m, x, 0), overflow);
    }
    overflow = either(m, overflow, paris_lost(m, result, dest.len, is_signed));
    finish(m, self, dest, result, is_signed, overflow);
}

/* ---- of one number ---- */

/* The bits, inverted where the sign is 1. */
static struct machine_value *without_sign(struct machine *m, struct machine_value *x,
                                          bool is_signed)
{
    if (!is_signed)
        return x;
    struct machine_value *spread =
        paris_resize(m, sign_of(m, x), machine_value_type(x).width, true);
    return machine_binary(m, MACHINE_XOR, x, spread);
}

static struct machine_value *signum(struct machine *m, struct machine_value *x)
{
    unsigned int width = machine_value_type(x).width;
    struct machine_value *positive = paris_resize(
        m, machine_binary(m, MACHINE_NE, x, paris_number(m, (int)width, 0)), width, false);
    struct machine_value *sign = sign_of(m, x);
    return positive && sign ? machine_select(m, sign, paris_number(m, (int)width, -1), positive)
                            : NULL;
}

static struct machine_value *to_gray(struct machine *m, struct machine_value *x)
{
    return machine_binary(m, MACHINE_XOR, x,
                          machine_bits_shift(m, MACHINE_USHIFT, x, paris_number(m, 32, -1)));
}

void paris_integer_unary(const struct paris_instruction *self, struct paris_operand dest,
                         struct paris_operand a)
{
    struct machine *m = paris_begin(self->name);
    struct machine_type type;
    if (!paris_check_dest(dest, a, a, &type))
        return;
    struct machine_value *x = paris_load(m, a, "source", self->scope), *result,
                         *overflow = paris_number(m, 1, 0);
    if (!x)
        return;
    bool is_signed = a.letter == 's', result_signed = false;
    switch (self->op) {
    case MACHINE_POPCOUNT:
    case MACHINE_LENGTH:
        result = machine_unary(m, self->op, without_sign(m, x, is_signed));
        break;
    case MACHINE_ISQRT:
        result = machine_unary(m, MACHINE_ISQRT, x);
        if (is_signed && result) {
            overflow = sign_of(m, x);
            result = machine_select(m, overflow, paris_number(m, (int)a.len, 0), result);
            result_signed = true;
        }
        break;
    case PARIS_OP_TO_GRAY:
        result = to_gray(m, x);
        break;
    case PARIS_OP_SIGNUM:
        result = signum(m, paris_resize(m, x, paris_longest(dest.len, a.len), true));
        result_signed = true;
        break;
    default: /* the machine's operation is the whole instruction, and refuses what is none */
        result = machine_unary(m, self->op, x);
        break;
    }
    overflow = either(m, overflow, paris_lost(m, result, dest.len, result_signed));
    finish(m, self, dest, result, result_signed, overflow);
}

/* ---- shifts ---- */

/* Shifted left, bits are lost that do not come back by shifting right; shifted right, bits
 * that dest cannot hold. */
static struct machine_value *shift_overflow(struct machine *m,
                                            const struct paris_instruction *self,
                                            struct machine_value *x,
                                            struct machine_value *result, unsigned int len,
                                            struct machine_value *count, bool is_signed)
{
    unsigned int width = machine_value_type(x).width;
    struct machine_value *kept =
        paris_resize(m, paris_resize(m, result, len, is_signed), width, is_signed);
    struct machine_value *back = count ? machine_unary(m, MACHINE_NEG, count) : NULL;
    struct machine_value *again = machine_bits_shift(m, self->op, kept, back);
    struct machine_value *differs = machine_binary(m, MACHINE_NE, again, x);
    struct machine_value *right = sign_of(m, count);
    struct machine_value *lost = paris_lost(m, result, len, is_signed);
    return right && lost && differs ? machine_select(m, right, lost, differs) : NULL;
}

void paris_shift(const struct paris_instruction *self, struct paris_operand dest,
                 struct paris_operand a, struct paris_operand count)
{
    struct machine *m = paris_begin(self->name);
    struct machine_type type;
    struct machine_value *x, *n;
    if (!paris_check_dest(dest, a, count, &type) ||
        !paris_load_two(m, self, dest, a, count, &x, &n))
        return;
    bool is_signed = dest.letter == 's';
    x = paris_resize(m, x, paris_longest(dest.len, a.len), is_signed);
    n = paris_resize(m, n, count.len < PARIS_INTEGER_MAX ? count.len + 1 : count.len, true);
    struct machine_value *result = machine_bits_shift(m, self->op, x, n);
    finish(m, self, dest, result, is_signed,
           result ? shift_overflow(m, self, x, result, dest.len, n, is_signed) : NULL);
}

void paris_rotate(const struct paris_instruction *self, struct paris_operand dest,
                  struct paris_operand a, struct paris_operand count)
{
    struct machine *m = paris_begin(self->name);
    struct machine_type type;
    struct machine_value *x, *n;
    if (paris_check_dest(dest, a, count, &type) &&
        paris_load_two(m, self, dest, a, count, &x, &n))
        paris_store(m, dest, machine_bits_shift(m, MACHINE_ROTATE, x, n), self->scope);
}
