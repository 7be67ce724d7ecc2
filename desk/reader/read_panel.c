/* read_panel.c - the template's colours and sizes, at the side of the page: each is set there,
 * and seen at once. Beside a colour stands how well letters of it, or on it, are read. */
#include "read_desk.h"

#include <desk_control.h>
#include <math.h>
#include <string.h>

/* What follows a change of the same thing so soon is one with it. */
enum { SHARE_US = 1500000 };
enum { WIDTH = 330 };

struct read_panel {
    struct read_desk *desk;
    GtkWidget *side, *theme, *colours[READER_COLOURS], *read[READER_COLOURS],
        *sizes[READER_SIZES];
    struct control rows[READER_SIZES]; /* size_rows, with what is usual */
    bool filling;
    int last; /* what was changed last: a colour, or a size behind them; -1: none */
    guint done;
    gint64 changed_us;
};

/* What colours are used for. */
static const char *const colour_labels[READER_COLOURS] = {
    N_("Paper"), N_("Letters"),     N_("Links"),      N_("Struck out"), N_("Selected"),
    N_("Found"), N_("Found, here"), N_("Highlights"), N_("Notes")};

/* What is usual the pages say. */
static const struct control size_rows[READER_SIZES] = {
    {N_("heading_1"), "", READER_SIZE_LEAST, READER_SIZE_MOST, 1, CONTROL_LOGARITHMIC, NULL,
     N_("headings of the first level, of the text's size"), .at = 0},
    {N_("heading_2"), "", READER_SIZE_LEAST, READER_SIZE_MOST, 1, CONTROL_LOGARITHMIC, NULL,
     N_("headings of the second level"), .at = 0},
    {N_("heading_3"), "", READER_SIZE_LEAST, READER_SIZE_MOST, 1, CONTROL_LOGARITHMIC, NULL,
     N_("other headings"), .at = 0},
    {N_("note"), "", READER_SIZE_LEAST, READER_SIZE_MOST, 1, CONTROL_LOGARITHMIC, NULL,
     N_("notes"), .at = 0},
    {N_("code"), "", READER_SIZE_LEAST, READER_SIZE_MOST, 1, CONTROL_LOGARITHMIC, NULL,
     N_("code"), .at = 0},
    {N_("table"), "", READER_SIZE_LEAST, READER_SIZE_MOST, 1, CONTROL_LOGARITHMIC, NULL,
     N_("tables"), .at = 0}};

/* ---- what is set ---- */

/* The template is kept as it was before, but for changes of the same thing that follow each
 * other as a slider moves. */
static void change_begin(struct read_panel *p, int what)
{
    struct read_desk *d = p->desk;
    const gint64 now = g_get_monotonic_time();
    if (p->last != what || p->done != d->grid_done || now > p->changed_us + SHARE_US)
        read_grid_keep(d);
    p->last = what;
    p->done = d->grid_done;
    p->changed_us = now;
}

static void colour_set(struct read_panel *p, int colour, const double rgb[3])
{
    struct read_desk *d = p->desk;
    change_begin(p, colour);
    memcpy(reader_colour_at(&d->template.colours[d->dark], colour), rgb, 3 * sizeof *rgb);
    read_tiles_forget(d->tiles);
    read_miniatures_close(d);
    read_look_again(d);
    d->acted(d);
}

static void size_set(void *user, int size, double value)
{
    struct read_panel *p = user;
    struct read_desk *d = p->desk;
    if (p->filling)
        return;
    change_begin(p, READER_COLOURS + size);
    d->template.sizes[size] = value == reader_size_usual((enum reader_size)size) ? 0 : value;
    read_miniatures_close(d);
    read_look_again(d);
    d->acted(d);
}

static void colour_chosen(GtkColorButton *button, struct read_panel *p)
{
    GdkRGBA rgba;
    gtk_color_chooser_get_rgba(GTK_COLOR_CHOOSER(button), &rgba);
    for (int i = 0; i < READER_COLOURS; i++)
        if (p->colours[i] == GTK_WIDGET(button))
            colour_set(p, i, (const double[]){rgba.red, rgba.green, rgba.blue});
}

bool read_panel_set(struct read_desk *d, const char *words)
{
    const char *value = strchr(words, ' ');
    const size_t length = value ? (size_t)(value - words) : 0;
    double rgb[3];
    for (int i = 0; value && i < READER_COLOURS; i++)
        if (strlen(reader_colour_names[i]) == length &&
            strncmp(reader_colour_names[i], words, length) == 0) {
            if (!reader_colour_read(value + 1, rgb))
                return false;
            colour_set(d->panel, i, rgb);
            return true;
        }
    for (int i = 0; value && i < READER_SIZES; i++)
        if (strlen(reader_size_names[i]) == length &&
            strncmp(reader_size_names[i], words, length) == 0) {
            desk_control_type(d->panel->sizes[i], g_ascii_strtod(value + 1, NULL));
            return true;
        }
    return false;
}

/* ---- what is shown ---- */

static void contrast_show(struct read_panel *p, int colour)
{
    const struct read_desk *d = p->desk;
    const double ratio = reader_colour_contrast(d->colours, colour);
    const bool good = ratio >= READER_CONTRAST_LEAST;
    char *text = g_strdup_printf(good ? "%.1f : 1" : _("⚠ %.1f : 1, hard to read"),
                                 floor(10 * ratio) / 10);
    gtk_label_set_text(GTK_LABEL(p->read[colour]), text);
    g_free(text);
}

