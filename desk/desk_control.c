/* desk_control.c - a control as a row of widgets: see desk_control.h. */
#include "desk_control.h"
#include "desk_words.h"

#include "desk_shared.h"

#include <ctype.h>
#include <math.h>
#include <string.h>

enum {
    WHOLE = 1000, /* positions of a slider */
    NUMBER_BYTES = 400
};

struct row {
    const struct control *control;
    desk_control_changed *changed;
    void *user;
    int number_of; /* the caller's number */
    bool filling;
    GtkWidget *slider, *number, *choice, *toggle;
};

char *desk_label(const char *name)
{
    char *text = g_strdup(name);
    for (char *c = text; *c; c++)
        if (*c == '_')
            *c = ' ';
    text[0] = (char)toupper((unsigned char)text[0]);
    char *label = g_strdup(_(text));
    g_free(text);
    return label;
}

static struct row *row_of(GtkWidget *box)
{
    return g_object_get_data(G_OBJECT(box), "row");
}

/* ---- values ---- */

/* A slider's position says nothing: a screen reader says the number, and its unit. */
static void value_say(const struct row *row, double value)
{
    char text[64];
    control_number(row->control, value, text, sizeof text);
    char *said = g_strdup_printf("%s %s", text, row->control->unit);
    gtk_accessible_update_property(GTK_ACCESSIBLE(row->slider),
                                   GTK_ACCESSIBLE_PROPERTY_VALUE_TEXT, said, -1);
    g_free(said);
}

/* The number has the decimals that a value needs. */
static void decimals_fit(struct row *row, double value)
{
    char text[NUMBER_BYTES];
    const bool filling = row->filling;
    if (!row->number)
        return;
    control_number(row->control, value, text, sizeof text);
    const char *point = strpbrk(text, ".,");
    row->filling = true; /* GTK tells that the value is another one */
    gtk_spin_button_set_digits(GTK_SPIN_BUTTON(row->number),
                               point ? (guint)strlen(point + 1) : 0);
    row->filling = filling;
}

void desk_control_set(GtkWidget *box, double value)
{
    struct row *row = row_of(box);
    row->filling = true;
    if (row->slider) {
        gtk_range_set_value(GTK_RANGE(row->slider), WHOLE * control_along(row->control, value));
        value_say(row, value);
    }
    desk_control_type(box, value);
    decimals_fit(row, value);
    row->filling = false;
}

static void row_tell(struct row *row, double value)
{
    if (!row->filling)
        row->changed(row->user, row->number_of, value);
}

static void slider_moved(GtkRange *range, struct row *row)
{
    row_tell(row, control_at(row->control, gtk_range_get_value(range) / WHOLE));
}

static void number_typed(GtkSpinButton *number, struct row *row)
{
    decimals_fit(row, gtk_spin_button_get_value(number));
    row_tell(row, gtk_spin_button_get_value(number));
}

static void choice_made(GtkDropDown *choice, GParamSpec *spec, struct row *row)
{
    (void)spec;
    row_tell(row, gtk_drop_down_get_selected(choice));
}

static void toggled(GtkSwitch *toggle, GParamSpec *spec, struct row *row)
{
    (void)spec;
    row_tell(row, gtk_switch_get_active(toggle));
}

static void reset(GtkButton *button, struct row *row)
{
    (void)button;
    row_tell(row, row->control->usual);
}

void desk_control_type(GtkWidget *box, double value)
{
    const struct row *row = row_of(box);
    if (row->number)
        gtk_spin_button_set_value(GTK_SPIN_BUTTON(row->number), value);
    if (row->choice)
        gtk_drop_down_set_selected(GTK_DROP_DOWN(row->choice), (guint)value);
    if (row->toggle)
        gtk_switch_set_active(GTK_SWITCH(row->toggle), value != 0);
}

/* ---- widgets ---- */

static GtkWidget *choice_new(const struct control *control)
{
    char **words = g_strsplit(control->choices, " ", -1);
    GtkStringList *names = gtk_string_list_new(NULL);
    for (char **word = words; *word; word++) {
        char *label = desk_label(*word);
        gtk_string_list_append(names, label);
        g_free(label);
    }
    g_strfreev(words);
    return gtk_drop_down_new(G_LIST_MODEL(names), NULL);
}

/* Where nobody has typed, the value stays what it is, to the last bit. */
static int number_read(GtkSpinButton *number, double *value, const struct row *row)
{
    const double now = gtk_adjustment_get_value(gtk_spin_button_get_adjustment(number));
    char text[NUMBER_BYTES];
    control_number(row->control, now, text, sizeof text);
    if (strcmp(text, gtk_editable_get_text(GTK_EDITABLE(number))) != 0)
        return FALSE; /* as GTK reads it */
    *value = now;
    return TRUE;
}

