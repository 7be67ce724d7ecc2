/* desk_window.c - the window: header, tools, sheet, panel, a line of state; and what the paper
 * reports. */
#include "desk.h"
#include "desk_renderer.h"

#include <visible_text.h>

#include <math.h>
#include <string.h>
#include <unistd.h>

/* ---- telling ---- */

static void notice_close(GtkButton *button, struct desk *d)
{
    (void)button;
    gtk_revealer_set_reveal_child(GTK_REVEALER(d->notice), FALSE);
}

static GtkWidget *notice_new(struct desk *d)
{
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8),
              *close = gtk_button_new_from_icon_name("window-close-symbolic");
    d->notice = gtk_revealer_new();
    d->notice_text = gtk_label_new("");
    gtk_label_set_wrap(GTK_LABEL(d->notice_text), TRUE);
    gtk_label_set_xalign(GTK_LABEL(d->notice_text), 0);
    gtk_widget_set_hexpand(d->notice_text, TRUE);
    gtk_widget_set_margin_start(box, 12);
    desk_name(close, _("Put this message away"), _("Put this message away"));
    g_signal_connect(close, "clicked", G_CALLBACK(notice_close), d);
    gtk_box_append(GTK_BOX(box), d->notice_text);
    gtk_box_append(GTK_BOX(box), close);
    gtk_widget_add_css_class(box, "app-notification");
    gtk_widget_set_halign(d->notice, GTK_ALIGN_CENTER);
    gtk_widget_set_valign(d->notice, GTK_ALIGN_START);
    gtk_revealer_set_child(GTK_REVEALER(d->notice), box);
    return d->notice;
}

/* ---- what has been set ---- */

static void setting_changed(struct desk *d, int setting)
{
    if (setting == STUDIO_TOOL && (int)d->settings.value[STUDIO_TOOL] != STUDIO_TOOL_TYPE)
        desk_type_drop(d);
    if (setting >= STUDIO_TYPE_SIZE && setting <= STUDIO_TYPE_SLIDE)
        desk_type_changed(d);
    if (setting == STUDIO_TOOL ||
        (setting >= STUDIO_STAMP_AS && setting <= STUDIO_STAMP_NEGATIVE))
        desk_stamp_changed(d);
    desk_panel_fill(d);
    if (setting == STUDIO_TILT_X || setting == STUDIO_TILT_Y)
        gtk_widget_queue_draw(d->board);
    desk_canvas_show(d);
}

/* ---- what the paper reports ---- */

static void title_show(struct desk *d)
{
    char *name =
        d->report.path[0] ? g_path_get_basename(d->report.path) : g_strdup(_("A new sheet"));
    char *title =
        g_strdup_printf("%s%s - %s", d->report.changed ? "• " : "", name, _("Studio"));
    gtk_window_set_title(GTK_WINDOW(d->window), title);
    g_free(title);
    g_free(name);
}

static void state_show(struct desk *d)
{
    const struct studio_report *r = &d->report;
    char *text;
    if (!r->ready)
        text = g_strdup(r->failed ? _("There is no sheet.") : _("The paper is being made …"));
    else if (r->films)
        text = g_strdup_printf(_("The film is being made: %.0f %%; the hand waits"),
                               100.0 * (double)r->flow_done / fmax(1, (double)r->flow_total));
    else if (r->flow_total > 0)
        text = g_strdup_printf(_("The past flows anew: %.0f %%; what you see is of before"),
                               100.0 * (double)r->flow_done / (double)r->flow_total);
    else if (r->stopped)
        text = g_strdup(_("Stopped: what you see is of before. Ctrl+G goes on."));
    else if (r->way)
        text = g_strdup(_("Draw the stroke's new way"));
    else if (r->inserts)
        text = g_strdup_printf(_("Inserting after deed %d; what followed flows anew when you "
                                 "go to the present"),
                               r->deeds_done);
    else if (r->visits)
        text = g_strdup_printf(_("After deed %d of %d: what you do now is inserted here"),
                               r->deeds_done, r->deeds);
    else if (r->held)
        text = g_strdup(_("Undone. Time stands still until you paint, redo or let it go on."));
    else if (d->settings.value[STUDIO_PAUSED] != 0)
        text = g_strdup_printf(_("Time stands still · step %ld"), r->steps);
    else
        text = g_strdup_printf(r->wet ? _("Wet · step %ld") : _("Dry · step %ld"), r->steps);
    gtk_label_set_text(GTK_LABEL(d->state), text);
    g_free(text);
    text = g_strdup_printf(_("Past: %d operations, %.0f of %.0f MB"), r->operations,
                           r->history_bytes * 1e-6, r->budget_bytes * 1e-6);
    gtk_label_set_text(GTK_LABEL(d->memory), text);
    g_free(text);
}

