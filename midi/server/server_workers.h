/* server_workers.h - terminals' bytes before other programs' work, while music is played.
 *
 * What comes from a serial line or a pseudo-terminal is carried to its reader by a worker of
 * Linux's ("kworker/u..."), which has the usual priority. Where other programs want all
 * processors, it waits for its turn like them, some milliseconds, whatever the reader's
 * priority. (A niceness of -20 halves that at most: who computes keeps its slice.) Root may
 * give such workers real-time priority; theirs is the least there is. They do other things for
 * the whole system, too. So this is for who asks for it, and lasts from when messages come
 * until none has come for ten seconds.
 *
 *     struct server_workers *w = workers_create("/proc", &why);
 *     workers_look(w, messages, now_ns);             // each second; returns at once
 *     workers_destroy(w);                            // all have the usual priority
 *
 * A thread of usual priority does it: looking for workers takes longer than a note may. */
#ifndef LUTETIA_MIDI_SERVER_WORKERS_H
#define LUTETIA_MIDI_SERVER_WORKERS_H

#include <stdbool.h>
#include <stdint.h>
#include <sys/types.h>

enum { WORKERS_PRIORITY = 1, WORKERS_MAX = 256 }; /* of SCHED_FIFO */

struct server_workers;

/* The workers that proc, a folder like /proc, tells of; their count, WORKERS_MAX at most.
 * -1: it does not tell (errno; ENOENT where it is not the whole system's). */
int workers_find(const char *proc, pid_t found[WORKERS_MAX]);

/* NULL: they are not known or may not be changed; *why says it in words. */
struct server_workers *workers_create(const char *proc, const char **why);
/* messages: how many there have been. Takes NULL. */
void workers_look(struct server_workers *workers, uint64_t messages, uint64_t now_ns);
/* Messages have come lately. Takes NULL. */
bool workers_first(const struct server_workers *workers);
void workers_destroy(struct server_workers *workers); /* takes NULL */

#endif
