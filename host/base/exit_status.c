/* exit_status.c - see exit_status.h. glibc's on_exit() tells a handler the status, and its
 * exit(), called again by a handler, goes on with the handlers that are left, and with the new
 * status. */
#include "exit_status.h"

#include <stdatomic.h>
#include <stdint.h>
#include <stdlib.h>
#include <unistd.h>

static void end(int status, void *process)
{
    if (status == EXIT_SUCCESS && (pid_t)(intptr_t)process == getpid())
        exit(EXIT_FAILURE);
}

void exit_status_fail(void)
{
    static atomic_int failed;
    const int self = (int)getpid();
    if (atomic_exchange(&failed, self) != self)
        on_exit(end, (void *)(intptr_t)self);
}
