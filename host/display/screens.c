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

static void known_tell(GLFWmonitor **monitors, int count, const char *words, char *why,
                       size_t room)
{
    char known[400] = "";
    for (int i = 0; i < count; i++) {
        int p[4] = {0};
        char one[80];
        const char *called = glfw3.GetMonitorName(monitors[i]);
        place_of(monitors[i], p);
        snprintf(one, sizeof one, "%d (%.20s, %dx%d at %d,%d)", i + 1, called ? called : "",
                 p[2], p[3], p[0], p[1]);
        error_text_list(known, sizeof known, ", ", one);
    }
    snprintf(why, room, "there is no screen '%.20s'; there are %s%s", words, known,
             count ? ", and all" : "none");
}

static bool is_taken(const struct screens *s, int screen)
{
    bool taken = false;
    for (int i = 0; i < s->over_count; i++)
        taken = taken || s->over[i] == screen;
    for (int i = 0; i < s->same_count; i++)
        taken = taken || s->same[i] == screen;
    return taken;
}

/* Numbers from 1, each once; after an `=` those that show the same. */
static bool numbers_read(const char *words, int count, struct screens *out)
{
    bool same = false;
    for (;;) {
        char *end;
        const long number = *words >= '0' && *words <= '9' ? strtol(words, &end, 10) : 0;
        if (number < 1 || number > count || number > SCREENS_MAX ||
            is_taken(out, (int)number - 1))
            return false;
        if (same)
            out->same[out->same_count++] = (int)number - 1;
        else
            out->over[out->over_count++] = (int)number - 1;
        if (!*end)
            return true;
        if (*end != '=' && (*end != ',' || same))
            return false;
        same = *end == '=';
        words = end + 1;
    }
}

bool screens_read(const char *words, struct screens *out, char *why, size_t room)
{
    int count = 0;
    GLFWmonitor **monitors = glfw3.GetMonitors(&count);
    *out = (struct screens){0};
    const bool all = strcmp(words, "all") == 0;
    for (int i = 0; all && i < count && i < SCREENS_MAX; i++)
        out->over[out->over_count++] = i;
    if (all ? count > 0 : numbers_read(words, count, out))
        return true;
    known_tell(monitors, count, words, why, room);
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

void screens_cover(GLFWwindow *window, const int *screens, int screens_count)
{
    int count = 0, p[4], all[4] = {0};
    bool any = false;
    GLFWmonitor **monitors = glfw3.GetMonitors(&count);
    for (int i = 0; i < screens_count; i++) {
        if (screens[i] >= count || !place_of(monitors[screens[i]], p))
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
