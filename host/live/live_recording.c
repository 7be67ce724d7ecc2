/* live_recording.c - see live_recording.h. */
#include "live_recording.h"

#include <midi_internal.h>
#include <sound.h>

void live_recording_finish(struct live_recording *r)
{
    midi_song_destroy(r->heard);
    *r = (struct live_recording){.heard = NULL};
}

void live_recording_begin(struct live_recording *r, uint64_t now_ns)
{
    live_recording_finish(r);
    r->heard = sound_events_song();
    r->began_ns = now_ns;
}

void live_recording_add(struct live_recording *r, const struct sound_event *e, uint64_t now_ns)
{
    struct sound_event at = *e;
    at.time_s = (double)(now_ns - r->began_ns) / 1e9;
    if (r->heard && sound_event_add(r->heard, &at) == MIDI_OK)
        r->count++;
}

/* The song from a time on: what was set before it holds, notes of before are over. */
static enum midi_status song_part(struct midi_song *song, double from_s, struct midi_song **out)
{
    const struct midi_song_def def = midi_song_def_default();
    const uint64_t from_ns = from_s > 0 ? (uint64_t)(1e9 * from_s) : 0;
    const size_t count = midi_song_info(song).events_count;
    enum midi_status status = midi_song_create(&def, out);
    for (size_t i = 0; i < count && status == MIDI_OK; i++) {
        const struct midi_song_event e = midi_song_event(song, i);
        const int kind = e.kind == MIDI_SONG_MESSAGE ? e.bytes[0] & 0xf0 : 0;
        if (!kind || (e.time_ns < from_ns && (kind == MIDI_NOTE_ON || kind == MIDI_NOTE_OFF)))
            continue;
        const struct midi_message m =
            midi_message_make(e.time_ns > from_ns ? e.time_ns - from_ns : 0, e.bytes[0],
                              e.bytes[1], e.count > 2 ? e.bytes[2] : 0);
        status = midi_song_record(*out, 0, &m, 0);
    }
    return status;
}

enum midi_status live_recording_end(struct live_recording *r, uint64_t now_ns,
                                    struct midi_song *song, double song_s, int *file)
{
    struct sound_def def = sound_def_default();
    const double seconds = (double)(now_ns - r->began_ns) / 1e9;
    enum midi_status status = MIDI_OK;
    *file = -1;
    def.room = true;
    if (!r->heard)
        return MIDI_OK;
    if (song)
        status = song_part(song, song_s, &def.beside);
    if (status == MIDI_OK && (r->count > 0 || song) && seconds > 0)
        status = sound_render_open(&def, r->heard, seconds, file);
    midi_song_destroy(def.beside);
    live_recording_finish(r);
    return status;
}
