/* diffusion_per_axis.cl - the diffusion step by hand, one kernel for each axis: a reference for
 * generated kernels. Follows diffusion_vectors.cl in the program.
 *
 * Sixteen fibers are a vector. A sheet is nine planes of one buffer, PLANE floats apart:
 *
 *     0..3  water and three pigments      4..7  the same, to be written      8  absorbency
 *
 *     |<-- MARGIN -->|<------------ WIDTH ------------>|<-- MARGIN or more -->|
 *     |<------------------------------- PITCH ------------------------------->|   a row
 *
 * Neither PITCH nor PLANE is a multiple of a page: rows and planes that begin at the same
 * offset from a page would compete for the same cache sets.
 *
 * Two shapes give the same bits. Streaming goes from planes FROM to planes TO, computes a
 * neighbour's flow again, and bypasses the caches with its stores: it is best for sheets larger
 * than the caches. In place goes from right to left and from the last row to the first, so the
 * values that it reads are still old, and carries the flow for the next fibers. It is best
 * inside the cache, and does not wrap.
 *
 * Context: the rectangle X0 <= x < X1, Y0 <= y < Y1 is the bounds of the loops; only the
 * first and the last vector of a row are masked. Flows into fibers outside it are 0. gravity
 * > 0.
 */

/* WIDTH, HEIGHT, PITCH, PLANE, X0, Y0, X1, Y1 are given when it is built. */
#define MARGIN 16
#define ABSORBENCY 8
#define EACH_LANE (int16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15)

#define AT(plane, k) (sheet + (long)(plane)*PLANE + MARGIN + (k))
#if !STREAM_PAST_CACHES
#undef STORE_PAST
#define STORE_PAST STORE
#endif

struct constants {
    float gravity, weight[3];
};
#define CONSTANTS                                                                              \
    {                                                                                          \
        gravity,                                                                               \
        {                                                                                      \
            weight0, weight1, weight2                                                          \
        }                                                                                      \
    }
#define SHEET_AND_CONSTANTS                                                                    \
    __global float *sheet, int from, int to, float gravity, float weight0, float weight1,      \
        float weight2

static inline vector gravitate(vector flow, float gravity)
{
    return flow > (vector)(0.0f) ? flow * gravity : flow / gravity;
}

static inline vector gradient(vector lower, vector here, vector absorbency)
{
    return (lower - here) * absorbency;
}

/* Which fibers of a row take part; x may be up to a margin beyond the row's end, where the
 * row begins again. */
static inline int16 active(int16 x)
{
    int16 wrapped = x >= WIDTH ? x - WIDTH : x;
    return (wrapped >= X0) & (wrapped < X1);
}

/* ---- streaming ---- */

/* Flows into fibers k.. and into fibers k + step.., and the water of both, from old values. */
struct flows {
    vector here, next;
};

static inline struct flows water_flows(__global const float *sheet, int from, long lower,
                                       long k, long upper, long second, float gravity,
                                       int16 next_active, int16 second_active, bool masked,
                                       vector *water, vector *next_water)
{
    vector here = LOAD(AT(from, k)), next = LOAD_ANY(AT(from, upper));
    vector in =
        gravitate(gradient(LOAD_ANY(AT(from, lower)), here, LOAD(AT(ABSORBENCY, k))), gravity);
    vector out = gravitate(gradient(here, next, LOAD_ANY(AT(ABSORBENCY, upper))), gravity);
    vector beyond = gravitate(
        gradient(next, LOAD_ANY(AT(from, second)), LOAD_ANY(AT(ABSORBENCY, second))), gravity);
    if (masked) {
        out = next_active ? out : (vector)(0.0f);
        beyond = second_active ? beyond : (vector)(0.0f);
    }
    *water = moved(here, in, out);
    *next_water = moved(next, out, beyond);
    return (struct flows){in, out};
}

/* One vector of fibers; lower, upper and second are where the neighbours at -1, +1 and +2 on
 * the axis are. */
static inline void vector_stream(__global float *sheet, int from, int to, struct constants c,
                                 long lower, long k, long upper, long second, int16 here_active,
                                 int16 next_active, int16 second_active, bool masked)
{
    vector water, next_water;
    vector absorbency = LOAD(AT(ABSORBENCY, k)),
           next_absorbency = LOAD_ANY(AT(ABSORBENCY, upper));
    water_flows(sheet, from, lower, k, upper, second, c.gravity, next_active, second_active,
                masked, &water, &next_water);
    STORE_PAST(AT(to, k), masked ? (here_active ? water : LOAD(AT(from, k))) : water);
#pragma unroll
    for (int i = 0; i < 3; i++) {
        vector here = LOAD(AT(from + 1 + i, k)), next = LOAD_ANY(AT(from + 1 + i, upper));
        vector in =
            gradient(LOAD_ANY(AT(from + 1 + i, lower)), here, absorbency) * water * c.weight[i];
        vector out = gradient(here, next, next_absorbency) * next_water * c.weight[i];
        in = gravitate(in, c.gravity);
        out = gravitate(out, c.gravity);
        if (masked)
            out = next_active ? out : (vector)(0.0f);
        vector pigment = moved(here, in, out);
        STORE_PAST(AT(to + 1 + i, k), masked ? (here_active ? pigment : here) : pigment);
    }
}

