/* gl_shapes.h - lines, discs, rings and boxes on a display, by OpenGL, their edges smooth.
 *
 *     struct gl_shapes *shapes;
 *     if (gl_shapes_create(glfwGetProcAddress, &shapes) != DISPLAY_OK)
 *         die(display_error());
 *     gl_shapes_begin(shapes, width_px, height_px);         // a frame, the context being current
 *     gl_shapes_bars(shapes, bars, count);
 *     gl_shapes_destroy(shapes);
 *
 * All are one shape, a bar: a box with round corners, turned. A fragment's part of it is found from the distance to its
 * edge, so that a bar thinner than a pixel is as much fainter, and nothing depends on multisampling.
 *
 *                      half_length
 *               ,-------------+-------------.
 *              (   radius     | half_width   )  --> (ux, uy)
 *               `---------------------------'
 *
 * A line has half_width as its radius; a disc half_length, too; a box has radius 0. With `ring` above 0 only the outline is
 * drawn, so wide, its middle on the edge.
 *
 * OpenGL 2.1 is enough. Blending, the program and the current colour are left changed. Where the framebuffer is encoded as
 * sRGB light is mixed, else numbers.
 *
 * Threads. That of the context, which must be the same, and current, in all calls. */
#ifndef LUTETIA_GL_SHAPES_H
#define LUTETIA_GL_SHAPES_H

#include "display.h"

struct gl_bar {
    float x_px, y_px; /* the middle; y downwards */
    float ux, uy;     /* along its length; of length 1 */
    float half_length_px, half_width_px, radius_px, ring_px;
    float color[4]; /* 0..1, as numbers of sRGB; and how much it covers of what is behind it */
};

struct gl_shapes;
/* function: finds OpenGL's functions by their names. Errors: NO_WINDOW (no OpenGL 2.1, or its shaders fail), NO_MEMORY. */
enum display_status gl_shapes_create(void (*(*function)(const char *name))(void),
                                     struct gl_shapes **out);
void gl_shapes_destroy(struct gl_shapes *shapes); /* NULL is fine */

/* A new frame: the size of the viewport, which is the picture's. */
void gl_shapes_begin(struct gl_shapes *shapes, int width_px, int height_px);

/* The whole picture in one colour. */
void gl_shapes_clear(struct gl_shapes *shapes, const float color[3]);

/* Bars, one over the other in that order. */
void gl_shapes_bars(struct gl_shapes *shapes, const struct gl_bar *bars, int count);

#endif
