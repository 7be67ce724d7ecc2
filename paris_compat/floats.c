/* Floats: overflow of functions, powers and scaling by integers, two operations in one, parts
 * of floats, tests of what a float is, exchange.
 *
 * Two operations in one round twice: the result is that of the two instructions. */
#include <math.h>

#include "paris_state.h"

static struct machine_value *zero_if_finite(struct machine *m, struct machine_value *x)
{
    return machine_binary(m, MACHINE_FSUB, x, x);
}

static struct machine_value *both(struct machine *m, struct machine_value *a,
                                  struct machine_value *b)
{
    return machine_binary(m, MACHINE_FADD, a, b);
}

bool paris_float_overflow(struct machine *m, int op, struct machine_value *a,
                          struct machine_value *b, struct machine_value *result)
{
    if (!a || !result)
        return false;
    if (op == MACHINE_FMOD || op == MACHINE_FREM) {
        struct machine_value *zero = machine_constant_float(m, machine_value_type(b), 0);
        return paris_flag_put(m, MACHINE_OVERFLOW,
                              zero ? machine_binary(m, MACHINE_FEQ, b, zero) : NULL,
                              MACHINE_WHERE_ACTIVE);
    }
    struct machine_value *operand = b ? both(m, zero_if_finite(m, a), zero_if_finite(m, b)) : a;
    return operand && machine_overflow_record_result(m, result, operand) == MACHINE_OK;
}

/* Floats of other formats as the equal doubles, from which their parts are taken. */
static struct machine_value *native(struct machine *m, struct machine_value *x)
{
    return x && machine_value_type(x).s ? machine_to_float(m, x, MACHINE_F64, false) : x;
}

/* ---- powers and scaling by integers ---- */

static struct machine_value *with_sign(struct machine *m, struct machine_value *x,
                                       struct machine_value *sign)
{
    struct machine_value *negative = x && sign ? machine_unary(m, MACHINE_FNEG, x) : NULL;
    return negative ? machine_select(m, sign, negative, x) : x;
}

/* x to the power n, in double. An n that is not a double is the sum of two that are: its low
 * 32 bits, and the rest. Beyond 2^64 all powers are 0, 1 or infinite, so the rounding of the
 * rest does not matter. */
static struct machine_value *power(struct machine *m, struct machine_value *x,
                                   struct machine_value *n, bool is_signed)
{
    int len = machine_value_type(n).width;
    x = machine_to_float(m, x, MACHINE_F64, false);
    if (len <= 53)
        return machine_binary(m, MACHINE_FPOW, x,
                              machine_to_float(m, n, MACHINE_F64, is_signed));
    struct machine_value *sign = is_signed ? machine_extract(m, n, len - 1, 1) : NULL;
    struct machine_value *magnitude = is_signed ? paris_absolute(m, n) : n;
    if (!magnitude)
        return NULL;
    struct machine_value *low =
        machine_to_float(m, machine_extract(m, magnitude, 0, 32), MACHINE_F64, false);
    struct machine_value *high =
        machine_to_float(m, machine_extract(m, magnitude, 32, len - 32), MACHINE_F64, false);
    struct machine_value *unit = machine_constant_float(m, MACHINE_F64, 4294967296.0);
    high = high && unit ? machine_binary(m, MACHINE_FMUL, high, unit) : NULL;
    return machine_binary(m, MACHINE_FMUL,
                          machine_binary(m, MACHINE_FPOW, x, with_sign(m, high, sign)),
                          machine_binary(m, MACHINE_FPOW, x, with_sign(m, low, sign)));
}

/* Whether the constant fits in 53 bits, signed or not. */
static bool constant_is_short(struct paris_operand b)
{
    unsigned long offset = b.letter == 's' ? 1ul << 52 : 0;
    return b.value.bits + offset < 1ul << 53;
}

void paris_float_by_integer(const struct paris_instruction *self, struct paris_operand dest,
                            struct paris_operand a, struct paris_operand b)
{
    struct machine *m = paris_begin(self->name);
    struct machine_type type;
    struct machine_value *x, *n;
    if (!paris_check_dest(dest, a, b, &type) || !paris_load_two(m, self, dest, a, b, &x, &n))
        return;
    bool is_signed = b.letter == 's';
    if (b.is_constant && constant_is_short(b))
        n = machine_extract(m, n, 0, 53);
    struct machine_value *result;
    if (self->op == MACHINE_FPOW)
        result = machine_to_float(m, power(m, x, n, is_signed), type, false);
    else {
        struct machine_type in = type.s ? MACHINE_F64 : type;
        result = machine_binary(m, MACHINE_FSCALE, native(m, x),
                                machine_to_float(m, n, in, is_signed));
        result = machine_to_float(m, result, type, false);
    }
    if (self->overflow && !paris_float_overflow(m, self->op, x, NULL, result)) {
        paris_fail_machine();
        return;
    }
    paris_store(m, dest, result, self->scope);
}

