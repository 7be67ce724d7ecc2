/* open.c - chooses, opens and closes the device. */
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/errors.h"
#include "base/parts.h"
#include "device/chunks.h"
#include "device/code_pages.h"
#include "device/tuning.h"
#include "devices.h"
#include "input_file.h"
#include "latency.h"
#include "ranks/ranks.h"

int machine_devices_list(void (*each)(void *context, int index, const char *platform,
                                      const char *device, const char *version,
                                      int compute_units, uint64_t memory_bytes),
                         void *context)
{
    struct opencl_device *all = calloc(OPENCL_DEVICES_MAX, sizeof *all);
    if (!all)
        return 0;
    int count = opencl_devices(all, NULL);
    for (int i = 0; i < count; i++) {
        cl_uint units = 0;
        cl_ulong memory = 0;
        clGetDeviceInfo(all[i].id, CL_DEVICE_MAX_COMPUTE_UNITS, sizeof units, &units, NULL);
        clGetDeviceInfo(all[i].id, CL_DEVICE_GLOBAL_MEM_SIZE, sizeof memory, &memory, NULL);
        each(context, i, all[i].platform_name, all[i].name, all[i].version, (int)units, memory);
    }
    free(all);
    return count;
}

/* PoCL reports no device if it cannot make the folder for its cache. */
static enum machine_status no_device_on(struct machine *m, cl_platform_id platform)
{
    char name[128] = "";
    clGetPlatformInfo(platform, CL_PLATFORM_NAME, sizeof name - 1, name, NULL);
    return machine_fail(
        m, MACHINE_NO_DEVICE,
        "the OpenCL platform \"%s\" has no device; if it is PoCL: can it write in "
        "POCL_CACHE_DIR, XDG_CACHE_HOME or ~/.cache?",
        name);
}

static enum machine_status choose(struct machine *m, const struct machine_config *config)
{
    struct device *d = m->device;
    struct opencl_device *all = calloc(OPENCL_DEVICES_MAX, sizeof *all);
    if (!all)
        return machine_fail(m, MACHINE_NO_MEMORY, "not enough memory to list devices");
    cl_platform_id without;
    const char *choice;
    int count = opencl_devices(all, &without);
    int chosen = opencl_device_choose(all, count, config->device, &choice);
    if (chosen < 0) {
        enum machine_status status =
            count > 0 ? machine_fail(m, MACHINE_NO_DEVICE,
                                     "no OpenCL device is called \"%s\": `lutetia info` lists "
                                     "the %d there are",
                                     choice, count)
            : without ? no_device_on(m, without)
                      : machine_fail(m, MACHINE_NO_DEVICE,
                                     "no OpenCL device was found: install one (Debian: apt-get "
                                     "install pocl-opencl-icd)");
        free(all);
        return status;
    }
    d->platform = all[chosen].platform;
    d->id = all[chosen].id;
    snprintf(d->name, sizeof d->name, "%s", all[chosen].name);
    snprintf(d->platform_name, sizeof d->platform_name, "%s", all[chosen].platform_name);
    free(all);
    return MACHINE_OK;
}

/* What arrays may take of so much memory that the front end and other programs use, too: what
 * is available now, but for a part. */
static uint64_t memory_left(uint64_t bytes)
{
    enum { PART = 16 };
    unsigned long long kb;
    char line[128];
    FILE *file = input_file_open("/proc/meminfo", NULL);
    while (file && fgets(line, sizeof line, file))
        if (sscanf(line, "MemAvailable: %llu kB", &kb) == 1 && kb << 10 < bytes)
            bytes = kb << 10;
    if (file)
        fclose(file);
    return bytes - bytes / PART;
}

/* PoCL 7.1 compiles some kernels so that a work-group of one work-item is computed twice, and
 * crashes on others where it computes values again instead of keeping them (seen with LLVM 21).
 * It asks for these settings whenever it compiles. One that the user has made stays. */
static void pocl_keep_right(const char *driver)
{
    enum { WRONG_SINCE = 7 };
    if (atoi(driver) < WRONG_SINCE)
        return;
    setenv("POCL_WORK_GROUP_SPECIALIZATION", "0", 0);
    setenv("POCL_PREGION_VALUE_REMAT", "0", 0);
}

