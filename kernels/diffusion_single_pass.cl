/* diffusion_single_pass.cl - one step in one pass; after diffusion_rolling.cl.
 *
 * A work-item has a strip of columns and a band of rows. Its scratch is eight rows: four that
 * have gone along x, four of flows. PAST: write past the caches. */

__kernel void diffusion_single_pass(__global float *sheet, __global float *scratch,
                                    long scratch_floats, long row_floats, int from, int to,
                                    int columns, int height, long pitch, long plane,
                                    long origin, int steps_count, int strips_count,
                                    int bands_count, float gravity, float weight0,
                                    float weight1, float weight2)
{
    struct constants c = constants_of(gravity, weight0, weight1, weight2);
    int tile = get_global_id(0), strip = tile % strips_count, band = tile / strips_count;
    int vectors = columns / LANES;
    int xa = vectors * strip / strips_count * LANES;
    int xb = vectors * (strip + 1) / strips_count * LANES;
    int ya = (long)height * band / bands_count, yb = (long)height * (band + 1) / bands_count;
    int last = min(yb + 1, height - 1); /* the flows of two rows further on are needed */
    int right = min(xb + LANES, columns);
    __global float *own = scratch + tile * scratch_floats + LANES - xa;
    struct rows along = rows_at(own, row_floats),
                flow = rows_at(own + 4 * row_floats, row_floats);
    struct rows spare = rows_at(own + 8 * row_floats, row_floats);

    for (int i = 0; i < 4; i++)
        for (int x = xa; x < right; x += LANES)
            STORE(flow.first + i * flow.apart + x, (float16)(0.0f));
    for (int y = last + 1; y >= ya; y--) {
        long k = origin + (y - 1) * pitch;
        __global const float *a = sheet + 8 * plane + k, *b = a + pitch;
        struct rows old = rows_at(sheet + from * plane + k, plane);
        struct rows out = rows_at(sheet + to * plane + k + pitch, plane);
        float16 carry[4] = {0.0f, 0.0f, 0.0f, 0.0f};
        if (y > last) {
            row(ROW_FIRST, false, old, a, a, along, flow, spare, xa, right, c, carry);
        } else if (y == 0) {
            row(ROW_EDGE, false, old, a, b, along, flow, spare, xb, right, c, carry);
            row(ROW_EDGE, false, old, a, b, along, flow, out, xa, xb, c, carry);
        } else if (y >= yb) {
            row(ROW_INNER, false, old, a, b, along, flow, spare, xa, right, c, carry);
        } else {
            row(ROW_INNER, false, old, a, b, along, flow, spare, xb, right, c, carry);
            row(ROW_INNER, PAST, old, a, b, along, flow, out, xa, xb, c, carry);
        }
    }
}
