/* prelude.cl - the beginning of every generated kernel.
 *
 * A kernel handles VECTOR neighbouring processors of a row at a time, and is written once for
 * every VECTOR: VI  a bit of each, as 0 or -1        VU, VL  up to 32 and 64 bits, unused high
 * bits 0 VF, VD  float, double                VQ      up to 128 bits Rows are PITCH elements
 * apart and begin and end with HALO columns that repeat the other end; so a neighbour is found
 * without a question. Where WRAPS is 1, or a kernel looks further than the halo, columns are
 * wrapped.
 *
 * A kernel of few short integers has narrow lanes: VI and VU of LANE bits, 8 or 16, and so
 * many more of them.
 */
#pragma OPENCL FP_CONTRACT OFF
#pragma OPENCL EXTENSION cl_khr_fp64 : enable

#define JOIN_(a, b) a##b
#define JOIN(a, b) JOIN_(a, b)

#ifndef LANE
#define LANE 32
#endif

/* Compilers tuned for processors that slow down at wide vectors split each vector in two,
 * except in functions that declare their need of wide ones. */
#if VECTOR * LANE == 512 && defined(__has_attribute)
#if __has_attribute(min_vector_width)
#define WHOLE_VECTORS __attribute__((min_vector_width(512)))
#endif
#endif
#ifndef WHOLE_VECTORS
#define WHOLE_VECTORS
#endif

#if LANE < 32 /* compilers for CPUs have longer vectors than OpenCL names, but no conversion
        * functions for them */
#if LANE == 8
#define SIGNED char
#define UNSIGNED uchar
#else
#define SIGNED short
#define UNSIGNED ushort
#endif
#define LANES(type, bytes)                                                                     \
    typedef type JOIN(type, _lanes) __attribute__((ext_vector_type(VECTOR)));                  \
    typedef JOIN(type, _lanes) JOIN(type, _anywhere) __attribute__((aligned(bytes)))
LANES(char, 1);
LANES(uchar, 1);
LANES(short, 2);
LANES(ushort, 2);
typedef JOIN(SIGNED, _lanes) VI;
typedef JOIN(UNSIGNED, _lanes) VU;
#define LANES_OF(type) JOIN(type, _lanes)
#define CONVERT(type, v) __builtin_convertvector(v, LANES_OF(type))
#define CMP_U(e) (e)
#define SEL_U(m, a, b) ((m) ? (a) : (b))
#define SEL_I(m, a, b) (((m) & (a)) | (~(m) & (b)))
#define AS_U(v) __builtin_astype(v, VU)
#define AS_S(v) __builtin_astype(v, VI)
#define GET(type, p, i) (*(const __global JOIN(type, _anywhere) *)((p) + (i)))
#define PUT(type, p, i, v) (*(__global JOIN(type, _anywhere) *)((p) + (i)) = (v))
/* HALO lanes of many, from that one on. */
#if HALO == 16
#define PART(v, at)                                                                            \
    __builtin_shufflevector(v, v, (at), (at) + 1, (at) + 2, (at) + 3, (at) + 4, (at) + 5,      \
                            (at) + 6, (at) + 7, (at) + 8, (at) + 9, (at) + 10, (at) + 11,      \
                            (at) + 12, (at) + 13, (at) + 14, (at) + 15)
#elif HALO == 8
#define PART(v, at)                                                                            \
    __builtin_shufflevector(v, v, (at), (at) + 1, (at) + 2, (at) + 3, (at) + 4, (at) + 5,      \
                            (at) + 6, (at) + 7)
