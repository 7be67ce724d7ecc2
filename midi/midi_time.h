/* midi_time.h - the clock of all timestamps, and how long things took, as a histogram.
 *
 *     struct midi_histogram h = {0};
 *     midi_histogram_add(&h, midi_now_ns() - message.time_ns);
 *     printf("p99 %.0f us\n", midi_histogram_part(&h, 0.99) / 1e3);
 *
 * A histogram's bins are 1/16 of an octave wide: what it says is right within 4.5%. */
#ifndef LUTETIA_MIDI_TIME_H
#define LUTETIA_MIDI_TIME_H

#include <stdint.h>

uint64_t midi_now_ns(void); /* CLOCK_MONOTONIC, the same in all processes of a machine */

enum { MIDI_BINS = 16 * 48 };

struct midi_histogram { /* zeros: empty */
    uint64_t count, most_ns;
    uint32_t bins[MIDI_BINS];
};

void midi_histogram_add(struct midi_histogram *h, uint64_t ns);
/* The time that `part` (0..1) of all do not exceed; 0 of none. The largest is exact. */
double midi_histogram_part(const struct midi_histogram *h, double part);
/* Adds what the other one has. */
void midi_histogram_join(struct midi_histogram *h, const struct midi_histogram *more);
/* How many took from_ns or longer and less than to_ns, to the width of a bin. */
uint64_t midi_histogram_between(const struct midi_histogram *h, uint64_t from_ns,
                                uint64_t to_ns);

#endif
