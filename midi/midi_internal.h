/* midi_internal.h - shared by the files of this folder and its subfolders. */
#ifndef LUTETIA_MIDI_INTERNAL_H
#define LUTETIA_MIDI_INTERNAL_H

#include "midi_status.h"

#include <error_text.h>

extern _Thread_local struct error_text midi_last_error;

/* Keeps the message for midi_error() and returns the status. */
#define midi_fail(status, ...)                                                                 \
    ((enum midi_status)error_text_fail(&midi_last_error, (int)(status), __VA_ARGS__))

#endif
