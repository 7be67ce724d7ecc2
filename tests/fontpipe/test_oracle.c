/* test_oracle.c - compares pixels of random glyphs of the installed fonts with an oracle that
 * shares no code with the pipeline. FreeType reads TrueType's outlines, which the pipeline has
 * from HarfBuzz (and a reader of its own CFF's), at a size that has many of its 64ths to a unit
 * of the font, and their points are taken apart here; variable fonts at random places of their
 * axes. A pixel is the integral, over rows, of the spans that are inside by the nonzero rule,
 * weighed by a closed form (or a fine table) of the filter.
 *
 *     test_oracle [CASES [SEED]]        120 cases by default, of sizes from 5 to 3000 pixels */
#include "cff_reader.h"
#include "support.h"

#include <gray.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <fontconfig/fontconfig.h>
#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_TRUETYPE_TABLES_H
#include FT_MULTIPLE_MASTERS_H

enum {
    FACES = 20,
    PIXELS = 12,
    CURVES_MAX = 8192,
    CROSSINGS_MAX = 512,
    DEPTH = 14,
    PROFILE_STEPS = 4096
};

static long cases_count = 120;
static uint32_t seed = 1990;

/* ---- filters, by their formulas ---- */

struct oracle_filter {
    const char *name;
    double radius;
    double (*profile)(double v); /* of a product; NULL: round */
    bool cone;
    double *integral; /* the profile's, from -radius on, PROFILE_STEPS + 1; normalised */
    double whole;
};

static double profile_box(double v)
{
    (void)v;
    return 1;
}

static double profile_gaussian_fast(double v)
{
    return exp(-2 * v * v);
}

static double profile_gaussian_slow(double v)
{
    return exp(-v * v / 1.125);
}

static double profile_mitchell(double v)
{
    double x = fabs(v);
    return x < 1 ? 7 * x * x * x / 6 - 2 * x * x + 8.0 / 9
                 : -7 * x * x * x / 18 + 2 * x * x - 10 * x / 3 + 16.0 / 9;
}

static double profile_lanczos(double v)
{
    double x = M_PI * fabs(v);
    return x < 1e-9 ? 1 : 3 * sin(x) * sin(x / 3) / (x * x);
}

static struct oracle_filter filters[] = {
    {"box", 0.5, profile_box, false, NULL, 0},
    {"pillbox", 0.75, NULL, false, NULL, 0},
    {"cone", 1.25, NULL, true, NULL, 0},
    {"gaussian-slow", 3, profile_gaussian_slow, false, NULL, 0},
    {"gaussian-fast", 2, profile_gaussian_fast, false, NULL, 0},
    {"mitchell", 2, profile_mitchell, false, NULL, 0},
    {"lanczos", 3, profile_lanczos, false, NULL, 0},
};
enum { FILTERS = sizeof filters / sizeof *filters };

static void filter_begin(struct oracle_filter *f)
{
    f->whole = M_PI * f->radius * f->radius / (f->cone ? 3 : 1);
    if (!f->profile)
        return;
    f->integral = calloc(PROFILE_STEPS + 1, sizeof *f->integral);
    assert_non_null(f->integral);
    double d = 2 * f->radius / PROFILE_STEPS;
    for (int i = 0; i < PROFILE_STEPS; i++) {
        double a = -f->radius + i * d; /* Simpson's rule */
        f->integral[i + 1] =
            f->integral[i] +
            d / 6 * (f->profile(a) + 4 * f->profile(a + d / 2) + f->profile(a + d));
    }
    f->whole = f->integral[PROFILE_STEPS];
}

/* The integral of f(s, v) over s from below up to u. */
static double row_integral(const struct oracle_filter *f, double u, double v)
{
    if (fabs(v) >= f->radius)
        return 0;
    if (f->profile) {
        double at = fmin(fmax((u / f->radius + 1) / 2, 0), 1) * PROFILE_STEPS;
        int i = (int)fmin(floor(at), PROFILE_STEPS - 1);
        double h = f->integral[i] + (at - i) * (f->integral[i + 1] - f->integral[i]);
        return h * f->profile(v) / (f->whole * f->whole);
    }
    double half = sqrt(f->radius * f->radius - v * v), to = fmin(fmax(u, -half), half), sum = 0;
    if (!f->cone)
        return (to + half) / f->whole;
    for (int i = 0; i < 2; i++) {
        double s = i ? to : -half, r = sqrt(s * s + v * v);
        double root = 0.5 * (s * r + (v * v > 1e-30 ? v * v * log(s + r + 1e-300) : 0));
        sum += (i ? 1 : -1) * (s - root / f->radius);
    }
    return sum / f->whole;
}

