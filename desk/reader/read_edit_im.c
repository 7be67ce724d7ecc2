/* read_edit_im.c - the input method, whose letters are seen before they are there, and the
 * caret as it is drawn. */
#include "read_edit.h"

#include <math.h>
#include <string.h>

/* ---- where the caret is ---- */

/* Where the column of text begins that a point is in. */
static double column_x(const struct read_desk *d, double x)
{
    const struct reader_grid *grid = &d->setup.grid;
    double begins = grid->text[0].x;
    for (int i = 1; i < grid->texts; i++)
        if (x >= grid->text[i].x - d->size_px / 2)
            begins = grid->text[i].x;
    return begins;
}

bool read_edit_caret_box(struct read_desk *d, struct reader_box *box)
{
    const struct read_editing *e = d->editing;
    const struct reader_shown *shown;
    int count;
    if (reader_view_look(d->view, &shown, &count) != READER_OK)
        return false;
    if (!count) { /* an empty document */
        *box = (struct reader_box){0, d->setup.margin_px, d->setup.margin_px, 0,
                                   d->size_px * d->setup.leading};
        return true;
    }
    if (!reader_view_caret(d->view, e->caret, e->before, box))
        return false;
    switch (reader_edit_waits(e->edit)) {
    case READER_WAITS_NOTHING:
        break;
    case READER_WAITS_BLANK:
        box->x += 0.28 * d->size_px;
        break;
    case READER_WAITS_PARAGRAPH:
    case READER_WAITS_OUTSIDE:
        box->y += box->height;
        box->x = column_x(d, box->x);
        break;
    }
    return true;
}

void read_edit_wanted(struct read_desk *d)
{
    struct reader_box box;
    if (!read_edit_caret_box(d, &box)) {
        reader_view_go(d->view, d->editing->caret, floor(d->setup.height_px / 3));
        return;
    }
    const double line = d->size_px * d->setup.leading;
    if (box.y < 0)
        reader_view_scroll(d->view, floor(box.y - line / 2));
    else if (box.y + box.height > d->setup.height_px)
        reader_view_scroll(d->view, ceil(box.y + box.height - d->setup.height_px + line / 2));
}

/* ---- the input method ---- */

static void committed(GtkIMContext *im, const char *text, struct read_desk *d)
{
    (void)im;
    d->editing->type(d, text);
}

static void preedit_changed(GtkIMContext *im, struct read_desk *d)
{
    struct read_editing *e = d->editing;
    int caret;
    g_clear_pointer(&e->preedit, g_free);
    gtk_im_context_get_preedit_string(im, &e->preedit, NULL, &caret);
    e->preedit_caret = (int)(g_utf8_offset_to_pointer(e->preedit, caret) - e->preedit);
    read_page_changed(d);
}

static gboolean surrounding(GtkIMContext *im, struct read_desk *d)
{
    const struct reader_block *b = reader_document_block(d->document, d->editing->caret);
    if (!b)
        return FALSE;
    const size_t from = d->editing->caret > b->at ? d->editing->caret - b->at : 0;
    const int at = (int)MIN(from, (size_t)b->bytes);
    gtk_im_context_set_surrounding_with_selection(im, b->text, b->bytes, at, at);
    return TRUE;
}

static gboolean surrounding_delete(GtkIMContext *im, int offset, int count, struct read_desk *d)
{
    const struct reader_block *b = reader_document_block(d->document, d->editing->caret);
    (void)im;
    if (!b || d->editing->caret < b->at)
        return FALSE;
    const char *caret = d->document->plain + d->editing->caret,
               *begin = g_utf8_offset_to_pointer(caret, offset),
               *end = g_utf8_offset_to_pointer(begin, count),
               *first = d->document->plain + b->at;
    if (begin < first || end > first + b->bytes)
        return FALSE;
    d->editing->erase(d, (size_t)(begin - d->document->plain),
                      (size_t)(end - d->document->plain));
    return TRUE;
}

static void focus_in(GtkEventController *controller, struct read_desk *d)
{
    (void)controller;
    if (d->editing->on)
        gtk_im_context_focus_in(d->editing->im);
}

static void focus_out(GtkEventController *controller, struct read_desk *d)
{
    (void)controller;
    gtk_im_context_focus_out(d->editing->im);
}

static void im_make(struct read_desk *d)
{
    struct read_editing *e = d->editing;
    GtkEventController *focus = gtk_event_controller_focus_new();
    e->im = gtk_im_multicontext_new();
    gtk_im_context_set_client_widget(e->im, d->page);
    g_signal_connect(e->im, "commit", G_CALLBACK(committed), d);
    g_signal_connect(e->im, "preedit-changed", G_CALLBACK(preedit_changed), d);
    g_signal_connect(e->im, "retrieve-surrounding", G_CALLBACK(surrounding), d);
    g_signal_connect(e->im, "delete-surrounding", G_CALLBACK(surrounding_delete), d);
    g_signal_connect(focus, "enter", G_CALLBACK(focus_in), d);
    g_signal_connect(focus, "leave", G_CALLBACK(focus_out), d);
    gtk_widget_add_controller(d->page, focus);
}

