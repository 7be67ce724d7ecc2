/* live_recording.h - what was heard from one moment to another, as sound: for films that a
 * window records.
 *
 *     struct live_recording r = {0};
 *     live_recording_begin(&r, now_ns);
 *     live_recording_add(&r, &event, now_ns);                 // as it is heard
 *     live_recording_end(&r, now_ns, song, song_s, &file);    // a WAV file without a name
 *
 * Times are of the monotonic clock. Threads: one at a time. */
#ifndef LUTETIA_LIVE_RECORDING_H
#define LUTETIA_LIVE_RECORDING_H

#include <sound_events.h>

/* All zeros: nothing is recorded. */
struct live_recording {
    struct midi_song *heard; /* NULL: nothing is recorded */
    uint64_t began_ns;
    long count;
};

/* What was recorded before is forgotten. Without memory nothing is recorded. */
void live_recording_begin(struct live_recording *r, uint64_t now_ns);
void live_recording_add(struct live_recording *r, const struct sound_event *e, uint64_t now_ns);
/* song: was played meanwhile, from its second song_s on; NULL: none. *file: -1 where nothing
 * was heard. Errors: those of sound_render_open(); *file is then -1. Owns: the caller closes
 * *file. */
enum midi_status live_recording_end(struct live_recording *r, uint64_t now_ns,
                                    struct midi_song *song, double song_s, int *file);
void live_recording_finish(struct live_recording *r); /* forgets; zeros it */

#endif
