/* read_list.c - the list of what readers have left: highlights, notes, ink; what has gone from
 * the text is shown with its quotation. */
#include "read_desk.h"

static void row_chosen(GtkListBox *list, GtkListBoxRow *row, struct read_desk *d)
{
    const int index = GPOINTER_TO_INT(g_object_get_data(G_OBJECT(row), "index"));
    (void)list;
    if (!d->remarks || index >= reader_remarks_count(d->remarks))
        return;
    const struct reader_remark *r = reader_remarks_get(d->remarks, index);
    if (!r->orphan)
        read_document_go(d, r->begin);
    if (r->kind == READER_REMARK_TYPED)
        read_remarks_edit(d, index);
}

static char *row_text(const struct reader_remark *r)
{
    static const char *const kinds[] = {N_("Highlight"), N_("Note"), N_("Ink")};
    size_t bytes;
    const char *quoted = reader_anchor_quotation(r->anchor, &bytes);
    char *part = g_utf8_make_valid(quoted, (gssize)MIN(bytes, 60)),
         *headings = g_strdup(reader_anchor_headings(r->anchor));
    char *text = g_strdup_printf("%s%s%s%s: “%s”%s%s%s%s", r->by, *r->by ? " — " : "",
                                 r->orphan ? _("Gone from the text. ") : "", _(kinds[r->kind]),
                                 g_strdelimit(part, "\n", ' '), r->text[0] ? " — " : "",
                                 r->text, r->orphan ? " · " : "", r->orphan ? headings : "");
    g_free(headings);
    g_free(part);
    return text;
}

void read_list_fill(struct read_desk *d)
{
    GtkWidget *row;
    if (!d->remarks_list || !d->page)
        return;
    while ((row = gtk_widget_get_first_child(d->remarks_list)))
        gtk_list_box_remove(GTK_LIST_BOX(d->remarks_list), row);
    for (int i = 0; d->remarks && i < reader_remarks_count(d->remarks); i++) {
        const struct reader_remark *r = reader_remarks_get(d->remarks, i);
        if (!reader_remark_seen(r))
            continue;
        char *text = row_text(r);
        GtkWidget *label = gtk_label_new(text);
        gtk_label_set_xalign(GTK_LABEL(label), 0);
        gtk_label_set_wrap(GTK_LABEL(label), TRUE);
        gtk_label_set_max_width_chars(GTK_LABEL(label), 28);
        row = gtk_list_box_row_new();
        gtk_list_box_row_set_child(GTK_LIST_BOX_ROW(row), label);
        desk_name(row, text, NULL);
        g_object_set_data(G_OBJECT(row), "index", GINT_TO_POINTER(i));
        gtk_list_box_append(GTK_LIST_BOX(d->remarks_list), row);
        g_free(text);
    }
}

GtkWidget *read_list_new(struct read_desk *d)
{
    d->remarks_list = gtk_list_box_new();
    gtk_list_box_set_activate_on_single_click(GTK_LIST_BOX(d->remarks_list), TRUE);
    gtk_widget_add_css_class(d->remarks_list, "navigation-sidebar");
    desk_name(d->remarks_list, _("Notes"), NULL);
    g_signal_connect(d->remarks_list, "row-activated", G_CALLBACK(row_chosen), d);
    return d->remarks_list;
}
