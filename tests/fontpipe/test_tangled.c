/* test_tangled.c - outlines that cross themselves however often: their gray pictures against an
 * oracle that shares no code with the pipeline. It counts winding numbers along hundreds of
 * lines in a row of pixels, from points of its own and roots in closed form; an outline's
 * pixels are right where those lines' spans say so. */
#include "support.h"

#include <edges.h>
#include <gray.h>
#include <master.h>
#include <outline.h>

#include <math.h>
#include <stdlib.h>
#include <time.h>

enum { LINES_A_ROW = 512, EM = 1000 };

/* How many rows are looked at; LUTETIA_TANGLED_ROWS: more of them, and at sizes that take long,
 * too. */
static int rows_of(double size_px)
{
    const char *asked = getenv("LUTETIA_TANGLED_ROWS");
    return asked ? atoi(asked) : size_px < 100 ? 2 : 1;
}

/* A contour is points; with curves every second one is leant to, as in a quadratic curve. */
struct tangle {
    double (*points)[2];
    int *starts; /* of contours, and behind the last */
    int count, contours;
    bool curves;
    enum font_fill rule;
};

static struct tangle tangle_new(int count, int contours, bool curves, enum font_fill rule)
{
    struct tangle t = {.count = count, .contours = contours, .curves = curves, .rule = rule};
    t.points = malloc((size_t)count * sizeof *t.points);
    t.starts = malloc(((size_t)contours + 1) * sizeof *t.starts);
    assert_true(t.points && t.starts);
    for (int c = 0; c <= contours; c++)
        t.starts[c] = (int)((long)count * c / contours) & ~1;
    return t;
}

static void tangle_free(struct tangle *t)
{
    free(t->points);
    free(t->starts);
}

/* ---- the oracle ---- */

struct crossing {
    double x;
    int direction;
};

static int crossings_compare(const void *a, const void *b)
{
    const struct crossing *p = a, *q = b;
    return (p->x > q->x) - (p->x < q->x);
}

static int line_cross(const double *a, const double *b, double y, struct crossing *out)
{
    if ((a[1] <= y) == (b[1] <= y))
        return 0;
    *out = (struct crossing){a[0] + (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]),
                             b[1] > a[1] ? 1 : -1};
    return 1;
}

static int curve_cross(const double *a, const double *b, const double *c, double y,
                       struct crossing *out)
{
    double p = a[1] - 2 * b[1] + c[1], q = b[1] - a[1], r = a[1] - y, square = q * q - p * r;
    double at[2];
    int signs[2], roots = 0, count = 0;
    if (fmax(fmax(a[1], b[1]), c[1]) < y || fmin(fmin(a[1], b[1]), c[1]) > y)
        return 0;
    if (fabs(p) < 1e-9) { /* y changes evenly, x does not */
        at[roots] = q != 0 ? -r / (2 * q) : -1;
        signs[roots++] = q > 0 ? 1 : -1;
    } else if (square > 0) {
        for (int sign = -1; sign <= 1; sign += 2) {
            at[roots] = (-q + sign * sqrt(square)) / p;
            signs[roots++] = sign;
        }
    }
    for (int i = 0; i < roots; i++) {
        double t = at[i], u = 1 - t;
        if (t >= 0 && t < 1)
            out[count++] =
                (struct crossing){u * u * a[0] + 2 * u * t * b[0] + t * t * c[0], signs[i]};
    }
    return count;
}

static int tangle_cross(const struct tangle *t, double y, struct crossing *out)
{
    int n = 0;
    for (int c = 0; c < t->contours; c++) {
        int first = t->starts[c], count = t->starts[c + 1] - first, step = t->curves ? 2 : 1;
        for (int k = 0; k < count; k += step) {
            const double *a = t->points[first + k];
            const double *b = t->points[first + (k + 1) % count];
            n += t->curves ? curve_cross(a, b, t->points[first + (k + 2) % count], y, out + n)
                           : line_cross(a, b, y, out + n);
        }
    }
    qsort(out, (size_t)n, sizeof *out, crossings_compare);
    return n;
}

static void span_add(double *row, int width, double from, double to)
{
    from = fmax(0, from);
    to = fmin(width, to);
    for (int x = (int)from; x < width && x < to; x++)
        row[x] += (fmin(to, x + 1) - fmax(from, x)) / LINES_A_ROW;
}

/* Pixels from the origin on, of the row that is `down` pixels below the top of the em. */
static void row_true(const struct tangle *t, double size_px, int down, double *row, int width,
                     struct crossing *crossings)
{
    double scale = size_px / EM;
    for (int x = 0; x < width; x++)
        row[x] = 0;
    for (int k = 0; k < LINES_A_ROW; k++) {
        double y = (size_px - down - (k + 0.5) / LINES_A_ROW) / scale;
        int n = tangle_cross(t, y, crossings), winding = 0;
        for (int i = 0; i + 1 < n; i++) {
            winding += crossings[i].direction;
            if (t->rule == FONT_NONZERO ? winding != 0 : winding & 1)
                span_add(row, width, crossings[i].x * scale, crossings[i + 1].x * scale);
        }
    }
}

