/* read_miniatures.c - all pages small, in place of the page: one riffles through them by wheel,
 * keys and pointer, sees what was found and what readers left, and goes to a page by a click or
 * Return. They are set when they are opened, and painted as they come in. */
#include "read_desk.h"

#include <math.h>
#include <reader_miniatures.h>

enum { WIDTH = 120, WIDTH_LEAST = 60, WIDTH_MOST = 400, STEP = 20 };

struct read_miniatures {
    struct read_desk *desk;
    GtkWidget *stack, *grid;
    GtkSingleSelection *chosen;
    struct reader_miniatures *small; /* NULL: they are not open */
    GPtrArray *bound;                /* GtkListItem that are seen */
    int width;
};

/* ---- what is drawn ---- */

static void mark_add(GArray *marks, size_t begin, size_t end, const double rgb[3])
{
    const struct reader_mark mark = {begin, end, {rgb[0], rgb[1], rgb[2]}};
    if (begin < end)
        g_array_append_val(marks, mark);
}

static void marks_set(struct read_miniatures *m)
{
    struct read_desk *d = m->desk;
    GArray *marks = g_array_new(FALSE, FALSE, sizeof(struct reader_mark));
    for (int i = 0; d->remarks && i < reader_remarks_count(d->remarks); i++) {
        const struct reader_remark *r = reader_remarks_get(d->remarks, i);
        if (reader_remark_seen(r) && !r->orphan)
            mark_add(marks, r->begin, MAX(r->end, r->begin + 1),
                     r->kind == READER_REMARK_TYPED ? d->colours->noted : d->colours->marked);
    }
    for (guint i = 0; i < d->hits->len; i++) {
        const struct read_range hit = g_array_index(d->hits, struct read_range, i);
        mark_add(marks, hit.begin, hit.end,
                 (int)i == d->hit ? d->colours->current : d->colours->found);
    }
    if (reader_miniatures_mark(m->small, (const struct reader_mark *)(void *)marks->data,
                               (int)marks->len) != READER_OK)
        d->say(d, reader_error());
    g_array_free(marks, TRUE);
}

static GdkTexture *page_paint(struct read_miniatures *m, int page)
{
    int width, height;
    reader_miniatures_size(m->small, &width, &height);
    const gsize row = 3 * (gsize)width, size = row * (gsize)height;
    uint8_t *rgb = g_malloc0(size);
    if (reader_miniatures_paint(m->small, page, rgb, row) != READER_OK)
        m->desk->say(m->desk, reader_error());
    GBytes *bytes = g_bytes_new_take(rgb, size);
    GdkTexture *texture = gdk_memory_texture_new(width, height, GDK_MEMORY_R8G8B8, bytes, row);
    g_bytes_unref(bytes);
    return texture;
}

/* Its picture and its number; a screen reader hears how many marks it has. */
static void item_fill(struct read_miniatures *m, GtkListItem *item)
{
    GtkWidget *box = gtk_list_item_get_child(item), *picture = gtk_widget_get_first_child(box),
              *label = gtk_widget_get_next_sibling(picture);
    const int page = (int)gtk_list_item_get_position(item);
    const int marks = m->small ? reader_miniatures_marks(m->small, page) : 0;
    int width, height;
    if (!m->small)
        return;
    reader_miniatures_size(m->small, &width, &height);
    GdkTexture *texture = page_paint(m, page);
    char *number = g_strdup_printf("%d", page + 1),
         *name = marks ? g_strdup_printf(_("Page %d, %d marks"), page + 1, marks)
                       : g_strdup_printf(_("Page %d"), page + 1);
    gtk_picture_set_paintable(GTK_PICTURE(picture), GDK_PAINTABLE(texture));
    gtk_widget_set_size_request(picture, m->width, m->width * height / width);
    gtk_label_set_text(GTK_LABEL(label), number);
    desk_name(box, name, NULL);
    g_object_unref(texture);
    g_free(name);
    g_free(number);
}

static void item_setup(GtkSignalListItemFactory *factory, GtkListItem *item,
                       struct read_miniatures *m)
{
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 2);
    (void)factory;
    (void)m;
    gtk_box_append(GTK_BOX(box), gtk_picture_new());
    gtk_box_append(GTK_BOX(box), gtk_label_new(""));
    gtk_list_item_set_child(item, box);
}

static void item_bind(GtkSignalListItemFactory *factory, GtkListItem *item,
                      struct read_miniatures *m)
{
    (void)factory;
    g_ptr_array_add(m->bound, item);
    item_fill(m, item);
}

