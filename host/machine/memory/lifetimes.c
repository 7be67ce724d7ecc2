/* lifetimes.c - see lifetimes.h. */
#include "memory/lifetimes.h"

#include "memory/memory.h"

void lifetimes_call(struct machine *m)
{
    struct lifetimes *l = &m->memory->lifetimes;
    l->dead[++l->calls % LIFETIMES] = 0;
}