/* ---- two operations in one ---- */

void paris_float_pair(const struct paris_instruction *self, struct paris_operand dest,
                      struct paris_operand a, struct paris_operand b, struct paris_operand c)
{
    static const uint8_t first[] = {
        [PARIS_MULT_ADD] = MACHINE_FMUL,  [PARIS_MULT_SUB] = MACHINE_FMUL,
        [PARIS_MULT_SUBF] = MACHINE_FMUL, [PARIS_ADD_MULT] = MACHINE_FADD,
        [PARIS_SUB_MULT] = MACHINE_FSUB,  [PARIS_SUBF_MULT] = MACHINE_FSUB};
    static const uint8_t second[] = {
        [PARIS_MULT_ADD] = MACHINE_FADD,  [PARIS_MULT_SUB] = MACHINE_FSUB,
        [PARIS_MULT_SUBF] = MACHINE_FSUB, [PARIS_ADD_MULT] = MACHINE_FMUL,
        [PARIS_SUB_MULT] = MACHINE_FMUL,  [PARIS_SUBF_MULT] = MACHINE_FMUL};
    struct machine *m = paris_begin(self->name);
    struct machine_type type;
    if (!paris_check_dest(dest, a, b, &type) || !paris_check_overlap(dest, c))
        return;
    struct machine_value *x = paris_load(m, a, "source1", self->scope);
    struct machine_value *y =
        x ? paris_load(m, b, b.is_constant ? "source2_value" : "source2", self->scope) : NULL;
    struct machine_value *z =
        y ? paris_load(m, c, c.is_constant ? "source3_value" : "source3", self->scope) : NULL;
    if (!x || !y || !z)
        return;
    bool from = self->op == PARIS_SUBF_MULT, to = self->op == PARIS_MULT_SUBF;
    struct machine_value *t = machine_binary(m, first[self->op], from ? y : x, from ? x : y);
    struct machine_value *r =
        t ? machine_binary(m, second[self->op], to ? z : t, to ? t : z) : NULL;
    if (self->overflow && r) {
        /* An infinite sum times 0 is a NaN, and counts as an overflow. */
        struct machine_value *operands =
            both(m, both(m, zero_if_finite(m, x), zero_if_finite(m, y)), zero_if_finite(m, z));
        struct machine_value *largest =
            machine_binary(m, MACHINE_FMAX, machine_unary(m, MACHINE_FABS, r),
                           machine_unary(m, MACHINE_FABS, t));
        if (!operands || !largest ||
            machine_overflow_record_result(m, largest, operands) != MACHINE_OK)
            r = NULL;
    }
    paris_store(m, dest, r, self->scope);
}

/* ---- what a float is made of ---- */

static int significand_bits(struct machine_type type)
{
    return type.width == 32 ? 23 : 52;
}

static struct machine_value *exponent_field(struct machine *m, struct machine_value *x)
{
    struct machine_type type = machine_value_type(x);
    int s = significand_bits(type);
    return machine_extract(m, x, s, type.width - 1 - s);
}

/* Enough bits for any exponent and for the sum of two. */
enum { EXPONENT_WIDTH = 16 };

static struct machine_value *is_finite(struct machine *m, struct machine_value *x)
{
    struct machine_type type = machine_value_type(x);
    return machine_binary(m, MACHINE_FLT, machine_unary(m, MACHINE_FABS, x),
                          machine_constant_float(m, type, (double)__builtin_inff()));
}

static struct machine_value *is_zero(struct machine *m, struct machine_value *x)
{
    return machine_binary(m, MACHINE_FEQ, x,
                          machine_constant_float(m, machine_value_type(x), 0));
}

