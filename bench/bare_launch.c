/* bare_launch.c - see bare_launch.h. */
#include "bare_launch.h"

#include "harness.h"

bool bare_launch_open(struct bare_launch *b)
{
    static const char *const text =
        "__kernel void bare(__global float *a, __global float *b, __global float *c, "
        "__global float *d, __global float *e, __global float *f, __global float *g, "
        "__global float *h, __global float *i, float j, float k, float l, float m, float n, "
        "float o, int p, int q, int r, int s, int t, int u, int v)\n"
        "{ a[get_global_id(1)] = j; }\n";
    cl_int error;
    if (!bench_opencl_open(&b->cl, NULL) ||
        !(b->program = bench_opencl_build(&b->cl, &text, 1, "")))
        return false;
    b->kernel = clCreateKernel(b->program, "bare", &error);
    if (!error)
        b->memory = clCreateBuffer(b->cl.context, CL_MEM_READ_WRITE, 4096, NULL, &error);
    return !error || bench_opencl_fail("a bare kernel", error);
}

void bare_launch_close(struct bare_launch *b)
{
    if (b->memory)
        clReleaseMemObject(b->memory);
    if (b->kernel)
        clReleaseKernel(b->kernel);
    if (b->program)
        clReleaseProgram(b->program);
    bench_opencl_close(&b->cl);
}

bool bare_launch(struct bare_launch *b, double *seconds)
{
    enum { ARRAYS = 9, NUMBERS = 13 };
    static const size_t global[2] = {1, 6}, local[2] = {1, 1};
    const float number = 1;
    double start = bench_thread_s();
    cl_int error = 0;
    for (cl_uint i = 0; i < ARRAYS; i++)
        error |= clSetKernelArg(b->kernel, i, sizeof b->memory, &b->memory);
    for (cl_uint i = 0; i < NUMBERS; i++)
        error |= clSetKernelArg(b->kernel, ARRAYS + i, sizeof number, &number);
    if (!error)
        error = clEnqueueNDRangeKernel(b->cl.queue, b->kernel, 2, NULL, global, local, 0, NULL,
                                       NULL);
    if (!error)
        error = clFlush(b->cl.queue);
    *seconds = bench_thread_s() - start;
    if (!error)
        error = clFinish(b->cl.queue);
    return !error || bench_opencl_fail("a bare kernel", error);
}
