/* many.c - see many.h. Edges are kept on the host in one array of each kind, every glyph's
 * padded, and copied when there are new ones. As many work-items as the device can run at once
 * share the glyphs. */
#include "many.h"
#include "gray_internal.h"
#include "internal.h"

#include <devices.h>
#include <kernels.h>

#include <CL/cl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PAD = 16, BUFFERS = 6 };

/* As kernels/glyphs.cl has it. */
struct device_job {
    cl_int node_first, node_count, line_first, line_count;
    cl_float ax, ay;
    cl_int width, height, pitch;
    cl_uint pixels;
};

struct kept_edges {
    int node_first, line_first;
    struct font_edges shape; /* counts and box alone */
};

struct font_many {
    cl_device_id device;
    cl_context context;
    cl_command_queue queue;
    cl_program program;
    cl_kernel kernel;
    cl_mem tables, jobs, pixels, carries;
    cl_mem edges[BUFFERS]; /* x, y, weight of nodes; x0, x1, y of lines */
    size_t jobs_bytes, pixels_bytes, carries_bytes;
    struct font_filter *filter;
    char name[200];
    float *host[BUFFERS];
    int nodes_count, lines_count, nodes_capacity, lines_capacity;
    struct kept_edges *kept;
    int kept_count, kept_capacity;
    bool edges_changed;
    struct font_gray *grays;
    struct device_job *device_jobs;
    int grays_capacity;
    uint8_t *result; /* the pixels, mapped */
    size_t workers;
    int sums; /* floats in local memory */
};

static enum font_status device_fail(cl_int error, const char *what)
{
    if (error == CL_MEM_OBJECT_ALLOCATION_FAILURE || error == CL_OUT_OF_HOST_MEMORY ||
        error == CL_INVALID_BUFFER_SIZE)
        return font_fail(FONT_NO_MEMORY, "%s: not enough memory on the device", what);
    return font_fail(FONT_DEVICE_FAILED, "%s: OpenCL error %d", what, (int)error);
}

/* ---- the device ---- */

static enum font_status device_find(struct font_many *m, const char *wanted)
{
    struct opencl_device *all = calloc(OPENCL_DEVICES_MAX, sizeof *all);
    if (!all)
        return font_fail(FONT_NO_MEMORY, "no memory to list devices");
    int chosen = opencl_device_choose(all, opencl_devices(all, NULL), wanted, &wanted);
    if (chosen >= 0) {
        m->device = all[chosen].id;
        snprintf(m->name, sizeof m->name, "%.90s (%.90s)", all[chosen].name,
                 all[chosen].platform_name);
    }
    free(all);
    if (chosen >= 0)
        return FONT_OK;
    return font_fail(FONT_NO_DEVICE,
                     "there is no OpenCL device%s%.60s; `lutetia info` lists them",
                     wanted ? " " : "", wanted ? wanted : "");
}

static enum font_status program_build(struct font_many *m)
{
    cl_int error;
    cl_ulong local = 0;
    const char *source = kernel_glyphs_cl;
    clGetDeviceInfo(m->device, CL_DEVICE_LOCAL_MEM_SIZE, sizeof local, &local, NULL);
    /* A glyph of the greatest width needs 32 rows of margin and some of its own. */
    int least = (2 * FONT_MANY_WIDTH_MAX + 80) * (2 * FONT_MARGIN_ROWS + 8);
    int sums = least;
    if (local < sizeof(float) * (size_t)least + 1024) /* such a device draws narrower ones */
        sums = (int)((local > 2048 ? local - 2048 : 0) / sizeof(float)) & ~15;
    m->sums = sums;
    char options[160];
    snprintf(options, sizeof options, "-cl-std=CL1.2 -DTAPS=%d -DTERMS=%d -DSUMS=%d",
             m->filter->taps, m->filter->terms_count, sums);
    m->context = clCreateContext(NULL, 1, &m->device, NULL, NULL, &error);
    if (error != CL_SUCCESS)
        return device_fail(error, "a context");
    m->queue = clCreateCommandQueueWithProperties(m->context, m->device, NULL, &error);
    if (error != CL_SUCCESS)
        return device_fail(error, "a queue");
    m->program = clCreateProgramWithSource(m->context, 1, &source, NULL, &error);
    if (error != CL_SUCCESS)
        return device_fail(error, "a program");
    error = clBuildProgram(m->program, 1, &m->device, options, NULL, NULL);
    if (error != CL_SUCCESS) {
        char log[300] = "";
        clGetProgramBuildInfo(m->program, m->device, CL_PROGRAM_BUILD_LOG, sizeof log - 1, log,
                              NULL);
        log[strcspn(log, "\n")] = '\0';
        return font_fail(FONT_DEVICE_FAILED, "glyphs.cl does not compile on %s: %s", m->name,
                         log);
    }
    m->kernel = clCreateKernel(m->program, "glyphs", &error);
    return error == CL_SUCCESS ? FONT_OK : device_fail(error, "a kernel");
}

