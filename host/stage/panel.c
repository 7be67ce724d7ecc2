/* panel.c - see panel.h. All places follow from the last picture's size. */
#include "panel.h"

#include <face.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TYPED_MAX = 40, MESSAGE_MAX = 160, GROUPS_MAX = 16, WORDS_MAX = 400 };
static const double slider_range_max = 1e5;

/* Rows that follow each other, under a title. */
struct group {
    const char *name; /* owned by the actor */
    int first, count;
    bool folded;
};

struct stage_panel {
    struct font_face *face;
    struct font_shaper *shaper;
    bool shown;
    /* The last picture. */
    int width_px, height_px, rows_count;
    double px, text_px, left_px, row_px, title_px;
    double scrolled_px;
    struct group groups[GROUPS_MAX];
    int groups_count;
    /* What is done to it. */
    int dragged;          /* a row; -1: none */
    int wanted;           /* the same: to be scrolled to */
    bool of_knob;         /* an end of the dragged row's knob, not its value */
    double pointer_px[2]; /* where the pointer was last */
    int explained;        /* in the last picture; -1: none */
    struct stage_panel_knobs knobs;
    int typed_row;
    char typed[TYPED_MAX];
    char message[MESSAGE_MAX];
};

enum stage_status stage_panel_create(const char *font, struct stage_panel **out)
{
    *out = NULL;
    struct stage_panel *p = calloc(1, sizeof *p);
    if (!p)
        return stage_fail(STAGE_NO_MEMORY, "no memory for a panel");
    p->dragged = p->typed_row = p->wanted = -1;
    p->pointer_px[0] = -1;
    if (font_face_open(font, 0, &p->face) != FONT_OK ||
        font_shaper_create(p->face, &p->shaper) != FONT_OK) {
        stage_panel_destroy(p);
        return stage_fail(STAGE_FAILED, "%s", font_error());
    }
    *out = p;
    return STAGE_OK;
}

void stage_panel_destroy(struct stage_panel *p)
{
    if (!p)
        return;
    font_shaper_destroy(p->shaper);
    font_face_close(p->face);
    free(p);
}

bool stage_panel_shown(const struct stage_panel *p)
{
    return p->shown;
}

bool stage_panel_typing(const struct stage_panel *p)
{
    return p->shown && p->typed_row >= 0;
}

void stage_panel_knobs_set(struct stage_panel *p, const struct stage_panel_knobs *knobs)
{
    p->knobs = *knobs;
}

void stage_panel_show(struct stage_panel *p, bool shown)
{
    p->shown = shown;
    p->dragged = p->typed_row = -1;
    p->pointer_px[0] = -1;
}

const char *stage_panel_message(const struct stage_panel *p)
{
    return p->message;
}

double stage_panel_text(struct stage_panel *p, struct stage_draw_list *list, const char *text,
                        double x_px, double y_px, double size_px, bool right,
                        struct stage_color color)
{
    struct font_layout layout;
    if (font_shaper_layout(p->shaper, text, strlen(text), size_px, NULL, &layout) != FONT_OK)
        return 0;
    double width_px = layout.width_px;
    stage_draw_text(list, &layout, round(right ? x_px - width_px : x_px), round(y_px), color);
    font_layout_finish(&layout);
    return width_px;
}

/* ---- places ---- */

/* Changes with a click. */
static bool is_clicked(const struct control *row)
{
    return row->curve == CONTROL_SWITCH || row->curve == CONTROL_CHOICE;
}

/* Controls with an unbounded range of places have no slider; their values are typed. */
static bool has_slider(const struct control *row)
{
    return !is_clicked(row) &&
           (row->curve == CONTROL_LOGARITHMIC || row->most - row->least < slider_range_max);
}

/* The stage's own controls are the first group, the actor's follow. Groups that were there keep
 * whether they are folded. */
static void groups_find(struct stage_panel *p, struct stage *stage)
{
    const struct stage_actor actor = stage_actor(stage);
    int of_actor = 0;
    if (actor.kind->controls)
        actor.kind->controls(actor.self, &of_actor);
    p->groups_count = 0;
    for (int i = 0; i < p->rows_count; i++) {
        const int row = i - (p->rows_count - of_actor);
        const char *name = row < 0             ? "time and picture"
                           : actor.kind->group ? actor.kind->group(actor.self, row)
                                               : actor.kind->name;
        struct group *last = p->groups_count ? &p->groups[p->groups_count - 1] : NULL;
        if (last && (strcmp(last->name, name) == 0 || p->groups_count == GROUPS_MAX)) {
            last->count++;
            continue;
        }
        struct group *g = &p->groups[p->groups_count++];
        *g = (struct group){name, i, 1, g->name && !strcmp(g->name, name) && g->folded};
    }
}

