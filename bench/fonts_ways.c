/* fonts_ways.c - see fonts_ways.h: glyphs a second and how exact they are, beside FreeType,
 * stb_truetype and direct filtering, in one run on one thread. All results are first
 * compared with gold: ours with the filter that is drawn, peers with the box, which is their
 * only filter. The contenders of a case run alternately. */
#include "fonts_ways.h"
#include "fonts_peers.h"

#include <edges.h>
#include <face.h>
#include <gold.h>
#include <gray.h>
#include <many.h>
#include <master.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LETTERS = 94, PAGE = 5000, SIZES = 40, TURNS = 61, WORK_MAX = 24 };

struct place {
    int letter;
    double x, y;
};

struct fonts {
    struct font_face *face;
    const void *bytes;
    size_t bytes_count;
    struct font_filter *filter, *box;
    struct font_outline outlines[LETTERS];
    uint32_t glyphs[LETTERS];
    double units;
    /* Of the case at hand. */
    double size_px;
    struct font_map map;
    struct font_edges edges[LETTERS], master_edges[LETTERS];
    struct font_master masters[LETTERS];
    struct place places[PAGE];
    int places_count, rounds;
    struct font_gray gray, picture;
    struct font_edges scratch;
    struct peer_freetype *freetype;
    struct peer_stb *stb;
    struct peer_direct *direct;
    struct font_many *many;
    struct font_many_job *jobs;
    int jobs_count;
    bool page;
};

/* A way to draw: sets *gray to the picture of places[i]. */
typedef bool draw_one(struct fonts *f, int i, const struct font_gray **gray);

static bool font_wrong(void)
{
    return bench_fail("%s", font_error());
}

static bool cached_edges(struct fonts *f, int i, const struct font_gray **gray)
{
    const struct place *p = &f->places[i];
    *gray = &f->gray;
    return font_gray_draw(&f->gray, &f->edges[p->letter], f->filter, p->x, p->y) == FONT_OK ||
           font_wrong();
}

static bool from_outlines(struct fonts *f, int i, const struct font_gray **gray)
{
    const struct place *p = &f->places[i];
    *gray = &f->gray;
    return (font_edges_build(&f->scratch, &f->outlines[p->letter], &f->map, f->filter) ==
                FONT_OK &&
            font_gray_draw(&f->gray, &f->scratch, f->filter, p->x, p->y) == FONT_OK) ||
           font_wrong();
}

/* Includes reading the font's file: FreeType reads the outline, and overlaps are removed. */
static bool from_file(struct fonts *f, int i, const struct font_gray **gray)
{
    const struct place *p = &f->places[i];
    struct font_outline outline;
    *gray = &f->gray;
    bool ok = font_face_outline(f->face, f->glyphs[p->letter], &outline) == FONT_OK &&
              font_edges_build(&f->scratch, &outline, &f->map, f->filter) == FONT_OK &&
              font_gray_draw(&f->gray, &f->scratch, f->filter, p->x, p->y) == FONT_OK;
    font_outline_finish(&outline);
    return ok || font_wrong();
}

static bool master_rectangles(struct fonts *f, int i, const struct font_gray **gray)
{
    const struct place *p = &f->places[i];
    *gray = &f->gray;
    return font_gray_draw(&f->gray, &f->master_edges[p->letter], f->filter, p->x, p->y) ==
               FONT_OK ||
           font_wrong();
}

static bool freetype(struct fonts *f, int i, const struct font_gray **gray)
{
    const struct place *p = &f->places[i];
    *gray = &f->picture;
    return peer_freetype_draw(f->freetype, f->glyphs[p->letter], p->x, p->y, &f->picture) ||
           bench_fail("FreeType failed");
}

static bool freetype_raster(struct fonts *f, int i, const struct font_gray **gray)
{
    *gray = &f->picture;
    return peer_freetype_raster(f->freetype, f->places[i].letter, &f->picture) ||
           bench_fail("FreeType failed");
}

