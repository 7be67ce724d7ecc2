/* server_support.h - runs a server in its own process, and an instrument on a pseudo-terminal.
 *
 *     struct instrument keys = instrument_plug("keys");
 *     struct served served = served_begin((const char *[]){"keys=serial:...", NULL}, false);
 *     ...
 *     served_end(&served); */
#ifndef LUTETIA_TESTS_MIDI_SERVER_SUPPORT_H
#define LUTETIA_TESTS_MIDI_SERVER_SUPPORT_H

#include <midi_client.h>

#include <sys/types.h>

struct served {
    pid_t process;
    char path[108];
};

/* Starts a server and waits until it listens. tcp_port 0: none. */
struct served served_begin(const char *const *devices, int tcp_port, const char *token);
/* Sends SIGTERM and waits; the exit status must be 0. */
void served_end(struct served *s);
void served_kill(struct served *s);                              /* SIGKILL */
void served_again(struct served *s, const char *const *devices); /* at the same path */

/* A device for the server: a link to a pseudo-terminal whose other end is `file`. */
struct instrument {
    int file;
    char link[200];
};
struct instrument instrument_plug(const char *name);
void instrument_unplug(struct instrument *i); /* the link is gone, too */
void instrument_again(struct instrument *i);  /* at the same link */
void instrument_send(const struct instrument *i, const void *bytes, size_t count);
/* Reads what the server sends to it, until there are `count` bytes or none came for wait_ms.
 * Returns how many. */
size_t instrument_hear(const struct instrument *i, uint8_t *bytes, size_t count, int wait_ms);

/* Connects a client; filters as in midi_client_listen(), NULL: it hears nothing. */
struct midi_client *client_of(const struct served *s, const char *name, const char *filters);
/* The next message within two seconds; fails the test if none comes. Skips other events. */
struct midi_message next_message(struct midi_client *c, int *device);
/* The next event of this kind within five seconds. */
struct midi_client_event next_event(struct midi_client *c, enum midi_client_kind kind);
/* Waits until the device is up. */
void wait_up(struct midi_client *c, const char *device);

/* The instrument as a device, `keys=serial:LINK@31250`; valid until the next call. */
const char *const *one_device(const struct instrument *i);
/* Reads the messages by which a new server silences all channels. */
void silence_skip(const struct instrument *i);
void check_text(const struct midi_message *m, const char *words);

#endif
