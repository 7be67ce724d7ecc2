/* text.h - text as glyphs in places: HarfBuzz shapes it, FriBidi orders what runs to the left,
 * fontconfig finds fonts for what the first has not.
 *
 *     struct font_shaper *shaper;
 *     font_shaper_create(face, &shaper);
 *     struct font_layout layout;
 *     if (font_shaper_layout(shaper, "Paris", 5, 12.25, NULL, &layout) != FONT_OK)
 *         die(font_error());
 *     for (int i = 0; i < layout.glyphs_count; i++)
 *         draw(layout.glyphs[i].face, layout.glyphs[i].glyph, layout.glyphs[i].x_px, layout.glyphs[i].y_px);
 *     font_layout_finish(&layout);
 *     font_shaper_destroy(shaper);
 *
 * Text is UTF-8. What is not is replaced, each damaged sequence by U+FFFD, and counted. Lines
 * end at newlines (and what Unicode has beside them), and with `width_px` where no more fits:
 * at a place where a break is allowed (UAX 14), or, where a word is longer than the line,
 * between two letters. White space at the end of such a line stands in the margin; a soft
 * hyphen that ends it is seen. Places are fractions of pixels; nothing is rounded.
 *
 * Errors: functions that can fail return a status and leave one line in font_error(). Others
 * cannot fail.
 *
 * Ownership: faces are borrowed; what else is passed is copied. A layout's arrays are its own.
 *
 * Threads: a shaper and its faces belong to one thread at a time. */
#ifndef LUTETIA_FONT_TEXT_H
#define LUTETIA_FONT_TEXT_H

#include "face.h"
#include "ink.h"

struct font_map;
struct font_shaper;

/* face: borrowed, must outlive the shaper; the first choice for every character. Errors:
 * NO_MEMORY. Owns: the caller destroys *out. */
enum font_status font_shaper_create(struct font_face *face, struct font_shaper **out);
void font_shaper_destroy(struct font_shaper *shaper); /* NULL is fine */
/* Characters that no font has as outlines are looked for in fonts of colours, too: for whoever
 * draws by font_painter_layout(), gl_type_draw() or in files (drawing.h). */
void font_shaper_colour(struct font_shaper *shaper);

/* START: left, and where a paragraph runs to the left, right. JUSTIFY: white spaces are widened
 * until lines fill the column, but for a paragraph's last one. */
enum font_align {
    FONT_ALIGN_START,
    FONT_ALIGN_LEFT,
    FONT_ALIGN_RIGHT,
    FONT_ALIGN_CENTER,
    FONT_ALIGN_JUSTIFY
};
/* "left", "right", "center" or "justify". False: the word is none of them, and *out is as it
 * was. */
bool font_align_named(const char *word, enum font_align *out);

struct font_text_options {
    const char
        *features; /* HarfBuzz's, by commas: "-liga,ss01,kern=0"; NULL: the font's usual ones */
    const char *language; /* "fr"; NULL: the locale's */
    double letter_spacing_px;
    double line_height; /* of the size; 0: the fonts' own */
    /* of the column that lines are broken for; 0: only where the text has line ends */
    double width_px;
    enum font_align align; /* in the column, or within the longest line */
    bool no_fallback;      /* only the first face */
    /* 1 the paragraph runs to the left, -1 to the right, 0 as its first letter */
    int right_to_left;
};

struct font_placed {
    struct font_face *face; /* owned by the shaper or its creator */
    uint32_t glyph;
    double x_px,
        /* of the origin, from the column's left edge on the first baseline; y downwards */
        y_px;
    int cluster; /* byte of the text that it comes from */
    int line;
    bool is_mark;  /* it moves the pen by nothing: an accent on another letter */
    float size_px; /* of the em; 0: the layout's */
    int ink;       /* of the layout's inks, from 1; 0: whoever draws says */
    /* Of the layout's maps, from 1; 0: none. It takes pixels around the glyph's origin to
     * pixels around it, before the glyph is put in its place and the text's own map is
     * applied. */
    int map;
};