#else
#define PART(v, at) __builtin_shufflevector(v, v, (at), (at) + 1, (at) + 2, (at) + 3)
#endif
typedef uchar uchar_part __attribute__((ext_vector_type(HALO), aligned(1)));
typedef ushort ushort_part __attribute__((ext_vector_type(HALO), aligned(2)));
#define PART_OUT(kind, p, i, part) (*(__global JOIN(TYPE_##kind, _part) *)((p) + (i)) = (part))
#define FIRST_OUT(kind, p, i, v) PART_OUT(kind, p, i, PART(TO_##kind(v), 0))
#define LAST_OUT(kind, p, i, v) PART_OUT(kind, p, i, PART(TO_##kind(v), VECTOR - HALO))
#else
#define SIGNED int
#define UNSIGNED uint
#define LANES_OF(type) JOIN(type, VECTOR)
/* VECTOR == HALO */
#define FIRST_OUT(kind, p, i, v) OUT_##kind(p, i, v)
#define LAST_OUT(kind, p, i, v) OUT_##kind(p, i, v)
#if VECTOR == 1
typedef int VI;
typedef uint VU;
typedef ulong VL;
typedef long VM;
typedef float VF;
typedef double VD;
#define CONVERT(type, v) ((type)(v))
#define CMP_U(e) (-(e))
#define CMP_L(e) (-(e))
#define SEL_U(m, a, b) ((m) ? (a) : (b))
#define SEL_L(m, a, b) ((m) ? (a) : (b))
#define IOTA 0
#define GET(type, p, i) ((p)[i])
#define PUT(type, p, i, v) ((p)[i] = (v))
#else
typedef JOIN(int, VECTOR) VI;
typedef JOIN(uint, VECTOR) VU;
typedef JOIN(ulong, VECTOR) VL;
typedef JOIN(long, VECTOR) VM;
typedef JOIN(float, VECTOR) VF;
typedef JOIN(double, VECTOR) VD;
#define CONVERT(type, v) JOIN(JOIN(convert_, type), VECTOR)(v)
#define CMP_U(e) (e)
#define CMP_L(e) CONVERT(int, e)
#define SEL_U(m, a, b) ((m) ? (a) : (b))
#define SEL_L(m, a, b) (CONVERT(long, m) ? (a) : (b))
#if VECTOR == 16
#define IOTA ((int16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15))
#elif VECTOR == 8
#define IOTA ((int8)(0, 1, 2, 3, 4, 5, 6, 7))
#else
#define IOTA ((int4)(0, 1, 2, 3))
#endif
/* In one load or store each, which vload and vstore of some devices are not. */
#define ANYWHERE(type, bytes)                                                                  \
    typedef JOIN(type, VECTOR) JOIN(type, _anywhere) __attribute__((aligned(bytes)))
ANYWHERE(uchar, 1);
ANYWHERE(ushort, 2);
ANYWHERE(uint, 4);
ANYWHERE(ulong, 8);
ANYWHERE(float, 4);
ANYWHERE(double, 8);
#define GET(type, p, i) (*(const __global JOIN(type, _anywhere) *)((p) + (i)))
#define PUT(type, p, i, v) (*(__global JOIN(type, _anywhere) *)((p) + (i)) = (v))
#endif
#define SEL_F SEL_U
#define SEL_D SEL_L
#define SEL_I(m, a, b) (((m) & (a)) | (~(m) & (b)))
#define AS_U(v) JOIN_AS(uint, v)
#define AS_S(v) JOIN_AS(int, v)
#define AS_L(v) JOIN_AS(ulong, v)
#define AS_M(v) JOIN_AS(long, v)
#define AS_F(v) JOIN_AS(float, v)
#define AS_D(v) JOIN_AS(double, v)
#if VECTOR == 1
#define JOIN_AS(type, v) as_##type(v)
#else
#define JOIN_AS(type, v) JOIN(as_##type, VECTOR)(v)
#endif
#endif /* LANE */

/* ---- columns and rows ---- */

static inline int wrap(int c, int length)
{
    c = c < 0 ? c + length : c >= length ? c - length : c;
    if (c < 0 || c >= length) {
        c %= length;
        c = c < 0 ? c + length : c;
    }
    return c;
}

#if WRAPS
#define AT(dx) wrap(x + (dx), W)
#else
#define AT(dx) (x + (dx))
#endif

#if LANE == 32
static inline VU column(int x, int W)
{
#if VECTOR == 1
    return (VU)wrap(x, W);
#else
    VI c = (VI)(x) + IOTA;
    c = c < 0 ? c + W : c;
    c = c >= W ? c - W : c;
    return AS_U(c);
#endif
}
#endif

/* ---- memory ---- */

