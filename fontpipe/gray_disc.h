/* gray_disc.h - arcs to the shares of discs that ink covers, for the pillbox: part of gray_kernel.h.
 *
 * A pixel is the area of its disc below an arc (and between the arc's ends along x), over the disc's area. With the disc's radius
 * as the unit and its centre as the origin, w(x) = sqrt(1 - x^2), and l(x) the arc,
 *
 *     area = integral of w - min(max(l, -w), w) dx   over x from a to b: the arc's ends, cut off at -1 and 1
 *
 *           .  -  .
 *        /         \          from p to q the arc is inside: l's own integral, a trapezium's and a parabola's
 *      -p-----___   |
 *       \        `q /         before p and behind q it is above or below all of the disc: -w or w, whose integral
 *         '  -  '             W(x) = (x sqrt(1 - x^2) + asin x) / 2 is a polynomial but for a root
 *
 * p and q are where the arc's chord, shifted by as much as the arc is beside it there, meets the circle. All of
 * that is continuous: nothing depends on which side of a rounding error something lies. Vertical edges have no part
 * in it.
 *
 * A block of 4 by 4 pixels is done at once. Sums are differences between rows, and below the block all of 2 (W(b) - W(a))
 * counts. */
enum { BLOCK = 4, BLOCK_ROWS = LANES / BLOCK };

typedef float four_floats __attribute__((vector_size(16)));
typedef float four_loose __attribute__((vector_size(16), aligned(4), may_alias));

/* What is the same for all pixels, in units of the radius. */
struct disc_arc {
    float x, y;           /* where it begins */
    float dx, dy, length; /* its chord's direction, and how long that is; dx > 0 */
    float bend,
        lens; /* the distance of the arc's middle from the chord, downwards; and the area between arc and chord */
    float weight;
};

/* The integral of sqrt (1 - x^2) from 0 to x, for x from -1 to 1, with an error of at most
 * 1.5e-5. Near 1 it is pi/4 less (1 - |x|)^1.5 times a factor that is nearly linear in x; the
 * coefficients interpolate that factor at Chebyshev's nodes. */
/* To 14 bits where that is much faster: no processor draws the plain ones otherwise than another. */
INLINE vector quick_root(vector v)
{
#if LANES == 16
    return v * (vector)_mm512_rsqrt14_ps((__m512)vector_max(v, v * 0 + 1e-30f));
#else
    return vector_root(v);
#endif
}

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

/* Of a block's columns, each as often as there are rows in a vector. */
struct disc_columns {
    vector x0, from, to, at_from, at_to;
};

INLINE void disc_columns_make(struct disc_columns *out, const struct disc_arc *a, vector left)
{
    vector one = left * 0 + 1;
    out->x0 = a->x - left;
    out->from = vector_between(out->x0, -one, one);
    out->to = vector_between(out->x0 + a->dx * a->length, -one, one);
#if LANES > 4
    /* Both ends' integrals at once: columns repeat after BLOCK lanes. */
    ints upper;
    for (int k = 0; k < LANES; k++)
        upper[k] = k & BLOCK ? -1 : 0;
    vector both = disc_integral((vector)(((ints)out->from & ~upper) | ((ints)out->to & upper)));
    out->at_from = vector_first_four(both);
    out->at_to = vector_second_four(both);
#else
    out->at_from = disc_integral(out->from);
    out->at_to = disc_integral(out->to);
#endif
}

/* How far beside the chord the arc is at t. */
INLINE vector disc_beside(const struct disc_arc *a, vector t)
{
    return (t - t * t) * (4 * a->bend);
}

/* The areas of LANES pixels, whose centres are at `top`. */
INLINE vector disc_area(const struct disc_arc *a, const struct disc_columns *c, vector top)
{
    vector none = top * 0, one = none + 1, length = none + a->length;
    vector x0 = c->x0, y0 = a->y - top;
    /* The chord's point nearest to the centre: its distance along the chord, and from it. There
     * the arc is about as far from the chord. */
    vector foot = -(x0 * a->dx + y0 * a->dy),
           t = vector_between(foot * (1 / a->length), none, one);
    vector line = y0 * a->dx - x0 * a->dy, away = line + disc_beside(a, t);
    vector half = quick_root(vector_max(one - away * away, none));
    /* Repeats that with the arc's distance from the chord where the arc meets the circle. */
    vector tp = vector_between((foot - half) * (1 / a->length), none, one);
    vector tq = vector_between((foot + half) * (1 / a->length), none, one);
    vector away_p = line + disc_beside(a, tp), away_q = line + disc_beside(a, tq);
    vector p = vector_between(foot - quick_root(vector_max(one - away_p * away_p, none)), none,
                              length);
    vector q = vector_between(foot + quick_root(vector_max(one - away_q * away_q, none)), none,
                              length);
    tp = p * (1 / a->length);
    tq = q * (1 / a->length);
    vector beside_p = disc_beside(a, tp), beside_q = disc_beside(a, tq);
    vector xp = vector_between(x0 + p * a->dx - beside_p * a->dy, c->from, c->to);
    vector xq = vector_between(x0 + q * a->dx - beside_q * a->dy, c->from, c->to);
    vector yp = y0 + p * a->dy + beside_p * a->dx, yq = y0 + q * a->dy + beside_q * a->dx;
    vector before = disc_integral(xp) - c->at_from, behind = c->at_to - disc_integral(xq);
    /* With the sign of where the arc is: above the disc or below it. */
    before = (vector)((ints)before ^ ((ints)yp & (int)0x80000000));
    behind = (vector)((ints)behind ^ ((ints)yq & (int)0x80000000));
    vector h = tq - tp;
    vector inside = (xq - xp) * (yp + yq) * 0.5f + h * h * h * a->lens;
    return (c->at_to - c->at_from - before - inside - behind) * a->weight;
}

