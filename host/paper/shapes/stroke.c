/* stroke.c - the way of a stroke: a cubic spline through timed samples.
 *
 * Between two samples the position is the Hermite cubic of their positions and velocities. A
 * sample's velocity is that of the parabola through it and both its neighbours (a
 * Catmull-Rom spline for uneven times). Pressure and tilt are linear between samples: a
 * cubic could overshoot below 0.
 */
#include "brush.h"

#include "arguments/rows.h"
#include "base/base.h"

#include <math.h>
#include <stdio.h>

enum paper_status paper_stroke_check(const struct paper_stroke *stroke)
{
    if (stroke->samples_count < 1 || stroke->samples_count > PAPER_STROKE_SAMPLES_MAX)
        return paper_fail(PAPER_BAD_ARGUMENT, "a stroke has 1..%d samples (got %d)",
                          PAPER_STROKE_SAMPLES_MAX, stroke->samples_count);
    enum paper_status status =
        paper_members_check(&paper_stroke_members, stroke, "a stroke's ", "");
    for (int i = 0; i < stroke->samples_count && status == PAPER_OK; i++) {
        const struct paper_stroke_sample *s = &stroke->samples[i];
        char where[40];
        snprintf(where, sizeof where, " in sample %d", i + 1);
        status = paper_members_check(&paper_sample_members, s, "a stroke's ", where);
        if (status != PAPER_OK)
            break;
        if (i > 0 && !(s->time_s > stroke->samples[i - 1].time_s))
            return paper_fail(PAPER_BAD_ARGUMENT,
                              "a stroke's times must ascend (got %g after %g in sample %d)",
                              s->time_s, stroke->samples[i - 1].time_s, i + 1);
    }
    return status;
}

/* x (axis 0) or y of sample i. */
static double place(const struct paper_stroke *stroke, int i, int axis)
{
    return axis == 0 ? stroke->samples[i].x : stroke->samples[i].y;
}

static double slope(const struct paper_stroke *stroke, int i, int axis)
{
    return (place(stroke, i + 1, axis) - place(stroke, i, axis)) /
           (stroke->samples[i + 1].time_s - stroke->samples[i].time_s);
}

static double velocity(const struct paper_stroke *stroke, int i, int axis)
{
    if (i == 0)
        return slope(stroke, 0, axis);
    if (i == stroke->samples_count - 1)
        return slope(stroke, i - 1, axis);
    double before = stroke->samples[i].time_s - stroke->samples[i - 1].time_s;
    double after = stroke->samples[i + 1].time_s - stroke->samples[i].time_s;
    return (slope(stroke, i - 1, axis) * after + slope(stroke, i, axis) * before) /
           (before + after);
}

struct paper_stroke_sample paper_stroke_at(const struct paper_stroke *stroke, double time_s,
                                           int *cursor)
{
    int last = stroke->samples_count - 1, i = *cursor;
    if (last == 0 || time_s <= stroke->samples[0].time_s)
        return stroke->samples[0];
    if (time_s >= stroke->samples[last].time_s)
        return stroke->samples[last];
    if (i > last - 1 || stroke->samples[i].time_s > time_s)
        i = 0;
    while (stroke->samples[i + 1].time_s < time_s)
        i++;
    *cursor = i;
    const struct paper_stroke_sample *a = &stroke->samples[i], *b = a + 1;
    double length = b->time_s - a->time_s, u = (time_s - a->time_s) / length, v = 1 - u;
    double at[2];
    for (int axis = 0; axis < 2; axis++) {
        double p = place(stroke, i, axis), q = place(stroke, i + 1, axis);
        double start = velocity(stroke, i, axis) * length;
        double end = velocity(stroke, i + 1, axis) * length;
        at[axis] = v * v * ((1 + 2 * u) * p + u * start) + u * u * ((1 + 2 * v) * q - v * end);
    }
    return (struct paper_stroke_sample){
        .time_s = time_s,
        .x = at[0],
        .y = at[1],
        .pressure = v * a->pressure + u * b->pressure,
        .tilt_x = v * a->tilt_x + u * b->tilt_x,
        .tilt_y = v * a->tilt_y + u * b->tilt_y,
    };
}
