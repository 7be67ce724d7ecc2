/* awake.c - see awake.h.
 *
 * A thread of the lowest priority can be stopped anywhere for long, so it holds no lock that
 * others wait for, allocates nothing, and nobody waits long for its end: who is last to let go
 * of the memory frees it. */
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
#ifdef __x86_64__
#include <cpuid.h>
#endif

#include "base/clock.h"
#include "base/process.h"
#include "latency.h"

enum { PROCESSORS_MOST = 16, RESTS = 64, LOOKS_NS = 20000000 };

/* How long the end of a thread is waited for. */
static const double END_S = 0.05;

struct keeper {
    struct awake *awake;
    size_t processor;
    pthread_t thread;
};

struct awake {
    int file;                 /* what the system is asked by; -1: threads look at the time */
    _Atomic bool held;        /* it has been asked that no processor halts */
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

bool awake_is_virtual(void)
{
    unsigned int of[4] = {0};
#ifdef __x86_64__
    if (!__get_cpuid(1, &of[0], &of[1], &of[2], &of[3]))
        return false;
#endif
    return of[2] >> 31;
}

struct awake *awake_create(const char *path, bool threads)
{
    cpu_set_t set;
    int count = sched_getaffinity(0, sizeof set, &set) ? 0 : CPU_COUNT(&set);
    if (count < 2 || count > PROCESSORS_MOST)
        return NULL;
    bool few =
        sysconf(_SC_NPROCESSORS_ONLN) <= PROCESSORS_MOST; /* the system's are asked, all */
    int file = path && few ? latency_open(path) : -1;
    struct awake *a = file >= 0 || threads ? calloc(1, sizeof *a) : NULL;
    if (!a) {
        if (file >= 0)
            close(file);
        return NULL;
    }
    a->file = file;
    a->owner = process_now();
    atomic_store(&a->users, 1);
    for (size_t i = 0; i < CPU_SETSIZE && (file < 0 || !a->count); i++)
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
    if (atomic_fetch_sub(&a->users, 1) != 1)
        return;
    if (a->file >= 0)
        close(a->file);
    free(a);
}

/* end: at most until then; NULL: for as long as it takes. */
static void futex(_Atomic uint32_t *word, int operation, uint32_t value,
                  const struct timespec *end)
{
    syscall(SYS_futex, word, operation | FUTEX_PRIVATE_FLAG, value, end, NULL, 0);
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
            futex(&a->wakes, FUTEX_WAIT, wakes, NULL);
        atomic_fetch_sub(&a->sleeping, 1);
    }
    let_go(a);
    return NULL;
}

/* Where it cannot be asked processors halt, as they would without it. */
static void ask(struct awake *a, bool held)
{
    atomic_store(&a->held, held);
    (void)latency_ask(a->file, held);
}

/* The only thread where the system is asked: takes the question back when the time is over. */
static void *take_back(void *of)
{
    const struct keeper *k = of;
    struct awake *a = k->awake;
    while (!atomic_load(&a->ends)) {
        const uint32_t wakes = atomic_load(&a->wakes);
        const int64_t left = atomic_load(&a->until_ns) - now_ns();
        const struct timespec t = {0, left < LOOKS_NS ? left
                                                      : LOOKS_NS}; /* the end may come sooner */
        if (left <= 0 && atomic_load(&a->held)) {
            ask(a, false);
            if (is_wanted(
                    a)) /* somebody has asked meanwhile, perhaps before it was taken back */
                ask(a, true);
        } else {
            futex(&a->wakes, FUTEX_WAIT, wakes, left > 0 ? &t : NULL);
        }
    }
    let_go(a);
    return NULL;
}

static void wake(struct awake *a)
{
    atomic_fetch_add(&a->wakes, 1);
    futex(&a->wakes, FUTEX_WAKE, INT_MAX, NULL);
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
        if (pthread_create(&k->thread, NULL, a->file < 0 ? keep : take_back, k)) {
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
    bool good = a->file < 0 ? !atomic_load(&a->sleeping) : atomic_load(&a->held);
    if ((a->started && good) || !a->count || a->owner != process_now())
        return;
    if (a->file >= 0)
        ask(a, true);
    if (a->started)
        wake(a);
    else
        threads_start(a);
    if (a->file >= 0 && !a->started) /* nobody would take it back */
        ask(a, false);
}

void awake_destroy(struct awake *a)
{
    struct timespec end;
    if (!a)
        return;
    if (a->owner != process_now()) { /* the threads are another process's */
        if (a->file >= 0)
            close(a->file);
        free(a);
        return;
    }
    atomic_store(&a->ends, true);
    wake(a);
    clock_gettime(CLOCK_REALTIME, &end);
    end.tv_nsec += (long)(END_S * 1e9);
    end.tv_sec += end.tv_nsec / 1000000000;
    end.tv_nsec %= 1000000000;
    if (a->file >= 0)
        ask(a, false);
    for (int i = 0; i < a->started; i++)
        if (pthread_timedjoin_np(a->keepers[i].thread, NULL, &end))
            pthread_detach(a->keepers[i].thread);
    let_go(a);
}
