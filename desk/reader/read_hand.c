/* read_hand.c - pointer, wheel and touch: the wheel glides, a touchpad moves exactly, a drag
 * (touch, or the middle button) goes on with its momentum; the first button selects, and
 * follows links. */
#include "read_desk.h"

#include <math.h>

#define GLIDE_S 0.07     /* in which the wheel's way is done but for 1/e */
#define MOMENTUM_S 0.325 /* in which a drag's speed is 1/e */
#define WHEEL_LINES 3

/* ---- scrolling ---- */

/* By whole pixels, so that what stays is only moved; the rest is carried over. */
void read_hand_scroll(struct read_desk *d, double px)
{
    const double all = d->rest_px + px, whole = trunc(all);
    d->rest_px = all - whole;
    if (!d->view || whole == 0)
        return;
    reader_view_scroll(d->view, whole);
    read_page_changed(d);
}

static gboolean tick(GtkWidget *widget, GdkFrameClock *clock, gpointer data)
{
    struct read_desk *d = data;
    const gint64 now_us = gdk_frame_clock_get_frame_time(clock);
    const double dt = d->tick_us ? fmin(0.1, (double)(now_us - d->tick_us) * 1e-6) : 1.0 / 60;
    (void)widget;
    d->tick_us = now_us;
    const double glided = d->glide_px * -expm1(-dt / GLIDE_S),
                 carried = d->speed_px_s * MOMENTUM_S * -expm1(-dt / MOMENTUM_S);
    d->glide_px -= glided;
    d->speed_px_s *= exp(-dt / MOMENTUM_S);
    const bool done = fabs(d->glide_px) < 0.5 && fabs(d->speed_px_s) < 8;
    read_hand_scroll(d, glided + carried + (done ? d->glide_px : 0));
    if (!done)
        return G_SOURCE_CONTINUE;
    d->glide_px = d->speed_px_s = 0;
    d->tick = 0;
    return G_SOURCE_REMOVE;
}

static void tick_begin(struct read_desk *d)
{
    if (d->tick)
        return;
    d->tick_us = 0;
    d->tick = gtk_widget_add_tick_callback(d->page, tick, d, NULL);
}

void read_hand_glide(struct read_desk *d, double px)
{
    d->glide_px += px;
    d->speed_px_s = 0;
    tick_begin(d);
}

static gboolean scrolled(GtkEventControllerScroll *scroll, double x, double y,
                         struct read_desk *d)
{
    const GdkModifierType state =
        gtk_event_controller_get_current_event_state(GTK_EVENT_CONTROLLER(scroll));
    (void)x;
    if (state & GDK_CONTROL_MASK)
        read_look_size(d, d->size_px * pow(1.08, -y));
    else if (gtk_event_controller_scroll_get_unit(scroll) == GDK_SCROLL_UNIT_WHEEL)
        read_hand_glide(d, y * WHEEL_LINES * d->size_px * d->setup.leading);
    else {
        d->glide_px = d->speed_px_s = 0;
        read_hand_scroll(d, y);
    }
    return TRUE;
}

static void decelerated(GtkEventControllerScroll *scroll, double vx, double vy,
                        struct read_desk *d)
{
    (void)scroll;
    (void)vx;
    d->speed_px_s = vy;
    tick_begin(d);
}

/* ---- dragging the page ---- */

static double event_s(GtkGesture *gesture)
{
    return gtk_event_controller_get_current_event_time(GTK_EVENT_CONTROLLER(gesture)) * 1e-3;
}

static void drag_begin(GtkGestureDrag *gesture, double x, double y, struct read_desk *d)
{
    (void)x;
    (void)y;
    d->glide_px = d->speed_px_s = 0;
    d->drag_y = 0;
    d->drag_s = event_s(GTK_GESTURE(gesture));
}

