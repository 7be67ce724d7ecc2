/* edits.c - faces and levels with their edits: see edits.h. */
#include "edits_internal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- reading ---- */

bool edits_row_same(const struct edits_row *a, const struct edits_row *b)
{
    return a->edit.glyph == b->edit.glyph && a->edit.level == b->edit.level &&
           a->edit.from_px == b->edit.from_px && a->edit.to_px == b->edit.to_px &&
           edits_setting_same(a->setting, b->setting);
}

/* Whether a row before it is the same. */
static bool is_again(const struct font_edits *edits, int i)
{
    for (int k = 0; k < i; k++)
        if (edits_row_same(&edits->rows[k], &edits->rows[i]))
            return true;
    return false;
}

/* Sets the axes to what the row is for, and has that in the row in one form. own: how they are
 * set otherwise, and now, if `*now` is NULL. */
static enum font_status setting_go(struct edits_row *row, struct font_face *face,
                                   const char *own, const char **now)
{
    if (edits_setting_same(row->setting, *now))
        return FONT_OK;
    enum font_status status = edits_setting_set(face, row->setting ? row->setting : own);
    char *kept = NULL;
    if (status == FONT_OK && row->setting)
        status = edits_setting_of(face, &kept);
    if (status == FONT_OK && row->setting) {
        free(row->setting);
        row->setting = kept;
    }
    *now = status == FONT_OK ? row->setting : NULL;
    return status;
}

static enum font_status row_check(struct font_edits *edits, int i, struct font_face *face)
{
    struct edits_row *row = &edits->rows[i];
    row->edit.name = row->name;
    row->edit.file = row->file;
    row->edit.setting = row->setting ? row->setting : "";
    if (row->edit.level == FONT_EDITS_FILTER && strcmp(row->name, "*") == 0)
        row->edit.glyph = FONT_EVERY_GLYPH;
    else if (font_face_glyph_named(face, row->name, &row->edit.glyph) != FONT_OK)
        return font_fail(FONT_NO_GLYPH, "%s/edits.txt: %.300s", edits->folder, font_error());
    return is_again(edits, i)
               ? font_fail(FONT_BAD_FILE, "%s/edits.txt: %s has two rows of its %s",
                           edits->folder, row->name, font_edits_level_name(row->edit.level))
               : FONT_OK;
}

