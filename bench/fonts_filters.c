/* fonts_filters.c - see fonts_filters.h.
 *
 * The contenders of a size and a face run alternately. A run's time is the thread's
 * processor time, so that other load has little influence. A run draws the letters as often
 * as takes about a millisecond.
 */
#include "fonts_filters.h"
#include "fonts_first.h"
#include "fonts_peers.h"

#include <edges.h>
#include <face.h>
#include <filter.h>
#include <gold.h>
#include <gray.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum {
    LETTERS = 94,
    FACES = 5,
    SIZES = 4,
    FILTERS_MAX = 16,
    TURNS = 9,
    CONTENDERS_MAX = 2 * FILTERS_MAX + 2
};

static const char *const faces[FACES] = {"DejaVuSans", "DejaVuSerif-Bold",
                                         "EBGaramond12-Italic", "NimbusSans-Regular.otf",
                                         "C059-Roman.otf"};
static const struct {
    const char *name;
    double px;
} sizes[SIZES] = {{"12.25 px", 12.25}, {"24 px", 24}, {"72 px", 72}, {"200 px", 200}};

struct contest {
    struct font_face *face;
    struct font_outline outlines[LETTERS];
    uint32_t glyphs[LETTERS];
    double units, x[LETTERS], y[LETTERS];
    struct font_map map;
    struct font_filter *filters[FILTERS_MAX];
    int filters_count;
    struct font_edges kept[FILTERS_MAX][LETTERS], scratch;
    struct font_gray gray, picture;
    struct peer_freetype *freetype;
    struct peer_stb *stb;
};

/* One way to draw all letters. filter: its number; -1 for a peer. */
struct contender {
    char what[32];
    int filter;
    bool (*draw)(struct contest *c, int filter, int letter);
    int rounds;
    double turns[TURNS];
};

/* Sums over all faces of a size. */
struct totals {
    struct bench_sample seconds[CONTENDERS_MAX]; /* for a glyph of each face */
    double least[FILTERS_MAX], error[FILTERS_MAX];
    int faces_count;
};

static bool font_wrong(void)
{
    return bench_fail("%s", font_error());
}

static bool outline_draw(struct contest *c, int filter, int i)
{
    const struct font_filter *f = c->filters[filter];
    return (font_edges_build(&c->scratch, &c->outlines[i], &c->map, f) == FONT_OK &&
            font_gray_draw(&c->gray, &c->scratch, f, c->x[i], c->y[i]) == FONT_OK) ||
           font_wrong();
}

static bool kept_draw(struct contest *c, int filter, int i)
{
    return font_gray_draw(&c->gray, &c->kept[filter][i], c->filters[filter], c->x[i],
                          c->y[i]) == FONT_OK ||
           font_wrong();
}

static bool freetype_draw(struct contest *c, int filter, int i)
{
    (void)filter;
    return peer_freetype_draw(c->freetype, c->glyphs[i], c->x[i], c->y[i], &c->picture) ||
           bench_fail("FreeType failed");
}

static bool stb_draw(struct contest *c, int filter, int i)
{
    (void)filter;
    return peer_stb_draw(c->stb, c->glyphs[i], c->x[i], c->y[i], &c->picture) ||
           bench_fail("stb_truetype failed");
}

static void face_finish(struct contest *c)
{
    for (int i = 0; i < LETTERS; i++)
        font_outline_finish(&c->outlines[i]);
    font_face_close(c->face);
    c->face = NULL;
}

static bool face_open(struct contest *c, const char *name)
{
    struct font_face_info info;
    if (font_face_open(name, 0, &c->face) != FONT_OK)
        return font_wrong();
    font_face_describe(c->face, &info);
    c->units = info.units_per_em;
    for (int i = 0; i < LETTERS; i++) {
        c->glyphs[i] = font_face_glyph(c->face, 33 + (uint32_t)i);
        c->x[i] = i * 7 % 16 / 16.0;
        c->y[i] = i * 5 % 16 / 16.0;
        if (font_face_outline(c->face, c->glyphs[i], &c->outlines[i]) != FONT_OK)
            return font_wrong();
    }
    return true;
}

static bool size_begin(struct contest *c, double px)
{
    size_t bytes_count;
    const void *bytes = font_face_bytes(c->face, &bytes_count);
    c->map = font_map_size(px, c->units);
    peer_freetype_destroy(c->freetype);
    peer_stb_destroy(c->stb);
    c->freetype = peer_freetype_create(bytes, bytes_count, px);
    c->stb = peer_stb_create(bytes, px);
    if (!c->freetype || !c->stb)
        return bench_fail("FreeType or stb_truetype cannot read the font");
    for (int f = 0; f < c->filters_count; f++)
        for (int i = 0; i < LETTERS; i++)
            if (font_edges_build(&c->kept[f][i], &c->outlines[i], &c->map, c->filters[f]) !=
                FONT_OK)
                return font_wrong();
    return true;
}

