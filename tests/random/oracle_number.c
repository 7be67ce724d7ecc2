/* oracle_number.c - see oracle_number.h. */
#include "oracle_number.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

wide wide_mask(int bits)
{
    return bits >= 128 ? ~(wide)0 : ((wide)1 << bits) - 1;
}

signed_wide wide_signed(wide x, int bits)
{
    wide sign = (wide)1 << (bits - 1);

    x &= wide_mask(bits);
    return (signed_wide)((x ^ sign) - sign);
}

/* ---- integers ---- */

static bool fits(wide exact, bool is_signed, int bits)
{
    return is_signed ? wide_signed(exact, bits) == (signed_wide)exact
                     : (exact & wide_mask(bits)) == exact;
}

static wide exact_arithmetic(enum op op, bool is_signed, wide a, wide b, bool *wraps)
{
    signed_wide s = 0;
    wide u = 0;

    switch ((int)op) {
    case OP_ADD:
        *wraps = is_signed ? __builtin_add_overflow((signed_wide)a, (signed_wide)b, &s)
                           : __builtin_add_overflow(a, b, &u);
        break;
    case OP_SUBTRACT:
        *wraps = is_signed ? __builtin_sub_overflow((signed_wide)a, (signed_wide)b, &s)
                           : __builtin_sub_overflow(a, b, &u);
        break;
    case OP_MULTIPLY:
        *wraps = is_signed ? __builtin_mul_overflow((signed_wide)a, (signed_wide)b, &s)
                           : __builtin_mul_overflow(a, b, &u);
        break;
    default:
        abort();
    }
    return is_signed ? (wide)s : u;
}

static bool is_less(bool is_signed, wide a, wide b)
{
    return is_signed ? (signed_wide)a < (signed_wide)b : a < b;
}

/* x / 0 is 0, with remainder x. The least number / -1 is the least number. */
static wide divided(enum op op, bool is_signed, wide a, wide b, int bits, bool *overflows)
{
    signed_wide x = (signed_wide)a, y = (signed_wide)b;
    wide q = 0, left = a;

    *overflows = b == 0;
    if (b && !is_signed) {
        q = a / b;
        left = a % b;
    } else if (b) {
        q = y == -1 ? -a : (wide)(x / y);
        signed_wide r = y == -1 ? 0 : x % y;
        left = (wide)(r && (r < 0) != (y < 0) ? r + y : r);
    }
    wide result = op == OP_MOD ? left : q;
    bool out_of_128 = op == OP_TRUNCATE && is_signed && y == -1 && x < 0 && (signed_wide)q < 0;
    *overflows = *overflows || out_of_128 || !fits(result, is_signed, bits);
    return result & wide_mask(bits);
}

/* Shifts one place at a time. */
static wide shifted(signed_wide a, signed_wide count, int bits, bool *overflows)
{
    *overflows = false;
    for (; count > 0 && a; count--) {
        *overflows = *overflows || bits < 2 || !fits((wide)a, true, bits - 1);
        a = wide_signed((wide)a * 2, bits);
    }
    for (; count < 0 && a && a != -1; count++)
        a = a >> 1;
    return (wide)a & wide_mask(bits);
}

wide number_integer(enum op op, bool is_signed, wide a, wide b, int bits, bool *overflows)
{
    bool wraps = false;
    wide exact;

    switch ((int)op) {
    case OP_ADD:
    case OP_SUBTRACT:
    case OP_MULTIPLY:
        exact = exact_arithmetic(op, is_signed, a, b, &wraps);
        *overflows = wraps || !fits(exact, is_signed, bits);
        return exact & wide_mask(bits);
    case OP_NEGATE:
        return number_integer(OP_SUBTRACT, is_signed, 0, a, bits, overflows);
    case OP_ABS:
        if ((signed_wide)a < 0)
            return number_integer(OP_SUBTRACT, is_signed, 0, a, bits, overflows);
        *overflows = !fits(a, is_signed, bits);
        return a & wide_mask(bits);
    case OP_TRUNCATE:
    case OP_MOD:
        return divided(op, is_signed, a, b, bits, overflows);
    case OP_SHIFT:
        return shifted((signed_wide)a, (signed_wide)b, bits, overflows);
    case OP_MIN:
        return (is_less(is_signed, a, b) ? a : b) & wide_mask(bits);
    case OP_MAX:
        return (is_less(is_signed, a, b) ? b : a) & wide_mask(bits);
    case OP_AND:
        return a & b;
    case OP_IOR:
        return a | b;
    case OP_XOR:
        return a ^ b;
    case OP_NOT:
        return ~a & wide_mask(bits);
    case OP_MOVE:
        return a & wide_mask(bits);
    case OP_ZERO:
        return 0;
    default:
        abort();
    }
}

