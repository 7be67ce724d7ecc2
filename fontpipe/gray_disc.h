/* gray_disc.h - arcs to the shares of discs that ink covers, for the pillbox: part of
 * gray_kernel.h.
 *
 * A pixel is the area of its disc below an arc (and between the arc's ends along x), over the
 * disc's area. With the disc's radius as the unit and its centre as the origin, w(x) = sqrt(1 -
 * x^2), and l(x) the arc,
 *
 *     area = integral of w - min(max(l, -w), w) dx   over x from a to b: the arc's ends, cut
 *                                                    off at -1 and 1
 *
 *           .  -  .
 *        /         \          from p to q the arc is inside: l's own integral, a trapezium's and a parabola's
 *      -p-----___   |
 *       \        `q /         before p and behind q it is above or below all of the disc: -w or w, whose integral
 *         '  -  '             W(x) = (x sqrt(1 - x^2) + asin x) / 2 is a polynomial but for a root
 *
 * p and q are where the arc's chord, shifted by as much as the arc is beside it there, meets
 * the circle. All of that is continuous: nothing depends on which side of a rounding error
 * something lies. Vertical edges have no part in it.
 *
 * A block of 4 by 4 pixels is done at once, of most arcs the only one. Sums are differences
 * between rows, and below the block all of 2 (W(b) - W(a)) counts. Each step of an area waits
 * for the one before, so two vectors are gone through together: two arcs' blocks, or two parts
 * of one. */
enum {
    BLOCK = 4,
    BLOCK_ROWS = LANES / BLOCK,
    BLOCK_PARTS = BLOCK / BLOCK_ROWS,
    TOGETHER = 2,
    DISC_BATCH = 32
};

typedef float four_floats __attribute__((vector_size(16)));
typedef float four_loose __attribute__((vector_size(16), aligned(4), may_alias));

/* Arcs in units of the radius, each turned to the right; what is the same for all pixels. */
struct discs {
    float x[DISC_BATCH], y[DISC_BATCH];               /* where it begins */
    float dx[DISC_BATCH], dy[DISC_BATCH];             /* its chord's direction */
    float length[DISC_BATCH], per_length[DISC_BATCH]; /* of the chord */
    /* four times the distance of the arc's middle from the chord, downwards */
    float bend[DISC_BATCH];
    float lens[DISC_BATCH];   /* the area between arc and chord */
    float weight[DISC_BATCH]; /* 1 / pi, and which way it was turned */
    int column[DISC_BATCH], row[DISC_BATCH], columns[DISC_BATCH], rows[DISC_BATCH];
};

INLINE vector vector_of(ints mask, vector yes, vector no)
{
    return (vector)(((ints)yes & mask) | ((ints)no & ~mask));
}

INLINE ints vector_floor(vector v)
{
    ints whole = __builtin_convertvector(v, ints);
    return whole + (__builtin_convertvector(whole, vector) > v);
}

INLINE void discs_put(float *to, vector v)
{
    *(vector_loose *)to = v;
}

INLINE void discs_make(struct discs *d, const struct font_gray_job *job, int first, int count)
{
    const float radius = (float)job->filter->radius, per = 1 / radius;
    for (int k = 0; k < count; k += LANES) {
        float fields[6][LANES] __attribute__((aligned(64)));
        for (int l = 0; l < LANES; l++) { /* the last again where there are no more */
            const struct font_arc *a = &job->arcs[first + (k + l < count ? k + l : count - 1)];
            fields[0][l] = a->x, fields[1][l] = a->y;
            fields[2][l] = a->cx, fields[3][l] = a->cy;
            fields[4][l] = a->bx, fields[5][l] = a->by;
        }
        vector in[6];
        for (int i = 0; i < 6; i++)
            in[i] = load(fields[i]);
        vector x = in[0] + job->ax, y = in[1] + (job->ay - (float)job->row), none = x * 0;
        vector across = in[2] + in[4], down = in[3] + in[5];
        ints turned = across < none;
        vector x_end = x + across, y_end = y + down, left = vector_min(x, x_end);
        discs_put(d->x + k, left * per);
        discs_put(d->y + k, vector_of(turned, y_end, y) * per);
        vector length = vector_root(across * across + down * down);
        vector over = (none + 1) / vector_max(length, none + 1e-20f);
        vector dx = vector_max(across, -across) * over;
        vector dy = vector_of(turned, -down, down) * over;
        vector bend = (in[4] * dy - in[5] * dx) * per;
        length *= per;
        discs_put(d->dx + k, dx);
        discs_put(d->dy + k, dy);
        discs_put(d->length + k, length);
        discs_put(d->per_length + k, over * radius);
        discs_put(d->bend + k, bend);
        discs_put(d->lens + k, bend * length * (1 / 6.0f));
        discs_put(d->weight + k, vector_of(turned, none - 0.3183098862f, none + 0.3183098862f));
        /* Where it turns around between its ends, it is at most by / 4 beyond them. */
        vector beyond = vector_max(in[5], -in[5]) * 0.25f;
        beyond = vector_of(in[3] * (in[3] + in[5] * 2) < none, beyond, none);
        vector top = vector_min(y, y_end) - beyond, bottom = vector_max(y, y_end) + beyond;
        vector right = vector_max(x, x_end);
        ints column = __builtin_convertvector(left, ints), row = vector_floor(top);
        *(ints_loose *)(d->column + k) = column;
        *(ints_loose *)(d->row + k) = row;
        *(ints_loose *)(d->columns + k) = -vector_floor(1 - 2 * radius - right) - column;
        *(ints_loose *)(d->rows + k) = -vector_floor(1 - 2 * radius - bottom) - row;
    }
}

