/* renderer.h - a draw list drawn by OpenGL, in one of three ways: in a window (GLFW), without a surface (EGL), or by a library
 * that draws itself (OSMesa). What draws is the same in all.
 *
 *     struct stage_renderer *renderer;
 *     if (stage_renderer_offscreen(GL_OFFSCREEN_OSMESA, 800, 600, &renderer) != STAGE_OK)
 *         die(stage_error());
 *     stage_renderer_draw(renderer, &list, theme.colors[STAGE_COLOR_BACKGROUND]);
 *     stage_renderer_read(renderer, &image);
 *     stage_renderer_destroy(renderer);
 *
 * Letters are their outlines under their maps, filtered as fontpipe does it when the map is new, and kept as textures while it
 * stays; lines, discs and boxes are found by fragments. Light is mixed, not numbers.
 *
 * Threads. That which created it; one renderer draws at a time. */
#ifndef LUTETIA_STAGE_RENDERER_H
#define LUTETIA_STAGE_RENDERER_H

#include <display.h>
#include <window.h>

#include "draw_list.h"

struct stage_renderer;

enum stage_way { STAGE_BY_EGL, STAGE_BY_OSMESA };

/* Errors: BAD_ARGUMENT (the size), NO_DISPLAY (no OpenGL in that way: what is missing, or that this build has none),
 * NO_MEMORY. */
enum stage_status stage_renderer_offscreen(enum stage_way way, int width_px, int height_px,
                                           struct stage_renderer **out);
/* window: borrowed; one that is drawn by the caller. Pictures are as large as it is at the time. */
enum stage_status stage_renderer_window(struct window *window, struct stage_renderer **out);
void stage_renderer_destroy(struct stage_renderer *renderer); /* NULL is fine */

void stage_renderer_size(const struct stage_renderer *renderer, int *width_px, int *height_px);

/* Draws, and shows it where there is a window. What a map sends beyond the horizon is left out. Errors: NO_MEMORY, FAILED. */
enum stage_status stage_renderer_draw(struct stage_renderer *renderer,
                                      const struct stage_draw_list *list,
                                      struct stage_color background);

/* What was drawn last, red, green, blue. An image of that size is used again. Errors: NO_MEMORY. Owns: the caller destroys *image. */
enum stage_status stage_renderer_read(struct stage_renderer *renderer,
                                      struct display_image *image);

#endif