/* ---- outlines: curves that are monotonic in y, in pixels, y downwards ---- */

struct curve {
    int degree;
    double x[4], y[4], t0, t1, low, high;
};

struct glyph {
    struct curve curves[CURVES_MAX];
    int count;
    double scale, dx, dy;
};

struct point {
    double x, y;
};

static double along(const double *p, int degree, double t)
{
    double q[4];
    memcpy(q, p, sizeof q);
    for (int n = degree; n > 0; n--)
        for (int k = 0; k < n; k++)
            q[k] += t * (q[k + 1] - q[k]);
    return q[0];
}

static void monotone_add(struct glyph *g, const struct curve *c, double t0, double t1)
{
    assert_true(g->count < CURVES_MAX);
    struct curve *to = &g->curves[g->count++];
    *to = *c;
    to->t0 = t0;
    to->t1 = t1;
    double a = along(c->y, c->degree, t0), b = along(c->y, c->degree, t1);
    to->low = fmin(a, b);
    to->high = fmax(a, b);
}

/* Where y turns around: the roots of its derivative. */
static void curve_add(struct glyph *g, int degree, const struct point *points)
{
    struct curve c = {.degree = degree};
    double turns[4] = {0}, a, b, d;
    int count = 1;
    for (int k = 0; k <= degree; k++) {
        c.x[k] = points[k].x * g->scale + g->dx;
        c.y[k] = -points[k].y * g->scale + g->dy;
    }
    double p = c.y[1] - c.y[0], q = c.y[2] - c.y[1], r = c.y[3] - c.y[2];
    if (degree == 2 && p != q) {
        turns[count++] = p / (p - q);
    } else if (degree == 3) {
        a = p - 2 * q + r;
        b = 2 * (q - p);
        d = b * b - 4 * a * p;
        if (fabs(a) > 1e-12 * (fabs(p) + fabs(q) + fabs(r)) && d >= 0) {
            double s = -0.5 * (b + copysign(sqrt(d), b));
            turns[count++] = s / a;
            if (s != 0)
                turns[count++] = p / s;
        } else if (b != 0) {
            turns[count++] = -p / b;
        }
    }
    if (count == 3 && turns[1] > turns[2]) {
        double swap = turns[1];
        turns[1] = turns[2];
        turns[2] = swap;
    }
    double from = 0;
    for (int k = 1; k < count; k++)
        if (turns[k] > from + 1e-9 && turns[k] < 1 - 1e-9) {
            monotone_add(g, &c, from, turns[k]);
            from = turns[k];
        }
    monotone_add(g, &c, from, 1);
}

/* Of a variable font: FreeType counts places on axes in 65536ths, where OpenType has 16384ths,
 * and puts components at whole units. */
static const double UNSURE_UNITS = 0.12;
static bool ft_varied;

static uint8_t *cff_table;
static size_t cff_bytes;

static void cff_line(void *g, const double *p)
{
    curve_add(g, 1, (const struct point *)(const void *)p);
}

static void cff_cubic(void *g, const double *p)
{
    curve_add(g, 3, (const struct point *)(const void *)p);
}

static struct point middle_of(struct point a, struct point b)
{
    return (struct point){(a.x + b.x) / 2, (a.y + b.y) / 2};
}

/* A contour's points, each on the curve or a quadratic's or a cubic's: first those between two
 * of a quadratic's are put in, so that what is left is lines and whole curves, around. */
static void contour_add(struct glyph *g, const FT_Outline *o, int first, int last)
{
    static struct point points[2 * CURVES_MAX];
    static int kinds[2 * CURVES_MAX];
    int count = 0, start = -1;
    for (int i = first; i <= last; i++) {
        int before = i > first ? i - 1 : last;
        int kind = o->tags[i] & 3, last_kind = o->tags[before] & 3;
        struct point p = {(double)o->points[i].x, (double)o->points[i].y},
                     q = {(double)o->points[before].x, (double)o->points[before].y};
        if (kind == 0 && last_kind == 0) {
            kinds[count] = 1;
            points[count++] = middle_of(q, p);
        }
        kinds[count] = kind == 3 ? 1 : kind;
        points[count++] = p;
    }
    for (int i = 0; i < count && start < 0; i++)
        if (kinds[i] == 1)
            start = i;
    for (int i = 0; start >= 0 && i < count;) {
        struct point curve[4] = {points[(start + i) % count]};
        int degree = 1;
        while (degree < 3 && kinds[(start + i + degree) % count] != 1) {
            curve[degree] = points[(start + i + degree) % count];
            degree++;
        }
        curve[degree] = points[(start + i + degree) % count];
        curve_add(g, degree, curve);
        i += degree;
    }
}