static void item_unbind(GtkSignalListItemFactory *factory, GtkListItem *item,
                        struct read_miniatures *m)
{
    (void)factory;
    g_ptr_array_remove_fast(m->bound, item);
    gtk_picture_set_paintable(
        GTK_PICTURE(gtk_widget_get_first_child(gtk_list_item_get_child(item))), NULL);
}

void read_miniatures_changed(struct read_desk *d)
{
    struct read_miniatures *m = d->miniatures;
    if (!m || !m->small)
        return;
    marks_set(m);
    for (guint i = 0; i < m->bound->len; i++)
        item_fill(m, g_ptr_array_index(m->bound, i));
}

/* ---- opening ---- */

/* Pages as wide as the window's column, as high as a book's. */
static struct reader_pages_setup setup_of(const struct read_desk *d)
{
    struct reader_pages_setup s = d->setup;
    const double column = s.grid.text[0].width;
    s.grid = (struct reader_grid){0};
    s.margin_px = 3 * s.size_px;
    s.width_px = column + 2 * s.margin_px;
    s.height_px = round(1.4 * s.width_px);
    s.notes_px = 0;
    s.columns = 1;
    s.running = true;
    return s;
}

static void choose(struct read_miniatures *m, guint page)
{
    gtk_single_selection_set_selected(m->chosen, page);
    gtk_widget_activate_action(m->grid, "list.scroll-to-item", "u", page);
}

static gboolean choose_later(gpointer data)
{
    struct read_miniatures *m = data;
    if (m->small)
        choose(m, gtk_single_selection_get_selected(m->chosen));
    return G_SOURCE_REMOVE;
}

static void model_fill(struct read_miniatures *m)
{
    GtkStringList *pages = gtk_string_list_new(NULL);
    for (int i = 0; i < reader_miniatures_count(m->small); i++) {
        char number[20];
        g_snprintf(number, sizeof number, "%d", i + 1);
        gtk_string_list_append(pages, number);
    }
    gtk_single_selection_set_model(m->chosen, G_LIST_MODEL(pages));
    g_object_unref(pages);
}

static void pages_open(struct read_miniatures *m)
{
    struct read_desk *d = m->desk;
    const struct reader_pages_setup setup = setup_of(d);
    const struct reader_miniatures_def def = {.setup = &setup,
                                              .width_px = m->width *
                                                          gtk_widget_get_scale_factor(m->stack),
                                              .dark = d->dark};
    size_t top = 0;
    if (!d->view || reader_miniatures_make(d->document, &def, &m->small) != READER_OK) {
        d->say(d, reader_error());
        return;
    }
    reader_view_top(d->view, &top);
    const int page = reader_miniatures_page(m->small, top);
    marks_set(m);
    model_fill(m);
    gtk_stack_set_visible_child_name(GTK_STACK(m->stack), "miniatures");
    gtk_widget_grab_focus(m->grid);
    choose(m, (guint)MAX(page, 0));
    g_idle_add(choose_later, m); /* once it has its place */
}

void read_miniatures_close(struct read_desk *d)
{
    struct read_miniatures *m = d->miniatures;
    if (!m || !m->small)
        return;
    gtk_stack_set_visible_child_name(GTK_STACK(m->stack), "page");
    gtk_single_selection_set_model(m->chosen, NULL);
    reader_miniatures_destroy(m->small);
    m->small = NULL;
    if (d->page)
        gtk_widget_grab_focus(d->page);
}

void read_miniatures_toggle(struct read_desk *d)
{
    if (d->miniatures->small)
        read_miniatures_close(d);
    else
        pages_open(d->miniatures);
}

/* ---- hand and keys ---- */

static void go(struct read_miniatures *m, guint page)
{
    struct read_desk *d = m->desk;
    size_t byte = 0;
    const bool found = m->small && reader_miniatures_byte(m->small, (int)page, 0, 0, &byte);
    read_miniatures_close(d);
    if (found)
        read_document_go(d, byte);
}

static void activated(GtkGridView *grid, guint page, struct read_miniatures *m)
{
    (void)grid;
    go(m, page);
}

static void resize(struct read_miniatures *m, int by)
{
    m->width = CLAMP(m->width + by, WIDTH_LEAST, WIDTH_MOST);
    if (reader_miniatures_resize(m->small, m->width * gtk_widget_get_scale_factor(m->stack)) ==
        READER_OK)
        read_miniatures_changed(m->desk);
}

