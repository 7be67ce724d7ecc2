/* server_support.h - a server as a process of its own, and an instrument on a pseudo-terminal.
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

/* Waits until it listens. tcp_port 0: none. */
struct served served_begin(const char *const *devices, int tcp_port, const char *token);
/* SIGTERM, and waits; the exit status must be 0. */
void served_end(struct served *s);
void served_kill(struct served *s);                              /* SIGKILL */
void served_again(struct served *s, const char *const *devices); /* at the same path */

/* A device as the server sees it: a link to a pseudo-terminal whose other end is `file`. */
struct instrument {
    int file;
    char link[200];
};
struct instrument instrument_plug(const char *name);
void instrument_unplug(struct instrument *i); /* the link is gone, too */
void instrument_again(struct instrument *i);  /* at the same link */
void instrument_send(const struct instrument *i, const void *bytes, size_t count);
/* What it is sent until `count` bytes are there or so long nothing came; how many. */
size_t instrument_hear(const struct instrument *i, uint8_t *bytes, size_t count, int wait_ms);

/* A client of the server, that hears all if it is to. */
struct midi_client *client_of(const struct served *s, const char *name, const char *filters);
/* The next message within two seconds; fails the test if none comes. Other events are passed over. */
struct midi_message next_message(struct midi_client *c, int *device);
/* The next event of that kind within five seconds. */
struct midi_client_event next_event(struct midi_client *c, enum midi_client_kind kind);
/* Waits until the device is up. */
void wait_up(struct midi_client *c, const char *device);

/* `keys=serial:LINK@31250`, of the instrument; valid until the next call. */
const char *const *one_device(const struct instrument *i);
/* Reads what the server sends to silence whoever was played before it came. */
void silence_skip(const struct instrument *i);
void check_text(const struct midi_message *m, const char *words);

#endif
