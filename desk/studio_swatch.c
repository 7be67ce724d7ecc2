/* studio_swatch.c - see studio_swatch.h. */
#include "studio_swatch.h"

#include <math.h>

/* Light that a layer which absorbs K and scatters S throws back, over a ground that throws back `ground`. */
static double layer(double k, double s, double ground)
{
    if (k <= 0 && s <= 0)
        return ground;
    s = fmax(s, 1e-6);
    const double a = 1 + k / s, b = sqrt(a * a - 1), x = fmin(b * s, 300),
                 c = a * sinh(x) + b * cosh(x);
    const double back = x > 1e-9 ? sinh(x) / c : s / (1 + s),
                 through = x > 1e-9 ? b / c : 1 / (1 + s);
    return back + through * through * ground / (1 - back * ground);
}

void studio_swatch(const struct paper_sheet_config *config, const double *amount, double rgb[3])
{
    for (int channel = 0; channel < 3; channel++) {
        double k = 0, s = 0, takes = 0, leaves = 0;
        for (int i = 0; i < config->pigments_count; i++) {
            k += amount[1 + i] * config->pigments[i].k[channel];
            s += amount[1 + i] * config->pigments[i].s[channel];
            takes += amount[1 + i] * config->pigments[i].takes[channel];
            leaves += amount[1 + i] * (1 - config->pigments[i].takes[channel]);
        }
        const double ground = config->stock.color[channel];
        double light = 0;
        switch (config->rule) {
        case PAPER_RULE_KUBELKA_MUNK:
            light = paper_light_display(layer(k, s, paper_light_linear(ground)));
            break;
        case PAPER_RULE_SUBTRACT:
            light = ground - takes;
            break;
        case PAPER_RULE_LUMINOUS:
            light = ground + leaves;
            break;
        }
        rgb[channel] = fmin(1, fmax(0, light));
    }
}
