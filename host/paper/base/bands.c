/* bands.c - see bands.h.
 *
 * Both tables are computed from the CIE's of 1931 (2 degrees) and of D65, every 10 nm: the
 * light of a band is the sum over its nm. The second table is the smoothest one with numbers
 * from 0 on, sums of 1, and the first one's inverse, after Mallett and Yuksel, "Spectral
 * Primary Decomposition for Rendering with sRGB Reflectance" (EGSR 2019).
 */
#include "bands.h"

#include "base/base.h"

#include <math.h>
#include <string.h>

// clang-format off
const double paper_light_of_band[3][PAPER_BANDS] = {
    {0.0049408, 0.0565295, -0.0415627, -0.2383466, -0.1875292, 0.3627392, 0.6860090, 0.3052786, 0.0479415, 0.0039998},
    {-0.0043379, -0.0559608, 0.0070153, 0.2597522, 0.5006308, 0.3047630, 0.0191496, -0.0255292, -0.0050421, -0.0004408},
    {0.0308423, 0.4667812, 0.5357076, 0.0786853, -0.0475460, -0.0448571, -0.0162321, -0.0030117, -0.0003434, -0.0000261},
};
const double paper_band_of_light[PAPER_BANDS][3] = {
    {0.0000000, -0.0000000, 1.0000000},
    {0.0014226, 0.0000000, 0.9985774},
    {0.0364804, 0.0495053, 0.9140143},
    {0.0000000, 0.8153206, 0.1846794},
    {0.0000000, 1.0000000, 0.0000000},
    {0.0436225, 0.9385226, 0.0178548},
    {0.9160117, 0.0633763, 0.0206121},
    {1.0000000, 0.0000000, -0.0000000},
    {1.0000000, 0.0000000, -0.0000000},
    {1.0000000, 0.0000000, 0.0000000},
};
// clang-format on

#define Q_LEAST 2e-3     /* as in model/view.c */
#define BLACK_LEAST 1e-5 /* what is seen over black of a pigment that scatters nothing */

double paper_layer_seen(double k, double s, double below)
{
    const double q = fmax(sqrt(k * (k + 2 * s)), Q_LEAST), c = q / tanh(q);
    return (s + below * (c - k - s)) / (k + s + c - s * below);
}

double paper_uneven_seen(double k, double s, double below)
{
    const double q = sqrt(k * (k + 2 * s)), c = q + 2 / (q + 2);
    return (s + below * (c - k - s)) / (k + s + c - s * below);
}

bool paper_pigment_banded(const struct paper_pigment *pigment)
{
    double sum = 0;
    for (int band = 0; band < PAPER_BANDS; band++)
        sum += pigment->absorption[band] + pigment->scattering[band];
    return sum > 0;
}

bool paper_config_banded(const struct paper_sheet_config *config)
{
    bool banded = false;
    for (int i = 0; i < config->pigments_count; i++)
        banded = banded || paper_pigment_banded(&config->pigments[i]);
    return banded;
}

void paper_pigment_bands(const struct paper_pigment *pigment, double k[PAPER_BANDS],
                         double s[PAPER_BANDS])
{
    memcpy(k, pigment->absorption, sizeof pigment->absorption);
    memcpy(s, pigment->scattering, sizeof pigment->scattering);
    if (paper_pigment_banded(pigment))
        return;
    for (int band = 0; band < PAPER_BANDS; band++) {
        double white = 0, black = 0;
        for (int i = 0; i < 3; i++) {
            const double part = paper_band_of_light[band][i];
            white += part * paper_layer_seen(pigment->k[i], pigment->s[i], 1);
            black += part * paper_layer_seen(pigment->k[i], pigment->s[i], 0);
        }
        white = fmax(fmin(white, 1 - BLACK_LEAST), 2 * BLACK_LEAST);
        paper_layer_of(white, fmax(fmin(black, white - BLACK_LEAST), BLACK_LEAST / 10),
                       &k[band], &s[band]);
        /* an uneven layer of Q lets as much pass as an even one of log (1 + Q) */
        const double q = fmax(sqrt(k[band] * (k[band] + 2 * s[band])), Q_LEAST);
        k[band] *= expm1(q) / q;
        s[band] *= expm1(q) / q;
    }
}
