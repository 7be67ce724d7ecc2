/* read_grid.c - the template of the page: another one, its grid's lines as they are shown and
 * dragged, its file. */
#include "read_desk.h"

#include <errno.h>
#include <math.h>
#include <output_file.h>
#include <stdlib.h>
#include <string.h>

enum { NEAR_PX = 7 };

/* ---- another one ---- */

bool read_grid_open(struct read_desk *d, const char *name)
{
    if (reader_template_open(name, &d->template) != READER_OK) {
        d->say(d, reader_error());
        return false;
    }
    g_array_set_size(d->grid_past, 0);
    d->grid_done = 0;
    read_tiles_forget(d->tiles); /* colours may be others */
    read_miniatures_close(d);
    read_look_again(d);
    d->acted(d);
    return true;
}

bool read_grid_save(struct read_desk *d, const char *path)
{
    struct output_file out;
    char *text = reader_template_text(&d->template);
    bool good = text && output_file_open(&out, path);
    if (good) {
        fputs(text, out.stream);
        good = output_file_commit(&out);
    }
    if (!good) {
        char *told =
            g_strdup_printf(_("%s: cannot write: %s"), path, text ? out.why : _("no memory"));
        d->say(d, told);
        g_free(told);
    }
    free(text);
    return good;
}

/* ---- lines ---- */

/* Both edges of each column that is seen, from the left to the right. */
static int edges_count(const struct read_desk *d)
{
    return 2 * d->setup.grid.columns_count;
}

static double edge_px(const struct read_desk *d, int edge)
{
    const struct reader_grid_column *c = &d->setup.grid.columns[edge / 2];
    return c->x + (edge % 2 ? c->width : 0);
}

/* The column beside the one that has the edge, across the gutter; -1: there is none. */
static int beside(const struct read_desk *d, int edge)
{
    const int at = edge / 2 + (edge % 2 ? 1 : -1);
    return at >= 0 && at < d->setup.grid.columns_count ? d->setup.grid.columns[at].number : -1;
}

/* ---- undo ---- */

void read_grid_keep(struct read_desk *d)
{
    g_array_set_size(d->grid_past, d->grid_done);
    g_array_append_val(d->grid_past, d->template);
    d->grid_done++;
}

bool read_grid_can(const struct read_desk *d, bool redo)
{
    return redo ? d->grid_done < d->grid_past->len : d->grid_done > 0;
}

/* The one of the past and the present one change places. */
void read_grid_undo(struct read_desk *d, bool redo)
{
    if (!read_grid_can(d, redo))
        return;
    struct reader_template *past =
        &g_array_index(d->grid_past, struct reader_template, d->grid_done - (redo ? 0 : 1));
    const struct reader_template now = d->template;
    d->template = *past;
    *past = now;
    d->grid_done += redo ? 1 : -1u;
    d->grid_held = false;
    read_tiles_forget(d->tiles); /* colours may be others */
    read_look_again(d);
    d->acted(d);
}

/* What is in the middle grows on both sides of it. */
static void edge_move(struct read_desk *d, int edge, double by_px)
{
    const int other = beside(d, edge);
    reader_template_settle(&d->template, &d->setup.grid, d->size_px);
    const double by_em = (other < 0 ? 2 : 1) * by_px / d->size_px;
    reader_template_drag(&d->template, d->setup.grid.columns[edge / 2].number, other,
                         edge % 2 ? by_em : -by_em);
    read_look_again(d);
}

static int edge_at(const struct read_desk *d, double x)
{
    int nearest = -1;
    for (int i = 0; i < edges_count(d); i++)
        if (fabs(edge_px(d, i) - x) <= NEAR_PX &&
            (nearest < 0 || fabs(edge_px(d, i) - x) < fabs(edge_px(d, nearest) - x)))
            nearest = i;
    return nearest;
}

void read_grid_show(struct read_desk *d, bool show)
{
    d->grid_shown = show;
    d->grid_edge = -1;
    d->grid_held = false;
    read_page_changed(d);
    d->acted(d);
}

bool read_grid_press(struct read_desk *d, double x)
{
    if (!d->grid_shown)
        return false;
    d->grid_edge = edge_at(d, x);
    d->grid_held = d->grid_edge >= 0;
    d->grid_moved = false;
    read_page_changed(d);
    return d->grid_held;
}

bool read_grid_move(struct read_desk *d, double x)
{
    if (!d->grid_shown)
        return false;
    if (!d->grid_held) {
        if (edge_at(d, x) < 0)
            return false;
        gtk_widget_set_cursor_from_name(d->page, "col-resize");
        return true;
    }
    if (d->grid_edge >= edges_count(d)) /* columns have gone: the window is another */
        d->grid_held = false;
    else if (x != edge_px(d, d->grid_edge)) {
        if (!d->grid_moved) /* one drag is one deed */
            read_grid_keep(d);
        d->grid_moved = true;
        edge_move(d, d->grid_edge, x - edge_px(d, d->grid_edge));
    }
    return true;
}