struct font_line {
    int glyphs_begin, glyphs_count;
    double x_px, y_px; /* where its baseline begins at the left */
    double width_px;
    bool to_left; /* the paragraph runs to the left */
    bool ends_paragraph;
};

enum { FONT_MISSING_MAX = 16 };

struct font_layout {
    struct font_placed *glyphs;
    struct font_line *lines;
    int glyphs_count, glyphs_capacity, lines_count, lines_capacity;
    double width_px;              /* of the longest line or the column */
    double ascent_px, descent_px; /* of the first face; descent: below the last baseline */
    /* From line to line, of the first face or as asked for. Where other faces' letters need
     * more, and nothing was asked for, lines are farther apart: lines[].y_px. */
    double line_height_px;
    double height_px; /* from the first baseline to the last */
    double size_px;
    int missing_count;                  /* characters for which there is no glyph anywhere */
    uint32_t missing[FONT_MISSING_MAX]; /* the first of them, each once */
    int damaged_count;                  /* sequences that were not UTF-8 */
    int fallback_count;                 /* characters set in another face */
    /* Owned by the layout, freed with it. */
    struct font_ink *inks;
    struct font_map *maps;
    int inks_count, inks_capacity, maps_count, maps_capacity;
};

/* The size that a glyph is set at. */
double font_placed_size(const struct font_layout *layout, const struct font_placed *glyph);
/* Where glyph i of a layout goes whose origin is at (x_px, y_px), through `map` (NULL: as it
 * is): *out takes pixels around the glyph's origin to the picture's around (*x, *y). Where
 * nothing is distorted *out has no translation. Errors: BAD_ARGUMENT (a distortion after
 * another, unless both are projective). */
enum font_status font_placed_map(const struct font_layout *layout, int i,
                                 const struct font_map *map, double x_px, double y_px,
                                 struct font_map *out, double *x, double *y);
/* A map or an ink of the layout's own: its number; 0: no memory. */
int font_layout_map_add(struct font_layout *layout, const struct font_map *map);
int font_layout_ink_add(struct font_layout *layout, const struct font_ink *ink);
/* Counts a character that no font has, and keeps it among the first. A character that is kept
 * already is not counted again. */
void font_layout_missing_add(struct font_layout *layout, uint32_t character);

/* Errors: BAD_ARGUMENT (a size that is not 0.1..FONT_SIDE_MAX, features that cannot be read, a
 * width below 0), TOO_LARGE past a million characters, NO_MEMORY; *out is then empty. options:
 * NULL for the usual. */
enum font_status font_shaper_layout(struct font_shaper *shaper, const char *text, size_t bytes,
                                    double size_px, const struct font_text_options *options,
                                    struct font_layout *out);
void font_layout_finish(struct font_layout *layout);

/* What a passage of the text is, for who reads a PDF aloud or makes other things of it.
 * ARTIFACT: nothing of the text's own, as a page's number. */
enum font_role {
    FONT_ROLE_PARAGRAPH,
    FONT_ROLE_HEADING,
    FONT_ROLE_ITEM,
    FONT_ROLE_QUOTE,
    FONT_ROLE_NOTE,
    FONT_ROLE_ARTIFACT
};
struct font_passage {
    size_t begin, end; /* bytes of the text */
    enum font_role role;
    int level;     /* of a heading, from 1 */
    int paragraph; /* passages of the same one, on other pages too, are one */
};

/* The next character of UTF-8; *text moves on. false: it was damaged, and U+FFFD is what stands
 * for it. text < end. */
bool font_utf8_next(const char **text, const char *end, uint32_t *character);
/* Writes a character, up to U+10FFFF, as UTF-8. Returns how many bytes. */
enum { FONT_UTF8_BYTES = 4 };
int font_utf8_put(uint32_t character, char to[FONT_UTF8_BYTES]);
/* How many sequences are not UTF-8; and the text with U+FFFD in place of each. Owns: the caller
 * frees *out. Errors: NO_MEMORY. */
int font_utf8_damaged(const char *text, size_t bytes);
enum font_status font_utf8_mend(const char *text, size_t bytes, char **out, size_t *out_bytes);

#endif
