/* device.h - OpenCL: a device, its buffers, programs and queue. */
#ifndef LUTETIA_MACHINE_DEVICE_H
#define LUTETIA_MACHINE_DEVICE_H

#include <CL/cl.h>

#include "base/settings.h"
#include "device/shape.h"

/* Before and after each buffer there is so much more memory, which nobody's numbers are in: kernels in strips load
 * vectors of which some lanes are beyond a row's ends. A multiple of any device's alignment. */
enum { DEVICE_GUARD_BYTES = 4096, LINE_BYTES = 64 };

/* A buffer of so many bytes, in which the first column of the first row is so many bytes on. */
struct rows {
    size_t bytes, first;
};

struct device_buffer {
    cl_mem mem;
    size_t bytes, first; /* see struct rows */
    void *host;    /* where it is for the front end; NULL: the device has memory of its own */
    uint32_t refs; /* a buffer goes back to the pool at 0; the queue is in order, so at once */
    uint32_t mark, number; /* of the last walk that came by: run/states.c */
};

struct program_entry;

struct device {
    cl_platform_id platform;
    cl_device_id id;
    cl_context context;
    cl_command_queue queue;
    char name[256], platform_name[128], driver[128];
    bool is_cpu, has_double;
    int units; /* that compute at the same time */
    uint64_t memory_bytes, memory_max_alloc_bytes;
    struct device_shape shape;
    struct device_buffer **pool;
    int pool_count, pool_capacity;
    uint64_t pool_bytes, held_bytes;
    unsigned skew;                  /* of the next buffer's beginning */
    struct program_entry *programs; /* hash table by text: see programs.c */
    uint64_t kernels_built, kernels_built_background, kernels_run;
    double busy_s;        /* waiting for it */
    cl_kernel *unstarted; /* built, and not run yet */
    int unstarted_count, unstarted_capacity;
    const char *options;
    bool is_pocl;           /* on a CPU */
    bool queued;            /* commands that nobody has waited for may be in the queue */
    bool keeps_programs;    /* on disk */
    cl_event fence;         /* see device_pace(); NULL: none yet */
    uint64_t fence_kernels; /* run before it */
};

enum machine_status device_open(struct machine *m, const struct machine_config *config);
void device_close(struct machine *m);
struct device_shape shape_of(const struct device *d, const struct settings *s);

/* ---- check.c ---- */

enum machine_status device_check(struct machine *m, cl_int error, const char *what);

/* ---- buffers.c ---- */

struct device_buffer *device_buffer_get(struct machine *m,
                                        size_t bytes); /* refs 1; NULL: error set */

/* On CPUs the first column is where a line of the caches begins. */
struct device_buffer *device_rows_get(struct machine *m, struct rows rows);
bool device_rows_fit(const struct device_buffer *b, struct rows rows);
void device_buffer_ref(struct device_buffer *b);
void device_buffer_unref(struct machine *m, struct device_buffer *b);
void device_pool_empty(struct device *d);

/* ---- programs.c ---- */

bool device_programs_begin(struct device *d); /* false: no memory */

void device_programs_finish(struct device *d);
/* The kernel of that name in a program of these parts, all but the last the same for many; from
 * memory, from disk, or built. Belongs to the device. NULL: error set. */
enum { DEVICE_PARTS = 7 };
cl_kernel device_kernel(struct machine *m, const char *const parts[DEVICE_PARTS],
                        const char *options, const char *name);
/* The same for one that is written by hand, in a text of its own. */
cl_kernel device_library_kernel(struct machine *m, const char *text, const char *options,
                                const char *name);
/* What it is known by: its whole text, and how it is built. The caller's to free; NULL: no memory. */
char *device_kernel_key(const struct device *d, const char *const parts[DEVICE_PARTS],
                        const char *options, const char *name);
/* All options that its program is built with. And what PoCL is given: without the header of all OpenCL functions, which
 * clang reads for longer than what the machine says. It is told that it has read it, and functions.cl declares those in
 * use. The text is the caller's to free; NULL: no memory. */
enum { DEVICE_OPTIONS_BYTES = 300 };
void device_options(const struct device *d, const char *options, bool header,
                    char out[DEVICE_OPTIONS_BYTES]);
char *device_text_without_header(const char *const parts[DEVICE_PARTS]);
/* The kernel can be started in work-groups of so many items. */
bool device_takes_group(const struct device *d, cl_kernel kernel, int items);
/* It need not be built: it is in memory, or on disk. */
bool device_kernel_at_hand(struct machine *m, const char *const parts[DEVICE_PARTS],
                           const char *options, const char *name);

/* ---- queue.c ---- */

/* Starts it, unless error says that its arguments are wrong, in work-groups of that size; local NULL: the driver
 * decides, and on a CPU one is one item. The first time, waits: the compiler may still be at it in a thread of the
 * driver's, and a program that ended meanwhile would pull it down. */
enum machine_status device_launch(struct machine *m, cl_kernel kernel, cl_int error,
                                  cl_uint dimensions, const size_t *global, const size_t *local,
                                  const char *what);
/* Around a call that waits for the device, whose time counts as busy; begin gives when it began. */
double device_wait_begin(struct machine *m);
enum machine_status device_wait_end(struct machine *m, cl_int error, double start,
                                    const char *what);
/* A whole buffer becomes repetitions of the pattern; from its beginning a copy. Do not wait. */
enum machine_status device_fill(struct machine *m, const struct device_buffer *b,
                                const void *pattern, size_t pattern_bytes, const char *what);
enum machine_status device_copy(struct machine *m, const struct device_buffer *from,
                                const struct device_buffer *to, size_t bytes, const char *what);
void device_flush(struct machine *m); /* what is in the queue begins */
/* Waits until all that is in the queue is done: the front end may look at buffers (device_buffer.host) then. */
enum machine_status device_settle(struct machine *m);

/* After kernels were started: waits where the front end is so many of them ahead of the device, for each that waits in the
 * queue takes memory. */
enum machine_status device_pace(struct machine *m, uint64_t ahead);
/* It has never been started. */

void device_unstarted_add(struct device *d, cl_kernel kernel);

#endif
