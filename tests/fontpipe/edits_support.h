/* edits_support.h - folders of a font's edits, for tests. Include after cmocka's headers. */
#ifndef LUTETIA_TESTS_EDITS_SUPPORT_H
#define LUTETIA_TESTS_EDITS_SUPPORT_H

#include "../display/scratch.h"
#include "made_font.h"
#include "support.h"

#include <edits.h>

#include <stdlib.h>

static inline void put_text(const char *folder, const char *file, const char *text)
{
    char path[600];
    snprintf(path, sizeof path, "%s/%s", folder, file);
    FILE *f = fopen(path, "wb");
    assert_non_null(f);
    fputs(text, f);
    assert_int_equal(fclose(f), 0);
}

static inline char *text_of(const char *folder, const char *file, char *room, size_t bytes)
{
    char path[600];
    snprintf(path, sizeof path, "%s/%s", folder, file);
    FILE *f = fopen(path, "rb");
    assert_non_null(f);
    room[fread(room, 1, bytes - 1, f)] = '\0';
    fclose(f);
    return room;
}

/* Writes out a level of a glyph at a size, by a filter; the file's name is left in file. */
static inline void level_out(const char *folder, struct font_face *face,
                             const struct font_edits_out *what, int em_px, double size_px,
                             const char *filter, char file[FONT_EDITS_FILE_BYTES])
{
    struct font_edits *edits = NULL;
    struct font_levels *levels;
    uint32_t glyph = what->glyph == UINT32_MAX ? 0 : what->glyph; /* every glyph */
    if (font_edits_is(folder))
        assert_font(font_edits_read(folder, face, &edits));
    assert_font(font_edits_levels(edits, face, glyph, em_px, size_px, filter, &levels));
    assert_font(font_edits_write(folder, edits, face, what, levels, file));
    font_levels_destroy(levels);
    font_edits_destroy(edits);
}

/* A folder of that name with a level of a glyph of DejaVu Sans written out. */
static inline const char *folder_with(const char *name, const char *glyph,
                                      enum font_edits_level level, const char *ending,
                                      int em_px, char file[FONT_EDITS_FILE_BYTES])
{
    const char *folder = scratch_path(name);
    struct font_face *face = face_open("DejaVuSans");
    struct font_edits_out what = {.level = level, .ending = ending};
    assert_font(font_face_glyph_named(face, glyph, &what.glyph));
    level_out(folder, face, &what, em_px, 12, "box", file);
    font_face_close(face);
    return folder;
}

/* DejaVu Sans with an axis wdth, in the folder's file wide.ttf. */
static inline struct font_face *wide_face_open(const char *folder)
{
    struct font_face *plain = face_open("DejaVuSans");
    size_t count, made_count;
    const uint8_t *bytes = font_face_bytes(plain, &count);
    uint8_t *made = made_wide(bytes, count, &made_count);
    char path[600];
    snprintf(path, sizeof path, "%s/wide.ttf", folder);
    FILE *f = fopen(path, "wb");
    assert_non_null(f);
    assert_int_equal(fwrite(made, 1, made_count, f), made_count);
    assert_int_equal(fclose(f), 0);
    free(made);
    font_face_close(plain);
    return face_open(path);
}

#endif
