/* test_paints.c - paints as painters know them: their colours, their tints, what they do in
 * mixtures. How they stain and granulate: test_staining.c.
 *
 * Swatches are published measurements of paint that shops sell. "measured" spectra were not
 * made from them, "fitted" ones were (docs/paints.md). Layers are computed here by Kubelka and
 * Munk's own formulas, means over a fiber as sums over amounts, and light from the CIE's
 * tables. */
#include <bands.h>
#include <paper.h>
#include <separate.h>
#include <sheet.h>

#include "sheet_calls.h"
#include "sheets.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define DEGREES 57.295779513082323

/* ---- light ---- */

enum { WAVES = 36 }; /* 380 to 730 nm, every 10 */

/* The CIE's of 1931 (2 degrees), x, y and z, and D65. */
static const double cie[4][WAVES] = {
    {.0014, .0042, .0143, .0435, .1344, .2839, .3483, .3362, .2908, .1954,  .0956,  .0320,
     .0049, .0093, .0633, .1655, .2904, .4334, .5945, .7621, .9163, 1.0263, 1.0622, 1.0026,
     .8544, .6424, .4479, .2835, .1649, .0874, .0468, .0227, .0114, .0058,  .0029,  .0014},
    {.0000, .0001, .0004, .0012, .0040, .0116, .0230, .0380, .0600, .0910, .1390, .2080,
     .3230, .5030, .7100, .8620, .9540, .9950, .9950, .9520, .8700, .7570, .6310, .5030,
     .3810, .2650, .1750, .1070, .0610, .0320, .0170, .0082, .0041, .0021, .0010, .0005},
    {.0065, .0201, .0679, .2074, .6456, 1.3856, 1.7471, 1.7721, 1.6692, 1.2876, .8130, .4652,
     .2720, .1582, .0782, .0422, .0203, .0087,  .0039,  .0021,  .0017,  .0011,  .0008, .0003,
     .0002, 0,     0,     0,     0,     0,      0,      0,      0,      0,      0,     0},
    {49.98,  54.65,  82.75,  91.49,  93.43,  86.68,  104.86, 117.01, 117.81,
     114.86, 115.92, 108.81, 109.35, 107.80, 104.79, 107.69, 104.41, 104.05,
     100.00, 96.33,  95.79,  88.69,  90.01,  89.60,  87.70,  83.29,  83.70,
     80.03,  80.21,  82.28,  78.28,  69.72,  71.61,  74.35,  61.60,  69.89}};

/* XYZ to linear light of sRGB: IEC 61966-2-1. */
static const double light_of_xyz[3][3] = {{3.2404542, -1.5371385, -0.4985314},
                                          {-0.9692660, 1.8760108, 0.0415560},
                                          {0.0556434, -0.2040259, 1.0572252}};

/* What one channel sees of the light between two waves; linear between the table's. */
static double light_between(int channel, double from, double to)
{
    double sum = 0, all = 0;
    for (double nm = 380.25; nm < 730; nm += 0.5) {
        const int i = (int)((nm - 380) / 10);
        const double part = (nm - 380) / 10 - i;
        double value[4], light = 0;
        for (int k = 0; k < 4; k++)
            value[k] = cie[k][i] * (1 - part) + cie[k][i + 1] * part;
        for (int k = 0; k < 3; k++)
            light += light_of_xyz[channel][k] * value[k] * value[3];
        all += light;
        sum += nm > from && nm < to ? light : 0;
    }
    return sum / all;
}

static void bands_are_the_cies(void **state)
{
    (void)state;
    for (int band = 0; band < PAPER_BANDS; band++) {
        double sum = 0;
        for (int i = 0; i < 3; i++) {
            const double light = light_between(i, 380 + 35 * band, 415 + 35 * band);
            if (!(fabs(light - paper_light_of_band[i][band]) < 0.004))
                fail_msg("band %d: %g of channel %d, and the CIE's are %g", band,
                         paper_light_of_band[i][band], i, light);
            sum += paper_band_of_light[band][i];
            assert_true(paper_band_of_light[band][i] >= 0);
        }
        assert_true(fabs(sum - 1) < 1e-6);
    }
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            double sum = 0;
            for (int band = 0; band < PAPER_BANDS; band++)
                sum += paper_light_of_band[i][band] * paper_band_of_light[band][k];
            assert_true(fabs(sum - (i == k)) < 1e-5);
        }
}

