/* desk_name.c - names of controls: see desk_shared.h. */
#include "desk_shared.h"

void desk_name(GtkWidget *widget, const char *name, const char *tip)
{
    /* Later drop-downs are labelled by what is chosen in them, which is their value. */
    gtk_accessible_reset_relation(GTK_ACCESSIBLE(widget), GTK_ACCESSIBLE_RELATION_LABELLED_BY);
    gtk_accessible_update_property(GTK_ACCESSIBLE(widget), GTK_ACCESSIBLE_PROPERTY_LABEL, name,
                                   -1);
    gtk_widget_set_tooltip_text(widget, tip);
}

void desk_name_bars(GtkWidget *scrolled, const char *name)
{
    GtkScrolledWindow *window = GTK_SCROLLED_WINDOW(scrolled);
    desk_name(gtk_scrolled_window_get_hscrollbar(window), name, NULL);
    desk_name(gtk_scrolled_window_get_vscrollbar(window), name, NULL);
}
