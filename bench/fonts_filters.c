/* fonts_filters.c - see fonts_filters.h. */
#include "fonts_filters.h"
#include "fonts_contest.h"
#include "fonts_first.h"
#include "fonts_raster.h"

#include <gold.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { SIZES = 4, CONTENDERS_MAX = 2 * FONTS_FILTERS_MAX + 2 };

static const struct {
    const char *name;
    double px;
} sizes[SIZES] = {{"12.25 px", 12.25}, {"24 px", 24}, {"72 px", 72}, {"200 px", 200}};

/* Sums over all faces of a size. */
struct totals {
    struct bench_sample seconds[CONTENDERS_MAX]; /* for a glyph of each face */
    double least[FONTS_FILTERS_MAX], error[FONTS_FILTERS_MAX];
    int faces_count;
};

static bool font_wrong(void)
{
    return bench_fail("%s", font_error());
}

/* Finds the largest difference from gold for a few letters: gold takes milliseconds. */
static bool error_find(struct fonts_contest *c, int filter, double px, double *worst)
{
    const struct font_filter *f = c->filters[filter];
    struct font_difference sum = {0};
    for (int i = filter; i<FONTS_LETTERS; i += px> 100 ? 31 : 11) {
        if (!fonts_outline_draw(c, filter, i))
            return false;
        int left = c->gray.left_px - 1, top = c->gray.top_px - 1;
        int width = c->gray.width_px + 2, height = c->gray.height_px + 2;
        double *gold = malloc(sizeof *gold * (size_t)width * (size_t)height);
        bool ok = gold && font_gold_draw(&c->outlines[i], &c->map, f, c->x[i], c->y[i], left,
                                         top, width, height, gold) == FONT_OK;
        if (ok)
            font_gold_compare(&c->gray, false, left, top, width, height, gold, &sum);
        free(gold);
        if (!ok)
            return gold ? font_wrong() : bench_fail("no memory");
    }
    *worst = fmax(*worst, sum.max);
    return true;
}

static int contenders_make(const struct fonts_contest *c, struct fonts_contender *all)
{
    int count = 0;
    all[count++] =
        (struct fonts_contender){.what = "freetype", .filter = -1, .draw = fonts_freetype_draw};
    all[count++] =
        (struct fonts_contender){.what = "stb_truetype", .filter = -1, .draw = fonts_stb_draw};
    for (int f = 0; f < c->filters_count; f++) {
        struct font_filter_info info;
        font_filter_describe(c->filters[f], &info);
        all[count] = (struct fonts_contender){.filter = f, .draw = fonts_outline_draw};
        snprintf(all[count++].what, sizeof all->what, "%.31s", info.name);
        all[count] = (struct fonts_contender){.filter = f, .draw = fonts_kept_draw};
        snprintf(all[count++].what, sizeof all->what, "%.19s, kept edges", info.name);
    }
    return count;
}

static bool face_run(struct fonts_contest *c, const char *name, int s, struct totals *t)
{
    static struct fonts_contender all[CONTENDERS_MAX];
    int count = contenders_make(c, all);
    if (!fonts_contest_open(c, name) || !fonts_contest_size(c, sizes[s].px))
        return false;
    for (int f = 0; f < c->filters_count; f++)
        if (!error_find(c, f, sizes[s].px, &t->error[f]))
            return false;
    if (!fonts_contend(c, all, count))
        return false;
    double yardstick = 0;
    for (int k = 0; k < count; k++) {
        struct bench_sample one = all[k].seconds;
        t->seconds[k].median += one.median / FONTS_LETTERS;
        t->seconds[k].min += one.min / FONTS_LETTERS;
        if (k == 0)
            yardstick = one.min;
        if (all[k].draw == fonts_outline_draw) {
            double *least = &t->least[all[k].filter], times = yardstick / one.min;
            *least = t->faces_count == 0 ? times : fmin(*least, times);
        }
    }
    t->faces_count++;
    return true;
}

static void number_add(struct bench_report *r, const char *what, const char *more,
                       const char *of_case, double value, const char *unit)
{
    char name[32];
    snprintf(name, sizeof name, "%.15s, %s", what, more);
    bench_report_add(r, name, of_case, (struct bench_sample){value, value}, 1, unit);
}

static bool size_run(struct fonts_contest *c, const char *font, int s, struct bench_report *r)
{
    struct totals t = {.faces_count = 0};
    struct fonts_contender all[CONTENDERS_MAX];
    for (int i = 0; i < (font ? 1 : FONTS_FACES); i++)
        if (!face_run(c, font ? font : fonts_faces[i], s, &t))
            return false;
    int count = contenders_make(c, all);
    for (int k = 0; k < count; k++) {
        struct bench_sample rate = {t.faces_count / t.seconds[k].median,
                                    t.faces_count / t.seconds[k].min};
        bench_report_add(r, all[k].what, sizes[s].name, rate, 1, "glyphs/s");
        if (all[k].draw == fonts_outline_draw) {
            number_add(r, all[k].what, "slowest face", sizes[s].name, t.least[all[k].filter],
                       "x freetype");
            number_add(r, all[k].what, "max error", sizes[s].name, t.error[all[k].filter],
                       "/255");
        }
    }
    return true;
}

static bool filters_open(struct fonts_contest *c, const char *filter)
{
    const char *const one[] = {filter, NULL}, *const *names =
                                                  filter ? one : font_filter_names();
    for (; *names && c->filters_count < FONTS_FILTERS_MAX; names++)
        if (!fonts_contest_filter(c, *names))
            return false;
    return true;
}

bool fonts_filters_run(const char *font, const char *filter, bool quick,
                       struct bench_report *report)
{
    struct fonts_contest *c = calloc(1, sizeof *c);
    if (!c)
        return bench_fail("no memory");
    bench_report_init(report, "fonts", 1, font_simd_name(font_simd_use(FONT_SIMD_AVX512)));
    bool ok = filters_open(c, filter);
    for (int s = 0; ok && s < (quick ? 1 : SIZES); s++)
        ok = size_run(c, font, s, report);
    for (int i = 0; ok && i < (font ? 1 : FONTS_FACES); i++)
        ok = fonts_first_run(font ? font : fonts_faces[i], report);
    fonts_contest_destroy(c);
    if (ok)
        bench_report_print(report, "freetype", stdout);
    return ok && fonts_raster_run(font, filter, quick, report);
}
