/* vpsets.c - creating and releasing VP sets.
 *
 * A VP set's id is the lowest one that is free; its generation distinguishes sets that had
 * the same id.
 */
#include <stdlib.h>
#include <string.h>

#include "memory/memory.h"
#include "values/graph.h"

bool vpsets_grow(struct machine *m, int count)
{
    int had = m->values->sets_count > 1 ? m->values->sets_count : 0;
    struct vpset *sets = realloc(m->values->sets, (size_t)count * sizeof *sets);
    m->values->sets = sets ? sets : m->values->sets;
    struct flags *flags = realloc(m->memory->flags, (size_t)count * sizeof *flags);
    m->memory->flags = flags ? flags : m->memory->flags;
    if (!sets || !flags)
        return false;
    memset(&sets[had], 0, (size_t)(count - had) * sizeof *sets);
    memset(&flags[had], 0, (size_t)(count - had) * sizeof *flags);
    m->values->sets_count = count;
    return true;
}

void vpset_release(struct machine *m, struct vpset *s)
{
    known_addresses_forget(m);
    known_places_forget(m);
    known_ranks_forget(m);
    flag_overflow_clear(m, &flags_of(m, s)->overflow);
    for (int flag = 0; flag < 3; flag++)
        graph_unref(m, flags_of(m, s)->of[flag].value);
    s->used = false;
}

void vpsets_finish(struct machine *m)
{
    for (int i = 1; i < m->values->sets_count; i++)
        if (m->values->sets[i].used)
            vpset_release(m, &m->values->sets[i]);
    free(m->values->sets);
    free(m->memory->flags);
}
