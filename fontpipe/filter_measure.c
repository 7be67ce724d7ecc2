/* filter_measure.c - what a filter does, and how finely edges must be taken apart for it.
 *
 * An edge of ink is integrated at Gauss's nodes where the filter is smooth. How long a piece of
 * edge m nodes are enough for is found by trying: pieces of several lengths and slants, against
 * very fine steps that are exact along x. Filters with corners in their profile (the box) need
 * steps everywhere, as fine as the same trial says. */
#include "filter_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { REFERENCE_PER_PX = 48, GRID_PER_PX = 4, GRID_MAX = 80, REFERENCE_MAX = 288 };

/* The trial edge runs from the origin. Sums of what it adds to a pixel at (x, y) of a grid, per
 * unit of dx. */
struct trial {
    double x[GRID_MAX], y[GRID_MAX];
    int x_count, y_count;
    double dx, dy;
    double exact[GRID_MAX][GRID_MAX], sum[GRID_MAX][GRID_MAX];
};

static int grid_fill(double *grid, double length, double radius)
{
    int count = 0;
    for (double at = -radius; at <= length + radius && count < GRID_MAX;
         at += 1.0 / GRID_PER_PX)
        grid[count++] = at + 0.03; /* beside the profile's own corners */
    return count;
}

/* The entries of a grid that the filter reaches from `at`, with `half` of a step: outside
 * nothing of it lies. */
static void grid_reached(const double *grid, int count, double reach, double at, int *from,
                         int *to)
{
    double begin = count ? grid[0] : 0;
    *from = (int)fmin(fmax(floor((at - reach - begin) * GRID_PER_PX), 0), count);
    *to = (int)fmin(fmax(ceil((at + reach - begin) * GRID_PER_PX) + 1, *from), count);
}

/* Adds column(x_i) * H(Y - y_i); column holds the entries from..to - 1, and is nought
 * elsewhere. */
static void trial_add(const struct trial *t, const struct font_filter *f, int term, double y,
                      const double *column, int from, int to, double (*sum)[GRID_MAX])
{
    const struct font_filter_term *terms = &f->terms[term];
    int low, high;
    grid_reached(t->y, t->y_count, f->radius, y, &low, &high);
    for (int j = low; j < t->y_count; j++) {
        double row = terms->weight * (j < high ? font_term_integral(f, term, t->y[j] - y)
                                               : terms->integral[f->knots]);
        if (row != 0)
            for (int i = from; i < to; i++)
                sum[j][i] += row * column[i];
    }
}

/* Steps add the difference of integrals from one end of the step to the other. A step begins
 * where the one before ended. */
static void trial_steps(struct trial *t, const struct font_filter *f, int count,
                        double (*sum)[GRID_MAX])
{
    double column[GRID_MAX], before[GRID_MAX];
    memset(sum, 0, sizeof t->exact);
    for (int term = 0; term < f->terms_count; term++) {
        for (int i = 0; i < t->x_count; i++)
            before[i] = font_term_integral(f, term, t->x[i]);
        for (int k = 0; k < count; k++) {
            double end = t->dx * (k + 1) / count;
            int from, to;
            grid_reached(t->x, t->x_count, f->radius + t->dx / count, end, &from, &to);
            for (int i = from; i < to; i++) {
                double now = font_term_integral(f, term, t->x[i] - end);
                column[i] = before[i] - now;
                before[i] = now;
            }
            trial_add(t, f, term, t->dy * (k + 0.5) / count, column, from, to, sum);
        }
    }
}

/* Nodes add weight times the density there. */
static void trial_node(const struct trial *t, const struct font_filter *f, int term, double at,
                       double weight, double (*sum)[GRID_MAX])
{
    double column[GRID_MAX], x = t->dx * at;
    int from, to;
    grid_reached(t->x, t->x_count, f->radius, x, &from, &to);
    for (int i = from; i < to; i++)
        column[i] = t->dx * weight * font_term_density(f, term, t->x[i] - x);
    trial_add(t, f, term, t->dy * at, column, from, to, sum);
}

static void trial_nodes(struct trial *t, const struct font_filter *f, int count,
                        double (*sum)[GRID_MAX])
{
    memset(sum, 0, sizeof t->exact);
    for (int term = 0; term < f->terms_count; term++)
        for (int k = 0; k < count; k++)
            trial_node(t, f, term, font_gauss_at[count][k], font_gauss_weight[count][k], sum);
}

static void trial_even(struct trial *t, const struct font_filter *f, int count,
                       double (*sum)[GRID_MAX])
{
    memset(sum, 0, sizeof t->exact);
    for (int term = 0; term < f->terms_count; term++)
        for (int k = 0; k < count; k++) {
            int end = k < count - 1 - k ? k : count - 1 - k;
            double weight = end < 3 ? (double)font_even_weight[end] : 1;
            trial_node(t, f, term, (k + 0.5) / count, weight / count, sum);
        }
}

static double trial_error(const struct trial *t)
{
    double worst = 0;
    for (int j = 0; j < t->y_count; j++)
        for (int i = 0; i < t->x_count; i++)
            worst = fmax(worst, fabs(t->sum[j][i] - t->exact[j][i]));
    return worst;
}

static void trial_begin(struct trial *t, const struct font_filter *f, double length,
                        double slant)
{
    t->dx = length / hypot(1, slant);
    t->dy = t->dx * slant;
    t->x_count = grid_fill(t->x, t->dx, f->radius);
    t->y_count = grid_fill(t->y, t->dy, f->radius);
    int steps = (int)ceil(length * REFERENCE_PER_PX);
    trial_steps(t, f,
                steps < 16              ? 16
                : steps > REFERENCE_MAX ? REFERENCE_MAX
                                        : steps,
                t->exact);
}

