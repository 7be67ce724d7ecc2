/* breaks.c - what a line costs: see breaks.h. breaks_again.c finds the way. */
#include "breaks_cost.h"

double breaks_ratio(const struct break_place *from, const struct break_place *to, double width,
                    const struct break_rules *rules, bool last)
{
    return cost_ratio(from, to, width, rules, last);
}

double breaks_demerits(const struct break_place *from, const struct break_place *to,
                       double ratio, int fitness_before, int *fitness, bool last)
{
    return cost_demerits(from, to, ratio, fitness_before, fitness, last);
}
