/* read_search.c - what is found: all hits are marked, one is the current one. */
#include "read_desk.h"

#include <math.h>

enum { HITS_MAX = 10000 };

static void told_show(struct read_desk *d)
{
    char *text = NULL;
    const char *what = gtk_editable_get_text(GTK_EDITABLE(d->search_entry));
    if (d->hits->len)
        text = g_strdup_printf(_("%d of %u"), d->hit + 1, d->hits->len);
    else
        text = g_strdup(*what ? _("Not found") : "");
    gtk_label_set_text(GTK_LABEL(d->search_told), text);
    g_free(text);
}

/* A note that a hit is in is opened where it is called. */
static void note_open(struct read_desk *d, size_t byte)
{
    const struct reader_document *doc = d->document;
    const struct reader_block *block = reader_document_block(doc, byte);
    for (int i = 0; i < doc->notes_count; i++) {
        const struct reader_note *note = &doc->notes[i];
        const long at = block - (doc->note_blocks + note->first_block);
        if (note->blocks_count && block >= doc->note_blocks && at >= 0 &&
            at < note->blocks_count && !reader_view_note_open(d->view, i))
            reader_view_note(d->view, i, byte);
    }
}

static void hit_show(struct read_desk *d)
{
    struct reader_box box;
    const struct read_range hit = g_array_index(d->hits, struct read_range, d->hit);
    const struct reader_shown *shown;
    int seen;
    note_open(d, hit.begin);
    reader_view_look(d->view, &shown, &seen);
    const int count = reader_view_boxes(d->view, hit.begin, hit.end, &box, 1);
    if (count < 1 || box.y < 0 || box.y + box.height > d->setup.height_px)
        reader_view_go(d->view, hit.begin, floor(d->setup.height_px / 3));
    d->focused = G_MAXSIZE;
}

void read_search_text(struct read_desk *d, const char *text)
{
    struct read_range hit;
    size_t top = 0;
    g_array_set_size(d->hits, 0);
    d->hit = -1;
    if (!d->view)
        return;
    reader_view_top(d->view, &top);
    for (size_t from = 0;
         d->hits->len < HITS_MAX &&
         reader_document_search(d->document, text, from, true, &hit.begin, &hit.end);
         from = hit.end > hit.begin ? hit.end : hit.begin + 1) {
        if (d->hit < 0 && hit.begin >= top)
            d->hit = (int)d->hits->len;
        g_array_append_val(d->hits, hit);
    }
    if (d->hit < 0 && d->hits->len)
        d->hit = 0;
    if (d->hits->len)
        hit_show(d);
    told_show(d);
    read_page_changed(d);
    read_miniatures_changed(d);
}

void read_search_step(struct read_desk *d, bool forward)
{
    const int count = (int)d->hits->len;
    if (!count)
        return;
    d->hit = (d->hit + (forward ? 1 : count - 1)) % count;
    hit_show(d);
    told_show(d);
    read_page_changed(d);
}

void read_search_open(struct read_desk *d, bool open)
{
    gtk_search_bar_set_search_mode(GTK_SEARCH_BAR(d->search_bar), open);
    if (open)
        gtk_widget_grab_focus(d->search_entry);
}
