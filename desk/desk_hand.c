/* desk_hand.c - pointer and pen: from GTK's events to events of input.h, each with its own
 * time, place and pressure, and from those to the paper. GTK joins the moves of a picture into
 * one; the history of that one has them all.
 *
 * A mouse has no pressure: it presses as much as is set, and less the quicker it is. A pen
 * presses as it says. A pen that hovers never paints, since only a press begins a stroke. */
#include "desk.h"

#include <math.h>

#define QUICK 1500.0     /* canvas units a second: as quick as a hand is */
#define SMOOTH_S 0.03    /* over which its speed is taken */
#define TILT_MOST 1.047  /* radians at the most that a pen measures */
#define LINE_QUICK 400.0 /* fibers a second, of a line or an ellipse */
#define LINE_APART 3.0   /* fibers between two of its points */
enum { LINE_POINTS_MOST = 2000 };

/* ---- from events to the paper ---- */

static double pressure_of(struct desk *d, const struct input_event *e)
{
    const double *value = d->settings.value;
    d->pen_presses = d->pen_presses || (e->pen && e->pressure > 0);
    if (e->pen && d->pen_presses)
        return pow(e->pressure, value[STUDIO_CURVE]);
    const double gone_s = e->time_s - d->last_s;
    if (e->kind == INPUT_POINTER_DOWN)
        d->speed = 0;
    else if (gone_s > 0) {
        const double speed = hypot(e->x_px - d->last_x, e->y_px - d->last_y) / gone_s,
                     share = 1 - exp(-gone_s / SMOOTH_S);
        d->speed += share * (speed - d->speed);
    }
    return value[STUDIO_PRESSURE] * (1 - value[STUDIO_SPEED] * fmin(1, d->speed / QUICK));
}

static void point_send(struct desk *d, enum studio_point_kind kind, const struct input_event *e)
{
    double x = e->x_px, y = e->y_px;
    if (kind == STUDIO_POINT_MOVE)
        desk_steady(d, e->time_s, &x, &y);
    else
        desk_steady_begin(d, e->time_s, x, y);
    const struct studio_place at = studio_view_to_sheet(&d->view, x, y);
    const double side = d->view.mirrored ? -1 : 1, c = cos(d->view.turn), s = sin(d->view.turn);
    const struct studio_point point = {.kind = kind,
                                       .time_s = e->time_s,
                                       .x = at.x,
                                       .y = at.y,
                                       .pressure = d->pressure,
                                       .tilt_x =
                                           TILT_MOST * side * (c * e->tilt_x + s * e->tilt_y),
                                       .tilt_y = TILT_MOST * (c * e->tilt_y - s * e->tilt_x)};
    const unsigned long number = studio_paper_send(
        d->paper, (struct studio_message){.kind = STUDIO_MESSAGE_POINT, .point = point});
    desk_measure_sent(d, number);
    if (kind != STUDIO_POINT_DROP)
        desk_ghost_add(d, number, at.x, at.y, kind == STUDIO_POINT_DOWN);
}

static void set_send(struct desk *d, int setting, double value)
{
    studio_paper_send(d->paper, (struct studio_message){.kind = STUDIO_MESSAGE_SET,
                                                        .setting = setting,
                                                        .value = value});
}

/* What holds for this deed alone: a deed has the settings of when it began. The pen's other end
 * is another tool, and Shift and Alt join what is selected, or take it out. */
static void for_now(struct desk *d, bool begins)
{
    const double *value = d->settings.value;
    if (d->eraser)
        set_send(d, STUDIO_TOOL, begins ? (double)desk_tool(d) : value[STUDIO_TOOL]);
    if (desk_tool(d) == STUDIO_TOOL_SELECT && (d->modifiers & (INPUT_SHIFT | INPUT_ALT)))
        set_send(d, STUDIO_JOIN,
                 !begins                      ? value[STUDIO_JOIN]
                 : (d->modifiers & INPUT_ALT) ? STUDIO_JOIN_SUBTRACT
                                              : STUDIO_JOIN_ADD);
}