static const struct group *group_of(const struct stage_panel *p, int row)
{
    for (int i = 0; i < p->groups_count; i++)
        if (row >= p->groups[i].first && row < p->groups[i].first + p->groups[i].count)
            return &p->groups[i];
    return NULL;
}

/* How high a title and its rows are. */
static double group_height(const struct stage_panel *p, const struct group *g)
{
    return p->title_px + (g->folded ? 0 : g->count * p->row_px);
}

static double group_top(const struct stage_panel *p, const struct group *g)
{
    double y = 0.8 * p->text_px - p->scrolled_px;
    for (const struct group *before = p->groups; before < g; before++)
        y += group_height(p, before);
    return y;
}

static double row_top(const struct stage_panel *p, int row)
{
    const struct group *g = group_of(p, row);
    return g ? group_top(p, g) + p->title_px + (row - g->first) * p->row_px : 0;
}

static struct font_box slider_box(const struct stage_panel *p, int row)
{
    double y = row_top(p, row) + 1.85 * p->text_px;
    return (struct font_box){p->left_px + p->text_px, y - 0.5 * p->text_px,
                             p->width_px - p->text_px, y + 0.5 * p->text_px};
}

static struct font_box value_box(const struct stage_panel *p, int row)
{
    double y = row_top(p, row);
    return (struct font_box){p->width_px - 9.5 * p->text_px, y, p->width_px - p->text_px,
                             y + 1.3 * p->text_px};
}

bool stage_panel_place(const struct stage_panel *p, int row, struct font_box *slider,
                       struct font_box *value)
{
    const struct group *g = group_of(p, row);
    if (!p->shown || !g || g->folded)
        return false;
    *slider = slider_box(p, row);
    *value = value_box(p, row);
    return value->y0 >= 0 && slider->y1 <= p->height_px;
}

bool stage_panel_title(const struct stage_panel *p, int row, struct font_box *title)
{
    const struct group *g = group_of(p, row);
    if (!p->shown || !g)
        return false;
    const double y = group_top(p, g);
    *title = (struct font_box){p->left_px, y, p->width_px, y + p->title_px};
    return title->y0 >= 0 && title->y1 <= p->height_px;
}

void stage_panel_reveal(struct stage_panel *p, int row)
{
    p->wanted = row;
}

/* Unfolds what is wanted, and scrolls so that it is whole on the picture. */
static void wanted_show(struct stage_panel *p)
{
    const struct group *g = group_of(p, p->wanted);
    if (g) {
        p->groups[g - p->groups].folded = false;
        const double top = row_top(p, p->wanted), below = top + p->row_px - p->height_px;
        p->scrolled_px += top < p->title_px ? top - p->title_px
                          : below > 0       ? fmin(below, top)
                                            : 0;
    }
    p->wanted = -1;
}

static void scroll(struct stage_panel *p, double by_px)
{
    double all = 1.6 * p->text_px;
    for (int i = 0; i < p->groups_count; i++)
        all += group_height(p, &p->groups[i]);
    p->scrolled_px = fmin(fmax(0, all - p->height_px), fmax(0, p->scrolled_px + by_px));
}

int stage_panel_beside(const struct stage_panel *p, const struct stage *stage, int width_px,
                       double px)
{
    const int taken = (int)ceil(px * stage_theme(stage)->sizes[STAGE_SIZE_PANEL_WIDTH]);
    return p->shown && 3 * taken <= 2 * width_px ? width_px - taken : width_px;
}

/* ---- drawing ---- */

/* False: no knob moves the row's control, and it waits for none. */
static bool knob_of(const struct stage_panel *p, int row, struct stage_panel_knob *out)
{
    return p->knobs.of && p->knobs.of(p->knobs.context, row, out);
}

/* Between the knob's ends the way is thicker, and each end has a tick. */
static void knob_draw(const struct stage_panel *p, const struct stage_panel_knob *knob,
                      const struct font_box *way, const struct stage_color *colors,
                      struct stage_draw_list *list)
{
    const double y = (way->y0 + way->y1) / 2, ends[2] = {knob->from, knob->to};
    double at[2];
    for (int i = 0; i < 2; i++) {
        at[i] = way->x0 + ends[i] * (way->x1 - way->x0);
        stage_draw_line(list, at[i], y - 5 * p->px, at[i], y + 5 * p->px, 1.5 * p->px,
                        colors[STAGE_COLOR_SLIDER_KNOB]);
    }
    stage_draw_line(list, at[0], y, at[1], y, 3 * p->px, colors[STAGE_COLOR_SLIDER_KNOB]);
}

