/* face_replaced.c - glyphs that are no longer those of the font's file: see face.h. */
#include "face_internal.h"

#include <stdlib.h>
#include <string.h>

/* Where the glyph of a setting is, or would be. */
static int place_of(const struct font_face *face, uint32_t glyph, int setting)
{
    int from = 0, to = face->replaced_count;
    while (from < to) {
        int middle = from + (to - from) / 2;
        const struct font_replaced *r = &face->replaced[middle];
        if (r->glyph < glyph || (r->glyph == glyph && r->setting < setting))
            from = middle + 1;
        else
            to = middle;
    }
    return from;
}

static const struct font_replaced *replaced_at(const struct font_face *face, uint32_t glyph,
                                               int setting)
{
    int i = place_of(face, glyph, setting);
    return i < face->replaced_count && face->replaced[i].glyph == glyph &&
                   face->replaced[i].setting == setting
               ? &face->replaced[i]
               : NULL;
}

const struct font_replaced *font_face_replaced(const struct font_face *face, uint32_t glyph)
{
    if (!face->replaced_count)
        return NULL;
    const struct font_replaced *here =
        face->own_setting ? replaced_at(face, glyph, face->own_setting) : NULL;
    return here ? here : replaced_at(face, glyph, 0);
}

int font_face_replaced_count(const struct font_face *face)
{
    return face->replaced_count;
}

bool font_face_is_replaced(const struct font_face *face, uint32_t glyph)
{
    return font_face_replaced(face, glyph) != NULL;
}

static void replaced_free(struct font_replaced *r)
{
    font_outline_finish(&r->outline);
    font_outline_finish(&r->rough);
}

void font_face_replaced_finish(struct font_face *face)
{
    for (int i = 0; i < face->replaced_count; i++)
        replaced_free(&face->replaced[i]);
    free(face->replaced);
}

/* A copy with the face's em and this advance. */
static enum font_status copy_make(const struct font_face *face,
                                  const struct font_outline *outline, double advance,
                                  struct font_outline *out)
{
    enum font_status status = font_outline_copy(outline, out);
    out->units_per_em = face->ft->units_per_EM;
    out->advance = advance;
    return status;
}

enum font_status font_face_outline_replace(struct font_face *face, uint32_t glyph,
                                           const struct font_outline *outline,
                                           const struct font_outline *rough, bool here)
{
    struct font_replaced made = {.glyph = glyph};
    if (here && (made.setting = font_face_own_setting(face)) == 0)
        return font_fail(FONT_NO_MEMORY, "no memory for a glyph");
    if (glyph >= (uint32_t)face->ft->num_glyphs)
        return font_fail(FONT_NO_GLYPH, "%s has no glyph %u", face->path, (unsigned)glyph);
    enum font_status status = copy_make(face, outline, outline->advance, &made.outline);
    if (status == FONT_OK)
        status = copy_make(face, rough ? rough : outline, outline->advance, &made.rough);
    if (status == FONT_OK)
        status = font_outline_prepare(&made.outline, FONT_NONZERO);
    int i = place_of(face, glyph, made.setting);
    bool there = replaced_at(face, glyph, made.setting) != NULL;
    if (status == FONT_OK && !there &&
        !array_reserve(&face->replaced, &face->replaced_capacity, face->replaced_count + 1,
                       sizeof *face->replaced))
        status = font_fail(FONT_NO_MEMORY, "no memory for a glyph");
    if (status != FONT_OK) {
        replaced_free(&made);
        return status;
    }
    if (there) {
        replaced_free(&face->replaced[i]);
    } else {
        memmove(&face->replaced[i + 1], &face->replaced[i],
                (size_t)(face->replaced_count - i) * sizeof *face->replaced);
        face->replaced_count++;
    }
    face->replaced[i] = made;
    font_face_version_renew(face);
    return FONT_OK;
}
