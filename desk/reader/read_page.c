/* read_page.c - the page: a widget that shows a reader_view and what is marked in it. Its
 * children are labels that are not drawn, for screen readers (read_heard.c), and what belongs
 * to demonstrations (read_stages.c). */
#include "read_desk.h"

#include <math.h>

struct _ReadPage {
    GtkWidget parent;
    struct read_desk *desk;
};
G_DECLARE_FINAL_TYPE(ReadPage, read_page, READ, PAGE, GtkWidget)
G_DEFINE_TYPE(ReadPage, read_page, GTK_TYPE_WIDGET)

enum { MARKS_MAX = 2000 };

static void range_mark(struct read_desk *d, struct read_range range, const double *rgb,
                       GArray *marks)
{
    struct reader_box boxes[256];
    if (range.begin >= range.end || marks->len >= MARKS_MAX)
        return;
    int count = reader_view_boxes(d->view, range.begin, range.end, boxes, G_N_ELEMENTS(boxes));
    for (int i = 0; i < MIN(count, (int)G_N_ELEMENTS(boxes)); i++)
        g_array_append_val(marks, ((struct read_mark){boxes[i], rgb}));
}

/* seen: the bytes of passages in the window. */
static void hits_mark(struct read_desk *d, struct read_range seen, GArray *marks)
{
    const size_t notes =
        d->document->note_blocks_count ? d->document->note_blocks[0].at : G_MAXSIZE;
    for (guint i = 0; i < d->hits->len; i++) {
        const struct read_range hit = g_array_index(d->hits, struct read_range, i);
        /* notes stand elsewhere than their bytes */
        if (hit.begin < notes && (hit.end <= seen.begin || hit.begin >= seen.end))
            continue;
        range_mark(d, hit, (int)i == d->hit ? d->colours->current : d->colours->found, marks);
    }
}

static void remarks_mark(struct read_desk *d, GArray *marks)
{
    for (int i = 0; d->remarks && i < reader_remarks_count(d->remarks); i++) {
        const struct reader_remark *r = reader_remarks_get(d->remarks, i);
        if (r->kind != READER_REMARK_INK && reader_remark_seen(r) && !r->orphan)
            range_mark(d, (struct read_range){r->begin, r->end},
                       r->kind == READER_REMARK_TYPED ? d->colours->noted : d->colours->marked,
                       marks);
    }
}

static void focus_draw(struct read_desk *d, GtkSnapshot *snapshot)
{
    const struct reader_span *span =
        d->focused == G_MAXSIZE ? NULL : reader_document_span(d->document, d->focused);
    const struct reader_block *block =
        span ? reader_document_block(d->document, d->focused) : NULL;
    struct reader_box boxes[16];
    if (!span || read_stages_is(block) || !gtk_widget_has_focus(d->page))
        return;
    const int count = reader_view_boxes(d->view, block->at + (size_t)span->begin,
                                        block->at + (size_t)span->end, boxes, 16);
    const double *c = d->colours->link;
    const GdkRGBA rgba = {(float)c[0], (float)c[1], (float)c[2], 1};
    for (int i = 0; i < MIN(count, 16); i++) {
        GskRoundedRect outline;
        gsk_rounded_rect_init_from_rect(
            &outline,
            &GRAPHENE_RECT_INIT((float)boxes[i].x - 2, (float)boxes[i].y - 1,
                                (float)boxes[i].width + 4, (float)boxes[i].height + 2),
            3);
        gtk_snapshot_append_border(snapshot, &outline, (const float[]){2, 2, 2, 2},
                                   (const GdkRGBA[]){rgba, rgba, rgba, rgba});
    }
}

static void page_snapshot(GtkWidget *widget, GtkSnapshot *snapshot)
{
    struct read_desk *d = ((ReadPage *)widget)->desk;
    const double *c = d->colours->paper;
    const struct reader_shown *shown;
    int count;
    const float width = (float)gtk_widget_get_width(widget),
                height = (float)gtk_widget_get_height(widget);
    const GdkRGBA paper = {(float)c[0], (float)c[1], (float)c[2], 1};
    gtk_snapshot_append_color(snapshot, &paper, &GRAPHENE_RECT_INIT(0, 0, width, height));
    if (!d->view || reader_view_look(d->view, &shown, &count) != READER_OK)
        return;
    GArray *marks = g_array_new(FALSE, FALSE, sizeof(struct read_mark));
    remarks_mark(d, marks);
    if (count)
        hits_mark(d, (struct read_range){shown[0].begin, shown[count - 1].end}, marks);
    range_mark(d, d->selected, d->colours->selected, marks);
    gtk_snapshot_push_clip(snapshot, &GRAPHENE_RECT_INIT(0, 0, width, height));
    read_tiles_draw(d, snapshot, shown, count, (const struct read_mark *)(void *)marks->data,
                    (int)marks->len, gtk_widget_get_scale_factor(widget));
    read_stages_draw(d, snapshot);
    read_ink_draw(d, snapshot);
    focus_draw(d, snapshot);
    read_edit_draw(d, snapshot);
    read_grid_draw(d, snapshot);
    gtk_snapshot_pop(snapshot);
    g_array_free(marks, TRUE);
}

static void page_measure(GtkWidget *widget, GtkOrientation orientation, int for_size,
                         int *least, int *natural, int *least_baseline, int *natural_baseline)
{
    (void)widget;
    (void)for_size;
    *least = 180;
    *natural = orientation == GTK_ORIENTATION_HORIZONTAL ? 800 : 700;
    *least_baseline = *natural_baseline = -1;
}

static void page_allocate(GtkWidget *widget, int width, int height, int baseline)
{
    struct read_desk *d = ((ReadPage *)widget)->desk;
    (void)baseline;
    d->resized(d, width, height);
    read_heard_place(d);
    read_stages_place(d);
}

static void page_dispose(GObject *object)
{
    GtkWidget *child;
    while ((child = gtk_widget_get_first_child(GTK_WIDGET(object))))
        gtk_widget_unparent(child);
    G_OBJECT_CLASS(read_page_parent_class)->dispose(object);
}

static void read_page_class_init(ReadPageClass *class)
{
    GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);
    G_OBJECT_CLASS(class)->dispose = page_dispose;
    widget->snapshot = page_snapshot;
    widget->measure = page_measure;
    widget->size_allocate = page_allocate;
    gtk_widget_class_set_accessible_role(widget, GTK_ACCESSIBLE_ROLE_GROUP);
}

static void read_page_init(ReadPage *page)
{
    (void)page;
}

GtkWidget *read_page_new(struct read_desk *d)
{
    d->page = g_object_new(read_page_get_type(), NULL);
    ((ReadPage *)(void *)d->page)->desk = d;
    gtk_widget_set_hexpand(d->page, TRUE);
    gtk_widget_set_vexpand(d->page, TRUE);
    gtk_widget_set_focusable(d->page, TRUE);
    gtk_widget_set_overflow(d->page, GTK_OVERFLOW_HIDDEN);
    desk_name(d->page, _("The page"), NULL);
    return d->page;
}