static bool compared(enum op op, bool less, bool equal, bool greater)
{
    switch ((int)op) {
    case OP_EQ:
        return equal;
    case OP_NE:
        return !equal;
    case OP_LT:
        return less;
    case OP_LE:
        return less || equal;
    case OP_GT:
        return greater;
    case OP_GE:
        return greater || equal;
    default:
        abort();
    }
}

bool number_compare_integer(enum op op, bool is_signed, wide a, wide b)
{
    return compared(op, is_less(is_signed, a, b), a == b, is_less(is_signed, b, a));
}

/* ---- floats ---- */

uint64_t number_nan(int float_bits)
{
    return float_bits == 32 ? 0xffc00000u : 0xfff8000000000000u;
}

static float single(uint64_t bits)
{
    uint32_t low = (uint32_t)bits;
    float x;

    memcpy(&x, &low, sizeof x);
    return x;
}

static double real(uint64_t bits)
{
    double x;

    memcpy(&x, &bits, sizeof x);
    return x;
}

static uint64_t single_bits(float x)
{
    uint32_t low;

    memcpy(&low, &x, sizeof low);
    return isnan(x) ? number_nan(32) : low;
}

static uint64_t real_bits(double x)
{
    uint64_t bits;

    memcpy(&bits, &x, sizeof bits);
    return isnan(x) ? number_nan(64) : bits;
}

double number_value(uint64_t a, int float_bits)
{
    return float_bits == 32 ? (double)single(a) : real(a);
}

uint64_t number_real(double x, int float_bits)
{
    return float_bits == 32 ? single_bits((float)x) : real_bits(x);
}

uint64_t number_resize_float(uint64_t a, int from_bits, int to_bits)
{
    return from_bits == to_bits ? a : number_real(number_value(a, from_bits), to_bits);
}

/* min and max return the bits of one operand, unless it is a NaN. */
#define FLOAT_ARITHMETIC(function, type, bits_of, of_bits, square_root, absolute)              \
    static uint64_t function(enum op op, uint64_t pa, uint64_t pb, bool *overflows)            \
    {                                                                                          \
        type a = of_bits(pa), b = of_bits(pb), result;                                         \
                                                                                               \
        switch ((int)op) {                                                                     \
        case OP_ADD:                                                                           \
            result = a + b;                                                                    \
            break;                                                                             \
        case OP_SUBTRACT:                                                                      \
            result = a - b;                                                                    \
            break;                                                                             \
        case OP_MULTIPLY:                                                                      \
            result = a * b;                                                                    \
            break;                                                                             \
        case OP_DIVIDE:                                                                        \
            result = a / b;                                                                    \
            break;                                                                             \
        case OP_MIN:                                                                           \
            return bits_of(a < b ? a : b);                                                     \
        case OP_MAX:                                                                           \
            return bits_of(a > b ? a : b);                                                     \
        case OP_NEGATE:                                                                        \
            return bits_of(-a);                                                                \
        case OP_ABS:                                                                           \
            return bits_of(absolute(a));                                                       \
        case OP_SQRT:                                                                          \
            return bits_of(square_root(a));                                                    \
        default:                                                                               \
            abort();                                                                           \
        }                                                                                      \
        *overflows = isinf(result) && isfinite(a) && isfinite(b);                              \
        return bits_of(result);                                                                \
    }

FLOAT_ARITHMETIC(single_arithmetic, float, single_bits, single, sqrtf, fabsf)
FLOAT_ARITHMETIC(real_arithmetic, double, real_bits, real, sqrt, fabs)

