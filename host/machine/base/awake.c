/* awake.c - see awake.h.
 *
 * A thread of the lowest priority can be stopped anywhere for long, so it holds no lock that others wait for, allocates nothing, and
 * nobody waits long for its end: who is last to let go of the memory frees it. */
#include "base/awake.h"

#include <limits.h>
#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <linux/futex.h>

#include "base/clock.h"

enum { PROCESSORS_MOST = 16, RESTS = 64 };

/* How long the end of a thread is waited for. */
static const double END_S = 0.05;

struct keeper {
    struct awake *awake;
    size_t processor;
    pthread_t thread;
};

struct awake {
    _Atomic int64_t until_ns; /* by clock_s() */
    _Atomic uint32_t wakes;   /* threads sleep while it stays the same */
    _Atomic int sleeping, users;
    _Atomic bool ends;
    int count, started;
    struct keeper keepers[PROCESSORS_MOST];
    pid_t owner;
};

static int64_t now_ns(void)
{
    return (int64_t)(clock_s() * 1e9);
}

struct awake *awake_create(void)
{
    cpu_set_t set;
    int count = sched_getaffinity(0, sizeof set, &set) ? 0 : CPU_COUNT(&set);
    if (count < 2 || count > PROCESSORS_MOST)
        return NULL;
    struct awake *a = calloc(1, sizeof *a);
    if (!a)
        return NULL;
    a->owner = getpid();
    atomic_store(&a->users, 1);
    for (size_t i = 0; i < CPU_SETSIZE; i++)
        if (CPU_ISSET(i, &set))
            a->keepers[a->count++] = (struct keeper){.awake = a, .processor = i};
    return a;
}

/* ---- threads ---- */

/* False: the system does not allow it, and the thread would be in the way. */
static bool be_last_on(size_t processor)
{
    cpu_set_t set;
    struct sched_param none = {0};
    CPU_ZERO(&set);
    CPU_SET(processor, &set);
    return !sched_setaffinity(0, sizeof set, &set) && !sched_setscheduler(0, SCHED_IDLE, &none);
}

static void rest(void)
{
    for (int i = 0; i < RESTS; i++) {
#if defined(__x86_64__) || defined(__i386__)
        __builtin_ia32_pause();
#endif
    }
}

static void let_go(struct awake *a)
{
    if (atomic_fetch_sub(&a->users, 1) == 1)
        free(a);
}

static void futex(_Atomic uint32_t *word, int operation, uint32_t value)
{
    syscall(SYS_futex, word, operation | FUTEX_PRIVATE_FLAG, value, NULL, NULL, 0);
}

static bool is_wanted(const struct awake *a)
{
    return atomic_load(&a->ends) || now_ns() < atomic_load(&a->until_ns);
}

static void *keep(void *of)
{
    const struct keeper *k = of;
    struct awake *a = k->awake;
    bool last = be_last_on(k->processor);
    while (last && !atomic_load(&a->ends)) {
        const uint32_t wakes = atomic_load(&a->wakes);
        if (is_wanted(a)) {
            rest();
            continue;
        }
        atomic_fetch_add(&a->sleeping, 1);
        if (!is_wanted(a)) /* whoever wants it from here on sees that somebody sleeps */
            futex(&a->wakes, FUTEX_WAIT, wakes);
        atomic_fetch_sub(&a->sleeping, 1);
    }
    let_go(a);
    return NULL;
}

static void wake(struct awake *a)
{
    atomic_fetch_add(&a->wakes, 1);
    futex(&a->wakes, FUTEX_WAKE, INT_MAX);
}

/* As many as the system allows. */
static void threads_start(struct awake *a)
{
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    for (; a->started < a->count; a->started++) {
        struct keeper *k = &a->keepers[a->started];
        atomic_fetch_add(&a->users, 1);
        if (pthread_create(&k->thread, NULL, keep, k)) {
            atomic_fetch_sub(&a->users, 1);
            break;
        }
    }
    a->count = a->started;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
}

void awake_for(struct awake *a, double seconds)
{
    if (!a)
        return;
    atomic_store(&a->until_ns, now_ns() + (int64_t)(seconds * 1e9));
    if ((a->started && !atomic_load(&a->sleeping)) || a->owner != getpid())
        return;
    if (!a->started && a->count)
        threads_start(a);
    else
        wake(a);
}

void awake_destroy(struct awake *a)
{
    struct timespec end;
    if (!a)
        return;
    if (a->owner != getpid()) { /* the threads are another process's */
        free(a);
        return;
    }
    atomic_store(&a->ends, true);
    wake(a);
    clock_gettime(CLOCK_REALTIME, &end);
    end.tv_nsec += (long)(END_S * 1e9);
    end.tv_sec += end.tv_nsec / 1000000000;
    end.tv_nsec %= 1000000000;
    for (int i = 0; i < a->started; i++)
        if (pthread_timedjoin_np(a->keepers[i].thread, NULL, &end))
            pthread_detach(a->keepers[i].thread);
    let_go(a);
}
