/* own.h - what a face has of its own below its outlines: a filter for all of its glyphs, for
 * one of them or for some sizes, and the gray of a glyph at a size.
 *
 *     // small type is softer
 *     font_own_filter_set(face, FONT_EVERY_GLYPH, 0, 14, "cone", false);
 *     // retouched, pixel by pixel
 *     font_own_gray_set(face, glyph, 12, &gray, false);
 *
 * Painters and atlases (paint.h, atlas.h) draw with both, whatever filter they have themselves.
 * A size is that of an em in the picture, after all maps, at the glyph's origin. Gray is used
 * where a letter is upright, not widened, and of that size to a millionth; its origin then goes
 * to the nearest whole pixel. Drawings, PDF and springs that turn have outlines.
 *
 * Errors: functions that can fail return a status and leave one line in font_error(); the face
 * is then as it was. Others cannot fail.
 *
 * Ownership: what is passed is copied. Threads: as the face. */
#ifndef LUTETIA_FONT_OWN_H
#define LUTETIA_FONT_OWN_H

#include "face.h"
#include "filter.h"
#include "gray.h"

#define FONT_EVERY_GLYPH UINT32_MAX

enum { FONT_OWN_FILTERS_MAX = 32 };

/* From from_px up to, and without, to_px. here: as long as the axes are set as they are now;
 * that comes before what holds for any setting, and a glyph's before every glyph's; of several
 * sizes that fit the first that was set. The face's version changes. Errors: BAD_ARGUMENT (no
 * such filter, sizes that are none), NO_GLYPH, TOO_LARGE (more than FONT_OWN_FILTERS_MAX
 * different ones), NO_MEMORY. */
enum font_status font_own_filter_set(struct font_face *face, uint32_t glyph, double from_px,
                                     double to_px, const char *filter, bool here);
/* The same size and setting again takes the place of what was. Errors: BAD_ARGUMENT, NO_GLYPH,
 * NO_MEMORY. */
enum font_status font_own_gray_set(struct font_face *face, uint32_t glyph, double size_px,
                                   const struct font_gray *gray, bool here);
/* What is used for a glyph as the axes are now; NULL: nothing of its own. Owns: the face; valid
 * until it is closed or something is set. */
const struct font_filter *font_own_filter(const struct font_face *face, uint32_t glyph,
                                          double size_px);
const struct font_gray *font_own_gray(const struct font_face *face, uint32_t glyph,
                                      double size_px);
/* Where what belongs to a glyph is looked for, in this order: the glyph's own for the axes as
 * they are set now, its own for any setting, and every glyph's likewise. i: 0 to
 * FONT_OWN_PLACES - 1. */
enum { FONT_OWN_PLACES = 4 };
struct font_own_place {
    uint32_t glyph;
    bool here; /* for the axes as they are set now */
};
struct font_own_place font_own_place(uint32_t glyph, int i);
/* Whether the size is at from_px or above, and below to_px; if both are the same, whether it is
 * that one, to a millionth. */
bool font_own_size_is(double from_px, double to_px, double size_px);

/* Whether the face has any of them. */
bool font_own_any(const struct font_face *face);

#endif
