/* pigment.c - pigments: the tables, and Kubelka-Munk's K and S from two colours.
 *
 * K, S, density, staining and granulation of the first twelve pigments are those of Curtis
 * et al. 1997, table 1. Their mobility in fibers is our choice: it falls with density.
 * Cyan, magenta and yellow are the thesis's; their K and S are those of ideal inks that take
 * one channel and scatter a little.
 */
#include "sheet.h"

#include "base/base.h"

#include <math.h>
#include <stdio.h>
#include <strings.h>

/* name; weight; density, staining, granulation; K; S; takes */
// clang-format off
static const struct paper_pigment pigments[] = {
    {"quinacridone rose", {0.8, 0.8}, .02, 5.5, .81, {.22, 1.47, .57}, {.05, .003, .03}, {0.1, 0.9, 0.4}},
    {"indian red", {0.4, 0.4}, .05, 7.0, .40, {.46, 1.07, 1.50}, {1.28, .38, .21}, {0.3, 0.7, 0.8}},
    {"cadmium yellow", {0.4, 0.4}, .05, 3.4, .81, {.10, .36, 3.45}, {.97, .65, .007}, {0.0, 0.2, 0.95}},
    {"hooker's green", {0.25, 0.25}, .09, 1.0, .41, {1.62, .61, 1.64}, {.01, .012, .003}, {0.85, 0.45, 0.85}},
    {"cerulean blue", {0.9, 0.9}, .01, 1.0, .31, {1.52, .32, .25}, {.06, .26, .40}, {0.85, 0.3, 0.1}},
    {"burnt umber", {0.25, 0.25}, .09, 9.3, .90, {.74, 1.54, 2.10}, {.09, .09, .004}, {0.5, 0.8, 0.9}},
    {"cadmium red", {0.8, 0.8}, .02, 1.0, .63, {.14, 1.08, 1.68}, {.77, .015, .018}, {0.1, 0.8, 0.9}},
    {"brilliant orange", {0.9, 0.9}, .01, 1.0, .14, {.13, .81, 3.45}, {.005, .009, .007}, {0.0, 0.55, 0.95}},
    {"hansa yellow", {0.35, 0.35}, .06, 1.0, .08, {.06, .21, 1.78}, {.50, .88, .009}, {0.0, 0.1, 0.85}},
    {"phthalo green", {0.8, 0.8}, .02, 1.0, .12, {1.55, .47, .63}, {.01, .05, .035}, {0.85, 0.3, 0.5}},
    {"french ultramarine", {0.9, 0.9}, .01, 3.1, .91, {.86, .86, .06}, {.005, .005, .09}, {0.75, 0.7, 0.1}},
    {"interference lilac", {0.35, 0.35}, .06, 1.0, .08, {.08, .11, .07}, {1.25, .42, 1.43}, {0.1, 0.2, 0.05}},
    {"cyan", {1.0, 1.0}, .01, 1.0, 0, {1.8, .12, .05}, {.01, .03, .05}, {1, 0, 0}},
    {"magenta", {0.35, 0.35}, .01, 1.0, 0, {.08, 1.8, .15}, {.05, .01, .03}, {0, 1, 0}},
    {"yellow", {0.7, 0.7}, .01, 1.0, 0, {.03, .08, 1.8}, {.05, .04, .01}, {0, 0, 1}},
};
// clang-format on

enum { PIGMENTS_COUNT = sizeof pigments / sizeof *pigments };

const struct paper_pigment *paper_pigment_number(int number)
{
    return number >= 0 && number < PIGMENTS_COUNT ? &pigments[number] : NULL;
}

void paper_pigment_names(char *text, size_t room)
{
    size_t used = 0;
    *text = '\0';
    for (int i = 0; i < PIGMENTS_COUNT && used < room; i++)
        used +=
            (size_t)snprintf(text + used, room - used, "%s%s", i ? ", " : "", pigments[i].name);
}

const struct paper_pigment *paper_pigment_find(const char *name)
{
    for (int i = 0; i < PIGMENTS_COUNT; i++)
        if (strcasecmp(pigments[i].name, name) == 0)
            return &pigments[i];
    return NULL;
}

enum paper_status paper_pigment_colors(struct paper_pigment *pigment,
                                       const double over_white[3], const double over_black[3])
{
    double k[3], s[3];
    for (int i = 0; i < 3; i++) {
        double w = over_white[i], b = over_black[i];
        if (!(b > 0 && w > b && w < 1))
            return paper_fail(
                PAPER_BAD_ARGUMENT,
                "a pigment's colours must be 0 < over black < over white < 1 in each "
                "channel (got %g over black and %g over white)",
                b, w);
        double alpha = 0.5 * (w + (b - w + 1) / b), beta = sqrt(alpha * alpha - 1);
        double cotangent = (beta * beta - (alpha - w) * (alpha - 1)) / (beta * (1 - w));
        s[i] = atanh(1 / cotangent) / beta;
        k[i] = s[i] * (alpha - 1);
        if (!(s[i] >= 0 && s[i] <= 100 && k[i] >= 0 && k[i] <= 100))
            return paper_fail(PAPER_BAD_ARGUMENT,
                              "no pigment looks %g over black and %g over white; take colours "
                              "further from 0, from 1 and from each other",
                              b, w);
    }
    for (int i = 0; i < 3; i++) {
        pigment->k[i] = k[i];
        pigment->s[i] = s[i];
    }
    return PAPER_OK;
}

double paper_light_linear(double display)
{
    return display <= 0.04045 ? display / 12.92 : pow((display + 0.055) / 1.055, 2.4);
}

double paper_light_display(double linear)
{
    return linear <= 0.0031308 ? linear * 12.92 : 1.055 * pow(linear, 1 / 2.4) - 0.055;
}
