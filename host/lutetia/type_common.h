/* type_common.h - shared by `lutetia type` and `lutetia font`. */
#ifndef LUTETIA_TYPE_COMMON_H
#define LUTETIA_TYPE_COMMON_H

#include <display.h>
#include <drawing.h>
#include <paint.h>

#include <stdbool.h>

/* Prints font_error() and returns EXIT_FAILED. */
int fail_font(const char *verb);

/* Makes a white picture. EXIT_SUCCESS, or prints why not. */
int type_image_create(const char *verb, double width, double height,
                      struct display_image *image);
struct font_picture type_picture(const struct display_image *image);
/* What a file's name says that it is to be: a PNG without an ending, too. */
enum type_out { TYPE_OUT_NONE, TYPE_OUT_PNG, TYPE_OUT_SVG, TYPE_OUT_PDF };
enum type_out type_out_of(const char *path);
/* A layout as SVG or PDF, by the name. */
int type_drawing_write(const char *verb, const char *path, const struct font_drawing *drawing,
                       const struct font_layout *layout, const struct font_map *map,
                       double x_px, double y_px);
/* Says which characters no font has, if there are any. */
void type_missing_tell(const char *verb, const char *font, const struct font_layout *layout);
/* Says in how many places a text was not UTF-8, if it was not. */
void type_damaged_tell(const char *verb, int damaged);
/* Says which glyphs were left out of what has been drawn so far, if any were. */
void type_left_out_tell(const char *verb);
/* The same of a text that is not laid out here. */
void type_text_check(const char *verb, const char *font, struct font_face *face,
                     const char *text);
int type_image_write(const char *verb, const char *path, const struct display_image *image);

/* Says that a font has changed since its edits were made, if one has that was opened by its
 * folder. */
void type_edits_tell(const char *verb);
/* The row of --edits in a verb's options, beside that of --font. */
#define TYPE_EDITS_OPTION(folder)                                                              \
    {                                                                                          \
        "edits", 0, OPTION_TEXT, "DIR",                                                        \
            "draw with the edits of the font in this folder; without --font its own font is "  \
            "taken",                                                                           \
            folder, 0, 0, 0                                                                    \
    }
/* The name of the font to be opened: `given` (NULL: none) with the edits of a folder (NULL:
 * none); without both the usual one. The caller frees *out, which is NULL on failure. */
int type_font_name(const char *verb, const char *given, const char *edits, const char *usual,
                   char **out);

/* Opens a font, or a folder of edits of one, and sets axes, "wght=700,wdth=80". coloured: also
 * one that has nothing but pictures in colours. */
int type_face_open(const char *verb, const char *name, int index, const char *axes,
                   bool coloured, struct font_face **out);

/* Gets a filter's name; for one that begins with @, the words of that file, separated by
 * commas. The caller frees *out. */
int type_filter_read(const char *verb, const char *name, char **out);

/* lcd, crt or print. EXIT_SUCCESS, or prints what there is. */
int type_display_read(const char *verb, const char *word, enum font_display *out);
/* The filter of these that fits best, but one (-1: none); -1: there is no other. Prints it for
 * lines of this width, with why, and the next. */
int type_fits_best(const struct font_filter_fit *fits, int count, int but);
void type_fits_print(const char *const *names, const struct font_filter_fit *fits, int count,
                     double detail_px);
/* The named filter that suits lines of this width on a display; prints why. NULL, and why not,
 * on failure. */
const char *type_filter_choose(const char *verb, double detail_px, enum font_display display);

/* Labels: a line of small black type with the left end of its baseline at (x, y). Nothing is
 * drawn if there is no font. */
struct type_labels;
struct type_labels *type_labels_create(double size_px);
void type_labels_destroy(struct type_labels *labels);
void type_label(struct type_labels *labels, struct display_image *image, double x, double y,
                const char *format, ...) __attribute__((format(printf, 5, 6)));

/* type_compare.c: pictures of the text in gray by us, by the definition and by FreeType,
 * enlarged, and of their differences. */
int type_compare(const char *verb, const char *path, const struct font_layout *layout,
                 const struct font_map *map, const char *filter, double x_px, double y_px,
                 int zoom);

/* type_gl.c: draws the text by OpenGL, as on a display, over the white picture. */
int type_gl(const char *verb, const struct font_layout *layout, const struct font_map *map,
            const char *filter, double darken_px, double x_px, double y_px, const double ink[3],
            struct display_image *image);

/* Whether a variable font has that axis, like wght. */
bool type_axis_there(const struct font_face *face, const char *tag);

#endif
