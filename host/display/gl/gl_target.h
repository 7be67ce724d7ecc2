/* gl_target.h - a picture that is drawn to in place of a window's own, and then shown there: so that colours mix as light
 * whatever the window has, and what is shown can be read.
 *
 *     struct gl_target *target;
 *     if (gl_target_create(glfwGetProcAddress, &target) != DISPLAY_OK)
 *         die(display_error());
 *     gl_target_begin(target, width_px, height_px);          // a frame
 *     ...draw...
 *     gl_target_show(target);                                // into the window's framebuffer
 *     gl_target_destroy(target);
 *
 * Threads. That of the context, which must be the same, and current, in all calls. */
#ifndef LUTETIA_GL_TARGET_H
#define LUTETIA_GL_TARGET_H

#include "display.h"

struct gl_target;
/* Errors: NO_WINDOW (no OpenGL 3), NO_MEMORY. */
enum display_status gl_target_create(void (*(*function)(const char *name))(void),
                                     struct gl_target **out);
void gl_target_destroy(struct gl_target *target); /* NULL is fine */

/* What is drawn from now on goes there. Errors: NO_MEMORY (of the graphics card: so large a picture). */
enum display_status gl_target_begin(struct gl_target *target, int width_px, int height_px);

/* The picture into the window, which is drawn to from now on. */
void gl_target_show(struct gl_target *target);

/* What has been drawn: red, green, blue. An image of that size is used again, else one is created. Errors: NO_MEMORY.
 * Owns: the caller destroys *image. */
enum display_status gl_target_read(struct gl_target *target, struct display_image *image);

#endif