static void row_draw(struct stage_panel *p, struct stage *stage, const struct control *row,
                     int number, struct stage_draw_list *list)
{
    const struct stage_theme *theme = stage_theme(stage);
    const struct stage_color *colors = theme->colors;
    char value[64], text[96];
    double y = row_top(p, number) + p->text_px, now = control_read(row, stage);
    bool typing = p->typed_row == number;
    struct stage_panel_knob knob = {0};
    const bool has_knob = knob_of(p, number, &knob);
    control_text(row, now, value, sizeof value);
    if (typing)
        snprintf(text, sizeof text, "%s|", p->typed);
    else if (knob.waits)
        snprintf(text, sizeof text, "%s", knob.text);
    else
        snprintf(text, sizeof text, "%s%s%s", value, row->unit[0] ? " " : "", row->unit);
    stage_panel_text(p, list, row->name, p->left_px + p->text_px, y, p->text_px, false,
                     colors[STAGE_COLOR_PANEL_TEXT]);
    stage_panel_text(
        p, list, text, p->width_px - p->text_px, y, p->text_px, true,
        colors[typing || knob.waits ? STAGE_COLOR_SLIDER_KNOB : STAGE_COLOR_PANEL_VALUE]);
    if (!has_slider(row))
        return;
    struct font_box box = slider_box(p, number);
    double middle = (box.y0 + box.y1) / 2;
    double at = box.x0 + control_along(row, now) * (box.x1 - box.x0);
    stage_draw_line(list, box.x0, middle, box.x1, middle, 2 * p->px,
                    colors[STAGE_COLOR_SLIDER]);
    if (has_knob && !knob.waits)
        knob_draw(p, &knob, &box, colors, list);
    stage_draw_disc(list, at, middle, 5 * p->px, colors[STAGE_COLOR_SLIDER_KNOB]);
}

static void title_draw(struct stage_panel *p, const struct group *g,
                       const struct stage_color *colors, struct stage_draw_list *list)
{
    const double y = group_top(p, g) + 1.2 * p->text_px;
    stage_panel_text(p, list, g->folded ? "+" : "\xe2\x88\x92", p->left_px + p->text_px, y,
                     p->text_px, false, colors[STAGE_COLOR_PANEL_VALUE]);
    stage_panel_text(p, list, g->name, p->left_px + 2.2 * p->text_px, y, p->text_px, false,
                     colors[STAGE_COLOR_PANEL_VALUE]);
}

/* Text in lines of at most that width, from y downwards: draws them, or only counts them (list
 * NULL). A word that is too long has a line of its own. */
static int lines_draw(struct stage_panel *p, struct stage_draw_list *list, const char *text,
                      double x_px, double y_px, double width_px, struct stage_color color)
{
    struct stage_draw_list nowhere = {0};
    char line[WORDS_MAX] = "";
    int lines = 0;
    for (const char *word = text; *word;) {
        const size_t length = strcspn(word, " "), before = strlen(line);
        if (before + length + 2 > sizeof line)
            break;
        snprintf(line + before, sizeof line - before, "%s%.*s", before ? " " : "", (int)length,
                 word);
        const bool full = before && stage_panel_text(p, &nowhere, line, 0, 0, p->text_px, false,
                                                     color) > width_px;
        if (full)
            line[before] = '\0';
        else
            word += length + strspn(word + length, " ");
        if (!full && *word)
            continue;
        if (list)
            stage_panel_text(p, list, line, x_px, y_px + 1.4 * p->text_px * lines, p->text_px,
                             false, color);
        lines++;
        line[0] = '\0';
    }
    stage_draw_finish(&nowhere);
    return lines;
}

/* The row at a place; -1: none. */
static int row_at(const struct stage_panel *p, double x_px, double y_px)
{
    for (int i = 0; x_px >= p->left_px && i < p->rows_count; i++)
        if (!group_of(p, i)->folded && y_px >= row_top(p, i) &&
            y_px < row_top(p, i) + p->row_px)
            return i;
    return -1;
}