static bool stb_truetype(struct fonts *f, int i, const struct font_gray **gray)
{
    const struct place *p = &f->places[i];
    *gray = &f->picture;
    return peer_stb_draw(f->stb, f->glyphs[p->letter], p->x, p->y, &f->picture) ||
           bench_fail("stb_truetype failed");
}

static bool direct(struct fonts *f, int i, const struct font_gray **gray)
{
    const struct place *p = &f->places[i];
    *gray = &f->picture;
    return peer_direct_draw(f->direct, &f->masters[p->letter], f->size_px, p->x, p->y,
                            &f->picture) ||
           bench_fail("no memory");
}

static const struct way {
    const char *what;
    draw_one *draw;
    enum font_simd simd;
    bool box, slow, no_page;
} ways[] = {
    {"cached edges", cached_edges, FONT_SIMD_AVX512, false, false, false},
    {"cached edges, AVX2", cached_edges, FONT_SIMD_AVX2, false, false, false},
    {"cached edges, plain C", cached_edges, FONT_SIMD_PLAIN, false, false, false},
    {"from outlines", from_outlines, FONT_SIMD_AVX512, false, false, false},
    {"from file", from_file, FONT_SIMD_AVX512, false, false, false},
    {"master rectangles", master_rectangles, FONT_SIMD_AVX512, false, false, false},
    {"freetype", freetype, FONT_SIMD_AVX512, true, false, false},
    {"freetype raster", freetype_raster, FONT_SIMD_AVX512, true, false, true},
    {"stb_truetype", stb_truetype, FONT_SIMD_AVX512, true, false, false},
    {"direct", direct, FONT_SIMD_AVX512, false, true, true},
};
enum { WAYS = sizeof ways / sizeof *ways };

/* ---- exactness ---- */

/* Adds a picture's difference from gold of the same filter; gold_bytes (may be NULL): and
 * gold's own bytes'. */
static bool gold_add(struct fonts *f, const struct place *p, const struct font_filter *filter,
                     const struct font_gray *gray, bool exact, struct font_difference *sum,
                     struct font_difference *gold_bytes)
{
    struct font_gray where;
    if (font_gray_place(&where, &f->edges[p->letter], f->filter, p->x, p->y) != FONT_OK)
        return font_wrong();
    /* the size of our picture, with its filter's margin, which a peer's lacks */
    int left = where.left_px - 1, top = where.top_px - 1;
    int width = where.width_px + 2, height = where.height_px + 2;
    double *gold = malloc(sizeof *gold * (size_t)width * (size_t)height);
    bool ok = gold && font_gold_draw(&f->outlines[p->letter], &f->map, filter, p->x, p->y, left,
                                     top, width, height, gold) == FONT_OK;
    if (ok)
        font_gold_compare(gray, exact, left, top, width, height, gold, sum);
    if (ok && gold_bytes)
        font_gold_bytes_compare(gold, width * height, gold_bytes);
    free(gold);
    return ok || font_wrong();
}

static void difference_add(struct bench_report *r, const char *what, const char *of_case,
                           const struct font_difference *d)
{
    char name[32];
    snprintf(name, sizeof name, "%.20s max error", what);
    bench_report_add(r, name, of_case, (struct bench_sample){d->max, d->max}, 1, "/255");
    snprintf(name, sizeof name, "%.20s psnr", what);
    double psnr = font_difference_psnr(d);
    bench_report_add(r, name, of_case, (struct bench_sample){psnr, psnr}, 1, "dB");
}

