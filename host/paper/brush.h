/* brush.h - bristly brushes on a sheet, after Strassmann's Hairy Brushes (SIGGRAPH 1986).
 *
 *     struct paper_brush brush = paper_brush_default();
 *     brush.width = 24;
 *     paper_sheet_brush(sheet, &brush);
 *     paper_sheet_dip(sheet, &(struct paper_dip){.part = 1, .side = {-1, 1}, .amount = {1, 0.6}});
 *     struct paper_stroke_sample samples[] = {{.x = 40, .y = 60, .pressure = 0.3},
 *                                             {.time_s = 0.8, .x = 300, .y = 90, .pressure = 0.8}};
 *     paper_sheet_stroke(sheet, &(struct paper_stroke){.pace = 60, .samples_count = 2, .samples = samples}, NULL);
 *
 * A sheet has PAPER_BRUSHES_MAX brushes, by number. Each bristle is a processor of its own, and
 * holds water and the sheet's pigments in whole grains. Bristles and fibers exchange grains, so
 * sheet and brushes together lose nothing (docs/paper.md). The result depends only on the
 * arguments: the same calls make the same bits.
 *
 * Errors, ownership and threads: as sheet.h says; these take sheets with parts only.
 */
#ifndef LUTETIA_PAPER_BRUSH_H
#define LUTETIA_PAPER_BRUSH_H

#include "sheet.h"

enum {
    PAPER_BRUSHES_MAX = 8,
    PAPER_BRISTLES_MAX = 512,
    PAPER_STROKE_SAMPLES_MAX = 100000,
    PAPER_STROKE_STEPS_MAX = 100000
};

struct paper_brush {
    int number;    /* the brush's number in the sheet, 0..PAPER_BRUSHES_MAX - 1 */
    int bristles;  /* 1..PAPER_BRISTLES_MAX */
    double width;  /* width of the tuft in fibers, 1..1000 */
    double depth;  /* and along, 1..1000 */
    double angle;  /* direction of the tuft's width, from x towards y */
    bool follows;  /* the tuft turns with the stroke: angle is measured from the stroke's
                   * normal */
    bool flat;     /* the bristles fill a rectangle; else an ellipse */
    double point;  /* how much shorter the outer bristles are, 0..1: with light pressure such a
                * brush draws a thin line */
    double uneven; /* variation of the bristles' lengths and loads, 0..1 */
    double splay;  /* how far pressure spreads the bristles, 0..2 */
    double bend;   /* how far the bristles trail behind at full pressure, in widths, 0..2 */
    double thickness; /* a bristle's thickness in fibers, 0..100 */
    double reach;     /* the approximate distance in fibers that a full brush paints, 1..1e6 */
    double load;      /* depth of water that a full brush leaves on a fiber, 0.01..2 */
    double flow;      /* rate of exchange between bristle and fiber, 1/s, 0..1e6 */
    double mixing;    /* the part of the exchange that remains where both are equally wet,
                       * 0..1 */
    uint64_t seed;    /* for the positions of the bristles */
    bool mirrored;    /* left and right of the tuft exchanged */
};
/* A round brush of 160 bristles, 20 fibers wide, number 0. */
struct paper_brush paper_brush_default(void);

/* Kinds of brushes: "round", "flat", "mop", "rigger", "fan", "bristle", by number from 0; NULL:
 * there is none of that number. They are constants of the library, valid for ever. */
const char *paper_brush_kind(int number);
/* Makes the brush one of that kind, of the width that it has; number, angle, follows, flow,
 * seed and mirrored stay. False: there is no such kind, and nothing changes. Threads: any. */
bool paper_brush_of_kind(struct paper_brush *brush, const char *kind);

struct paper_dip {
    int number;
    double part;    /* the part of the brush's content that is replaced, 0..1 */
    double side[2]; /* only bristles from..to across the tuft, -1 left, 1 right in the
                     * stroke's direction */
    double amount[1 + PAPER_PIGMENTS_MAX]; /* [0]: how full of water, 0..1; the others: the
                                   * approximate amount of each pigment that a fiber then
                                   * gets, 0..4 */
};

struct paper_stroke_sample {
    double time_s;         /* seconds since the stroke's beginning, ascending */
    double x, y;           /* fibers */
    double pressure;       /* 0..1 */
    double tilt_x, tilt_y; /* tilt of the handle, radians, -1.5..1.5 */
};

