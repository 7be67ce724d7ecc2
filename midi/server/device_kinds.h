/* device_kinds.h - the kinds of devices; a new kind is a row and a file. */
#ifndef LUTETIA_MIDI_DEVICE_KINDS_H
#define LUTETIA_MIDI_DEVICE_KINDS_H

#include "device.h"

extern const struct device_kind device_kind_raw, device_kind_serial, device_kind_pty,
    device_kind_loop, device_kind_link, device_kind_file, device_kind_sound, device_kind_jack,
    device_kind_alsa;

/* All kinds of this build; ends with NULL. */
extern const struct device_kind *const device_kinds[];

#endif
