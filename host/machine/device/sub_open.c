/* sub_open.c - sub-devices opened, and given commands in turn with the whole device: see
 * sub_devices.h. */
#include <string.h>

#include "base/errors.h"
#include "device/chunks.h"
#include "device/sub_devices.h"

enum machine_status device_sub_open(struct machine *m, struct machine *of, int which)
{
    struct device *d = m->device;
    const struct device *whole = of->device;
    cl_uint units = 0;
    cl_int error;
    *d = (struct device){.process = whole->process,
                         .platform = whole->platform,
                         .id = whole->subs->ids[which],
                         .is_cpu = whole->is_cpu,
                         .is_pocl = whole->is_pocl,
                         .has_double = whole->has_double,
                         .keeps_programs = whole->keeps_programs,
                         .options = whole->options,
                         .memory_max_alloc_bytes = whole->memory_max_alloc_bytes,
                         .name_holders = whole->name_holders};
    memcpy(d->name, whole->name, sizeof d->name);
    memcpy(d->platform_name, whole->platform_name, sizeof d->platform_name);
    memcpy(d->driver, whole->driver, sizeof d->driver);
    clGetDeviceInfo(d->id, CL_DEVICE_MAX_COMPUTE_UNITS, sizeof units, &units, NULL);
    d->units = units ? (int)units : 1;
    d->crew = crew_create(d->units);
    d->shape = shape_of(d, &m->settings);
    d->queue = clCreateCommandQueueWithProperties(whole->context, d->id, NULL, &error);
    if (error)
        return device_check(of, error, "a command queue of a share of it cannot be made");
    d->context = whole->context;
    clRetainContext(d->context);
    chunks_begin(d);
    whole->subs->of[which] = d;
    return device_programs_begin(d)
               ? MACHINE_OK
               : machine_fail(of, MACHINE_NO_MEMORY, "not enough memory for the kernel cache");
}

void device_sub_close(struct machine *m, struct machine *of, int which)
{
    struct device *whole = of->device;
    whole->subs->of[which] = NULL;
    whole->memory_bytes = whole->subs->memory_bytes;
    device_close(m);
}

/* Each may take what is left as well as the others: memory that is free now is divided. */
static void memory_divide(const struct sub_devices *s, const struct device *d)
{
    uint64_t held = d->held_bytes + d->pool_bytes;
    for (int i = 0; i < s->count; i++)
        held += s->of[i]->held_bytes + s->of[i]->pool_bytes;
    const uint64_t left = held < s->memory_bytes ? s->memory_bytes - held : 0;
    for (int i = 0; i < s->count; i++)
        s->of[i]->memory_bytes =
            s->of[i]->held_bytes + s->of[i]->pool_bytes + left / (uint64_t)s->count;
}

enum machine_status device_subs_begin(struct machine *m)
{
    struct device *d = m->device;
    device_stays_awake(m);
    memory_divide(d->subs, d);
    return d->subs->queued ? MACHINE_OK : device_settle(m);
}

void device_subs_queued(struct machine *m)
{
    struct device *d = m->device;
    uint64_t theirs = 0;
    for (int i = 0; i < d->subs->count; i++) {
        d->subs->queued |= d->subs->of[i]->queued;
        theirs += d->subs->of[i]->held_bytes;
    }
    d->queued |= d->subs->queued;
    d->memory_bytes = theirs < d->subs->memory_bytes ? d->subs->memory_bytes - theirs : 0;
}
