/* hand.c - see hand.h. */
#include "hand.h"

#include <X11/extensions/XTest.h>
#include <assert.h>

void hand_move(Window window, int x_px, int y_px)
{
    Display *display = screen_display();
    Window child;
    int x, y;
    XTranslateCoordinates(display, window, DefaultRootWindow(display), x_px, y_px, &x, &y,
                          &child);
    XTestFakeMotionEvent(display, -1, x, y, CurrentTime);
    XSync(display, False);
}

void hand_button(unsigned button, bool down)
{
    XTestFakeButtonEvent(screen_display(), button, down, CurrentTime);
    XSync(screen_display(), False);
}

void hand_key(KeySym key, bool down)
{
    KeyCode code = XKeysymToKeycode(screen_display(), key);
    assert(code);
    XTestFakeKeyEvent(screen_display(), code, down, CurrentTime);
    XSync(screen_display(), False);
}

void hand_type(KeySym key)
{
    hand_key(key, true);
    hand_key(key, false);
}