enum font_status font_many_create(const char *device, const struct font_filter *filter,
                                  struct font_many **out)
{
    *out = NULL;
    struct font_many *m = calloc(1, sizeof *m);
    if (!m)
        return font_fail(FONT_NO_MEMORY, "no memory for many glyphs");
    cl_int error = CL_SUCCESS;
    enum font_status status = device_find(m, device);
    if (status == FONT_OK)
        status = font_filter_create(&filter->def, &m->filter);
    if (status == FONT_OK)
        status = program_build(m);
    if (status == FONT_OK) {
        m->tables =
            clCreateBuffer(m->context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR,
                           sizeof(float) * FONT_TERM_FLOATS * (size_t)m->filter->terms_count,
                           m->filter->tables, &error);
        if (error != CL_SUCCESS)
            status = device_fail(error, "tables");
    }
    cl_uint units = 1;
    if (status == FONT_OK)
        clGetDeviceInfo(m->device, CL_DEVICE_MAX_COMPUTE_UNITS, sizeof units, &units, NULL);
    /* PoCL hands out groups 32 at a time: so many that all threads get some, and end
     * together. */
    m->workers = 256 * (size_t)(units > 64 ? 64 : units);
    if (status == FONT_OK)
        *out = m;
    else
        font_many_destroy(m);
    return status;
}

static void buffer_release(cl_mem *buffer)
{
    if (*buffer)
        clReleaseMemObject(*buffer);
    *buffer = NULL;
}

static void result_unmap(struct font_many *m)
{
    if (m->result)
        clEnqueueUnmapMemObject(m->queue, m->pixels, m->result, 0, NULL, NULL);
    m->result = NULL;
}

void font_many_destroy(struct font_many *m)
{
    if (!m)
        return;
    if (m->queue) {
        result_unmap(m);
        clFinish(m->queue);
    }
    buffer_release(&m->tables);
    buffer_release(&m->jobs);
    buffer_release(&m->pixels);
    buffer_release(&m->carries);
    for (int i = 0; i < BUFFERS; i++) {
        buffer_release(&m->edges[i]);
        free(m->host[i]);
    }
    if (m->kernel)
        clReleaseKernel(m->kernel);
    if (m->program)
        clReleaseProgram(m->program);
    if (m->queue)
        clReleaseCommandQueue(m->queue);
    if (m->context)
        clReleaseContext(m->context);
    font_filter_destroy(m->filter);
    free(m->kept);
    free(m->grays);
    free(m->device_jobs);
    free(m);
}

const char *font_many_device(const struct font_many *m)
{
    return m->name;
}

/* ---- edges ---- */

static bool grow(float **arrays, int *capacity, int wanted)
{
    if (wanted <= *capacity)
        return true;
    int grown = *capacity ? *capacity : 4096;
    while (grown < wanted)
        grown *= 2;
    for (int i = 0; i < 3; i++) {
        float *array = realloc(arrays[i], (size_t)grown * sizeof *array);
        if (!array)
            return false;
        arrays[i] = array;
    }
    *capacity = grown;
    return true;
}

/* Copies nodes into the order in which gray_kernel.h reads them, followed by zeros. */
static void nodes_copy(float *to, const float *from, int count)
{
    int third = count / 3, at = 0;
    for (int k = 0; k < third; k++)
        for (int part = 0; part < 3; part++)
            to[at++] = from[k + part * third];
    for (int k = 3 * third; k < count; k++)
        to[at++] = from[k];
    memset(to + count, 0, PAD * sizeof *to);
}

