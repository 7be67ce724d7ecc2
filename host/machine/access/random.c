/* random.c - random numbers. Each call draws anew, so a call that draws is never foreseen. */
#include "run/replay.h"
#include "values/places.h"

struct machine_value *machine_random(struct machine *m, int width, uint64_t limit)
{
    record_impure(m);
    return places_random(m, width, limit);
}
