/* gray_patch.h - nodes to sums by patches, for filters that are no short sum of products: part of gray_kernel.h.
 *
 * Where a node lies between two columns and two rows says which four patches of the table are interpolated between; the blocks
 * of sums are those of gray_kernel.h. What the table's straight lines are wrong by is of both signs along an edge, and
 * next to nothing after it. */

struct patch_batch {
    int patch[BATCH], sums[BATCH], row[BATCH];
    float here[BATCH], right[BATCH], below[BATCH], both[BATCH]; /* the four patches' weights */
};

INLINE void patch_batch_fill(struct patch_batch *b, const struct font_gray_job *job, int first,
                             int count, int stride)
{
    int odd = job->odd;
    for (int k = 0; k < count; k += LANES) { /* the arrays are longer than the count */
        vector ax = load(job->node_x + first + k) + job->ax;
        vector ay = load(job->node_y + first + k) + job->ay;
        vector weight = load(job->node_weight + first + k);
        ints ix = __builtin_convertvector(ax, ints), iy = __builtin_convertvector(ay, ints);
        vector px = (ax - __builtin_convertvector(ix, vector)) * FONT_PATCH_PHASES;
        vector py = (ay - __builtin_convertvector(iy, vector)) * FONT_PATCH_PHASES;
        ints qx = __builtin_convertvector(px, ints), qy = __builtin_convertvector(py, ints);
        vector tx = px - __builtin_convertvector(qx, vector);
        vector ty = (py - __builtin_convertvector(qy, vector)) * weight;
        ints row = iy - job->row, within = ix & 3, block = ix - within;
        block += (block >> 2 & 1) * (odd + 4);
        *(ints_loose *)(b->patch + k) =
            (qy * (FONT_PATCH_PHASES + 1) + qx) * FONT_PATCH_FLOATS + 4 - within;
        *(ints_loose *)(b->row + k) = row;
        *(ints_loose *)(b->sums + k) = (row + FONT_MARGIN_ROWS) * stride + block;
        vector both = tx * ty;
        *(vector_loose *)(b->both + k) = both;
        *(vector_loose *)(b->below + k) = ty - both;
        *(vector_loose *)(b->right + k) = tx * weight - both;
        *(vector_loose *)(b->here + k) = weight - tx * weight - ty + both;
    }
}

INLINE void patch_add(const struct font_gray_job *job, const struct patch_batch *b, int k,
                      float *sums, int stride, bool banded)
{
    enum { BELOW = (FONT_PATCH_PHASES + 1) * FONT_PATCH_FLOATS };
    if (banded && !row_in_band(job, b->row[k]))
        return;
    const float *patch = job->filter->patches + b->patch[k];
    float here = b->here[k], right = b->right[k], below = b->below[k], both = b->both[k];
    sums += b->sums[k];
    OPAQUE(sums);
    OPAQUE(patch);
    for (int r = 0; r <= FONT_PATCH_TAPS; r++)
        for (int p = 0; p < 8; p += HALF_LANES) {
            const float *at = patch + r * FONT_PATCH_ROW + p;
            *(half_vector *)(sums + r * stride + p) +=
                half_load(at) * here + half_load(at + FONT_PATCH_FLOATS) * right +
                half_load(at + BELOW) * below +
                half_load(at + BELOW + FONT_PATCH_FLOATS) * both;
        }
}

/* From three places in turns, as nodes_add(). */
INLINE void patches_add(const struct font_gray_job *job, int stride, bool banded)
{
    struct patch_batch b;
    for (int first = 0; first < job->nodes_count; first += BATCH) {
        int count = job->nodes_count - first < BATCH ? job->nodes_count - first : BATCH;
        int third = count / 3;
        patch_batch_fill(&b, job, first, count, stride);
        for (int k = 0; k < third; k++) {
            patch_add(job, &b, k, job->sums, stride, banded);
            patch_add(job, &b, k + third, job->sums, stride, banded);
            patch_add(job, &b, k + 2 * third, job->sums, stride, banded);
        }
        for (int k = 3 * third; k < count; k++)
            patch_add(job, &b, k, job->sums, stride, banded);
    }
}
