/* page.h - pages: paragraphs in many faces, sizes and inks, broken as wholes, flowing through
 * the boxes of a template, around shapes and inside them; notes at the foot and in the margin;
 * text that can be changed, and only what changes is set anew.
 *
 *     struct page_text *text;
 *     page_text_create(&text);
 *     struct page_style style = page_style_default();
 *     style.size_px = 14;
 *     int roman, id;
 *     page_style_add(text, &style, &roman);
 *     struct page_manner manner = page_manner_default();
 *     manner.align = FONT_ALIGN_JUSTIFY;
 *     page_paragraph_add(text, 0, -1, "In the beginning...", 19, roman, &manner, &id);
 *     struct page_template template = {.width_px = 600, .height_px = 800, .frames_count = 1,
 *                                      .frames = {{.x = 60, .y = 60, .width = 480, .height = 680}}};
 *     page_templates_set(text, &template, 1);
 *     struct font_layout layout;
 *     page_layout(text, 0, &layout);                   // the first page, for any painter
 *     ...
 *     // "In a beginning": that paragraph alone is set anew
 *     page_text_replace(text, id, 3, 3, "a", 1);
 *
 * Pages are set when they are asked for: a page needs those before it, as far as they have
 * changed since. Places in pages are pixels from the upper left, y downwards.
 *
 * Errors: functions that can fail return a status of fontpipe's and leave one line in
 * font_error(); what was there stays.
 *
 * Ownership: what is passed is copied, but for shapes' points. Threads: a text belongs to one
 * thread at a time. */
#ifndef LUTETIA_PAGE_H
#define LUTETIA_PAGE_H

#include "text.h"

struct page_text;
/* Without paragraphs, styles and templates. Errors: NO_MEMORY. Owns: the caller destroys
 * *out. */
enum font_status page_text_create(struct page_text **out);
void page_text_destroy(struct page_text *text); /* NULL is fine */
/* As font_shaper_colour(), of all faces of styles that are made from now on. */
void page_text_colour(struct page_text *text);

/* ---- how letters look ---- */

struct page_style {
    const char *font;     /* as font_face_open() has it */
    const char *axes;     /* "wght=700"; NULL: as the font is */
    const char *features; /* "-liga,ss01"; NULL: the font's usual ones */
    const char *language; /* "fr"; NULL: the locale's */
    double size_px;
    double raise_px;   /* above the baseline; negative: below */
    double spacing_px; /* added between letters */
    bool inked;        /* in `ink`; else whoever draws says */
    struct font_ink ink;
    /* of the style's own font, as font_filter_create_named() has it, where that has no other
     * (own.h); NULL: whoever draws says */
    const char *filter;
};
/* DejaVu Serif at 16 pixels, without ink. */
struct page_style page_style_default(void);
/* Texts are copied. Errors: BAD_FILE for a font that there is not, BAD_ARGUMENT. */
enum font_status page_style_add(struct page_text *text, const struct page_style *style,
                                int *out);

/* A style whose letters are not seen: letters in a row that have it are one box, in whose place
 * `shown` is: a formula, a sign. The box is as wide as shown->width_px, and stands on the
 * line's baseline; lines of a paragraph in which one is higher (ascent_px) or deeper
 * (descent_px) than its lines are farther apart. No line is broken within it, and a caret
 * stands before it or behind. look: of its font only the line's height counts. shown: one line;
 * copied, its faces must outlive the text. Errors: as page_style_add(); BAD_ARGUMENT for
 * numbers that are none. */
enum font_status page_inset_add(struct page_text *text, const struct page_style *look,
                                const struct font_layout *shown, int *out);

/* ---- paragraphs ---- */

enum page_tab_align { PAGE_TAB_LEFT, PAGE_TAB_RIGHT, PAGE_TAB_CENTER, PAGE_TAB_DECIMAL };
struct page_tab {
    double x_px; /* from the paragraph's left edge */
    enum page_tab_align align;
};
enum { PAGE_TABS_MAX = 16 };

struct page_manner {
    enum font_align align;
    /* from line to line; 0: the font's, at the size of the paragraph's first style */
    double leading_px;
    double indent_px;                              /* of the first line */
    double left_px, right_px, before_px, after_px; /* what is left blank around it */
    int right_to_left;                             /* as font_text_options has it */
    bool hyphenate;  /* by the dictionary of the style's language */
    double protrude; /* 0..1: how far small signs at a line's ends stand in the margin */
    /* 0..0.05: how much wider or narrower letters may be; by the font's axis of widths, where
     * it has one */
    double expand;
    /* the badness a line may have before words are hyphenated more freely; 200 */
    double tolerance;
    bool keep_together, keep_with_next, begins_column;
    bool below; /* it stands below what stands beside the paragraphs before it */
    /* from 1: in flow 0 it begins a page, which is by the template of that number; 0: no */
    int begins_page;
    /* that page's frames are no deeper; 0: they are as the template has them */
    double page_depth_px;
    bool balance; /* its lines are about as long as each other, for headings; not justified */
    enum font_role
        role;  /* what it is, for who reads a PDF; a note is one whatever stands here */
    int level; /* of a heading, from 1 */
    int orphans, widows; /* the fewest lines at the end and at the beginning of a column; 2 */
    struct page_tab
        tabs[PAGE_TABS_MAX]; /* a tab goes to the next; behind the last, every four ems */
    int tabs_count;
};
/* From where the direction of the text begins, without hyphens, two lines at least in a
 * column. */
