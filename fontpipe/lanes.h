/* lanes.h - vectors of LANES floats, and what they have an instruction for: part of
 * gray_kernel.h and edges_kernel.h, which are compiled once for each instruction set. */
#if defined(__AVX2__)
#include <immintrin.h>
#elif defined(__SSE2__)
#include <emmintrin.h>
#endif

typedef float vector __attribute__((vector_size(LANES * 4)));
typedef float vector_loose __attribute__((vector_size(LANES * 4), aligned(4), may_alias));
typedef int ints __attribute__((vector_size(LANES * 4)));
typedef int ints_loose __attribute__((vector_size(LANES * 4), aligned(4), may_alias));

#define INLINE static inline __attribute__((always_inline))

#if LANES == 16
#define OF_PROCESSOR(operation, ...) ((vector)_mm512_##operation##_ps(__VA_ARGS__))
typedef __m512 native;
#elif LANES == 8
#define OF_PROCESSOR(operation, ...) ((vector)_mm256_##operation##_ps(__VA_ARGS__))
typedef __m256 native;
#elif defined(__SSE2__)
#define OF_PROCESSOR(operation, ...) ((vector)_mm_##operation##_ps(__VA_ARGS__))
typedef __m128 native;
#endif

INLINE vector load(const float *at)
{
    return *(const vector_loose *)at;
}

INLINE vector vector_root(vector v)
{
#ifdef OF_PROCESSOR
    return OF_PROCESSOR(sqrt, (native)v);
#else
    for (int k = 0; k < LANES; k++)
        v[k] = __builtin_sqrtf(v[k]);
    return v;
#endif
}

INLINE vector vector_min(vector a, vector b)
{
#ifdef OF_PROCESSOR
    return OF_PROCESSOR(min, (native)a, (native)b);
#else
    ints mask = a < b;
    return (vector)(((ints)a & mask) | ((ints)b & ~mask));
#endif
}

INLINE vector vector_max(vector a, vector b)
{
#ifdef OF_PROCESSOR
    return OF_PROCESSOR(max, (native)a, (native)b);
#else
    ints mask = a > b;
    return (vector)(((ints)a & mask) | ((ints)b & ~mask));
#endif
}

INLINE vector vector_absolute(vector v)
{
    return (vector)((ints)v & 0x7fffffff);
}

/* ---- choices, lane by lane: masks have registers of their own in AVX-512; & and | work with
 * all of them ---- */

#if LANES == 16
typedef __mmask16 choice;
#else
typedef ints choice;
#endif

INLINE choice less(vector a, vector b)
{
#if LANES == 16
    return _mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_LT_OQ);
#else
    return a < b;
#endif
}

INLINE choice but_not(choice a, choice b)
{
    return (choice)(a & ~b);
}

/* a where it is so, else b. */
INLINE vector chosen(choice so, vector a, vector b)
{
#if LANES == 16
    return (vector)_mm512_mask_blend_ps(so, (__m512)b, (__m512)a);
#elif LANES == 8
    return (vector)_mm256_blendv_ps((__m256)b, (__m256)a, (__m256)so);
#else
    return (vector)(((ints)a & so) | ((ints)b & ~so));
#endif
}

/* More by so much where it is so. */
INLINE ints raised(ints v, choice so, int by)
{
#if LANES == 16
    return (ints)_mm512_mask_add_epi32((__m512i)v, so, (__m512i)v, _mm512_set1_epi32(by));
#else
    return v + (so & by);
#endif
}

/* Entries of a table of eight. */
INLINE vector of_table(const float *table, ints entry)
{
#if LANES == 16
    return (vector)_mm512_permutexvar_ps((__m512i)entry,
                                         _mm512_castps256_ps512(_mm256_loadu_ps(table)));
#elif LANES == 8
    return (vector)_mm256_permutevar8x32_ps(_mm256_loadu_ps(table), (__m256i)entry);
#else
    vector v;
    for (int k = 0; k < LANES; k++)
        v[k] = table[entry[k]];
    return v;
#endif
}

/* A bit for each lane, the first one's the lowest. */
INLINE unsigned choice_bits(choice so)
{
#if LANES == 16
    return so;
#elif LANES == 8
    return (unsigned)_mm256_movemask_ps((__m256)so);
#elif defined(__SSE2__)
    return (unsigned)_mm_movemask_ps((__m128)so);
#else
    unsigned bits = 0;
    for (int k = 0; k < LANES; k++)
        bits |= so[k] ? 1u << k : 0;
    return bits;
#endif
}

/* Of up to sixteen. */
INLINE int bits_count(unsigned bits)
{
#ifdef __POPCNT__
    return __builtin_popcount(bits);
#else
    bits -= bits >> 1 & 0x5555;
    bits = (bits & 0x3333) + (bits >> 2 & 0x3333);
    bits = (bits + (bits >> 4)) & 0x0f0f;
    return (int)((bits + (bits >> 8)) & 31);
#endif
}

/* The lanes where it is so, one behind the other. Up to LANES floats are written. */
INLINE void store_chosen(float *to, choice so, vector v)
{
#if LANES == 16
    _mm512_storeu_ps(to, _mm512_maskz_compress_ps(so, (__m512)v));
#else
    unsigned bits = choice_bits(so);
    for (int k = 0; k < LANES; k++, bits >>= 1) {
        *to = v[k];
        to += bits & 1;
    }
#endif
}
