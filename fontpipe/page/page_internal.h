/* page_internal.h - what the files of fontpipe/page share.
 *
 *     page_text -> flows -> paragraphs -> letters, shaped runs        set.c: once for each
 *                                                                     change of the text; a
 *                                                                     long one's, where it
 *                                                                     changed (renew.c)
 *                                      -> lines                       lines.c: once for each
 *                                                                     change of widths
 *               -> pages: which lines of which paragraphs, where      flow.c; pages.c: those
 *                                                                     that need it */
#ifndef LUTETIA_PAGE_INTERNAL_H
#define LUTETIA_PAGE_INTERNAL_H

#include "../internal.h"
#include "../text_internal.h"
#include "breaks.h"
#include "page.h"

#include <own.h>

enum { LETTERS_MAX = 1000000, FLOWS_MAX = 8, PAGES_MAX = 100000, TEMPLATES_MAX = 1000 };

/* One look of letters, and the shaper of its face. Faces are shared. */
struct style {
    struct page_style look;
    char *font, *axes, *features, *language, *filter; /* what look has */
    struct font_shaper *shaper;
    hb_feature_t hb_features[32];
    unsigned features_count;
    hb_language_t hb_language;
    double ascent_px, descent_px, leading_px;
    bool is_inset; /* its letters are shown as a box of this: inset.c */
    struct font_layout shown;
};

struct letter {
    uint32_t character;
    int32_t byte;
    int16_t style, face;
    int8_t level;
    bool cluster;  /* a cluster begins here */
    bool grapheme; /* a caret may stand before it */
    bool stands;   /* in a vertical line */
    bool across;   /* there it is one of a few digits beside each other in one place */
    bool safe;     /* glyphs before and behind it are as they would be apart */
    bool hyphen;   /* a word may be divided behind it */
    uint8_t brk;   /* libunibreak's, of the place behind it */
    hb_script_t script;
    float advance_px;            /* of the cluster, at its first letter */
    float stretch_px, shrink_px; /* of the space behind it */
};

struct shaped {
    uint32_t glyph;
    int32_t letter;               /* its cluster's first */
    float advance_px, x_px, y_px; /* along the line; of its origin from the pen */
};

struct set_run {
    int begin, end, glyphs_begin, glyphs_end;
    int16_t style, face;
    int8_t level;
    bool upright; /* in a vertical line, its letters stand */
    bool across;  /* all of them beside each other, in one place */
};

struct line {
    int begin, end;  /* letters; white space at its end is within */
    int ink_end;     /* and without it */
    double ratio;    /* by which its spaces are stretched or shrunk */
    double width_px; /* what it was broken for */
    bool hyphen, last;
};

/* kind: of a note; beside: what stands beside the paragraph is one of its notes,
 * at byte -1, before all of them. */
struct note {
    int byte;
    enum page_note kind;
    struct paragraph *paragraph;
    struct page_beside *beside; /* owned; NULL: a note */
};

struct mark {
    int id, byte;
    bool after;
};

struct span {
    int begin, style; /* from that byte to the next span's */
};

struct paragraph {
    int id, flow, at; /* its number in the flow; flow -1: a note */
    char *text;
    int bytes;
    int style; /* that it was given to begin with: its lines' height and middle are of that */
    struct span *spans;
    int spans_count, spans_capacity;
    struct page_manner manner;
    struct note *notes;
    int notes_count, notes_capacity;
    struct page_obstacle *obstacles; /* rows owned */
    int obstacles_count;
    int begins_frame; /* when it was placed last */
    double begins_v;
    struct mark *marks;
    int marks_count, marks_capacity;
    /* From here on made of the above. */
    bool analysed, vertical;
    /* All but its ends is another text than what stands here was made of: renew.c. So many
     * bytes at its beginning and at its end are the same; it had so many. */
    bool edited;
    int head, tail, bytes_before;
    bool counted; /* the numbers of letters of which renew.c asks are known */
    int letters_turning, letters_embedding, letters_thai;
    bool plain; /* as font_breaks_plain() has it */
    int count, base;
    int letters_capacity; /* of characters, too */
    struct letter *letters;
    uint32_t *characters;
    struct shaped *glyphs;
    int glyphs_count, glyphs_capacity;
    struct set_run *runs;
    int runs_count, runs_capacity;
    bool hyphenated;
    double leading_px, rise_px; /* rise: of a line's upper edge over its baseline */
    struct line *lines;
    int lines_count, lines_capacity;
    bool broken;
    double *widths; /* that lines were broken for */
    int widths_count, widths_capacity;
    /* Of a long one, how it was broken (lines_internal.h); known: what of its letters changed
     * since, begin -1: nothing. */
    struct ways *ways;
    bool change_known;
    struct break_change change;
    int overfull;
    uint32_t breakings; /* how often its lines have been made */
    int first_page;     /* that it was placed on when pages were last filled; -1: none */
    int owner;          /* of a note: the paragraph that it belongs to; -1 */
    bool beside;        /* such a note that stands beside it */
};

