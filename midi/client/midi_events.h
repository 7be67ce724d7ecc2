/* midi_events.h - a client's events that wait to be taken, in their order. */
#ifndef LUTETIA_MIDI_EVENTS_H
#define LUTETIA_MIDI_EVENTS_H

#include "midi_client.h"

#include <stddef.h>

/* All zeros is an empty one. A ring that has grown goes when it is empty: an event has the room
 * of the longest text and message. */
struct midi_events {
    struct midi_client_event *ring;
    size_t first, count, room;
    uint32_t lost; /* dropped because it is full */
};

/* The last event, of no kind yet; NULL: there is no room, which is counted. */
struct midi_client_event *midi_events_add(struct midi_events *events);
/* Takes the last one back. */
void midi_events_drop(struct midi_events *events);
/* The first event; behind the last one that some were lost, if so. False: none, *out is
 * NOTHING. */
bool midi_events_take(struct midi_events *events, struct midi_client_event *out);
void midi_events_finish(struct midi_events *events);

#endif
