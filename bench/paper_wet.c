/* paper_wet.c - see paper_wet.h. */
#include "paper_wet.h"
#include <visible_text.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <paper.h>
#include <sheet.h>

#include "input_file.h"
#include "paris_internal.h"

enum {
    WORD_SIZE = 40, /* fibers to the em */
    WORD_PIGMENTS = 6,
    UNIT = 64,            /* as usual */
    STEPS_BOXED = 30,     /* of a turn */
    STEPS_WHOLE = 4,      /* ... */
    STEPS_KERNELS = 1000, /* until a box has its best kernels */
    POSTER_WIDTH = 3000,
    POSTER_HEIGHT = 2000,
    POSTER_STEPS = 600,
    POSTER_PIGMENTS = 3,
    LARGE_SIDE = 4096,
    LARGE_STEPS = 4
};

static bool said(enum paper_status status)
{
    return status == PAPER_OK || bench_fail("the paper: %s", paper_error());
}

/* On a machine of its own. */
static bool sheet_make(int width, int height, int pigments, struct paper_sheet **sheet)
{
    struct paper_sheet_config config = paper_sheet_config_default();
    struct machine_config machine = machine_config_default();
    *sheet = NULL;
    config.width = width;
    config.height = height;
    config.pigments_count = pigments;
    for (int i = 0; i < pigments; i++)
        config.pigments[i] = *paper_pigment_number(i);
    return (paris_reset(&machine) || bench_fail("%s", paris_error())) &&
           said(paper_sheet_create(&config, sheet));
}

static bool steps_go(struct paper_sheet *sheet, int count)
{
    bool ok = true;
    for (int i = 0; ok && i < count; i++)
        ok = said(paper_sheet_step(sheet));
    return ok && said(paper_sheet_finish(sheet));
}

static bool line_put(struct paper_sheet *sheet, const char *text, double size, int x, int y,
                     int pigment)
{
    const struct paper_line line = {
        .text = text, .font = "DejaVu Serif", .size_px = size, .anchor = 0.5};
    struct paper_screen screen;
    double amount[1 + PAPER_PIGMENTS_MAX] = {0.6};
    amount[1 + pigment] = 0.6;
    bool ok = said(paper_line_screen(&line, &screen, NULL)) &&
              said(paper_sheet_put(sheet, &screen, x - screen.width_px / 2,
                                   y - screen.height_px / 2, amount));
    paper_screen_destroy(&screen);
    return ok;
}

/* ---- a word ---- */

struct turn {
    struct paper_sheet *sheet;
    int unit, steps;
};

/* The first step looks where it is wet. */
static bool turn_ready(void *context)
{
    const struct turn *t = context;
    return said(paper_sheet_confine(t->sheet, t->unit)) && steps_go(t->sheet, 2);
}

static bool turn_work(void *context)
{
    const struct turn *t = context;
    return steps_go(t->sheet, t->steps);
}

bool paper_word_measure(struct bench_report *r, const struct bench_options *o, int width,
                        int height, bool everywhere)
{
    struct paper_sheet *sheet;
    char of_case[48];
    snprintf(of_case, sizeof of_case, "word on %dx%d", width, height);
    visible_say("paper: %s ...", of_case);
    struct paper_air air = paper_air_default();
    air.humidity = 0; /* a word that has dried would take no time */
    bool ok = sheet_make(width, height, WORD_PIGMENTS, &sheet) &&
              said(paper_sheet_air(sheet, &air)) &&
              line_put(sheet, "water", WORD_SIZE, width / 2, height / 2, 0) &&
              steps_go(sheet, STEPS_KERNELS);
    struct turn boxed = {sheet, UNIT, STEPS_BOXED}, whole = {sheet, 0, STEPS_WHOLE};
    struct bench_contender contenders[] = {
        {.what = "sheet, in boxes", .ready = turn_ready, .work = turn_work, .context = &boxed},
        {.what = "sheet, everywhere",
         .ready = turn_ready,
         .work = turn_work,
         .context = &whole},
    };
    const int count = everywhere ? 2 : 1;
    const double share = ok ? paper_sheet_share(sheet) : 0;
    if (ok && !(share > 0 && share < 1))
        ok = bench_fail("%s: %g of the sheet is in boxes", of_case, share);
    ok = ok && bench_measure_in_turns(contenders, count, o->repeat_count);
    for (int i = 0; ok && i < count; i++) {
        const struct bench_sample seconds = contenders[i].seconds;
        const double steps = i == 0 ? STEPS_BOXED : STEPS_WHOLE;
        bench_report_add(r, contenders[i].what, of_case,
                         (struct bench_sample){steps / seconds.median, steps / seconds.min}, 1,
                         "steps/s");
    }
    paper_sheet_destroy(sheet);
    return ok;
}

