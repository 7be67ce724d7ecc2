/* studio_view.c - see studio_view.h. */
#include "studio_view.h"

#include <math.h>

struct studio_place studio_view_to_sheet(const struct studio_view *view, double x, double y)
{
    const double right = (x - view->width / 2) / view->zoom,
                 down = (y - view->height / 2) / view->zoom, c = cos(view->turn),
                 s = sin(view->turn), along = c * right + s * down;
    return (struct studio_place){view->x0 + (view->mirrored ? -along : along),
                                 view->y0 - s * right + c * down};
}

struct studio_place studio_view_to_canvas(const struct studio_view *view, double x, double y)
{
    const double along = view->mirrored ? view->x0 - x : x - view->x0, down = y - view->y0,
                 c = cos(view->turn), s = sin(view->turn);
    return (struct studio_place){view->width / 2 + view->zoom * (c * along - s * down),
                                 view->height / 2 + view->zoom * (s * along + c * down)};
}

void studio_view_fit(struct studio_view *view, int sheet_width, int sheet_height)
{
    const double margin = 0.96, along = margin * view->width / sheet_width,
                 down = margin * view->height / sheet_height;
    view->x0 = sheet_width / 2.0;
    view->y0 = sheet_height / 2.0;
    view->zoom = fmin(1, fmax(STUDIO_ZOOM_MIN, fmin(along, down)));
    view->turn = 0;
    view->mirrored = false;
}

/* Moves the sheet so that `place` of it lies at x, y of the canvas. */
static void hold(struct studio_view *view, struct studio_place place, double x, double y)
{
    const struct studio_place now = studio_view_to_sheet(view, x, y);
    view->x0 += place.x - now.x;
    view->y0 += place.y - now.y;
}

void studio_view_zoom(struct studio_view *view, double factor, double x, double y)
{
    const struct studio_place place = studio_view_to_sheet(view, x, y);
    view->zoom = fmin(STUDIO_ZOOM_MAX, fmax(STUDIO_ZOOM_MIN, view->zoom * factor));
    hold(view, place, x, y);
}

void studio_view_turn(struct studio_view *view, double by, double x, double y)
{
    const struct studio_place place = studio_view_to_sheet(view, x, y);
    view->turn = remainder(view->turn + by, 8 * atan(1));
    hold(view, place, x, y);
}

void studio_view_mirror(struct studio_view *view)
{
    view->mirrored = !view->mirrored;
    view->turn = -view->turn;
}

void studio_view_pan(struct studio_view *view, double by_x, double by_y)
{
    const struct studio_place place =
        studio_view_to_sheet(view, view->width / 2 - by_x, view->height / 2 - by_y);
    view->x0 = place.x;
    view->y0 = place.y;
}
