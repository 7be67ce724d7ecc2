/* edits.h - what a designer has changed of a font, at any level of the pipeline, in a folder
 * beside it.
 *
 *     struct font_face *face;
 *     // the folder, where a font's name may stand
 *     if (font_edits_open("my-garamond", 0, false, &face) != FONT_OK)
 *         die(font_error());
 *
 * or of a font that is open:
 *
 *     struct font_edits *edits;
 *     if (font_edits_read("my-garamond", face, &edits) != FONT_OK || font_edits_apply(edits, face) != FONT_OK)
 *         die(font_error());
 *     if (font_edits_changed(edits))
 *         warn(font_edits_changed(edits));
 *     font_edits_destroy(edits);
 *
 * The folder has one file for each level of a glyph that was written out, and edits.txt, which
 * says what they are:
 *
 *     lutetia edits 1
 *     font EBGaramond12-Regular.otf                       the file: in the folder, beside it,
 *                                                         or where the system keeps fonts
 *     face 0                                              of a collection
 *     sha256 5ef1...                                      of the font's file, all of its 64
 *                                                         digits
 *     ampersand outline ampersand.svg 0123456789abcdef
 *     ampersand master ampersand.png 89abcdef01234567 860 -54 -700      pixels to the em; left
 *                                                                       and top of the first,
 *                                                                       as in master.h
 *     #214 rectangles glyph214.txt 01234567...
 *     * filter all-filter.txt - 0 14                      of every glyph, for sizes from 0 up
 *                                                         to 14 pixels
 *     ampersand gray ampersand-12.png 89abcdef01234567 12 -1 -10       size of the em; left and
 *                                                                      top of the first pixel,
 *                                                                      as in gray.h
 *     a outline a-wght700.svg 01234567... @wght=700       while the axes are set so, and the
 *                                                         others as usual
 *
 * A row is a glyph's name or number, a level, a file, and the first 16 digits of the file's sum
 * as it was written. A file that still has that sum is no edit: the level is made from those
 * above it. With - in its place the file counts in any case. An edited level takes the place of
 * what it would be, and what lies below is made from it. Whatever draws the glyph then draws
 * that: gray from the master's or the rectangles' own boundary; by the filter of the row for
 * its size; and at a size that has gray of its own that (own.h). Where a glyph's outline,
 * master or rectangles have rows for a setting of the axes, those for any setting do not count
 * there.
 *
 * Files. Outlines are SVG (.svg: paths, in font units, y downwards; the viewBox's width is the
 * advance) or UFO's glif (.glif). Masters are PNG, ink below 128 of 255. Gray is PNG: 0 is all
 * ink, 255 none. Filters are text: the words of one (filter.h), parted by anything; what
 * follows a # is a note. Rectangles are text: a line "em N", and a line of x0 y0 x1 y1 for
 * each, in master pixels.
 *
 * Trust. Such a folder is input from outside: files are plain names in it and regular files,
 * sizes are bounded (a file 16 MiB, 4,096 rows, 256 MiB in all), and whatever does not read so
 * fails, with the file and what is wrong.
 *
 * Errors: functions that can fail return a status and leave one line in font_error().
 *
 * Ownership: what is passed is copied. Threads: edits and faces belong to one thread at a
 * time. */
#ifndef LUTETIA_FONT_EDITS_H
#define LUTETIA_FONT_EDITS_H

#include <face.h>
#include <levels.h>

enum font_edits_level {
    FONT_EDITS_OUTLINE,
    FONT_EDITS_MASTER,
    FONT_EDITS_RECTANGLES,
    FONT_EDITS_FILTER,
    FONT_EDITS_GRAY,
    FONT_EDITS_LEVELS
};
/* "outline", "master", "rectangles", "filter", "gray"; never NULL. */
const char *font_edits_level_name(enum font_edits_level level);

