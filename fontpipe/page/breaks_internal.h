/* breaks_internal.h - what breaks_find.c and breaks_again.c share. */
#ifndef LUTETIA_PAGE_BREAKS_INTERNAL_H
#define LUTETIA_PAGE_BREAKS_INTERNAL_H

#include "breaks.h"

/* A search that goes on: nodes that were active when it began, then those that it makes. */
struct search {
    const struct break_place *places;
    const double *widths;
    int widths_count, last;
    int last_word; /* the place that the last word begins behind */
    const struct break_rules *rules;
    struct break_node *nodes;
    int count, capacity;
    int *active, active_count, active_capacity;
    struct break_check *checks;
    int checks_count, checks_capacity;
    int place; /* that is looked at next */
};

enum { BREAK_ACTIVE = 0x7fffffff }; /* a node that is not gone */

bool search_node_add(struct search *s, struct break_node node);
/* Looks at places up to that one, not at it; stops behind one at which no node is active. */
bool search_run(struct search *s, int until);

#endif
