/* ahead.c - which step is the first that takes an array, and fetches its next block: see
 * byte_code.h. */
#include <stdlib.h>

#include "interpret/byte_code.h"

void byte_code_ahead(struct byte_code *p)
{
    bool *taken = calloc((size_t)p->places_count, sizeof *taken);
    for (int i = 0; taken && i < p->steps_count; i++) {
        struct lanes_step *s = &p->steps[i];
        int inputs = s->run ? lanes_inputs(s->op) : 0;
        if (s->op == LANES_GUARD)
            continue;
        for (int k = 0; s->list && k < s->detail; k++) {
            bool *known = &taken[s->list[2 * k + 1]];
            if (p->places[s->list[2 * k + 1]].kind == PLACE_ARRAY && !*known)
                s->ahead |= AHEAD_LIST;
            *known = true;
        }
        for (int k = 0; k < 4; k++) {
            int place = k == 3 ? s->to : s->in[k];
            if (s->op != LANES_STREAM && (k < inputs || k == 3) &&
                p->places[place].kind == PLACE_ARRAY && !taken[place]) {
                taken[place] = true;
                s->ahead |= (uint8_t)(1u << k);
            }
        }
    }
    free(taken);
}
