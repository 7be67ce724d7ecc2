/* window_input.c - GLFW's callbacks as events in the window's queue.
 *
 * GLFW gives the pointer in screen coordinates; on fine screens one such unit is several
 * pixels.
 */
#include "window_internal.h"

#include <stdlib.h>
#include <string.h>

static struct window *window_of(GLFWwindow *glfw)
{
    return glfw3.GetWindowUserPointer(glfw);
}

/* Appends an event of the present time, at the pointer's present place. */
static void put(struct window *window, struct input_event event)
{
    struct pen_state pen = pen_now(window->pen);
    struct input_event all = window->pointer;
    all.kind = event.kind;
    all.time_s = input_now_s();
    all.pen = pen.is_pen;
    all.pressure = pen.pressure;
    all.tilt_x = pen.tilt_x;
    all.tilt_y = pen.tilt_y;
    all.button = event.button;
    all.scroll_x = event.scroll_x;
    all.scroll_y = event.scroll_y;
    all.key = event.key;
    all.character = event.character;
    all.width_px = event.width_px;
    all.height_px = event.height_px;
    all.path = event.path;
    input_queue_put(&window->queue, &all);
}

static unsigned modifiers_of(int glfw)
{
    return (glfw & GLFW_MOD_SHIFT ? INPUT_SHIFT : 0u) |
           (glfw & GLFW_MOD_CONTROL ? INPUT_CONTROL : 0u) |
           (glfw & GLFW_MOD_ALT ? INPUT_ALT : 0u) | (glfw & GLFW_MOD_SUPER ? INPUT_SUPER : 0u);
}

/* ---- the window ---- */

static void size_take(GLFWwindow *glfw, int width, int height)
{
    struct window *window = window_of(glfw);
    window->stale = true;
    put(window,
        (struct input_event){.kind = INPUT_SIZE, .width_px = width, .height_px = height});
}

static void refresh_take(GLFWwindow *glfw)
{
    window_of(glfw)->stale = true;
}

static void close_take(GLFWwindow *glfw)
{
    put(window_of(glfw), (struct input_event){.kind = INPUT_CLOSE});
}

static void focus_take(GLFWwindow *glfw, int focused)
{
    struct window *window = window_of(glfw);
    if (focused)
        return;
    window->pointer.modifiers = 0;
    put(window, (struct input_event){.kind = INPUT_FOCUS_LOST});
}

static void drop_take(GLFWwindow *glfw, int count, const char **paths)
{
    for (int i = 0; i < count; i++) {
        char *path = strdup(paths[i]);
        if (path)
            put(window_of(glfw), (struct input_event){.kind = INPUT_DROP, .path = path});
        free(path);
    }
}

/* ---- the pointer ---- */

static void place_set(struct window *window, double x, double y)
{
    int width, height, width_px, height_px;
    glfw3.GetWindowSize(window->glfw, &width, &height);
    glfw3.GetFramebufferSize(window->glfw, &width_px, &height_px);
    window->pointer.x_px = width > 0 ? x * width_px / width : x;
    window->pointer.y_px = height > 0 ? y * height_px / height : y;
}

static void move_take(GLFWwindow *glfw, double x, double y)
{
    struct window *window = window_of(glfw);
    place_set(window, x, y);
    put(window, (struct input_event){.kind = INPUT_POINTER_MOVE});
}

static void enter_take(GLFWwindow *glfw, int entered)
{
    if (!entered)
        put(window_of(glfw), (struct input_event){.kind = INPUT_POINTER_LEAVE});
}

/* The event's place is that of the last move. Asked now, GLFW would give the present place,
 * not that of the press. */
static void button_take(GLFWwindow *glfw, int button, int action, int modifiers)
{
    struct window *window = window_of(glfw);
    if (button < 0 || button >= INPUT_BUTTONS)
        return;
    window->pointer.modifiers = modifiers_of(modifiers);
    if (action == GLFW_RELEASE)
        window->pointer.buttons &= ~(1u << button);
    else
        window->pointer.buttons |= 1u << button;
    put(window, (struct input_event){.kind = action == GLFW_RELEASE ? INPUT_POINTER_UP
                                                                    : INPUT_POINTER_DOWN,
                                     .button = button});
}

static void scroll_take(GLFWwindow *glfw, double x, double y)
{
    put(window_of(glfw),
        (struct input_event){.kind = INPUT_SCROLL, .scroll_x = x, .scroll_y = y});
}

/* ---- keys ---- */

