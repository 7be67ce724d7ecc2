/* serial_speed.h - sets any speed of a serial line: MIDI's 31250 bits a second is not a
 * standard terminal speed. */
#ifndef LUTETIA_MIDI_SERIAL_SPEED_H
#define LUTETIA_MIDI_SERIAL_SPEED_H

#include <stdbool.h>

/* False: the line does not support it; errno. */
bool serial_speed_set(int file, unsigned int bits_per_second);

#endif
