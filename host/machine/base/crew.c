/* crew.c - see crew.h.
 *
 * A ticket says what is left to take: the number of the job above, and how many parts nobody has taken below. Whoever lowers it by
 * one has taken a part. The number of the job differs from job to job, so who still thinks of an old job cannot take a part of a
 * new one. What the job is stays as it is until all its parts are done, and is looked at only with a part in hand.
 *
 *     caller     writes the job | ticket = job 7, 4 left | takes parts ........... waits until none is undone
 *     thread     sleeps         | wakes                  | takes parts | looks for more | sleeps */
#include "base/crew.h"

#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <unistd.h>

enum { LOOKS = 4000 };   /* before a thread sleeps: some 20 us */
enum { PARTS_EACH = 8 }; /* for each thread, at most */

struct worker {
    struct crew *crew;
    pthread_t thread;
    int number;
};

struct crew {
    pthread_mutex_t lock;
    pthread_cond_t work;
    _Atomic uint64_t ticket; /* job << 32 | parts left to take */
    _Atomic int undone, sleeping;
    _Atomic bool ends;
    crew_part *function;
    void *context;
    int parts;
    int size, started; /* started: threads, without the caller */
    pid_t owner;
    struct worker workers[CREW_MOST];
};

static inline void rest(void)
{
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#endif
}

/* False: there was none. */
static bool part_take(struct crew *c, int worker)
{
    uint64_t ticket = atomic_load(&c->ticket);
    while ((uint32_t)ticket)
        if (atomic_compare_exchange_weak(&c->ticket, &ticket, ticket - 1)) {
            c->function(c->context, c->parts - (int)(uint32_t)ticket, worker);
            atomic_fetch_sub(&c->undone, 1);
            return true;
        }
    return false;
}

static bool is_wanted(const struct crew *c)
{
    return (uint32_t)atomic_load(&c->ticket) || atomic_load(&c->ends);
}

static void *work(void *of)
{
    struct worker *w = of;
    struct crew *c = w->crew;
    while (!atomic_load(&c->ends)) {
        if (part_take(c, w->number))
            continue;
        for (int i = 0; i < LOOKS && !is_wanted(c); i++)
            rest();
        if (is_wanted(c))
            continue;
        pthread_mutex_lock(&c->lock);
        atomic_fetch_add(&c->sleeping, 1);
        while (!is_wanted(c))
            pthread_cond_wait(&c->work, &c->lock);
        atomic_fetch_sub(&c->sleeping, 1);
        pthread_mutex_unlock(&c->lock);
    }
    return NULL;
}

struct crew *crew_create(int threads)
{
    struct crew *c = threads > 1 ? calloc(1, sizeof *c) : NULL;
    if (!c)
        return NULL;
    pthread_mutex_init(&c->lock, NULL);
    pthread_cond_init(&c->work, NULL);
    c->size = threads < CREW_MOST ? threads : CREW_MOST;
    c->owner = getpid();
    return c;
}

/* As many as the system allows. */
static void threads_start(struct crew *c)
{
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    while (c->started < c->size - 1) {
        struct worker *w = &c->workers[c->started];
        *w = (struct worker){.crew = c, .number = c->started + 1};
        if (pthread_create(&w->thread, NULL, work, w))
            break;
        c->started++;
    }
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    c->size = c->started + 1;
}

static void wake(struct crew *c)
{
    pthread_mutex_lock(&c->lock);
    pthread_cond_broadcast(&c->work);
    pthread_mutex_unlock(&c->lock);
}

void crew_run(struct crew *c, int parts, crew_part *function, void *context)
{
    if (!c || parts < 2 || c->owner != getpid()) {
        for (int i = 0; i < parts; i++)
            function(context, i, 0);
        return;
    }
    if (c->started < c->size - 1)
        threads_start(c);
    c->function = function;
    c->context = context;
    c->parts = parts;
    atomic_store(&c->undone, parts);
    uint64_t job = (atomic_load(&c->ticket) >> 32) + 1;
    atomic_store(&c->ticket, job << 32 | (uint32_t)parts);
    if (atomic_load(&c->sleeping))
        wake(c);
    while (part_take(c, 0))
        continue;
    for (int i = 0; atomic_load(&c->undone); i++)
        if (i < LOOKS)
            rest();
        else
            sched_yield();
}

int crew_parts(const struct crew *c, double work, double least, double part)
{
    if (!c || work < least)
        return 1;
    double parts = work / part, most = (double)(PARTS_EACH * c->size);
    return (int)(parts < most ? parts : most);
}

int crew_size(const struct crew *c)
{
    return c ? c->size : 1;
}

void crew_destroy(struct crew *c)
{
    if (!c)
        return;
    bool here = c->owner == getpid();
    atomic_store(&c->ends, true);
    if (here)
        wake(c);
    for (int i = 0; i < c->started && here; i++)
        pthread_join(c->workers[i].thread, NULL);
    if (here) {
        pthread_cond_destroy(&c->work);
        pthread_mutex_destroy(&c->lock);
    }
    free(c);
}
