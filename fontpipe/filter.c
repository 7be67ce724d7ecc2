/* filter.c - makes filters: profiles, their integrals, the tables. */
#include "arcs.h"
#include "filter_internal.h"
#include "internal.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const double font_gauss_at[FONT_NODES_MAX + 1][FONT_NODES_MAX] = {
    {0},
    {0.5},
    {0.21132486540518713, 0.78867513459481287},
    {0.1127016653792583, 0.5, 0.8872983346207417},
    {0.069431844202973714, 0.33000947820757187, 0.66999052179242813, 0.93056815579702623},
    {0.046910077030668018, 0.23076534494715845, 0.5, 0.7692346550528415, 0.95308992296933193},
    {0.033765242898423975, 0.1693953067668677, 0.38069040695840151, 0.61930959304159849,
     0.83060469323313235, 0.96623475710157603},
    {0.025446043828620757, 0.12923440720030277, 0.29707742431130141, 0.5, 0.70292257568869854,
     0.87076559279969723, 0.97455395617137919},
    {0.019855071751231856, 0.10166676129318658, 0.2372337950418355, 0.40828267875217511,
     0.59171732124782483, 0.7627662049581645, 0.89833323870681348, 0.9801449282487682},
};

const double font_gauss_weight[FONT_NODES_MAX + 1][FONT_NODES_MAX] = {
    {0},
    {1},
    {0.50000000000000011, 0.50000000000000011},
    {0.27777777777777762, 0.44444444444444442, 0.27777777777777762},
    {0.17392742256872687, 0.32607257743127305, 0.32607257743127305, 0.17392742256872687},
    {0.1184634425280945, 0.23931433524968324, 0.28444444444444444, 0.23931433524968324,
     0.1184634425280945},
    {0.085662246189585248, 0.1803807865240693, 0.23395696728634552, 0.23395696728634552,
     0.1803807865240693, 0.085662246189585248},
    {0.064742483084434838, 0.13985269574463835, 0.19091502525255952, 0.2089795918367347,
     0.19091502525255952, 0.13985269574463835, 0.064742483084434838},
    {0.050614268145188088, 0.11119051722668723, 0.15685332293894369, 0.181341891689181,
     0.181341891689181, 0.15685332293894369, 0.11119051722668723, 0.050614268145188088},
};

const float font_even_weight[3] = {13 / 12.0f, 7 / 8.0f, 25 / 24.0f};

enum { KNOTS = 2048 }; /* of a product's profile */

struct font_filter_def font_filter_def_default(enum font_filter_kind kind)
{
    struct font_filter_def def = {.kind = kind};
    switch (kind) {
    case FONT_BOX:
        def.radius_px = 0.5;
        break;
    case FONT_PILLBOX:
        def.radius_px = 0.75;
        break;
    case FONT_CONE:
        def.radius_px = 1.25;
        break;
    case FONT_GAUSSIAN:
        def.radius_px = 2;
        def.sigma_px = 0.5;
        break;
    case FONT_MITCHELL:
        def.radius_px = 2;
        def.b = def.c = 1.0 / 3;
        break;
    case FONT_LANCZOS:
        def.radius_px = 3;
        break;
    case FONT_SAMPLES:
    case FONT_ROUND_SAMPLES:
        def.radius_px = 1;
        break;
    }
    return def;
}

/* ---- profiles ---- */

static double sinc(double x)
{
    return fabs(x) < 1e-9 ? 1 : sin(M_PI * x) / (M_PI * x);
}

static double mitchell(double x, double b, double c)
{
    x = fabs(x);
    if (x < 1)
        return ((12 - 9 * b - 6 * c) * x * x * x + (-18 + 12 * b + 6 * c) * x * x + 6 - 2 * b) /
               6;
    if (x < 2)
        return ((-b - 6 * c) * x * x * x + (6 * b + 30 * c) * x * x + (-12 * b - 48 * c) * x +
                8 * b + 24 * c) /
               6;
    return 0;
}