int font_many_edges(struct font_many *m, const struct font_edges *e)
{
    if (e->arcs_count) {
        font_fail(FONT_BAD_ARGUMENT, "OpenCL draws edges of font_edges_build_tabled()");
        return -1;
    }
    if (e->nodes_count > (1 << 24) || m->nodes_count > (1 << 28) ||
        m->lines_count > (1 << 28) ||
        !array_reserve(&m->kept, &m->kept_capacity, m->kept_count + 1, sizeof *m->kept) ||
        !grow(m->host, &m->nodes_capacity, m->nodes_count + e->nodes_count + PAD) ||
        !grow(m->host + 3, &m->lines_capacity, m->lines_count + e->lines_count + PAD)) {
        font_fail(FONT_NO_MEMORY, "no memory for many glyphs");
        return -1;
    }
    struct kept_edges *k = &m->kept[m->kept_count];
    *k = (struct kept_edges){.node_first = m->nodes_count, .line_first = m->lines_count};
    k->shape = (struct font_edges){.nodes_count = e->nodes_count,
                                   .lines_count = e->lines_count,
                                   .x0 = e->x0,
                                   .y0 = e->y0,
                                   .x1 = e->x1,
                                   .y1 = e->y1};
    const float *nodes[] = {e->node_x, e->node_y, e->node_weight};
    const float *lines[] = {e->line_x0, e->line_x1, e->line_y};
    for (int i = 0; i < 3; i++) {
        if (e->nodes_count)
            nodes_copy(m->host[i] + m->nodes_count, nodes[i], e->nodes_count);
        if (e->lines_count)
            memcpy(m->host[3 + i] + m->lines_count, lines[i],
                   (size_t)e->lines_count * sizeof(float));
    }
    m->nodes_count += (e->nodes_count + PAD) / PAD * PAD;
    m->lines_count += e->lines_count;
    m->edges_changed = true;
    return m->kept_count++;
}

void font_many_edges_forget(struct font_many *m)
{
    m->kept_count = m->nodes_count = m->lines_count = 0;
    m->edges_changed = true;
}

static enum font_status edges_upload(struct font_many *m)
{
    if (!m->edges_changed)
        return FONT_OK;
    for (int i = 0; i < BUFFERS; i++) {
        cl_int error;
        size_t count = (size_t)(i < 3 ? m->nodes_count : m->lines_count) + PAD;
        buffer_release(&m->edges[i]);
        m->edges[i] =
            clCreateBuffer(m->context, CL_MEM_READ_ONLY, count * sizeof(float), NULL, &error);
        if (error == CL_SUCCESS && count > PAD)
            error =
                clEnqueueWriteBuffer(m->queue, m->edges[i], CL_TRUE, 0,
                                     (count - PAD) * sizeof(float), m->host[i], 0, NULL, NULL);
        if (error != CL_SUCCESS)
            return device_fail(error, "edges");
    }
    m->edges_changed = false;
    return FONT_OK;
}

/* ---- drawing ---- */

static enum font_status buffer_reserve(struct font_many *m, cl_mem *buffer, size_t *have,
                                       size_t bytes, cl_mem_flags flags)
{
    cl_int error;
    if (bytes <= *have)
        return FONT_OK;
    buffer_release(buffer);
    *have = 0;
    *buffer = clCreateBuffer(m->context, flags, bytes + bytes / 4, NULL, &error);
    if (error != CL_SUCCESS)
        return device_fail(error, "a buffer");
    *have = bytes + bytes / 4;
    return FONT_OK;
}

static enum font_status jobs_place(struct font_many *m, const struct font_many_job *jobs,
                                   int count, size_t *pixels_bytes, int *widest)
{
    size_t pixels = 0;
    *widest = 16;
    for (int i = 0; i < count; i++) {
        if (jobs[i].edges < 0 || jobs[i].edges >= m->kept_count)
            return font_fail(FONT_BAD_ARGUMENT, "there are no edges %d", jobs[i].edges);
        const struct kept_edges *k = &m->kept[jobs[i].edges];
        struct font_gray *gray = &m->grays[i];
        struct device_job *job = &m->device_jobs[i];
        float ax, ay;
        enum font_status status = font_gray_place_at(gray, &k->shape, m->filter, jobs[i].x_px,
                                                     jobs[i].y_px, &ax, &ay);
        if (status != FONT_OK)
            return status;
        /* As glyphs.cl has it: margins and at least a row must fit local memory. */
        int stride = m->filter->taps > 5 ? gray->pitch + 16
                     : gray->pitch == 16 ? 48
                                         : 2 * gray->pitch + 48;
        if (gray->width_px > FONT_MANY_WIDTH_MAX || m->sums / stride <= 2 * FONT_MARGIN_ROWS)
            return font_fail(FONT_TOO_LARGE,
                             "a glyph %d pixels wide is too wide for %s; draw it by itself",
                             gray->width_px, m->name);
        *job = (struct device_job){
            k->node_first,  k->shape.nodes_count, k->line_first, k->shape.lines_count, ax, ay,
            gray->width_px, gray->height_px,      gray->pitch,   (cl_uint)pixels};
        *widest = gray->pitch > *widest ? gray->pitch : *widest;
        pixels += (size_t)gray->pitch * (size_t)gray->height_px;
        if (pixels > 1u << 31)
            return font_fail(FONT_TOO_LARGE, "so many glyphs at once take over 2 GB of pixels");
    }
    *pixels_bytes = pixels ? pixels : 16;
    return FONT_OK;
}

