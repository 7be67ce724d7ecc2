/* read_layers.c - readers' layers of notes and ink: which are shown, and which one is
 * written. */
#include "read_desk.h"

#include <string.h>

/* Others are marked, listed, possible. */
static void changed(struct read_desk *d)
{
    d->listed(d);
    read_page_changed(d);
    d->acted(d);
}

void read_layers_begin(struct read_desk *d)
{
    for (int i = 1; i < reader_remarks_layers(d->remarks); i++)
        if (strcmp(reader_remarks_layer(d->remarks, i), g_get_real_name()) == 0)
            reader_remarks_write_layer(d->remarks, i);
    read_layers_kept(d);
    reader_remarks_write_layer(d->remarks, reader_remarks_written(d->remarks)); /* is seen */
}

void read_layers_show(struct read_desk *d, int layer, bool shown)
{
    reader_remarks_layer_show(d->remarks, layer, shown);
    if (!shown && layer == reader_remarks_written(d->remarks)) /* what is written is seen */
        reader_remarks_layer_show(d->remarks, layer, true);
    read_layers_keep(d);
    read_text_around(d);
    changed(d);
}

void read_layers_write(struct read_desk *d, const char *name)
{
    int layer = 0;
    if (!d->remarks) {
        d->say(d, _("Notes are not kept for this document."));
        return;
    }
    if (*name && reader_remarks_layer_add(d->remarks, name, &layer) != READER_OK) {
        d->say(d, reader_error());
        return;
    }
    reader_remarks_write_layer(d->remarks, layer);
    read_layers_keep(d);
    changed(d);
}

/* ---- the small window ---- */

struct opened {
    struct read_desk *desk;
    GtkWidget *popover, *entry;
};

static int layer_of(GtkWidget *button)
{
    return GPOINTER_TO_INT(g_object_get_data(G_OBJECT(button), "layer"));
}

static void shown_toggled(GtkCheckButton *button, struct opened *o)
{
    if (!o->desk->remarks)
        return;
    const int layer = layer_of(GTK_WIDGET(button));
    read_layers_show(o->desk, layer, gtk_check_button_get_active(button));
    gtk_check_button_set_active(button, reader_remarks_layer_shown(o->desk->remarks, layer));
}

static void written_toggled(GtkCheckButton *button, struct opened *o)
{
    if (o->desk->remarks && gtk_check_button_get_active(button))
        read_layers_write(o->desk,
                          reader_remarks_layer(o->desk->remarks, layer_of(GTK_WIDGET(button))));
}

static void added(GtkEntry *entry, struct opened *o)
{
    read_layers_write(o->desk, gtk_editable_get_text(GTK_EDITABLE(entry)));
    gtk_popover_popdown(GTK_POPOVER(o->popover));
}

static void closed(GtkPopover *popover, struct opened *o)
{
    (void)popover;
    o->desk->layers = NULL;
    desk_popover_drop_later(o->popover);
}

static GtkWidget *check_add(struct opened *o, GtkWidget *grid, int layer, int column,
                            const char *label, bool active, GCallback toggled)
{
    GtkWidget *check = gtk_check_button_new_with_label(label);
    gtk_check_button_set_active(GTK_CHECK_BUTTON(check), active);
    g_object_set_data(G_OBJECT(check), "layer", GINT_TO_POINTER(layer));
    if (toggled)
        g_signal_connect(check, "toggled", toggled, o);
    gtk_grid_attach(GTK_GRID(grid), check, column, layer, 1, 1);
    return check;
}

static void rows_add(struct opened *o, GtkWidget *grid)
{
    const struct reader_remarks *remarks = o->desk->remarks;
    GtkWidget *first = NULL;
    for (int i = 0; i < reader_remarks_layers(remarks); i++) {
        const char *name = reader_remarks_layer(remarks, i);
        check_add(o, grid, i, 0, *name ? name : _("Without a name"),
                  reader_remarks_layer_shown(remarks, i), G_CALLBACK(shown_toggled));
        GtkWidget *check = check_add(o, grid, i, 1, _("is written"), false, NULL);
        gtk_check_button_set_group(GTK_CHECK_BUTTON(check), GTK_CHECK_BUTTON(first));
        first = first ? first : check;
        gtk_check_button_set_active(GTK_CHECK_BUTTON(check),
                                    i == reader_remarks_written(remarks));
        g_signal_connect(check, "toggled", G_CALLBACK(written_toggled), o);
    }
}

void read_layers_open(struct read_desk *d)
{
    if (d->layers) { /* the same key closes it */
        gtk_popover_popdown(GTK_POPOVER(d->layers));
        return;
    }
    if (!d->remarks) {
        d->say(d, _("Notes are not kept for this document."));
        return;
    }
    struct opened *o = g_new0(struct opened, 1);
    GtkWidget *all = gtk_box_new(GTK_ORIENTATION_VERTICAL, 6), *grid = gtk_grid_new();
    *o = (struct opened){d, gtk_popover_new(), gtk_entry_new()};
    gtk_grid_set_column_spacing(GTK_GRID(grid), 12);
    rows_add(o, grid);
    gtk_entry_set_placeholder_text(GTK_ENTRY(o->entry), _("Another reader's name"));
    desk_name(o->entry, _("A new layer's name"), NULL);
    gtk_box_append(GTK_BOX(all), grid);
    gtk_box_append(GTK_BOX(all), o->entry);
    gtk_popover_set_child(GTK_POPOVER(o->popover), all);
    gtk_widget_set_parent(o->popover, gtk_widget_get_parent(d->page));
    gtk_popover_set_pointing_to(
        GTK_POPOVER(o->popover),
        &(const GdkRectangle){gtk_widget_get_width(d->page) / 2, 10, 1, 1});
    g_object_set_data_full(G_OBJECT(o->popover), "owner", o, g_free);
    g_signal_connect(o->entry, "activate", G_CALLBACK(added), o);
    g_signal_connect(o->popover, "closed", G_CALLBACK(closed), o);
    d->layers = o->popover;
    gtk_popover_popup(GTK_POPOVER(o->popover));
}