static void down(struct desk *d, const struct input_event *e)
{
    const struct studio_place at = studio_view_to_sheet(&d->view, e->x_px, e->y_px);
    if (e->button == INPUT_BUTTON_MIDDLE || d->space) {
        d->panning = true;
        return;
    }
    if (e->button != INPUT_BUTTON_LEFT || d->down || !d->report.ready)
        return;
    d->eraser = e->eraser;
    if (desk_tool(d) == STUDIO_TOOL_TYPE) {
        if (!desk_springs_take(d, e->time_s, at.x, at.y, desk_type_print))
            desk_type_begin(d, at.x, at.y);
        return;
    }
    if (desk_tool(d) == STUDIO_TOOL_STAMP) {
        desk_stamp_put(d, at.x, at.y);
        return;
    }
    d->down = true;
    d->down_x = at.x;
    d->down_y = at.y;
    d->modifiers = e->modifiers;
    d->shaping = desk_shapes(d);
    if (d->shaping)
        return;
    for_now(d, true);
    point_send(d, STUDIO_POINT_DOWN, e);
    for_now(d, false);
}

/* A line or an ellipse, as a stroke. */
static void shape_send(struct desk *d, const struct input_event *e)
{
    const struct studio_place to = studio_view_to_sheet(&d->view, e->x_px, e->y_px);
    const double length = desk_shape_length(d, to);
    const int count = (int)CLAMP(length / LINE_APART, 8, LINE_POINTS_MOST);
    for_now(d, true);
    for (int i = 0; i <= count; i++) {
        const struct studio_place at = desk_shape_at(d, to, (double)i / count);
        const struct studio_point point = {.kind = i == 0       ? STUDIO_POINT_DOWN
                                                   : i == count ? STUDIO_POINT_UP
                                                                : STUDIO_POINT_MOVE,
                                           .time_s =
                                               e->time_s + length * i / count / LINE_QUICK,
                                           .x = at.x,
                                           .y = at.y,
                                           .pressure = d->pressure};
        const unsigned long number = studio_paper_send(
            d->paper, (struct studio_message){.kind = STUDIO_MESSAGE_POINT, .point = point});
        desk_measure_sent(d, number);
        desk_ghost_add(d, number, at.x, at.y, i == 0);
    }
    for_now(d, false);
}

static void lift(struct desk *d, const struct input_event *e)
{
    if (d->shaping)
        shape_send(d, e);
    else
        point_send(d, STUDIO_POINT_UP, e);
    d->down = d->shaping = false;
}

static void up(struct desk *d, const struct input_event *e)
{
    if (d->panning) {
        d->panning = false;
        return;
    }
    if (e->button == INPUT_BUTTON_LEFT)
        desk_springs_let_go(d, e->time_s);
    if (!d->down || e->button != INPUT_BUTTON_LEFT)
        return;
    lift(d, e);
}

void desk_hand_event(struct desk *d, const struct input_event *e)
{
    const bool moved = e->kind == INPUT_POINTER_MOVE || e->kind == INPUT_POINTER_DOWN ||
                       e->kind == INPUT_POINTER_UP;
    if (moved)
        d->pressure = pressure_of(d, e);
    if (moved && !d->down) /* in mid-stroke it stays what it was */
        d->eraser = e->eraser;
    if (e->kind == INPUT_POINTER_MOVE && d->panning) {
        studio_view_pan(&d->view, e->x_px - d->last_x, e->y_px - d->last_y);
        desk_canvas_changed(d);
    } else if (e->kind == INPUT_POINTER_MOVE && desk_springs_held(d)) {
        const struct studio_place at = studio_view_to_sheet(&d->view, e->x_px, e->y_px);
        desk_springs_move(d, e->time_s, at.x, at.y);
    } else if (e->kind == INPUT_POINTER_MOVE && d->down && !d->shaping)
        point_send(d, STUDIO_POINT_MOVE, e);
    else if (e->kind == INPUT_POINTER_DOWN)
        down(d, e);
    else if (e->kind == INPUT_POINTER_UP)
        up(d, e);
    else if (e->kind == INPUT_FOCUS_LOST || e->kind == INPUT_CLOSE)
        desk_hand_lift(d);
    if (moved) {
        d->last_x = d->pointer_x = e->x_px;
        d->last_y = d->pointer_y = e->y_px;
        d->last_s = e->time_s;
        d->pointer_inside = true;
    }
    if (e->kind == INPUT_POINTER_LEAVE)
        d->pointer_inside = false;
    desk_canvas_show(d);
}

static struct input_event where_it_is(const struct desk *d)
{
    return (struct input_event){
        .kind = INPUT_POINTER_UP, .time_s = d->last_s, .x_px = d->last_x, .y_px = d->last_y};
}

