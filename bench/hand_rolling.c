/* hand_rolling.c - runs kernels/diffusion_single_pass.cl and diffusion_time_tiled.cl; see
 * rolling.h. */
#include "rolling.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "harness.h"
#include "kernels.h"
#include "opencl.h"

struct diffusion_rolling {
    struct diffusion_scene scene; /* its arrays are not ours */
    struct rolling_layout layout;
    struct rolling_tiling tiling;
    struct bench_opencl cl;
    int steps_max; /* at a time */
    int now;       /* the copy that holds the sheet: plane 0 or 4 */
    cl_program program;
    cl_kernel kernel;
    cl_mem sheet, scratch;
    size_t scratch_bytes;
};

static bool kernel_build(struct diffusion_rolling *r, enum diffusion_rolling_kind kind)
{
    bool single = kind == DIFFUSION_SINGLE_PASS || kind == DIFFUSION_SINGLE_PASS_RELAXED;
    bool relaxed =
        kind == DIFFUSION_SINGLE_PASS_RELAXED || kind == DIFFUSION_TIME_TILED_RELAXED;
    const char *sources[] = {kernel_diffusion_rolling_cl, single
                                                              ? kernel_diffusion_single_pass_cl
                                                              : kernel_diffusion_time_tiled_cl};
    char options[64];
    cl_int error;
    /* Only a sheet of which both copies stay in the last cache is not written past it. */
    double bytes = (double)r->layout.count * sizeof(float);
    long cache_bytes = sysconf(_SC_LEVEL3_CACHE_SIZE);
    snprintf(options, sizeof options, "-DRISES=%d -DRELAXED=%d -DPAST=%d",
             r->scene.gravity >= 1.0f, relaxed, bytes > 0.75 * (double)cache_bytes);
    r->program = bench_opencl_build(&r->cl, sources, 2, options);
    if (!r->program)
        return false;
    r->kernel = clCreateKernel(
        r->program, single ? "diffusion_single_pass" : "diffusion_time_tiled", &error);
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

/* From the copy at hand to the other. */
static bool launch(struct diffusion_rolling *r, const struct rolling_tiling *t)
{
    const struct rolling_layout *l = &r->layout;
    const struct diffusion_scene *s = &r->scene;
    if (!scratch_fit(r, t))
        return false;
    const int from = r->now, to = DIFFUSION_FIELDS_COUNT - from;
    const cl_long scratch_floats = (cl_long)rolling_tile_floats(l, t),
                  row_floats = (cl_long)rolling_row_floats(l, t), pitch = (cl_long)l->pitch,
                  plane = (cl_long)l->plane, origin = (cl_long)l->origin;
    const struct {
        size_t size;
        const void *value;
    } arguments[] = {
        {sizeof r->sheet, &r->sheet},
        {sizeof r->scratch, &r->scratch},
        {sizeof scratch_floats, &scratch_floats},
        {sizeof row_floats, &row_floats},
        {sizeof from, &from},
        {sizeof to, &to},
        {sizeof l->columns, &l->columns},
        {sizeof l->height, &l->height},
        {sizeof pitch, &pitch},
        {sizeof plane, &plane},
        {sizeof origin, &origin},
        {sizeof t->steps_count, &t->steps_count},
        {sizeof t->strips_count, &t->strips_count},
        {sizeof t->bands_count, &t->bands_count},
        {sizeof s->gravity, &s->gravity},
        {sizeof(float), &s->molecular_weight[0]},
        {sizeof(float), &s->molecular_weight[1]},
        {sizeof(float), &s->molecular_weight[2]},
    };
    const size_t tiles = (size_t)(t->strips_count * t->bands_count), alone = 1;
    cl_int error = CL_SUCCESS;
    for (cl_uint i = 0; !error && i < sizeof arguments / sizeof *arguments; i++)
        error = clSetKernelArg(r->kernel, i, arguments[i].size, arguments[i].value);
    if (!error)
        error = clEnqueueNDRangeKernel(r->cl.queue, r->kernel, 1, NULL, &tiles, &alone, 0, NULL,
                                       NULL);
    return error ? bench_opencl_fail("a launch", error) : true;
}

static bool tune_run(void *context, const struct rolling_tiling *t)
{
    struct diffusion_rolling *r = context;
    return launch(r, t) && !clFinish(r->cl.queue);
}

static bool tiling_choose(struct diffusion_rolling *r, const struct rolling_tiling *tiling)
{
    cl_uint units = 1;
    if (tiling) {
        r->tiling = *tiling;
        if (r->tiling.steps_count > r->steps_max)
            r->tiling.steps_count = r->steps_max;
        rolling_tiling_clamp(&r->tiling, &r->layout);
        return true;
    }
    clGetDeviceInfo(r->cl.device, CL_DEVICE_MAX_COMPUTE_UNITS, sizeof units, &units, NULL);
    return rolling_tune(&r->layout, r->steps_max, (int)units, tune_run, r, &r->tiling);
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
    r->steps_max = kind == DIFFUSION_SINGLE_PASS || kind == DIFFUSION_SINGLE_PASS_RELAXED
                       ? 1
                       : ROLLING_STEPS_MAX;
    if (rolling_layout_init(&r->layout, s) && bench_opencl_open(&r->cl, device) &&
        sheet_create(r) && kernel_build(r, kind) && tiling_choose(r, tiling))
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
        if (!launch(r, &t))
            return false;
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