/* ---- colours by hand ---- */

/* Kubelka and Munk: a layer's reflectance and transmittance, and the light between it and what
 * is below. */
static double layer_by_hand(double k, double s, double below)
{
    double r = 0, t = 1;
    if (s < 1e-9) {
        t = exp(-k);
    } else {
        const double a = 1 + k / s, b = sqrt(a * a - 1), x = fmin(b * s, 300);
        const double c = a * sinh(x) + b * cosh(x);
        r = x > 1e-9 ? sinh(x) / c : s / (1 + s);
        t = x > 1e-9 ? b / c : 1 / (1 + s);
    }
    return r + t * t * below / (1 - r * below);
}

/* Paint whose amounts are spread by a gamma distribution of shape 2 lets pass what an even
 * layer of log (1 + Q) / Q as much does. */
static double uneven_by_hand(double k, double s, double below)
{
    const double q = sqrt(k * (k + 2 * s)), part = q > 1e-9 ? log1p(q) / q : 1;
    return layer_by_hand(part * k, part * s, below);
}

struct part {
    const char *name;
    double amount;
};

/* The linear light of a mixture on white. */
static void mixture_by_hand(const struct part *parts, int count, double rgb[3])
{
    memset(rgb, 0, 3 * sizeof *rgb);
    for (int band = 0; band < PAPER_BANDS; band++) {
        double k = 0, s = 0;
        for (int i = 0; i < count; i++) {
            const struct paper_pigment *pigment = paper_pigment_find(parts[i].name);
            assert_non_null(pigment);
            k += parts[i].amount * pigment->absorption[band];
            s += parts[i].amount * pigment->scattering[band];
        }
        for (int i = 0; i < 3; i++)
            rgb[i] += paper_light_of_band[i][band] * uneven_by_hand(k, s, 1);
    }
}

static void lab_of(const double rgb[3], double lab[3])
{
    static const double xyz[3][3] = {{0.433953, 0.376219, 0.189828},
                                     {0.212671, 0.715160, 0.072169},
                                     {0.017758, 0.109477, 0.872765}};
    double f[3];
    for (int i = 0; i < 3; i++) {
        double t = 0;
        for (int k = 0; k < 3; k++)
            t += xyz[i][k] * fmin(1, fmax(0, rgb[k]));
        f[i] = t > 216.0 / 24389 ? cbrt(t) : (24389.0 / 27 * t + 16) / 116;
    }
    lab[0] = 116 * f[1] - 16;
    lab[1] = 500 * (f[0] - f[1]);
    lab[2] = 200 * (f[1] - f[2]);
}

static void mixture_lab(const struct part *parts, int count, double lab[3])
{
    double rgb[3];
    mixture_by_hand(parts, count, rgb);
    lab_of(rgb, lab);
}

/* The colour difference of CIE 142 (2001). */
static double difference_2000(const double p[3], const double q[3])
{
    const double c = pow((hypot(p[1], p[2]) + hypot(q[1], q[2])) / 2, 7),
                 g = 0.5 * (1 - sqrt(c / (c + pow(25, 7))));
    const double a1 = p[1] * (1 + g), a2 = q[1] * (1 + g), c1 = hypot(a1, p[2]),
                 c2 = hypot(a2, q[2]);
    double h1 = atan2(p[2], a1) * DEGREES, h2 = atan2(q[2], a2) * DEGREES;
    h1 += h1 < 0 ? 360 : 0;
    h2 += h2 < 0 ? 360 : 0;
    double turn = h2 - h1, h = h1 + h2;
    turn += turn > 180 ? -360 : turn < -180 ? 360 : 0;
    h = fabs(h1 - h2) <= 180 ? h / 2 : h < 360 ? h / 2 + 180 : h / 2 - 180;
    const double l = (p[0] + q[0]) / 2 - 50, m = (c1 + c2) / 2, m7 = pow(m, 7);
    const double t = 1 - 0.17 * cos((h - 30) / DEGREES) + 0.24 * cos(2 * h / DEGREES) +
                     0.32 * cos((3 * h + 6) / DEGREES) - 0.2 * cos((4 * h - 63) / DEGREES);
    const double light = (q[0] - p[0]) / (1 + 0.015 * l * l / sqrt(20 + l * l)),
                 chroma = (c2 - c1) / (1 + 0.045 * m),
                 hue = 2 * sqrt(c1 * c2) * sin(turn / 2 / DEGREES) / (1 + 0.015 * m * t),
                 rotated = -2 * sqrt(m7 / (m7 + pow(25, 7))) *
                           sin(60 * exp(-pow((h - 275) / 25, 2)) / DEGREES);
    return sqrt(light * light + chroma * chroma + hue * hue + rotated * chroma * hue);
}

