/* diffusion_rolling.cl - the diffusion step by hand, both axes in one pass over rolling rows:
 * what one row is. diffusion_single_pass.cl and diffusion_time_tiled.cl follow it in the same
 * program; bench/rolling.h explains.
 *
 * Built with -DRISES=1 if gravity is 1 or more, else 0; with -DRELAXED=1 for the variants that
 * multiply by 1 / gravity and fold constants, and so give other bits; -DABSORBENCY= its plane. */
#pragma OPENCL FP_CONTRACT OFF

#define LANES 16

#define LOAD(at) (*(const __global float16 *)(at))
/* In one load, which vload16 of some devices is not. */
typedef float16 float16_anywhere __attribute__((aligned(4)));
#define LOAD_ANY(at) (*(const __global float16_anywhere *)(at))
#define STORE(at, v) (*(__global float16 *)(at) = (v))
#define STORE_PAST STORE
#if defined(__has_builtin)
#if __has_builtin(__builtin_nontemporal_store)
#undef STORE_PAST
#define STORE_PAST(at, v) __builtin_nontemporal_store(v, (__global float16 *)(at))
#endif
#endif

struct constants {
#if RELAXED
    float rising[4], falling[4]; /* weight * gravity, weight / gravity */
#else
    float gravity, weight[3];
#endif
};

static inline struct constants constants_of(float gravity, float weight0, float weight1,
                                            float weight2)
{
#if RELAXED
    float r = 1.0f / gravity;
    struct constants c = {{gravity, weight0 * gravity, weight1 * gravity, weight2 * gravity},
                          {r, weight0 * r, weight1 * r, weight2 * r}};
#else
    struct constants c = {gravity, {weight0, weight1, weight2}};
#endif
    return c;
}

/* Rows of the four fields: that of field i begins at first + i * apart. */
struct rows {
    __global float *first;
    long apart;
};

static inline struct rows rows_at(__global float *first, long apart)
{
    struct rows r = {first, apart};
    return r;
}

/* Rounding keeps the order, so the larger is flow * gravity where flow is above zero, and
 * flow / gravity where it is below. */
static inline float16 the_one(float16 along, float16 against)
{
#if RISES
    return along > against ? along : against;
#else
    return along < against ? along : against;
#endif
}

/* What flows into fibers of field i. wet: absorbency, or absorbency * water. */
static inline float16 flow_in(float16 lower, float16 here, float16 absorbency, float16 water,
                              int i, struct constants c)
{
    float16 t = lower - here;
#if RELAXED
    t = t * (i ? absorbency * water : absorbency);
    return the_one(t * c.rising[i], t * c.falling[i]);
#else
    t = t * absorbency;
    if (i)
        t = t * water * c.weight[i - 1];
    return the_one(t * c.gravity, t / c.gravity);
#endif
}

static inline float16 moved(float16 amount, float16 in, float16 out)
{
    float16 t = amount + in;
    t = t - out;
    t = t < (float16)(1.0f) ? t : (float16)(1.0f);
    return t > (float16)(0.0f) ? t : (float16)(0.0f);
}

/* Lanes 1..15 of a, then lane 0 of b: what lies one fiber further on. */
static inline float16 further(float16 a, float16 b)
{
    return (float16)(a.s123, a.s4567, a.s89ab, a.scdef, b.s0);
}

enum {
    ROW_FIRST, /* of a walk: along x only, there is no row before it */
    ROW_INNER,
    ROW_EDGE /* the row above it, y - 1, is outside the rectangle and does not change */
};

/* Columns x0..x1-1, from right to left: row y - 1, in `old`, goes along x and is kept in
 * `along`; row y, which was there, goes along y to `out`. `flow`: into row y + 1, then into
 * row y. carry: the flows into the vector at x1, then at x0. */
static inline __attribute__((always_inline)) void
row(int kind, bool past, struct rows old, __global const float *upper_absorbency,
    __global const float *absorbency, struct rows along, struct rows flow, struct rows out,
    int x0, int x1, struct constants c, float16 carry[4])
{
    float16 carry0 = carry[0], carry1 = carry[1], carry2 = carry[2], carry3 = carry[3];
/* A macro: an array of what is carried would not stay in registers. */
#define FIELD(i, carried)                                                                      \
    {                                                                                          \
        float16 upper = LOAD(old.first + (i)*old.apart + x);                                   \
        if (kind != ROW_EDGE) {                                                                \
            float16 lower = LOAD_ANY(old.first + (i)*old.apart + x - 1);                       \
            float16 in = flow_in(lower, upper, a, water_x, i, c);                              \
            upper = moved(upper, in, further(in, carried));                                    \
            carried = in;                                                                      \
            if ((i) == 0)                                                                      \
                water_x = upper;                                                               \
        }                                                                                      \
        if (kind != ROW_FIRST) {                                                               \
            float16 here = LOAD(along.first + (i)*along.apart + x);                            \
            float16 in = flow_in(upper, here, b, water_y, i, c);                               \
            here = moved(here, in, LOAD(flow.first + (i)*flow.apart + x));                     \
            STORE(flow.first + (i)*flow.apart + x, in);                                        \
            if ((i) == 0)                                                                      \
                water_y = here;                                                                \
            if (past)                                                                          \
                STORE_PAST(out.first + (i)*out.apart + x, here);                               \
            else                                                                               \
                STORE(out.first + (i)*out.apart + x, here);                                    \
        }                                                                                      \
        STORE(along.first + (i)*along.apart + x, upper);                                       \
    }
    for (int x = x1 - LANES; x >= x0; x -= LANES) {
        float16 a = LOAD(upper_absorbency + x), b = LOAD(absorbency + x);
        float16 water_x = 0.0f, water_y = 0.0f;
        FIELD(0, carry0)
        FIELD(1, carry1)
        FIELD(2, carry2)
        FIELD(3, carry3)
    }
#undef FIELD
    carry[0] = carry0;
    carry[1] = carry1;
    carry[2] = carry2;
    carry[3] = carry3;
}
