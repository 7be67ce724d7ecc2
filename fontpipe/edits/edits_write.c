/* edits_write.c - levels out of the pipeline, to be edited: see edits.h. */
#include "edits_internal.h"

#include <display.h>
#include <output_file.h>

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* Where a level goes. stray: a file that no row has is there. */
struct edits_out {
    const char *folder, *file;
    char *path;
    bool stray;
};

static const char *const endings[FONT_EDITS_LEVELS] = {".svg", ".png", ".txt", ".txt", ".png"};

/* ---- outlines ---- */

static void svg_put(FILE *f, const struct font_outline *o, const struct font_face_info *info)
{
    fprintf(f,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 %.9g %.9g %.9g\">\n"
            "<path d=\"",
            -info->ascender, o->advance, info->ascender - info->descender);
    for (int i = 0; i < o->segments_count; i++) {
        const struct font_segment *s = &o->segments[i];
        if (i == 0 || s[-1].contour != s->contour)
            fprintf(f, "%sM%.9g %.9g\n", i ? "Z\n" : "", s->p[0].x, -s->p[0].y);
        fputc(s->degree == 1 ? 'L' : s->degree == 2 ? 'Q' : 'C', f);
        for (int k = 1; k <= s->degree; k++)
            fprintf(f, "%s%.9g %.9g", k > 1 ? " " : "", s->p[k].x, 0 - s->p[k].y);
        fputc('\n', f);
    }
    fprintf(f, "%s\"/>\n</svg>\n", o->segments_count ? "Z" : "");
}

static void glif_put(FILE *f, const struct font_outline *o, const char *name)
{
    static const char *const types[] = {"line", "qcurve", "curve"};
    fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<glyph name=\"", f);
    for (; *name; name++) {
        if (strchr("<>&\"", *name))
            fprintf(f, "&#%d;", *name);
        else
            fputc(*name, f);
    }
    fprintf(f, "\" format=\"2\">\n<advance width=\"%.9g\"/>\n<outline>\n", o->advance);
    for (int i = 0; i < o->segments_count; i++) {
        const struct font_segment *s = &o->segments[i];
        bool first = i == 0 || s[-1].contour != s->contour;
        if (first)
            fprintf(f, "%s<contour>\n", i ? "</contour>\n" : "");
        for (int k = 1; k < s->degree; k++)
            fprintf(f, "<point x=\"%.9g\" y=\"%.9g\"/>\n", s->p[k].x, s->p[k].y);
        fprintf(f, "<point x=\"%.9g\" y=\"%.9g\" type=\"%s\"/>\n", s->p[s->degree].x,
                s->p[s->degree].y, types[s->degree - 1]);
    }
    fprintf(f, "%s</outline>\n</glyph>\n", o->segments_count ? "</contour>\n" : "");
}

/* ---- files ----
 *
 * A file that no row has, and that is not what would be written, is somebody's own and stays.
 * One that is the same is of a run that was cut off before its row was written. */

static enum font_status refuse(const char *path)
{
    return font_fail(FONT_BAD_ARGUMENT, "%s is there already, and no row of edits.txt has it",
                     path);
}

static enum font_status text_write(const struct edits_out *to, const char *text, size_t count)
{
    struct output_file out;
    const char *path = to->path;
    if (to->stray) {
        char *there = NULL;
        size_t bytes;
        enum font_status status = edits_file_read(to->folder, to->file, &there, &bytes);
        bool same = status == FONT_OK && bytes == count && memcmp(there, text, count) == 0;
        free(there);
        if (!same)
            return refuse(path);
    }
    if (!output_file_open(&out, path))
        return font_fail(FONT_BAD_FILE, "%s: cannot write: %s", path, out.why);
    fwrite(text, 1, count, out.stream);
    return output_file_commit(&out)
               ? FONT_OK
               : font_fail(FONT_BAD_FILE, "%s: cannot write: %s", path, out.why);
}