/* A piece of a line that text can stand in: the box of a line in a frame, or of what obstacles
 * leave of it. */
struct slot {
    double u0, u1, v; /* along the lines, across them: of its beginning, end and upper edge */
    int frame;
};

/* Lines begin..end of a paragraph on a page, each in a slot of its own. */
struct piece {
    struct paragraph *paragraph;
    int begin, end, slots_begin, frame;
    uint32_t lines_hash; /* of the lines as they were placed */
    uint32_t breakings;  /* of the paragraph, when that was last looked at */
};

struct cursor {
    int at;     /* of the flow's paragraphs */
    int line;   /* of it that comes next */
    int letter; /* that line's first */
};

struct page {
    struct cursor starts[FLOWS_MAX], ends[FLOWS_MAX];
    struct piece *pieces;
    struct slot *slots;
    int pieces_count, pieces_capacity, slots_count, slots_capacity;
    bool filled; /* its pieces and its ends are what its starts give */
    bool last;
    int template;    /* that its first paragraph asks for, from 1; 0: that of its number */
    double depth_px; /* and how deep its frames are at most; 0: as they are */
};

struct flow {
    struct paragraph **paragraphs;
    int count, capacity;
};

struct shared_face {
    char *name; /* and axes and filter */
    struct font_face *face;
    struct font_shaper *shaper;
};

/* A style's face, so many hundredths wider; NULL: it cannot be. */
struct wide_face {
    const struct font_face *of;
    int steps;
    struct font_face *face;
};

struct page_text {
    struct style **styles;
    int styles_count, styles_capacity;
    struct shared_face *faces; /* of styles, each once */
    int faces_count, faces_capacity;
    struct wide_face *widths;
    int widths_count, widths_capacity;
    bool colour;
    struct flow flows[FLOWS_MAX];
    struct paragraph **by_id;
    int ids_count, ids_capacity;
    int *marks_of; /* the paragraph's id of each mark; -1: gone */
    int marks_count, marks_capacity;
    struct page_template *templates;
    double **shape_points; /* owned: PAGE_SHAPES_MAX for each template */
    int templates_count;
    struct page_running running[PAGE_RUNNING_MAX]; /* texts owned */
    int running_count;
    struct page *pages;
    int pages_count, pages_capacity;
    int pages_good;    /* so many of them are as the text is now */
    int last_filled;   /* the page of them that was filled last; -1: none was */
    int besides_count; /* all that stands beside paragraphs, obstacles, too */
    struct page_stats stats;
    hb_buffer_t *buffer;
};

/* The style's filter as the face's own. */
static inline enum font_status style_filter_set(const struct page_style *look,
                                                struct font_face *face)
{
    return look->filter ? font_own_filter_set(face, FONT_EVERY_GLYPH, 0, 2.0 * FONT_SIDE_MAX,
                                              look->filter, false)
                        : FONT_OK;
}

/* story.c */
struct paragraph *story_paragraph(const struct page_text *t, int id); /* NULL: there is none */
/* A note, or what stands beside the paragraph, which takes `beside`, whatever becomes of it. */
enum font_status story_note_add(struct page_text *t, int id, const struct note *note,
                                const char *utf8, size_t bytes, int style,
                                const struct page_manner *manner, int *note_id);
/* templates.c */
bool templates_vertical(const struct page_text *t, int flow);
void templates_finish(struct page_text *t);

/* inset.c: puts what an inset shows, its origin at (x, y), of that byte, line and ink. False:
 * no memory. */
bool inset_put(const struct style *style, double x, double y, const struct font_placed *as,
               struct font_layout *out);

/* words.c: marks the letters behind which words may be divided; and breaks between words of
 * Thai, which are written together. */
