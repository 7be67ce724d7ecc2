/* confine.h - a process that reads untrusted bytes, and gives up all rights that reading does
 * not need.
 *
 *     pid_t parent = getpid(), child = fork();
 *     if (child == 0) {
 *         confine_descriptors((int[]){file, pipe}, 2);
 *         confine_resources(parent, 300, memory_bytes);
 *         ... open the one file that is to be read
 *         confine_calls();
 *         ... read it; send what was found through a pipe
 *     }
 *
 * A file that exploits a bug of the library which reads it can then only compute, within the
 * limits of time and memory, and write to the open descriptors.
 */
#ifndef LUTETIA_CONFINE_H
#define LUTETIA_CONFINE_H

#include <stdbool.h>
#include <sys/types.h>

/* The process ends with its parent (SIGKILL), leaves no core file, takes at most so many
 * seconds of a processor, and its memory grows by at most so many bytes from now on (0: any
 * number). Memory is not limited where the address sanitizer keeps terabytes of addresses for
 * itself. Called in a child, soon after fork(). */
void confine_resources(pid_t parent, unsigned cpu_seconds, unsigned long long memory_bytes);

/* Closes all that is open but the standard streams and these: what the parent has open is none
 * of a reader's business. Called in a child. */
void confine_descriptors(const int *kept, int count);

/* From now on the process can read and write what it has open, ask for memory, tell the time
 * and exit. Every other call of the system (open, socket, fork, exec, kill, ...) fails with
 * EPERM, for good: seccomp. False: the system has no seccomp; nothing has changed. */
bool confine_calls(void);

#endif