/* A pair of the paper that tells how to compute it (Sharma, Wu, Dalal 2005). */
static void the_difference_is_the_cies(void **state)
{
    (void)state;
    const double p[3] = {50, 2.6772, -79.7751}, q[3] = {50, 0, -82.7485};
    assert_true(fabs(difference_2000(p, q) - 2.0425) < 1e-4);
    const double r[3] = {50, 2.5, 0}, s[3] = {73, 25, -18};
    assert_true(fabs(difference_2000(r, s) - 27.1492) < 1e-4);
}

/* ---- the table ---- */

static void paints_have_names(void **state)
{
    (void)state;
    static const char *const old[] = {"quinacridone rose",
                                      "indian red",
                                      "cadmium yellow",
                                      "hooker's green",
                                      "cerulean blue",
                                      "burnt umber",
                                      "cadmium red",
                                      "brilliant orange",
                                      "hansa yellow",
                                      "phthalo green",
                                      "french ultramarine",
                                      "interference lilac",
                                      "cyan",
                                      "magenta",
                                      "yellow"};
    static const char *const wanted[] = {"burnt sienna", "yellow ochre", "raw umber",
                                         "Payne's gray", "lamp black",   "viridian",
                                         "alizarin",     "ultramarine",  "quinacridone gold"};
    const struct paper_paint *paint;
    char names[PAPER_PIGMENT_NAMES_ROOM];
    int banded = 0;
    for (int i = 0; (paint = paper_paint_number(i)); i++) {
        assert_ptr_equal(paper_pigment_find(paint->pigment.name), &paint->pigment);
        banded += paper_pigment_banded(&paint->pigment);
    }
    assert_true(banded >= 30);
    for (size_t i = 0; i < sizeof old / sizeof *old; i++) {
        assert_non_null(paper_pigment_find(old[i]));
        assert_string_equal(paper_pigment_curtis(old[i])->name, old[i]);
    }
    for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++)
        assert_non_null(paper_pigment_find(wanted[i]));
    assert_null(paper_pigment_find("ultra"));
    assert_null(paper_pigment_find(""));
    assert_null(paper_pigment_find(", "));
    assert_null(paper_pigment_curtis("burnt sienna"));
    paper_pigment_names(names, sizeof names);
    assert_true(strlen(names) < sizeof names - 1);
    assert_non_null(strstr(names, "ivory black"));
}

/* Display values 0..255, or L*a*b*. */
struct swatch {
    const char *name;
    bool lab;
    double values[3];
};

/* Gouache of Winsor & Newton, as sensuallogic.com/artistcolordata has measured it; L*a*b*:
 * acrylics of Golden, by their maker. */