/* Finds the largest difference from gold for a few letters: gold takes milliseconds. */
static bool error_find(struct contest *c, int filter, double px, double *worst)
{
    const struct font_filter *f = c->filters[filter];
    struct font_difference sum = {0};
    for (int i = filter; i<LETTERS; i += px> 100 ? 31 : 11) {
        if (!outline_draw(c, filter, i))
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

static bool turn(struct contest *c, struct contender *k, int rounds, double *seconds)
{
    double began_s = bench_thread_s();
    for (int round = 0; round < rounds; round++)
        for (int i = 0; i < LETTERS; i++)
            if (!k->draw(c, k->filter, i))
                return false;
    *seconds = (bench_thread_s() - began_s) / rounds;
    return true;
}

static bool contend(struct contest *c, struct contender *all, int count)
{
    for (int k = 0; k < count; k++) {
        double seconds;
        if (!turn(c, &all[k], 1, &seconds) || !turn(c, &all[k], 1, &seconds))
            return false;
        all[k].rounds = 1 + (int)fmin(20, 1e-3 / fmax(seconds, 1e-6));
    }
    for (int i = 0; i < bench_many(TURNS, 1); i++)
        for (int k = 0; k < count; k++)
            if (!turn(c, &all[k], all[k].rounds, &all[k].turns[i]))
                return false;
    return true;
}

static int contenders_make(const struct contest *c, struct contender *all)
{
    int count = 0;
    all[count++] = (struct contender){.what = "freetype", .filter = -1, .draw = freetype_draw};
    all[count++] = (struct contender){.what = "stb_truetype", .filter = -1, .draw = stb_draw};
    for (int f = 0; f < c->filters_count; f++) {
        struct font_filter_info info;
        font_filter_describe(c->filters[f], &info);
        all[count] = (struct contender){.filter = f, .draw = outline_draw};
        snprintf(all[count++].what, sizeof all->what, "%.31s", info.name);
        all[count] = (struct contender){.filter = f, .draw = kept_draw};
        snprintf(all[count++].what, sizeof all->what, "%.19s, kept edges", info.name);
    }
    return count;
}

static bool face_run(struct contest *c, const char *name, int s, struct totals *t)
{
    static struct contender all[CONTENDERS_MAX];
    int count = contenders_make(c, all);
    if (!face_open(c, name) || !size_begin(c, sizes[s].px))
        return false;
    for (int f = 0; f < c->filters_count; f++)
        if (!error_find(c, f, sizes[s].px, &t->error[f]))
            return false;
    if (!contend(c, all, count))
        return false;
    double yardstick = 0;
    for (int k = 0; k < count; k++) {
        struct bench_sample one = bench_sample_of(all[k].turns, bench_many(TURNS, 1));
        t->seconds[k].median += one.median / LETTERS;
        t->seconds[k].min += one.min / LETTERS;
        if (k == 0)
            yardstick = one.min;
        if (all[k].draw == outline_draw) {
            double *least = &t->least[all[k].filter], times = yardstick / one.min;
            *least = t->faces_count == 0 ? times : fmin(*least, times);
        }
    }
    t->faces_count++;
    face_finish(c);
    return true;
}

static void number_add(struct bench_report *r, const char *what, const char *more,
                       const char *of_case, double value, const char *unit)
{
    char name[32];
    snprintf(name, sizeof name, "%.15s, %s", what, more);
    bench_report_add(r, name, of_case, (struct bench_sample){value, value}, 1, unit);
}

static bool size_run(struct contest *c, const char *font, int s, struct bench_report *r)
{
    struct totals t = {.faces_count = 0};
    struct contender all[CONTENDERS_MAX];
    for (int i = 0; i < (font ? 1 : FACES); i++)
        if (!face_run(c, font ? font : faces[i], s, &t))
            return false;
    int count = contenders_make(c, all);
    for (int k = 0; k < count; k++) {
        struct bench_sample rate = {t.faces_count / t.seconds[k].median,
                                    t.faces_count / t.seconds[k].min};
        bench_report_add(r, all[k].what, sizes[s].name, rate, 1, "glyphs/s");
        if (all[k].draw == outline_draw) {
            number_add(r, all[k].what, "slowest face", sizes[s].name, t.least[all[k].filter],
                       "x freetype");
            number_add(r, all[k].what, "max error", sizes[s].name, t.error[all[k].filter],
                       "/255");
        }
    }
    return true;
}

static bool filters_open(struct contest *c, const char *filter)
{
    const char *const one[] = {filter, NULL}, *const *names =
                                                  filter ? one : font_filter_names();
    for (; *names && c->filters_count < FILTERS_MAX; names++)
        if (font_filter_create_named(*names, &c->filters[c->filters_count++]) != FONT_OK)
            return font_wrong();
    return true;
}

bool fonts_filters_run(const char *font, const char *filter, bool quick,
                       struct bench_report *report)
{
    struct contest *c = calloc(1, sizeof *c);
    if (!c)
        return bench_fail("no memory");
    bench_report_init(report, "fonts", 1, font_simd_name(font_simd_use(FONT_SIMD_AVX512)));
    bool ok = filters_open(c, filter);
    for (int s = 0; ok && s < (quick ? 1 : SIZES); s++)
        ok = size_run(c, font, s, report);
    for (int i = 0; ok && i < (font ? 1 : FACES); i++)
        ok = fonts_first_run(font ? font : faces[i], report);
    if (ok)
        bench_report_print(report, "freetype", stdout);
    if (c->face)
        face_finish(c);
    for (int f = 0; f < c->filters_count; f++) {
        for (int i = 0; i < LETTERS; i++)
            font_edges_finish(&c->kept[f][i]);
        font_filter_destroy(c->filters[f]);
    }
    font_edges_finish(&c->scratch);
    font_gray_finish(&c->gray);
    peer_freetype_destroy(c->freetype);
    peer_stb_destroy(c->stb);
    free(c);
    return ok;
}
