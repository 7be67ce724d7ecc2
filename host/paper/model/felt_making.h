/* felt_making.h - what the files that make a felt share: a sheet that is being made. */
#ifndef LUTETIA_PAPER_FELT_MAKING_H
#define LUTETIA_PAPER_FELT_MAKING_H

#include "model/clouds.h"
#include "sheet.h"

#include <stdbool.h>
#include <stdint.h>

/* What each kind of paper is made of: lengths in fibers of the model, at the stock's own grain
 * and fiber_length. */
struct recipe {
    const char *stock;
    double length;                /* of a usual fiber */
    double cover;                 /* fibers that lie on one another */
    double curl;                  /* how fast bends wander */
    double tooth, fibers, clouds; /* parts of the relief */
    double grit;                  /* in part in place of the fibers */
    double laid, laid_step,
        chain_step; /* the lines' part, and how far apart they are; 0: wove */
    double pores;   /* bundles of fibers that lie on one another; 0: none. felt_fibers.c */
};

/* What a sheet is made of. */
struct making {
    const struct paper_sheet_config *config;
    const struct recipe *recipe;
    int width, height;
    double scale;   /* fibers of this sheet for one of the stock as it is known */
    double lean[2]; /* x, y: how much of a fiber's direction counts; the longer is 1 */
    uint64_t seed;
    const float *inside; /* of a sheet with a deckle, else NULL: deckle_make() */
    float *stayed;       /* mass of the fibers that lie in the sheet, where that is not all */
    bool slowly;         /* all fibers are drawn, also those that do not reach the sheet */
};

/* What is thrown on: fibers, or bundles of fibers that lie side by side. In fibers of the
 * stock's own scale. */
struct felt_thrown {
    uint64_t which; /* the number of their chances among the sheet's */
    double length;  /* usual */
    double cover;   /* that lie on one another, in the mean */
    double curl;    /* how fast bends wander */
    double width;
};

/* Random numbers in a row. */
struct chances {
    uint64_t seed, number;
};

static inline double chance(struct chances *c)
{
    return clouds_chance(c->seed, c->number++);
}

/* The place `at` on an axis of a torus. */
static inline int felt_around(int at, int length)
{
    const int place = at % length;
    return place < 0 ? place + length : place;
}

/* mass, height * width numbers, is what lies on each fiber: 1 where one of them does. More are
 * thrown where there are clouds. Those that begin in one square of the stock's scale are the
 * same at every scale. */
void felt_throw(const struct making *m, const struct felt_thrown *of, float *mass,
                const float *clouds);

#endif
