/* desk_actions.c - actions, the menu, the keys. Letters are keys of the window that come after
 * whoever types has had them. */
#include "desk.h"

#include <math.h>
#include <string.h>

/* ---- actions ---- */

static void undo(GSimpleAction *action, GVariant *parameter, gpointer data)
{
    struct desk *d = data;
    (void)action;
    (void)parameter;
    if (d->shaping) { /* nothing of it has been sent */
        d->down = d->shaping = false;
        return;
    }
    d->down = false;
    g_array_set_size(d->ghost, 0);
    desk_send(d, STUDIO_MESSAGE_UNDO);
}

#define SENDS(name, kind)                                                                      \
    static void name(GSimpleAction *action, GVariant *parameter, gpointer data)                \
    {                                                                                          \
        (void)action;                                                                          \
        (void)parameter;                                                                       \
        desk_send(data, kind);                                                                 \
    }
#define CALLS(name, call)                                                                      \
    static void name(GSimpleAction *action, GVariant *parameter, gpointer data)                \
    {                                                                                          \
        struct desk *d = data;                                                                 \
        (void)action;                                                                          \
        (void)parameter;                                                                       \
        call;                                                                                  \
    }
SENDS(redo, STUDIO_MESSAGE_REDO)
SENDS(dry, STUDIO_MESSAGE_DRY)
SENDS(seal, STUDIO_MESSAGE_SEAL)
SENDS(select_none, STUDIO_MESSAGE_SELECT_NONE)
SENDS(select_invert, STUDIO_MESSAGE_SELECT_INVERT)
SENDS(present, STUDIO_MESSAGE_PRESENT)
SENDS(from_here, STUDIO_MESSAGE_FROM_HERE)
SENDS(take_out, STUDIO_MESSAGE_REMOVE)
SENDS(dish, STUDIO_MESSAGE_DISH)
SENDS(way, STUDIO_MESSAGE_WAY)
SENDS(bookmark, STUDIO_MESSAGE_BOOKMARK)
SENDS(bookmark_earlier, STUDIO_MESSAGE_BOOKMARK_VISIT)
CALLS(go_on, desk_send(d, d->report.stopped ? STUDIO_MESSAGE_FLOW : STUDIO_MESSAGE_GO_ON))
CALLS(bookmark_later,
      studio_paper_send(d->paper, (struct studio_message){.kind = STUDIO_MESSAGE_BOOKMARK_VISIT,
                                                          .value = 1}))
CALLS(stop, studio_paper_stop(d->paper))
CALLS(earlier, desk_past_move(d, -1))
CALLS(later, desk_past_move(d, 1))
CALLS(past, gtk_widget_set_visible(d->past_box, !gtk_widget_get_visible(d->past_box)))
CALLS(beside, desk_beside_keep(d))
CALLS(new_sheet, desk_file_new(d))
CALLS(open_sheet, desk_file_open(d))
CALLS(save, desk_file_save(d, false))
CALLS(save_as, desk_file_save(d, true))
CALLS(picture, desk_file_picture(d))
CALLS(script, desk_file_script(d))
CALLS(film, desk_file_film(d))
CALLS(stamp, desk_file_stamp(d))
CALLS(palette_open, desk_file_palette(d, true))
CALLS(palette_save, desk_file_palette(d, false))
CALLS(close_window, gtk_window_close(GTK_WINDOW(d->window)))

/* ---- the view ---- */

static void view_zoom(struct desk *d, double factor)
{
    studio_view_zoom(&d->view, factor, d->view.width / 2, d->view.height / 2);
    desk_canvas_changed(d);
}

static void view_turn(struct desk *d, double degrees)
{
    studio_view_turn(&d->view, degrees * G_PI / 180, d->view.width / 2, d->view.height / 2);
    desk_canvas_changed(d);
}

static void view_fit(struct desk *d)
{
    if (d->seen.width)
        studio_view_fit(&d->view, d->seen.width, d->seen.height);
    desk_canvas_changed(d);
}

