/* desk_files.c - dialogs: a new sheet, files, what is not saved. GTK 4.8 has
 * GtkFileChooserNative and no GtkFileDialog. */
#include "desk.h"

#include <string.h>

static void send_path(struct desk *d, enum studio_message_kind kind, const char *path,
                      double value)
{
    studio_paper_send(d->paper, (struct studio_message){
                                    .kind = kind, .text = g_strdup(path), .value = value});
}

/* ---- what is not saved ---- */

struct question {
    struct desk *desk;
    void (*done)(struct desk *d);
    GtkWidget *window;
};

static void question_end(struct question *q, bool go)
{
    struct desk *d = q->desk;
    void (*done)(struct desk *) = q->done;
    gtk_window_destroy(GTK_WINDOW(q->window));
    if (go)
        done(d);
}

static void question_stay(GtkButton *button, struct question *q)
{
    (void)button;
    question_end(q, false);
}

static void question_go(GtkButton *button, struct question *q)
{
    (void)button;
    question_end(q, true);
}

static void question_save(GtkButton *button, struct question *q)
{
    struct desk *d = q->desk;
    (void)button;
    d->leaving = q->done; /* when it has been saved */
    question_end(q, false);
    desk_file_save(d, false);
}

/* A small window in the middle of the other one, with an empty row of buttons. */
static GtkWidget *dialog_new(struct desk *d, const char *title, GtkWidget **box,
                             GtkWidget **buttons)
{
    GtkWidget *window = gtk_window_new();
    *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 8);
    *buttons = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8);
    gtk_window_set_title(GTK_WINDOW(window), title);
    gtk_window_set_transient_for(GTK_WINDOW(window), GTK_WINDOW(d->window));
    gtk_window_set_modal(GTK_WINDOW(window), TRUE);
    gtk_widget_set_margin_start(*box, 18);
    gtk_widget_set_margin_end(*box, 18);
    gtk_widget_set_margin_top(*box, 18);
    gtk_widget_set_margin_bottom(*box, 18);
    gtk_widget_set_halign(*buttons, GTK_ALIGN_END);
    gtk_window_set_child(GTK_WINDOW(window), *box);
    return window;
}

static GtkWidget *button_add(GtkWidget *buttons, const char *label, GCallback clicked,
                             gpointer data)
{
    GtkWidget *button = gtk_button_new_with_label(label);
    g_signal_connect(button, "clicked", clicked, data);
    gtk_box_append(GTK_BOX(buttons), button);
    return button;
}

void desk_file_leave(struct desk *d, void (*done)(struct desk *d))
{
    GtkWidget *box, *buttons;
    if (!d->report.changed || d->asked) {
        done(d);
        return;
    }
    struct question *q = g_new0(struct question, 1);
    *q = (struct question){d, done, dialog_new(d, _("Not saved"), &box, &buttons)};
    GtkWidget *text = gtk_label_new(_("The sheet has changed since it was saved."));
    gtk_box_append(GTK_BOX(box), text);
    gtk_box_append(GTK_BOX(box), buttons);
    button_add(buttons, _("Go on painting"), G_CALLBACK(question_stay), q);
    button_add(buttons, _("Leave without saving"), G_CALLBACK(question_go), q);
    GtkWidget *save = button_add(buttons, _("Save"), G_CALLBACK(question_save), q);
    gtk_widget_add_css_class(save, "suggested-action");
    gtk_window_set_default_widget(GTK_WINDOW(q->window), save);
    g_object_set_data_full(G_OBJECT(q->window), "question", q, g_free);
    gtk_window_present(GTK_WINDOW(q->window));
}

/* ---- a new sheet ---- */

enum { PAINTS_MOST = 128, PAINTS_ABREAST = 4 };

struct form {
    struct desk *desk;
    GtkWidget *window, *width, *height, *stock, *pigments[PAINTS_MOST];
    int pigments_count;
};

static void form_take(struct desk *d, const struct form *f)
{
    struct paper_sheet_config *config = g_new0(struct paper_sheet_config, 1);
    *config = paper_sheet_config_default();
    config->width = gtk_spin_button_get_value_as_int(GTK_SPIN_BUTTON(f->width));
    config->height = gtk_spin_button_get_value_as_int(GTK_SPIN_BUTTON(f->height));
    config->stock =
        *paper_stock_number((int)gtk_drop_down_get_selected(GTK_DROP_DOWN(f->stock)));
    config->seed = (uint64_t)(g_random_int() & 0x7fffffff); /* as scripts can say it */
    for (int i = 0; i < f->pigments_count; i++)
        if (gtk_check_button_get_active(GTK_CHECK_BUTTON(f->pigments[i])) &&
            config->pigments_count < PAPER_PIGMENTS_MAX)
            config->pigments[config->pigments_count++] = *paper_pigment_number(i);
    if (config->pigments_count == 0)
        config->pigments[config->pigments_count++] = *paper_pigment_find(PAPER_PIGMENT_USUAL);
    studio_paper_send(d->paper,
                      (struct studio_message){.kind = STUDIO_MESSAGE_NEW, .config = config});
}

