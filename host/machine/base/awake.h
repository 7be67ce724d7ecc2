/* awake.h - keeps processors from halting between two pieces of work.
 *
 * A thread that sleeps on a processor with nothing else to do is woken by letting the processor go on. In a virtual machine that takes
 * the host's time, too: up to a millisecond. Of two threads that share a kernel of 0.4 ms the other one then does all. So while there
 * is work, a thread for each processor looks at the time: of the lowest priority (SCHED_IDLE), which any other thread of any
 * program preempts at once.
 *
 *     struct awake *awake = awake_create ();
 *     awake_for (awake, 0.005);                 for 5 ms from now on
 *     awake_destroy (awake); */
#ifndef LUTETIA_MACHINE_AWAKE_H
#define LUTETIA_MACHINE_AWAKE_H

#include <stdbool.h>

struct awake;

/* Starts no thread yet. NULL: there is one processor, or there are more than sixteen; or no memory. */
struct awake *awake_create(void);
/* From one thread at a time; a child after fork() does nothing. NULL is fine. */
void awake_for(struct awake *a, double seconds);
void awake_destroy(struct awake *a);

#endif
