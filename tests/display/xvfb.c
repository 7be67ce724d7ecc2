/* xvfb.c - runs Xvfb as a child, with an X connection besides that of the tested program. */
#include "xvfb.h"

#include "clock.h"

#include <X11/Xatom.h>
#include <X11/Xutil.h>
#include <assert.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

static pid_t server;
static Display *display;

static void moment_wait(void)
{
    usleep(10000);
}

/* Ignores X errors: a window may disappear while it is read. */
static int error_pass(Display *of, XErrorEvent *error)
{
    (void)of;
    (void)error;
    return 0;
}

_Noreturn static void server_become(int number_to, const char *size)
{
    char descriptor[16], screen[32];
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    snprintf(descriptor, sizeof descriptor, "%d", number_to);
    /* WIDTHxHEIGHT, or that and the depth */
    snprintf(screen, sizeof screen, "%s%s", size,
             strchr(strchr(size, 'x') + 1, 'x') ? "" : "x24");
    freopen("/dev/null", "w", stderr); /* what it says about keyboards */
    execlp("Xvfb", "Xvfb", "-displayfd", descriptor, "-screen", "0", screen, "-nolisten", "tcp",
           "-noreset", (char *)NULL);
    _exit(127);
}

bool screen_start(const char *size)
{
    int ends[2];
    char name[32] = ":";
    int made = pipe(ends);
    assert(made == 0);
    server = fork();
    assert(server >= 0);
    if (server == 0) {
        close(ends[0]);
        server_become(ends[1], size);
    }
    close(ends[1]);
    size_t count = 1;
    ssize_t got = 1;
    while (got > 0 && count < sizeof name - 1 && !strchr(name, '\n')) {
        got = read(ends[0], name + count, sizeof name - 1 - count);
        count += got > 0 ? (size_t)got : 0;
    }
    close(ends[0]);
    if (!strchr(name, '\n')) {
        screen_end();
        puts("[  SKIPPED ] Xvfb: it does not start; is xvfb installed?");
        return false;
    }
    *strchr(name, '\n') = '\0';
    setenv("DISPLAY", name, 1);
    unsetenv("WAYLAND_DISPLAY");
    XSetErrorHandler(error_pass);
    display = XOpenDisplay(NULL);
    assert(display);
    return true;
}

void screen_dpi(int dots_per_inch)
{
    char text[32];
    int length = snprintf(text, sizeof text, "Xft.dpi:\t%d\n", dots_per_inch);
    if (dots_per_inch)
        XChangeProperty(display, DefaultRootWindow(display), XA_RESOURCE_MANAGER, XA_STRING, 8,
                        PropModeReplace, (const unsigned char *)text, length);
    else
        XDeleteProperty(display, DefaultRootWindow(display), XA_RESOURCE_MANAGER);
    XSync(display, False);
}

void screen_end(void)
{
    if (display)
        XCloseDisplay(display);
    display = NULL;
    if (server > 0) {
        kill(server, SIGTERM);
        waitpid(server, NULL, 0);
    }
    server = 0;
    unsetenv("DISPLAY");
}

/* ---- windows ---- */

static bool is_shown(Window window, const char *title)
{
    XWindowAttributes attributes;
    char *name = NULL;
    bool is = XGetWindowAttributes(display, window, &attributes) &&
              attributes.map_state == IsViewable && XFetchName(display, window, &name) &&
              name && strstr(name, title);
    if (name)
        XFree(name);
    return is;
}

static Window window_look(const char *title)
{
    Window root, parent, *windows = NULL, found = 0;
    unsigned int count = 0;
    XQueryTree(display, DefaultRootWindow(display), &root, &parent, &windows, &count);
    for (unsigned int i = 0; i < count; i++)
        if (is_shown(windows[i], title))
            found = windows[i];
    if (windows)
        XFree(windows);
    return found;
}

Window screen_window(const char *title, double wait_s)
{
    double until = clock_now_s() + wait_s;
    Window found = window_look(title);
    while (!found && clock_now_s() < until) {
        moment_wait();
        found = window_look(title);
    }
    return found;
}

