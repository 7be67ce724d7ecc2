/* diffusion_single_pass.cl - one step in one pass, in place; after diffusion_row.cl.
 *
 * A work-item has a band of rows and processes it from its last row to its first, so the values
 * that it reads are still old. Its scratch is twelve rows: four after the pass along x, four of
 * flows, four that are not kept. The rows that a band needs of its neighbours may be
 * overwritten by then, so each step copies these rows for the next one, to `edges`:
 *
 *       of each band   ya, ya + 1   for the band before it, which needs the flows into row yb
 *                      yb - 1       for the band after it
 *
 * A band has two rows or more. A row of edges is as long as one of the sheet.
 */

static inline struct rows edge_at(__global float *edges, long pitch, int band, int which)
{
    return rows_at(edges + ((long)band * 3 + which) * 4 * pitch, pitch);
}

static inline void edge_keep(struct rows edge, struct rows now, int columns)
{
    for (int i = 0; i < 4; i++)
        for (int x = 0; x < columns; x += LANES)
            STORE(edge.first + i * edge.apart + x, LOAD(now.first + i * now.apart + x));
}

static inline void band_edges_keep(__global float *edges, long pitch, int band, int y, int ya,
                                   int yb, struct rows now, int columns)
{
    if (y == yb - 1)
        edge_keep(edge_at(edges, pitch, band, 2), now, columns);
    if (y <= ya + 1)
        edge_keep(edge_at(edges, pitch, band, y - ya), now, columns);
}

/* Of the sheet as it is, with the vector before each row, which never changes. */
__kernel void diffusion_edges(__global float *sheet, __global float *edges, int columns,
                              int height, long pitch, long plane, long origin)
{
    int band = get_global_id(0), bands_count = get_global_size(0);
    int ya = (long)height * band / bands_count, yb = (long)height * (band + 1) / bands_count;
    for (int y = ya; y < yb; y++)
        band_edges_keep(edges, pitch, band, y, ya, yb,
                        rows_at(sheet + origin + y * pitch - LANES, plane), columns + LANES);
}

__kernel void diffusion_single_pass(__global float *sheet, __global float *scratch,
                                    long scratch_floats, long row_floats, __global float *edges,
                                    __global float *next_edges, int columns, int height,
                                    long pitch, long plane, long origin, float gravity,
                                    float weight0, float weight1, float weight2)
{
    struct constants c = constants_of(gravity, weight0, weight1, weight2);
    int band = get_global_id(0), bands_count = get_global_size(0);
    int ya = (long)height * band / bands_count, yb = (long)height * (band + 1) / bands_count;
    int last = min(yb + 1, height - 1); /* the flows of two rows further on are needed */
    __global float *own = scratch + band * scratch_floats;
    struct rows along = rows_at(own, row_floats);
    struct rows flow = rows_at(own + 4 * row_floats, row_floats);
    struct rows spare = rows_at(own + 8 * row_floats, row_floats);

    edges += LANES;
    next_edges += LANES;
    for (int i = 0; i < 4; i++)
        for (int x = 0; x < columns; x += LANES)
            STORE(flow.first + i * flow.apart + x, (vector)(0.0f));
    for (int y = last + 1; y >= ya; y--) {
        __global float *upper = sheet + origin + (y - 1) * pitch;
        __global const float *a = upper + ABSORBENCY * plane, *b = a + pitch;
        struct rows old = rows_at(upper, plane), out = rows_at(upper + pitch, plane);
        vector carry[4] = {0.0f, 0.0f, 0.0f, 0.0f};
        if (y > yb)
            old = edge_at(edges, pitch, band + 1, y - 1 - yb);
        else if (y == ya && y > 0)
            old = edge_at(edges, pitch, band - 1, 2);
        if (y > last)
            row(ROW_FIRST, false, old, a, a, along, flow, spare, 0, columns, c, carry);
        else if (y == 0)
            row(ROW_EDGE, false, old, a, b, along, flow, out, 0, columns, c, carry);
        else
            row(ROW_INNER, false, old, a, b, along, flow, y < yb ? out : spare, 0, columns, c,
                carry);
        if (y < yb)
            band_edges_keep(next_edges, pitch, band, y, ya, yb, out, columns);
    }
}