void read_panel_follow(struct read_desk *d)
{
    struct read_panel *p = d->panel;
    if (!p || !gtk_widget_get_visible(p->side))
        return;
    p->filling = true;
    gtk_label_set_text(GTK_LABEL(p->theme), d->dark ? _("Dark theme") : _("Light theme"));
    for (int i = 0; i < READER_COLOURS; i++) {
        const double *c = reader_colour_at(&d->template.colours[d->dark], i);
        const GdkRGBA rgba = {(float)c[0], (float)c[1], (float)c[2], 1};
        gtk_color_chooser_set_rgba(GTK_COLOR_CHOOSER(p->colours[i]), &rgba);
        contrast_show(p, i);
    }
    for (int i = 0; i < READER_SIZES; i++) {
        const double own = d->template.sizes[i];
        desk_control_set(p->sizes[i], own > 0 ? own : reader_size_usual((enum reader_size)i));
    }
    p->filling = false;
}

void read_panel_toggle(struct read_desk *d)
{
    GtkWidget *side = d->panel->side;
    const bool opens = !gtk_widget_get_visible(side);
    gtk_widget_set_visible(side, opens);
    read_panel_follow(d);
    gtk_widget_grab_focus(opens ? d->panel->colours[0] : d->page);
    d->acted(d);
}

bool read_panel_focused(const struct read_desk *d)
{
    GtkWidget *focus = d->window ? gtk_window_get_focus(GTK_WINDOW(d->window)) : NULL;
    return focus && d->panel && gtk_widget_is_ancestor(focus, d->panel->side);
}

/* ---- widgets ---- */

static void colour_add(struct read_panel *p, GtkWidget *grid, int colour)
{
    const char *called = _(colour_labels[colour]);
    GtkWidget *label = gtk_label_new(called), *button = gtk_color_button_new(),
              *read = gtk_label_new("");
    gtk_label_set_xalign(GTK_LABEL(label), 0);
    gtk_label_set_xalign(GTK_LABEL(read), 0);
    gtk_widget_set_hexpand(read, TRUE);
    gtk_widget_set_tooltip_text(read, _("contrast of letters: 4.5 : 1 and more is read well"));
    gtk_color_button_set_title(GTK_COLOR_BUTTON(button), called);
    desk_name(button, called, NULL);
    g_signal_connect(button, "color-set", G_CALLBACK(colour_chosen), p);
    gtk_grid_attach(GTK_GRID(grid), label, 0, colour, 1, 1);
    gtk_grid_attach(GTK_GRID(grid), button, 1, colour, 1, 1);
    gtk_grid_attach(GTK_GRID(grid), read, 2, colour, 1, 1);
    p->colours[colour] = button;
    p->read[colour] = read;
}

static GtkWidget *headed(const char *text)
{
    GtkWidget *label = gtk_label_new(text);
    gtk_widget_add_css_class(label, "heading");
    gtk_label_set_xalign(GTK_LABEL(label), 0);
    return label;
}

GtkWidget *read_panel_new(struct read_desk *d)
{
    struct read_panel *p = d->panel = g_new0(struct read_panel, 1);
    GtkWidget *all = gtk_box_new(GTK_ORIENTATION_VERTICAL, 6), *grid = gtk_grid_new(),
              *save = gtk_button_new_with_label(_("Save the template…"));
    p->desk = d;
    p->last = -1;
    p->side = gtk_scrolled_window_new();
    p->theme = headed("");
    gtk_widget_set_size_request(p->side, WIDTH, -1);
    gtk_scrolled_window_set_policy(GTK_SCROLLED_WINDOW(p->side), GTK_POLICY_NEVER,
                                   GTK_POLICY_AUTOMATIC);
    gtk_grid_set_column_spacing(GTK_GRID(grid), 10);
    gtk_grid_set_row_spacing(GTK_GRID(grid), 4);
    for (int i = 0; i < READER_COLOURS; i++)
        colour_add(p, grid, i);
    gtk_widget_set_margin_start(all, 10);
    gtk_widget_set_margin_end(all, 10);
    gtk_widget_set_margin_top(all, 8);
    gtk_box_append(GTK_BOX(all), p->theme);
    gtk_box_append(GTK_BOX(all), grid);
    gtk_box_append(GTK_BOX(all), headed(_("Sizes, of the text's")));
    for (int i = 0; i < READER_SIZES; i++) {
        p->rows[i] = size_rows[i];
        p->rows[i].usual = reader_size_usual((enum reader_size)i);
        p->sizes[i] = desk_control_new(&p->rows[i], NULL, size_set, p, i);
        gtk_box_append(GTK_BOX(all), p->sizes[i]);
    }
    gtk_actionable_set_action_name(GTK_ACTIONABLE(save), "win.template-save");
    gtk_box_append(GTK_BOX(all), save);
    gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(p->side), all);
    desk_name_bars(p->side, _("Scrolls colours and sizes"));
    gtk_widget_set_visible(p->side, FALSE);
    g_object_set_data_full(G_OBJECT(p->side), "panel", p, g_free);
    return p->side;
}
