/* read_desk.h - the reader's window: what its files share.
 *
 *     read_main.c      the program: its words, the application
 *     read_window.c    the window: header, search, what is told
 *     read_contents.c  the contents
 *     read_actions.c   actions, menu
 *     read_document.c  files, links, the way back
 *     read_search.c    what is found
 *     read_keys.c      keys of the page
 *     read_hand.c      pointer, wheel, touch: scrolling, selecting
 *     read_remarks.c   highlights, typed notes, undo
 *     read_list.c      their list
 *     read_layers.c    readers' layers: which are shown, which is written
 *     read_layers_kept.c  the same, from one time to the next
 *     read_pen.c       a pen's and a mouse's reports
 *     read_ink.c       ink
 *     read_spots.c     spots that are taken out of it
 *     read_chosen.c    strokes that are chosen: moved, scaled, grouped
 *     read_around.c    and those that text flows around
 *     read_chosen_hand.c  pointer and keys for them
 *     read_edit.c, read_edit_keys.c, read_edit_im.c, read_save.c  editing: read_edit.h
 *     read_watch.c     files that other programs change
 *     read_text.c      words
 *     read_page.c      the page: a widget that shows a reader_view
 *     read_changed.c   what follows when the page is other
 *     read_heard.c     the page's text for screen readers
 *     read_choices.c   and what keys act on
 *     read_stages.c    demonstrations in it
 *     read_stages_draw.c  how they are seen
 *     read_stages_hand.c  pointer and keys for them
 *     read_controls.c  their controls
 *     read_printed.c   what those of them that are programs print
 *     read_miniatures.c  all pages, small
 *     read_tiles.c     its pictures, painted by fontpipe and kept
 *     read_look.c      sizes, colours, how wide the text is
 *     read_grid.c      the template: its grid's lines, its file
 *     read_panel.c     its colours and sizes, at the page's side
 *     read_play.c      recorded input: events from a file
 *
 * All of this belongs to GTK's thread. */
#ifndef LUTETIA_READ_DESK_H
#define LUTETIA_READ_DESK_H

#include <desk_frame.h>
#include <desk_shared.h>
#include <desk_words.h>
#include <gtk/gtk.h>
#include <reader_colours.h>
#include <reader_files.h>
#include <reader_remarks.h>
#include <reader_template.h>
#include <reader_view.h>

struct read_options {
    GPtrArray *paths;  /* of the document's files; not changed once it is open */
    GPtrArray *manual; /* paths, where they are the manual's; else NULL */
    const char *font, *mono, *math, *language, *play, *template;
    double size_px;
    int width, height;
    int theme; /* -1: as the desktop; 0: light; 1: dark */
    bool ragged;
};

/* Bytes of the plain text. */
struct read_range {
    size_t begin, end;
};

/* A place that one can go back to. */
struct read_place {
    GPtrArray *paths; /* of the document */
    size_t byte;
};

/* What the first button does. */
enum read_tool {
    READ_TOOL_READ,
    READ_TOOL_PEN,
    READ_TOOL_ERASER,
    READ_TOOL_SPOTS,
    READ_TOOL_MOVE
};

struct read_tiles;
struct read_stages;
struct read_miniatures;
struct read_editing;
struct reader_edit_change;
struct read_play;

/* How strokes lie in the window: scaled from a point, and then moved. */
struct read_lay {
    double from_x, from_y, scale_x, scale_y, by_x, by_y;
};

/* What of chosen strokes the hand holds, while it is down. */
struct read_hold {
    enum { READ_HOLD_NOTHING, READ_HOLD_FRAME, READ_HOLD_BOX } what;
    int handle;
    double from_x, from_y, x, y;
    struct reader_box box;
    int at; /* the stroke that Tab has come to */
};

