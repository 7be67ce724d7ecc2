/* separate.c - finds the pigments of a colour: damped Gauss-Newton steps within 0..most for
 * each pigment, from two starts. */
#include "separate.h"

#include "bands.h"
#include "base/base.h"

#include <patience.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { GRID = 33, STEPS_MAX = 40, PIXELS_ASK = 256, N = PAPER_PIGMENTS_MAX };

void paper_separation_choose(struct paper_separation *s,
                             const struct paper_sheet_config *config, const int *number,
                             int count)
{
    s->pigments_count = count;
    s->banded = paper_config_banded(config);
    for (int i = 0; i < count; i++) {
        s->pigments[i] = config->pigments[number[i]];
        paper_pigment_bands(&s->pigments[i], s->absorption[i], s->scattering[i]);
    }
}

struct paper_separation paper_separation_of(const struct paper_sheet_config *config)
{
    struct paper_separation s = {.rule = config->rule, .most = 2, .thrift = 0.3};
    int number[PAPER_PIGMENTS_MAX];
    for (int i = 0; i < PAPER_PIGMENTS_MAX; i++)
        number[i] = i;
    paper_separation_choose(&s, config, number, config->pigments_count);
    for (int i = 0; i < 3; i++)
        s.below[i] = config->rule == PAPER_RULE_KUBELKA_MUNK
                         ? paper_light_linear(config->stock.color[i])
                         : config->stock.color[i];
    return s;
}

/* What is seen of the amounts by bands. */
static void banded_color(const struct paper_separation *s, const double *amount, double rgb[3])
{
    double k[PAPER_BANDS] = {0}, scattering[PAPER_BANDS] = {0};
    memset(rgb, 0, 3 * sizeof *rgb);
    for (int i = 0; i < s->pigments_count; i++)
        for (int band = 0; band < PAPER_BANDS; band++) {
            k[band] += amount[i] * s->absorption[i][band];
            scattering[band] += amount[i] * s->scattering[i][band];
        }
    for (int band = 0; band < PAPER_BANDS; band++) {
        double below = 0;
        for (int c = 0; c < 3; c++)
            below += paper_band_of_light[band][c] * s->below[c];
        const double seen = paper_uneven_seen(k[band], scattering[band], below);
        for (int c = 0; c < 3; c++)
            rgb[c] += paper_light_of_band[c][band] * seen;
    }
}

static double channel_color(const struct paper_separation *s, const double *amount, int c)
{
    double k = 0, scattering = 0, taken = 0, shone = 0;
    for (int i = 0; i < s->pigments_count; i++) {
        k += amount[i] * s->pigments[i].k[c];
        scattering += amount[i] * s->pigments[i].s[c];
        taken += amount[i] * s->pigments[i].takes[c];
        shone += amount[i] * (1 - s->pigments[i].takes[c]);
    }
    return s->rule == PAPER_RULE_KUBELKA_MUNK ? paper_layer_seen(k, scattering, s->below[c])
           : s->rule == PAPER_RULE_SUBTRACT   ? s->below[c] - taken
                                              : s->below[c] + shone;
}

void paper_mixture_color(const struct paper_separation *s, const double *amount, double rgb[3])
{
    const bool linear = s->rule == PAPER_RULE_KUBELKA_MUNK;
    if (linear && s->banded)
        banded_color(s, amount, rgb);
    else
        for (int c = 0; c < 3; c++)
            rgb[c] = channel_color(s, amount, c);
    for (int c = 0; c < 3; c++) {
        rgb[c] = fmin(1, fmax(0, rgb[c]));
        rgb[c] = linear ? rgb[c] : paper_light_linear(rgb[c]);
    }
}

