/* programs.c - kernels, found by their key (disk_cache.h): in memory by a hash table, on
 * disk by a file of disk_cache.c. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/statvfs.h>

#include "base/errors.h"
#include "device/disk_cache.h"
#include "kernels.h"
#include "watch/watch.h"

enum { BUCKETS = 1024 };
#define KERNEL_ROOM_BYTES 1e6 /* the most disk space that compiling a kernel takes */

/* Of a kernel's memory, most is its program's as the compiler keeps it: a megabyte with PoCL,
 * and more where the text is long. */
enum { UNIT_TEXT_BYTES = 1 << 15 };

bool device_programs_begin(struct device *d)
{
    d->kernels = calloc(BUCKETS, sizeof(struct device_kernel *));
    return d->kernels != NULL;
}

static void kernel_free(struct device_kernel *k)
{
    clReleaseKernel(k->cl);
    clReleaseProgram(k->program);
    free(k->key);
    free(k);
}

void device_programs_finish(struct device *d)
{
    for (int i = 0; d->kernels && i < BUCKETS; i++)
        for (struct device_kernel *k = d->kernels[i], *next; k; k = next) {
            next = k->next;
            kernel_free(k);
        }
    free(d->kernels);
}

void device_kernel_hold(struct device_kernel *kernel)
{
    if (kernel)
        kernel->holders++;
}

void device_kernel_let_go(struct device_kernel *kernel)
{
    if (kernel)
        kernel->holders--;
}

bool device_kernels_are_many(const struct machine *m)
{
    const struct device *d = m->device;
    return d->kernel_units > m->settings.kernels && d->kernels_built != d->built_then;
}

static int last_used_first(const void *a, const void *b)
{
    const struct device_kernel *const *x = a, *const *y = b;
    return (*x)->used < (*y)->used ? 1 : (*x)->used > (*y)->used ? -1 : 0;
}

uint64_t device_kernels_old(const struct machine *m)
{
    const struct device *d = m->device;
    const uint64_t room = m->settings.kernels - m->settings.kernels / 4;
    struct device_kernel **all =
        calloc((size_t)d->kernel_units + 1, sizeof(struct device_kernel *));
    size_t count = 0, i = 0;
    uint64_t units = 0;
    for (int bucket = 0; all && bucket < BUCKETS; bucket++)
        for (struct device_kernel *k = d->kernels[bucket]; k; k = k->next)
            all[count++] = k;
    if (count)
        qsort(all, count, sizeof *all, last_used_first);
    while (i < count && units + all[i]->units <= room)
        units += all[i++]->units;
    const uint64_t old = i < count ? all[i]->used + 1 : 0;
    free(all);
    return old;
}

void device_kernels_forget(struct machine *m, uint64_t used_before)
{
    struct device *d = m->device;
    if (device_settle(m))
        return;
    d->built_then = d->kernels_built;
    for (int i = 0; i < BUCKETS; i++)
        for (struct device_kernel **at = &d->kernels[i], *k; (k = *at);) {
            if (k->holders || k->used >= used_before) {
                at = &k->next;
                continue;
            }
            *at = k->next;
            d->kernel_units -= k->units;
            d->kernels_gone++;
            kernel_free(k);
        }
}

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

/* Generated programs may compare a number with itself; compilers need not warn users. */
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

/* The whole log on one line, however long: a driver gives none of it to a buffer that is too
 * short. NULL: there is none. */
static char *device_build_log(cl_program program, cl_device_id id)
{
    size_t bytes = 0;
    if (clGetProgramBuildInfo(program, id, CL_PROGRAM_BUILD_LOG, 0, NULL, &bytes))
        return NULL;
    char *log = calloc(1, bytes + 1);
    if (log && clGetProgramBuildInfo(program, id, CL_PROGRAM_BUILD_LOG, bytes, log, NULL))
        log[0] = '\0';
    for (char *c = log; c && *c; c++)
        if (*c == '\n')
            *c = ' ';
    return log;
}

/* PoCL's compiler writes to its cache, and ends the process if it cannot. Returns the folder
 * if it lacks room for a kernel. */