/* ---- a poster ---- */

/* A word, a line below it, and a wash behind their upper half; all dry while the steps go. */
static bool poster_paint(struct paper_sheet *sheet)
{
    const double wash[1 + PAPER_PIGMENTS_MAX] = {0.5, 0, 0.2};
    enum { BAND = 500 };
    uint8_t *gray = malloc((size_t)POSTER_WIDTH * BAND);
    if (!gray)
        return bench_fail("no memory for a poster");
    memset(gray, 255, (size_t)POSTER_WIDTH * BAND);
    const struct paper_screen screen = {
        .width_px = POSTER_WIDTH, .height_px = BAND, .gray = gray};
    bool ok = said(paper_sheet_put(sheet, &screen, 0, 300, wash)) &&
              line_put(sheet, "Lutetia", 720, POSTER_WIDTH / 2, 800, 0) &&
              line_put(sheet, "water, paper, time", 240, POSTER_WIDTH / 2, 1500, 2);
    free(gray);
    return ok;
}

struct poster_time {
    double wall, process; /* seconds; of all processors */
};

static bool poster_time(struct poster_time *took)
{
    struct paper_sheet *sheet;
    visible_say("paper: a poster ...");
    bool ok =
        sheet_make(POSTER_WIDTH, POSTER_HEIGHT, POSTER_PIGMENTS, &sheet) && poster_paint(sheet);
    const struct poster_time start = {bench_now_s(), bench_process_s()};
    ok = ok && steps_go(sheet, POSTER_STEPS);
    *took = (struct poster_time){bench_now_s() - start.wall, bench_process_s() - start.process};
    paper_sheet_destroy(sheet);
    if (ok)
        visible_say("paper: ... %.1f s, %.1f s of processors", took->wall, took->process);
    return ok;
}

bool paper_poster_measure(struct bench_report *r)
{
    struct poster_time took;
    if (!poster_time(&took))
        return false;
    const struct {
        const char *what, *unit;
        double value;
    } rows[] = {
        {"sheet", "s", took.wall},
        {"processors", "s", took.process},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        bench_report_add(r, rows[i].what, "poster 3000x2000, 600 steps",
                         (struct bench_sample){rows[i].value, rows[i].value}, 1, rows[i].unit);
    return true;
}

/* ---- memory ---- */

/* The most that the process had in memory, bytes; 0: the system does not say. */
static double most_in_memory(void)
{
    FILE *f = input_file_open("/proc/self/status", NULL);
    char line[256];
    double kilobytes = 0;
    while (f && fgets(line, sizeof line, f))
        if (sscanf(line, "VmHWM: %lf", &kilobytes) == 1)
            break;
    if (f)
        fclose(f);
    return 1024 * kilobytes;
}

bool paper_memory_measure(struct bench_report *r)
{
    struct paper_sheet *sheet;
    const double amount[1 + PAPER_PIGMENTS_MAX] = {0.5, 0.2, 0.2, 0.2};
    const size_t count = (size_t)LARGE_SIDE * LARGE_SIDE;
    const struct paper_sheet_view view = {.show = PAPER_SHOW_COLOR};
    struct machine_config machine = machine_config_default();
    visible_say("paper: memory of %dx%d ...", LARGE_SIDE, LARGE_SIDE);
    if (!paris_reset(&machine)) /* arrays of the sheets before go back to the system */
        return bench_fail("%s", paris_error());
    FILE *f = fopen("/proc/self/clear_refs", "w"); /* "5": the most begins anew */
    if (f) {
        fputs("5", f);
        fclose(f);
    }
    uint16_t *rgb = malloc(3 * count * sizeof *rgb);
    bool ok = (rgb || bench_fail("no memory for a picture")) &&
              sheet_make(LARGE_SIDE, LARGE_SIDE, POSTER_PIGMENTS, &sheet);
    if (!ok) {
        free(rgb);
        return false;
    }
    ok = said(paper_sheet_put(sheet, NULL, 0, 0, amount)) && steps_go(sheet, LARGE_STEPS) &&
         said(paper_sheet_view(sheet, &view, rgb));
    const double bytes = most_in_memory();
    if (ok && bytes > 0)
        bench_report_add(r, "memory", "4096x4096, three pigments",
                         (struct bench_sample){bytes, bytes}, 0x1p-30, "GiB");
    free(rgb);
    paper_sheet_destroy(sheet);
    return ok;
}
