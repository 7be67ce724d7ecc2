/* device.h - the part that all kinds of devices have in common.
 *
 * Input bytes go through a parser; output messages go through an encoder and a ring of
 * bytes. A device that is away is reopened when it is back.
 */
#ifndef LUTETIA_MIDI_DEVICE_H
#define LUTETIA_MIDI_DEVICE_H

#include "server_loop.h"

#include <midi_encoder.h>
#include <midi_notes.h>
#include <midi_parser.h>

enum {
    DEVICE_NAME_BYTES = 64,
    DEVICE_ARGUMENT_BYTES = 400,
    DEVICE_OUT_BYTES = 32768, /* the ring's size: includes room for the ends of all notes */
    DEVICE_OUT_USUAL = 512 /* the limit for messages; further messages wait at their senders */
};

struct server_device;

struct device_kind {
    const char *name, *argument, *help;
    bool plays;   /* all devices of this kind can play; otherwise open() tells */
    bool hears;   /* all give some */
    int retry_ms; /* between attempts while it is away; 0: 100 */
    bool stays;   /* it exists only with the server: nobody else has played it */
    /* Tries to open the device. Errors: NO_DEVICE, IO_FAILED: will be tried again later.
     * BAD_ARGUMENT, BAD_FILE: permanent. */
    enum midi_status (*open)(struct server_device *d);
    void (*close)(struct server_device *d);  /* also called after a failed open() */
    void (*finish)(struct server_device *d); /* for good; may be NULL */
    /* Writes as many of the bytes as is possible now; if not all, device_write_out() must be
     * called later. */
    size_t (*write)(struct server_device *d, const uint8_t *bytes, size_t count);
    /* Whether what write() took has not all left yet, so that closing would lose it; may be
     * NULL. */
    bool (*busy)(const struct server_device *d);
    void (*more)(struct server_device *d,
                 bool wanted); /* call device_write_out() when the device can take bytes; may
                                * be NULL */
};

struct device_counts {
    uint64_t in, out, refused; /* refused: messages of programs while it was away */
    uint64_t lost;             /* messages that came, or went, and did not arrive */
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
    /* called after all messages of a read */
    void *owner;
    void (*received)(struct server_device *d, const struct midi_message *m);
    void (*read)(struct server_device *d);    /* after all messages of a read */
    void (*changed)(struct server_device *d); /* it came or went */
    void (*lost)(struct server_device *d, uint32_t in,
                 uint32_t out);               /* so many messages, and nobody knows which */
    void (*drained)(struct server_device *d); /* there is room again */
    /* out */
    struct midi_encoder encoder;
    uint8_t out[DEVICE_OUT_BYTES];
    size_t out_first, out_count;
    bool more_wanted, writing; /* within a write, whose messages may be heard and answered */
    struct midi_notes sounding, played; /* now, and ever since it was opened */
    bool ends_again; /* messages were lost: the ends of notes may be among them */
    struct server_timer retry;
};

/* Parses `NAME=KIND:ARGUMENT`, or without the name. Owns: the caller destroys the device.
 * Errors: BAD_ARGUMENT, NO_MEMORY. */
enum midi_status device_create(const struct device_kind *const *kinds, const char *spec,
                               struct server_loop *loop, struct server_device **out);
/* Tries to open the device until it succeeds. Errors: permanent ones. */
enum midi_status device_start(struct server_device *d);
/* Ends the notes that it plays, waits a moment for that, and closes it. */
void device_destroy(struct server_device *d);

/* ---- for kinds ---- */

void device_input(struct server_device *d, uint64_t time_ns, const uint8_t *bytes,
                  size_t count);
void device_message(struct server_device *d,
                    const struct midi_message *m); /* one that is whole */
void device_read_end(struct server_device *d);
void device_write_out(struct server_device *d);
/* So many messages are lost, and nobody knows which: that is told, what sounds because of those
 * that came ends, and soon the ends of the notes that were played are sent again. */
void device_lost(struct server_device *d, uint32_t in, uint32_t out);
/* Marks the device as away; it is tried again soon. */
void device_down(struct server_device *d, const char *why);

/* ---- for the server ---- */

/* Called twice a second: sends the ends of notes again, after a loss. */
void device_look(struct server_device *d);
/* Whether there is room for a message of a program. */
bool device_has_room(const struct server_device *d);
/* False: the device is not up, or cannot play. device_write_out() sends what was put. */
bool device_put(struct server_device *d, const struct midi_message *m);

#endif
