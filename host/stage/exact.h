/* exact.h - draws a list at the best quality: every shape through fontpipe's filter, mixed as
 * light, without OpenGL and without a display. For stills and films, and as the reference for
 * other ways.
 *
 *     struct stage_exact *exact;
 *     stage_exact_create("gaussian-fast", &exact);
 *     struct display_image image = {.width_px = 800, .height_px = 600, .channels = 3};
 *     display_image_create(&image);
 *     stage_exact_draw(exact, &list, theme.colors[STAGE_COLOR_BACKGROUND], &image);
 *     stage_exact_destroy(exact);
 *
 * A letter is its mapped outline, filtered. Lines, discs and boxes are outlines, too.
 *
 * Threads. One belongs to one thread at a time.
 */
#ifndef LUTETIA_STAGE_EXACT_H
#define LUTETIA_STAGE_EXACT_H

#include <display.h>

#include "draw_list.h"

struct stage_exact;
/* filter: by its name (filter.h of fontpipe). Errors: BAD_ARGUMENT, NO_MEMORY. */
enum stage_status stage_exact_create(const char *filter, struct stage_exact **out);
void stage_exact_destroy(struct stage_exact *exact); /* NULL is fine */

/* Draws into an image of three channels, on the background's colour, or of four, on the
 * background with its opacity. Shapes that a map sends beyond the horizon, or that are too
 * large to be filtered, are left out. Errors: NO_MEMORY. */
enum stage_status stage_exact_draw(struct stage_exact *exact,
                                   const struct stage_draw_list *list,
                                   struct stage_color background, struct display_image *image);

/* The number of letters that the last picture left out. */
int stage_exact_left_out(const struct stage_exact *exact);

#endif
