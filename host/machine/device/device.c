/* device.c - OpenCL: which device, buffers, programs.
 *
 * Buffers. Versions of values come and go at every step, so released buffers are kept in a pool
 * by size. The queue is in order: a buffer may be used again as soon as nobody refers to it.
 * Arrays that begin at the same offset from a page disturb each other in the caches (1.5 to 2
 * times slower sweeps over large sheets), so each begins at another multiple of 128 bytes, as a
 * sub-buffer.
 *
 * Programs. A kernel is known by its whole text and options: in memory by a hash table, on disk by a file
 * of cache.c. */
#include "build/background.h"
#include "devices.h"
#include "kernels.h"
#include "watch/watch.h"

#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

enum {
    PROGRAMS_SIZE = 1024,
    LARGE_PAGE_BYTES = 2 << 20,
    SKEW_BYTES = 7 * 128,
    SKEW_PAGE_BYTES = 4096,
    SKEW_LARGE_BYTES = 64 << 10,
    POOL_BYTES_MAX = 1 << 30
};

struct program_entry {
    char *key; /* options, then text */
    cl_program program;
    cl_kernel kernel;
    struct program_entry *next;
};

static const struct {
    cl_int code;
    const char *name;
} error_names[] = {
    {CL_DEVICE_NOT_FOUND, "no such device"},
    {CL_DEVICE_NOT_AVAILABLE, "the device is not available"},
    {CL_COMPILER_NOT_AVAILABLE, "there is no compiler"},
    {CL_MEM_OBJECT_ALLOCATION_FAILURE, "not enough device memory"},
    {CL_OUT_OF_RESOURCES, "out of resources"},
    {CL_OUT_OF_HOST_MEMORY, "not enough memory"},
    {CL_BUILD_PROGRAM_FAILURE, "a kernel did not compile"},
    {CL_INVALID_VALUE, "invalid value"},
    {CL_INVALID_BUFFER_SIZE, "the buffer is too large"},
    {CL_INVALID_KERNEL_ARGS, "invalid kernel arguments"},
    {CL_INVALID_WORK_GROUP_SIZE, "invalid work-group size"},
    {-1001, "no OpenCL platform is installed (Debian: apt-get install pocl-opencl-icd)"},
};

static const char *error_name(cl_int error)
{
    for (size_t i = 0; i < sizeof error_names / sizeof *error_names; i++)
        if (error_names[i].code == error)
            return error_names[i].name;
    return "error";
}

enum machine_status device_check(struct machine *m, cl_int error, const char *what)
{
    if (error == CL_SUCCESS)
        return MACHINE_OK;
    bool memory = error == CL_MEM_OBJECT_ALLOCATION_FAILURE || error == CL_OUT_OF_HOST_MEMORY ||
                  error == CL_INVALID_BUFFER_SIZE;
    return machine_fail(m, memory ? MACHINE_NO_MEMORY : MACHINE_DEVICE_FAILED,
                        "%s: %s (OpenCL error %d on %s)", what, error_name(error), error,
                        m->device->name);
}

/* ---- choice ---- */

int machine_devices_list(void (*each)(void *context, int index, const char *platform,
                                      const char *device, const char *version,
                                      int compute_units, uint64_t memory_bytes),
                         void *context)
{
    struct opencl_device *all = calloc(OPENCL_DEVICES_MAX, sizeof *all);
    if (!all)
        return 0;
    int count = opencl_devices(all, NULL);
    for (int i = 0; i < count; i++) {
        cl_uint units = 0;
        cl_ulong memory = 0;
        clGetDeviceInfo(all[i].id, CL_DEVICE_MAX_COMPUTE_UNITS, sizeof units, &units, NULL);
        clGetDeviceInfo(all[i].id, CL_DEVICE_GLOBAL_MEM_SIZE, sizeof memory, &memory, NULL);
        each(context, i, all[i].platform_name, all[i].name, all[i].version, (int)units, memory);
    }
    free(all);
    return count;
}

/* Tiles: as many work-items as a unit of a GPU has lanes for a few times over, and local memory as GPUs have it (a
 * CPU says how large a cache is). */
