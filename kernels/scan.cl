/* scan.cl - running combinations along lines of elements, and filling lines.
 *
 *     line:    | run 0       | run 1       | run 2 ...     in the direction of the scan
 *     scan     each run by itself; its total, and where in it a segment first begins
 *     JOINS    what goes before each run: the totals of those before it, one after the other
 *     FINISHES combines that with the run's elements before the first beginning of a segment
 *     FILLS    fills lines with one element each
 *
 * Elements are xor-ed with `flip` as they come and as they go, which turns the greatest into
 * the least, signed order into unsigned, and `and` into `or`; and cut to the bits of `cut`.
 *
 * For floats the order of combination is specified: see machine_scan().
 *
 * -DPART= 0 scan, 1 the others  -DTYPE= of elements: uint ulong (KIND 0), float double (KIND
 * 1), ulong2 for numbers of 128 bits (KIND 2)  -DMASK= int or long, as wide as TYPE
 * -DLANES= 1, or 16: so many neighbouring lines at once, where there are as many columns.
 * Element k of a line is at base + k * step; the lines are `columns` neighbours in rows
 * inner_stride apart, in blocks outer_stride apart. A row of a buffer is `width` columns
 * and, on both sides, `halo` that repeat the other end.
 */
#pragma OPENCL FP_CONTRACT OFF
#pragma OPENCL EXTENSION cl_khr_fp64 : enable

enum { COPY, ADD, MULTIPLY, MIN, OR, XOR };
enum { JOINS, FINISHES, FILLS };
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
static inline TYPE sum2(TYPE a, TYPE v)
{
    ulong lo = a.x + v.x;
    return (TYPE)(lo, a.y + v.y + (lo < a.x));
}
static inline TYPE least2(TYPE a, TYPE v)
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

/* Floats are summed and multiplied here; their minimum and maximum are found as integers. */
#if KIND == 1
#define IF_COPY(body)
#define FOR_OP(body)                                                                           \
    if (op == ADD) {                                                                           \
        body(SUM)                                                                              \
    } else {                                                                                   \
        body(PRODUCT)                                                                          \
    }
#define QUIET                                                                                  \
    (sizeof(TYPE) == 4 ? (TYPE)as_float(0xffc00000u) : (TYPE)as_double(0xfff8000000000000UL))
#define TAKE(T, v) (v)
#define SHOW(T, v) SEL((v) == (v), v, (T)(QUIET))
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
#define TAKE(T, v) ((v) ^ (T)(flip))
#define SHOW(T, v) (((v) & (T)(cut)) ^ (T)(flip))
#endif

/* Copies columns [from, to) beyond the ends of the row, into the halos. */
static inline void repeat(__global TYPE *row, int from, int to, int width, int halo)
{
    for (int c = from; c < min(to, halo); c++)
        row[c + width] = row[c];
    for (int c = max(from, width - halo); c < to; c++)
        row[c - width] = row[c];
}

/* This work-item's run and lines. Global ids: run; block of columns in row; block of rows. */
#define PLACE(lanes)                                                                           \
    const int blocks = (columns + (lanes)-1) / (lanes);                                        \
    const int block = (int)(get_global_id(1) % (size_t)blocks);                                \
    const int column = min(block * (lanes), columns - (lanes));                                \
    const size_t rows = get_global_size(1) / (size_t)blocks;                                   \
    const size_t inner = get_global_id(1) / (size_t)blocks, outer = get_global_id(2);          \
    const size_t line = outer * rows + inner;                                                  \
    const size_t row = base + inner * inner_stride + outer * outer_stride;                     \
    const int begin = (int)get_global_id(0) * run, end = min(begin + run, length);             \
    const bool edge = halo && (column < halo || column + (lanes) > width - halo);
#define EACH_ELEMENT for (int k = begin; k < end; k++)
#define HERE const size_t at = row + (size_t)column + (size_t)((long)k * step);
/* When all is written. */
#define REPEAT_ACROSS(lanes, to)                                                               \
    if (!along && edge)                                                                        \
        for (int k = begin; k < (to); k++) {                                                   \
            HERE repeat(out + (at - (size_t)column), column, column + (lanes), width, halo);   \
        }
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
#define PLAIN(combine)                                                                         \
    for (int k = begin; k < end; k++, at += (size_t)step) {                                    \
        const V old = acc;                                                                     \
        acc = combine(acc, TAKE(V, LOAD(in, at)));                                             \
        const V shown = exclusive ? old : acc;                                                 \
        STORE(out, at, SHOW(V, shown));                                                        \
    }
