/* midi_server.h - a process that opens the instruments; any number of programs play them and
 * listen to them through it.
 *
 *     struct midi_server_def def = {.devices = specs, .devices_count = 2, .real_time = true, .awake = true};
 *     struct midi_server *server;
 *     if (midi_server_create(&def, &server) != MIDI_OK)
 *         die(midi_error());
 *     // until midi_server_stop(), from a signal handler or a thread
 *     midi_server_run(server);
 *     midi_server_destroy(server);
 *
 *     devices                  server                           programs
 *     keys   -> bytes -> parser -> filters, a chain each -> ring of frames -> socket
 *     synth  <- bytes <- ring <- encoder <- filters <- frames  <- socket
 *
 * One thread does everything and never blocks. A program that does not read only fills its own
 * ring. A program that sends more than a device takes is not read from until the device has
 * room; programs that wait for one device take turns. When a program, a device or the server
 * goes away, the notes that only it held are ended.
 *
 * docs/midi.md describes the protocol; client/midi_client.h is the other side.
 */
#ifndef LUTETIA_MIDI_SERVER_H
#define LUTETIA_MIDI_SERVER_H

#include <midi_status.h>

#include <stdbool.h>

struct midi_server_def {
    const char *path;           /* of the socket; NULL: the user's default */
    int tcp_port;               /* on 127.0.0.1, too; 0: none */
    const char *token;          /* the token of clients over TCP; required with a port */
    const char *const *devices; /* [NAME=]KIND[:ARGUMENT] each */
    int devices_count;
    bool real_time; /* SCHED_FIFO, if that is allowed */
    /* no processor sleeps while messages come, if that is allowed (server_awake.h) */
    bool awake;
    /* what carries serial lines' and terminals' bytes goes before other programs while messages
     * come, if that is allowed: it concerns the whole system (server_workers.h) */
    bool terminals_first;
    void (*log)(void *context, const char *line);
    void *context;
};

struct midi_server;

/* Listens, and opens devices; devices that are away are tried again as long as the server
 * runs. Errors: BAD_ARGUMENT (an invalid device), REFUSED (the socket is in use, or not
 * ours), IO_FAILED, NO_MEMORY. */
enum midi_status midi_server_create(const struct midi_server_def *def,
                                    struct midi_server **out);
void midi_server_destroy(struct midi_server *server); /* takes NULL */
void midi_server_run(struct midi_server *server);
void midi_server_stop(struct midi_server *server); /* callable from anywhere, also from
                                                    * signal handlers */
const char *midi_server_path(const struct midi_server *server);

/* One line for each kind of device: "serial:PATH[@SPEED]   a serial line, ...". i from 0; NULL ends them. */
const char *midi_server_kind(int i, const char **argument, const char **help);

#endif