static enum font_status outline_write(const struct edits_out *to, struct font_face *face,
                                      uint32_t glyph, const char *ending)
{
    struct font_outline o;
    struct font_face_info info;
    char name[FONT_GLYPH_NAME_BYTES], *text = NULL;
    size_t count = 0;
    enum font_status status = font_face_outline_raw(face, glyph, &o);
    if (status != FONT_OK)
        return status;
    font_face_describe(face, &info);
    FILE *f = open_memstream(&text, &count);
    if (f && strcmp(ending, ".svg") == 0)
        svg_put(f, &o, &info);
    else if (f)
        glif_put(f, &o, font_face_glyph_name(face, glyph, name));
    font_outline_finish(&o);
    status = f && fclose(f) == 0 && text
                 ? text_write(to, text, count)
                 : font_fail(FONT_NO_MEMORY, "no memory for %s", to->path);
    free(text);
    return status;
}

static enum font_status rectangles_write(const struct edits_out *to, struct font_levels *levels)
{
    const struct font_rectangles *r;
    char *text = NULL;
    size_t count = 0;
    enum font_status status = font_levels_rectangles(levels, &r);
    if (status != FONT_OK)
        return status;
    FILE *f = open_memstream(&text, &count);
    if (f)
        fprintf(f, "em %d\n", r->em_px);
    for (int i = 0; f && i < r->count; i++)
        fprintf(f, "%d %d %d %d\n", r->items[i].x0, r->items[i].y0, r->items[i].x1,
                r->items[i].y1);
    status = f && fclose(f) == 0 && text
                 ? text_write(to, text, count)
                 : font_fail(FONT_NO_MEMORY, "no memory for %s", to->path);
    free(text);
    return status;
}

static bool is_picture(const char *path, const struct display_image *image)
{
    struct display_image there = {0};
    bool same = display_png_bytes(path, 1) <= EDITS_PNG_BYTES_MAX &&
                display_png_read_gray(path, &there) == DISPLAY_OK &&
                there.width_px == image->width_px && there.height_px == image->height_px &&
                memcmp(there.pixels, image->pixels,
                       (size_t)image->width_px * (size_t)image->height_px) == 0;
    display_image_destroy(&there);
    return same;
}

static enum font_status picture_write(const struct edits_out *to,
                                      const struct display_image *image)
{
    if (to->stray && !is_picture(to->path, image))
        return refuse(to->path);
    return display_png_write(to->path, image) == DISPLAY_OK
               ? FONT_OK
               : font_fail(FONT_BAD_FILE, "%s", display_error());
}

/* With a margin for ink that goes beyond the letter. */
static enum font_status master_write(const struct edits_out *to, struct font_levels *levels,
                                     struct edits_row *row)
{
    const struct font_master *m;
    enum font_status status = font_levels_master(levels, &m);
    if (status != FONT_OK)
        return status;
    int margin = m->em_px / 16 + 1;
    struct display_image image = {.width_px = m->width_px + 2 * margin,
                                  .height_px = m->height_px + 2 * margin,
                                  .channels = 1};
    if (display_image_create(&image) != DISPLAY_OK)
        return font_fail(FONT_NO_MEMORY, "%s", display_error());
    font_master_to_picture(m, margin, image.pixels);
    status = picture_write(to, &image);
    display_image_destroy(&image);
    row->em_px = m->em_px;
    row->left_px = m->left_px - margin;
    row->top_px = m->top_px - margin;
    return status;
}

static enum font_status gray_write(const struct edits_out *to, struct font_levels *levels,
                                   struct edits_row *row)
{
    struct display_image image = {0};
    enum font_status status = edits_gray_picture(levels, row, &image);
    if (status == FONT_OK)
        status = picture_write(to, &image);
    display_image_destroy(&image);
    return status;
}

static enum font_status filter_write(const struct edits_out *to,
                                     const struct font_levels *levels)
{
    char *text = NULL;
    size_t count = 0;
    enum font_status status = edits_filter_text(font_levels_filter(levels), &text, &count);
    if (status == FONT_OK)
        status = text_write(to, text, count);
    free(text);
    return status;
}

/* The level of a row to its file. */
static enum font_status level_write(const struct edits_out *to, struct font_face *face,
                                    struct edits_row *row, const char *ending,
                                    struct font_levels *levels)
{
    switch (row->edit.level) {
    case FONT_EDITS_OUTLINE:
        return outline_write(to, face, row->edit.glyph, ending);
    case FONT_EDITS_MASTER:
        return master_write(to, levels, row);
    case FONT_EDITS_RECTANGLES:
        return rectangles_write(to, levels);
    case FONT_EDITS_FILTER:
        return filter_write(to, levels);
    case FONT_EDITS_GRAY:
        return gray_write(to, levels, row);
    case FONT_EDITS_LEVELS:
        break;
    }
    return FONT_OK;
}

