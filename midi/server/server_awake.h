/* server_awake.h - keeps the processors awake while music is played.
 *
 * A processor with nothing to do is put to sleep, and takes up to some hundred microseconds to wake: longer than the server's whole
 * work. Linux's interface for programs that cannot wait so long is the file /dev/cpu_dma_latency (PM QoS): while a program keeps
 * it open, with a 0 written to it, no processor sleeps. That costs power, so the server does it from when messages come until
 * none has come for ten seconds. Root may open the file, and those whom a rule of udev's lets.
 */
#ifndef LUTETIA_MIDI_SERVER_AWAKE_H
#define LUTETIA_MIDI_SERVER_AWAKE_H

#include <stdbool.h>
#include <stdint.h>

#define AWAKE_PATH "/dev/cpu_dma_latency"
enum { AWAKE_MS = 10000 };

struct server_awake {
    const char *path; /* NULL: not wanted, or not allowed */
    int file;         /* -1: the processors may sleep */
    uint64_t messages, until_ns;
};

/* path: AWAKE_PATH, or NULL if it is not wanted. False: it is not allowed (errno). */
bool awake_begin(struct server_awake *a, const char *path);
/* To be called now and then; messages: how many there have been. */
void awake_look(struct server_awake *a, uint64_t messages, uint64_t now_ns);
void awake_end(struct server_awake *a);

#endif