void desk_hand_lift(struct desk *d)
{
    const struct input_event e = where_it_is(d);
    d->panning = d->space = false;
    desk_springs_let_go(d, e.time_s);
    if (d->down)
        lift(d, &e);
}

void desk_hand_drop(struct desk *d)
{
    const struct input_event e = where_it_is(d);
    if (d->down && !d->shaping)
        point_send(d, STUDIO_POINT_DROP, &e);
    d->down = d->shaping = false;
    g_array_set_size(d->ghost, 0);
}

/* ---- from GTK ---- */

static bool report_take(struct desk *d, GdkEvent *event, const GdkTimeCoord *past,
                        struct input_event *e)
{
    struct desk_report r;
    if (!desk_pen_report(d->pen, d->canvas, event, past, &r))
        return false;
    e->time_s = 1e-3 * r.time_ms;
    e->x_px = r.x;
    e->y_px = r.y;
    e->pen = r.pen;
    e->eraser = r.eraser;
    e->pressure = r.pressure;
    e->tilt_x = r.tilt[0];
    e->tilt_y = r.tilt[1];
    return true;
}

/* A mouse that is bumped while a pen paints. */
static bool beside_pen(const struct desk *d, const struct input_event *e)
{
    return d->down && d->by_pen && !e->pen;
}

static void moves_take(struct desk *d, GdkEvent *event)
{
    guint count = 0;
    GdkTimeCoord *history = gdk_event_get_history(event, &count);
    for (guint i = 0; i <= count; i++) {
        struct input_event e = {.kind = INPUT_POINTER_MOVE};
        if (report_take(d, event, i < count ? &history[i] : NULL, &e) && !beside_pen(d, &e))
            desk_hand_event(d, &e);
    }
    g_free(history);
}

static void button_take(struct desk *d, GdkEvent *event, enum input_kind kind)
{
    const guint button = gdk_button_event_get_button(event);
    struct input_event e = {.kind = kind,
                            .button = button == GDK_BUTTON_PRIMARY  ? INPUT_BUTTON_LEFT
                                      : button == GDK_BUTTON_MIDDLE ? INPUT_BUTTON_MIDDLE
                                                                    : INPUT_BUTTON_RIGHT};
    const GdkModifierType state = gdk_event_get_modifier_state(event);
    e.modifiers = (state & GDK_SHIFT_MASK ? INPUT_SHIFT : 0u) |
                  (state & GDK_CONTROL_MASK ? INPUT_CONTROL : 0u) |
                  (state & GDK_ALT_MASK ? INPUT_ALT : 0u);
    if (!report_take(d, event, NULL, &e) || beside_pen(d, &e))
        return;
    if (kind == INPUT_POINTER_DOWN && !d->down)
        d->by_pen = e.pen;
    if (kind == INPUT_POINTER_DOWN)
        gtk_widget_grab_focus(d->canvas);
    desk_hand_event(d, &e);
}

static gboolean event_take(GtkEventControllerLegacy *controller, GdkEvent *event,
                           struct desk *d)
{
    (void)controller;
    const GdkEventType type = gdk_event_get_event_type(event);
    if (type == GDK_MOTION_NOTIFY)
        moves_take(d, event);
    else if (type == GDK_BUTTON_PRESS)
        button_take(d, event, INPUT_POINTER_DOWN);
    else if (type == GDK_BUTTON_RELEASE)
        button_take(d, event, INPUT_POINTER_UP);
    return FALSE;
}

static void leave(GtkEventControllerMotion *controller, struct desk *d)
{
    (void)controller;
    if (!d->down)
        desk_hand_event(d, &(struct input_event){.kind = INPUT_POINTER_LEAVE});
}

static void active_changed(GObject *window, GParamSpec *spec, struct desk *d)
{
    (void)spec;
    if (!gtk_window_is_active(GTK_WINDOW(window)))
        desk_hand_event(d, &(struct input_event){.kind = INPUT_FOCUS_LOST});
}

void desk_hand_attach(struct desk *d)
{
    GtkEventController *controller = gtk_event_controller_legacy_new();
    g_signal_connect(controller, "event", G_CALLBACK(event_take), d);
    gtk_widget_add_controller(d->canvas, controller);
    controller = gtk_event_controller_motion_new();
    g_signal_connect(controller, "leave", G_CALLBACK(leave), d);
    gtk_widget_add_controller(d->canvas, controller);
    g_signal_connect(d->window, "notify::is-active", G_CALLBACK(active_changed), d);
    d->pressure = d->settings.value[STUDIO_PRESSURE];
}