bool read_grid_release(struct read_desk *d)
{
    const bool held = d->grid_held;
    d->grid_held = false;
    if (held)
        d->acted(d);
    return held;
}

bool read_grid_key(struct read_desk *d, guint key)
{
    const int count = edges_count(d);
    if (!d->grid_shown)
        return false;
    switch (key) {
    case GDK_KEY_Escape:
        read_grid_show(d, false);
        return true;
    case GDK_KEY_Tab:
    case GDK_KEY_ISO_Left_Tab:
        if (count)
            d->grid_edge = d->grid_edge < 0
                               ? 0
                               : (d->grid_edge + (key == GDK_KEY_Tab ? 1 : count - 1)) % count;
        read_page_changed(d);
        return true;
    case GDK_KEY_Left:
    case GDK_KEY_Right:
        if (d->grid_edge >= 0 && d->grid_edge < count) {
            read_grid_keep(d);
            edge_move(d, d->grid_edge, (key == GDK_KEY_Left ? -0.5 : 0.5) * d->size_px);
            d->acted(d);
        }
        return true;
    default:
        return false;
    }
}

char *read_grid_heard(const struct read_desk *d)
{
    const int count = edges_count(d);
    if (!d->grid_shown)
        return NULL;
    if (d->grid_edge < 0 || d->grid_edge >= count)
        return g_strdup_printf(_("The grid has %d lines. Tab takes one."), count);
    const struct reader_grid_column *c = &d->setup.grid.columns[d->grid_edge / 2];
    return g_strdup_printf(
        d->grid_edge % 2 ? _("Line %d of %d: right edge of column %d, which is %.1f em wide")
                         : _("Line %d of %d: left edge of column %d, which is %.1f em wide"),
        d->grid_edge + 1, count, c->number + 1, c->width / d->size_px);
}

void read_grid_draw(struct read_desk *d, GtkSnapshot *snapshot)
{
    const double *c = d->colours->link;
    const float height = (float)d->setup.height_px;
    const GdkRGBA pale = {(float)c[0], (float)c[1], (float)c[2], 0.10F},
                  line = {(float)c[0], (float)c[1], (float)c[2], 0.55F},
                  chosen = {(float)c[0], (float)c[1], (float)c[2], 1};
    if (!d->grid_shown)
        return;
    for (int i = 0; i < d->setup.grid.columns_count; i++) {
        const struct reader_grid_column *column = &d->setup.grid.columns[i];
        gtk_snapshot_append_color(
            snapshot, &pale,
            &GRAPHENE_RECT_INIT((float)column->x, 0, (float)column->width, height));
    }
    for (int i = 0; i < edges_count(d); i++) {
        const float wide = i == d->grid_edge ? 3 : 1;
        gtk_snapshot_append_color(
            snapshot, i == d->grid_edge ? &chosen : &line,
            &GRAPHENE_RECT_INIT((float)round(edge_px(d, i)) - wide / 2, 0, wide, height));
    }
}

/* ---- its file ---- */

static void file_chosen(GtkNativeDialog *dialog, int response, struct read_desk *d)
{
    GtkFileChooser *chooser = GTK_FILE_CHOOSER(dialog);
    GFile *file = response == GTK_RESPONSE_ACCEPT ? gtk_file_chooser_get_file(chooser) : NULL;
    char *path = file ? g_file_get_path(file) : NULL;
    if (file && !path)
        d->say(d, _("This is no file of this computer; take another place."));
    if (path && gtk_file_chooser_get_action(chooser) == GTK_FILE_CHOOSER_ACTION_OPEN)
        read_grid_open(d, path);
    else if (path)
        read_grid_save(d, path);
    g_free(path);
    g_clear_object(&file);
    g_object_unref(dialog);
}

void read_grid_choose(struct read_desk *d, bool opens)
{
    GtkFileChooserNative *dialog = gtk_file_chooser_native_new(
        opens ? _("Open a template") : _("Save the template"), GTK_WINDOW(d->window),
        opens ? GTK_FILE_CHOOSER_ACTION_OPEN : GTK_FILE_CHOOSER_ACTION_SAVE, NULL, NULL);
    gtk_native_dialog_set_modal(GTK_NATIVE_DIALOG(dialog), TRUE);
    if (!opens) {
        char *name =
            g_strconcat(*d->template.name ? d->template.name : "own", ".template", NULL);
        gtk_file_chooser_set_current_name(GTK_FILE_CHOOSER(dialog), name);
        g_free(name);
    }
    g_signal_connect(dialog, "response", G_CALLBACK(file_chosen), d);
    gtk_native_dialog_show(GTK_NATIVE_DIALOG(dialog));
}