/* To 14 bits where that is much faster: no processor draws the plain ones otherwise than
 * another. */
INLINE vector quick_root(vector v)
{
#if LANES == 16
    return v * (vector)_mm512_rsqrt14_ps((__m512)vector_max(v, v * 0 + 1e-30f));
#else
    return vector_root(v);
#endif
}

/* The integral of sqrt (1 - x^2) from 0 to x, for x from -1 to 1, with an error of at most
 * 1.5e-5. Near 1 it is pi/4 less (1 - |x|)^1.5 times a factor that is nearly linear in x; the
 * coefficients interpolate that factor at Chebyshev's nodes. */
INLINE vector disc_integral(vector x)
{
    vector one = x * 0 + 1;
    ints sign = (ints)x & (int)0x80000000;
    vector rest = vector_max(one - (vector)((ints)x & 0x7fffffff), x * 0);
    vector p =
        ((rest * -0.0045389788f - 0.0111291746f) * rest - 0.1417378241f) * rest + 0.9428190304f;
    vector value = one * 0.7853981634f - rest * quick_root(rest) * p;
    return (vector)((ints)value ^ sign);
}

INLINE vector vector_between(vector v, vector low, vector high)
{
    return vector_min(vector_max(v, low), high);
}

/* Of a block's columns, each as often as there are rows in a vector: the ends of the arc's
 * part, and the integrals there. */
struct disc_columns {
    vector x0, from, to, at_from, at_to;
};

/* Of one or two blocks from columns `left` on. */
INLINE void disc_columns_make(struct disc_columns *out, int count, const struct discs *d,
                              const int *arc, const vector *left)
{
    vector one = left[0] * 0 + 1;
    for (int p = 0; p < count; p++) {
        int k = arc[p];
        out[p].x0 = d->x[k] - left[p];
        out[p].from = vector_between(out[p].x0, -one, one);
        out[p].to = vector_between(out[p].x0 + d->dx[k] * d->length[k], -one, one);
    }
#if LANES == 16
    /* All ends' integrals at once: columns repeat after BLOCK lanes. */
    vector ends = (vector)_mm512_mask_mov_ps((__m512)out[0].from, 0x00f0, (__m512)out[0].to);
    ends = (vector)_mm512_mask_mov_ps((__m512)ends, 0x0f00, (__m512)out[count - 1].from);
    ends = (vector)_mm512_mask_mov_ps((__m512)ends, 0xf000, (__m512)out[count - 1].to);
    __m512 at = (__m512)disc_integral(ends);
    out[0].at_from = (vector)_mm512_shuffle_f32x4(at, at, 0x00);
    out[0].at_to = (vector)_mm512_shuffle_f32x4(at, at, 0x55);
    out[count - 1].at_from = (vector)_mm512_shuffle_f32x4(at, at, 0xaa);
    out[count - 1].at_to = (vector)_mm512_shuffle_f32x4(at, at, 0xff);
#elif LANES == 8
    __m256 at = (__m256)disc_integral(
        (vector)_mm256_blend_ps((__m256)out[0].from, (__m256)out[0].to, 0xf0));
    out[0].at_from = (vector)_mm256_permute2f128_ps(at, at, 0x00);
    out[0].at_to = (vector)_mm256_permute2f128_ps(at, at, 0x11);
#else
    out[0].at_from = disc_integral(out[0].from);
    out[0].at_to = disc_integral(out[0].to);
#endif
}