static const struct swatch swatches[] = {
    {"french ultramarine", 0, {49, 52, 174}},
    {"cobalt blue", 0, {33, 104, 201}},
    {"cerulean blue", 0, {16, 117, 167}},
    {"cadmium orange", 0, {253, 111, 42}},
    {"cadmium scarlet", 0, {233, 69, 47}},
    {"dioxazine violet", 0, {86, 61, 124}},
    {"phthalo green", 0, {30, 83, 74}},
    {"quinacridone rose", 0, {157, 49, 67}},
    {"alizarin crimson", 0, {154, 44, 67}},
    {"burnt sienna", 0, {145, 76, 54}},
    {"burnt umber", 0, {104, 72, 61}},
    {"raw sienna", 0, {191, 119, 66}},
    {"raw umber", 0, {151, 112, 74}},
    {"yellow ochre", 0, {209, 148, 75}},
    {"indian red", 0, {118, 61, 65}},
    {"ivory black", 0, {44, 41, 43}},
    {"lamp black", 0, {57, 56, 60}},
    {"indigo", 0, {56, 59, 88}},
    {"prussian blue", 0, {27, 64, 111}},
    {"oxide of chromium", 0, {78, 107, 82}},
    {"cobalt turquoise", 0, {0, 166, 177}},
    {"perylene maroon", 0, {125, 54, 69}},
    {"lemon yellow", 0, {255, 234, 12}},
    {"hansa yellow", 0, {255, 222, 0}},
    {"cadmium yellow", 1, {84.67, 14.85, 111.12}},
    {"indian yellow", 0, {255, 162, 0}},
    {"pyrrole red", 1, {39.06, 64.97, 55.65}},
    {"pyrrole orange", 1, {53.54, 65.74, 78.33}},
    {"viridian", 1, {27.74, -33.2, 0.67}},
    {"nickel azo yellow", 1, {65.75, 14.21, 63.61}},
    {"naples yellow", 1, {76.38, 11.46, 41.78}},
};

static void paints_look_like_swatches(void **state)
{
    (void)state;
    char wrong[2000] = "";
    for (size_t i = 0; i < sizeof swatches / sizeof *swatches; i++) {
        const struct swatch *swatch = &swatches[i];
        double wanted[3], least = 1e9, rgb[3];
        for (int c = 0; c < 3; c++)
            rgb[c] = paper_light_linear(swatch->values[c] / 255);
        if (swatch->lab)
            memcpy(wanted, swatch->values, sizeof wanted);
        else
            lab_of(rgb, wanted);
        for (double amount = 0.1; amount < 12; amount *= 1.05) {
            double lab[3];
            mixture_lab(&(struct part){swatch->name, amount}, 1, lab);
            least = fmin(least, difference_2000(lab, wanted));
        }
        printf("%s: %.1f\n", swatch->name, least);
        if (!(least <= 8))
            snprintf(wrong + strlen(wrong), sizeof wrong - strlen(wrong), " %s %.1f",
                     swatch->name, least);
    }
    if (*wrong)
        fail_msg("off their swatches:%s", wrong);
}

static void blue_and_yellow_are_green(void **state)
{
    (void)state;
    static const char *const blues[] = {"phthalo blue", "cerulean blue", "cobalt blue",
                                        "prussian blue", "french ultramarine"};
    static const char *const yellows[] = {"hansa yellow", "lemon yellow", "cadmium yellow"};
    for (int i = 0; i < 5; i++)
        for (int k = 0; k < 3; k++) {
            double lab[3], most = 0, hue = 0;
            for (double part = 0.1; part < 0.9; part += 0.01) {
                mixture_lab((struct part[]){{blues[i], part}, {yellows[k], 1 - part}}, 2, lab);
                const double angle = atan2(lab[2], lab[1]) * DEGREES;
                if (angle > 120 && angle < 190 && hypot(lab[1], lab[2]) > most) {
                    most = hypot(lab[1], lab[2]);
                    hue = angle;
                }
            }
            printf("%s with %s: chroma %.0f at %.0f degrees\n", blues[i], yellows[k], most,
                   hue);
            if (!(most >= 18))
                fail_msg("%s with %s gives no green", blues[i], yellows[k]);
        }
}

static void complements_are_gray(void **state)
{
    (void)state;
    static const char *const pairs[][2] = {
        {"french ultramarine", "burnt sienna"}, {"french ultramarine", "burnt umber"},
        {"cobalt blue", "burnt sienna"},        {"viridian", "alizarin crimson"},
        {"phthalo green", "alizarin crimson"},  {"cerulean blue", "light red"}};
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        double least = 1e9, light = 0;
        for (double part = 0.02; part < 0.99; part += 0.01) {
            double lab[3];
            mixture_lab((struct part[]){{pairs[i][0], part}, {pairs[i][1], 1 - part}}, 2, lab);
            if (hypot(lab[1], lab[2]) < least) {
                least = hypot(lab[1], lab[2]);
                light = lab[0];
            }
        }
        printf("%s with %s: chroma %.1f at L %.0f\n", pairs[i][0], pairs[i][1], least, light);
        if (!(least <= 10))
            fail_msg("%s with %s gives no gray", pairs[i][0], pairs[i][1]);
    }
}

