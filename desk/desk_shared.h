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

struct desk_pen;
/* desk_pen.c */
struct desk_pen *desk_pen_create(GtkWidget *canvas);
void desk_pen_destroy(struct desk_pen *pen);
/* A pen's report at that time in milliseconds, as near as there is one; whether it was its
 * other end. False: no pen has spoken. */
bool desk_pen_at(struct desk_pen *pen, guint32 time_ms, double *pressure, double tilt[2],
                 bool *eraser);
/* Whether what came at that time from that place of the surface, in pixels of the screen, a
 * move or else a button's, was told by a device that is no pen. */
bool desk_pen_other(const struct desk_pen *pen, guint32 time_ms, double x_px, double y_px,
                    bool moved);

#endif
