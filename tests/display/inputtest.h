/* inputtest.h - pens and mice of Xorg's input driver "inputtest", which report by XInput 2 as
 * a tablet's driver does.
 *
 *     enum { PEN, MOUSE };
 *     static const struct inputtest_kind kinds[] = {{"pen", true, true}, {"mouse", false, false}};
 *     if (mkdtemp(folder) && inputtest_start(folder, kinds, 2)) {     // xorg_display() is there
 *         inputtest_move(PEN, 400, 300, 0.5);
 *         inputtest_press(PEN, true);
 *     }
 *     xorg_end(folder);
 *
 * When a function returns, the server has done what it says. */
#ifndef LUTETIA_TEST_INPUTTEST_H
#define LUTETIA_TEST_INPUTTEST_H

#include <stdbool.h>

enum { INPUTTEST_WIDTH = 1280, INPUTTEST_HEIGHT = 1024, INPUTTEST_DEVICES = 8 };

struct inputtest_kind {
    const char *name;   /* of the device */
    bool pen, pressure; /* a pen has places of the screen; else it is a mouse */
};

/* An Xorg with these devices, the last of which is its pointer's own. False: there is none with
 * that driver, or it may not be started. */
bool inputtest_start(const char *folder, const struct inputtest_kind *kinds, int count);
/* A pen's place, in pixels of the screen. pressure < 0: it has none. */
void inputtest_move(int device, double x_px, double y_px, double pressure);
void inputtest_push(int device, double right_px, double down_px); /* of a mouse */
void inputtest_press(int device, bool down); /* its first button, or point */

#endif
