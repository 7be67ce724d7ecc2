/* members.c - checking and freeing by rows. */
#include "members.h"

#include <stdio.h>

bool members_check(const struct members *members, const void *of, const char *whose,
                   const char *where, char *text, size_t room)
{
    for (const struct member *m = members->first; m < members->first + members->count; m++) {
        const void *start = (const char *)of + m->offset;
        for (int i = 0; m->name && i < m->count; i++) {
            double value = m->kind == MEMBER_INT ? (double)((const int *)start)[i]
                                                 : ((const double *)start)[i];
            if (value >= m->least && value <= m->most)
                continue;
            snprintf(text, room, "%s%s must be %g..%g (got %g%s)", whose, m->name, m->least,
                     m->most, value, where);
            return false;
        }
    }
    return true;
}

void members_free(const struct members *members, void *of)
{
    for (const struct member *m = members->first; m < members->first + members->count; m++)
        if (m->form && m->form->free)
            m->form->free((char *)of + m->offset, of);
}