struct read_desk {
    struct read_options options;
    int status; /* the program's exit status */
    GtkApplication *application;
    GtkWidget *window, *page, *scrollbar, *contents, *contents_side, *search_bar, *search_entry,
        *search_told, *notice, *notice_text, *told;
    struct read_panel *panel; /* of colours and sizes */
    int contents_source;      /* whose headings are all in the contents; -1: none */
    /* the document */
    struct reader_document *document;
    struct reader_files files; /* of it, those that are included, too */
    struct reader_view *view;
    struct reader_pages_setup setup;
    const struct reader_colours *colours;
    bool dark;
    double size_px;
    struct reader_template template;
    bool grid_shown, grid_held; /* its lines are seen; one of them is dragged */
    int grid_edge;              /* the line that is chosen; -1: none */
    bool grid_moved;            /* since it is held */
    GArray *grid_past;          /* struct reader_template: what moved lines can be undone to */
    guint grid_done;            /* of them, those that are not undone */
    /* the page */
    struct read_tiles *tiles;
    struct read_stages *stages;
    struct read_miniatures *miniatures;
    struct read_editing *editing;
    GtkWidget *replace_box, *replace_entry;
    GArray *hits; /* struct read_range */
    int hit;      /* the current one; -1: none */
    struct read_range selected;
    size_t select_from;
    size_t focused; /* the link or sign that Tab has come to; G_MAXSIZE: none */
    bool moving;    /* the scrollbar is being set by the page */
    /* scrolling */
    double rest_px;  /* of a pixel */
    double glide_px; /* that the wheel still has to go */
    double speed_px_s;
    gint64 tick_us;
    guint tick;
    bool dragging;
    double drag_y, drag_s;
    double pointer_x, pointer_y;
    double pressure; /* of a pen over the page, 0..1; a mouse: 1 */
    /* the way back */
    GArray *way; /* struct read_place */
    guint way_at;
    /* what readers leave */
    struct reader_remarks *remarks;   /* NULL: none are kept */
    char *remarks_path;               /* of their file */
    GtkWidget *remarks_list, *typing; /* typing: the small window of a note */
    GtkWidget *layers;                /* that of layers, while it is open */
    GArray *deeds;                    /* struct read_deed */
    guint deeds_done, syncing;
    unsigned group; /* of deeds that are undone together; their number so far */
    bool grouping;
    enum read_tool tool;
    struct desk_pen *pen;
    bool hand_down, by_pen; /* a button of a mouse, or a pen's point */
    bool eraser;            /* the pen's other end is */
    unsigned ink_rgba;
    double ink_width; /* ems */
    GArray *stroke;   /* struct reader_ink_point, in the window's pixels */
    double stroke_s;
    GArray *spots;  /* where an eraser of spots has been, while the hand is down */
    bool drawn;     /* the hand is down */
    GArray *chosen; /* int: strokes */
    struct read_hold hold;
    bool laid; /* what is chosen is shown as it will be */
    struct read_lay lay;
    bool playing, playing_erased;
    double play_s, play_end_s;
    gint64 play_us;
    GPtrArray *watches; /* GFileMonitor */
    guint reloading;
    GPtrArray *heard;       /* labels */
    char *heard_chosen;     /* what keys act on, as it was said last */
    guint hearing, barring; /* sources of what is done soon */
    struct read_play *play;
    /* what files below the window's call of it */
    void (*document_shown)(struct read_desk *d);
    void (*acted)(struct read_desk *d);       /* other actions are possible */
    void (*choices_say)(struct read_desk *d); /* read_choices_say() */
    void (*listed)(struct read_desk *d);      /* what readers have left is other */
    void (*placed)(struct read_desk *d);      /* another place is read */
    void (*changed)(struct read_desk *d);     /* the page is other: read_page_changed() */
    bool (*step)(struct read_desk *d, bool forward); /* read_keys_step() */
    void (*resized)(struct read_desk *d, int width, int height);
    void (*say)(struct read_desk *d, const char *text);
    void (*edits_begin)(struct read_desk *d);        /* read_edit_document() */
    void (*edits_recover)(struct read_desk *d);      /* read_save_recover() */
    bool (*edits_needed)(const struct read_desk *d); /* read_save_needed() */
    void (*edited)(struct read_desk *d);             /* read_save_soon() */
    void (*titled)(struct read_desk *d);             /* the title may be other */
    void (*refilled)(struct read_desk *d);           /* headings may be other */
    void (*looked)(struct read_desk *d);             /* the page looks otherwise now */
};

