/* machine_op.h - the operations on values: see machine_unary() and machine_binary(). */
#ifndef LUTETIA_MACHINE_OP_H
#define LUTETIA_MACHINE_OP_H

enum machine_op {
    /* bits -> bits, one operand */
    MACHINE_NOT,
    MACHINE_NEG,
    /* bits, bits -> bits, all of one width, modulo 2^width */
    MACHINE_AND,
    MACHINE_OR,
    MACHINE_XOR,
    MACHINE_ADD,
    MACHINE_SUB,
    MACHINE_MUL,
    MACHINE_UMIN,
    MACHINE_UMAX,
    MACHINE_SMIN,
    MACHINE_SMAX,
    /* bits, bits -> bit */
    MACHINE_EQ,
    MACHINE_NE,
    MACHINE_ULT,
    MACHINE_ULE,
    MACHINE_SLT,
    MACHINE_SLE,
    /* Integers beyond these: integers.c.
       bits, bits -> bits, all of one width. Quotients are rounded toward zero (DIV), down
       (FLOOR), up (CEIL), to nearest with halves to even (ROUND); REM has the sign of a, MOD
       that of b. A quotient by zero is 0, what remains of a by zero is a. POW: modulo 2^width,
       b unsigned. */
    MACHINE_UDIV,
    MACHINE_UCEIL,
    MACHINE_UROUND,
    MACHINE_UREM,
    MACHINE_SDIV,
    MACHINE_SFLOOR,
    MACHINE_SCEIL,
    MACHINE_SROUND,
    MACHINE_SREM,
    MACHINE_SMOD,
    MACHINE_POW,
    /* bits, bits -> bit: a to the b (b unsigned) is not a number of that width */
    MACHINE_UPOW_BEYOND,
    MACHINE_SPOW_BEYOND,
    /* bits, and a signed number of 32 bits (-128..128) -> bits: to the left by so many, to the
       right where it is negative; S keeps the sign. ROTATE: 0 to width - 1. Made by
       machine_bits_shift() */
    MACHINE_USHIFT,
    MACHINE_SSHIFT,
    MACHINE_ROTATE,
    /* bits -> bits */
    MACHINE_POPCOUNT, /* how many are 1 */
    MACHINE_LENGTH,   /* the place of the highest 1, from 1 on; 0: there is none */
    MACHINE_REVERSE,  /* the last bit first */
    MACHINE_UNGRAY,   /* the number whose Gray code it is */
    MACHINE_ISQRT,    /* the square root, rounded down */
    /* float -> float */
    MACHINE_FNEG,
    MACHINE_FABS,
    MACHINE_FSQRT,
    MACHINE_FFLOOR,
    MACHINE_FCEIL,
    MACHINE_FTRUNC,
    MACHINE_FROUND, /* to nearest, halves to even */
    /* float, float -> float; min is a < b ? a : b and max is a > b ? a : b: b where either is
       NaN */
    MACHINE_FADD,
    MACHINE_FSUB,
    MACHINE_FMUL,
    MACHINE_FDIV,
    MACHINE_FMIN,
    MACHINE_FMAX,
    /* float, float -> bit: false where either is NaN, except FNE */
    MACHINE_FEQ,
    MACHINE_FNE,
    MACHINE_FLT,
    MACHINE_FLE,
    MACHINE_FGT,
    MACHINE_FGE,
    /* float -> float: kernels/math.cl, the same bits on every device and here; within 1 ulp
       (single) and 2 ulp (double) of the correctly rounded result; special cases as in Annex F
       of C */
    MACHINE_FEXP,
    MACHINE_FLN,
    MACHINE_FLOG2,
    MACHINE_FLOG10,
    MACHINE_FSIN, /* radians */
    MACHINE_FCOS,
    MACHINE_FTAN,
    MACHINE_FASIN,
    MACHINE_FACOS,
    MACHINE_FATAN,
    MACHINE_FSINH,
    MACHINE_FCOSH,
    MACHINE_FTANH,
    MACHINE_FASINH,
    MACHINE_FACOSH,
    MACHINE_FATANH,
    /* float, float -> float */
    MACHINE_FATAN2, /* of the point with y = a, x = b */
    MACHINE_FPOW,   /* a to the power b */
    MACHINE_FMOD,   /* a - b floor(a / b): exact but for one rounding; its sign is b's */
    MACHINE_FREM,   /* a - b trunc(a / b): exact; its sign is a's */
    MACHINE_FSCALE, /* a 2^b, rounded once; b is whole */
    MACHINE_OP_COUNT_PUBLIC
};

#endif