/* ---- uneven paint and its tints ---- */

/* The mean over amounts x of what a layer of x times as much throws back; x is spread by the
 * density 4 x exp (-2 x). */
static double mean_by_hand(double k, double s, double below)
{
    double sum = 0, all = 0;
    for (double x = 0.01; x < 14; x += 0.02) {
        const double weight = x * exp(-2 * x);
        all += weight;
        sum += weight * layer_by_hand(x * k, x * s, below);
    }
    return sum / all;
}

/* The formula is the mean, exactly where nothing scatters, and nearly for every paint. */
static void uneven_paint_is_the_mean_over_amounts(void **state)
{
    (void)state;
    static const double ground[] = {0.93, 0.5, 0}, most[] = {0.01, 0.04, 0.08};
    double worst[3] = {0}, k[PAPER_BANDS], s[PAPER_BANDS];
    for (double x = 0.01; x < 20; x *= 3)
        assert_true(fabs(paper_uneven_seen(x, 0, 1) - mean_by_hand(x, 0, 1)) < 5e-4);
    const struct paper_paint *paint;
    for (int number = 0; (paint = paper_paint_number(number)); number++) {
        if (!paper_pigment_banded(&paint->pigment))
            continue;
        paper_pigment_bands(&paint->pigment, k, s);
        for (int i = 0; i < 3; i++)
            for (double amount = 0.1; amount < 5; amount *= 3)
                for (int band = 0; band < PAPER_BANDS; band++)
                    worst[i] = fmax(
                        worst[i],
                        fabs(paper_uneven_seen(amount * k[band], amount * s[band], ground[i]) -
                             mean_by_hand(amount * k[band], amount * s[band], ground[i])));
    }
    paper_pigment_bands(&(struct paper_pigment){.k = {100, 10, 30}}, k, s);
    for (int band = 0; band < PAPER_BANDS; band++)
        assert_true(paper_uneven_seen(k[band], s[band], 1) < 1e-3);
    for (int i = 0; i < 3; i++) {
        printf("over %.2f the formula is off the mean by %.4f\n", ground[i], worst[i]);
        assert_true(worst[i] < most[i]);
    }
}

/* The tint of a paint on white that is as light as this. */
static void tint_lab(const char *name, double light, double lab[3])
{
    double low = 1e-4, high = 100;
    for (int i = 0; i < 60; i++) {
        const double amount = sqrt(low * high);
        mixture_lab(&(struct part){name, amount}, 1, lab);
        *(lab[0] > light ? &low : &high) = amount;
    }
}

/* Tints of the measured pigments with titanium white, by their absorption and scattering in
 * Berns's database (docs/paints.md): L*, chroma, hue. The paints were fitted to these. */