/* read_look.c */
void read_look_set(struct read_desk *d); /* the setup, from the sizes and colours */
void read_look_size(struct read_desk *d, double size_px);
void read_look_column(struct read_desk *d, double column_em);
void read_look_theme(struct read_desk *d, bool dark);
void read_look_resized(struct read_desk *d, int width, int height);

void read_look_again(struct read_desk *d); /* the template is another */

/* read_grid.c */
/* A template that is built in, or of a file. False: it was said why not. */
bool read_grid_open(struct read_desk *d, const char *name_or_path);
bool read_grid_save(struct read_desk *d, const char *path);
void read_grid_choose(struct read_desk *d, bool opens); /* the file, by a dialog */
void read_grid_show(struct read_desk *d, bool show);
/* False: it is none of theirs. */
bool read_grid_press(struct read_desk *d, double x);
bool read_grid_move(struct read_desk *d, double x);
bool read_grid_release(struct read_desk *d);
bool read_grid_key(struct read_desk *d, guint key);
void read_grid_keep(struct read_desk *d); /* the template can be undone to what it is */
bool read_grid_can(const struct read_desk *d, bool redo);
void read_grid_undo(struct read_desk *d, bool redo);
void read_grid_draw(struct read_desk *d, GtkSnapshot *snapshot);
/* The line that keys move, in words; NULL: the grid is not seen. Owns: the caller frees it. */
char *read_grid_heard(const struct read_desk *d);

/* read_layers.c */
void read_layers_begin(struct read_desk *d); /* as they were, or the user's own is written */
void read_layers_show(struct read_desk *d, int layer, bool shown);
void read_layers_write(struct read_desk *d, const char *name); /* "": the first */
void read_layers_open(struct read_desk *d);                    /* a small window of them */

/* read_layers_kept.c: which are hidden and which is written, as it was the last time */
void read_layers_kept(struct read_desk *d);
void read_layers_keep(struct read_desk *d);

/* read_tiles.c */
struct read_tiles *read_tiles_create(void);
void read_tiles_destroy(struct read_tiles *tiles);
/* Draws the passages that are seen. marks: boxes, and the colour of each. */
struct read_mark {
    struct reader_box box;
    const double *rgb;
};
void read_tiles_draw(struct read_desk *d, GtkSnapshot *snapshot,
                     const struct reader_shown *shown, int count, const struct read_mark *marks,
                     int marks_count, int scale);
/* How many tiles were ever painted. */
long read_tiles_painted(const struct read_tiles *tiles);
void read_tiles_forget(struct read_tiles *tiles); /* colours have changed */

/* read_stages.c */
struct read_stages *read_stages_create(struct read_desk *d);
void read_stages_forget(struct read_desk *d); /* the document is another one */
/* Behind that, where it is the same document with other text: programs that were running, or
 * were not compiled, are compiled and run anew. Each is told by its place among programs. */
void read_stages_again(struct read_desk *d);
/* It is another one after an edit: those whose scripts are what they were go on. */
void read_stages_follow_document(struct read_desk *d, const struct reader_document *before);
void read_stages_edited(struct read_desk *d, int block); /* the same of one block, in place */
void read_stages_finish(struct read_desk *d);            /* with the page: all end */
void read_stages_destroy(struct read_stages *stages);
void read_stages_changed(struct read_desk *d); /* others may be seen, or elsewhere */
void read_stages_place(struct read_desk *d);   /* where their strips are */
void read_stages_draw(struct read_desk *d, GtkSnapshot *snapshot);
/* False: it is none of theirs. */
bool read_stages_press(struct read_desk *d, double x, double y);
bool read_stages_move(struct read_desk *d, double x, double y);
bool read_stages_release(struct read_desk *d, double x, double y);
bool read_stages_holds(const struct read_desk *d); /* what is dragged is its */
bool read_stages_key(struct read_desk *d, guint key);
/* The focus goes to the controls of the one that Tab has come to; false: there are none. */
bool read_stages_enter(struct read_desk *d, size_t byte);
void read_stages_key_up(struct read_desk *d, guint key);
bool read_stages_types(const struct read_desk *d);     /* keys are a control's */
bool read_stages_is(const struct reader_block *block); /* one of them */
/* As its button does, where Tab has come to one, and keys are its own. */
bool read_stages_follow(struct read_desk *d, size_t byte);
/* For recorded input: the button of the one that is seen as that number, from 1; whether it
 * runs, and so many pictures have not come yet; what there is, as lines that g_free() frees. */
