/* colour_svg.c - glyphs as SVG documents, drawn into pictures by librsvg and Cairo where they
 * are installed.
 *
 * They bring twenty libraries with them, so they are loaded when the first such glyph is looked
 * at; of each function what it takes is written here, and none of their headers is needed.
 * librsvg reads no other file for a document that came from memory. */
#include "colour_internal.h"

#include <library.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <ft2build.h>
#include FT_FREETYPE_H
#include <hb-ot.h>

enum { ARGB32 = 0 };

struct rectangle {
    double x, y, width, height;
};

#define FUNCTIONS(X)                                                                           \
    X(void *, rsvg_handle_new_from_data, (const uint8_t *, size_t, void **))                   \
    X(int, rsvg_handle_set_stylesheet, (void *, const uint8_t *, size_t, void **))             \
    X(int, rsvg_handle_get_geometry_for_layer,                                                 \
      (void *, const char *, const struct rectangle *, struct rectangle *, struct rectangle *, \
       void **))                                                                               \
    X(int, rsvg_handle_render_layer,                                                           \
      (void *, void *, const char *, const struct rectangle *, void **))                       \
    X(void, g_object_unref, (void *))                                                          \
    X(void, g_error_free, (void *))                                                            \
    X(void *, cairo_image_surface_create, (int, int, int))                                     \
    X(void, cairo_surface_destroy, (void *))                                                   \
    X(void, cairo_surface_flush, (void *))                                                     \
    X(uint8_t *, cairo_image_surface_get_data, (void *))                                       \
    X(int, cairo_image_surface_get_stride, (void *))                                           \
    X(void *, cairo_create, (void *))                                                          \
    X(void, cairo_destroy, (void *))                                                           \
    X(int, cairo_status, (void *))                                                             \
    X(void, cairo_translate, (void *, double, double))                                         \
    X(void, cairo_scale, (void *, double, double))

static struct {
    bool good;
#define MEMBER(result, name, parameters) result(*name) parameters;
    FUNCTIONS(MEMBER)
} svg;
static pthread_once_t svg_once = PTHREAD_ONCE_INIT;

static void svg_begin(void)
{
#define ROW(result, name, parameters) LIBRARY_FUNCTION(svg, name),
    static const struct library_function functions[] = {FUNCTIONS(ROW)};
    const char *missing;
    svg.good = library_load("librsvg-2.so.2", functions, sizeof functions / sizeof *functions,
                            &svg, &missing);
}

bool font_colour_svg_drawn(void)
{
    pthread_once(&svg_once, svg_begin);
    return svg.good;
}

static hb_blob_t *document_of(struct font_face *face, uint32_t glyph)
{
    if (!FT_HAS_SVG(font_face_freetype(face)))
        return NULL;
    hb_blob_t *document = hb_ot_color_glyph_reference_svg(font_face_harfbuzz(face), glyph);
    if (hb_blob_get_length(document))
        return document;
    hb_blob_destroy(document);
    return NULL;
}

bool font_colour_has_svg(struct font_face *face, uint32_t glyph)
{
    hb_blob_t *document = document_of(face, glyph);
    hb_blob_destroy(document);
    return document;
}

