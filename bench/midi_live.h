/* midi_live.h - what is played, seen and heard: from a bounce to its note, from a key to its
 * picture. */
#ifndef LUTETIA_BENCH_MIDI_LIVE_H
#define LUTETIA_BENCH_MIDI_LIVE_H

#include "harness.h"

#include <stdbool.h>

struct stage;

/* A stage of masses without springs, which bounce for ever, each at its own height; it keeps no
 * session. Owns: the caller destroys *out. Errors: false. */
bool midi_live_masses(struct stage **out);

/* Adds the rows. Without a display there is none of pictures, and a line says so. Errors:
 * false. */
bool midi_live_measure(struct bench_report *r, int rounds);

#endif