static void tints_are_those_of_paint(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        double light, chroma, hue;
    } rows[] = {
        {"french ultramarine", 85, 20, 273},
        {"french ultramarine", 75, 33, 277},
        {"french ultramarine", 65, 44, 282},
        {"cobalt blue", 85, 21, 266},
        {"cobalt blue", 75, 33, 271},
        {"cobalt blue", 65, 43, 275},
        {"cerulean blue", 85, 18, 251},
        {"cerulean blue", 75, 27, 254},
        {"cerulean blue", 65, 33, 257},
        {"phthalo green", 85, 26, 187},
        {"phthalo green", 75, 37, 184},
        {"phthalo green", 65, 42, 182},
        {"phthalo green yellow shade", 85, 39, 170},
        {"phthalo green yellow shade", 75, 56, 167},
        {"phthalo green yellow shade", 65, 55, 161},
        {"phthalo blue", 85, 24, 238},
        {"phthalo blue", 75, 35, 243},
        {"phthalo blue", 65, 43, 250},
        {"phthalo blue red shade", 85, 20, 252},
        {"phthalo blue red shade", 75, 31, 256},
        {"phthalo blue red shade", 65, 40, 261},
        {"dioxazine violet", 85, 19, 300},
        {"dioxazine violet", 75, 29, 300},
        {"dioxazine violet", 65, 38, 301},
        {"quinacridone rose", 85, 25, 347},
        {"quinacridone rose", 75, 38, 349},
        {"quinacridone rose", 65, 49, 354},
        {"quinacridone magenta", 85, 25, 335},
        {"quinacridone magenta", 75, 38, 337},
        {"quinacridone magenta", 65, 48, 340},
    };
    int worse = 0;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        double lab[3];
        tint_lab(rows[i].name, rows[i].light, lab);
        const double chroma = hypot(lab[1], lab[2]);
        double hue = atan2(lab[2], lab[1]) * DEGREES;
        hue += hue < 0 ? 360 : 0;
        printf("%s at L %.0f: chroma %.0f, hue %.0f; with white %.0f, %.0f\n", rows[i].name,
               rows[i].light, chroma, hue, rows[i].chroma, rows[i].hue);
        worse += !(fabs(chroma - rows[i].chroma) <= 8 && fabs(hue - rows[i].hue) <= 10);
    }
    assert_int_equal(worse, 0);
}

/* A wash is never purer than the paint at its best depth, which is a deep one. */
static void washes_are_less_pure_than_deep_paint(void **state)
{
    (void)state;
    double tint[3], deep[3];
    tint_lab("french ultramarine", 75, tint);
    tint_lab("french ultramarine", 35, deep);
    assert_true(hypot(tint[1], tint[2]) < 0.6 * hypot(deep[1], deep[2]));
    tint_lab("phthalo green", 80, tint);
    assert_true(hypot(tint[1], tint[2]) < 45 && tint[1] < 0);
    tint_lab("quinacridone rose", 75, tint);
    assert_true(hypot(tint[1], tint[2]) < 45 && tint[1] > 0);
}

/* ---- on paper ---- */

enum { SIDE = 96, FIBERS = SIDE * SIDE };

static float values[FIBERS], other[FIBERS];

/* A picture of mixtures of two paints on white is that of the formulas by hand; water makes it
 * darker. */
