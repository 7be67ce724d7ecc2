/* internal.h - what the pipeline's files share. */
#ifndef LUTETIA_FONT_INTERNAL_H
#define LUTETIA_FONT_INTERNAL_H

#include "status.h"

#include <array.h>
#include <error_text.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Keeps the text for font_error() and returns the status. */
extern _Thread_local struct error_text font_last_error;
#define font_fail(status, ...)                                                                 \
    ((enum font_status)error_text_fail(&font_last_error, (int)(status), __VA_ARGS__))

/* Before the i-th piece of work that may be long: NO_MEMORY where it shall stop (patience.h),
 * which is asked at some of them, and the first. */
enum font_status font_patience_ask(int i);

/* Of the bytes of a key. */
uint32_t font_hash(const void *key, size_t bytes_count);

/* face.c: FreeType's. */
struct font_face;
struct FT_FaceRec_;
struct FT_FaceRec_ *font_face_freetype(struct font_face *face);
/* face_harfbuzz.c: HarfBuzz's, borrowed while the face is open; of WOFF's files, too. And the
 * face's axes, for a font of it. */
struct hb_face_t;
struct hb_font_t;
struct hb_face_t *font_face_harfbuzz(struct font_face *face);
void font_face_harfbuzz_variations(const struct font_face *face, struct hb_font_t *font);

/* face_replaced.c: how many glyphs are no longer the file's. */
int font_face_replaced_count(const struct font_face *face);

/* status.c: notes a glyph for font_left_out(), with the reason that font_error() has. */
void font_left_out_add(const char *path, const char *glyph);
/* face_outline.c: as font_face_outline(), or for whoever prepares it font_face_outline_raw(),
 * but a glyph whose outline is damaged or too large is empty, and left out by name. Errors:
 * NO_GLYPH, NO_MEMORY. */
struct font_outline;
enum font_status font_face_outline_or_none(struct font_face *face, uint32_t glyph,
                                           bool prepared, struct font_outline *out);

/* outline.c: of a prepared outline. */
enum font_status font_outline_polynomials(struct font_outline *o);

#endif
