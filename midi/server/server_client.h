/* server_client.h - a program at the other end of a socket: frames in, frames out, and what
 * happens if it does not read.
 *
 * Outgoing frames wait in a ring. When it is three quarters full, dispensable messages are
 * dropped (clocks, active sensing, values that later ones replace); when it is full, all
 * are. As soon as the client reads again, it is told how many messages it has lost, and the
 * notes that it believes to sound are ended. A client that reads nothing for ten seconds is
 * disconnected.
 */
#ifndef LUTETIA_MIDI_SERVER_CLIENT_H
#define LUTETIA_MIDI_SERVER_CLIENT_H

#include "server_loop.h"

#include <midi_filter.h>
#include <midi_notes.h>
#include <midi_proof.h>
#include <midi_time.h>
#include <midi_wire.h>

enum {
    CLIENT_NAME_BYTES = 64,
    CLIENT_OUT_BYTES = 1 << 17,
    CLIENT_IN_BYTES = MIDI_WIRE_HEAD + MIDI_WIRE_TEXT_MAX,
    CLIENT_GREET_MS = 5000,
    CLIENT_STALL_MS = 10000
};

enum client_verdict {
    CLIENT_GOES_ON,
    CLIENT_WAITS, /* the frame cannot be handled now; client_wake() is called when it can */
    CLIENT_ENDS
};

struct server_client {
    struct server_client *next;
    struct server_watch watch;
    struct server_loop *loop;
    uint32_t number;
    bool tcp, greeted, dead;
    /* over TCP: it has said hello, and was asked to show that it knows the token */
    bool challenged;
    struct midi_proof proof;
    char name[CLIENT_NAME_BYTES];
    uint64_t came_ns,
        progress_ns; /* progress: when it last read something, or had nothing to read */
    uint8_t in[CLIENT_IN_BYTES];
    size_t in_count;
    int waits_for; /* the device; -1: none */
    uint64_t waits_since_ns;
    uint32_t watched; /* for what */
    uint8_t out[CLIENT_OUT_BYTES];
    size_t out_first, out_count;
    /* of each device */
    struct midi_chain *hears[MIDI_WIRE_DEVICES]; /* NULL: it does not listen to the device */
    struct midi_chain *sends[MIDI_WIRE_DEVICES]; /* NULL: unfiltered */
    struct midi_notes heard[MIDI_WIRE_DEVICES], played[MIDI_WIRE_DEVICES];
    uint32_t cut; /* a bit for each device: the rest of a system exclusive is dropped */
    /* what it was given */
    uint32_t messages; /* numbered so */
    uint64_t sent, received, thinned, lost;
    uint32_t lost_untold;
    uint32_t batch;    /* messages put and not yet flushed */
    uint64_t batch_ns; /* and the time of the oldest */
    struct midi_histogram *latency;
    /* upcalls */
    void *owner;
    enum client_verdict (*frame)(struct server_client *c, const struct midi_wire_frame *f);
    void (*ended)(struct server_client *c); /* the client is dead; destroy it later */
};

/* Takes the descriptor over. NULL: no memory; the descriptor is closed. */
struct server_client *client_create(struct server_loop *loop, int file, bool tcp);
void client_destroy(struct server_client *c);
/* Watches its socket from now on. */
bool client_begin(struct server_client *c);

/* False: there was no room, or the client is dead. */
bool client_put(struct server_client *c, const struct midi_wire_frame *f);
bool client_put_text(struct server_client *c, uint8_t kind, int device, uint32_t number,
                     const char *text);
/* Puts a message of a device, as the client receives it. */
void client_put_message(struct server_client *c, int device, const struct midi_message *m);
/* Ends the notes of that device that the client believes to sound. */
void client_release(struct server_client *c, int device);
/* So many messages to it are lost: it is told, and the notes that it believes to sound are
 * ended. */
void client_lose(struct server_client *c, uint32_t count);
/* Writes what it takes. */
void client_flush(struct server_client *c);
/* Handles the frame that had to wait. */
void client_wake(struct server_client *c);
/* Sends the reason, if possible, and disconnects. */
void client_end(struct server_client *c, const char *why);
/* Called regularly: disconnects a client that does not read. */
void client_look(struct server_client *c, uint64_t now_ns);

#endif
