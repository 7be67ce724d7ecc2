/* pdf_internal.h - what the files that write PDF share.
 *
 *     document  -> pages    pdf_page.c: letters in their places, in rows (pdf_run.c), inks (pdf_ink.c), what they say
 *                         (pdf_text.c)
 *               -> fonts    pdf_letters.c: which letter is which code; pdf_font.c: fonts as
 *                           objects pdf_program.c: HarfBuzz's subsets; pdf_cff.c: CFF made of
 *                           outlines
 *               -> tags     pdf_tags.c: headings, paragraphs, notes; the document's outline;
 *                           its title
 *
 * A letter is a glyph with the text that it shows: the same glyph may show other text
 * elsewhere, and then has another code. Objects are numbered when they are first spoken of, and
 * written in any order. */
#ifndef LUTETIA_FONT_PDF_INTERNAL_H
#define LUTETIA_FONT_PDF_INTERNAL_H

#include "document.h"
#include "drawing_internal.h"

enum { PDF_BUCKETS = 4096, PDF_CODES_MAX = 65000, PDF_PICTURES_MAX = 255 };

static const double pdf_point_px = 0.75; /* points in a pixel */

struct pdf_letter {
    struct font_face *face;
    uint32_t glyph;
    size_t said, bytes; /* its text, in the document's */
    int parts;          /* it has so much of the glyph's width; 0: none */
    double width;       /* its own, in ems */
    int font, code, next;
};

/* Of embedded fonts codes have two bytes; of those of pictures (Type 3, whose glyphs are blank)
 * one. Codes begin with 1. */
struct pdf_font {
    struct font_face *face;
    uint64_t version;
    bool pictures;
    int *letters; /* of the document's */
    int count, capacity, number;
};

/* Part of a page's text, of one element: a marked content. */
struct pdf_mark {
    int element, page, next; /* next: of the element's; -1 */
};

struct pdf_element {
    enum font_role role;
    int level, paragraph, number;
    int first, last; /* of its marks; -1 */
    size_t said, bytes;
    double top; /* of its first letter, in points from the page's foot */
};

struct pdf_page {
    int number, marks_begin, marks_count;
};

struct font_document {
    char *title, *language;
    struct pdf_letter *letters;
    int letters_count, letters_capacity;
    int heads[PDF_BUCKETS]; /* of chains of letters: plus 1 */
    struct pdf_font *fonts;
    int fonts_count, fonts_capacity;
    char *said; /* texts of letters and headings */
    int said_count, said_capacity;
    struct pdf_page *pages;
    int pages_count, pages_capacity;
    struct pdf_element *elements;
    int elements_count, elements_capacity;
    struct pdf_mark *marks;
    int marks_count, marks_capacity;
    FILE *f; /* into `whole` */
    char *whole;
    size_t whole_bytes;
    long *offsets; /* of objects; 0: not written yet */
    int objects, offsets_capacity;
    int list_number, fonts_number; /* of the objects: the list of pages, the fonts by name */
    bool tagged, failed, written;  /* failed: there was no memory */
};

/* pdf_object.c: the number of a new object; that object's beginning. */
int pdf_object(struct font_document *p);
void pdf_object_begin(struct font_document *p, int number);
/* A stream as an object, packed; `more`: of its dictionary. *number: 0 for a new one. */
void pdf_stream(struct font_document *p, int *number, const char *more, const void *bytes,
                size_t count);
/* Keeps a text; where it begins. */
size_t pdf_say(struct font_document *p, const char *text, size_t bytes);
enum font_status pdf_no_memory(void);
/* A text as PDF has it: <FEFF...>. */
void pdf_text_put(const char *text, size_t bytes, FILE *f);

/* pdf_letters.c: the number of such a letter, made if there is none yet; -1: no memory. Errors
 * are the document's. */
int pdf_letter_find(struct font_document *p, struct font_face *face, uint32_t glyph,
                    bool picture, const char *text, size_t bytes, int parts);

/* pdf_font.c: all fonts as objects. */
enum font_status pdf_fonts_put(struct font_document *p);

/* A font's program: the bytes to be embedded, and which of its glyphs each letter is. */
struct pdf_program {
    bool truetype; /* else CFF */
    uint8_t *bytes;
    size_t count;
    uint32_t *glyphs; /* of letters, by code; NULL: the codes themselves */
};
/* pdf_program.c: cut out by HarfBuzz. False: that cannot be done, or is not what we would
 * draw. */
bool pdf_program_subset(const struct font_document *p, const struct pdf_font *font,
                        struct pdf_program *out);
/* pdf_cff.c: frees what it has. */
void pdf_program_finish(struct pdf_program *program);
/* Made of the outlines, a glyph for each code. Owns: pdf_program_finish(). */
enum font_status pdf_program_draw(const struct font_document *p, const struct pdf_font *font,
                                  struct pdf_program *out);
/* Whether a CFF table's glyphs are told by other numbers than their places. True where it
 * cannot be read. */
bool pdf_cff_keyed(const uint8_t *bytes, size_t count);