/* ---- the pipeline ---- */

static void tangle_outline(const struct tangle *t, struct font_outline *o)
{
    *o = (struct font_outline){.units_per_em = EM, .advance = EM};
    for (int c = 0; c < t->contours; c++) {
        int first = t->starts[c], count = t->starts[c + 1] - first;
        assert_font(font_outline_move(o, t->points[first][0], t->points[first][1]));
        for (int k = 1; k < count; k++) {
            const double *p = t->points[first + k], *q = t->points[first + (k + 1) % count];
            if (!t->curves)
                assert_font(font_outline_line(o, p[0], p[1]));
            else if (k & 1)
                assert_font(font_outline_quad(o, p[0], p[1], q[0], q[1]));
        }
        assert_font(font_outline_close(o));
    }
}

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* The most by which some rows of the picture are from the truth, of 255. */
static double worst_of(const struct tangle *t, const struct font_outline *o, double size_px,
                       uint32_t *seed)
{
    struct font_filter *box;
    struct font_edges edges = {0};
    struct font_gray gray = {0};
    struct font_map map = font_map_size(size_px, EM);
    int size = (int)size_px;
    double *row = malloc(((size_t)size + 1) * sizeof *row), worst = 0;
    struct crossing *crossings = malloc((2 * (size_t)t->count + 2) * sizeof *crossings);
    assert_true(row && crossings);
    assert_font(font_filter_create_named("box", &box));
    double before = seconds();
    assert_font(font_edges_build(&edges, o, &map, box));
    assert_font(font_gray_draw(&gray, &edges, box, 0, 0));
    double took = seconds() - before;
    for (int r = 0; r < rows_of(size_px); r++) {
        int down = (int)(size * random_unit(seed));
        row_true(t, size_px, down, row, size, crossings);
        for (int x = 0; x < size; x++) {
            int left = x - gray.left_px, top = down - size - gray.top_px;
            bool in = left >= 0 && top >= 0 && left < gray.width_px && top < gray.height_px;
            double have = in ? gray.pixels[(size_t)top * (size_t)gray.pitch + (size_t)left] : 0;
            worst = fmax(worst, fabs(have - 255 * row[x]));
        }
    }
    print_message("    %4.0f px: %.2f of 255, %.3f s\n", size_px, worst, took);
    free(row);
    free(crossings);
    font_gray_finish(&gray);
    font_edges_finish(&edges);
    font_filter_destroy(box);
    return worst;
}

/* Prepares it, and compares it at several sizes, but for those that are slow. Finishes the
 * tangle. */
static void tangle_check(const char *name, struct tangle *t, const double *bounds,
                         const bool *slow, uint32_t *seed)
{
    static const double sizes[] = {12, 60, 400};
    struct font_outline o;
    tangle_outline(t, &o);
    double before = seconds();
    assert_font(font_outline_prepare(&o, t->rule));
    print_message("%s: %d points, %s, %d segments, %d crossings, %.3f s\n", name, t->count,
                  o.tangled   ? "tangled"
                  : o.rebuilt ? "rebuilt"
                              : "as it was",
                  o.segments_count, o.crossings, seconds() - before);
    for (int i = 0; i < 3; i++) {
        if (o.tangled && slow[i] && !getenv("LUTETIA_TANGLED_ROWS"))
            continue;
        double worst = worst_of(t, &o, sizes[i], seed);
        if (!(worst <= bounds[i]))
            fail_msg("%s at %g px: %.2f of 255 from the truth, %.2f allowed", name, sizes[i],
                     worst, bounds[i]);
    }
    font_outline_finish(&o);
    tangle_free(t);
}

static void points_random(struct tangle *t, double reach, bool whole, uint32_t *seed)
{
    for (int i = 0; i < t->count; i++)
        for (int k = 0; k < 2; k++) {
            double from = i && reach < EM ? t->points[i - 1][k] : EM / 2;
            double p = from + reach * (random_unit(seed) - 0.5);
            p = fmin(fmax(p, 0), EM);
            t->points[i][k] = whole ? floor(p) : p;
        }
}

