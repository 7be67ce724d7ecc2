/* copies.c - measures how fast the device copies as many bytes as a kernel reads and writes.
 *
 * The copy is measured by the same clock on arrays of the kernel's size, when the
 * explanation is requested. So small arrays stay in the caches, and the copy's time includes
 * a launch, as the kernel's does.
 */
#include "measure/copies.h"

#include <stdio.h>
#include <stdlib.h>

#include "device/device.h"
#include "kernels.h"
#include "watch/watch_struct.h"

enum { MEASURED_MOST = 16, COPIES_LEAST = 5, COPIES_MOST = 25, COPY_RUN = 1024 };

#define COPIES_S 0.004
#define COPY_BYTES_MOST (UINT64_C(1) << 30)

/* Builds and starts both copy kernels (storing through and past the caches) while the
 * program begins. At its end, parts of the driver's compiler may be gone already. */
void copies_ready(struct machine *m, struct watch_sums *e)
{
    struct watch *watch = m->watch;
    m->watch = NULL; /* these commands are not the program's */
    m->inside++;
    for (int streams = 0; streams < 2; streams++) {
        char options[64];
        size_t one = 1;
        cl_ulong count = 0;
        cl_uint run = 1;
        struct device_buffer *b = device_buffer_get(m, 64);
        snprintf(options, sizeof options, "-DELEMENT=float%d -DSTREAMS=%d",
                 m->device->is_cpu ? 16 : 4, streams);
        struct device_kernel *kernel =
            b ? device_library_kernel(m, kernel_copy_cl, options, "copy") : NULL;
        cl_kernel k = kernel ? kernel->cl : NULL;
        if (k && !clSetKernelArg(k, 0, sizeof count, &count) &&
            !clSetKernelArg(k, 1, sizeof run, &run) && !device_argument(k, 2, b) &&
            !device_argument(k, 3, b) &&
            !clEnqueueNDRangeKernel(m->device->queue, k, 1, NULL, &one,
                                    m->device->is_cpu ? &one : NULL, 0, NULL, NULL) &&
            !clFinish(m->device->queue))
            e->copies[streams] = k;
        device_kernel_hold(kernel); /* until the machine ends */
        if (b)
            device_buffer_unref(m, b);
    }
    m->inside--;
    m->watch = watch;
    machine_error_clear(m); /* without copies there is no comparison */
}

static double event_s(cl_event done)
{
    cl_ulong started, ended;
    if (clGetEventProfilingInfo(done, CL_PROFILING_COMMAND_START, sizeof started, &started,
                                NULL) ||
        clGetEventProfilingInfo(done, CL_PROFILING_COMMAND_END, sizeof ended, &ended, NULL) ||
        ended <= started)
        return 0;
    return 1e-9 * (double)(ended - started);
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The median of some runs; 0: the device has no profiling. */
static double copies_s(struct machine *m, cl_kernel kernel, size_t elements, size_t run)
{
    double times[COPIES_MOST], sum = 0;
    size_t global = (elements + run - 1) / run, one = 1;
    int count = 0;
    for (int i = 0;
         i <= COPIES_MOST && count < COPIES_MOST && (count < COPIES_LEAST || sum < COPIES_S);
         i++) {
        cl_event done = NULL;
        if (clEnqueueNDRangeKernel(m->device->queue, kernel, 1, NULL, &global,
                                   m->device->is_cpu ? &one : NULL, 0, NULL, &done))
            return 0;
        cl_int error = clWaitForEvents(1, &done);
        double t = error ? 0 : event_s(done);
        clReleaseEvent(done);
        if (t <= 0)
            return 0;
        if (i == 0) /* the first run includes compiling and new memory */
            continue;
        sum += times[count++] = t;
    }
    qsort(times, (size_t)count, sizeof *times, by_value);
    return times[count / 2];
}

/* The time to read half of the bytes and write the other half; 0: unknown. */
static double copy_s(struct machine *m, const cl_kernel *kernels, uint64_t bytes)
{
    bool cpu = m->device->is_cpu;
    size_t element = cpu ? 64 : 16, elements = (size_t)(bytes / 2 + element - 1) / element;
    size_t run = cpu ? COPY_RUN : 1;
    struct device_buffer *from = device_buffer_get(m, elements * element),
                         *to = from ? device_buffer_get(m, elements * element) : NULL;
    double best = 0;
    for (int streams = 0; to && streams < 2; streams++) {
        cl_kernel kernel = kernels[streams];
        cl_ulong count = elements;
        cl_uint columns = (cl_uint)run;
        if (!kernel || clSetKernelArg(kernel, 0, sizeof count, &count) ||
            clSetKernelArg(kernel, 1, sizeof columns, &columns) ||
            device_argument(kernel, 2, from) || device_argument(kernel, 3, to))
            break;
        double t = copies_s(m, kernel, elements, run);
        best = t > 0 && (best <= 0 || t < best) ? t : best;
    }
    if (from)
        device_buffer_unref(m, from);
    if (to)
        device_buffer_unref(m, to);
    return best;
}

void copies_measure(struct machine *m, struct watch_sums *e)
{
    struct machine_explained *f = &e->facts;
    enum machine_status status = m->status;
    f->copy_bytes = 0;
    f->copy_bytes_per_s = 0;
    m->inside++;
    for (int i = 0; i < f->kernels_count && i < MEASURED_MOST; i++) {
        struct machine_explained_kernel *k = &e->kernels[i];
        uint64_t bytes = k->runs ? k->bytes / k->runs : 0;
        if (!bytes || bytes > COPY_BYTES_MOST)
            continue;
        for (int j = 0; j < i && k->copy_s <= 0; j++)
            if (e->kernels[j].runs && e->kernels[j].bytes / e->kernels[j].runs == bytes)
                k->copy_s = e->kernels[j].copy_s;
        if (k->copy_s <= 0)
            k->copy_s = copy_s(m, e->copies, bytes);
        if (k->copy_s > 0 && bytes > f->copy_bytes) {
            f->copy_bytes = bytes;
            f->copy_bytes_per_s = (double)bytes / k->copy_s;
        }
    }
    m->inside--;
    if (!status) /* running out of memory for a copy is not an error */
        machine_error_clear(m);
}
