/* desk_shared.h - what the studio's and the reader's window share: names for screen readers,
 * popovers, a pen's pressure. */
#ifndef LUTETIA_DESK_SHARED_H
#define LUTETIA_DESK_SHARED_H

#include <gtk/gtk.h>
#include <stdbool.h>

/* desk_name.c: what a screen reader says of a control, and what is shown under the pointer
 * (NULL: nothing). */
void desk_name(GtkWidget *widget, const char *name, const char *tip);
/* The same for the bars of a scrolled window, which later GTK shows to screen readers. */
void desk_name_bars(GtkWidget *scrolled, const char *name);

/* desk_popover.c: a popover that was made to be opened once. For its signal "closed": it goes
 * when GTK has done with it. And at once, before its window goes. */
void desk_popover_drop_later(GtkWidget *popover);
void desk_popover_end(GtkWidget *popover);

/* desk_pen.c */
struct desk_pen;
struct desk_pen *desk_pen_create(GtkWidget *canvas);
void desk_pen_destroy(struct desk_pen *pen);
/* What a pen or a mouse tells. */
struct desk_report {
    guint32 time_ms;
    double x, y; /* of the widget */
    bool pen;
    bool eraser;              /* it is the pen's other end */
    double pressure, tilt[2]; /* of a pen: 0..1, -1..1; else 0 */
};
/* A motion or a button's event; past: one of the motions that GTK has joined in it; NULL: the
 * last. False: it has no place in the widget. */
bool desk_pen_report(struct desk_pen *pen, GtkWidget *widget, GdkEvent *event,
                     const GdkTimeCoord *past, struct desk_report *report);

#endif