/* Opens the font of a folder with edits.txt, and applies them; of a name like FONT+FOLDER that
 * font, with the folder's edits; any other name as font_face_open() does. coloured: as
 * font_face_open_coloured(). font_edits_said() then has what there is to say. Errors: as
 * font_face_open() and font_edits_read(). Owns: the caller closes *out. */
enum font_status font_edits_open(const char *name, int index, bool coloured,
                                 struct font_face **out);
/* Whether the name is that of a folder with edits.txt. Threads: any. */
bool font_edits_is(const char *name);
/* The folder in a name that font_edits_open() takes: all of it, or what follows its last +.
 * NULL: it names none. Owns: it points into the name. Threads: any. */
const char *font_edits_folder(const char *name);
/* One line on the fonts that this thread has opened so since this was last asked, if one has
 * changed since its edits were made; else NULL. Owns: the library; valid until this thread asks
 * again. */
const char *font_edits_said(void);

struct font_edits;
/* Reads a folder of edits for a face that has none yet. Errors: BAD_FILE, NO_GLYPH, TOO_LARGE,
 * NO_MEMORY; each names the file. Owns: the caller destroys *out. */
enum font_status font_edits_read(const char *folder, struct font_face *face,
                                 struct font_edits **out);
void font_edits_destroy(struct font_edits *edits); /* NULL is fine */
/* A line if the font's file is not the one that the edits were made of; else NULL. Owns: the
 * edits. */
const char *font_edits_changed(const struct font_edits *edits);

struct font_edit {
    uint32_t glyph; /* of a filter also FONT_EVERY_GLYPH (own.h) */
    const char *name,
        *file; /* the glyph's, and the file's within the folder; owned by the edits */
    enum font_edits_level level;
    bool edited;         /* false: the file is as it was written */
    const char *setting; /* "@wght=700", or "" for any; owned by the edits */
    double from_px,
        /* of a filter: the sizes that it is for, without the last; of gray: its size, twice;
         * else 0 */
        to_px;
};
int font_edits_count(const struct font_edits *edits);
/* Edit i, from 0 on. */
struct font_edit font_edits_at(const struct font_edits *edits, int i);

/* Replaces the face's glyphs that were edited. Errors: NO_GLYPH, TOO_LARGE, NO_MEMORY; glyphs
 * before that one are replaced. */
enum font_status font_edits_apply(const struct font_edits *edits, struct font_face *face);
/* A glyph's levels with its edits, at a size, as the face's axes are set; levels without edits
 * have this em, and this filter. face: as it was before font_edits_apply(). Errors: as
 * font_levels_create() and font_face_outline(). Owns: the caller destroys *out. */
enum font_status font_edits_levels(const struct font_edits *edits, struct font_face *face,
                                   uint32_t glyph, int em_px, double size_px,
                                   const char *filter, struct font_levels **out);

/* What is written: a level of a glyph, as the levels have it. */
struct font_edits_out {
    uint32_t glyph; /* of a filter also FONT_EVERY_GLYPH */
    enum font_edits_level level;
    const char *ending;    /* of its file: ".glif" in place of ".svg"; NULL: the level's */
    bool here;             /* for the axes as they are set now, alone */
    double from_px, to_px; /* of a filter: the sizes that it is for; both 0: all */
};
/* Writes it, to be edited, into a folder that is made if there is none, and notes it in its
 * edits.txt. A filter counts as soon as it is written. edits: what was read of the folder, or
 * NULL for a new one. The file's name is left in room. Errors: BAD_ARGUMENT (it is there
 * already, axes that cannot be noted), BAD_FILE (it cannot be written), NO_MEMORY. */
enum { FONT_EDITS_FILE_BYTES = 160 };
enum font_status font_edits_write(const char *folder, const struct font_edits *edits,
                                  struct font_face *face, const struct font_edits_out *what,
                                  struct font_levels *levels, char room[FONT_EDITS_FILE_BYTES]);

#endif
