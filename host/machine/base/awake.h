/* awake.h - keeps processors from halting between two pieces of work.
 *
 * A thread that sleeps on a processor with nothing else to do is woken by letting the processor
 * go on. In a virtual machine that takes the host's time, too: up to a millisecond. Of two
 * threads that share a kernel of 0.4 ms the other one then does all. There are two remedies
 * while there is work. The better one asks the system (latency.h). Where it is not allowed, a
 * thread for each processor can look at the time: of the lowest priority (SCHED_IDLE), which
 * any other thread of any program preempts at once.
 *
 *     struct awake *awake = awake_create (LATENCY_PATH, false);
 *     awake_for (awake, 0.005);                 for 5 ms from now on
 *     awake_destroy (awake); */
#ifndef LUTETIA_MACHINE_AWAKE_H
#define LUTETIA_MACHINE_AWAKE_H

#include <stdbool.h>

struct awake;

/* Whether this computer is another one's program: only there it takes long to wake a
 * processor. */
bool awake_is_virtual(void);
/* Asks nothing and starts no thread yet. path: LATENCY_PATH, or NULL if the system is not to be
 * asked; threads: by threads where it cannot be. NULL: neither can be, there is one processor,
 * or there are more than sixteen; or no memory. */
struct awake *awake_create(const char *path, bool threads);
/* From one thread at a time; a child after fork() does nothing. NULL is fine. */
void awake_for(struct awake *a, double seconds);
void awake_destroy(struct awake *a);

#endif
