/* filter_choose.c - which filter shows lines of a width best on a display. */
#include "filter_internal.h"

#include <math.h>

double font_display_spot(enum font_display display, double v)
{
    switch (display) {
    case FONT_DISPLAY_LCD:
        return v >= -0.5 && v < 0.5 ? 1 : 0; /* a square pixel */
    case FONT_DISPLAY_CRT:
        return exp(-0.5 * v * v / (0.45 * 0.45)) / (0.45 * sqrt(2 * M_PI)); /* a beam */
    case FONT_DISPLAY_PRINT:
        break;
    }
    return fabs(v) <= 0.6 ? 1 / 1.2 : 0; /* a dot that runs a little */
}

/* How bright a line of this width, whose centre is at x, is at its brightest, through filter
 * and spot; and its weight. */
static double line_shown(const struct font_filter *f, double width, double x,
                         enum font_display display)
{
    double best = 0;
    for (int s = -8; s <= 8; s++) {
        double at = x + s / 16.0, sum = 0;
        for (int i = (int)floor(at) - 6; i <= (int)ceil(at) + 6; i++)
            sum += (font_filter_edge(f, i + 0.5 - x + width / 2) -
                    font_filter_edge(f, i + 0.5 - x - width / 2)) *
                   font_display_spot(display, at - i - 0.5);
        best = fmax(best, sum);
    }
    return best;
}

struct font_filter_fit font_filter_fit(const struct font_filter *f, double detail_px,
                                       enum font_display display)
{
    double mean = 0, square = 0;
    if (!(detail_px > 0.01))
        detail_px = 0.01;
    for (int p = 0; p < 8; p++) {
        double shown = line_shown(f, detail_px, p / 8.0, display) / fmin(1, detail_px);
        mean += shown / 8;
        square += shown * shown / 8;
    }
    struct font_filter_fit fit = {.lost = 1 - fmin(mean, 1),
                                  .uneven = sqrt(fmax(0, square - mean * mean)),
                                  .rings = f->info.undershoot};
    /* What rings beside the line is as bad as what it loses. */
    fit.cost = fit.lost * fit.lost + 9 * fit.uneven * fit.uneven + 4 * fit.rings * fit.rings;
    return fit;
}

const char *font_filter_choose(double detail_px, enum font_display display)
{
    const char *best = "gaussian-fast";
    double least = 1e9;
    for (const char *const *name = font_filter_names(); *name; name++) {
        struct font_filter *f;
        if (font_filter_create_named(*name, &f) != FONT_OK)
            continue;
        double cost = font_filter_fit(f, detail_px, display).cost;
        if (cost < least) {
            least = cost;
            best = *name;
        }
        font_filter_destroy(f);
    }
    return best;
}
