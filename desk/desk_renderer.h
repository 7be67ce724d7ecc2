/* desk_renderer.h - which of GTK's renderers draws the windows.
 *
 * Where OpenGL is computed by the processors, GTK's OpenGL renderer draws the whole window for
 * each picture; cairo draws what has changed.
 *
 *     desk_renderer_choose(gdk_display_get_default());          before the first window
 */
#ifndef LUTETIA_DESK_RENDERER_H
#define LUTETIA_DESK_RENDERER_H

#include <gtk/gtk.h>

/* Lets cairo draw the windows of this program if OpenGL is computed by the processors.
 * GSK_RENDERER in the environment has the last word. */
void desk_renderer_choose(GdkDisplay *display);

#endif
