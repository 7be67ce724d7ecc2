/* tuning.h - how code is generated for a device, as `lutetia tune` found it. */
#ifndef LUTETIA_MACHINE_TUNING_H
#define LUTETIA_MACHINE_TUNING_H

#include "device/device.h"

enum { TUNING_BYTES_MOST = 4096 };
/* What a file of so many bytes says; bytes[length] is 0. False: why is in one line, with the line's number; out is
 * what is usual. platform, name and driver: the device that it must be for. */
bool tuning_parse(const char *bytes, size_t length, const struct device *d,
                  struct machine_tuning *out, char *why, size_t why_size);
/* The device is known: what nobody forces is what has been kept for it, or what config says. */
void tuning_apply(struct machine *m, const struct machine_config *config);

#endif
