/* studio_messages.c - see studio_messages.h. */
#include "studio_messages.h"

#include <array.h>

#include <math.h>
#include <stdlib.h>
#include <time.h>

void studio_message_free(struct studio_message *message)
{
    free(message->text);
    free(message->font);
    free(message->features);
    free(message->config);
    paper_screen_destroy(&message->screen);
    *message = (struct studio_message){0};
}

void studio_messages_begin(struct studio_messages *m)
{
    atomic_init(&m->put, 0);
    atomic_init(&m->taken, 0);
    sem_init(&m->come, 0, 0);
    m->waiting = NULL;
    m->waiting_first = m->waiting_count = m->waiting_capacity = 0;
    m->numbered = 0;
}

void studio_messages_finish(struct studio_messages *m)
{
    struct studio_message message;
    while (studio_messages_take(m, &message))
        studio_message_free(&message);
    for (int i = m->waiting_first; i < m->waiting_count; i++)
        studio_message_free(&m->waiting[i]);
    free(m->waiting);
    m->waiting = NULL;
    sem_destroy(&m->come);
}

/* False: the ring is full. */
static bool ring_put(struct studio_messages *m, const struct studio_message *message)
{
    const unsigned long put = atomic_load_explicit(&m->put, memory_order_relaxed);
    if (put - atomic_load_explicit(&m->taken, memory_order_acquire) == STUDIO_MESSAGES_MAX)
        return false;
    m->ring[put % STUDIO_MESSAGES_MAX] = *message;
    atomic_store_explicit(&m->put, put + 1, memory_order_release);
    sem_post(&m->come);
    return true;
}

void studio_messages_flush(struct studio_messages *m)
{
    while (m->waiting_first < m->waiting_count && ring_put(m, &m->waiting[m->waiting_first]))
        m->waiting_first++;
    if (m->waiting_first == m->waiting_count)
        m->waiting_first = m->waiting_count = 0;
}

unsigned long studio_messages_put(struct studio_messages *m, struct studio_message message)
{
    message.number = ++m->numbered;
    studio_messages_flush(m);
    if (m->waiting_count == 0 && ring_put(m, &message))
        return message.number;
    if (!array_reserve(&m->waiting, &m->waiting_capacity, m->waiting_count + 1,
                       sizeof *m->waiting)) {
        studio_message_free(&message);
        return 0;
    }
    m->waiting[m->waiting_count++] = message;
    return message.number;
}

bool studio_messages_take(struct studio_messages *m, struct studio_message *out)
{
    const unsigned long taken = atomic_load_explicit(&m->taken, memory_order_relaxed);
    if (taken == atomic_load_explicit(&m->put, memory_order_acquire))
        return false;
    *out = m->ring[taken % STUDIO_MESSAGES_MAX];
    atomic_store_explicit(&m->taken, taken + 1, memory_order_release);
    return true;
}

bool studio_messages_waiting(const struct studio_messages *m)
{
    return atomic_load_explicit(&m->taken, memory_order_relaxed) !=
           atomic_load_explicit(&m->put, memory_order_acquire);
}

void studio_messages_wait(struct studio_messages *m, double seconds)
{
    struct timespec until;
    clock_gettime(CLOCK_REALTIME, &until);
    const double end = (double)until.tv_nsec * 1e-9 + seconds;
    until.tv_sec += (time_t)floor(end);
    until.tv_nsec = (long)((end - floor(end)) * 1e9);
    if (sem_timedwait(&m->come, &until) == 0)
        while (sem_trywait(&m->come) == 0) /* all that have come are taken at once */
            continue;
}
