/* gl_offscreen.h - OpenGL without a window: what a display would show, as an image.
 *
 *     struct gl_offscreen *screen;
 *     if (gl_offscreen_create(640, 480, &screen) != DISPLAY_OK)
 *         die(display_error());
 *     ...draw, with the functions that gl_offscreen_function() finds...
 *     gl_offscreen_read(screen, &image);
 *     gl_offscreen_destroy(screen);
 *
 * There are two ways to a context. EGL makes one without a surface and takes the graphics card if it can. OSMesa is a library that
 * draws by itself: it wants no display, no EGL and no graphics card. Each is looked for when one is asked for: the program
 * starts where there is neither. What is drawn to is encoded as sRGB: with GL_FRAMEBUFFER_SRGB enabled colours are light, and light is mixed.
 *
 * Threads. The context belongs to the thread that created it, which can have one at a time. */
#ifndef LUTETIA_GL_OFFSCREEN_H
#define LUTETIA_GL_OFFSCREEN_H

#include "display.h"

struct gl_offscreen;

enum { GL_OFFSCREEN_SIDE_MAX = 8192 };

/* Black at first; the viewport is all of it. Errors: BAD_ARGUMENT (1..GL_OFFSCREEN_SIDE_MAX a side), NO_WINDOW (no EGL, or
 * no OpenGL 3 by it), NO_MEMORY. */
enum display_status gl_offscreen_create(int width_px, int height_px, struct gl_offscreen **out);
void gl_offscreen_destroy(struct gl_offscreen *screen); /* NULL is fine */

enum gl_offscreen_way { GL_OFFSCREEN_EGL, GL_OFFSCREEN_OSMESA };
/* The same in one way or the other; gl_offscreen_create() is by EGL. Errors: NO_WINDOW says what is missing, which may be that
 * this lutetia was built without OSMesa. */
enum display_status gl_offscreen_create_by(enum gl_offscreen_way way, int width_px,
                                           int height_px, struct gl_offscreen **out);

/* What finds functions of OpenGL by their names: that of the screen's own way. */
typedef void (*gl_offscreen_find(const char *name))(void);
gl_offscreen_find *gl_offscreen_functions(const struct gl_offscreen *screen);

/* EGL's, without a screen: of OpenGL, by its name; NULL: there is none. */
void (*gl_offscreen_function(const char *name))(void);

/* All of one colour, 0..1, as numbers of sRGB. */
void gl_offscreen_clear(struct gl_offscreen *screen, const double color[3]);

/* What has been drawn: red, green, blue. Errors: NO_MEMORY. Owns: the caller destroys *image. */
enum display_status gl_offscreen_read(struct gl_offscreen *screen, struct display_image *image);

#endif
