/* panel.h - a stage's controls as sliders, at the right of the picture. Each row of the table
 * gives a slider.
 *
 *     struct stage_panel *panel;
 *     stage_panel_create("DejaVuSans", &panel);
 *     if (!stage_panel_input(panel, stage, &event))
 *         ...the event is not the panel's...
 *     stage_panel_draw(panel, stage, width_px, height_px, px, &list);
 *     stage_panel_destroy(panel);
 *
 *     gravity              9.81 em/s2      the value: click it and type another one, then Enter
 *     ------------o------------------      drag; a switch and a choice change with a click
 *
 *   - world              a group of controls: a click folds it (+), and unfolds it
 *
 * Where somebody knows of instruments (stage_panel_knobs): a click with the right button lets a
 * control wait for the knob that is turned next, Shift and a drag set the knob's ends, Shift
 * and a click with the right button let it go.
 *
 * The wheel scrolls a panel that does not fit. Beside the panel stands what the control under
 * the pointer does. Each change can be undone.
 */
#ifndef LUTETIA_STAGE_PANEL_H
#define LUTETIA_STAGE_PANEL_H

#include <input.h>

#include "stage.h"

/* The knob of an instrument that moves a control: text names it, from and to are its ends on
 * the slider's way. waits: for one that is turned. */
struct stage_panel_knob {
    const char *text;
    double from, to;
    bool waits;
};

/* Who knows of knobs. of() NULL: nobody does. Rows are those of stage_controls(). */
struct stage_panel_knobs {
    bool (*of)(void *context, int row, struct stage_panel_knob *out); /* false: none moves it */
    void (*learn)(void *context, int row);             /* a click with the right button */
    void (*forget)(void *context, int row);            /* the same with Shift */
    void (*end)(void *context, int row, double along); /* the nearer end: Shift and drag */
    void *context;
};

struct stage_panel;
/* font: as font_face_open() has it. Errors: FAILED (there is no such font), NO_MEMORY. */
enum stage_status stage_panel_create(const char *font, struct stage_panel **out);
void stage_panel_destroy(struct stage_panel *panel); /* NULL is fine */
void stage_panel_knobs_set(struct stage_panel *panel, const struct stage_panel_knobs *knobs);

bool stage_panel_shown(const struct stage_panel *panel);
/* A value is being typed: keys are the panel's. */
bool stage_panel_typing(const struct stage_panel *panel);
void stage_panel_show(struct stage_panel *panel, bool shown);

/* How much of a picture's width is left for the stage: what the panel does not take, unless it
 * would take more than two thirds; then it lies over the stage. */
int stage_panel_beside(const struct stage_panel *panel, const struct stage *stage, int width_px,
                       double px);

/* Draws the panel on top of the list, if it is shown. */
void stage_panel_draw(struct stage_panel *panel, struct stage *stage, int width_px,
                      int height_px, double px, struct stage_draw_list *list);

/* True: the panel took the event. stage_panel_message() has the error of a typed value. */
bool stage_panel_input(struct stage_panel *panel, struct stage *stage,
                       const struct input_event *event);
const char *stage_panel_message(const struct stage_panel *panel);

/* Draws text in the panel's font, with its left end on the baseline at (x_px, y_px); returns
 * its width. size_px: its size. right: (x_px, y_px) is its right end. */
double stage_panel_text(struct stage_panel *panel, struct stage_draw_list *list,
                        const char *text, double x_px, double y_px, double size_px, bool right,
                        struct stage_color color);

/* ---- for tests, and who wants to point at it ---- */

/* Unfolds a row's group and scrolls to it; it is there in the next picture. */
void stage_panel_reveal(struct stage_panel *panel, int row);

/* The places of a row's slider and value, in pixels of the last picture; false: it has none,
 * is folded, or is not on the picture. */
bool stage_panel_place(const struct stage_panel *panel, int row, struct font_box *slider,
                       struct font_box *value);
/* The place of the title of the group that a row is in. */
bool stage_panel_title(const struct stage_panel *panel, int row, struct font_box *title);
/* The row that the last picture explains; -1: none. */
int stage_panel_explained(const struct stage_panel *panel);

#endif
