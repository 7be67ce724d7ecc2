/* desk.h - the studio's window: what its files share.
 *
 *     desk_main.c      the program: its words, the application
 *     desk_window.c    the window, and what the paper reports
 *     desk_common.c    what the others use
 *     desk_canvas.c    the sheet: how it is seen, the cursor, the ghost
 *     desk_area.h      a canvas that is drawn by OpenGL, in part where processors compute that
 *     desk_gl.c        its drawing in OpenGL, core profile
 *     desk_hand.c      pointer and pen, as events (input.h), to the paper
 *     desk_shared.h    what the reader's window has, too: a pen's pressure on X11, names
 *     desk_shape.c     lines, ellipses, steadying
 *     desk_rows.c      a control as a row
 *     desk_panel.c     tools, controls
 *     desk_dish.c      the dish: wells, swatches; the tilted board
 *     desk_actions.c   actions, menus, keys
 *     desk_files.c     new, open, save, pictures
 *     desk_unsaved.c   sheets that were never saved
 *     desk_type.c      type on the sheet
 *     desk_stamp.c     pictures that are put on the sheet
 *     desk_past.c      time under the hand
 *     desk_beside.c    a moment beside the sheet
 *     desk_play.c      recorded input: events and actions from a file
 *     desk_measure.c   how long the window takes
 *
 * The window never calls what belongs to the paper's thread (studio_paper.h). All of this
 * belongs to GTK's thread. */
#ifndef LUTETIA_DESK_H
#define LUTETIA_DESK_H

#include "desk_area.h"
#include "desk_frame.h"
#include "desk_shared.h"
#include "desk_words.h"
#include "studio_palette.h"
#include "studio_paper.h"
#include "studio_selection.h"
#include "studio_view.h"

#include <gtk/gtk.h>
#include <input.h>

#define DESK_FILM_S 60.0 /* how long a film is at the most */

/* What the hand has done and the paper has not shown yet. */
struct desk_ghost {
    unsigned long number; /* of its message */
    double x, y, radius;  /* fibers */
    double rgb[3];        /* of its paint, display values */
    bool begins;
};

struct desk_options {
    const char *path, *play;
    struct paper_sheet_config config;
    bool fresh; /* a new sheet, though one was not saved */
    int theme;  /* -1: as the desktop; 0: light; 1: dark */
};

struct desk_gl;
struct desk_play;
struct desk_measure;
struct desk_beside;
struct desk_springs;

struct desk {
    struct desk_options options;
    int status; /* the program's exit status */
    GtkApplication *application;
    GtkWidget *window, *canvas, *notice, *notice_text, *state, *memory, *place;
    GtkWidget *tools[STUDIO_TOOLS], *rows[STUDIO_SETTINGS], *tool_box, *dish_box, *tool_title,
        *tool_hint;
    GtkWidget *title, *pause, *wells[STUDIO_WELLS], *swatch, *board;
    struct studio_paper *paper;
    struct studio_report report;
    struct studio_settings settings;
    bool filling; /* widgets are being set from the settings, and not by a hand */
    double well_amount[STUDIO_WELLS][1 + PAPER_PIGMENTS_MAX];
    int well;
    /* the canvas */
    struct desk_gl *gl;
    struct studio_view view;
    bool viewed; /* the view has been fitted to the sheet */
    struct studio_picture seen;
    GArray *ghost; /* struct desk_ghost */
    double pointer_x, pointer_y;
    bool pointer_inside;
    double pressure; /* the pen's, or what the mouse would press with */
    /* the hand */
    struct desk_pen *pen;
    bool down, panning, space;
    bool by_pen;        /* a pen has come down, and until it is lifted a mouse does nothing */
    bool eraser;        /* the pen is held the other way round */
    unsigned modifiers; /* of input.h, when the hand came down */
    bool shaping;       /* a line or an ellipse, which is sent when it ends */
    double steady_x, steady_y, steady_s;
    bool pen_presses; /* a pen has told a pressure; one that never does presses as a mouse */
    double last_x, last_y, last_s, speed;
    double down_x, down_y; /* fibers */
    /* type */
    GtkIMContext *input_method;
    GString *typed;
    char *preedit;
    bool typing;
    double type_x, type_y;
    char *font, *features;
    struct desk_springs *springs;   /* NULL: what is typed lies still */
    struct studio_outlined outline; /* of what is selected */
    /* stamps */
    GtkWidget *stamp_box, *stamp_name;
    char *stamp;     /* the picture's file; NULL: none yet */
    bool stamp_seen; /* its stencil is under the pointer */
    bool stamp_due;  /* another one will be, when the last one has been made */
    unsigned long stamp_sent;
    /* the past */
    GtkWidget *past_box, *past_strip, *past_scale, *flow, *flow_bar;
    struct studio_past past;
    unsigned long past_seen;
    int past_sent, past_shown, past_shown_of; /* moments that were sent; that are shown */
    struct desk_beside *beside;
    struct desk_play *play;
    struct desk_measure *measure;    /* NULL: nothing is measured */
    bool closed;                     /* the window was, by its person */
    bool asked;                      /* whether what is not saved may go */
    void (*leaving)(struct desk *d); /* what is done when it has been saved */
    gint woken;
    /* what files below the window's call of it */
    void (*changed)(struct desk *d, int setting);
    void (*look)(struct desk *d);
};