#define EACH for (int p = 0; p < TOGETHER; p++)

/* How far beside the chord an arc is at t. */
INLINE vector disc_beside(vector t, float bend)
{
    return (t - t * t) * bend;
}

/* The areas of the pixels whose centres are at `top`. */
INLINE void disc_areas(vector out[TOGETHER], const struct discs *d, const int arc[TOGETHER],
                       const struct disc_columns c[TOGETHER], const vector top[TOGETHER])
{
    typedef vector vectors[TOGETHER];
    vector none = top[0] * 0, one = none + 1;
    vectors x0, y0, foot, line, half, p0, q0, t0, t1, beside_p, beside_q, xp, xq, yp, yq;
    float dx[TOGETHER], dy[TOGETHER], bend[TOGETHER], length[TOGETHER], per[TOGETHER];
    EACH
    {
        dx[p] = d->dx[arc[p]], dy[p] = d->dy[arc[p]], bend[p] = d->bend[arc[p]];
        length[p] = d->length[arc[p]], per[p] = d->per_length[arc[p]];
        x0[p] = c[p].x0;
        y0[p] = d->y[arc[p]] - top[p];
    }
    /* The chord's point nearest to the centre: its distance along the chord, and from it. There
     * the arc is about as far from the chord. */
    EACH foot[p] = -(x0[p] * dx[p] + y0[p] * dy[p]);
    EACH line[p] = y0[p] * dx[p] - x0[p] * dy[p];
    EACH t0[p] = vector_between(foot[p] * per[p], none, one);
    EACH half[p] = line[p] + disc_beside(t0[p], bend[p]);
    EACH half[p] = quick_root(vector_max(one - half[p] * half[p], none));
    /* Repeats that with the arc's distance from the chord where the arc meets the circle. */
    EACH t0[p] = vector_between((foot[p] - half[p]) * per[p], none, one);
    EACH t1[p] = vector_between((foot[p] + half[p]) * per[p], none, one);
    EACH p0[p] = line[p] + disc_beside(t0[p], bend[p]);
    EACH q0[p] = line[p] + disc_beside(t1[p], bend[p]);
    EACH p0[p] = quick_root(vector_max(one - p0[p] * p0[p], none));
    EACH q0[p] = quick_root(vector_max(one - q0[p] * q0[p], none));
    EACH p0[p] = vector_between(foot[p] - p0[p], none, none + length[p]);
    EACH q0[p] = vector_between(foot[p] + q0[p], none, none + length[p]);
    EACH t0[p] = p0[p] * per[p];
    EACH t1[p] = q0[p] * per[p];
    EACH beside_p[p] = disc_beside(t0[p], bend[p]);
    EACH beside_q[p] = disc_beside(t1[p], bend[p]);
    EACH xp[p] =
        vector_between(x0[p] + p0[p] * dx[p] - beside_p[p] * dy[p], c[p].from, c[p].to);
    EACH xq[p] =
        vector_between(x0[p] + q0[p] * dx[p] - beside_q[p] * dy[p], c[p].from, c[p].to);
    EACH yp[p] = y0[p] + p0[p] * dy[p] + beside_p[p] * dx[p];
    EACH yq[p] = y0[p] + q0[p] * dy[p] + beside_q[p] * dx[p];
    /* What is before and behind the arc's part inside, with the sign of where the arc is: above
     * the disc or below it. */
    EACH p0[p] = disc_integral(xp[p]) - c[p].at_from;
    EACH q0[p] = c[p].at_to - disc_integral(xq[p]);
    EACH p0[p] = (vector)((ints)p0[p] ^ ((ints)yp[p] & (int)0x80000000));
    EACH q0[p] = (vector)((ints)q0[p] ^ ((ints)yq[p] & (int)0x80000000));
    EACH t1[p] -= t0[p];
    EACH half[p] =
        (xq[p] - xp[p]) * (yp[p] + yq[p]) * 0.5f + t1[p] * t1[p] * t1[p] * d->lens[arc[p]];
    EACH out[p] = (c[p].at_to - c[p].at_from - p0[p] - half[p] - q0[p]) * d->weight[arc[p]];
}

/* Adds what a block's rows are more than the rows above them. above: the row before the block,
 * and then its last. */
INLINE void block_store(float *sums, int stride, const vector *rows, four_floats *above)
{
    for (int r = 0; r < BLOCK; r++) {
        four_floats row;
        const vector *from = &rows[r / BLOCK_ROWS];
        __builtin_memcpy(&row, (const float *)from + r % BLOCK_ROWS * BLOCK, sizeof row);
        *(four_loose *)(sums + r * stride) += row - *above;
        *above = row;
    }
}