/* Rows are shared out among get_global_size(1) work-items. */
static inline int first_row(void)
{
    return Y0 + (int)((long)(Y1 - Y0) * get_global_id(1) / get_global_size(1));
}

static inline int end_row(void)
{
    return Y0 + (int)((long)(Y1 - Y0) * (get_global_id(1) + 1) / get_global_size(1));
}

__kernel void diffusion_x_streaming(SHEET_AND_CONSTANTS)
{
    struct constants c = CONSTANTS;
    for (int y = first_row(); y < end_row(); y++) {
        long row = (long)y * PITCH;
        for (int i = 0; i < 5; i++) { /* the ends that the row's vectors look past */
            __global float *ends = AT(i < 4 ? from + i : ABSORBENCY, row);
            ends[-1] = ends[WIDTH - 1];
            ends[WIDTH] = ends[0];
            ends[WIDTH + 1] = ends[1];
        }
        for (int x = X0 / 16 * 16; x < X1; x += 16) {
            long k = row + x;
            if (x >= X0 && x + 17 < X1)
                vector_stream(sheet, from, to, c, k - 1, k, k + 1, k + 2, 0, 0, 0, false);
            else
                vector_stream(sheet, from, to, c, k - 1, k, k + 1, k + 2, active(x + EACH_LANE),
                              active(x + 1 + EACH_LANE), active(x + 2 + EACH_LANE), true);
        }
    }
}

__kernel void diffusion_y_streaming(SHEET_AND_CONSTANTS)
{
    struct constants c = CONSTANTS;
    for (int y = first_row(); y < end_row(); y++) {
        int next = (y + 1) % HEIGHT, second = (y + 2) % HEIGHT;
        int next_on = next >= Y0 && next < Y1, second_on = second >= Y0 && second < Y1;
        long lower = (long)(y ? y - 1 : HEIGHT - 1) * PITCH, row = (long)y * PITCH;
        for (int x = X0 / 16 * 16; x < X1; x += 16) {
            if (next_on && second_on && x >= X0 && x + 16 <= X1) {
                vector_stream(sheet, from, to, c, lower + x, row + x, (long)next * PITCH + x,
                              (long)second * PITCH + x, 0, 0, 0, false);
            } else {
                int16 here_active = active(x + EACH_LANE);
                vector_stream(sheet, from, to, c, lower + x, row + x, (long)next * PITCH + x,
                              (long)second * PITCH + x, here_active,
                              next_on ? here_active : (int16)(0),
                              second_on ? here_active : (int16)(0), true);
            }
        }
    }
}

/* ---- in place ---- */

/* One vector: leaves its inflow in flow[], which held the inflow of the fibers beyond. */
static inline void vector_in_place(__global float *sheet, struct constants c, long lower,
                                   long k, vector out[4], vector flow[4], bool along_row,
                                   int16 here_active, bool masked)
{
    vector absorbency = LOAD(AT(ABSORBENCY, k)), water = 0.0f;
#pragma unroll
    for (int i = 0; i < 4; i++) {
        vector here = LOAD(AT(i, k));
        vector in = gradient(LOAD_ANY(AT(i, lower)), here, absorbency);
        if (i)
            in = in * water * c.weight[i - 1];
        in = gravitate(in, c.gravity);
        if (masked)
            in = here_active ? in : (vector)(0.0f);
        vector now = moved(here, in, along_row ? further(in, out[i]) : out[i]);
        if (masked)
            now = here_active ? now : here;
        if (i == 0)
            water = now;
        STORE(AT(i, k), now);
        flow[i] = in;
    }
}

__kernel void diffusion_x_in_place(SHEET_AND_CONSTANTS)
{
    struct constants c = CONSTANTS;
    for (int y = first_row(); y < end_row(); y++) {
        vector flow[4] = {0.0f, 0.0f, 0.0f, 0.0f};
        long row = (long)y * PITCH;
        for (int x = (X1 - 1) / 16 * 16; x >= X0 / 16 * 16; x -= 16) {
            long k = row + x;
            if (x >= X0 && x + 16 <= X1)
                vector_in_place(sheet, c, k - 1, k, flow, flow, true, 0, false);
            else
                vector_in_place(sheet, c, k - 1, k, flow, flow, true, active(x + EACH_LANE),
                                true);
        }
    }
}

/* A work-item has a strip of columns, and keeps the outflow of its rows. */
#define STRIP 256

__kernel void diffusion_y_in_place(SHEET_AND_CONSTANTS)
{
    struct constants c = CONSTANTS;
    vector flow[STRIP / 16][4];
    int begin = get_global_id(1) * STRIP, end = min(begin + STRIP, (X1 + 15) / 16 * 16);
    begin = max(begin, X0 / 16 * 16);
    for (int i = 0; i < STRIP / 16; i++)
        for (int j = 0; j < 4; j++)
            flow[i][j] = 0.0f;
    for (int y = Y1 - 1; y >= Y0; y--) {
        long row = (long)y * PITCH;
        for (int x = begin; x < end; x += 16) {
            __private vector *f = flow[x % STRIP / 16];
            long k = row + x;
            if (x >= X0 && x + 16 <= X1)
                vector_in_place(sheet, c, k - PITCH, k, f, f, false, 0, false);
            else
                vector_in_place(sheet, c, k - PITCH, k, f, f, false, active(x + EACH_LANE),
                                true);
        }
    }
}
