/* studio_selection.h - what of a sheet is selected: masking fluid lies on all the rest, so
 * nothing can be put there, and no water flows across.
 *
 *     double points[2 * STUDIO_OUTLINE_CORNERS];
 *     const int count = studio_outline_points(STUDIO_OUTLINE_ELLIPSE, 10, 20, 90, 60, points);
 *     struct studio_around around;
 *     if (studio_around_make(NULL, STUDIO_JOIN_NEW, points, count, config, &around) == PAPER_OK && around.screen.gray)
 *         paper_sheet_resist(sheet, &around.screen, around.x, around.y, true);
 *     studio_around_free(&around);
 *
 * A selection is an operation like others: it is found in the sheet's history, by what its
 * screen was drawn from (drawing.h). So it is undone, saved, replayed and put into scripts, and
 * a sheet that is opened again has the one that it was saved with. Fluid that a hand has
 * painted is told apart from it:
 *
 *     operations  fluid  selection  fluid (inside)  nothing selected
 *     fluid       x      x          x x             x x
 *     frisket            x          x
 *
 * Where another one is selected instead, or more or less of the sheet, two operations follow
 * each other at once, and are one deed: fluid around the new one, and off with what was around
 * the old one alone.
 *
 * Threads: the sheet's. */
#ifndef LUTETIA_STUDIO_SELECTION_H
#define LUTETIA_STUDIO_SELECTION_H

#include <drawing.h>
#include <history.h>

/* Choices of the setting STUDIO_OUTLINE. */
enum studio_outline { STUDIO_OUTLINE_RECTANGLE, STUDIO_OUTLINE_ELLIPSE, STUDIO_OUTLINE_LASSO };
enum { STUDIO_OUTLINE_CORNERS = 180, STUDIO_LASSO_CORNERS = 4000 };

/* A rectangle or an ellipse between two corners. Shape: points holds STUDIO_OUTLINE_CORNERS
 * pairs; returns how many are used. */
int studio_outline_points(enum studio_outline outline, double x1, double y1, double x2,
                          double y2, double *points);
/* The same of a hand's way, from its samples: no more than STUDIO_LASSO_CORNERS, half a fiber
 * apart. Shape: points holds as many pairs as there are samples, and may be the samples. */
int studio_lasso_points(const double *samples, int count, double *points);

/* Zeros: nothing is known yet. */
struct studio_selection {
    int operations; /* of the history, that have been looked at */
    double *points; /* of the selection's outline, loop after loop; NULL: nothing is selected */
    int points_count;
    int *ends; /* of each loop: how many points there are up to its end */
    int loops;
    struct paper_drawing drawing; /* of what is selected */
    /* one for each fiber, 0..255; NULL: there is none */
    uint8_t *fluid, *frisket;
};
/* Looks at the operations that have been done since it looked last; after an undo `operations`
 * is set to 0 before. Errors: those of paper_history_arguments(). */
enum paper_status studio_selection_look(struct studio_selection *selection,
                                        const struct paper_sheet *sheet);
void studio_selection_free(struct studio_selection *selection);
/* Whether operation `number` selects something; whether it takes off what was around the
 * selection before, and so belongs to the one before it. */
bool studio_selection_begins(const struct paper_sheet *sheet, int number);
bool studio_selection_ends(const struct paper_sheet *sheet, int number);
/* What a screen covers of the selection is left of it. */
void studio_selection_clip(const struct studio_selection *selection, int width, int height,
                           struct paper_screen *screen, int x, int y);

/* What a polygon is to the selection; where nothing is selected, that is the whole sheet. The
 * inversion needs no polygon. */
enum studio_join { STUDIO_JOIN_NEW, STUDIO_JOIN_ADD, STUDIO_JOIN_SUBTRACT, STUDIO_JOIN_INVERT };

/* Everything around what is selected then, as a screen that knows what it was drawn from.
 * screen.gray NULL: nothing of it is on the sheet, or all of the sheet is; drawing.count 0:
 * the polygon has no area, or lies beyond the sheet. Errors: NO_MEMORY; BAD_ARGUMENT: a corner
 * lies too far away, or the drawing would be longer than PAPER_DRAWING_MOST, which is said in
 * no words. Owns: studio_around_free(). */
struct studio_around {
    struct paper_screen screen;
    struct paper_drawing drawing;
    int x, y;
};
enum paper_status studio_around_make(const struct studio_selection *selection,
                                     enum studio_join join, const double *points, int count,
                                     const struct paper_sheet_config *config,
                                     struct studio_around *out);
void studio_around_free(struct studio_around *around);

#endif
