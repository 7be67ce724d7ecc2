/* diffusion_vectors.cl - sixteen fibers as a vector: before the diffusion steps by hand, in the
 * same program. */
#pragma OPENCL FP_CONTRACT OFF

#define LANES 16

typedef float16 vector;
/* In one load, which vload16 of some devices is not. */
typedef float16 vector_anywhere __attribute__((aligned(4)));

#define LOAD(at) (*(const __global vector *)(at)) /* at: a multiple of 16 floats */
#define LOAD_ANY(at) (*(const __global vector_anywhere *)(at))
#define STORE(at, v) (*(__global vector *)(at) = (v))
#define STORE_PAST STORE /* past the caches, where the compiler knows how */
#if defined(__has_builtin)
#if __has_builtin(__builtin_nontemporal_store)
#undef STORE_PAST
#define STORE_PAST(at, v) __builtin_nontemporal_store(v, (__global vector *)(at))
#endif
#endif

static inline vector all_lanes(float x)
{
    return (vector)(x);
}

static inline vector least(vector a, vector b)
{
    return a < b ? a : b;
}

static inline vector greatest(vector a, vector b)
{
    return a > b ? a : b;
}

/* Lanes 1..15 of a, then lane 0 of b: the vector one fiber further on. */
static inline vector further(vector a, vector b)
{
    return (vector)(a.s123, a.s4567, a.s89ab, a.scdef, b.s0);
}

static inline vector moved(vector amount, vector in, vector out)
{
    vector t = amount + in;
    t = t - out;
    return greatest(least(t, all_lanes(1.0f)), all_lanes(0.0f));
}