bool read_stages_button(struct read_desk *d, int number);
bool read_stages_waits(struct read_desk *d, int number, long pictures);
/* Its control of that number, from 1, is given a value as if by a hand. */
bool read_stages_set(struct read_desk *d, int number, int control, double value);
char *read_stages_told(struct read_desk *d);

/* read_controls.c */
struct read_controls;
struct demonstration;
/* A box of them, which is below the strip as long as that is there. called: which demonstration
 * they are of. */
struct read_controls *read_controls_create(GtkWidget *strip, const char *called);
void read_controls_destroy(struct read_controls *controls); /* the strip is gone */
/* Those that a demonstration has declared, in place of the ones that there are. NULL: it has
 * ended, and nothing can be set. */
void read_controls_fill(struct read_controls *controls, struct demonstration *run);
/* How high they are in a column of that width; 0: there are none. */
int read_controls_height(struct read_controls *controls, int width);
bool read_controls_enter(struct read_controls *controls); /* the first has the focus */
bool read_controls_has(const struct read_controls *controls, const GtkWidget *focus);
bool read_controls_type(struct read_controls *controls, int number, double value);
void read_controls_tell(const struct read_controls *controls, GString *to);

/* read_miniatures.c */
GtkWidget *read_miniatures_new(struct read_desk *d, GtkWidget *page); /* both, one is seen */
void read_miniatures_finish(struct read_desk *d);                     /* with the window */
void read_miniatures_destroy(struct read_desk *d);
void read_miniatures_toggle(struct read_desk *d);
void read_miniatures_close(struct read_desk *d);
void read_miniatures_changed(struct read_desk *d);        /* other things are marked */
bool read_miniatures_key(struct read_desk *d, guint key); /* false: it is none of theirs */
char *read_miniatures_told(const struct read_desk *d);    /* a line; g_free() it */

/* read_changed.c */
void read_page_changed(struct read_desk *d); /* to be drawn anew */

/* read_page.c */
GtkWidget *read_page_new(struct read_desk *d);

/* read_choices.c */
void read_choices_say(struct read_desk *d);

/* read_heard.c */
void read_heard_changed(struct read_desk *d); /* soon */
void read_heard_place(struct read_desk *d);   /* where the labels are */
void read_heard_finish(struct read_desk *d);

/* read_hand.c */
void read_hand_attach(struct read_desk *d);
void read_hand_scroll(struct read_desk *d, double px); /* at once */
void read_hand_glide(struct read_desk *d, double px);
void read_hand_press(struct read_desk *d, double x, double y, int times);
void read_hand_move(struct read_desk *d, double x, double y);
void read_hand_release(struct read_desk *d, double x, double y);

/* read_keys.c */
bool read_keys_key(struct read_desk *d, guint key, GdkModifierType state);
/* Tab, or with Shift, from the place that it has come to. */
bool read_keys_step(struct read_desk *d, bool forward);

/* read_search.c */
void read_search_text(struct read_desk *d, const char *text);
void read_search_step(struct read_desk *d, bool forward);
void read_search_open(struct read_desk *d, bool open);

/* read_document.c */
/* The files as one document, in place of the one that there is. False: it was said why not, and
 * all is as it was. */
bool read_document_open(struct read_desk *d);
/* Follows the link, or opens the note, that a byte is of. False: there is neither. */
bool read_document_follow(struct read_desk *d, size_t byte);
void read_document_go(struct read_desk *d, size_t byte); /* kept on the way */
bool read_document_is_manual(const struct read_desk *d);
void read_document_back(struct read_desk *d, bool forward);
bool read_document_can(const struct read_desk *d, bool forward);
void read_document_finish(struct read_desk *d);
/* Its files anew, as another program has left them: the line that is being read stays, and so
 * do notes. */
void read_document_reload(struct read_desk *d);

