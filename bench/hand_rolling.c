/* hand_rolling.c - runs bench/kernels/diffusion_single_pass.cl and diffusion_time_tiled.cl; see
 * rolling.h. */
#include "rolling.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "diffusion_kernels.h"
#include "harness.h"
#include "opencl.h"

struct diffusion_rolling {
    struct diffusion_scene scene; /* its arrays are not ours */
    struct rolling_layout layout;
    struct rolling_tiling tiling;
    struct bench_opencl cl;
    bool in_place; /* a single pass */
    int now;       /* the copy that holds the sheet: plane 0 or 4 */
    cl_program program;
    cl_kernel kernel;
    cl_mem sheet, scratch;
    cl_mem edges[2]; /* in place: of this step and of the next */
    size_t scratch_bytes;
};

struct argument {
    size_t size;
    const void *value;
};

#define ARGUMENT(of)                                                                           \
    {                                                                                          \
        sizeof(of), &(of)                                                                      \
    }

static bool run(struct diffusion_rolling *r, cl_kernel kernel, int items_count,
                const struct argument *arguments, size_t arguments_count)
{
    const size_t items = (size_t)items_count, alone = 1;
    cl_int error = CL_SUCCESS;
    for (cl_uint i = 0; !error && i < arguments_count; i++)
        error = clSetKernelArg(kernel, i, arguments[i].size, arguments[i].value);
    if (!error)
        error =
            clEnqueueNDRangeKernel(r->cl.queue, kernel, 1, NULL, &items, &alone, 0, NULL, NULL);
    return error ? bench_opencl_fail("a launch", error) : true;
}

static bool kernel_build(struct diffusion_rolling *r, bool relaxed)
{
    const char *sources[] = {
        kernel_diffusion_vectors_cl, kernel_diffusion_rolling_cl, kernel_diffusion_row_cl,
        r->in_place ? kernel_diffusion_single_pass_cl : kernel_diffusion_time_tiled_cl};
    char options[64];
    cl_int error;
    /* stores bypass the caches unless both copies of the sheet fit the last-level cache */
    double bytes = (double)r->layout.count * sizeof(float);
    long cache_bytes = sysconf(_SC_LEVEL3_CACHE_SIZE);
    snprintf(options, sizeof options, "-DRISES=%d -DRELAXED=%d -DPAST=%d -DABSORBENCY=%d",
             r->scene.gravity >= 1.0f, relaxed, bytes > 0.75 * (double)cache_bytes,
             r->layout.absorbency);
    r->program = bench_opencl_build(&r->cl, sources, 4, options);
    if (!r->program)
        return false;
    r->kernel = clCreateKernel(
        r->program, r->in_place ? "diffusion_single_pass" : "diffusion_time_tiled", &error);
    return error ? bench_opencl_fail("clCreateKernel", error) : true;
}

static bool sheet_create(struct diffusion_rolling *r)
{
    size_t bytes = r->layout.count * sizeof(float);
    cl_int error;
    r->sheet = clCreateBuffer(r->cl.context, CL_MEM_READ_WRITE, bytes, NULL, &error);
    float *planes = malloc(bytes);
    if (error || !planes) {
        free(planes);
        return bench_fail("hand-written kernels: no memory for a sheet of %dx%d",
                          r->scene.width, r->scene.height);
    }
    rolling_fill(&r->layout, &r->scene, planes);
    error =
        clEnqueueWriteBuffer(r->cl.queue, r->sheet, CL_TRUE, 0, bytes, planes, 0, NULL, NULL);
    free(planes);
    return error ? bench_opencl_fail("writing the sheet", error) : true;
}

static bool scratch_fit(struct diffusion_rolling *r, const struct rolling_tiling *t)
{
    size_t bytes = rolling_tile_floats(&r->layout, t) * sizeof(float) *
                   (size_t)(t->strips_count * t->bands_count);
    cl_int error;
    if (bytes <= r->scratch_bytes)
        return true;
    if (r->scratch)
        clReleaseMemObject(r->scratch);
    r->scratch_bytes = 0;
    r->scratch = clCreateBuffer(r->cl.context, CL_MEM_READ_WRITE, bytes, NULL, &error);
    if (error) {
        r->scratch = NULL;
        return bench_fail("hand-written kernels: no memory for %zu bytes of rows", bytes);
    }
    r->scratch_bytes = bytes;
    return true;
}

