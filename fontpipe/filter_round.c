/* filter_round.c - a round filter as a sum of products.
 *
 * f(u, v) on a grid of cells is a symmetric matrix; its eigenvectors a_k with eigenvalues l_k
 * give f = sum of l_k a_k(u) a_k(v), and the largest few are enough: the sum's error at an edge
 * of ink is measured for edges along the axes, slanted ones and corners, and terms are added
 * until it is below a tenth of a 255th, where eight are enough for that. f is even in u and v:
 * a quarter of the cells is all there is. The eigenvectors are found together, by multiplying a
 * set of vectors with the matrix and making them perpendicular again. */
#include "filter_internal.h"
#include "internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CELLS = 96, VECTORS = 16, ITERATIONS = 60, FINER = 16 };

struct round_work {
    double a[CELLS][CELLS];
    double v[VECTORS][CELLS], next[VECTORS][CELLS];
    double value[VECTORS];
    double rest[CELLS][CELLS];
};

/* Cells' mean values, of a quarter of f; returns the integral over all of it in cells. */
static double cells_fill(const struct font_filter *f, struct round_work *w)
{
    double sum = 0;
    for (int i = 0; i < CELLS; i++)
        for (int j = 0; j <= i; j++) {
            double mean = 0;
            for (int a = 0; a < FINER; a++)
                for (int b = 0; b < FINER; b++)
                    mean += font_filter_profile(
                        f, f->radius / CELLS *
                               hypot(i + (a + 0.5) / FINER, j + (b + 0.5) / FINER));
            mean /= FINER * FINER;
            w->a[i][j] = w->a[j][i] = mean;
            sum += i == j ? mean : 2 * mean;
        }
    return 4 * sum;
}

static void perpendicular(double (*v)[CELLS])
{
    for (int k = 0; k < VECTORS; k++) {
        for (int twice = 0; twice < 2; twice++)
            for (int l = 0; l < k; l++) {
                double dot = 0;
                for (int i = 0; i < CELLS; i++)
                    dot += v[k][i] * v[l][i];
                for (int i = 0; i < CELLS; i++)
                    v[k][i] -= dot * v[l][i];
            }
        double square = 0;
        for (int i = 0; i < CELLS; i++)
            square += v[k][i] * v[k][i];
        double scale = square > 1e-300 ? 1 / sqrt(square) : 0;
        for (int i = 0; i < CELLS; i++)
            v[k][i] *= scale;
    }
}

static void vectors_find(struct round_work *w)
{
    for (int k = 0; k < VECTORS; k++)
        for (int i = 0; i < CELLS; i++)
            w->v[k][i] = cos(M_PI * k * (i + 0.5) / CELLS);
    perpendicular(w->v);
    for (int n = 0; n < ITERATIONS; n++) {
        for (int k = 0; k < VECTORS; k++)
            for (int i = 0; i < CELLS; i++) {
                double sum = 0;
                for (int j = 0; j < CELLS; j++)
                    sum += w->a[i][j] * w->v[k][j];
                w->next[k][i] = sum;
            }
        for (int k = 0; k < VECTORS; k++) {
            w->value[k] = 0;
            for (int i = 0; i < CELLS; i++)
                w->value[k] += w->v[k][i] * w->next[k][i];
        }
        memcpy(w->v, w->next, sizeof w->v);
        perpendicular(w->v);
    }
}

/* What `rest` leaves at an edge of ink: the largest sum over a half plane or a quarter, in
 * cells. The quarter of cells stands for all four by symmetry. */
