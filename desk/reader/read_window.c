/* read_window.c - the window: header, search, the page and its scrollbar, what is told. */
#include "read_desk.h"

#include <desk_renderer.h>

#include <string.h>
#include <visible_text.h>

/* ---- telling ---- */

static void say(struct read_desk *d, const char *text)
{
    visible_say("lutetia read: %s", text); /* whoever looks at the terminal */
    if (!d->notice)
        return;
    gtk_label_set_text(GTK_LABEL(d->notice_text), text);
    gtk_revealer_set_reveal_child(GTK_REVEALER(d->notice), TRUE);
}

static void notice_close(GtkButton *button, struct read_desk *d)
{
    (void)button;
    gtk_revealer_set_reveal_child(GTK_REVEALER(d->notice), FALSE);
}

static GtkWidget *notice_new(struct read_desk *d)
{
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8),
              *close = gtk_button_new_from_icon_name("window-close-symbolic");
    d->notice = gtk_revealer_new();
    d->notice_text = gtk_label_new("");
    gtk_label_set_wrap(GTK_LABEL(d->notice_text), TRUE);
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

/* ---- search ---- */

static void search_changed(GtkSearchEntry *entry, struct read_desk *d)
{
    read_search_text(d, gtk_editable_get_text(GTK_EDITABLE(entry)));
}

static void search_activated(GtkSearchEntry *entry, struct read_desk *d)
{
    (void)entry;
    read_search_step(d, true);
}

static void search_stopped(GtkSearchEntry *entry, struct read_desk *d)
{
    (void)entry;
    read_search_open(d, false);
    gtk_widget_grab_focus(d->page);
}

static void replace_clicked(GtkWidget *widget, struct read_desk *d)
{
    (void)widget;
    read_edit_replace(d, gtk_editable_get_text(GTK_EDITABLE(d->replace_entry)), false);
}

static void replace_all_clicked(GtkWidget *widget, struct read_desk *d)
{
    (void)widget;
    read_edit_replace(d, gtk_editable_get_text(GTK_EDITABLE(d->replace_entry)), true);
}

/* What hits become, where the document is edited. */
static GtkWidget *replace_new(struct read_desk *d)
{
    GtkWidget *one = gtk_button_new_with_label(_("Replace")),
              *all = gtk_button_new_with_label(_("Replace all"));
    d->replace_box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 6);
    d->replace_entry = gtk_entry_new();
    desk_name(d->replace_entry, _("Replace by"), NULL);
    gtk_entry_set_placeholder_text(GTK_ENTRY(d->replace_entry), _("Replace by"));
    g_signal_connect(d->replace_entry, "activate", G_CALLBACK(replace_clicked), d);
    g_signal_connect(one, "clicked", G_CALLBACK(replace_clicked), d);
    g_signal_connect(all, "clicked", G_CALLBACK(replace_all_clicked), d);
    gtk_box_append(GTK_BOX(d->replace_box), d->replace_entry);
    gtk_box_append(GTK_BOX(d->replace_box), one);
    gtk_box_append(GTK_BOX(d->replace_box), all);
    gtk_widget_set_visible(d->replace_box, FALSE);
    return d->replace_box;
}

static GtkWidget *search_new(struct read_desk *d)
{
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 6),
              *before = gtk_button_new_from_icon_name("go-up-symbolic"),
              *next = gtk_button_new_from_icon_name("go-down-symbolic");
    d->search_bar = gtk_search_bar_new();
    d->search_entry = gtk_search_entry_new();
    d->search_told = gtk_label_new("");
    gtk_widget_set_size_request(d->search_entry, 280, -1);
    desk_name(d->search_entry, _("Search for"), NULL);
    desk_name(before, _("Hit before"), _("Hit before (Ctrl+Shift+G)"));
    desk_name(next, _("Next hit"), _("Next hit (Ctrl+G)"));
    gtk_actionable_set_action_name(GTK_ACTIONABLE(before), "win.search-before");
    gtk_actionable_set_action_name(GTK_ACTIONABLE(next), "win.search-next");
    g_signal_connect(d->search_entry, "search-changed", G_CALLBACK(search_changed), d);
    g_signal_connect(d->search_entry, "activate", G_CALLBACK(search_activated), d);
    g_signal_connect(d->search_entry, "stop-search", G_CALLBACK(search_stopped), d);
    gtk_box_append(GTK_BOX(box), d->search_entry);
    gtk_box_append(GTK_BOX(box), before);
    gtk_box_append(GTK_BOX(box), next);
    gtk_box_append(GTK_BOX(box), d->search_told);
    gtk_box_append(GTK_BOX(box), replace_new(d));
    gtk_search_bar_set_child(GTK_SEARCH_BAR(d->search_bar), box);
    return d->search_bar;
}

/* ---- the page ---- */

static void bar_moved(GtkAdjustment *adjustment, struct read_desk *d)
{
    const double all = gtk_adjustment_get_upper(adjustment);
    if (d->moving || !d->view || all <= 0)
        return;
    reader_view_go_part(d->view, gtk_adjustment_get_value(adjustment) / all);
    read_page_changed(d);
}

static gboolean key_pressed(GtkEventControllerKey *controller, guint key, guint code,
                            GdkModifierType state, struct read_desk *d)
{
    (void)controller;
    (void)code;
    if (read_stages_types(d))
        return FALSE;
    return read_edit_on(d) ? read_edit_key(d, key, state) : read_keys_key(d, key, state);
}

