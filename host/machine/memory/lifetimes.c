/* lifetimes.c - see lifetimes.h. */
#include "memory/lifetimes.h"

#include "memory/memory.h"

void lifetimes_call(struct machine *m)
{
    struct lifetimes *l = &m->memory->lifetimes;
    l->dead[++l->calls % LIFETIMES] = 0;
}

void lifetimes_accessed(struct machine *m, struct slot *slot, bool overwrites)
{
    struct lifetimes *l = &m->memory->lifetimes;
    if (!l->noted)
        return;
    if (overwrites && slot->call_accessed && l->calls - slot->call_accessed < LIFETIMES) {
        int32_t bytes = (int32_t)(slot->bits + 7) / 8;
        l->dead[slot->call_accessed % LIFETIMES] += bytes;
        l->dead[l->calls % LIFETIMES] -= bytes;
    }
    slot->call_accessed = l->calls;
}
