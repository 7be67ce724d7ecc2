/* reshape.cl - the memory of physical processors, seen from VP sets of other ratios. See
 * reshape.h.
 *
 * Virtual processor (p, r), the r-th of physical processor p, has the row-major index p * ratio
 * + r in send order (layout 1) and r * P + p where processors are dealt out (layout 0). With
 * subgrids (layout 2) it is the sum without carry of what each bit of p * ratio + r stands for.
 * Each has k finer ones: coarse (p, j) is fine (p, j * k) to (p, j * k + k - 1).
 *
 *     slices   out i of coarse (p, j) = fine (p, j * k + first + i), for i < n
 *     weave    fine (p, j * k + first + i * parts + t) = the t-th `width` bits of in i of
 *              coarse (p, j)
 *     put      bits of one slot into images of the processors' memory
 *     get      and out of them
 *
 * Processors beyond the set's size read as 0. -DELEMENT= uchar .. ulong2, of fine values in
 * memory; -DWHOLE= of coarse ones. RUN physical processors are a work-item.
 */

#define SET(s)                                                                                 \
    uint s##_count, uint s##_ratio, uint s##_plog2, uint s##_layout, uint16 s##_low,           \
        uint16 s##_high, uint s##_width, uint s##_pitch, uint s##_halo

#define SUBGRIDS 2

static inline uint linear(uint x, const uint *bits)
{
    uint sum = 0;
    for (; x; x >>= 1, bits++)
        sum ^= *bits & -(x & 1);
    return sum;
}

/* The row-major index; UINT_MAX if there is no such processor. base: of (p, 0), for
 * subgrids. */
