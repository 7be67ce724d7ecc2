/* scan.cl - running combinations along lines of elements, and what fills lines.
 *
 *     line:   | run 0       | run 1       | run 2 ...     in the direction of the scan
 *     PART 0  each run by itself; its total, and where in it a segment first begins
 *     PART 1  what goes before each run: the totals of those before it, one after the other
 *     PART 2  combines that with the run's elements before the first beginning of a segment
 *     PART 3  fills lines with one element each
 *
 * The order of combination is part of what the machine promises for floats: see machine_scan().
 *
 * -DPART=  -DTYPE= of elements: uint ulong (KIND 0), float double (KIND 1), ulong2 for numbers of
 * 128 bits (KIND 2)  -DMASK= int or long, as wide as TYPE  -DLANES= 1, or 16: so many neighbouring
 * lines at once, where there are as many columns. Element k of a line is at base + k * step; the
 * lines are `columns` neighbours in rows inner_stride apart, in blocks outer_stride apart. A row
 * of a buffer is `width` columns and, on both sides, `halo` that repeat the other end. */
#pragma OPENCL FP_CONTRACT OFF
#pragma OPENCL EXTENSION cl_khr_fp64 : enable

enum { COPY, ADD, MULTIPLY, MIN, OR, XOR };
#define NEVER 0x7fffffffu /* no segment begins in the run */
#define HAS 0x80000000u   /* COPY: there is an element to copy */

#define JOIN_(a, b) a##b
#define JOIN(a, b) JOIN_(a, b)
#if LANES == 1
typedef TYPE V;
typedef uchar B;
typedef uint U;
typedef int M;
#define LOAD(p, i) ((p)[i])
#define STORE(p, i, v) ((p)[i] = (v))
#define M_OF(b) ((int)(b))
#define U_OF(m) ((uint)(-(m)))
#else
typedef JOIN(TYPE, LANES) V;
typedef JOIN(uchar, LANES) B;
typedef JOIN(uint, LANES) U;
typedef JOIN(MASK, LANES) M;
#define LOAD(p, i) JOIN(vload, LANES)(0, (p) + (i))
#define STORE(p, i, v) JOIN(vstore, LANES)(v, 0, (p) + (i))
#define M_OF(b) JOIN(JOIN(convert_, MASK), LANES)(b)
#define U_OF(m) JOIN(as_uint, LANES)(JOIN(convert_int, LANES)(m))
#endif
#define SEL(m, a, b) ((m) ? (a) : (b))

#if KIND == 2
inline TYPE sum2(TYPE a, TYPE v)
{
    ulong lo = a.x + v.x;
    return (TYPE)(lo, a.y + v.y + (lo < a.x));
}
inline TYPE least2(TYPE a, TYPE v)
{
    return v.y < a.y || (v.y == a.y && v.x < a.x) ? v : a;
}
#define SUM(a, v) sum2(a, v)
#define LEAST(a, v) least2(a, v)
#else
#define SUM(a, v) ((a) + (v))
#define LEAST(a, v) SEL((v) < (a), v, a)
#endif
#define PRODUCT(a, v) ((a) * (v))
#define EITHER(a, v) ((a) | (v))
#define DIFFERENT(a, v) ((a) ^ (v))
#define FORMER(a, v) (a)

/* Floats are summed and multiplied; the least and the greatest are found as whole numbers. */
#if KIND == 1
#define IF_COPY(body)
#define FOR_OP(body)                                                                           \
    if (op == ADD) {                                                                           \
        body(SUM)                                                                              \
    } else {                                                                                   \
        body(PRODUCT)                                                                          \
    }
#define QUIET                                                                                  \
    (sizeof(TYPE) == 4 ? (TYPE)as_float(0x7fc00000u) : (TYPE)as_double(0x7ff8000000000000UL))
#define CANONICAL(T, v) SEL((v) == (v), v, (T)(QUIET))
#else
#define IF_COPY(body)                                                                          \
    if (op == COPY) {                                                                          \
        body                                                                                   \
    } else
#define FOR_OP(body)                                                                           \
    if (op == ADD) {                                                                           \
        body(SUM)                                                                              \
    } else if (op == MIN) {                                                                    \
        body(LEAST)                                                                            \
    } else if (op == OR) {                                                                     \
        body(EITHER)                                                                           \
    } else {                                                                                   \
        body(DIFFERENT)                                                                        \
    }
#define CANONICAL(T, v) (v)
#endif

/* What is in columns [from, to) is repeated beyond the ends of the row. */
inline void repeat(__global TYPE *row, int from, int to, int width, int halo)
{
    for (int c = from; c < min(to, halo); c++)
        row[c + width] = row[c];
    for (int c = max(from, width - halo); c < to; c++)
        row[c - width] = row[c];
}

