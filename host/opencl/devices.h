/* devices.h - lists the OpenCL devices and chooses one: for the machine, for glyphs and for the
 * benchmarks' hand-written kernels.
 *
 *     struct opencl_device *all = calloc(OPENCL_DEVICES_MAX, sizeof *all);
 *     int count = opencl_devices(all, NULL), chosen = opencl_device_choose(all, count, NULL);
 *     if (chosen >= 0)
 *         clCreateContext(NULL, 1, &all[chosen].id, NULL, NULL, &error);
 *
 * Threads. The first call of a process may change its environment (see opencl_devices()):
 * make it before other threads read the environment.
 */
#ifndef LUTETIA_OPENCL_DEVICES_H
#define LUTETIA_OPENCL_DEVICES_H

#include <CL/cl.h>

enum { OPENCL_DEVICES_MAX = 64 };

struct opencl_device {
    cl_platform_id platform;
    cl_device_id id;
    char platform_name[128], name[256], version[128];
};

/* Lists all devices of all platforms, in the loader's order; returns their number. *without,
 * which may be NULL: a platform that has no device, or NULL. PoCL's threads are tied to a
 * processor each (POCL_AFFINITY=1) if there are enough processors, unless that variable,
 * POCL_MAX_PTHREAD_COUNT or an affinity of the process says otherwise. Otherwise the system
 * often wakes two threads on one processor, and a kernel of a few milliseconds ends before
 * one of them is moved. A process that may run on fewer processors than there are has as many
 * threads as these. */
int opencl_devices(struct opencl_device out[static OPENCL_DEVICES_MAX],
                   cl_platform_id *without);

/* wanted: a number, or part of a device's or its platform's name, in any case; NULL or "":
 * LUTETIA_DEVICE, else the first. *said (may be NULL) gets the text that was used, NULL for
 * none. -1: there is no such device. */
int opencl_device_choose(const struct opencl_device *all, int count, const char *wanted,
                         const char **said);

#endif