enum { GROUP_USUAL = 256, GROUP_LEAST = 32, LOCAL_BYTES_CPU = 48 << 10 };

static void shape_tiles(const struct device *d, const struct settings *s,
                        struct device_shape *shape)
{
    size_t items = 0, sides[16] = {0};
    cl_ulong local = 0;
    cl_device_local_mem_type kind = CL_NONE;
    clGetDeviceInfo(d->id, CL_DEVICE_MAX_WORK_GROUP_SIZE, sizeof items, &items, NULL);
    clGetDeviceInfo(d->id, CL_DEVICE_MAX_WORK_ITEM_SIZES, sizeof sides, sides, NULL);
    items = sides[0] < items ? sides[0] : items;
    clGetDeviceInfo(d->id, CL_DEVICE_LOCAL_MEM_SIZE, sizeof local, &local, NULL);
    clGetDeviceInfo(d->id, CL_DEVICE_LOCAL_MEM_TYPE, sizeof kind, &kind, NULL);
    shape->units = d->units;
    shape->group = GROUP_USUAL;
    while (shape->group > GROUP_LEAST && (size_t)shape->group > items)
        shape->group /= 2;
    if (d->is_cpu && local > LOCAL_BYTES_CPU)
        local = LOCAL_BYTES_CPU;
    shape->local_bytes = local < (cl_ulong)INT32_MAX ? (int)local : INT32_MAX;
    /* CPUs have vectors, which are several times as fast: there tiles are for tests. So are tiles in what is called
     * local and is not. */
    bool wanted = d->is_cpu ? shape->always_strips : kind == CL_LOCAL || shape->always_strips;
    if (shape->vector > 1 || (size_t)shape->group > items || !wanted)
        shape->group = 0;
    if (s->tile != SETTING_FREE) {
        shape->tile_width = (int)(s->tile >> 16);
        shape->tile_height = (int)(s->tile & 0xffff);
    }
}

/* From public figures of large GPUs, and not measured: 1e13 operations a second, 1 TB/s, and 15 TB/s to and from local memory.
 * It is the ratios that plans follow from. */
struct device_shape device_shape_gpu(void)
{
    return (struct device_shape){.vector = 1,
                                 .op_ns = 1e-4,
                                 .byte_ns = 1e-3,
                                 .near_byte_ns = 6e-5,
                                 .launch_ns = 5000,
                                 .run_columns = 1,
                                 .strip_columns = 256,
                                 .strips_each = 3,
                                 .turns = 8,
                                 .streams = true};
}

/* What generated code should look like there, where nobody says. Costs measured with PoCL on two cores with AVX-512:
 * see docs/engine.md. A strip is so wide that a few rows of many arrays are in the caches. */
static struct device_shape shape_usual(const struct device *d)
{
    if (!d->is_cpu)
        return device_shape_gpu();
    cl_uint width = 0;
    clGetDeviceInfo(d->id, CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT, sizeof width, &width, NULL);
    return (struct device_shape){.vector = width >= 16  ? 16
                                           : width >= 8 ? 8
                                           : width >= 4 ? 4
                                                        : 1,
                                 .byte_ns = 0.022,
                                 .near_byte_ns = 0.004,
                                 .near_bytes = 512 << 10,
                                 .launch_ns = 3000,
                                 .run_columns = 4096,
                                 .strip_columns = 4096,
                                 .strips_each = 3,
                                 .turns = 8,
                                 .streams = true};
}

static int said(const struct settings *s, enum machine_knob knob, int usual)
{
    return s->knob[knob] == SETTING_FREE ? usual : (int)s->knob[knob];
}

