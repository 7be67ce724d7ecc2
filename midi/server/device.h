/* device.h - where messages come from and go to: what all kinds of devices have in common.
 *
 * Bytes in go through a parser, messages out through an encoder and a ring of bytes. A device that is away is tried again. */
#ifndef LUTETIA_MIDI_DEVICE_H
#define LUTETIA_MIDI_DEVICE_H

#include "server_loop.h"

#include <midi_encoder.h>
#include <midi_notes.h>
#include <midi_parser.h>

enum {
    DEVICE_NAME_BYTES = 64,
    DEVICE_ARGUMENT_BYTES = 400,
    DEVICE_OUT_BYTES = 32768, /* so much in all: there is room for the ends of all notes */
    DEVICE_OUT_USUAL = 512 /* so much of messages: what waits longer waits with who sends it */
};

struct server_device;

struct device_kind {
    const char *name, *argument, *help;
    bool plays;   /* all of this kind take messages; else open() says */
    bool hears;   /* all give some */
    int retry_ms; /* between tries while it is away; 0: 100 */
    bool stays;   /* goes and comes with the server: nobody else has played it */
    /* Tries to be there. Errors: NO_DEVICE, IO_FAILED: it is tried again later. BAD_ARGUMENT, BAD_FILE: it never will be. */
    enum midi_status (*open)(struct server_device *d);
    void (*close)(struct server_device *d);  /* also after an open() that failed */
    void (*finish)(struct server_device *d); /* for good; may be NULL */
    /* Takes what it can now of the bytes; where that is not all, device_write_out() is to be called later. */
    size_t (*write)(struct server_device *d, const uint8_t *bytes, size_t count);
    void (*more)(struct server_device *d,
                 bool wanted); /* call device_write_out() when it can take some; may be NULL */
};

struct device_counts {
    uint64_t in, out, refused; /* refused: from programs while it was away */
    uint32_t opened;
};

struct server_device {
    const struct device_kind *kind;
    char name[DEVICE_NAME_BYTES], argument[DEVICE_ARGUMENT_BYTES];
    int number;
    struct server_loop *loop;
    bool up, plays, hears;
    char why[200]; /* why it is not up */
    struct device_counts counts;
    struct midi_parser parser;
    void *own; /* the kind's */
    /* upcalls */
    void *owner;
    void (*received)(struct server_device *d, const struct midi_message *m);
    void (*read)(struct server_device *d);    /* after all messages of a read */
    void (*changed)(struct server_device *d); /* it came or went */
    void (*drained)(struct server_device *d); /* there is room again */
    /* out */
    struct midi_encoder encoder;
    uint8_t out[DEVICE_OUT_BYTES];
    size_t out_first, out_count;
    bool more_wanted,
        writing; /* writing: further down, what is written is heard, and may be answered */
    struct midi_notes sounding;
    struct server_timer retry;
};

/* `NAME=KIND:ARGUMENT`, or without the name. Owns: the caller destroys it. Errors: BAD_ARGUMENT, NO_MEMORY. */
enum midi_status device_create(const struct device_kind *const *kinds, const char *spec,
                               struct server_loop *loop, struct server_device **out);
/* Tries to open it, and again until it is there. Errors: what will never be. */
enum midi_status device_start(struct server_device *d);
/* Ends the notes that it plays, waits for that for a moment, and closes it. */
void device_destroy(struct server_device *d);

/* ---- for kinds ---- */

void device_input(struct server_device *d, uint64_t time_ns, const uint8_t *bytes,
                  size_t count);
void device_message(struct server_device *d,
                    const struct midi_message *m); /* one that is whole */
void device_read_end(struct server_device *d);
void device_write_out(struct server_device *d);
/* It is away; it is tried again soon. */
void device_down(struct server_device *d, const char *why);

/* ---- for the server ---- */

/* Whether a message of a program has room now. */
bool device_has_room(const struct server_device *d);
/* False: it is not up, or takes none. device_write_out() sends what was put. */
bool device_put(struct server_device *d, const struct midi_message *m);

#endif
