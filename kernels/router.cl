/* router.cl - messages to other processors.
 *
 * Processors are counted by row-major index. Elements lie in rows of `width`, `pitch` apart,
 * that begin and end with `halo` columns which repeat the other end.
 *
 * Addresses are indices already: the host makes them.
 *
 *     claim      owner[d] = 1 + the highest index that sends to d
 *     scatter    dest[d] = source of the last that sends to d; for few work-items
 *     deliver    dest[d] = source of its owner, or old[d]
 *     route      to[i] = the processor that i sends to
 *     combine    each work-item has some of the destinations, and passes all senders in order
 *     fetch      out[i] = source[the processor at i's address]
 *     arrived    1 where there is an owner
 *     edges      fills the halo
 *
 * -DFLAT=1: both sets have one row. -DADDRESS= uchar .. ulong2: of address fields; -DELEMENT=
 * the same: of messages; -DKIND=0 bits up to 64, 1 float or double, 2 pairs of 64. */
#pragma OPENCL FP_CONTRACT OFF
#pragma OPENCL EXTENSION cl_khr_fp64 : enable

#define NONE 0xffffffffu
#define NOBODY 0xfffffffeu /* sends to a processor that does not exist */

#define LAYOUT(s) uint s##_width, uint s##_pitch, uint s##_halo

/* Divides by a number that stays the same: with k = 31 + the least s for which it is at most
 * 2^s, n / by is n * (2^k / by + 1) >> k for all n below 2^31. A division takes ten times as
 * long. */
struct divisor {
    ulong factor;
    uint shift, by;
};
static inline struct divisor divisor_of(uint by)
{
    const uint shift = 31 + (by > 1 ? 32 - clz(by - 1) : 0);
    const struct divisor d = {(1UL << shift) / by + 1, shift, by};
    return d;
}
static inline uint over(uint n, struct divisor d)
{
    return (uint)(n * d.factor >> d.shift);
}

static inline size_t place(uint n, struct divisor width, uint pitch, uint halo)
{
#if FLAT
    return (size_t)n + halo;
#endif
    const uint row = over(n, width);
    return (size_t)row * pitch + halo + (n - row * width.by);
}
#define DIVIDES_PLACE(s) const struct divisor s##_row = divisor_of(s##_width)
#define PLACE(s, n) place(n, s##_row, s##_pitch, s##_halo)

#define INDEX_OF(a) ((a) < count ? (a) : NOBODY)