/* Letters at places of all kinds, a few of each: gold takes milliseconds. */
static bool way_check(struct fonts *f, const struct way *way, const char *of_case,
                      struct bench_report *r)
{
    struct font_difference bytes = {0}, exact = {0}, gold_bytes = {0};
    int step = f->page ? 53 : way->slow || f->size_px > 40 ? 4 : 1;
    font_simd_use(way->simd);
    for (int i = 0; i < f->places_count; i += step) {
        const struct font_gray *gray;
        if (!way->draw(f, i, &gray) ||
            !gold_add(f, &f->places[i], way->box ? f->box : f->filter, gray, false, &bytes,
                      NULL))
            return false;
    }
    difference_add(r, way->what, of_case, &bytes);
    if (way->draw != cached_edges || way->simd != FONT_SIMD_AVX512)
        return true;
    /* our values before rounding, and the error of rounding alone: gold's is about 62 dB */
    for (int i = 0; i < f->places_count; i += step) {
        const struct place *p = &f->places[i];
        if (font_gray_draw_exact(&f->gray, &f->edges[p->letter], f->filter, p->x, p->y) !=
            FONT_OK)
            return font_wrong();
        if (!gold_add(f, p, f->filter, &f->gray, true, &exact, &gold_bytes))
            return false;
    }
    difference_add(r, "bytes of gold", of_case, &gold_bytes);
    difference_add(r, "unrounded", of_case, &exact);
    double ink = 100 * fabs(exact.ink / exact.ink_gold - 1);
    bench_report_add(r, "unrounded ink off by", of_case, (struct bench_sample){ink, ink}, 1,
                     "%");
    return true;
}

/* ---- speed ---- */

struct work {
    struct fonts *f;
    const struct way *way;
};

static bool way_work(void *context)
{
    const struct work *w = context;
    struct fonts *f = w->f;
    font_simd_use(w->way->simd);
    for (int round = 0; round < f->rounds; round++)
        for (int i = 0; i < f->places_count; i++) {
            const struct font_gray *gray;
            if (!w->way->draw(f, i, &gray))
                return false;
        }
    return true;
}

/* One uncounted run, after which the caches hold no data of the contender before. */
static bool way_ready(void *context)
{
    const struct work *w = context;
    int rounds = w->f->rounds;
    w->f->rounds = 1;
    bool ok = way_work(context);
    w->f->rounds = rounds;
    return ok;
}

static bool many_work(void *context)
{
    struct fonts *f = context;
    const struct font_gray *grays;
    for (int round = 0; round < f->rounds; round++)
        if (font_many_draw(f->many, f->jobs, f->jobs_count, &grays) != FONT_OK)
            return font_wrong();
    return true;
}

static void rate_add(struct bench_report *r, const char *what, const char *of_case,
                     struct bench_sample seconds, double glyphs)
{
    bench_report_add(r, what, of_case,
                     (struct bench_sample){glyphs / seconds.median, glyphs / seconds.min}, 1,
                     "glyphs/s");
}

static bool case_prepare(struct fonts *f, double size_px)
{
    f->size_px = size_px;
    f->map = font_map_size(size_px, f->units);
    peer_freetype_destroy(f->freetype);
    peer_stb_destroy(f->stb);
    f->freetype = peer_freetype_create(f->bytes, f->bytes_count, size_px);
    f->stb = peer_stb_create(f->bytes, size_px);
    if (!f->freetype || !f->stb)
        return bench_fail("FreeType or stb_truetype cannot read the font");
    font_many_edges_forget(f->many);
    f->jobs_count = 0;
    for (int i = 0; i < LETTERS; i++) {
        struct font_rectangles rectangles = {0};
        bool ok =
            font_edges_build(&f->edges[i], &f->outlines[i], &f->map, f->filter) == FONT_OK &&
            font_edges_build_tabled(&f->scratch, &f->outlines[i], &f->map, f->filter) ==
                FONT_OK &&
            font_many_edges(f->many, &f->scratch) == i &&
            font_master_make(&f->masters[i], &f->outlines[i], 980) == FONT_OK &&
            font_rectangles_make(&rectangles, &f->masters[i]) == FONT_OK &&
            font_rectangles_edges(&rectangles, size_px, &f->master_edges[i]) == FONT_OK &&
            font_master_make(&f->masters[i], &f->outlines[i], (int)lrint(16 * size_px)) ==
                FONT_OK;
        font_rectangles_finish(&rectangles);
        if (!ok)
            return font_wrong();
        if (!peer_freetype_keep(f->freetype, i, f->glyphs[i], f->places[i].x, f->places[i].y))
            return bench_fail("FreeType failed");
    }
    for (int i = 0; i < f->places_count; i++)
        f->jobs[f->jobs_count++] = (struct font_many_job){
            f->places[i].letter, (float)f->places[i].x, (float)f->places[i].y};
    return true;
}

