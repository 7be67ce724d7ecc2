/* voice_formants.c - linear prediction by Burg's method, and the polynomial's roots by Durand
 * and Kerner's.
 *
 * A root r exp(±ia) is a resonance at a / 2 pi of the rate, with bandwidth -ln r / pi of it.
 * Formants are resonances within FORMANT_LEAST_HZ and FORMANT_MOST_HZ whose bandwidth is
 * below a limit that grows with frequency. The samples are first pre-emphasised by 6 dB an
 * octave.
 */
#include "voice_formants.h"

#include <complex.h>
#include <math.h>
#include <stdbool.h>

#define PI 3.14159265358979323846
#define LIFT 0.97f
#define FORMANT_LEAST_HZ 180.0
#define FORMANT_MOST_HZ 4000.0
#define WIDTH_HZ 250.0
#define WIDTH_PART 0.4

/* a[0] = 1 .. a[order]: x[i] is predicted as -sum a[k] x[i - k]. */
static void burg(const float *x, int count, int order, double *room, double *a)
{
    double *forward = room, *backward = room + count, before[VOICE_ORDER_MAX + 1];
    for (int i = 0; i < count; i++)
        forward[i] = backward[i] = (double)x[i];
    a[0] = 1;
    for (int k = 1; k <= order; k++) {
        double over = 0, under = 0;
        for (int i = k; i < count; i++) {
            over -= 2 * forward[i] * backward[i - 1];
            under += forward[i] * forward[i] + backward[i - 1] * backward[i - 1];
        }
        double reflection = under > 0 ? over / under : 0;
        for (int i = 0; i < k; i++)
            before[i] = a[i];
        before[k] = 0;
        a[k] = 0;
        for (int i = 1; i <= k; i++)
            a[i] = before[i] + reflection * before[k - i];
        for (int i = count - 1; i >= k; i--) {
            double f = forward[i], b = backward[i - 1];
            forward[i] = f + reflection * b;
            backward[i] = b + reflection * f;
        }
    }
}

/* Roots of z^order + a[1] z^(order-1) + ... */
static bool roots_find(const double *a, int order, complex double *z)
{
    enum { ROUNDS = 200 };
    for (int i = 0; i < order; i++) /* no two alike, none real */
        z[i] = 0.9 * cexp(I * (2 * PI * (i + 0.35) / order));
    for (int round = 0; round < ROUNDS; round++) {
        double moved = 0;
        for (int i = 0; i < order; i++) {
            complex double value = 1, apart = 1;
            for (int k = 1; k <= order; k++)
                value = value * z[i] + a[k];
            for (int j = 0; j < order; j++)
                if (j != i)
                    apart *= z[i] - z[j];
            complex double step = cabs(apart) > 1e-30 ? value / apart : 1e-6;
            z[i] -= step;
            moved = fmax(moved, cabs(step));
        }
        if (moved < 1e-9)
            return true;
    }
    return false;
}

void voice_formants(float *samples, int count, double rate_hz, int order, double *room,
                    double formant_hz[2])
{
    double a[VOICE_ORDER_MAX + 1], lowest[2] = {INFINITY, INFINITY};
    complex double z[VOICE_ORDER_MAX];
    formant_hz[0] = formant_hz[1] = 0;
    for (int i = count - 1; i >= 0; i--) {
        float window = 0.54f - 0.46f * cosf((float)(2 * PI) * ((float)i + 0.5f) / (float)count);
        samples[i] = (samples[i] - (i > 0 ? LIFT * samples[i - 1] : 0)) * window;
    }
    burg(samples, count, order, room, a);
    if (!roots_find(a, order, z))
        return;
    for (int i = 0; i < order; i++) {
        double hz = carg(z[i]) / (2 * PI) * rate_hz, width = -log(cabs(z[i])) / PI * rate_hz;
        if (!(hz >= FORMANT_LEAST_HZ && hz <= FORMANT_MOST_HZ &&
              width < WIDTH_HZ + WIDTH_PART * hz))
            continue;
        if (hz < lowest[0]) {
            lowest[1] = lowest[0];
            lowest[0] = hz;
        } else if (hz < lowest[1])
            lowest[1] = hz;
    }
    for (int i = 0; i < 2; i++)
        formant_hz[i] = isfinite(lowest[i]) ? lowest[i] : 0;
}
