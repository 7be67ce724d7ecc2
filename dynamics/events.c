/* events.c - see events.h. */
#include "events.h"
#include "internal.h"

#include <stdlib.h>

void dyn_event_add(struct dyn_network *n, struct dyn_event event)
{
    if (!n->events)
        n->events = malloc(DYN_EVENTS_MAX * sizeof *n->events);
    if (!n->events || n->events_count == DYN_EVENTS_MAX)
        n->events_lost++;
    if (!n->events)
        return;
    if (n->events_count == DYN_EVENTS_MAX) {
        n->events_first = (n->events_first + 1) % DYN_EVENTS_MAX;
        n->events_count--;
    }
    n->events[(n->events_first + n->events_count++) % DYN_EVENTS_MAX] = event;
}

void dyn_snap(struct dyn_network *n, int spring, double strain, double time_s)
{
    const struct dyn_state *a = &n->state[n->end[spring][0]], *b = &n->state[n->end[spring][1]];
    n->broken[spring] = true;
    n->changed = true;
    dyn_event_add(n, (struct dyn_event){.kind = DYN_SNAP,
                                        .time_s = time_s,
                                        .mass = -1,
                                        .spring = spring,
                                        .strength = strain,
                                        .x = (a->x + b->x) / 2,
                                        .y = (a->y + b->y) / 2});
}

int dyn_events_take(struct dyn_network *n, struct dyn_event *out, int most)
{
    int count = 0;
    for (; count < most && n->events_count > 0; count++) {
        out[count] = n->events[n->events_first];
        n->events_first = (n->events_first + 1) % DYN_EVENTS_MAX;
        n->events_count--;
    }
    return count;
}

long long dyn_events_lost(const struct dyn_network *n)
{
    return n->events_lost;
}

const char *dyn_event_name(enum dyn_event_kind kind)
{
    static const char *const names[] = {"clank", "click", "twang", "snap"};
    return names[kind];
}

int dyn_clank_velocity(double speed)
{
    double loud = 20 * speed;
    return loud < 1 ? 1 : loud > 127 ? 127 : (int)loud;
}