static void view_mirror(struct desk *d)
{
    studio_view_mirror(&d->view);
    desk_canvas_changed(d);
}

CALLS(zoom_in, view_zoom(d, 1.25))
CALLS(zoom_out, view_zoom(d, 0.8))
CALLS(zoom_one, view_zoom(d, 1 / d->view.zoom))
CALLS(zoom_fit, view_fit(d))
CALLS(turn_left, view_turn(d, -15))
CALLS(turn_right, view_turn(d, 15))
CALLS(turn_back, view_turn(d, -d->view.turn * 180 / G_PI))
CALLS(mirror, view_mirror(d))

/* "brush": what `lutetia studio` is told in recorded input, and what menus call. */
static void tool(GSimpleAction *action, GVariant *parameter, gpointer data)
{
    double value;
    (void)action;
    if (stage_control_parse(&studio_controls[STUDIO_TOOL],
                            g_variant_get_string(parameter, NULL), &value) == STAGE_OK)
        desk_set(data, STUDIO_TOOL, value);
}

/* ---- keys ---- */

static const struct {
    const char *keys, *does;
} help_rows[] = {
    {N_("1 … 8"), N_("a well of the dish")},
    {N_("[ and ]"), N_("a narrower or wider brush")},
    {N_("P"), N_("time stands still or goes on")},
    {N_("."), N_("one step of time")},
    {N_("Space and drag, or the middle button"), N_("move the sheet")},
    {N_("+ and -, or Ctrl and the wheel"), N_("zoom")},
    {N_("0 and F"), N_("the sheet at its own size, or the whole sheet")},
    {N_(", and ;"), N_("turn the sheet")},
    {N_("H"), N_("mirror the sheet")},
    {N_("Escape"), N_("give up the stroke, or the type that is not in the paper yet")},
    {N_("Ctrl+Z, Ctrl+Shift+Z"), N_("undo, redo")},
    {N_("Ctrl+Enter"), N_("let the type into the paper")},
    {N_("Ctrl+D, Ctrl+L"), N_("dry the sheet, seal it under a glaze")},
    {N_("Ctrl+Shift+A"), N_("select nothing: the whole sheet takes paint again")},
    {N_("Ctrl+Shift+V"), N_("invert the selection")},
    {N_("Shift or Alt and drag, with the selection"),
     N_("join it to what is selected, or take it out")},
    {N_("Ctrl+T; Alt+Left, Alt+Right, Alt+Home"),
     N_("the past; an earlier or later moment, the present")},
    {N_("Ctrl+B; Alt+Up, Alt+Down"), N_("a bookmark at this moment; from one to the next")},
    {N_("Ctrl+K"), N_("keep this moment beside the sheet, or none any more")},
    {N_("Ctrl+Delete, Ctrl+R, Ctrl+J"),
     N_("there: take the deed out, do it with the dish, another way")},
    {N_("Ctrl+E, Ctrl+Shift+E"), N_("write a picture, a script that makes the same sheet")},
    {N_("Ctrl+Shift+M"), N_("write a film of the making")},
    {N_("Ctrl+I"), N_("choose the picture of the stamp")},
    {N_("Ctrl+Shift+O, Ctrl+Shift+P"), N_("open a palette, save the palette")},
};

static void help_row(GtkWidget *grid, int row, const char *keys, const char *does)
{
    GtkWidget *left = gtk_label_new(keys), *right = gtk_label_new(does);
    gtk_label_set_xalign(GTK_LABEL(left), 0);
    gtk_label_set_xalign(GTK_LABEL(right), 0);
    gtk_widget_add_css_class(left, "heading");
    gtk_grid_attach(GTK_GRID(grid), left, 0, row, 1, 1);
    gtk_grid_attach(GTK_GRID(grid), right, 1, row, 1, 1);
}

