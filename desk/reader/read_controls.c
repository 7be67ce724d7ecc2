/* read_controls.c - controls of a demonstration, under its picture: a row of widgets for each
 * that its script has declared. What was declared is copied, so that the rows stay when it has
 * ended. */
#include "read_desk.h"

#include <demonstration.h>
#include <desk_control.h>

struct read_controls {
    struct demonstration *run; /* NULL: it has ended */
    GtkWidget *box, *rows[DEMONSTRATION_CONTROLS_MAX];
    struct demonstration_control declared[DEMONSTRATION_CONTROLS_MAX];
    struct control table[DEMONSTRATION_CONTROLS_MAX];
    int count;
};

enum { WIDEST = 520, GAP = 4 };

struct read_controls *read_controls_create(GtkWidget *strip, const char *called)
{
    struct read_controls *c = g_new0(struct read_controls, 1);
    char *name = g_strdup_printf(_("Controls of demonstration %s"), called);
    c->box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 2);
    gtk_widget_set_halign(c->box, GTK_ALIGN_START);
    desk_name(c->box, name, NULL);
    g_free(name);
    gtk_box_append(GTK_BOX(strip), c->box);
    return c;
}

void read_controls_destroy(struct read_controls *c)
{
    g_free(c);
}

static void changed(void *user, int number, double value)
{
    struct read_controls *c = user;
    if (!c->run)
        return;
    demonstration_set(c->run, number, value);
    desk_control_set(c->rows[number], demonstration_control(c->run, number)->value);
}

/* The row of the table that widgets are made of. */
static struct control row_of(const struct demonstration_control *c)
{
    return (struct control){.name = c->name,
                            .unit = c->unit,
                            .least = c->least,
                            .most = c->most,
                            .usual = c->usual,
                            .curve = c->curve,
                            .choices = c->choices,
                            .does = c->does};
}

void read_controls_fill(struct read_controls *c, struct demonstration *run)
{
    const struct demonstration_control *declared;
    c->run = run;
    gtk_widget_set_sensitive(c->box, run != NULL);
    if (!run)
        return;
    for (; c->count > 0; c->count--)
        gtk_box_remove(GTK_BOX(c->box), c->rows[c->count - 1]);
    for (; (declared = demonstration_control(run, c->count)); c->count++) {
        const int i = c->count;
        c->declared[i] = *declared;
        c->table[i] = row_of(&c->declared[i]);
        c->rows[i] = desk_control_new(&c->table[i], NULL, changed, c, i);
        desk_control_set(c->rows[i], declared->value);
        gtk_box_append(GTK_BOX(c->box), c->rows[i]);
    }
}

int read_controls_height(struct read_controls *c, int width)
{
    int least = 0, natural = 0;
    if (!c->count)
        return 0;
    gtk_widget_set_size_request(c->box, MIN(width, WIDEST), -1);
    gtk_widget_measure(c->box, GTK_ORIENTATION_VERTICAL, -1, &least, &natural, NULL, NULL);
    return natural + GAP;
}

bool read_controls_enter(struct read_controls *c)
{
    return c->count && c->run && gtk_widget_child_focus(c->box, GTK_DIR_TAB_FORWARD);
}

bool read_controls_has(const struct read_controls *c, const GtkWidget *focus)
{
    return focus && gtk_widget_is_ancestor((GtkWidget *)(uintptr_t)focus, c->box);
}

bool read_controls_type(struct read_controls *c, int number, double value)
{
    if (number < 1 || number > c->count || !c->run)
        return false;
    desk_control_type(c->rows[number - 1], value);
    return true;
}

void read_controls_tell(const struct read_controls *c, GString *to)
{
    for (int i = 0; i < c->count; i++) {
        const struct demonstration_control *now =
            c->run ? demonstration_control(c->run, i) : &c->declared[i];
        g_string_append_printf(to, "control%d %g %s\n", i + 1, now->value, now->name);
    }
}