static int key_of(int key)
{
    static const struct {
        int glfw, key;
    } names[] = {{GLFW_KEY_ESCAPE, INPUT_KEY_ESCAPE},
                 {GLFW_KEY_ENTER, INPUT_KEY_ENTER},
                 {GLFW_KEY_KP_ENTER, INPUT_KEY_ENTER},
                 {GLFW_KEY_TAB, INPUT_KEY_TAB},
                 {GLFW_KEY_BACKSPACE, INPUT_KEY_BACKSPACE},
                 {GLFW_KEY_DELETE, INPUT_KEY_DELETE},
                 {GLFW_KEY_LEFT, INPUT_KEY_LEFT},
                 {GLFW_KEY_RIGHT, INPUT_KEY_RIGHT},
                 {GLFW_KEY_UP, INPUT_KEY_UP_ARROW},
                 {GLFW_KEY_DOWN, INPUT_KEY_DOWN_ARROW},
                 {GLFW_KEY_HOME, INPUT_KEY_HOME},
                 {GLFW_KEY_END, INPUT_KEY_END},
                 {GLFW_KEY_PAGE_UP, INPUT_KEY_PAGE_UP},
                 {GLFW_KEY_PAGE_DOWN, INPUT_KEY_PAGE_DOWN},
                 {GLFW_KEY_LEFT_SHIFT, INPUT_KEY_SHIFT},
                 {GLFW_KEY_RIGHT_SHIFT, INPUT_KEY_SHIFT},
                 {GLFW_KEY_LEFT_CONTROL, INPUT_KEY_CONTROL},
                 {GLFW_KEY_RIGHT_CONTROL, INPUT_KEY_CONTROL}};
    if (key >= GLFW_KEY_SPACE && key <= GLFW_KEY_GRAVE_ACCENT)
        return key; /* GLFW's are ASCII, too */
    if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12)
        return INPUT_KEY_F1 + key - GLFW_KEY_F1;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (names[i].glfw == key)
            return names[i].key;
    return INPUT_KEY_OTHER;
}

/* The modifiers after a key went down or up; X11 reports the modifiers before the event. */
static unsigned modifiers_after(int key, int action, int modifiers)
{
    unsigned held = modifiers_of(modifiers), own = 0;
    if (key == GLFW_KEY_LEFT_SHIFT || key == GLFW_KEY_RIGHT_SHIFT)
        own = INPUT_SHIFT;
    else if (key == GLFW_KEY_LEFT_CONTROL || key == GLFW_KEY_RIGHT_CONTROL)
        own = INPUT_CONTROL;
    else if (key == GLFW_KEY_LEFT_ALT || key == GLFW_KEY_RIGHT_ALT)
        own = INPUT_ALT;
    return action == GLFW_RELEASE ? held & ~own : held | own;
}

static void key_take(GLFWwindow *glfw, int key, int scancode, int action, int modifiers)
{
    struct window *window = window_of(glfw);
    (void)scancode;
    window->pointer.modifiers = modifiers_after(key, action, modifiers);
    put(window, (struct input_event){.kind = action == GLFW_PRESS    ? INPUT_KEY_DOWN
                                             : action == GLFW_REPEAT ? INPUT_KEY_REPEAT
                                                                     : INPUT_KEY_UP,
                                     .key = key_of(key)});
}

static void text_take(GLFWwindow *glfw, unsigned int character)
{
    put(window_of(glfw), (struct input_event){.kind = INPUT_TEXT, .character = character});
}

/* ---- the queue ---- */

void window_input_begin(struct window *window)
{
    double x, y;
    GLFWwindow *glfw = window->glfw;
    window->pen = pen_open();
    glfw3.SetWindowUserPointer(glfw, window);
    glfw3.SetFramebufferSizeCallback(glfw, size_take);
    glfw3.SetWindowRefreshCallback(glfw, refresh_take);
    glfw3.SetWindowCloseCallback(glfw, close_take);
    glfw3.SetWindowFocusCallback(glfw, focus_take);
    glfw3.SetDropCallback(glfw, drop_take);
    glfw3.SetCursorPosCallback(glfw, move_take);
    glfw3.SetCursorEnterCallback(glfw, enter_take);
    glfw3.SetMouseButtonCallback(glfw, button_take);
    glfw3.SetScrollCallback(glfw, scroll_take);
    glfw3.SetKeyCallback(glfw, key_take);
    glfw3.SetCharCallback(glfw, text_take);
    glfw3.GetCursorPos(glfw, &x, &y);
    place_set(window, x, y);
}

bool window_input_take_or(struct window *window, double wait_s, int descriptor,
                          struct input_event *event)
{
    bool readable = false;
    double until_s = input_now_s() + wait_s;
    glfw3.PollEvents();
    for (;;) {
        if (window->stale)
            window_draw(window);
        double left_s = until_s - input_now_s();
        if (input_queue_take(&window->queue, event)) {
            if (event->kind == INPUT_SIZE) /* several size events were merged: use the
                                            * present size */
                window_size(window, &event->width_px, &event->height_px);
            return true;
        }
        if (!(left_s > 0) || readable)
            return false;
        readable = window_wait_or(left_s, descriptor);
    }
}

bool window_input_take(struct window *window, double wait_s, struct input_event *event)
{
    return window_input_take_or(window, wait_s, -1, event);
}

void window_close(struct window *window)
{
    if (window_closing(window))
        return;
    glfw3.SetWindowShouldClose(window->glfw, GLFW_TRUE);
    put(window, (struct input_event){.kind = INPUT_CLOSE});
}
