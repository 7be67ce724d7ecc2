/* process.h - which process this is: a child after fork() has none of the threads that its
 * parent had, neither ours nor the driver's. */
#ifndef LUTETIA_MACHINE_PROCESS_H
#define LUTETIA_MACHINE_PROCESS_H

#include <sys/types.h>

/* As getpid(), without asking the system each time. */
pid_t process_now(void);
/* In a child that was not made by fork(). */
void process_forked(void);

#endif
