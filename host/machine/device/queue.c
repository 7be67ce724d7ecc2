/* queue.c - commands: starting them, waiting for them, and limiting how far the front end
 * runs ahead. */
#include <stdlib.h>
#include <string.h>

#include "base/arrays.h"
#include "device/device.h"
#include "device/far.h"
#include "watch/watch.h"

enum { PARTS_FORCED = 7 };

/* How long processors do not halt after a kernel was started; and at most, while the front end
 * waits for one. */
static const double AWAKE_S = 5e-3, AWAKE_WAITING_S = 1;

double device_wait_begin(struct machine *m)
{
    m->inside++;
    awake_for(m->device->awake, AWAKE_WAITING_S);
    return clock_s();
}

enum machine_status device_wait_end(struct machine *m, cl_int error, double start,
                                    const char *what)
{
    m->inside--;
    awake_for(m->device->awake, AWAKE_S);
    m->device->busy_s += clock_s() - start;
    if (m->watch)
        watch_waited(m, start, what);
    return device_check(m, error, what);
}

void device_stays_awake(struct machine *m)
{
    awake_for(m->device->awake, AWAKE_S);
}

int device_parts_at(const struct machine *m, double seconds, const struct crew_costs *costs)
{
    if (m->settings.near > 1)
        return PARTS_FORCED;
    return m->settings.near ? crew_parts(m->device->crew, 1e9 * seconds, costs) : 1;
}

int device_parts(const struct machine *m, double seconds)
{
    return device_parts_at(m, seconds, &m->device->shape.share);
}

/* Bytes copied, or all filled with a pattern. */
struct moving {
    char *to;
    const char *from;
    size_t bytes, pattern_bytes; /* 0: copied */
    int parts;
};
enum { MOVED_TOGETHER = 4096 };

static void part_move(void *of, int part, int worker)
{
    const struct moving *g = of;
    size_t pieces = (g->bytes + MOVED_TOGETHER - 1) / MOVED_TOGETHER,
           first = pieces * (size_t)part / (size_t)g->parts * MOVED_TOGETHER,
           end = pieces * (size_t)(part + 1) / (size_t)g->parts * MOVED_TOGETHER;
    end = end < g->bytes ? end : g->bytes;
    (void)worker;
    if (g->pattern_bytes)
        array_fill(g->to + first, g->from, g->pattern_bytes, (end - first) / g->pattern_bytes);
    else
        memcpy(g->to + first, g->from + first, end - first);
}

static void move(struct machine *m, char *to, const void *from, size_t bytes,
                 size_t pattern_bytes)
{
    struct moving g = {.to = to,
                       .from = from,
                       .bytes = bytes,
                       .pattern_bytes = pattern_bytes,
                       .parts =
                           device_parts(m, 1e-9 * m->device->shape.move_ns * (double)bytes)};
    const double start = device_work_begin(m);
    crew_run(m->device->crew, g.parts, part_move, &g);
    device_work_end(m, start);
}

void device_move(struct machine *m, void *to, const void *from, size_t bytes)
{
    move(m, to, from, bytes, 0);
}

/* The front end may look at it itself. */
static bool near(const struct machine *m, const struct device_buffer *b)
{
    return b->host && m->settings.near;
}

bool device_is_near(struct machine *m, const struct device_buffer *b)
{
    return m->settings.near && m->device->is_pocl && b && b->host && !device_settle(m);
}

/* A command of the device's own follows. */
static cl_int own_begin(struct device *d)
{
    const cl_int error = d->subs ? device_subs_wait(d) : CL_SUCCESS;
    d->queued = true;
    return error;
}

/* Where no command is on its way. */
static bool at_once(const struct machine *m, const struct device_buffer *b)
{
    return near(m, b) && !m->device->queued && !m->watch;
}

enum machine_status device_fill(struct machine *m, const struct device_buffer *b,
                                const void *pattern, size_t pattern_bytes, const char *what)
{
    if (b->rank)
        return device_far_fill(m, b, pattern, pattern_bytes);
    if (at_once(m, b)) {
        move(m, b->host, pattern, b->bytes, pattern_bytes);
        return MACHINE_OK;
    }
    if (!device_is_ours(m->device))
        return device_is_not_ours(m);
    m->inside++;
    cl_event *done = m->watch ? watch_command(m, 0) : NULL;
    cl_int error = own_begin(m->device);
    error = error ? error
                  : clEnqueueFillBuffer(m->device->queue, device_mem(b), pattern, pattern_bytes,
                                        0, b->bytes, 0, NULL, done);
    m->inside--;
    if (done)
        watch_moves(m, error, "fill", b->bytes);
    return device_check(m, error, what);
}

enum machine_status device_copy(struct machine *m, const struct device_buffer *from,
                                const struct device_buffer *to, size_t bytes, const char *what)
{
    if (from->rank)
        return device_far_copy(m, from, to, bytes);
    if (near(m, from) && at_once(m, to)) {
        move(m, to->host, from->host, bytes, 0);
        return MACHINE_OK;
    }
    if (!device_is_ours(m->device))
        return device_is_not_ours(m);
    m->inside++;
    cl_event *done = m->watch ? watch_command(m, 0) : NULL;
    cl_int error = own_begin(m->device);
    error = error ? error
                  : clEnqueueCopyBuffer(m->device->queue, device_mem(from), device_mem(to), 0,
                                        0, bytes, 0, NULL, done);
    m->inside--;
    if (done)
        watch_moves(m, error, "copy", 2 * bytes);
    return device_check(m, error, what);
}

