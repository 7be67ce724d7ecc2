/* type_gl.c - `lutetia type --gl`: draws the text by OpenGL, as on a display. */
#include "lutetia.h"
#include "type_common.h"

#include <stdlib.h>

#ifdef LUTETIA_GL
#include <gl_offscreen.h>
#include <gl_type.h>

/* Positions within a pixel: an edge is off by at most 1/128 of a pixel, which is 2 of 255
 * where a filter is steepest. */
enum { PLACES = 64 };

int type_gl(const char *verb, const struct font_layout *layout, const struct font_map *map,
            const char *filter, double darken_px, double x_px, double y_px, const double ink[3],
            struct display_image *image)
{
    struct gl_offscreen *screen = NULL;
    struct gl_type *type = NULL;
    struct gl_type_def def = gl_type_def_default();
    def.function = gl_offscreen_function;
    def.atlas.filter = filter;
    def.atlas.darken_px = darken_px;
    def.atlas.places_x = def.atlas.places_y = PLACES;
    if (layout->size_px > 256) /* a glyph must fit an atlas page */
        def.atlas.width_px = def.atlas.height_px = 4096;
    enum display_status status =
        gl_offscreen_create(image->width_px, image->height_px, &screen);
    if (status == DISPLAY_OK)
        status = gl_type_create(&def, &type);
    if (status == DISPLAY_OK) {
        gl_offscreen_clear(screen, (const double[]){1, 1, 1});
        gl_type_begin(type, image->width_px, image->height_px);
        status = gl_type_draw(type, layout, map, x_px, y_px, ink);
    }
    if (status == DISPLAY_OK) {
        display_image_destroy(image);
        status = gl_offscreen_read(screen, image);
    }
    gl_type_destroy(type);
    gl_offscreen_destroy(screen);
    return status == DISPLAY_OK ? EXIT_SUCCESS : fail(verb, "%s", display_error());
}

#else

int type_gl(const char *verb, const struct font_layout *layout, const struct font_map *map,
            const char *filter, double darken_px, double x_px, double y_px, const double ink[3],
            struct display_image *image)
{
    (void)layout, (void)map, (void)filter, (void)darken_px, (void)x_px, (void)y_px, (void)ink;
    (void)image;
    return fail(verb,
                "this program was built without OpenGL: install libegl-dev and libglfw3-dev "
                "and build it again");
}

#endif