static struct device_shape shape_of(const struct device *d, const struct settings *s)
{
    struct device_shape shape = shape_usual(d);
    shape.run_columns = said(s, MACHINE_RUN, shape.run_columns);
    shape.strip_columns = said(s, MACHINE_COLUMNS, shape.strip_columns);
    shape.strips_each = said(s, MACHINE_STRIPS_EACH, shape.strips_each);
    shape.turns = said(s, MACHINE_TURNS, shape.turns);
    shape.streams = said(s, MACHINE_STREAMS, shape.streams) != 0;
    shape.no_strips = s->strips == 0;
    shape.always_strips = s->strips == 1;
    if (d->is_cpu) {
        shape.vector = said(s, MACHINE_VECTOR, shape.vector);
        shape.halo = shape.vector > 1 ? shape.vector : 0;
        shape.narrow = shape.vector > 1 && s->narrow;
#ifdef __x86_64__ /* 0/0 is *the* NaN, and an operand that is it is the result */
        shape.keeps_nan = s->keeps_nan != 0;
#endif
        shape.op_ns = 0.064 / shape.vector;
    }
    shape_tiles(d, s, &shape);
    return shape;
}

/* PoCL has no device where it cannot make the folder that it compiles in. */
static enum machine_status no_device_on(struct machine *m, cl_platform_id platform)
{
    char name[128] = "";
    clGetPlatformInfo(platform, CL_PLATFORM_NAME, sizeof name - 1, name, NULL);
    return machine_fail(
        m, MACHINE_NO_DEVICE,
        "the OpenCL platform \"%s\" has no device; if it is PoCL: can it write in "
        "POCL_CACHE_DIR, XDG_CACHE_HOME or ~/.cache?",
        name);
}

static enum machine_status choose_and_open(struct machine *m,
                                           const struct machine_config *config)
{
    struct device *d = m->device;
    struct opencl_device *all = calloc(OPENCL_DEVICES_MAX, sizeof *all);
    if (!all)
        return machine_fail(m, MACHINE_NO_MEMORY, "not enough memory to list devices");
    cl_platform_id without;
    const char *choice;
    int count = opencl_devices(all, &without);
    int chosen = opencl_device_choose(all, count, config->device, &choice);
    if (chosen < 0) {
        enum machine_status status =
            count > 0 ? machine_fail(m, MACHINE_NO_DEVICE,
                                     "no OpenCL device is called \"%s\": `lutetia info` lists "
                                     "the %d there are",
                                     choice, count)
            : without ? no_device_on(m, without)
                      : machine_fail(m, MACHINE_NO_DEVICE,
                                     "no OpenCL device was found: install one (Debian: apt-get "
                                     "install pocl-opencl-icd)");
        free(all);
        return status;
    }
    d->platform = all[chosen].platform;
    d->id = all[chosen].id;
    snprintf(d->name, sizeof d->name, "%s", all[chosen].name);
    snprintf(d->platform_name, sizeof d->platform_name, "%s", all[chosen].platform_name);
    free(all);
    cl_device_type type = 0;
    cl_uint units = 0;
    cl_ulong memory = 0, max_alloc = 0;
    cl_device_fp_config doubles = 0, singles = 0;
    clGetDeviceInfo(d->id, CL_DEVICE_TYPE, sizeof type, &type, NULL);
    clGetDeviceInfo(d->id, CL_DEVICE_MAX_COMPUTE_UNITS, sizeof units, &units, NULL);
    clGetDeviceInfo(d->id, CL_DEVICE_GLOBAL_MEM_SIZE, sizeof memory, &memory, NULL);
    clGetDeviceInfo(d->id, CL_DEVICE_MAX_MEM_ALLOC_SIZE, sizeof max_alloc, &max_alloc, NULL);
    clGetDeviceInfo(d->id, CL_DEVICE_DOUBLE_FP_CONFIG, sizeof doubles, &doubles, NULL);
    clGetDeviceInfo(d->id, CL_DEVICE_SINGLE_FP_CONFIG, sizeof singles, &singles, NULL);
    clGetDeviceInfo(d->id, CL_DRIVER_VERSION, sizeof d->driver - 1, d->driver, NULL);
    d->is_cpu = (type & CL_DEVICE_TYPE_CPU) != 0;
    d->is_pocl = d->is_cpu && strcmp(d->platform_name, "Portable Computing Language") == 0;
    /* PoCL has a cache of its own, and would compile each program once more to give it away. */
    d->keeps_programs = m->settings.keep == SETTING_FREE ? !d->is_pocl : m->settings.keep;
    d->units = units ? (int)units : 1;
    d->memory_bytes = d->is_cpu ? memory / 2 : memory; /* the front end lives there too */
    d->memory_max_alloc_bytes = max_alloc;
    if (!doubles)
        return machine_fail(m, MACHINE_NO_DEVICE,
                            "%s has no double precision, which the machine needs", d->name);
    d->options = singles & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT
                     ? "-cl-fp32-correctly-rounded-divide-sqrt"
                     : "";
    tuning_apply(m, config);
    d->shape = shape_of(d, &m->settings);
    cl_int error;
    d->context = clCreateContext(NULL, 1, &d->id, NULL, NULL, &error);
    if (error)
        return device_check(m, error, "a context cannot be made");
    const cl_queue_properties profiling[] = {CL_QUEUE_PROPERTIES, CL_QUEUE_PROFILING_ENABLE, 0};
    d->queue = clCreateCommandQueueWithProperties(d->context, d->id,
                                                  m->watch ? profiling : NULL, &error);
    if (error && m->watch) /* then without times */
        d->queue = clCreateCommandQueueWithProperties(d->context, d->id, NULL, &error);
    if (error)
        return device_check(m, error, "a command queue cannot be made");
    d->programs = calloc(PROGRAMS_SIZE, sizeof *d->programs);
    return d->programs
               ? MACHINE_OK
               : machine_fail(m, MACHINE_NO_MEMORY, "not enough memory for the kernel cache");
}