/* Which elements are active, and before which ones a segment begins: where the element
 * `back` before has a 1 (at element 0 it does not matter). Missing arrays are read at 0 and
 * ignored, and integers are selected with masks, because branches are slower. */
#if LANES == 1 && KIND == 0
#define CHOOSE(m, a, b) (((a) & (V)(-(MASK)(m))) | ((b) & ~(V)(-(MASK)(m))))
#else
#define CHOOSE SEL
#endif
#define BITS(p, i) (M_OF(LOAD(p, i)) != (M)0)
#define FLAGS                                                                                  \
    const M active = BITS(context, at & context_mask) | everyone;                              \
    const M begins =                                                                           \
        BITS(bits, (at - (size_t)back) & bits_mask) & somewhere & (active | anywhere);         \
    first = MIN_U(first, (U)((uint)k) | (~U_OF(begins) & (U)NEVER));                           \
    acc = CHOOSE(begins, none, acc);                                                           \
    back = whole_back;
#if LANES == 1
#define MIN_U(a, b) ((a) < (b) ? (a) : (b))
#else
#define MIN_U(a, b) min(a, b)
#endif
#define FLAGGED(combine)                                                                       \
    for (int k = begin; k < end; k++, at += (size_t)step) {                                    \
        FLAGS const V old = acc, own = TAKE(V, LOAD(in, at));                                  \
        acc = combine(acc, CHOOSE(active, own, none));                                         \
        const V shown = exclusive ? old : acc;                                                 \
        STORE(out, at, SHOW(V, shown));                                                        \
    }
/* For lines where all elements are active, and segments begin at a 1. */
#define SEGMENTED(combine)                                                                     \
    for (int k = begin; k < end; k++, at += (size_t)step) {                                    \
        const M begins = BITS(bits, at);                                                       \
        first = MIN_U(first, (U)((uint)k) | (~U_OF(begins) & (U)NEVER));                       \
        const V old = SEL(begins, none, acc);                                                  \
        acc = combine(old, TAKE(V, LOAD(in, at)));                                             \
        const V shown = exclusive ? old : acc;                                                 \
        STORE(out, at, SHOW(V, shown));                                                        \
    }
/* The first active element of a segment. */
#define COPIED                                                                                 \
    for (int k = begin; k < end; k++, at += (size_t)step) {                                    \
        FLAGS has &= begins == (M)0;                                                           \
        const V old = acc, own = LOAD(in, at);                                                 \
        const M takes = active & (has == (M)0);                                                \
        acc = CHOOSE(takes, own, acc);                                                         \
        has |= active;                                                                         \
        const V shown = exclusive ? old : acc;                                                 \
        STORE(out, at, shown);                                                                 \
    }

__kernel void scan(ulong base, long step, ulong inner_stride, ulong outer_stride, int length,
                   int run, int columns, int width, int halo, int along, int op, int exclusive,
                   int masked, int segmented, int starts, int backward, int keep, TYPE identity,
                   TYPE flip, TYPE cut, const __global TYPE *in, const __global uchar *context,
                   const __global uchar *bits, __global TYPE *out, __global TYPE *totals,
                   __global uint *firsts)
{
    PLACE(LANES)
    const long whole_back = backward ? step : 0;
    long back = begin ? whole_back : 0;
    size_t at = row + (size_t)column + (size_t)((long)begin * step);
    const size_t context_mask = masked ? ~(size_t)0 : 0, bits_mask = segmented ? ~(size_t)0 : 0;
    const M yes = (M)0 == (M)0, no = (M)0;
    const M everyone = masked ? no : yes, somewhere = segmented ? yes : no,
            anywhere = starts ? no : yes;
    const V none = (V)(identity);
    V acc = none;
    U first = (U)NEVER;
    M has = (M)0;
    IF_COPY(COPIED)
    if (masked || backward) {
        FOR_OP(FLAGGED)
    } else if (segmented) {
        FOR_OP(SEGMENTED)
    } else {
        FOR_OP(PLAIN)
    }
    REPEAT_ALONG(begin, end)
    REPEAT_ACROSS(LANES, end)
    if (keep) {
        const size_t mine =
            (line * get_global_size(0) + get_global_id(0)) * (size_t)columns + (size_t)column;
        STORE(totals, mine, acc);
        STORE(firsts, mine, first | (U_OF(has != (M)0) & (U)HAS));
    }
}

