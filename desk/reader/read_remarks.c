/* read_remarks.c - the reader's highlights and typed notes, their list, and undo; all are kept
 * as they are made (reader_remarks.h). */
#include "read_desk.h"

#include <math.h>
#include <string.h>

enum { SYNC_MS = 900, TYPED_MS = 400 };

/* What can be undone: a remark as it was before, and after. */
struct read_deed {
    int index;
    enum { DEED_MADE, DEED_ERASED, DEED_ARRANGED, DEED_WRITTEN } kind;
    struct reader_arranged *arranged[2];
    int arranged_count;
    char *text[2];
    unsigned group; /* those of one number are undone together; 0: alone */
};

static void deed_clear(gpointer item)
{
    struct read_deed *deed = item;
    for (int k = 0; k < 2; k++) {
        g_free(deed->text[k]);
        g_free(deed->arranged[k]);
    }
}

/* ---- opening ---- */

static gboolean sync_now(gpointer data)
{
    struct read_desk *d = data;
    d->syncing = 0;
    if (d->remarks && reader_remarks_sync(d->remarks) != READER_OK)
        d->say(d, reader_error());
    return G_SOURCE_REMOVE;
}

/* After each change: shown, listed, soon safe. */
static void changed(struct read_desk *d)
{
    if (!d->syncing)
        d->syncing = g_timeout_add(SYNC_MS, sync_now, d);
    read_text_around(d);
    d->listed(d);
    read_page_changed(d);
    d->acted(d);
}

void read_remarks_open(struct read_desk *d, const char *file)
{
    read_remarks_close(d);
    d->remarks_path = g_strdup(file);
    if (reader_remarks_open(file, &d->remarks) != READER_OK)
        d->say(d, reader_error());
    else
        read_layers_begin(d);
    read_remarks_find(d);
}

void read_remarks_find(struct read_desk *d)
{
    if (d->remarks && reader_remarks_find(d->remarks, d->document->plain,
                                          d->document->plain_bytes) != READER_OK)
        d->say(d, reader_error());
    read_text_around(d);
    d->listed(d);
}

void read_remarks_close(struct read_desk *d)
{
    if (d->typing)
        desk_popover_end(d->typing);
    if (d->layers)
        desk_popover_end(d->layers);
    if (d->syncing)
        g_source_remove(d->syncing);
    d->syncing = 0;
    if (!d->deeds) {
        d->deeds = g_array_new(FALSE, FALSE, sizeof(struct read_deed));
        g_array_set_clear_func(d->deeds, deed_clear);
    }
    g_array_set_size(d->deeds, 0);
    d->deeds_done = 0;
    g_array_set_size(d->chosen, 0);
    d->laid = false;
    if (d->remarks && reader_remarks_sync(d->remarks) != READER_OK)
        d->say(d, reader_error());
    reader_remarks_close(d->remarks);
    d->remarks = NULL;
    g_clear_pointer(&d->remarks_path, g_free);
}

/* ---- undo ---- */

static void deed_keep(struct read_desk *d, struct read_deed deed)
{
    if (d->deeds_done < d->deeds->len)
        g_array_remove_range(d->deeds, d->deeds_done, d->deeds->len - d->deeds_done);
    deed.group = d->grouping ? d->group : 0;
    g_array_append_val(d->deeds, deed);
    d->deeds_done = d->deeds->len;
}

bool read_remarks_can(const struct read_desk *d, bool redo)
{
    return d->remarks && (redo ? d->deeds_done < d->deeds->len : d->deeds_done > 0);
}

void read_remarks_group(struct read_desk *d, bool begins)
{
    d->group += begins;
    d->grouping = begins;
}

static enum reader_status deed_do(struct read_desk *d, const struct read_deed *deed, bool redo)
{
    switch (deed->kind) {
    case DEED_MADE:
        return reader_remarks_erase(d->remarks, deed->index, !redo);
    case DEED_ERASED:
        return reader_remarks_erase(d->remarks, deed->index, redo);
    case DEED_ARRANGED:
        return reader_remarks_arrange(d->remarks, deed->arranged[redo], deed->arranged_count);
    case DEED_WRITTEN:
        return reader_remarks_write(d->remarks, deed->index, deed->text[redo]);
    }
    return READER_OK;
}

/* The one that would be undone, or done again, next. */
static const struct read_deed *deed_next(const struct read_desk *d, bool redo)
{
    return read_remarks_can(d, redo)
               ? &g_array_index(d->deeds, struct read_deed, d->deeds_done - (redo ? 0 : 1))
               : NULL;
}

