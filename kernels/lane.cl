/* lane.cl - one operation on one lane, whatever it is: what the interpreter of a device
 * performs (interpret.cl).
 *
 * A lane is its bits, zero-extended to 128. host/machine/interpret/lane_by_folding.c has the
 * same operations for the front end; both must agree to the bit. This file follows prelude.cl,
 * wide.cl, soft.cl, integers.cl and, with MATH, math.cl; VECTOR is 1. Before it stand the
 * numbers of operations and families (#define MACHINE_ADD ..., #define SPELL_BITS ...), and
 * INTEGER_CASES and MATH_CASES, which are made of the rows of these families
 * (host/machine/interpret/device_code.c).
 *
 * A switch over another family has a case for each operation of it: test machine_operations.
 * What is of no family gives 0. */

/* What a step says, beside its places. */
typedef struct {
    int op, family, detail;   /* family: SPELL_BITS and so on */
    int from_width, to_width; /* of the first operand, of the result */
    int from_float;
    int from_s, from_e, to_s, to_e; /* formats of floats; s 0: single or double */
} step_said;

/* ---- numbers as lanes hold them ---- */

static VQ lane_ones(int width)
{
    return width > 64    ? q_cut(q_of(~0UL, ~0UL), width)
           : width == 64 ? q_of(~0UL, 0)
                         : q_of((1UL << width) - 1, 0);
}

static int lane_sign(VQ a, int width)
{
    return (int)(width > 64 ? a.hi >> (width - 65) : a.lo >> (width - 1)) & 1;
}

/* All 128 bits of a signed number of that width. */
static VQ lane_extended(VQ a, int width)
{
    return width > 64 ? q_extended(a, width)
                      : q_signed((long)(a.lo << (64 - width)) >> (64 - width));
}

/* 2 to the power e, as a double */
static double power_of_two(int e)
{
    return as_double((ulong)(1023 + e) << 52);
}

/* ---- bits ---- */

static int product_overflows(VQ a, VQ b, int w)
{
    if (w > 64)
        return q_umul_overflows(a, b, w) & 1;
    return mul_hi(a.lo, b.lo) != 0 || (w < 64 && a.lo * b.lo >> w != 0);
}

static int signed_product_overflows(VQ a, VQ b, int w)
{
    if (w > 64)
        return q_smul_overflows(a, b, w) & 1;
    return l_smul_overflows((long)lane_extended(a, w).lo, (long)lane_extended(b, w).lo, w) & 1;
}

/* Whether the sign of a sum or difference r is wrong: b as it would be added. */
static int sign_overflows(VQ a, VQ b, VQ r, int w)
{
    return lane_sign(q_and(q_xor(a, r), q_xor(b, r)), w);
}

#define OF_WIDTH(small, large) (w > 64 ? (large) : q_of(small, 0))

static VQ integers(const step_said *s, VQ a, VQ b)
{
    const int w = s->from_width;
    const uint n = (uint)b.lo; /* of shifts */
    switch (s->op) {
        INTEGER_CASES
    }
    return q_of(0, 0);
}

/* Comparisons, and whether a result does not fit. */
static int bit(const step_said *s, VQ a, VQ b)
{
    const int w = s->from_width;
    switch (s->op) {
    case MACHINE_EQ:
        return q_eq(a, b) & 1;
    case MACHINE_NE:
        return ~q_eq(a, b) & 1;
    case MACHINE_ULT:
    case NODE_OVERFLOW_USUB:
        return q_ult(a, b) & 1;
    case MACHINE_ULE:
        return ~q_ult(b, a) & 1;
    case MACHINE_SLT:
        return q_slt(lane_extended(a, w), lane_extended(b, w), 128) & 1;
    case MACHINE_SLE:
        return ~q_slt(lane_extended(b, w), lane_extended(a, w), 128) & 1;
    case NODE_OVERFLOW_UADD:
        return q_ult(q_and(q_add(a, b), lane_ones(w)), a) & 1;
    case NODE_OVERFLOW_UMUL:
        return product_overflows(a, b, w);
    case NODE_OVERFLOW_SADD:
        return sign_overflows(a, b, q_add(a, b), w);
    case NODE_OVERFLOW_SSUB:
        return sign_overflows(a, q_not(b), q_sub(a, b), w);
    case NODE_OVERFLOW_SMUL:
        return signed_product_overflows(a, b, w);
    case NODE_OVERFLOW_SNEG:
        return q_eq(a, w > 64 ? q_shl(q_of(1, 0), w - 1) : q_of(1UL << (w - 1), 0)) & 1;
    }
    return 0;
}

