/* forks.h - machines when their process forks.
 *
 *     parent   fork() waits until the machines of its thread have nothing queued and nothing is
 *              being loaded
 *     child    its machines hold what they held; no kernel runs there, and plans are
 *              interpreted
 *
 * A machine of another thread may have been at work: then the child cannot use it, and is told
 * so. */
#ifndef LUTETIA_MACHINE_FORKS_H
#define LUTETIA_MACHINE_FORKS_H

struct machine;

/* A machine that has a device; one that is about to lose it. */
void forks_machine_made(struct machine *m);
void forks_machine_gone(struct machine *m);

#endif
