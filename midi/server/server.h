/* server.h - struct midi_server, shared by the server's files. */
#ifndef LUTETIA_MIDI_SERVER_INTERNAL_H
#define LUTETIA_MIDI_SERVER_INTERNAL_H

#include "device.h"
#include "server_awake.h"
#include "server_client.h"
#include "server_log.h"
#include "server_workers.h"

#include <midi_real_time.h>

enum { SERVER_CLIENTS_MAX = 64, SERVER_TOKEN_BYTES = 128 };

struct midi_server {
    struct server_loop loop;
    struct server_device *devices[MIDI_WIRE_DEVICES];
    int devices_count;
    struct server_client *owners[MIDI_WIRE_DEVICES]; /* the client with an open system
                                                      * exclusive on each device */
    uint64_t owned_ns[MIDI_WIRE_DEVICES];            /* since when */
    struct server_client *clients;
    int clients_count;
    uint32_t clients_seen, dropped;
    struct midi_histogram latency;
    struct server_timer thinned; /* for the next value that a filter holds back */
    struct server_timer second;  /* housekeeping */
    uint64_t began_ns, rates_ns;
    uint64_t in_before[MIDI_WIRE_DEVICES], out_before[MIDI_WIRE_DEVICES]; /* a second ago */
    double in_hz[MIDI_WIRE_DEVICES], out_hz[MIDI_WIRE_DEVICES];
    uint64_t messages; /* both ways, but for active sensing */
    struct server_awake awake;
    struct server_workers *workers; /* NULL: not asked for, or not allowed */
    char token[SERVER_TOKEN_BYTES], path[108];
    int tcp_port;
    struct server_log lines;
    char real_time[MIDI_REAL_TIME_TEXT], sleep[160],
        terminals[160]; /* for people: what was asked for, and what is allowed */
    /* sockets */
    struct server_watch unix_watch, tcp_watch, stop_watch;
    int lock;
};

#endif