bool screen_window_gone(Window window, double wait_s)
{
    double until = clock_now_s() + wait_s;
    XWindowAttributes attributes;
    while (XGetWindowAttributes(display, window, &attributes)) {
        if (clock_now_s() > until)
            return false;
        moment_wait();
    }
    return true;
}

void screen_resize(Window window, int width_px, int height_px)
{
    XResizeWindow(display, window, (unsigned int)width_px, (unsigned int)height_px);
    XSync(display, False);
}

Display *screen_display(void)
{
    return display;
}

void screen_key(Window window, KeySym key)
{
    XEvent event = {.xkey = {.window = window,
                             .root = DefaultRootWindow(display),
                             .same_screen = True,
                             .keycode = XKeysymToKeycode(display, key)}};
    assert(event.xkey.keycode);
    for (int up = 0; up < 2; up++) {
        event.type = up ? KeyRelease : KeyPress;
        event.xkey.time = CurrentTime;
        XSendEvent(display, window, False, up ? KeyReleaseMask : KeyPressMask, &event);
    }
    XSync(display, False);
}

void screen_close(Window window)
{
    XEvent event = {.xclient = {.type = ClientMessage,
                                .window = window,
                                .message_type = XInternAtom(display, "WM_PROTOCOLS", False),
                                .format = 32}};
    event.xclient.data.l[0] = (long)XInternAtom(display, "WM_DELETE_WINDOW", False);
    event.xclient.data.l[1] = CurrentTime;
    XSendEvent(display, window, False, NoEventMask, &event);
    XSync(display, False);
}

/* ---- pictures ---- */

/* Of 256 steps, the nearest. */
static uint8_t channel_of(unsigned long colour, unsigned long mask)
{
    const unsigned long step = mask & -mask, most = mask / step;
    return (uint8_t)((colour / step & most) * 255 / most);
}

void screen_read(Window window, struct display_image *image)
{
    XWindowAttributes attributes;
    memset(image, 0, sizeof *image);
    if (!XGetWindowAttributes(display, window, &attributes))
        return;
    XImage *seen = XGetImage(display, window, 0, 0, (unsigned int)attributes.width,
                             (unsigned int)attributes.height, AllPlanes, ZPixmap);
    if (!seen)
        return;
    *image = (struct display_image){
        .width_px = attributes.width, .height_px = attributes.height, .channels = 3};
    enum display_status status = display_image_create(image);
    assert(status == DISPLAY_OK);
    for (int y = 0; y < image->height_px; y++)
        for (int x = 0; x < image->width_px; x++) {
            unsigned long colour = XGetPixel(seen, x, y);
            uint8_t *pixel = image->pixels + 3 * (y * image->width_px + x);
            pixel[0] = channel_of(colour, seen->red_mask);
            pixel[1] = channel_of(colour, seen->green_mask);
            pixel[2] = channel_of(colour, seen->blue_mask);
        }
    XDestroyImage(seen);
}

bool screen_shows(Window window, const struct display_image *image, double wait_s)
{
    double until = clock_now_s() + wait_s;
    for (;;) {
        struct display_image seen;
        size_t bytes = (size_t)image->width_px * (size_t)image->height_px * 3, at = 0;
        screen_read(window, &seen);
        bool same = seen.pixels && seen.width_px == image->width_px &&
                    seen.height_px == image->height_px;
        while (same && at < bytes && seen.pixels[at] == image->pixels[at])
            at++;
        bool late = clock_now_s() > until;
        if (late && at < bytes && same)
            fprintf(stderr, "at %d,%d channel %d: %d is seen for %d\n",
                    (int)(at / 3) % image->width_px, (int)(at / 3) / image->width_px,
                    (int)(at % 3), seen.pixels[at], image->pixels[at]);
        else if (late && !same)
            fprintf(stderr, "%dx%d pixels are seen for %dx%d\n", seen.width_px, seen.height_px,
                    image->width_px, image->height_px);
        display_image_destroy(&seen);
        if (same && at == bytes)
            return true;
        if (late)
            return false;
        moment_wait();
    }
}
