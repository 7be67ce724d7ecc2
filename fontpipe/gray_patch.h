/* gray_patch.h - nodes to sums by patches, for filters that are no short sum of products: part
 * of gray_kernel.h.
 *
 * Where a node lies between two columns and two rows says which four patches of the table are
 * interpolated between. What the table's straight lines are wrong by is of both signs along an
 * edge, and next to nothing after it. A patch is four rows of four columns, which together are
 * one cache line; nodes of one pixel that follow each other are added up in registers, and then
 * once to the four rows. */

typedef float four_columns __attribute__((vector_size(16), aligned(4), may_alias));

struct patch_batch {
    int patch[BATCH], sums[BATCH], row[BATCH];
    float here[BATCH], right[BATCH], below[BATCH], both[BATCH]; /* the four patches' weights */
};

INLINE void patch_batch_fill(struct patch_batch *b, const struct font_gray_job *job, int first,
                             int count, int stride)
{
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
        ints row = iy - job->row;
        *(ints_loose *)(b->patch + k) = (qy * (FONT_PATCH_PHASES + 1) + qx) * FONT_PATCH_FLOATS;
        *(ints_loose *)(b->row + k) = row;
        *(ints_loose *)(b->sums + k) = (row + FONT_MARGIN_ROWS) * stride + ix;
        vector both = tx * ty;
        *(vector_loose *)(b->both + k) = both;
        *(vector_loose *)(b->below + k) = ty - both;
        *(vector_loose *)(b->right + k) = tx * weight - both;
        *(vector_loose *)(b->here + k) = weight - tx * weight - ty + both;
    }
    IN_MEMORY();
}

INLINE void patches_add(const struct font_gray_job *job, int stride, bool banded)
{
    enum { BELOW = (FONT_PATCH_PHASES + 1) * FONT_PATCH_FLOATS };
    struct patch_batch b;
    for (int first = 0; first < job->nodes_count; first += BATCH) {
        int count = job->nodes_count - first < BATCH ? job->nodes_count - first : BATCH;
        patch_batch_fill(&b, job, first, count, stride);
        for (int k = 0; k < count;) {
            vector above[PARTS], under[PARTS]; /* two sums: they do not wait for each other */
            int at = b.sums[k];
            if (banded && !row_in_band(job, b.row[k])) {
                k++;
                continue;
            }
            for (int p = 0; p < PARTS; p++)
                above[p] = under[p] = (vector){0};
            do {
                const float *patch = job->filter->patches + b.patch[k];
                for (int p = 0; p < PARTS; p++, patch += LANES) {
                    above[p] += load(patch) * b.here[k];
                    under[p] += load(patch + BELOW) * b.below[k];
                    above[p] += load(patch + FONT_PATCH_FLOATS) * b.right[k];
                    under[p] += load(patch + BELOW + FONT_PATCH_FLOATS) * b.both[k];
                }
            } while (++k < count && b.sums[k] == at);
            float sums[ROW] __attribute__((aligned(64)));
            for (int p = 0; p < PARTS; p++)
                *(vector *)(sums + p * LANES) = above[p] + under[p];
            for (int r = 0; r <= FONT_PATCH_TAPS; r++)
                *(four_columns *)(job->sums + at + r * stride) +=
                    *(four_columns *)(sums + r * FONT_PATCH_ROW);
        }
    }
}
