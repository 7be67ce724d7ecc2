#include "oracle.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef __int128 signed_number;

static bool is(const char *op, const char *name)
{
    return strcmp(op, name) == 0;
}

static bool ends(const char *op, const char *end)
{
    size_t n = strlen(op), k = strlen(end);
    return n >= k && strcmp(op + n - k, end) == 0;
}

/* ---- integers ---- */

number oracle_mask(int width)
{
    return width >= 128 ? ~(number)0 : ((number)1 << width) - 1;
}

number oracle_extend(number bits, int width, bool is_signed)
{
    bits &= oracle_mask(width);
    if (is_signed && bits >> (width - 1) & 1)
        bits |= ~oracle_mask(width);
    return bits;
}

static bool arithmetic_overflows(const char *op, bool is_signed, number a, number b,
                                 number *result)
{
    if (is(op, "subfrom")) {
        number t = a;
        a = b;
        b = t;
        op = "subtract";
    }
    signed_number x = (signed_number)a, y = (signed_number)b, r = 0;
    bool overflow = false;
    if (is(op, "add"))
        overflow =
            is_signed ? __builtin_add_overflow(x, y, &r) : __builtin_add_overflow(a, b, result);
    else if (is(op, "subtract"))
        overflow =
            is_signed ? __builtin_sub_overflow(x, y, &r) : __builtin_sub_overflow(a, b, result);
    else if (is(op, "multiply"))
        overflow =
            is_signed ? __builtin_mul_overflow(x, y, &r) : __builtin_mul_overflow(a, b, result);
    if (is_signed)
        *result = (number)r;
    return overflow;
}

static bool less(bool is_signed, number a, number b)
{
    return is_signed ? (signed_number)a < (signed_number)b : a < b;
}

struct oracle_result oracle_integer(const char *op, bool is_signed, number a, int alen,
                                    number b, int blen, int dlen)
{
    number x = oracle_extend(a, alen, is_signed), y = oracle_extend(b, blen, is_signed), r = 0;
    struct oracle_result out = {0, false};
    if (is(op, "min")) {
        out.bits = (less(is_signed, x, y) ? x : y) & oracle_mask(dlen);
        return out;
    }
    if (is(op, "max")) {
        out.bits = (less(is_signed, x, y) ? y : x) & oracle_mask(dlen);
        return out;
    }
    if (is(op, "negate") || (is(op, "abs") && less(true, x, 0)))
        out.overflow = arithmetic_overflows("subtract", is_signed, 0, x, &r);
    else if (is(op, "abs"))
        r = x;
    else
        out.overflow = arithmetic_overflows(op, is_signed, x, y, &r);
    out.bits = r & oracle_mask(dlen);
    if (oracle_extend(out.bits, dlen, is_signed) != r)
        out.overflow = true;
    return out;
}

bool oracle_integer_compare(const char *op, bool is_signed, number a, int alen, number b,
                            int blen)
{
    number x = oracle_extend(a, alen, is_signed), y = oracle_extend(b, blen, is_signed);
    bool lt = less(is_signed, x, y), eq = x == y;
    return is(op, "eq")   ? eq
           : is(op, "ne") ? !eq
           : is(op, "lt") ? lt
           : is(op, "le") ? lt || eq
           : is(op, "gt") ? !lt && !eq
                          : !lt;
}

/* ---- floats ---- */

/* All NaNs that arithmetic gives have the same bits. */
static number canonical(int width, double x)
{
    uint32_t low;
    uint64_t all;
    float single = (float)x;
    if (isnan(x))
        return width == 32 ? 0xffc00000u : 0xfff8000000000000u;
    if (width == 32) {
        memcpy(&low, &single, sizeof low);
        return low;
    }
    memcpy(&all, &x, sizeof all);
    return all;
}

number oracle_float_bits(int width, double x)
{
    return canonical(width, x);
}

double oracle_float_value(int width, number bits)
{
    uint32_t low = (uint32_t)bits;
    uint64_t all = (uint64_t)bits;
    float single;
    double x;
    if (width == 32) {
        memcpy(&single, &low, sizeof single);
        return single;
    }
    memcpy(&x, &all, sizeof x);
    return x;
}

/* The last operation that the two functions below know. */
static void expect_root(const char *op)
{
    if (is(op, "sqrt"))
        return;
    fprintf(stderr, "oracle.c does not know %s\n", op);
    abort();
}

