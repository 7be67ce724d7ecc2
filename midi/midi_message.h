/* midi_message.h - a message of MIDI 1.0, the table of all messages, and messages as text.
 *
 *     struct midi_message m = midi_message_make(now_ns, 0x90, 60, 100);
 *     char text[MIDI_TEXT_MAX];
 *     midi_message_text(&m, text);                       // "note-on 1 c4 100"
 *     if (midi_message_read("control 1 7 127", &m) != MIDI_OK)
 *         die(midi_error());
 *
 * A message is one status byte and its data bytes. System exclusive can be of any length, so it
 * is divided into pieces, each a message of up to MIDI_BYTES_MAX bytes. The bytes of a piece
 * show its kind:
 *
 *     f0 . . . .      the first byte is f0: a first piece
 *     . . . . . .     the first byte is data: one that goes on
 *     . . . f7        the last byte is f7: a last piece (which may be a first one, too, or f7
 *                     alone)
 *
 * Between two pieces of one system exclusive only real-time messages (f8 to ff) may come.
 *
 * Source: The Complete MIDI 1.0 Detailed Specification, table of status bytes.
 *
 * Errors: functions that can fail return a status and leave one line in midi_error().
 *
 * Ownership: messages are values, and point to nothing. Threads: any.
 */
#ifndef LUTETIA_MIDI_MESSAGE_H
#define LUTETIA_MIDI_MESSAGE_H

#include "midi_status.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
    MIDI_BYTES_MAX = 244, /* bytes of a piece of system exclusive; the whole struct then has
                           * 256 bytes */
    MIDI_TEXT_MAX = 3 * MIDI_BYTES_MAX + 32,
    MIDI_CHANNELS = 16,
    MIDI_NOTES = 128
};

enum {
    MIDI_NOTE_OFF = 0x80,
    MIDI_NOTE_ON = 0x90,
    MIDI_POLY_PRESSURE = 0xa0, /* aftertouch of one key */
    MIDI_CONTROL = 0xb0,
    MIDI_PROGRAM = 0xc0,
    MIDI_PRESSURE = 0xd0, /* aftertouch of a channel */
    MIDI_BEND = 0xe0,
    MIDI_SYSEX = 0xf0,
    MIDI_SYSEX_END = 0xf7,
    MIDI_CLOCK = 0xf8,
    MIDI_SENSING = 0xfe,
    MIDI_RESET = 0xff
};

struct midi_message {
    uint64_t time_ns; /* CLOCK_MONOTONIC at the read that brought its last byte */
    uint16_t count;   /* of bytes; 1 or more */
    uint8_t bytes[MIDI_BYTES_MAX];
};

/* ---- the table ---- */

enum midi_kind {
    MIDI_KIND_CHANNEL,
    MIDI_KIND_SYSEX,              /* f0, and what goes on */
    MIDI_KIND_COMMON,             /* f1 to f6: ends running status */
    MIDI_KIND_REAL_TIME,          /* f8 to ff: may come inside any other message */
    MIDI_KIND_UNDEFINED,          /* f4, f5: end running status like common messages; dropped */
    MIDI_KIND_UNDEFINED_REAL_TIME /* f9, fd: dropped */
};

struct midi_row {
    const char *name; /* "note-on" */
    uint8_t status;   /* of channel messages with channel 0 */
    enum midi_kind kind;
    uint8_t data_count; /* bytes that follow */
};

/* The row of a status byte, 0x80 to 0xff; NULL for data bytes. All rows; never NULL. They are
 * constants, valid for ever. */
const struct midi_row *midi_row_of(uint8_t status);
const struct midi_row *midi_rows(int *count);

/* ---- messages ---- */

/* Makes a message with up to two data bytes; superfluous ones are ignored. Range: status is
 * 0x80 or more and not system exclusive; data 0..127 (masked). */
struct midi_message midi_message_make(uint64_t time_ns, uint8_t status, uint8_t first,
                                      uint8_t second);

/* The kind, by the first byte; a data byte means a continued system exclusive. */
enum midi_kind midi_message_kind(const struct midi_message *m);
/* 0..15, or -1 if the message has no channel. */
int midi_message_channel(const struct midi_message *m);
/* Whether the number of bytes and each byte are valid. */
bool midi_message_good(const struct midi_message *m);
/* Whether another piece of the system exclusive follows. */
bool midi_message_open(const struct midi_message *m);
/* Whether all but their times is equal. */
bool midi_message_equal(const struct midi_message *a, const struct midi_message *b);

/* Whether it is a note-on with a velocity above 0; whether it ends a note: a note-off, or a
 * note-on with velocity 0. */
bool midi_message_strikes(const struct midi_message *m);
bool midi_message_releases(const struct midi_message *m);

/* ---- as words ---- */

/* A name, the channel from 1, then numbers; notes as c4 (60), c#4, sysex as hexadecimal digits:
 * "note-on 10 c#2 90", "bend 1 -200", "song-position 12", "sysex f0 7e 7f 09 01 f7". */
void midi_message_text(const struct midi_message *m, char text[MIDI_TEXT_MAX]);
/* Reads what the above wrote; notes may be numbers, too. Errors: BAD_ARGUMENT, with the known
 * names. */
enum midi_status midi_message_read(const char *text, struct midi_message *m);
/* Reads "c4", "f#-1", or a number, 0..127. -1: it is neither. */
int midi_note_read(const char *word);
/* The note as text; 8 bytes are enough. */
void midi_note_text(int note, char text[8]);

#ifdef __cplusplus
}
#endif

#endif
