/* devices.c - see devices.h. */
#include "devices.h"

#include <user_folder.h>

#include <sched.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { PLATFORMS_MAX = 16 };

/* PoCL makes as many threads as there are processors, and ties thread n to processor n. If
 * one of these processors is not available to this process, PoCL would end the program, so
 * threads are not tied then, and there are only as many as processors that are available. */
static void pocl_threads_tie(void)
{
    cpu_set_t ours;
    char count[16];
    bool all = true;
    long processors = sysconf(_SC_NPROCESSORS_CONF);
    if (getenv("POCL_MAX_PTHREAD_COUNT") || processors < 2 || processors > CPU_SETSIZE ||
        sched_getaffinity(0, sizeof ours, &ours))
        return;
    for (long i = 0; i < processors; i++)
        all = all && CPU_ISSET((size_t)i, &ours);
    snprintf(count, sizeof count, "%d", CPU_COUNT(&ours));
    if (all)
        setenv("POCL_AFFINITY", "1", 0);
    else
        setenv("POCL_MAX_PTHREAD_COUNT", count, 0);
}

/* PoCL loads files of its cache as code. Without HOME it would use a folder with a fixed
 * name in /tmp, and with an empty POCL_CACHE_DIR it ends the program. So it is always given
 * a folder of this user. A folder that the user has chosen, and that cannot be made, is left
 * as it is; PoCL then reports no device. */
static void pocl_cache_settle(void)
{
    const char *said = getenv("POCL_CACHE_DIR");
    char folder[USER_FOLDER_MAX];
    if (said && *said) {
        user_folder_make(said);
        if (access(said, F_OK) != 0 || !user_folder_wrong(said))
            return;
    }
    if (user_cache_folder("pocl/kcache", folder, NULL))
        setenv("POCL_CACHE_DIR", folder, 1);
    else
        setenv("POCL_KERNEL_CACHE", "0", 1);
}

static void name_get(char *out, size_t size, cl_int error)
{
    if (error)
        out[0] = '\0';
    out[size - 1] = '\0';
}

static void describe(struct opencl_device *d)
{
    name_get(d->platform_name, sizeof d->platform_name,
             clGetPlatformInfo(d->platform, CL_PLATFORM_NAME, sizeof d->platform_name,
                               d->platform_name, NULL));
    name_get(d->name, sizeof d->name,
             clGetDeviceInfo(d->id, CL_DEVICE_NAME, sizeof d->name, d->name, NULL));
    name_get(d->version, sizeof d->version,
             clGetDeviceInfo(d->id, CL_DEVICE_VERSION, sizeof d->version, d->version, NULL));
}

int opencl_devices(struct opencl_device out[static OPENCL_DEVICES_MAX], cl_platform_id *without)
{
    cl_platform_id platforms[PLATFORMS_MAX];
    cl_uint platforms_count = 0;
    int count = 0;
    if (without)
        *without = NULL;
    pocl_threads_tie();
    pocl_cache_settle();
    if (clGetPlatformIDs(PLATFORMS_MAX, platforms, &platforms_count) != CL_SUCCESS)
        return 0;
    for (cl_uint p = 0; p < platforms_count && p < PLATFORMS_MAX; p++) {
        cl_device_id devices[OPENCL_DEVICES_MAX];
        cl_uint devices_count = 0;
        if (clGetDeviceIDs(platforms[p], CL_DEVICE_TYPE_ALL, OPENCL_DEVICES_MAX, devices,
                           &devices_count) != CL_SUCCESS) {
            if (without)
                *without = platforms[p];
            continue;
        }
        for (cl_uint d = 0;
             d < devices_count && d < OPENCL_DEVICES_MAX && count < OPENCL_DEVICES_MAX; d++) {
            out[count] = (struct opencl_device){.platform = platforms[p], .id = devices[d]};
            describe(&out[count++]);
        }
    }
    return count;
}

int opencl_device_choose(const struct opencl_device *all, int count, const char *wanted,
                         const char **said)
{
    if (!wanted || !*wanted)
        wanted = getenv("LUTETIA_DEVICE");
    if (wanted && !*wanted)
        wanted = NULL;
    if (said)
        *said = wanted;
    if (!wanted)
        return count > 0 ? 0 : -1;
    char *end;
    long index = strtol(wanted, &end, 10);
    if (!*end)
        return index >= 0 && index < count ? (int)index : -1;
    for (int i = 0; i < count; i++)
        if (strcasestr(all[i].name, wanted) || strcasestr(all[i].platform_name, wanted))
            return i;
    return -1;
}