static VQ bits(const step_said *s, VQ a, VQ b)
{
    const int w = s->from_width;
    switch (s->op) {
    case MACHINE_NOT:
        return q_not(a);
    case MACHINE_NEG:
        return q_neg(a);
    case MACHINE_AND:
        return q_and(a, b);
    case MACHINE_OR:
        return q_or(a, b);
    case MACHINE_XOR:
        return q_xor(a, b);
    case MACHINE_ADD:
        return q_add(a, b);
    case MACHINE_SUB:
        return q_sub(a, b);
    case MACHINE_MUL:
        return OF_WIDTH(a.lo * b.lo, q_mul(a, b));
    case MACHINE_UMIN:
        return q_ult(a, b) ? a : b;
    case MACHINE_UMAX:
        return q_ult(b, a) ? a : b;
    case MACHINE_SMIN:
        return q_slt(lane_extended(a, w), lane_extended(b, w), 128) ? a : b;
    case MACHINE_SMAX:
        return q_slt(lane_extended(a, w), lane_extended(b, w), 128) ? b : a;
    }
    return q_of((ulong)bit(s, a, b), 0); /* a comparison */
}

/* ---- floats ---- */

/* A sum, difference, product or quotient. */
static ulong float_operator(int op, const step_said *s, ulong a, ulong b)
{
    const float f = as_float((uint)a), g = as_float((uint)b);
    const double x = as_double(a), y = as_double(b);
    switch (op) {
    case MACHINE_FADD:
        return s->from_s             ? soft_add(a, b, s->from_s, s->from_e)
               : s->from_width == 32 ? as_uint(f + g)
                                     : as_ulong(x + y);
    case MACHINE_FSUB:
        return s->from_s             ? soft_add(a, b ^ SOFT_SIGN, s->from_s, s->from_e)
               : s->from_width == 32 ? as_uint(f - g)
                                     : as_ulong(x - y);
    case MACHINE_FMUL:
        return s->from_s             ? soft_multiply(a, b, s->from_s, s->from_e)
               : s->from_width == 32 ? as_uint(f * g)
                                     : as_ulong(x * y);
    case MACHINE_FDIV:
        return s->from_s             ? soft_divide(a, b, s->from_s, s->from_e)
               : s->from_width == 32 ? as_uint(f / g)
                                     : as_ulong(x / y);
    }
    return 0;
}

static ulong float_function(const step_said *s, ulong a)
{
    const int single = s->from_width == 32;
    const float f = as_float((uint)a);
    const double x = as_double(a);
    switch (s->op) {
    case MACHINE_FNEG:
        return a ^ 1UL << (s->from_width - 1);
    case MACHINE_FABS:
        return a & ~(1UL << (s->from_width - 1));
    case MACHINE_FSQRT:
        return s->from_s ? soft_root(a, s->from_s, s->from_e)
               : single  ? as_uint(sqrt(f))
                         : as_ulong(sqrt(x));
    case MACHINE_FFLOOR:
        return single ? as_uint(floor(f)) : as_ulong(floor(x));
    case MACHINE_FCEIL:
        return single ? as_uint(ceil(f)) : as_ulong(ceil(x));
    case MACHINE_FTRUNC:
        return single ? as_uint(trunc(f)) : as_ulong(trunc(x));
    case MACHINE_FROUND:
        return single ? as_uint(rint(f)) : as_ulong(rint(x));
    }
    return 0;
}

static double lane_double(ulong a, int width)
{
    return width == 32 ? (double)as_float((uint)a) : as_double(a);
}

static int is_infinite(ulong a, int width)
{
    return width == 32 ? (a & 0x7fffffff) == 0x7f800000 : (a & ~SOFT_SIGN) == SOFT_INFINITE;
}

static int is_finite(ulong a, int width)
{
    return width == 32 ? (a & 0x7f800000) != 0x7f800000 : (a & SOFT_INFINITE) != SOFT_INFINITE;
}

/* As compared, or chosen by comparing. */
static ulong float_compared(const step_said *s, ulong a, ulong b)
{
    const double x = lane_double(a, s->from_width), y = lane_double(b, s->from_width);
    switch (s->op) {
    case MACHINE_FMIN:
        return x < y ? a : b;
    case MACHINE_FMAX:
        return x > y ? a : b;
    case MACHINE_FEQ:
        return x == y;
    case MACHINE_FNE:
        return x != y;
    case MACHINE_FLT:
        return x < y;
    case MACHINE_FLE:
        return x <= y;
    case MACHINE_FGT:
        return x > y;
    case MACHINE_FGE:
        return x >= y;
    }
    return 0;
}

static int float_overflows(const step_said *s, ulong a, ulong b)
{
    const int w = s->from_width;
    ulong r = a;
    switch (s->op) {
    case NODE_OVERFLOW_FADD:
        r = float_operator(MACHINE_FADD, s, a, b);
        break;
    case NODE_OVERFLOW_FSUB:
        r = float_operator(MACHINE_FSUB, s, a, b);
        break;
    case NODE_OVERFLOW_FMUL:
        r = float_operator(MACHINE_FMUL, s, a, b);
        break;
    case NODE_OVERFLOW_FDIV:
        r = float_operator(MACHINE_FDIV, s, a, b);
        break;
    case NODE_OVERFLOW_RESULT: /* a is the result */
        return is_infinite(a, w) && is_finite(b, w);
    }
    return is_infinite(r, w) && is_finite(a, w) && is_finite(b, w);
}