/* The n of |x| = f 2^n, 1 <= f < 2, in EXPONENT_WIDTH bits; for numbers other than 0. */
static struct machine_value *exponent(struct machine *m, struct machine_value *x)
{
    struct machine_type type = machine_value_type(x);
    int bias = type.width == 32 ? 127 : 1023, w = EXPONENT_WIDTH;
    struct machine_value *scaled = machine_binary(
        m, MACHINE_FMUL, x, machine_constant_float(m, type, 18446744073709551616.0));
    struct machine_value *field = exponent_field(m, x);
    struct machine_value *small =
        field ? machine_binary(m, MACHINE_EQ, field,
                               paris_number(m, type.width == 32 ? 8 : 11, 0))
              : NULL;
    if (!scaled || !small)
        return NULL;
    field = machine_select(
        m, small,
        machine_binary(m, MACHINE_SUB, machine_resize(m, exponent_field(m, scaled), w, false),
                       paris_number(m, w, bias + 64)),
        machine_binary(m, MACHINE_SUB, machine_resize(m, field, w, false),
                       paris_number(m, w, bias)));
    return field;
}

static struct machine_value *significand_of(struct machine *m, struct machine_value *x,
                                            struct machine_type type)
{
    struct machine_value *n = exponent(m, x);
    n = n ? machine_to_float(m, n, type, true) : NULL;
    return n ? machine_binary(m, MACHINE_FSCALE, x, machine_unary(m, MACHINE_FNEG, n)) : NULL;
}

static struct machine_value *signum(struct machine *m, struct machine_value *x,
                                    struct machine_value *plus, struct machine_value *minus,
                                    struct machine_value *other)
{
    struct machine_value *zero = machine_constant_float(m, machine_value_type(x), 0);
    struct machine_value *below =
        machine_select(m, machine_binary(m, MACHINE_FLT, x, zero), minus, other);
    return machine_select(m, machine_binary(m, MACHINE_FGT, x, zero), plus, below);
}

void paris_float_made(const struct paris_instruction *self, struct paris_operand dest,
                      struct paris_operand a)
{
    struct machine *m = paris_begin(self->name);
    struct machine_type type;
    if (!paris_check_dest(dest, a, a, &type))
        return;
    struct machine_value *x = native(m, paris_load(m, a, "source", self->scope)), *r;
    if (!x)
        return;
    type = machine_value_type(x);
    if (self->op == PARIS_SIGNUM) {
        struct machine_value *zero = machine_constant_float(m, type, 0);
        r = signum(m, x, machine_constant_float(m, type, 1),
                   machine_constant_float(m, type, -1),
                   machine_binary(m, MACHINE_FMUL, x, zero)); /* 0 as it is, NaN canonical */
    } else {
        struct machine_value *one = machine_constant_float(m, type, 1);
        struct machine_value *plain = machine_binary(m, MACHINE_FMUL, x, one);
        struct machine_value *is_number = is_finite(m, x), *zero = is_zero(m, x);
        r = machine_select(m, zero, plain,
                           machine_select(m, is_number, significand_of(m, x, type), plain));
    }
    paris_store(m, dest, r, self->scope);
}

/* Converts an integer to dest's length; overflow is 1 if it does not fit, or if `fits` is 0
 * (NULL: always 1). */
static void store_integer(struct machine *m, const struct paris_instruction *self,
                          struct paris_operand dest, struct machine_value *v,
                          struct machine_value *fits)
{
    bool is_signed = dest.letter == 's';
    int width = v ? machine_value_type(v).width : 0, len = (int)dest.len;
    struct machine_value *r = v ? machine_resize(m, v, len, is_signed) : NULL;
    if (r && len < width) {
        struct machine_value *same =
            machine_binary(m, MACHINE_EQ, v, machine_resize(m, r, width, is_signed));
        fits = fits ? machine_binary(m, MACHINE_AND, fits, same) : same;
    }
    if (!r) {
        paris_fail_machine();
        return;
    }
    struct machine_value *overflow =
        fits ? machine_unary(m, MACHINE_NOT, fits) : paris_number(m, 1, 0);
    if (!self->overflow || paris_flag_put(m, MACHINE_OVERFLOW, overflow, MACHINE_WHERE_ACTIVE))
        paris_store(m, dest, r, self->scope);
}

