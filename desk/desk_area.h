/* desk_area.h - a canvas that is drawn by OpenGL, a GtkGLArea.
 *
 * Where OpenGL is computed by the processors, GTK's own OpenGL renderer draws the whole window
 * for each picture, which takes several times as long as the canvas alone. So cairo draws the
 * window there, and the canvas is drawn in part: OpenGL draws what has changed into a
 * framebuffer of the canvas's own, which is read back into tiles. A tile that has not changed
 * is not drawn on the window again.
 *
 *     desk_renderer_choose(display);               before the first window
 *     GtkWidget *canvas = desk_area_new(draw, context);
 */
#ifndef LUTETIA_DESK_AREA_H
#define LUTETIA_DESK_AREA_H

#include "studio_pictures.h"

#include <gtk/gtk.h>

/* Draws into the framebuffer that is bound, in its viewport, at `scale` pixels for a unit of
 * the window. drawn NULL: all of it. Else it is what has to be drawn at least, in pixels from
 * the top left corner, and afterwards what has been, which may be nothing; outside of it the
 * framebuffer is as the last call left it. */
typedef void desk_area_draw(void *context, int scale, struct studio_rectangle *drawn);

/* A GtkGLArea; gtk_gl_area_queue_render() draws it again. */
GtkWidget *desk_area_new(desk_area_draw *draw, void *context);

#endif
