/* midi_song_internal.h - struct midi_song: events in a list, their bytes in one block of
 * memory. */
#ifndef LUTETIA_MIDI_SONG_INTERNAL_H
#define LUTETIA_MIDI_SONG_INTERNAL_H

#include "midi_internal.h"
#include "midi_song.h"

enum { SONG_BYTES_MAX = 64 << 20, SONG_TRACKS_MAX = 65535 };

struct song_event {
    uint64_t time_ns;
    uint32_t tick, order; /* order: in which they were added */
    uint32_t offset, count;
    uint16_t track;
    uint8_t kind, meta;
};

struct song_tempo {
    uint32_t tick, tempo_us;
    uint64_t time_ns;
};

struct midi_song {
    int format, division, tracks_count;
    bool sorted; /* events are in order and have their times */
    struct song_event *events;
    size_t events_count, events_room;
    uint8_t *bytes;
    size_t bytes_count, bytes_room;
    uint32_t *end_ticks; /* of each track */
    struct song_tempo *tempos;
    size_t tempos_count, tempos_room;
    int open_track; /* the track of the system exclusive being recorded; -1: none */
};

/* Makes room for one more item of that size. Errors: NO_MEMORY. */
enum midi_status song_room(void **items, size_t *room, size_t count, size_t item_bytes);
/* Sorts the events and computes their times. */
enum midi_status song_sort(struct midi_song *song);

#endif