static void key_released(GtkEventControllerKey *controller, guint key, guint code,
                         GdkModifierType state, struct read_desk *d)
{
    (void)controller;
    (void)code;
    (void)state;
    read_stages_key_up(d, key);
}

static GtkWidget *page_new(struct read_desk *d)
{
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 0);
    GtkEventController *keys = gtk_event_controller_key_new();
    gtk_box_append(GTK_BOX(box), read_page_new(d));
    d->scrollbar =
        gtk_scrollbar_new(GTK_ORIENTATION_VERTICAL, gtk_adjustment_new(0, 0, 1, 1, 1, 1));
    desk_name(d->scrollbar, _("Where in the document"), NULL);
    g_signal_connect(gtk_scrollbar_get_adjustment(GTK_SCROLLBAR(d->scrollbar)), "value-changed",
                     G_CALLBACK(bar_moved), d);
    gtk_box_append(GTK_BOX(box), d->scrollbar);
    g_signal_connect(keys, "key-pressed", G_CALLBACK(key_pressed), d);
    g_signal_connect(keys, "key-released", G_CALLBACK(key_released), d);
    read_edit_keys_are(d, keys);
    gtk_widget_add_controller(d->page, keys);
    read_hand_attach(d);
    return box;
}

static void titled(struct read_desk *d)
{
    char *name = read_document_is_manual(d)
                     ? g_strdup(_("The manual"))
                     : g_path_get_basename(g_ptr_array_index(d->options.paths, 0));
    char *title = g_strdup_printf("%s%s - %s", read_save_needed(d) ? "*" : "", name,
                                  read_edit_on(d) ? _("Reader, editing") : _("Reader"));
    gtk_window_set_title(GTK_WINDOW(d->window), title);
    g_free(title);
    g_free(name);
    gtk_widget_set_visible(d->replace_box, read_edit_on(d));
}

static void document_shown(struct read_desk *d)
{
    titled(d);
    read_miniatures_close(d);
    read_contents_fill(d);
    read_watch_begin(d, read_save_foreign);
    read_actions_enable(d);
}

/* ---- making ---- */

static GtkWidget *header_new(void)
{
    static const struct desk_button buttons[] = {
        {"view-list-symbolic", N_("Contents"), "win.contents", "F9"},
        {"go-previous-symbolic", N_("Back"), "win.back", "Alt+Left"},
        {"go-next-symbolic", N_("Forward"), "win.forward", "Alt+Right"},
        {"edit-find-symbolic", N_("Search"), "win.search", "Ctrl+F"},
        {"format-text-underline-symbolic", N_("Highlight"), "win.highlight", "H"},
        {"insert-text-symbolic", N_("Note"), "win.note", "N"},
        {"document-edit-symbolic", N_("Draw"), "win.pen", "D"}};
    GMenuModel *menu = read_menu_new();
    GtkWidget *header = desk_frame_header(buttons, G_N_ELEMENTS(buttons), menu);
    g_object_unref(menu);
    return header;
}

static gboolean close_asked(GtkWindow *window, struct read_desk *d)
{
    (void)window;
    if (!read_save_closes(d))
        return TRUE;
    read_heard_finish(d);
    read_stages_finish(d);
    read_miniatures_finish(d);
    read_watch_end(d);
    read_remarks_close(d);
    d->notice = NULL;
    d->page = NULL;
    return FALSE;
}

void read_window_open(struct read_desk *d)
{
    GtkWidget *all = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0),
              *middle = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 0), *over = gtk_overlay_new();
    desk_renderer_choose(gdk_display_get_default());
    d->say = say;
    d->document_shown = document_shown;
    d->acted = read_actions_enable;
    d->choices_say = read_choices_say;
    d->listed = read_list_fill;
    d->placed = read_contents_follow;
    d->changed = read_page_changed;
    d->step = read_keys_step;
    d->resized = read_look_resized;
    d->edits_begin = read_edit_document;
    d->edits_recover = read_save_recover;
    d->edits_needed = read_save_needed;
    d->edited = read_save_soon;
    d->titled = titled;
    d->refilled = read_contents_fill;
    d->looked = read_panel_follow;
    d->window = gtk_application_window_new(d->application);
    gtk_window_set_default_size(GTK_WINDOW(d->window), d->options.width, d->options.height);
    read_actions_add(d);
    gtk_window_set_titlebar(GTK_WINDOW(d->window), header_new());
    gtk_box_append(GTK_BOX(middle), read_contents_new(d));
    gtk_box_append(GTK_BOX(middle), read_miniatures_new(d, page_new(d)));
    gtk_box_append(GTK_BOX(middle), read_panel_new(d));
    gtk_overlay_set_child(GTK_OVERLAY(over), middle);
    gtk_overlay_add_overlay(GTK_OVERLAY(over), notice_new(d));
    gtk_widget_set_vexpand(over, TRUE);
    gtk_box_append(GTK_BOX(all), search_new(d));
    gtk_box_append(GTK_BOX(all), over);
    gtk_window_set_child(GTK_WINDOW(d->window), all);
    g_signal_connect(d->window, "close-request", G_CALLBACK(close_asked), d);
    d->dark = desk_frame_theme(d->options.theme);
    read_look_set(d);
    if (!read_document_open(d)) {
        d->status = 1;
        g_application_quit(G_APPLICATION(d->application));
        return;
    }
    gtk_window_present(GTK_WINDOW(d->window));
    gtk_widget_grab_focus(d->page);
    if (d->play)
        read_play_begin(d->play);
}
