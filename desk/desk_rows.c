/* desk_rows.c - the studio's settings as rows of widgets, made of the table of its controls. */
#include "desk.h"

#include "desk_control.h"

static void row_changed(void *user, int setting, double value)
{
    struct desk *d = user;
    if (!d->filling)
        desk_set(d, setting, value);
}

GtkWidget *desk_row_new(struct desk *d, int setting, const char *label)
{
    return d->rows[setting] =
               desk_control_new(&studio_controls[setting], label, row_changed, d, setting);
}

void desk_row_fill(struct desk *d, int setting)
{
    desk_control_set(d->rows[setting], d->settings.value[setting]);
}
