/* crew.c - see crew.h.
 *
 * A ticket says what is left to take: the number of the job above, and below it the first part
 * that nobody has taken and the end of these. The caller takes the first, the threads the last:
 * so much of what one of two has written it finds in its own cache the next time. Whoever
 * changes the ticket has taken a part. The number of the job differs from job to job, so who
 * still thinks of an old job cannot take a part of a new one. What the job is stays as it is
 * until all its parts are done, and is looked at only with a part in hand.
 *
 * In a virtual machine the host may run two processors far apart, and move them from second to
 * second: what one processor has written is then four times as long on its way to the other. So
 * now and then, after a job, the caller sends a ping, and a thread that looks for work answers
 * it. While the round trip takes long, short work is not shared out; after a while the caller
 * tries again.
 *
 * Errands are in a row of few places, behind the lock; a thread that finds no part takes the
 * first.
 *
 *     caller     writes the job | ticket = job 7, 0 to 4 | takes 0, 1 .............. waits until none is undone
 *     thread     sleeps         | wakes                  | takes 3, 2 | looks for more | sleeps */
#include "base/crew.h"

#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "base/process.h"

enum { RESTS = 16 };          /* from one look at the clock to the next */
enum { PARTS_EACH = 8 };      /* for each thread, at most */
enum { PARTS_MOST = 0xffff }; /* of a job that is shared out */
enum {
    ALONE_LEAST = 256,
    ALONE_MOST = 1 << 13
}; /* pieces of short work that follow a late part */

static const double LOOKS_S = 50e-6; /* how long before a thread sleeps */
/* A part is late when the caller waits longer than this, and longer than half of what it did
 * itself. */
static const double LATE_S = 30e-6;

/* A batch is so many pings, and the least time of a batch counts. A thread that looks for work
 * answers within so many looks of the caller. */
enum { BATCHES = 3, PINGS = 4, ANSWER_LOOKS = 200 };
static const double BETWEEN_PINGS_S = 5e-3, APART_S = 20e-3;

/* Of a meeting: parts take so long, and there are so many tries. */
enum { MEETINGS = 5 };
static const double WAIT_S = 10e-6;

enum { ERRANDS_MOST = 8 };

struct errand {
    crew_errand_work *work;
    void *context;
};

struct worker {
    struct crew *crew;
    pthread_t thread;
    int number;
};

struct crew {
    pthread_mutex_t lock;
    pthread_cond_t work;
    _Atomic uint64_t ticket; /* job << 32 | first << 16 | end, of the parts left to take */
    _Atomic int undone, sleeping;
    _Atomic int errands_count;
    struct errand errands[ERRANDS_MOST]; /* behind the lock */
    _Atomic bool ends;
    _Alignas(64) _Atomic uint32_t ping; /* odd: nobody has answered it yet */
    _Alignas(64) double pinged_s;       /* when the caller sent the last batch */
    double trip_ns;
    crew_part *function;
    void *context;
    int size, started; /* started: threads, without the caller */
    int alone;         /* pieces of short work that the caller still does alone */
    int alone_next;    /* ... after the next late part */
    pid_t owner;
    struct worker workers[CREW_MOST];
};

static inline void rest(void)
{
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#endif
}

static uint32_t first_of(uint64_t ticket)
{
    return (uint32_t)ticket >> 16;
}

static uint32_t end_of(uint64_t ticket)
{
    return (uint32_t)ticket & 0xffff;
}

static bool has_parts(uint64_t ticket)
{
    return first_of(ticket) < end_of(ticket);
}

/* False: there was none. */
static bool part_take(struct crew *c, int worker)
{
    const uint64_t first_taken = UINT64_C(1) << 16;
    uint64_t ticket = atomic_load(&c->ticket);
    while (has_parts(ticket))
        if (atomic_compare_exchange_weak(&c->ticket, &ticket,
                                         worker ? ticket - 1 : ticket + first_taken)) {
            c->function(c->context, (int)(worker ? end_of(ticket) - 1 : first_of(ticket)),
                        worker);
            atomic_fetch_sub(&c->undone, 1);
            return true;
        }
    return false;
}

/* False: there was none. */
static bool errand_take(struct crew *c, bool wanted)
{
    struct errand e = {0};
    if (!atomic_load(&c->errands_count))
        return false;
    pthread_mutex_lock(&c->lock);
    const int count = atomic_load(&c->errands_count);
    if (count) {
        e = c->errands[0];
        for (int i = 1; i < count; i++)
            c->errands[i - 1] = c->errands[i];
        atomic_store(&c->errands_count, count - 1);
    }
    pthread_mutex_unlock(&c->lock);
    if (e.work)
        e.work(e.context, wanted);
    return e.work;
}

/* For any thread; the first one's answer counts. */
static void ping_answer(struct crew *c)
{
    uint32_t ping = atomic_load(&c->ping);
    if (ping & 1)
        atomic_compare_exchange_strong(&c->ping, &ping, ping + 1);
}

/* False: no thread looks for work just now. */
static bool ping_send(struct crew *c)
{
    uint32_t ping = atomic_load(&c->ping) + 1;
    atomic_store(&c->ping, ping);
    for (int i = 0; i < ANSWER_LOOKS; i++) {
        if (atomic_load(&c->ping) != ping)
            return true;
        rest();
    }
    return !atomic_compare_exchange_strong(&c->ping, &ping, ping + 1);
}