static bool case_run(struct fonts *f, const char *of_case, double size_px,
                     struct bench_report *r)
{
    struct bench_contender contenders[WORK_MAX];
    struct work works[WORK_MAX];
    int count = 0;
    if (!case_prepare(f, size_px))
        return false;
    f->rounds = f->page ? 1 : size_px < 40 ? 8 : 3;
    for (int i = 0; i < WAYS; i++) {
        if (f->page && ways[i].no_page)
            continue;
        if (!way_check(f, &ways[i], of_case, r))
            return false;
        if (ways[i].slow || font_simd_use(ways[i].simd) != ways[i].simd)
            continue;
        works[count] = (struct work){f, &ways[i]};
        contenders[count] = (struct bench_contender){.what = ways[i].what,
                                                     .ready = f->page ? NULL : way_ready,
                                                     .work = way_work,
                                                     .context = &works[count]};
        count++;
    }
    contenders[count++] =
        (struct bench_contender){.what = "opencl", .work = many_work, .context = f};
    if (!bench_measure_in_turns(contenders, count, f->page ? TURNS / 4 : TURNS))
        return false;
    double glyphs = (double)f->rounds * f->places_count;
    for (int i = 0; i < count; i++)
        rate_add(r, contenders[i].what, of_case, contenders[i].seconds, glyphs);
    /* Direct filtering takes seconds: once is enough. */
    f->rounds = 1;
    struct work slow = {f, &ways[WAYS - 1]};
    struct bench_sample seconds;
    if (!f->page && size_px < 40) {
        if (!bench_measure(way_work, &slow, 2, &seconds))
            return false;
        rate_add(r, "direct", of_case, seconds, f->places_count);
    }
    return true;
}

/* ---- the OpenCL path's own case: a typeface at forty sizes ---- */

struct forty {
    struct fonts *f;
    struct font_edges *edges; /* SIZES * LETTERS */
    struct font_gray gray;
    double processor_s[2]; /* the shortest time on all threads: of one thread in C, of OpenCL */
};

static void least_keep(double *least, double began_s)
{
    double s = bench_process_s() - began_s;
    if (*least == 0 || s < *least)
        *least = s;
}

static bool forty_opencl(void *context)
{
    struct forty *t = context;
    double began_s = bench_process_s();
    bool ok = many_work(t->f);
    least_keep(&t->processor_s[1], began_s);
    return ok;
}

static bool forty_one_thread(void *context)
{
    struct forty *t = context;
    double began_s = bench_process_s();
    for (int i = 0; i < SIZES * LETTERS; i++)
        if (font_gray_draw(&t->gray, &t->edges[i], t->f->filter, (double)t->f->jobs[i].x_px,
                           (double)t->f->jobs[i].y_px) != FONT_OK)
            return font_wrong();
    least_keep(&t->processor_s[0], began_s);
    return true;
}