struct page_manner page_manner_default(void);
/* Whether there are patterns by which words of the language are divided (NULL: English); else
 * `hyphenate` divides none. */
bool page_language_divides(const char *language);

/* A paragraph before the one that is number `at` of its flow (-1: as the last), all in one
 * style. *id names it ever after. Line ends in the text are kept within the paragraph. Errors:
 * BAD_ARGUMENT, TOO_LARGE past a million characters, NO_MEMORY. */
enum font_status page_paragraph_add(struct page_text *text, int flow, int at, const char *utf8,
                                    size_t bytes, int style, const struct page_manner *manner,
                                    int *id);
enum font_status page_paragraph_remove(struct page_text *text, int id);
enum font_status page_paragraph_manner(struct page_text *text, int id,
                                       const struct page_manner *manner);
/* Bytes begin..end of it in another style. Errors: BAD_ARGUMENT (no such paragraph, style or
 * range), NO_MEMORY. */
enum font_status page_paragraph_style(struct page_text *text, int id, int begin, int end,
                                      int style);
/* Takes `removed` bytes out at a byte and puts others there, in the style of the letter before.
 * Errors: BAD_ARGUMENT where that would cut a character in two. */
enum font_status page_text_replace(struct page_text *text, int id, int byte, int removed,
                                   const char *utf8, size_t bytes);
/* Its text, valid until the paragraph is changed; NULL: there is no such paragraph. */
const char *page_paragraph_text(const struct page_text *text, int id, size_t *bytes);
int page_paragraph_at(const struct page_text *text, int flow,
                      int at); /* its id; -1: there is none */

/* A note to a place, set where the page's template has room for such: at the foot of the column
 * that the place is in, or in its margin. Its paragraph has an id, and is changed as others
 * are; it goes with the letter before its place. Errors: BAD_ARGUMENT, TOO_LARGE, NO_MEMORY. */
enum page_note { PAGE_NOTE_FOOT, PAGE_NOTE_MARGIN };
enum font_status page_note_add(struct page_text *text, int id, int byte, enum page_note kind,
                               const char *utf8, size_t bytes, int style,
                               const struct page_manner *manner, int *note_id);

/* ---- beside paragraphs ---- */

enum page_side { PAGE_SIDE_LEFT, PAGE_SIDE_RIGHT };
/* What a row of a box covers, from its left edge; nothing where to is not behind from. */
struct page_row {
    double from_px, to_px;
};
enum { PAGE_ROWS_MAX = 512 };

/* A figure, or its caption: it stands at a side of the frame, from a paragraph's upper edge on,
 * and lines beside it are shorter. Several of one paragraph and side stand below each other.
 * Where it has no room above the frame's end, its paragraph begins the next frame. */
struct page_beside {
    enum page_side side; /* in a vertical frame, left is above */
    double width_px;
    double gap_px; /* between it and lines */
    /* the narrowest piece of line beside it that is used, without what the piece's paragraph
     * leaves blank at its sides */
    double least_px;
    /* what of it lines keep away from: rows of equal height, from above to below; none: all of
     * it, and what its own manner leaves blank above and below */
    const struct page_row *rows;
    int rows_count;
};
/* Its paragraph has an id, and is changed as others are; it goes with the paragraph that it
 * stands beside. rows are copied. Errors: BAD_ARGUMENT (no such paragraph, or one that is no
 * flow's; no box), TOO_LARGE, NO_MEMORY. */
enum font_status page_beside_add(struct page_text *text, int id,
                                 const struct page_beside *beside, const char *utf8,
                                 size_t bytes, int style, const struct page_manner *manner,
                                 int *beside_id);

/* A shape that others draw, and that lines keep away from: a box of rows, from the frame's left
 * edge and the paragraph's upper edge. It ends with the frame that its paragraph begins in. */
struct page_obstacle {
    double x_px, y_px, height_px;
    double gap_px, least_px; /* as page_beside has them */
    const struct page_row *rows;
    int rows_count;
};
/* Replaces those that the paragraph had. rows are copied. Errors: BAD_ARGUMENT, NO_MEMORY. */
enum font_status page_obstacles_set(struct page_text *text, int id,
                                    const struct page_obstacle *obstacles, int count);

/* Where a paragraph begins: its page, the left edge of its frame, and its upper edge, from
 * which obstacles are counted. In a vertical frame: the right edge of its first line, and the
 * frame's upper edge. Errors: as page_find(). */
enum font_status page_paragraph_begins(struct page_text *text, int id, int *page, double *x,
                                       double *y);

/* ---- marks ---- */

struct page_place {
    int paragraph, byte;
};
/* A place that stays at its letter when text around it is changed. after: it stays behind what
 * is put in exactly there. Errors: BAD_ARGUMENT, NO_MEMORY. */
