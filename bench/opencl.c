/* opencl.c - see opencl.h. */
#include "opencl.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "devices.h"
#include "harness.h"

bool bench_opencl_fail(const char *what, cl_int error)
{
    return bench_fail("hand-written kernels: %s failed (OpenCL error %d)", what, (int)error);
}

static bool device_choose(struct bench_opencl *cl, const char *wanted)
{
    struct opencl_device *all = calloc(OPENCL_DEVICES_MAX, sizeof *all);
    if (!all)
        return bench_fail("hand-written kernels: no memory to list devices");
    int count = opencl_devices(all, NULL);
    int chosen = opencl_device_choose(all, count, wanted, &wanted);
    if (chosen >= 0) {
        cl->device = all[chosen].id;
        memcpy(cl->device_name, all[chosen].name, sizeof cl->device_name);
    }
    free(all);
    if (!count)
        return bench_fail("hand-written kernels: no OpenCL device; install pocl-opencl-icd");
    return chosen >= 0 ||
           bench_fail("hand-written kernels: no OpenCL device \"%s\"", wanted ? wanted : "");
}

bool bench_opencl_is_cpu(const char *wanted, bool *is_cpu)
{
    struct bench_opencl cl = {0};
    cl_device_type type = 0;
    if (!device_choose(&cl, wanted))
        return false;
    cl_int error = clGetDeviceInfo(cl.device, CL_DEVICE_TYPE, sizeof type, &type, NULL);
    *is_cpu = (type & CL_DEVICE_TYPE_CPU) != 0;
    return !error || bench_opencl_fail("clGetDeviceInfo", error);
}

bool bench_opencl_open(struct bench_opencl *cl, const char *wanted)
{
    cl_int error;
    *cl = (struct bench_opencl){0};
    if (!device_choose(cl, wanted))
        return false;
    cl->context = clCreateContext(NULL, 1, &cl->device, NULL, NULL, &error);
    if (!error)
        cl->queue = clCreateCommandQueueWithProperties(cl->context, cl->device, NULL, &error);
    return error ? bench_opencl_fail("clCreateContext", error) : true;
}

void bench_opencl_close(struct bench_opencl *cl)
{
    if (cl->queue)
        clReleaseCommandQueue(cl->queue);
    if (cl->context)
        clReleaseContext(cl->context);
    cl->queue = NULL;
    cl->context = NULL;
}

cl_program bench_opencl_build(const struct bench_opencl *cl, const char *const *sources,
                              int sources_count, const char *options)
{
    const char *text[8];
    cl_int error;
    if (sources_count > 8)
        abort();
    memcpy(text, sources, (size_t)sources_count * sizeof *text);
    cl_program program =
        clCreateProgramWithSource(cl->context, (cl_uint)sources_count, text, NULL, &error);
    if (error) {
        bench_opencl_fail("clCreateProgramWithSource", error);
        return NULL;
    }
    error = clBuildProgram(program, 1, &cl->device, options, NULL, NULL);
    if (error) {
        static char log[8192];
        clGetProgramBuildInfo(program, cl->device, CL_PROGRAM_BUILD_LOG, sizeof log, log, NULL);
        fprintf(stderr, "%s\n", log);
        clReleaseProgram(program);
        bench_opencl_fail("clBuildProgram", error);
        return NULL;
    }
    return program;
}