/* ---- rows ---- */

static enum font_status list_begin(const char *folder, struct font_face *face,
                                   const struct font_edits *edits, struct font_edits *out)
{
    struct font_face_info info;
    font_face_describe(face, &info);
    const char *base = strrchr(info.path, '/');
    size_t count;
    const void *bytes = font_face_bytes(face, &count);
    *out = (struct font_edits){0};
    out->folder = strdup(folder);
    if (!out->folder)
        return font_fail(FONT_NO_MEMORY, "no memory for edits");
    snprintf(out->font, sizeof out->font, "%.255s", base ? base + 1 : info.path);
    out->face = info.index;
    edits_sum(bytes, count, 64, out->sha256);
    if (edits) {
        snprintf(out->font, sizeof out->font, "%s", edits->font);
        snprintf(out->sha256, sizeof out->sha256, "%s", edits->sha256);
        out->face = edits->face;
    }
    for (int i = 0; edits && i < edits->rows_count; i++) {
        struct edits_row *row;
        enum font_status status = edits_row_add(out, &row);
        if (status != FONT_OK)
            return status;
        const struct edits_row *from = &edits->rows[i];
        *row = *from; /* without what it owns */
        row->outline = (struct font_outline){0};
        row->master = (struct font_master){0};
        row->rectangles = (struct font_rectangles){0};
        row->gray = (struct font_gray){0};
        row->words = NULL;
        row->setting = from->setting ? strdup(from->setting) : NULL;
        if (from->setting && !row->setting)
            return font_fail(FONT_NO_MEMORY, "no memory for edits");
    }
    if (!edits && mkdir(folder, 0777) != 0 && errno != EEXIST)
        return font_fail(FONT_BAD_FILE, "%s: cannot make this folder: %s", folder,
                         strerror(errno));
    return FONT_OK;
}

/* A file's name: the glyph's, and of filters and gray what they are, their sizes, and the
 * axes. */
static void file_name(struct edits_row *row, const char *ending)
{
    char more[EDITS_SETTING_BYTES + 80] = "";
    size_t used = 0;
    const struct font_edit *e = &row->edit;
    const char *name = e->glyph == FONT_EVERY_GLYPH ? "all" : row->name;
    if (e->level == FONT_EDITS_FILTER)
        used += (size_t)snprintf(more, sizeof more, "-filter");
    if (e->level == FONT_EDITS_GRAY)
        used += (size_t)snprintf(more, sizeof more, "-%.9g", e->from_px);
    else if (e->level == FONT_EDITS_FILTER && (e->from_px > 0 || e->to_px < FONT_SIDE_MAX))
        used += (size_t)snprintf(more + used, sizeof more - used, "-%.9g-%.9g", e->from_px,
                                 e->to_px);
    for (const char *at = row->setting ? row->setting : ""; *at && used + 1 < sizeof more; at++)
        if (*at != '=') /* @wght=700,wdth=80: -wght700-wdth80 */
            more[used++] = *at == '@' || *at == ',' ? '-' : *at;
    more[used] = '\0';
    int n = snprintf(row->file, sizeof row->file, "%s%s%s", name, more, ending);
    if (n < 0 || n >= (int)sizeof row->file || !edits_file_is_plain(row->file))
        snprintf(row->file, sizeof row->file, "glyph%u%.60s%s", (unsigned)e->glyph, more,
                 ending);
    if (!edits_file_is_plain(row->file))
        snprintf(row->file, sizeof row->file, "glyph%u%s", (unsigned)e->glyph, ending);
}

/* A name that no other row has. */
static void file_choose(const struct font_edits *list, struct edits_row *row,
                        const char *ending)
{
    enum { STEM_MAX = 120 };
    char wanted[FONT_EDITS_FILE_BYTES];
    file_name(row, ending);
    memcpy(wanted, row->file, sizeof wanted);
    size_t stem = strlen(wanted) - strlen(ending);
    for (int number = 2, i = 0; i < list->rows_count; i++)
        if (&list->rows[i] != row && strcmp(list->rows[i].file, row->file) == 0) {
            snprintf(row->file, sizeof row->file, "%.*s-%d%s",
                     (int)(stem < STEM_MAX ? stem : STEM_MAX), wanted, number++, ending);
            i = -1;
        }
}

