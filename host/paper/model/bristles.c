/* bristles.c - where a tuft's bristles are at rest, and what each is like, from the brush's
 * description; and how its hairs part and lift on their way.
 *
 *      across |      .--.          .--.       noises over the tuft and the way: hairs that lie
 *             |  .--'    `--.  .--'    `-     together move together, so a gap opens between two
 *             |  ------------------------     tufts of them, and closes farther on; where the
 *             +---------------------> way     noise is high hairs are lifted, and reach less far
 *
 * The way is that of the tuft's middle. Noises are sums and products of numbers by chance: the
 * same bits everywhere. */
#include "model/brush_internal.h"
#include "model/clouds.h"

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

/* How wide tufts of hairs are that move together, and how far they go until they have moved
 * otherwise: of the gaps, and of lifted hairs in two sizes. Fibers. */
#define PART_WIDE 3.0
#define PART_LONG 45.0
#define LIFT_WIDE 2.5
#define LIFT_LONG 22.0
#define LIFT_FURTHER 2.7 /* the second size, of the first */
/* Fibers that hairs part by. */
#define PARTING 1.6

/* A number by chance, -1..1, at a corner of a noise's grid. */
static double corner(uint64_t seed, double across, double along)
{
    return 2 * clouds_chance(clouds_word(seed, (uint64_t)(int64_t)across),
                             (uint64_t)(int64_t)along) -
           1;
}

/* A noise of size 1, -1..1. */
static double noise(uint64_t seed, double across, double along)
{
    const double i = floor(across), j = floor(along);
    double u = across - i, v = along - j;
    u *= u * (3 - 2 * u);
    v *= v * (3 - 2 * v);
    return (1 - v) * ((1 - u) * corner(seed, i, j) + u * corner(seed, i + 1, j)) +
           v * ((1 - u) * corner(seed, i, j + 1) + u * corner(seed, i + 1, j + 1));
}

struct sheet_hair sheet_hair_at(const struct sheet_brush *own, int number, uint64_t seed,
                                double way, double finer)
{
    const struct paper_brush *brush = &own->brush;
    const double across = own->bristles[number].across * brush->width / (2 * finer),
                 along = way / finer;
    const double lifted = noise(seed + 1, across / LIFT_WIDE, along / LIFT_LONG) +
                          noise(seed + 2, across / (LIFT_FURTHER * LIFT_WIDE),
                                along / (LIFT_FURTHER * LIFT_LONG));
    return (struct sheet_hair){.aside = finer * PARTING *
                                        noise(seed, across / PART_WIDE, along / PART_LONG),
                               .lifted = fmin(1, fmax(0, brush->uneven * lifted))};
}