/* What a hand has set, but for what the sheet itself brings along: its air. */
static void sheet_take(struct desk *d)
{
    for (int i = STUDIO_TILT_X; i <= STUDIO_EDGE; i++)
        d->settings.value[i] = d->report.settings.value[i];
    d->settings.value[STUDIO_PAUSED] = d->report.settings.value[STUDIO_PAUSED];
    d->viewed = false;
    desk_beside_drop(d);
    desk_type_drop(d);
    desk_panel_sheet(d);
    for (int i = 0; i < STUDIO_SETTINGS; i++)
        desk_set(d, i, d->settings.value[i]);
    if (d->report.found_again)
        desk_say(d, _("What was not saved is here again."));
    if (d->play)
        desk_play_begin(d->play);
}

/* For the dialogs' list of recent files. */
static void recent_add(const char *path)
{
    char *uri = path[0] ? g_filename_to_uri(path, NULL, NULL) : NULL;
    if (uri)
        gtk_recent_manager_add_item(gtk_recent_manager_get_default(), uri);
    g_free(uri);
}

static gboolean report_take(gpointer data)
{
    struct desk *d = data;
    const struct studio_report before = d->report;
    g_atomic_int_set(&d->woken, 0);
    if (!d->window)
        return G_SOURCE_REMOVE;
    studio_paper_report(d->paper, &d->report);
    if (d->report.sheets != before.sheets)
        sheet_take(d);
    if (strcmp(d->report.path, before.path) != 0)
        recent_add(d->report.path);
    if (d->report.errors != before.errors) {
        desk_say(d, d->report.error);
        d->leaving = NULL;                                  /* it is not saved: stay */
        visible_say("lutetia studio: %s", d->report.error); /* whoever looks at the terminal */
        if (d->play)
            d->status = 1; /* nobody is there to do it again */
        if (d->report.failed) {
            d->status = 1;
            g_application_quit(G_APPLICATION(d->application));
        }
    }
    if (d->report.notes != before.notes) {
        char *text = g_strdup_printf(
            d->report.note_other ? _("Written: %s.") : _("Saved in %s."), d->report.note);
        desk_say(d, text);
        g_free(text);
        void (*leaving)(struct desk *) = d->report.note_other ? NULL : d->leaving;
        if (leaving) {
            d->leaving = NULL;
            leaving(d);
            return G_SOURCE_REMOVE; /* there may be no window any more */
        }
    }
    if (d->report.outlines != before.outlines)
        studio_paper_outline(d->paper, &d->outline);
    desk_stamp_look(d);
    desk_canvas_look(d);
    desk_past_look(d);
    desk_beside_look(d);
    title_show(d);
    state_show(d);
    desk_actions_enable(d);
    desk_canvas_show(d);
    return G_SOURCE_REMOVE;
}

static void wake(void *context)
{
    struct desk *d = context;
    if (g_atomic_int_compare_and_exchange(&d->woken, 0, 1))
        g_idle_add_full(G_PRIORITY_DEFAULT, report_take, d, NULL);
}

static void look(struct desk *d)
{
    wake(d);
}

/* ---- making ---- */

static void pause_toggled(GtkToggleButton *button, struct desk *d)
{
    if (!d->filling)
        desk_set(d, STUDIO_PAUSED, gtk_toggle_button_get_active(button));
}

static GtkWidget *header_new(struct desk *d)
{
    static const struct desk_button buttons[] = {
        {"document-new-symbolic", N_("New sheet"), "win.new", "Ctrl+N"},
        {"document-open-symbolic", N_("Open"), "win.open", "Ctrl+O"},
        {"document-save-symbolic", N_("Save"), "win.save", "Ctrl+S"},
        {"edit-undo-symbolic", N_("Undo"), "win.undo", "Ctrl+Z"},
        {"edit-redo-symbolic", N_("Redo"), "win.redo", "Ctrl+Shift+Z"},
    };
    static const struct desk_button past = {"document-open-recent-symbolic", N_("The past"),
                                            "win.past", "Ctrl+T"};
    GMenuModel *menu = desk_menu_new();
    GtkWidget *header = desk_frame_header(buttons, G_N_ELEMENTS(buttons), menu);
    d->pause = gtk_toggle_button_new();
    gtk_button_set_icon_name(GTK_BUTTON(d->pause), "media-playback-pause-symbolic");
    desk_name(d->pause, _("Time stands still"), _("Time on the paper stands still (P)"));
    g_signal_connect(d->pause, "toggled", G_CALLBACK(pause_toggled), d);
    gtk_header_bar_pack_start(GTK_HEADER_BAR(header), d->pause);
    gtk_header_bar_pack_start(GTK_HEADER_BAR(header), desk_frame_button(&past));
    g_object_unref(menu);
    return header;
}