/* The driver's threads do not take what a terminal says to the program, nor do the linkers that they run: PoCL aborts
 * when one of those is interrupted. */
enum machine_status device_open(struct machine *m, const struct machine_config *config)
{
    sigset_t interrupt, before;
    sigemptyset(&interrupt);
    sigaddset(&interrupt, SIGINT);
    pthread_sigmask(SIG_BLOCK, &interrupt, &before);
    enum machine_status status = choose_and_open(m, config);
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return status;
}

static void pool_empty(struct device *d)
{
    for (int i = 0; i < d->pool_count; i++) {
        clReleaseMemObject(d->pool[i]->mem);
        free(d->pool[i]);
    }
    d->pool_count = 0;
    d->pool_bytes = 0;
}

double device_wait_begin(struct machine *m)
{
    m->device->inside++;
    return machine_clock_s();
}

enum machine_status device_wait_end(struct machine *m, cl_int error, double start,
                                    const char *what)
{
    m->device->inside--;
    m->device->busy_s += machine_clock_s() - start;
    if (m->watch)
        watch_waited(m, start, what);
    return device_check(m, error, what);
}

enum machine_status device_fill(struct machine *m, const struct device_buffer *b,
                                const void *pattern, size_t pattern_bytes, const char *what)
{
    m->device->inside++;
    cl_event *done = m->watch ? watch_command(m, 0) : NULL;
    cl_int error = clEnqueueFillBuffer(m->device->queue, b->mem, pattern, pattern_bytes, 0,
                                       b->bytes, 0, NULL, done);
    m->device->inside--;
    if (done)
        watch_moves(m, error, "fill", b->bytes);
    return device_check(m, error, what);
}

enum machine_status device_copy(struct machine *m, const struct device_buffer *from,
                                const struct device_buffer *to, size_t bytes, const char *what)
{
    m->device->inside++;
    cl_event *done = m->watch ? watch_command(m, 0) : NULL;
    cl_int error =
        clEnqueueCopyBuffer(m->device->queue, from->mem, to->mem, 0, 0, bytes, 0, NULL, done);
    m->device->inside--;
    if (done)
        watch_moves(m, error, "copy", 2 * bytes);
    return device_check(m, error, what);
}

void device_flush(struct machine *m)
{
    m->device->inside++;
    clFlush(m->device->queue);
    m->device->inside--;
}

/* While better kernels are being built no more are put into the queue than keep the device busy: they would all be of
 * the old ones. */
enum { KERNELS_AHEAD = 256, KERNELS_AHEAD_BUILDING = 16 };

