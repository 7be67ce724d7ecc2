/* gl_ink.h - gradients and pictures as ink, by a shader: what letters are filled with that is
 * not one colour.
 *
 *     // the coverage's texture is bound to unit 0
 *     gl_ink_use(ink, &layout.inks[0], x_px, y_px, height_px, light);
 *     ...quads...
 *     gl_ink_leave(ink);
 *
 * Each pixel gets what font_ink_at() says at its centre, as numbers of sRGB or, if the
 * framebuffer mixes light, as light. */
#ifndef LUTETIA_GL_INK_H
#define LUTETIA_GL_INK_H

#include <ink.h>

#include "display.h"

struct gl_ink;
/* function: finds OpenGL's functions. Errors: NO_MEMORY, NO_WINDOW (no OpenGL 2.1 with
 * shaders). */
enum display_status gl_ink_create(void (*(*function)(const char *name))(void),
                                  struct gl_ink **out);
void gl_ink_destroy(struct gl_ink *ink); /* NULL is fine */

/* Fills with an ink, a gradient or a picture, whose places are counted from (x_px, y_px) of a
 * viewport so high. light: the framebuffer mixes light. Errors: BAD_ARGUMENT (what
 * font_ink_check() refuses), NO_MEMORY (a picture that the display has no room for). */
enum display_status gl_ink_use(struct gl_ink *ink, const struct font_ink *of, double x_px,
                               double y_px, int height_px, bool light);
void gl_ink_leave(struct gl_ink *ink);

#endif