static double rest_measure(const struct round_work *w)
{
    enum { SIDE = 2 * CELLS };
    double worst = 0;
    static const int slants[][2] = {{1, 0}, {1, 1}, {2, 1}, {3, 1}, {3, 2}};
    for (size_t s = 0; s < sizeof slants / sizeof *slants; s++) {
        double sums[5 * SIDE] = {0}, sum = 0;
        for (int i = 0; i < SIDE; i++)
            for (int j = 0; j < SIDE; j++)
                sums[slants[s][0] * i + slants[s][1] * j] +=
                    w->rest[i < CELLS ? CELLS - 1 - i : i - CELLS]
                           [j < CELLS ? CELLS - 1 - j : j - CELLS];
        for (int i = 0; i < 5 * SIDE; i++) {
            sum += sums[i];
            worst = fmax(worst, fabs(sum));
        }
    }
    double above[SIDE] = {0};
    for (int i = 0; i < SIDE; i++) {
        double along = 0;
        for (int j = 0; j < SIDE; j++) {
            along += w->rest[i < CELLS ? CELLS - 1 - i : i - CELLS]
                            [j < CELLS ? CELLS - 1 - j : j - CELLS];
            above[j] += along;
            worst = fmax(worst, fabs(above[j]));
        }
    }
    return worst;
}

/* Adds the k-th vector as a term: its integral and density at the cells' borders. */
static bool term_add(struct font_filter *f, const struct round_work *w, int k)
{
    struct font_filter_term *t = &f->terms[f->terms_count++];
    double value = w->value[k], cell = f->radius / CELLS, root = sqrt(fabs(value)) / cell;
    t->weight = value < 0 ? -1 : 1;
    t->integral = calloc((size_t)f->knots + 1, sizeof(double));
    t->density = calloc((size_t)f->knots + 1, sizeof(double));
    if (!t->integral || !t->density)
        return false;
    for (int i = 0; i < 2 * CELLS; i++) {
        double here = root * w->v[k][i < CELLS ? CELLS - 1 - i : i - CELLS];
        t->integral[i + 1] = t->integral[i] + cell * here;
        t->density[i] += i ? 0.5 * here : here;
        t->density[i + 1] += i + 1 < 2 * CELLS ? 0.5 * here : here;
    }
    return true;
}

enum font_status font_filter_decompose(struct font_filter *f)
{
    struct round_work *w = calloc(1, sizeof *w);
    if (!w)
        return font_fail(FONT_NO_MEMORY, "no memory for a filter");
    f->knots = 2 * CELLS;
    double cell = f->radius / CELLS, whole = cells_fill(f, w);
    enum font_status status = FONT_OK;
    f->info.raw_integral = whole * cell * cell;
    if (!(whole > 1e-6) || !isfinite(whole)) {
        free(w);
        return font_fail(FONT_BAD_ARGUMENT, "filter %s: its integral must be positive",
                         f->name);
    }
    f->scale = 1 / (whole * cell * cell);
    if (f->def.kind->volume != 0)
        f->scale = 1 / (f->def.kind->volume * f->radius * f->radius);
    for (int i = 0; i < CELLS; i++)
        for (int j = 0; j < CELLS; j++)
            w->a[i][j] /= whole;
    vectors_find(w);
    memcpy(w->rest, w->a, sizeof w->rest);
    double residual = 1, sum = 0;
    for (int k = 0; k < FONT_TERMS_MAX && status == FONT_OK && residual > 0.1 / 255; k++) {
        for (int i = 0; i < CELLS; i++)
            for (int j = 0; j < CELLS; j++)
                w->rest[i][j] -= w->value[k] * w->v[k][i] * w->v[k][j];
        if (!term_add(f, w, k))
            status = font_fail(FONT_NO_MEMORY, "no memory for a filter");
        residual = rest_measure(w);
    }
    f->info.residual = residual;
    /* The sum's integral is 1 too, so that what is full stays full. */
    for (int k = 0; k < f->terms_count && status == FONT_OK; k++)
        sum += f->terms[k].weight * f->terms[k].integral[f->knots] *
               f->terms[k].integral[f->knots];
    for (int k = 0; k < f->terms_count && status == FONT_OK; k++)
        for (int i = 0; i <= f->knots; i++) {
            f->terms[k].integral[i] /= sqrt(sum);
            f->terms[k].density[i] /= sqrt(sum);
        }
    free(w);
    return status;
}
