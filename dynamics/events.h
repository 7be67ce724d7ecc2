/* events.h - events that can be heard: masses that hit the floor, are tacked or plucked,
 * springs that break.
 *
 *     struct dyn_event events[64];
 *     for (int count; (count = dyn_events_take(network, events, 64)) > 0;)
 *         play(events, count);
 *
 * Errors, ownership and threads: as network.h says.
 */
#ifndef LUTETIA_DYN_EVENTS_H
#define LUTETIA_DYN_EVENTS_H

#include "network.h"

enum dyn_event_kind {
    DYN_CLANK, /* a mass bounced; strength: its speed after the bounce, units/s */
    DYN_CLICK, /* a mass was tacked; strength 1 */
    DYN_TWANG, /* a mass was released; strength: the greatest strain of its springs, then
                * `spring` is that spring */
    DYN_SNAP   /* a spring broke or was cut; strength: its strain */
};

enum dyn_side { DYN_FLOOR, DYN_CEILING, DYN_LEFT, DYN_RIGHT };

struct dyn_event {
    enum dyn_event_kind kind;
    enum dyn_side side; /* of a clank */
    double time_s;      /* the network's time, exact to the part of a step */
    int mass, spring;   /* -1: none */
    double strength;
    double x, y; /* where */
};

/* Takes the oldest waiting events, at most `most`; returns how many. At most DYN_EVENTS_MAX
 * wait; when there are more, the oldest are dropped and counted. */
enum { DYN_EVENTS_MAX = 4096 };
int dyn_events_take(struct dyn_network *n, struct dyn_event *out, int most);
long long dyn_events_lost(const struct dyn_network *n);

/* "clank" and so on: a constant, valid for ever; never NULL. */
const char *dyn_event_name(enum dyn_event_kind kind);

/* A clank's loudness as a MIDI velocity, 1..127: 20 for each unit/s. Source: the thesis,
 * appendix 7.1. */
int dyn_clank_velocity(double speed);

#endif
