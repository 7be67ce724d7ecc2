/* exact.h - a draw list as a picture of the best quality: every shape through fontpipe's filter, mixed as light. No OpenGL, no
 * display. For stills and films, and what the other ways are compared with.
 *
 *     struct stage_exact *exact;
 *     stage_exact_create("gaussian-fast", &exact);
 *     struct display_image image = {.width_px = 800, .height_px = 600, .channels = 3};
 *     display_image_create(&image);
 *     stage_exact_draw(exact, &list, theme.colors[STAGE_COLOR_BACKGROUND], &image);
 *     stage_exact_destroy(exact);
 *
 * A letter is its outline under its map, filtered: what the filter says of each pixel, and no more. Lines, discs and boxes
 * are outlines, too.
 *
 * Threads. One belongs to one thread at a time. */
#ifndef LUTETIA_STAGE_EXACT_H
#define LUTETIA_STAGE_EXACT_H

#include <display.h>

#include "draw_list.h"

struct stage_exact;
/* filter: by its name (filter.h of fontpipe). Errors: BAD_ARGUMENT, NO_MEMORY. */
enum stage_status stage_exact_create(const char *filter, struct stage_exact **out);
void stage_exact_destroy(struct stage_exact *exact); /* NULL is fine */

/* Draws into an image of three channels. What a map sends beyond the horizon, and what is too large to be filtered, is left out.
 * Errors: NO_MEMORY. */
enum stage_status stage_exact_draw(struct stage_exact *exact,
                                   const struct stage_draw_list *list,
                                   struct stage_color background, struct display_image *image);

/* How many letters the last picture left out. */
int stage_exact_left_out(const struct stage_exact *exact);

#endif
