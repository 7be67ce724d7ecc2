/* edits_internal.h - what the files of edits share.
 *
 *     edits.c          faces and levels with their edits       edits_open.c  fonts by a folder's name
 *     edits_list.c     edits.txt
 *     edits_read.c     a level's file            edits_write.c  likewise out
 *     edits_text.c     files of a folder as text, sums, rectangles
 *     edits_low.c      filter tables and gray, in and out
 *     edits_setting.c  settings of axes
 *     outline_path.c   SVG's paths               outline_xml.c  SVG and glif */
#ifndef LUTETIA_FONT_EDITS_INTERNAL_H
#define LUTETIA_FONT_EDITS_INTERNAL_H

#include "edits.h"

#include <internal.h>
#include <own.h>

enum {
    EDITS_BYTES_MAX = 16 << 20,
    EDITS_ROWS_MAX = 4096,
    EDITS_SUM = 16,
    EDITS_SETTING_BYTES = FONT_AXES_BYTES + 1,
    EDITS_FILTER_BYTES_MAX = 16384,
    EDITS_FAR = 32768,
    EDITS_PNG_BYTES_MAX = 1 << 27,
    EDITS_ALL_BYTES_MAX = 1 << 28 /* what the rows of a folder may hold together */
};

/* A row of edits.txt, and what its file has. */
struct edits_row {
    struct font_edit edit;
    char name[FONT_GLYPH_NAME_BYTES], file[FONT_EDITS_FILE_BYTES], sum[EDITS_SUM + 1];
    char *setting;              /* with its @; NULL: any */
    int em_px, left_px, top_px; /* of a master; of gray without em_px */
    struct font_outline outline;
    struct font_master master;
    struct font_rectangles rectangles;
    char *words; /* of a filter */
    struct font_gray gray;
};

struct font_edits {
    char *folder;
    char font[256], sha256[65];
    int face;
    struct edits_row *rows;
    int rows_count, rows_capacity;
    size_t bytes; /* that the rows hold */
    struct error_text changed;
};

/* edits_text.c: a file of the folder, whole, with a zero behind it. Owns: the caller frees
 * *bytes. Errors: BAD_FILE, NO_MEMORY. */
enum font_status edits_file_read(const char *folder, const char *file, char **bytes,
                                 size_t *count);
/* FOLDER/FILE. Owns: the caller frees it; NULL: no memory. */
char *edits_path(const char *folder, const char *file);
/* A plain name: letters, digits, ._-, and no dot first. */
bool edits_file_is_plain(const char *file);
/* digits: 16, or 64 for all of the sum; room has one more. */
void edits_sum(const void *bytes, size_t count, int digits, char *room);
/* A whole number within bounds, up to white space or the end; the next word. False: it is
 * none. */
bool edits_number(const char **at, int least, int most, int *value);
enum font_status edits_rectangles_read(const char *path, const char *text, double em_units,
                                       double advance, struct font_rectangles *out);

/* A number likewise. */
bool edits_size(const char **at, double least, double most, double *value);

/* edits_setting.c: how the face's axes are set, with an @ before. Owns: the caller frees *out.
 * Errors: BAD_ARGUMENT (a tag that no word can have), NO_MEMORY. */
enum font_status edits_setting_of(const struct font_face *face, char **out);
/* Sets the axes so; NULL: leaves them. Errors: BAD_ARGUMENT. */
enum font_status edits_setting_set(struct font_face *face, const char *setting);
bool edits_setting_same(const char *a, const char *b);

/* edits_low.c. Errors: BAD_FILE, TOO_LARGE, NO_MEMORY. */
enum font_status edits_filter_read(struct edits_row *row, const char *path, const char *bytes,
                                   size_t count);
enum font_status edits_gray_read(struct edits_row *row, const char *path);
/* What a filter's file has. Owns: the caller frees *text. */
enum font_status edits_filter_text(const struct font_filter *filter, char **text,
                                   size_t *count);
/* Paper and ink of the levels' gray, with a margin. Owns: the caller destroys the image. */
struct display_image;
enum font_status edits_gray_picture(struct font_levels *levels, struct edits_row *row,
                                    struct display_image *image);

/* edits_list.c: edits.txt of a folder, without the files. Errors: BAD_FILE, NO_MEMORY. */
enum font_status edits_list_read(const char *folder, struct font_edits **out);
/* Writes it anew. */
enum font_status edits_list_write(const struct font_edits *edits);
enum font_status edits_row_add(struct font_edits *edits, struct edits_row **out);

/* edits.c: whether both are the same glyph's at the same level, for the same axes; of gray of
 * one size, of filters for the same sizes. */
bool edits_row_same(const struct edits_row *a, const struct edits_row *b);

/* edits_read.c: the row's file, if it was edited. Errors: BAD_FILE, TOO_LARGE, NO_MEMORY. */
enum font_status edits_row_read(struct font_edits *edits, struct edits_row *row,
                                struct font_face *face);

/* outline_path.c: a path's words, through a map (xx, yx, xy, yy, x, y as in SVG's matrix()).
 * *why: what is wrong with it. */
enum font_status edits_path_draw(const char *d, const double map[6], struct font_outline *out,
                                 const char **why);
/* outline_xml.c: units: of the em. The advance is left as it is where the file has none.
 * Errors: BAD_FILE with the file's path, TOO_LARGE, NO_MEMORY. */
enum font_status edits_outline_read(const char *path, const char *bytes, size_t count,
                                    struct font_outline *out);

#endif