static void drag_update(GtkGestureDrag *gesture, double x, double y, struct read_desk *d)
{
    const double now = event_s(GTK_GESTURE(gesture)), moved = d->drag_y - y;
    (void)x;
    if (now > d->drag_s)
        d->speed_px_s = 0.4 * d->speed_px_s + 0.6 * moved / (now - d->drag_s);
    d->drag_y = y;
    d->drag_s = now;
    if (read_stages_holds(d)) /* a finger drags what is in it, and not the page */
        d->speed_px_s = 0;
    else
        read_hand_scroll(d, moved);
}

static void drag_end(GtkGestureDrag *gesture, double x, double y, struct read_desk *d)
{
    (void)x;
    (void)y;
    if (event_s(GTK_GESTURE(gesture)) - d->drag_s > 0.1) /* it was held still */
        d->speed_px_s = 0;
    tick_begin(d);
}

static void drag_attach(struct read_desk *d, guint button, bool touch)
{
    GtkGesture *drag = gtk_gesture_drag_new();
    gtk_gesture_single_set_button(GTK_GESTURE_SINGLE(drag), button);
    gtk_gesture_single_set_touch_only(GTK_GESTURE_SINGLE(drag), touch);
    g_signal_connect(drag, "drag-begin", G_CALLBACK(drag_begin), d);
    g_signal_connect(drag, "drag-update", G_CALLBACK(drag_update), d);
    g_signal_connect(drag, "drag-end", G_CALLBACK(drag_end), d);
    gtk_widget_add_controller(d->page, GTK_EVENT_CONTROLLER(drag));
}

/* ---- selecting ---- */

void read_hand_press(struct read_desk *d, double x, double y, int times)
{
    bool inside;
    size_t byte;
    d->glide_px = d->speed_px_s = 0;
    d->dragging = false;
    gtk_widget_grab_focus(d->page);
    if (read_grid_press(d, x) || read_stages_press(d, x, y) ||
        read_edit_press(d, x, y, times, false))
        return;
    if (!d->view || !reader_view_hit(d->view, x, y, &byte, &inside))
        return;
    d->select_from = byte;
    d->selected = (struct read_range){0, 0};
    if (times == 2)
        d->selected = read_text_word(d, byte);
    else if (times >= 3) {
        const struct reader_block *block = reader_document_block(d->document, byte);
        d->selected = (struct read_range){block->at, block->at + (size_t)block->bytes};
    }
    d->dragging = times == 1;
    read_page_changed(d);
}

void read_hand_move(struct read_desk *d, double x, double y)
{
    bool inside;
    size_t byte;
    d->pointer_x = x;
    d->pointer_y = y;
    if (read_grid_move(d, x))
        return;
    if (!d->dragging && read_stages_move(d, x, y)) {
        gtk_widget_set_cursor_from_name(d->page, "default");
        return;
    }
    if (read_edit_drag(d, x, y))
        return;
    if (!d->view || !reader_view_hit(d->view, x, y, &byte, &inside))
        return;
    if (d->dragging) {
        d->selected = (struct read_range){MIN(byte, d->select_from), MAX(byte, d->select_from)};
        if (y < 0 || y > d->setup.height_px) /* the page follows */
            read_hand_scroll(d, y < 0 ? y / 4 : (y - d->setup.height_px) / 4);
        read_page_changed(d);
        return;
    }
    const struct reader_span *span = inside ? reader_document_span(d->document, byte) : NULL;
    const bool leads = span && (span->look & (READER_LINK | READER_NOTE));
    gtk_widget_set_cursor_from_name(d->page, leads ? "pointer" : "text");
    gtk_widget_set_tooltip_text(d->page,
                                leads && (span->look & READER_LINK) ? span->target : NULL);
}

