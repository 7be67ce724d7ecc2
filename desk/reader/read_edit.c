/* read_edit.c - editing in the page: the mode, changes of the document, and what follows them.
 * What is typed becomes a change of the source by reader_edit.h. */
#include "read_edit.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

enum { FILL_MS = 300 };

struct read_editing *read_edit_create(void)
{
    struct read_editing *e = g_new0(struct read_editing, 1);
    e->saved = g_ptr_array_new_with_free_func((GDestroyNotify)(void (*)(void))g_bytes_unref);
    e->want_x = -1;
    e->type = read_edit_type;
    e->erase = read_edit_delete;
    return e;
}

void read_edit_destroy(struct read_editing *e)
{
    if (e->filling)
        g_source_remove(e->filling);
    if (e->blink)
        g_source_remove(e->blink);
    reader_edit_destroy(e->edit);
    g_ptr_array_unref(e->saved);
    g_clear_object(&e->im);
    g_free(e->preedit);
    g_free(e);
}

bool read_edit_on(const struct read_desk *d)
{
    return d->editing->on;
}

/* ---- the mode ---- */

void read_edit_document(struct read_desk *d)
{
    struct read_editing *e = d->editing;
    reader_edit_destroy(e->edit);
    e->edit = NULL;
    if (!d->document || reader_edit_create(&d->document, &d->files, d->remarks, &e->edit))
        return;
    e->caret = MIN(e->caret, d->document->plain_bytes);
    e->from = e->caret;
    g_ptr_array_set_size(e->saved, 0);
    for (int i = 0; i < d->files.count; i++)
        g_ptr_array_add(e->saved, g_bytes_new(d->files.texts[i].text, d->files.texts[i].bytes));
}

/* Why it cannot be edited; NULL: it can. Owns: the caller frees it. */
static char *why_not(const struct read_desk *d)
{
    if (read_document_is_manual(d))
        return g_strdup(_("The manual is not edited."));
    for (int i = 0; i < d->files.count; i++)
        if (!d->files.whole[i] || access(d->files.whole[i], W_OK) != 0)
            return g_strdup_printf(_("%s can only be read: it is not edited."),
                                   d->files.paths[i]);
    return NULL;
}

void read_edit_toggle(struct read_desk *d)
{
    struct read_editing *e = d->editing;
    size_t top = 0;
    char *why = e->on || !e->edit ? NULL : why_not(d);
    if (why || !e->edit) {
        if (why)
            d->say(d, why);
        g_free(why);
        return;
    }
    e->on = !e->on;
    reader_edit_wait_end(e->edit);
    read_edit_im_begin(d);
    read_edit_blink(d, e->on);
    d->focused = G_MAXSIZE;
    if (e->on && reader_view_top(d->view, &top) == READER_OK) {
        const struct read_range selected = d->selected;
        read_edit_caret(d, selected.end > selected.begin ? selected.end : top, false, false);
        if (selected.end > selected.begin) {
            e->from = selected.begin;
            d->selected = selected;
        }
    }
    gtk_widget_grab_focus(d->page);
    read_page_changed(d);
    d->titled(d);
    d->acted(d);
}

/* ---- the caret ---- */

struct read_range read_edit_range(const struct read_desk *d)
{
    const struct read_editing *e = d->editing;
    return (struct read_range){MIN(e->caret, e->from), MAX(e->caret, e->from)};
}

void read_edit_caret(struct read_desk *d, size_t byte, bool before, bool select)
{
    struct read_editing *e = d->editing;
    const struct reader_block *b = reader_document_block(d->document, byte);
    if (b)
        byte = CLAMP(byte, b->at, b->at + (size_t)b->bytes);
    if (byte != e->caret || !select)
        reader_edit_wait_end(e->edit);
    e->caret = byte;
    e->before = before;
    e->want_x = -1;
    if (!select)
        e->from = byte;
    reader_edit_part(e->edit);
    d->selected = read_edit_range(d);
    read_edit_blink(d, e->on);
    read_page_changed(d);
    read_edit_im_place(d);
    d->acted(d);
}