static const char *full_folder(const struct device *d)
{
    struct statvfs room;
    const char *folder = d->is_pocl ? getenv("POCL_CACHE_DIR") : NULL;
    return folder && statvfs(folder, &room) == 0 &&
                   (double)room.f_bavail * (double)room.f_frsize < KERNEL_ROOM_BYTES
               ? folder
               : NULL;
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
    const char *full = full_folder(d);
    if (full) {
        machine_fail(m, MACHINE_BUILD_FAILED,
                     "the disk is full: there is no room to compile a kernel in %s; free some "
                     "space, or name a folder elsewhere in POCL_CACHE_DIR",
                     full);
        return NULL;
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
        char *log = device_build_log(program, d->id);
        machine_fail(m, MACHINE_BUILD_FAILED, "a kernel did not compile on %s (%d): %s",
                     d->name, error, log ? log : "");
        free(log);
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

static struct device_kernel **kernel_bucket(struct device *d, uint64_t id)
{
    return &d->kernels[id % BUCKETS];
}

static struct device_kernel *kernel_find(struct device *d, const char *key)
{
    struct device_kernel *k = *kernel_bucket(d, cache_hash(CACHE_HASH_BEGIN, key));
    while (k && strcmp(k->key, key) != 0)
        k = k->next;
    if (k)
        k->used = d->kernels_run;
    return k;
}

bool device_takes_group(const struct device *d, const struct device_kernel *kernel, int items)
{
    size_t most = 0;
    return !clGetKernelWorkGroupInfo(kernel->cl, d->id, CL_KERNEL_WORK_GROUP_SIZE, sizeof most,
                                     &most, NULL) &&
           (size_t)items <= most;
}

bool device_kernel_at_hand(struct machine *m, const char *const parts[DEVICE_PARTS],
                           const char *options, const char *name)
{
    char *key = cache_key(m->device, parts, options, name);
    bool found = key && (kernel_find(m->device, key) ||
                         (m->device->keeps_programs && cache_program_is_there(m->device, key)));
    free(key);
    return found;
}

/* Keeps the program and its kernel under the key; both arguments are the table's from now on.
 * NULL: error set. */
static struct device_kernel *program_keep(struct machine *m, cl_program program, char *key,
                                          const char *name)
{
    struct device *d = m->device;
    struct device_kernel *k = calloc(1, sizeof *k);
    cl_int error = CL_OUT_OF_HOST_MEMORY;
    cl_kernel kernel = k ? clCreateKernel(program, name, &error) : NULL;
    if (!error) {
        const uint64_t id = cache_hash(CACHE_HASH_BEGIN, key);
        struct device_kernel **bucket = kernel_bucket(d, id);
        *k = (struct device_kernel){.cl = kernel,
                                    .id = id,
                                    .used = d->kernels_run,
                                    .units = 1 + (uint32_t)(strlen(key) / UNIT_TEXT_BYTES),
                                    .key = key,
                                    .program = program,
                                    .next = *bucket};
        *bucket = k;
        d->kernel_units += k->units;
        d->kernels_built++;
        return k;
    }
    device_check(m, error, "a kernel cannot be made");
    clReleaseProgram(program);
    free(k);
    free(key);
    return NULL;
}

static char *key_of(struct machine *m, const char *const parts[DEVICE_PARTS],
                    const char *options, const char *name)
{
    char *key = cache_key(m->device, parts, options, name);
    if (!key)
        machine_fail(m, MACHINE_NO_MEMORY, "not enough memory for a kernel's text");
    return key;
}

struct device_kernel *device_kernel(struct machine *m, const char *const parts[DEVICE_PARTS],
                                    const char *options, const char *name)
{
    char *key = key_of(m, parts, options, name);
    struct device_kernel *kernel = key ? kernel_find(m->device, key) : NULL;
    if (key && !kernel && !device_is_ours(m->device)) {
        free(key);
        device_is_not_ours(m);
        return NULL;
    }
    m->inside++;
    cl_program program = key && !kernel ? build(m, parts, options, key) : NULL;
    if (program)
        kernel = program_keep(m, program, key, name);
    else
        free(key);
    m->inside--;
    return kernel;
}

cl_program device_program_build(const struct device *d, const char *const parts[DEVICE_PARTS],
                                const char *options)
{
    return d->is_pocl && !full_folder(d) ? build_without_header(d, parts, options) : NULL;
}

struct device_kernel *device_program_take(struct machine *m, cl_program program,
                                          const char *const parts[DEVICE_PARTS],
                                          const char *options, const char *name)
{
    char *key = key_of(m, parts, options, name);
    if (key)
        return program_keep(m, program, key, name);
    clReleaseProgram(program);
    return NULL;
}

struct device_kernel *device_library_kernel(struct machine *m, const char *text,
                                            const char *options, const char *name)
{
    const char *parts[DEVICE_PARTS];
    for (int i = 0; i < DEVICE_PARTS - 1; i++)
        parts[i] = "";
    parts[DEVICE_PARTS - 1] = text;
    return device_kernel(m, parts, options, name);
}
