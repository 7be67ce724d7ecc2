/* gl_shapes.h - lines, discs, rings, boxes and images on a display, by OpenGL, their edges
 * smooth.
 *
 *     struct gl_shapes *shapes;
 *     if (gl_shapes_create(glfwGetProcAddress, &shapes) != DISPLAY_OK)
 *         die(display_error());
 *     // a frame, the context being current
 *     gl_shapes_begin(shapes, width_px, height_px);
 *     gl_shapes_bars(shapes, bars, count);
 *     gl_shapes_destroy(shapes);
 *
 * Every shape is a bar: a rotated box with round corners. A fragment's coverage is computed
 * from the distance to the bar's edge, so a bar thinner than a pixel is fainter in proportion,
 * and nothing depends on multisampling.
 *
 *                      half_length
 *               ,-------------+-------------.
 *              (   radius     | half_width   )  --> (ux, uy)
 *               `---------------------------'
 *
 * A line has radius = half_width; a disc has radius = half_width = half_length; a box has
 * radius 0. With `ring` above 0 only an outline of that width is drawn, centred on the edge.
 *
 * OpenGL 2.1 is enough. The calls change the blend state, the program and the current colour.
 * If the framebuffer is encoded as sRGB, light is mixed, else numbers.
 *
 * Threads. That of the context, which must be the same, and current, in all calls.
 */
#ifndef LUTETIA_GL_SHAPES_H
#define LUTETIA_GL_SHAPES_H

#include "display.h"

#include <stdint.h>

struct gl_bar {
    float x_px, y_px; /* the middle; y downwards */
    float ux, uy;     /* along its length; of length 1 */
    float half_length_px, half_width_px, radius_px, ring_px;
    float color[4]; /* sRGB numbers 0..1, and opacity */
};

/* An image in a box, linear between its pixels. */
struct gl_image {
    const uint8_t *rgb; /* rows from the top, sRGB numbers */
    int width, height;
    float x0_px, y0_px, x1_px, y1_px;
};

struct gl_shapes;
/* function: finds OpenGL's functions by their names. Errors: NO_WINDOW (no OpenGL 2.1, or its
 * shaders fail), NO_MEMORY. */
enum display_status gl_shapes_create(void (*(*function)(const char *name))(void),
                                     struct gl_shapes **out);
void gl_shapes_destroy(struct gl_shapes *shapes); /* NULL is fine */

/* A new frame: the size of the viewport, which is the picture's. */
void gl_shapes_begin(struct gl_shapes *shapes, int width_px, int height_px);

/* The whole picture in one colour, and its alpha. What is drawn over alpha leaves colours that
 * are multiplied by it, as light. */
void gl_shapes_clear(struct gl_shapes *shapes, const float color[4]);

/* Draws the bars in order, later ones over earlier ones. */
void gl_shapes_bars(struct gl_shapes *shapes, const struct gl_bar *bars, int count);

/* Draws the image over what is there. */
void gl_shapes_image(struct gl_shapes *shapes, const struct gl_image *image);

#endif