static bool glyph_load(struct glyph *g, FT_Face face, uint32_t index, double size_px)
{
    g->count = 0;
    if (cff_table) { /* FreeType cuts its numbers to whole units */
        g->scale = size_px / face->units_per_EM;
        struct cff_reader r = {.context = g, .line = cff_line, .cubic = cff_cubic};
        return cff_glyph_read(&r, cff_table, cff_bytes, index) && g->count > 0;
    }
    g->scale = size_px / (64.0 * face->size->metrics.x_ppem);
    if (ft_varied && (FT_Load_Glyph(face, index, FT_LOAD_NO_SCALE | FT_LOAD_NO_RECURSE) != 0 ||
                      face->glyph->format == FT_GLYPH_FORMAT_COMPOSITE))
        return false;
    if (FT_Load_Glyph(face, index, FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP) != 0 ||
        face->glyph->format != FT_GLYPH_FORMAT_OUTLINE)
        return false;
    const FT_Outline *o = &face->glyph->outline;
    for (int c = 0, first = 0; c < o->n_contours; first = o->contours[c++] + 1)
        contour_add(g, o, first, o->contours[c]);
    return g->count > 0;
}

/* The table of the face that is looked at, if it has CFF outlines; FreeType unpacks it. */
static void cff_load(FT_Face ft)
{
    FT_ULong length = 0;
    free(cff_table);
    cff_table = NULL;
    cff_bytes = 0;
    if (!FT_IS_SFNT(ft) ||
        FT_Load_Sfnt_Table(ft, FT_MAKE_TAG('C', 'F', 'F', ' '), 0, NULL, &length))
        return;
    cff_table = malloc(length);
    assert_non_null(cff_table);
    assert_int_equal(
        FT_Load_Sfnt_Table(ft, FT_MAKE_TAG('C', 'F', 'F', ' '), 0, cff_table, &length), 0);
    cff_bytes = length;
}

/* So large that a unit of the font has many 64ths of a pixel; FreeType reads no Type 1 glyphs
 * that are larger than 2000. */
static void size_set(FT_Face ft)
{
    FT_UInt ppem = FT_IS_SFNT(ft) ? ft->units_per_EM * 31u : 2000;
    assert_int_equal(FT_Set_Pixel_Sizes(ft, 0, ppem < 65535 ? ppem : 65535), 0);
}

/* The same random place of all axes, in both. */
static void axes_set(struct font_face *face, FT_Library library, FT_Face ft, uint32_t *random)
{
    FT_MM_Var *axes;
    FT_Fixed values[16];
    ft_varied = false;
    if (!FT_HAS_MULTIPLE_MASTERS(ft) || FT_Get_MM_Var(ft, &axes) != 0)
        return;
    for (FT_UInt i = 0; i < axes->num_axis && i < 16; i++) {
        struct font_axis axis;
        assert_font(font_face_axis(face, (int)i, &axis));
        double value = floor(axis.least + random_unit(random) * (axis.most - axis.least));
        assert_font(font_face_axis_set(face, axis.tag, value));
        values[i] = (FT_Fixed)(fmax(axis.least, value) * 65536);
    }
    ft_varied = true;
    if (axes->num_axis <= 16)
        FT_Set_Var_Design_Coordinates(ft, axes->num_axis, values);
    FT_Done_MM_Var(library, axes);
}

/* ---- a pixel ---- */

struct crossing {
    double x;
    int direction;
};

static int crossings_compare(const void *a, const void *b)
{
    const struct crossing *p = a, *q = b;
    return (p->x > q->x) - (p->x < q->x);
}

static struct crossing crossing_of(const struct curve *c, double y)
{
    double a = c->t0, b = c->t1;
    bool falls = along(c->y, c->degree, a) > along(c->y, c->degree, b);
    for (int n = 0; n < (c->degree == 1 ? 0 : 48); n++) {
        double middle = 0.5 * (a + b);
        if ((along(c->y, c->degree, middle) < y) != falls)
            a = middle;
        else
            b = middle;
    }
    double t = c->degree == 1 ? (y - c->y[0]) / (c->y[1] - c->y[0]) : 0.5 * (a + b);
    return (struct crossing){along(c->x, c->degree, t), falls ? -1 : 1};
}