/* For in place: makes the buffers of the rows that bands exchange. */
static bool edges_create(struct diffusion_rolling *r)
{
    const struct rolling_layout *l = &r->layout;
    size_t bytes =
        (size_t)r->tiling.bands_count * 3 * DIFFUSION_FIELDS_COUNT * l->pitch * sizeof(float);
    const cl_long pitch = (cl_long)l->pitch, plane = (cl_long)l->plane,
                  origin = (cl_long)l->origin;
    cl_int error = CL_SUCCESS;
    for (int i = 0; !error && i < 2; i++)
        r->edges[i] = clCreateBuffer(r->cl.context, CL_MEM_READ_WRITE, bytes, NULL, &error);
    if (error)
        return bench_fail("hand-written kernels: no memory for %zu bytes of rows", bytes);
    cl_kernel kernel = clCreateKernel(r->program, "diffusion_edges", &error);
    if (error)
        return bench_opencl_fail("clCreateKernel", error);
    bool ok = true;
    for (int i = 0; ok && i < 2; i++) {
        const struct argument arguments[] = {ARGUMENT(r->sheet),   ARGUMENT(r->edges[i]),
                                             ARGUMENT(l->columns), ARGUMENT(l->height),
                                             ARGUMENT(pitch),      ARGUMENT(plane),
                                             ARGUMENT(origin)};
        ok = run(r, kernel, r->tiling.bands_count, arguments,
                 sizeof arguments / sizeof *arguments);
    }
    clReleaseKernel(kernel);
    return ok;
}

static bool single_pass(struct diffusion_rolling *r)
{
    const struct rolling_layout *l = &r->layout;
    const float *weight = r->scene.molecular_weight;
    const cl_long scratch_floats = (cl_long)rolling_tile_floats(l, &r->tiling),
                  row_floats = (cl_long)rolling_row_floats(l, &r->tiling),
                  pitch = (cl_long)l->pitch, plane = (cl_long)l->plane,
                  origin = (cl_long)l->origin;
    const struct argument arguments[] = {
        ARGUMENT(r->sheet),   ARGUMENT(r->scratch),  ARGUMENT(scratch_floats),
        ARGUMENT(row_floats), ARGUMENT(r->edges[0]), ARGUMENT(r->edges[1]),
        ARGUMENT(l->columns), ARGUMENT(l->height),   ARGUMENT(pitch),
        ARGUMENT(plane),      ARGUMENT(origin),      ARGUMENT(r->scene.gravity),
        ARGUMENT(weight[0]),  ARGUMENT(weight[1]),   ARGUMENT(weight[2])};
    bool ok = run(r, r->kernel, r->tiling.bands_count, arguments,
                  sizeof arguments / sizeof *arguments);
    cl_mem swap = r->edges[0];
    r->edges[0] = r->edges[1];
    r->edges[1] = swap;
    return ok;
}

/* From the copy at hand to the other. */
static bool time_tiled(struct diffusion_rolling *r, const struct rolling_tiling *t)
{
    const struct rolling_layout *l = &r->layout;
    const float *weight = r->scene.molecular_weight;
    if (!scratch_fit(r, t))
        return false;
    const int from = r->now, to = DIFFUSION_FIELDS_COUNT - from;
    const cl_long scratch_floats = (cl_long)rolling_tile_floats(l, t),
                  row_floats = (cl_long)rolling_row_floats(l, t), pitch = (cl_long)l->pitch,
                  plane = (cl_long)l->plane, origin = (cl_long)l->origin;
    const struct argument arguments[] = {
        ARGUMENT(r->sheet),        ARGUMENT(r->scratch),     ARGUMENT(scratch_floats),
        ARGUMENT(row_floats),      ARGUMENT(from),           ARGUMENT(to),
        ARGUMENT(l->columns),      ARGUMENT(l->height),      ARGUMENT(pitch),
        ARGUMENT(plane),           ARGUMENT(origin),         ARGUMENT(t->steps_count),
        ARGUMENT(t->strips_count), ARGUMENT(t->bands_count), ARGUMENT(r->scene.gravity),
        ARGUMENT(weight[0]),       ARGUMENT(weight[1]),      ARGUMENT(weight[2])};
    return run(r, r->kernel, t->strips_count * t->bands_count, arguments,
               sizeof arguments / sizeof *arguments);
}