/* To the second-level cache, where there is a way to say so. */
#ifdef __has_builtin
#if __has_builtin(__builtin_prefetch)
#define PREFETCH(p, writes) __builtin_prefetch((const void *)(uintptr_t)(p), writes, 2)
#endif
#endif
#ifndef PREFETCH
#define PREFETCH(p, writes) (void)0
#endif

/* For each type in memory: its element, and how it is loaded and stored. */
#define TYPE_bit uchar
#define TYPE_u8 uchar
#define TYPE_u16 ushort
#define TYPE_u32 uint
#define TYPE_u64 ulong
#define TYPE_f32 float
#define TYPE_f64 double
#if LANE < 32 /* memory has only 0 or 1: no comparison is needed */
#define FROM_bit(v) AS_S(-CONVERT(UNSIGNED, v))
#else
#define FROM_bit(v) CMP_U(CONVERT(SIGNED, v) != (SIGNED)0)
#endif
#define FROM_u8(v) CONVERT(UNSIGNED, v)
#define FROM_u16(v) CONVERT(UNSIGNED, v)
#define FROM_u32(v) (v)
#define FROM_u64(v) (v)
#define FROM_f32(v) (v)
#define FROM_f64(v) (v)
#define TO_bit(v) CONVERT(uchar, (v) & (SIGNED)1)
#define TO_u8(v) CONVERT(uchar, v)
#define TO_u16(v) CONVERT(ushort, v)
#define TO_u32(v) (v)
#define TO_u64(v) (v)
#define TO_f32(v) (v)
#define TO_f64(v) (v)

#define LOAD_bit(p, i) FROM_bit(GET(uchar, p, i))
#define LOAD_u8(p, i) FROM_u8(GET(uchar, p, i))
#define LOAD_u16(p, i) FROM_u16(GET(ushort, p, i))
#define LOAD_u32(p, i) GET(uint, p, i)
#define LOAD_u64(p, i) GET(ulong, p, i)
#ifdef AHEAD
#define LOAD_f32(p, i) (PREFETCH((p) + (i) + AHEAD, 0), GET(float, p, i))
#else
#define LOAD_f32(p, i) GET(float, p, i)
#endif
#define LOAD_f64(p, i) GET(double, p, i)

/* Stores that bypass the caches: for arrays larger than the caches, with aligned vectors. */
#ifdef __has_builtin
#if STREAMS && VECTOR > 1 && __has_builtin(__builtin_nontemporal_store)
#define STREAM(type, p, i, v) __builtin_nontemporal_store(v, (__global type *)((p) + (i)))
#define PASS_u32(p, i, v) STREAM(VU, p, i, v)
#define PASS_u64(p, i, v) STREAM(VL, p, i, v)
#define PASS_f32(p, i, v) STREAM(VF, p, i, v)
#define PASS_f64(p, i, v) STREAM(VD, p, i, v)
#endif
#endif
#ifndef PASS_u32
#define PASS_u32 OUT_u32
#define PASS_u64 OUT_u64
#define PASS_f32 OUT_f32
#define PASS_f64 OUT_f64
#endif
#define PASS_bit OUT_bit
#define PASS_u8 OUT_u8
#define PASS_u16 OUT_u16
#define PASS_u128 OUT_u128

#define OUT_bit(p, i, v) PUT(uchar, p, i, TO_bit(v))
#define OUT_u8(p, i, v) PUT(uchar, p, i, TO_u8(v))
#define OUT_u16(p, i, v) PUT(ushort, p, i, TO_u16(v))
#define OUT_u32(p, i, v) PUT(uint, p, i, v)
#define OUT_u64(p, i, v) PUT(ulong, p, i, v)
#define OUT_f32(p, i, v) PUT(float, p, i, v)
#define OUT_f64(p, i, v) PUT(double, p, i, v)

#if HALO == 0
#define STORE(kind, p, v) OUT_##kind(p, x, v)
#elif VECTOR == 1
#define STORE(kind, p, v)                                                                      \
    do {                                                                                       \
        OUT_##kind(p, x, v);                                                                   \
        if (x < HALO)                                                                          \
            OUT_##kind(p, x + W, v);                                                           \
        if (x >= W - HALO)                                                                     \
            OUT_##kind(p, x - W, v);                                                           \
    } while (0)