/* The row at y's part of the pixel whose centre is (x, centre_y). */
static double row_of(const struct oracle_filter *f, const struct curve *const *near, int count,
                     double x, double centre_y, double y)
{
    struct crossing crossings[CROSSINGS_MAX];
    int found = 0, winding = 0;
    double sum = 0;
    for (int i = 0; i < count && found < CROSSINGS_MAX; i++)
        if (near[i]->low <= y && y < near[i]->high)
            crossings[found++] = crossing_of(near[i], y);
    qsort(crossings, (size_t)found, sizeof *crossings, crossings_compare);
    for (int i = 0; i + 1 < found; i++) {
        winding += crossings[i].direction;
        if (winding)
            sum += row_integral(f, crossings[i + 1].x - x, y - centre_y) -
                   row_integral(f, crossings[i].x - x, y - centre_y);
    }
    return sum;
}

static int doubles_compare(const void *a, const void *b)
{
    double p = *(const double *)a, q = *(const double *)b;
    return (p > q) - (p < q);
}

struct pixel {
    const struct oracle_filter *filter;
    const struct curve *near[CURVES_MAX];
    int count;
    double x, y;
};

/* Integrates rows by Gauss's three nodes, and halves the interval until that makes no
 * difference: a nearly horizontal edge crosses a pixel within few rows. */
