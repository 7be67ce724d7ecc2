/* window_open.c - windows are opened and closed: see window.h. */
#include "display_internal.h"
#include "screens.h"
#include "window_internal.h"
#include "window_repeat.h"

#include <library.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static enum display_status fail_glfw(const char *what)
{
    const char *why = NULL;
    glfw3.GetError(&why);
    return display_fail(DISPLAY_NO_WINDOW, "%s: %s", what, why ? why : "GLFW does not say why");
}

static bool functions_find(struct gl *gl)
{
    bool all = true;
#define GL_FIND(name, parameters)                                                              \
    gl->name = (void(*) parameters)glfw3.GetProcAddress("gl" #name);                           \
    all = all && gl->name;
    GL_FUNCTIONS(GL_FIND)
    gl->GetError = (GLenum(*)(void))glfw3.GetProcAddress("glGetError");
    gl->GetString = (const GLubyte *(*)(GLenum))glfw3.GetProcAddress("glGetString");
    gl->GenerateMipmap = (void (*)(GLenum))glfw3.GetProcAddress("glGenerateMipmap");
    GLint major = 0;
    if (all && gl->GetError) /* a driver may return functions that it does not implement */
        gl->GetIntegerv(GL_MAJOR_VERSION, &major);
    if (all && gl->GetError && gl->GetError() != GL_NO_ERROR)
        major = 0;
    if (major < 3)
        gl->GenerateMipmap = NULL;
    return all && gl->GetError && gl->GetString;
}

/* Whether the processors compute what OpenGL draws. Mesa's drivers of that kind are these. */
static bool gl_is_software(const struct gl *gl)
{
    static const char *const drivers[] = {"llvmpipe", "softpipe", "swrast",
                                          "Software Rasterizer"};
    const GLubyte *name = gl->GetString(GL_RENDERER);
    for (size_t i = 0; name && i < sizeof drivers / sizeof *drivers; i++)
        if (strstr((const char *)name, drivers[i]))
            return true;
    return false;
}

static struct {
    unsigned long (*glfwGetX11Window)(GLFWwindow *);
    void *(*glfwGetX11Display)(void);
} native;

static bool native_found(void)
{
    static const struct library_function functions[] = {
        LIBRARY_FUNCTION(native, glfwGetX11Window),
        LIBRARY_FUNCTION(native, glfwGetX11Display)};
    const char *missing;
    return native.glfwGetX11Window ||
           library_load(GLFW_FILE, functions, sizeof functions / sizeof *functions, &native,
                        &missing);
}

/* NULL: none, or GLFW draws on something else than X11. */
static struct window_x11 *x11_begin(GLFWwindow *glfw)
{
    const unsigned long window = native_found() ? native.glfwGetX11Window(glfw) : 0;
    return window ? window_x11_begin(window) : NULL;
}

static void *x11_display(GLFWwindow *glfw)
{
    const bool is_x11 = native_found() && native.glfwGetX11Window(glfw);
    return is_x11 && window_x11_waits() ? native.glfwGetX11Display() : NULL;
}

/* screens: NULL: a usual window. */
static GLFWwindow *glfw_window_make(const struct window_config *config,
                                    const struct screens *screens)
{
    float x = 1, y = 1;
    GLFWmonitor *monitor = glfw3.GetPrimaryMonitor();
    if (monitor)
        glfw3.GetMonitorContentScale(monitor, &x, &y);
    glfw3.DefaultWindowHints();
    glfw3.WindowHint(GLFW_CONTEXT_VERSION_MAJOR, 2);
    glfw3.WindowHint(GLFW_CONTEXT_VERSION_MINOR, 1);
    glfw3.WindowHint(GLFW_DEPTH_BITS, 0);
    glfw3.WindowHint(GLFW_STENCIL_BITS, 0);
    glfw3.WindowHint(GLFW_SCALE_TO_MONITOR, x >= SCALE_LEAST);
    glfw3.WindowHint(GLFW_VISIBLE, GLFW_FALSE);
    glfw3.WindowHint(GLFW_AUTO_ICONIFY, !screens); /* it stays where another is used */
    glfw3.WindowHint(GLFW_DECORATED, !screens || screens->over_count == 1);
    GLFWwindow *glfw =
        glfw3.CreateWindow(config->width_px, config->height_px, config->title, NULL, NULL);
    if (!glfw)
        return NULL;

    int at[2], room[2] = {0}, size[2];
    glfw3.GetWindowSize(glfw, &size[0], &size[1]);
    if (monitor)
        glfw3.GetMonitorWorkarea(monitor, &at[0], &at[1], &room[0], &room[1]);
    if (room[0] > 0 && room[1] > 0 && (size[0] > room[0] || size[1] > room[1])) {
        /* A tenth is left for the window's frame. */
        double scale = 0.9 * fmin((double)room[0] / size[0], (double)room[1] / size[1]);
        int width = (int)lround(size[0] * scale), height = (int)lround(size[1] * scale);
        glfw3.SetWindowSize(glfw, width > 1 ? width : 1, height > 1 ? height : 1);
    }
    return glfw;
}

/* NULL: it stays as it is. */
static enum display_status window_screens_fill(struct window *window,
                                               const struct screens *screens)
{
    int *b = window->before;
    if (!screens)
        return DISPLAY_OK;
    if (screens->over_count > 1) {
        screens_cover(window->glfw, screens->over, screens->over_count);
        window->edgeless = true;
    } else {
        glfw3.GetWindowPos(window->glfw, &b[0], &b[1]);
        glfw3.GetWindowSize(window->glfw, &b[2], &b[3]);
        window->fullscreen = screens_fill(window->glfw, screens->over[0]);
    }
    if (screens->same_count && !(window->repeat = window_repeat_create(window, screens)))
        return fail_glfw("no window on a further screen");
    return DISPLAY_OK;
}

static void texture_make(struct window *window)
{
    const struct gl *gl = &window->gl;
    gl->GetIntegerv(GL_MAX_TEXTURE_SIZE, &window->side_max_px);
    gl->GenTextures(1, &window->texture);
    gl->BindTexture(GL_TEXTURE_2D, window->texture);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl->TexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
    gl->BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
}

enum display_status window_create(const struct window_config *config, struct window **out)
{
    enum display_status status;
    *out = NULL;
    if (!config->title || config->width_px < WINDOW_SIDE_MIN ||
        config->height_px < WINDOW_SIDE_MIN || config->width_px > WINDOW_SIDE_MAX ||
        config->height_px > WINDOW_SIDE_MAX)
        return display_fail(
            DISPLAY_BAD_ARGUMENT,
            "a window has a title and is %d..%d pixels wide and high (got %dx%d%s)",
            WINDOW_SIDE_MIN, WINDOW_SIDE_MAX, config->width_px, config->height_px,
            config->title ? "" : ", no title");
    if (!window_possible())
        return display_fail(DISPLAY_NO_WINDOW,
                            "no display: neither DISPLAY nor WAYLAND_DISPLAY is set");
    struct window *window = calloc(1, sizeof *window);
    if (!window)
        return display_fail(DISPLAY_NO_MEMORY, "no memory for a window");
    const char *why;
    if (!glfw_load(&why)) {
        status = display_fail(DISPLAY_NO_WINDOW, "no window: GLFW cannot be loaded: %s", why);
        goto failed;
    }
/* since 3.4, which else looks for Wayland, too, and its errors are of that */
#ifdef GLFW_PLATFORM
    const char *wayland = getenv("WAYLAND_DISPLAY");
    glfw3.InitHint(GLFW_PLATFORM, wayland && *wayland ? GLFW_ANY_PLATFORM : GLFW_PLATFORM_X11);
#endif
    if (!glfw3.Init()) {
        status = fail_glfw("no display");
        goto failed;
    }
    char why_not[500];
    struct screens chosen, *screens = config->screen ? &chosen : NULL;
    if (screens && !screens_read(config->screen, screens, why_not, sizeof why_not)) {
        status = display_fail(DISPLAY_BAD_ARGUMENT, "%s", why_not);
        goto failed;
    }
    window->glfw = glfw_window_make(config, screens);
    if (!window->glfw) {
        status = fail_glfw("no window");
        goto failed;
    }
    glfw3.MakeContextCurrent(window->glfw);
    if (!functions_find(&window->gl)) {
        status = display_fail(DISPLAY_NO_WINDOW, "no window: this display has no OpenGL 2.1");
        goto failed;
    }
    glfw3.SwapInterval(config->vsync);
    texture_make(window);
    window->drawn_by_caller = config->drawn_by_caller;
    if (!window->drawn_by_caller && !(screens && screens->same_count) &&
        gl_is_software(&window->gl))
        window->x11 = x11_begin(window->glfw);
    window_input_begin(window);
    window_wakes(x11_display(window->glfw));
    glfw3.ShowWindow(window->glfw);
    status = window_screens_fill(window, screens);
    if (status != DISPLAY_OK)
        goto failed;
    window_draw(window);
    *out = window;
    return DISPLAY_OK;

failed:
    window_destroy(window);
    return status;
}

void window_destroy(struct window *window)
{
    if (!window)
        return;
    window_x11_end(window->x11);
    if (window->glfw) {
        glfw3.MakeContextCurrent(window->glfw);
        window_repeat_destroy(window->repeat);
        if (window->texture)
            window->gl.DeleteTextures(1, &window->texture);
        glfw3.DestroyWindow(window->glfw);
    }
    pen_close(window->pen);
    input_queue_finish(&window->queue);
    free(window);
}
