/* sub_devices.h - a device divided into equal shares, each with a queue of its own. Who uses
 * them finds the functions in device.h.
 *
 * At any time commands are on their way either in the device's own queue or in those of its
 * sub-devices. `queued` of the device says that there are some, and of the sub-devices that
 * they are theirs. */
#ifndef LUTETIA_MACHINE_SUB_DEVICES_H
#define LUTETIA_MACHINE_SUB_DEVICES_H

#include "device/device.h"

struct sub_devices {
    int count;
    bool queued;
    uint64_t memory_bytes; /* of all together, and the device */
    cl_device_id ids[SUB_DEVICES_MOST];
    struct device *of[SUB_DEVICES_MOST]; /* that are open; else NULL */
};

#endif
