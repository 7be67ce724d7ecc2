/* pigment.c - paints by their names, and Kubelka and Munk's K and S from two colours.
 *
 * K, S, density, staining and granulation of the first twelve pigments are those of Curtis et
 * al. 1997, table 1. Their mobility in fibers is our choice: it falls with density. Cyan,
 * magenta and yellow are the thesis's; their K and S are those of ideal inks that take one
 * channel and scatter a little. Names mean these in scripts that were recorded before there
 * were paints (paints.c).
 */
#include "sheet.h"

#include "base/base.h"

#include <srgb.h>

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

/* name; weight; density, staining, granulation; K; S; takes */
// clang-format off
static const struct paper_pigment curtis[] = {
    {"quinacridone rose", {0.8, 0.8}, .02, 5.5, .81, {.22, 1.47, .57}, {.05, .003, .03}, {0.1, 0.9, 0.4}, {0}, {0}, 0},
    {"indian red", {0.4, 0.4}, .05, 7.0, .40, {.46, 1.07, 1.50}, {1.28, .38, .21}, {0.3, 0.7, 0.8}, {0}, {0}, 0},
    {"cadmium yellow", {0.4, 0.4}, .05, 3.4, .81, {.10, .36, 3.45}, {.97, .65, .007}, {0.0, 0.2, 0.95}, {0}, {0}, 0},
    {"hooker's green", {0.25, 0.25}, .09, 1.0, .41, {1.62, .61, 1.64}, {.01, .012, .003}, {0.85, 0.45, 0.85}, {0}, {0}, 0},
    {"cerulean blue", {0.9, 0.9}, .01, 1.0, .31, {1.52, .32, .25}, {.06, .26, .40}, {0.85, 0.3, 0.1}, {0}, {0}, 0},
    {"burnt umber", {0.25, 0.25}, .09, 9.3, .90, {.74, 1.54, 2.10}, {.09, .09, .004}, {0.5, 0.8, 0.9}, {0}, {0}, 0},
    {"cadmium red", {0.8, 0.8}, .02, 1.0, .63, {.14, 1.08, 1.68}, {.77, .015, .018}, {0.1, 0.8, 0.9}, {0}, {0}, 0},
    {"brilliant orange", {0.9, 0.9}, .01, 1.0, .14, {.13, .81, 3.45}, {.005, .009, .007}, {0.0, 0.55, 0.95}, {0}, {0}, 0},
    {"hansa yellow", {0.35, 0.35}, .06, 1.0, .08, {.06, .21, 1.78}, {.50, .88, .009}, {0.0, 0.1, 0.85}, {0}, {0}, 0},
    {"phthalo green", {0.8, 0.8}, .02, 1.0, .12, {1.55, .47, .63}, {.01, .05, .035}, {0.85, 0.3, 0.5}, {0}, {0}, 0},
    {"french ultramarine", {0.9, 0.9}, .01, 3.1, .91, {.86, .86, .06}, {.005, .005, .09}, {0.75, 0.7, 0.1}, {0}, {0}, 0},
    {"interference lilac", {0.35, 0.35}, .06, 1.0, .08, {.08, .11, .07}, {1.25, .42, 1.43}, {0.1, 0.2, 0.05}, {0}, {0}, 0},
    {"cyan", {1.0, 1.0}, .01, 1.0, 0, {1.8, .12, .05}, {.01, .03, .05}, {1, 0, 0}, {0}, {0}, 0},
    {"magenta", {0.35, 0.35}, .01, 1.0, 0, {.08, 1.8, .15}, {.05, .01, .03}, {0, 1, 0}, {0}, {0}, 0},
    {"yellow", {0.7, 0.7}, .01, 1.0, 0, {.03, .08, 1.8}, {.05, .04, .01}, {0, 0, 1}, {0}, {0}, 0},
};
// clang-format on

enum { CURTIS_COUNT = sizeof curtis / sizeof *curtis };

const struct paper_pigment *paper_pigment_curtis(const char *name)
{
    for (int i = 0; i < CURTIS_COUNT; i++)
        if (strcasecmp(curtis[i].name, name) == 0)
            return &curtis[i];
    return NULL;
}

const struct paper_pigment *paper_pigment_number(int number)
{
    const struct paper_paint *paint = paper_paint_number(number);
    return paint ? &paint->pigment : NULL;
}

void paper_pigment_names(char *text, size_t room)
{
    size_t used = 0;
    *text = '\0';
    for (int i = 0; paper_pigment_number(i) && used < room; i++)
        used += (size_t)snprintf(text + used, room - used, "%s%s", i ? ", " : "",
                                 paper_pigment_number(i)->name);
}

/* Whether it is one of the names with ", " between them. */
static bool among(const char *names, const char *name)
{
    const size_t length = strlen(name);
    for (const char *at = names; at && *at; at = strchr(at, ',')) {
        at += *at == ',' ? 2 : 0;
        if (strncasecmp(at, name, length) == 0 && (at[length] == ',' || !at[length]))
            return length > 0;
    }
    return false;
}

const struct paper_pigment *paper_pigment_find(const char *name)
{
    const struct paper_paint *paint;
    for (int i = 0; (paint = paper_paint_number(i)); i++)
        if (strcasecmp(paint->pigment.name, name) == 0 || among(paint->also, name))
            return &paint->pigment;
    return NULL;
}

void paper_layer_of(double white, double black, double *k, double *s)
{
    const double alpha = 0.5 * (white + (black - white + 1) / black),
                 beta = sqrt(alpha * alpha - 1),
                 cotangent =
                     (beta * beta - (alpha - white) * (alpha - 1)) / (beta * (1 - white));
    *s = atanh(1 / cotangent) / beta;
    *k = *s * (alpha - 1);
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
        paper_layer_of(w, b, &k[i], &s[i]);
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
    paper_pigment_unband(pigment);
    return PAPER_OK;
}

void paper_pigment_unband(struct paper_pigment *pigment)
{
    for (int band = 0; band < PAPER_BANDS; band++)
        pigment->absorption[band] = pigment->scattering[band] = 0;
}

double paper_light_linear(double display)
{
    return srgb_light(display);
}

double paper_light_display(double linear)
{
    return srgb_number(linear);
}