void read_edit_im_begin(struct read_desk *d)
{
    struct read_editing *e = d->editing;
    if (!e->im)
        im_make(d);
    gtk_event_controller_key_set_im_context(GTK_EVENT_CONTROLLER_KEY(e->keys),
                                            e->on ? e->im : NULL);
    if (e->on)
        gtk_im_context_focus_in(e->im);
    else
        gtk_im_context_focus_out(e->im);
    gtk_im_context_reset(e->im);
}

void read_edit_im_place(struct read_desk *d)
{
    struct reader_box box;
    if (!d->editing->on || !d->editing->im || !read_edit_caret_box(d, &box))
        return;
    gtk_im_context_set_cursor_location(
        d->editing->im, &(GdkRectangle){(int)box.x, (int)box.y, 1, (int)fmax(1, box.height)});
}

void read_edit_keys_are(struct read_desk *d, GtkEventController *keys)
{
    d->editing->keys = keys;
}

void read_edit_preedit(struct read_desk *d, const char *text)
{
    struct read_editing *e = d->editing;
    g_free(e->preedit);
    e->preedit = g_strdup(text);
    e->preedit_caret = (int)strlen(text);
    read_page_changed(d);
}

/* ---- the caret as it is drawn ---- */

static gboolean blinked(gpointer data)
{
    struct read_desk *d = data;
    d->editing->hidden = !d->editing->hidden;
    if (d->page)
        gtk_widget_queue_draw(d->page);
    return G_SOURCE_CONTINUE;
}

void read_edit_blink(struct read_desk *d, bool on)
{
    struct read_editing *e = d->editing;
    gboolean blinks = FALSE;
    int time_ms = 0;
    if (e->blink)
        g_source_remove(e->blink);
    e->blink = 0;
    e->hidden = false;
    if (!on || d->play || !d->page)
        return; /* recorded input has the same picture each time */
    g_object_get(gtk_widget_get_settings(d->page), "gtk-cursor-blink", &blinks,
                 "gtk-cursor-blink-time", &time_ms, NULL);
    if (blinks)
        e->blink = g_timeout_add((guint)MAX(100, time_ms / 2), blinked, d);
}

/* What the input method has not given yet stands at the caret, underlined, over the text. */
static void preedit_draw(struct read_desk *d, GtkSnapshot *snapshot, struct reader_box *box)
{
    const struct read_editing *e = d->editing;
    const double *ink = d->colours->ink, *paper = d->colours->paper;
    PangoLayout *layout = gtk_widget_create_pango_layout(d->page, e->preedit);
    PangoAttrList *attributes = pango_attr_list_new();
    PangoRectangle where, caret;
    pango_attr_list_insert(attributes, pango_attr_underline_new(PANGO_UNDERLINE_SINGLE));
    pango_attr_list_insert(attributes,
                           pango_attr_size_new_absolute((int)(d->size_px * PANGO_SCALE)));
    pango_layout_set_attributes(layout, attributes);
    pango_attr_list_unref(attributes);
    pango_layout_get_pixel_extents(layout, NULL, &where);
    pango_layout_get_cursor_pos(layout, e->preedit_caret, &caret, NULL);
    const double x = fmax(0, fmin(box->x, d->setup.width_px - where.width));
    gtk_snapshot_append_color(
        snapshot, &(GdkRGBA){(float)paper[0], (float)paper[1], (float)paper[2], 1},
        &GRAPHENE_RECT_INIT((float)x, (float)box->y, (float)where.width, (float)box->height));
    gtk_snapshot_save(snapshot);
    gtk_snapshot_translate(
        snapshot,
        &GRAPHENE_POINT_INIT((float)x, (float)(box->y + (box->height - where.height) / 2)));
    gtk_snapshot_append_layout(snapshot, layout,
                               &(GdkRGBA){(float)ink[0], (float)ink[1], (float)ink[2], 1});
    gtk_snapshot_restore(snapshot);
    g_object_unref(layout);
    box->x = x + (double)caret.x / PANGO_SCALE;
}

void read_edit_draw(struct read_desk *d, GtkSnapshot *snapshot)
{
    const struct read_editing *e = d->editing;
    const double *c = d->colours->ink;
    struct reader_box box;
    if (!e->on || !read_edit_caret_box(d, &box))
        return;
    if (e->preedit && *e->preedit)
        preedit_draw(d, snapshot, &box);
    if (!e->hidden)
        gtk_snapshot_append_color(
            snapshot, &(GdkRGBA){(float)c[0], (float)c[1], (float)c[2], 1},
            &GRAPHENE_RECT_INIT((float)round(box.x), (float)box.y, 2, (float)box.height));
}
