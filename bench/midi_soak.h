/* midi_soak.h - the MIDI server at the rate of a MIDI cable for as long as one likes, with
 * programs that come, go, stall and are killed beside four that check each message. */
#ifndef LUTETIA_BENCH_MIDI_SOAK_H
#define LUTETIA_BENCH_MIDI_SOAK_H

#include <stdbool.h>
#include <stdint.h>

struct midi_soak_result {
    uint64_t messages, deliveries; /* played; checked by the four */
    uint64_t wrong;                /* lost or altered at one of the four */
    uint64_t killed;               /* programs that were */
    /* the server's memory: the most in the last quarter of the time less that in the second */
    double grown_kib;
    double p99_us;
};

/* Errors: false: it could not go on. Messages that are wrong are a result. */
bool midi_soak(double seconds, struct midi_soak_result *out);

#endif
