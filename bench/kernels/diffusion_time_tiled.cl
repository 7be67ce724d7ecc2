/* diffusion_time_tiled.cl - several steps in one pass; after diffusion_row.cl.
 *
 * A work-item has a strip of columns and a band of rows, and a rim around it. Its scratch is
 * twelve rows for each step: four that have gone along x, four of flows, and the four that it
 * hands to the next step. The last step writes the sheet. PAST: past the caches. */

__kernel void diffusion_time_tiled(__global float *sheet, __global float *scratch,
                                   long scratch_floats, long row_floats, int from, int to,
                                   int columns, int height, long pitch, long plane, long origin,
                                   int steps_count, int strips_count, int bands_count,
                                   float gravity, float weight0, float weight1, float weight2)
{
    struct constants c = constants_of(gravity, weight0, weight1, weight2);
    int tile = get_global_id(0), strip = tile % strips_count, band = tile / strips_count;
    int vectors = columns / LANES;
    int xa = vectors * strip / strips_count * LANES;
    int xb = vectors * (strip + 1) / strips_count * LANES;
    int ya = (long)height * band / bands_count, yb = (long)height * (band + 1) / bands_count;
    int left = max(xa - LANES, 0), right = min(xb + LANES, columns);
    __global float *own = scratch + tile * scratch_floats;

    for (long i = 0; i < scratch_floats; i += LANES)
        STORE(own + i, (vector)(0.0f));
    own += LANES - left;
    /* Step s has row yb + steps_count - turn + s in hand. */
    for (int turn = -1; turn <= yb - ya + 2 * steps_count - 1; turn++)
        for (int s = 0; s < steps_count; s++) {
            int y = yb + steps_count - turn + s;
            int last = min(yb + steps_count - s, height - 1);
            int first = max(ya - (steps_count - 1 - s), 0);
            if (y > last + 1 || y < first)
                continue;
            long k = origin + (y - 1) * pitch;
            __global const float *a = sheet + ABSORBENCY * plane + k, *b = a + pitch;
            __global float *mine = own + s * 12 * row_floats;
            struct rows old = rows_at(sheet + from * plane + k, plane);
            struct rows along = rows_at(mine, row_floats);
            struct rows flow = rows_at(mine + 4 * row_floats, row_floats);
            struct rows out = rows_at(mine + 8 * row_floats, row_floats);
            vector carry[4] = {0.0f, 0.0f, 0.0f, 0.0f};
            int x1 = right;
            if (s > 0 && y > 0) { /* the step before has just left it */
                struct rows handed = rows_at(mine - 4 * row_floats, row_floats);
                for (int i = 0; i < 4; i++) /* the column that does not change */
                    handed.first[i * handed.apart + left - 1] =
                        old.first[i * old.apart + left - 1];
                old = handed;
            }
            bool to_sheet = s == steps_count - 1 && y < yb;
            if (y > last) {
                row(ROW_FIRST, false, old, a, a, along, flow, out, left, right, c, carry);
            } else if (y == 0) {
                if (to_sheet) {
                    row(ROW_EDGE, false, old, a, b, along, flow, out, xb, right, c, carry);
                    out = rows_at(sheet + to * plane + k + pitch, plane);
                    x1 = xb;
                }
                row(ROW_EDGE, false, old, a, b, along, flow, out, to_sheet ? xa : left, x1, c,
                    carry);
            } else if (to_sheet) {
                row(ROW_INNER, false, old, a, b, along, flow, out, xb, right, c, carry);
                out = rows_at(sheet + to * plane + k + pitch, plane);
                row(ROW_INNER, PAST, old, a, b, along, flow, out, xa, xb, c, carry);
            } else {
                row(ROW_INNER, false, old, a, b, along, flow, out, left, right, c, carry);
            }
        }
}