#else /* the first HALO columns are the right halo, the last ones the left */
#define STORE(kind, p, v)                                                                      \
    do {                                                                                       \
        PASS_##kind(p, x, v);                                                                  \
        if (x == 0)                                                                            \
            FIRST_OUT(kind, p, W, v);                                                          \
        if (x == W - VECTOR)                                                                   \
            LAST_OUT(kind, p, -HALO, v);                                                       \
    } while (0)
#endif

#if LANE == 32 /* to the end */

/* ---- anywhere in an array ---- */

/* Lanes of the array p, at the indices j. */
#if VECTOR == 1
#define LANES_AT(type, p, j) ((p)[j])
#elif VECTOR == 4
#define LANES_AT(type, p, j) ((LANES_OF(type))((p)[j.s0], (p)[j.s1], (p)[j.s2], (p)[j.s3]))
#elif VECTOR == 8
#define LANES_AT(type, p, j)                                                                   \
    ((LANES_OF(type))((p)[j.s0], (p)[j.s1], (p)[j.s2], (p)[j.s3], (p)[j.s4], (p)[j.s5],        \
                      (p)[j.s6], (p)[j.s7]))
#else
#define LANES_AT(type, p, j)                                                                   \
    ((LANES_OF(type))((p)[j.s0], (p)[j.s1], (p)[j.s2], (p)[j.s3], (p)[j.s4], (p)[j.s5],        \
                      (p)[j.s6], (p)[j.s7], (p)[j.s8], (p)[j.s9], (p)[j.sa], (p)[j.sb],        \
                      (p)[j.sc], (p)[j.sd], (p)[j.se], (p)[j.sf]))
#endif
/* By an instruction, where there is one. */
#define AT_bit(type, p, j) LANES_AT(type, p, j)
#define AT_u8(type, p, j) LANES_AT(type, p, j)
#define AT_u16(type, p, j) LANES_AT(type, p, j)
#if VECTOR == 16 && defined(__AVX512F__) && defined(__has_builtin)
#if __has_builtin(__builtin_ia32_gathersiv8df)
#define ADDRESS(p) ((const void *)(uintptr_t)(p))
#define AT_f64(type, p, j)                                                                     \
    ((double16)(__builtin_ia32_gathersiv8df((double8)(0), ADDRESS(p), AS_S(j).lo, -1, 8),      \
                __builtin_ia32_gathersiv8df((double8)(0), ADDRESS(p), AS_S(j).hi, -1, 8)))
#define AT_u64(type, p, j)                                                                     \
    as_ulong16(                                                                                \
        (long16)(__builtin_ia32_gathersiv8di((long8)(0), ADDRESS(p), AS_S(j).lo, -1, 8),       \
                 __builtin_ia32_gathersiv8di((long8)(0), ADDRESS(p), AS_S(j).hi, -1, 8)))
#define AT_f32(type, p, j)                                                                     \
    __builtin_ia32_gathersiv16sf((float16)(0), ADDRESS(p), AS_S(j), -1, 4)
#define AT_u32(type, p, j)                                                                     \
    as_uint16(__builtin_ia32_gathersiv16si((int16)(0), ADDRESS(p), AS_S(j), -1, 4))
#endif
#endif
#ifndef AT_f64
#define AT_u32(type, p, j) LANES_AT(type, p, j)
#define AT_u64(type, p, j) LANES_AT(type, p, j)
#define AT_f32(type, p, j) LANES_AT(type, p, j)
#define AT_f64(type, p, j) LANES_AT(type, p, j)
#endif
/* An index that is inside. */
#define INSIDE(i, n) SEL_U(CMP_U((i) < (n)), i, (VU)(0))
/* Whether the indices i go up by one, and all are inside: then one load has all lanes. */
#if VECTOR == 1
#define FIRST(i) (i)
#define IN_A_ROW(i, n) 0
#else
#define FIRST(i) (i).s0
#define IN_A_ROW(i, n) in_a_row(i, (n).s0)
static inline int in_a_row(VU i, uint n)
{
    VU off = (i - (VU)(i.s0)) ^ AS_U(IOTA);
#if VECTOR == 16
    uint8 eight = off.lo | off.hi;
    uint4 four = eight.lo | eight.hi;
#elif VECTOR == 8
    uint4 four = off.lo | off.hi;
#else
    uint4 four = off;
#endif
    ulong2 two = as_ulong2(four);
    return (two.x | two.y) == 0 && i.s0 < n && n - i.s0 >= VECTOR;
}
#endif
/* What is read at the indices i, which are j where they are inside: 0 where they are not.
 * letter: of the container. */
