/* device_kinds.c - see device_kinds.h. */
#include "device_kinds.h"

const struct device_kind *const device_kinds[] = {
    &device_kind_raw,  &device_kind_serial,
    &device_kind_pty,  &device_kind_loop,
    &device_kind_file, &device_kind_sound,
    &device_kind_jack, &device_kind_alsa,
    &device_kind_link, NULL,
};