void read_hand_release(struct read_desk *d, double x, double y)
{
    bool inside;
    size_t byte;
    if (read_grid_release(d) || read_stages_release(d, x, y))
        return;
    const bool clicked =
        d->dragging && !read_edit_on(d) && d->selected.begin == d->selected.end;
    d->dragging = false;
    if (clicked && d->view && reader_view_hit(d->view, x, y, &byte, &inside) && inside &&
        !read_document_follow(d, byte)) {
        const int index = read_remarks_at(d, byte);
        if (index >= 0 && reader_remarks_get(d->remarks, index)->kind == READER_REMARK_TYPED)
            read_remarks_edit(d, index);
    }
    d->acted(d);
}

/* With a tool the buttons of a mouse and a pen are read_pen.c's, a finger's touch is here. */
static bool is_tools(const struct read_desk *d, GdkEvent *event)
{
    return d->tool != READ_TOOL_READ && event &&
           gdk_event_get_event_type(event) != GDK_TOUCH_BEGIN &&
           gdk_event_get_event_type(event) != GDK_TOUCH_END;
}

static void pressed(GtkGestureClick *click, int times, double x, double y, struct read_desk *d)
{
    GtkEventController *controller = GTK_EVENT_CONTROLLER(click);
    const GdkModifierType state = gtk_event_controller_get_current_event_state(controller);
    const guint32 now_ms = gtk_event_controller_get_current_event_time(controller);
    bool inside;
    size_t byte;
    if (is_tools(d, gtk_event_controller_get_current_event(controller)))
        return;
    if (d->tool != READ_TOOL_READ) {
        gtk_widget_grab_focus(d->page);
        d->eraser = false;
        read_ink_press(d, x, y, READ_MOUSE_PRESSURE, now_ms * 1e-3, state & GDK_SHIFT_MASK);
        return;
    }
    if (times == 1 && (state & GDK_SHIFT_MASK) && read_edit_press(d, x, y, 1, true))
        return;
    if ((state & GDK_CONTROL_MASK) && read_edit_on(d) &&
        reader_view_hit(d->view, x, y, &byte, &inside) && inside &&
        read_document_follow(d, byte))
        return;
    read_hand_press(d, x, y, times);
}

static void released(GtkGestureClick *click, int times, double x, double y, struct read_desk *d)
{
    (void)times;
    if (is_tools(d, gtk_event_controller_get_current_event(GTK_EVENT_CONTROLLER(click))))
        return;
    if (d->tool == READ_TOOL_READ)
        read_hand_release(d, x, y);
    else
        read_ink_release(d, x, y);
}

static void moved(GtkEventControllerMotion *motion, double x, double y, struct read_desk *d)
{
    (void)motion;
    if (d->tool == READ_TOOL_READ)
        read_hand_move(d, x, y);
}

void read_hand_attach(struct read_desk *d)
{
    GtkEventController *scroll = gtk_event_controller_scroll_new(
        GTK_EVENT_CONTROLLER_SCROLL_BOTH_AXES | GTK_EVENT_CONTROLLER_SCROLL_KINETIC);
    GtkEventController *motion = gtk_event_controller_motion_new();
    GtkGesture *click = gtk_gesture_click_new();
    g_signal_connect(scroll, "scroll", G_CALLBACK(scrolled), d);
    g_signal_connect(scroll, "decelerate", G_CALLBACK(decelerated), d);
    g_signal_connect(motion, "motion", G_CALLBACK(moved), d);
    gtk_gesture_single_set_button(GTK_GESTURE_SINGLE(click), GDK_BUTTON_PRIMARY);
    g_signal_connect(click, "pressed", G_CALLBACK(pressed), d);
    g_signal_connect(click, "released", G_CALLBACK(released), d);
    gtk_widget_add_controller(d->page, scroll);
    gtk_widget_add_controller(d->page, motion);
    gtk_widget_add_controller(d->page, GTK_EVENT_CONTROLLER(click));
    drag_attach(d, GDK_BUTTON_MIDDLE, false);
    drag_attach(d, GDK_BUTTON_PRIMARY, true);
    read_pen_attach(d); /* hears before them */
}
