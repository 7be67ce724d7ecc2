/* edits.c - faces and levels with their edits: see edits.h. */
#include "edits_internal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- reading ---- */

/* Whether a row before it is the same glyph's at the same level. */
static bool is_again(const struct font_edits *edits, int i)
{
    const struct font_edit *e = &edits->rows[i].edit;
    for (int k = 0; k < i; k++)
        if (edits->rows[k].edit.glyph == e->glyph && edits->rows[k].edit.level == e->level)
            return true;
    return false;
}

static enum font_status rows_read(struct font_edits *edits, struct font_face *face)
{
    enum font_status status = FONT_OK;
    for (int i = 0; i < edits->rows_count && status == FONT_OK; i++) {
        struct edits_row *row = &edits->rows[i];
        row->edit.name = row->name;
        row->edit.file = row->file;
        status = font_patience_ask(0);
        if (status != FONT_OK)
            break;
        status = font_face_glyph_named(face, row->name, &row->edit.glyph);
        if (status != FONT_OK)
            status = font_fail(status, "%s/edits.txt: %.300s", edits->folder, font_error());
        else if (is_again(edits, i))
            status =
                font_fail(FONT_BAD_FILE, "%s/edits.txt: %s has two rows of its %s",
                          edits->folder, row->name, font_edits_level_name(row->edit.level));
        else
            status = edits_row_read(edits, row, face);
    }
    return status;
}

enum font_status font_edits_read(const char *folder, struct font_face *face,
                                 struct font_edits **out)
{
    char sum[65];
    size_t count;
    struct font_face_info info;
    struct font_edits *edits;
    enum font_status status = edits_list_read(folder, &edits);
    *out = NULL;
    if (status == FONT_OK)
        status = rows_read(edits, face);
    if (status != FONT_OK) {
        font_edits_destroy(edits);
        return status;
    }
    const void *bytes = font_face_bytes(face, &count);
    font_face_describe(face, &info);
    edits_sum(bytes, count, 64, sum);
    if (strcmp(sum, edits->sha256) != 0)
        error_text_fail(&edits->changed, 0,
                        "%s has changed since the edits in %s were made of %s", info.path,
                        folder, edits->font);
    *out = edits;
    return FONT_OK;
}

const char *font_edits_changed(const struct font_edits *edits)
{
    return edits->changed.text[0] ? edits->changed.text : NULL;
}

int font_edits_count(const struct font_edits *edits)
{
    return edits->rows_count;
}

struct font_edit font_edits_at(const struct font_edits *edits, int i)
{
    return edits->rows[i].edit;
}

/* ---- a glyph ---- */

/* The glyph's row of a level, if that was edited. */
static const struct edits_row *edited_at(const struct font_edits *edits, uint32_t glyph,
                                         enum font_edits_level level)
{
    for (int i = 0; edits && i < edits->rows_count; i++) {
        const struct font_edit *e = &edits->rows[i].edit;
        if (e->glyph == glyph && e->level == level && e->edited)
            return &edits->rows[i];
    }
    return NULL;
}

enum font_status font_edits_levels(const struct font_edits *edits, struct font_face *face,
                                   uint32_t glyph, int em_px, double size_px,
                                   const char *filter, struct font_levels **out)
{
    const struct edits_row *outline = edited_at(edits, glyph, FONT_EDITS_OUTLINE);
    const struct edits_row *master = edited_at(edits, glyph, FONT_EDITS_MASTER);
    const struct edits_row *parts = edited_at(edits, glyph, FONT_EDITS_RECTANGLES);
    struct font_outline own = {0};
    *out = NULL;
    enum font_status status = outline ? FONT_OK : font_face_outline(face, glyph, &own);
    if (status == FONT_OK)
        status =
            font_levels_create(outline ? &outline->outline : &own, em_px, size_px, filter, out);
    font_outline_finish(&own);
    if (status == FONT_OK && master)
        status = font_levels_master_set(*out, &master->master);
    if (status == FONT_OK && parts)
        status = font_levels_rectangles_set(*out, &parts->rectangles);
    if (status != FONT_OK) {
        font_levels_destroy(*out);
        *out = NULL;
    }
    return status;
}

/* The outline that a glyph has by its lowest edit, and the same without steps. */
static enum font_status outline_find(const struct font_edits *edits, uint32_t glyph, double em,
                                     struct font_outline *exact, struct font_outline *rough)
{
    const struct edits_row *outline = edited_at(edits, glyph, FONT_EDITS_OUTLINE);
    const struct edits_row *master = edited_at(edits, glyph, FONT_EDITS_MASTER);
    const struct edits_row *parts = edited_at(edits, glyph, FONT_EDITS_RECTANGLES);
    struct font_master covered = {0};
    const struct font_master *m = parts ? &covered : master ? &master->master : NULL;
    if (!m)
        return font_outline_copy(&outline->outline, exact);
    enum font_status status =
        parts ? font_rectangles_master(&parts->rectangles, &covered) : FONT_OK;
    if (status == FONT_OK)
        status = font_master_outline(m, em, false, exact);
    if (status == FONT_OK)
        status = font_master_outline(m, em, true, rough);
    if (status == FONT_OK && outline)
        exact->advance = outline->outline.advance;
    font_master_finish(&covered);
    return status;
}

enum font_status font_edits_apply(const struct font_edits *edits, struct font_face *face)
{
    enum font_status status = FONT_OK;
    struct font_face_info info;
    font_face_describe(face, &info);
    for (int i = 0; i < edits->rows_count && status == FONT_OK; i++) {
        const struct edits_row *row = &edits->rows[i];
        struct font_outline exact = {0}, rough = {0};
        if (!row->edit.edited || font_face_is_replaced(face, row->edit.glyph))
            continue; /* not, or with another of the glyph's rows */
        status = font_patience_ask(0);
        if (status == FONT_OK)
            status = outline_find(edits, row->edit.glyph, info.units_per_em, &exact, &rough);
        if (status == FONT_OK)
            status = font_face_outline_replace(face, row->edit.glyph, &exact,
                                               rough.segments_count ? &rough : NULL);
        if (status != FONT_OK)
            status = font_fail(status, "%s/%s: %.300s", edits->folder, row->file, font_error());
        font_outline_finish(&exact);
        font_outline_finish(&rough);
    }
    return status;
}
