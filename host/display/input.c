/* input.c - see input.h. The queue is a ring. */
#include "input.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

/* Places reserved for events that end something, and, among these, places reserved for
 * INPUT_SIZE and INPUT_CLOSE. */
enum { ENDS_RESERVED = 64, LAST_RESERVED = 2 };

double input_now_s(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static struct input_event *event_at(struct input_queue *q, int i)
{
    return &q->events[(q->first + i) % INPUT_EVENTS_MAX];
}

void input_queue_finish(struct input_queue *q)
{
    for (int i = 0; i < q->count; i++)
        free(event_at(q, i)->path);
    free(q->path);
    memset(q, 0, sizeof *q);
}

static bool waits_once(enum input_kind kind)
{
    return kind == INPUT_SIZE || kind == INPUT_CLOSE;
}

/* How many events may wait before such an event is refused. */
static int room_for(enum input_kind kind)
{
    if (waits_once(kind))
        return INPUT_EVENTS_MAX;
    bool ends = kind == INPUT_POINTER_UP || kind == INPUT_KEY_UP ||
                kind == INPUT_POINTER_LEAVE || kind == INPUT_FOCUS_LOST;
    return INPUT_EVENTS_MAX - (ends ? LAST_RESERVED : ENDS_RESERVED);
}

/* A waiting event that the new one replaces; NULL if there is none. */
static struct input_event *replaceable(struct input_queue *q, const struct input_event *event)
{
    for (int i = 0; waits_once(event->kind) && i < q->count; i++)
        if (event_at(q, i)->kind == event->kind)
            return event_at(q, i);
    if (event->kind == INPUT_POINTER_MOVE && q->count > INPUT_EVENTS_MAX / 2) {
        struct input_event *last = event_at(q, q->count - 1);
        if (last->kind == INPUT_POINTER_MOVE && last->buttons == event->buttons)
            return last;
    }
    return NULL;
}

bool input_queue_put(struct input_queue *q, const struct input_event *event)
{
    struct input_event *place = replaceable(q, event);
    if (!place) {
        int room = room_for(event->kind);
        char *path = event->path && q->count < room ? strdup(event->path) : NULL;
        if (q->count >= room || (event->path && !path)) {
            q->lost_count++;
            return false;
        }
        place = event_at(q, q->count++);
        *place = *event;
        place->path = path;
        return true;
    }
    *place = *event;
    return true;
}

bool input_queue_take(struct input_queue *q, struct input_event *event)
{
    memset(event, 0, sizeof *event);
    free(q->path);
    q->path = NULL;
    if (!q->count)
        return false;
    *event = *event_at(q, 0);
    q->path = event->path;
    q->first = (q->first + 1) % INPUT_EVENTS_MAX;
    q->count--;
    return true;
}
