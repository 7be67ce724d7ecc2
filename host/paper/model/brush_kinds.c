/* brush_kinds.c - the kinds of brushes: sizes relative to the width. */
#include <brush.h>

#include <math.h>
#include <string.h>

static const struct kind {
    const char *name;
    bool flat;
    double depth, point, uneven, splay, bend, bristles, thickness, reach, load, mixing;
} kinds[] = {
    {"round", false, 0.75, 0.75, 0.25, 0.25, 0.3, 8, 0.07, 30, 0.7, 0.15},
    {"flat", true, 0.22, 0.1, 0.3, 0.15, 0.2, 7, 0.06, 22, 0.7, 0.15},
    {"mop", false, 0.9, 0.35, 0.15, 0.5, 0.3, 8, 0.10, 60, 1.0, 0.25},
    {"rigger", false, 1.0, 0.9, 0.1, 0.4, 0.8, 8, 0.15, 140, 0.6, 0.1},
    {"fan", true, 0.15, 0.0, 1.0, 0.5, 0.15, 2.5, 0.05, 18, 0.6, 0.1},
    {"bristle", true, 0.35, 0.15, 0.9, 0.3, 0.3, 4, 0.05, 14, 0.6, 0.1},
};
enum { KINDS = sizeof kinds / sizeof *kinds };

const char *paper_brush_kind(int number)
{
    return number >= 0 && number < KINDS ? kinds[number].name : NULL;
}

bool paper_brush_of_kind(struct paper_brush *brush, const char *kind)
{
    for (int i = 0; i < KINDS; i++) {
        const struct kind *k = &kinds[i];
        if (strcmp(k->name, kind) != 0)
            continue;
        brush->flat = k->flat;
        brush->point = k->point;
        brush->uneven = k->uneven;
        brush->splay = k->splay;
        brush->bend = k->bend;
        brush->load = k->load;
        brush->mixing = k->mixing;
        brush->depth = fmax(1, k->depth * brush->width);
        brush->bristles = (int)fmin(PAPER_BRISTLES_MAX, fmax(12, k->bristles * brush->width));
        brush->thickness = fmax(1.2, k->thickness * brush->width);
        brush->reach = k->reach * brush->width;
        return true;
    }
    return false;
}
