/* desk_control.h - a control as a row of widgets, made of its row in a table of controls: its
 * name, a slider and its number, or a choice, or a switch, and a button for what is usual.
 *
 *     GtkWidget *row = desk_control_new(&rows[3], NULL, moved, d, 3);
 *     desk_control_set(row, 0.5);
 */
#ifndef LUTETIA_DESK_CONTROL_H
#define LUTETIA_DESK_CONTROL_H

#include <control_table.h>
#include <gtk/gtk.h>

/* A hand has set it. */
typedef void desk_control_changed(void *user, int number, double value);

/* name: in place of the control's own. Owns: the widget copies nothing of the control, which
 * must be there as long. */
GtkWidget *desk_control_new(const struct control *control, const char *name,
                            desk_control_changed *changed, void *user, int number);
/* Shows a value; nobody is told. */
void desk_control_set(GtkWidget *row, double value);
/* As a hand that types it: for recorded input. */
void desk_control_type(GtkWidget *row, double value);

char *desk_label(const char *name); /* "tilt_x" as "Tilt x", translated; free it by g_free() */

#endif
