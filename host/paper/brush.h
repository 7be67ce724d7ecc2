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
 * A sheet has PAPER_BRUSHES_MAX brushes, by number. Each bristle is a processor of its own and holds water and the sheet's
 * pigments in whole grains; what it gives a fiber the fiber gets, and what it takes the fiber loses, so sheet and brushes
 * together lose nothing (docs/paper.md). Everything is decided by the arguments: the same calls make the same bits.
 *
 * Errors and threads: as sheet.h says; these take sheets with parts only. */
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
    int number;   /* which of the sheet's, 0..PAPER_BRUSHES_MAX - 1 */
    int bristles; /* 1..PAPER_BRISTLES_MAX */
    double width; /* of the tuft, across, fibers, 1..1000 */
    double depth; /* and along, 1..1000 */
    double angle; /* of the tuft's width, from x towards y */
    bool follows; /* the tuft turns with the stroke: angle is that to its normal */
    bool flat;    /* its bristles fill a rectangle, else an ellipse */
    double
        point; /* how much shorter the outer bristles are, 0..1: light pressure draws a thin line */
    double uneven;    /* how far bristles differ in length and in what they give, 0..1 */
    double splay;     /* how far pressure spreads them, 0..2 */
    double bend;      /* how far they trail behind, in widths, at full pressure, 0..2 */
    double thickness; /* of a bristle, fibers, 0..100 */
    double reach;     /* about how far a full brush paints, fibers, 1..1e6 */
    double load;      /* water that it lays on a fiber when it is full, 0.01..2 */
    double flow;      /* how fast bristle and fiber exchange, 1/s, 0..1e6 */
    double mixing;    /* how far they do where both are as wet, 0..1 */
    uint64_t seed;    /* of where the bristles are */
    bool mirrored;    /* left and right of the tuft changed */
};
struct paper_brush paper_brush_default(void);

struct paper_dip {
    int number;
    double part;    /* of what the brush holds that is exchanged for the new, 0..1 */
    double side[2]; /* bristles from..to across the tuft, -1 left, 1 right of where it goes */
    double amount
        [1 + PAPER_PIGMENTS_MAX]; /* [0]: how full of water, 0..1; about what a fiber then gets
                                               of each pigment, 0..4 */
};

struct paper_stroke_sample {
    double time_s;         /* from the stroke's beginning, ascending */
    double x, y;           /* fibers */
    double pressure;       /* 0..1 */
    double tilt_x, tilt_y; /* of the handle, radians, -1.5..1.5 */
};

struct paper_stroke {
    int number;
    double
        pace; /* steps of the paper in a second of the stroke, 0..10000; 0: the paper waits */
    int samples_count;
    const struct paper_stroke_sample *samples;
};

/* Makes brush `number` anew: clean and dry. Errors: BAD_ARGUMENT, NO_MEMORY, MACHINE_FAILED. */
enum paper_status paper_sheet_brush(struct paper_sheet *sheet, const struct paper_brush *brush);

/* Dips the brush into paint, clean water, or (no amounts) a cloth. Errors: as paper_sheet_brush(). */
enum paper_status paper_sheet_dip(struct paper_sheet *sheet, const struct paper_dip *dip);

/* Draws a spline through the samples, while the paper goes on; *steps (may be NULL) gets its steps. Off the sheet, and
 * where there is resist, nothing is touched. Errors: as paper_sheet_brush(). */
enum paper_status paper_sheet_stroke(struct paper_sheet *sheet,
                                     const struct paper_stroke *stroke, int *steps);

/* What brush `number` holds of a substance (0 water, 1 + a pigment's number), in units; exact. */
enum paper_status paper_sheet_brush_total(struct paper_sheet *sheet, int number, int substance,
                                          double *total);

/* Long operations ask `due` between steps and end early, with PAPER_OK, when it says so; NULL: they do not ask. */
void paper_sheet_stop_when(struct paper_sheet *sheet, bool (*due)(void *context),
                           void *context);

/* ---- a stroke's way ---- */

/* Position, pressure and tilt at a time: a cubic through the samples' positions, straight between their pressures. *cursor
 * begins as 0 and speeds up calls with growing times. */
struct paper_stroke_sample paper_stroke_at(const struct paper_stroke *stroke, double time_s,
                                           int *cursor);
enum paper_status paper_stroke_check(const struct paper_stroke *stroke);

#endif
