/* control_curve.h - how values of a control lie along its slider.
 *
 * LOGARITHMIC and CENTRED: the usual value is in the middle, and values near it have the most
 * of the way. SWITCH: 0 or 1. CHOICE: the number of one of the choices. */
#ifndef LUTETIA_CONTROL_CURVE_H
#define LUTETIA_CONTROL_CURVE_H

enum control_curve {
    CONTROL_LINEAR,
    CONTROL_LOGARITHMIC,
    CONTROL_CENTRED,
    CONTROL_SWITCH,
    CONTROL_CHOICE
};
enum { CONTROL_CURVES = CONTROL_CHOICE + 1 };

#endif
