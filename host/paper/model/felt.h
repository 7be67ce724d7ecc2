/* felt.h - paper as it is made: what a sheet with parts is like, fiber by fiber, on the front
 * end. */
#ifndef LUTETIA_PAPER_FELT_H
#define LUTETIA_PAPER_FELT_H

#include "sheet.h"

/* height * width numbers each, rows from the top; mean about 0, deviation about 1 where the
 * stock has such a thing, else 0. */
struct felt {
    float *relief;    /* up: the tooth, fibers and clouds that stand out */
    float *mass;      /* how much fiber lies there */
    float *fibers;    /* the same without clouds */
    float *sizing;    /* how much of the size has gone in there */
    float *pores;     /* 0..1, 1 where a bundle of fibers leads water along; NULL: none does */
    bool smeared;     /* no fibers; the relief is of smears and dust */
    float *thickness; /* of a sheet with a deckle: 0..1, 0 where there is no paper; else NULL */
};

/* From the stock and the seed, by sums, products, quotients and square roots alone: the same
 * bits everywhere. Errors: NO_MEMORY; nothing is then allocated. Owns: the caller gives it to
 * felt_free(). */
enum paper_status felt_make(const struct paper_sheet_config *config, struct felt *out);
/* The same bits, slower: fibers that cannot reach the sheet are drawn, too. */
enum paper_status felt_make_slowly(const struct paper_sheet_config *config, struct felt *out);
/* Whether a stock has fibers. */
bool felt_has_fibers(const struct paper_stock *stock);
/* Fibers of this sheet to one of its stock as it is known: 2 where the sheet is drawn anew
 * twice as fine. */
double felt_scale(const struct paper_sheet_config *config);
void felt_free(struct felt *felt); /* may be of zeros */

#endif
