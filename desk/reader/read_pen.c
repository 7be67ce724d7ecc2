/* read_pen.c - a pen or a mouse over the page, report by report: what GTK joins into one motion
 * is taken apart again, each place with its own time and pressure. While one of them is down,
 * what the other one does is nothing. */
#include "read_desk.h"

/* A mouse that is bumped while a pen draws, or a pen that is near while a mouse does. */
static bool is_beside(const struct read_desk *d, const struct desk_report *r)
{
    return d->hand_down && d->by_pen != r->pen;
}

static double pressure_of(const struct desk_report *r)
{
    return r->pen ? r->pressure : READ_MOUSE_PRESSURE;
}

/* True: no part of it is for others. */
static bool moves_take(struct read_desk *d, GdkEvent *event)
{
    guint count = 0;
    bool beside = false;
    GdkTimeCoord *passed = gdk_event_get_history(event, &count);
    for (guint i = 0; i <= count; i++) {
        struct desk_report r;
        if (!desk_pen_report(d->pen, d->page, event, i < count ? &passed[i] : NULL, &r))
            continue;
        beside = is_beside(d, &r);
        if (beside)
            continue;
        d->pressure = r.pen ? r.pressure : 1; /* for a demonstration */
        if (d->tool != READ_TOOL_READ)
            read_ink_move(d, r.x, r.y, pressure_of(&r), r.time_ms * 1e-3);
    }
    g_free(passed);
    return beside;
}

static bool press_take(struct read_desk *d, GdkEvent *event)
{
    struct desk_report r;
    if (!desk_pen_report(d->pen, d->page, event, NULL, &r))
        return false;
    if (is_beside(d, &r))
        return true;
    d->hand_down = true;
    d->by_pen = r.pen;
    d->eraser = r.eraser;
    d->pressure = r.pen ? r.pressure : 1;
    if (d->tool != READ_TOOL_READ) {
        gtk_widget_grab_focus(d->page);
        read_ink_press(d, r.x, r.y, pressure_of(&r), r.time_ms * 1e-3,
                       gdk_event_get_modifier_state(event) & GDK_SHIFT_MASK);
    }
    return false;
}

static bool release_take(struct read_desk *d, GdkEvent *event)
{
    struct desk_report r;
    if (!desk_pen_report(d->pen, d->page, event, NULL, &r))
        return false;
    if (is_beside(d, &r))
        return true;
    d->hand_down = false;
    if (d->tool != READ_TOOL_READ)
        read_ink_release(d, r.x, r.y);
    return false;
}

/* Whoever was down is no longer, and nobody has told it. */
static void lifted_elsewhere(struct read_desk *d)
{
    if (d->hand_down && d->tool != READ_TOOL_READ)
        read_ink_release(d, d->pointer_x, d->pointer_y);
    d->hand_down = false;
}

static gboolean event_take(GtkEventControllerLegacy *controller, GdkEvent *event,
                           struct read_desk *d)
{
    (void)controller;
    const GdkEventType type = gdk_event_get_event_type(event);
    if ((type == GDK_MOTION_NOTIFY || type == GDK_BUTTON_PRESS) &&
        !(gdk_event_get_modifier_state(event) & GDK_BUTTON1_MASK))
        lifted_elsewhere(d);
    if (type == GDK_MOTION_NOTIFY)
        return moves_take(d, event);
    if ((type != GDK_BUTTON_PRESS && type != GDK_BUTTON_RELEASE) ||
        gdk_button_event_get_button(event) != GDK_BUTTON_PRIMARY)
        return FALSE;
    return type == GDK_BUTTON_PRESS ? press_take(d, event) : release_take(d, event);
}

void read_pen_attach(struct read_desk *d)
{
    GtkEventController *controller = gtk_event_controller_legacy_new();
    d->pen = desk_pen_create(d->page);
    g_signal_connect(controller, "event", G_CALLBACK(event_take), d);
    gtk_widget_add_controller(d->page, controller);
}
