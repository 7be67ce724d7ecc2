/* renderer_none.c - replaces renderer.c in builds without OpenGL: making a renderer fails
 * with a message, and functions that take one are never called. */
#include "renderer.h"

#include <stdlib.h>

static enum stage_status none(struct stage_renderer **out)
{
    *out = NULL;
    return stage_fail(STAGE_NO_DISPLAY,
                      "this lutetia was built without OpenGL (libglfw3-dev or "
                      "libegl-dev was not there)");
}

enum stage_status stage_renderer_offscreen(enum stage_way way, int width_px, int height_px,
                                           struct stage_renderer **out)
{
    (void)way, (void)width_px, (void)height_px;
    return none(out);
}

enum stage_status stage_renderer_window(struct window *window, struct stage_renderer **out)
{
    (void)window;
    return none(out);
}

void stage_renderer_destroy(struct stage_renderer *renderer)
{
    if (renderer)
        abort();
}

void stage_renderer_size(const struct stage_renderer *renderer, int *width_px, int *height_px)
{
    (void)renderer, (void)width_px, (void)height_px;
    abort();
}

enum stage_status stage_renderer_draw(struct stage_renderer *renderer,
                                      const struct stage_draw_list *list,
                                      struct stage_color background)
{
    (void)renderer, (void)list, (void)background;
    abort();
}

enum stage_status stage_renderer_read(struct stage_renderer *renderer,
                                      struct display_image *image)
{
    (void)renderer, (void)image;
    abort();
}

enum stage_status stage_renderer_apart(struct stage_renderer *renderer,
                                       const struct stage_draw_list *list,
                                       struct stage_color background, int width_px,
                                       int height_px, bool alpha, struct display_image *image)
{
    (void)renderer, (void)list, (void)background, (void)width_px, (void)height_px;
    (void)alpha, (void)image;
    abort();
}