static enum font_status jobs_run(struct font_many *m, int count, size_t pixels_bytes,
                                 int widest)
{
    enum font_status status = edges_upload(m);
    size_t jobs_bytes = (size_t)count * sizeof *m->device_jobs;
    size_t carry = (size_t)widest + 16;
    if (status == FONT_OK)
        status = buffer_reserve(m, &m->jobs, &m->jobs_bytes, jobs_bytes, CL_MEM_READ_ONLY);
    if (status == FONT_OK)
        status = buffer_reserve(m, &m->pixels, &m->pixels_bytes, pixels_bytes,
                                CL_MEM_WRITE_ONLY | CL_MEM_ALLOC_HOST_PTR);
    if (status == FONT_OK)
        status = buffer_reserve(m, &m->carries, &m->carries_bytes,
                                m->workers * carry * sizeof(float), CL_MEM_READ_WRITE);
    if (status != FONT_OK)
        return status;
    cl_int jobs_count = count, carry_floats = (cl_int)carry, error;
    error = clEnqueueWriteBuffer(m->queue, m->jobs, CL_FALSE, 0, jobs_bytes, m->device_jobs, 0,
                                 NULL, NULL);
    cl_uint at = 0;
    error |= clSetKernelArg(m->kernel, at++, sizeof m->tables, &m->tables);
    for (int i = 0; i < BUFFERS; i++)
        error |= clSetKernelArg(m->kernel, at++, sizeof m->edges[i], &m->edges[i]);
    error |= clSetKernelArg(m->kernel, at++, sizeof m->jobs, &m->jobs);
    error |= clSetKernelArg(m->kernel, at++, sizeof jobs_count, &jobs_count);
    error |= clSetKernelArg(m->kernel, at++, sizeof m->pixels, &m->pixels);
    error |= clSetKernelArg(m->kernel, at++, sizeof m->carries, &m->carries);
    error |= clSetKernelArg(m->kernel, at++, sizeof carry_floats, &carry_floats);
    size_t one = 1;
    if (error == CL_SUCCESS)
        error = clEnqueueNDRangeKernel(m->queue, m->kernel, 1, NULL, &m->workers, &one, 0, NULL,
                                       NULL);
    if (error == CL_SUCCESS)
        m->result = clEnqueueMapBuffer(m->queue, m->pixels, CL_TRUE, CL_MAP_READ, 0,
                                       pixels_bytes, 0, NULL, NULL, &error);
    return error == CL_SUCCESS ? FONT_OK : device_fail(error, "glyphs");
}

enum font_status font_many_draw(struct font_many *m, const struct font_many_job *jobs,
                                int count, const struct font_gray **grays)
{
    *grays = NULL;
    if (count < 0)
        return font_fail(FONT_BAD_ARGUMENT, "there cannot be %d glyphs", count);
    result_unmap(m);
    if (count > m->grays_capacity) {
        free(m->grays);
        free(m->device_jobs);
        m->grays = calloc((size_t)count, sizeof *m->grays);
        m->device_jobs = calloc((size_t)count, sizeof *m->device_jobs);
        m->grays_capacity = m->grays && m->device_jobs ? count : 0;
        if (!m->grays_capacity)
            return font_fail(FONT_NO_MEMORY, "no memory for %d glyphs", count);
    }
    size_t pixels_bytes = 0;
    int widest = 0;
    enum font_status status = jobs_place(m, jobs, count, &pixels_bytes, &widest);
    if (status == FONT_OK && count)
        status = jobs_run(m, count, pixels_bytes, widest);
    for (int i = 0; i < count && status == FONT_OK; i++)
        m->grays[i].pixels = m->grays[i].width_px ? m->result + m->device_jobs[i].pixels : NULL;
    *grays = status == FONT_OK ? m->grays : NULL;
    return status;
}
