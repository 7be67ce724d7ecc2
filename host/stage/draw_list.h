/* draw_list.h - a picture as a list of shapes, from back to front: letters under any map,
 * lines, discs, rings, boxes, images. Actors write it; renderer.h draws it by OpenGL and
 * exact.h through fontpipe's filter.
 *
 *     struct stage_draw_list list = {0};
 *     stage_draw_begin(&list, view);                         // the world: y upwards
 *     stage_draw_line(&list, 0, 0, 3, 0, 2, floor_color);
 *     stage_draw_letter(&list, &letter, corners, ink);
 *     ...
 *     stage_draw_finish(&list);
 *
 * Units. Places are in the world's units, and are converted by the list's present view;
 * widths are in pixels. Items are stored in pixels, y downwards. Errors. If memory is short,
 * the list is incomplete, and drawing it returns the error. Shapes at places that are not
 * finite or far outside of any picture are left out. Threads. A list belongs to one thread
 * at a time.
 */
#ifndef LUTETIA_STAGE_DRAW_LIST_H
#define LUTETIA_STAGE_DRAW_LIST_H

#include <edges.h>
#include <text.h>

#include "theme.h"

#include <stdbool.h>

/* From the world to pixels: x_px = x0_px + scale x, y_px = y0_px - scale y. */
struct stage_view {
    double scale, x0_px, y0_px;
};
/* A view for places in pixels: y is downwards. */
#define STAGE_VIEW_PIXELS ((struct stage_view){0, 0, 0})

enum stage_draw_kind { STAGE_DRAW_BAR, STAGE_DRAW_GLYPH, STAGE_DRAW_IMAGE };

struct stage_bar {
    double x_px, y_px, ux, uy;
    double half_length_px, half_width_px, radius_px;
    double ring_px; /* 0: filled; else the width of its outline */
};

/* Axes of a variable font that one letter has otherwise than its face (font_axes.h). */
enum { STAGE_LETTER_AXES_MAX = 4 };
struct stage_letter_axis {
    char tag[5];
    double value;
};
struct stage_letter_axes {
    int count;
    struct stage_letter_axis axes[STAGE_LETTER_AXES_MAX];
};

struct stage_glyph {
    struct font_face *face;
    uint32_t glyph;
    double size_px;
    struct font_map map; /* from the glyph at that size to the picture */
    double x_px,
        y_px; /* of its origin, if the map is affine; the map's translation is then not used */
    struct stage_letter_axes axes;
};

/* An image in a box; between its pixels it is linear. */
struct stage_image {
    const uint8_t *rgb; /* rows from the top, sRGB numbers; borrowed until the list is drawn */
    int width, height;
    double x0_px, y0_px, x1_px, y1_px;
};

struct stage_item {
    enum stage_draw_kind kind;
    struct stage_color color;
    union {
        struct stage_bar bar;
        struct stage_glyph glyph;
        struct stage_image image;
    };
};

/* All zeros is an empty list. */
struct stage_draw_list {
    struct stage_item *items;
    int count, capacity;
    struct stage_view view;
    bool incomplete;
};

void stage_draw_finish(struct stage_draw_list *list); /* frees; zeros it */

/* Empties the list and keeps its memory for reuse. */
void stage_draw_begin(struct stage_draw_list *list, struct stage_view view);
/* Sets the view of the following shapes. */
void stage_draw_view(struct stage_draw_list *list, struct stage_view view);

void stage_draw_line(struct stage_draw_list *list, double x0, double y0, double x1, double y1,
                     double width_px, struct stage_color color);
void stage_draw_disc(struct stage_draw_list *list, double x, double y, double radius_px,
                     struct stage_color color);
void stage_draw_ring(struct stage_draw_list *list, double x, double y, double radius_px,
                     double width_px, struct stage_color color);
/* A box between two opposite corners, with round corners; ring_px above 0: its outline. */
void stage_draw_box(struct stage_draw_list *list, double x0, double y0, double x1, double y1,
                    double radius_px, double ring_px, struct stage_color color);

/* A letter, and the box of its plane that is mapped to the corners. */
struct stage_letter {
    struct font_face *face;
    uint32_t glyph;
    double size; /* the length of an em in the plane; y is downwards, the origin is on the
                  * baseline */
    double x0, y0, x1, y1; /* the box that is mapped to the corners */
    struct stage_letter_axes axes;
};

/* A letter whose corners are further apart, along x or y, is left out: only part of a stroke
 * would be visible. */
enum { STAGE_LETTER_MAX_PX = 8192 };

/* The letter with its box's corners (x0, y0), (x1, y0), (x1, y1), (x0, y1) at these places.
 * The map is projective for clearly convex corners, bilinear for others, and continuous in
 * between (font_map_corners()). */
void stage_draw_letter(struct stage_draw_list *list, const struct stage_letter *letter,
                       const struct font_point corners[4], struct stage_color color);

/* Draws a layout with its origin at that place, at its own size in pixels. */
void stage_draw_text(struct stage_draw_list *list, const struct font_layout *layout, double x,
                     double y, struct stage_color color);

/* An image that fills the box between two opposite corners and hides what is behind it. */
void stage_draw_image(struct stage_draw_list *list, const uint8_t *rgb, int width, int height,
                      double x0, double y0, double x1, double y1);

/* Appends another list, or its letters only, moved by that many pixels. tint: in that
 * colour, with the product of the opacities; NULL: unchanged. fade: 0..1, a factor of the
 * opacity. */
void stage_draw_again(struct stage_draw_list *list, const struct stage_draw_list *other,
                      double x_px, double y_px, const struct stage_color *tint, double fade,
                      bool letters_only);

/* Appends another list, `scale` times as large and then moved by that many pixels. */
void stage_draw_scaled(struct stage_draw_list *list, const struct stage_draw_list *other,
                       double scale, double x_px, double y_px);

/* ---- places ---- */

void stage_view_to_px(struct stage_view view, double x, double y, double *x_px, double *y_px);
void stage_view_to_world(struct stage_view view, double x_px, double y_px, double *x,
                         double *y);

#endif