/* What an edit has made of the document is shown. */
void read_document_edited(struct read_desk *d, const struct reader_edit_change *change);

/* read_edit.c */
struct read_editing *read_edit_create(void);
void read_edit_destroy(struct read_editing *editing);
void read_edit_document(struct read_desk *d); /* the document is another one */
bool read_edit_on(const struct read_desk *d);
void read_edit_toggle(struct read_desk *d);
void read_edit_select(struct read_desk *d, struct read_range range); /* where it is on */
void read_edit_type(struct read_desk *d, const char *text);
void read_edit_undo(struct read_desk *d, bool redo);
bool read_edit_can(const struct read_desk *d, bool redo);
void read_edit_cut(struct read_desk *d);
void read_edit_paste(struct read_desk *d);
/* As lines that g_free() frees. */
char *read_edit_told(struct read_desk *d);
/* The hit, or all. */
void read_edit_replace(struct read_desk *d, const char *text, bool all);

/* read_edit_keys.c: false: it is none of theirs. */
bool read_edit_key(struct read_desk *d, guint key, GdkModifierType state);
bool read_edit_press(struct read_desk *d, double x, double y, int times, bool select);
bool read_edit_drag(struct read_desk *d, double x, double y);

/* read_edit_im.c */
void read_edit_keys_are(struct read_desk *d, GtkEventController *keys); /* of the page */
void read_edit_draw(struct read_desk *d, GtkSnapshot *snapshot);
void read_edit_preedit(struct read_desk *d, const char *text); /* as an input method has it */

/* read_save.c */
bool read_save(struct read_desk *d); /* false: it was said why not */
bool read_save_needed(const struct read_desk *d);
void read_save_soon(struct read_desk *d);    /* there was an edit */
void read_save_foreign(struct read_desk *d); /* a file may have been changed */
void read_save_recover(struct read_desk *d); /* what a program that was killed has left */
void read_save_discard(struct read_desk *d);
bool read_save_closes(struct read_desk *d); /* false: it is asked first */
bool read_save_answer(struct read_desk *d, int answer);

/* read_text.c */
/* The text of bytes; g_free() it. */
char *read_text_of(const struct read_desk *d, struct read_range range);
struct read_range read_text_word(const struct read_desk *d, size_t byte);
/* From where a stroke's points are counted; false: it is not seen. */
bool read_text_origin(struct read_desk *d, const struct reader_remark *r, double *x, double *y);
/* The view is told around which ink text flows: after remarks or the document have changed. */
void read_text_around(struct read_desk *d);

/* read_remarks.c */
void read_remarks_open(struct read_desk *d, const char *file);
void read_remarks_find(struct read_desk *d); /* in another text */
void read_remarks_close(struct read_desk *d);
void read_remarks_finish(struct read_desk *d);
/* Each is a deed that can be undone. The new one's number; -1: it was said why there is
 * none. */
int read_remarks_add(struct read_desk *d, const struct reader_remark *what, size_t begin,
                     size_t end);
void read_remarks_erase(struct read_desk *d, int index);
/* So many strokes at once, as one deed. */
void read_remarks_arrange(struct read_desk *d, const struct reader_arranged *to, int count);
/* Deeds from one to the other are undone together. */
void read_remarks_group(struct read_desk *d, bool begins);
void read_remarks_undo(struct read_desk *d, bool redo);
bool read_remarks_can(const struct read_desk *d, bool redo);
int read_remarks_at(const struct read_desk *d, size_t byte);
void read_remarks_highlight(
    struct read_desk *d); /* what is selected, or the line that is read */
void read_remarks_type(struct read_desk *d);
void read_remarks_typed(struct read_desk *d, const char *text); /* without its small window */
void read_remarks_edit(struct read_desk *d, int index);

/* read_panel.c */
GtkWidget *read_panel_new(struct read_desk *d);
void read_panel_toggle(struct read_desk *d);
void read_panel_follow(struct read_desk *d);        /* the template or the theme is another */
bool read_panel_focused(const struct read_desk *d); /* keys go to it */
/* As a hand: "ink #204060", "note 0.9". False: there is no such colour, or size. */
bool read_panel_set(struct read_desk *d, const char *words);