static void nodes_measure(struct font_filter *f, struct trial *t)
{
    for (int l = 0; l < FONT_LENGTHS; l++)
        for (int s = 0; s < FONT_SLANTS; s++) {
            trial_begin(t, f, 0.25 * pow(2, 0.25 * l), font_slants[s]);
            float *error = f->node_error[s][l]; /* of m nodes: error[m - 1] */
            for (int m = 1; m <= FONT_NODES_MAX; m++) {
                trial_nodes(t, f, m, t->sum);
                error[m - 1] = (float)(trial_error(t) / t->dx);
                if (m > 1 && error[m - 1] * t->dx < (double)f->piece_tolerance / 8) {
                    while (++m <= FONT_NODES_MAX) /* more are as good */
                        error[m - 1] = error[m - 2];
                }
            }
            if (f->way != FONT_BY_PATCHES && l == 4 && s == 0 &&
                error[3] * t->dx > (double)f->piece_tolerance)
                return; /* half a pixel needs more than four: steps, 16 a pixel, are as few */
        }
    f->use_nodes = true;
}

/* The longest pieces that can be taken apart. */
static void pieces_measure(struct font_filter *f)
{
    for (int s = 0; s < FONT_SLANTS; s++) {
        double dx_per_px = 1 / hypot(1, s ? font_slants[s - 1] : 0), length = 0.25;
        for (int l = 0; l < FONT_LENGTHS; l++) {
            double longer = 0.25 * pow(2, 0.25 * l);
            double error = (double)f->node_error[s][l][FONT_NODES_MAX - 1] * longer * dx_per_px;
            if (error > (double)f->piece_tolerance)
                break;
            length = longer;
        }
        f->pieces_per_px[s] = (float)(1 / length);
    }
}

/* How far apart nodes on a long edge may be. */
static void spacing_measure(struct font_filter *f, struct trial *t)
{
    const double length = 6;
    for (int s = 0; s < FONT_SLANTS; s++) {
        int count = FONT_EVEN_LEAST;
        trial_begin(t, f, length, font_slants[s]);
        for (; count < 80; count++) {
            trial_even(t, f, count, t->sum);
            if (trial_error(t) <= 0.7 * (double)f->piece_tolerance)
                break;
        }
        f->even_per_px[s] = (float)(count / length);
    }
}

static void steps_measure(struct font_filter *f, struct trial *t)
{
    for (f->step_px = 0.5; f->step_px > 1.0 / 20; f->step_px /= 2) {
        double worst = 0;
        for (int s = 0; s < FONT_SLANTS; s++) {
            trial_begin(t, f, 3, font_slants[s]);
            trial_steps(t, f, (int)ceil(fmax(t->dx, t->dy) / f->step_px), t->sum);
            worst = fmax(worst, trial_error(t));
        }
        /* Round filters leave something out already. */
        if (worst <= (f->round ? 1 : 3) * FONT_STEP_TOLERANCE)
            return;
    }
}

/* Of a wave of so many cycles a pixel along an axis. */
static double response(const struct font_filter *f, double cycles)
{
    enum { N = 512 };
    double sum = 0, d = 2 * f->radius / N;
    for (int t = 0; t < f->terms_count; t++)
        for (int i = 0; i < N; i++) {
            double v = -f->radius + (i + 0.5) * d;
            sum += f->terms[t].weight * f->terms[t].integral[f->knots] *
                   font_term_density(f, t, v) * cos(2 * M_PI * cycles * v) * d;
        }
    return sum;
}

static double line_density(const struct font_filter *f, double v)
{
    double sum = 0;
    for (int t = 0; t < f->terms_count; t++)
        sum += f->terms[t].weight * f->terms[t].integral[f->knots] * font_term_density(f, t, v);
    return sum;
}

void font_filter_measure(struct font_filter *f)
{
    enum { N = 1024 };
    struct font_filter_info *info = &f->info;
    info->radius_px = f->radius;
    info->terms = f->terms_count;
    info->taps = f->taps;
    info->peak = font_filter_at(f, 0, 0);
    double centre = line_density(f, 0), half = 0;
    for (int i = 0; i < N; i++)
        half += line_density(f, -f->radius + (i + 0.5) * 2 * f->radius / N) > 0.5 * centre;
    info->half_width_px = half * 2 * f->radius / N;
    for (int p = 0; p < 64; p++) {
        double sum = 0;
        for (int k = 0; k < f->taps; k++)
            sum += line_density(f, k + 1 - (p + 0.5) / 64 - f->radius);
        info->ripple = fmax(info->ripple, fabs(sum - 1));
    }
    for (int i = 0; i <= N; i++) {
        double edge = font_filter_edge(f, -f->radius + i * 2 * f->radius / N);
        info->undershoot = fmax(info->undershoot, fmax(-edge, edge - 1));
    }
    info->response_nyquist = response(f, 0.5);
    info->response_pixel = response(f, 1);

    struct trial *t = calloc(1, sizeof *t);
    f->step_px = 1.0 / 16;
    if (t) { /* without memory for the trial: the finest steps */
        nodes_measure(f, t);
        pieces_measure(f);
        if (f->use_nodes)
            spacing_measure(f, t);
        f->use_nodes &= f->way != FONT_BY_PATCHES; /* tables alone take steps */
        if (!f->use_nodes)
            steps_measure(f, t);
    }
    free(t);
    static const char *const drawn[] = {"at nodes", "as areas in the grid", "as areas in discs",
                                        "at nodes, by patches"};
    info->drawn = drawn[f->way];
    info->step_px = f->use_nodes || f->way != FONT_BY_TABLES ? 0 : f->step_px;
}
