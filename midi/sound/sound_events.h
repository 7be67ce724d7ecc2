/* sound_events.h - events of bodies that hit, are tacked, plucked or break, as notes.
 *
 *     struct midi_song *song = sound_events_song();
 *     sound_event_add(song, &(struct sound_event){.kind = SOUND_CLANK, .time_s = 0.42, .velocity = 63, .height = 0.5});
 *     sound_render(&def, song, film_seconds, "letters.wav");
 *
 * Each kind has a channel and a General MIDI sound of its own, with a quick attack; the
 * velocity is the loudness.
 */
#ifndef LUTETIA_MIDI_SOUND_EVENTS_H
#define LUTETIA_MIDI_SOUND_EVENTS_H

#include <midi_song.h>

enum sound_kind { SOUND_CLANK, SOUND_CLICK, SOUND_TWANG, SOUND_SNAP, SOUND_KINDS };

struct sound_event {
    enum sound_kind kind;
    double time_s; /* from the beginning */
    int velocity;  /* 1..127 */
    double height; /* 0 low (something large) to 1 high */
    double side;   /* -1 left to 1 right */
};

/* Reads "clank", "click", "twang", "snap"; -1: none of them. */
int sound_kind_read(const char *name);
const char *sound_kind_name(enum sound_kind kind);

/* Makes a song with the channels' sounds set. NULL: no memory. */
struct midi_song *sound_events_song(void);
/* The event's messages: its pan, the note, and the note's end. With a live synthesizer the
 * caller sends the end later. Range: values are clamped. */
void sound_event_messages(const struct sound_event *e, uint64_t time_ns,
                          struct midi_message messages[static 3]);
/* The duration of the note. */
uint64_t sound_event_ns(enum sound_kind kind);
/* The message that sets a kind's sound, sent once to a synthesizer. */
struct midi_message sound_kind_program(enum sound_kind kind);
/* Errors: NO_MEMORY, BAD_ARGUMENT (a time that is none). */
enum midi_status sound_event_add(struct midi_song *song, const struct sound_event *e);

#endif
