/* sub_devices.c - a device divided into equal shares: see sub_devices.h. */
#include "device/sub_devices.h"

#include <stdlib.h>

void device_divide(struct machine *m, int count)
{
    struct device *d = m->device;
    if (count < 2 || count > SUB_DEVICES_MOST || !m->settings.blocks_apart ||
        !m->settings.near || m->watch || !d->is_pocl || d->units < count || !device_is_ours(d))
        return;
    cl_device_partition_property by[SUB_DEVICES_MOST + 3] = {CL_DEVICE_PARTITION_BY_COUNTS};
    for (int i = 0; i < count; i++)
        by[1 + i] = d->units * (i + 1) / count - d->units * i / count;
    by[1 + count] = CL_DEVICE_PARTITION_BY_COUNTS_LIST_END;
    struct sub_devices *s = calloc(1, sizeof *s);
    cl_uint made = 0;
    if (!s || clCreateSubDevices(d->id, by, (cl_uint)count, s->ids, &made) ||
        made != (cl_uint)count) {
        free(s);
        return;
    }
    s->count = count;
    s->memory_bytes = d->memory_bytes;
    d->subs = s;
}

int device_subs_count(const struct device *d)
{
    return d->subs ? d->subs->count : 0;
}

cl_uint device_ids(const struct device *d, cl_device_id *ids)
{
    const int count = device_subs_count(d);
    ids[0] = d->id;
    for (int i = 0; i < count; i++)
        ids[1 + i] = d->subs->ids[i];
    return (cl_uint)count + 1;
}

cl_int device_subs_wait(struct device *d)
{
    cl_int error = CL_SUCCESS;
    if (!d->subs || !d->subs->queued)
        return error;
    for (int i = 0; i < d->subs->count; i++) {
        struct device *sub = d->subs->of[i];
        if (!sub || !sub->queued)
            continue;
        const cl_int failed = clFinish(sub->queue);
        error = error ? error : failed;
        sub->queued = false;
    }
    d->subs->queued = false;
    return error;
}

void device_subs_finish(struct device *d)
{
    for (int i = 0; d->subs && i < d->subs->count && device_is_ours(d); i++)
        clReleaseDevice(d->subs->ids[i]);
    free(d->subs);
    d->subs = NULL;
}