static void random_contours_are_right_to_one(void **state)
{
    (void)state;
    static const struct {
        int points, contours;
        bool curves, whole;
        double reach;
        enum font_fill rule;
        double bounds[3];
        bool slow[3];
    } cases[] = {
        {800, 1, true, true, EM, FONT_NONZERO, {1, 1, 1}, {false}},
        {800, 1, true, false, EM, FONT_EVEN_ODD, {1, 1, 1}, {false}},
        {2000, 7, false, true, EM, FONT_NONZERO, {1, 1, 1}, {false}},
        {10000, 1, false, false, 30, FONT_NONZERO, {1, 1, 1}, {false}},
        {10000, 1, true, true, EM, FONT_NONZERO, {1, 1, 6}, {false, true, false}},
        {10000, 1, false, true, EM, FONT_NONZERO, {1, 1, 6}, {true, false, true}},
    };
    uint32_t seed = 37;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct tangle t =
            tangle_new(cases[i].points, cases[i].contours, cases[i].curves, cases[i].rule);
        points_random(&t, cases[i].reach, cases[i].whole, &seed);
        tangle_check(cases[i].rule == FONT_NONZERO ? "random" : "random, even-odd", &t,
                     cases[i].bounds, cases[i].slow, &seed);
    }
}

/* Discs and bars of fonts: contours that overlap, many of them at once; all of one direction,
 * or of both. */
static void overlapping_pieces_are_right_to_one(void **state)
{
    (void)state;
    static const double one[] = {1, 1, 1};
    static const bool slow[] = {false, false, true};
    uint32_t seed = 425;
    struct tangle discs = tangle_new(425 * 16, 425, true, FONT_NONZERO);
    for (int c = 0; c < 425; c++) {
        double x = 60 + 880 * random_unit(&seed), y = 60 + 880 * random_unit(&seed);
        double radius = 10 + 50 * random_unit(&seed);
        int direction = c % 3 ? 1 : -1;
        for (int k = 0; k < 16; k++) {
            double far = k & 1 ? radius / cos(M_PI / 8) : radius;
            discs.points[16 * c + k][0] = rint(x + far * cos(direction * M_PI * k / 8));
            discs.points[16 * c + k][1] = rint(y + far * sin(direction * M_PI * k / 8));
        }
    }
    tangle_check("discs", &discs, one, slow, &seed);
    struct tangle bars = tangle_new(2500 * 4, 2500, false, FONT_NONZERO);
    for (int c = 0; c < 2500;
         c++) { /* half of them lie, so that edges of pixels see their height */
        bool lies = c & 1;
        double at = floor(990 * random_unit(&seed)), lean = lies ? 0 : 200 * random_unit(&seed);
        const double corners[4][2] = {
            {at, 0}, {at + 1 + c % 3, 0}, {at + 1 + c % 3 - lean, 1000}, {at - lean, 1000}};
        for (int k = 0; k < 4; k++) {
            bars.points[4 * c + k][0] = corners[k][lies] * (lies ? 0.3 : 1);
            bars.points[4 * c + k][1] = corners[k][!lies];
        }
    }
    tangle_check("bars", &bars, one, slow, &seed);
    struct tangle star = tangle_new(10000, 1, false, FONT_NONZERO);
    for (int i = 0; i < 10000; i++) {
        double radius = i & 1 ? 300 : 490;
        star.points[i][0] = rint(500 + radius * cos(2 * M_PI * i / 10000));
        star.points[i][1] = rint(500 + radius * sin(2 * M_PI * i / 10000));
    }
    tangle_check("star", &star, one, slow, &seed);
}

/* What a master has black, in pixels. */
static double master_ink(const struct font_outline *o)
{
    struct font_master m = {0};
    assert_font(font_master_make(&m, o, 600));
    double ink = (double)font_master_ink(&m);
    font_master_finish(&m);
    return ink;
}

/* The slow twin: an outline whose boundary can be made, filled where it is drawn all the
 * same. */
static void boundaries_and_strips_agree(void **state)
{
    (void)state;
    uint32_t seed = 2026;
    for (int n = 0; n < 7; n++) {
        struct tangle t =
            tangle_new(100 + 40 * n, 1 + n % 5, n & 1, n % 3 ? FONT_NONZERO : FONT_EVEN_ODD);
        struct font_outline o, strips;
        points_random(&t, n & 2 ? EM : 300, n & 4, &seed);
        tangle_outline(&t, &o);
        tangle_outline(&t, &strips);
        assert_font(font_outline_prepare(&o, t.rule));
        assert_true(o.rebuilt && !o.tangled);
        strips.box = font_outline_box(&strips);
        strips.rule = t.rule;
        strips.turn = 1;
        strips.tangled = strips.prepared = true;
        double ink = master_ink(&o), ink_by_strips = master_ink(&strips);
        if (fabs(ink - ink_by_strips) > 1e-3 * ink + 5)
            fail_msg("tangle %d: masters of %.0f and %.0f pixels", n, ink, ink_by_strips);
        if (worst_of(&t, &strips, 30 + 20 * n, &seed) > 1.2)
            fail_msg("tangle %d: strips are wrong", n);
        font_outline_finish(&o);
        font_outline_finish(&strips);
        tangle_free(&t);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_contours_are_right_to_one),
        cmocka_unit_test(overlapping_pieces_are_right_to_one),
        cmocka_unit_test(boundaries_and_strips_agree),
    };
    return cmocka_run_group_tests_name("tangled", tests, NULL, NULL);
}
