/* voice_cry.c - see voice_cry.h. The glottis: all harmonics below 0.45 of the rate, which
 * fall by 12 dB an octave above 100 Hz. The vocal tract: two Klatt resonators of bandwidth
 * WIDTH_HZ in series. */
#include "voice_cry.h"

#include <math.h>
#include <stdlib.h>

#define PI 3.14159265358979323846
#define WIDTH_HZ 80.0
#define SOFT_HZ 100.0
#define LOUDNESS 0.25 /* root of the mean square where loud() is 1 */

/* One breath: begins at `begin`, swells, and dies away. */
static double breath(double t, double begin, double seconds)
{
    double part = (t - begin) / seconds;
    return part <= 0 || part >= 1 ? 0 : fmin(1, part / 0.12) * pow(sin(PI * sqrt(part)), 0.8);
}

static double cry_loud(double t)
{
    return fmin(1,
                0.55 * breath(t, 0.15, 0.7) + breath(t, 1.0, 1.7) + 0.75 * breath(t, 2.9, 1.1));
}

static double cry_high(double t)
{
    double bend = breath(t, 0.15, 0.7) + breath(t, 1.0, 1.7) + breath(t, 2.9, 1.1);
    return 330 + 170 * bend + 9 * sin(2 * PI * 6 * t);
}

static void cry_vowel(double t, double formant_hz[2])
{
    double open = fmin(1, 1.4 * cry_loud(t));
    formant_hz[0] = 500 + 500 * open;
    formant_hz[1] = 1500 + 200 * (1 - open);
}

struct voice_cry voice_cry_default(void)
{
    return (struct voice_cry){.seconds = 4.2,
                              .rate_hz = 44100,
                              .loud = cry_loud,
                              .high = cry_high,
                              .vowel = cry_vowel};
}

float *voice_cry_make(const struct voice_cry *cry, size_t *count)
{
    *count = (size_t)(cry->seconds * cry->rate_hz);
    float *out = malloc((*count ? *count : 1) * sizeof *out);
    double *plain = malloc((*count ? *count : 1) * sizeof *plain);
    double phase = 0, last[2][2] = {{0}}, soft[2] = {0}, rate = cry->rate_hz, square = 0;
    if (!out || !plain) {
        free(out);
        free(plain);
        return NULL;
    }
    for (size_t i = 0; i < *count; i++) {
        double t = (double)i / rate, hz = cry->high(t), formant_hz[2];
        phase += hz / rate;
        phase -= floor(phase);
        double angle = 2 * PI * phase, n = floor(0.45 * rate / hz), x = n;
        if (fabs(sin(angle / 2)) > 1e-9)
            x = (sin((n + 0.5) * angle) / sin(angle / 2) - 1) / 2;
        for (int k = 0; k < 2; k++) {
            soft[k] += (x - soft[k]) * (1 - exp(-2 * PI * SOFT_HZ / rate));
            x = soft[k];
        }
        cry->vowel(t, formant_hz);
        for (int f = 0; f < 2; f++) {
            double r = exp(-PI * WIDTH_HZ / rate),
                   c = 2 * r * cos(2 * PI * formant_hz[f] / rate);
            double y = (1 - c + r * r) * x + c * last[f][0] - r * r * last[f][1];
            last[f][1] = last[f][0];
            last[f][0] = x = y;
        }
        plain[i] = x;
        square += x * x;
    }
    double unit = square > 0 ? LOUDNESS * sqrt((double)*count / square) : 0;
    for (size_t i = 0; i < *count; i++) {
        double x = unit * plain[i] * cry->loud((double)i / rate);
        out[i] = (float)fmax(-1, fmin(1, x));
    }
    free(plain);
    return out;
}