/* A fence is put behind so many kernels, and the one before it waited for. */
enum machine_status device_pace(struct machine *m)
{
    struct device *d = m->device;
    uint64_t ahead = background_busy(m) ? KERNELS_AHEAD_BUILDING : KERNELS_AHEAD;
    if (d->kernels_run - d->fence_kernels < ahead)
        return MACHINE_OK;
    cl_event reached = d->fence;
    cl_int error = clEnqueueMarkerWithWaitList(d->queue, 0, NULL, &d->fence);
    if (error)
        d->fence = NULL;
    d->fence_kernels = d->kernels_run;
    if (!reached)
        return device_check(m, error, "waiting for the device");
    double start = device_wait_begin(m);
    error |= clWaitForEvents(1, &reached);
    clReleaseEvent(reached);
    return device_wait_end(m, error, start, "waiting for the device");
}

void device_close(struct machine *m)
{
    struct device *d = m->device;
    if (d->queue)
        clFinish(d->queue);
    if (d->fence)
        clReleaseEvent(d->fence);
    pool_empty(d);
    free(d->pool);
    if (d->programs)
        for (int i = 0; i < PROGRAMS_SIZE; i++)
            for (struct program_entry *p = d->programs[i].next, *next; p; p = next) {
                next = p->next;
                clReleaseKernel(p->kernel);
                clReleaseProgram(p->program);
                free(p->key);
                free(p);
            }
    free(d->programs);
    free(d->unstarted);
    if (d->queue)
        clReleaseCommandQueue(d->queue);
    if (d->context)
        clReleaseContext(d->context);
}

/* ---- buffers ---- */

static void CL_CALLBACK memory_free(cl_mem memory, void *address)
{
    (void)memory;
    free(address);
}

/* A CPU reads and writes many rows of many arrays at the same time, each in a page of its own: large ones are in
 * large pages where the system has them, or looking for pages takes as long as computing. */
static cl_mem memory_get(const struct device *d, struct rows rows, cl_int *error)
{
    void *address;
    size_t bytes = rows.bytes, skipped = -rows.first % LINE_BYTES;
    bool large = bytes >= LARGE_PAGE_BYTES;
    if (!d->is_cpu || (!large && !skipped))
        return clCreateBuffer(d->context, CL_MEM_READ_WRITE, bytes, NULL, error);
    *error = CL_OUT_OF_HOST_MEMORY;
    if (posix_memalign(&address, large ? LARGE_PAGE_BYTES : DEVICE_GUARD_BYTES,
                       skipped + bytes))
        return NULL;
#ifdef MADV_HUGEPAGE
    madvise(address, bytes / LARGE_PAGE_BYTES * LARGE_PAGE_BYTES, MADV_HUGEPAGE);
#endif
    cl_mem memory = clCreateBuffer(d->context, CL_MEM_READ_WRITE | CL_MEM_USE_HOST_PTR, bytes,
                                   (char *)address + skipped, error);
    if (!*error)
        *error = clSetMemObjectDestructorCallback(memory, memory_free, address);
    if (!*error)
        return memory;
    if (memory)
        clReleaseMemObject(memory);
    free(address);
    return NULL;
}

/* How far behind a page's beginning the next array begins at most. Processors compare addresses by their last 12 bits first,
 * and hold back what reads where something a little before it seems to write: nine arrays in a row are 384 bytes apart
 * in this or more (sub-buffers begin at multiples of 128). And of many large ones, rows are not all in the same places
 * of a cache. */
static size_t skew_room(size_t bytes)
{
    return bytes < LARGE_PAGE_BYTES ? SKEW_PAGE_BYTES : SKEW_LARGE_BYTES;
}

struct device_buffer *device_buffer_get(struct machine *m, size_t bytes)
{
    return device_rows_get(m, (struct rows){bytes, 0});
}

bool device_rows_fit(const struct device_buffer *b, struct rows rows)
{
    return b->bytes == rows.bytes && b->first == rows.first % LINE_BYTES;
}

