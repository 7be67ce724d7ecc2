/* desk_past.c - time under the hand: the deeds of the past as a row of small pictures, which is
 * dragged; and what can be done at the moment that is visited. The slider says the same to a
 * keyboard and to a screen reader. */
#include "desk.h"

enum {
    GAP = 6,
    CARD = STUDIO_SMALL_WIDTH + GAP,
    LABEL = 15,
    STRIP = STUDIO_SMALL_HEIGHT + LABEL + 2 * GAP
};

static void visit(struct desk *d, int deeds)
{
    if (deeds == d->past_sent || deeds < 0 || deeds > d->past.count)
        return;
    d->past_sent = deeds;
    desk_measure_sent(
        d, studio_paper_send(d->paper, (struct studio_message){.kind = STUDIO_MESSAGE_VISIT,
                                                               .value = deeds}));
}

void desk_past_move(struct desk *d, int by)
{
    d->past_sent = -1;
    visit(d, CLAMP(d->report.deeds_done + by, 0, d->past.count));
}

/* ---- the row of pictures ---- */

static void small_draw(cairo_t *cr, const struct studio_past_deed *deed, double x, double alpha)
{
    cairo_surface_t *surface =
        cairo_image_surface_create(CAIRO_FORMAT_RGB24, STUDIO_SMALL_WIDTH, STUDIO_SMALL_HEIGHT);
    unsigned char *rows = cairo_image_surface_get_data(surface);
    const int pitch_bytes = cairo_image_surface_get_stride(surface);
    for (int i = 0; rows && i < STUDIO_SMALL_WIDTH * STUDIO_SMALL_HEIGHT; i++) {
        const uint8_t *p = deed->rgb + 3 * i;
        const guint32 pixel = (guint32)p[0] << 16 | (guint32)p[1] << 8 | p[2];
        memcpy(rows + pitch_bytes * (i / STUDIO_SMALL_WIDTH) + 4 * (i % STUDIO_SMALL_WIDTH),
               &pixel, sizeof pixel);
    }
    cairo_surface_mark_dirty(surface);
    cairo_set_source_surface(cr, surface, x, GAP);
    cairo_paint_with_alpha(cr, alpha);
    cairo_surface_destroy(surface);
}

static void label_draw(struct desk *d, cairo_t *cr, const char *text, double x)
{
    PangoLayout *layout = gtk_widget_create_pango_layout(d->past_strip, text);
    PangoAttrList *attributes = pango_attr_list_new();
    pango_attr_list_insert(attributes, pango_attr_scale_new(PANGO_SCALE_SMALL));
    pango_layout_set_attributes(layout, attributes);
    pango_layout_set_width(layout, STUDIO_SMALL_WIDTH * PANGO_SCALE);
    pango_layout_set_alignment(layout, PANGO_ALIGN_CENTER);
    pango_layout_set_ellipsize(layout, PANGO_ELLIPSIZE_END);
    cairo_move_to(cr, x, GAP + STUDIO_SMALL_HEIGHT + 1);
    pango_cairo_show_layout(cr, layout);
    pango_attr_list_unref(attributes);
    g_object_unref(layout);
}

/* The paper's word for a deed, as a person says it. */
static const char *deed_name(const char *what)
{
    if (strcmp(what, "put") == 0)
        return _("ink"); /* a drop, or type */
    if (strcmp(what, "print") == 0)
        return _("picture"); /* a stamp in its own colours */
    return strcmp(what, "resist") == 0 ? _("mask") : _(what);
}

static void card_draw(struct desk *d, cairo_t *cr, const GdkRGBA *text, int number)
{
    const struct studio_past_deed *deed = number > 0 ? &d->past.deeds[number - 1] : NULL;
    const double x = GAP + CARD * number, alpha = number <= d->report.deeds_done ? 1 : 0.45;
    cairo_set_source_rgba(cr, (double)text->red, (double)text->green, (double)text->blue,
                          0.12 * alpha);
    cairo_rectangle(cr, x, GAP, STUDIO_SMALL_WIDTH, STUDIO_SMALL_HEIGHT);
    cairo_fill(cr);
    if (deed && deed->pictured)
        small_draw(cr, deed, x, alpha);
    cairo_set_source_rgba(cr, (double)text->red, (double)text->green, (double)text->blue,
                          alpha);
    label_draw(d, cr,
               !deed           ? _("empty")
               : deed->name[0] ? deed->name
                               : deed_name(deed->what),
               x);
    if (deed && deed->marked) { /* a ribbon at the corner */
        const double right = x + STUDIO_SMALL_WIDTH - 6;
        cairo_set_source_rgba(cr, 0.88, 0.2, 0.15, alpha);
        cairo_move_to(cr, right - 9, GAP - 3);
        cairo_line_to(cr, right, GAP - 3);
        cairo_line_to(cr, right, GAP + 14);
        cairo_line_to(cr, right - 4.5, GAP + 9);
        cairo_line_to(cr, right - 9, GAP + 14);
        cairo_close_path(cr);
        cairo_fill(cr);
    }
    if (number != d->report.deeds_done)
        return;
    cairo_set_source_rgb(cr, 0.21, 0.52, 0.89);
    cairo_set_line_width(cr, 3);
    cairo_rectangle(cr, x - 1.5, GAP - 1.5, STUDIO_SMALL_WIDTH + 3, STUDIO_SMALL_HEIGHT + 3);
    cairo_stroke(cr);
}

