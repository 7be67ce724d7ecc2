/* diffusion_rolling.cl - the diffusion step by hand, both axes in one pass over rolling rows:
 * what flows. diffusion_vectors.cl comes before it in the same program, diffusion_row.cl and
 * diffusion_single_pass.cl or diffusion_time_tiled.cl behind it; bench/rolling.h explains.
 *
 * Built with -DRISES=1 if gravity is 1 or more, else 0; with -DRELAXED=1 for the variants that
 * multiply by 1 / gravity and fold constants, and so give other bits; -DABSORBENCY= its
 * plane. */
#define INLINE static inline __attribute__((always_inline))

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
static inline vector the_one(vector along, vector against)
{
    return RISES ? greatest(along, against) : least(along, against);
}

/* The inflow of fibers of field i. wet: absorbency, or absorbency * water. */
static inline vector flow_in(vector lower, vector here, vector absorbency, vector water, int i,
                             struct constants c)
{
    vector t = lower - here;
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