static double single_arithmetic(const char *op, float a, float b)
{
    volatile float r = 0;
    if (is(op, "add"))
        r = a + b;
    else if (is(op, "subtract"))
        r = a - b;
    else if (is(op, "subfrom"))
        r = b - a;
    else if (is(op, "multiply"))
        r = a * b;
    else if (is(op, "divide"))
        r = a / b;
    else if (is(op, "divinto"))
        r = b / a;
    else {
        expect_root(op);
        r = sqrtf(a);
    }
    return (double)r;
}

static double double_arithmetic(const char *op, double a, double b)
{
    if (is(op, "add"))
        return a + b;
    if (is(op, "subtract"))
        return a - b;
    if (is(op, "subfrom"))
        return b - a;
    if (is(op, "multiply"))
        return a * b;
    if (is(op, "divide"))
        return a / b;
    if (is(op, "divinto"))
        return b / a;
    expect_root(op);
    return sqrt(a);
}

static double whole(const char *op, double x)
{
    if (ends(op, "floor"))
        return floor(x);
    if (ends(op, "ceiling"))
        return ceil(x);
    if (ends(op, "truncate"))
        return trunc(x);
    return rint(x);
}

struct oracle_result oracle_float(const char *op, int width, number a, number b)
{
    double x = oracle_float_value(width, a), y = oracle_float_value(width, b), r;
    struct oracle_result out = {0, false};
    if (is(op, "min"))
        r = x < y ? x : y;
    else if (is(op, "max"))
        r = x > y ? x : y;
    else if (is(op, "negate"))
        r = -x;
    else if (is(op, "abs"))
        r = fabs(x);
    else if (op[0] == 'f' && op[1] == '_')
        r = whole(op, x);
    else
        r = width == 32 ? single_arithmetic(op, (float)x, (float)y)
                        : double_arithmetic(op, x, y);
    out.bits = canonical(width, r);
    out.overflow = isinf(r) && isfinite(x) && isfinite(y);
    return out;
}

bool oracle_float_compare(const char *op, int width, number a, number b)
{
    double x = oracle_float_value(width, a), y = oracle_float_value(width, b);
    return is(op, "eq")   ? x == y
           : is(op, "ne") ? x != y
           : is(op, "lt") ? x < y
           : is(op, "le") ? x <= y
           : is(op, "gt") ? x > y
                          : x >= y;
}

number oracle_float_move(int to_width, number bits, int from_width)
{
    return to_width == from_width ? bits
                                  : canonical(to_width, oracle_float_value(from_width, bits));
}

/* ---- conversions ---- */

number oracle_to_float(int width, number integer, int len, bool is_signed)
{
    number x = oracle_extend(integer, len, is_signed);
    bool negative = is_signed && (signed_number)x < 0;
    number magnitude = negative ? -x : x, kept = magnitude;
    int digits = width == 32 ? 24 : 53, exponent = 0;
    while (kept >> digits) {
        kept >>= 1;
        exponent++;
    }
    number lost = magnitude - (kept << exponent),
           half = exponent ? (number)1 << (exponent - 1) : 0;
    if (exponent && (lost > half || (lost == half && (kept & 1))))
        kept++;
    double r = ldexp((double)kept, exponent);
    if (width == 32 && r > 3.4028234663852886e38)
        r = INFINITY;
    return canonical(width, negative ? -r : r);
}

struct oracle_result oracle_to_integer(const char *op, int width, number bits, int len,
                                       bool is_signed)
{
    double x = oracle_float_value(width, bits);
    struct oracle_result out = {0, true};
    if (isnan(x))
        return out;
    double r = whole(op, x);
    double low = is_signed ? -ldexp(1, len - 1) : 0,
           beyond = ldexp(1, is_signed ? len - 1 : len);
    if (r < low) {
        out.bits = is_signed ? (number)1 << (len - 1) : 0;
    } else if (r >= beyond) {
        out.bits = oracle_mask(is_signed ? len - 1 : len);
    } else {
        out.overflow = false;
        out.bits = (r < 0 ? -(number)-r : (number)r) & oracle_mask(len);
    }
    return out;
}

/* ---- bits ---- */

number oracle_logical(const char *op, number a, number b)
{
    if (is(op, "logand"))
        return a & b;
    if (is(op, "logior"))
        return a | b;
    if (is(op, "logxor"))
        return a ^ b;
    if (is(op, "logeqv"))
        return ~(a ^ b);
    if (is(op, "lognand"))
        return ~(a & b);
    if (is(op, "lognor"))
        return ~(a | b);
    if (is(op, "logandc1"))
        return ~a & b;
    if (is(op, "logandc2"))
        return a & ~b;
    if (is(op, "logorc1"))
        return ~a | b;
    if (is(op, "logorc2"))
        return a | ~b;
    return ~a; /* lognot */
}
