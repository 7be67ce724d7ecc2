/* lines_internal.h - what lines.c and places.c share. */
#ifndef LUTETIA_PAGE_LINES_INTERNAL_H
#define LUTETIA_PAGE_LINES_INTERNAL_H

#include "page_internal.h"

enum { BREAK_PASSES = 10, WAYS_LEAST = 1000 }; /* shorter paragraphs are broken anew */

/* Places where lines may end, in the order of the text. */
struct places {
    struct break_place *items;
    int *letters; /* behind which each is: the number of the letter after it */
    bool *hyphens;
    int count, capacity_items, capacity_letters, capacity_hyphens;
    int too_long; /* pieces between two of them that are wider than the narrowest line */
    bool made;    /* of some text */
    bool ready;   /* of the text as it is */
    bool exact;   /* no sum of them is rounded */
    bool again;   /* `change` is what changed of them since the breaking before */
    struct break_change change;
};

/* What is kept of a long paragraph's breaking, so that it can be found again. */
struct ways {
    struct places places[2]; /* without words divided, and with */
    struct break_search searches[BREAK_PASSES];
};

void ways_finish(struct ways *ways);

struct filling {
    struct page_text *t;
    struct paragraph *p;
    struct ways *ways;
    struct places anywhere; /* where each letter is a place */
    double least;           /* the narrowest line */
    int kept, begin;        /* lines that stay, and the letter behind them */
    bool ragged;
    bool hyphens_too; /* words may be divided by their patterns */
    bool searched[BREAK_PASSES];
};

bool line_white(const struct paragraph *p, int i);
/* What a line may end with behind letter i: 0 nothing, else 1 plus the penalty; *hyphen: one is
 * seen there that is not in the text. */
int line_end_penalty(const struct filling *f, int i, bool letters_too, bool *hyphen);

/* All legal ends, with the sums up to them; anywhere: each letter is one, at a high price. */
bool places_make(struct filling *f, struct places *to, bool anywhere);
/* The same of what was kept, where letters have changed. */
bool places_ready(struct filling *f, struct places *places);
void places_finish(struct places *places);

#endif
