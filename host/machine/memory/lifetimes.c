/* lifetimes.c - how long what fields hold is wanted. */
#include "memory/lifetimes.h"

#include "run/replay.h"

void lifetimes_accessed(struct machine *m, struct slot *slot, bool overwrites)
{
    struct history *h = m->run->replay ? &m->run->replay->history : NULL;
    if (!h)
        return;
    if (overwrites && slot->call_accessed && h->count - slot->call_accessed < HISTORY) {
        int32_t bytes = (int32_t)(slot->bits + 7) / 8;
        h->dead[slot->call_accessed % HISTORY] += bytes;
        h->dead[h->count % HISTORY] -= bytes;
    }
    slot->call_accessed = h->count;
}
