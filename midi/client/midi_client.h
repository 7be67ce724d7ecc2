/* midi_client.h - connects a program to instruments, through the server `lutetia midi serve`.
 *
 *     struct midi_client_def def = midi_client_def_default("my program");
 *     struct midi_client *client;
 *     struct midi_client_event event;
 *     if (midi_client_open(&def, &client) != MIDI_OK || midi_client_listen(client, "*", "drop=clock") != MIDI_OK)
 *         die(midi_error());
 *     while (midi_client_next(client, -1, &event) == MIDI_OK)
 *         if (event.kind == MIDI_CLIENT_MESSAGE && midi_message_strikes(&event.message))
 *             play(event.message.bytes[1], event.message.bytes[2]);
 *     midi_client_close(client);
 *
 *     cc prog.c $(pkg-config --cflags --libs lutetia-midi)
 *
 * When the connection is lost, the client generates messages that end the sounding notes, and
 * reports it (MIDI_CLIENT_GONE). It reconnects as soon as possible, listens to the same devices
 * again, and reports it (MIDI_CLIENT_BACK).
 *
 * Errors: functions that can fail return a status and leave one line in midi_error().
 *
 * Ownership: what is passed is copied. Threads: a client belongs to one at a time.
 */
#ifndef LUTETIA_MIDI_CLIENT_H
#define LUTETIA_MIDI_CLIENT_H

#include <midi_message.h>

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

struct midi_client;

struct midi_client_def {
    const char *name; /* the program's name in the server's status */
    /* NULL: the user's own server; a socket's path; or HOST:PORT, a TCP port of this machine */
    const char *address;
    const char *token; /* for TCP: the server's token */
    bool stays;        /* reconnects when the server goes away; otherwise that is NO_SERVER */
};
struct midi_client_def midi_client_def_default(const char *name); /* stays */

enum midi_client_kind {
    MIDI_CLIENT_NOTHING, /* the time is over */
    MIDI_CLIENT_MESSAGE,
    MIDI_CLIENT_DEVICE, /* device and text: a device exists, has come or gone: "NAME KIND
                         * in,out up" */
    MIDI_CLIENT_LOST,   /* this program was too slow: `lost` messages were dropped */
    MIDI_CLIENT_GONE,   /* the connection is lost; text says why */
    MIDI_CLIENT_BACK
};

struct midi_client_event {
    enum midi_client_kind kind;
    int device; /* its number */
    uint32_t lost;
    struct midi_message message;
    char text[160];
};

/* Connects, and checks that the other side is this user's (or root's). Errors: NO_SERVER,
 * REFUSED, NO_MEMORY. Owns: the caller closes *out. */
enum midi_status midi_client_open(const struct midi_client_def *def, struct midi_client **out);
void midi_client_close(struct midi_client *client); /* takes NULL */

/* Receive the device's messages ("*": of all devices) from now on, through these filters
 * (midi_filter.h). Errors: REFUSED, with the server's reason; NO_SERVER. */
enum midi_status midi_client_listen(struct midi_client *client, const char *device,
                                    const char *filters);
/* Sends any command of docs/midi.md; a reply that does not fit is cut. reply may be NULL.
 * Errors: as above. */
enum midi_status midi_client_command(struct midi_client *client, const char *command,
                                     char *reply, size_t room);
/* The number of a device; -1: there is no device of that name. */
int midi_client_device(const struct midi_client *client, const char *name);
/* The name of a device, valid until the next call of midi_client_next(); NULL: there is no
 * device of that number. */
const char *midi_client_device_name(const struct midi_client *client, int device);

/* Sends to a device; time_ns 0: now. Blocks while the device is slower than the caller, as
 * long as the server lives. Errors: BAD_ARGUMENT, NO_SERVER. */
enum midi_status midi_client_send(struct midi_client *client, int device,
                                  const struct midi_message *m);
/* Waits for the next event, for that long at most, -1: without limit. Errors: NO_SERVER, if
 * the client does not stay. */
enum midi_status midi_client_next(struct midi_client *client, int wait_ms,
                                  struct midi_client_event *event);
/* A descriptor that is readable when midi_client_next() has something to do; -1 while the
 * server is gone. It can change. */
int midi_client_descriptor(const struct midi_client *client);

#ifdef __cplusplus
}
#endif

#endif
