/* studio_swatch.c - see studio_swatch.h. */
#include "studio_swatch.h"

#include <separate.h>

#include <math.h>

void studio_swatch(const struct paper_sheet_config *config, const double *amount, double rgb[3])
{
    const struct paper_separation mixture = paper_separation_of(config);
    double paint = 0;
    for (int i = 0; i < config->pigments_count; i++)
        paint += fabs(amount[1 + i]);
    paper_mixture_color(&mixture, amount + 1, rgb);
    for (int channel = 0; channel < 3; channel++)
        rgb[channel] =
            paint > 0 ? paper_light_display(rgb[channel]) : config->stock.color[channel];
}
