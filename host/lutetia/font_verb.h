/* font_verb.h - what the files of `lutetia font` share. */
#ifndef LUTETIA_FONT_VERB_H
#define LUTETIA_FONT_VERB_H

#include <display.h>
#include <edits.h>

#include <stdbool.h>

struct font_verb {
    const char *file, *axes, *filter, *glyph, *text, *out_path, *master_in, *master_out;
    const char *waterfall, *against; /* an axis; another version of the font */
    const char *proof, *display;     /* a word in all filters, for a display */
    const char *edits, *write;       /* a folder, and the level that is written there */
    double size_px, sizes[2];        /* sizes: of a filter that is written */
    double typeface_px;              /* of all glyphs; 0: not asked for */
    int face, em_px, merge;
    bool show_filter;
};

/* font_drawn.c: a box of one colour; a line of some width through points, as type is drawn, as
 * the outlines of its pieces; gray pixels enlarged. */
void font_box_fill(struct display_image *image, double x0, double y0, double x1, double y1,
                   const uint8_t rgb[3]);
enum font_status font_stroke_draw(struct display_image *image, const struct font_point *p,
                                  int count, double width, const double ink[3]);
void font_gray_show(struct display_image *image, const struct font_gray *gray, double x,
                    double y, int zoom);

/* font_glyph.c: the glyph v->glyph at each level, with its edits (NULL: none), of a face
 * without them. */
int font_levels_show(const struct font_verb *v, struct font_face *face,
                     const struct font_edits *edits);
/* font_proof.c: the word v->proof by every filter at several sizes. */
int font_proof_show(const struct font_verb *v, struct font_face *face);
/* font_list.c: prints axes, named places on them, scripts and features. */
void font_list_print(struct font_face *face);
/* font_waterfall.c: a line at places along the axis v->waterfall. */
int font_waterfall_show(const struct font_verb *v, struct font_face *face);
/* font_against.c: the face and the one of v->against, and what is different. */
int font_against_show(const struct font_verb *v, struct font_face *face);
/* font_typeface.c: all glyphs of v->typeface_px, and a table of where each is. */
int font_typeface_show(const struct font_verb *v, struct font_face *face);
/* Writes the level v->write of a glyph, of a filter also of every one, to the folder v->edits,
 * and notes it there. */
int font_level_write(const struct font_verb *v, struct font_face *face, uint32_t glyph,
                     const struct font_edits *edits, struct font_levels *levels);

#endif