static void strip_draw(GtkDrawingArea *area, cairo_t *cr, int width, int height, gpointer data)
{
    struct desk *d = data;
    GdkRGBA text;
    double left, top, right, bottom;
    (void)width;
    (void)height;
    gtk_style_context_get_color(gtk_widget_get_style_context(GTK_WIDGET(area)), &text);
    cairo_clip_extents(cr, &left, &top, &right, &bottom);
    const int first = MAX(0, (int)(left / CARD) - 1),
              last = MIN(d->past.count, (int)(right / CARD) + 1);
    for (int i = first; i <= last; i++)
        card_draw(d, cr, &text, i);
}

static void strip_visit(struct desk *d, double x)
{
    visit(d, CLAMP((int)((x - GAP / 2.0) / CARD), 0, d->past.count));
}

static void drag_begun(GtkGestureDrag *gesture, double x, double y, struct desk *d)
{
    (void)gesture;
    (void)y;
    d->past_sent = -1;
    strip_visit(d, x);
}

static void dragged(GtkGestureDrag *gesture, double by_x, double by_y, struct desk *d)
{
    double x, y;
    (void)by_y;
    if (gtk_gesture_drag_get_start_point(gesture, &x, &y))
        strip_visit(d, x + by_x);
}

static GtkWidget *strip_new(struct desk *d)
{
    GtkWidget *scrolled = gtk_scrolled_window_new();
    GtkGesture *drag = gtk_gesture_drag_new();
    d->past_strip = gtk_drawing_area_new();
    gtk_drawing_area_set_content_height(GTK_DRAWING_AREA(d->past_strip), STRIP);
    gtk_drawing_area_set_draw_func(GTK_DRAWING_AREA(d->past_strip), strip_draw, d, NULL);
    desk_name(d->past_strip, _("The past as pictures"), NULL);
    g_signal_connect(drag, "drag-begin", G_CALLBACK(drag_begun), d);
    g_signal_connect(drag, "drag-update", G_CALLBACK(dragged), d);
    gtk_widget_add_controller(d->past_strip, GTK_EVENT_CONTROLLER(drag));
    gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scrolled), d->past_strip);
    gtk_scrolled_window_set_policy(GTK_SCROLLED_WINDOW(scrolled), GTK_POLICY_AUTOMATIC,
                                   GTK_POLICY_NEVER);
    desk_name_bars(scrolled, _("Scrolls the past"));
    return scrolled;
}

/* ---- what can be done ---- */

static void scale_moved(GtkRange *range, struct desk *d)
{
    if (!d->filling)
        visit(d, (int)(gtk_range_get_value(range) + 0.5));
}

static GtkWidget *button_new(const char *label, const char *action, const char *tip)
{
    GtkWidget *button = gtk_button_new_with_label(label);
    gtk_actionable_set_action_name(GTK_ACTIONABLE(button), action);
    desk_name(button, label, tip);
    return button;
}

static void name_entered(GtkEntry *entry, struct desk *d)
{
    const char *name = gtk_editable_get_text(GTK_EDITABLE(entry));
    studio_paper_send(d->paper, (struct studio_message){.kind = STUDIO_MESSAGE_BOOKMARK,
                                                        .text = g_strdup(name)});
    gtk_editable_set_text(GTK_EDITABLE(entry), "");
    gtk_widget_grab_focus(d->canvas);
}

