/* song_support.c - see song_support.h. */
#include "song_support.h"

#include "../sample.h"

#include <stdlib.h>
#include <string.h>

static void add(struct midi_song *song, struct midi_song_event e)
{
    if (midi_song_add(song, &e) != MIDI_OK)
        abort();
}

struct midi_song *song_by_chance(uint64_t *seed, int events_count)
{
    static const int divisions[] = {1, 96, 480, 9600, 32767, -(25 << 8 | 40), -(29 << 8 | 80)};
    struct midi_song_def def = midi_song_def_default();
    struct midi_song *song;
    uint32_t ticks[5] = {0};
    def.format = sample_word(seed) % 3 != 0;
    def.division = divisions[sample_word(seed) % 7];
    if (midi_song_create(&def, &song) != MIDI_OK)
        abort();
    for (int i = 0; i < events_count; i++) {
        const uint64_t any = sample_word(seed);
        uint8_t bytes[400] = {0};
        struct midi_song_event e = {.track = (uint16_t)(def.format ? any % 5 : 0),
                                    .bytes = bytes};
        for (size_t k = 0; k < sizeof bytes; k++)
            bytes[k] = (uint8_t)(sample_word(seed) & 0x7f);
        ticks[e.track] +=
            any >> 8 & 15 ? (uint32_t)(any >> 16 & 63) : (uint32_t)(any >> 40 & 0xfffff);
        e.tick = ticks[e.track];
        switch (any >> 60) {
        case 0:
            e.kind = MIDI_SONG_SYSEX;
            e.count = (uint32_t)(2 + (any >> 32) % 390);
            bytes[0] = 0xf0;
            bytes[e.count - 1] = 0xf7;
            break;
        case 1:
            e.kind = MIDI_SONG_ESCAPE;
            e.count = (uint32_t)(any >> 32 & 7);
            break;
        case 2:
            e.kind = MIDI_SONG_META;
            e.meta = (uint8_t)(1 + (any >> 32) % 9);
            e.count = (uint32_t)(any >> 36 & 255);
            break;
        case 3:
            e.kind = MIDI_SONG_META;
            e.meta = MIDI_META_TEMPO;
            e.count = 3;
            break;
        default:
            bytes[0] = (uint8_t)(0x80 | (any >> 32) % 0x70);
            e.count = 1u + midi_row_of(bytes[0])->data_count;
        }
        add(song, e);
    }
    if (midi_song_end(song, 0, ticks[0] + 100) != MIDI_OK)
        abort();
    return song;
}

const char *songs_differ(struct midi_song *a, struct midi_song *b)
{
    const struct midi_song_info x = midi_song_info(a), y = midi_song_info(b);
    if (x.format != y.format || x.division != y.division || x.tracks_count != y.tracks_count)
        return "format, division or tracks";
    if (x.events_count != y.events_count)
        return "the number of events";
    if (x.end_tick != y.end_tick || x.end_ns != y.end_ns)
        return "the end";
    for (size_t i = 0; i < x.events_count; i++) {
        const struct midi_song_event e = midi_song_event(a, i), f = midi_song_event(b, i);
        if (e.tick != f.tick || e.time_ns != f.time_ns || e.track != f.track)
            return "an event's time or track";
        if (e.kind != f.kind || e.meta != f.meta || e.count != f.count ||
            (e.count && memcmp(e.bytes, f.bytes, e.count) != 0))
            return "an event";
    }
    return NULL;
}