/* This work-item's run and lines. Global ids: run; block of columns in row; block of rows. */
#define PLACE                                                                                  \
    const int blocks = (columns + LANES - 1) / LANES;                                          \
    const int block = (int)(get_global_id(1) % (size_t)blocks);                                \
    const int column = LANES == 1 ? block : min(block * LANES, columns - LANES);               \
    const size_t rows = get_global_size(1) / (size_t)blocks;                                   \
    const size_t inner = get_global_id(1) / (size_t)blocks, outer = get_global_id(2);          \
    const size_t line = outer * rows + inner;                                                  \
    const size_t row = base + inner * inner_stride + outer * outer_stride;                     \
    const int begin = (int)get_global_id(0) * run, end = min(begin + run, length);             \
    const bool edge = halo && (column < halo || column + LANES > width - halo);
#define EACH_ELEMENT for (int k = begin; k < end; k++)
#define HERE const size_t at = row + (size_t)column + (size_t)((long)k * step);
#define REPEAT_ACROSS                                                                          \
    if (!along && edge)                                                                        \
        repeat(out + (at - (size_t)column), column, column + LANES, width, halo);
/* Along a row, once for the whole run; going down, element 0 is the last column. */
#define REPEAT_ALONG(from, to)                                                                 \
    if (along && halo) {                                                                       \
        if (step > 0)                                                                          \
            repeat(out + row, from, to, width, halo);                                          \
        else                                                                                   \
            repeat(out + (row - (size_t)(length - 1)), length - (to), length - (from), width,  \
                   halo);                                                                      \
    }

#if PART == 0
/* A segment begins where bit 0 of flag is 1. */
#define BOUNDARY                                                                               \
    const M begins = (M_OF(flag) & (M)1) != (M)0;                                              \
    const U fresh = U_OF(begins) & U_OF(first == (U)NEVER);                                    \
    first = (first & ~fresh) | ((U)((uint)k) & fresh);                                         \
    acc = SEL(begins, none, acc);
#define PLAIN(combine)                                                                         \
    if (exclusive) {                                                                           \
        EACH_ELEMENT                                                                           \
        {                                                                                      \
            HERE const V old = acc;                                                            \
            acc = combine(acc, LOAD(in, at));                                                  \
            STORE(out, at, CANONICAL(V, old));                                                 \
            REPEAT_ACROSS                                                                      \
        }                                                                                      \
    } else {                                                                                   \
        EACH_ELEMENT                                                                           \
        {                                                                                      \
            HERE acc = combine(acc, LOAD(in, at));                                             \
            STORE(out, at, CANONICAL(V, acc));                                                 \
            REPEAT_ACROSS                                                                      \
        }                                                                                      \
    }
#define SEGMENTED(combine)                                                                     \
    EACH_ELEMENT                                                                               \
    {                                                                                          \
        HERE const B flag = LOAD(flags, at);                                                   \
        BOUNDARY const V old = acc;                                                            \
        acc = combine(acc, LOAD(in, at));                                                      \
        const V shown = exclusive ? old : acc;                                                 \
        STORE(out, at, CANONICAL(V, shown));                                                   \
        REPEAT_ACROSS                                                                          \
    }
/* The first element of a segment that takes part: where bit 1 of flag is 1. */
#define COPIED                                                                                 \
    EACH_ELEMENT                                                                               \
    {                                                                                          \
        HERE const B flag = LOAD(flags, at);                                                   \
        BOUNDARY has &= begins == (M)0;                                                        \
        const V old = acc;                                                                     \
        const M active = (M_OF(flag) & (M)2) != (M)0;                                          \
        acc = SEL(active & (has == (M)0), LOAD(in, at), acc);                                  \
        has |= active;                                                                         \
        const V shown = exclusive ? old : acc;                                                 \
        STORE(out, at, shown);                                                                 \
        REPEAT_ACROSS                                                                          \
    }

__kernel void scan(ulong base, long step, ulong inner_stride, ulong outer_stride, int length,
                   int run, int columns, int width, int halo, int along, int op, int exclusive,
                   int segmented, int keep, TYPE identity, const __global TYPE *in,
                   const __global uchar *flags, __global TYPE *out, __global TYPE *totals,
                   __global uint *firsts)
{
    PLACE
    const V none = (V)(identity);
    V acc = none;
    U first = (U)NEVER;
    M has = (M)0;
    IF_COPY(COPIED)
    if (segmented) {
        FOR_OP(SEGMENTED)
    } else {
        FOR_OP(PLAIN)
    }
    REPEAT_ALONG(begin, end)
    if (keep) {
        const size_t at =
            (line * get_global_size(0) + get_global_id(0)) * (size_t)columns + (size_t)column;
        STORE(totals, at, acc);
        STORE(firsts, at, first | (U_OF(has != (M)0) & (U)HAS));
    }
}

