/* ways.c - what is kept of a long paragraph's breaking: see lines_internal.h. */
#include "lines_internal.h"

#include <stdlib.h>

void ways_finish(struct ways *ways)
{
    for (int i = 0; i < 2; i++)
        places_finish(&ways->places[i]);
    for (int i = 0; i < BREAK_PASSES; i++)
        break_search_finish(&ways->searches[i]);
}

void lines_forget(struct paragraph *p)
{
    if (p->ways)
        ways_finish(p->ways);
    free(p->ways);
    p->ways = NULL;
    p->change_known = false;
}

void lines_changed(struct paragraph *p, int begin, int end_before, int end)
{
    struct break_change *c = &p->change;
    if (c->begin < 0) {
        *c = (struct break_change){begin, end_before, end};
        return;
    }
    const int behind = c->end > end_before ? c->end : end_before; /* as it was in between */
    c->begin = begin < c->begin ? begin : c->begin;
    c->end_before += behind - c->end;
    c->end = behind + end - end_before;
}

size_t lines_bytes(const struct paragraph *p)
{
    size_t bytes = p->ways ? sizeof *p->ways : 0;
    for (int i = 0; p->ways && i < 2; i++) {
        const struct places *places = &p->ways->places[i];
        bytes += (size_t)places->capacity_items * sizeof *places->items +
                 (size_t)places->capacity_letters * sizeof *places->letters +
                 (size_t)places->capacity_hyphens * sizeof *places->hyphens;
    }
    for (int i = 0; p->ways && i < BREAK_PASSES; i++) {
        const struct break_search *search = &p->ways->searches[i];
        bytes += (size_t)search->capacity * sizeof *search->nodes +
                 (size_t)search->checks_capacity * sizeof *search->checks;
    }
    return bytes;
}