/* read_contents.c */
GtkWidget *read_contents_new(struct read_desk *d);
void read_contents_fill(struct read_desk *d);   /* the document is another one */
void read_contents_toggle(struct read_desk *d); /* they are seen, or not */
void read_contents_follow(struct read_desk *d); /* the place that is read is chosen in them */

/* read_list.c */
GtkWidget *read_list_new(struct read_desk *d);
void read_list_fill(struct read_desk *d);

/* read_ink.c */
void read_ink_draw(struct read_desk *d, GtkSnapshot *snapshot);
/* more: with Shift, what is pressed is chosen besides. */
void read_ink_press(struct read_desk *d, double x, double y, double pressure, double time_s,
                    bool more);
void read_ink_move(struct read_desk *d, double x, double y, double pressure, double time_s);
void read_ink_release(struct read_desk *d, double x, double y);
void read_ink_play(struct read_desk *d, bool erased); /* or ends it */

/* read_pen.c */
void read_pen_attach(struct read_desk *d);
#define READ_MOUSE_PRESSURE 0.5 /* of ink */

/* read_chosen.c */
/* Whether it can be: ink that is seen, in the layer that is written. */
bool read_chosen_can(const struct read_desk *d, int index);
bool read_chosen_is(const struct read_desk *d, int index);
int read_chosen_count(struct read_desk *d); /* those that can still be */
/* What is chosen, in words; NULL: nothing is being chosen. Owns: the caller frees it. */
char *read_chosen_heard(struct read_desk *d);
void read_chosen_none(struct read_desk *d);
/* A stroke with its group, alone or with those that are; or all; or no longer. */
void read_chosen_take(struct read_desk *d, int index, bool more);
void read_chosen_leave(struct read_desk *d, int index);
void read_chosen_all(struct read_desk *d);
/* The newest stroke that can be chosen within reach of a point; -1: none is. */
int read_chosen_at(struct read_desk *d, double x, double y, double reach);
/* The box of those that are in the window; false: none is. */
bool read_chosen_box(struct read_desk *d, struct reader_box *box);
/* The box of one; false: it is not in the window. */
bool read_chosen_box_of(struct read_desk *d, int index, struct reader_box *box);
void read_chosen_lay(struct read_desk *d, const struct read_lay *lay);
/* While the hand is down they are shown so; NULL: as they are. */
void read_chosen_preview(struct read_desk *d, const struct read_lay *lay);
void read_chosen_previewed(struct read_desk *d, int index, struct reader_remark *r);
void read_chosen_group(struct read_desk *d, bool together);
void read_chosen_erase(struct read_desk *d);

/* read_around.c: text flows around what is chosen, or no longer. */
void read_around_toggle(struct read_desk *d);
/* read_chosen_lay(); what text flows around may be beside another paragraph then. */
void read_around_lay(struct read_desk *d, const struct read_lay *lay);

/* read_chosen_hand.c */
void read_chosen_press(struct read_desk *d, double x, double y, bool more);
void read_chosen_drag(struct read_desk *d, double x, double y);
void read_chosen_release(struct read_desk *d);
bool read_chosen_key(struct read_desk *d, guint key, bool shift);
void read_chosen_draw(struct read_desk *d, cairo_t *cairo);

/* read_spots.c */
void read_spots_add(struct read_desk *d, double x, double y);
bool read_spots_at(const struct read_desk *d, double x, double y); /* what is there goes */
void read_spots_end(struct read_desk *d);                          /* the hand is up */

/* read_watch.c */
void read_watch_begin(struct read_desk *d, void (*changed)(struct read_desk *d));
void read_watch_end(struct read_desk *d);

/* read_actions.c */
GMenuModel *read_menu_new(void);
void read_actions_add(struct read_desk *d);
void read_actions_enable(struct read_desk *d);

/* read_window.c */
void read_window_open(struct read_desk *d);

/* read_play.c */
/* NULL: it cannot be read; a line has been said. */
struct read_play *read_play_open(struct read_desk *d, const char *path);
void read_play_begin(struct read_play *play);
void read_play_destroy(struct read_play *play);

#endif
