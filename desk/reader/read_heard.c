/* read_heard.c - the page's text for screen readers: GTK 4.8 lets only labels say their text,
 * so each passage that is seen has one that is not drawn, where the passage is. */
#include "read_desk.h"

enum { SOON_MS = 120, HEARD_MAX = 200 };

/* What a passage says, and the notes that are open in it. */
static char *passage_text(const struct read_desk *d, const struct reader_shown *shown)
{
    const struct reader_document *doc = d->document;
    GString *all =
        g_string_new_len(doc->plain + shown->begin, (gssize)(shown->end - shown->begin));
    for (int i = 0; i < doc->notes_count; i++) {
        const struct reader_note *note = &doc->notes[i];
        if (reader_view_note_passage(d->view, i) != shown->passage)
            continue;
        g_string_append_printf(all, "\n%d", i + 1);
        for (int k = note->first_block; k < note->first_block + note->blocks_count; k++)
            g_string_append_printf(all, " %s", doc->note_blocks[k].text);
    }
    return g_string_free(all, FALSE);
}

static GtkWidget *label_at(struct read_desk *d, guint i)
{
    while (d->heard->len <= i) {
        GtkWidget *label = gtk_label_new(NULL);
        gtk_label_set_wrap(GTK_LABEL(label), TRUE);
        gtk_widget_set_can_target(label, FALSE);
        gtk_widget_set_parent(label, d->page);
        g_ptr_array_add(d->heard, label);
    }
    return g_ptr_array_index(d->heard, i);
}

static gboolean heard_fill(gpointer data)
{
    struct read_desk *d = data;
    const struct reader_shown *shown;
    int count = 0;
    guint used = 0;
    d->hearing = 0;
    if (!d->page || !d->view || reader_view_look(d->view, &shown, &count) != READER_OK)
        return G_SOURCE_REMOVE;
    d->choices_say(d);
    for (int i = 0; i < count && used < HEARD_MAX; i++) {
        const bool heading =
            reader_document_block(d->document, shown[i].begin)->kind == READER_HEADING;
        char *text = passage_text(d, &shown[i]);
        GtkWidget *label = label_at(d, used++);
        gtk_label_set_text(GTK_LABEL(label), text);
        gtk_accessible_update_property(GTK_ACCESSIBLE(label),
                                       GTK_ACCESSIBLE_PROPERTY_DESCRIPTION,
                                       heading ? _("Heading") : "", -1);
        gtk_widget_set_child_visible(label, TRUE);
        g_free(text);
    }
    for (guint i = used; i < d->heard->len; i++) {
        gtk_label_set_text(GTK_LABEL(label_at(d, i)), "");
        gtk_widget_set_child_visible(label_at(d, i), FALSE);
    }
    gtk_widget_queue_allocate(d->page);
    return G_SOURCE_REMOVE;
}

void read_heard_changed(struct read_desk *d)
{
    if (!d->hearing)
        d->hearing = g_timeout_add(SOON_MS, heard_fill, d);
}

void read_heard_place(struct read_desk *d)
{
    const struct reader_shown *shown;
    int count = 0;
    if (!d->view || reader_view_look(d->view, &shown, &count) != READER_OK)
        return;
    for (guint i = 0; i < d->heard->len; i++) {
        GtkWidget *label = g_ptr_array_index(d->heard, i);
        int least = 0, natural = 0;
        gtk_widget_measure(label, GTK_ORIENTATION_VERTICAL, (int)d->setup.width_px, &least,
                           &natural, NULL, NULL);
        const bool seen = (int)i < count;
        const GtkAllocation box = {0, seen ? (int)shown[i].y_px : -least,
                                   (int)MAX(d->setup.width_px, 180),
                                   MAX(least, seen ? (int)MIN(shown[i].height_px, 30000) : 1)};
        gtk_widget_size_allocate(label, &box, -1);
    }
}

void read_heard_finish(struct read_desk *d)
{
    if (d->hearing)
        g_source_remove(d->hearing);
    if (d->barring)
        g_source_remove(d->barring);
    d->hearing = d->barring = 0;
    g_clear_pointer(&d->heard_chosen, g_free);
}