static inline uint index_at(uint p, uint r, uint base, uint count, uint ratio, uint plog2,
                            uint layout, const uint *bits)
{
    const ulong n = layout == SUBGRIDS ? base ^ linear(r, bits)
                    : layout           ? (ulong)p * ratio + r
                                       : ((ulong)r << plog2) + p;
    return n < count && (layout != SUBGRIDS || (ulong)p * ratio + r < count) ? (uint)n
                                                                             : 0xffffffffu;
}
#define PREPARE(s)                                                                             \
    uint s##_bits[32];                                                                         \
    vstore16(s##_low, 0, s##_bits);                                                            \
    vstore16(s##_high, 1, s##_bits)
/* Before the virtual processors of p. */
#define BASE(s, p)                                                                             \
    const uint s##_base = s##_layout == SUBGRIDS ? linear((p)*s##_ratio, s##_bits) : 0
#define INDEX(s, p, r)                                                                         \
    index_at(p, r, s##_base, s##_count, s##_ratio, s##_plog2, s##_layout, s##_bits)

static inline size_t place(uint n, uint width, uint pitch, uint halo)
{
    return n < width ? n + halo : (size_t)(n / width) * pitch + halo + n % width;
}
#define PLACE(s, n) place(n, s##_width, s##_pitch, s##_halo)

/* Stores an element, and its copy at the other end of its row. */
#define STORE(s, out, n, v)                                                                    \
    do {                                                                                       \
        const size_t at = PLACE(s, n);                                                         \
        out[at] = v;                                                                           \
        if (s##_halo) {                                                                        \
            const uint x = n < s##_width ? n : n % s##_width;                                  \
            if (x < s##_halo)                                                                  \
                out[at + s##_width] = v;                                                       \
            if (x + s##_halo >= s##_width)                                                     \
                out[at - s##_width] = v;                                                       \
        }                                                                                      \
    } while (0)

#define SIXTEEN(type, name)                                                                    \
    type name##0, type name##1, type name##2, type name##3, type name##4, type name##5,        \
        type name##6, type name##7, type name##8, type name##9, type name##10, type name##11,  \
        type name##12, type name##13, type name##14, type name##15
#define LIST(name)                                                                             \
    {                                                                                          \
        name##0, name##1, name##2, name##3, name##4, name##5, name##6, name##7, name##8,       \
            name##9, name##10, name##11, name##12, name##13, name##14, name##15                \
    }

#define PROCESSORS(body)                                                                       \
    const uint j = get_global_id(1), begin = get_global_id(0) * run;                           \
    const uint end = min(begin + run, 1u << c_plog2);                                          \
    PREPARE(c);                                                                                \
    PREPARE(f);                                                                                \
    for (uint p = begin; p < end; p++) {                                                       \
        BASE(c, p);                                                                            \
        BASE(f, p);                                                                            \
        const uint m = INDEX(c, p, j);                                                         \
        body                                                                                   \
    }

#ifdef ELEMENT
#ifndef WHOLE
__kernel void slices(SET(f), SET(c), uint run, uint k, uint first, uint n, uint wanted,
                     const __global ELEMENT *in, SIXTEEN(__global ELEMENT *, o))
{
    __global ELEMENT *const out[16] = LIST(o);
    PROCESSORS({
        if (m == 0xffffffffu)
            continue;
        for (uint i = 0; i < n; i++) {
            const uint q = INDEX(f, p, j * k + first + i);
            const ELEMENT v = q != 0xffffffffu ? in[PLACE(f, q)] : (ELEMENT)(0);
            if (wanted >> i & 1)
                STORE(c, out[i], m, v);
        }
    })
}

/* run counts physical processors; bits [bit, bit + width) of virtual processor r are at start +
 * r / parts * outer + r % parts * inner. */
#ifdef PAIR
#define LOW(v) (v).x
#define HIGH(v) (v).y
#define JOINED(low, high) ((ulong2)(low, high))
#else
#define LOW(v) (ulong)(v)
#define HIGH(v) 0UL
#define JOINED(low, high) ((ELEMENT)(low))
#endif

static inline ulong image_read(const __global uint *image, uint at, uint width)
{
    ulong v = 0;
    for (uint done = 0; done < width;) {
        const uint bit = (at + done) % 32, n = min(32 - bit, width - done);
        v |= ((ulong)(image[(at + done) / 32] >> bit) & ((1UL << n) - 1)) << done;
        done += n;
    }
    return v;
}

static inline void image_write(__global uint *image, uint at, uint width, ulong v)
{
    for (uint done = 0; done < width;) {
        const uint bit = (at + done) % 32, n = min(32 - bit, width - done);
        const uint mask = (uint)(((1UL << n) - 1) << bit);
        const uint i = (at + done) / 32;
        image[i] = (image[i] & ~mask) | ((uint)(v >> done) << bit & mask);
        done += n;
    }
}

__kernel void put(SET(c), uint run, uint words, uint start, uint parts, uint outer, uint inner,
                  uint width, const __global ELEMENT *in, __global uint *image)
{
    const uint begin = get_global_id(0) * run, end = min(begin + run, 1u << c_plog2);
    PREPARE(c);
    for (uint p = begin; p < end; p++) {
        BASE(c, p);
        for (uint r = 0; r < c_ratio; r++) {
            const uint m = INDEX(c, p, r), at = start + r / parts * outer + r % parts * inner;
            const ELEMENT v = m != 0xffffffffu ? in[PLACE(c, m)] : (ELEMENT)(0);
            __global uint *memory = image + (size_t)p * words;
            image_write(memory, at, min(width, 64u), LOW(v));
            if (width > 64)
                image_write(memory, at + 64, width - 64, HIGH(v));
        }
    }
}

__kernel void get(SET(c), uint run, uint words, uint start, uint parts, uint outer, uint inner,
                  uint width, const __global uint *image, __global ELEMENT *out)
{
    const uint begin = get_global_id(0) * run, end = min(begin + run, 1u << c_plog2);
    PREPARE(c);
    for (uint p = begin; p < end; p++) {
        BASE(c, p);
        for (uint r = 0; r < c_ratio; r++) {
            const uint m = INDEX(c, p, r), at = start + r / parts * outer + r % parts * inner;
            const __global uint *memory = image + (size_t)p * words;
            if (m == 0xffffffffu)
                continue;
            const ulong low = image_read(memory, at, min(width, 64u));
            const ulong high = width > 64 ? image_read(memory, at + 64, width - 64) : 0;
            const ELEMENT v = JOINED(low, high);
            STORE(c, out, m, v);
        }
    }
}
#else
#ifdef PAIR
#define PART(v, t) (v)
#elif defined(WIDE)
static inline ulong bits_from(ulong2 v, uint at)
{
    return at == 0 ? v.x : at < 64 ? v.x >> at | v.y << (64 - at) : v.y >> (at - 64);
}
#define PART(v, t) ((ELEMENT)(bits_from(v, (t)*width) & mask))
#else
#define PART(v, t) ((ELEMENT)((ulong)(v) >> (t)*width & mask))
#endif

__kernel void weave(SET(f), SET(c), uint run, uint k, uint first, uint n, uint parts,
                    uint width, ulong mask, SIXTEEN(const __global WHOLE *, i),
                    __global ELEMENT *out)
{
    const __global WHOLE *const in[16] = LIST(i);
    PROCESSORS({
        for (uint i = 0; i < n; i++) {
            const WHOLE whole = m != 0xffffffffu ? in[i][PLACE(c, m)] : (WHOLE)(0);
            for (uint t = 0; t < parts && first + i * parts + t < k; t++) {
                const uint q = INDEX(f, p, j * k + first + i * parts + t);
                const ELEMENT v = PART(whole, t);
                if (q != 0xffffffffu)
                    STORE(f, out, q, v);
            }
        }
    })
}
#endif
#endif