/* Draws what is at the document's `id` where the picture is. */
static bool surface_draw(void *handle, const char *id, const struct rectangle *viewport,
                         const struct font_colour_picture *to, double scale)
{
    void *surface = svg.cairo_image_surface_create(ARGB32, to->width_px, to->height_px);
    void *cairo = svg.cairo_create(surface), *error = NULL;
    svg.cairo_translate(cairo, -to->left_px, to->top_px);
    svg.cairo_scale(cairo, scale, scale);
    bool good = svg.cairo_status(cairo) == 0 &&
                svg.rsvg_handle_render_layer(handle, cairo, id, viewport, &error);
    svg.cairo_surface_flush(surface);
    const uint8_t *from = good ? svg.cairo_image_surface_get_data(surface) : NULL;
    for (int y = 0; from && y < to->height_px; y++)
        for (int x = 0; x < to->width_px; x++) {
            uint32_t pixel; /* cover highest, then red, green, blue */
            memcpy(&pixel,
                   from + (ptrdiff_t)y * svg.cairo_image_surface_get_stride(surface) +
                       4 * (ptrdiff_t)x,
                   sizeof pixel);
            for (int c = 0; c < 4; c++)
                to->bgra[4 * ((size_t)y * (size_t)to->width_px + (size_t)x) + (size_t)c] =
                    (uint8_t)(pixel >> (8 * c));
        }
    if (error)
        svg.g_error_free(error);
    svg.cairo_destroy(cairo);
    svg.cairo_surface_destroy(surface);
    return from;
}

/* The box around what is drawn, in the picture's pixels. */
static bool box_of(void *handle, const char *id, const struct rectangle *viewport, double scale,
                   struct font_box *out)
{
    struct rectangle ink, logical;
    void *error = NULL;
    bool good =
        svg.rsvg_handle_get_geometry_for_layer(handle, id, viewport, &ink, &logical, &error);
    if (error)
        svg.g_error_free(error);
    *out = (struct font_box){ink.x * scale, ink.y * scale, (ink.x + ink.width) * scale,
                             (ink.y + ink.height) * scale};
    return good;
}

static enum font_status document_draw(void *handle, const char *id, double em, int em_px,
                                      struct font_colour_picture *out)
{
    const struct rectangle viewport = {0, 0, em, em};
    struct font_box box;
    for (;; em_px /= 2) {
        if (em_px < 1 || !box_of(handle, id, &viewport, em_px / em, &box))
            return FONT_BAD_FILE;
        if (font_colour_pixels_set(&box, em_px, out))
            break;
    }
    if (!out->width_px)
        return FONT_OK;
    out->bgra = calloc((size_t)out->width_px * (size_t)out->height_px, 4);
    if (!out->bgra)
        return FONT_NO_MEMORY;
    return surface_draw(handle, id, &viewport, out, em_px / em) ? FONT_OK : FONT_BAD_FILE;
}

enum font_status font_colour_svg(struct font_face *face, uint32_t glyph, int em_px,
                                 const double ink[3], struct font_colour_picture *out)
{
    char id[32], style[64];
    void *error = NULL, *handle = NULL;
    hb_blob_t *document = document_of(face, glyph);
    unsigned count = 0;
    const char *bytes = document ? hb_blob_get_data(document, &count) : NULL;
    enum font_status status = FONT_BAD_FILE;
    *out = (struct font_colour_picture){0};
    if (bytes && font_colour_svg_drawn())
        handle = svg.rsvg_handle_new_from_data((const uint8_t *)bytes, count, &error);
    if (handle) {
        snprintf(id, sizeof id, "#glyph%u", (unsigned)glyph);
        int length = snprintf(style, sizeof style, "svg{color:#%02x%02x%02x}",
                              (unsigned)lrint(255 * ink[0]), (unsigned)lrint(255 * ink[1]),
                              (unsigned)lrint(255 * ink[2]));
        if (svg.rsvg_handle_set_stylesheet(handle, (const uint8_t *)style, (size_t)length,
                                           &error))
            status =
                document_draw(handle, id, font_face_freetype(face)->units_per_EM, em_px, out);
        svg.g_object_unref(handle);
    }
    if (error)
        svg.g_error_free(error);
    hb_blob_destroy(document);
    if (status == FONT_OK)
        return status;
    free(out->bgra);
    *out = (struct font_colour_picture){0};
    return status == FONT_NO_MEMORY
               ? font_fail(status, "no memory for a glyph's picture")
               : font_fail(status, "glyph %u has a drawing in SVG that cannot be read",
                           (unsigned)glyph);
}
