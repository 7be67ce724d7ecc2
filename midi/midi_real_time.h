/* midi_real_time.h - the priority of what plays in time: the server, and whoever plays a song.
 *
 *     char said[MIDI_REAL_TIME_TEXT];
 *     midi_real_time_begin(said);                  // "real-time priority 40", or why not
 *
 * Errors: none; without real time everything works, later on a busy machine. Threads: the
 * calling one gets it; those that it makes, and programs that it starts, do not. */
#ifndef LUTETIA_MIDI_REAL_TIME_H
#define LUTETIA_MIDI_REAL_TIME_H

#include <stdbool.h>

enum { MIDI_REAL_TIME_PRIORITY = 40, MIDI_REAL_TIME_TEXT = 160 };

/* SCHED_FIFO, where that is allowed (`ulimit -r`, or root). */
bool midi_real_time_begin(char said[MIDI_REAL_TIME_TEXT]);

#endif
