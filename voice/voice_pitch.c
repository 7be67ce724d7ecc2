/* voice_pitch.c - de Cheveigné and Kawahara's YIN: the lag at which a signal differs least from
 * itself.
 *
 *     d(lag)  = sum over half the samples of (x[i] - x[i + lag])^2
 *     d'(lag) = d(lag) / mean of d(1..lag)
 *
 * The first dip of d' below DIP is the period, else the deepest dip where that is below
 * NONE; a parabola through it and its neighbours places it between samples.
 */
#include "voice_pitch.h"

#include <math.h>
#include <stdbool.h>

#define DIP 0.15f
#define NONE 0.35f

static float difference(const float *x, int count, int lag)
{
    float sum = 0;
    for (int i = 0; i < count; i++) {
        float d = x[i] - x[i + lag];
        sum += d * d;
    }
    return sum;
}

/* The place of the minimum of the parabola through three numbers around `lag`. */
static double between(const float *d, int lag)
{
    double a = (double)d[lag - 1], b = (double)d[lag], c = (double)d[lag + 1],
           bend = a - 2 * b + c;
    double moved = bend > 0 ? 0.5 * (a - c) / bend : 0;
    return lag + fmax(-1, fmin(1, moved));
}

double voice_pitch(const float *samples, int count, double rate_hz, double least_hz,
                   double most_hz, float *room, double *clarity)
{
    int half = count / 2, first = (int)fmax(2, floor(rate_hz / most_hz)),
        last = (int)fmin(half - 2, ceil(rate_hz / least_hz));
    float total = 0;
    *clarity = 0;
    room[0] = 1;
    for (int lag = 1; lag <= last + 1; lag++) {
        float d = difference(samples, half, lag);
        total += d;
        room[lag] = total > 0 ? d * (float)lag / total : 1;
    }
    int best = 0;
    for (int lag = first; lag <= last; lag++) {
        bool dip = room[lag] <= room[lag - 1] && room[lag] < room[lag + 1];
        if (!dip || (best && room[lag] >= room[best]))
            continue;
        best = lag;
        if (room[lag] < DIP)
            break;
    }
    if (!best)
        return 0;
    *clarity = fmax(0, fmin(1, 1 - (double)room[best]));
    return room[best] < NONE ? rate_hz / between(room, best) : 0;
}
