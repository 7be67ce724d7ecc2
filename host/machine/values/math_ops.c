/* math_ops.c - kernels/math.cl for the front end: what the device computes, to the bit. */
#include "values/math_ops.h"

#include <math.h>
#include <string.h>

#include "base/op_families.h"
#include "base/scalar.h"

static inline uint64_t bits_of(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static inline double double_of(uint64_t bits)
{
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

typedef uint64_t math_u64;
typedef int64_t math_i64;
#define MATH_FUNCTION static
#define MATH_BITS(x) bits_of(x)
#define MATH_DOUBLE(x) double_of(x)
#define MATH_MUL_HI(a, b) ((uint64_t)(((unsigned __int128)(a) * (b)) >> 64))
#define MATH_CLZ(x) __builtin_clzll(x)
#define TABLE(type, name, count) static const type name[count]
#define ulong uint64_t
#include "math_tables.cl"
/* and then */
#include "math.cl"
#include "math_others.cl"
#undef ulong

bool math_evaluate(int op, double a, double b, double *out)
{
    switch ((enum op_math)op) {
    case OF_MACHINE_FEXP:
        *out = math_exp(a);
        return true;
    case OF_MACHINE_FLN:
        *out = math_ln(a);
        return true;
    case OF_MACHINE_FLOG2:
        *out = math_log2(a);
        return true;
    case OF_MACHINE_FLOG10:
        *out = math_log10(a);
        return true;
    case OF_MACHINE_FSIN:
        *out = math_sin(a);
        return true;
    case OF_MACHINE_FCOS:
        *out = math_cos(a);
        return true;
    case OF_MACHINE_FTAN:
        *out = math_tan(a);
        return true;
    case OF_MACHINE_FASIN:
        *out = math_asin(a);
        return true;
    case OF_MACHINE_FACOS:
        *out = math_acos(a);
        return true;
    case OF_MACHINE_FATAN:
        *out = math_atan(a);
        return true;
    case OF_MACHINE_FSINH:
        *out = math_sinh(a);
        return true;
    case OF_MACHINE_FCOSH:
        *out = math_cosh(a);
        return true;
    case OF_MACHINE_FTANH:
        *out = math_tanh(a);
        return true;
    case OF_MACHINE_FASINH:
        *out = math_asinh(a);
        return true;
    case OF_MACHINE_FACOSH:
        *out = math_acosh(a);
        return true;
    case OF_MACHINE_FATANH:
        *out = math_atanh(a);
        return true;
    case OF_MACHINE_FATAN2:
        *out = math_atan2(a, b);
        return true;
    case OF_MACHINE_FPOW:
        *out = math_pow(a, b);
        return true;
    case OF_MACHINE_FMOD:
        *out = math_mod(a, b);
        return true;
    case OF_MACHINE_FREM:
        *out = math_rem(a, b);
        return true;
    case OF_MACHINE_FSCALE:
        *out = math_ldexp(a, b);
        return true;
    }
    return false; /* it is of another family */
}

/* Almost always the C library's result says which single it is. Its error is below a 2^53rd,
 * and 2^50ths are allowed for. */
static bool exp_single(double a, double *out)
{
    double r = fabs(a) < 80 ? exp(a) : 0, less = r - r * 0x1p-50, more = r + r * 0x1p-50;
    *out = r;
    return r > 0 && (float)less == (float)more;
}

bool math_evaluate_single(int op, double a, double b, double *out)
{
    return (op == MACHINE_FEXP && exp_single(a, out)) || math_evaluate(op, a, b, out);
}

bool math_fold(int op, struct machine_type type, struct machine_scalar a,
               struct machine_scalar b, struct machine_scalar *out)
{
    double r;
    out->hi = 0;
    if (type.width == 64) {
        if (!math_evaluate(op, double_of(a.lo), double_of(b.lo), &r))
            return false;
        out->lo = isnan(r) ? NAN_64 : bits_of(r);
        return true;
    }
    uint32_t low[2] = {(uint32_t)a.lo, (uint32_t)b.lo};
    float single[2];
    memcpy(single, low, sizeof single);
    if (!math_evaluate_single(op, (double)single[0], (double)single[1], &r))
        return false;
    single[0] = (float)r;
    memcpy(low, single, sizeof low);
    out->lo = isnan(r) ? NAN_32 : low[0];
    return true;
}
