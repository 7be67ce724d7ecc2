/* desk_frame.c - see desk_frame.h. */
#include "desk_frame.h"

#include "desk_shared.h"
#include "desk_words.h"

#include <locale.h>
#include <string.h>
#include <visible_text.h>

/* ---- the program ---- */

static bool words_take(int argc, char **argv, desk_word *word, void *context)
{
    for (int i = 1; i < argc; i++) {
        char name[32];
        const char *value = strchr(argv[i], '=');
        const size_t length = value ? (size_t)(value - argv[i]) : sizeof name;
        if (length >= sizeof name)
            return false;
        memcpy(name, argv[i], length);
        name[length] = '\0';
        if (!word(context, name, value + 1))
            return false;
    }
    return true;
}

int desk_frame_begin(const char *verb, const char *without_display, int argc, char **argv,
                     desk_word *word, void *context)
{
    setlocale(LC_ALL, "");
    setlocale(LC_NUMERIC, "C"); /* numbers in files and scripts have points */
    bindtextdomain("lutetia", LUTETIA_LOCALEDIR);
    bind_textdomain_codeset("lutetia", "UTF-8");
    textdomain("lutetia");
    if (!words_take(argc, argv, word, context)) {
        visible_say("lutetia %s: `lutetia %s` runs this program", verb, verb);
        return 2;
    }
    gtk_disable_setlocale();
    if (gtk_init_check())
        return 0;
    visible_say("lutetia %s: no display; run it where there is a desktop, or set DISPLAY or "
                "WAYLAND_DISPLAY%s",
                verb, without_display);
    return 1;
}

int desk_frame_run(GtkApplication *application, char **argv, GCallback activate, void *context)
{
    g_signal_connect(application, "activate", activate, context);
    return g_application_run(G_APPLICATION(application), 1, argv);
}

/* GTK 4.20 has schemes of colours, and warns of the switch that there was before.
 * NULL: an older GTK. */
static GEnumClass *schemes_of(GtkSettings *settings)
{
    GParamSpec *found = g_object_class_find_property(G_OBJECT_GET_CLASS(settings),
                                                     "gtk-interface-color-scheme");
    return found && G_IS_PARAM_SPEC_ENUM(found) ? G_PARAM_SPEC_ENUM(found)->enum_class : NULL;
}

bool desk_frame_theme(int theme)
{
    GtkSettings *settings = gtk_settings_get_default();
    GEnumClass *schemes = schemes_of(settings);
    const GEnumValue *is_dark = schemes ? g_enum_get_value_by_nick(schemes, "dark") : NULL,
                     *is_light = schemes ? g_enum_get_value_by_nick(schemes, "light") : NULL;
    const char *name = is_dark && is_light ? "gtk-interface-color-scheme"
                                           : "gtk-application-prefer-dark-theme";
    const int dark = is_dark && is_light ? is_dark->value : TRUE,
              light = is_dark && is_light ? is_light->value : FALSE;
    int now = theme == 1 ? dark : light; /* a gboolean is an int */
    if (theme >= 0)
        g_object_set(settings, name, now, NULL);
    else
        g_object_get(settings, name, &now, NULL);
    return now == dark;
}

/* ---- the header ---- */

GtkWidget *desk_frame_button(const struct desk_button *button)
{
    GtkWidget *widget = gtk_button_new_from_icon_name(button->icon);
    char *tip = g_strdup_printf("%s (%s)", _(button->name), button->key);
    gtk_actionable_set_action_name(GTK_ACTIONABLE(widget), button->action);
    desk_name(widget, _(button->name), tip);
    g_free(tip);
    return widget;
}

GtkWidget *desk_frame_header(const struct desk_button *buttons, size_t count, GMenuModel *menu)
{
    GtkWidget *header = gtk_header_bar_new(), *opener = gtk_menu_button_new();
    for (size_t i = 0; i < count; i++)
        gtk_header_bar_pack_start(GTK_HEADER_BAR(header), desk_frame_button(&buttons[i]));
    gtk_menu_button_set_icon_name(GTK_MENU_BUTTON(opener), "open-menu-symbolic");
    gtk_menu_button_set_menu_model(GTK_MENU_BUTTON(opener), menu);
    gtk_menu_button_set_primary(GTK_MENU_BUTTON(opener), TRUE);
    desk_name(opener, _("Menu"), _("Menu (F10)"));
    gtk_header_bar_pack_end(GTK_HEADER_BAR(header), opener);
    return header;
}

/* ---- actions ---- */

GMenuModel *desk_frame_menu(const struct desk_row *rows, size_t count, GMenuModel *submenu)
{
    GMenu *menu = g_menu_new(), *part = g_menu_new();
    for (size_t i = 0; i <= count; i++) {
        if (i < count && rows[i].action) {
            g_menu_append(part, _(rows[i].label), rows[i].action);
            continue;
        }
        g_menu_append_section(menu, NULL, G_MENU_MODEL(part));
        g_object_unref(part);
        part = g_menu_new();
        if (i < count && rows[i].label)
            g_menu_append_submenu(menu, _(rows[i].label), submenu);
    }
    g_object_unref(part);
    return G_MENU_MODEL(menu);
}

void desk_frame_keys(GtkApplication *application, const struct desk_row *rows, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (rows[i].action)
            gtk_application_set_accels_for_action(application, rows[i].action,
                                                  (const char *[]){rows[i].key, NULL});
}

void desk_frame_enable(GtkWidget *window, const struct desk_state *states, size_t count)
{
    for (size_t i = 0; i < count; i++)
        g_simple_action_set_enabled(
            G_SIMPLE_ACTION(g_action_map_lookup_action(G_ACTION_MAP(window), states[i].action)),
            states[i].enabled);
}