static void keys_show(struct desk *d)
{
    GtkWidget *window = gtk_window_new(), *scrolled = gtk_scrolled_window_new(),
              *grid = gtk_grid_new();
    int row = 0;
    gtk_window_set_title(GTK_WINDOW(window), _("Keys"));
    gtk_window_set_transient_for(GTK_WINDOW(window), GTK_WINDOW(d->window));
    gtk_window_set_default_size(GTK_WINDOW(window), 620, 640);
    gtk_grid_set_column_spacing(GTK_GRID(grid), 24);
    gtk_grid_set_row_spacing(GTK_GRID(grid), 6);
    gtk_widget_set_margin_start(grid, 18);
    gtk_widget_set_margin_end(grid, 18);
    gtk_widget_set_margin_top(grid, 18);
    gtk_widget_set_margin_bottom(grid, 18);
    for (int i = 0; i < STUDIO_TOOLS; i++) {
        char *key = g_ascii_strup(studio_tools[i].key, -1);
        help_row(grid, row++, key, _(studio_tools[i].name));
        g_free(key);
    }
    for (size_t i = 0; i < G_N_ELEMENTS(help_rows); i++)
        help_row(grid, row++, _(help_rows[i].keys), _(help_rows[i].does));
    gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scrolled), grid);
    desk_name_bars(scrolled, _("Scrolls the keys"));
    gtk_window_set_child(GTK_WINDOW(window), scrolled);
    gtk_window_present(GTK_WINDOW(window));
}
CALLS(keys, keys_show(d))

static void width_change(struct desk *d, double factor)
{
    const struct control *control = &studio_controls[STUDIO_WIDTH];
    desk_set(
        d, STUDIO_WIDTH,
        fmin(control->most, fmax(control->least, d->settings.value[STUDIO_WIDTH] * factor)));
}

static void escape(struct desk *d)
{
    if (d->typing)
        desk_type_drop(d);
    else
        desk_hand_drop(d);
}

static bool view_key(struct desk *d, guint key)
{
    switch (key) {
    case GDK_KEY_plus:
    case GDK_KEY_equal:
    case GDK_KEY_KP_Add:
        view_zoom(d, 1.25);
        return true;
    case GDK_KEY_minus:
    case GDK_KEY_KP_Subtract:
        view_zoom(d, 0.8);
        return true;
    case GDK_KEY_0:
        view_zoom(d, 1 / d->view.zoom);
        return true;
    case GDK_KEY_f:
        view_fit(d);
        return true;
    case GDK_KEY_comma:
        view_turn(d, -15);
        return true;
    case GDK_KEY_semicolon:
        view_turn(d, 15);
        return true;
    case GDK_KEY_h:
        view_mirror(d);
        return true;
    default:
        return false;
    }
}

static bool other_key(struct desk *d, guint key)
{
    switch (key) {
    case GDK_KEY_Escape:
        escape(d);
        return true;
    case GDK_KEY_space:
        d->space = true;
        return true;
    case GDK_KEY_bracketleft:
        width_change(d, 1 / 1.2);
        return true;
    case GDK_KEY_bracketright:
        width_change(d, 1.2);
        return true;
    case GDK_KEY_p:
        desk_set(d, STUDIO_PAUSED, d->settings.value[STUDIO_PAUSED] == 0);
        return true;
    case GDK_KEY_period:
        studio_paper_send(d->paper,
                          (struct studio_message){.kind = STUDIO_MESSAGE_STEP, .value = 1});
        return true;
    case GDK_KEY_question:
    case GDK_KEY_F1:
        keys_show(d);
        return true;
    default:
        return false;
    }
}

bool desk_key(struct desk *d, guint key, GdkModifierType state)
{
    GtkWidget *focus = gtk_window_get_focus(GTK_WINDOW(d->window));
    const guint lower = gdk_keyval_to_lower(key);
    if (d->typing && focus == d->canvas && desk_type_key(d, key, state))
        return true;
    if (state & (GDK_CONTROL_MASK | GDK_ALT_MASK | GDK_SUPER_MASK))
        return false;
    if (focus && (GTK_IS_EDITABLE(focus) || GTK_IS_TEXT(focus) || GTK_IS_TEXT_VIEW(focus)))
        return false;
    for (int i = 0; i < STUDIO_TOOLS; i++)
        if (lower == (guint)studio_tools[i].key[0]) {
            desk_set(d, STUDIO_TOOL, i);
            return true;
        }
    if (key >= GDK_KEY_1 && key < GDK_KEY_1 + STUDIO_WELLS) {
        desk_dish_well(d, (int)(key - GDK_KEY_1));
        return true;
    }
    return other_key(d, lower) || view_key(d, lower);
}

