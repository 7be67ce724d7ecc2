/* desk_renderer.c - see desk_renderer.h. */
#include "desk_renderer.h"

#include <epoxy/gl.h>
#include <string.h>

static bool computed(void)
{
    static const char *const drivers[] = {"llvmpipe", "softpipe", "swrast"};
    const char *name = (const char *)glGetString(GL_RENDERER);
    for (size_t i = 0; name && i < G_N_ELEMENTS(drivers); i++)
        if (strstr(name, drivers[i]))
            return true;
    return false;
}

void desk_renderer_choose(GdkDisplay *display)
{
    GdkGLContext *context =
        g_getenv("GSK_RENDERER") ? NULL : gdk_display_create_gl_context(display, NULL);
    if (!context)
        return;
    if (gdk_gl_context_realize(context, NULL)) {
        gdk_gl_context_make_current(context);
        if (computed())
            g_setenv("GSK_RENDERER", "cairo", TRUE); /* read when a window gets its renderer */
        gdk_gl_context_clear_current();
    }
    g_object_unref(context);
}
