#include "oracle_floats.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

static bool is(const char *op, const char *name)
{
    return strcmp(op, name) == 0;
}

static struct oracle_float result(int width, long double r, int ulp, bool overflow)
{
    double x = width == 32 ? (double)(float)r : (double)r;
    return (struct oracle_float){oracle_float_bits(width, x), ulp, overflow};
}

struct oracle_float oracle_function(const char *op, int width, number a, number b)
{
    static const struct {
        const char *name;
        long double (*f)(long double);
        bool overflows;
    } functions[] = {
        {"exp", expl, true},     {"ln", logl, true},         {"log2", log2l, true},
        {"log10", log10l, true}, {"sin", sinl, false},       {"cos", cosl, false},
        {"tan", tanl, false},    {"asin", asinl, false},     {"acos", acosl, false},
        {"atan", atanl, false},  {"sinh", sinhl, true},      {"cosh", coshl, true},
        {"tanh", tanhl, false},  {"asinh", asinhl, false},   {"acosh", acoshl, false},
        {"atanh", atanhl, true}, {"floor", floorl, false},   {"ceiling", ceill, false},
        {"round", rintl, false}, {"truncate", truncl, false}};
    long double x = (long double)oracle_float_value(width, a),
                y = (long double)oracle_float_value(width, b), r;
    int ulp = width == 32 ? 1 : 2;
    for (size_t i = 0; i < sizeof functions / sizeof functions[0]; i++)
        if (is(op, functions[i].name)) {
            struct oracle_float out = result(width, functions[i].f(x), i < 16 ? ulp : 0, false);
            out.overflow = functions[i].overflows && isfinite(x) &&
                           isinf(oracle_float_value(width, out.bits));
            return out;
        }
    if (is(op, "atan2"))
        return result(width, atan2l(x, y), ulp, false);
    if (is(op, "rem") || is(op, "mod")) {
        r = fmodl(x, y);
        if (is(op, "mod") && r == 0)
            r = copysignl(0, y);
        else if (is(op, "mod") && (r < 0) != (y < 0)) /* NaN stays one */
            r = width == 32 ? (long double)((float)r + (float)y)
                            : (long double)((double)r + (double)y);
        return result(width, r, 0, y == 0);
    }
    struct oracle_float out = result(width, powl(x, y), ulp, false); /* f_power, power */
    out.overflow = isfinite(x) && isfinite(y) && isinf(oracle_float_value(width, out.bits));
    return out;
}

struct oracle_float oracle_by_integer(const char *op, int width, number a, number n, int len,
                                      bool is_signed)
{
    double x = oracle_float_value(width, a);
    number whole = oracle_extend(n, len, is_signed);
    bool negative = is_signed && whole >> 127;
    number magnitude = negative ? -whole : whole;
    struct oracle_float out;
    if (is(op, "scale")) {
        int k = magnitude > 5000 ? 5000 : (int)magnitude;
        out = result(width, (long double)ldexp(x, negative ? -k : k), 0, false);
    } else {
        /* an odd power of a negative number is negative; the bits lost above 2^64 do not
         * matter */
        long double y = (long double)magnitude;
        long double r = powl(fabsl((long double)x), negative ? -y : y);
        if (isnan(x) && magnitude == 0)
            r = 1;
        out = result(width, signbit(x) && (magnitude & 1) ? -r : r, width == 32 ? 1 : 2, false);
    }
    out.overflow = isfinite(x) && isinf(oracle_float_value(width, out.bits));
    return out;
}

static double one(char op, int width, double x, double y)
{
    volatile float f;
    volatile double d;
    if (width == 32) {
        float p = (float)x, q = (float)y;
        f = op == '*' ? p * q : op == '+' ? p + q : p - q;
        return (double)f;
    }
    d = op == '*' ? x * y : op == '+' ? x + y : x - y;
    return d;
}

struct oracle_float oracle_pair(const char *op, int width, number a, number b, number c)
{
    double x = oracle_float_value(width, a), y = oracle_float_value(width, b),
           z = oracle_float_value(width, c), t, r;
    if (op[0] == 'm') {
        t = one('*', width, x, y);
        r = is(op, "mult_add")   ? one('+', width, t, z)
            : is(op, "mult_sub") ? one('-', width, t, z)
                                 : one('-', width, z, t);
    } else {
        t = is(op, "add_mult")   ? one('+', width, x, y)
            : is(op, "sub_mult") ? one('-', width, x, y)
                                 : one('-', width, y, x);
        r = one('*', width, t, z);
    }
    bool finite = isfinite(x) && isfinite(y) && isfinite(z);
    return (struct oracle_float){oracle_float_bits(width, r), 0,
                                 finite && (isinf(r) || isinf(t))};
}