#define COLUMNS(s)                                                                             \
    const uint row = get_global_id(1), begin = get_global_id(0) * run,                         \
               end = min(begin + run, s##_width);                                              \
    const size_t first = (size_t)row * s##_pitch + s##_halo

#ifdef ADDRESS
#define ADDRESS_OF(a) ((uint)(a)LOW)

/* First every sender writes its index; then senders that find a lower index than their own
 * correct it. Without collisions there is no atomic operation. */
__kernel void claim(LAYOUT(s), uint run, uint mask, uint count, uint all, uint second,
                    const __global ADDRESS *address, const __global uchar *context,
                    volatile __global uint *owner)
{
    COLUMNS(s);
    for (uint x = begin; x < end; x++) {
        const uint i = row * s_width + x + 1;
        if (!all && !context[first + x])
            continue;
        const uint d = INDEX_OF(ADDRESS_OF(address[first + x]) & mask);
        if (d >= NOBODY)
            continue;
        if (!second)
            owner[d] = i;
        else if (owner[d] < i)
            atomic_max(&owner[d], i);
    }
}

__kernel void route(LAYOUT(s), uint run, uint mask, uint count, uint all,
                    const __global ADDRESS *address, const __global uchar *context,
                    __global uint *to)
{
    COLUMNS(s);
    for (uint x = begin; x < end; x++)
        to[row * s_width + x] =
            all || context[first + x] ? INDEX_OF(ADDRESS_OF(address[first + x]) & mask) : NONE;
}

#ifdef ELEMENT
/* out holds the old dest. Each work-item has a share of the destinations and passes over all
 * senders in order. Messages for other shares are written to a dummy place (trash, one for
 * each work-item), because a branch on them could not be predicted. */
__kernel void scatter(LAYOUT(s), uint rows, uint mask, uint count, LAYOUT(d), uint all,
                      uint share, uint notifies, uint trash,
                      const __global ADDRESS *restrict address,
                      const __global uchar *restrict context,
                      const __global ELEMENT *restrict from, __global ELEMENT *restrict out,
                      __global uint *restrict owner)
{
    DIVIDES_PLACE(d);
    const uint low = get_global_id(0) * share;
    const size_t lost = (size_t)trash + get_global_id(0) * 64;
    for (uint row = 0; row < rows; row++) {
        const size_t first = (size_t)row * s_pitch + s_halo;
        for (uint x = 0; x < s_width; x++) {
            const uint d = INDEX_OF(ADDRESS_OF(address[first + x]) & mask);
            const int mine = (d - low < share) & (d < NOBODY) & (all || context[first + x]);
            out[mine ? PLACE(d, d) : lost] = from[first + x];
            if (notifies && mine)
                owner[d] = 1;
        }
    }
}

__kernel void fetch(LAYOUT(s), uint run, uint mask, uint count, LAYOUT(f),
                    const __global ADDRESS *address, const __global ELEMENT *restrict from,
                    __global ELEMENT *restrict out)
{
    COLUMNS(s);
    DIVIDES_PLACE(f);
    for (uint x = begin; x < end; x++) {
        const uint d = INDEX_OF(ADDRESS_OF(address[first + x]) & mask);
        const ELEMENT v = d < NOBODY ? from[PLACE(f, d)] : (ELEMENT)(0);
        out[first + x] = v;
    }
}
#endif

#else
__kernel void arrived(LAYOUT(d), uint run, const __global uint *owner, __global uchar *out)
{
    COLUMNS(d);
    for (uint x = begin; x < end; x++) {
        const uchar v = owner[row * d_width + x] != 0;
        out[first + x] = v;
    }
}
#endif

#if defined(ELEMENT) && !defined(ADDRESS)
/* A work-item for each row. */
__kernel void edges(LAYOUT(d), __global ELEMENT *out)
{
    const size_t first = (size_t)get_global_id(1) * d_pitch + d_halo;
    for (uint x = 0; x < d_halo; x++) {
        out[first + d_width + x] = out[first + x];
        out[first - d_halo + x] = out[first + d_width - d_halo + x];
    }
}

#ifndef KIND
__kernel void deliver(LAYOUT(d), uint run, LAYOUT(s), const __global uint *owner,
                      const __global ELEMENT *from, const __global ELEMENT *old,
                      __global ELEMENT *out)
{
    COLUMNS(d);
    DIVIDES_PLACE(s);
    for (uint x = begin; x < end; x++) {
        const uint o = owner[row * d_width + x];
        const ELEMENT v = o ? from[PLACE(s, o - 1)] : old[first + x];
        out[first + x] = v;
    }
}
#else

/* op: AND, OR, XOR, ADD, UMIN, UMAX, SMIN, SMAX, FADD, FMIN, FMAX are 1 .. 11. sign: the
 * highest bit, mask: all bits, of the width. */
#if KIND == 0
static inline ELEMENT join(uint op, ELEMENT a, ELEMENT b, ulong2 sign, ulong2 mask)
{
    switch (op) {
    case 1:
        return a & b;
    case 2:
        return a | b;
    case 3:
        return a ^ b;
    case 4:
        return (ELEMENT)((a + b) & mask.x);
    case 5:
        return a < b ? a : b;
    case 6:
        return a > b ? a : b;
    case 7:
        return (a ^ sign.x) < (b ^ sign.x) ? a : b;
    case 8:
        return (a ^ sign.x) > (b ^ sign.x) ? a : b;
    }
    return 0;
}
#elif KIND == 1
static inline ELEMENT join(uint op, ELEMENT a, ELEMENT b, ulong2 sign, ulong2 mask)
{
    const ELEMENT c = op == 9 ? a + b : op == 10 ? (a < b ? a : b) : (a > b ? a : b);
    return c == c ? c : CANONICAL;
}
#else
static inline int less(ulong2 a, ulong2 b, ulong2 sign)
{
    a ^= sign;
    b ^= sign;
    return a.y < b.y || (a.y == b.y && a.x < b.x);
}
static inline ulong2 join(uint op, ulong2 a, ulong2 b, ulong2 sign, ulong2 mask)
{
    const ulong low = a.x + b.x;
    switch (op) {
    case 1:
        return a & b;
    case 2:
        return a | b;
    case 3:
        return a ^ b;
    case 4:
        return (ulong2)(low, a.y + b.y + (low < a.x)) & mask;
    case 5:
        return less(b, a, (ulong2)(0)) ? b : a;
    case 6:
        return less(a, b, (ulong2)(0)) ? b : a;
    case 7:
        return less(b, a, sign) ? b : a;
    case 8:
        return less(a, b, sign) ? b : a;
    }
    return 0;
}
#endif

/* Messages for other shares are combined in a dummy place (trash, one for each work-item),
 * because a branch on them could not be predicted. */
__kernel void combine(LAYOUT(d), LAYOUT(s), uint op, uint senders, uint share, uint notifies,
                      uint trash, ulong sign_low, ulong sign_high, ulong mask_low,
                      ulong mask_high, const __global uint *restrict to,
                      const __global ELEMENT *restrict from, __global ELEMENT *restrict out,
                      __global uint *restrict owner)
{
    const uint low = get_global_id(0) * share, lost = get_global_id(0) * 64;
    const ulong2 sign = (ulong2)(sign_low, sign_high), mask = (ulong2)(mask_low, mask_high);
    DIVIDES_PLACE(d);
    for (uint begin = 0, row = 0; begin < senders; begin += s_width, row++)
        for (uint x = 0; x < s_width; x++) {
            const uint d = to[begin + x];
            const int mine = (d - low < share) & (d < NOBODY);
            if (!trash && !mine)
                continue;
            /* No branch, which could not be predicted. Places of no use take turns, or each
             * access would wait for the one before. */
            const size_t keep = -(size_t)mine,
                         at = (PLACE(d, d) & keep) | (((size_t)trash + lost + x % 32) & ~keep);
            out[at] = join(op, out[at], from[(size_t)row * s_pitch + s_halo + x], sign, mask);
            if (notifies && mine)
                owner[d] = 1;
        }
}
#endif
#endif
