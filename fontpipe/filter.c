/* filter.c - makes filters from their names: integrals of profiles, and the tables. */
#include "arcs.h"
#include "filter_internal.h"
#include "internal.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { KNOTS = 2048 }; /* of a product's profile */

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
            sum +=
                font_gauss_weight[FONT_NODES_MAX][k] *
                font_filter_profile(f, -f->radius + (i + font_gauss_at[FONT_NODES_MAX][k]) * d);
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
        t->density[i] = font_filter_profile(f, -f->radius + i * d) / whole;
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
                    /* The last phase belongs to this row: a jump at the radius is approached
                     * from inside. */
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

static enum font_status def_take(struct font_filter *f, const struct font_filter_def *def)
{
    const struct font_filter_kind *kind = def->kind;
    f->def = *def;
    f->radius = def->radius_px;
    snprintf(f->name, sizeof f->name, "%s", kind->name);
    if (!(f->radius >= 0.25 && f->radius <= FONT_FILTER_RADIUS_MAX))
        return font_fail(FONT_BAD_ARGUMENT,
                         "a filter's radius must be 0.25..%d pixels (got %g)",
                         FONT_FILTER_RADIUS_MAX, f->radius);
    if ((kind->takes == FONT_TAKES_SIGMA_RADIUS || kind->sigma_px != 0) &&
        !(f->def.sigma_px >= 0.1 && f->def.sigma_px <= 4))
        return font_fail(FONT_BAD_ARGUMENT, "a Gaussian's sigma must be 0.1..4 pixels (got %g)",
                         f->def.sigma_px);
    if (kind->takes == FONT_TAKES_SAMPLES) {
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
    if (kind->way != FONT_BY_TABLES && f->radius >= kind->way_least_px &&
        f->radius <= kind->way_most_px)
        f->way = kind->way;
    f->arc_span_px = FONT_ARC_SPAN_PX;
    f->arc_bend_px = INFINITY;
    if (f->way == FONT_BY_DISCS) {
        f->arc_span_px = (float)fmax(3.98 - 2 * f->radius, 1.5); /* a block of gray_disc.h */
        f->arc_bend_px = FONT_DISC_BEND * (float)f->radius;
    }
    f->piece_tolerance =
        (float)(f->way == FONT_BY_PATCHES ? FONT_PATCH_TOLERANCE : FONT_PIECE_TOLERANCE);
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
    f->round = def->kind->round;
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

enum { NAMES_MAX = 32 };
static const char *names[NAMES_MAX + 1];
static char names_text[256];

/* Of those that need nothing more. */
__attribute__((constructor)) static void names_make(void)
{
    int count = 0;
    size_t used = 0;
    for (int i = 0; i < font_filter_kinds_count; i++)
        if (font_filter_kinds[i].takes == FONT_TAKES_RADIUS && count < NAMES_MAX) {
            names[count] = font_filter_kinds[i].name;
            if (used < sizeof names_text)
                used += (size_t)snprintf(names_text + used, sizeof names_text - used, "%s%s",
                                         count ? ", " : "", names[count]);
            count++;
        }
}

const char *const *font_filter_names(void)
{
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

/* The kind of that name, if it takes so many numbers. */
static const struct font_filter_kind *kind_find(const char *name, size_t length, int count)
{
    for (int i = 0; i < font_filter_kinds_count; i++) {
        const struct font_filter_kind *kind = &font_filter_kinds[i];
        bool fits = kind->takes == FONT_TAKES_RADIUS         ? count <= 1
                    : kind->takes == FONT_TAKES_SIGMA_RADIUS ? count == 2
                                                             : count >= 3;
        if (fits && strlen(kind->name) == length && strncmp(kind->name, name, length) == 0)
            return kind;
    }
    return NULL;
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
    struct font_filter_def def = {.kind = kind_find(name, length, count)};
    if (!def.kind)
        return font_fail(FONT_BAD_ARGUMENT,
                         "there is no filter '%.60s'; there are %s (each with :radius), "
                         "gaussian:sigma,radius, samples:radius,s0,s1,.. and "
                         "round:radius,s0,s1,..",
                         name, names_text);
    def.radius_px = count ? numbers[0] : def.kind->radius_px;
    def.sigma_px = def.kind->sigma_px;
    if (def.kind->takes == FONT_TAKES_SIGMA_RADIUS) {
        def.sigma_px = numbers[0];
        def.radius_px = numbers[1];
    } else if (def.kind->takes == FONT_TAKES_SAMPLES) {
        def.samples = numbers + 1;
        def.samples_count = count - 1;
    }
    if (count && def.radius_px == 0)
        return font_fail(FONT_BAD_ARGUMENT, "a filter's radius must be 0.25..%d pixels (got 0)",
                         FONT_FILTER_RADIUS_MAX);
    enum font_status status = font_filter_create(&def, out);
    if (status == FONT_OK)
        snprintf((*out)->name, sizeof(*out)->name, "%.60s", name);
    return status;
}

void font_filter_words(const char *text, size_t count, char *out)
{
    size_t length = 0;
    bool gap = false, note = false;
    for (size_t i = 0; i < count; i++) {
        char c = text[i];
        note = c != '\n' && (note || c == '#');
        if (note || c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == ',' || c == '\0') {
            gap = length > 0;
            continue;
        }
        if (gap && out[length - 1] != ':') /* no comma after "samples:" */
            out[length++] = ',';
        gap = false;
        out[length++] = c;
    }
    out[length] = '\0';
}

void font_filter_describe(const struct font_filter *f, struct font_filter_info *out)
{
    *out = f->info;
    out->name = f->name;
}
