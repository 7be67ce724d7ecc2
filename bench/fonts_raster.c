/* fonts_raster.c - see fonts_raster.h. */
#include "fonts_raster.h"
#include "fonts_contest.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { SIZES = 8, FILTERS = 3, CONTENDERS_MAX = 2 + 3 * FILTERS };

static const double sizes_px[SIZES] = {10, 12.25, 16, 24, 32, 72, 200, 400};
static const char *const usual[FILTERS] = {"box", "pillbox", "gaussian-fast"};
static const char yardstick[] = "freetype raster";

/* Of a size, over all faces. */
struct totals {
    struct fonts_contender all[CONTENDERS_MAX];
    struct bench_sample seconds[CONTENDERS_MAX];
    double least[CONTENDERS_MAX]; /* times as many as FreeType draws, of the slowest face */
    int count, faces_count;
};

static void contender_add(struct totals *t, const char *what, const char *more, int filter,
                          bool (*draw)(struct fonts_contest *, int, int))
{
    struct fonts_contender *k = &t->all[t->count];
    *k = (struct fonts_contender){.filter = filter, .draw = draw};
    snprintf(k->what, sizeof k->what, "%.18s%s", what, more);
    t->count++;
}

/* from_file: of the fonts' bytes, not of outlines. */
static void contenders_make(const struct fonts_contest *c, bool from_file, struct totals *t)
{
    contender_add(t, yardstick, "", -1, from_file ? fonts_freetype_draw : fonts_raster_draw);
    for (int f = 0; f < c->filters_count; f++) {
        struct font_filter_info info;
        font_filter_describe(c->filters[f], &info);
        contender_add(t, info.name, "", f, from_file ? fonts_file_draw : fonts_kept_draw);
        if (!from_file)
            contender_add(t, info.name, ", scaled too", f, fonts_outline_draw);
    }
}

static bool face_run(struct fonts_contest *c, const char *font, double px, struct totals *t)
{
    if (!fonts_contest_open(c, font) || !fonts_contest_size(c, px) ||
        !fonts_contend(c, t->all, t->count))
        return false;
    for (int k = 0; k < t->count; k++) {
        const struct bench_sample *one = &t->all[k].seconds;
        double times = t->all[0].seconds.median / one->median;
        t->seconds[k].median += one->median / FONTS_LETTERS;
        t->seconds[k].min += one->min / FONTS_LETTERS;
        t->least[k] = t->faces_count ? fmin(t->least[k], times) : times;
    }
    t->faces_count++;
    return true;
}

static bool size_run(struct fonts_contest *c, const char *font, double px, bool from_file,
                     struct bench_report *r)
{
    struct totals t = {.count = 0};
    char of_case[32], name[48];
    snprintf(of_case, sizeof of_case, "%s%g px", from_file ? "from file, " : "outline, ", px);
    contenders_make(c, from_file, &t);
    for (int i = 0; i < (font ? 1 : FONTS_FACES); i++)
        if (!face_run(c, font ? font : fonts_faces[i], px, &t))
            return false;
    for (int k = 0; k < t.count; k++) {
        struct bench_sample rate = {t.faces_count / t.seconds[k].median,
                                    t.faces_count / t.seconds[k].min};
        bench_report_add(r, t.all[k].what, of_case, rate, 1, "glyphs/s");
        if (t.all[k].filter < 0 || t.all[k].draw == fonts_outline_draw)
            continue;
        snprintf(name, sizeof name, "%.15s, slowest face", t.all[k].what);
        bench_report_add(r, name, of_case, (struct bench_sample){t.least[k], t.least[k]}, 1,
                         "x freetype");
    }
    return true;
}

static void rows_copy(const struct bench_report *from, struct bench_report *to)
{
    for (int i = 0; i < from->rows_count; i++) {
        const struct bench_row *row = &from->rows[i];
        bench_report_add(to, row->what, row->of_case,
                         (struct bench_sample){row->value, row->min}, 1, row->unit);
    }
}

bool fonts_raster_run(const char *font, const char *filter, bool quick,
                      struct bench_report *report)
{
    static struct bench_report own;
    struct fonts_contest *c = calloc(1, sizeof *c);
    if (!c)
        return bench_fail("no memory");
    bench_report_init(&own, "fonts", report->threads_count, report->device);
    bool ok = true;
    for (int f = 0; ok && f < (filter ? 1 : FILTERS); f++)
        ok = fonts_contest_filter(c, filter ? filter : usual[f]);
    for (int s = 0; ok && s < SIZES; s++)
        if (!quick || sizes_px[s] == 12.25)
            ok = size_run(c, font, sizes_px[s], false, &own);
    for (int s = 0; ok && s < SIZES; s++)
        if (sizes_px[s] == 12.25 || (!quick && sizes_px[s] == 72))
            ok = size_run(c, font, sizes_px[s], true, &own);
    fonts_contest_destroy(c);
    if (ok) {
        puts(
            "\nLike beside like. outline: FreeType's raster alone, of scaled outlines in "
            "memory, and kept edges,\nwhich are that here (\"scaled too\": of outlines in font "
            "units). from file: from the font's bytes to\nthe picture, by both, as when a "
            "glyph is drawn for the first time.\n");
        bench_report_print(&own, yardstick, stdout);
        rows_copy(&own, report);
    }
    return ok;
}