/* ---- all of them ---- */

static const GActionEntry entries[] = {
    {.name = "new", .activate = new_sheet},
    {.name = "open", .activate = open_sheet},
    {.name = "save", .activate = save},
    {.name = "save-as", .activate = save_as},
    {.name = "picture", .activate = picture},
    {.name = "script", .activate = script},
    {.name = "film", .activate = film},
    {.name = "stamp", .activate = stamp},
    {.name = "palette-open", .activate = palette_open},
    {.name = "palette-save", .activate = palette_save},
    {.name = "undo", .activate = undo},
    {.name = "redo", .activate = redo},
    {.name = "dry", .activate = dry},
    {.name = "seal", .activate = seal},
    {.name = "select-none", .activate = select_none},
    {.name = "select-invert", .activate = select_invert},
    {.name = "go-on", .activate = go_on},
    {.name = "past", .activate = past},
    {.name = "earlier", .activate = earlier},
    {.name = "later", .activate = later},
    {.name = "present", .activate = present},
    {.name = "remove", .activate = take_out},
    {.name = "dish", .activate = dish},
    {.name = "way", .activate = way},
    {.name = "bookmark", .activate = bookmark},
    {.name = "bookmark-earlier", .activate = bookmark_earlier},
    {.name = "bookmark-later", .activate = bookmark_later},
    {.name = "from-here", .activate = from_here},
    {.name = "beside", .activate = beside},
    {.name = "stop", .activate = stop},
    {.name = "zoom-in", .activate = zoom_in},
    {.name = "zoom-out", .activate = zoom_out},
    {.name = "zoom-one", .activate = zoom_one},
    {.name = "zoom-fit", .activate = zoom_fit},
    {.name = "turn-left", .activate = turn_left},
    {.name = "turn-right", .activate = turn_right},
    {.name = "turn-back", .activate = turn_back},
    {.name = "mirror", .activate = mirror},
    {.name = "tool", .activate = tool, .parameter_type = "s"},
    {.name = "keys", .activate = keys},
    {.name = "close", .activate = close_window},
};