/* Asks the driver for the device's properties. */
static enum machine_status ask(struct machine *m)
{
    struct device *d = m->device;
    cl_device_type type = 0;
    cl_uint units = 0;
    cl_ulong memory = 0, max_alloc = 0;
    cl_device_fp_config doubles = 0, singles = 0;
    clGetDeviceInfo(d->id, CL_DEVICE_TYPE, sizeof type, &type, NULL);
    clGetDeviceInfo(d->id, CL_DEVICE_MAX_COMPUTE_UNITS, sizeof units, &units, NULL);
    clGetDeviceInfo(d->id, CL_DEVICE_GLOBAL_MEM_SIZE, sizeof memory, &memory, NULL);
    clGetDeviceInfo(d->id, CL_DEVICE_MAX_MEM_ALLOC_SIZE, sizeof max_alloc, &max_alloc, NULL);
    clGetDeviceInfo(d->id, CL_DEVICE_DOUBLE_FP_CONFIG, sizeof doubles, &doubles, NULL);
    clGetDeviceInfo(d->id, CL_DEVICE_SINGLE_FP_CONFIG, sizeof singles, &singles, NULL);
    clGetDeviceInfo(d->id, CL_DRIVER_VERSION, sizeof d->driver - 1, d->driver, NULL);
    d->is_cpu = (type & CL_DEVICE_TYPE_CPU) != 0;
    d->is_pocl = d->is_cpu && strcmp(d->platform_name, "Portable Computing Language") == 0;
    if (d->is_pocl)
        pocl_keep_right(d->driver);
    /* PoCL has a cache of its own, and would compile each program once more to return its
     * binary. */
    d->keeps_programs = m->settings.keep == SETTING_FREE ? !d->is_pocl : m->settings.keep;
    d->units = units ? (int)units : 1;
    d->crew = d->is_pocl ? crew_create(d->units) : NULL;
    const uint64_t awake = m->settings.awake;
    if (d->is_pocl && d->units > 1 && awake)
        d->awake =
            awake_create(awake == 1 || awake_is_virtual() ? LATENCY_PATH : NULL, awake == 1);
    d->memory_bytes =
        m->settings.memory != SETTING_FREE ? m->settings.memory
        : d->is_cpu ? memory_left(memory) /* the front end and others use the same memory */
                    : memory;
    if (d->is_cpu && m->settings.memory == SETTING_FREE)
        d->memory_bytes /= (uint64_t)ranks_on_node();
    d->memory_max_alloc_bytes = max_alloc;
    d->has_double = doubles != 0;
    if (!doubles)
        return machine_fail(m, MACHINE_NO_DEVICE,
                            "%s has no double precision, which the machine needs", d->name);
    d->options = singles & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT
                     ? "-cl-fp32-correctly-rounded-divide-sqrt"
                     : "";
    return MACHINE_OK;
}

static enum machine_status choose_and_open(struct machine *m,
                                           const struct machine_config *config)
{
    struct device *d = m->device;
    enum machine_status status = choose(m, config);
    code_pages_begin(&d->code);
    status = status ? status : ask(m);
    if (status)
        return status;
    tuning_apply(m, config);
    d->shape = shape_of(d, &m->settings);
    cl_int error;
    cl_device_id ids[1 + SUB_DEVICES_MOST];
    device_divide(m, (int)m->settings.blocks);
    const cl_uint ids_count = device_ids(d, ids);
    d->context = device_context(d, ids, ids_count, &error);
    if (error)
        return device_check(m, error, "a context cannot be made");
    const cl_queue_properties profiling[] = {CL_QUEUE_PROPERTIES, CL_QUEUE_PROFILING_ENABLE, 0};
    d->queue = clCreateCommandQueueWithProperties(d->context, d->id,
                                                  m->watch ? profiling : NULL, &error);
    if (error && m->watch) /* the queue is then made without profiling */
        d->queue = clCreateCommandQueueWithProperties(d->context, d->id, NULL, &error);
    if (error)
        return device_check(m, error, "a command queue cannot be made");
    chunks_begin(d);
    if (m->settings.near && device_is_ours(d))
        crew_meet(d->crew); /* else the first work that is shared out waits for them */
    return device_programs_begin(d)
               ? MACHINE_OK
               : machine_fail(m, MACHINE_NO_MEMORY, "not enough memory for the kernel cache");
}

/* Signals are blocked while the driver makes its threads, so that signals from a terminal
 * reach neither these threads nor the linkers that they run: PoCL aborts if a linker is
 * interrupted. */
enum machine_status device_open(struct machine *m, const struct machine_config *config)
{
    static _Atomic pid_t first;
    pid_t process = 0;
    if (atomic_compare_exchange_strong(&first, &process, process_now()))
        process = process_now();
    m->device->process = process;
    if (!device_is_ours(m->device) && !m->settings.near)
        m->settings.near = 1;
    sigset_t interrupt, before;
    sigemptyset(&interrupt);
    sigaddset(&interrupt, SIGINT);
    pthread_sigmask(SIG_BLOCK, &interrupt, &before);
    enum machine_status status = choose_and_open(m, config);
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return status;
}

void device_close(struct machine *m)
{
    struct device *d = m->device;
    const bool ours = device_is_ours(d);
    if (d->queue && ours)
        clFinish(d->queue);
    aside_end(&d->code);
    for (int i = 0; i < d->fences_count && ours; i++)
        clReleaseEvent(d->fences[i].reached);
    crew_destroy(d->crew);
    awake_destroy(d->awake);
    if (d->claims.memory && ours)
        clReleaseMemObject(d->claims.memory);
    device_pool_empty(d);
    free(d->pool);
    device_programs_finish(d);
    if (d->queue && ours) /* it may wait for threads */
        clReleaseCommandQueue(d->queue);
    if (d->context && ours)
        device_context_leave(d);
    device_subs_finish(d);
    chunks_finish(d);
}

const char *machine_device_name(const struct machine *m)
{
    return m->device->name;
}

const char *machine_device_driver(const struct machine *m)
{
    return m->device->driver;
}
