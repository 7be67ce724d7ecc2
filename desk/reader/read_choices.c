/* read_choices.c - what keys act on, for screen readers: a line of the grid, strokes that are
 * chosen. It is the page's description, so that whoever hears the page hears it. */
#include "read_desk.h"

void read_choices_say(struct read_desk *d)
{
    char *line = read_grid_heard(d), *strokes = line ? NULL : read_chosen_heard(d);
    const char *says = line ? line : strokes ? strokes : "";
    if (g_strcmp0(says, d->heard_chosen) != 0) {
        g_free(d->heard_chosen);
        d->heard_chosen = g_strdup(says);
        gtk_accessible_update_property(GTK_ACCESSIBLE(d->page),
                                       GTK_ACCESSIBLE_PROPERTY_DESCRIPTION, says, -1);
    }
    g_free(line);
    g_free(strokes);
}
