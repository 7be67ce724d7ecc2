/* copy.c - see copy.h. */
#include "copy.h"

#include <stdlib.h>
#include <string.h>

#include "opencl.h"

typedef float vector __attribute__((vector_size(64)));

static void copy_pass(float *restrict to, const float *restrict from, size_t count)
{
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < count; i += 16) {
#if defined(__clang__)
        __builtin_nontemporal_store(*(const vector *)(from + i), (vector *)(to + i));
#elif defined(__AVX512F__)
        __builtin_ia32_movntps512(to + i, *(const vector *)(from + i));
#elif defined(__AVX__)
        typedef float half_vector __attribute__((vector_size(32)));
        __builtin_ia32_movntps256(to + i, *(const half_vector *)(from + i));
        __builtin_ia32_movntps256(to + i + 8, *(const half_vector *)(from + i + 8));
#else
        *(vector *)(to + i) = *(const vector *)(from + i);
#endif
    }
}

struct bench_copy {
    size_t count; /* floats */
    float *from, *to;
    struct bench_opencl cl; /* of a device with memory of its own; else nothing is open */
    cl_mem device_from, device_to;
};

static bool host_begin(struct bench_copy *c)
{
    const size_t bytes = (c->count * sizeof(float) + 4095) / 4096 * 4096;
    c->from = aligned_alloc(4096, bytes);
    c->to = aligned_alloc(4096, bytes);
    if (!c->from || !c->to)
        return bench_fail("no memory for two arrays of %zu bytes", bytes);
    memset(c->from, 0, bytes);
    memset(c->to, 0, bytes);
    return true;
}

static bool device_begin(struct bench_copy *c)
{
    const float zero = 0;
    const size_t bytes = c->count * sizeof zero;
    cl_int error, other;
    if (!bench_opencl_open(&c->cl, NULL))
        return false;
    c->device_from = clCreateBuffer(c->cl.context, CL_MEM_READ_WRITE, bytes, NULL, &error);
    c->device_to = clCreateBuffer(c->cl.context, CL_MEM_READ_WRITE, bytes, NULL, &other);
    error = error ? error : other;
    if (!error)
        error = clEnqueueFillBuffer(c->cl.queue, c->device_from, &zero, sizeof zero, 0, bytes,
                                    0, NULL, NULL);
    if (!error)
        error = clFinish(c->cl.queue);
    return !error || bench_opencl_fail("two arrays to copy", error);
}

struct bench_copy *bench_copy_create(size_t bytes)
{
    struct bench_copy *c = calloc(1, sizeof *c);
    bool is_cpu = true;
    bytes = bench_quick && bytes > 1 << 20 ? 1 << 20 : bytes;
    if (!c) {
        bench_fail("no memory for two arrays of %zu bytes", bytes);
        return NULL;
    }
    c->count = bytes / sizeof(float) / 16 * 16;
    if (bench_opencl_is_cpu(NULL, &is_cpu) && (is_cpu ? host_begin(c) : device_begin(c)))
        return c;
    bench_copy_destroy(c);
    return NULL;
}

void bench_copy_destroy(struct bench_copy *c)
{
    if (c) {
        free(c->from);
        free(c->to);
        if (c->device_from)
            clReleaseMemObject(c->device_from);
        if (c->device_to)
            clReleaseMemObject(c->device_to);
        bench_opencl_close(&c->cl);
    }
    free(c);
}

bool bench_copy_work(void *context)
{
    struct bench_copy *c = context;
    if (c->from) {
        copy_pass(c->to, c->from, c->count);
        return true;
    }
    cl_int error = clEnqueueCopyBuffer(c->cl.queue, c->device_from, c->device_to, 0, 0,
                                       c->count * sizeof(float), 0, NULL, NULL);
    if (!error)
        error = clFinish(c->cl.queue);
    return !error || bench_opencl_fail("a copy", error);
}

struct bench_sample bench_copy_rate(const struct bench_copy *c, struct bench_sample seconds)
{
    double gigabytes = 2e-9 * (double)(c->count * sizeof(float));
    return (struct bench_sample){gigabytes / seconds.median, gigabytes / seconds.min};
}
