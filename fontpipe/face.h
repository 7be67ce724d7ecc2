/* face.h - fonts: TrueType, CFF, Type 1, collections, variable fonts, WOFF. FreeType reads the
 * files, HarfBuzz and FreeType give outlines in the font's units, in doubles; neither draws.
 *
 *     struct font_face *face;
 *     if (font_face_open("EBGaramond12-Regular", 0, &face) != FONT_OK)
 *         die(font_error());
 *     struct font_outline outline;
 *     font_face_outline(face, font_face_glyph(face, 'A'), &outline);
 *     font_outline_finish(&outline);
 *     font_face_close(face);
 *
 * Errors: functions that can fail return a status and leave one line in font_error(). Others
 * cannot fail.
 *
 * Ownership: what is passed is copied, and stays the caller's.
 *
 * Threads: a face belongs to one thread at a time; faces are independent of each other. */
#ifndef LUTETIA_FONT_FACE_H
#define LUTETIA_FONT_FACE_H

#include "outline.h"

#include <stddef.h>
#include <stdint.h>

struct font_face;

/* A path, or a font file's name without folder and ending, looked for where the system keeps
 * fonts, or a family as fontconfig knows it ("DejaVu Sans:bold"). index: of the face in a
 * collection, 0 otherwise. Errors: BAD_FILE, NO_MEMORY, BAD_ARGUMENT for an index the file has
 * not. Owns: the caller closes *out. */
enum font_status font_face_open(const char *name, int index, struct font_face **out);
/* Also such as have nothing but pictures in colours (colour.h): their glyphs have no outlines.
 * Errors: as font_face_open(). Owns: the caller closes *out. */
enum font_status font_face_open_coloured(const char *name, int index, struct font_face **out);
/* The file of such a name, or NULL; index (may be NULL) becomes a family's in a collection if
 * it is 0. Owns: the caller frees it. Threads: any. */
char *font_face_find(const char *name, int *index);
/* The first of the names, NULL-ended, whose font there is, else the first name, never NULL.
 * Owns: the caller, it is one of the names. Threads: any. */
const char *font_face_first(const char *const *names);
/* The same as font_face_open() and font_face_open_coloured(), from memory, which is copied.
 * Errors: as font_face_open(). Owns: the caller closes *out. */
enum font_status font_face_open_memory(const void *bytes, size_t count, int index,
                                       struct font_face **out);
enum font_status font_face_open_memory_coloured(const void *bytes, size_t count, int index,
                                                struct font_face **out);
void font_face_close(struct font_face *face); /* NULL is fine */

struct font_face_info {
    const char *family, *style, *format, *path; /* owned by the face; "" if unknown */
    int glyphs_count, faces_count, index, axes_count;
    double units_per_em, ascender, descender, line_height; /* descender is negative */
    double underline_y, underline_height;
};
/* Its texts are valid as long as the face. */
void font_face_describe(const struct font_face *face, struct font_face_info *out);

/* How heavy, slanted and wide a face is, as fontconfig counts (FC_WEIGHT, FC_SLANT, FC_WIDTH);
 * a variable one as its axes are set. */
struct font_manner {
    double weight;
    int slant, width;
};
struct font_manner font_face_manner(const struct font_face *face);

/* The glyph for a character; 0 if the font has none. */
uint32_t font_face_glyph(const struct font_face *face, uint32_t character);

/* The outline with advance and units_per_em, prepared. Owns: the caller finishes *out, which is
 * empty on failure. Errors: NO_GLYPH for an index the font has not or that is a bitmap,
 * BAD_FILE for a damaged one. */
enum font_status font_face_outline(struct font_face *face, uint32_t glyph,
                                   struct font_outline *out);
/* The same before it is prepared: for emboldening. Errors: as font_face_outline(). Owns: the
 * caller finishes *out. */
enum font_status font_face_outline_raw(struct font_face *face, uint32_t glyph,
                                       struct font_outline *out);
/* From now on the glyph is this, for whoever asks: outline and advance, in the font's units;
 * the font's file stays as it is. `rough`, where it is not NULL, is given in place of `outline`
 * to those that work on it further (font_face_outline_raw()): the same without the steps of
 * pixels. here: as long as the axes are set as they are now; that comes before what holds for
 * any setting. The face's version changes. Errors: NO_GLYPH for an index the font has not,
 * NO_MEMORY; the glyph is then as it was. */
