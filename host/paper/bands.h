/* bands.h - light in ten bands of 35 nm, from 380 to 730 nm, and colours of it by CIE 1931 in
 * D65.
 *
 *     double k[PAPER_BANDS], s[PAPER_BANDS], rgb[3] = {0};
 *     paper_pigment_bands(paper_pigment_find("burnt sienna"), k, s);
 *     for (int band = 0; band < PAPER_BANDS; band++)
 *         for (int i = 0; i < 3; i++)
 *             rgb[i] += paper_light_of_band[i][band] * paper_uneven_seen(k[band], s[band], 1);
 *
 * A layer of paint is computed by Kubelka and Munk in each band: blue and yellow make green
 * because the two let the same narrow part of green through, which three wide channels cannot
 * say. A colour that is only known as red, green and blue, as that of paper is, is taken to be
 * a sum of three smooth spectra, the whole of which is white.
 *
 * Errors: none. Threads: any.
 */
#ifndef LUTETIA_PAPER_BANDS_H
#define LUTETIA_PAPER_BANDS_H

#include "sheet.h"

/* Linear light, red, green and blue, of a band in which all light is seen; the sum over bands
 * is 1. */
extern const double paper_light_of_band[3][PAPER_BANDS];
/* What is seen in each band of red, green and blue; the sum over these is 1, and the matrix is
 * an inverse of the one above. */
extern const double paper_band_of_light[PAPER_BANDS][3];

/* Whether anything is known of the pigment by bands, or of any of the sheet's. */
bool paper_pigment_banded(const struct paper_pigment *pigment);
bool paper_config_banded(const struct paper_sheet_config *config);

/* Absorption and scattering of a unit in each band: the pigment's own, or such that a unit of
 * it, uneven, looks over white and over black as an even layer of k and s does. */
void paper_pigment_bands(const struct paper_pigment *pigment, double k[PAPER_BANDS],
                         double s[PAPER_BANDS]);

/* The part of light that a layer on `below` (0..1) throws back. Source: Kubelka and Munk
 * 1931. */
double paper_layer_seen(double k, double s, double below);

/* The same of a layer that lies unevenly within a fiber, as paints known by bands do: what its
 * amounts, spread by a gamma distribution of shape 2, throw back in the mean (view.c). */
double paper_uneven_seen(double k, double s, double below);

#endif