static void pictures_are_kubelka_munk_by_bands(void **state)
{
    (void)state;
    static const char *const names[] = {"phthalo blue", "hansa yellow", "burnt sienna", "cyan"};
    static uint16_t rgb[3 * FIBERS];
    struct paper_sheet_config config = sheet_of_two(SIDE, SIDE, names[0], names[1]);
    config.parts = PAPER_PART_INFUSED;
    config.pigments[config.pigments_count++] = *paper_pigment_find(names[2]);
    config.pigments[config.pigments_count++] = *paper_pigment_find(names[3]);
    struct paper_separation formula = paper_separation_of(&config);
    struct paper_sheet *sheet;
    check(paper_sheet_create(&config, &sheet));
    for (int i = 0; i < 3; i++)
        formula.below[i] = 1;
    for (int i = 0; i < FIBERS; i++)
        values[i] = 1;
    for (int i = 0; i < 3; i++)
        check(paper_sheet_layer_write(sheet, PAPER_LAYER_RED + (enum paper_layer)i, 0, values));
    for (int first = 0; first < 2; first++) {
        for (int i = 0; i < FIBERS; i++) {
            values[i] = (float)(i % SIDE) * 2 / SIDE;
            other[i] = (float)(i / SIDE) * 2 / SIDE;
        }
        check(paper_sheet_layer_write(sheet, PAPER_LAYER_INFUSED_PIGMENT, first, values));
        check(paper_sheet_layer_write(sheet, PAPER_LAYER_INFUSED_PIGMENT, first + 1, other));
        check(
            paper_sheet_view(sheet, &(struct paper_sheet_view){.show = PAPER_SHOW_COLOR}, rgb));
        for (int i = 0; i < FIBERS; i++) {
            const double p = floor((double)values[i] * PAPER_GRAINS) / PAPER_GRAINS,
                         q = floor((double)other[i] * PAPER_GRAINS) / PAPER_GRAINS;
            double hand[3], mixed[3];
            mixture_by_hand((struct part[]){{names[first], p}, {names[first + 1], q}}, 2, hand);
            paper_mixture_color(
                &formula, (double[]){first ? 0 : p, first ? p : q, first ? q : 0, 0}, mixed);
            for (int c = 0; c < 3; c++) {
                if (!(fabs(mixed[c] - fmin(1, fmax(0, hand[c]))) < 1e-4))
                    fail_msg("the formula says %g, and by hand it is %g", mixed[c], hand[c]);
                const double shown = rgb[3 * i + c] / 65535.0,
                             wanted = paper_light_display(fmin(1, fmax(0, hand[c])));
                if (!(fabs(shown - wanted) < 0.0015))
                    fail_msg("%g %s and %g %s: channel %d is %g, and by hand %g", p,
                             names[first], q, names[first + 1], c, shown, wanted);
            }
        }
        memset(values, 0, sizeof values);
        check(paper_sheet_layer_write(sheet, PAPER_LAYER_INFUSED_PIGMENT, first, values));
    }
    /* a unit of an ink that is known by three channels looks the same over white among paints
     * that are known by bands */
    memset(values, 0, sizeof values);
    for (int i = 0; i < 3; i++)
        check(paper_sheet_layer_write(sheet, PAPER_LAYER_INFUSED_PIGMENT, i, values));
    for (int i = 0; i < FIBERS; i++)
        values[i] = 1;
    check(paper_sheet_layer_write(sheet, PAPER_LAYER_INFUSED_PIGMENT, 3, values));
    check(paper_sheet_view(sheet, &(struct paper_sheet_view){.show = PAPER_SHOW_COLOR}, rgb));
    for (int c = 0; c < 3; c++) {
        const double wanted = paper_light_display(
            layer_by_hand(config.pigments[3].k[c], config.pigments[3].s[c], 1));
        if (!(fabs(rgb[c] / 65535.0 - wanted) < 0.01))
            fail_msg("a unit of cyan: channel %d is %g, and should be %g", c, rgb[c] / 65535.0,
                     wanted);
    }
    paper_sheet_destroy(sheet);
}

static void wet_paint_is_darker(void **state)
{
    (void)state;
    static uint16_t wet[3 * FIBERS], dry[3 * FIBERS];
    struct paper_sheet_config config =
        sheet_of_two(SIDE, SIDE, "payne's gray", "cadmium yellow");
    struct paper_sheet *sheet;
    check(paper_sheet_create(&config, &sheet));
    check(paper_sheet_put(sheet, NULL, 0, 0, (double[]){0.6, 0.5, 0}));
    check(paper_sheet_view(sheet, &(struct paper_sheet_view){.show = PAPER_SHOW_COLOR}, wet));
    check(paper_sheet_dry(sheet));
    check(paper_sheet_view(sheet, &(struct paper_sheet_view){.show = PAPER_SHOW_COLOR}, dry));
    double sum = 0;
    for (int i = 0; i < 3 * FIBERS; i++)
        sum += (dry[i] - wet[i]) / 65535.0 / (3 * FIBERS);
    printf("payne's gray dries lighter by %.3f\n", sum);
    assert_true(sum > 0.03 && sum < 0.15);
    paper_sheet_destroy(sheet);
}

int main(void)
{
    setvbuf(stdout, NULL, _IONBF, 0);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bands_are_the_cies),
        cmocka_unit_test(the_difference_is_the_cies),
        cmocka_unit_test(paints_have_names),
        cmocka_unit_test(paints_look_like_swatches),
        cmocka_unit_test(blue_and_yellow_are_green),
        cmocka_unit_test(complements_are_gray),
        cmocka_unit_test(uneven_paint_is_the_mean_over_amounts),
        cmocka_unit_test(tints_are_those_of_paint),
        cmocka_unit_test(washes_are_less_pure_than_deep_paint),
        cmocka_unit_test(pictures_are_kubelka_munk_by_bands),
        cmocka_unit_test(wet_paint_is_darker),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