void paper_lab(const double rgb[3], double lab[3])
{
    static const double xyz[3][3] = {/* sRGB's primaries, each row divided by its white */
                                     {0.433953, 0.376219, 0.189828},
                                     {0.212671, 0.715160, 0.072169},
                                     {0.017758, 0.109477, 0.872765}};
    double f[3];
    for (int i = 0; i < 3; i++) {
        double t = xyz[i][0] * rgb[0] + xyz[i][1] * rgb[1] + xyz[i][2] * rgb[2];
        f[i] = t > 216.0 / 24389 ? cbrt(t) : (24389.0 / 27 * t + 16) / 116;
    }
    lab[0] = 116 * f[1] - 16;
    lab[1] = 500 * (f[0] - f[1]);
    lab[2] = 200 * (f[1] - f[2]);
}

/* ---- one colour ---- */

static double cost(const struct paper_separation *s, const double target[3], const double *a,
                   double residual[3])
{
    double rgb[3], lab[3], sum = 0;
    paper_mixture_color(s, a, rgb);
    paper_lab(rgb, lab);
    for (int i = 0; i < 3; i++) {
        residual[i] = lab[i] - target[i];
        sum += residual[i] * residual[i];
    }
    for (int i = 0; i < s->pigments_count; i++)
        sum += s->thrift * a[i] * a[i];
    return sum;
}

/* Solves m x = v of n rows by Cholesky's factors; m is positive definite. */
static void solve(int n, double m[N][N], double *v)
{
    for (int j = 0; j < n; j++) {
        for (int k = 0; k < j; k++)
            m[j][j] -= m[j][k] * m[j][k];
        m[j][j] = sqrt(fmax(m[j][j], 1e-12));
        for (int i = j + 1; i < n; i++) {
            for (int k = 0; k < j; k++)
                m[i][j] -= m[i][k] * m[j][k];
            m[i][j] /= m[j][j];
        }
    }
    for (int i = 0; i < n; i++) {
        for (int k = 0; k < i; k++)
            v[i] -= m[i][k] * v[k];
        v[i] /= m[i][i];
    }
    for (int i = n - 1; i >= 0; i--) {
        for (int k = i + 1; k < n; k++)
            v[i] -= m[k][i] * v[k];
        v[i] /= m[i][i];
    }
}

/* Improves the amounts a; returns their cost. */
static double descend(const struct paper_separation *s, const double target[3], double *a)
{
    double residual[3], damping = 1, now = cost(s, target, a, residual);
    int n = s->pigments_count;
    for (int step = 0; step < STEPS_MAX; step++) {
        double slopes[N][3], gradient[N];
        for (int i = 0; i < n; i++) {
            double moved[N], other[3], h = a[i] < s->most / 2 ? 1e-5 : -1e-5;
            memcpy(moved, a, sizeof(double) * (size_t)n);
            moved[i] += h;
            cost(s, target, moved, other);
            gradient[i] = s->thrift * a[i];
            for (int c = 0; c < 3; c++) {
                slopes[i][c] = (other[c] - residual[c]) / h;
                gradient[i] += slopes[i][c] * residual[c];
            }
        }
        int open[N], count = 0; /* variables not held at an end of their range */
        for (int i = 0; i < n; i++)
            if (!(a[i] <= 0 && gradient[i] > 0) && !(a[i] >= s->most && gradient[i] < 0))
                open[count++] = i;
        double m[N][N], v[N];
        for (int i = 0; i < count; i++) {
            v[i] = -gradient[open[i]];
            for (int j = 0; j < count; j++) {
                m[i][j] = i == j ? s->thrift + damping : 0;
                for (int c = 0; c < 3; c++)
                    m[i][j] += slopes[open[i]][c] * slopes[open[j]][c];
            }
        }
        solve(count, m, v);
        double next[N], far = 0, there[3];
        memcpy(next, a, sizeof next);
        for (int i = 0; i < count; i++) {
            next[open[i]] = fmin(s->most, fmax(0, a[open[i]] + v[i]));
            far = fmax(far, fabs(next[open[i]] - a[open[i]]));
        }
        double then = cost(s, target, next, there);
        if (then < now) {
            memcpy(a, next, sizeof(double) * (size_t)n);
            memcpy(residual, there, sizeof there);
            bool done = now - then < 1e-7 * now && far < 1e-4;
            now = then;
            damping = fmax(damping / 5, 1e-6);
            if (done)
                break;
        } else {
            damping *= 6;
            if (damping > 1e9 || far < 1e-6)
                break;
        }
    }
    return now;
}

