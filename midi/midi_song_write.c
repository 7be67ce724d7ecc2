/* midi_song_write.c - writes a song as a Standard MIDI File. */
#include "midi_song_internal.h"

#include <output_file.h>

#include <stdlib.h>
#include <string.h>

struct writer {
    uint8_t *bytes;
    size_t count, room;
    enum midi_status status;
};

static void put(struct writer *w, const void *bytes, size_t count)
{
    void *all = w->bytes;
    if (w->status == MIDI_OK)
        w->status = song_room(&all, &w->room, w->count + count, 1);
    w->bytes = all;
    if (w->status != MIDI_OK || !count)
        return;
    memcpy(w->bytes + w->count, bytes, count);
    w->count += count;
}

static void put_number(struct writer *w, uint32_t value, int bytes_count)
{
    for (int i = bytes_count - 1; i >= 0; i--)
        put(w, &(uint8_t){(uint8_t)(value >> 8 * i)}, 1);
}

static void put_length(struct writer *w, uint32_t value)
{
    int groups = 1;
    while (groups < 4 && value >> 7 * groups)
        groups++;
    while (groups--)
        put(w, &(uint8_t){(uint8_t)((value >> 7 * groups & 0x7f) | (groups ? 0x80 : 0))}, 1);
}

/* A delta larger than a number of the file is divided by empty text events (ff 01 00), which
 * every program can read. */
static void put_delta(struct writer *w, uint32_t delta)
{
    enum { DELTA_MAX = 0x0fffffff };
    for (; delta > DELTA_MAX; delta -= DELTA_MAX) {
        put_length(w, DELTA_MAX);
        put(w, "\xff\x01", 3); /* includes the 0 that ends the literal */
    }
    put_length(w, delta);
}

static void put_event(struct writer *w, const struct midi_song_event *e, uint8_t *running)
{
    switch (e->kind) {
    case MIDI_SONG_MESSAGE: {
        const uint32_t from = *running == e->bytes[0];
        put(w, e->bytes + from, e->count - from);
        *running = e->bytes[0];
        return;
    }
    case MIDI_SONG_SYSEX:
        put_number(w, MIDI_SYSEX, 1);
        put_length(w, e->count - 1);
        put(w, e->bytes + 1, e->count - 1);
        break;
    case MIDI_SONG_ESCAPE:
        put_number(w, MIDI_SYSEX_END, 1);
        put_length(w, e->count);
        put(w, e->bytes, e->count);
        break;
    case MIDI_SONG_META:
        put_number(w, 0xff, 1);
        put_number(w, e->meta, 1);
        put_length(w, e->count);
        put(w, e->bytes, e->count);
        break;
    }
    *running = 0;
}

/* The events of a track are scattered among all; first[track] and next[] link them. */
static void put_track(struct writer *w, struct midi_song *song, int track,
                      const uint32_t *first, const uint32_t *next)
{
    uint32_t tick = 0;
    uint8_t running = 0;
    put(w, "MTrk\0\0\0\0", 8);
    const size_t begin = w->count;
    for (uint32_t i = first[track]; i != UINT32_MAX && w->status == MIDI_OK; i = next[i]) {
        const struct midi_song_event e = midi_song_event(song, i);
        if (e.tick - tick > 0x0fffffff)
            running = 0;
        put_delta(w, e.tick - tick);
        put_event(w, &e, &running);
        tick = e.tick;
    }
    put_delta(w, song->end_ticks[track] - tick);
    put(w, "\xff\x2f", 3);
    if (w->status != MIDI_OK)
        return;
    const size_t length = w->count - begin;
    for (int i = 0; i < 4; i++)
        w->bytes[begin - 4 + (size_t)i] = (uint8_t)(length >> 8 * (3 - i));
}

enum midi_status midi_song_bytes(struct midi_song *song, uint8_t **bytes, size_t *count)
{
    struct writer w = {0};
    *bytes = NULL;
    *count = 0;
    if (!song->tracks_count && midi_song_end(song, 0, 0) != MIDI_OK)
        return MIDI_NO_MEMORY;
    w.status = song_sort(song);
    const size_t tracks = (size_t)song->tracks_count;
    uint32_t *first = malloc(tracks * sizeof *first);
    uint32_t *next = malloc((song->events_count + 1) * sizeof *next);
    if (!first || !next)
        w.status = midi_fail(MIDI_NO_MEMORY, "no memory to write a song");
    for (size_t i = 0; w.status == MIDI_OK && i < tracks; i++)
        first[i] = UINT32_MAX;
    for (size_t i = song->events_count; w.status == MIDI_OK && i-- > 0;) {
        next[i] = first[song->events[i].track];
        first[song->events[i].track] = (uint32_t)i;
    }
    put(&w, "MThd\0\0\0\6", 8);
    put_number(&w, (uint32_t)song->format, 2);
    put_number(&w, (uint32_t)tracks, 2);
    put_number(&w,
               song->division > 0
                   ? (uint32_t)song->division
                   : (uint32_t)((256 - (-song->division >> 8)) << 8 | (-song->division & 255)),
               2);
    for (int i = 0; w.status == MIDI_OK && i < song->tracks_count; i++)
        put_track(&w, song, i, first, next);
    free(first);
    free(next);
    if (w.status != MIDI_OK) {
        free(w.bytes);
        return w.status;
    }
    *bytes = w.bytes;
    *count = w.count;
    return MIDI_OK;
}

enum midi_status midi_song_write(struct midi_song *song, const char *path)
{
    uint8_t *bytes;
    size_t count;
    struct output_file out;
    enum midi_status status = midi_song_bytes(song, &bytes, &count);
    if (status != MIDI_OK)
        return status;
    if (!output_file_open(&out, path)) {
        status = midi_fail(MIDI_IO_FAILED, "%s: cannot write: %s", path, out.why);
    } else {
        fwrite(bytes, 1, count, out.stream);
        if (!output_file_commit(&out))
            status = midi_fail(MIDI_IO_FAILED, "%s: cannot write: %s", path, out.why);
    }
    free(bytes);
    return status;
}
