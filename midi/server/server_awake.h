/* server_awake.h - keeps the processors awake while music is played.
 *
 * To wake a processor takes up to some hundred microseconds: longer than the server's whole
 * work. So the server asks the system (latency.h) that none sleeps, from when messages come
 * until none has come for ten seconds.
 */
#ifndef LUTETIA_MIDI_SERVER_AWAKE_H
#define LUTETIA_MIDI_SERVER_AWAKE_H

#include <stdbool.h>
#include <stdint.h>

enum { AWAKE_MS = 10000 };

struct server_awake {
    const char *path; /* NULL: not wanted, or not allowed */
    int file;         /* -1: the processors may sleep */
    uint64_t messages, until_ns;
};

/* path: LATENCY_PATH, or NULL if it is not wanted. False: it is not allowed (errno). */
bool awake_begin(struct server_awake *a, const char *path);
/* To be called now and then; messages: how many there have been. */
void awake_look(struct server_awake *a, uint64_t messages, uint64_t now_ns);
void awake_end(struct server_awake *a);

#endif
