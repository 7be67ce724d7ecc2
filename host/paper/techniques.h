/* techniques.h - what painters do besides the brush: graded washes, splatter, salt, lifting,
 * varnish, printed amounts.
 *
 *     paper_sheet_splatter(sheet, &(struct paper_splatter){.x = 200, .y = 150, .radius = 80, .drops = 60,
 *                                                          .size = {1, 5}, .seed = 3, .amount = {1, 0.7}});
 *     paper_sheet_salt(sheet, &(struct paper_salt){.x = 200, .y = 150, .radius = 60, .grains = 40,
 *                                                  .size = {1, 2}, .strength = 1, .reach = 10, .seed = 4});
 *
 * Random numbers depend only on the given seed, so the same calls make the same bits.
 *
 * Errors, ownership and threads: as sheet.h says.
 */
#ifndef LUTETIA_PAPER_TECHNIQUES_H
#define LUTETIA_PAPER_TECHNIQUES_H

#include "sheet.h"

/* A screen, and the place of its upper left corner; NULL: everywhere. */
struct paper_place {
    const struct paper_screen *screen;
    int x, y;
};

/* Amounts that change linearly from one place to another, and are constant beyond both.
 * Errors: as paper_sheet_put(). */
struct paper_wash {
    struct paper_place place;
    double from[2], to[2]; /* x, y; if both are equal: `amount` everywhere */
    double amount[1 + PAPER_PIGMENTS_MAX], end[1 + PAPER_PIGMENTS_MAX]; /* 0..4 */
};
enum paper_status paper_sheet_wash(struct paper_sheet *sheet, const struct paper_wash *wash);

/* Amounts for each fiber of a rectangle, for example of a separated image. The part off the
 * sheet is ignored. Errors: as paper_sheet_put(). */
struct paper_print {
    int x, y, width, height;
    const float *amount[1 + PAPER_PIGMENTS_MAX]; /* rows from the top, 0..4; NULL: none */
};
enum paper_status paper_sheet_print(struct paper_sheet *sheet, const struct paper_print *print);

/* Puts letters of about that size as a painter does: a thin wash of 0.42 of the pigments, and
 * into it, here and there, drops with 0.6 of them. Where they fall follows from the sheet's
 * seed. Errors: as paper_sheet_put(); a size below 1 is BAD_ARGUMENT. */
enum paper_status paper_sheet_put_charged(struct paper_sheet *sheet,
                                          const struct paper_screen *screen, int x, int y,
                                          const double *amount, double size);

/* Throws drops at random about a place: many small drops and few large ones. Drops thrown in a
 * direction fly further and are longer. Errors: as paper_sheet_put(). */
struct paper_splatter {
    double x, y, radius; /* most fall within it */
    double toward;       /* radians from x towards y */
    double thrown;       /* 0: straight down; 1..4: how much longer than wide */
    int drops;           /* 1..100000 */
    double size[2];      /* radii, least and most, 0.1..500 */
    uint64_t seed;
    double amount[1 + PAPER_PIGMENTS_MAX];
};
enum paper_status paper_sheet_splatter(struct paper_sheet *sheet,
                                       const struct paper_splatter *splatter);

/* Strews grains of salt within a radius; grains that fall outside the place's screen are left
 * out. Grains dissolve in water. The brine spreads, draws surface water in and pushes pigments
 * away. When the paper is dried the grains are brushed off. Errors: as paper_sheet_put(). */
struct paper_salt {
    struct paper_place place;
    double x, y, radius;
    int grains;      /* 1..100000 */
    double size[2];  /* radii, least and most, 0.1..50 */
    double strength; /* 0..4 */
    /* how far brine goes, fibers, 1..100; the last salt's holds for all on the sheet */
    double reach;
    uint64_t seed;
};
enum paper_status paper_sheet_salt(struct paper_sheet *sheet, const struct paper_salt *salt);

/* Rubs with a damp sponge: removes the fraction `part` (0..1) of the pigment that is not fixed,
 * and some of the fixed pigment too: the more, the lower its `staining`. Errors: as
 * paper_sheet_put(). */
struct paper_lift {
    struct paper_place place;
    double part;
};
enum paper_status paper_sheet_lift(struct paper_sheet *sheet, const struct paper_lift *lift);

/* Clear gloss on top: colours are deeper under it and light shows its edges. It stays when the
 * paper is sealed. Errors: as paper_sheet_put(). */
struct paper_varnish {
    struct paper_place place;
    double amount; /* 0..1; a fiber keeps the largest amount that it was ever given */
};
enum paper_status paper_sheet_varnish(struct paper_sheet *sheet,
                                      const struct paper_varnish *varnish);

#endif