static enum font_status rows_read(struct font_edits *edits, struct font_face *face)
{
    char *own = NULL;
    const char *now = NULL;
    enum font_status status = edits_setting_of(face, &own);
    if (status == FONT_BAD_ARGUMENT) /* then no row has a setting */
        status = FONT_OK;
    for (int i = 0; i < edits->rows_count && status == FONT_OK; i++) {
        struct edits_row *row = &edits->rows[i];
        status = font_patience_ask(0);
        if (status != FONT_OK)
            break;
        status = setting_go(row, face, own, &now);
        if (status != FONT_OK)
            status =
                font_fail(FONT_BAD_FILE, "%s/edits.txt: %.300s", edits->folder, font_error());
        if (status == FONT_OK)
            status = row_check(edits, i, face);
        if (status == FONT_OK)
            status = edits_row_read(edits, row, face);
    }
    if (now && edits_setting_set(face, own) != FONT_OK && status == FONT_OK)
        status = FONT_BAD_FILE;
    free(own);
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

/* The glyph's row of a level for a setting (NULL: any), if that was edited. */
static const struct edits_row *edited_at(const struct font_edits *edits, uint32_t glyph,
                                         const char *setting, enum font_edits_level level)
{
    for (int i = 0; edits && i < edits->rows_count; i++) {
        const struct font_edit *e = &edits->rows[i].edit;
        if (e->glyph == glyph && e->level == level && e->edited &&
            edits_setting_same(edits->rows[i].setting, setting))
            return &edits->rows[i];
    }
    return NULL;
}

/* What a glyph's form has been edited at; NULL: not there. */
struct form {
    const struct edits_row *outline, *master, *parts;
};

static struct form form_at(const struct font_edits *edits, uint32_t glyph, const char *setting)
{
    return (struct form){edited_at(edits, glyph, setting, FONT_EDITS_OUTLINE),
                         edited_at(edits, glyph, setting, FONT_EDITS_MASTER),
                         edited_at(edits, glyph, setting, FONT_EDITS_RECTANGLES)};
}

static bool is_formed(const struct form *f)
{
    return f->outline || f->master || f->parts;
}

/* The row of the filter or of the gray that the glyph has at a size, if it was edited: looked
 * for as a face looks for its own (own.h). */
static const struct edits_row *low_find(const struct font_edits *edits,
                                        enum font_edits_level level, uint32_t glyph,
                                        const char *setting, double size_px)
{
    for (int i = 0; edits && i < FONT_OWN_PLACES * edits->rows_count; i++) {
        const struct font_own_place place = font_own_place(glyph, i / edits->rows_count);
        const struct edits_row *row = &edits->rows[i % edits->rows_count];
        const struct font_edit *e = &row->edit;
        if (e->glyph == place.glyph && e->level == level && e->edited &&
            font_own_size_is(e->from_px, e->to_px, size_px) &&
            edits_setting_same(row->setting, place.here ? setting : NULL))
            return row;
    }
    return NULL;
}

/* What lies below the form. */
static enum font_status low_set(const struct font_edits *edits, uint32_t glyph,
                                const char *setting, double size_px, struct font_levels *levels)
{
    const struct edits_row *filter =
        low_find(edits, FONT_EDITS_FILTER, glyph, setting, size_px);
    const struct edits_row *gray = low_find(edits, FONT_EDITS_GRAY, glyph, setting, size_px);
    enum font_status status = filter ? font_levels_filter_set(levels, filter->words) : FONT_OK;
    return status == FONT_OK && gray ? font_levels_gray_set(levels, &gray->gray) : status;
}

enum font_status font_edits_levels(const struct font_edits *edits, struct font_face *face,
                                   uint32_t glyph, int em_px, double size_px,
                                   const char *filter, struct font_levels **out)
{
    struct font_outline own = {0};
    char *setting = NULL;
    *out = NULL;
    enum font_status status = edits_setting_of(face, &setting);
    if (status == FONT_BAD_ARGUMENT)
        status = FONT_OK;
    struct form form = form_at(edits, glyph, setting);
    if (!setting || !is_formed(&form))
        form = form_at(edits, glyph, NULL);
    if (status == FONT_OK && !form.outline)
        status = font_face_outline(face, glyph, &own);
    if (status == FONT_OK)
        status = font_levels_create(form.outline ? &form.outline->outline : &own, em_px,
                                    size_px, filter, out);
    font_outline_finish(&own);
    if (status == FONT_OK && form.master)
        status = font_levels_master_set(*out, &form.master->master);
    if (status == FONT_OK && form.parts)
        status = font_levels_rectangles_set(*out, &form.parts->rectangles);
    if (status == FONT_OK)
        status = low_set(edits, glyph, setting, size_px, *out);
    free(setting);
    if (status != FONT_OK) {
        font_levels_destroy(*out);
        *out = NULL;
    }
    return status;
}

/* The outline that a glyph has by its lowest edit, and the same without steps. */
static enum font_status outline_find(const struct form *form, double em,
                                     struct font_outline *exact, struct font_outline *rough)
{
    struct font_master covered = {0};
    const struct font_master *m = form->parts    ? &covered
                                  : form->master ? &form->master->master
                                                 : NULL;
    if (!m)
        return font_outline_copy(&form->outline->outline, exact);
    enum font_status status =
        form->parts ? font_rectangles_master(&form->parts->rectangles, &covered) : FONT_OK;
    if (status == FONT_OK)
        status = font_master_outline(m, em, false, exact);
    if (status == FONT_OK)
        status = font_master_outline(m, em, true, rough);
    if (status == FONT_OK && form->outline)
        exact->advance = form->outline->outline.advance;
    font_master_finish(&covered);
    return status;
}

/* The glyph's form in the row's setting, once, at the first of its rows. */
static enum font_status form_apply(const struct font_edits *edits, const struct edits_row *row,
                                   struct font_face *face)
{
    struct font_outline exact = {0}, rough = {0};
    struct font_face_info info;
    const struct form form = form_at(edits, row->edit.glyph, row->setting);
    const struct edits_row *first = form.outline  ? form.outline
                                    : form.master ? form.master
                                                  : form.parts;
    if (first != row)
        return FONT_OK;
    font_face_describe(face, &info);
    enum font_status status = outline_find(&form, info.units_per_em, &exact, &rough);
    if (status == FONT_OK)
        status = font_face_outline_replace(face, row->edit.glyph, &exact,
                                           rough.segments_count ? &rough : NULL,
                                           row->setting != NULL);
    font_outline_finish(&exact);
    font_outline_finish(&rough);
    return status;
}

static enum font_status row_apply(const struct font_edits *edits, const struct edits_row *row,
                                  struct font_face *face)
{
    switch (row->edit.level) {
    case FONT_EDITS_OUTLINE:
    case FONT_EDITS_MASTER:
    case FONT_EDITS_RECTANGLES:
        return form_apply(edits, row, face);
    case FONT_EDITS_FILTER:
        return font_own_filter_set(face, row->edit.glyph, row->edit.from_px, row->edit.to_px,
                                   row->words, row->setting != NULL);
    case FONT_EDITS_GRAY:
        return font_own_gray_set(face, row->edit.glyph, row->edit.from_px, &row->gray,
                                 row->setting != NULL);
    case FONT_EDITS_LEVELS:
        break;
    }
    return FONT_OK;
}

enum font_status font_edits_apply(const struct font_edits *edits, struct font_face *face)
{
    char *own = NULL;
    const char *now = NULL;
    enum font_status status = edits_setting_of(face, &own);
    if (status == FONT_BAD_ARGUMENT)
        status = FONT_OK;
    for (int i = 0; i < edits->rows_count && status == FONT_OK; i++) {
        const struct edits_row *row = &edits->rows[i];
        if (!row->edit.edited)
            continue;
        status = font_patience_ask(0);
        if (status == FONT_OK && !edits_setting_same(row->setting, now)) {
            status = edits_setting_set(face, row->setting ? row->setting : own);
            now = row->setting;
        }
        if (status == FONT_OK)
            status = row_apply(edits, row, face);
        if (status != FONT_OK)
            status = font_fail(status, "%s/%s: %.300s", edits->folder, row->file, font_error());
    }
    if (now && edits_setting_set(face, own) != FONT_OK && status == FONT_OK)
        status = FONT_BAD_FILE;
    free(own);
    return status;
}
