/* read_actions.c - actions, their keys, the menu. */
#include "read_desk.h"

#define ACTION(name, does)                                                                     \
    static void name(GSimpleAction *action, GVariant *value, gpointer data)                    \
    {                                                                                          \
        struct read_desk *d = data;                                                            \
        (void)action;                                                                          \
        (void)value;                                                                           \
        does;                                                                                  \
    }

static void copy_selected(struct read_desk *d)
{
    if (!d->document || d->selected.begin >= d->selected.end)
        return;
    char *text = read_document_text(d, d->selected);
    gdk_clipboard_set_text(gtk_widget_get_clipboard(d->page), text);
    g_free(text);
}

static void contents_toggle(struct read_desk *d)
{
    gtk_widget_set_visible(d->contents_side, !gtk_widget_get_visible(d->contents_side));
}

static void select_all(struct read_desk *d)
{
    if (d->document)
        d->selected = (struct read_range){0, d->document->plain_bytes};
    read_page_changed(d);
    read_actions_enable(d);
}

enum { SIZE_STEP_PERCENT = 8, COLUMN_STEP = 3 };

ACTION(back, read_document_back(d, false))
ACTION(forward, read_document_back(d, true))
ACTION(contents, contents_toggle(d))
ACTION(search, read_search_open(d, true))
ACTION(search_next, read_search_step(d, true))
ACTION(search_before, read_search_step(d, false))
ACTION(larger, read_look_size(d, d->size_px *(1 + SIZE_STEP_PERCENT / 100.0)))
ACTION(smaller, read_look_size(d, d->size_px / (1 + SIZE_STEP_PERCENT / 100.0)))
ACTION(usual, read_look_size(d, d->options.size_px))
ACTION(wider, read_look_column(d, d->column_em + COLUMN_STEP))
ACTION(narrower, read_look_column(d, d->column_em - COLUMN_STEP))
ACTION(dark, read_look_theme(d, !d->dark))
ACTION(copy, copy_selected(d))
ACTION(all, select_all(d))
ACTION(close_window, gtk_window_close(GTK_WINDOW(d->window)))

static const GActionEntry entries[] = {
    {.name = "back", .activate = back},
    {.name = "forward", .activate = forward},
    {.name = "contents", .activate = contents},
    {.name = "search", .activate = search},
    {.name = "search-next", .activate = search_next},
    {.name = "search-before", .activate = search_before},
    {.name = "larger", .activate = larger},
    {.name = "smaller", .activate = smaller},
    {.name = "usual", .activate = usual},
    {.name = "wider", .activate = wider},
    {.name = "narrower", .activate = narrower},
    {.name = "dark", .activate = dark},
    {.name = "copy", .activate = copy},
    {.name = "all", .activate = all},
    {.name = "close", .activate = close_window},
};

/* Rows of the menu; a row without an action begins another part. */
static const struct {
    const char *action, *label, *key;
} menu_rows[] = {
    {"win.back", "Back", "<Alt>Left"},
    {"win.forward", "Forward", "<Alt>Right"},
    {"win.contents", "Contents", "F9"},
    {NULL, NULL, NULL},
    {"win.search", "Search…", "<Control>f"},
    {"win.search-next", "Next hit", "<Control>g"},
    {"win.search-before", "Hit before", "<Control><Shift>g"},
    {NULL, NULL, NULL},
    {"win.copy", "Copy", "<Control>c"},
    {"win.all", "Select all", "<Control>a"},
    {NULL, NULL, NULL},
    {"win.larger", "Larger letters", "<Control>plus"},
    {"win.smaller", "Smaller letters", "<Control>minus"},
    {"win.usual", "Usual letters", "<Control>0"},
    {"win.wider", "Wider lines", "<Control><Shift>Right"},
    {"win.narrower", "Narrower lines", "<Control><Shift>Left"},
    {"win.dark", "Light or dark", "<Control>d"},
    {NULL, NULL, NULL},
    {"win.close", "Close", "<Control>w"},
};

GMenuModel *read_menu_new(void)
{
    GMenu *menu = g_menu_new(), *part = g_menu_new();
    for (size_t i = 0; i <= G_N_ELEMENTS(menu_rows); i++) {
        if (i < G_N_ELEMENTS(menu_rows) && menu_rows[i].action) {
            g_menu_append(part, _(menu_rows[i].label), menu_rows[i].action);
            continue;
        }
        g_menu_append_section(menu, NULL, G_MENU_MODEL(part));
        g_object_unref(part);
        part = g_menu_new();
    }
    g_object_unref(part);
    return G_MENU_MODEL(menu);
}

void read_actions_add(struct read_desk *d)
{
    g_action_map_add_action_entries(G_ACTION_MAP(d->window), entries, G_N_ELEMENTS(entries), d);
    for (size_t i = 0; i < G_N_ELEMENTS(menu_rows); i++)
        if (menu_rows[i].action)
            gtk_application_set_accels_for_action(d->application, menu_rows[i].action,
                                                  (const char *[]){menu_rows[i].key, NULL});
}

void read_actions_enable(struct read_desk *d)
{
    const struct {
        const char *name;
        bool enabled;
    } states[] = {{"back", read_document_can(d, false)},
                  {"forward", read_document_can(d, true)},
                  {"copy", d->selected.begin < d->selected.end}};
    for (size_t i = 0; d->window && i < G_N_ELEMENTS(states); i++)
        g_simple_action_set_enabled(G_SIMPLE_ACTION(g_action_map_lookup_action(
                                        G_ACTION_MAP(d->window), states[i].name)),
                                    states[i].enabled);
}
