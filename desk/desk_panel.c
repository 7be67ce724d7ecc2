/* desk_panel.c - tools on the left; on the right the dish, the tool's own controls, time and
 * air: each a row made of the control's table. */
#include "desk.h"

void desk_panel_fill(struct desk *d)
{
    const int tool = (int)d->settings.value[STUDIO_TOOL];
    d->filling = true;
    for (int i = 0; i < STUDIO_SETTINGS; i++)
        if (d->rows[i]) {
            desk_row_fill(d, i);
            if (i > STUDIO_TOOL && i < STUDIO_PAUSED)
                gtk_widget_set_visible(d->rows[i],
                                       studio_tool_has((enum studio_tool_number)tool, i));
        }
    gtk_toggle_button_set_active(GTK_TOGGLE_BUTTON(d->tools[tool]), TRUE);
    gtk_toggle_button_set_active(GTK_TOGGLE_BUTTON(d->pause),
                                 d->settings.value[STUDIO_PAUSED] != 0);
    gtk_label_set_text(GTK_LABEL(d->tool_title), _(studio_tools[tool].name));
    gtk_label_set_text(GTK_LABEL(d->tool_hint), _(studio_tools[tool].does));
    gtk_widget_set_visible(d->tool_box, tool == STUDIO_TOOL_TYPE);
    gtk_widget_set_visible(d->stamp_box, tool == STUDIO_TOOL_STAMP);
    desk_dish_changed(d);
    d->filling = false;
}

/* ---- tools ---- */

static void tool_chosen(GtkToggleButton *button, struct desk *d)
{
    if (d->filling || !gtk_toggle_button_get_active(button))
        return;
    desk_set(d, STUDIO_TOOL, GPOINTER_TO_INT(g_object_get_data(G_OBJECT(button), "tool")));
}

GtkWidget *desk_tools_new(struct desk *d)
{
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 2);
    gtk_widget_add_css_class(box, "toolbar");
    for (int i = 0; i < STUDIO_TOOLS; i++) {
        const struct studio_tool *tool = &studio_tools[i];
        GtkWidget *button = gtk_toggle_button_new(),
                  *row = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8),
                  *name = gtk_label_new(_(tool->name)), *key = gtk_label_new(NULL);
        char *upper = g_ascii_strup(tool->key, -1);
        char *tip = g_strdup_printf(_("%s Key: %s"), _(tool->does), upper);
        gtk_label_set_text(GTK_LABEL(key), upper);
        gtk_widget_add_css_class(key, "dim-label");
        gtk_label_set_xalign(GTK_LABEL(name), 0);
        gtk_widget_set_hexpand(name, TRUE);
        gtk_box_append(GTK_BOX(row), name);
        gtk_box_append(GTK_BOX(row), key);
        gtk_button_set_child(GTK_BUTTON(button), row);
        gtk_button_set_has_frame(GTK_BUTTON(button), FALSE);
        desk_choice(button);
        desk_name(button, _(tool->name), tip);
        if (i)
            gtk_toggle_button_set_group(GTK_TOGGLE_BUTTON(button),
                                        GTK_TOGGLE_BUTTON(d->tools[0]));
        g_object_set_data(G_OBJECT(button), "tool", GINT_TO_POINTER(i));
        g_signal_connect(button, "toggled", G_CALLBACK(tool_chosen), d);
        gtk_box_append(GTK_BOX(box), button);
        d->tools[i] = button;
        g_free(upper);
        g_free(tip);
    }
    return box;
}

/* ---- the panel ---- */

static GtkWidget *heading(GtkWidget *box, const char *text)
{
    GtkWidget *label = gtk_label_new(text);
    gtk_label_set_xalign(GTK_LABEL(label), 0);
    gtk_widget_add_css_class(label, "heading");
    gtk_widget_set_margin_top(label, 8);
    gtk_box_append(GTK_BOX(box), label);
    return label;
}

static void care(GtkButton *button, struct desk *d)
{
    studio_paper_send(
        d->paper, (struct studio_message){
                      .kind = STUDIO_MESSAGE_CARE,
                      .setting = GPOINTER_TO_INT(g_object_get_data(G_OBJECT(button), "care"))});
}

static GtkWidget *care_new(struct desk *d)
{
    static const struct {
        const char *name, *does;
        enum studio_care care;
    } cares[] = {
        {N_("Dip"), N_("Fill the brush with what is in the dish"), STUDIO_DIP},
        {N_("Rinse"), N_("Fill the brush with clean water"), STUDIO_RINSE},
        {N_("Wipe"), N_("Press all out of the brush on a cloth"), STUDIO_WIPE},
    };
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 4);
    for (size_t i = 0; i < G_N_ELEMENTS(cares); i++) {
        GtkWidget *button = gtk_button_new_with_label(_(cares[i].name));
        gtk_widget_set_tooltip_text(button, _(cares[i].does));
        gtk_widget_set_hexpand(button, TRUE);
        g_object_set_data(G_OBJECT(button), "care", GINT_TO_POINTER(cares[i].care));
        g_signal_connect(button, "clicked", G_CALLBACK(care), d);
        gtk_box_append(GTK_BOX(box), button);
    }
    return box;
}

GtkWidget *desk_panel_new(struct desk *d)
{
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 2),
              *scrolled = gtk_scrolled_window_new();
    gtk_widget_set_margin_start(box, 8);
    gtk_widget_set_margin_end(box, 14);
    gtk_widget_set_margin_bottom(box, 8);
    heading(box, _("Dish"));
    gtk_box_append(GTK_BOX(box), desk_dish_new(d));
    d->tool_title = heading(box, "");
    d->tool_hint = gtk_label_new("");
    gtk_label_set_xalign(GTK_LABEL(d->tool_hint), 0);
    gtk_label_set_wrap(GTK_LABEL(d->tool_hint), TRUE);
    gtk_label_set_max_width_chars(GTK_LABEL(d->tool_hint), 40);
    gtk_widget_add_css_class(d->tool_hint, "dim-label");
    gtk_box_append(GTK_BOX(box), d->tool_hint);
    for (int i = STUDIO_TOOL + 1; i < STUDIO_PAUSED; i++)
        gtk_box_append(GTK_BOX(box), desk_row_new(d, i, NULL));
    d->tool_box = desk_type_new(d);
    gtk_box_append(GTK_BOX(box), d->tool_box);
    d->stamp_box = desk_stamp_new(d);
    gtk_box_append(GTK_BOX(box), d->stamp_box);
    gtk_box_append(GTK_BOX(box), care_new(d));
    heading(box, _("Time and air"));
    gtk_box_append(GTK_BOX(box), desk_board_new(d));
    for (int i = STUDIO_PACE; i < STUDIO_WATER; i++)
        gtk_box_append(GTK_BOX(box), desk_row_new(d, i, NULL));
    gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scrolled), box);
    gtk_scrolled_window_set_policy(GTK_SCROLLED_WINDOW(scrolled), GTK_POLICY_NEVER,
                                   GTK_POLICY_AUTOMATIC);
    gtk_widget_set_size_request(scrolled, 350, -1);
    desk_name_bars(scrolled, _("Scrolls the settings"));
    return scrolled;
}
