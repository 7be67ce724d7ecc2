/* desk_frame.h - what surrounds a window of ours, made from tables: the program's beginning,
 * the header with its buttons, the menu, the keys, and which actions can be done now.
 *
 *     static const struct desk_row rows[] = {{"win.open", "Open…", "<Control>o"}, {0},
 *                                            {"win.close", "Close", "<Control>w"}};
 *     GMenuModel *menu = desk_frame_menu(rows, 3, NULL);
 *     gtk_window_set_titlebar(window, desk_frame_header(buttons, 2, menu));
 *     desk_frame_keys(application, rows, 3);
 *
 * Texts are msgids of gettext. All of this belongs to GTK's thread. */
#ifndef LUTETIA_DESK_FRAME_H
#define LUTETIA_DESK_FRAME_H

#include <gtk/gtk.h>
#include <stdbool.h>

/* A row of the menu. Without an action another part begins; with a label it begins after a
 * submenu of that name. */
struct desk_row {
    const char *action, *label, *key;
};

/* A button of the header; key: as it is shown under the pointer. */
struct desk_button {
    const char *icon, *name, *action, *key;
};

struct desk_state {
    const char *action; /* without "win." */
    bool enabled;
};

/* Takes each word NAME=VALUE of the command line; false: it is none of the program's. */
typedef bool desk_word(void *context, const char *name, const char *value);

/* Languages, words and the display. `verb` runs this program, which has no other
 * user; without_display: what else can be done where there is none. Returns 0; else the exit
 * status, and why has been said. */
int desk_frame_begin(const char *verb, const char *without_display, int argc, char **argv,
                     desk_word *word, void *context);
/* Runs an application of one window until that is closed. The exit status. */
int desk_frame_run(GtkApplication *application, char **argv, GCallback activate, void *context);

/* theme: 0 light, 1 dark, -1: stays as the desktop is. Returns whether it is dark. */
bool desk_frame_theme(int theme);
GtkWidget *desk_frame_button(const struct desk_button *button);
/* The header with these buttons and the menu, which stays the caller's. */
GtkWidget *desk_frame_header(const struct desk_button *buttons, size_t count, GMenuModel *menu);
/* submenu: for the row that names one; NULL: there is none. The caller's to unref. */
GMenuModel *desk_frame_menu(const struct desk_row *rows, size_t count, GMenuModel *submenu);
void desk_frame_keys(GtkApplication *application, const struct desk_row *rows, size_t count);
void desk_frame_enable(GtkWidget *window, const struct desk_state *states, size_t count);

#endif
