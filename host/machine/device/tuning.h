/* tuning.h - the knobs that `lutetia tune` has stored for a device. */
#ifndef LUTETIA_MACHINE_TUNING_H
#define LUTETIA_MACHINE_TUNING_H

#include "device/device.h"

enum { TUNING_BYTES_MOST = 4096 };
/* Parses a file of that many bytes; bytes[length] is 0. platform, name and driver: the
 * device that the file must be for. False: `why` gets one line with the line's number, and
 * out the usual values. */
bool tuning_parse(const char *bytes, size_t length, const struct device *d,
                  struct machine_tuning *out, char *why, size_t why_size);
/* Called when the device is known. Knobs that the environment does not force get the stored
 * values, or those of config. */
void tuning_apply(struct machine *m, const struct machine_config *config);

#endif
