/* filter_profiles_by_name.c - the kinds of filters: profiles, and the table that everything
 * else is read off. A new filter is its profile and a row; lists of names, help and
 * measurements have it then. */
#include "filter_internal.h"

#include <math.h>

static double flat(const struct font_filter *f, double v)
{
    (void)f;
    (void)v;
    return 1;
}

static double flat_chord(const struct font_filter *f, double v, double half, double to)
{
    (void)f;
    (void)v;
    return to + half;
}

static double cone(const struct font_filter *f, double v)
{
    return 1 - fabs(v) / f->radius;
}

/* The integral of sqrt(s^2 + v^2) has a closed form. */
static double cone_chord(const struct font_filter *f, double v, double half, double to)
{
    double w = fabs(v), sum = 0;
    for (int i = 0; i < 2; i++) {
        double s = i ? to : -half, length = hypot(s, w);
        double root = 0.5 * (s * length + (w > 0 ? w * w * asinh(s / w) : 0));
        sum += i ? root : -root;
    }
    return to + half - sum / f->radius;
}

static double gaussian(const struct font_filter *f, double v)
{
    return exp(-0.5 * v * v / (f->def.sigma_px * f->def.sigma_px));
}

/* Source: Mitchell and Netravali, Reconstruction filters in computer graphics, SIGGRAPH 1988;
 * b = c = 1/3. */
static double mitchell(const struct font_filter *f, double v)
{
    const double b = 1.0 / 3, c = 1.0 / 3;
    double x = 2 * fabs(v) / f->radius;
    if (x < 1)
        return ((12 - 9 * b - 6 * c) * x * x * x + (-18 + 12 * b + 6 * c) * x * x + 6 - 2 * b) /
               6;
    return ((-b - 6 * c) * x * x * x + (6 * b + 30 * c) * x * x + (-12 * b - 48 * c) * x +
            8 * b + 24 * c) /
           6;
}

static double sinc(double x)
{
    return fabs(x) < 1e-9 ? 1 : sin(M_PI * x) / (M_PI * x);
}

static double lanczos(const struct font_filter *f, double v)
{
    double q = fabs(v) / f->radius;
    double lobes = fmax(1, round(f->radius)); /* zeros at whole pixels, or close to them */
    return sinc(q * lobes) * sinc(q);
}

static double sampled(const struct font_filter *f, double v)
{
    double at = fabs(v) / f->radius * (f->def.samples_count - 1);
    int i = (int)fmin(floor(at), f->def.samples_count - 2);
    return f->samples[i] + (at - i) * (f->samples[i + 1] - f->samples[i]);
}

#define PATCHES_MOST_PX (FONT_PATCH_TAPS / 2.0)

/* clang-format off */
const struct font_filter_kind font_filter_kinds[] = {
    {"box", .radius_px = 0.5, .profile = flat, .way = FONT_BY_AREAS, .way_least_px = 0.5, .way_most_px = 0.5},
    {"pillbox", .round = true, .radius_px = 0.75, .profile = flat, .chord = flat_chord, .volume = M_PI,
     .way = FONT_BY_DISCS, .way_most_px = FONT_FILTER_RADIUS_MAX},
    {"cone", .round = true, .radius_px = 1.25, .profile = cone, .chord = cone_chord, .volume = M_PI / 3,
     .way = FONT_BY_PATCHES, .way_most_px = PATCHES_MOST_PX},
    {"gaussian-slow", .radius_px = 3, .sigma_px = 0.75, .profile = gaussian},
    {"gaussian-fast", .radius_px = 2, .sigma_px = 0.5, .profile = gaussian},
    {"mitchell", .radius_px = 2, .profile = mitchell},
    {"lanczos", .radius_px = 3, .profile = lanczos},
    {"gaussian", FONT_TAKES_SIGMA_RADIUS, .profile = gaussian},
    {"samples", FONT_TAKES_SAMPLES, .profile = sampled},
    {"round", FONT_TAKES_SAMPLES, .round = true, .profile = sampled},
};
/* clang-format on */
const int font_filter_kinds_count = sizeof font_filter_kinds / sizeof *font_filter_kinds;
