/* frame_clock.h - simulated time out of real time: fixed steps, slow motion, pause, single steps; and when the next picture
 * is due.
 *
 *     struct frame_clock clock = frame_clock_begin(1 / 240.0, now_s);
 *     for (;;) {                                                // a frame
 *         for (int n = frame_clock_advance(&clock, now_s); n > 0; n--)
 *             simulate(clock.step_s);
 *         draw(frame_clock_fraction(&clock));                   // between the last step and the next
 *     }
 *
 * A simulation goes in steps of one length, so that it computes the same whatever the screen's rate is. Real time that is
 * not yet a whole step is carried to the next frame. A frame that took long brings frame_max_s at most: a program that was
 * stopped goes on where it was, and a simulation that is too slow for real time loses time rather than falls behind for ever.
 *
 * The clock asks nobody for the time: whoever calls says what time it is. Films say n / fps, tests what they like.
 *
 * Units. Seconds. Threads. A clock belongs to one thread at a time. */
#ifndef LUTETIA_FRAME_CLOCK_H
#define LUTETIA_FRAME_CLOCK_H

#include <stdbool.h>
#include <stdint.h>

#define FRAME_CLOCK_RATE_MIN 0.001
#define FRAME_CLOCK_RATE_MAX 1000.0

struct frame_clock {
    double step_s;      /* simulated time of one step */
    double rate;        /* simulated seconds in a real one; 1; below it slow motion */
    double frame_max_s; /* real time that one frame brings at most; 0.25 */
    bool paused;
    /* Read only. */
    int64_t steps_count; /* since the beginning */
    double carried_s;    /* simulated, 0 to step_s: not yet a step */
    double now_s;        /* the real time of the last frame */
    int singles_count;   /* single steps that were asked for and not yet taken */
    double lost_s;       /* real time that frames had beyond frame_max_s */
    double
        frame_s; /* a frame's usual length, the mean over the last twenty or so; 0 before two frames */
    double frame_longest_s;
};

/* step_s: above 0. */
struct frame_clock frame_clock_begin(double step_s, double now_s);

/* A new frame: how many steps to simulate now. A paused clock gives the single steps that were asked for. A time before the
 * last frame's counts as that. */
int frame_clock_advance(struct frame_clock *clock, double now_s);

/* How far between the last step and the next the present is, 0..1. */
double frame_clock_fraction(const struct frame_clock *clock);

/* Simulated time. */
double frame_clock_time_s(const struct frame_clock *clock);

/* Real seconds from the last frame until the simulated time is time_s; 0 if it has been; infinity while paused. */
double frame_clock_wait_s(const struct frame_clock *clock, double time_s);

/* Goes on to that simulated time at once, if it is still to come: a single step of what happens at known times. */
void frame_clock_skip(struct frame_clock *clock, double time_s);

/* Pauses, and asks for one step more. */
void frame_clock_single(struct frame_clock *clock);

/* Kept within FRAME_CLOCK_RATE_MIN..MAX. Simulated time goes on from where it is. */
void frame_clock_rate_set(struct frame_clock *clock, double rate);

/* When pictures may be drawn: at most so many a second, and after each a rest as long as it took to draw, so that drawing
 * never takes more than half of a processor. */
struct frame_pace {
    double least_s; /* from one picture's beginning to the next's */
    double due_s;   /* the next picture may begin at this real time */
};
void frame_pace_drawn(struct frame_pace *pace, double began_s, double ended_s);

#endif
