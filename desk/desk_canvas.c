/* desk_canvas.c - the sheet in the window: when it is drawn, what of the hand's way is still a
 * ghost, how it is zoomed. */
#include "desk.h"

#include <math.h>
#include <visible_text.h>

#define LASSO_PX 0.8 /* half the width of its line */

void desk_canvas_show(struct desk *d)
{
    if (d->window)
        gtk_gl_area_queue_render(GTK_GL_AREA(d->canvas));
}

void desk_canvas_changed(struct desk *d)
{
    char text[160];
    const double degrees = d->view.turn * 180 / G_PI;
    snprintf(text, sizeof text, "%.0f %%", 100 * d->view.zoom);
    if (fabs(degrees) > 0.05 || d->view.mirrored)
        snprintf(text, sizeof text, "%.0f %% · %.0f°%s", 100 * d->view.zoom, degrees,
                 d->view.mirrored ? _(" mirrored") : "");
    gtk_label_set_text(GTK_LABEL(d->place), text);
    desk_beside_show(d);
    desk_canvas_show(d);
}

/* ---- the ghost ---- */

void desk_ghost_add(struct desk *d, unsigned long number, double x, double y, bool begins)
{
    struct desk_ghost ghost = {
        .number = number, .x = x, .y = y, .radius = desk_cursor_radius(d), .begins = begins};
    const enum studio_tool_number tool = desk_tool(d);
    const bool lasso = tool == STUDIO_TOOL_SELECT &&
                       (int)d->settings.value[STUDIO_OUTLINE] == STUDIO_OUTLINE_LASSO;
    desk_tool_color(d, ghost.rgb);
    if (lasso)
        ghost.radius = LASSO_PX / d->view.zoom;
    if (studio_tools[tool].swept || tool == STUDIO_TOOL_DROP || lasso)
        g_array_append_val(d->ghost, ghost);
}

void desk_ghost_forget(struct desk *d, unsigned long heard)
{
    guint done = 0;
    while (done < d->ghost->len &&
           g_array_index(d->ghost, struct desk_ghost, done).number <= heard)
        done++;
    if (done == 0)
        return;
    g_array_remove_range(d->ghost, 0, done);
    if (d->ghost->len > 0)
        g_array_index(d->ghost, struct desk_ghost, 0).begins = true;
}

/* ---- drawing ---- */

void desk_canvas_look(struct desk *d)
{
    struct studio_shown shown;
    if (!d->gl)
        return;
    gtk_gl_area_make_current(GTK_GL_AREA(d->canvas));
    const struct studio_picture *picture = studio_paper_picture(d->paper);
    if (picture) {
        const bool other = d->seen.width != picture->width || d->seen.height != picture->height;
        d->seen = *picture;
        if (!desk_gl_picture(d->gl, picture))
            desk_say(d, _("This sheet is larger than the graphics card can show."));
        desk_ghost_forget(d, picture->heard);
        if (other || !d->viewed) {
            studio_view_fit(&d->view, picture->width, picture->height);
            d->viewed = true;
            desk_canvas_changed(d);
        }
    }
    if (studio_paper_shown(d->paper, &shown))
        desk_gl_shown(d->gl, &shown);
}

static void canvas_draw(void *context, int scale, struct studio_rectangle *drawn)
{
    struct desk *d = context;
    if (!d->gl) {
        if (drawn)
            *drawn = (struct studio_rectangle){0};
        return;
    }
    desk_gl_draw(d->gl, d, scale, drawn);
    desk_measure_drawn(d);
}

static void canvas_realize(GtkGLArea *area, struct desk *d)
{
    char *why = NULL;
    gtk_gl_area_make_current(area);
    const GError *error = gtk_gl_area_get_error(area);
    if (error)
        why = g_strdup(error->message);
    else
        d->gl = desk_gl_create(&why);
    if (!why) {
        d->look(d); /* there may be a picture already */
        return;
    }
    visible_say(_("lutetia studio: no OpenGL 3.2 for the sheet: %s; install libgl1-mesa-dri, "
                  "which draws without a graphics card"),
                why);
    g_free(why);
    d->status = 1;
    g_application_quit(G_APPLICATION(d->application));
}

static void canvas_unrealize(GtkGLArea *area, struct desk *d)
{
    gtk_gl_area_make_current(area);
    desk_gl_destroy(d->gl);
    d->gl = NULL;
    d->seen = (struct studio_picture){0};
}

static void canvas_resize(GtkGLArea *area, int width, int height, struct desk *d)
{
    (void)width;
    (void)height;
    d->view.width = gtk_widget_get_width(GTK_WIDGET(area));
    d->view.height = gtk_widget_get_height(GTK_WIDGET(area));
    if (d->viewed && d->seen.width && d->view.turn == 0 && !d->view.mirrored &&
        d->view.zoom < 1)
        studio_view_fit(&d->view, d->seen.width, d->seen.height);
    desk_beside_show(d);
}

/* ---- zoom ---- */

static gboolean canvas_scroll(GtkEventControllerScroll *scroll, double x, double y,
                              struct desk *d)
{
    const GdkModifierType state =
        gtk_event_controller_get_current_event_state(GTK_EVENT_CONTROLLER(scroll));
    const double line = 48;
    if ((state & GDK_CONTROL_MASK) && (state & GDK_SHIFT_MASK))
        studio_view_turn(&d->view, y * G_PI / 36, d->pointer_x, d->pointer_y);
    else if (state & GDK_CONTROL_MASK)
        studio_view_zoom(&d->view, pow(1.15, -y), d->pointer_x, d->pointer_y);
    else
        studio_view_pan(&d->view, -line * (state & GDK_SHIFT_MASK ? y : x),
                        -line * (state & GDK_SHIFT_MASK ? x : y));
    desk_canvas_changed(d);
    return TRUE;
}

GtkWidget *desk_canvas_new(struct desk *d)
{
    d->canvas = desk_area_new(canvas_draw, d);
    d->ghost = g_array_new(FALSE, FALSE, sizeof(struct desk_ghost));
    gtk_widget_set_hexpand(d->canvas, TRUE);
    gtk_widget_set_vexpand(d->canvas, TRUE);
    gtk_widget_set_size_request(d->canvas, 240, 200);
    gtk_widget_set_focusable(d->canvas, TRUE);
    gtk_widget_set_cursor_from_name(d->canvas, "none");
    desk_name(d->canvas, _("The sheet"), NULL);
    g_signal_connect(d->canvas, "realize", G_CALLBACK(canvas_realize), d);
    g_signal_connect(d->canvas, "unrealize", G_CALLBACK(canvas_unrealize), d);
    g_signal_connect(d->canvas, "resize", G_CALLBACK(canvas_resize), d);
    GtkEventController *scroll =
        gtk_event_controller_scroll_new(GTK_EVENT_CONTROLLER_SCROLL_BOTH_AXES);
    g_signal_connect(scroll, "scroll", G_CALLBACK(canvas_scroll), d);
    gtk_widget_add_controller(d->canvas, scroll);
    return d->canvas;
}
