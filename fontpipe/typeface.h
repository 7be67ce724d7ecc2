/* typeface.h - all glyphs of a face at a size, drawn on the OpenCL device (many.h) and packed
 * into one picture: the thesis's "typeface in fifteen seconds".
 *
 *     struct font_typeface_def def = {.size_px = 12.25, .filter = "gaussian-fast"};
 *     struct font_typeface t;
 *     if (font_typeface_draw(face, &def, &t) != FONT_OK)
 *         die(font_error());
 *     ...t.glyphs[i] says where a glyph is in t.pixels...
 *     font_typeface_finish(&t);
 *
 * Glyphs stand on shelves, the highest first, with a blank pixel around each, so that a texture
 * may be looked up between its pixels. Origins are on whole pixels.
 *
 * What the device does not draw, a font_painter does: glyphs that are too wide for it, outlines
 * that cross themselves in ways that need arcs, and faces with filters or gray of their own
 * (own.h). Pixels are a painter's to rounding.
 *
 * Errors: functions that can fail return a status and leave one line in font_error(). Others
 * cannot fail.
 *
 * Ownership: a typeface's memory is its own; font_typeface_finish() frees it. The face is
 * borrowed.
 *
 * Threads: one thread at a time. */
#ifndef LUTETIA_FONT_TYPEFACE_H
#define LUTETIA_FONT_TYPEFACE_H

#include "face.h"

#include <stdbool.h>
#include <stdint.h>

enum { FONT_TYPEFACE_SIDE_MAX = 16384 };

/* The sizes that users are offered. */
#define FONT_TYPEFACE_LEAST_PX 0.5
#define FONT_TYPEFACE_MOST_PX 400.0

struct font_typeface_def {
    double size_px;     /* 0.1..FONT_SIDE_MAX */
    const char *filter; /* a name of filter.h; NULL: "gaussian-fast" */
    /* The most memory for the picture and, while it is made, for the glyphs before they have
     * their places in it; 0: as much as there is. */
    double pixels_bytes_max;
    const char *device; /* as LUTETIA_DEVICE, which NULL looks at */
    /* Asked between pieces of the work, how many glyphs of how many are done; false: it stops,
     * with NO_MEMORY as status.h has it. NULL: nobody asks. */
    bool (*go_on)(void *context, int done, int count);
    void *context;
};

struct font_typeface_glyph {
    uint32_t glyph;
    uint32_t character;            /* the first that the glyph stands for; 0: none */
    int x, y, width_px, height_px; /* in the picture; width 0: it has no ink */
    int left_px, top_px;           /* of its first pixel, from its origin; y downwards */
    double advance_px;
};

struct font_typeface {
    int width_px, height_px;            /* 0: nothing has ink */
    uint8_t *pixels;                    /* how far each is covered, rows of width_px bytes */
    struct font_typeface_glyph *glyphs; /* by glyph number */
    int glyphs_count, inked_count;
    int on_device_count; /* of inked_count, drawn by the device */
    char device[128];
};

/* About how much memory the making takes besides the pixels: the glyphs that the device holds
 * at once, and the table. */
double font_typeface_work_bytes(const struct font_face *face, double size_px);
/* Errors: BAD_ARGUMENT (a size or filter that cannot be), NO_DEVICE, DEVICE_FAILED, TOO_LARGE
 * (past FONT_TYPEFACE_SIDE_MAX pixels a side), NO_MEMORY, also where patience is over
 * (patience.h); *out is then empty. Owns: the caller finishes *out. */
enum font_status font_typeface_draw(struct font_face *face, const struct font_typeface_def *def,
                                    struct font_typeface *out);
/* Frees its memory, and makes it empty. */
void font_typeface_finish(struct font_typeface *typeface);

#endif