/* The profile as asked for, at a distance within the radius: h of a product, f along a radius of a round one. */
static double profile(const struct font_filter *f, double v)
{
    double r = f->radius, q = fabs(v) / r;
    if (q > 1)
        return 0;
    switch (f->def.kind) {
    case FONT_BOX:
    case FONT_PILLBOX:
        return 1;
    case FONT_CONE:
        return 1 - q;
    case FONT_GAUSSIAN:
        return exp(-0.5 * v * v / (f->def.sigma_px * f->def.sigma_px));
    case FONT_MITCHELL:
        return mitchell(2 * q, f->def.b, f->def.c);
    case FONT_LANCZOS: {
        double lobes = fmax(1, round(r)); /* zeros at whole pixels, or close to them */
        return sinc(q * lobes) * sinc(q);
    }
    case FONT_SAMPLES:
    case FONT_ROUND_SAMPLES:
        break;
    }
    double at = q * (f->def.samples_count - 1);
    int i = (int)fmin(floor(at), f->def.samples_count - 2);
    return f->samples[i] + (at - i) * (f->samples[i + 1] - f->samples[i]);
}

double font_term_density(const struct font_filter *f, int term, double v)
{
    const struct font_filter_term *t = &f->terms[term];
    if (fabs(v) > f->radius)
        return 0;
    if (!f->round)
        return profile(f, v) * f->scale;
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
    return profile(f, hypot(u, v)) * f->scale;
}