enum machine_status device_read(struct machine *m, const struct device_buffer *b, size_t at,
                                void *to, size_t bytes, const char *what)
{
    if (b->rank)
        return device_far_read(m, b, (struct far_rows){at, bytes, bytes, 1}, to, bytes);
    if (m->watch)
        watch_bytes(m, bytes);
    if (near(m, b)) {
        enum machine_status status = device_settle_for(m, what);
        const double start = device_work_begin(m);
        if (!status)
            memcpy(to, (const char *)b->host + at, bytes);
        device_work_end(m, start);
        return status;
    }
    if (!device_is_ours(m->device))
        return device_is_not_ours(m);
    double start = device_wait_begin(m);
    cl_int error = clEnqueueReadBuffer(m->device->queue, device_mem(b), CL_TRUE, at, bytes, to,
                                       0, NULL, NULL);
    return device_wait_end(m, error, start, what);
}

enum machine_status device_write(struct machine *m, const struct device_buffer *b, size_t at,
                                 const void *from, size_t bytes, const char *what)
{
    if (b->rank)
        return device_far_write(m, b, (struct far_rows){at, bytes, bytes, 1}, from, bytes);
    if (m->watch)
        watch_bytes(m, bytes);
    if (near(m, b)) {
        enum machine_status status = device_settle_for(m, what);
        const double start = device_work_begin(m);
        if (!status)
            memcpy((char *)b->host + at, from, bytes);
        device_work_end(m, start);
        return status;
    }
    if (!device_is_ours(m->device))
        return device_is_not_ours(m);
    double start = device_wait_begin(m);
    cl_int error = clEnqueueWriteBuffer(m->device->queue, device_mem(b), CL_TRUE, at, bytes,
                                        from, 0, NULL, NULL);
    return device_wait_end(m, error, start, what);
}

void device_flush(struct machine *m)
{
    if (!device_is_ours(m->device))
        return;
    m->inside++;
    clFlush(m->device->queue);
    m->inside--;
}

enum machine_status device_settle_for(struct machine *m, const char *what)
{
    struct device *d = m->device;
    if (!d->queued && !m->watch)
        return MACHINE_OK;
    if (!device_is_ours(d))
        return device_is_not_ours(m);
    double start = device_wait_begin(m);
    cl_int error = d->subs ? device_subs_wait(d) : CL_SUCCESS;
    error = error || !d->queued ? error : clFinish(d->queue);
    d->queued = false;
    return device_wait_end(m, error, start, what);
}

enum machine_status device_settle(struct machine *m)
{
    return m->device->queued ? device_settle_for(m, "waiting for the device") : MACHINE_OK;
}

static cl_int fence_put(struct device *d)
{
    struct fence *f = &d->fences[d->fences_count];
    f->kernels = d->kernels_run;
    const cl_int error = clEnqueueMarkerWithWaitList(d->queue, 0, NULL, &f->reached);
    d->fences_count += !error;
    return error;
}

static cl_int oldest_wait(struct device *d)
{
    const cl_int error = clWaitForEvents(1, &d->fences[0].reached);
    clReleaseEvent(d->fences[0].reached);
    memmove(d->fences, d->fences + 1, (size_t)--d->fences_count * sizeof *d->fences);
    return error;
}

static bool is_ahead(const struct device *d, uint64_t kernels)
{
    return d->fences_count &&
           (d->fences_count == FENCES || d->kernels_run - d->fences[0].kernels >= kernels);
}

/* There are several fences, so that one wait is for a part of these kernels only. */
enum machine_status device_pace(struct machine *m, uint64_t ahead)
{
    struct device *d = m->device;
    const uint64_t newest = d->fences_count ? d->fences[d->fences_count - 1].kernels : 0;
    if (d->kernels_run - newest < ahead / FENCES || !device_is_ours(d))
        return MACHINE_OK;
    if (is_ahead(d, ahead)) {
        double start = device_wait_begin(m);
        cl_int error = CL_SUCCESS;
        while (!error && is_ahead(d, ahead))
            error = oldest_wait(d);
        enum machine_status status = device_wait_end(m, error, start, "waiting for the device");
        if (status)
            return status;
    }
    return device_check(m, fence_put(d), "waiting for the device");
}

enum machine_status device_launch(struct machine *m, struct device_kernel *kernel, cl_int error,
                                  cl_uint dimensions, const size_t *global, const size_t *local,
                                  const char *what)
{
    static const size_t one[3] = {1, 1, 1};
    struct device *d = m->device;
    if (!device_is_ours(d))
        return device_is_not_ours(m);
    m->inside++;
    double start = watch_clock(m);
    cl_event *done = m->watch ? watch_command(m, start) : NULL;
    error = error ? error : own_begin(d);
    awake_for(d->awake, AWAKE_S);
    if (!error)
        error = clEnqueueNDRangeKernel(d->queue, kernel->cl, dimensions, NULL, global,
                                       local       ? local
                                       : d->is_cpu ? one
                                                   : NULL,
                                       0, NULL, done);
    if (m->watch)
        watch_launched(m, error, kernel->cl, kernel->id, what);
    kernel->used = ++d->kernels_run;
    if (!kernel->started) {
        kernel->started = true;
        device_started(kernel->id);
        error = error ? error : clFinish(d->queue);
        if (m->watch)
            watch_span(m, WATCH_BUILD_FIRST, start, NULL);
    }
    m->inside--;
    return device_check(m, error, what);
}
