/* renderer.c - see renderer.h. The list is drawn in runs: consecutive bars by one call,
 * consecutive glyphs by another. */
#include "renderer.h"
#include "font_axes.h"

#include <gl_offscreen.h>
#include <gl_shapes.h>
#include <gl_target.h>
#include <gl_type.h>
#include <srgb.h>

#include <stdlib.h>
#include <string.h>

/* A glyph must fit a page of glyphs: pages are twice as large as the picture, within these. */
enum { RUN = 512, PAGE_MIN = 2048, PAGE_MAX = 8192, PLACES = 8 };

struct stage_renderer {
    struct window *window;          /* or */
    struct gl_offscreen *offscreen; /* what is drawn to */
    struct gl_target *target;       /* of a window */
    struct gl_target *apart;        /* for pictures that are not shown; NULL: none yet */
    struct gl_type *type;
    struct gl_shapes *shapes;
    void (*(*function)(const char *name))(void);
    int width_px, height_px, page_px;
    struct gl_bar bars[RUN];
    struct gl_type_glyph glyphs[RUN];
};

static enum stage_status fail_display(enum display_status status)
{
    return stage_fail(status == DISPLAY_NO_MEMORY      ? STAGE_NO_MEMORY
                      : status == DISPLAY_BAD_ARGUMENT ? STAGE_BAD_ARGUMENT
                      : status == DISPLAY_NO_WINDOW    ? STAGE_NO_DISPLAY
                                                       : STAGE_FAILED,
                      "%s", display_error());
}

/* Makes the atlas of glyphs, and makes it again when the picture has become larger. */
static enum display_status type_make(struct stage_renderer *r, int width_px, int height_px)
{
    struct gl_type_def def = gl_type_def_default();
    int page_px = PAGE_MIN;
    while (page_px < PAGE_MAX && (page_px < 2 * width_px || page_px < 2 * height_px))
        page_px *= 2;
    if (r->type && page_px <= r->page_px)
        return DISPLAY_OK;
    gl_type_destroy(r->type);
    def.function = r->function;
    def.atlas.width_px = def.atlas.height_px = r->page_px = page_px;
    def.atlas.pages_max = 2;
    def.atlas.places_x = def.atlas.places_y = PLACES;
    enum display_status status = gl_type_create(&def, &r->type);
    while (status == DISPLAY_BAD_ARGUMENT &&
           page_px > PAGE_MIN / 2) { /* a small graphics card */
        page_px /= 2;
        def.atlas.width_px = def.atlas.height_px = page_px;
        status = gl_type_create(&def, &r->type);
    }
    return status;
}

static enum stage_status tools_make(struct stage_renderer *r)
{
    enum display_status status = type_make(r, r->width_px, r->height_px);
    if (status == DISPLAY_OK)
        status = gl_shapes_create(r->function, &r->shapes);
    return status == DISPLAY_OK ? STAGE_OK : fail_display(status);
}

enum stage_status stage_renderer_offscreen(enum stage_way way, int width_px, int height_px,
                                           struct stage_renderer **out)
{
    *out = NULL;
    struct stage_renderer *r = calloc(1, sizeof *r);
    if (!r)
        return stage_fail(STAGE_NO_MEMORY, "no memory to draw with OpenGL");
    r->width_px = width_px;
    r->height_px = height_px;
    enum display_status made =
        gl_offscreen_create_by(way == STAGE_BY_OSMESA ? GL_OFFSCREEN_OSMESA : GL_OFFSCREEN_EGL,
                               width_px, height_px, &r->offscreen);
    if (made == DISPLAY_OK)
        r->function = gl_offscreen_functions(r->offscreen);
    enum stage_status status = made == DISPLAY_OK ? tools_make(r) : fail_display(made);
    if (status == STAGE_OK)
        *out = r;
    else
        stage_renderer_destroy(r);
    return status;
}