void words_hyphenate(struct page_text *t, struct paragraph *p);
/* The same of words that have letters *begin..*end, where it was done: from where to where. */
void words_hyphenate_again(struct page_text *t, struct paragraph *p, int *begin, int *end);
void words_thai(struct paragraph *p);

/* renew.c: letters, levels, faces, and glyphs for all of the paragraph, if they are not there;
 * after an edit of a long one where that changed them. */
enum font_status set_analyse(struct page_text *t, struct paragraph *p);
/* Notes that bytes are about to be taken out. */
void renew_edited(struct paragraph *p, int byte, int removed);
/* set.c: all of it, whatever is there. */
enum font_status set_all(struct page_text *t, struct paragraph *p);
/* upright.c: which letters of a vertical paragraph stand, once their faces, scripts and places
 * for carets are known. */
void upright_find(struct page_text *t, struct paragraph *p);
/* What a script's letters do where nothing is known of them. */
bool upright_script(hb_script_t script);
/* Glyphs from..count of such a run, shaped from left to right, put beside each other in one
 * place of an em. */
void upright_across(struct shaped *glyphs, int count, hb_font_t *font, double scale,
                    double em_px, double centre_px);
/* carets.c: before which letters of begin..end a caret may stand. */
void carets_find(const struct page_text *t, struct paragraph *p, int begin, int end);
/* Whether a caret's place behind the character is no matter of what stands before it. */
bool carets_apart(uint32_t character);

void set_forget(struct paragraph *p); /* all that is made of the text */
/* The parts of the analysis, of letters begin..end: the letter at *at in the span *span; faces;
 * runs, appended; what a line can be stretched and shrunk by; clusters, of glyphs. */
struct letter set_letter(const struct page_text *t, const struct paragraph *p, const char **at,
                         int *span);
void set_faces(struct page_text *t, struct paragraph *p, int begin, int end);
bool set_runs_cut(const struct paragraph *p, int begin, int end, struct set_run **runs,
                  int *count, int *capacity);
void set_spaces(const struct page_text *t, struct paragraph *p, int begin, int end);
void set_clusters(struct paragraph *p, const struct shaped *glyphs, int count);
/* Leading, once the runs are known. */
void set_leading(const struct page_text *t, struct paragraph *p);
/* Which of glyphs from..to, of one run, are of letters begin..end. */
void set_glyphs_of(const struct shaped *glyphs, int from, int to, int begin, int end,
                   int *glyphs_begin, int *glyphs_end);

/* Glyphs of letters begin..end, which are of one run, as they are at a line's end. Appends to
 * *out. */
enum font_status set_shape(struct page_text *t, const struct paragraph *p,
                           const struct set_run *run, int begin, int end, struct shaped **out,
                           int *count, int *capacity);

/* lines.c: breaks the paragraph for lines of these widths, the last for all after it. */
enum font_status lines_break(struct page_text *t, struct paragraph *p, const double *widths,
                             int count);
/* The same of what follows the first `kept` of its lines, which stay: widths are of the lines
 * behind them. */
enum font_status lines_break_rest(struct page_text *t, struct paragraph *p, int kept,
                                  const double *widths, int count);

/* What is kept of how it was broken is forgotten, or has other letters begin..end where there
 * were letters begin..end_before. */
void lines_forget(struct paragraph *p);
size_t lines_bytes(const struct paragraph *p); /* that it takes */
void lines_changed(struct paragraph *p, int begin, int end_before, int end);

/* Where the pen is behind a tab that it comes to at `pen`, in a line that ends before the
 * letter `end`. */
double signs_tab(const struct page_text *t, const struct paragraph *p, int tab, int end,
                 double pen);

/* A glyph of a line that has been set: u along the line from its slot's beginning, v above the
 * baseline. */
struct set_glyph {
    uint32_t glyph;
    int32_t letter; /* -1: a hyphen that is not in the text */
    int run;
    float u, v, scale; /* scale: along the line */
};
/* A cluster of it, in the order in which it is seen. */
struct set_cluster {
    int begin, end; /* letters */
    float u0, u1;
    int8_t level;
};
struct set_line {
    struct set_glyph *glyphs;
    struct set_cluster *clusters;
    int glyphs_count, glyphs_capacity, clusters_count, clusters_capacity;
    double u0, u1; /* where its ink begins and ends */
    struct shaped *work;
    int work_count, work_capacity;
    struct set_run *runs;
    int runs_capacity;
    struct font_run *order;
    int order_capacity;
};
void set_line_finish(struct set_line *l);
/* line.c: sets a line of the paragraph in a slot so wide. */
enum font_status line_set(struct page_text *t, const struct paragraph *p,
                          const struct line *line, double width_px, struct set_line *out);