struct device_buffer *device_rows_get(struct machine *m, struct rows rows)
{
    struct device *d = m->device;
    size_t bytes = rows.bytes;
    rows.first %= LINE_BYTES;
    for (int i = d->pool_count - 1; i >= 0; i--)
        if (device_rows_fit(d->pool[i], rows)) {
            struct device_buffer *b = d->pool[i];
            d->pool[i] = d->pool[--d->pool_count];
            d->pool_bytes -= bytes;
            d->held_bytes += bytes;
            b->refs = 1;
            return b;
        }
    size_t whole = bytes + skew_room(bytes) + 2 * DEVICE_GUARD_BYTES;
    if (whole > d->memory_max_alloc_bytes || d->held_bytes + whole > d->memory_bytes) {
        pool_empty(d);
        machine_fail(
            m, MACHINE_NO_MEMORY,
            "%.1f MB more for one field do not fit in the memory of %s (%.0f MB, %.0f in use)",
            1e-6 * (double)whole, d->name, 1e-6 * (double)d->memory_bytes,
            1e-6 * (double)d->held_bytes);
        return NULL;
    }
    struct device_buffer *b = calloc(1, sizeof *b);
    cl_int error = CL_OUT_OF_HOST_MEMORY;
    cl_mem parent = b ? memory_get(d, (struct rows){whole, rows.first}, &error) : NULL;
    if (error && d->pool_count) {
        m->device->inside++;
        clFinish(d->queue);
        m->device->inside--;
        pool_empty(d);
        parent = b ? memory_get(d, (struct rows){whole, rows.first}, &error) : NULL;
    }
    if (!error) {
        cl_buffer_region region = {.origin = DEVICE_GUARD_BYTES +
                                             SKEW_BYTES * d->skew++ % skew_room(bytes),
                                   .size = bytes};
        b->mem = clCreateSubBuffer(parent, CL_MEM_READ_WRITE, CL_BUFFER_CREATE_TYPE_REGION,
                                   &region, &error);
        if (error) { /* an alignment that the device does not like */
            region.origin = DEVICE_GUARD_BYTES;
            b->mem = clCreateSubBuffer(parent, CL_MEM_READ_WRITE, CL_BUFFER_CREATE_TYPE_REGION,
                                       &region, &error);
        }
        clReleaseMemObject(parent); /* lives as long as the part of it does */
    }
    if (error) {
        free(b);
        device_check(m, error, "memory for a field");
        return NULL;
    }
    b->bytes = bytes;
    b->first = rows.first;
    b->refs = 1;
    d->held_bytes += bytes;
    return b;
}

void device_buffer_ref(struct device_buffer *b)
{
    b->refs++;
}

void device_buffer_unref(struct machine *m, struct device_buffer *b)
{
    struct device *d = m->device;
    if (--b->refs)
        return;
    d->held_bytes -= b->bytes;
    if (d->pool_count == d->pool_capacity) {
        int capacity = d->pool_capacity ? 2 * d->pool_capacity : 64;
        struct device_buffer **pool = realloc(d->pool, (size_t)capacity * sizeof *pool);
        if (pool) {
            d->pool = pool;
            d->pool_capacity = capacity;
        }
    }
    if (d->pool_count == d->pool_capacity || d->pool_bytes + b->bytes > POOL_BYTES_MAX) {
        clReleaseMemObject(b->mem);
        free(b);
        return;
    }
    d->pool[d->pool_count++] = b;
    d->pool_bytes += b->bytes;
}

/* ---- programs ---- */

char *device_text_without_header(const char *const parts[DEVICE_PARTS])
{
    size_t size = strlen(kernel_functions_cl) + 1;
    for (int i = 0; i < DEVICE_PARTS; i++)
        size += strlen(parts[i]);
    char *text = malloc(size), *end = text;
    if (text)
        end = stpcpy(end, kernel_functions_cl);
    for (int i = 0; i < DEVICE_PARTS && text; i++)
        end = stpcpy(end, parts[i]);
    return text;
}

/* Programs compare what they like, a number with itself, say: compilers need not tell users. */
void device_options(const struct device *d, const char *options, bool header,
                    char out[DEVICE_OPTIONS_BYTES])
{
    snprintf(out, DEVICE_OPTIONS_BYTES, "%s -w %s%s", options, d->options,
             header ? "" : " -D_OPENCL_H_");
}

