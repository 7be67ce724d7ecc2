/* read_watch.c - files of the document that other programs change are noticed. */
#include "read_desk.h"

enum { SETTLED_MS = 150 }; /* without another change: then it is written */

struct watched {
    struct read_desk *desk;
    void (*changed)(struct read_desk *d);
};

static gboolean settled(gpointer data)
{
    struct watched *w = data;
    w->desk->reloading = 0;
    w->changed(w->desk);
    return G_SOURCE_REMOVE;
}

static void file_changed(GFileMonitor *monitor, GFile *file, GFile *other,
                         GFileMonitorEvent event, struct watched *w)
{
    (void)monitor;
    (void)file;
    (void)other;
    if (event == G_FILE_MONITOR_EVENT_DELETED ||
        event == G_FILE_MONITOR_EVENT_ATTRIBUTE_CHANGED)
        return; /* what takes its place is told, too */
    if (w->desk->reloading)
        g_source_remove(w->desk->reloading);
    w->desk->reloading = g_timeout_add(SETTLED_MS, settled, w);
}

void read_watch_begin(struct read_desk *d, void (*changed)(struct read_desk *d))
{
    read_watch_end(d);
    for (int i = 0; i < d->files.count; i++) {
        GFile *file = g_file_new_for_path(d->files.paths[i]);
        GFileMonitor *monitor =
            g_file_monitor_file(file, G_FILE_MONITOR_WATCH_MOVES, NULL, NULL);
        g_object_unref(file);
        if (!monitor)
            continue;
        struct watched *w = g_new0(struct watched, 1);
        *w = (struct watched){d, changed};
        g_object_set_data_full(G_OBJECT(monitor), "watched", w, g_free);
        g_signal_connect(monitor, "changed", G_CALLBACK(file_changed), w);
        g_ptr_array_add(d->watches, monitor);
    }
}

void read_watch_end(struct read_desk *d)
{
    if (d->reloading)
        g_source_remove(d->reloading);
    d->reloading = 0;
    g_ptr_array_set_size(d->watches, 0);
}