/* pdf_tags.c: the element of a passage, and a mark of it on the page that is made; -1: no
 * memory. */
int pdf_mark_begin(struct font_document *p, const struct font_drawing *d,
                   const struct font_passage *passage, double top);
const char *pdf_tag(const struct pdf_element *e, char room[8]);
/* Of the document's dictionary. */
struct pdf_catalog {
    int tags, outline, metadata, info; /* objects; 0: none */
};
void pdf_tags_put(struct font_document *p, struct pdf_catalog *out);

/* Colours and cover, packed. */
struct pdf_picture {
    int width_px, height_px, number; /* number: of its object, once it is written */
    uint8_t *packed[2];
    size_t counts[2];
};

/* The text that is written: letters of one font under one map, in a row. */
struct pdf_run {
    bool open, within; /* within a row's letters */
    bool hidden;       /* they are not painted */
    int font;
    double m[6]; /* of an em, to points: where the row began */
    double pen;  /* behind the last letter, in ems */
};

/* A page that is made. */
struct pdf_making {
    struct font_document *p;
    const struct font_drawing *d;
    const struct font_layout *layout;
    const struct font_map *map;
    double x, y; /* of the layout's origin, in pixels */
    struct drawn drawn;
    int *order;       /* in which glyphs are written: as the text has them */
    bool *ends;       /* of glyphs: the last of a line, with another behind it */
    double *advances; /* of drawn.glyphs, in ems; NAN: not asked for yet */
    FILE *f;          /* what is on the page */
    int ink;          /* of the glyph before; -1 */
    struct pdf_run run;
    struct pdf_picture *pictures;
    int pictures_count, pictures_capacity;
    bool covers[256]; /* translucencies that are used */
    int passage;      /* that is open; -1: none; -2: what is no text */
};

/* PDF has no exponents: what would need one is nothing. */
static inline double pdf_plain(double number)
{
    return number > -1e-4 && number < 1e-4 ? 0 : number;
}

/* pdf_page.c */
enum font_status pdf_page_put(struct font_document *p, const struct font_drawing *d,
                              const struct font_layout *layout, const struct font_map *map,
                              double x, double y);

/* pdf_run.c: a letter, its glyph's em by m. */
void pdf_run_letter(struct pdf_making *m, int letter, const double em[6], bool hidden);
void pdf_run_end(struct pdf_making *m);

/* pdf_ink.c: a picture. Owns: pdf_picture_finish(). */
bool pdf_picture_pack(const struct font_tile *tile, struct pdf_picture *out);
void pdf_picture_finish(struct pdf_picture *picture);
void pdf_picture_put(struct font_document *p, struct pdf_picture *picture);
/* What letters are filled with from here on: glyph i's ink. */
void pdf_ink_use(struct pdf_making *m, int i);
/* numbers[i]: of the object that is ink i's pattern or mask, or 0. */
enum font_status pdf_inks_make(struct pdf_making *m, int *numbers);
/* In the page's resources. */
void pdf_inks_put(const struct pdf_making *m, const int *numbers);

/* pdf_beside.c: boxes and strokes in what is on the page; strokes as objects, their numbers. */
void pdf_boxes_show(struct pdf_making *m);
void pdf_strokes_show(struct pdf_making *m);
enum font_status pdf_strokes_make(const struct pdf_making *m, int *numbers);

/* pdf_text.c: the text in UTF-16, as hexadecimal digits. */
void pdf_utf16_put(const char *text, size_t begin, size_t end, FILE *file);
/* How many letters the cluster has, if they are several that go to the left; else 0. */
int pdf_leftward(const struct font_drawing *d, const struct drawn_text *text);
/* Whether what it shows goes to the left. */
bool pdf_is_leftward(const struct font_drawing *d, const struct drawn_text *text);
/* Whether the glyph shows joiners or marks of direction alone: it takes no place, whatever the
 * font says. */
bool pdf_is_unseen(const struct font_drawing *d, const struct drawn_text *text,
                   const struct font_placed *g);
/* In clusters that go to the left glyphs that stand on others show none of the letters, which
 * are shared by the others, and so are joiners behind them: programs put letters in the order
 * in which they stand, and take one that is higher for another line's. */
void pdf_marks_tell_nothing(const struct font_drawing *d, const struct font_layout *layout,
                            struct drawn *drawn);
/* What of them the glyph itself shows, cut off the text's end: *letters of them, 0 for nothing.
 * Glyphs stand from the left to the right, the cluster's last letters with its first glyph. */
void pdf_share(const struct font_drawing *d, const struct drawn_text *text, size_t *end,
               int *letters);
/* Whether something is written before a glyph, or behind it; and that: where its cluster is
 * told as a whole what it says. */
bool pdf_said_begins(const struct font_drawing *d, const struct drawn_text *text);
bool pdf_said_ends(const struct font_drawing *d, const struct drawn_text *text);
void pdf_said_begin(const struct font_drawing *d, const struct drawn_text *text, FILE *file);

#endif
