/* midi_soak.h - the MIDI server at the rate of a MIDI cable for as long as one likes, with
 * programs that come, go, stall and are killed beside sixteen that check each message. The
 * instrument is unplugged and plugged in again, and a stage hears it and OSC. */
#ifndef LUTETIA_BENCH_MIDI_SOAK_H
#define LUTETIA_BENCH_MIDI_SOAK_H

#include <stdbool.h>
#include <stdint.h>

struct midi_soak_result {
    uint64_t messages, deliveries; /* played; checked by the sixteen */
    uint64_t wrong;                /* lost or altered at one of the sixteen */
    uint64_t killed;               /* programs that were */
    uint64_t plugged;              /* how often the instrument was unplugged, and came back */
    /* The stage's controls that were set by OSC and asked for; those of them, and knobs, that
     * were not what they had to be. */
    uint64_t answers, wrong_answers;
    /* memory: the most in the last quarter of the time less that in the second; and the most */
    double grown_kib, stage_grown_kib, server_kib, stage_kib;
    double p50_us, p99_us;
};

/* Errors: false: it could not go on. Messages that are wrong are a result. */
bool midi_soak(double seconds, struct midi_soak_result *out);

#endif
