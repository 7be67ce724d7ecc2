/* midi_wire.h - the protocol between server and clients: frames over a stream. docs/midi.md
 * describes it.
 *
 *     byte 0  bytes of the payload (16 bits)      all numbers with the low byte first
 *          2  kind
 *          3  device (a number; 255: none)
 *          4  number (32 bits): what it counts, the kind says
 *          8  time (64 bits), nanoseconds of CLOCK_MONOTONIC
 *         16  the payload
 */
#ifndef LUTETIA_MIDI_WIRE_H
#define LUTETIA_MIDI_WIRE_H

#include <midi_message.h>

#include <stddef.h>

#define MIDI_WIRE_GREETING "lutetia-midi 1"

enum {
    MIDI_WIRE_HEAD = 16,
    MIDI_WIRE_TEXT_MAX = 1024,   /* of what clients send */
    MIDI_WIRE_REPLY_MAX = 32768, /* of what servers send */
    MIDI_WIRE_DEVICES = 32,
    MIDI_WIRE_NO_DEVICE = 255
};

enum midi_wire_kind {
    MIDI_WIRE_HELLO =
        1, /* client: the greeting, a line with its name; over TCP, see midi_proof.h */
    MIDI_WIRE_COMMAND = 2, /* client: words; number: chosen by the client, and repeated in
                            * the reply */
    /* both: a message to or from the device; number: counts a client's messages from 0 */
    MIDI_WIRE_MIDI = 3,
    MIDI_WIRE_PROOF = 4,    /* client, over TCP: it knows the token */
    MIDI_WIRE_WELCOME = 16, /* server: the greeting */
    MIDI_WIRE_DEVICE =
        17, /* server: a device exists, has come or gone: "NAME KIND in|out|in,out up|down" */
    MIDI_WIRE_LOST =
        18, /* server: the client was too slow, and `number` messages were dropped */
    MIDI_WIRE_REPLY = 19, /* server: the answer to a command */
    MIDI_WIRE_ERROR =
        20, /* server: a command was wrong (its number), or (number 0) the connection ends */
    MIDI_WIRE_CHALLENGE = 21 /* server, over TCP: what the proofs are of */
};

struct midi_wire_frame {
    uint16_t count;
    uint8_t kind, device;
    uint32_t number;
    uint64_t time_ns;
    const uint8_t *payload;
};

/* The head's bytes. */
void midi_wire_head(const struct midi_wire_frame *f, uint8_t bytes[static MIDI_WIRE_HEAD]);
/* The length of the frame at the beginning of the bytes; 0: it is incomplete. payload points
 * into the bytes. */
size_t midi_wire_read(const uint8_t *bytes, size_t count, struct midi_wire_frame *f);
/* Gets the frame's message; false: the payload is not one. */
bool midi_wire_message(const struct midi_wire_frame *f, struct midi_message *m);

/* The default address of the user's server: $XDG_RUNTIME_DIR/lutetia-midi, else lutetia-midi
 * in /tmp/lutetia-UID, a folder made with mode 0700. False: the folder cannot be made, or is
 * not this user's alone; *why says so. */
bool midi_wire_usual_path(char path[static 108], const char **why);

#endif