/* What is typed here is the name of the bookmark at this moment. */
static GtkWidget *name_new(struct desk *d)
{
    GtkWidget *entry = gtk_entry_new();
    gtk_entry_set_placeholder_text(GTK_ENTRY(entry), _("Name"));
    gtk_editable_set_width_chars(GTK_EDITABLE(entry), 8);
    desk_name(entry, _("Bookmark's name"),
              _("Type a name and press Enter: this moment's bookmark is called so"));
    g_signal_connect(entry, "activate", G_CALLBACK(name_entered), d);
    return entry;
}

GtkWidget *desk_past_new(struct desk *d)
{
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0),
              *row = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 4);
    const struct {
        const char *label, *action, *tip;
    } buttons[] = {
        {_("Bookmark"), "win.bookmark",
         _("This moment is marked, or is no more (Ctrl+B); Alt+Up and Alt+Down go from one to "
           "the next")},
        {_("To the present"), "win.present",
         _("What was inserted is kept; what followed it flows anew")},
        {_("Take it out"), "win.remove",
         _("The sheet is as if this deed had not been; its time stays")},
        {_("With this dish"), "win.dish", _("This deed is done with what is in the dish now")},
        {_("Another way"), "win.way",
         _("The next stroke that you draw is the way of this one")},
        {_("Beside"), "win.beside",
         _("The sheet as it is seen now stays beside it, for comparison (Ctrl+K)")},
        {_("Begin anew here"), "win.from-here",
         _("What you do next takes the place of all that followed")},
    };
    d->past_scale = gtk_scale_new_with_range(GTK_ORIENTATION_HORIZONTAL, 0, 1, 1);
    gtk_scale_set_draw_value(GTK_SCALE(d->past_scale), FALSE);
    gtk_scale_set_digits(GTK_SCALE(d->past_scale), 0);
    gtk_widget_set_hexpand(d->past_scale, TRUE);
    desk_name(d->past_scale, _("Moment of the past"),
              _("After how many deeds (Alt+Left, Alt+Right)"));
    g_signal_connect(d->past_scale, "value-changed", G_CALLBACK(scale_moved), d);
    gtk_widget_set_margin_start(row, 8);
    gtk_widget_set_margin_end(row, 8);
    gtk_box_append(GTK_BOX(row), d->past_scale);
    gtk_box_append(GTK_BOX(row), name_new(d));
    for (size_t i = 0; i < G_N_ELEMENTS(buttons); i++)
        gtk_box_append(GTK_BOX(row),
                       button_new(buttons[i].label, buttons[i].action, buttons[i].tip));
    gtk_box_append(GTK_BOX(box), row);
    gtk_box_append(GTK_BOX(box), strip_new(d));
    gtk_widget_set_visible(box, FALSE);
    d->past_box = box;
    return box;
}

/* ---- while the past flows anew ---- */

GtkWidget *desk_flow_new(struct desk *d)
{
    d->flow = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 6);
    d->flow_bar = gtk_progress_bar_new();
    gtk_widget_set_valign(d->flow_bar, GTK_ALIGN_CENTER);
    gtk_widget_set_size_request(d->flow_bar, 120, -1);
    desk_name(d->flow_bar, _("How far the past has flowed anew"), NULL);
    gtk_box_append(GTK_BOX(d->flow), d->flow_bar);
    gtk_box_append(
        GTK_BOX(d->flow),
        button_new(_("Stop"), "win.stop", _("The picture stays that of before (Ctrl+Escape)")));
    gtk_widget_set_visible(d->flow, FALSE);
    return d->flow;
}

void desk_past_look(struct desk *d)
{
    const struct studio_report *r = &d->report;
    const bool flows = r->flow_total > 0;
    gtk_widget_set_visible(d->flow, flows);
    if (flows)
        gtk_progress_bar_set_fraction(GTK_PROGRESS_BAR(d->flow_bar),
                                      (double)r->flow_done / (double)r->flow_total);
    if (r->past != d->past_seen && studio_paper_past(d->paper, &d->past)) {
        d->past_seen = r->past;
        gtk_drawing_area_set_content_width(GTK_DRAWING_AREA(d->past_strip),
                                           GAP + CARD * (d->past.count + 1));
        gtk_widget_queue_draw(d->past_strip);
    }
    if (d->past_shown == r->deeds_done && d->past_shown_of == d->past.count)
        return;
    d->past_shown = r->deeds_done;
    d->past_shown_of = d->past.count;
    d->filling = true;
    gtk_range_set_range(GTK_RANGE(d->past_scale), 0, d->past.count > 0 ? d->past.count : 1);
    gtk_range_set_value(GTK_RANGE(d->past_scale), r->deeds_done);
    d->filling = false;
    d->past_sent = -1;
    gtk_widget_queue_draw(d->past_strip);
}