void read_remarks_undo(struct read_desk *d, bool redo)
{
    const struct read_deed *deed = deed_next(d, redo);
    const unsigned group = deed ? deed->group : 0;
    enum reader_status status = READER_OK;
    if (!deed)
        return;
    do {
        status = deed_do(d, deed, redo);
        if (status == READER_OK)
            d->deeds_done += redo ? 1 : -1u;
        deed = deed_next(d, redo);
    } while (status == READER_OK && group && deed && deed->group == group);
    if (status != READER_OK)
        d->say(d, reader_error());
    changed(d);
}

/* ---- changes ---- */

int read_remarks_add(struct read_desk *d, const struct reader_remark *what, size_t begin,
                     size_t end)
{
    int index = -1;
    if (!d->remarks) {
        d->say(d, _("Notes are not kept for this document."));
        return -1;
    }
    if (reader_remarks_add(d->remarks, what, d->document->plain, d->document->plain_bytes,
                           begin, end, &index) != READER_OK) {
        d->say(d, reader_error());
        return -1;
    }
    deed_keep(d, (struct read_deed){.index = index, .kind = DEED_MADE});
    changed(d);
    return index;
}

void read_remarks_erase(struct read_desk *d, int index)
{
    if (reader_remarks_erase(d->remarks, index, true) == READER_OK)
        deed_keep(d, (struct read_deed){.index = index, .kind = DEED_ERASED});
    else
        d->say(d, reader_error());
    changed(d);
}

void read_remarks_arrange(struct read_desk *d, const struct reader_arranged *to, int count)
{
    struct read_deed deed = {.kind = DEED_ARRANGED, .arranged_count = count};
    for (int k = 0; k < 2; k++)
        deed.arranged[k] = g_new(struct reader_arranged, (gsize)count);
    for (int i = 0; i < count; i++) {
        deed.arranged[0][i] = reader_remarks_arranged(d->remarks, to[i].index);
        deed.arranged[1][i] = to[i];
    }
    if (reader_remarks_arrange(d->remarks, to, count) == READER_OK) {
        deed_keep(d, deed);
    } else {
        deed_clear(&deed);
        d->say(d, reader_error());
    }
    changed(d);
}

/* The highlight or typed note on a byte, the newest; -1: there is none. */
int read_remarks_at(const struct read_desk *d, size_t byte)
{
    for (int i = d->remarks ? reader_remarks_count(d->remarks) - 1 : -1; i >= 0; i--) {
        const struct reader_remark *r = reader_remarks_get(d->remarks, i);
        if (r->kind != READER_REMARK_INK && reader_remark_seen(r) && !r->orphan &&
            byte >= r->begin && byte < r->end)
            return i;
    }
    return -1;
}

/* What is selected, or the line that is being read. */
static struct read_range range_now(struct read_desk *d)
{
    struct read_range range = d->selected;
    if (range.begin >= range.end && reader_view_top(d->view, &range.begin) == READER_OK) {
        const struct reader_block *block = reader_document_block(d->document, range.begin);
        const size_t last = block->at + (size_t)block->bytes;
        range.end = MIN(range.begin + 24, last);
        while (range.end < last && (d->document->plain[range.end] & 0xc0) == 0x80)
            range.end++;
    }
    return range;
}

void read_remarks_highlight(struct read_desk *d)
{
    const unsigned yellow = 0xffe94cffu;
    const struct read_range range = range_now(d);
    if (range.begin < range.end)
        read_remarks_add(
            d, &(struct reader_remark){.kind = READER_REMARK_HIGHLIGHT, .rgba = yellow},
            range.begin, range.end);
    d->selected = (struct read_range){0, 0};
}

/* ---- typing ---- */

struct typing {
    struct read_desk *desk;
    int index;
    GtkWidget *popover, *text;
    guint source;
    char *before;
};

static char *typed_text(struct typing *t)
{
    GtkTextBuffer *buffer = gtk_text_view_get_buffer(GTK_TEXT_VIEW(t->text));
    GtkTextIter begin, end;
    gtk_text_buffer_get_bounds(buffer, &begin, &end);
    return gtk_text_buffer_get_text(buffer, &begin, &end, FALSE);
}

static gboolean typed_write(gpointer data)
{
    struct typing *t = data;
    char *text = typed_text(t);
    t->source = 0;
    if (t->desk->remarks && reader_remarks_write(t->desk->remarks, t->index, text) != READER_OK)
        t->desk->say(t->desk, reader_error());
    g_free(text);
    changed(t->desk);
    return G_SOURCE_REMOVE;
}

static void typed_changed(GtkTextBuffer *buffer, struct typing *t)
{
    (void)buffer;
    if (!t->source)
        t->source = g_timeout_add(TYPED_MS, typed_write, t);
}

