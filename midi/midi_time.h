/* midi_time.h - the clock of all timestamps, and histograms of durations.
 *
 *     struct midi_histogram h = {0};
 *     midi_histogram_add(&h, midi_now_ns() - message.time_ns);
 *     printf("p99 %.0f us\n", midi_histogram_part(&h, 0.99) / 1e3);
 *
 * A histogram's bins are 1/16 of an octave wide: its results are exact to 4.5%.
 *
 * Errors: none. Ownership: a histogram is the caller's, and points to nothing. Threads: any; a
 * histogram belongs to one at a time.
 */
#ifndef LUTETIA_MIDI_TIME_H
#define LUTETIA_MIDI_TIME_H

#include <stdint.h>

uint64_t midi_now_ns(void); /* CLOCK_MONOTONIC, the same in all processes of a machine */

enum { MIDI_BINS = 16 * 48 };

struct midi_histogram { /* zeros: empty */
    uint64_t count, most_ns;
    uint32_t bins[MIDI_BINS];
};

/* Counts one duration. */
void midi_histogram_add(struct midi_histogram *h, uint64_t ns);
/* The quantile `part` (0..1); 0 if the histogram is empty. The largest value is exact. */
double midi_histogram_part(const struct midi_histogram *h, double part);
/* Adds another histogram. */
void midi_histogram_join(struct midi_histogram *h, const struct midi_histogram *more);
/* The number of durations of at least from_ns and less than to_ns, to the width of a bin. */
uint64_t midi_histogram_between(const struct midi_histogram *h, uint64_t from_ns,
                                uint64_t to_ns);

#endif