static bool forty_run(struct fonts *f, struct bench_report *r)
{
    struct forty t = {.f = f, .edges = calloc(SIZES * LETTERS, sizeof *t.edges)};
    bool ok = t.edges != NULL;
    font_many_edges_forget(f->many);
    font_simd_use(FONT_SIMD_AVX512);
    for (int i = 0; ok && i < SIZES * LETTERS; i++) {
        struct font_map map = font_map_size(8 + 0.75 * (i / LETTERS), f->units);
        ok = font_edges_build(&t.edges[i], &f->outlines[i % LETTERS], &map, f->filter) ==
                 FONT_OK &&
             font_edges_build_tabled(&f->scratch, &f->outlines[i % LETTERS], &map, f->filter) ==
                 FONT_OK &&
             (f->jobs[i].edges = font_many_edges(f->many, &f->scratch)) >= 0;
        f->jobs[i].x_px = (float)(i % 16) / 16;
        f->jobs[i].y_px = (float)(i / 16 % 16) / 16;
    }
    if (!ok)
        font_wrong();
    f->jobs_count = SIZES * LETTERS;
    f->rounds = 1;
    struct bench_contender contenders[] = {
        {.what = "cached edges", .work = forty_one_thread, .context = &t},
        {.what = "opencl", .work = forty_opencl, .context = &t}};
    ok = ok && bench_measure_in_turns(contenders, 2, TURNS);
    for (int i = 0; ok && i < 2; i++)
        rate_add(r, contenders[i].what, "40 sizes", contenders[i].seconds, SIZES * LETTERS);
    if (ok) {
        const struct bench_sample *one = &contenders[0].seconds, *all = &contenders[1].seconds;
        bench_report_add(r, "opencl / one thread", "40 sizes",
                         (struct bench_sample){one->median / all->median, one->min / all->min},
                         1, "x");
        /* other load on the cores halves the first ratio, but not this one */
        double ratio = bench_threads_count() * t.processor_s[0] / t.processor_s[1];
        bench_report_add(r, "opencl / one thread, cpu time", "40 sizes",
                         (struct bench_sample){ratio, ratio}, 1, "x");
    }
    for (int i = 0; t.edges && i < SIZES * LETTERS; i++)
        font_edges_finish(&t.edges[i]);
    free(t.edges);
    font_gray_finish(&t.gray);
    return ok;
}

/* ---- the thesis's typeface: a master of 860 pixels in rectangles, filtered, and filtered
 * directly ---- */

static bool thesis_rectangles(void *context)
{
    struct fonts *f = context;
    for (int i = 0; i < LETTERS; i++) {
        struct font_rectangles rectangles = {0};
        bool ok = font_rectangles_make(&rectangles, &f->masters[i]) == FONT_OK &&
                  font_rectangles_edges(&rectangles, 24, &f->scratch) == FONT_OK &&
                  font_gray_draw(&f->gray, &f->scratch, f->filter, 0, 0) == FONT_OK;
        font_rectangles_finish(&rectangles);
        if (!ok)
            return font_wrong();
    }
    return true;
}

static bool thesis_direct(void *context)
{
    struct fonts *f = context;
    for (int i = 0; i < LETTERS; i += 8)
        if (!peer_direct_draw(f->direct, &f->masters[i], 24, 0, 0, &f->picture))
            return bench_fail("no memory");
    return true;
}

static bool thesis_run(struct fonts *f, struct bench_report *r)
{
    struct bench_sample rectangles, direct_part;
    static const int ems[] = {730, 980, 860}; /* the last is measured */
    font_simd_use(FONT_SIMD_AVX512);
    for (size_t e = 0; e < sizeof ems / sizeof *ems; e++) {
        long count = 0;
        char of_case[32];
        for (int i = 0; i < LETTERS; i++) {
            struct font_rectangles parts = {0};
            if (font_master_make(&f->masters[i], &f->outlines[i], ems[e]) != FONT_OK ||
                font_rectangles_make(&parts, &f->masters[i]) != FONT_OK)
                return font_wrong();
            count += parts.count;
            font_rectangles_finish(&parts);
        }
        double each = (double)count / LETTERS;
        snprintf(of_case, sizeof of_case, "typeface, em %d", ems[e]);
        bench_report_add(r, "rectangles a glyph", of_case, (struct bench_sample){each, each}, 1,
                         "");
    }
    if (!bench_measure(thesis_rectangles, f, 10, &rectangles) ||
        !bench_measure(thesis_direct, f, 2, &direct_part))
        return false;
    double share = (double)LETTERS / ((LETTERS + 7) / 8);
    bench_report_add(r, "master rectangles", "typeface", rectangles, 1e3, "ms");
    bench_report_add(r, "direct", "typeface", direct_part, 1e3 * share, "ms");
    double ratio = direct_part.median * share / rectangles.median;
    bench_report_add(r, "direct / rectangles", "typeface",
                     (struct bench_sample){ratio, direct_part.min * share / rectangles.min}, 1,
                     "x");
    return true;
}

