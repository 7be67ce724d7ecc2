/* live_source.h - what is played, from wherever it comes: a MIDI server, a song in time, the
 * computer's own keyboard.
 *
 *     // the user's own server, else the computer's keyboard
 *     struct live_source_def def = {.lowest = 48};
 *     struct live_source *source;
 *     if (live_source_open(&def, &source) != MIDI_OK)
 *         die(midi_error());
 *     while (live_source_next(source, now_s, &message))          // before each picture
 *         play(&message);
 *     live_source_close(source);
 *
 * Threads: a source belongs to one. */
#ifndef LUTETIA_LIVE_SOURCE_H
#define LUTETIA_LIVE_SOURCE_H

#include <input.h>
#include <midi_message.h>
#include <midi_song.h>

struct live_source;

struct live_source_def {
    struct midi_song
        *song; /* borrowed; played from second 0 on, and nothing else; NULL: live */
    const char
        *server; /* as midi_client_def's address; NULL: the user's own, if there is one */
    const char *device;  /* of the server; NULL: all */
    const char *filters; /* midi_filter.h; NULL: none */
    int lowest;          /* the note of the computer's lowest key */
    bool no_computer;    /* its keyboard plays nothing, where there is no server either */
};

/* Without a server of the user's own the computer's keyboard plays. Errors: NO_SERVER (the one
 * that was named), REFUSED, BAD_ARGUMENT (filters), NO_MEMORY. */
enum midi_status live_source_open(const struct live_source_def *def, struct live_source **out);
void live_source_close(struct live_source *source); /* NULL is fine */

/* The computer's keyboard plays. */
bool live_source_by_computer(const struct live_source *source);
/* There is nobody for what it would play: it does not. */
void live_source_no_computer(struct live_source *source);
/* A key of the window's, or that it lost the keyboard. True: it was played. */
bool live_source_key(struct live_source *source, const struct input_event *event);

/* The next message that has come, or of the song until second now_s; waits for none. False:
 * there is none. */
bool live_source_next(struct live_source *source, double now_s, struct midi_message *m);
/* When the song's next message is due, in its seconds; INFINITY: there is none, or no song. */
double live_source_due_s(const struct live_source *source);
/* A descriptor that is readable when there is a message; -1: there is none now. */
int live_source_descriptor(const struct live_source *source);
/* What there is to say of the server since the last call: that it has gone, or is back; NULL:
 * nothing. */
const char *live_source_said(struct live_source *source);

#endif
