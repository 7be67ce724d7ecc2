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

/* A case for each row of the table that is a function of math.cl. */
#define CALL_1(function) function(a)
#define CALL_2(function) function(a, b)
#define CASE_FOLD_MATH(op, inputs, function)                                                   \
    case OF_##op:                                                                              \
        *out = CALL_##inputs(function);                                                        \
        return true;
#define CASE_FOLD_NEVER(...)
#define CASE_FOLD_MAKER(...)
#define CASE_FOLD_BITS(...)
#define CASE_FOLD_QUOTIENT(...)
#define CASE_FOLD_POWER(...)
#define CASE_FOLD_SHIFT(...)
#define CASE_FOLD_COUNT(...)
#define WORD(word) math_##word
#define OPERATION(op, name, inputs, takes, gives, cost, nan, fold, spell, word, ...)           \
    CASE_##fold(op, inputs, word)
#define NODE OPERATION

bool math_evaluate(int op, double a, double b, double *out)
{
    switch ((enum op_math)op) {
#include "machine_op.tab"
    }
    return false; /* it is of another family */
}

#undef OPERATION
#undef NODE
#undef WORD

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
