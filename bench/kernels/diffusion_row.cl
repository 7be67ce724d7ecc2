/* diffusion_row.cl - one row of one step over rolling rows: the same text in OpenCL C, after
 * diffusion_rolling.cl, and in C, included by bench/openmp_rolling.c. Before it come
 *
 *     vector, LANES, LOAD, LOAD_ANY, STORE, STORE_PAST, all_lanes(), further(), moved()
 *     struct constants, flow_in()     what flows into fibers of field i
 *     struct rows                     of the four fields: that of field i begins at first + i *
 *                                     apart
 *     INLINE                          a function that is always part of its caller
 *
 * and in C __global, which is nothing. */

enum row_kind {
    ROW_FIRST, /* of a walk: along x only, there is no row before it */
    ROW_INNER,
    ROW_EDGE /* the row above it, y - 1, is outside the rectangle and does not change */
};

/* Columns x0..x1-1, from right to left: row y - 1, in `old`, goes along x and is kept in
 * `along`; row y, which was there, goes along y to `out`. `flow`: into row y + 1, then into
 * row y. carry: the flows into the vector at x1, then at x0. */
INLINE void row(enum row_kind kind, bool past, struct rows old,
                __global const float *upper_absorbency, __global const float *absorbency,
                struct rows along, struct rows flow, struct rows out, int x0, int x1,
                struct constants c, vector carry[4])
{
    vector carry0 = carry[0], carry1 = carry[1], carry2 = carry[2], carry3 = carry[3];
/* A macro: an array of what is carried would not stay in registers. */
#define FIELD(i, carried)                                                                      \
    {                                                                                          \
        vector upper = LOAD(old.first + (i)*old.apart + x);                                    \
        if (kind != ROW_EDGE) {                                                                \
            vector lower = LOAD_ANY(old.first + (i)*old.apart + x - 1);                        \
            vector in = flow_in(lower, upper, a, water_x, i, c);                               \
            upper = moved(upper, in, further(in, carried));                                    \
            carried = in;                                                                      \
            if ((i) == 0)                                                                      \
                water_x = upper;                                                               \
        }                                                                                      \
        if (kind != ROW_FIRST) {                                                               \
            vector here = LOAD(along.first + (i)*along.apart + x);                             \
            vector in = flow_in(upper, here, b, water_y, i, c);                                \
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
    for (long x = x1 - LANES; x >= x0; x -= LANES) {
        vector a = LOAD(upper_absorbency + x), b = LOAD(absorbency + x);
        vector water_x = all_lanes(0.0f), water_y = all_lanes(0.0f);
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