#if MATH
static double float_function_of(int op, double x, double y)
{
    switch (op) {
        MATH_CASES
    }
    return 0;
}

static ulong float_math(const step_said *s, ulong a, ulong b)
{
    const double r =
        float_function_of(s->op, lane_double(a, s->from_width), lane_double(b, s->from_width));
    return s->to_width == 32 ? as_uint((float)r) : as_ulong(r);
}
#else
#define float_math(s, a, b) 0
#endif

/* ---- between bits and floats ---- */

static ulong bits_to_float(const step_said *s, VQ a)
{
    const int w = s->from_width, negative = s->op == NODE_S_TO_F && lane_sign(a, w);
    const VQ m = negative ? q_and(q_neg(a), lane_ones(w)) : a;
    if (s->to_s)
        return soft_whole(negative, m.lo, m.hi, s->to_s, s->to_e);
    if (s->to_width == 32) {
        const float f = w > 64 ? q_to_f(m) : (float)m.lo;
        return as_uint(negative ? -f : f);
    }
    const double x = w > 64 ? q_to_d(m) : (double)m.lo;
    return as_ulong(negative ? -x : x);
}

static VQ float_to_bits(const step_said *s, ulong a)
{
    const int w = s->to_width, is_signed = s->op == NODE_F_TO_S, e = is_signed ? w - 1 : w;
    const double v = lane_double(a, s->from_width), limit = power_of_two(e);
    const ulong top = e == 64 ? ~0UL : (1UL << (e & 63)) - 1;
    if (w > 64)
        return is_signed ? d_to_sq(v, limit, w) : d_to_uq(v, limit, w);
    return q_of(is_signed ? d_to_s(v, limit, (long)top) : d_to_u(v, limit, top), 0);
}

static ulong float_to_float(const step_said *s, ulong a)
{
    if (s->from_width == s->to_width)
        return a;
    return s->to_width == 32 ? as_uint((float)as_double(a))
                             : as_ulong((double)as_float((uint)a));
}

static ulong canonical(const step_said *s, ulong a)
{
    if (s->to_width == 32)
        return (a & 0x7fffffff) > 0x7f800000 ? 0xffc00000 : a;
    return (a & ~SOFT_SIGN) > SOFT_INFINITE ? SOFT_NAN : a;
}

/* ---- any ---- */

static VQ converted(const step_said *s, VQ a, VQ b)
{
    switch (s->op) {
    case NODE_ZERO_EXTEND:
    case NODE_EXTRACT:
        return q_shr(a, s->detail);
    case NODE_SIGN_EXTEND:
        return lane_extended(a, s->from_width);
    case LANES_JOIN:
        return q_or(a, q_shl(b, s->detail));
    case NODE_U_TO_F:
    case NODE_S_TO_F:
        return q_of(bits_to_float(s, a), 0);
    case NODE_F_TO_U:
    case NODE_F_TO_S:
        return float_to_bits(s, a.lo);
    case NODE_F_TO_F:
        return q_of(float_to_float(s, a.lo), 0);
    case NODE_PACK:
        return q_of(soft_pack(a.lo, s->from_s, s->from_e), 0);
    case NODE_UNPACK:
        return q_of(soft_unpack(a.lo, s->to_s, s->to_e), 0);
    case LANES_FIT:
        return q_of(soft_fit(a.lo, s->to_s, s->to_e), 0);
    case LANES_CANONICAL:
        return q_of(canonical(s, a.lo), 0);
    case LANES_COPY:
        return a;
    }
    return q_of(0, 0);
}

static VQ lane_performed(const step_said *s, VQ a, VQ b, VQ c)
{
    switch (s->family) {
    case SPELL_SELECT:
        return a.lo ? b : c;
    case SPELL_BITS_ONE:
    case SPELL_BITS:
        return bits(s, a, b);
    case SPELL_INTEGER:
        return integers(s, a, b);
    case SPELL_OVERFLOW:
        return q_of((ulong)(s->from_float ? float_overflows(s, a.lo, b.lo) : bit(s, a, b)), 0);
    case SPELL_FLOAT_FUNCTION:
        return q_of(float_function(s, a.lo), 0);
    case SPELL_FLOAT_OPERATOR:
        return q_of(float_operator(s->op, s, a.lo, b.lo), 0);
    case SPELL_FLOAT_CHOICE:
    case SPELL_FLOAT_COMPARISON:
        return q_of(float_compared(s, a.lo, b.lo), 0);
    case SPELL_MATH:
        return q_of(float_math(s, a.lo, b.lo), 0);
    case SPELL_CONVERSION:
        return converted(s, a, b);
    }
    return q_of(0, 0);
}
