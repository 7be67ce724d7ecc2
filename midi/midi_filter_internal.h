/* midi_filter_internal.h - the links of a chain of filters. */
#ifndef LUTETIA_MIDI_FILTER_INTERNAL_H
#define LUTETIA_MIDI_FILTER_INTERNAL_H

#include "midi_filter.h"
#include "midi_internal.h"

enum { MIDI_LINKS_MAX = 16, MIDI_HELD_MAX = 256 };

enum midi_link_kind {
    MIDI_LINK_DROP,
    MIDI_LINK_CHANNELS,
    MIDI_LINK_NOTES,
    MIDI_LINK_TRANSPOSE,
    MIDI_LINK_VELOCITY,
    MIDI_LINK_CHANNEL,
    MIDI_LINK_SPLIT,
    MIDI_LINK_THIN
};

/* A value that is thinned. */
struct midi_held {
    int key;
    bool waits;       /* the message is held back until sent_ns + interval */
    uint64_t sent_ns; /* when a value was last passed on */
    uint64_t order;   /* of beginning to wait */
    struct midi_message message;
};

struct midi_link {
    enum midi_link_kind kind;
    uint32_t rows;     /* DROP: a bit for each row of the table */
    uint16_t channels; /* CHANNELS: a bit for each */
    int least, most;   /* NOTES; SPLIT: least */
    int steps;         /* TRANSPOSE */
    int channel;       /* CHANNEL, SPLIT: from 0 */
    uint8_t curve[128];
    uint64_t interval_ns; /* THIN */
    struct midi_held *held;
    int held_count;
};

struct midi_chain {
    int links_count;
    uint64_t order;
    struct midi_link links[MIDI_LINKS_MAX];
};

#endif