#elif PART == 1
#define JOIN_RUN(combine) carry = begins ? total : combine(carry, total);
#define JOIN_COPY                                                                              \
    if (begins || !has) {                                                                      \
        carry = total;                                                                         \
        has = f & HAS;                                                                         \
    }
__kernel void scan(int runs, int columns, int op, int keep, TYPE identity,
                   __global TYPE *totals, __global uint *firsts, __global TYPE *sums)
{
    const size_t column = get_global_id(0), line = get_global_id(1);
    TYPE carry = identity;
    uint has = 0;
    for (int r = 0; r < runs; r++) {
        const size_t at = (line * (size_t)runs + (size_t)r) * (size_t)columns + column;
        const TYPE total = totals[at];
        const uint f = firsts[at];
        const bool begins = (f & NEVER) != NEVER;
        totals[at] = carry;
        firsts[at] = (f & NEVER) | has;
        IF_COPY(JOIN_COPY)
        {
            FOR_OP(JOIN_RUN)
        }
    }
    if (keep)
        sums[line * (size_t)columns + column] = CANONICAL(TYPE, carry);
}

#elif PART == 2
#if LANES == 1 && KIND != 2
typedef JOIN(TYPE, 16) V16;
#define SIXTEENS(combine)                                                                      \
    for (; x + 16 <= stop; x += 16) {                                                          \
        V16 v = combine((V16)(carry), vload16(0, out + x));                                    \
        vstore16(CANONICAL(V16, v), 0, out + x);                                               \
    }
#else
#define SIXTEENS(combine)
#endif
#if LANES == 1
#define ALONG(combine)                                                                         \
    if (along) {                                                                               \
        size_t x = step > 0 ? row + (size_t)begin : row - (size_t)(last - 1);                  \
        const size_t stop = x + (size_t)(last - begin);                                        \
        SIXTEENS(combine)                                                                      \
        for (; x < stop; x++) {                                                                \
            const V v = combine(carry, out[x]);                                                \
            out[x] = CANONICAL(V, v);                                                          \
        }                                                                                      \
        REPEAT_ALONG(begin, last)                                                              \
    } else
#define BEFORE(k) 1
#else
#define ALONG(combine)
#define BEFORE(k) (M_OF((U)((uint)k) < first) & wanted)
#endif
#define FINISH(combine)                                                                        \
    ALONG(combine)                                                                             \
    for (int k = begin; k < last; k++) {                                                       \
        HERE const V old = LOAD(out, at), v = combine(carry, old);                             \
        STORE(out, at, SEL(BEFORE(k), CANONICAL(V, v), old));                                  \
        REPEAT_ACROSS                                                                          \
    }

__kernel void scan(ulong base, long step, ulong inner_stride, ulong outer_stride, int length,
                   int run, int columns, int width, int halo, int along, int op,
                   __global TYPE *out, const __global TYPE *totals, const __global uint *firsts)
{
    PLACE
    const size_t mine =
        (line * get_global_size(0) + get_global_id(0)) * (size_t)columns + (size_t)column;
    const V carry = LOAD(totals, mine);
    const U f = LOAD(firsts, mine), first = f & (U)NEVER;
#if LANES == 1
    const int last = op == COPY && !(f & HAS) ? begin : min(end, (int)first);
    if (last <= begin)
        return;
#else
    const int last = end;
    const M wanted = op == COPY ? M_OF((f & (U)HAS) != (U)0) : ~(M)0;
#endif
    IF_COPY(FINISH(FORMER))
    {
        FOR_OP(FINISH)
    }
}

#else
#if LANES == 1 && KIND != 2
#define FILL_SIXTEENS                                                                          \
    for (; x + 16 <= stop; x += 16)                                                            \
        vstore16((JOIN(TYPE, 16))(v), 0, out + x);
#else
#define FILL_SIXTEENS
#endif
__kernel void scan(ulong base, long step, ulong inner_stride, ulong outer_stride, int length,
                   int run, int columns, int width, int halo, int along, ulong from_base,
                   ulong from_inner, ulong from_outer, const __global TYPE *from,
                   __global TYPE *out)
{
    PLACE
    const V v = LOAD(from, from_base + inner * from_inner + outer * from_outer + (size_t)column);
#if LANES == 1
    if (along) {
        size_t x = row + (size_t)begin;
        const size_t stop = row + (size_t)end;
        FILL_SIXTEENS
        for (; x < stop; x++)
            out[x] = v;
        REPEAT_ALONG(begin, end)
        return;
    }
#endif
    EACH_ELEMENT
    {
        HERE STORE(out, at, v);
        REPEAT_ACROSS
    }
}
#endif
