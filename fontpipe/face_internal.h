/* face_internal.h - a font's face, as face.c opens it and face_outline.c reads its outlines. */
#ifndef LUTETIA_FONT_FACE_INTERNAL_H
#define LUTETIA_FONT_FACE_INTERNAL_H

#include "face.h"
#include "internal.h"

#include <hb.h>

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_MULTIPLE_MASTERS_H

enum { FACE_AXES_MAX = 64, FACE_SETTINGS_KEPT = 64 };

/* How the axes were set before: with the version that it had. */
struct font_setting {
    FT_Fixed values[FACE_AXES_MAX];
    uint64_t version;
};

/* Who reads the outlines: HarfBuzz, or FreeType where there are no tables that HarfBuzz draws. */
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
};

/* The status of one of FreeType's errors, with its words. */
enum font_status font_face_fail(const struct font_face *face, const char *what, int error);
void font_face_harfbuzz_finish(struct font_face *face);

#endif