void paris_float_part(const struct paris_instruction *self, struct paris_operand dest,
                      struct paris_operand a)
{
    struct machine *m = paris_begin(self->name);
    struct machine_type type, ftype;
    if (!paris_check_dest(dest, a, a, &type))
        return;
    struct machine_value *x = native(m, paris_load(m, a, "source", self->scope));
    if (!x)
        return;
    ftype = machine_value_type(x);
    struct machine_value *zero = is_zero(m, x), *finite = is_finite(m, x), *v = NULL;
    if (!zero || !finite) {
        paris_fail_machine();
        return;
    }
    int len = (int)dest.len, w = EXPONENT_WIDTH, s = (int)a.len;
    switch ((enum paris_float_part_op)self->op) {
    case PARIS_SIGNUM:
        store_integer(m, self, dest,
                      signum(m, x, paris_number(m, len, 1), paris_number(m, len, -1),
                             paris_number(m, len, 0)),
                      NULL);
        return;
    case PARIS_EXPONENT_FIELD:
        store_integer(m, self, dest,
                      paris_load(m, paris_b(a.field + a.len, a.e), "source", self->scope),
                      NULL);
        return;
    case PARIS_EXPONENT: {
        /* for 0 the result is the least number of dest's length */
        int width = len > w ? len : w;
        struct machine_value *n = exponent(m, x);
        v = n ? machine_select(m, finite, n, paris_number(m, w, 0)) : NULL;
        v = v ? machine_resize(m, v, width, true) : NULL;
        struct machine_value *least = machine_constant(
            m, MACHINE_UINT(width),
            len > 64 ? (struct machine_scalar){0, UINT64_MAX << (len - 65)}
                     : (struct machine_scalar){UINT64_MAX << (len - 1), UINT64_MAX});
        struct machine_value *fits =
            machine_binary(m, MACHINE_AND, finite, machine_unary(m, MACHINE_NOT, zero));
        store_integer(m, self, dest, v && least ? machine_select(m, zero, least, v) : NULL,
                      fits);
        return;
    }
    case PARIS_SIGNIFICAND: { /* 1 <= m < 2, times 2^s, as an integer; 0 stays 0 */
        struct machine_value *f = significand_of(m, x, ftype);
        struct machine_value *none = machine_constant_float(m, ftype, 0);
        f = f ? machine_select(m, finite, machine_select(m, zero, none, f), none) : NULL;
        if (f && dest.letter == 'u')
            f = machine_unary(m, MACHINE_FABS, f);
        f = f ? machine_binary(m, MACHINE_FSCALE, f, machine_constant_float(m, ftype, s))
              : NULL;
        v = f ? machine_to_bits(m, f, s + 2, dest.letter == 's') : NULL;
        store_integer(m, self, dest, v, finite);
        return;
    }
    }
}

/* ---- VAX ---- */

/* Both formats have sign, exponent and fraction in this order; a VAX number with exponent field
 * E is the IEEE number with E - 2, and in memory its 16-bit words stand from the highest to the
 * lowest. Exponent 0 is the number 0, or with the sign the reserved operand. */
static struct machine_value *words_reversed(struct machine *m, struct machine_value *v)
{
    int width = machine_value_type(v).width;
    struct machine_value *r = machine_extract(m, v, width - 16, 16);
    for (int at = width - 32; r && at >= 0; at -= 16)
        r = machine_concat(m, r, machine_extract(m, v, at, 16));
    return r;
}

static struct machine_value *scaled_bits(struct machine *m, struct machine_value *bits,
                                         struct machine_type type, double factor)
{
    struct machine_value *x = machine_reinterpret(m, bits, type);
    x = x ? machine_binary(m, MACHINE_FMUL, x, machine_constant_float(m, type, factor)) : NULL;
    return x ? machine_reinterpret(m, x, MACHINE_UINT(type.width)) : NULL;
}