static GtkWidget *state_new(struct desk *d)
{
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 16);
    d->state = gtk_label_new("");
    d->memory = gtk_label_new("");
    d->place = gtk_label_new("");
    gtk_label_set_xalign(GTK_LABEL(d->state), 0);
    gtk_label_set_ellipsize(GTK_LABEL(d->state), PANGO_ELLIPSIZE_END);
    gtk_widget_set_hexpand(d->state, TRUE);
    gtk_widget_set_margin_start(box, 8);
    gtk_widget_set_margin_end(box, 8);
    gtk_widget_set_margin_top(box, 3);
    gtk_widget_set_margin_bottom(box, 3);
    gtk_box_append(GTK_BOX(box), d->state);
    gtk_box_append(GTK_BOX(box), desk_flow_new(d));
    gtk_box_append(GTK_BOX(box), d->memory);
    gtk_box_append(GTK_BOX(box), d->place);
    return box;
}

static void leave(struct desk *d)
{
    d->asked = true;
    gtk_window_destroy(GTK_WINDOW(d->window));
}

/* Nothing touches a widget from here on. */
static void gone(GtkWidget *window, struct desk *d)
{
    (void)window;
    desk_measure_end(d);
    d->window = NULL;
    d->closed = d->asked || !d->report.changed;
}

static gboolean close_asked(GtkWindow *window, struct desk *d)
{
    (void)window;
    desk_hand_event(d, &(struct input_event){.kind = INPUT_CLOSE});
    if (d->asked)
        return FALSE;
    studio_paper_report(d->paper, &d->report);
    desk_file_leave(d, leave);
    return TRUE;
}

enum { FLUSH_MS = 20 };

static gboolean flush(gpointer data)
{
    studio_paper_flush(((struct desk *)data)->paper);
    return G_SOURCE_CONTINUE;
}

static gboolean key_pressed(GtkEventControllerKey *controller, guint key, guint code,
                            GdkModifierType state, struct desk *d)
{
    (void)controller;
    (void)code;
    return desk_key(d, key, state);
}

static void key_released(GtkEventControllerKey *controller, guint key, guint code,
                         GdkModifierType state, struct desk *d)
{
    (void)controller;
    (void)code;
    (void)state;
    if (key == GDK_KEY_space)
        d->space = false;
}

/* Of the past's checkpoints: a quarter of the memory, within reason. */
static double budget_bytes(void)
{
    const double all = (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
    return CLAMP(all / 4, 256e6, 4e9);
}

void desk_window_open(struct desk *d)
{
    GtkWidget *all = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0),
              *middle = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 0), *over = gtk_overlay_new();
    desk_renderer_choose(gdk_display_get_default());
    desk_frame_theme(d->options.theme);
    d->changed = setting_changed;
    d->look = look;
    d->window = gtk_application_window_new(d->application);
    gtk_window_set_default_size(GTK_WINDOW(d->window), 1260, 820);
    desk_actions_add(d);
    gtk_window_set_titlebar(GTK_WINDOW(d->window), header_new(d));
    char *folder = desk_unsaved_folder(),
         *found = d->options.path || d->options.fresh ? NULL : desk_unsaved_find(folder);
    d->paper = studio_paper_start(&(struct studio_paper_def){.config = &d->options.config,
                                                             .found = found,
                                                             .folder = folder,
                                                             .path = d->options.path,
                                                             .budget_bytes = budget_bytes(),
                                                             .wake = wake,
                                                             .context = d});
    g_free(folder);
    g_free(found);
    GtkWidget *tools = desk_tools_new(d), *state = state_new(d);
    gtk_widget_set_hexpand(tools, FALSE); /* the sheet has what is left */
    gtk_box_append(GTK_BOX(middle), tools);
    gtk_box_append(GTK_BOX(middle), desk_beside_new(d));
    gtk_box_append(GTK_BOX(middle), desk_canvas_new(d));
    GtkWidget *panel = desk_panel_new(d);
    gtk_widget_set_hexpand(panel, FALSE);
    gtk_box_append(GTK_BOX(middle), panel);
    gtk_overlay_set_child(GTK_OVERLAY(over), middle); /* a message never moves the sheet */
    gtk_overlay_add_overlay(GTK_OVERLAY(over), notice_new(d));
    gtk_box_append(GTK_BOX(all), over);
    gtk_box_append(GTK_BOX(all), desk_past_new(d));
    gtk_box_append(GTK_BOX(all), state);
    gtk_window_set_child(GTK_WINDOW(d->window), all);
    d->pen = desk_pen_create(d->canvas);
    desk_hand_attach(d);
    desk_type_attach(d);
    desk_stamp_attach(d);
    GtkEventController *keys = gtk_event_controller_key_new();
    g_signal_connect(keys, "key-pressed", G_CALLBACK(key_pressed), d);
    g_signal_connect(keys, "key-released", G_CALLBACK(key_released), d);
    gtk_widget_add_controller(d->window, keys);
    g_signal_connect(d->window, "close-request", G_CALLBACK(close_asked), d);
    g_signal_connect(d->window, "destroy", G_CALLBACK(gone), d);
    g_timeout_add(FLUSH_MS, flush, d);
    desk_panel_fill(d);
    title_show(d);
    state_show(d);
    gtk_window_present(GTK_WINDOW(d->window));
    gtk_widget_grab_focus(d->canvas);
}
