/* gl_offscreen.h - OpenGL without a window; the result is read as an image.
 *
 *     struct gl_offscreen *screen;
 *     if (gl_offscreen_create(640, 480, &screen) != DISPLAY_OK)
 *         die(display_error());
 *     ...draw, with the functions that gl_offscreen_function() finds...
 *     gl_offscreen_read(screen, &image);
 *     gl_offscreen_destroy(screen);
 *
 * A context is made in one of two ways. EGL makes one without a surface, and uses the graphics
 * card if it can. OSMesa is a software renderer in a library: it needs no display, no EGL and
 * no graphics card. The libraries are loaded when a context is made, so the program starts
 * without them. The framebuffer is encoded as sRGB: with GL_FRAMEBUFFER_SRGB enabled, colours
 * are linear light and blending mixes light.
 *
 * Threads. The context belongs to the thread that created it, which can have one at a time.
 */
#ifndef LUTETIA_GL_OFFSCREEN_H
#define LUTETIA_GL_OFFSCREEN_H

#include "display.h"

struct gl_offscreen;

enum { GL_OFFSCREEN_SIDE_MAX = 8192 };

/* Black at first; the viewport is all of it. Errors: BAD_ARGUMENT (1..GL_OFFSCREEN_SIDE_MAX a
 * side), NO_WINDOW (no EGL, or no OpenGL 3 by it), NO_MEMORY. */
enum display_status gl_offscreen_create(int width_px, int height_px, struct gl_offscreen **out);
void gl_offscreen_destroy(struct gl_offscreen *screen); /* NULL is fine */

enum gl_offscreen_way { GL_OFFSCREEN_EGL, GL_OFFSCREEN_OSMESA };
/* The same in a given way; gl_offscreen_create() uses EGL. Errors: NO_WINDOW says what is
 * missing, for example that this lutetia was built without OSMesa. */
enum display_status gl_offscreen_create_by(enum gl_offscreen_way way, int width_px,
                                           int height_px, struct gl_offscreen **out);

/* The function that finds OpenGL's functions by name in this screen's way. */
typedef void (*gl_offscreen_find(const char *name))(void);
gl_offscreen_find *gl_offscreen_functions(const struct gl_offscreen *screen);

/* Finds a function of OpenGL by its name through EGL, without a screen; NULL if there is
 * none. */
void (*gl_offscreen_function(const char *name))(void);

/* Fills the screen with one colour, given as sRGB numbers 0..1. */
void gl_offscreen_clear(struct gl_offscreen *screen, const double color[3]);

/* Reads the picture as red, green, blue. Errors: NO_MEMORY. Owns: the caller destroys
 * *image. */
enum display_status gl_offscreen_read(struct gl_offscreen *screen, struct display_image *image);

#endif
