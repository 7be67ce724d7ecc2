/* midi_live.h - what is played, seen and heard: from a bounce to its note, from a key to its
 * picture. */
#ifndef LUTETIA_BENCH_MIDI_LIVE_H
#define LUTETIA_BENCH_MIDI_LIVE_H

#include "harness.h"

#include <stdbool.h>

/* Adds the rows. Without a display there is none of pictures, and a line says so. Errors:
 * false. */
bool midi_live_measure(struct bench_report *r, int rounds);

#endif