/* ---- all of it ---- */

static bool fonts_open(struct fonts *f, const char *font, const char *filter)
{
    struct font_face_info info;
    if (font_face_open(font, 0, &f->face) != FONT_OK ||
        font_filter_create_named(filter, &f->filter) != FONT_OK ||
        font_filter_create_named("box", &f->box) != FONT_OK ||
        font_many_create(NULL, f->filter, &f->many) != FONT_OK)
        return font_wrong();
    font_face_describe(f->face, &info);
    f->units = info.units_per_em;
    f->bytes = font_face_bytes(f->face, &f->bytes_count);
    f->direct = peer_direct_create(f->filter);
    f->jobs = calloc(PAGE > SIZES * LETTERS ? PAGE : SIZES * LETTERS, sizeof *f->jobs);
    if (!f->direct || !f->jobs)
        return bench_fail("no memory");
    for (int i = 0; i < LETTERS; i++) {
        f->glyphs[i] = font_face_glyph(f->face, 33 + (uint32_t)i);
        if (font_face_outline(f->face, f->glyphs[i], &f->outlines[i]) != FONT_OK)
            return font_wrong();
    }
    return true;
}

static void fonts_close(struct fonts *f)
{
    for (int i = 0; i < LETTERS; i++) {
        font_outline_finish(&f->outlines[i]);
        font_edges_finish(&f->edges[i]);
        font_edges_finish(&f->master_edges[i]);
        font_master_finish(&f->masters[i]);
    }
    font_edges_finish(&f->scratch);
    font_gray_finish(&f->gray);
    peer_freetype_destroy(f->freetype);
    peer_stb_destroy(f->stb);
    peer_direct_destroy(f->direct);
    font_many_destroy(f->many);
    font_filter_destroy(f->filter);
    font_filter_destroy(f->box);
    font_face_close(f->face);
    free(f->jobs);
}

static bool fonts_run(struct fonts *f, bool quick, struct bench_report *r)
{
    static const struct {
        const char *name;
        double size_px;
    } cases[] = {{"12.25 px", 12.25}, {"24 px", 24}, {"72 px", 72}};
    for (int n = 0; n < 3; n++) {
        f->places_count = LETTERS;
        for (int i = 0; i < LETTERS; i++)
            f->places[i] = (struct place){i, (i * 7 % 16) / 16.0, (i * 5 % 16) / 16.0};
        if (!case_run(f, cases[n].name, cases[n].size_px, r))
            return false;
        if (quick)
            return true;
    }
    f->page = true;
    f->places_count = PAGE;
    for (int i = 0; i < PAGE; i++) { /* each pair once */
        int place = i / LETTERS * 5 % 256;
        f->places[i] = (struct place){i % LETTERS, place % 16 / 16.0, place / 16 / 16.0};
    }
    return case_run(f, "page of 5000", 12.25, r) && forty_run(f, r) && thesis_run(f, r);
}

bool fonts_ways_run(const char *font, const char *filter, bool quick,
                    struct bench_report *report)
{
    struct fonts *f = calloc(1, sizeof *f);
    if (!f)
        return bench_fail("no memory");
    bool ok = fonts_open(f, font, filter);
    if (ok) {
        bench_report_init(report, "fonts", 1, font_many_device(f->many));
        ok = fonts_run(f, quick, report);
    }
    if (ok)
        bench_report_print(report, "freetype", stdout);
    fonts_close(f);
    free(f);
    font_simd_use(FONT_SIMD_AVX512);
    return ok;
}
