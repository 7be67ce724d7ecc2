/* read_actions.c - actions, their keys, the menu. */
#include "read_desk.h"

/* Where the document is edited, the same keys select words. */
static void column_step(struct read_desk *d, guint key, double em)
{
    if (!read_edit_key(d, key, GDK_CONTROL_MASK | GDK_SHIFT_MASK))
        read_look_column(d, reader_template_text_em(&d->template) + em);
}

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
    char *text = read_text_of(d, d->selected);
    gdk_clipboard_set_text(gtk_widget_get_clipboard(d->page), text);
    g_free(text);
}

static void select_all(struct read_desk *d)
{
    if (d->tool == READ_TOOL_MOVE) {
        read_chosen_all(d);
        return;
    }
    if (d->document)
        d->selected = (struct read_range){0, d->document->plain_bytes};
    read_edit_select(d, d->selected);
    read_page_changed(d);
    read_actions_enable(d);
}

/* Inks, translucent: red, green, blue, opacity. */
static const struct {
    const char *name, *label;
    unsigned rgba;
    double width;
} inks[] = {{"blue", N_("Blue ink"), 0x1f4fbfc8u, 0.16},
            {"red", N_("Red ink"), 0xc8201ec8u, 0.16},
            {"green", N_("Green ink"), 0x0f7a3ac8u, 0.16},
            {"marker", N_("Yellow marker"), 0xffd40070u, 0.9}};

static void ink_choose(struct read_desk *d, const char *name)
{
    for (size_t i = 0; i < G_N_ELEMENTS(inks); i++)
        if (g_str_equal(inks[i].name, name)) {
            d->ink_rgba = inks[i].rgba;
            d->ink_width = inks[i].width;
        }
    if (d->tool != READ_TOOL_PEN)
        read_keys_key(d, GDK_KEY_d, 0);
}

/* The grid's lines are seen, or keys go to its colours and sizes: it is the template that is
 * worked at. */
static bool template_edited(const struct read_desk *d)
{
    return d->grid_shown || read_panel_focused(d);
}

static void undo_any(struct read_desk *d, bool redo)
{
    (template_edited(d) ? read_grid_undo
     : read_edit_on(d)  ? read_edit_undo
                        : read_remarks_undo)(d, redo);
}

static bool can_any(const struct read_desk *d, bool redo)
{
    return (template_edited(d) ? read_grid_can
            : read_edit_on(d)  ? read_edit_can
                               : read_remarks_can)(d, redo);
}

enum { SIZE_STEP_PERCENT = 8, COLUMN_STEP = 3 };

ACTION(back, read_document_back(d, false))
ACTION(forward, read_document_back(d, true))
ACTION(contents, read_contents_toggle(d))
ACTION(search, read_search_open(d, true))
ACTION(search_next, read_search_step(d, true))
ACTION(search_before, read_search_step(d, false))
ACTION(larger, read_look_size(d, d->size_px *(1 + SIZE_STEP_PERCENT / 100.0)))
ACTION(smaller, read_look_size(d, d->size_px / (1 + SIZE_STEP_PERCENT / 100.0)))
ACTION(usual, read_look_size(d, d->options.size_px))
ACTION(wider, column_step(d, GDK_KEY_Right, COLUMN_STEP))
ACTION(narrower, column_step(d, GDK_KEY_Left, -COLUMN_STEP))
ACTION(dark, read_miniatures_close(d); read_look_theme(d, !d->dark))
ACTION(miniatures, read_miniatures_toggle(d))
ACTION(copy, copy_selected(d))
ACTION(all, select_all(d))
ACTION(edit, read_edit_toggle(d))
ACTION(save, read_save(d))
ACTION(cut, read_edit_cut(d))
ACTION(paste, read_edit_paste(d))
ACTION(undo, undo_any(d, false))
ACTION(redo, undo_any(d, true))
ACTION(highlight, read_keys_key(d, GDK_KEY_h, 0))
ACTION(note, read_keys_key(d, GDK_KEY_n, 0))
ACTION(pen, read_keys_key(d, GDK_KEY_d, 0))
ACTION(eraser, read_keys_key(d, GDK_KEY_e, 0))
ACTION(spots, read_keys_key(d, GDK_KEY_E, 0))
ACTION(move_ink, read_keys_key(d, GDK_KEY_m, 0))
ACTION(group_ink, read_chosen_group(d, true))
ACTION(ungroup_ink, read_chosen_group(d, false))
ACTION(around_ink, read_around_toggle(d))
ACTION(play_back, read_keys_key(d, GDK_KEY_r, 0))
ACTION(play_back_all, read_keys_key(d, GDK_KEY_R, 0))
ACTION(ink, ink_choose(d, g_variant_get_string(value, NULL)))
ACTION(template, read_grid_open(d, g_variant_get_string(value, NULL)))
ACTION(template_open, read_grid_choose(d, true))
ACTION(template_save, read_grid_choose(d, false))
ACTION(grid, read_grid_show(d, !d->grid_shown))
ACTION(panel, read_panel_toggle(d))
ACTION(layers, read_layers_open(d))
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
    {.name = "miniatures", .activate = miniatures},
    {.name = "copy", .activate = copy},
    {.name = "all", .activate = all},
    {.name = "edit", .activate = edit},
    {.name = "save", .activate = save},
    {.name = "cut", .activate = cut},
    {.name = "paste", .activate = paste},
    {.name = "undo", .activate = undo},
    {.name = "redo", .activate = redo},
    {.name = "highlight", .activate = highlight},
    {.name = "note", .activate = note},
    {.name = "pen", .activate = pen},
    {.name = "eraser", .activate = eraser},
    {.name = "spots", .activate = spots},
    {.name = "move-ink", .activate = move_ink},
    {.name = "group-ink", .activate = group_ink},
    {.name = "ungroup-ink", .activate = ungroup_ink},
    {.name = "around-ink", .activate = around_ink},
    {.name = "play-back", .activate = play_back},
    {.name = "play-back-all", .activate = play_back_all},
    {.name = "ink", .activate = ink, .parameter_type = "s"},
    {.name = "template", .activate = template, .parameter_type = "s"},
    {.name = "template-open", .activate = template_open},
    {.name = "template-save", .activate = template_save},
    {.name = "grid", .activate = grid},
    {.name = "panel", .activate = panel},
    {.name = "layers", .activate = layers},
    {.name = "close", .activate = close_window},
};

