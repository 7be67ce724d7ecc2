/* server_loop.c - see server_loop.h. */
#include "server_loop.h"

#include <midi_time.h>

#include <errno.h>
#include <stddef.h>
#include <sys/timerfd.h>
#include <unistd.h>

bool loop_create(struct server_loop *l)
{
    *l = (struct server_loop){.epoll = epoll_create1(EPOLL_CLOEXEC), .clock = -1};
    if (l->epoll < 0)
        return false;
    l->clock = timerfd_create(CLOCK_MONOTONIC, TFD_CLOEXEC | TFD_NONBLOCK);
    struct epoll_event event = {.events = EPOLLIN, .data.ptr = NULL};
    return l->clock >= 0 && epoll_ctl(l->epoll, EPOLL_CTL_ADD, l->clock, &event) == 0;
}

void loop_finish(struct server_loop *l)
{
    if (l->clock >= 0)
        close(l->clock);
    if (l->epoll >= 0)
        close(l->epoll);
}

bool loop_watch(struct server_loop *l, struct server_watch *w, uint32_t events)
{
    struct epoll_event event = {.events = events, .data.ptr = w};
    return epoll_ctl(l->epoll, EPOLL_CTL_ADD, w->file, &event) == 0;
}

void loop_change(struct server_loop *l, struct server_watch *w, uint32_t events)
{
    struct epoll_event event = {.events = events, .data.ptr = w};
    if (w->file >= 0)
        (void)epoll_ctl(l->epoll, EPOLL_CTL_MOD, w->file, &event);
}

void loop_unwatch(struct server_loop *l, struct server_watch *w)
{
    if (w->file >= 0)
        (void)epoll_ctl(l->epoll, EPOLL_CTL_DEL, w->file, NULL);
    for (int i = 0; i < l->events_count; i++) /* events already fetched may still refer to it */
        if (l->events[i].data.ptr == w)
            l->events[i].events = 0;
}

void loop_timer(struct server_loop *l, struct server_timer *t, uint64_t due_ns)
{
    t->due_ns = due_ns;
    if (t->listed)
        return;
    t->next = l->timers;
    t->listed = true;
    l->timers = t;
}

void loop_timer_remove(struct server_loop *l, struct server_timer *t)
{
    for (struct server_timer **at = &l->timers; *at; at = &(*at)->next)
        if (*at == t) {
            *at = t->next;
            break;
        }
    t->listed = false;
    t->due_ns = UINT64_MAX;
}

/* Calls the timers that are due, one at a time, since each may change the list. Returns when
 * the next one is due. */
static uint64_t timers_fire(struct server_loop *l)
{
    for (;;) {
        struct server_timer *first = NULL;
        for (struct server_timer *t = l->timers; t; t = t->next)
            if (!first || t->due_ns < first->due_ns)
                first = t;
        if (!first || first->due_ns == UINT64_MAX)
            return UINT64_MAX;
        const uint64_t now_ns = midi_now_ns();
        if (first->due_ns > now_ns)
            return first->due_ns;
        first->due_ns = UINT64_MAX;
        first->fire(first, now_ns);
    }
}

static void clock_set(struct server_loop *l, uint64_t due_ns)
{
    struct itimerspec at = {{0, 0}, {0, 0}};
    if (due_ns != UINT64_MAX) {
        at.it_value.tv_sec = (time_t)(due_ns / 1000000000);
        at.it_value.tv_nsec = (long)(due_ns % 1000000000);
    }
    (void)timerfd_settime(l->clock, TFD_TIMER_ABSTIME, &at, NULL);
}

void loop_run(struct server_loop *l)
{
    uint64_t set_ns = 0;
    while (!l->stops) {
        const uint64_t due_ns = timers_fire(l);
        if (l->stops)
            return;
        if (due_ns != set_ns)
            clock_set(l, due_ns);
        set_ns = due_ns;
        l->events_count = epoll_wait(l->epoll, l->events, LOOP_EVENTS, -1);
        if (l->events_count < 0 && errno != EINTR)
            return;
        for (int i = 0; i < l->events_count && !l->stops; i++) {
            struct server_watch *w = l->events[i].data.ptr;
            if (!w)
                set_ns = 0; /* the clock descriptor: its timers were called above, and it is
                             * set again */
            else if (l->events[i].events)
                w->ready(w, l->events[i].events);
        }
        l->events_count = 0;
    }
}