static void trip_measure(struct crew *c, double now)
{
    double least = 1;
    c->pinged_s = now;
    for (int batch = 0; batch < BATCHES; batch++) {
        const double start = clock_s();
        for (int i = 0; i < PINGS; i++)
            if (!ping_send(c))
                return;
        const double trip = (clock_s() - start) / PINGS;
        least = trip < least ? trip : least;
    }
    c->trip_ns = 1e9 * least;
}

static bool is_wanted(const struct crew *c)
{
    return atomic_load(&c->errands_count) || has_parts(atomic_load(&c->ticket)) ||
           atomic_load(&c->ends);
}

static bool is_done(const struct crew *c)
{
    return !atomic_load(&c->undone);
}

/* Looks for so long whether it is so. */
static bool look(struct crew *c, bool (*is_so)(const struct crew *c))
{
    const double start = clock_s();
    do
        for (int i = 0; i < RESTS; i++) {
            if (is_so(c))
                return true;
            ping_answer(c);
            rest();
        }
    while (clock_s() - start < LOOKS_S);
    return false;
}

static void *work(void *of)
{
    struct worker *w = of;
    struct crew *c = w->crew;
    while (!atomic_load(&c->ends)) {
        if (part_take(c, w->number) || errand_take(c, true) || look(c, is_wanted))
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
    struct crew *c = threads > 1 ? aligned_alloc(_Alignof(struct crew), sizeof *c) : NULL;
    if (!c)
        return NULL;
    memset(c, 0, sizeof *c);
    pthread_mutex_init(&c->lock, NULL);
    pthread_cond_init(&c->work, NULL);
    c->size = threads < CREW_MOST ? threads : CREW_MOST;
    c->owner = process_now();
    c->alone_next = ALONE_LEAST;
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

/* The longer one was late again and again, the longer short work is not shared out. */
static void was_late(struct crew *c, bool late)
{
    if (late) {
        c->alone = c->alone_next;
        c->alone_next = c->alone_next < ALONE_MOST ? 2 * c->alone_next : ALONE_MOST;
    } else if (c->alone_next > ALONE_LEAST) {
        c->alone_next--;
    }
}

void crew_run(struct crew *c, int parts, crew_part *function, void *context)
{
    if (!c || parts < 2 || parts > PARTS_MOST || c->owner != process_now()) {
        for (int i = 0; i < parts; i++)
            function(context, i, 0);
        return;
    }
    if (c->started < c->size - 1)
        threads_start(c);
    c->function = function;
    c->context = context;
    atomic_store(&c->undone, parts);
    uint64_t job = (atomic_load(&c->ticket) >> 32) + 1;
    atomic_store(&c->ticket, job << 32 | (uint32_t)parts);
    if (atomic_load(&c->sleeping))
        wake(c);
    const double start = clock_s();
    while (part_take(c, 0))
        continue;
    const double done = clock_s();
    while (!look(c, is_done))
        sched_yield();
    const double end = clock_s();
    was_late(c, end - done > LATE_S + (done - start) / 2);
    if (end - c->pinged_s > BETWEEN_PINGS_S && !atomic_load(&c->sleeping))
        trip_measure(c, end);
}

/* Long enough for a thread to come, if it comes at all. */
static void part_wait(void *context, int part, int worker)
{
    const double end = clock_s() + WAIT_S;
    (void)context;
    (void)part;
    (void)worker;
    while (clock_s() < end)
        rest();
}

void crew_meet(struct crew *c)
{
    for (int i = 0; c && i < MEETINGS && c->trip_ns == 0; i++)
        crew_run(c, 2 * c->size, part_wait, NULL);
}

bool crew_errand(struct crew *c, crew_errand_work *function, void *context)
{
    if (!c || c->owner != process_now())
        return false;
    if (c->started < c->size - 1)
        threads_start(c);
    pthread_mutex_lock(&c->lock);
    const int count = atomic_load(&c->errands_count);
    const bool taken = c->started && count < ERRANDS_MOST;
    if (taken) {
        c->errands[count] = (struct errand){function, context};
        atomic_store(&c->errands_count, count + 1);
        pthread_cond_signal(&c->work);
    }
    pthread_mutex_unlock(&c->lock);
    return taken;
}

int crew_parts(struct crew *c, double work, const struct crew_costs *costs)
{
    if (!c || work < costs->awake)
        return 1;
    if (work < costs->late && c->alone > 0) {
        c->alone--;
        return 1;
    }
    if (work < costs->asleep && (c->started < c->size - 1 || atomic_load(&c->sleeping)))
        return 1;
    if (c->trip_ns > costs->trip && work < costs->apart * 2 / c->size &&
        clock_s() - c->pinged_s < APART_S)
        return 1;
    double parts = work / costs->part, most = (double)(PARTS_EACH * c->size);
    return (int)(parts < most ? parts : most);
}

double crew_trip(const struct crew *c)
{
    return c ? c->trip_ns : 0;
}

int crew_size(const struct crew *c)
{
    return c ? c->size : 1;
}

void crew_destroy(struct crew *c)
{
    if (!c)
        return;
    bool here = c->owner == process_now();
    atomic_store(&c->ends, true);
    if (here)
        wake(c);
    for (int i = 0; i < c->started && here; i++)
        pthread_join(c->workers[i].thread, NULL);
    while (here && errand_take(c, false))
        continue;
    if (here) {
        pthread_cond_destroy(&c->work);
        pthread_mutex_destroy(&c->lock);
    }
    free(c);
}