#else
#define JOIN_RUN(combine) carry = begins ? total : combine(carry, total);
#define JOIN_COPY                                                                              \
    if (begins || !has) {                                                                      \
        carry = total;                                                                         \
        has = f & HAS;                                                                         \
    }
/* Sixteen elements of a row at a time. */
#if KIND == 2
#define FINISH_SIXTEENS(combine)
#define FILL_SIXTEENS
#else
typedef JOIN(TYPE, 16) V16;
#define FINISH_SIXTEENS(combine)                                                               \
    for (; along && x + 16 <= stop; x += 16) {                                                 \
        const V16 v = combine((V16)(carry), TAKE(V16, vload16(0, out + x)));                   \
        vstore16(SHOW(V16, v), 0, out + x);                                                    \
    }
#define FILL_SIXTEENS                                                                          \
    for (; x + 16 <= stop; x += 16)                                                            \
        vstore16((V16)(v), 0, out + x);
#endif
#define FINISH(combine)                                                                        \
    {                                                                                          \
        FINISH_SIXTEENS(combine)                                                               \
        for (; x < stop; x += apart) {                                                         \
            const V v = combine(carry, TAKE(V, out[x]));                                       \
            out[x] = SHOW(V, v);                                                               \
        }                                                                                      \
    }

/* JOINS: one line's runs, one after the other. */
static inline void join_runs(int columns, int runs, int op, int keep, TYPE identity, TYPE flip,
                             TYPE cut, __global TYPE *totals, __global uint *firsts,
                             __global TYPE *sums)
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
        sums[line * (size_t)columns + column] = SHOW(TYPE, carry);
}

__kernel void scan(ulong base, long step, ulong inner_stride, ulong outer_stride, int length,
                   int run, int columns, int width, int halo, int along, int lanes, int stage,
                   int runs, int op, int keep, TYPE identity, TYPE flip, TYPE cut,
                   ulong from_base, ulong from_inner, ulong from_outer, __global TYPE *out,
                   __global TYPE *totals, __global uint *firsts, __global TYPE *sums)
{
    if (stage == JOINS) {
        join_runs(columns, runs, op, keep, identity, flip, cut, totals, firsts, sums);
        return;
    }
    PLACE(lanes)
    if (stage == FINISHES) {
        const size_t mine =
            (line * get_global_size(0) + get_global_id(0)) * (size_t)columns + (size_t)column;
        const V carry = totals[mine];
        const uint f = firsts[mine];
        const int last = op == COPY && !(f & HAS) ? begin : min(end, (int)(f & NEVER));
        if (last <= begin)
            return;
        /* from the least place to the greatest */
        const size_t apart = (size_t)(step > 0 ? step : -step);
        const int least = step > 0 ? begin : last - 1;
        size_t x = row + (size_t)column + (size_t)((long)least * step);
        const size_t stop = x + (size_t)(last - begin) * apart;
        IF_COPY(FINISH(FORMER)){FOR_OP(FINISH)} REPEAT_ALONG(begin, last)
            REPEAT_ACROSS(1, last) return;
    }
#if KIND != 1
    const __global TYPE *from =
        sums + (from_base + inner * from_inner + outer * from_outer + (size_t)column);
    const TYPE v = *from;
    if (along) {
        size_t x = row + (size_t)begin;
        const size_t stop = row + (size_t)end;
        FILL_SIXTEENS
        for (; x < stop; x++)
            out[x] = v;
        REPEAT_ALONG(begin, end)
#if KIND == 0
    } else if (lanes == 16) {
        const V16 all = vload16(0, from);
        EACH_ELEMENT
        {
            HERE vstore16(all, 0, out + at);
        }
        REPEAT_ACROSS(16, end)
#endif
    } else {
        EACH_ELEMENT
        {
            HERE out[at] = v;
        }
        REPEAT_ACROSS(1, end)
    }
#endif
}
#endif