/* The row of what is written, or a new one. */
static enum font_status row_find(struct font_edits *list, struct font_face *face,
                                 const struct edits_row *wanted, const char *ending,
                                 struct edits_row **out, struct edits_out *to)
{
    for (int i = 0; i < list->rows_count; i++) {
        struct edits_row *row = &list->rows[i];
        if (!edits_row_same(row, wanted))
            continue;
        if (row->edit.edited)
            return font_fail(
                FONT_BAD_ARGUMENT,
                "%s/%s was edited; take its row out of edits.txt and the file away "
                "to write it anew",
                list->folder, row->file);
        *out = row;
    }
    enum font_status status = *out ? FONT_OK : edits_row_add(list, out);
    if (status != FONT_OK)
        return status;
    struct edits_row *row = *out;
    bool written = row->file[0] != '\0';
    char former[FONT_EDITS_FILE_BYTES];
    memcpy(former, row->file, sizeof former);
    if (!written) {
        row->edit = wanted->edit;
        row->setting = wanted->setting ? strdup(wanted->setting) : NULL;
        if (wanted->setting && !row->setting)
            return font_fail(FONT_NO_MEMORY, "no memory for edits");
    }
    if (wanted->edit.glyph == FONT_EVERY_GLYPH)
        snprintf(row->name, sizeof row->name, "*");
    else
        font_face_glyph_name(face, wanted->edit.glyph, row->name);
    file_choose(list, row, ending);
    struct stat about;
    to->folder = list->folder;
    to->file = row->file;
    to->path = edits_path(list->folder, row->file);
    if (!to->path)
        return font_fail(FONT_NO_MEMORY, "no memory for edits");
    to->stray = lstat(to->path, &about) == 0 && (!written || strcmp(former, row->file) != 0);
    return FONT_OK;
}

/* A row that says what is written. */
static enum font_status wanted_make(const struct font_face *face,
                                    const struct font_edits_out *what,
                                    const struct font_levels *levels, struct edits_row *row)
{
    *row = (struct edits_row){.edit = {.glyph = what->glyph, .level = what->level}};
    if (what->level == FONT_EDITS_GRAY)
        row->edit.from_px = row->edit.to_px = font_levels_size(levels);
    if (what->level == FONT_EDITS_FILTER) {
        row->edit.from_px = what->from_px;
        row->edit.to_px = what->to_px > 0 ? what->to_px : FONT_SIDE_MAX;
    }
    if (what->glyph == FONT_EVERY_GLYPH && what->level != FONT_EDITS_FILTER)
        return font_fail(FONT_BAD_ARGUMENT, "the level %s is one glyph's",
                         font_edits_level_name(what->level));
    return what->here ? edits_setting_of(face, &row->setting) : FONT_OK;
}

enum font_status font_edits_write(const char *folder, const struct font_edits *edits,
                                  struct font_face *face, const struct font_edits_out *what,
                                  struct font_levels *levels, char room[FONT_EDITS_FILE_BYTES])
{
    struct font_edits list = {0};
    struct edits_row *row = NULL, wanted;
    struct edits_out to = {0};
    char *bytes = NULL;
    size_t count;
    const char *ending = what->ending ? what->ending : endings[what->level];
    enum font_status status = wanted_make(face, what, levels, &wanted);
    if (status == FONT_OK)
        status = list_begin(folder, face, edits, &list);
    if (status == FONT_OK)
        status = row_find(&list, face, &wanted, ending, &row, &to);
    if (status == FONT_OK)
        status = level_write(&to, face, row, ending, levels);
    if (status == FONT_OK)
        status = edits_file_read(folder, row->file, &bytes, &count);
    if (status == FONT_OK) {
        edits_sum(bytes, count, EDITS_SUM, row->sum);
        if (what->level == FONT_EDITS_FILTER)
            snprintf(row->sum, sizeof row->sum, "-"); /* it counts as it is */
        snprintf(room, FONT_EDITS_FILE_BYTES, "%s", row->file);
        status = edits_list_write(&list);
    }
    free(bytes);
    free(to.path);
    free(wanted.setting);
    for (int i = 0; i < list.rows_count; i++)
        free(list.rows[i].setting);
    free(list.rows);
    free(list.folder);
    return status;
}