/* desk_window.c */
void desk_window_open(struct desk *d);

/* desk_common.c */
void desk_say(struct desk *d, const char *text); /* in the window, until it is put away */
/* A button of which one is chosen: that one has a frame. In the dark theme it is only a little
 * darker than the others. */
void desk_choice(GtkWidget *button);
void desk_send(struct desk *d, enum studio_message_kind kind);
void desk_set(struct desk *d, int setting,
              double value); /* here, on the paper and in the panel */
/* The tool of the pointer: the one that is set, or that of a pen's other end. */
enum studio_tool_number desk_tool(const struct desk *d);
double desk_cursor_radius(const struct desk *d); /* fibers */
/* What the tool leaves, as a colour: that of the dish, or gray. */
void desk_tool_color(const struct desk *d, double rgb[3]);

/* desk_canvas.c */
GtkWidget *desk_canvas_new(struct desk *d);
void desk_canvas_look(struct desk *d);    /* take the newest picture of the paper */
void desk_canvas_show(struct desk *d);    /* draw it again */
void desk_canvas_changed(struct desk *d); /* the view is another */
void desk_ghost_add(struct desk *d, unsigned long number, double x, double y, bool begins);
void desk_ghost_forget(struct desk *d, unsigned long heard);

/* desk_gl.c */
struct desk_gl *desk_gl_create(char **why);
void desk_gl_destroy(struct desk_gl *gl);
/* The picture's changed rectangle, or all of it where its size is another. False: it is larger
 * than the device can. */
bool desk_gl_picture(struct desk_gl *gl, const struct studio_picture *picture);
void desk_gl_shown(struct desk_gl *gl, const struct studio_shown *shown);
/* drawn: as desk_area_draw has it. */
void desk_gl_draw(struct desk_gl *gl, const struct desk *d, int scale,
                  struct studio_rectangle *drawn);
/* The picture alone, as the view has it. */
void desk_gl_sheet(struct desk_gl *gl, const struct studio_view *view, int scale,
                   struct studio_rectangle *drawn);

/* desk_shape.c */
/* A place of the canvas as the steadied way has it; from where it begins. */
void desk_steady(struct desk *d, double time_s, double *x, double *y);
void desk_steady_begin(struct desk *d, double time_s, double x, double y);
bool desk_shapes(const struct desk *d); /* the next way is a line or an ellipse */
/* From where the hand came down to `to`, all fibers: its place at a part of the way; about how
 * long it is. */
struct studio_place desk_shape_at(const struct desk *d, struct studio_place to, double part);
double desk_shape_length(const struct desk *d, struct studio_place to);

/* desk_hand.c */
void desk_hand_attach(struct desk *d);
void desk_hand_event(struct desk *d,
                     const struct input_event *event); /* places: of the canvas */
void desk_hand_lift(struct desk *d); /* wherever it is: a stroke that was begun is done */
void desk_hand_drop(struct desk *d); /* a stroke that was begun is given up */

/* desk_rows.c */
GtkWidget *desk_row_new(struct desk *d, int setting, const char *label);
void desk_row_fill(struct desk *d, int setting);

/* desk_panel.c */
GtkWidget *desk_tools_new(struct desk *d);
GtkWidget *desk_panel_new(struct desk *d);
void desk_panel_fill(struct desk *d);  /* from the settings */
void desk_panel_sheet(struct desk *d); /* another sheet: its pigments */

