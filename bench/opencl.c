/* opencl.c - see opencl.h. */
#include "opencl.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness.h"

enum { PLATFORMS_MAX = 16, DEVICES_MAX = 64 };

bool bench_opencl_fail(const char *what, cl_int error)
{
    return bench_fail("hand-written kernels: %s failed (OpenCL error %d)", what, (int)error);
}

static bool device_choose(struct bench_opencl *cl, const char *wanted)
{
    cl_platform_id platforms[PLATFORMS_MAX];
    cl_uint platforms_count = 0;
    int index = 0;
    if (!wanted || !*wanted)
        wanted = getenv("LUTETIA_DEVICE");
    if (clGetPlatformIDs(PLATFORMS_MAX, platforms, &platforms_count) || !platforms_count)
        return bench_fail("hand-written kernels: no OpenCL platform; install pocl-opencl-icd");
    for (cl_uint p = 0; p < platforms_count && p < PLATFORMS_MAX; p++) {
        cl_device_id devices[DEVICES_MAX];
        cl_uint count = 0;
        char platform_name[128] = "";
        if (clGetDeviceIDs(platforms[p], CL_DEVICE_TYPE_ALL, DEVICES_MAX, devices, &count))
            continue;
        clGetPlatformInfo(platforms[p], CL_PLATFORM_NAME, sizeof platform_name, platform_name,
                          NULL);
        for (cl_uint d = 0; d < count && d < DEVICES_MAX; d++, index++) {
            clGetDeviceInfo(devices[d], CL_DEVICE_NAME, sizeof cl->device_name, cl->device_name,
                            NULL);
            bool fits = !wanted || !*wanted;
            if (!fits && isdigit((unsigned char)wanted[0]))
                fits = atoi(wanted) == index;
            else if (!fits)
                fits = strcasestr(cl->device_name, wanted) || strcasestr(platform_name, wanted);
            if (fits) {
                cl->device = devices[d];
                return true;
            }
        }
    }
    return bench_fail("hand-written kernels: no OpenCL device \"%s\"", wanted ? wanted : "");
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
