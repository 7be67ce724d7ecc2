/* desk_area.c - see desk_area.h.
 *
 *     framebuffer -> what has changed, read back -> pixels -> tiles that it touches -> nodes
 *
 * Tiles have whole pixels of the screen and are neither scaled nor turned, so there are no
 * seams between them. A tile is a node of cairo's, which copies its pixels; GTK 4.8 would take
 * a texture's through floats, which cost as much as drawing. A tile that has not changed stays
 * the same node: GTK draws it again only where something else has changed above it. */
#include "desk_area.h"

#include <epoxy/gl.h>
#include <string.h>

enum { TILE = 192, BYTES = 4 }; /* pixels, a multiple of the scales 1 to 4; bytes of a pixel */

struct _DeskArea {
    GtkGLArea parent;
    desk_area_draw *draw;
    void *context;
    GLuint framebuffer, colors;
    int width, height, columns, rows; /* pixels; tiles */
    uint8_t *pixels, *read;           /* from the top; what was read, from the bottom */
    int scale;
    GskRenderNode **tiles;
};

#define DESK_TYPE_AREA desk_area_get_type()
G_DECLARE_FINAL_TYPE(DeskArea, desk_area, DESK, AREA, GtkGLArea)
G_DEFINE_TYPE(DeskArea, desk_area, GTK_TYPE_GL_AREA)

/* ---- tiles ---- */

static void tiles_free(DeskArea *a)
{
    for (int i = 0; i < a->columns * a->rows; i++)
        g_clear_pointer(&a->tiles[i], gsk_render_node_unref);
    g_clear_pointer(&a->tiles, g_free);
    g_clear_pointer(&a->pixels, g_free);
    g_clear_pointer(&a->read, g_free);
    a->width = a->height = a->columns = a->rows = 0;
}

static void framebuffer_free(DeskArea *a)
{
    if (a->framebuffer)
        glDeleteFramebuffers(1, &a->framebuffer);
    if (a->colors)
        glDeleteRenderbuffers(1, &a->colors);
    a->framebuffer = a->colors = 0;
}

static void size_set(DeskArea *a, int width, int height, int scale)
{
    const size_t bytes = BYTES * (size_t)width * (size_t)height;
    tiles_free(a);
    framebuffer_free(a);
    a->width = width;
    a->height = height;
    a->scale = scale;
    a->columns = (width + TILE - 1) / TILE;
    a->rows = (height + TILE - 1) / TILE;
    a->tiles = g_new0(GskRenderNode *, (gsize)(a->columns * a->rows));
    a->pixels = g_malloc(bytes);
    a->read = g_malloc(bytes);
    glGenFramebuffers(1, &a->framebuffer);
    glGenRenderbuffers(1, &a->colors);
    glBindRenderbuffer(GL_RENDERBUFFER, a->colors);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width, height);
    glBindFramebuffer(GL_FRAMEBUFFER, a->framebuffer);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, a->colors);
    g_signal_emit_by_name(a, "resize", width, height);
}

static graphene_rect_t tile_bounds(const DeskArea *a, int column, int row)
{
    const int x = column * TILE, y = row * TILE;
    const float scale = (float)a->scale;
    return (graphene_rect_t){
        {(float)x / scale, (float)y / scale},
        {(float)MIN(TILE, a->width - x) / scale, (float)MIN(TILE, a->height - y) / scale}};
}

/* Its pixels are copied: the node may be drawn after they have changed. */
static void tile_make(DeskArea *a, int column, int row)
{
    const int x = column * TILE, y = row * TILE, width = MIN(TILE, a->width - x),
              height = MIN(TILE, a->height - y);
    const graphene_rect_t bounds = tile_bounds(a, column, row);
    cairo_surface_t *image = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
    uint8_t *copy = cairo_image_surface_get_data(image);
    const size_t stride = (size_t)cairo_image_surface_get_stride(image);
    for (int i = 0; copy && i < height; i++)
        memcpy(copy + (size_t)i * stride,
               a->pixels + BYTES * ((size_t)(y + i) * (size_t)a->width + (size_t)x),
               BYTES * (size_t)width);
    cairo_surface_mark_dirty(image);
    cairo_surface_set_device_scale(image, a->scale, a->scale);
    GskRenderNode **tile = &a->tiles[row * a->columns + column];
    g_clear_pointer(tile, gsk_render_node_unref);
    *tile = gsk_cairo_node_new(&bounds);
    cairo_t *cairo = gsk_cairo_node_get_draw_context(*tile);
    cairo_set_operator(cairo, CAIRO_OPERATOR_SOURCE);
    cairo_set_source_surface(cairo, image, bounds.origin.x, bounds.origin.y);
    cairo_pattern_set_filter(cairo_get_source(cairo), CAIRO_FILTER_NEAREST);
    cairo_rectangle(cairo, bounds.origin.x, bounds.origin.y, bounds.size.width,
                    bounds.size.height);
    cairo_fill(cairo);
    cairo_destroy(cairo);
    cairo_surface_destroy(image);
}

