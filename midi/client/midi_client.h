/* midi_client.h - a program's way to instruments: through the server, `lutetia midi serve`.
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
 * Where the server goes away the notes that sound are ended by messages of their own, and the client says so
 * (MIDI_CLIENT_GONE), tries again until it is back, listens to what it listened to before, and says so (MIDI_CLIENT_BACK).
 *
 * Threads: a client belongs to one at a time. */
#ifndef LUTETIA_MIDI_CLIENT_H
#define LUTETIA_MIDI_CLIENT_H

#include <midi_message.h>

#include <stddef.h>

struct midi_client;

struct midi_client_def {
    const char *name; /* what the server's status calls it */
    const char *
        address; /* NULL: the user's own server; a socket's path; or HOST:PORT, a TCP port of this machine */
    const char *token; /* for TCP: what the server wants to hear */
    bool stays;        /* tries again where the server goes away; else that is NO_SERVER */
};
struct midi_client_def midi_client_def_default(const char *name); /* stays */

enum midi_client_kind {
    MIDI_CLIENT_NOTHING, /* the time is over */
    MIDI_CLIENT_MESSAGE,
    MIDI_CLIENT_DEVICE, /* device and text: one is there, has come or gone: "NAME KIND in,out up" */
    MIDI_CLIENT_LOST, /* this program was too slow: `lost` messages were left out */
    MIDI_CLIENT_GONE, /* the server is; text says why */
    MIDI_CLIENT_BACK
};

struct midi_client_event {
    enum midi_client_kind kind;
    int device; /* its number */
    uint32_t lost;
    struct midi_message message;
    char text[160];
};

/* Connects, and checks that the other side is this user's (or root's). Errors: NO_SERVER, REFUSED, NO_MEMORY. */
enum midi_status midi_client_open(const struct midi_client_def *def, struct midi_client **out);
void midi_client_close(struct midi_client *client); /* takes NULL */

/* From now on messages of the device ("*": of all) arrive, through these filters (midi_filter.h).
 * Errors: REFUSED, with the server's reason; NO_SERVER. */
enum midi_status midi_client_listen(struct midi_client *client, const char *device,
                                    const char *filters);
/* Any command of docs/midi.md; the reply is cut where it does not fit. reply may be NULL. Errors: as above. */
enum midi_status midi_client_command(struct midi_client *client, const char *command,
                                     char *reply, size_t room);
/* The number of a device; -1: there is none of that name. */
int midi_client_device(const struct midi_client *client, const char *name);
/* NULL: none has that number. */
const char *midi_client_device_name(const struct midi_client *client, int device);

/* To a device; time_ns 0: now. Waits where the device is slower than the caller, so long as the server lives.
 * Errors: BAD_ARGUMENT, NO_SERVER. */
enum midi_status midi_client_send(struct midi_client *client, int device,
                                  const struct midi_message *m);
/* The next event; waits so long at most, -1: for ever. Errors: NO_SERVER, where the client does not stay. */
enum midi_status midi_client_next(struct midi_client *client, int wait_ms,
                                  struct midi_client_event *event);
/* Readable when midi_client_next() has something to do; -1 while the server is gone. It may change. */
int midi_client_descriptor(const struct midi_client *client);

#endif