/* All of a disc's part between the arc's ends, in the row below the block. */
INLINE void block_end(float *sums, const struct disc_columns *c, float weight,
                      const four_floats *above)
{
    vector whole = (c->at_to - c->at_from) * (2 * weight);
    four_floats below;
    __builtin_memcpy(&below, &whole, sizeof below);
    *(four_loose *)sums += below - *above;
}

/* The centres of a block's first pixels, in units of the radius. */
struct disc_lanes {
    vector column, row;
    float per, centre;
};

INLINE struct disc_lanes disc_lanes_make(float radius)
{
    struct disc_lanes l = {.per = 1 / radius, .centre = 1 - radius};
    for (int k = 0; k < LANES; k++) {
        l.column[k] = (float)(k % BLOCK) / radius;
        l.row[k] = (float)(k / BLOCK) / radius;
    }
    return l;
}

INLINE vector disc_centres(const struct disc_lanes *l, vector lanes, int first)
{
    return lanes + ((float)first + l->centre) * l->per;
}

/* An arc of any number of blocks. */
INLINE void disc_add(const struct font_gray_job *job, const struct discs *d, int k,
                     const struct disc_lanes *l)
{
    const int arc[TOGETHER] = {k, k};
    for (int i = 0; i < d->columns[k]; i += BLOCK) {
        float *sums =
            job->sums + (long)(FONT_MARGIN_ROWS + d->row[k]) * job->stride + d->column[k] + i;
        vector left = disc_centres(l, l->column, d->column[k] + i);
        struct disc_columns columns[TOGETHER];
        disc_columns_make(columns, 1, d, arc, &left);
        columns[1] = columns[0];
        four_floats above = {0};
        int j = 0;
        do {
            vector areas[BLOCK_PARTS + 1];
            for (int part = 0; part < BLOCK_PARTS; part += TOGETHER) {
                vector tops[TOGETHER];
                EACH tops[p] = disc_centres(l, l->row, d->row[k] + j + (part + p) * BLOCK_ROWS);
                disc_areas(areas + part, d, arc, columns, tops);
            }
            block_store(sums, job->stride, areas, &above);
            sums += BLOCK * job->stride;
            j += BLOCK;
        } while (j < d->rows[k]);
        block_end(sums, columns, d->weight[k], &above);
    }
}

/* Two arcs of a block each, where a vector is a block. */
INLINE void disc_pair_add(const struct font_gray_job *job, const struct discs *d,
                          const int arc[TOGETHER], const struct disc_lanes *l)
{
    vector lefts[TOGETHER], tops[TOGETHER], areas[TOGETHER];
    struct disc_columns columns[TOGETHER];
    EACH lefts[p] = disc_centres(l, l->column, d->column[arc[p]]);
    EACH tops[p] = disc_centres(l, l->row, d->row[arc[p]]);
    disc_columns_make(columns, TOGETHER, d, arc, lefts);
    disc_areas(areas, d, arc, columns, tops);
    EACH
    {
        float *sums = job->sums + (long)(FONT_MARGIN_ROWS + d->row[arc[p]]) * job->stride +
                      d->column[arc[p]];
        four_floats above = {0};
        block_store(sums, job->stride, &areas[p], &above);
        block_end(sums + BLOCK * job->stride, &columns[p], d->weight[arc[p]], &above);
    }
}

INLINE void discs_add(const struct font_gray_job *job)
{
    struct discs d;
    struct disc_lanes lanes = disc_lanes_make((float)job->filter->radius);
    rows_clear(job, job->stride);
    for (int first = 0; first < job->arcs_count; first += DISC_BATCH) {
        int count = job->arcs_count - first < DISC_BATCH ? job->arcs_count - first : DISC_BATCH;
        int waiting = -1; /* an arc of one block, for another */
        discs_make(&d, job, first, count);
        for (int k = 0; k < count; k++) {
            bool pairs = BLOCK_PARTS == 1 && d.columns[k] <= BLOCK && d.rows[k] <= BLOCK;
            if (!(d.length[k] > 1e-7f) || (job->banded && !row_in_band(job, d.row[k])))
                continue;
            if (pairs && waiting < 0) {
                waiting = k;
            } else if (pairs) {
                disc_pair_add(job, &d, (const int[TOGETHER]){waiting, k}, &lanes);
                waiting = -1;
            } else {
                disc_add(job, &d, k, &lanes);
            }
        }
        if (waiting >= 0)
            disc_add(job, &d, waiting, &lanes);
    }
}