void read_edit_select(struct read_desk *d, struct read_range range)
{
    if (!d->editing->on)
        return;
    d->editing->from = range.begin;
    read_edit_caret(d, range.end, true, true);
}

/* ---- what follows ---- */

static gboolean contents_fill(gpointer data)
{
    struct read_desk *d = data;
    d->editing->filling = 0;
    if (d->page && d->document)
        d->refilled(d);
    return G_SOURCE_REMOVE;
}

static void ranges_move(struct read_desk *d, const struct reader_edit_change *change)
{
    for (guint i = 0; i < d->hits->len; i++) {
        struct read_range *hit = &g_array_index(d->hits, struct read_range, i);
        hit->begin = reader_edit_moved(change, hit->begin);
        hit->end = MAX(hit->begin, reader_edit_moved(change, hit->end));
    }
    for (guint i = 0; i < d->way->len; i++) {
        struct read_place *place = &g_array_index(d->way, struct read_place, i);
        if (place->paths == d->options.paths)
            place->byte = MIN(reader_edit_moved(change, place->byte), d->document->plain_bytes);
    }
    d->focused = G_MAXSIZE;
}

void read_edit_changed(struct read_desk *d, enum reader_status status,
                       struct reader_edit_change *change)
{
    struct read_editing *e = d->editing;
    const bool changed = change->before || change->block >= 0;
    if (status != READER_OK)
        d->say(d, reader_error());
    if (changed) {
        read_document_edited(d, change);
        ranges_move(d, change);
        if (!e->filling)
            e->filling = g_timeout_add(FILL_MS, contents_fill, d);
        d->edited(d);
        d->titled(d);
    }
    if (changed || (status == READER_OK && change->caret != e->caret)) {
        const enum reader_edit_waits waits = reader_edit_waits(e->edit);
        e->caret = e->from = MIN(change->caret, d->document->plain_bytes);
        e->before = waits != READER_WAITS_NOTHING || (e->caret > 0 && change->block >= 0);
        e->want_x = -1;
        d->selected = read_edit_range(d);
    }
    reader_edit_change_finish(change);
    read_edit_blink(d, e->on);
    read_edit_wanted(d);
    read_page_changed(d);
    read_edit_im_place(d);
    d->acted(d);
}

/* ---- edits ---- */

void read_edit_delete(struct read_desk *d, size_t begin, size_t end)
{
    struct reader_edit_change change;
    const enum reader_status status = reader_edit_delete(d->editing->edit, begin, end, &change);
    read_edit_changed(d, status, &change);
}

void read_edit_break(struct read_desk *d)
{
    struct reader_edit_change change;
    const struct read_range range = read_edit_range(d);
    reader_edit_group(d->editing->edit, true);
    if (range.end > range.begin)
        read_edit_delete(d, range.begin, range.end);
    const enum reader_status status =
        reader_edit_break(d->editing->edit, d->editing->caret, &change);
    read_edit_changed(d, status, &change);
    reader_edit_group(d->editing->edit, false);
}

/* One line of what is typed; what is selected goes. False: it was said why not. */
static bool line_type(struct read_desk *d, const char *text, size_t bytes)
{
    struct read_editing *e = d->editing;
    struct reader_edit_change change;
    const struct read_range range = read_edit_range(d);
    enum reader_status status = READER_OK;
    if (range.end > range.begin) {
        status = reader_edit_insert(e->edit, range.begin, range.end, text, bytes, &change);
        if (status == READER_OK) {
            read_edit_changed(d, status, &change);
            return true;
        }
        reader_edit_change_finish(&change);
        read_edit_delete(d, range.begin, range.end);
        if (e->from != e->caret)
            return false;
    }
    status = reader_edit_insert(e->edit, e->caret, e->caret, text, bytes, &change);
    read_edit_changed(d, status, &change);
    return status == READER_OK;
}

