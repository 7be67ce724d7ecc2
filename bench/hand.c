/* hand.c - runs bench/kernels/diffusion_per_axis.cl: two launches a step. */
#include "scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "diffusion_kernels.h"
#include "harness.h"
#include "opencl.h"

enum {
    MARGIN = 16, /* of the kernel */
    STRIP = 256, /* of the kernel */
    PLANES_COUNT = 9,
    ABSORBENCY = 8,
    BANDS_COUNT = 64, /* work-items that share the rows */
    PAGE_FLOATS = 1024,
    PLANE_SKEW = 7 * 16
};

struct diffusion_hand {
    struct diffusion_scene scene; /* its arrays are not ours */
    enum diffusion_shape shape;
    size_t pitch, plane; /* floats */
    struct bench_opencl cl;
    cl_program program;
    cl_kernel kernel[2]; /* along x, along y */
    cl_mem sheet;
};

static long last_cache_bytes(void)
{
    long bytes = sysconf(_SC_LEVEL3_CACHE_SIZE);
    if (bytes <= 0)
        bytes = sysconf(_SC_LEVEL2_CACHE_SIZE);
    return bytes;
}

static enum diffusion_shape shape_best(const struct diffusion_scene *s)
{
    double bytes = 5.0 * sizeof(float) * s->width * s->height;
    bool off_edges = s->x0 > 0 && s->y0 > 0 && s->x1 < s->width && s->y1 < s->height;
    return off_edges && bytes < 0.75 * (double)last_cache_bytes() ? DIFFUSION_IN_PLACE
                                                                  : DIFFUSION_STREAMING;
}

/* ---- building ---- */

static bool program_build(struct diffusion_hand *h)
{
    const struct diffusion_scene *s = &h->scene;
    const char *sources[] = {kernel_diffusion_vectors_cl, kernel_diffusion_per_axis_cl};
    char options[512];
    cl_int error;
    double bytes = 9.0 * sizeof(float) * s->width * s->height;
    snprintf(options, sizeof options,
             "-DWIDTH=%d -DHEIGHT=%d -DPITCH=%zu -DPLANE=%zu -DX0=%d -DY0=%d -DX1=%d -DY1=%d "
             "-DSTREAM_PAST_CACHES=%d",
             s->width, s->height, h->pitch, h->plane, s->x0, s->y0, s->x1, s->y1,
             bytes > (double)last_cache_bytes());
    h->program = bench_opencl_build(&h->cl, sources, 2, options);
    if (!h->program)
        return false;
    static const char *const names[][2] = {
        [DIFFUSION_IN_PLACE] = {"diffusion_x_in_place", "diffusion_y_in_place"},
        [DIFFUSION_STREAMING] = {"diffusion_x_streaming", "diffusion_y_streaming"}};
    for (int axis = 0; axis < 2; axis++) {
        int from = axis && h->shape == DIFFUSION_STREAMING ? 4 : 0, to = 4 - from;
        cl_uint n = 0;
        h->kernel[axis] = clCreateKernel(h->program, names[h->shape][axis], &error);
        if (error)
            return bench_opencl_fail("clCreateKernel", error);
        error = clSetKernelArg(h->kernel[axis], n++, sizeof h->sheet, &h->sheet);
        error |= clSetKernelArg(h->kernel[axis], n++, sizeof from, &from);
        error |= clSetKernelArg(h->kernel[axis], n++, sizeof to, &to);
        error |= clSetKernelArg(h->kernel[axis], n++, sizeof s->gravity, &s->gravity);
        for (int i = 0; i < 3; i++)
            error |=
                clSetKernelArg(h->kernel[axis], n++, sizeof(float), &s->molecular_weight[i]);
        if (error)
            return bench_opencl_fail("clSetKernelArg", error);
    }
    return true;
}

/* ---- planes ---- */