#define GATHER(letter, kind, type, p, i, n, j, row)                                            \
    ((row)                                                                                     \
         ? FROM_##kind(GET(type, p, FIRST(i)))                                                 \
         : SEL_##letter(CMP_U((i) < (n)), FROM_##kind(AT_##kind(type, p, j)), (V##letter)(0)))

/* ---- NaN ---- */

#define CANON_F(v) SEL_F(CMP_U((v) == (v)), v, (VF)(as_float(0xffc00000u)))
#define CANON_D(v) SEL_D(CMP_L((v) == (v)), v, (VD)(as_double(0xfff8000000000000UL)))

/* ---- integers in floats and back ---- */

/* Rounds toward zero, to width bits; out of range the nearest end of the range, NaN 0. limit
 * is 2^width, or 2^(width - 1) */
static inline VU f_to_u_small(VF v, float limit, uint top)
{
    VI inside = CMP_U(v > 0.0f) & CMP_U(v < limit);
    VU r = AS_U(CONVERT(int, SEL_F(inside, v, (VF)(0.0f))));
    return SEL_U(CMP_U(v >= limit), (VU)(top), r);
}

static inline VU f_to_s_small(VF v, float limit, int top)
{
    VI inside = CMP_U(v > -limit) & CMP_U(v < limit);
    VI r = CONVERT(int, SEL_F(inside, v, (VF)(0.0f)));
    r = SEL_U(CMP_U(v >= limit), (VI)(top), r);
    r = SEL_U(CMP_U(v <= -limit), (VI)(-top - 1), r);
    return AS_U(r);
}

static inline VL d_to_u(VD v, double limit, ulong top)
{
    VI inside = CMP_L(v > 0.0) & CMP_L(v < limit);
    VL r = CONVERT(ulong, SEL_D(inside, v, (VD)(0.0)));
    return SEL_L(CMP_L(v >= limit), (VL)(top), r);
}

static inline VL d_to_s(VD v, double limit, long top)
{
    VI inside = CMP_L(v > -limit) & CMP_L(v < limit);
    VM r = CONVERT(long, SEL_D(inside, v, (VD)(0.0)));
    r = SEL_L(CMP_L(v >= limit), (VM)(top), r);
    r = SEL_L(CMP_L(v <= -limit), (VM)(-top - 1), r);
    return AS_L(r);
}

/* ---- random numbers: see machine_random() ---- */

static inline VL mix(VL z)
{
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9UL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebUL;
    return z ^ (z >> 31);
}

static inline VL random_bits(VU index, ulong key)
{
    return mix(CONVERT(ulong, index) * 0x9e3779b97f4a7c15UL + key);
}

/* ---- overflow of floats: infinite from finite ---- */

#define FINITE_F(v) CMP_U((AS_U(v) & 0x7f800000u) != 0x7f800000u)
#define INFINITE_F(v) CMP_U((AS_U(v) & 0x7fffffffu) == 0x7f800000u)
#define FINITE_D(v) CMP_L((AS_L(v) & 0x7ff0000000000000UL) != 0x7ff0000000000000UL)
#define INFINITE_D(v) CMP_L((AS_L(v) & 0x7fffffffffffffffUL) == 0x7ff0000000000000UL)

/* ---- overflow of a product of two numbers of width bits (2..32), all of it known ---- */

static inline VI s_product_overflows(VM product, int width)
{
    VM top = (VM)(((long)1 << (width - 1)) - 1);
    return CMP_L(product > top) | CMP_L(product < -top - 1L);
}

#endif
