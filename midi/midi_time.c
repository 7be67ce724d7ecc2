/* midi_time.c - see midi_time.h. */
#include "midi_time.h"

#include <math.h>
#include <time.h>

uint64_t midi_now_ns(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint64_t)now.tv_sec * 1000000000u + (uint64_t)now.tv_nsec;
}

/* The octave is the highest bit; its sixteenths are the four bits below. */
static int bin_of(uint64_t ns)
{
    if (ns < 16)
        return (int)ns;
    const int octave = 63 - __builtin_clzll(ns);
    const int bin = 16 * (octave - 3) + (int)(ns >> (octave - 4) & 15);
    return bin < MIDI_BINS ? bin : MIDI_BINS - 1;
}

static double bin_from(int bin)
{
    return bin < 16 ? bin : ldexp(16 + bin % 16, bin / 16 - 1);
}

void midi_histogram_add(struct midi_histogram *h, uint64_t ns)
{
    h->count++;
    h->most_ns = ns > h->most_ns ? ns : h->most_ns;
    h->bins[bin_of(ns)]++;
}

void midi_histogram_join(struct midi_histogram *h, const struct midi_histogram *more)
{
    h->count += more->count;
    h->most_ns = more->most_ns > h->most_ns ? more->most_ns : h->most_ns;
    for (int i = 0; i < MIDI_BINS; i++)
        h->bins[i] += more->bins[i];
}

double midi_histogram_part(const struct midi_histogram *h, double part)
{
    const double wanted = part * (double)h->count;
    double seen = 0;
    for (int i = 0; i < MIDI_BINS && h->count; i++) {
        seen += h->bins[i];
        if (seen >= wanted && h->bins[i])
            return fmin((double)h->most_ns, bin_from(i + 1));
    }
    return (double)h->most_ns;
}

uint64_t midi_histogram_between(const struct midi_histogram *h, uint64_t from_ns,
                                uint64_t to_ns)
{
    uint64_t count = 0;
    for (int i = 0; i < MIDI_BINS; i++)
        if (bin_from(i) >= (double)from_ns && bin_from(i) < (double)to_ns)
            count += h->bins[i];
    return count;
}
