/* server_loop.h - one thread that waits for descriptors and for times.
 *
 * Watches and timers are members of their owners' structs, and are removed before these are
 * freed.
 */
#ifndef LUTETIA_MIDI_SERVER_LOOP_H
#define LUTETIA_MIDI_SERVER_LOOP_H

#include <stdbool.h>
#include <stdint.h>
#include <sys/epoll.h>

struct server_watch {
    int file; /* -1: not watched */
    void (*ready)(struct server_watch *w, uint32_t events);
    void *owner;
};

struct server_timer {
    uint64_t due_ns; /* UINT64_MAX: never */
    void (*fire)(struct server_timer *t, uint64_t now_ns);
    void *owner;
    struct server_timer *next; /* the loop's */
    bool listed;
};

enum { LOOP_EVENTS = 32 };

struct server_loop {
    int epoll, clock;
    bool stops;
    struct server_timer *timers;
    struct epoll_event events[LOOP_EVENTS]; /* those at hand */
    int events_count;
};

bool loop_create(struct server_loop *l); /* false: errno */
void loop_finish(struct server_loop *l);
/* Calls what is due and ready, until loop->stops. */
void loop_run(struct server_loop *l);

/* events: EPOLLIN, EPOLLOUT. False: errno. */
bool loop_watch(struct server_loop *l, struct server_watch *w, uint32_t events);
void loop_change(struct server_loop *l, struct server_watch *w, uint32_t events);
void loop_unwatch(struct server_loop *l, struct server_watch *w); /* an unwatched one is fine */

void loop_timer(struct server_loop *l, struct server_timer *t, uint64_t due_ns);
void loop_timer_remove(struct server_loop *l, struct server_timer *t);

#endif
