/* studio_view.h - where on the canvas a sheet's place is, and back.
 *
 *     struct studio_view view = {.width = 800, .height = 600};
 *     studio_view_fit(&view, 1024, 768);
 *     struct studio_place place = studio_view_to_sheet(&view, pointer_x, pointer_y);
 *
 * The sheet's place (x, y) in fibers, fiber i reaching from i to i + 1, lies at
 *
 *     middle of the canvas + zoom * turned by `turn` (mirrored if so: -(x - x0), else x - x0; y - y0)
 *
 * in the canvas's own units, which are GTK's: one is one or more pixels of the screen. So
 * nothing depends on the screen's scale. Angles are radians, from x towards y. */
#ifndef LUTETIA_STUDIO_VIEW_H
#define LUTETIA_STUDIO_VIEW_H

#include <stdbool.h>

#define STUDIO_ZOOM_MIN 0.05
#define STUDIO_ZOOM_MAX 32.0

struct studio_view {
    double width, height; /* of the canvas */
    double x0, y0;        /* the sheet's place in the middle of it */
    double zoom;          /* units of the canvas for a fiber */
    double turn;
    bool mirrored;
};

struct studio_place {
    double x, y;
};

struct studio_place studio_view_to_sheet(const struct studio_view *view, double x, double y);
struct studio_place studio_view_to_canvas(const struct studio_view *view, double x, double y);

/* The whole sheet is seen, upright, with a margin; not larger than it is. */
void studio_view_fit(struct studio_view *view, int sheet_width, int sheet_height);
/* These keep what lies under a place of the canvas where it is. */
void studio_view_zoom(struct studio_view *view, double factor, double x, double y);
void studio_view_turn(struct studio_view *view, double by, double x, double y);
/* Left and right are exchanged about the middle of the canvas. */
void studio_view_mirror(struct studio_view *view);
/* The sheet follows a hand. */
void studio_view_pan(struct studio_view *view, double by_x, double by_y);

#endif
