/* bristles.c - where a tuft's bristles are at rest, and what each is like, from the brush's
 * description. */
#include "model/brush_internal.h"

#include <math.h>

#define GOLDEN_ANGLE 2.3999632297286533

void sheet_brush_bristles_make(struct sheet_brush *own)
{
    const struct paper_brush *brush = &own->brush;
    for (int i = 0; i < brush->bristles; i++) {
        struct sheet_bristle *bristle = &own->bristles[i];
        uint64_t number = (uint64_t)i;
        double a = sheet_chance(brush->seed, number, 1),
               b = sheet_chance(brush->seed, number, 2);
        if (brush->flat) { /* additive recurrence: even, without rows */
            bristle->across = 2 * fmod(0.5 + 0.7548776662466927 * (i + 1) + 0.1 * a, 1) - 1;
            bristle->along = 2 * fmod(0.5 + 0.5698402909980532 * (i + 1) + 0.1 * b, 1) - 1;
        } else {
            double radius = sqrt((i + 0.2 + 0.6 * a) / brush->bristles);
            double angle = GOLDEN_ANGLE * i + b;
            bristle->across = radius * cos(angle);
            bristle->along = radius * sin(angle);
        }
        double squared = bristle->across * bristle->across + bristle->along * bristle->along;
        if (brush->flat)
            squared /= 2;
        bristle->shorter =
            fmin(0.95, brush->point * 0.8 * squared +
                           brush->uneven * 0.3 * sheet_chance(brush->seed, number, 3));
        bristle->gives = 1 + brush->uneven * (sheet_chance(brush->seed, number, 4) - 0.5);
    }
}
