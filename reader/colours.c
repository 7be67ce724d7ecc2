/* colours.c - see reader_colours.h. */
#include "reader_colours.h"

static const struct reader_colours themes[] = {
    {.paper = {254 / 255.0, 252 / 255.0, 248 / 255.0},
     .ink = {0.07, 0.07, 0.08},
     .link = {0.08, 0.22, 0.55},
     .struck = {0.42, 0.42, 0.42},
     .selected = {0.72, 0.84, 1},
     .found = {1, 0.93, 0.6},
     .current = {1, 0.75, 0.35},
     .marked = {1, 0.93, 0.45},
     .noted = {0.75, 0.89, 1}},
    {.paper = {28 / 255.0, 28 / 255.0, 30 / 255.0},
     .ink = {0.86, 0.85, 0.82},
     .link = {0.55, 0.75, 1},
     .struck = {0.62, 0.62, 0.62},
     .selected = {0.17, 0.29, 0.45},
     .found = {0.36, 0.31, 0.08},
     .current = {0.52, 0.34, 0.05},
     .marked = {0.38, 0.33, 0.04},
     .noted = {0.1, 0.27, 0.4}}};

const struct reader_colours *reader_colours_of(bool dark)
{
    return &themes[dark];
}
