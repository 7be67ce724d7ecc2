/* panel.c - see panel.h. All places follow from the last picture's size. */
#include "panel.h"

#include <face.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TYPED_MAX = 40, MESSAGE_MAX = 160 };
static const double slider_range_max = 1e5;

struct stage_panel {
    struct font_face *face;
    struct font_shaper *shaper;
    bool shown;
    /* The last picture. */
    int width_px, height_px, rows_count;
    double px, text_px, left_px, row_px;
    double scrolled_px;
    /* What is done to it. */
    int dragged; /* a row; -1: none */
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
    p->dragged = p->typed_row = -1;
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

void stage_panel_show(struct stage_panel *p, bool shown)
{
    p->shown = shown;
    p->dragged = p->typed_row = -1;
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
static bool is_clicked(const struct stage_control *row)
{
    return row->curve == STAGE_SWITCH || row->curve == STAGE_CHOICE;
}

/* Controls with an unbounded range of places have no slider; their values are typed. */
static bool has_slider(const struct stage_control *row)
{
    return !is_clicked(row) &&
           (row->curve == STAGE_LOGARITHMIC || row->most - row->least < slider_range_max);
}

static double row_top(const struct stage_panel *p, int row)
{
    return p->text_px * 0.8 + row * p->row_px - p->scrolled_px;
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
    if (!p->shown || row < 0 || row >= p->rows_count)
        return false;
    *slider = slider_box(p, row);
    *value = value_box(p, row);
    return value->y0 >= 0 && slider->y1 <= p->height_px;
}

static void scroll(struct stage_panel *p, double by_px)
{
    double most = fmax(0, p->rows_count * p->row_px + 1.6 * p->text_px - p->height_px);
    p->scrolled_px = fmin(most, fmax(0, p->scrolled_px + by_px));
}

/* ---- drawing ---- */

static void row_draw(struct stage_panel *p, struct stage *stage,
                     const struct stage_control *row, int number, struct stage_draw_list *list)
{
    const struct stage_theme *theme = stage_theme(stage);
    const struct stage_color *colors = theme->colors;
    char value[64], text[96];
    double y = row_top(p, number) + p->text_px, now = stage_control_read(row, stage);
    bool typing = p->typed_row == number;
    stage_control_text(row, now, value, sizeof value);
    if (typing)
        snprintf(text, sizeof text, "%s|", p->typed);
    else
        snprintf(text, sizeof text, "%s%s%s", value, row->unit[0] ? " " : "", row->unit);
    stage_panel_text(p, list, row->name, p->left_px + p->text_px, y, p->text_px, false,
                     colors[STAGE_COLOR_PANEL_TEXT]);
    stage_panel_text(p, list, text, p->width_px - p->text_px, y, p->text_px, true,
                     colors[typing ? STAGE_COLOR_SLIDER_KNOB : STAGE_COLOR_PANEL_VALUE]);
    if (!has_slider(row))
        return;
    struct font_box box = slider_box(p, number);
    double middle = (box.y0 + box.y1) / 2;
    double knob = box.x0 + stage_control_along(row, now) * (box.x1 - box.x0);
    stage_draw_line(list, box.x0, middle, box.x1, middle, 2 * p->px,
                    colors[STAGE_COLOR_SLIDER]);
    stage_draw_disc(list, knob, middle, 5 * p->px, colors[STAGE_COLOR_SLIDER_KNOB]);
}

void stage_panel_draw(struct stage_panel *p, struct stage *stage, int width_px, int height_px,
                      double px, struct stage_draw_list *list)
{
    const struct stage_theme *theme = stage_theme(stage);
    const struct stage_control *rows = stage_controls(stage, &p->rows_count);
    p->width_px = width_px;
    p->height_px = height_px;
    p->px = px;
    p->text_px = px * theme->sizes[STAGE_SIZE_PANEL_TEXT_SIZE];
    p->row_px = 2.7 * p->text_px;
    p->left_px = width_px - px * theme->sizes[STAGE_SIZE_PANEL_WIDTH];
    if (!p->shown)
        return;
    scroll(p, 0);
    stage_draw_view(list, STAGE_VIEW_PIXELS);
    stage_draw_box(list, p->left_px, -2, width_px + 2, height_px + 2, 0, 0,
                   theme->colors[STAGE_COLOR_PANEL]);
    stage_draw_line(list, p->left_px, -2, p->left_px, height_px + 2, px,
                    theme->colors[STAGE_COLOR_PANEL_EDGE]);
    for (int i = 0; i < p->rows_count; i++)
        if (row_top(p, i) > -p->row_px && row_top(p, i) < height_px)
            row_draw(p, stage, &rows[i], i, list);
}

/* ---- input ---- */

/* An error is kept for the message; then there is nothing to undo. */
static void value_set(struct stage_panel *p, struct stage *stage,
                      const struct stage_control *row, double value)
{
    p->message[0] = '\0';
    if (stage_control_write(row, stage, value) != STAGE_OK)
        snprintf(p->message, sizeof p->message, "%s", stage_error());
}

static void drag(struct stage_panel *p, struct stage *stage, double x_px)
{
    int count;
    const struct stage_control *row = &stage_controls(stage, &count)[p->dragged];
    struct font_box box = slider_box(p, p->dragged);
    double value = stage_control_at(row, (x_px - box.x0) / (box.x1 - box.x0));
    if (strcmp(row->name, "skins") == 0)
        value = floor(value + 0.5);
    value_set(p, stage, row, value);
}

static bool inside(const struct font_box *box, const struct input_event *e)
{
    return e->x_px >= box->x0 && e->x_px <= box->x1 && e->y_px >= box->y0 && e->y_px <= box->y1;
}

static void press(struct stage_panel *p, struct stage *stage, const struct input_event *e)
{
    int count, number = (int)floor((e->y_px - row_top(p, 0)) / p->row_px);
    const struct stage_control *rows = stage_controls(stage, &count);
    p->typed_row = -1;
    if (e->button != INPUT_BUTTON_LEFT || number < 0 || number >= count)
        return;
    const struct stage_control *row = &rows[number];
    struct font_box slider = slider_box(p, number), value = value_box(p, number);
    if (is_clicked(row)) {
        double next = stage_control_read(row, stage) + 1;
        stage_mark(stage);
        value_set(p, stage, row, next > row->most ? row->least : next);
    } else if (has_slider(row) && inside(&slider, e)) {
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
    const struct stage_control *row = &stage_controls(stage, &count)[p->typed_row];
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
    if (e->x_px < p->left_px)
        return false;
    if (e->kind == INPUT_POINTER_DOWN)
        press(p, stage, e);
    else if (e->kind == INPUT_SCROLL)
        scroll(p, -e->scroll_y * p->row_px);
    return e->kind == INPUT_POINTER_DOWN || e->kind == INPUT_SCROLL;
}
