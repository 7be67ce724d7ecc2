/* lanes.h - vectors of LANES doubles, for step_kernel.h: 8 (AVX-512), 4 (AVX2) or 1. Each
 * function rounds as plain C does, lane by lane. */
#ifndef LUTETIA_DYN_LANES_H
#define LUTETIA_DYN_LANES_H

#include "internal.h"

#include <math.h>
#if LANES > 1
#include <immintrin.h>
#endif

#define INLINE static inline __attribute__((always_inline))

#if LANES == 8

typedef __m512d lanes;
typedef __mmask8 lanes_mask;

INLINE lanes lanes_load(const double *at)
{
    return _mm512_load_pd(at);
}

INLINE void lanes_store(double *at, lanes v)
{
    _mm512_storeu_pd(at, v);
}

INLINE lanes lanes_all(double v)
{
    return _mm512_set1_pd(v);
}

INLINE lanes_mask lanes_less(lanes a, lanes b)
{
    return _mm512_cmp_pd_mask(a, b, _CMP_LT_OQ);
}

INLINE lanes_mask lanes_both(lanes_mask a, lanes_mask b)
{
    return (lanes_mask)(a & b);
}

INLINE lanes_mask lanes_either(lanes_mask a, lanes_mask b)
{
    return (lanes_mask)(a | b);
}

INLINE unsigned lanes_bits(lanes_mask m)
{
    return m;
}

INLINE lanes lanes_pick(lanes_mask m, lanes yes, lanes no)
{
    return _mm512_mask_blend_pd(m, no, yes);
}

INLINE lanes lanes_sqrt(lanes v)
{
    return _mm512_sqrt_pd(v);
}

INLINE lanes lanes_min(lanes a, lanes b)
{
    return _mm512_min_pd(a, b);
}

INLINE lanes lanes_max(lanes a, lanes b)
{
    return _mm512_max_pd(a, b);
}

#elif LANES == 4

typedef __m256d lanes;
typedef __m256d lanes_mask;

INLINE lanes lanes_load(const double *at)
{
    return _mm256_load_pd(at);
}

INLINE void lanes_store(double *at, lanes v)
{
    _mm256_storeu_pd(at, v);
}

INLINE lanes lanes_all(double v)
{
    return _mm256_set1_pd(v);
}

INLINE lanes_mask lanes_less(lanes a, lanes b)
{
    return _mm256_cmp_pd(a, b, _CMP_LT_OQ);
}

INLINE lanes_mask lanes_both(lanes_mask a, lanes_mask b)
{
    return _mm256_and_pd(a, b);
}

INLINE lanes_mask lanes_either(lanes_mask a, lanes_mask b)
{
    return _mm256_or_pd(a, b);
}

INLINE unsigned lanes_bits(lanes_mask m)
{
    return (unsigned)_mm256_movemask_pd(m);
}

INLINE lanes lanes_pick(lanes_mask m, lanes yes, lanes no)
{
    return _mm256_blendv_pd(no, yes, m);
}

INLINE lanes lanes_sqrt(lanes v)
{
    return _mm256_sqrt_pd(v);
}

INLINE lanes lanes_min(lanes a, lanes b)
{
    return _mm256_min_pd(a, b);
}

INLINE lanes lanes_max(lanes a, lanes b)
{
    return _mm256_max_pd(a, b);
}

#else

typedef double lanes;
typedef bool lanes_mask;

INLINE lanes lanes_load(const double *at)
{
    return *at;
}

INLINE void lanes_store(double *at, lanes v)
{
    *at = v;
}

INLINE lanes lanes_all(double v)
{
    return v;
}

INLINE lanes_mask lanes_less(lanes a, lanes b)
{
    return a < b;
}

INLINE lanes_mask lanes_both(lanes_mask a, lanes_mask b)
{
    return a && b;
}

INLINE lanes_mask lanes_either(lanes_mask a, lanes_mask b)
{
    return a || b;
}

INLINE unsigned lanes_bits(lanes_mask m)
{
    return m;
}

INLINE lanes lanes_pick(lanes_mask m, lanes yes, lanes no)
{
    return m ? yes : no;
}

INLINE lanes lanes_sqrt(lanes v)
{
    return sqrt(v);
}

INLINE lanes lanes_min(lanes a, lanes b)
{
    return a < b ? a : b;
}

INLINE lanes lanes_max(lanes a, lanes b)
{
    return a > b ? a : b;
}

#endif
#endif
