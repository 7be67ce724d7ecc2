/* serial_speed.h - any speed of a serial line, as MIDI's 31250 bits a second is none of those that terminals have. */
#ifndef LUTETIA_MIDI_SERIAL_SPEED_H
#define LUTETIA_MIDI_SERIAL_SPEED_H

#include <stdbool.h>

/* False: errno; the line cannot. */
bool serial_speed_set(int file, unsigned int bits_per_second);

#endif
