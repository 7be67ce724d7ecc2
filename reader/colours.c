/* colours.c - see reader_colours.h. */
#include "reader_colours.h"

#include <srgb.h>

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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
     .current = {0.5, 0.325, 0.05},
     .marked = {0.38, 0.33, 0.04},
     .noted = {0.1, 0.27, 0.4}}};

const struct reader_colours *reader_colours_of(bool dark)
{
    return &themes[dark];
}

const char *const reader_colour_names[READER_COLOURS] = {
    "paper", "ink", "link", "struck", "selected", "found", "current", "marked", "noted"};
_Static_assert(sizeof(struct reader_colours) == READER_COLOURS * 3 * sizeof(double),
               "all have names");

double *reader_colour_at(struct reader_colours *colours, int colour)
{
    return (double *)(void *)colours + 3 * (size_t)colour;
}

bool reader_colour_read(const char *text, double rgb[3])
{
    if (*text != '#' || strlen(text) != 7 || strspn(text + 1, "0123456789abcdefABCDEF") != 6)
        return false;
    const unsigned long all = strtoul(text + 1, NULL, 16);
    for (int c = 0; c < 3; c++)
        rgb[c] = (double)(all >> (16 - 8 * c) & 255) / 255;
    return true;
}

void reader_colour_text(const double rgb[3], char text[8])
{
    snprintf(text, 8, "#%02x%02x%02x", (unsigned)lrint(255 * rgb[0]) & 255,
             (unsigned)lrint(255 * rgb[1]) & 255, (unsigned)lrint(255 * rgb[2]) & 255);
}

static double light_of(const double rgb[3])
{
    return 0.2126 * srgb_light(rgb[0]) + 0.7152 * srgb_light(rgb[1]) +
           0.0722 * srgb_light(rgb[2]);
}

/* Source: Web Content Accessibility Guidelines 2.1, "contrast ratio". */
double reader_colour_contrast(const struct reader_colours *c, int colour)
{
    const double *own = (const double *)(const void *)c + 3 * (size_t)colour;
    const bool letters = own == c->ink || own == c->link || own == c->struck;
    const double a = light_of(letters ? own : c->ink), b = light_of(letters ? c->paper : own);
    return (fmax(a, b) + 0.05) / (fmin(a, b) + 0.05);
}
