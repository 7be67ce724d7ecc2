/* gl_type.h - text on a display, by OpenGL: glyphs of fontpipe's atlas as textures on
 * rectangles.
 *
 *     struct gl_type *type;
 *     struct gl_type_def def = gl_type_def_default();
 *     def.function = glfwGetProcAddress;                    // or gl_offscreen_function
 *     if (gl_type_create(&def, &type) != DISPLAY_OK)
 *         die(display_error());
 *     // a frame, the context being current
 *     gl_type_begin(type, width_px, height_px);
 *     gl_type_draw(type, &layout, NULL, 20, 40, ink);
 *     gl_type_draw(type, &another, &map, 0, 0, red);
 *     gl_type_destroy(type);
 *
 * The text's pixels are the picture's: y goes down. A glyph's rectangle lies on whole pixels;
 * its fraction of a pixel is one of the atlas's positions. Only glyphs that the atlas has newly
 * drawn are copied into the textures; the others stay from frame to frame. If the framebuffer
 * is encoded as sRGB, coverage mixes light (as font_painter_layout() does, and numbers where an
 * ink says so), else numbers.
 *
 * OpenGL 2.1 is enough. The calls change the blend state, the bound textures, the program in
 * use (none afterwards), the current colour and the unpack alignment.
 *
 * Errors. What fontpipe says is passed on as BAD_ARGUMENT, its text in display_error().
 * Threads. That of the context, which must be the same, and current, in all calls.
 */
#ifndef LUTETIA_GL_TYPE_H
#define LUTETIA_GL_TYPE_H

#include <atlas.h>

#include "display.h"

struct gl_type_def {
    void (*(*function)(const char *name))(void); /* of OpenGL */
    struct font_atlas_def atlas;
};
struct gl_type_def gl_type_def_default(void);

struct gl_type;
/* Errors: BAD_ARGUMENT, NO_WINDOW (no OpenGL 2.1), NO_MEMORY. */
enum display_status gl_type_create(const struct gl_type_def *def, struct gl_type **out);
void gl_type_destroy(struct gl_type *type); /* NULL is fine */

/* A new frame: the size of the viewport, which is the picture's. */
void gl_type_begin(struct gl_type *type, int width_px, int height_px);

/* A layout with its origin at (x_px, y_px), through any map (NULL: as it is), each glyph first
 * through its own. ink: 0..1, as numbers of sRGB, for glyphs that have none of the layout's.
 * Errors: BAD_ARGUMENT (a glyph larger than a page or beyond the horizon, a place out of range,
 * an ink that cannot be drawn), NO_MEMORY, NO_WINDOW (a gradient or picture as ink, and no
 * shaders); part of the text may then have been drawn. */
enum display_status gl_type_draw(struct gl_type *type, const struct font_layout *layout,
                                 const struct font_map *map, double x_px, double y_px,
                                 const double ink[3]);

/* Glyphs, each through its own map and in its own colour, drawn in order, later ones over
 * earlier ones. */
struct gl_type_glyph {
    struct font_face *face;
    uint32_t glyph;
    double size_px;
    struct font_map map; /* as font_atlas_get() has it */
    double x_px, y_px;   /* of the origin; 0 where the map is a distortion */
    float color[4];      /* sRGB numbers 0..1, and opacity */
};
/* A glyph that a distortion maps beyond the horizon, or that is larger than a page, is not
 * drawn; *left_out counts these. Errors: as gl_type_draw(). */
enum display_status gl_type_glyphs(struct gl_type *type, const struct gl_type_glyph *glyphs,
                                   int count, int *left_out);

struct font_atlas *gl_type_atlas(struct gl_type *type); /* for its statistics */

#endif
