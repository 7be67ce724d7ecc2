/* aside.h - one piece of work in a thread of its own, while the caller goes on.
 *
 *     if (!aside_begin (&aside, search, &context))
 *         search (&context);                            there is no thread to be had
 *     ...
 *     if (aside_is_done (&aside))
 *         aside_end (&aside);                           what the work has written can be read
 *                                                       now
 *
 * The thread takes no signal. In a child after fork() it does not exist: the work is lost, and
 * stays undone. */
#ifndef LUTETIA_MACHINE_ASIDE_H
#define LUTETIA_MACHINE_ASIDE_H

#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <sys/types.h>

typedef void aside_work(void *context);

/* All zero: no work. */
struct aside {
    bool begun, joined;
    pid_t owner; /* the process that began it */
    pthread_t thread;
    atomic_bool done;
    aside_work *work;
    void *context;
};

/* False: the work has not begun. There must be no other. */
bool aside_begin(struct aside *a, aside_work *work, void *context);
/* Never waits. */
bool aside_is_done(const struct aside *a);
/* Whether it will never be done: this is a child. */
bool aside_is_lost(const struct aside *a);
/* Waits until the work is done, if there is any and it is not lost. */
void aside_end(struct aside *a);
/* The same, but the work is still there to be ended. */
void aside_wait(struct aside *a);

#endif
