/* midi_song.h - Standard MIDI Files of formats 0 and 1, read and written; ticks and seconds.
 *
 *     struct midi_song *song;
 *     if (midi_song_read("song.mid", &song) != MIDI_OK)
 *         // "song.mid: track 3 ends within an event, at byte 1234"
 *         die(midi_error());
 *     for (size_t i = 0; i < midi_song_info(song).events_count; i++) {
 *         // by time, those of one time as they stand in the file
 *         struct midi_song_event e = midi_song_event(song, i);
 *         wait_until(e.time_ns);
 *         midi_song_play(&e, &parser, message_taken, context);
 *     }
 *     midi_song_destroy(song);
 *
 * A file that is read and written again has the same events; running status is used where it
 * saves a byte.
 *
 * Also accepted: a file within RIFF (RMID), chunks of other kinds (skipped), a missing end of a
 * track, running status across meta events, fewer tracks than the header says. Refused: format
 * 2, files over 64 MiB, truncated files.
 *
 * Time. A division is ticks for a quarter note, whose length tempo events change, or for a
 * frame of SMPTE time. The tempo map is exact to a nanosecond for each of its stretches, and
 * holds for all tracks.
 *
 * Source: Standard MIDI-File Format Spec. 1.1.
 *
 * Errors: functions that can fail return a status and leave one line in midi_error().
 *
 * Ownership: what is passed is copied; an event's bytes are the song's, valid until an event is
 * added.
 *
 * Threads: a song belongs to one thread at a time; those that only look sort its events first.
 */
#ifndef LUTETIA_MIDI_SONG_H
#define LUTETIA_MIDI_SONG_H

#include "midi_parser.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
    MIDI_TEMPO_USUAL_US = 500000, /* microseconds of a quarter note, if there is no tempo
                                   * event: 120 a minute */
    MIDI_DIVISION_USUAL = 9600,   /* for recordings: a tick is 52 us */
    MIDI_META_TRACK_NAME = 0x03,
    MIDI_META_END = 0x2f,
    MIDI_META_TEMPO = 0x51
};

enum midi_song_kind {
    MIDI_SONG_MESSAGE, /* a channel message; the bytes begin with its status */
    MIDI_SONG_SYSEX,   /* the bytes begin with f0, and end with f7 if no packet follows */
    MIDI_SONG_ESCAPE,  /* raw bytes: packets of a system exclusive, or anything */
    MIDI_SONG_META
};

struct midi_song_event {
    uint64_t time_ns; /* from the beginning */
    uint32_t tick;
    uint16_t track; /* from 0 */
    enum midi_song_kind kind;
    uint8_t meta; /* its type; of META */
    uint32_t count;
    const uint8_t *bytes; /* owned by the song; NULL: none */
};

struct midi_song;

struct midi_song_def {
    int format; /* 0 or 1 */
    /* ticks of a quarter note, 1..32767; or -(frames << 8 | ticks): frames 24, 25, 29, 30 */
    int division;
};
struct midi_song_def midi_song_def_default(void); /* format 1, MIDI_DIVISION_USUAL */

/* An empty song. Errors: BAD_ARGUMENT (a format or division that cannot be), NO_MEMORY; *out is
 * then NULL. Owns: the caller destroys *out. */
enum midi_status midi_song_create(const struct midi_song_def *def, struct midi_song **out);
void midi_song_destroy(struct midi_song *song); /* takes NULL */

/* ---- files ---- */

/* Errors: BAD_FILE, IO_FAILED, NO_MEMORY; *out is then NULL. Owns: the caller destroys *out. */
enum midi_status midi_song_read(const char *path, struct midi_song **out);
/* The same of bytes in memory; name: used in errors. Errors: BAD_FILE, NO_MEMORY; *out is then
 * NULL. Owns: the caller destroys *out. */
enum midi_status midi_song_parse(const char *name, const uint8_t *bytes, size_t count,
                                 struct midi_song **out);
/* Writes a whole file or none. Errors: IO_FAILED, NO_MEMORY. */
enum midi_status midi_song_write(struct midi_song *song, const char *path);
/* The file as bytes. Errors: NO_MEMORY. Owns: the caller frees *bytes. */
enum midi_status midi_song_bytes(struct midi_song *song, uint8_t **bytes, size_t *count);

/* ---- what is in it ---- */

struct midi_song_info {
    int format, division, tracks_count;
    size_t events_count; /* without the ends of tracks */
    uint32_t end_tick;
    uint64_t end_ns; /* when the last track ends */
};
/* Of the song as it is now. */
struct midi_song_info midi_song_info(struct midi_song *song);
/* Range: index is below events_count. */
struct midi_song_event midi_song_event(struct midi_song *song, size_t index);
/* The event as messages, through the caller's parser, which keeps the state of an open
 * system exclusive. Meta events give none. */
void midi_song_play(const struct midi_song_event *e, struct midi_parser *parser,
                    midi_take *take, void *context);

/* By the tempo map. */
uint64_t midi_song_time_ns(struct midi_song *song, uint32_t tick);
uint32_t midi_song_tick(struct midi_song *song, uint64_t time_ns); /* the nearest */

/* ---- making one ---- */

/* Adds an event anywhere; there are as many tracks as the largest number requires. The bytes
 * are copied. Errors: BAD_ARGUMENT (a track that format 0 lacks, bytes that do not fit the
 * kind), NO_MEMORY. */
enum midi_status midi_song_add(struct midi_song *song, const struct midi_song_event *event);
/* Records a message at its time_ns since begin_ns, by the default tempo: a recorded song has
 * no tempo events. Pieces of a system exclusive become one event. Files cannot hold
 * real-time and common messages, which are left out. Errors: those of midi_song_add(). */
enum midi_status midi_song_record(struct midi_song *song, int track,
                                  const struct midi_message *m, uint64_t begin_ns);
/* Ends the track at that time or at its last event, whichever is later. Errors: BAD_ARGUMENT
 * (no such track), NO_MEMORY. */
enum midi_status midi_song_end(struct midi_song *song, int track, uint32_t tick);

#ifdef __cplusplus
}
#endif

#endif
