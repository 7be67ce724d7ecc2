/* opencl.h - a device, its queue and programs, for the hand-written kernels.
 *
 *     struct bench_opencl cl = {0};
 *     if (!bench_opencl_open(&cl, NULL) || !(program = bench_opencl_build(&cl, sources, 2, options)))
 *         ...bench_error()
 *     bench_opencl_close(&cl);
 *
 * Errors. Functions that can fail return false or NULL, and bench_error() says why. */
#ifndef LUTETIA_BENCH_OPENCL_H
#define LUTETIA_BENCH_OPENCL_H

#include <CL/cl.h>
#include <stdbool.h>
#include <stddef.h>

struct bench_opencl {
    char device_name[256];
    cl_device_id device;
    cl_context context;
    cl_command_queue queue;
};

/* wanted: part of a device's or its platform's name, or its index; NULL or "": LUTETIA_DEVICE,
 * else the first. On failure close it, too. */
bool bench_opencl_open(struct bench_opencl *cl, const char *wanted);
void bench_opencl_close(struct bench_opencl *cl);
/* *is_cpu: whether that device is a CPU. */
bool bench_opencl_is_cpu(const char *wanted, bool *is_cpu);
/* The build log goes to stderr if it fails. Owns: the caller. */
cl_program bench_opencl_build(const struct bench_opencl *cl, const char *const *sources,
                              int sources_count, const char *options);
/* "hand-written kernels: WHAT failed (OpenCL error N)"; false. */
bool bench_opencl_fail(const char *what, cl_int error);

#endif
