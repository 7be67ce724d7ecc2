/* screens.c - see screens.h. */
#include "screens.h"

#include <error_text.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A screen's place on the desktop. False: GLFW does not tell. */
static bool place_of(GLFWmonitor *monitor, int place[4])
{
    const GLFWvidmode *mode = glfw3.GetVideoMode(monitor);
    if (!mode)
        return false;
    glfw3.GetMonitorPos(monitor, &place[0], &place[1]);
    place[2] = mode->width;
    place[3] = mode->height;
    return true;
}

bool screens_all(const char *name)
{
    return name && strcmp(name, "all") == 0;
}

bool screens_check(const char *name, char *why, size_t room)
{
    int count = 0;
    GLFWmonitor **monitors = glfw3.GetMonitors(&count);
    char *end, known[200] = "";
    const long number = strtol(name, &end, 10);
    if (count > 0 &&
        (screens_all(name) || (end != name && !*end && number >= 1 && number <= count)))
        return true;
    for (int i = 0; i < count; i++) {
        int p[4] = {0};
        char one[80];
        const char *called = glfw3.GetMonitorName(monitors[i]);
        place_of(monitors[i], p);
        snprintf(one, sizeof one, "%d (%.20s, %dx%d at %d,%d)", i + 1, called ? called : "",
                 p[2], p[3], p[0], p[1]);
        error_text_list(known, sizeof known, ", ", one);
    }
    snprintf(why, room, "there is no screen '%.20s'; there are %s%s", name, known,
             count ? ", and all" : "none");
    return false;
}

int screens_at(int x, int y)
{
    int count = 0, p[4];
    GLFWmonitor **monitors = glfw3.GetMonitors(&count);
    for (int i = 0; i < count; i++)
        if (place_of(monitors[i], p) && x >= p[0] && y >= p[1] && x < p[0] + p[2] &&
            y < p[1] + p[3])
            return i;
    return 0;
}

bool screens_fill(GLFWwindow *window, int screen)
{
    int count = 0;
    GLFWmonitor **monitors = glfw3.GetMonitors(&count);
    const GLFWvidmode *mode =
        screen >= 0 && screen < count ? glfw3.GetVideoMode(monitors[screen]) : NULL;
    if (mode)
        glfw3.SetWindowMonitor(window, monitors[screen], 0, 0, mode->width, mode->height,
                               mode->refreshRate);
    return mode;
}

void screens_cover(GLFWwindow *window)
{
    int count = 0, p[4], all[4] = {0};
    bool any = false;
    GLFWmonitor **monitors = glfw3.GetMonitors(&count);
    for (int i = 0; i < count; i++) {
        if (!place_of(monitors[i], p))
            continue;
        const int right = p[0] + p[2], bottom = p[1] + p[3];
        all[0] = any && all[0] < p[0] ? all[0] : p[0];
        all[1] = any && all[1] < p[1] ? all[1] : p[1];
        all[2] = any && all[2] > right ? all[2] : right;
        all[3] = any && all[3] > bottom ? all[3] : bottom;
        any = true;
    }
    if (!any)
        return;
    glfw3.SetWindowPos(window, all[0], all[1]);
    glfw3.SetWindowSize(window, all[2] - all[0], all[3] - all[1]);
}
