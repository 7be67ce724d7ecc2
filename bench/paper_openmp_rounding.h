/* paper_openmp_rounding.h - arithmetic of the paper's model in plain C, all of which becomes
 * vectors; flows are rounded here. */
#ifndef LUTETIA_PAPER_OPENMP_ROUNDING_H
#define LUTETIA_PAPER_OPENMP_ROUNDING_H

#define INLINE static inline __attribute__((always_inline))
/* A float plus that has no place for a fraction: see host/paris_kit/kit_float.h. */
#define WHOLE 12582912.0f

INLINE float least(float a, float b)
{
    return a < b ? a : b;
}

INLINE float greatest(float a, float b)
{
    return a > b ? a : b;
}

INLINE float within(float a, float low, float high)
{
    return least(greatest(a, low), high);
}

/* The nearest whole number. */
INLINE float whole(float x)
{
    return (x + WHOLE) - WHOLE;
}

/* ... and no more than q, of which it is taken. */
INLINE float whole_of(float x, float q)
{
    return least(whole(x), q);
}

#endif
