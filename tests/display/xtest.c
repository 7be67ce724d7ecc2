/* xtest.c - see xtest.h. */
#include "xtest.h"

#include <X11/extensions/XTest.h>
#include <assert.h>

void xtest_move(Window window, int x_px, int y_px)
{
    Display *display = screen_display();
    Window child;
    int x, y;
    XTranslateCoordinates(display, window, DefaultRootWindow(display), x_px, y_px, &x, &y,
                          &child);
    XTestFakeMotionEvent(display, -1, x, y, CurrentTime);
    XSync(display, False);
}

void xtest_button(unsigned button, bool down)
{
    XTestFakeButtonEvent(screen_display(), button, down, CurrentTime);
    XSync(screen_display(), False);
}

void xtest_key(KeySym key, bool down)
{
    KeyCode code = XKeysymToKeycode(screen_display(), key);
    assert(code);
    XTestFakeKeyEvent(screen_display(), code, down, CurrentTime);
    XSync(screen_display(), False);
}

void xtest_type(KeySym key)
{
    xtest_key(key, true);
    xtest_key(key, false);
}
