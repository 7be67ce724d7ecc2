/* devices.h - the OpenCL devices there are, and how one is chosen: the same for the machine, for glyphs and for the
 * benchmarks' kernels written by hand.
 *
 *     struct opencl_device *all = calloc(OPENCL_DEVICES_MAX, sizeof *all);
 *     int count = opencl_devices(all, NULL), chosen = opencl_device_choose(all, count, NULL);
 *     if (chosen >= 0)
 *         clCreateContext(NULL, 1, &all[chosen].id, NULL, NULL, &error);
 *
 * Threads. The first call of a process may change its environment (see opencl_devices()): make it before other threads
 * read that. */
#ifndef LUTETIA_OPENCL_DEVICES_H
#define LUTETIA_OPENCL_DEVICES_H

#include <CL/cl.h>

enum { OPENCL_DEVICES_MAX = 64 };

struct opencl_device {
    cl_platform_id platform;
    cl_device_id id;
    char platform_name[128], name[256], version[128];
};

/* All devices of all platforms, in the loader's order; how many. *without, which may be NULL: a platform that has no device,
 * or NULL.
 * PoCL's threads are tied to a processor each (POCL_AFFINITY=1) where there is one for each of them and nobody has said
 * otherwise by that variable, by POCL_MAX_PTHREAD_COUNT or by an affinity of the process: left to itself, the
 * system often wakes two of them on one processor, and what takes a few milliseconds is over before it
 * moves one away. */
int opencl_devices(struct opencl_device out[static OPENCL_DEVICES_MAX],
                   cl_platform_id *without);

/* wanted: a number, or part of a device's or its platform's name in capitals or not; NULL or "": LUTETIA_DEVICE, else the
 * first. *said, which may be NULL: what was wanted, NULL for nothing. -1: there is no such device. */
int opencl_device_choose(const struct opencl_device *all, int count, const char *wanted,
                         const char **said);

#endif
