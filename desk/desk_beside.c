/* desk_beside.c - a moment beside the one that is painted on: the picture of when it was kept,
 * in a canvas of its own at the left, seen as the sheet is seen: at the same zoom, turned and
 * mirrored alike, around the same place. Nothing can be done to it. */
#include "desk.h"

struct desk_beside {
    GtkWidget *box, *area, *text;
    struct desk_gl *gl;
    struct studio_picture picture; /* its pixels are its own; NULL: none */
    bool fresh;                    /* not given to OpenGL yet */
    bool due;                      /* it is kept once it is seen */
};

static void beside_draw(void *context, int scale, struct studio_rectangle *drawn)
{
    struct desk *d = context;
    struct desk_beside *b = d->beside;
    struct studio_view view = d->view;
    if (!b->gl || !b->picture.pixels) {
        if (drawn)
            *drawn = (struct studio_rectangle){0};
        return;
    }
    if (b->fresh)
        desk_gl_picture(b->gl, &b->picture);
    b->fresh = false;
    view.width = gtk_widget_get_width(b->area);
    view.height = gtk_widget_get_height(b->area);
    desk_gl_sheet(b->gl, &view, scale, drawn);
}

static void beside_realize(GtkGLArea *area, struct desk *d)
{
    char *why = NULL;
    gtk_gl_area_make_current(area);
    if (!gtk_gl_area_get_error(area))
        d->beside->gl = desk_gl_create(&why);
    g_free(why); /* the canvas has told it */
    d->beside->fresh = true;
}

static void beside_unrealize(GtkGLArea *area, struct desk *d)
{
    gtk_gl_area_make_current(area);
    desk_gl_destroy(d->beside->gl);
    d->beside->gl = NULL;
}

GtkWidget *desk_beside_new(struct desk *d)
{
    struct desk_beside *b = d->beside = g_new0(struct desk_beside, 1);
    b->box = gtk_overlay_new(); /* its canvas is as high as the sheet's */
    b->area = desk_area_new(beside_draw, d);
    b->text = gtk_label_new("");
    gtk_widget_set_hexpand(b->area, TRUE);
    gtk_widget_set_vexpand(b->area, TRUE);
    gtk_widget_set_size_request(b->area, 240, 200);
    gtk_widget_set_margin_end(b->box, 4);
    desk_name(b->area, _("The moment beside"), NULL);
    g_signal_connect(b->area, "realize", G_CALLBACK(beside_realize), d);
    g_signal_connect(b->area, "unrealize", G_CALLBACK(beside_unrealize), d);
    gtk_overlay_set_child(GTK_OVERLAY(b->box), b->area);
    gtk_overlay_add_overlay(GTK_OVERLAY(b->box), b->text);
    gtk_widget_add_css_class(b->text, "osd");
    gtk_widget_set_halign(b->text, GTK_ALIGN_CENTER);
    gtk_widget_set_valign(b->text, GTK_ALIGN_START);
    gtk_widget_set_visible(b->box, FALSE);
    return b->box;
}

void desk_beside_show(struct desk *d)
{
    if (d->beside && d->beside->picture.pixels)
        gtk_gl_area_queue_render(GTK_GL_AREA(d->beside->area));
}

void desk_beside_drop(struct desk *d)
{
    g_free(d->beside->picture.pixels);
    d->beside->picture = (struct studio_picture){0};
    d->beside->due = false;
    gtk_widget_set_visible(d->beside->box, FALSE);
}

void desk_beside_free(struct desk *d)
{
    if (d->beside)
        g_free(d->beside->picture.pixels);
    g_free(d->beside);
    d->beside = NULL;
}

/* The name of the moment that is seen. */
static char *moment_name(const struct desk *d)
{
    const int done = d->report.deeds_done;
    const char *name = done > 0 && done <= d->past.count ? d->past.deeds[done - 1].name : "";
    if (name[0])
        return g_strdup_printf(_("Beside: %s, step %ld"), name, d->report.steps);
    return g_strdup_printf(_("Beside: after deed %d, step %ld"), done, d->report.steps);
}

void desk_beside_keep(struct desk *d)
{
    const bool other = !d->beside->picture.pixels && !d->beside->due;
    desk_beside_drop(d);
    d->beside->due = other;
    desk_beside_look(d);
}

bool desk_beside_due(const struct desk *d)
{
    return d->beside->due;
}

/* What was asked for before, another moment say, is seen first. */
void desk_beside_look(struct desk *d)
{
    struct desk_beside *b = d->beside;
    if (!b->due || !d->seen.pixels || !d->report.looked ||
        d->report.answered < studio_paper_sent(d->paper))
        return;
    const size_t bytes = STUDIO_PIXEL * (size_t)d->seen.width * (size_t)d->seen.height;
    char *text = moment_name(d);
    b->due = false;
    b->picture = d->seen;
    b->picture.pixels = g_memdup2(d->seen.pixels, bytes);
    b->fresh = true;
    gtk_label_set_text(GTK_LABEL(b->text), text);
    g_free(text);
    gtk_widget_set_visible(b->box, TRUE);
    desk_beside_show(d);
}
