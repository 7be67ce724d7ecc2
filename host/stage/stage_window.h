/* stage_window.h - a stage in a window: hands, keys, the panel, recordings.
 *
 *     struct stage_window *w;
 *     struct stage_window_def def = stage_window_def_default();
 *     if (stage_window_create(stage, &def, &w) != STAGE_OK)
 *         die(stage_error());
 *     while (stage_window_turn(w) == STAGE_OK && stage_window_open(w))
 *         ;
 *     stage_window_destroy(w);
 *
 * Each turn takes all input, makes the steps that are due, and draws. So the pointer's place
 * takes effect in the simulation and on the screen in the same picture. `?` shows the keys
 * (stage_window_key()).
 *
 * Threads. The main thread, as window.h.
 */
#ifndef LUTETIA_STAGE_WINDOW_H
#define LUTETIA_STAGE_WINDOW_H

#include <display.h>
#include <input.h>

#include "help_sheet.h"
#include "panel.h"
#include "stage.h"

enum { STAGE_WINDOW_KEYS_MAX = 12 };

struct stage_window_def {
    const char *title;       /* "stage" */
    int width_px, height_px; /* 1280x800 */
    const char *record_path; /* where recordings go; "stage.mp4" */
    const char *save_path;   /* where the actor is saved and loaded; "stage.net" */
    const char *font;        /* the panel's font; "DejaVuSans" */
    double fps;              /* the most pictures a second; 60 */
    const char *screen;      /* that the window fills, as window.h; NULL: a usual window */
    const char *stream;      /* where its pictures go, too, as stage_stream.h; NULL: nowhere */
    /* what the letters on the keyboard play, for the help: they do nothing else then; NULL:
     * they play nothing */
    const char *played;
    /* Before a turn's steps: whoever plays the stage besides hands does so here; what it does
     * is in the same picture. And first of all for a key that goes down or up: true, it was
     * taken. NULL: nobody does. */
    enum stage_status (*before)(void *context, struct stage *stage, double now_s);
    bool (*key)(void *context, const struct input_event *event);
    /* A descriptor that is readable when `before` has something to take, or -1: the next
     * picture then comes at once, if the last one was a quarter of a picture's time ago, and as
     * long ago as it took. NULL: pictures come in time only. */
    int (*readable)(void *context);
    void *context;
    struct stage_panel_knobs knobs; /* zeros: there are none */
    /* What key() takes besides, for the help; borrowed. */
    const struct help_row *keys;
    int keys_count; /* STAGE_WINDOW_KEYS_MAX at most */
    /* After a turn's steps, before they are drawn: whoever lets hear what happened in them.
     * NULL: nobody does. */
    void (*after)(void *after_context, struct stage *stage);
    void *after_context;
    /* Of recordings: sound_begin() when one begins; at its end sound_end() gives a descriptor
     * of a WAV file of what was heard since, or -1 (*why: why not, or NULL). The window closes
     * it. Their context is after_context; now_s is the window's time, as for `before`. NULL:
     * recordings are silent. */
    void (*sound_begin)(void *after_context, double now_s);
    int (*sound_end)(void *after_context, double now_s, const char **why);
};
struct stage_window_def stage_window_def_default(void);

struct stage_window;
/* stage: borrowed. Errors: NO_DISPLAY, BAD_ARGUMENT (no such screen), FAILED (no font, no
 * stream), NO_MEMORY. */
enum stage_status stage_window_create(struct stage *stage, const struct stage_window_def *def,
                                      struct stage_window **out);
/* Ends a recording, and destroys the window. NULL is fine. */
void stage_window_destroy(struct stage_window *w);

/* Ends a recording, if there is one. Needs no display: it may have gone. */
void stage_window_record_end(struct stage_window *w);

/* One frame: waits until it is due. Errors: those of the actor and of drawing; errors of
 * files are only shown on the screen. */
enum stage_status stage_window_turn(struct stage_window *w);

/* False after the user closed the window, or pressed Esc. */
bool stage_window_open(const struct stage_window *w);

/* The last recording's path; NULL: none. */
const char *stage_window_recorded(const struct stage_window *w);

/* The last message on the screen; "" if there was none. */
const char *stage_window_message(const struct stage_window *w);

/* The last turn's picture, as rgb; the image is resized as needed. Errors: NO_MEMORY. */
enum stage_status stage_window_picture(struct stage_window *w, struct display_image *image);

/* Shows a message on the screen for some seconds. */
void stage_window_say(struct stage_window *w, const char *text);

/* Its panel, for tests. */
struct stage_panel *stage_window_panel(struct stage_window *w);

/* A row of the table of keys: its key and description. NULL: there is no such row. */
const char *stage_window_key(int row, const char **does);

#endif
