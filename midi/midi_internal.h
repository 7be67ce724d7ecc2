/* midi_internal.h - what the files of this folder share. */
#ifndef LUTETIA_MIDI_INTERNAL_H
#define LUTETIA_MIDI_INTERNAL_H

#include "midi_status.h"

#include <stdint.h>

/* Keeps the text for midi_error() and returns the status. */
enum midi_status midi_fail(enum midi_status status, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

#endif