/* How far its arrows go: by its range. */
static GtkWidget *number_new(struct row *row)
{
    const struct control *control = row->control;
    const double span = control->most - control->least;
    const double step = span > 400   ? 1
                        : span > 20  ? 0.5
                        : span > 0.5 ? 0.01
                                     : pow(10, floor(log10(span / 50)));
    GtkWidget *number = gtk_spin_button_new_with_range(control->least, control->most, step);
    g_signal_connect(number, "input", G_CALLBACK(number_read), row);
    gtk_editable_set_width_chars(GTK_EDITABLE(number), 5);
    gtk_editable_set_max_width_chars(GTK_EDITABLE(number), 5);
    return number;
}

static void slider_add(struct row *row, GtkWidget *box, const char *name, const char *tip)
{
    row->slider = gtk_scale_new_with_range(GTK_ORIENTATION_HORIZONTAL, 0, WHOLE, 1);
    gtk_scale_set_draw_value(GTK_SCALE(row->slider), FALSE);
    gtk_widget_set_hexpand(row->slider, TRUE);
    gtk_widget_set_size_request(row->slider, 96, -1);
    row->number = number_new(row);
    GtkWidget *again = gtk_button_new_from_icon_name("edit-undo-symbolic");
    gtk_button_set_has_frame(GTK_BUTTON(again), FALSE);
    char *text = g_strdup_printf(_("Usual %s"), name);
    desk_name(again, text, text);
    g_free(text);
    text = g_strdup_printf(_("%s, as a number"), name);
    desk_name(row->slider, name, tip);
    desk_name(row->number, text, tip);
    g_free(text);
    g_signal_connect(row->slider, "value-changed", G_CALLBACK(slider_moved), row);
    g_signal_connect(row->number, "value-changed", G_CALLBACK(number_typed), row);
    g_signal_connect(again, "clicked", G_CALLBACK(reset), row);
    gtk_box_append(GTK_BOX(box), row->slider);
    gtk_box_append(GTK_BOX(box), row->number);
    gtk_box_append(GTK_BOX(box), again);
}

static void widgets_add(struct row *row, GtkWidget *box, const char *name, const char *tip)
{
    if (row->control->curve == CONTROL_CHOICE) {
        row->choice = choice_new(row->control);
        gtk_widget_set_hexpand(row->choice, TRUE);
        desk_name(row->choice, name, tip);
        g_signal_connect(row->choice, "notify::selected", G_CALLBACK(choice_made), row);
        gtk_box_append(GTK_BOX(box), row->choice);
    } else if (row->control->curve == CONTROL_SWITCH) {
        row->toggle = gtk_switch_new();
        gtk_widget_set_valign(row->toggle, GTK_ALIGN_CENTER);
        desk_name(row->toggle, name, tip);
        g_signal_connect(row->toggle, "notify::active", G_CALLBACK(toggled), row);
        gtk_box_append(GTK_BOX(box), row->toggle);
    } else {
        slider_add(row, box, name, tip);
    }
}

GtkWidget *desk_control_new(const struct control *control, const char *label,
                            desk_control_changed *changed, void *user, int number)
{
    struct row *row = g_new0(struct row, 1);
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 4);
    char *name = label ? g_strdup(_(label)) : desk_label(control->name);
    const char *does = control->does[0] ? _(control->does) : "";
    char *tip = g_strdup_printf("%s%s%s%s", does, control->unit[0] ? " (" : "", control->unit,
                                control->unit[0] ? ")" : "");
    GtkWidget *text = gtk_label_new(name);
    *row =
        (struct row){.control = control, .changed = changed, .user = user, .number_of = number};
    gtk_label_set_xalign(GTK_LABEL(text), 0);
    gtk_label_set_width_chars(GTK_LABEL(text), label ? 17 : 10);
    gtk_label_set_max_width_chars(GTK_LABEL(text), label ? 17 : 14);
    gtk_label_set_ellipsize(GTK_LABEL(text), PANGO_ELLIPSIZE_END);
    gtk_widget_set_tooltip_text(text, tip);
    gtk_box_append(GTK_BOX(box), text);
    g_object_set_data_full(G_OBJECT(box), "row", row, g_free);
    widgets_add(row, box, name, tip);
    g_free(name);
    g_free(tip);
    return box;
}