static void form_cancel(GtkButton *button, struct form *f)
{
    (void)button;
    gtk_window_destroy(GTK_WINDOW(f->window));
}

static void form_done(GtkButton *button, struct form *f)
{
    (void)button;
    form_take(f->desk, f);
    gtk_window_destroy(GTK_WINDOW(f->window));
}

static GtkWidget *side_add(GtkWidget *grid, int row, const char *name, int value)
{
    GtkWidget *label = gtk_label_new(name), *side = gtk_spin_button_new_with_range(64, 4096, 1);
    gtk_spin_button_set_value(GTK_SPIN_BUTTON(side), value);
    gtk_label_set_xalign(GTK_LABEL(label), 0);
    desk_name(side, name, NULL);
    gtk_grid_attach(GTK_GRID(grid), label, 0, row, 1, 1);
    gtk_grid_attach(GTK_GRID(grid), side, 1, row, 1, 1);
    return side;
}

static void stock_add(struct form *f, GtkWidget *grid, int row)
{
    GtkWidget *label = gtk_label_new(_("Paper"));
    GtkStringList *names = gtk_string_list_new(NULL);
    int chosen = 0;
    for (int i = 0; paper_stock_number(i); i++) {
        gtk_string_list_append(names, paper_stock_number(i)->name);
        if (!strcmp(paper_stock_number(i)->name, f->desk->report.config.stock.name))
            chosen = i;
    }
    f->stock = gtk_drop_down_new(G_LIST_MODEL(names), NULL);
    gtk_drop_down_set_selected(GTK_DROP_DOWN(f->stock), (guint)chosen);
    gtk_label_set_xalign(GTK_LABEL(label), 0);
    desk_name(f->stock, _("Paper"), NULL);
    gtk_grid_attach(GTK_GRID(grid), label, 0, row, 1, 1);
    gtk_grid_attach(GTK_GRID(grid), f->stock, 1, row, 1, 1);
}

/* A sheet has so many and no more: when they are chosen the others cannot be. */
static void pigments_limit(GtkCheckButton *button, struct form *f)
{
    int chosen = 0;
    (void)button;
    for (int i = 0; i < f->pigments_count; i++)
        chosen += gtk_check_button_get_active(GTK_CHECK_BUTTON(f->pigments[i]));
    for (int i = 0; i < f->pigments_count; i++)
        gtk_widget_set_sensitive(
            f->pigments[i], chosen < PAPER_PIGMENTS_MAX ||
                                gtk_check_button_get_active(GTK_CHECK_BUTTON(f->pigments[i])));
}

static void pigments_add(struct form *f, GtkWidget *grid, int row)
{
    const struct paper_sheet_config *now = &f->desk->report.config;
    for (int i = 0; paper_pigment_number(i) && i < PAINTS_MOST; i++) {
        const char *name = paper_pigment_number(i)->name;
        GtkWidget *check = gtk_check_button_new_with_label(_(name));
        for (int k = 0; k < now->pigments_count; k++)
            if (!strcmp(now->pigments[k].name, name))
                gtk_check_button_set_active(GTK_CHECK_BUTTON(check), TRUE);
        gtk_grid_attach(GTK_GRID(grid), check, i % PAINTS_ABREAST, row + i / PAINTS_ABREAST, 1,
                        1);
        f->pigments[f->pigments_count++] = check;
        g_signal_connect(check, "toggled", G_CALLBACK(pigments_limit), f);
    }
    pigments_limit(NULL, f);
}

static void form_show(struct desk *d)
{
    GtkWidget *box, *buttons, *grid = gtk_grid_new(), *label;
    struct form *f = g_new0(struct form, 1);
    f->desk = d;
    f->window = dialog_new(d, _("New sheet"), &box, &buttons);
    gtk_grid_set_column_spacing(GTK_GRID(grid), 12);
    gtk_grid_set_row_spacing(GTK_GRID(grid), 4);
    f->width = side_add(grid, 0, _("Width in fibers"), d->report.config.width);
    f->height = side_add(grid, 1, _("Height in fibers"), d->report.config.height);
    stock_add(f, grid, 2);
    label = gtk_label_new(_("Pigments: each makes every step take longer"));
    gtk_label_set_xalign(GTK_LABEL(label), 0);
    gtk_grid_attach(GTK_GRID(grid), label, 0, 3, PAINTS_ABREAST, 1);
    pigments_add(f, grid, 4);
    gtk_box_append(GTK_BOX(box), grid);
    gtk_box_append(GTK_BOX(box), buttons);
    button_add(buttons, _("Cancel"), G_CALLBACK(form_cancel), f);
    GtkWidget *done = button_add(buttons, _("Take this sheet"), G_CALLBACK(form_done), f);
    gtk_widget_add_css_class(done, "suggested-action");
    gtk_window_set_default_widget(GTK_WINDOW(f->window), done);
    g_object_set_data_full(G_OBJECT(f->window), "form", f, g_free);
    gtk_window_present(GTK_WINDOW(f->window));
}

void desk_file_new(struct desk *d)
{
    desk_file_leave(d, form_show);
}

/* ---- files ---- */