/* ---- the table ---- */

struct table {
    const struct paper_separation *s;
    float *amount; /* [point][pigment] */
    uint8_t *known;
};

static const float *point_at(struct table *t, const int at[3])
{
    const struct paper_separation *s = t->s;
    size_t n = (size_t)s->pigments_count;
    size_t index = ((size_t)at[0] * GRID + (size_t)at[1]) * GRID + (size_t)at[2];
    float *out = t->amount + index * n;
    if (t->known[index])
        return out;
    double rgb[3], target[3], best[N], lowest = INFINITY;
    for (int c = 0; c < 3; c++)
        rgb[c] = paper_light_linear((double)at[c] / (GRID - 1));
    paper_lab(rgb, target);
    for (int start = 0; start < 2; start++) { /* thin and thick */
        double a[N] = {0};
        for (size_t i = 0; i < n; i++)
            a[i] = fmin(s->most, start ? 0.6 : 0.05);
        double reached = descend(s, target, a);
        if (reached < lowest) {
            lowest = reached;
            memcpy(best, a, sizeof best);
        }
    }
    for (size_t i = 0; i < n; i++)
        out[i] = (float)best[i];
    t->known[index] = 1;
    return out;
}

static void pixel_separate(struct table *t, const uint8_t *rgb, size_t pixel,
                           float *const *amount)
{
    int low[3];
    float part[3];
    for (int c = 0; c < 3; c++) {
        float at = (float)rgb[c] * (GRID - 1) / 255;
        low[c] = (int)fminf(at, GRID - 2);
        part[c] = at - (float)low[c];
    }
    for (int i = 0; i < t->s->pigments_count; i++)
        amount[i][pixel] = 0;
    for (int corner = 0; corner < 8; corner++) {
        float weight = 1;
        int at[3];
        for (int c = 0; c < 3; c++) {
            int up = corner >> c & 1;
            at[c] = low[c] + up;
            weight *= up ? part[c] : 1 - part[c];
        }
        if (weight == 0)
            continue;
        const float *point = point_at(t, at);
        for (int i = 0; i < t->s->pigments_count; i++)
            amount[i][pixel] += weight * point[i];
    }
}

enum paper_status paper_separate(const struct paper_separation *s, const uint8_t *rgb,
                                 size_t pixels, float *const *amount)
{
    if (s->pigments_count < 1 || s->pigments_count > PAPER_PIGMENTS_MAX)
        return paper_fail(PAPER_BAD_ARGUMENT, "a separation takes 1..%d pigments (got %d)",
                          PAPER_PIGMENTS_MAX, s->pigments_count);
    if (!(s->most >= 0.01 && s->most <= 4))
        return paper_fail(PAPER_BAD_ARGUMENT, "a separation's most must be 0.01..4 (got %g)",
                          s->most);
    if (!(s->thrift >= 0 && s->thrift <= 10))
        return paper_fail(PAPER_BAD_ARGUMENT, "a separation's thrift must be 0..10 (got %g)",
                          s->thrift);
    size_t points = (size_t)GRID * GRID * GRID;
    struct table t = {.s = s,
                      .amount = malloc(points * (size_t)s->pigments_count * sizeof(float)),
                      .known = calloc(points, 1)};
    enum paper_status status = PAPER_OK;
    if (t.amount && t.known)
        for (size_t i = 0; i < pixels && status == PAPER_OK; i++) {
            pixel_separate(&t, rgb + 3 * i, i, amount);
            if (i % PIXELS_ASK == 0 && patience_over())
                status = paper_fail(PAPER_MACHINE_FAILED, "stopped");
        }
    else
        status = paper_fail(PAPER_NO_MEMORY, "no memory to separate colours");
    free(t.amount);
    free(t.known);
    return status;
}