static cl_int plane_copy(struct diffusion_hand *h, size_t plane, float *host, bool write)
{
    const size_t origin[3] = {(plane * h->plane + MARGIN) * sizeof(float), 0, 0},
                 zero[3] = {0, 0, 0};
    const size_t row = (size_t)h->scene.width * sizeof(float), pitch = h->pitch * sizeof(float);
    const size_t region[3] = {row, (size_t)h->scene.height, 1};
    /* The buffer's row pitch must divide no origin: rows begin at origin[0], which may be
     * beyond one pitch. */
    size_t at[3] = {origin[0] % pitch, origin[0] / pitch, 0};
    if (write)
        return clEnqueueWriteBufferRect(h->cl.queue, h->sheet, CL_TRUE, at, zero, region, pitch,
                                        0, row, 0, host, 0, NULL, NULL);
    return clEnqueueReadBufferRect(h->cl.queue, h->sheet, CL_TRUE, at, zero, region, pitch, 0,
                                   row, 0, host, 0, NULL, NULL);
}

static bool sheet_create(struct diffusion_hand *h)
{
    const struct diffusion_scene *s = &h->scene;
    cl_int error;
    h->pitch = ((size_t)s->width + 2 * MARGIN + 15) / 16 * 16;
    if (h->pitch % PAGE_FLOATS == 0)
        h->pitch += 16;
    /* the rows that lower, upper and second read beyond the last row are inside the plane;
     * their content does not matter */
    h->plane = (h->pitch * (size_t)s->height + PAGE_FLOATS - 1) / PAGE_FLOATS * PAGE_FLOATS +
               PLANE_SKEW;
    size_t bytes = (h->plane * PLANES_COUNT + h->pitch) * sizeof(float);
    h->sheet = clCreateBuffer(h->cl.context, CL_MEM_READ_WRITE, bytes, NULL, &error);
    if (error)
        return bench_fail("hand-written kernels: no memory for a sheet of %dx%d", s->width,
                          s->height);
    const float zero = 0.0f;
    error =
        clEnqueueFillBuffer(h->cl.queue, h->sheet, &zero, sizeof zero, 0, bytes, 0, NULL, NULL);
    for (size_t i = 0; !error && i < DIFFUSION_FIELDS_COUNT; i++) {
        error = plane_copy(h, i, s->field[i], true);
        if (!error)
            error = plane_copy(h, 4 + i, s->field[i], true);
    }
    if (!error)
        error = plane_copy(h, ABSORBENCY, s->absorbency, true);
    return error ? bench_opencl_fail("writing the sheet", error) : true;
}

/* ---- what is offered ---- */

struct diffusion_hand *diffusion_hand_create(const struct diffusion_scene *s,
                                             const char *device, enum diffusion_shape shape)
{
    struct diffusion_hand *h = calloc(1, sizeof *h);
    if (!h) {
        bench_fail("no memory");
        return NULL;
    }
    h->scene = *s;
    h->shape = shape == DIFFUSION_SHAPE_BEST ? shape_best(s) : shape;
    if (bench_opencl_open(&h->cl, device) && sheet_create(h) && program_build(h))
        return h;
    diffusion_hand_destroy(h);
    return NULL;
}

void diffusion_hand_destroy(struct diffusion_hand *h)
{
    if (!h)
        return;
    for (int axis = 0; axis < 2; axis++)
        if (h->kernel[axis])
            clReleaseKernel(h->kernel[axis]);
    if (h->program)
        clReleaseProgram(h->program);
    if (h->sheet)
        clReleaseMemObject(h->sheet);
    bench_opencl_close(&h->cl);
    free(h);
}

bool diffusion_hand_steps(struct diffusion_hand *h, int steps_count)
{
    size_t rows[2] = {1, BANDS_COUNT},
           strips[2] = {1, ((size_t)h->scene.x1 + STRIP - 1) / STRIP};
    const size_t local[2] = {1, 1};
    cl_int error = CL_SUCCESS;
    for (int step = 0; step < steps_count && !error; step++)
        for (int axis = 0; axis < 2 && !error; axis++)
            error = clEnqueueNDRangeKernel(
                h->cl.queue, h->kernel[axis], 2, NULL,
                axis && h->shape == DIFFUSION_IN_PLACE ? strips : rows, local, 0, NULL, NULL);
    if (!error)
        error = clFinish(h->cl.queue);
    return error ? bench_opencl_fail("a launch", error) : true;
}

bool diffusion_hand_read(struct diffusion_hand *h, int field, float *out)
{
    cl_int error = plane_copy(h, (size_t)field, out, false);
    return error ? bench_opencl_fail("reading the sheet", error) : true;
}
