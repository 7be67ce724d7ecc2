/* gray_lanes.h - what vectors of LANES floats have an instruction for: part of gray_kernel.h. */
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
