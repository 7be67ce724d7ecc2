/* midi_server.h - one process that has the instruments, and any number of programs that play and hear them through it.
 *
 *     struct midi_server_def def = {.devices = specs, .devices_count = 2, .real_time = true};
 *     struct midi_server *server;
 *     if (midi_server_create(&def, &server) != MIDI_OK)
 *         die(midi_error());
 *     midi_server_run(server);          // until midi_server_stop(), from a signal handler or a thread
 *     midi_server_destroy(server);
 *
 *     devices                  server                           programs
 *     keys   -> bytes -> parser -> filters, a chain each -> ring of frames -> socket
 *     synth  <- bytes <- ring <- encoder <- filters <- frames  <- socket
 *
 * One thread does it all and waits for nobody: a program that does not read has its ring, and nothing else, full; one that sends
 * more than a device takes is not read from until the device has room, and those that wait for one device take turns.
 * Whoever goes, program, device or server: the notes that only he held are ended.
 *
 * docs/midi.md describes the protocol; client/midi_client.h is the other side. */
#ifndef LUTETIA_MIDI_SERVER_H
#define LUTETIA_MIDI_SERVER_H

#include <midi_status.h>

#include <stdbool.h>

struct midi_server_def {
    const char *path;           /* of the socket; NULL: the user's usual one */
    int tcp_port;               /* of 127.0.0.1, too; 0: none */
    const char *token;          /* what clients over TCP must say; needed with a port */
    const char *const *devices; /* [NAME=]KIND[:ARGUMENT] each */
    int devices_count;
    bool real_time; /* SCHED_FIFO, where that is allowed */
    void (*log)(void *context, const char *line);
    void *context;
};

struct midi_server;

/* Listens, and opens devices; those that are away are tried again as long as the server runs.
 * Errors: BAD_ARGUMENT (a device that cannot be), REFUSED (the socket is busy, or not ours), IO_FAILED, NO_MEMORY. */
enum midi_status midi_server_create(const struct midi_server_def *def,
                                    struct midi_server **out);
void midi_server_destroy(struct midi_server *server); /* takes NULL */
void midi_server_run(struct midi_server *server);
void midi_server_stop(struct midi_server *server); /* from anywhere, signal handlers as well */
const char *midi_server_path(const struct midi_server *server);

/* One line for each kind of device: "serial:PATH[@SPEED]   a serial line, ...". i from 0; NULL ends them. */
const char *midi_server_kind(int i, const char **argument, const char **help);

#endif
