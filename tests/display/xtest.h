/* xtest.h - simulates a person on the tests' screen by XTest: the pointer, its buttons and the
 * keyboard. Grabs, focus and modifiers are the X server's own.
 *
 *     xtest_move(window, 100, 50);
 *     xtest_button(1, true);
 *     xtest_move(window, 180, 90);
 *     xtest_button(1, false);
 */
#ifndef LUTETIA_TEST_XTEST_H
#define LUTETIA_TEST_XTEST_H

#include "xvfb.h"

void xtest_move(Window window, int x_px, int y_px);
void xtest_button(unsigned button,
                  bool down); /* X11's button: 1 left, 2 middle, 3 right, 4 and 5 the wheel */
void xtest_key(KeySym key, bool down);
void xtest_type(KeySym key); /* down and up */

#endif