/* desk_dish.c */
GtkWidget *desk_dish_new(struct desk *d);
GtkWidget *desk_board_new(struct desk *d);
void desk_dish_changed(struct desk *d);
void desk_dish_well(struct desk *d, int well);
void desk_palette_open(struct desk *d, const char *path);
void desk_palette_save(struct desk *d, const char *path);

/* desk_actions.c */
void desk_actions_add(struct desk *d);
GMenuModel *desk_menu_new(void);
void desk_actions_enable(struct desk *d);
bool desk_key(struct desk *d, guint key, GdkModifierType state); /* taken or not */

/* desk_files.c */
void desk_file_new(struct desk *d);
void desk_file_open(struct desk *d);
void desk_file_save(struct desk *d, bool as);
void desk_file_picture(struct desk *d);
void desk_file_script(struct desk *d);
void desk_file_palette(struct desk *d, bool opens);
void desk_file_stamp(struct desk *d);
void desk_file_film(struct desk *d);
/* Asks whether what is not saved may go; then `done`. */
void desk_file_leave(struct desk *d, void (*done)(struct desk *d));

/* desk_type.c */
void desk_type_attach(struct desk *d);
GtkWidget *desk_type_new(struct desk *d);                 /* fonts and features */
void desk_type_begin(struct desk *d, double x, double y); /* fibers */
void desk_type_print(struct desk *d);
void desk_type_drop(struct desk *d);
void desk_type_changed(struct desk *d);
bool desk_type_key(struct desk *d, guint key, GdkModifierType state);
void desk_type_text(struct desk *d, const char *text);

/* desk_springs.c */
/* By events' times and places, fibers; rests() prints it once it has landed. False: there is no
 * springy type there. */
bool desk_springs_take(struct desk *d, double time_s, double x, double y,
                       void (*rests)(struct desk *d));
bool desk_springs_held(const struct desk *d);
void desk_springs_move(struct desk *d, double time_s, double x,
                       double y); /* while it is held */
void desk_springs_let_go(struct desk *d, double time_s);
void desk_springs_print(struct desk *d); /* as it is now; there is one */
void desk_springs_drop(struct desk *d);  /* what is typed lies still again */

/* desk_stamp.c */
void desk_stamp_attach(struct desk *d);
GtkWidget *desk_stamp_new(struct desk *d); /* what is chosen */
bool desk_stamps(const struct desk *d);    /* the next click puts a picture */
void desk_stamp_choose(struct desk *d, const char *path);
void desk_stamp_put(struct desk *d, double x, double y); /* its middle, fibers */
void desk_stamp_changed(struct desk *d);                 /* tool or settings */
void desk_stamp_look(struct desk *d);                    /* after a report */

/* desk_past.c */
GtkWidget *desk_past_new(struct desk *d); /* hidden */
GtkWidget *desk_flow_new(struct desk *d); /* seen while the past flows anew */
void desk_past_look(struct desk *d);      /* after a report */
void desk_past_move(struct desk *d, int by);

/* desk_beside.c */
GtkWidget *desk_beside_new(struct desk *d); /* hidden */
void desk_beside_keep(struct desk *d);      /* what is seen is; or nothing any more */
bool desk_beside_due(const struct desk *d); /* it will be, when it is seen */
void desk_beside_look(struct desk *d);      /* after a report */
void desk_beside_drop(struct desk *d);      /* nothing is beside any more */
void desk_beside_show(struct desk *d);      /* draw it again */
void desk_beside_free(struct desk *d);

/* desk_unsaved.c */
/* The folder of journals of sheets that were never saved; NULL: it cannot be made. Free it by
 * g_free(). */
char *desk_unsaved_folder(void);
/* The newest of them that no living program writes; NULL: there is none. */
char *desk_unsaved_find(const char *folder);

/* desk_play.c */
/* NULL: it cannot be read; a line has been said. */
struct desk_play *desk_play_open(struct desk *d, const char *path);
void desk_play_begin(struct desk_play *play);
void desk_play_destroy(struct desk_play *play);

/* desk_measure.c */
void desk_measure_begin(struct desk *d, const char *name); /* ends what was measured before */
void desk_measure_sent(struct desk *d, unsigned long number); /* this message, now */
void desk_measure_drawn(struct desk *d);                      /* the canvas was */
void desk_measure_end(struct desk *d); /* before the window goes; nothing is measured: fine */

#endif