void read_edit_type(struct read_desk *d, const char *text)
{
    struct read_editing *e = d->editing;
    const bool many = strchr(text, '\n') || e->from != e->caret;
    if (!e->on || !e->edit)
        return;
    if (many)
        reader_edit_group(e->edit, true);
    for (const char *at = text; *at;) {
        const size_t bytes = strcspn(at, "\r\n");
        if (bytes && !line_type(d, at, bytes))
            break;
        at += bytes;
        if (*at == '\r')
            at++;
        if (*at == '\n') {
            read_edit_break(d);
            at++;
        }
    }
    if (many)
        reader_edit_group(e->edit, false);
}

void read_edit_undo(struct read_desk *d, bool redo)
{
    struct reader_edit_change change = {0};
    bool more = true;
    while (more && reader_edit_can(d->editing->edit, redo)) {
        const enum reader_status status = reader_edit_undo(d->editing->edit, redo, &change);
        more = status == READER_OK && change.more;
        read_edit_changed(d, status, &change);
    }
}

bool read_edit_can(const struct read_desk *d, bool redo)
{
    return d->editing->edit && reader_edit_can(d->editing->edit, redo);
}

/* ---- the clipboard ---- */

void read_edit_cut(struct read_desk *d)
{
    const struct read_range range = read_edit_range(d);
    if (!d->editing->on || range.end <= range.begin)
        return;
    char *text = read_text_of(d, range);
    gdk_clipboard_set_text(gtk_widget_get_clipboard(d->page), text);
    g_free(text);
    read_edit_delete(d, range.begin, range.end);
}

static void pasted(GObject *clipboard, GAsyncResult *result, gpointer data)
{
    struct read_desk *d = data;
    char *text = gdk_clipboard_read_text_finish(GDK_CLIPBOARD(clipboard), result, NULL);
    if (text && d->page)
        read_edit_type(d, text);
    g_free(text);
}

void read_edit_paste(struct read_desk *d)
{
    if (d->editing->on)
        gdk_clipboard_read_text_async(gtk_widget_get_clipboard(d->page), NULL, pasted, d);
}

char *read_edit_told(struct read_desk *d)
{
    const struct read_editing *e = d->editing;
    struct reader_box box = {0};
    const size_t from = d->document ? MIN(e->caret, d->document->plain_bytes) : 0;
    char *near = g_strndup(d->document ? d->document->plain + from : "", 20);
    if (e->on)
        read_edit_caret_box(d, &box);
    char *told = g_strdup_printf(
        "editing %d\ncaret %zu %.0f %.0f\nat %s\nunsaved %d\npreedit %s\nprocess %d\n", e->on,
        e->caret, box.x, box.y, g_strdelimit(near, "\n", ' '), d->edits_needed(d),
        e->preedit ? e->preedit : "", (int)getpid());
    g_free(near);
    return told;
}

/* ---- replacing ---- */

void read_edit_replace(struct read_desk *d, const char *text, bool all)
{
    struct read_editing *e = d->editing;
    int replaced = 0;
    if (!e->on || !d->hits->len || d->hit < 0)
        return;
    reader_edit_group(e->edit, true);
    const int first = all ? 0 : d->hit, last = all ? (int)d->hits->len - 1 : d->hit;
    for (int i = last; i >= first; i--) {
        struct reader_edit_change change;
        const struct read_range hit = g_array_index(d->hits, struct read_range, i);
        const enum reader_status status =
            *text ? reader_edit_insert(e->edit, hit.begin, hit.end, text, strlen(text), &change)
                  : reader_edit_delete(e->edit, hit.begin, hit.end, &change);
        replaced += status == READER_OK;
        read_edit_changed(d, status, &change);
    }
    reader_edit_group(e->edit, false);
    if (all) {
        char *told = g_strdup_printf(_("%d of %d replaced"), replaced, last + 1);
        gtk_label_set_text(GTK_LABEL(d->search_told), told);
        g_free(told);
        g_array_set_size(d->hits, 0);
        d->hit = -1;
    } else {
        g_array_remove_index(d->hits, (guint)d->hit);
        d->hit = d->hits->len ? d->hit % (int)d->hits->len : -1;
    }
    read_page_changed(d);
}