INLINE bool disc_arc_make(struct disc_arc *out, const struct font_arc *a, float ax, float ay,
                          float radius)
{
    float per = 1 / radius, dx = (a->cx + a->bx) * per, dy = (a->cy + a->by) * per;
    float length = __builtin_sqrtf(dx * dx + dy * dy);
    if (!(length > 1e-7f))
        return false;
    bool turned = dx < 0;
    *out = (struct disc_arc){.x = ((turned ? a->x + a->cx + a->bx : a->x) + ax) * per,
                             .y = ((turned ? a->y + a->cy + a->by : a->y) + ay) * per,
                             .dx = (turned ? -dx : dx) / length,
                             .dy = (turned ? -dy : dy) / length,
                             .length = length,
                             .weight = (turned ? -1.0f : 1.0f) * 0.3183098862f};
    out->bend = -0.25f * (a->by * out->dx - a->bx * out->dy) * per;
    out->lens = out->bend * length * (2 / 3.0f);
    return true;
}

/* Adds what a block's rows are more than the rows above them. above: the row before the block, and then its last. */
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

INLINE void disc_add(const struct font_gray_job *job, const struct font_arc *arc)
{
    float radius = (float)job->filter->radius, per = 1 / radius;
    float x = arc->x + job->ax, y = arc->y + job->ay - (float)job->row;
    float x_end = x + arc->cx + arc->bx, y_end = y + arc->cy + arc->by;
    float left = x < x_end ? x : x_end, top = y < y_end ? y : y_end;
    float right = x < x_end ? x_end : x, bottom = y < y_end ? y_end : y;
    int column = (int)left, row = (int)__builtin_floorf(top);
    int columns = (int)__builtin_ceilf(right + 2 * radius - 1) - column;
    int rows = (int)__builtin_ceilf(bottom + 2 * radius - 1) - row;
    struct disc_arc a;
    if (!disc_arc_make(&a, arc, job->ax, job->ay - (float)job->row, radius) ||
        (job->banded && !(row > -FONT_MARGIN_ROWS && row < job->rows)))
        return;
    vector lane_column, lane_row;
    for (int k = 0; k < LANES; k++) {
        lane_column[k] = (float)(k % BLOCK) * per;
        lane_row[k] = (float)(k / BLOCK) * per;
    }
    for (int i = 0; i < columns; i += BLOCK) {
        float *sums = job->sums + (long)(FONT_MARGIN_ROWS + row) * job->stride + column + i;
        vector lefts = lane_column + ((float)(column + i + 1) - radius) * per;
        vector areas[BLOCK / BLOCK_ROWS];
        struct disc_columns columns_here;
        disc_columns_make(&columns_here, &a, lefts);
        four_floats above = {0};
        int j = 0;
        do {
            for (int k = 0; k < BLOCK / BLOCK_ROWS; k++)
                areas[k] = disc_area(
                    &a, &columns_here,
                    lane_row + ((float)(row + j + k * BLOCK_ROWS + 1) - radius) * per);
            block_store(sums, job->stride, areas, &above);
            sums += BLOCK * job->stride;
            j += BLOCK;
        } while (j < rows);
        vector whole = (columns_here.at_to - columns_here.at_from) * (2 * a.weight);
        four_floats below; /* all of their discs */
        __builtin_memcpy(&below, &whole, sizeof below);
        *(four_loose *)sums += below - above;
    }
}

INLINE void discs_add(const struct font_gray_job *job)
{
    rows_clear(job, job->stride);
    for (int i = 0; i < job->arcs_count; i++)
        disc_add(job, &job->arcs[i]);
}
