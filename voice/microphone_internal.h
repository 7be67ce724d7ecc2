/* microphone_internal.h - what the kinds of microphones share: a ring that one thread writes
 * and another reads. */
#ifndef LUTETIA_VOICE_MICROPHONE_INTERNAL_H
#define LUTETIA_VOICE_MICROPHONE_INTERNAL_H

#include "microphone.h"

#include <stdatomic.h>

enum { RING_SAMPLES = 1 << 19 }; /* eleven seconds at 48000 Hz; a power of two */

struct microphone {
    void (*close)(struct microphone *m);
    void *own; /* the kind's */
    int rate_hz;
    atomic_size_t written, read, lost;
    atomic_bool gone;
    float ring[RING_SAMPLES];
};

/* By the thread that hears. */
void microphone_put(struct microphone *m, const float *samples, size_t count);

bool microphone_jack_open(struct microphone *m, char *why, size_t room);
bool microphone_pulse_open(struct microphone *m, char *why, size_t room);

#endif
