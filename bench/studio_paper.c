/* studio_paper.c - see studio_paper.h. */
#include "studio_paper.h"

#include <brush.h>
#include <history.h>
#include <picture.h>
#include <visible_text.h>

#include <stdlib.h>
#include <string.h>

enum {
    SIDE = 1024,
    WET = 300,
    PIGMENTS = 3,
    STROKE_PIECES = 100,
    REPORTS = 4,
    UNDOS = 9,
    PICTURES = 60
};
enum { SIDE_QUICK = 64, WET_QUICK = 48, PIECES_QUICK = 4 };
#define PIECE_S (1.0 / 60)
#define PACE 60.0
#define BUDGET_BYTES 1e9

static bool said(enum paper_status status)
{
    return status == PAPER_OK || bench_fail("the paper: %s", paper_error());
}

static bool sheet_make(int side, int wet, struct paper_sheet **sheet)
{
    struct paper_sheet_config config = paper_sheet_config_default();
    struct paper_air air = paper_air_default();
    const double amount[1 + PAPER_PIGMENTS_MAX] = {0.9, 0.3, 0.2, 0.1};
    config.width = config.height = side;
    config.pigments_count = PIGMENTS;
    for (int i = 0; i < PIGMENTS; i++)
        config.pigments[i] = *paper_pigment_number(i);
    air.humidity = 0; /* what has dried would take no time */
    *sheet = NULL;
    uint8_t *gray = malloc((size_t)wet * (size_t)wet);
    if (!gray)
        return bench_fail("no memory for what is wet");
    memset(gray, 255, (size_t)wet * (size_t)wet);
    const struct paper_screen screen = {.width_px = wet, .height_px = wet, .gray = gray};
    const bool ok =
        said(paper_sheet_create(&config, sheet)) &&
        said(paper_history_begin(*sheet, BUDGET_BYTES)) &&
        said(paper_sheet_air(*sheet, &air)) &&
        said(paper_sheet_put(*sheet, &screen, (side - wet) / 2, (side - wet) / 2, amount));
    free(gray);
    return ok;
}

/* ---- steps ---- */

static bool steps_go(struct paper_sheet *sheet, int count)
{
    for (int i = 0; i < count; i++)
        if (!said(paper_sheet_step(sheet)))
            return false;
    return said(paper_sheet_finish(sheet));
}

static bool steps_measure(struct bench_report *r, const struct bench_options *o, int side,
                          int wet, double *per_s)
{
    struct paper_sheet *sheet;
    char of_case[64];
    const int warm = bench_many(200, 2), steps = bench_many(30, 2);
    double *rates = calloc((size_t)o->repeat_count, sizeof *rates);
    side = bench_many(side, 64);
    wet = wet < side ? wet : side;
    snprintf(of_case, sizeof of_case, "%dx%d, %dx%d wet", side, side, wet, wet);
    visible_say("studio: steps of %s ...", of_case);
    bool ok = (rates || bench_fail("no memory for %d rates", o->repeat_count)) &&
              sheet_make(side, wet, &sheet);
    if (!ok) {
        free(rates);
        return false;
    }
    ok = steps_go(sheet, warm);
    for (int i = 0; ok && i < o->repeat_count; i++) {
        const double began_s = bench_now_s();
        ok = steps_go(sheet, steps);
        rates[i] = steps / (bench_now_s() - began_s);
    }
    if (ok) {
        const struct bench_sample rate = bench_sample_of(rates, o->repeat_count);
        *per_s = rate.median;
        bench_report_add(r, "steps", of_case, rate, 1, "steps/s");
    }
    paper_sheet_destroy(sheet);
    free(rates);
    return ok;
}

/* ---- a hand ---- */

struct hand {
    struct paper_sheet *sheet;
    uint8_t *rgb;
    double fibers_per_s;
    double *took_ms; /* of each piece with its picture */
    int pieces;
    double *ends_ms; /* of each end of a stroke, with the dip for the next and their picture */
    int ends;
};