static bool tune_run(void *context, const struct rolling_tiling *t)
{
    struct diffusion_rolling *r = context;
    return time_tiled(r, t) && !clFinish(r->cl.queue);
}

static bool tiling_choose(struct diffusion_rolling *r, const struct rolling_tiling *wanted)
{
    cl_uint units = 1;
    clGetDeviceInfo(r->cl.device, CL_DEVICE_MAX_COMPUTE_UNITS, sizeof units, &units, NULL);
    if (!wanted && !r->in_place)
        return rolling_tune(&r->layout, (int)units, tune_run, r, &r->tiling);
    r->tiling = wanted ? *wanted : (struct rolling_tiling){1, 1, 2 * (int)units};
    if (r->in_place) { /* one step, whole rows, two rows or more in a band */
        r->tiling.steps_count = r->tiling.strips_count = 1;
        if (r->tiling.bands_count > r->layout.height / 2)
            r->tiling.bands_count = r->layout.height / 2;
    }
    rolling_tiling_clamp(&r->tiling, &r->layout);
    return !r->in_place || (scratch_fit(r, &r->tiling) && edges_create(r));
}

struct diffusion_rolling *diffusion_rolling_create(const struct diffusion_scene *s,
                                                   const char *device,
                                                   enum diffusion_rolling_kind kind,
                                                   const struct rolling_tiling *tiling)
{
    struct diffusion_rolling *r = calloc(1, sizeof *r);
    if (!r) {
        bench_fail("no memory");
        return NULL;
    }
    r->scene = *s;
    r->in_place = kind == DIFFUSION_SINGLE_PASS || kind == DIFFUSION_SINGLE_PASS_RELAXED;
    bool relaxed =
        kind == DIFFUSION_SINGLE_PASS_RELAXED || kind == DIFFUSION_TIME_TILED_RELAXED;
    if (rolling_layout_init(&r->layout, s, r->in_place ? 1 : 2) &&
        bench_opencl_open(&r->cl, device) && sheet_create(r) && kernel_build(r, relaxed) &&
        tiling_choose(r, tiling))
        return r;
    diffusion_rolling_destroy(r);
    return NULL;
}

void diffusion_rolling_destroy(struct diffusion_rolling *r)
{
    if (!r)
        return;
    if (r->kernel)
        clReleaseKernel(r->kernel);
    if (r->program)
        clReleaseProgram(r->program);
    for (int i = 0; i < 2; i++)
        if (r->edges[i])
            clReleaseMemObject(r->edges[i]);
    if (r->scratch)
        clReleaseMemObject(r->scratch);
    if (r->sheet)
        clReleaseMemObject(r->sheet);
    bench_opencl_close(&r->cl);
    free(r);
}

bool diffusion_rolling_steps(struct diffusion_rolling *r, int steps_count)
{
    for (int left = steps_count; left > 0;) {
        struct rolling_tiling t = r->tiling;
        if (t.steps_count > left)
            t.steps_count = left;
        if (!(r->in_place ? single_pass(r) : time_tiled(r, &t)))
            return false;
        if (!r->in_place)
            r->now = DIFFUSION_FIELDS_COUNT - r->now;
        left -= t.steps_count;
    }
    cl_int error = clFinish(r->cl.queue);
    return error ? bench_opencl_fail("a launch", error) : true;
}

bool diffusion_rolling_read(struct diffusion_rolling *r, int field, float *out)
{
    size_t bytes = r->layout.plane * sizeof(float);
    float *plane = malloc(bytes);
    if (!plane)
        return bench_fail("no memory for a field of %zu bytes", bytes);
    cl_int error =
        clEnqueueReadBuffer(r->cl.queue, r->sheet, CL_TRUE, (size_t)(r->now + field) * bytes,
                            bytes, plane, 0, NULL, NULL);
    if (!error)
        rolling_read(&r->layout, &r->scene, field, plane, out);
    free(plane);
    return error ? bench_opencl_fail("reading the sheet", error) : true;
}

const struct rolling_tiling *diffusion_rolling_tiling(const struct diffusion_rolling *r)
{
    return &r->tiling;
}
