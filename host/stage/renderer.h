/* renderer.h - a draw list drawn by OpenGL, in one of three ways: in a window (GLFW), without a
 * surface (EGL), or by a software renderer (OSMesa). The drawing code is the same in all.
 *
 *     struct stage_renderer *renderer;
 *     if (stage_renderer_offscreen(GL_OFFSCREEN_OSMESA, 800, 600, &renderer) != STAGE_OK)
 *         die(stage_error());
 *     stage_renderer_draw(renderer, &list, theme.colors[STAGE_COLOR_BACKGROUND]);
 *     stage_renderer_read(renderer, &image);
 *     stage_renderer_destroy(renderer);
 *
 * A letter is its mapped outline, filtered by fontpipe when its map is new, and kept as a
 * texture while the map stays. Lines, discs and boxes are computed by the fragment shader.
 * Colours are mixed as light.
 *
 * Threads. That which created it; one renderer draws at a time.
 */
#ifndef LUTETIA_STAGE_RENDERER_H
#define LUTETIA_STAGE_RENDERER_H

#include <display.h>
#include <window.h>

#include "draw_list.h"

struct stage_renderer;

enum stage_way { STAGE_BY_EGL, STAGE_BY_OSMESA };

/* Errors: BAD_ARGUMENT (the size), NO_DISPLAY (no OpenGL in that way: what is missing, or that
 * this build has none), NO_MEMORY. */
enum stage_status stage_renderer_offscreen(enum stage_way way, int width_px, int height_px,
                                           struct stage_renderer **out);
/* window: borrowed; must be drawn by the caller. Pictures have the window's present size. */
enum stage_status stage_renderer_window(struct window *window, struct stage_renderer **out);
void stage_renderer_destroy(struct stage_renderer *renderer); /* NULL is fine */

void stage_renderer_size(const struct stage_renderer *renderer, int *width_px, int *height_px);

/* Draws the list, and shows it if there is a window. Shapes that a map sends beyond the
 * horizon are left out. Errors: NO_MEMORY, FAILED. */
enum stage_status stage_renderer_draw(struct stage_renderer *renderer,
                                      const struct stage_draw_list *list,
                                      struct stage_color background);

/* Reads the last picture as red, green, blue. An image of the same size is reused. Errors:
 * NO_MEMORY. Owns: the caller destroys *image. */
enum stage_status stage_renderer_read(struct stage_renderer *renderer,
                                      struct display_image *image);

/* Draws the list into *image, of a size of its own, and shows it nowhere: 3 channels, or 4 with
 * the background's alpha. The image is reused as above. Errors: as those of both. */
enum stage_status stage_renderer_apart(struct stage_renderer *renderer,
                                       const struct stage_draw_list *list,
                                       struct stage_color background, int width_px,
                                       int height_px, bool alpha, struct display_image *image);

#endif