/* NULL: the program needs the header after all. */
static cl_program build_without_header(const struct device *d,
                                       const char *const parts[DEVICE_PARTS],
                                       const char *options)
{
    char all_options[DEVICE_OPTIONS_BYTES];
    char *text = device_text_without_header(parts);
    const char *source = text;
    cl_int error = CL_OUT_OF_HOST_MEMORY;
    cl_program program =
        text ? clCreateProgramWithSource(d->context, 1, &source, NULL, &error) : NULL;
    free(text);
    if (error)
        return NULL;
    device_options(d, options, false, all_options);
    if (clBuildProgram(program, 1, &d->id, all_options, NULL, NULL) == CL_SUCCESS)
        return program;
    clReleaseProgram(program);
    return NULL;
}

static cl_program build(struct machine *m, const char *const parts[DEVICE_PARTS],
                        const char *own_options, const char *key)
{
    struct device *d = m->device;
    char options[DEVICE_OPTIONS_BYTES];
    double start = watch_clock(m);
    size_t size = 0;
    unsigned char *binary = d->keeps_programs ? cache_program_read(d, key, &size) : NULL;
    cl_int error = CL_SUCCESS, status = CL_SUCCESS;
    cl_program program = NULL;
    device_options(d, own_options, true, options);
    if (binary) {
        const unsigned char *data = binary;
        program =
            clCreateProgramWithBinary(d->context, 1, &d->id, &size, &data, &status, &error);
        free(binary);
        if (!error && !status &&
            clBuildProgram(program, 1, &d->id, options, NULL, NULL) == CL_SUCCESS) {
            if (m->watch)
                watch_span(m, WATCH_BUILD_LOAD, start, "\"options\":\"%s\"", options);
            return program;
        }
        if (program)
            clReleaseProgram(program);
    }
    if (d->is_pocl && (program = build_without_header(d, parts, own_options)))
        goto built;
    const char *sources[DEVICE_PARTS];
    memcpy(sources, parts, sizeof sources);
    program = clCreateProgramWithSource(d->context, DEVICE_PARTS, sources, NULL, &error);
    if (error) {
        device_check(m, error, "a program cannot be made");
        return NULL;
    }
    error = clBuildProgram(program, 1, &d->id, options, NULL, NULL);
    if (error) {
        char log[900] = "";
        clGetProgramBuildInfo(program, d->id, CL_PROGRAM_BUILD_LOG, sizeof log - 1, log, NULL);
        for (char *c = log; *c; c++)
            if (*c == '\n')
                *c = ' ';
        machine_fail(m, MACHINE_BUILD_FAILED, "a kernel did not compile on %s (%d): %s",
                     d->name, error, log);
        if (getenv("LUTETIA_DUMP"))
            fprintf(stderr, "%s\n%s\n", options, parts[DEVICE_PARTS - 1]);
        clReleaseProgram(program);
        return NULL;
    }
built:
    if (d->keeps_programs)
        cache_program_write(d, key, program);
    if (m->watch)
        watch_span(m, WATCH_BUILD, start, "\"options\":\"%s\"", options);
    return program;
}

char *device_kernel_key(const struct device *d, const char *const parts[DEVICE_PARTS],
                        const char *options, const char *name)
{
    size_t size = strlen(options) + strlen(name) + strlen(parts[DEVICE_PARTS - 1]) + 64;
    char *key = malloc(size);
    uint64_t library = CACHE_HASH_BEGIN;
    for (int i = 0; i < DEVICE_PARTS - 1; i++)
        library = cache_hash(library, parts[i]);
    if (key)
        snprintf(key, size, "%s %s\n%s %llx\n%s", options, d->options, name,
                 (unsigned long long)library, parts[DEVICE_PARTS - 1]);
    return key;
}

static struct program_entry *program_bucket(struct device *d, const char *key)
{
    return &d->programs[cache_hash(CACHE_HASH_BEGIN, key) % PROGRAMS_SIZE];
}