void paris_float_vax(const struct paris_instruction *self, struct paris_operand dest,
                     struct paris_operand a)
{
    struct machine *m = paris_begin(self->name);
    struct machine_type type;
    if (!paris_check_dest(dest, a, a, &type))
        return;
    if (type.s) {
        paris_fail("s, e: the VAX's floats are 23, 8 or 52, 11 (got %u, %u)", dest.len, dest.e);
        return;
    }
    int w = type.width, s = significand_bits(type), e = w - 1 - s;
    bool to_vax = self->op == PARIS_IEEE_TO_VAX;
    struct machine_value *bits =
        paris_load(m, paris_b(a.field, (unsigned int)w), "source", self->scope);
    if (!bits)
        return;
    if (!to_vax)
        bits = words_reversed(m, bits);
    struct machine_value *exponent_bits = bits ? machine_extract(m, bits, s, e) : NULL;
    struct machine_value *two = paris_number(m, w, (int64_t)2 << s),
                         *none = paris_number(m, w, 0);
    /* An exponent field below this is not the other format's plus or minus 2. */
    struct machine_value *low =
        exponent_bits
            ? machine_binary(m, MACHINE_ULT, exponent_bits, paris_number(m, e, to_vax ? 1 : 3))
            : NULL;
    struct machine_value *small = bits ? scaled_bits(m, bits, type, to_vax ? 4 : 0.25) : NULL;
    if (!two || !none || !low || !small) {
        paris_fail_machine();
        return;
    }
    struct machine_value *r, *wrong;
    if (to_vax) {
        struct machine_value *vanishes = machine_binary(
            m, MACHINE_EQ, machine_extract(m, small, s, e), paris_number(m, e, 0));
        r = machine_select(m, low, machine_select(m, vanishes, none, small),
                           machine_binary(m, MACHINE_ADD, bits, two));
        wrong = machine_binary(m, MACHINE_ULE, paris_number(m, e, ((int64_t)1 << e) - 2),
                               exponent_bits);
        r = machine_select(m, wrong, paris_number(m, w, (int64_t)((uint64_t)1 << (w - 1))), r);
        r = r ? words_reversed(m, r) : NULL;
    } else {
        struct machine_value *zero =
            machine_binary(m, MACHINE_EQ, exponent_bits, paris_number(m, e, 0));
        wrong = machine_binary(m, MACHINE_AND, zero, machine_extract(m, bits, w - 1, 1));
        r = machine_select(m, low, small, machine_binary(m, MACHINE_SUB, bits, two));
        r = machine_select(m, zero, none, r);
        r = machine_select(
            m, wrong,
            paris_number(m, w, w == 32 ? 0xffc00000 : (int64_t)UINT64_C(0xfff8000000000000)),
            r);
    }
    if (!r || paris_flag_put(m, MACHINE_OVERFLOW, wrong, MACHINE_WHERE_ACTIVE))
        paris_store(m, dest, r, self->scope);
}

/* ---- tests ---- */

void paris_float_test(const struct paris_instruction *self, struct paris_operand a)
{
    struct machine *m = paris_begin(self->name);
    struct machine_value *x = paris_load(m, a, "source", MACHINE_WHERE_ACTIVE), *r = NULL;
    if (!x)
        return;
    struct machine_type type = machine_value_type(x);
    struct machine_value *magnitude = machine_unary(m, MACHINE_FABS, x);
    struct machine_value *infinity = machine_constant_float(m, type, (double)__builtin_inff());
    struct machine_value *least =
        machine_constant_float(m, type, ldexp(1, 2 - (1 << (a.e - 1))));
    switch ((enum paris_float_test_op)self->op) {
    case PARIS_IS_NAN:
        r = machine_binary(m, MACHINE_FNE, x, x);
        break;
    case PARIS_IS_INFINITY:
        r = machine_binary(m, MACHINE_FEQ, magnitude, infinity);
        break;
    case PARIS_IS_FINITE:
        r = is_finite(m, x);
        break;
    case PARIS_IS_ZERO:
        r = is_zero(m, x);
        break;
    case PARIS_IS_NEGATIVE:
        r = machine_extract(m, x, type.width - 1, 1);
        break;
    case PARIS_IS_NORMAL:
        r = machine_binary(m, MACHINE_AND, is_finite(m, x),
                           machine_binary(m, MACHINE_FGE, magnitude, least));
        break;
    case PARIS_IS_SUBNORMAL: {
        struct machine_value *zero = is_zero(m, x);
        r = machine_binary(m, MACHINE_AND, machine_binary(m, MACHINE_FLT, magnitude, least),
                           zero ? machine_unary(m, MACHINE_NOT, zero) : NULL);
        break;
    }
    }
    paris_flag_put(m, MACHINE_TEST, r, MACHINE_WHERE_ACTIVE);
}

/* ---- exchange ---- */

void paris_float_swap(const struct paris_instruction *self, struct paris_operand dest,
                      struct paris_operand source)
{
    struct machine *m = paris_begin(self->name);
    struct machine_type type;
    if (!paris_check_dest(dest, source, source, &type))
        return;
    struct machine_value *x = paris_load(m, dest, "dest", self->scope);
    struct machine_value *y = x ? paris_load(m, source, "source", self->scope) : NULL;
    if (x && y && paris_store(m, dest, y, self->scope))
        paris_store(m, source, x, self->scope);
}
