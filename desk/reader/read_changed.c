/* read_changed.c - what follows when the page is other: it is drawn, heard, and the scrollbar
 * shows where it is. */
#include "read_desk.h"

#include <math.h>

/* Before the next picture, and not while one is drawn. */
static gboolean scrollbar_set(gpointer data)
{
    struct read_desk *d = data;
    const struct reader_shown *shown;
    double above, all;
    int count;
    d->barring = 0;
    if (!d->page || !d->view || reader_view_look(d->view, &shown, &count) != READER_OK)
        return G_SOURCE_REMOVE;
    reader_view_extent(d->view, &above, &all);
    d->moving = true;
    gtk_adjustment_configure(gtk_scrollbar_get_adjustment(GTK_SCROLLBAR(d->scrollbar)), above,
                             0, fmax(all, d->setup.height_px), 40, d->setup.height_px * 0.9,
                             d->setup.height_px);
    d->moving = false;
    d->placed(d);
    return G_SOURCE_REMOVE;
}

void read_page_changed(struct read_desk *d)
{
    if (!d->page)
        return;
    if (!d->barring)
        d->barring = g_idle_add_full(G_PRIORITY_DEFAULT, scrollbar_set, d, NULL);
    gtk_widget_queue_draw(d->page);
    read_heard_changed(d);
    read_stages_changed(d);
}