struct paper_stroke {
    int number;
    double pace; /* steps of the paper for each second of the stroke, 0..10000; 0: the paper
               * makes no steps */
    int samples_count;
    const struct paper_stroke_sample *samples;
};

/* Makes a new brush `number`, clean and dry. Errors: BAD_ARGUMENT, NO_MEMORY,
 * MACHINE_FAILED. */
enum paper_status paper_sheet_brush(struct paper_sheet *sheet, const struct paper_brush *brush);

/* Dips the brush into paint or clean water, or wipes it on a cloth (no amounts). Errors: as
 * paper_sheet_brush(). */
enum paper_status paper_sheet_dip(struct paper_sheet *sheet, const struct paper_dip *dip);

/* Draws a spline through the samples, while the paper makes steps; *steps (may be NULL) gets
 * their number. Off the sheet, and where there is resist, the brush does not touch. Errors:
 * as paper_sheet_brush(). */
enum paper_status paper_sheet_stroke(struct paper_sheet *sheet,
                                     const struct paper_stroke *stroke, int *steps);

/* ---- a stroke that grows while a hand makes it ----
 *
 *     paper_sheet_stroke_begin(sheet, 0, 60);
 *     while (pen_reports(samples, &count))
 *         paper_sheet_stroke_add(sheet, samples, count, NULL);
 *     paper_sheet_stroke_end(sheet, NULL);
 *
 * It makes the bits of paper_sheet_stroke() with all its samples at once, and one operation in
 * the history. A piece is painted, and the paper makes its steps, as soon as samples settle it:
 * for a moment of the stroke, when there are two samples after the end of the step that follows
 * it. So a pen that rests is told again from time to time. While a stroke grows it can be
 * looked at; who would do something else with the sheet or go elsewhere in its history hears
 * BAD_ARGUMENT, but for undo, which drops it. */

/* Begins a stroke of brush `number`; pace: as in struct paper_stroke. Errors: as
 * paper_sheet_brush(), and while another one grows. */
enum paper_status paper_sheet_stroke_begin(struct paper_sheet *sheet, int number, double pace);
/* Adds samples, whose times go on from those before. *steps (may be NULL) gets the number of
 * steps that the paper made. Errors: BAD_ARGUMENT (none grows, or these cannot follow: then it
 * is as it was); NO_MEMORY, MACHINE_FAILED, also where `due` said so: then the stroke is
 * dropped. */
enum paper_status paper_sheet_stroke_add(struct paper_sheet *sheet,
                                         const struct paper_stroke_sample *samples, int count,
                                         int *steps);
/* Paints what is left. A stroke without samples is dropped. Errors: BAD_ARGUMENT (none grows),
 * NO_MEMORY, MACHINE_FAILED, as above. */
enum paper_status paper_sheet_stroke_end(struct paper_sheet *sheet, int *steps);
/* Ends it as if it had not begun; without a history what has been painted stays. Nothing grows:
 * fine. */
void paper_sheet_stroke_drop(struct paper_sheet *sheet);
/* Whether one grows; false also after it ended or was dropped. */
bool paper_sheet_stroke_growing(const struct paper_sheet *sheet);

/* The amount of a substance (0 water, 1 + a pigment's number) in brush `number`, in units;
 * exact. Errors: BAD_ARGUMENT (no such brush or substance), NO_MEMORY, MACHINE_FAILED. */
enum paper_status paper_sheet_brush_total(struct paper_sheet *sheet, int number, int substance,
                                          double *total);

/* Long operations call `due` between steps, and end early with PAPER_OK if it returns true;
 * NULL: no call. Owns: the caller, of what `context` is; it is needed until another `due` is
 * given. */
void paper_sheet_stop_when(struct paper_sheet *sheet, bool (*due)(void *context),
                           void *context);

/* ---- a stroke's way ---- */

/* Position, pressure and tilt at a time: a cubic spline through the samples' positions,
 * linear between their pressures and tilts. *cursor begins as 0 and speeds up calls with
 * growing times. Threads: any. */
struct paper_stroke_sample paper_stroke_at(const struct paper_stroke *stroke, double time_s,
                                           int *cursor);
/* Whether a stroke can be drawn, without a sheet. Errors: BAD_ARGUMENT. Threads: any. */
enum paper_status paper_stroke_check(const struct paper_stroke *stroke);

#endif
