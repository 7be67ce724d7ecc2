/* frame_clock.h - simulated time out of real time: fixed steps, slow motion, pause, single
 * steps; and when the next picture is due.
 *
 *     struct frame_clock clock = frame_clock_begin(1 / 240.0, now_s);
 *     for (;;) {                                                // a frame
 *         for (int n = frame_clock_advance(&clock, now_s); n > 0; n--)
 *             simulate(clock.step_s);
 *         // between the last step and the next
 *         draw(frame_clock_fraction(&clock));
 *     }
 *
 * All steps have the same length, so that a simulation does not depend on the screen's rate.
 * Real time that is not yet a whole step is carried to the next frame. A long frame counts as
 * frame_max_s at most. So a program that was stopped goes on where it was, and a simulation
 * that is too slow for real time runs slower instead of falling behind for ever.
 *
 * The clock does not read the system's time: the caller passes the time. Films pass n / fps;
 * tests pass any time.
 *
 * Units. Seconds. Threads. A clock belongs to one thread at a time.
 */
#ifndef LUTETIA_FRAME_CLOCK_H
#define LUTETIA_FRAME_CLOCK_H

#include <stdbool.h>
#include <stdint.h>

#define FRAME_CLOCK_RATE_MIN 0.001
#define FRAME_CLOCK_RATE_MAX 1000.0

struct frame_clock {
    double step_s;      /* simulated time of one step */
    double rate;        /* simulated seconds for each real second; usually 1, below 1 slow
                         * motion */
    double frame_max_s; /* the most real time that one frame counts; 0.25 */
    bool paused;
    /* Read only. */
    int64_t steps_count; /* since the beginning */
    double carried_s;    /* simulated time that is not yet a whole step: 0 to step_s */
    double now_s;        /* the real time of the last frame */
    int singles_count;   /* single steps that were asked for and not yet taken */
    double lost_s;       /* real time lost because frames were longer than frame_max_s */
    double frame_s; /* a frame's usual length, a running mean over about twenty frames; 0 before
                  * two frames */
    double frame_longest_s;
};

/* step_s: above 0. */
struct frame_clock frame_clock_begin(double step_s, double now_s);

/* Begins a new frame. Returns how many steps to simulate now. A paused clock returns the
 * single steps that were asked for. A time before the last frame's is treated as the last
 * frame's. */
int frame_clock_advance(struct frame_clock *clock, double now_s);

/* Where the present is between the last step and the next, 0..1. */
double frame_clock_fraction(const struct frame_clock *clock);

/* Simulated time. */
double frame_clock_time_s(const struct frame_clock *clock);

/* Real seconds from the last frame until the simulated time is time_s; 0 if it has been;
 * infinity while paused. */
double frame_clock_wait_s(const struct frame_clock *clock, double time_s);

/* Moves at once to that simulated time, if it is in the future: a single step of a
 * simulation whose events have known times. */
void frame_clock_skip(struct frame_clock *clock, double time_s);

/* Pauses, and requests one more step. */
void frame_clock_single(struct frame_clock *clock);

/* The rate is clamped to FRAME_CLOCK_RATE_MIN..MAX. Simulated time is continuous. */
void frame_clock_rate_set(struct frame_clock *clock, double rate);

/* Decides when pictures may be drawn: at most so many a second, and after each a rest as
 * long as it took to draw, so that drawing never takes more than half of a processor. */
struct frame_pace {
    double least_s; /* from one picture's beginning to the next picture's beginning */
    double due_s;   /* the next picture may begin at this real time */
};
void frame_pace_drawn(struct frame_pace *pace, double began_s, double ended_s);

#endif