/* A VAX number is (-1)^sign 0.1fraction 2^(exponent - bias); its 16-bit words are in reverse
 * order. */
static struct oracle_float vax(const char *op, int width, number a)
{
    int s = width == 32 ? 23 : 52, e = width - 1 - s, bias = 1 << (e - 1), n = 0;
    number r = 0, plain = 0;
    if (is(op, "ieee_to_vax")) {
        double x = oracle_float_value(width, a);
        double f = isfinite(x) ? frexp(fabs(x), &n) : 0; /* 1/2 <= f < 1 */
        if (!isfinite(x) || n + bias >= 1 << e)
            plain = (number)1 << (width - 1);
        else if (x != 0 && n + bias > 0)
            plain = (number)signbit(x) * ((number)1 << (width - 1)) | (number)(n + bias) << s |
                    ((number)ldexp(f, s + 1) & oracle_mask(s));
        for (int i = 0; i < width / 16; i++)
            r |= (plain >> (16 * i) & 0xffff) << (width - 16 - 16 * i);
        return (struct oracle_float){r, 0, !isfinite(x) || n + bias >= 1 << e};
    }
    for (int i = 0; i < width / 16; i++)
        plain |= (a >> (16 * i) & 0xffff) << (width - 16 - 16 * i);
    bool negative = plain >> (width - 1) & 1;
    n = (int)(plain >> s & oracle_mask(e));
    if (n == 0)
        return (struct oracle_float){negative ? oracle_float_bits(width, (double)NAN) : 0, 0,
                                     negative};
    double f = (double)((plain & oracle_mask(s)) | (number)1 << s);
    double x = ldexp(negative ? -f : f, n - bias - s - 1);
    return (struct oracle_float){oracle_float_bits(width, x), 0, false};
}

struct oracle_float oracle_made(const char *op, int width, number a)
{
    double x = oracle_float_value(width, a);
    int n;
    if (strstr(op, "vax"))
        return vax(op, width, a);
    if (!is(op, "f_significand"))
        return result(width, x > 0 ? 1 : x < 0 ? -1 : (long double)x, 0, false);
    if (!isfinite(x) || x == 0)
        return result(width, (long double)x, 0, false);
    return result(width, (long double)(2 * frexp(x, &n)), 0, false);
}

struct oracle_result oracle_part(const char *op, int width, number a, int dlen, bool is_signed)
{
    double x = oracle_float_value(width, a);
    int s = width == 32 ? 23 : 52, n = 0;
    __int128 r;
    struct oracle_result out = {0, false};
    double m = isfinite(x) ? frexp(x, &n) : 0;
    if (is(op, "signum")) {
        r = x > 0 ? 1 : x < 0 ? -1 : 0;
    } else if (is(op, "significand")) {
        r = (__int128)ldexp(is_signed ? m : fabs(m), s + 1);
        out.overflow = !isfinite(x);
    } else if (is_signed) { /* exponent */
        r = x == 0 ? (__int128)(~(number)0 << (dlen - 1)) : isfinite(x) ? n - 1 : 0;
        out.overflow = x == 0 || !isfinite(x);
    } else {
        r = (__int128)((a >> s) & oracle_mask(width - 1 - s));
    }
    out.bits = (number)r & oracle_mask(dlen);
    if (oracle_extend(out.bits, dlen, is_signed) != (number)r)
        out.overflow = true;
    return out;
}

bool oracle_float_test(const char *op, int width, number a)
{
    double x = oracle_float_value(width, a), least = width == 32 ? 0x1p-126 : 0x1p-1022;
    return is(op, "is_nan")         ? isnan(x)
           : is(op, "is_finite")    ? isfinite(x)
           : is(op, "is_zero")      ? x == 0
           : is(op, "is_negative")  ? (a >> (width - 1) & 1) != 0
           : is(op, "is_normal")    ? isfinite(x) && fabs(x) >= least
           : is(op, "is_subnormal") ? x != 0 && fabs(x) < least
                                    : isinf(x);
}

static int64_t place(int width, number bits)
{
    int64_t magnitude = (int64_t)(bits & oracle_mask(width - 1));
    return bits >> (width - 1) & 1 ? -magnitude : magnitude;
}

bool oracle_float_near(int width, number got, number wanted, int ulp)
{
    if (got == wanted)
        return true;
    if (isnan(oracle_float_value(width, wanted)) || isnan(oracle_float_value(width, got)))
        return false;
    int64_t a = place(width, got), b = place(width, wanted);
    return (got ^ wanted) >> (width - 1) == 0 && llabs(a - b) <= ulp;
}
