/* frame_clock.c - see frame_clock.h. */
#include "frame_clock.h"

#include <math.h>

/* A step counts as due if only the rounding error of the summed frame times is missing. */
#define ROUNDING 1e-9

struct frame_clock frame_clock_begin(double step_s, double now_s)
{
    return (struct frame_clock){
        .step_s = step_s, .rate = 1, .frame_max_s = 0.25, .now_s = now_s};
}

static void frame_measure(struct frame_clock *c, double frame_s)
{
    c->frame_s = c->frame_s > 0 ? c->frame_s + (frame_s - c->frame_s) / 20 : frame_s;
    c->frame_longest_s = fmax(c->frame_longest_s, frame_s);
}

int frame_clock_advance(struct frame_clock *c, double now_s)
{
    double real_s = fmax(0, now_s - c->now_s);
    c->now_s = fmax(c->now_s, now_s);
    if (real_s > 0)
        frame_measure(c, real_s);
    if (c->paused) {
        int singles = c->singles_count;
        c->singles_count = 0;
        c->steps_count += singles;
        return singles;
    }
    c->lost_s += fmax(0, real_s - c->frame_max_s);
    c->carried_s += fmin(real_s, c->frame_max_s) * c->rate;
    double steps = floor(c->carried_s / c->step_s + ROUNDING);
    c->carried_s = fmax(0, c->carried_s - steps * c->step_s);
    c->steps_count += (int64_t)steps;
    return (int)steps;
}

double frame_clock_fraction(const struct frame_clock *c)
{
    return fmin(1, c->carried_s / c->step_s);
}

double frame_clock_time_s(const struct frame_clock *c)
{
    return (double)c->steps_count * c->step_s + c->carried_s;
}

double frame_clock_wait_s(const struct frame_clock *c, double time_s)
{
    double left_s = time_s - frame_clock_time_s(c);
    if (left_s <= ROUNDING * c->step_s)
        return 0;
    return c->paused ? INFINITY : left_s / c->rate;
}

void frame_clock_skip(struct frame_clock *c, double time_s)
{
    double left_s = time_s - frame_clock_time_s(c);
    if (!(left_s > 0))
        return;
    double steps = floor((c->carried_s + left_s) / c->step_s + ROUNDING);
    c->carried_s = fmax(0, c->carried_s + left_s - steps * c->step_s);
    c->steps_count += (int64_t)steps;
}

void frame_clock_single(struct frame_clock *c)
{
    c->paused = true;
    c->singles_count++;
}

void frame_clock_rate_set(struct frame_clock *c, double rate)
{
    c->rate = fmin(FRAME_CLOCK_RATE_MAX, fmax(FRAME_CLOCK_RATE_MIN, rate));
}

void frame_pace_drawn(struct frame_pace *pace, double began_s, double ended_s)
{
    pace->due_s = fmax(began_s + pace->least_s, ended_s + (ended_s - began_s));
}