enum stage_status stage_renderer_window(struct window *window, struct stage_renderer **out)
{
    *out = NULL;
    struct stage_renderer *r = calloc(1, sizeof *r);
    if (!r)
        return stage_fail(STAGE_NO_MEMORY, "no memory to draw with OpenGL");
    r->window = window;
    r->function = window_functions();
    window_frame_begin(window);
    window_size(window, &r->width_px, &r->height_px);
    enum display_status made = gl_target_create(r->function, &r->target);
    enum stage_status status = made == DISPLAY_OK ? tools_make(r) : fail_display(made);
    if (status == STAGE_OK)
        *out = r;
    else
        stage_renderer_destroy(r);
    return status;
}

void stage_renderer_destroy(struct stage_renderer *r)
{
    if (!r)
        return;
    if (r->window)
        window_frame_begin(r->window);
    gl_type_destroy(r->type);
    gl_shapes_destroy(r->shapes);
    gl_target_destroy(r->target);
    gl_target_destroy(r->apart);
    gl_offscreen_destroy(r->offscreen);
    free(r);
}

void stage_renderer_size(const struct stage_renderer *r, int *width_px, int *height_px)
{
    *width_px = r->width_px;
    *height_px = r->height_px;
    if (r->window)
        window_size(r->window, width_px, height_px);
}

/* ---- runs ---- */

static void color_put(struct stage_color color, float out[4])
{
    out[0] = color.r;
    out[1] = color.g;
    out[2] = color.b;
    out[3] = color.a;
}

/* Draws the run of bars from item i on; returns the item after them. */
static int bars_draw(struct stage_renderer *r, const struct stage_draw_list *list, int i)
{
    int count = 0;
    for (; i < list->count && list->items[i].kind == STAGE_DRAW_BAR && count < RUN; i++) {
        const struct stage_bar *b = &list->items[i].bar;
        struct gl_bar *to = &r->bars[count++];
        *to = (struct gl_bar){.x_px = (float)b->x_px,
                              .y_px = (float)b->y_px,
                              .ux = (float)b->ux,
                              .uy = (float)b->uy,
                              .half_length_px = (float)b->half_length_px,
                              .half_width_px = (float)b->half_width_px,
                              .radius_px = (float)b->radius_px,
                              .ring_px = (float)b->ring_px};
        color_put(list->items[i].color, to->color);
    }
    gl_shapes_bars(r->shapes, r->bars, count);
    return i;
}

/* Whether a glyph can be drawn by the call that draws the first one: faces have one setting of
 * their axes during a call. */
static bool is_of_run(const struct stage_glyph *first, const struct stage_glyph *g)
{
    if (!first->axes.count && !g->axes.count)
        return true;
    return g->face == first->face && stage_letter_axes_same(&g->axes, &first->axes);
}

static int glyphs_draw(struct stage_renderer *r, const struct stage_draw_list *list, int i,
                       enum display_status *status)
{
    const struct stage_glyph *first = &list->items[i].glyph;
    struct stage_letter_axes before;
    int count = 0, left_out;
    for (; i < list->count && list->items[i].kind == STAGE_DRAW_GLYPH && count < RUN; i++) {
        const struct stage_glyph *g = &list->items[i].glyph;
        if (!is_of_run(first, g))
            break;
        struct gl_type_glyph *to = &r->glyphs[count++];
        *to = (struct gl_type_glyph){.face = g->face,
                                     .glyph = g->glyph,
                                     .size_px = g->size_px,
                                     .map = g->map,
                                     .x_px = g->x_px,
                                     .y_px = g->y_px};
        color_put(list->items[i].color, to->color);
    }
    stage_letter_axes_put(first->face, &first->axes, &before);
    *status = gl_type_glyphs(r->type, r->glyphs, count, &left_out);
    stage_letter_axes_put(first->face, &before, NULL);
    return i;
}

static void image_draw(struct stage_renderer *r, const struct stage_image *i)
{
    const struct gl_image image = {.rgb = i->rgb,
                                   .width = i->width,
                                   .height = i->height,
                                   .x0_px = (float)i->x0_px,
                                   .y0_px = (float)i->y0_px,
                                   .x1_px = (float)i->x1_px,
                                   .y1_px = (float)i->y1_px};
    gl_shapes_image(r->shapes, &image);
}

