/* edits_read.c - a level's file in a folder of edits: see edits_internal.h. */
#include "edits_internal.h"

#include <display.h>

#include <stdlib.h>
#include <string.h>

/* The outline that the file has; where it says no advance, with the font's own. */
static enum font_status outline_take(struct edits_row *row, const char *path, const char *bytes,
                                     size_t count, double advance, double em)
{
    row->outline = (struct font_outline){.advance = advance, .units_per_em = em};
    return edits_outline_read(path, bytes, count, &row->outline);
}

static enum font_status master_take(struct edits_row *row, const char *path, double advance,
                                    double em)
{
    struct display_image image = {0};
    if (display_png_bytes(path, 1) > EDITS_PNG_BYTES_MAX)
        return font_fail(FONT_TOO_LARGE, "%s: a picture of so many pixels is no master", path);
    if (display_png_read_gray(path, &image) != DISPLAY_OK)
        return font_fail(FONT_BAD_FILE, "%s", display_error());
    const struct font_master_frame frame = {row->em_px,      row->left_px,
                                            row->top_px,     image.width_px,
                                            image.height_px, advance * row->em_px / em};
    enum font_status status = font_master_from_picture(&row->master, &frame, image.pixels);
    display_image_destroy(&image);
    return status;
}

static size_t row_bytes(const struct edits_row *row)
{
    const struct font_master *m = &row->master;
    return (size_t)row->outline.segments_count * sizeof *row->outline.segments +
           (size_t)m->row_words * (size_t)m->height_px * sizeof *m->bits +
           (size_t)row->rectangles.count * sizeof *row->rectangles.items +
           row->gray.memory_bytes + (row->words ? strlen(row->words) : 0);
}

enum font_status edits_row_read(struct font_edits *edits, struct edits_row *row,
                                struct font_face *face)
{
    char *bytes = NULL, sum[EDITS_SUM + 1];
    size_t count = 0;
    double advance = 0;
    struct font_face_info info;
    char *path = edits_path(edits->folder, row->file);
    enum font_status status = path ? edits_file_read(edits->folder, row->file, &bytes, &count)
                                   : font_fail(FONT_NO_MEMORY, "no memory for edits");
    font_face_describe(face, &info);
    if (status == FONT_OK) {
        row->edit.edited = strcmp(row->sum, "-") == 0;
        if (!row->edit.edited) {
            edits_sum(bytes, count, EDITS_SUM, sum);
            row->edit.edited = strcmp(sum, row->sum) != 0;
        }
    }
    if (status == FONT_OK && row->edit.edited) {
        if (row->edit.glyph != FONT_EVERY_GLYPH)
            (void)font_face_advance(face, row->edit.glyph, &advance);
        switch (row->edit.level) {
        case FONT_EDITS_OUTLINE:
            status = outline_take(row, path, bytes, count, advance, info.units_per_em);
            break;
        case FONT_EDITS_MASTER:
            status = master_take(row, path, advance, info.units_per_em);
            break;
        case FONT_EDITS_RECTANGLES:
            status = strlen(bytes) == count
                         ? edits_rectangles_read(path, bytes, info.units_per_em, advance,
                                                 &row->rectangles)
                         : font_fail(FONT_BAD_FILE, "%s is no text", path);
            break;
        case FONT_EDITS_FILTER:
            status = edits_filter_read(row, path, bytes, count);
            break;
        case FONT_EDITS_GRAY:
            status = edits_gray_read(row, path);
            break;
        case FONT_EDITS_LEVELS:
            break;
        }
        edits->bytes += row_bytes(row);
        if (status == FONT_OK && edits->bytes > EDITS_ALL_BYTES_MAX)
            status = font_fail(FONT_TOO_LARGE, "%s: all edits together hold more than %d bytes",
                               edits->folder, EDITS_ALL_BYTES_MAX);
    }
    free(bytes);
    free(path);
    return status;
}