/* One deed for all that was typed. */
static void typing_end(GtkPopover *popover, struct typing *t)
{
    struct read_desk *d = t->desk;
    (void)popover;
    if (t->source) {
        g_source_remove(t->source);
        typed_write(t);
    }
    char *text = typed_text(t);
    if (d->remarks && strcmp(text, t->before) != 0)
        deed_keep(d, (struct read_deed){.index = t->index,
                                        .kind = DEED_WRITTEN,
                                        .text = {g_strdup(t->before), g_strdup(text)}});
    g_free(text);
    g_free(t->before);
    t->before = NULL;
    d->typing = NULL;
    d->acted(d);
    desk_popover_drop_later(t->popover);
}

static void erase_clicked(GtkButton *button, struct typing *t)
{
    struct read_desk *d = t->desk;
    const int index = t->index;
    (void)button;
    gtk_popover_popdown(GTK_POPOVER(t->popover));
    read_remarks_erase(d, index);
}

/* A small window at the words. */
void read_remarks_edit(struct read_desk *d, int index)
{
    struct typing *t = g_new0(struct typing, 1);
    const struct reader_remark *r = reader_remarks_get(d->remarks, index);
    const bool own = r->layer == reader_remarks_written(d->remarks);
    struct reader_box box = {.x = d->setup.width_px / 2, .y = 40, .width = 1, .height = 1};
    GtkWidget *all = gtk_box_new(GTK_ORIENTATION_VERTICAL, 6),
              *erase = gtk_button_new_with_label(_("Erase this note")),
              *scrolled = gtk_scrolled_window_new();
    if (!r->orphan)
        reader_view_boxes(d->view, r->begin, r->begin + 1, &box, 1);
    *t = (struct typing){.desk = d,
                         .index = index,
                         .popover = gtk_popover_new(),
                         .text = gtk_text_view_new(),
                         .before = g_strdup(r->text)};
    GtkTextBuffer *buffer = gtk_text_view_get_buffer(GTK_TEXT_VIEW(t->text));
    gtk_text_buffer_set_text(buffer, r->text, -1);
    gtk_text_view_set_editable(GTK_TEXT_VIEW(t->text), own); /* others' are read */
    gtk_widget_set_sensitive(erase, own);
    gtk_text_view_set_wrap_mode(GTK_TEXT_VIEW(t->text), GTK_WRAP_WORD_CHAR);
    desk_name(t->text, _("What the note says"), NULL);
    gtk_widget_set_size_request(scrolled, 280, 120);
    gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scrolled), t->text);
    desk_name_bars(scrolled, _("Scrolls the note"));
    gtk_box_append(GTK_BOX(all), scrolled);
    gtk_box_append(GTK_BOX(all), erase);
    gtk_popover_set_child(GTK_POPOVER(t->popover), all);
    GtkWidget *beside = gtk_widget_get_parent(d->page); /* the page's own children are labels */
    gtk_widget_set_parent(t->popover, beside);
    graphene_point_t point;
    const graphene_point_t at = GRAPHENE_POINT_INIT((float)box.x, (float)box.y);
    if (!gtk_widget_compute_point(d->page, beside, &at, &point))
        point = at;
    const GdkRectangle where = {(int)point.x, (int)point.y, (int)fmax(1, box.width),
                                (int)fmax(1, box.height)};
    gtk_popover_set_pointing_to(GTK_POPOVER(t->popover), &where);
    g_object_set_data_full(G_OBJECT(t->popover), "owner", t, g_free);
    g_signal_connect(buffer, "changed", G_CALLBACK(typed_changed), t);
    g_signal_connect(erase, "clicked", G_CALLBACK(erase_clicked), t);
    g_signal_connect(t->popover, "closed", G_CALLBACK(typing_end), t);
    d->typing = t->popover;
    gtk_popover_popup(GTK_POPOVER(t->popover));
    gtk_widget_grab_focus(t->text);
}

void read_remarks_type(struct read_desk *d)
{
    const unsigned blue = 0x9fd0ffffu;
    const struct read_range range = range_now(d);
    if (range.begin >= range.end)
        return;
    const int index =
        read_remarks_add(d, &(struct reader_remark){.kind = READER_REMARK_TYPED, .rgba = blue},
                         range.begin, range.end);
    d->selected = (struct read_range){0, 0};
    if (index >= 0)
        read_remarks_edit(d, index);
}

void read_remarks_typed(struct read_desk *d, const char *text)
{
    const unsigned blue = 0x9fd0ffffu;
    const struct read_range range = range_now(d);
    char *copy = g_strdup(text);
    if (range.begin < range.end)
        read_remarks_add(
            d, &(struct reader_remark){.kind = READER_REMARK_TYPED, .rgba = blue, .text = copy},
            range.begin, range.end);
    g_free(copy);
    d->selected = (struct read_range){0, 0};
}

void read_remarks_finish(struct read_desk *d)
{
    read_remarks_close(d);
    g_array_free(d->deeds, TRUE);
    d->deeds = NULL;
}