enum font_status font_face_outline_replace(struct font_face *face, uint32_t glyph,
                                           const struct font_outline *outline,
                                           const struct font_outline *rough, bool here);
/* Whether it was replaced, as the axes are set now. */
bool font_face_is_replaced(const struct font_face *face, uint32_t glyph);

/* The glyph that is meant by a character, by U+0041, by its number (#214), or by its name in
 * the font (f_f_i). Errors: NO_GLYPH for a character or a number that the font has not,
 * BAD_ARGUMENT for anything else. */
enum font_status font_face_glyph_named(const struct font_face *face, const char *text,
                                       uint32_t *glyph);
/* Its name in the font, or #214 where it has none that finds it again. Returns room, never
 * NULL. Owns: the caller. */
enum { FONT_GLYPH_NAME_BYTES = 128 };
const char *font_face_glyph_name(const struct font_face *face, uint32_t glyph,
                                 char room[FONT_GLYPH_NAME_BYTES]);

/* How far the glyph moves the pen, in the font's units. Errors: NO_GLYPH, BAD_FILE. */
enum font_status font_face_advance(struct font_face *face, uint32_t glyph, double *advance);
/* What the font's own pair table adds between two glyphs (Type 1 and old TrueType); 0 without
 * one. */
double font_face_kerning(struct font_face *face, uint32_t left, uint32_t right);

/* How wide the face's uprights are, of an em: the area of its l by its height, where it has
 * none of I, i or o. 1/12 if it has none of them. */
double font_face_stem(struct font_face *face);

/* A variable font's axes: "wght" from least to most, what it is set to. */
struct font_axis {
    char tag[5];
    const char *name; /* owned by the face */
    double least, most, usual, value;
};
/* Axis number `axis` from 0. Errors: BAD_ARGUMENT for one that there is not. */
enum font_status font_face_axis(const struct font_face *face, int axis, struct font_axis *out);
/* Sets one axis; beyond its ends the end is taken. Errors: BAD_ARGUMENT for a tag that the font
 * has not. */
enum font_status font_face_axis_set(struct font_face *face, const char *tag, double value);
/* All as the font has them. Errors: as font_face_axis_set(). */
enum font_status font_face_axes_reset(struct font_face *face);
/* How they are set, in the form of font_face_axes_set(): those that are not as usual. Returns
 * room, never NULL; "" if all are, or there are none. Owns: the caller. */
enum { FONT_AXES_BYTES = 1024 };
const char *font_face_axes_text(const struct font_face *face, char room[FONT_AXES_BYTES]);
/* Several: "wght=700,wdth=80"; NULL or "": none. Errors: BAD_ARGUMENT, also for what does not
 * read so. */
enum font_status font_face_axes_set(struct font_face *face, const char *axes);

/* A variable font's named places: "Bold Condensed", and each axis there, in the order of
 * font_face_axis(). */
enum { FONT_AXES_MAX = 64 };
struct font_instance {
    char name[128]; /* UTF-8; "" if the font has none */
    double values[FONT_AXES_MAX];
};
int font_face_instances_count(struct font_face *face);
/* Errors: BAD_ARGUMENT for one that there is not. */
enum font_status font_face_instance(struct font_face *face, int i, struct font_instance *out);

/* The tags of the font's scripts ("latn"), or of its features ("liga"), as its tables have
 * them, each once, in the alphabet's order. Returns how many there are, up to 512; the first
 * `most` are written. Shape: tags[most]. */
int font_face_tags(struct font_face *face, bool features, char (*tags)[5], int most);
/* What the font calls a feature (ss01: "Open digits"), as UTF-8. False: it has no name for
 * it. */
bool font_face_feature_name(struct font_face *face, const char *tag, char *room, size_t bytes);

/* The font's file in memory, for shaping; never NULL, valid as long as the face. */
const void *font_face_bytes(const struct font_face *face, size_t *count);
/* Differs between any two settings of axes of any two faces open, and before and after a glyph
 * is replaced; of one of the face's last 64 settings it is what it was then. */
uint64_t font_face_version(const struct font_face *face);

#endif
