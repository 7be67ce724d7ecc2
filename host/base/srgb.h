/* srgb.h - the numbers of a display's colours, 0 to 1, and the light that they stand for.
 *
 *     double half = srgb_number ((srgb_light (a) + srgb_light (b)) / 2);
 *
 * Source: IEC 61966-2-1. Errors: none. Threads: any. */
#ifndef LUTETIA_SRGB_H
#define LUTETIA_SRGB_H

#include <math.h>

static inline double srgb_light(double number)
{
    return number <= 0.04045 ? number / 12.92 : pow((number + 0.055) / 1.055, 2.4);
}

static inline double srgb_number(double light)
{
    return light <= 0.0031308 ? 12.92 * light : 1.055 * pow(light, 1 / 2.4) - 0.055;
}

#endif