static cl_kernel program_find(struct device *d, const char *key)
{
    for (struct program_entry *p = program_bucket(d, key)->next; p; p = p->next)
        if (!strcmp(p->key, key))
            return p->kernel;
    return NULL;
}

static void unstarted_add(struct device *d, cl_kernel kernel)
{
    if (d->unstarted_count == d->unstarted_capacity) {
        int capacity = d->unstarted_capacity ? 2 * d->unstarted_capacity : 16;
        cl_kernel *list = realloc(d->unstarted, (size_t)capacity * sizeof(cl_kernel));
        if (!list)
            return;
        d->unstarted = list;
        d->unstarted_capacity = capacity;
    }
    d->unstarted[d->unstarted_count++] = kernel;
}

enum machine_status device_launch(struct machine *m, cl_kernel kernel, cl_int error,
                                  cl_uint dimensions, const size_t *global, const size_t *local,
                                  const char *what)
{
    static const size_t one[3] = {1, 1, 1};
    struct device *d = m->device;
    m->device->inside++;
    double start = watch_clock(m);
    cl_event *done = m->watch ? watch_command(m, start) : NULL;
    if (!error)
        error = clEnqueueNDRangeKernel(d->queue, kernel, dimensions, NULL, global,
                                       local       ? local
                                       : d->is_cpu ? one
                                                   : NULL,
                                       0, NULL, done);
    if (m->watch)
        watch_launched(m, error, kernel, what);
    d->kernels_run++;
    for (int i = 0; i < d->unstarted_count; i++)
        if (d->unstarted[i] == kernel) {
            d->unstarted[i] = d->unstarted[--d->unstarted_count];
            error = error ? error : clFinish(d->queue);
            if (m->watch)
                watch_span(m, WATCH_BUILD_FIRST, start, NULL);
            break;
        }
    m->device->inside--;
    return device_check(m, error, what);
}

bool device_takes_group(const struct device *d, cl_kernel kernel, int items)
{
    size_t most = 0;
    return !clGetKernelWorkGroupInfo(kernel, d->id, CL_KERNEL_WORK_GROUP_SIZE, sizeof most,
                                     &most, NULL) &&
           (size_t)items <= most;
}

bool device_kernel_at_hand(struct machine *m, const char *const parts[DEVICE_PARTS],
                           const char *options, const char *name)
{
    char *key = device_kernel_key(m->device, parts, options, name);
    bool found = key && (program_find(m->device, key) ||
                         (m->device->keeps_programs && cache_program_is_there(m->device, key)));
    free(key);
    return found;
}

cl_kernel device_kernel(struct machine *m, const char *const parts[DEVICE_PARTS],
                        const char *options, const char *name)
{
    struct device *d = m->device;
    char *key = device_kernel_key(d, parts, options, name);
    if (!key) {
        machine_fail(m, MACHINE_NO_MEMORY, "not enough memory for a kernel's text");
        return NULL;
    }
    cl_kernel known = program_find(d, key);
    if (known) {
        free(key);
        return known;
    }
    struct program_entry *entry = calloc(1, sizeof *entry), *bucket = program_bucket(d, key);
    cl_int error = CL_OUT_OF_HOST_MEMORY;
    m->device->inside++;
    if (entry && (entry->program = build(m, parts, options, key)))
        entry->kernel = clCreateKernel(entry->program, name, &error);
    m->device->inside--;
    if (entry && entry->program) {
        if (!error) {
            entry->key = key;
            entry->next = bucket->next;
            bucket->next = entry;
            d->kernels_built++;
            unstarted_add(d, entry->kernel);
            return entry->kernel;
        }
        device_check(m, error, "a kernel cannot be made");
        clReleaseProgram(entry->program);
    }
    free(entry);
    free(key);
    return NULL;
}

cl_kernel device_library_kernel(struct machine *m, const char *text, const char *options,
                                const char *name)
{
    const char *parts[DEVICE_PARTS];
    for (int i = 0; i < DEVICE_PARTS - 1; i++)
        parts[i] = "";
    parts[DEVICE_PARTS - 1] = text;
    return device_kernel(m, parts, options, name);
}
