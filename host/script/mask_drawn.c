/* mask_drawn.c - what masks were drawn from, in the terms of drawing.h: renders draw them
 * anew. */
#include "script_mask.h"

#include <stdlib.h>

bool script_mask_drawn(const struct script_mask *mask, struct event_bytes *b)
{
    if (mask->points)
        paper_drawing_polygon(b, mask->points, mask->points_count);
    else
        event_put_bytes(b, mask->drawn.at, mask->drawn.count);
    return (mask->points || mask->drawn.count > 0) && !b->short_of_memory &&
           b->count <= PAPER_DRAWING_MOST;
}

static void drawn_forget(struct script_mask *mask)
{
    free(mask->drawn.at);
    mask->drawn = (struct event_bytes){0};
}

void script_mask_drawn_keep(struct script_mask *mask, bool known)
{
    if (!known)
        drawn_forget(mask);
    mask->bytes += (double)mask->drawn.count;
    mask->script->memory_bytes += mask->drawn.count;
}

void script_mask_drawn_join(struct script_mask *made, const struct script_mask *a,
                            const struct script_mask *b, char operation)
{
    bool known = script_mask_drawn(a, &made->drawn);
    if (known && b) {
        known = script_mask_drawn(b, &made->drawn);
        paper_drawing_join(&made->drawn, operation);
    }
    script_mask_drawn_keep(made, known);
}

void script_mask_drawing_tell(struct script_mask *mask, struct paper_screen *screen)
{
    if (mask->drawn.count == 0 || mask->drawn.short_of_memory)
        return;
    mask->drawing = (struct paper_drawing){mask->drawn.at, mask->drawn.count, 1};
    screen->drawing = &mask->drawing;
}

bool script_mask_drawn_part(struct script_mask *all, const struct script_mask *part,
                            bool joined)
{
    const bool known = script_mask_drawn(part, &all->drawn);
    if (joined)
        paper_drawing_join(&all->drawn, '+');
    return known;
}
