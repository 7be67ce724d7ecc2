/* Timers: when one starts or stops, pending work is finished first, so that its time is counted
 * on the right side. What the front end computes in the machine's place is the machine's time;
 * it is taken while a timer runs. A timer goes on when the machine goes and another comes. */
#include <stdio.h>
#include <time.h>

#include "machine_told.h"
#include "paris_state.h"

#define TIMERS_COUNT 64

static struct timer {
    double elapsed_s, busy_s; /* of finished runs */
    double started_s, started_busy_s;
    int starts;
    bool running;
} timers[TIMERS_COUNT];

static struct timer *timer_of(const char *name, unsigned int timer)
{
    paris_the.call = name;
    if (timer < TIMERS_COUNT)
        return &timers[timer];
    paris_fail("timer: must be 0..%d (got %d)", TIMERS_COUNT - 1, (int)timer);
    return NULL;
}

static double now_s(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Of the machine that there is; 0: there is none. */
static double busy_now_s(void)
{
    struct machine_stats stats = {.busy_s = 0};
    if (paris_the.machine)
        machine_stats_get(paris_the.machine, &stats);
    return stats.busy_s;
}

/* Tells the machine whether any timer runs. */
static void work_time(void)
{
    bool any = false;
    for (int i = 0; i < TIMERS_COUNT; i++)
        any = any || timers[i].running;
    if (paris_the.machine)
        machine_work_time(paris_the.machine, any);
}

static void machine_catch_up(const char *name)
{
    if (machine_finish(paris_begin(name)) != MACHINE_OK)
        paris_fail_machine();
}

static double elapsed_s(const struct timer *t)
{
    return t->elapsed_s + (t->running ? now_s() - t->started_s : 0);
}

static double busy_s(const struct timer *t)
{
    return t->busy_s + (t->running ? busy_now_s() - t->started_busy_s : 0);
}

static void machine_changes(bool comes)
{
    for (int i = 0; i < TIMERS_COUNT && !comes; i++)
        if (timers[i].running) {
            timers[i].busy_s = busy_s(&timers[i]);
            timers[i].started_busy_s = 0; /* the next machine begins there */
        }
    if (comes)
        work_time();
}

void CM_timer_clear(unsigned int timer)
{
    struct timer *t = timer_of("CM_timer_clear", timer);
    if (!t)
        return;
    *t = (struct timer){0};
    work_time();
}

void CM_timer_start(unsigned int timer)
{
    struct timer *t = timer_of("CM_timer_start", timer);
    if (!t || t->running)
        return;
    machine_catch_up("CM_timer_start");
    t->running = true;
    paris_the.machine_changes = machine_changes;
    work_time();
    t->starts++;
    t->started_busy_s = busy_now_s();
    t->started_s = now_s();
}

void CM_timer_stop(unsigned int timer)
{
    struct timer *t = timer_of("CM_timer_stop", timer);
    if (!t || !t->running)
        return;
    machine_catch_up("CM_timer_stop");
    t->elapsed_s = elapsed_s(t);
    t->busy_s = busy_s(t);
    t->running = false;
    work_time();
}

double CM_timer_read_elapsed(unsigned int timer)
{
    const struct timer *t = timer_of("CM_timer_read_elapsed", timer);
    return t ? elapsed_s(t) : 0;
}

double CM_timer_read_cm_busy(unsigned int timer)
{
    const struct timer *t = timer_of("CM_timer_read_cm_busy", timer);
    return t ? busy_s(t) : 0;
}

double CM_timer_read_cm_idle(unsigned int timer)
{
    const struct timer *t = timer_of("CM_timer_read_cm_idle", timer);
    return t ? elapsed_s(t) - busy_s(t) : 0;
}

int CM_timer_read_starts(unsigned int timer)
{
    const struct timer *t = timer_of("CM_timer_read_starts", timer);
    return t ? t->starts : 0;
}

int CM_timer_read_run_state(unsigned int timer)
{
    const struct timer *t = timer_of("CM_timer_read_run_state", timer);
    return t && t->running;
}

void CM_timer_print(unsigned int timer)
{
    const struct timer *t = timer_of("CM_timer_print", timer);
    if (t)
        printf("timer %u: %d starts, %.6f s elapsed, %.6f s CM busy\n", timer, t->starts,
               elapsed_s(t), busy_s(t));
}