static double rows_of(const struct pixel *p, double from, double to, double before, int depth)
{
    static const double at[3] = {0.1127016653792583, 0.5, 0.8872983346207417};
    static const double weight[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
    double middle = 0.5 * (from + to), half[2] = {0, 0};
    for (int side = 0; side < 2; side++)
        for (int k = 0; k < 3; k++) {
            double y = (side ? middle : from) + at[k] * (middle - from);
            half[side] += weight[k] * (middle - from) *
                          row_of(p->filter, p->near, p->count, p->x, p->y, y);
        }
    double sum = half[0] + half[1];
    if (depth > 0 && (depth > DEPTH - 2 || fabs(sum - before) > 2e-6))
        return rows_of(p, from, middle, half[0], depth - 1) +
               rows_of(p, middle, to, half[1], depth - 1);
    return sum;
}

static double pixel_of(const struct oracle_filter *f, const struct glyph *g, double x, double y)
{
    static struct pixel pixel;
    static double breaks[2 * CURVES_MAX + 8];
    int breaks_count = 0;
    double sum = 0;
    pixel.filter = f;
    pixel.count = 0;
    pixel.x = x;
    pixel.y = y;
    for (int k = -4; k <= 4; k++) /* corners of profiles, too */
        if (fabs(k / 2.0) <= f->radius)
            breaks[breaks_count++] = y + k / 2.0;
    if (fmod(f->radius, 0.5) != 0) {
        breaks[breaks_count++] = y - f->radius;
        breaks[breaks_count++] = y + f->radius;
    }
    if (f->radius > 2) {
        breaks[breaks_count++] = y - f->radius;
        breaks[breaks_count++] = y + f->radius;
    }
    for (int i = 0; i < g->count; i++) {
        const struct curve *c = &g->curves[i];
        if (c->high <= y - f->radius || c->low >= y + f->radius || c->low == c->high)
            continue;
        pixel.near[pixel.count++] = c;
        if (c->low > y - f->radius)
            breaks[breaks_count++] = c->low;
        if (c->high < y + f->radius)
            breaks[breaks_count++] = c->high;
    }
    qsort(breaks, (size_t)breaks_count, sizeof *breaks, doubles_compare);
    for (int i = 0; i + 1 < breaks_count; i++)
        if (breaks[i + 1] > breaks[i])
            sum += rows_of(&pixel, breaks[i], breaks[i + 1], 1e9, DEPTH);
    return sum;
}

/* ---- fonts ---- */

static int paths_compare(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

/* Lists the files of all fonts, sorted by name. */
static int paths_find(char ***paths)
{
    FcPattern *pattern = FcPatternCreate();
    FcObjectSet *objects = FcObjectSetBuild(FC_FILE, (char *)NULL);
    FcFontSet *all = FcFontList(NULL, pattern, objects);
    int count = 0;
    assert_true(all && all->nfont > 0);
    *paths = calloc((size_t)all->nfont, sizeof **paths);
    assert_non_null(*paths);
    for (int i = 0; i < all->nfont; i++) {
        FcChar8 *file;
        if (FcPatternGetString(all->fonts[i], FC_FILE, 0, &file) == FcResultMatch)
            (*paths)[count++] = strdup((const char *)file);
    }
    qsort(*paths, (size_t)count, sizeof **paths, paths_compare);
    FcFontSetDestroy(all);
    FcObjectSetDestroy(objects);
    FcPatternDestroy(pattern);
    return count;
}

struct worst {
    double error;
    long pixels;
    char where[256];
};

static void glyph_compare(struct glyph *g, struct font_face *face, FT_Face ft, int filter,
                          uint32_t index, double size_px, uint32_t *random, struct worst *worst)
{
    static struct font_filter *made[FILTERS];
    const struct oracle_filter *f = &filters[filter];
    struct font_outline outline;
    struct font_edges edges = {0};
    struct font_gray gray = {0};
    double x = random_unit(random), y = random_unit(random);
    g->dx = x;
    g->dy = y;
    struct font_face_info info;
    if (!glyph_load(g, ft, index, size_px))
        return;
    font_face_describe(face, &info);
    made[filter] = made[filter] ? made[filter] : filter_make(f->name);
    assert_font(font_face_outline(face, index, &outline));
    struct font_map map = font_map_size(size_px, outline.units_per_em);
    assert_font(font_edges_build(&edges, &outline, &map, made[filter]));
    assert_font(font_gray_draw(&gray, &edges, made[filter], x, y));
    for (int n = 0; n < PIXELS; n++) {
        const struct curve *c = &g->curves[random_next(random) % (uint32_t)g->count];
        double t = c->t0 + random_unit(random) * (c->t1 - c->t0);
        int column = (int)floor(along(c->x, c->degree, t) + 3 * random_unit(random) - 1.5);
        int row = (int)floor(along(c->y, c->degree, t) + 3 * random_unit(random) - 1.5);
        int i = column - gray.left_px, j = row - gray.top_px;
        int have = i < 0 || j < 0 || i >= gray.width_px || j >= gray.height_px
                       ? 0
                       : gray.pixels[j * gray.pitch + i];
        double unsure = ft_varied ? UNSURE_UNITS * 255 * size_px / outline.units_per_em : 0;
        double want = fmin(fmax(255 * pixel_of(f, g, column + 0.5, row + 0.5), 0), 255);
        worst->pixels++;
        if (fabs(have - want) - unsure > worst->error) {
            worst->error = fabs(have - want) - unsure;
            snprintf(worst->where, sizeof worst->where,
                     "%.100s, glyph %u at %.4f px, %s, place (%.5f, %.5f), pixel (%d, %d): %d, "
                     "not %.3f%s",
                     info.path, index, size_px, f->name, x, y, column, row, have, want,
                     outline.rebuilt ? "; it covers something twice" : "");
        }
    }
    font_gray_finish(&gray);
    font_edges_finish(&edges);
    font_outline_finish(&outline);
}

static void glyphs_are_the_oracles_at_any_size(void **state)
{
    (void)state;
    static struct glyph glyph;
    static struct worst worst;
    uint32_t random = seed;
    FT_Library library;
    char **paths;
    int paths_count = paths_find(&paths);
    assert_int_equal(FT_Init_FreeType(&library), 0);
    for (int i = 0; i < FILTERS; i++)
        filter_begin(&filters[i]);
    for (int n = 0; n < FACES; n++) {
        const char *path = paths[random_next(&random) % (uint32_t)paths_count];
        struct font_face *face;
        FT_Face ft;
        if (font_face_open(path, 0, &face) != FONT_OK)
            continue;
        assert_int_equal(FT_New_Face(library, path, 0, &ft), 0);
        cff_load(ft);
        size_set(ft);
        axes_set(face, library, ft, &random);
        for (long k = 0; k < cases_count / FACES; k++)
            glyph_compare(&glyph, face, ft, (int)(random_next(&random) % FILTERS),
                          random_next(&random) % (uint32_t)ft->num_glyphs,
                          5 * pow(600, random_unit(&random)), &random, &worst);
        FT_Done_Face(ft);
        font_face_close(face);
    }
    FT_Done_FreeType(library);
    for (int i = 0; i < paths_count; i++)
        free(paths[i]);
    free(paths);
    for (int i = 0; i < FILTERS; i++)
        free(filters[i].integral);
    print_message("%ld pixels of %ld glyphs: at most %.3f of 255 (%s)\n", worst.pixels,
                  cases_count, worst.error, worst.where);
    assert_true(worst.pixels > 5 * cases_count);
    assert_true(worst.error <= 1);
}

int main(int argc, char **argv)
{
    cases_count = argc > 1 ? atol(argv[1]) : cases_count;
    seed = argc > 2 ? (uint32_t)atol(argv[2]) : seed;
    const struct CMUnitTest tests[] = {cmocka_unit_test(glyphs_are_the_oracles_at_any_size)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