uint64_t number_float(enum op op, int bits, uint64_t a, uint64_t b, bool *overflows)
{
    if (op == OP_MOVE)
        return a;
    if (op == OP_ZERO)
        return 0;
    return bits == 32 ? single_arithmetic(op, a, b, overflows)
                      : real_arithmetic(op, a, b, overflows);
}

/* A NaN is neither less, equal nor greater. */
bool number_compare_float(enum op op, int bits, uint64_t pa, uint64_t pb)
{
    double a = number_value(pa, bits), b = number_value(pb, bits);

    return compared(op, a<b, a == b, a> b);
}

/* ---- conversions ---- */

uint64_t number_from_integer(bool is_signed, wide a, int float_bits)
{
    if (float_bits == 32)
        return single_bits(is_signed ? (float)(signed_wide)a : (float)a);
    return real_bits(is_signed ? (double)(signed_wide)a : (double)a);
}

/* A number out of range gives the range's nearest end, NaN gives 0. Both are overflows. */
wide number_to_integer(enum op op, bool is_signed, uint64_t a, int float_bits, int bits,
                       bool *overflows)
{
    double x = number_value(a, float_bits), limit = ldexp(1.0, is_signed ? bits - 1 : bits);
    double lowest = is_signed ? -limit : 0.0;

    switch ((int)op) {
    case OP_TRUNCATE:
        x = trunc(x);
        break;
    case OP_FLOOR:
        x = floor(x);
        break;
    case OP_CEILING:
        x = ceil(x);
        break;
    case OP_ROUND:
        x = rint(x);
        break;
    default:
        abort();
    }
    *overflows = !(x >= lowest && x < limit);
    if (isnan(x))
        return 0;
    if (x < lowest)
        return is_signed ? (wide)1 << (bits - 1) : 0;
    if (x >= limit)
        return wide_mask(is_signed ? bits - 1 : bits);
    return (is_signed ? (wide)(signed_wide)x : (wide)x) & wide_mask(bits);
}

/* ---- reductions: machine_reduce() in machine.h states their order ---- */

static uint64_t together(enum op op, uint64_t so_far, uint64_t next, int bits)
{
    bool ignored;

    if (op == OP_ADD)
        return number_float(OP_ADD, bits, so_far, next, &ignored);
    return number_compare_float(op == OP_MIN ? OP_LT : OP_GT, bits, next, so_far) ? next
                                                                                  : so_far;
}

uint64_t number_float_reduce(enum op op, const uint64_t *values, const bool *active,
                             uint64_t count, int last_axis, int bits)
{
    enum { RUN = 4096, COLUMNS = 16 };
    uint64_t identity = number_real(op == OP_ADD   ? 0.0
                                    : op == OP_MIN ? __builtin_inf()
                                                   : -__builtin_inf(),
                                    bits);
    uint64_t *sums = calloc(count + 1, sizeof *sums), runs = 0, total;

    if (!sums)
        abort();
    for (uint64_t row = 0; row < count; row += (uint64_t)last_axis)
        for (int start = 0; start < last_axis; start += RUN) {
            uint64_t partial[COLUMNS];
            int length = last_axis - start < RUN ? last_axis - start : RUN;

            for (int k = 0; k < COLUMNS; k++)
                partial[k] = identity;
            for (int k = 0; k < length; k++)
                if (active[row + (uint64_t)(start + k)])
                    partial[k % COLUMNS] = together(op, partial[k % COLUMNS],
                                                    values[row + (uint64_t)(start + k)], bits);
            for (int half = COLUMNS / 2; half > 0; half /= 2)
                for (int k = 0; k < half; k++)
                    partial[k] = together(op, partial[k], partial[k + half], bits);
            sums[runs++] = partial[0];
        }
    for (; runs > 1; runs = (runs + 1) / 2)
        for (uint64_t k = 0; 2 * k < runs; k++)
            sums[k] = 2 * k + 1 < runs ? together(op, sums[2 * k], sums[2 * k + 1], bits)
                                       : sums[2 * k];
    total = sums[0];
    free(sums);
    return total;
}