/* What is asked for: a file to be opened or written, and who gets its name. */
struct asked {
    bool opens;
    const char *title, *ending, *name;
    void (*take)(struct desk *d, const char *path);
    bool endings; /* another ending is another format, and stays */
};

struct chooser {
    struct desk *desk;
    const struct asked *asked;
};

/* The name gets its ending where it has none. */
static void chosen(GtkNativeDialog *dialog, int response, struct chooser *c)
{
    GFile *file = response == GTK_RESPONSE_ACCEPT
                      ? gtk_file_chooser_get_file(GTK_FILE_CHOOSER(dialog))
                      : NULL;
    char *path = file ? g_file_get_path(file) : NULL;
    char *name = path ? g_path_get_basename(path) : NULL;
    if (file && !path)
        desk_say(c->desk, _("This is no file of this computer; take another place."));
    if (!path)
        c->desk->leaving = NULL;
    if (path) {
        char *whole = c->asked->opens || g_str_has_suffix(path, c->asked->ending) ||
                              (c->asked->endings && strchr(name, '.'))
                          ? g_strdup(path)
                          : g_strconcat(path, c->asked->ending, NULL);
        c->asked->take(c->desk, whole);
        g_free(whole);
    }
    g_free(path);
    g_free(name);
    g_clear_object(&file);
    g_object_unref(dialog);
    g_free(c);
}

static void choose(struct desk *d, const struct asked *asked)
{
    struct chooser *c = g_new0(struct chooser, 1);
    GtkFileChooserNative *dialog = gtk_file_chooser_native_new(
        _(asked->title), GTK_WINDOW(d->window),
        asked->opens ? GTK_FILE_CHOOSER_ACTION_OPEN : GTK_FILE_CHOOSER_ACTION_SAVE, NULL, NULL);
    GtkFileFilter *filter = gtk_file_filter_new();
    char *pattern = g_strconcat("*", asked->ending, NULL);
    *c = (struct chooser){d, asked};
    gtk_file_filter_add_pattern(filter, pattern);
    gtk_file_filter_set_name(filter, pattern);
    gtk_file_chooser_add_filter(GTK_FILE_CHOOSER(dialog), filter);
    g_object_unref(filter);
    g_free(pattern);
    gtk_native_dialog_set_modal(GTK_NATIVE_DIALOG(dialog), TRUE);
    if (!asked->opens)
        gtk_file_chooser_set_current_name(GTK_FILE_CHOOSER(dialog), asked->name);
    g_signal_connect(dialog, "response", G_CALLBACK(chosen), c);
    gtk_native_dialog_show(GTK_NATIVE_DIALOG(dialog));
}

static void sheet_open(struct desk *d, const char *path)
{
    send_path(d, STUDIO_MESSAGE_OPEN, path, 0);
}

static void sheet_save(struct desk *d, const char *path)
{
    send_path(d, STUDIO_MESSAGE_SAVE, path, 0);
}

static void picture_write(struct desk *d, const char *path)
{
    send_path(d, STUDIO_MESSAGE_PICTURE, path, 1);
}

static void script_write(struct desk *d, const char *path)
{
    send_path(d, STUDIO_MESSAGE_SCRIPT, path, 0);
}

static void film_write(struct desk *d, const char *path)
{
    send_path(d, STUDIO_MESSAGE_FILM, path, DESK_FILM_S);
}

static void open_choose(struct desk *d)
{
    static const struct asked asked = {true, N_("Open a sheet"), ".h5",
                                       NULL, sheet_open,         false};
    choose(d, &asked);
}

void desk_file_open(struct desk *d)
{
    desk_file_leave(d, open_choose);
}

void desk_file_save(struct desk *d, bool as)
{
    static const struct asked asked = {
        false, N_("Save the sheet with its past"), ".h5", "sheet.h5", sheet_save, false};
    if (!as && d->report.path[0])
        sheet_save(d, d->report.path);
    else
        choose(d, &asked);
}

void desk_file_script(struct desk *d)
{
    static const struct asked asked = {
        false,        N_("Write a script that makes the same sheet"),
        ".lua",       "sheet.lua",
        script_write, false};
    choose(d, &asked);
}

void desk_file_picture(struct desk *d)
{
    static const struct asked asked = {false,       N_("Write a picture"), ".png",
                                       "sheet.png", picture_write,         false};
    choose(d, &asked);
}

void desk_file_palette(struct desk *d, bool opens)
{
    static const struct asked opened = {true, N_("Open a palette"), ".palette",
                                        NULL, desk_palette_open,    false},
                              saved = {false,          N_("Save the palette"), ".palette",
                                       "dish.palette", desk_palette_save,      false};
    choose(d, opens ? &opened : &saved);
}

void desk_file_stamp(struct desk *d)
{
    static const struct asked asked = {true, N_("Choose a picture"), ".png",
                                       NULL, desk_stamp_choose,      false};
    choose(d, &asked);
}

void desk_file_film(struct desk *d)
{
    static const struct asked asked = {
        false, N_("Write a film of the making"), ".mp4", "sheet.mp4", film_write, true};
    choose(d, &asked);
}
