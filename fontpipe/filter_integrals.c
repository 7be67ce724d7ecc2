/* filter_integrals.c - a filter's numbers without its tables: profile, densities and integrals,
 * in double precision. */
#include "filter_internal.h"

#include <math.h>

double font_filter_profile(const struct font_filter *f, double v)
{
    return fabs(v) > f->radius ? 0 : f->def.kind->profile(f, v);
}

double font_term_density(const struct font_filter *f, int term, double v)
{
    const struct font_filter_term *t = &f->terms[term];
    if (fabs(v) > f->radius)
        return 0;
    if (!f->round)
        return font_filter_profile(f, v) * f->scale;
    double at = (v + f->radius) / (2 * f->radius) * f->knots;
    int i = (int)fmin(fmax(floor(at), 0), f->knots - 1);
    return t->density[i] + (at - i) * (t->density[i + 1] - t->density[i]);
}

double font_term_integral(const struct font_filter *f, int term, double v)
{
    const struct font_filter_term *t = &f->terms[term];
    double at = (v + f->radius) / (2 * f->radius) * f->knots;
    if (at <= 0)
        return 0;
    if (at >= f->knots)
        return t->integral[f->knots];
    int i = (int)at;
    double s = at - i, d = 2 * f->radius / f->knots, a = t->integral[i], b = t->integral[i + 1];
    /* A cubic through the integrals with the densities as slopes. */
    double da = d * t->density[i] - (b - a), db = -d * t->density[i + 1] + (b - a);
    return a + s * (b - a) + s * (1 - s) * ((1 - s) * da + s * db);
}

double font_filter_at(const struct font_filter *f, double u, double v)
{
    if (!f->round)
        return font_term_density(f, 0, u) * font_term_density(f, 0, v);
    return font_filter_profile(f, hypot(u, v)) * f->scale;
}

double font_filter_row_integral(const struct font_filter *f, double u, double v)
{
    if (!f->round)
        return font_term_integral(f, 0, u) * font_term_density(f, 0, v);
    double r = f->radius;
    if (fabs(v) >= r)
        return 0;
    double half = sqrt(r * r - v * v), to = fmin(fmax(u, -half), half);
    if (f->def.kind->chord)
        return f->def.kind->chord(f, v, half, to) * f->scale;
    /* Samples: Simpson's rule, finer than they are. */
    int n = 8 * f->def.samples_count;
    double d = (to + half) / n, sum = 0;
    for (int i = 0; i <= n; i++)
        sum += (i == 0 || i == n ? 1
                : i & 1          ? 4
                                 : 2) *
               font_filter_profile(f, hypot(-half + i * d, v));
    return sum * d / 3 * f->scale;
}

double font_filter_edge(const struct font_filter *f, double u)
{
    double sum = 0;
    for (int t = 0; t < f->terms_count; t++)
        sum +=
            f->terms[t].weight * font_term_integral(f, t, u) * f->terms[t].integral[f->knots];
    return sum;
}