/* What has changed, as the studio's thread looks; how many pixels that are. */
static bool look_areas(const struct hand *h, struct paper_area areas[PAPER_AREAS_MAX],
                       double *pixels)
{
    const struct paper_sheet_config *config = paper_sheet_get_config(h->sheet);
    const struct paper_sheet_view view = {.show = PAPER_SHOW_WET};
    const size_t width = (size_t)config->width;
    const int count = paper_sheet_changed(h->sheet, areas);
    bool ok = true;
    *pixels = 0;
    for (int i = 0; i < count && ok; i++) {
        *pixels += (double)areas[i].width * areas[i].height;
        ok = said(paper_sheet_view_area(
            h->sheet, &view, &areas[i],
            h->rgb + 3 * ((size_t)areas[i].y * width + (size_t)areas[i].x), 3 * width));
    }
    return ok;
}

static bool look(const struct hand *h)
{
    struct paper_area areas[PAPER_AREAS_MAX];
    double pixels;
    return look_areas(h, areas, &pixels);
}

static bool dipped(struct paper_sheet *sheet)
{
    const struct paper_dip dip = {.part = 1, .side = {-1, 1}, .amount = {0.8, 0.4, 0.2}};
    return said(paper_sheet_dip(sheet, &dip));
}

/* The reports of 1/60 s: back and forth over what is wet, a little lower after each turn. */
static void reports_make(const struct hand *h, int stroke, int piece,
                         struct paper_stroke_sample samples[REPORTS])
{
    const int side = bench_many(SIDE, SIDE_QUICK), wet = bench_many(WET, WET_QUICK);
    const double across = wet - 40, from = (side - wet) / 2.0 + 20;
    for (int i = 0; i < REPORTS; i++) {
        const double t = PIECE_S * (piece + (double)i / REPORTS);
        double along = h->fibers_per_s * t;
        const int turns = (int)(along / across);
        along -= turns * across;
        samples[i] =
            (struct paper_stroke_sample){.time_s = t,
                                         .x = from + (turns % 2 ? across - along : along),
                                         .y = from + stroke * 37 % (wet - 40) / 2 + turns * 3,
                                         .pressure = 0.6};
    }
}

