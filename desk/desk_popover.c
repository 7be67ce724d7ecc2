/* desk_popover.c - small windows that are made when they open: see desk_shared.h. */
#include "desk_shared.h"

/* With its window it has gone already. */
static gboolean drop(gpointer popover)
{
    if (gtk_widget_get_parent(popover))
        gtk_widget_unparent(popover);
    return G_SOURCE_REMOVE;
}

void desk_popover_drop_later(GtkWidget *popover)
{
    g_idle_add_full(G_PRIORITY_DEFAULT_IDLE, drop, g_object_ref(popover), g_object_unref);
}

void desk_popover_end(GtkWidget *popover)
{
    g_object_ref(popover);
    gtk_popover_popdown(GTK_POPOVER(popover));
    drop(popover);
    g_object_unref(popover);
}
