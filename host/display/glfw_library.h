/* glfw_library.h - GLFW, loaded when a window is opened for the first time: most programs open
 * none, and X11's library comes with it.
 *
 * glfw3.CreateWindow() is GLFW's glfwCreateWindow(). A name that is not in the table yet is
 * added there. */
#ifndef LUTETIA_GLFW_LIBRARY_H
#define LUTETIA_GLFW_LIBRARY_H

#include <GLFW/glfw3.h>
#include <stdbool.h>

/* clang-format off */
#define GLFW_NAMES(X)                                                                          \
    X(Init) X(InitHint) X(GetError) X(GetProcAddress) X(PollEvents) X(WaitEventsTimeout) X(PostEmptyEvent) \
    X(GetMonitors) X(GetMonitorPos) X(GetMonitorName) X(SetWindowPos)                          \
    X(GetPrimaryMonitor) X(GetMonitorContentScale) X(GetMonitorWorkarea) X(GetVideoMode)       \
    X(DefaultWindowHints) X(WindowHint) X(CreateWindow) X(DestroyWindow) X(ShowWindow)         \
    X(MakeContextCurrent) X(SwapBuffers) X(SwapInterval) X(GetCursorPos)                       \
    X(GetFramebufferSize) X(GetWindowContentScale) X(GetWindowPos) X(GetWindowSize)            \
    X(GetWindowUserPointer) X(SetWindowUserPointer) X(SetWindowSize) X(SetWindowTitle)         \
    X(SetWindowMonitor) X(WindowShouldClose) X(SetWindowShouldClose)                           \
    X(SetCharCallback) X(SetCursorEnterCallback) X(SetCursorPosCallback) X(SetDropCallback)    \
    X(SetFramebufferSizeCallback) X(SetKeyCallback) X(SetMouseButtonCallback)                  \
    X(SetScrollCallback) X(SetWindowCloseCallback) X(SetWindowFocusCallback)                   \
    X(SetWindowRefreshCallback)
/* clang-format on */

#define GLFW_MEMBER(name) __typeof__(glfw##name) *name;
extern struct glfw3 {
    GLFW_NAMES(GLFW_MEMBER)
} glfw3;

/* False: it cannot be loaded; *why is the reason. */
bool glfw_load(const char **why);

#endif
