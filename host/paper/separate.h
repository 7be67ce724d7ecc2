/* separate.h - colours separated into pigments.
 *
 *     struct paper_separation s = paper_separation_of(paper_sheet_get_config(sheet));
 *     float *amount[3] = {rose, blue, yellow};                     // one number a pixel each
 *     if (paper_separate(&s, rgb, pixels, amount) != PAPER_OK)
 *         die(paper_error());
 *
 * For each colour, finds the non-negative amounts that look most like it over the paper: least
 * squares in CIE L*a*b*, with a small penalty on the amounts. The penalty makes the solution
 * unique, and continuous in the colour. The problem is solved at the points of a grid of
 * 33x33x33 colours that are needed, and interpolated between them.
 *
 * Errors and ownership: as sheet.h says. Threads: any; one separation may be used by several at
 * a time.
 */
#ifndef LUTETIA_PAPER_SEPARATE_H
#define LUTETIA_PAPER_SEPARATE_H

#include "sheet.h"

struct paper_separation {
    enum paper_rule rule;
    double below
        [3]; /* the colour under the pigments: linear light, or, by the other rules, display
              * values, 0..1 */
    int pigments_count; /* 1..PAPER_PIGMENTS_MAX */
    struct paper_pigment pigments[PAPER_PIGMENTS_MAX];
    bool banded; /* any of them is known by bands: then this is what they do there (bands.h) */
    double absorption[PAPER_PIGMENTS_MAX][PAPER_BANDS],
        scattering[PAPER_PIGMENTS_MAX][PAPER_BANDS];
    double most;   /* amount of each, 0.01..4 */
    double thrift; /* price of pigment, 0..10 */
};
/* The rule, paper and pigments of a sheet; most 2, thrift 0.3. */
struct paper_separation paper_separation_of(const struct paper_sheet_config *config);

/* Only these of the sheet's pigments, by their numbers. */
void paper_separation_choose(struct paper_separation *s,
                             const struct paper_sheet_config *config, const int *number,
                             int count);

/* The colour of the amounts: linear light, 0..1. */
void paper_mixture_color(const struct paper_separation *s, const double *amount, double rgb[3]);
/* CIE 1976 L*a*b* (D65) of linear light. */
void paper_lab(const double rgb[3], double lab[3]);

/* Shape: rgb has 3 display values of 8 bits a pixel; amount[i] a number a pixel for pigment i.
 * Errors: BAD_ARGUMENT, NO_MEMORY. */
enum paper_status paper_separate(const struct paper_separation *s, const uint8_t *rgb,
                                 size_t pixels, float *const *amount);

#endif
