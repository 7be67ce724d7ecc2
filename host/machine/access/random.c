/* random.c - random numbers: another draw each time, so no call that draws is foreseen. */
#include "run/replay.h"
#include "values/places.h"

struct machine_value *machine_random(struct machine *m, int width, uint64_t limit)
{
    record_impure(m);
    return places_random(m, width, limit);
}
