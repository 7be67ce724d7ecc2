/* face_harfbuzz.c - a face's tables for HarfBuzz, as they are in the file or as FreeType
 * unpacks them; and FreeType's errors: see face_internal.h. */
#include "face_internal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include FT_TRUETYPE_TABLES_H

enum font_status font_face_fail(const struct font_face *face, const char *what, int error)
{
    const char *reason = FT_Error_String(error);
    char number[32];
    if (!reason) {
        snprintf(number, sizeof number, "FreeType error %d", error);
        reason = number;
    }
    return font_fail(FT_ERROR_BASE(error) == FT_Err_Out_Of_Memory ? FONT_NO_MEMORY
                                                                  : FONT_BAD_FILE,
                     "%s: %s: %s", face->path, what, reason);
}

struct face_table {
    struct face_table *next;
    hb_tag_t tag;
    hb_blob_t *blob;
};

/* A table that FreeType finds: of a packed file (WOFF), unpacked. It stays until the face ends,
 * since HarfBuzz's subsetter (6.0) reads tables that it has given back. */
static hb_blob_t *table_unpack(hb_face_t *hb, hb_tag_t tag, void *data)
{
    struct font_face *face = data;
    FT_ULong length = 0;
    (void)hb;
    for (struct face_table *t = face->tables; t; t = t->next)
        if (t->tag == tag)
            return hb_blob_reference(t->blob);
    if (tag == HB_TAG_NONE || FT_Load_Sfnt_Table(face->ft, tag, 0, NULL, &length) || !length ||
        length > INT32_MAX)
        return NULL;
    struct face_table *table = malloc(sizeof *table);
    char *bytes = malloc(length);
    if (!table || !bytes || FT_Load_Sfnt_Table(face->ft, tag, 0, (FT_Byte *)bytes, &length)) {
        free(table);
        free(bytes);
        return NULL;
    }
    hb_blob_t *blob =
        hb_blob_create(bytes, (unsigned)length, HB_MEMORY_MODE_WRITABLE, bytes, free);
    *table = (struct face_table){face->tables, tag, blob};
    face->tables = table;
    return hb_blob_reference(blob);
}

static bool is_packed(const struct font_face *face)
{
    return face->bytes_count >= 4 &&
           (memcmp(face->bytes, "wOFF", 4) == 0 || memcmp(face->bytes, "wOF2", 4) == 0);
}

/* Whether its tables are listed in another order than that of their tags: HarfBuzz would find
 * few of them. */
static bool is_disordered(const struct font_face *face)
{
    enum { HEAD = 12, ROW = 16 };
    const unsigned char *b = face->bytes;
    if (face->bytes_count < HEAD || !FT_IS_SFNT(face->ft) || memcmp(b, "ttcf", 4) == 0)
        return false;
    size_t rows = (size_t)(b[4] << 8 | b[5]);
    for (size_t i = 1; i < rows && HEAD + ROW * (i + 1) <= face->bytes_count; i++)
        if (memcmp(b + HEAD + ROW * (i - 1), b + HEAD + ROW * i, 4) > 0)
            return true;
    return false;
}

struct hb_face_t *font_face_harfbuzz(struct font_face *face)
{
    if (face->hb_face)
        return face->hb_face;
    if (is_packed(face) || is_disordered(face)) {
        face->hb_face = hb_face_create_for_tables(table_unpack, face, NULL);
    } else {
        hb_blob_t *blob = hb_blob_create((const char *)face->bytes, (unsigned)face->bytes_count,
                                         HB_MEMORY_MODE_READONLY, NULL, NULL);
        face->hb_face = hb_face_create(blob, (unsigned)(face->ft->face_index & 0xffff));
        hb_blob_destroy(blob);
    }
    hb_face_set_upem(face->hb_face, face->ft->units_per_EM);
    hb_face_set_glyph_count(face->hb_face, (unsigned)face->ft->num_glyphs);
    return face->hb_face;
}

void font_face_harfbuzz_variations(const struct font_face *face, struct hb_font_t *font)
{
    hb_variation_t variations[FACE_AXES_MAX];
    for (int i = 0; i < face->axes_count; i++)
        variations[i] = (hb_variation_t){(hb_tag_t)face->axes->axis[i].tag,
                                         (float)((double)face->values[i] / 65536)};
    if (face->axes_count)
        hb_font_set_variations(font, variations, (unsigned)face->axes_count);
}

void font_face_harfbuzz_finish(struct font_face *face)
{
    hb_font_destroy(face->hb_font);
    hb_face_destroy(face->hb_face);
    for (struct face_table *t = face->tables, *next; t; t = next) {
        next = t->next;
        hb_blob_destroy(t->blob);
        free(t);
    }
}