double font_filter_row_integral(const struct font_filter *f, double u, double v)
{
    if (!f->round)
        return font_term_integral(f, 0, u) * font_term_density(f, 0, v);
    double r = f->radius;
    if (fabs(v) >= r)
        return 0;
    double half = sqrt(r * r - v * v), to = fmin(fmax(u, -half), half);
    if (f->def.kind == FONT_PILLBOX)
        return (to + half) * f->scale;
    if (f->def.kind == FONT_CONE) {
        /* The integral of sqrt(s^2 + v^2) has a closed form. */
        double w = fabs(v), sum = 0;
        for (int i = 0; i < 2; i++) {
            double s = i ? to : -half, length = hypot(s, w);
            double root = 0.5 * (s * length + (w > 0 ? w * w * asinh(s / w) : 0));
            sum += i ? root : -root;
        }
        return (to + half - sum / r) * f->scale;
    }
    /* Samples: Simpson's rule, finer than they are. */
    int n = 8 * f->def.samples_count;
    double d = (to + half) / n, sum = 0;
    for (int i = 0; i <= n; i++)
        sum += (i == 0 || i == n ? 1 : i & 1 ? 4 : 2) * profile(f, hypot(-half + i * d, v));
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

/* ---- making one ---- */

static bool term_allocate(struct font_filter *f, int term)
{
    f->terms[term].weight = 1;
    f->terms[term].integral = calloc((size_t)f->knots + 1, sizeof(double));
    f->terms[term].density = calloc((size_t)f->knots + 1, sizeof(double));
    return f->terms[term].integral && f->terms[term].density;
}

/* One product: the profile's integral between knots with eight nodes each. */
static enum font_status product_make(struct font_filter *f)
{
    f->knots = KNOTS;
    f->terms_count = 1;
    if (!term_allocate(f, 0))
        return font_fail(FONT_NO_MEMORY, "no memory for a filter");
    struct font_filter_term *t = &f->terms[0];
    double d = 2 * f->radius / KNOTS;
    for (int i = 0; i < KNOTS; i++) {
        double sum = 0;
        for (int k = 0; k < FONT_NODES_MAX; k++)
            sum += font_gauss_weight[FONT_NODES_MAX][k] *
                   profile(f, -f->radius + (i + font_gauss_at[FONT_NODES_MAX][k]) * d);
        t->integral[i + 1] = t->integral[i] + sum * d;
    }
    double whole = t->integral[KNOTS];
    f->info.raw_integral = whole * whole;
    if (!(whole > 1e-6) || !isfinite(whole))
        return font_fail(FONT_BAD_ARGUMENT, "filter %s: its integral must be positive (got %g)",
                         f->name, whole);
    f->scale = 1 / whole;
    for (int i = 0; i <= KNOTS; i++) {
        t->integral[i] /= whole;
        t->density[i] = profile(f, -f->radius + i * d) / whole;
    }
    t->integral[KNOTS] = 1;
    return FONT_OK;
}

/* A row of a table at phase p and the differences to the next. */
static void table_row(float *row, int row_floats, const double *here, const double *next)
{
    for (int i = 0; i < row_floats; i++) {
        row[i] = (float)here[i];
        row[row_floats + i] = (float)(next[i] - here[i]);
    }
}

static enum font_status tables_make(struct font_filter *f)
{
    size_t bytes = sizeof(float) * FONT_TERM_FLOATS * (size_t)f->terms_count;
    f->tables = aligned_alloc(64, bytes);
    if (!f->tables)
        return font_fail(FONT_NO_MEMORY, "no memory for a filter");
    f->info.bytes = bytes;
    for (int t = 0; t < f->terms_count; t++) {
        float *x = f->tables + (ptrdiff_t)t * FONT_TERM_FLOATS;
        float *h = x + FONT_PHASES * 2 * FONT_X_ROW, *y = h + FONT_PHASES * 2 * FONT_H_ROW;
        double total = f->terms[t].integral[f->knots];
        for (int p = 0; p < FONT_PHASES; p++) {
            double vx[2][FONT_X_ROW] = {{0}}, vh[2][FONT_H_ROW] = {{0}},
                   vy[2][FONT_Y_ROW] = {{0}};
            for (int n = 0; n < 2; n++) {
                double phase = (double)(p + n) / FONT_PHASES;
                for (int k = 0; k < f->taps; k++) {
                    /* The last phase belongs to this row: a jump at the radius is approached from inside. */
                    double at = k + 1 - phase - f->radius;
                    vx[n][16 + k] = font_term_density(f, t, fmax(at, -f->radius));
                    vh[n][16 + k] = font_term_integral(f, t, at);
                }
                for (int k = 16 + f->taps; k < FONT_H_ROW; k++)
                    vh[n][k] = total;
                for (int k = 0; k <= f->taps; k++) {
                    double at = k + 1 - phase - f->radius;
                    vy[n][k] = f->terms[t].weight * (font_term_integral(f, t, at) -
                                                     font_term_integral(f, t, at - 1));
                }
            }
            table_row(x + p * 2 * FONT_X_ROW, FONT_X_ROW, vx[0], vx[1]);
            table_row(h + p * 2 * FONT_H_ROW, FONT_H_ROW, vh[0], vh[1]);
            table_row(y + p * 2 * FONT_Y_ROW, FONT_Y_ROW, vy[0], vy[1]);
        }
    }
    return FONT_OK;
}

static const char *const kind_names[] = {"box",      "pillbox", "cone",    "gaussian",
                                         "mitchell", "lanczos", "samples", "round"};

static enum font_status def_take(struct font_filter *f, const struct font_filter_def *def)
{
    if ((unsigned)def->kind > FONT_ROUND_SAMPLES)
        return font_fail(FONT_BAD_ARGUMENT, "there is no filter of kind %d", (int)def->kind);
    struct font_filter_def usual = font_filter_def_default(def->kind);
    f->def = *def;
    f->radius = def->radius_px != 0 ? def->radius_px : usual.radius_px;
    if (!(f->radius >= 0.25 && f->radius <= FONT_FILTER_RADIUS_MAX))
        return font_fail(FONT_BAD_ARGUMENT,
                         "a filter's radius must be 0.25..%d pixels (got %g)",
                         FONT_FILTER_RADIUS_MAX, f->radius);
    if (def->kind == FONT_GAUSSIAN) {
        if (f->def.sigma_px == 0)
            f->def.sigma_px = f->radius / 4;
        if (!(f->def.sigma_px >= 0.1 && f->def.sigma_px <= 4))
            return font_fail(FONT_BAD_ARGUMENT,
                             "a Gaussian's sigma must be 0.1..4 pixels (got %g)",
                             f->def.sigma_px);
    }
    if (def->kind == FONT_MITCHELL && !(fabs(def->b) <= 3 && fabs(def->c) <= 3))
        return font_fail(FONT_BAD_ARGUMENT, "Mitchell's b and c must be -3..3");
    if (def->kind == FONT_SAMPLES || def->kind == FONT_ROUND_SAMPLES) {
        if (!def->samples || def->samples_count < 2 ||
            def->samples_count > FONT_FILTER_SAMPLES_MAX)
            return font_fail(FONT_BAD_ARGUMENT, "a filter needs 2..%d samples (got %d)",
                             FONT_FILTER_SAMPLES_MAX, def->samples_count);
        f->samples = malloc((size_t)def->samples_count * sizeof *f->samples);
        if (!f->samples)
            return font_fail(FONT_NO_MEMORY, "no memory for a filter");
        for (int i = 0; i < def->samples_count; i++) {
            f->samples[i] = def->samples[i];
            if (!(fabs(f->samples[i]) <= 1e6))
                return font_fail(FONT_BAD_ARGUMENT, "a filter's sample cannot be %g",
                                 f->samples[i]);
        }
        f->def.samples = f->samples;
    }
    snprintf(f->name, sizeof f->name, "%s", kind_names[def->kind]);
    return FONT_OK;
}

enum font_status font_filter_create(const struct font_filter_def *def, struct font_filter **out)
{
    *out = NULL;
    struct font_filter *f = calloc(1, sizeof *f);
    if (!f)
        return font_fail(FONT_NO_MEMORY, "no memory for a filter");
    enum font_status status = def_take(f, def);
    f->taps = (int)ceil(2 * f->radius - 1e-9);
    f->round = f->def.kind == FONT_PILLBOX || f->def.kind == FONT_CONE ||
               f->def.kind == FONT_ROUND_SAMPLES;
    if (f->def.kind == FONT_BOX && f->radius == 0.5) {
        f->way = FONT_BY_AREAS;
        f->arc_span_px = FONT_ARC_SPAN_PX;
        f->arc_bend_px = INFINITY;
    } else if (f->def.kind == FONT_PILLBOX) {
        f->way = FONT_BY_DISCS;
        f->arc_span_px = (float)fmax(3.98 - 2 * f->radius, 1.5); /* a block of gray_disc.h */
        f->arc_bend_px = FONT_DISC_BEND * (float)f->radius;
    } else if (f->def.kind == FONT_CONE && f->taps <= FONT_PATCH_TAPS) {
        f->way = FONT_BY_PATCHES;
    }
    f->piece_tolerance =
        (float)(f->way == FONT_BY_PATCHES ? FONT_PATCH_TOLERANCE : FONT_PIECE_TOLERANCE);
    f->scale = 1;
    if (status == FONT_OK)
        status = f->round ? font_filter_decompose(f) : product_make(f);
    if (status == FONT_OK)
        status = tables_make(f);
    if (status == FONT_OK && f->way == FONT_BY_PATCHES)
        status = font_patches_make(f);
    if (status == FONT_OK) {
        font_filter_measure(f);
        *out = f;
    } else {
        font_filter_destroy(f);
    }
    return status;
}

void font_filter_destroy(struct font_filter *f)
{
    if (!f)
        return;
    for (int i = 0; i < FONT_TERMS_MAX; i++) {
        free(f->terms[i].integral);
        free(f->terms[i].density);
    }
    free(f->samples);
    free(f->tables);
    free(f->patches);
    free(f);
}

/* ---- names ---- */

static const struct named_filter {
    const char *name;
    enum font_filter_kind kind;
    double sigma_px, radius_px;
} named[] = {
    {"box", FONT_BOX, 0, 0.5},
    {"pillbox", FONT_PILLBOX, 0, 0.75},
    {"cone", FONT_CONE, 0, 1.25},
    {"gaussian-slow", FONT_GAUSSIAN, 0.75, 3},
    {"gaussian-fast", FONT_GAUSSIAN, 0.5, 2},
    {"mitchell", FONT_MITCHELL, 0, 2},
    {"lanczos", FONT_LANCZOS, 0, 3},
};
enum { NAMED_COUNT = sizeof named / sizeof *named };

const char *const *font_filter_names(void)
{
    static const char *const names[] = {"box",           "pillbox",  "cone",    "gaussian-slow",
                                        "gaussian-fast", "mitchell", "lanczos", NULL};
    return names;
}

/* Numbers separated by commas, all of the text. */
static int numbers_read(const char *text, double *out, int most)
{
    int count = 0;
    while (*text) {
        char *end;
        if (count == most)
            return -1;
        out[count++] = strtod(text, &end);
        if (end == text || (*end && *end != ',') || (*end == ',' && !end[1]))
            return -1;
        text = *end ? end + 1 : end;
    }
    return count;
}

enum font_status font_filter_create_named(const char *name, struct font_filter **out)
{
    *out = NULL;
    double numbers[FONT_FILTER_SAMPLES_MAX + 1];
    const char *colon = strchr(name, ':');
    size_t length = colon ? (size_t)(colon - name) : strlen(name);
    int count = colon ? numbers_read(colon + 1, numbers, FONT_FILTER_SAMPLES_MAX + 1) : 0;
    if (colon && count < 1)
        return font_fail(FONT_BAD_ARGUMENT,
                         "filter '%.60s': after the colon come numbers separated by commas",
                         name);
    struct font_filter_def def = {0};
    bool known = false;
    for (int i = 0; i < NAMED_COUNT && !known; i++)
        if (strlen(named[i].name) == length && strncmp(named[i].name, name, length) == 0 &&
            count <= 1) {
            def = font_filter_def_default(named[i].kind);
            def.radius_px = count ? numbers[0] : named[i].radius_px;
            def.sigma_px = named[i].sigma_px;
            known = true;
        }
    if (!known && length == 8 && strncmp(name, "gaussian", 8) == 0 && count == 2 &&
        numbers[0] != 0) {
        def = (struct font_filter_def){
            .kind = FONT_GAUSSIAN, .sigma_px = numbers[0], .radius_px = numbers[1]};
        known = true;
    }
    if (!known && count >= 3 &&
        ((length == 7 && strncmp(name, "samples", 7) == 0) ||
         (length == 5 && strncmp(name, "round", 5) == 0))) {
        def = (struct font_filter_def){.kind = length == 7 ? FONT_SAMPLES : FONT_ROUND_SAMPLES,
                                       .radius_px = numbers[0],
                                       .samples = numbers + 1,
                                       .samples_count = count - 1};
        known = true;
    }
    if (!known)
        return font_fail(FONT_BAD_ARGUMENT,
                         "there is no filter '%.60s'; there are box, pillbox, cone, "
                         "gaussian-slow, gaussian-fast, mitchell, lanczos (each with :radius), "
                         "gaussian:sigma,radius, samples:radius,s0,s1,.. and "
                         "round:radius,s0,s1,..",
                         name);
    if (count && def.radius_px == 0)
        return font_fail(FONT_BAD_ARGUMENT, "a filter's radius must be 0.25..%d pixels (got 0)",
                         FONT_FILTER_RADIUS_MAX);
    enum font_status status = font_filter_create(&def, out);
    if (status == FONT_OK)
        snprintf((*out)->name, sizeof(*out)->name, "%.60s", name);
    return status;
}

void font_filter_describe(const struct font_filter *f, struct font_filter_info *out)
{
    *out = f->info;
    out->name = f->name;
}