static enum display_status frame_begin(struct stage_renderer *r)
{
    enum display_status status = DISPLAY_OK;
    if (r->window) {
        window_frame_begin(r->window);
        window_size(r->window, &r->width_px, &r->height_px);
        if (r->width_px < 1 || r->height_px < 1) /* an icon now */
            r->width_px = r->height_px = 1;
        status = gl_target_begin(r->target, r->width_px, r->height_px);
    }
    return status == DISPLAY_OK ? type_make(r, r->width_px, r->height_px) : status;
}

/* background[3]: its alpha; the colour is multiplied by it, as light. */
static enum display_status list_draw(struct stage_renderer *r,
                                     const struct stage_draw_list *list, int width_px,
                                     int height_px, const float background[4])
{
    enum display_status status = DISPLAY_OK;
    gl_type_begin(r->type, width_px, height_px);
    gl_shapes_begin(r->shapes, width_px, height_px);
    gl_shapes_clear(r->shapes, background);
    for (int i = 0; i < list->count && status == DISPLAY_OK;)
        switch (list->items[i].kind) {
        case STAGE_DRAW_BAR:
            i = bars_draw(r, list, i);
            break;
        case STAGE_DRAW_GLYPH:
            i = glyphs_draw(r, list, i, &status);
            break;
        case STAGE_DRAW_IMAGE:
            image_draw(r, &list->items[i++].image);
            break;
        }
    return status;
}

enum stage_status stage_renderer_draw(struct stage_renderer *r,
                                      const struct stage_draw_list *list,
                                      struct stage_color background)
{
    const float opaque[] = {background.r, background.g, background.b, 1};
    if (list->incomplete)
        return stage_fail(STAGE_NO_MEMORY, "no memory for all that is to be drawn");
    enum display_status status = frame_begin(r);
    if (status != DISPLAY_OK)
        return fail_display(status);
    status = list_draw(r, list, r->width_px, r->height_px, opaque);
    if (r->window) {
        gl_target_show(r->target);
        window_frame_end(r->window);
    }
    return status == DISPLAY_OK ? STAGE_OK : fail_display(status);
}

enum stage_status stage_renderer_apart(struct stage_renderer *r,
                                       const struct stage_draw_list *list,
                                       struct stage_color background, int width_px,
                                       int height_px, bool alpha, struct display_image *image)
{
    const float a = alpha ? background.a : 1;
    float clear[4] = {background.r, background.g, background.b, a};
    for (int i = 0; i < 3 && a < 1; i++)
        clear[i] = (float)srgb_number(srgb_light(clear[i]) * a);
    if (list->incomplete)
        return stage_fail(STAGE_NO_MEMORY, "no memory for all that is to be drawn");
    if (r->window)
        window_frame_begin(r->window);
    enum display_status status =
        r->apart ? DISPLAY_OK : gl_target_create(r->function, &r->apart);
    if (status == DISPLAY_OK)
        status = gl_target_begin(r->apart, width_px, height_px);
    if (status == DISPLAY_OK)
        status = type_make(r, width_px, height_px);
    if (status == DISPLAY_OK)
        status = list_draw(r, list, width_px, height_px, clear);
    if (status == DISPLAY_OK)
        status = (alpha ? gl_target_read_alpha : gl_target_read)(r->apart, image);
    return status == DISPLAY_OK ? STAGE_OK : fail_display(status);
}

enum stage_status stage_renderer_read(struct stage_renderer *r, struct display_image *image)
{
    enum display_status status;
    if (r->window) {
        window_frame_begin(r->window);
        status = gl_target_read(r->target, image);
    } else {
        display_image_destroy(image);
        status = gl_offscreen_read(r->offscreen, image);
    }
    return status == DISPLAY_OK ? STAGE_OK : fail_display(status);
}
