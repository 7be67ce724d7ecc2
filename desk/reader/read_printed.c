/* read_printed.c - what a demonstration that is a program has printed, under its button: its
 * last lines, as letters of one width. There is as much room as it has needed so far. */
#include "read_stages.h"

enum { GAP = 4 };

GtkWidget *read_printed_new(const char *called)
{
    GtkWidget *label = gtk_label_new("");
    char *name = g_strdup_printf(_("What demonstration %s has printed"), called);
    PangoAttrList *look = pango_attr_list_new();
    pango_attr_list_insert(look, pango_attr_family_new("monospace"));
    pango_attr_list_insert(look, pango_attr_scale_new(PANGO_SCALE_SMALL));
    gtk_label_set_attributes(GTK_LABEL(label), look);
    pango_attr_list_unref(look);
    gtk_label_set_xalign(GTK_LABEL(label), 0);
    gtk_label_set_yalign(GTK_LABEL(label), 0);
    gtk_label_set_ellipsize(GTK_LABEL(label), PANGO_ELLIPSIZE_END);
    gtk_widget_set_visible(label, FALSE);
    desk_name(label, name, NULL);
    g_free(name);
    return label;
}

/* True: there are more lines than ever, and they need more room. */
bool read_printed_fill(struct stage *s)
{
    GString *all = g_string_new(NULL);
    const char *line;
    int lines = 0;
    if (!s->run || demonstration_lines(s->run) == s->printed_lines) {
        g_string_free(all, TRUE);
        return false;
    }
    s->printed_lines = demonstration_lines(s->run);
    for (; (line = demonstration_line(s->run, lines)); lines++)
        g_string_append_printf(all, "%s%s", lines ? "\n" : "", line);
    const bool more = lines > s->printed_most;
    for (; lines < s->printed_most; lines++) /* the room stays */
        g_string_append_c(all, '\n');
    s->printed_most = MAX(s->printed_most, lines);
    gtk_label_set_text(GTK_LABEL(s->printed), all->str);
    gtk_widget_set_visible(s->printed, TRUE);
    g_string_free(all, TRUE);
    return more;
}

int read_printed_height(const struct stage *s)
{
    int least = 0, natural = 0;
    if (!s->printed_most)
        return 0;
    gtk_widget_measure(s->printed, GTK_ORIENTATION_VERTICAL, -1, &least, &natural, NULL, NULL);
    return natural + GAP;
}

void read_printed_tell(const struct stage *s, guint number, GString *to)
{
    char **lines =
        g_strsplit(s->printed ? gtk_label_get_text(GTK_LABEL(s->printed)) : "", "\n", -1);
    for (guint i = 0; i < g_strv_length(lines); i++)
        if (*lines[i])
            g_string_append_printf(to, "printed%u.%u %s\n", number, i + 1, lines[i]);
    g_strfreev(lines);
}
