/* gl_target.h - a framebuffer that is drawn to in place of a window's own, and then copied to
 * the window. So colours are mixed as light whatever the window's format is, and the picture
 * can be read back.
 *
 *     struct gl_target *target;
 *     if (gl_target_create(glfwGetProcAddress, &target) != DISPLAY_OK)
 *         die(display_error());
 *     gl_target_begin(target, width_px, height_px);          // a frame
 *     ...draw...
 *     gl_target_show(target);                                // into the window's framebuffer
 *     gl_target_destroy(target);
 *
 * Threads. That of the context, which must be the same, and current, in all calls.
 */
#ifndef LUTETIA_GL_TARGET_H
#define LUTETIA_GL_TARGET_H

#include "display.h"

struct gl_target;
/* Errors: NO_WINDOW (no OpenGL 3), NO_MEMORY. */
enum display_status gl_target_create(void (*(*function)(const char *name))(void),
                                     struct gl_target **out);
void gl_target_destroy(struct gl_target *target); /* NULL is fine */

/* Directs drawing to the target. Errors: NO_MEMORY (the graphics card's, for so large a
 * picture). */
enum display_status gl_target_begin(struct gl_target *target, int width_px, int height_px);

/* Copies the picture into the window, to which drawing then goes. */
void gl_target_show(struct gl_target *target);

/* Reads the picture as red, green, blue; drawing goes to where it went before
 * gl_target_begin() then. An image of the same size is reused, else one is created. Errors:
 * NO_MEMORY. Owns: the caller destroys *image. */
enum display_status gl_target_read(struct gl_target *target, struct display_image *image);
/* The same with alpha, which the colours that are read are not multiplied by any more. */
enum display_status gl_target_read_alpha(struct gl_target *target, struct display_image *image);

#endif
