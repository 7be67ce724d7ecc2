/* breaks_cost.h - what a line costs, for the loops of breaks_find.c: see breaks.h. */
#ifndef LUTETIA_PAGE_BREAKS_COST_H
#define LUTETIA_PAGE_BREAKS_COST_H

#include "breaks.h"

#include <math.h>
#include <stdlib.h>

/* TeX's usual numbers. */
static const double line_penalty = 10, adjacent_demerits = 10000, hyphens_demerits = 10000,
                    last_hyphen_demerits = 5000;
/* Demerits are whole parts of that: so their sums are exact, and two ways differ by as much
 * whatever stands before them. */
static const double demerits_parts = 1 << 14;

enum fitness { VERY_LOOSE, LOOSE, DECENT = BREAK_DECENT, TIGHT = BREAK_TIGHT };

static inline double cost_ratio(const struct break_place *from, const struct break_place *to,
                                double width, const struct break_rules *rules, bool last)
{
    double lacks = width - (to->end.px - from->next.px);
    if (lacks >= 0) {
        double stretch = to->end.stretch - from->next.stretch + rules->emergency_px;
        if (last && rules->last_fills)
            return 0;
        return lacks < 1e-9 ? 0 : stretch > 0 ? lacks / stretch : BREAK_OVERFULL;
    }
    double shrink = to->end.shrink - from->next.shrink;
    return lacks > -1e-9 ? 0 : shrink > 0 ? lacks / shrink : -BREAK_OVERFULL;
}

static inline double cost_badness(double ratio)
{
    double bad = 100 * fabs(ratio * ratio * ratio);
    return bad < BREAK_INFINITE ? bad : BREAK_INFINITE;
}

/* TeX's badness: a whole number, of which the fitness is a matter; about 100 |ratio|^3. */
static inline double cost_whole_badness(double ratio)
{
    double r = floor(297 * fabs(ratio));
    return r > 1290 ? BREAK_INFINITE : floor((r * r * r + 131072) / 262144);
}

static inline enum fitness cost_fitness(double ratio)
{
    double badness = cost_whole_badness(ratio);
    if (ratio < 0)
        return badness > 12 ? TIGHT : DECENT;
    return badness > 99 ? VERY_LOOSE : badness > 12 ? LOOSE : DECENT;
}

static inline double cost_demerits(const struct break_place *from, const struct break_place *to,
                                   double ratio, int fitness_before, int *fitness, bool last)
{
    double bad = cost_badness(ratio), line = line_penalty + bad, p = to->penalty;
    double demerits = line * line;
    *fitness = (int)cost_fitness(ratio);
    demerits += p > 0 ? p * p : p > -BREAK_INFINITE ? -p * p : 0;
    if (from->flagged && (to->flagged || last))
        demerits += last ? last_hyphen_demerits : hyphens_demerits;
    if (abs(*fitness - fitness_before) > 1)
        demerits += adjacent_demerits;
    return breaks_whole(demerits * demerits_parts) / demerits_parts;
}

#endif