static const struct desk_row menu_rows[] = {
    {"win.back", N_("Back"), "<Alt>Left"},
    {"win.forward", N_("Forward"), "<Alt>Right"},
    {"win.contents", N_("Contents"), "F9"},
    {"win.miniatures", N_("All pages, small"), "<Control><Shift>m"},
    {NULL, NULL, NULL},
    {"win.search", N_("Search…"), "<Control>f"},
    {"win.search-next", N_("Next hit"), "<Control>g"},
    {"win.search-before", N_("Hit before"), "<Control><Shift>g"},
    {NULL, NULL, NULL},
    {"win.edit", N_("Edit, or end editing"), "F2"},
    {"win.save", N_("Save"), "<Control>s"},
    {NULL, NULL, NULL},
    {"win.cut", N_("Cut"), "<Control>x"},
    {"win.copy", N_("Copy"), "<Control>c"},
    {"win.paste", N_("Paste"), "<Control>v"},
    {"win.all", N_("Select all"), "<Control>a"},
    {NULL, NULL, NULL},
    {"win.undo", N_("Undo"), "<Control>z"},
    {"win.redo", N_("Redo"), "<Control><Shift>z"},
    {"win.highlight", N_("Highlight (H)"), "<Control>h"},
    {"win.note", N_("Note (N)"), "<Control>n"},
    {"win.layers", N_("Readers' layers…"), "<Control>l"},
    {"win.pen", N_("Draw (D)"), "<Control><Shift>d"},
    {"win.eraser", N_("Erase ink (E)"), "<Control>e"},
    {"win.spots", N_("Erase spots of ink (Shift+E)"), "<Control><Shift>e"},
    {"win.move-ink", N_("Choose ink: move, scale, group (M)"), "<Control>m"},
    {"win.group-ink", N_("Group the chosen ink (G)"), "<Control><Alt>g"},
    {"win.ungroup-ink", N_("Ungroup it (Shift+G)"), "<Control><Alt><Shift>g"},
    {"win.around-ink", N_("Text flows around it, or not (F)"), "<Control><Alt>f"},
    {"win.play-back", N_("Play ink back (R)"), "<Control>r"},
    {"win.play-back-all", N_("Play back with what was erased"), "<Control><Shift>r"},
    {NULL, NULL, NULL},
    {"win.larger", N_("Larger letters"), "<Control>plus"},
    {"win.smaller", N_("Smaller letters"), "<Control>minus"},
    {"win.usual", N_("Usual letters"), "<Control>0"},
    {"win.wider", N_("Wider lines"), "<Control><Shift>Right"},
    {"win.narrower", N_("Narrower lines"), "<Control><Shift>Left"},
    {"win.dark", N_("Light or dark"), "<Control>d"},
    {NULL, NULL, NULL},
    {"win.template::screen", N_("Template: screen"), NULL},
    {"win.template::book", N_("Template: book"), NULL},
    {"win.template::two-columns", N_("Template: two columns"), NULL},
    {"win.template-open", N_("Open a template…"), NULL},
    {"win.template-save", N_("Save the template…"), NULL},
    {"win.grid", N_("The grid's lines"), "F8"},
    {"win.panel", N_("Colours and sizes"), "F7"},
    {NULL, NULL, NULL},
    {"win.close", N_("Close"), "<Control>w"},
    {NULL, N_("Inks"), NULL},
};

GMenuModel *read_menu_new(void)
{
    GMenu *colours = g_menu_new();
    for (size_t i = 0; i < G_N_ELEMENTS(inks); i++) {
        char *action = g_strdup_printf("win.ink::%s", inks[i].name);
        g_menu_append(colours, _(inks[i].label), action);
        g_free(action);
    }
    GMenuModel *menu =
        desk_frame_menu(menu_rows, G_N_ELEMENTS(menu_rows), G_MENU_MODEL(colours));
    g_object_unref(colours);
    return menu;
}

void read_actions_add(struct read_desk *d)
{
    g_action_map_add_action_entries(G_ACTION_MAP(d->window), entries, G_N_ELEMENTS(entries), d);
    desk_frame_keys(d->application, menu_rows, G_N_ELEMENTS(menu_rows));
}

void read_actions_enable(struct read_desk *d)
{
    const struct desk_state states[] = {
        {"back", read_document_can(d, false)},
        {"forward", read_document_can(d, true)},
        {"undo", can_any(d, false)},
        {"redo", can_any(d, true)},
        {"group-ink", read_chosen_count(d) > 1},
        {"ungroup-ink", read_chosen_count(d) > 0},
        {"around-ink", read_chosen_count(d) > 0},
        {"save", read_save_needed(d)},
        {"paste", read_edit_on(d)},
        {"cut", read_edit_on(d) && d->selected.begin < d->selected.end},
        {"copy", d->selected.begin < d->selected.end}};
    if (d->window)
        desk_frame_enable(d->window, states, G_N_ELEMENTS(states));
}