/* A row of pixels as cairo has them: b, g, r, and a byte that nobody looks at. */
static void row_take(uint8_t *to, const uint8_t *from, int width, bool blue_first)
{
    if (blue_first) {
        memcpy(to, from, BYTES * (size_t)width);
        return;
    }
    for (int i = 0; i < width; i++, to += BYTES, from += BYTES) {
        to[0] = from[2];
        to[1] = from[1];
        to[2] = from[0];
    }
}

/* What has been drawn comes into the tiles that it touches. */
static void take(DeskArea *a, const struct studio_rectangle *r)
{
    const int width = r->right - r->left, height = r->bottom - r->top;
    const size_t stride = BYTES * (size_t)width;
    const bool blue_first = epoxy_is_desktop_gl();
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glReadPixels(r->left, a->height - r->bottom, width, height, blue_first ? GL_BGRA : GL_RGBA,
                 GL_UNSIGNED_BYTE, a->read);
    for (int i = 0; i < height; i++)
        row_take(a->pixels +
                     BYTES * ((size_t)(r->top + i) * (size_t)a->width + (size_t)r->left),
                 a->read + (size_t)(height - 1 - i) * stride, width, blue_first);
    for (int row = r->top / TILE; row * TILE < r->bottom; row++)
        for (int column = r->left / TILE; column * TILE < r->right; column++)
            tile_make(a, column, row);
}

/* ---- the widget ---- */

static void tiles_snapshot(const DeskArea *a, GtkSnapshot *snapshot)
{
    for (int i = 0; i < a->columns * a->rows; i++)
        if (a->tiles[i])
            gtk_snapshot_append_node(snapshot, a->tiles[i]);
}

static void area_snapshot(GtkWidget *widget, GtkSnapshot *snapshot)
{
    DeskArea *a = DESK_AREA(widget);
    GtkGLArea *area = GTK_GL_AREA(widget);
    const int scale = gtk_widget_get_scale_factor(widget),
              width = scale * gtk_widget_get_width(widget),
              height = scale * gtk_widget_get_height(widget);
    struct studio_rectangle drawn = {0};
    if (!GSK_IS_CAIRO_RENDERER(gtk_native_get_renderer(gtk_widget_get_native(widget))) ||
        gtk_gl_area_get_error(area)) {
        GTK_WIDGET_CLASS(desk_area_parent_class)->snapshot(widget, snapshot);
        return;
    }
    if (width <= 0 || height <= 0)
        return;
    gtk_gl_area_make_current(area);
    if (width != a->width || height != a->height || scale != a->scale) {
        size_set(a, width, height, scale);
        drawn = (struct studio_rectangle){0, 0, width, height};
    }
    glBindFramebuffer(GL_FRAMEBUFFER, a->framebuffer);
    glViewport(0, 0, width, height);
    a->draw(a->context, scale, &drawn);
    if (drawn.right > drawn.left && drawn.bottom > drawn.top)
        take(a, &drawn);
    tiles_snapshot(a, snapshot);
}

static gboolean area_render(GtkGLArea *area, GdkGLContext *context)
{
    DeskArea *a = DESK_AREA(area);
    (void)context;
    a->draw(a->context, gtk_widget_get_scale_factor(GTK_WIDGET(area)), NULL);
    return TRUE;
}

static void area_unrealize(GtkWidget *widget)
{
    DeskArea *a = DESK_AREA(widget);
    gtk_gl_area_make_current(GTK_GL_AREA(widget));
    if (!gtk_gl_area_get_error(GTK_GL_AREA(widget)))
        framebuffer_free(a);
    tiles_free(a);
    GTK_WIDGET_CLASS(desk_area_parent_class)->unrealize(widget);
}

static void desk_area_class_init(DeskAreaClass *class)
{
    GTK_WIDGET_CLASS(class)->snapshot = area_snapshot;
    GTK_WIDGET_CLASS(class)->unrealize = area_unrealize;
    GTK_GL_AREA_CLASS(class)->render = area_render;
}

static void desk_area_init(DeskArea *a)
{
    (void)a;
}

GtkWidget *desk_area_new(desk_area_draw *draw, void *context)
{
    DeskArea *a = g_object_new(DESK_TYPE_AREA, NULL);
    a->draw = draw;
    a->context = context;
    gtk_gl_area_set_auto_render(GTK_GL_AREA(a), FALSE);
    gtk_gl_area_set_required_version(GTK_GL_AREA(a), 3, 2);
    return GTK_WIDGET(a);
}
