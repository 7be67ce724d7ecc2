/* aside.c - see aside.h. */
#include "base/aside.h"

#include <signal.h>

#include "base/process.h"

static void *run(void *of)
{
    struct aside *a = of;
    a->work(a->context);
    atomic_store(&a->done, true);
    return NULL;
}

bool aside_begin(struct aside *a, aside_work *work, void *context)
{
    sigset_t all, before;
    a->work = work;
    a->context = context;
    a->owner = process_now();
    atomic_store(&a->done, false);
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    a->begun = pthread_create(&a->thread, NULL, run, a) == 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return a->begun;
}

bool aside_is_done(const struct aside *a)
{
    return a->begun && atomic_load(&a->done);
}

bool aside_is_lost(const struct aside *a)
{
    return a->begun && a->owner != process_now();
}

void aside_wait(struct aside *a)
{
    if (a->begun && !a->joined && !aside_is_lost(a))
        a->joined = pthread_join(a->thread, NULL) == 0;
}

void aside_end(struct aside *a)
{
    aside_wait(a);
    a->begun = a->joined = false;
}