/* What a control does, on the left of its row. */
static void help_draw(struct stage_panel *p, const struct control *row, int number,
                      const struct stage_color *colors, struct stage_draw_list *list)
{
    const double pad = 0.8 * p->text_px, line = 1.4 * p->text_px,
                 width = fmin(24 * p->text_px, p->left_px - 4 * pad);
    char text[WORDS_MAX];
    if (width < 8 * p->text_px || !row->does[0])
        return;
    if (is_clicked(row))
        snprintf(text, sizeof text, "%s%s%s", row->does, row->choices ? ": " : "",
                 row->choices ? row->choices : "");
    else
        snprintf(text, sizeof text, "%s; %g to %g%s%s", row->does, row->least, row->most,
                 row->unit[0] ? " " : "", row->unit);
    struct stage_panel_knob knob;
    const size_t used = strlen(text);
    if (knob_of(p, number, &knob) && !knob.waits)
        snprintf(text + used, sizeof text - used, "; moved by %s", knob.text);
    const int lines = lines_draw(p, NULL, text, 0, 0, width, colors[STAGE_COLOR_PANEL_TEXT]);
    const double height = lines * line + 1.2 * pad, x = p->left_px - 2 * pad - width;
    /* below how often pictures come */
    const double y =
        fmax(2.2 * p->text_px, fmin(row_top(p, number), p->height_px - height - pad));
    stage_draw_box(list, x - pad, y, x + width + pad, y + height, pad / 2, 0,
                   colors[STAGE_COLOR_PANEL]);
    lines_draw(p, list, text, x, y + pad + 0.8 * p->text_px, width,
               colors[STAGE_COLOR_PANEL_TEXT]);
}

void stage_panel_draw(struct stage_panel *p, struct stage *stage, int width_px, int height_px,
                      double px, struct stage_draw_list *list)
{
    const struct stage_theme *theme = stage_theme(stage);
    const struct control *rows = stage_controls(stage, &p->rows_count);
    p->width_px = width_px;
    p->height_px = height_px;
    p->px = px;
    p->text_px = px * theme->sizes[STAGE_SIZE_PANEL_TEXT_SIZE];
    p->row_px = 2.7 * p->text_px;
    p->title_px = 1.9 * p->text_px;
    p->left_px = width_px - px * theme->sizes[STAGE_SIZE_PANEL_WIDTH];
    groups_find(p, stage);
    if (!p->shown)
        return;
    wanted_show(p);
    scroll(p, 0);
    stage_draw_view(list, STAGE_VIEW_PIXELS);
    stage_draw_box(list, p->left_px, -2, width_px + 2, height_px + 2, 0, 0,
                   theme->colors[STAGE_COLOR_PANEL]);
    stage_draw_line(list, p->left_px, -2, p->left_px, height_px + 2, px,
                    theme->colors[STAGE_COLOR_PANEL_EDGE]);
    for (int g = 0; g < p->groups_count; g++) {
        const struct group *group = &p->groups[g];
        title_draw(p, group, theme->colors, list);
        for (int i = group->first; i < group->first + group->count && !group->folded; i++)
            if (row_top(p, i) > -p->row_px && row_top(p, i) < height_px)
                row_draw(p, stage, &rows[i], i, list);
    }
    p->explained = p->dragged >= 0     ? p->dragged
                   : p->typed_row >= 0 ? p->typed_row
                                       : row_at(p, p->pointer_px[0], p->pointer_px[1]);
    if (!group_of(p, p->explained) || group_of(p, p->explained)->folded)
        p->explained = -1;
    else
        help_draw(p, &rows[p->explained], p->explained, theme->colors, list);
}

/* ---- input ---- */

/* An error is kept for the message; then there is nothing to undo. */
static void value_set(struct stage_panel *p, struct stage *stage, const struct control *row,
                      double value)
{
    p->message[0] = '\0';
    if (stage_control_write(row, stage, value) != STAGE_OK)
        snprintf(p->message, sizeof p->message, "%s", stage_error());
}

static void drag(struct stage_panel *p, struct stage *stage, double x_px)
{
    int count;
    const struct control *row = &stage_controls(stage, &count)[p->dragged];
    struct font_box box = slider_box(p, p->dragged);
    const double along = (x_px - box.x0) / (box.x1 - box.x0);
    double value = control_at(row, along);
    if (p->of_knob) {
        p->knobs.end(p->knobs.context, p->dragged, along);
        return;
    }
    if (strcmp(row->name, "skins") == 0)
        value = floor(value + 0.5);
    value_set(p, stage, row, value);
}

static bool inside(const struct font_box *box, const struct input_event *e)
{
    return e->x_px >= box->x0 && e->x_px <= box->x1 && e->y_px >= box->y0 && e->y_px <= box->y1;
}