static bool stroke_paint(struct hand *h, int stroke)
{
    bool ok = said(paper_sheet_stroke_begin(h->sheet, 0, PACE));
    for (int piece = 0; ok && piece < bench_many(STROKE_PIECES, PIECES_QUICK); piece++) {
        struct paper_stroke_sample samples[REPORTS];
        reports_make(h, stroke, piece, samples);
        const double began_s = bench_now_s();
        ok = said(paper_sheet_stroke_add(h->sheet, samples, REPORTS, NULL)) && look(h);
        h->took_ms[h->pieces++] = 1e3 * (bench_now_s() - began_s);
    }
    const double began_s = bench_now_s();
    ok = ok && said(paper_sheet_stroke_end(h->sheet, NULL)) && dipped(h->sheet) && look(h);
    h->ends_ms[h->ends++] = 1e3 * (bench_now_s() - began_s);
    return ok;
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void pieces_add(struct bench_report *r, struct hand *h)
{
    char of_case[64];
    qsort(h->took_ms, (size_t)h->pieces, sizeof *h->took_ms, ascending);
    snprintf(of_case, sizeof of_case, "%d pieces, %g fibers/s", h->pieces, h->fibers_per_s);
    const struct {
        const char *what;
        double value;
    } rows[] = {{"1/60 s, median", h->took_ms[h->pieces / 2]},
                {"1/60 s, p99", h->took_ms[(int)(0.99 * (h->pieces - 1))]},
                {"1/60 s, longest", h->took_ms[h->pieces - 1]}};
    for (int i = 0; i < 3; i++)
        bench_report_add(r, rows[i].what, of_case,
                         (struct bench_sample){rows[i].value, rows[i].value}, 1, "ms");
    snprintf(of_case, sizeof of_case, "%d strokes, %g fibers/s", h->ends, h->fibers_per_s);
    bench_report_add(r, "a stroke's end", of_case, bench_sample_of(h->ends_ms, h->ends), 1,
                     "ms");
    bench_report_add(r, "a stroke's end, longest", of_case,
                     (struct bench_sample){h->ends_ms[h->ends - 1], h->ends_ms[h->ends - 1]}, 1,
                     "ms");
}

/* So many strokes; the first ones are not counted. */
static bool strokes_measure(struct bench_report *r, struct hand *h, double fibers_per_s,
                            int strokes, int warm)
{
    bool ok = true;
    visible_say("studio: strokes of %g fibers a second ...", fibers_per_s);
    h->fibers_per_s = fibers_per_s;
    for (int i = -warm; ok && i < strokes; i++) {
        if (i <= 0)
            h->pieces = h->ends = 0;
        ok = stroke_paint(h, i + warm);
    }
    if (ok)
        pieces_add(r, h);
    return ok;
}

static bool undo_measure(struct bench_report *r, struct hand *h)
{
    double took_ms[UNDOS];
    const int count = bench_many(UNDOS, 1);
    bool ok = true;
    for (int i = 0; ok && i < count; i++) {
        h->pieces = h->ends = 0;
        ok = stroke_paint(h, i);
        const double began_s = bench_now_s();
        paper_history_undo(h->sheet, 2); /* with its dip */
        ok = ok && look(h);
        took_ms[i] = 1e3 * (bench_now_s() - began_s);
    }
    if (ok)
        bench_report_add(r, "undo of a stroke", "paper", bench_sample_of(took_ms, count), 1,
                         "ms");
    return ok;
}

/* The picture of what a step has changed, when the step itself has been computed. */
static bool picture_measure(struct bench_report *r, struct hand *h)
{
    double took_ms[PICTURES], pixels = 0;
    char of_case[64];
    const int count = bench_many(PICTURES, 2), warm = bench_many(40, 1);
    const int side = bench_many(SIDE, SIDE_QUICK);
    bool ok = true;
    for (int i = -warm; ok && i < count; i++) {
        struct paper_area areas[PAPER_AREAS_MAX];
        ok = look(h) && steps_go(h->sheet, 1);
        const double began_s = bench_now_s();
        ok = ok && look_areas(h, areas, &pixels);
        if (i >= 0)
            took_ms[i] = 1e3 * (bench_now_s() - began_s);
    }
    snprintf(of_case, sizeof of_case, "%.0f pixels of %dx%d", pixels, side, side);
    if (ok)
        bench_report_add(r, "picture of a part", of_case, bench_sample_of(took_ms, count), 1,
                         "ms");
    return ok;
}

static bool hand_measure(struct bench_report *r)
{
    const int strokes = bench_many(100, 1), warm = bench_many(5, 0);
    struct hand h = {.sheet = NULL};
    struct paper_brush brush = paper_brush_default();
    brush.width = 24;
    h.rgb = malloc(3 * (size_t)SIDE * SIDE);
    h.took_ms = calloc((size_t)(strokes + warm) * STROKE_PIECES, sizeof *h.took_ms);
    h.ends_ms = calloc((size_t)(strokes + warm + UNDOS), sizeof *h.ends_ms);
    bool ok = (h.rgb && h.took_ms && h.ends_ms) || bench_fail("no memory for pictures");
    ok = ok && sheet_make(bench_many(SIDE, SIDE_QUICK), bench_many(WET, WET_QUICK), &h.sheet) &&
         said(paper_sheet_brush(h.sheet, &brush)) && dipped(h.sheet) &&
         strokes_measure(r, &h, 600, strokes, warm) && undo_measure(r, &h) &&
         picture_measure(r, &h) && strokes_measure(r, &h, 3000, bench_many(10, 1), warm);
    paper_sheet_destroy(h.sheet);
    free(h.rgb);
    free(h.took_ms);
    free(h.ends_ms);
    return ok;
}

bool studio_paper_measure(struct bench_report *r, const struct bench_options *o)
{
    double small = 1, all, part, large = 1;
    const bool ok = hand_measure(r) && steps_measure(r, o, 512, WET, &small) &&
                    steps_measure(r, o, SIDE, WET, &part) &&
                    steps_measure(r, o, SIDE, SIDE, &all) &&
                    steps_measure(r, o, 4096, WET, &large);
    if (ok)
        bench_report_add(r, "4096x4096 beside 512x512", "a step",
                         (struct bench_sample){small / large, small / large}, 1, "times");
    return ok;
}