static const struct desk_row menu_rows[] = {
    {"win.new", N_("New sheet…"), "<Control>n"},
    {"win.open", N_("Open…"), "<Control>o"},
    {"win.save", N_("Save"), "<Control>s"},
    {"win.save-as", N_("Save as…"), "<Control><Shift>s"},
    {"win.picture", N_("Write a picture…"), "<Control>e"},
    {"win.script", N_("Write a script…"), "<Control><Shift>e"},
    {"win.film", N_("Write a film of the making…"), "<Control><Shift>m"},
    {"win.stamp", N_("Choose a picture…"), "<Control>i"},
    {"win.palette-open", N_("Open a palette…"), "<Control><Shift>o"},
    {"win.palette-save", N_("Save the palette…"), "<Control><Shift>p"},
    {NULL, N_("Tools"), NULL},
    {"win.undo", N_("Undo"), "<Control>z"},
    {"win.redo", N_("Redo"), "<Control><Shift>z"},
    {"win.go-on", N_("Let time go on after an undo"), "<Control>g"},
    {"win.dry", N_("Dry the sheet"), "<Control>d"},
    {"win.seal", N_("Seal under a glaze"), "<Control>l"},
    {"win.select-none", N_("Select nothing"), "<Control><Shift>a"},
    {"win.select-invert", N_("Invert the selection"), "<Control><Shift>v"},
    {NULL, NULL, NULL},
    {"win.past", N_("The past"), "<Control>t"},
    {"win.earlier", N_("An earlier moment"), "<Alt>Left"},
    {"win.later", N_("A later moment"), "<Alt>Right"},
    {"win.present", N_("To the present"), "<Alt>Home"},
    {"win.bookmark", N_("Bookmark this moment"), "<Control>b"},
    {"win.bookmark-earlier", N_("To the bookmark before"), "<Alt>Up"},
    {"win.bookmark-later", N_("To the bookmark after"), "<Alt>Down"},
    {"win.remove", N_("Take this deed out"), "<Control>Delete"},
    {"win.dish", N_("Do this deed with the dish"), "<Control>r"},
    {"win.way", N_("Give this stroke another way"), "<Control>j"},
    {"win.from-here", N_("Begin anew here"), "<Control><Alt>Home"},
    {"win.beside", N_("Keep this moment beside, or none"), "<Control>k"},
    {"win.stop", N_("Stop what flows anew"), "<Control>Escape"},
    {NULL, NULL, NULL},
    {"win.zoom-in", N_("Larger"), "<Control>plus"},
    {"win.zoom-out", N_("Smaller"), "<Control>minus"},
    {"win.zoom-one", N_("One to one"), "<Control>1"},
    {"win.zoom-fit", N_("The whole sheet"), "<Control>0"},
    {"win.turn-left", N_("Turn left"), "<Control>comma"},
    {"win.turn-right", N_("Turn right"), "<Control>semicolon"},
    {"win.turn-back", N_("Upright"), "<Control>period"},
    {"win.mirror", N_("Mirror"), "<Control>h"},
    {NULL, NULL, NULL},
    {"win.keys", N_("Keys"), "<Control>question"},
    {"win.close", N_("Close"), "<Control>w"},
};

GMenuModel *desk_menu_new(void)
{
    GMenu *tools = g_menu_new();
    for (int i = 0; i < STUDIO_TOOLS; i++) {
        char name[64];
        control_text(&studio_controls[STUDIO_TOOL], i, name, sizeof name);
        char *action = g_strdup_printf("win.tool::%s", name);
        g_menu_append(tools, _(studio_tools[i].name), action);
        g_free(action);
    }
    GMenuModel *menu = desk_frame_menu(menu_rows, G_N_ELEMENTS(menu_rows), G_MENU_MODEL(tools));
    g_object_unref(tools);
    return menu;
}

void desk_actions_add(struct desk *d)
{
    g_action_map_add_action_entries(G_ACTION_MAP(d->window), entries, G_N_ELEMENTS(entries), d);
    desk_frame_keys(d->application, menu_rows, G_N_ELEMENTS(menu_rows));
}

void desk_actions_enable(struct desk *d)
{
    const struct desk_state states[] = {
        {"undo", d->report.can_undo || d->down},
        {"redo", d->report.can_redo},
        {"go-on", d->report.held || d->report.stopped},
        {"earlier", d->report.deeds_done > 0},
        {"later", d->report.deeds_done < d->report.deeds},
        {"present", d->report.visits},
        {"from-here", d->report.visits && !d->report.inserts},
        {"remove", d->report.deeds_done > 0 && !d->report.inserts},
        {"dish", d->report.deeds_done > 0 && !d->report.inserts},
        {"bookmark", d->report.deeds_done > 0 && !d->report.inserts},
        {"bookmark-earlier", d->report.deeds_done > 0 && !d->report.inserts},
        {"bookmark-later", d->report.visits && !d->report.inserts},
        {"way", d->report.deeds_done > 0 && !d->report.inserts},
        {"beside", d->report.ready},
        {"stop", d->report.flow_total > 0},
        {"save", d->report.ready},
        {"save-as", d->report.ready},
        {"picture", d->report.ready},
        {"script", d->report.ready},
        {"film", d->report.ready && d->report.operations > 0},
        {"stamp", d->report.ready},
        {"palette-open", d->report.ready},
        {"palette-save", d->report.ready},
        {"dry", d->report.ready},
        {"seal", d->report.ready},
        {"select-none", d->report.selected},
        {"select-invert", d->report.selected}};
    desk_frame_enable(d->window, states, G_N_ELEMENTS(states));
}