/* True: it was on a title. */
static bool group_fold(struct stage_panel *p, double y_px)
{
    for (int i = 0; i < p->groups_count; i++) {
        const double top = group_top(p, &p->groups[i]);
        if (y_px >= top && y_px < top + p->title_px) {
            p->groups[i].folded = !p->groups[i].folded;
            return true;
        }
    }
    return false;
}

static void press(struct stage_panel *p, struct stage *stage, const struct input_event *e)
{
    int count;
    const struct control *rows = stage_controls(stage, &count);
    const bool shift = (e->modifiers & INPUT_SHIFT) != 0;
    struct stage_panel_knob knob;
    p->typed_row = -1;
    p->of_knob = false;
    if (e->button == INPUT_BUTTON_LEFT && group_fold(p, e->y_px))
        return;
    const int number = row_at(p, e->x_px, e->y_px);
    if (number < 0 || number >= count) /* there may be fewer than on the last picture */
        return;
    if (e->button == INPUT_BUTTON_RIGHT && p->knobs.of)
        (shift ? p->knobs.forget : p->knobs.learn)(p->knobs.context, number);
    if (e->button != INPUT_BUTTON_LEFT)
        return;
    const struct control *row = &rows[number];
    struct font_box slider = slider_box(p, number), value = value_box(p, number);
    if (is_clicked(row)) {
        double next = control_read(row, stage) + 1;
        stage_mark(stage);
        value_set(p, stage, row, next > row->most ? row->least : next);
    } else if (has_slider(row) && inside(&slider, e)) {
        p->of_knob = shift && knob_of(p, number, &knob) && !knob.waits;
        if (!p->of_knob)
            stage_mark(stage);
        p->dragged = number;
        drag(p, stage, e->x_px);
    } else if (inside(&value, e)) {
        p->typed_row = number;
        p->typed[0] = '\0';
        p->message[0] = '\0';
    }
}

static void typed_commit(struct stage_panel *p, struct stage *stage)
{
    int count;
    double value;
    const struct control *row = &stage_controls(stage, &count)[p->typed_row];
    p->typed_row = -1;
    p->message[0] = '\0';
    if (!p->typed[0])
        return;
    if (stage_control_parse(row, p->typed, &value) != STAGE_OK) {
        snprintf(p->message, sizeof p->message, "%s", stage_error());
        return;
    }
    stage_mark(stage);
    value_set(p, stage, row, value);
    if (p->message[0])
        stage_mark_drop(stage);
}

/* While a value is being typed the panel takes all keys. */
static bool typed_input(struct stage_panel *p, struct stage *stage, const struct input_event *e)
{
    size_t length = strlen(p->typed);
    if (p->typed_row < 0)
        return false;
    if (e->kind == INPUT_TEXT) {
        if (e->character > ' ' && e->character < 0x7f && length + 1 < sizeof p->typed) {
            p->typed[length] = (char)e->character;
            p->typed[length + 1] = '\0';
        }
        return true;
    }
    if (e->kind != INPUT_KEY_DOWN && e->kind != INPUT_KEY_REPEAT)
        return e->kind == INPUT_KEY_UP;
    if (e->key == INPUT_KEY_BACKSPACE && length)
        p->typed[length - 1] = '\0';
    else if (e->key == INPUT_KEY_ENTER)
        typed_commit(p, stage);
    else if (e->key == INPUT_KEY_ESCAPE)
        p->typed_row = -1;
    return true;
}

bool stage_panel_input(struct stage_panel *p, struct stage *stage, const struct input_event *e)
{
    if (!p->shown)
        return false;
    if (p->dragged >= 0) {
        if (e->kind == INPUT_POINTER_MOVE)
            drag(p, stage, e->x_px);
        if (e->kind == INPUT_POINTER_UP || e->kind == INPUT_FOCUS_LOST)
            p->dragged = -1;
        return e->kind == INPUT_POINTER_MOVE || e->kind == INPUT_POINTER_UP;
    }
    if (typed_input(p, stage, e))
        return true;
    if (e->kind == INPUT_POINTER_MOVE) {
        p->pointer_px[0] = e->x_px;
        p->pointer_px[1] = e->y_px;
    }
    if (e->x_px < p->left_px)
        return false;
    if (e->kind == INPUT_POINTER_DOWN)
        press(p, stage, e);
    else if (e->kind == INPUT_SCROLL)
        scroll(p, -e->scroll_y * p->row_px);
    return e->kind == INPUT_POINTER_DOWN || e->kind == INPUT_SCROLL;
}

int stage_panel_explained(const struct stage_panel *p)
{
    return p->shown ? p->explained : -1;
}
