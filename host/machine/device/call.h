/* call.h - starts a hand-written kernel of kernels/.
 *
 *     struct kernel_call c = call_begin(m, kernel_router_cl, "-DADDRESS=uint", "claim");
 *     call_layout(&c, set);
 *     call_uint(&c, mask);
 *     call_buffer(&c, buffer);
 *     status = call_over(&c, m, set, "sending");
 *
 * Arguments are given in order. After an error the kernel is not started, and starting
 * returns the error.
 */
#ifndef LUTETIA_MACHINE_CALL_H
#define LUTETIA_MACHINE_CALL_H

#include "device/device.h"
#include "watch/watch.h"

/* Work for each work-item on a CPU: columns; physical processors. */
struct kernel_call {
    struct device_kernel
        *kernel; /* NULL after an error, which the machine's error text explains */
    cl_uint at;
    cl_int error;
    size_t bytes; /* bytes of the buffers passed so far */
};

static inline struct kernel_call call_begin(struct machine *m, const char *text,
                                            const char *options, const char *name)
{
    return (struct kernel_call){.kernel = device_library_kernel(m, text, options, name)};
}

static inline void call_argument(struct kernel_call *c, size_t size, const void *value)
{
    if (c->kernel)
        c->error |= clSetKernelArg(c->kernel->cl, c->at++, size, value);
}

static inline void call_int(struct kernel_call *c, int value)
{
    cl_int x = value;
    call_argument(c, sizeof x, &x);
}

static inline void call_uint(struct kernel_call *c, uint64_t value)
{
    cl_uint x = (cl_uint)value;
    call_argument(c, sizeof x, &x);
}

static inline void call_ulong(struct kernel_call *c, uint64_t value)
{
    call_argument(c, sizeof value, &value);
}

static inline void call_scalar(struct kernel_call *c, struct machine_scalar x)
{
    call_ulong(c, x.lo);
    call_ulong(c, x.hi);
}

static inline void call_buffer(struct kernel_call *c, const struct device_buffer *b)
{
    if (c->kernel)
        c->error |= device_argument(c->kernel->cl, c->at++, b);
    c->bytes += b->bytes;
}

/* Starts x * y, or x * y * z, work-items; on a CPU each is a group of its own. */
static inline enum machine_status call_start(struct kernel_call *c, struct machine *m, size_t x,
                                             size_t y, const char *what)
{
    size_t global[2] = {x, y};
    if (m->watch)
        watch_arrays(m, c->bytes);
    return c->kernel ? device_launch(m, c->kernel, c->error, 2, global, NULL, what) : m->status;
}

static inline enum machine_status call_start_3d(struct kernel_call *c, struct machine *m,
                                                size_t x, size_t y, size_t z, const char *what)
{
    size_t global[3] = {x, y, z};
    if (m->watch)
        watch_arrays(m, c->bytes);
    return c->kernel ? device_launch(m, c->kernel, c->error, 3, global, NULL, what) : m->status;
}

/* Columns for each work-item of call_over(); the kernel needs the number as an argument. */
static inline size_t call_run(const struct machine *m)
{
    return (size_t)m->device->shape.call_columns;
}

/* Physical processors for each work-item of call_processors(). */
static inline size_t call_processors_run(const struct machine *m)
{
    return (size_t)m->device->shape.call_processors;
}

/* The C type of an element of that many bytes in memory; 16 is a pair. */
static inline const char *call_element(size_t bytes)
{
    return bytes == 1   ? "uchar"
           : bytes == 2 ? "ushort"
           : bytes == 4 ? "uint"
           : bytes == 8 ? "ulong"
                        : "ulong2";
}

#endif