/* How far the letter may stand in the margin, of its own width. */
double signs_protrusion(uint32_t character, bool at_end);
/* The width of a hyphen in the style of a letter; *glyph: 0 if its face has none. */
double signs_hyphen(const struct page_text *t, const struct letter *l, uint32_t *glyph);

/* widths.c: the face for a glyph of the style's own face that is so much wider along the line:
 * one whose axis of widths is set so, if it has one. *scale: what is left to a map. */
struct font_face *widths_face(struct page_text *t, const struct style *style, uint32_t glyph,
                              float *scale);
void widths_finish(struct page_text *t);

/* What stands beside a frame's lines: covers.c. */
struct cover {
    double u, width;      /* along the lines */
    double v0, v1;        /* across them */
    double rows_v, row_v; /* where its rows begin, and how high each is */
    const struct page_row *rows;
    int rows_count;
    int side; /* a page_side; -1: an obstacle */
    double gap, least;
};
struct covers {
    struct cover *items;
    int count, capacity;
};
/* What of a line v..v + height a cover takes; false: nothing. */
bool cover_takes(const struct cover *c, double v, double height, double *a, double *b);
/* The lower edge of all; of one side. */
double covers_end(const struct covers *c);
double covers_side_end(const struct covers *c, enum page_side side);
/* From where on something so wide has room at a side of lines so long, and beside it at least
 * so much is left. */
double covers_room(const struct covers *c, enum page_side side, double v, double width,
                   double measure, double least);
/* Of what stands at v; height: with what its manner leaves blank. False: no memory. */
bool covers_beside_add(struct covers *c, const struct page_beside *beside,
                       const struct page_manner *manner, double measure, double v,
                       double height);
bool covers_obstacles_add(struct covers *c, const struct paragraph *p, double v);
void beside_free(struct page_beside *beside); /* NULL is fine */
void obstacles_free(struct paragraph *p);

/* slots.c: the next slot for a line so high in a frame from v on that ends above v_end. covers:
 * NULL: none. blank_px: what a line's paragraph leaves blank at its sides. False: there is no
 * more. */
bool slots_next(const struct page_template *t, int frame, const struct covers *covers,
                double blank_px, double *v, int *part, double v_end, double height_px,
                struct slot *out);
/* The frame's length along its lines, and across them. */
double frame_measure(const struct page_frame *f);
double frame_depth(const struct page_frame *f);

/* flow.c */
enum { FLOW_CHAIN_MAX = 4 }; /* paragraphs that one kept with the next looks at */
const struct page_template *flow_template(const struct page_text *t,
                                          int page); /* one that is filled */
/* Fills the page's frames from *ends on, which become those of the page. */
enum font_status flow_frames_fill(struct page_text *t, struct page *page, int number,
                                  struct cursor *ends);
/* Whether all of the flow's lines are of one width, whatever is placed. */
bool flow_uniform(const struct page_text *t, int flow, double *width);
/* flow_notes.c: of what is seen of lines begin..end. */
uint32_t flow_lines_hash(const struct paragraph *p, int begin, int end);

/* pages.c: pages up to this one are as the text is now. */
enum font_status flow_fill(struct page_text *t, int page);
void flow_changed(struct page_text *t, const struct paragraph *p); /* pages that looked at it */
/* A flow's paragraphs from number `at` on have other numbers. */
void flow_moved(struct page_text *t, int flow, int at);
void flow_changed_all(struct page_text *t);

/* layout.c: the line that a byte is in (before: where one ends and the next begins there, the
 * one that ends), its page, its slot. */
int layout_line(const struct paragraph *p, int byte, bool before);
enum font_status layout_find(struct page_text *t, struct page_place place, bool before,
                             int *page, int *line, struct slot *slot);

/* running.c: a page's running line as text, *text NULL where it has none there. Owns: the
 * caller frees it. False: no memory. */
bool running_text(const struct page_text *t, int page, const struct page_running *running,
                  char **text, size_t *bytes);
void running_finish(struct page_text *t);

/* A slot's place on the page: of a point u along and v across it. */
void slot_point(const struct page_template *t, const struct slot *s, double u, double v,
                double *x, double *y);

#endif
