/* read_contents.c - the contents: the headings of the document, beside the page. Of several
 * files all have their first heading in it, and the one that is being read has all of its
 * own. */
#include "read_desk.h"

/* What a row leads to. */
struct entry {
    size_t byte;
    int source;
    bool first; /* of its source */
};

static const struct entry *entry_of(GtkWidget *row)
{
    return g_object_get_data(G_OBJECT(row), "entry");
}

static void chosen(GtkListBox *list, GtkListBoxRow *row, struct read_desk *d)
{
    (void)list;
    read_document_go(d, entry_of(GTK_WIDGET(row))->byte);
    gtk_widget_grab_focus(d->page);
}

static GtkWidget *row_new(const struct reader_block *block, bool first)
{
    GtkWidget *row = gtk_list_box_row_new(), *label = gtk_label_new(block->text);
    struct entry *entry = g_new0(struct entry, 1);
    *entry = (struct entry){block->at, block->source, first};
    gtk_label_set_xalign(GTK_LABEL(label), 0);
    gtk_label_set_ellipsize(GTK_LABEL(label), PANGO_ELLIPSIZE_END);
    gtk_widget_set_tooltip_text(label, block->text);
    gtk_widget_set_margin_start(label, 6 + 14 * (block->level - 1));
    gtk_list_box_row_set_child(GTK_LIST_BOX_ROW(row), label);
    desk_name(row, block->text ? block->text : "", NULL);
    g_object_set_data_full(G_OBJECT(row), "entry", entry, g_free);
    return row;
}

static void rows_make(struct read_desk *d)
{
    int source = -1;
    for (int i = 0; i < d->document->blocks_count; i++) {
        const struct reader_block *block = &d->document->blocks[i];
        if (block->kind != READER_HEADING)
            continue;
        gtk_list_box_append(GTK_LIST_BOX(d->contents), row_new(block, block->source != source));
        source = block->source;
    }
}

/* The heading that stands last at or before what is being read; all of its file are seen. */
void read_contents_follow(struct read_desk *d)
{
    size_t top = 0;
    GtkWidget *here = NULL;
    if (!d->view || !d->document || !gtk_widget_get_visible(d->contents_side) ||
        reader_view_top(d->view, &top) != READER_OK)
        return;
    const struct reader_block *block = reader_document_block(d->document, top);
    const int source = block ? block->source : 0;
    const bool other = source != d->contents_source;
    for (GtkWidget *row = gtk_widget_get_first_child(d->contents); row;
         row = gtk_widget_get_next_sibling(row)) {
        const struct entry *entry = entry_of(row);
        if (other)
            gtk_widget_set_visible(row, entry->first || entry->source == source);
        if (entry->byte <= top)
            here = row;
    }
    d->contents_source = source;
    if (here)
        gtk_list_box_select_row(GTK_LIST_BOX(d->contents), GTK_LIST_BOX_ROW(here));
    else
        gtk_list_box_unselect_all(GTK_LIST_BOX(d->contents));
}

/* Rows are made once somebody wants to see them: a manual has a thousand. */
void read_contents_fill(struct read_desk *d)
{
    GtkWidget *row;
    while ((row = gtk_widget_get_first_child(d->contents)))
        gtk_list_box_remove(GTK_LIST_BOX(d->contents), row);
    d->contents_source = -1;
    if (gtk_widget_get_visible(d->contents_side) && d->document)
        rows_make(d);
    read_contents_follow(d);
}

void read_contents_toggle(struct read_desk *d)
{
    gtk_widget_set_visible(d->contents_side, !gtk_widget_get_visible(d->contents_side));
    read_contents_fill(d);
}

GtkWidget *read_contents_new(struct read_desk *d)
{
    d->contents_side = gtk_scrolled_window_new();
    d->contents = gtk_list_box_new();
    gtk_widget_set_size_request(d->contents_side, 230, -1);
    gtk_scrolled_window_set_policy(GTK_SCROLLED_WINDOW(d->contents_side), GTK_POLICY_NEVER,
                                   GTK_POLICY_AUTOMATIC);
    gtk_list_box_set_activate_on_single_click(GTK_LIST_BOX(d->contents), TRUE);
    gtk_widget_add_css_class(d->contents, "navigation-sidebar");
    desk_name(d->contents, _("Contents"), NULL);
    g_signal_connect(d->contents, "row-activated", G_CALLBACK(chosen), d);
    GtkWidget *both = gtk_box_new(GTK_ORIENTATION_VERTICAL, 6),
              *notes = gtk_label_new(_("Notes"));
    gtk_widget_add_css_class(notes, "heading");
    gtk_label_set_xalign(GTK_LABEL(notes), 0);
    gtk_widget_set_margin_start(notes, 12);
    gtk_box_append(GTK_BOX(both), d->contents);
    gtk_box_append(GTK_BOX(both), notes);
    gtk_box_append(GTK_BOX(both), read_list_new(d));
    gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(d->contents_side), both);
    desk_name_bars(d->contents_side, _("Scrolls the contents"));
    gtk_widget_set_visible(d->contents_side, FALSE);
    return d->contents_side;
}
