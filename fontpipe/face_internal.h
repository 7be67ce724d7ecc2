/* face_internal.h - a font's face, as face.c opens it and face_outline.c reads its outlines. */
#ifndef LUTETIA_FONT_FACE_INTERNAL_H
#define LUTETIA_FONT_FACE_INTERNAL_H

#include "face.h"
#include "internal.h"

#include <hb.h>

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_MULTIPLE_MASTERS_H

enum { FACE_AXES_MAX = FONT_AXES_MAX, FACE_SETTINGS_KEPT = 64 };

/* How the axes were set before: with the version that it had. */
struct font_setting {
    FT_Fixed values[FACE_AXES_MAX];
    uint64_t version;
};

/* A glyph that was replaced, in every setting of the axes (0), or in one of face->own_settings,
 * counted from 1: prepared, and what whoever works on it gets, prepared or not. */
struct font_replaced {
    uint32_t glyph;
    int setting;
    struct font_outline outline, rough;
};

/* Who reads the outlines: HarfBuzz, or FreeType where there are no tables that HarfBuzz
 * draws. */
enum font_reader { FONT_READER_UNKNOWN, FONT_READER_HARFBUZZ, FONT_READER_FREETYPE };

struct font_face {
    FT_Library library;
    FT_Face ft;
    FT_MM_Var *axes;
    FT_Fixed values[FACE_AXES_MAX];
    int axes_count;
    unsigned char *bytes;
    size_t bytes_count;
    char *path;
    uint64_t version;
    struct font_setting
        *settings; /* the last FACE_SETTINGS_KEPT, around; NULL until one is set */
    int settings_count, settings_next;
    hb_face_t *hb_face;        /* made when they are first asked for */
    struct face_table *tables; /* what had to be unpacked for it */
    hb_font_t *hb_font;        /* in the font's units; its axes as those of hb_version */
    uint64_t hb_version;
    enum font_reader reader;
    struct font_replaced *replaced; /* in the order of their glyphs, then of their settings */
    int replaced_count, replaced_capacity;
    struct font_own_setting *own_settings; /* of which something is not the font's own */
    int own_settings_count, own_settings_capacity;
    int own_setting;      /* which of them it is now, from 1; 0: none */
    struct font_own *own; /* own.c; NULL: nothing */
};

struct font_own_setting {
    FT_Fixed values[FACE_AXES_MAX];
};

/* face_version.c: the number of the setting as it is now among those of which something is not
 * the font's own; a new one where there is none. 0: no memory. Looks which of them the axes are
 * set to now. */
int font_face_own_setting(struct font_face *face);
void font_face_own_setting_find(struct font_face *face);
/* own.c */
void font_own_finish(struct font_face *face);
/* face_replaced.c: NULL where the glyph is the font's own. */
const struct font_replaced *font_face_replaced(const struct font_face *face, uint32_t glyph);
void font_face_replaced_finish(struct font_face *face);
/* face_version.c: a version that no face had before; settings that the face had are others now.
 * The version of the axes as they are set: that which such a setting had before, so that what
 * is kept of it is found again. The setting that a face is opened with. */
void font_face_version_renew(struct font_face *face);
void font_face_version_find(struct font_face *face);
void font_face_version_keep_first(struct font_face *face);

/* The status of one of FreeType's errors, with its words. */
enum font_status font_face_fail(const struct font_face *face, const char *what, int error);
void font_face_harfbuzz_finish(struct font_face *face);

#endif