/* What the grid does not do by itself. */
static bool own_key(struct read_miniatures *m, guint key)
{
    if (key == GDK_KEY_Escape)
        read_miniatures_close(m->desk);
    else if (key == GDK_KEY_plus || key == GDK_KEY_KP_Add)
        resize(m, STEP);
    else if (key == GDK_KEY_minus || key == GDK_KEY_KP_Subtract)
        resize(m, -STEP);
    else
        return false;
    return true;
}

bool read_miniatures_key(struct read_desk *d, guint key)
{
    struct read_miniatures *m = d->miniatures;
    if (!m || !m->small)
        return false;
    const guint page = gtk_single_selection_get_selected(m->chosen),
                last = (guint)reader_miniatures_count(m->small) - 1;
    if (key == GDK_KEY_Right)
        choose(m, MIN(page + 1, last));
    else if (key == GDK_KEY_Left)
        choose(m, page ? page - 1 : 0);
    else if (key == GDK_KEY_Home || key == GDK_KEY_End)
        choose(m, key == GDK_KEY_Home ? 0 : last);
    else if (key == GDK_KEY_Return)
        go(m, page);
    else
        return own_key(m, key);
    return true;
}

static gboolean key_pressed(GtkEventControllerKey *keys, guint key, guint code,
                            GdkModifierType state, struct read_miniatures *m)
{
    (void)keys;
    (void)code;
    return m->small && !(state & (GDK_CONTROL_MASK | GDK_ALT_MASK)) && own_key(m, key);
}

char *read_miniatures_told(const struct read_desk *d)
{
    const struct read_miniatures *m = d->miniatures;
    int marks = 0;
    if (!m || !m->small)
        return g_strdup("miniatures closed\n");
    for (int i = 0; i < reader_miniatures_count(m->small); i++)
        marks += reader_miniatures_marks(m->small, i);
    return g_strdup_printf("miniatures %d at %u marks %d\n", reader_miniatures_count(m->small),
                           gtk_single_selection_get_selected(m->chosen) + 1, marks);
}

/* ---- making ---- */

static GtkWidget *grid_new(struct read_miniatures *m)
{
    GtkListItemFactory *factory = gtk_signal_list_item_factory_new();
    GtkEventController *keys = gtk_event_controller_key_new();
    g_signal_connect(factory, "setup", G_CALLBACK(item_setup), m);
    g_signal_connect(factory, "bind", G_CALLBACK(item_bind), m);
    g_signal_connect(factory, "unbind", G_CALLBACK(item_unbind), m);
    m->chosen = gtk_single_selection_new(NULL);
    m->grid = gtk_grid_view_new(GTK_SELECTION_MODEL(m->chosen), factory);
    gtk_grid_view_set_max_columns(GTK_GRID_VIEW(m->grid), 40);
    gtk_grid_view_set_single_click_activate(GTK_GRID_VIEW(m->grid), TRUE);
    gtk_event_controller_set_propagation_phase(keys, GTK_PHASE_CAPTURE);
    g_signal_connect(keys, "key-pressed", G_CALLBACK(key_pressed), m);
    g_signal_connect(m->grid, "activate", G_CALLBACK(activated), m);
    gtk_widget_add_controller(m->grid, keys);
    desk_name(m->grid, _("Miniatures of all pages"), NULL);
    return m->grid;
}

GtkWidget *read_miniatures_new(struct read_desk *d, GtkWidget *page)
{
    struct read_miniatures *m = g_new0(struct read_miniatures, 1);
    GtkWidget *scrolled = gtk_scrolled_window_new();
    m->desk = d;
    m->width = WIDTH;
    m->bound = g_ptr_array_new();
    m->stack = gtk_stack_new();
    gtk_scrolled_window_set_policy(GTK_SCROLLED_WINDOW(scrolled), GTK_POLICY_NEVER,
                                   GTK_POLICY_AUTOMATIC);
    gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scrolled), grid_new(m));
    gtk_stack_add_named(GTK_STACK(m->stack), page, "page");
    gtk_stack_add_named(GTK_STACK(m->stack), scrolled, "miniatures");
    gtk_widget_set_hexpand(m->stack, TRUE);
    d->miniatures = m;
    return m->stack;
}

void read_miniatures_finish(struct read_desk *d)
{
    struct read_miniatures *m = d->miniatures;
    if (!m)
        return;
    reader_miniatures_destroy(m->small);
    m->small = NULL;
}

void read_miniatures_destroy(struct read_desk *d)
{
    if (d->miniatures)
        g_ptr_array_unref(d->miniatures->bound);
    g_clear_pointer(&d->miniatures, g_free);
}