enum font_status page_mark_add(struct page_text *text, struct page_place place, bool after,
                               int *mark);
/* False: it has gone with its paragraph. */
bool page_mark_get(const struct page_text *text, int mark, struct page_place *place);

/* ---- templates ---- */

struct page_box {
    double x, y, width, height;
};
enum { PAGE_FRAMES_MAX = 12, PAGE_SHAPES_MAX = 16 };

/* A box that a flow's text goes through, in the order of the list, then on the next page. */
struct page_frame {
    double x, y, width, height;
    int flow;
    bool vertical; /* lines go down, from the right to the left */
    /* Of the box for its margin notes: from where, and how wide; width 0: there is none. In a
     * vertical frame it lies above or under it: these are its y and its height. */
    double margin_x, margin_width;
    double foot_gap_px; /* between text and notes at its foot */
    /* paragraphs with lines so high, or twice that, begin at multiples of it, so that lines
     * beside each other are level; 0: none */
    double grid_px;
};

/* A polygon (x, y, ...). Obstacles: text goes around, at a distance; else text stays inside of
 * all that there are. */
struct page_shape {
    const double *points; /* borrowed until page_templates_set() is called again */
    int points_count;
    bool inside;
    double distance_px;
    double least_px; /* the narrowest piece of line that is used; 0: 3 lines' height */
};

struct page_template {
    double width_px, height_px;
    struct page_frame frames[PAGE_FRAMES_MAX];
    int frames_count;
    struct page_shape shapes[PAGE_SHAPES_MAX];
    int shapes_count;
};
/* The first page is by the first template, and so on; the last one is for all pages after it.
 * Errors: BAD_ARGUMENT. */
enum font_status page_templates_set(struct page_text *text,
                                    const struct page_template *templates, int count);

/* A line that each page has besides: its number, a running head. In `text` %p is the page's
 * number, %h the last heading of level 1 up to it, %% a percent sign. */
struct page_running {
    const char *text;
    int style;
    double x0, x1, y; /* from and to where, and its baseline */
    enum font_align align;
    bool not_opening; /* not on the first page, nor where such a heading stands first */
};
enum { PAGE_RUNNING_MAX = 4 };
/* Replaces those that there were. Errors: BAD_ARGUMENT, NO_MEMORY. */
enum font_status page_running_set(struct page_text *text, const struct page_running *running,
                                  int count);

/* ---- pages ---- */

/* All of a page: glyphs in its pixels, each with its size, ink and map; clusters are bytes of
 * the glyph's paragraph. Errors: NO_MEMORY, BAD_ARGUMENT for a page that there is not. Owns:
 * the caller finishes *out. */
enum font_status page_layout(struct page_text *text, int page, struct font_layout *out);
/* What a page says, line after line of its paragraphs, and what each passage of that is. */
struct page_said {
    char *utf8;
    size_t bytes;
    struct font_passage *passages;
    int passages_count;
};
/* The same with what the page says: clusters are then bytes of that. Errors: as page_layout().
 * Owns: the caller finishes *out and *said. */
enum font_status page_layout_said(struct page_text *text, int page, struct font_layout *out,
                                  struct page_said *said);
void page_said_finish(struct page_said *said);
/* How many pages all of the text needs: sets them. Errors: as page_layout(). */
enum font_status page_count(struct page_text *text, int *count);
/* The page on which a letter is. Errors: BAD_ARGUMENT for no place; as page_layout(). */
enum font_status page_find(struct page_text *text, struct page_place place, int *page);

struct page_stats {
    long paragraphs_analysed, paragraphs_broken, pages_filled; /* since it was created */
    size_t bytes;
    int lines_overfull; /* of all paragraphs that are set: what no rule could fit */
};
/* Since it was created. */
void page_stats_get(const struct page_text *text, struct page_stats *out);

/* ---- pointing ---- */

/* A caret's line: from the top of the line to its foot. */
struct page_caret {
    int page;
    double x0, y0, x1, y1;
};
/* The caret at a place. before: at the edge of the letter before it, else of the letter behind:
 * they differ at ends of lines and where the direction changes. A place inside a cluster or a
 * ligature is between its parts. Errors: BAD_ARGUMENT for no place. */
enum font_status page_caret_get(struct page_text *text, struct page_place place, bool before,
                                struct page_caret *out);
/* The place nearest to a point of a page: in the frame that is nearest, of the line at the
 * point's height or nearest to that. *before: as page_caret_get() has it. Errors: BAD_ARGUMENT
 * where the page has no text. */
enum font_status page_hit(struct page_text *text, int page, double x, double y,
                          struct page_place *place, bool *before);
/* The boxes of what lies between two places of one flow, on a page: those of each line, which
 * touch where the text does. *count: how many there are; at most boxes_max are written. Errors:
 * BAD_ARGUMENT for no place; as page_layout(). */
enum font_status page_select(struct page_text *text, struct page_place from,
                             struct page_place to, int page, struct page_box *boxes,
                             int boxes_max, int *count);
/* The next place that a caret can be at; forward: towards the text's end. False: it was the
 * last one of its paragraph. */
bool page_place_step(struct page_text *text, struct page_place *place, bool forward);

#endif
