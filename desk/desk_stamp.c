/* desk_stamp.c - pictures that are put on the sheet: choosing one, the stencil under the
 * pointer. */
#include "desk.h"

#include <math.h>

/* ---- the stencil ---- */

static void show_send(struct desk *d, bool anew)
{
    d->stamp_due = false;
    d->stamp_sent = studio_paper_send(
        d->paper, (struct studio_message){.kind = STUDIO_MESSAGE_STAMP_SHOW,
                                          .text = g_strdup(d->stamp_seen ? d->stamp : ""),
                                          .value = anew});
}

bool desk_stamps(const struct desk *d)
{
    return (int)d->settings.value[STUDIO_TOOL] == STUDIO_TOOL_STAMP && d->stamp;
}

void desk_stamp_changed(struct desk *d)
{
    const bool seen = desk_stamps(d);
    if (!d->paper || (!seen && !d->stamp_seen))
        return;
    d->stamp_seen = seen;
    if (seen && d->report.answered < d->stamp_sent)
        d->stamp_due = true; /* a slider moves faster than large stencils are made */
    else
        show_send(d, false);
}

void desk_stamp_look(struct desk *d)
{
    if (d->stamp_due && d->report.answered >= d->stamp_sent)
        show_send(d, false);
}

void desk_stamp_put(struct desk *d, double x, double y)
{
    if (!d->stamp) {
        desk_say(d, _("Choose a picture first, or drop its file on the sheet."));
        return;
    }
    desk_measure_sent(
        d, studio_paper_send(d->paper, (struct studio_message){.kind = STUDIO_MESSAGE_STAMP,
                                                               .text = g_strdup(d->stamp),
                                                               .type_x = floor(x),
                                                               .type_y = floor(y)}));
}

/* ---- choosing ---- */

void desk_stamp_choose(struct desk *d, const char *path)
{
    char *name = g_path_get_basename(path), *shown = g_filename_display_name(name);
    g_free(d->stamp);
    d->stamp = g_strdup(path);
    gtk_label_set_text(GTK_LABEL(d->stamp_name), shown);
    g_free(shown);
    g_free(name);
    desk_set(d, STUDIO_TOOL, STUDIO_TOOL_STAMP);
    d->stamp_seen = true;
    show_send(d, true); /* it may have changed since it was read */
}

GtkWidget *desk_stamp_new(struct desk *d)
{
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 4),
              *choose = gtk_button_new_with_label(_("Choose a picture…"));
    d->stamp_name = gtk_label_new(_("no picture yet"));
    gtk_label_set_xalign(GTK_LABEL(d->stamp_name), 0);
    gtk_label_set_ellipsize(GTK_LABEL(d->stamp_name), PANGO_ELLIPSIZE_MIDDLE);
    desk_name(choose, _("Choose a picture…"),
              _("A PNG file: what is dark in it takes paint (Ctrl+I)"));
    gtk_actionable_set_action_name(GTK_ACTIONABLE(choose), "win.stamp");
    gtk_box_append(GTK_BOX(box), choose);
    gtk_box_append(GTK_BOX(box), d->stamp_name);
    return box;
}

static gboolean dropped(GtkDropTarget *target, const GValue *value, double x, double y,
                        gpointer data)
{
    char *path = g_file_get_path(g_value_get_object(value));
    (void)target;
    (void)x;
    (void)y;
    if (!path)
        desk_say(data, _("This is no file of this computer; take another place."));
    else
        desk_stamp_choose(data, path);
    const bool taken = path != NULL;
    g_free(path);
    return taken;
}

void desk_stamp_attach(struct desk *d)
{
    GtkDropTarget *target = gtk_drop_target_new(G_TYPE_FILE, GDK_ACTION_COPY);
    g_signal_connect(target, "drop", G_CALLBACK(dropped), d);
    gtk_widget_add_controller(d->canvas, GTK_EVENT_CONTROLLER(target));
}
