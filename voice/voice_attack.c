/* voice_attack.c - a sound begins where the logarithm of its energy rises fastest, in the
 * whole spectrum or in its upper part. */
#include "voice_attack.h"

#include <math.h>

#define SPAN_S 0.05
#define AROUND_S 0.05

static int frames_of(double seconds, double frames_hz)
{
    double frames = floor(seconds * frames_hz + 0.5);
    return (int)fmax(1, fmin(VOICE_ATTACK_FRAMES_MAX / 2 - 1, frames));
}

void voice_attack_init(struct voice_attack *a, double frames_hz, double least, double gap_s)
{
    *a = (struct voice_attack){.least = least,
                               .span = frames_of(SPAN_S, frames_hz),
                               .around = frames_of(AROUND_S, frames_hz),
                               .gap = (int)fmax(1, floor(gap_s * frames_hz + 0.5)),
                               .last = -1000000};
}

static double *at(double *ring, long frame)
{
    return &ring[frame & (VOICE_ATTACK_FRAMES_MAX - 1)];
}

bool voice_attack_next(struct voice_attack *a, double energy, double upper)
{
    long now = a->count++, then = now - a->span, frame = now - a->around;
    double rise = 0;
    *at(a->energy[0], now) = energy;
    *at(a->energy[1], now) = upper;
    for (int band = 0; band < 2; band++) {
        double before = then >= 0 ? *at(a->energy[band], then) : *at(a->energy[band], 0);
        if (now < a->span) /* silence before the sound: the first frame stands for it */
            before = a->energy[band][0];
        rise += fmax(0, *at(a->energy[band], now) - before) / 2;
    }
    *at(a->rise, now) = rise;
    if (frame < 0)
        return false;
    double own = *at(a->rise, frame);
    if (own < a->least || frame - a->last < a->gap)
        return false;
    for (long other = frame - a->around; other <= now; other++)
        if (other >= 0 && other != frame &&
            (*at(a->rise, other) > own || (*at(a->rise, other) == own && other < frame)))
            return false;
    a->last = frame;
    return true;
}
