/* device.h - OpenCL: a device, its buffers, programs and queue. */
#ifndef LUTETIA_MACHINE_DEVICE_H
#define LUTETIA_MACHINE_DEVICE_H

#include <CL/cl.h>

#include "base/aside.h"
#include "base/awake.h"
#include "base/clock.h"
#include "base/crew.h"
#include "base/parts.h"
#include "base/process.h"
#include "base/settings.h"
#include "device/shape.h"

/* Each buffer has this much unused memory before and after it, because kernels in strips
 * load vectors that partly lie beyond a row's ends. A multiple of any device's alignment. */
enum { DEVICE_GUARD_BYTES = PAGE_BYTES, CHUNKS_AHEAD = 6 };

/* The size of a buffer, and the offset of its first row's first column, in bytes. */
struct rows {
    size_t bytes, first;
};

struct chunk;

/* In the queue, between as many kernels as the front end may be ahead. */
enum { FENCES = 4 };

/* What commands are given. */
struct device_memory {
    cl_mem mem;          /* NULL: no command has needed it yet */
    struct chunk *chunk; /* that it is a part of; NULL: it has memory of its own */
};

struct array_blocks;

struct device_buffer {
    struct device_memory *memory; /* NULL: it is in blocks only, or in another rank */
    size_t bytes, first;          /* see struct rows */
    void *host; /* where it is for the front end; NULL: the device has memory of its own */
    struct device *home; /* whose pool it goes back to; NULL: it is in blocks only */
    uint32_t refs; /* a buffer goes back to the pool at 0; the queue is in order, so at once */
    bool fresh;    /* no byte code has written it yet, so its memory may be in no cache */
    /* from what another array holds: a state cannot take another one for it
     * (known_places_keep()) */
    bool follows;
    uint32_t mark, number;       /* of the last walk that came by: run/states.c */
    struct array_blocks *blocks; /* NULL: it is in one piece */
    int rank;                    /* who has it in memory; 0: this process. And what it is */
    uint32_t far;                /* called there: far.h */
};

/* An array in blocks: sequencers/. */
struct array_blocks {
    struct device_buffer
        *whole; /* whose memory an array has that was in blocks only; else NULL */
    bool only;  /* it was made in blocks */
    struct machine_type type;
    size_t element;
    int set, count;
    int valid; /* ghost planes on each side */
    struct device_buffer *of[];
};

/* A kernel in memory, with its program. It stays while somebody holds it, and else until there
 * are too many: programs.c. */
struct device_kernel {
    cl_kernel cl;
    uint64_t id;   /* a hash of its key: the same when it has gone and comes back */
    uint64_t used; /* kernels started by then, when it was last asked for or started */
    uint32_t units, holders;
    bool started; /* it has been, once */
    char *key;    /* cache_key() */
    cl_program program;
    struct device_kernel *next;
};

/* Equal shares of a device's compute units, in its context: sub_devices.c. */
struct sub_devices;

struct device {
    pid_t process; /* that first opened a device, so the driver's threads are there */
    cl_platform_id platform;
    cl_device_id id;
    cl_context context;
    cl_command_queue queue;
    char name[256], platform_name[128], driver[128];
    bool is_cpu, has_double;
    int units; /* compute units */
    uint64_t memory_bytes, memory_max_alloc_bytes;
    struct device_shape shape;
    struct device_buffer **pool;
    int pool_count, pool_capacity;
    uint64_t pool_bytes, held_bytes;
    uint64_t peak_bytes, largest_bytes; /* the most that was held; of one array */
    /* Called when memory is short: whether some has become free. NULL: nothing can. And the
     * names of what holds most, for the message. */
    bool (*make_room)(struct machine *m);
    void (*name_holders)(const struct machine *m, char *out, size_t size);
    struct chunk *small, *middle, *next[CHUNKS_AHEAD]; /* that arrays are parts of: chunks.h */
    int next_count;
    uint64_t expected_bytes;        /* see device_expect() */
    unsigned skew;                  /* where the next buffer begins relative to a page */
    struct device_kernel **kernels; /* hash table by text: see programs.c */
    uint64_t kernel_units;          /* of all that are in memory */
    uint64_t built_then;            /* kernels_built when some last had to go */
    uint64_t kernels_gone;          /* that had to go for others */
    uint64_t kernels_built, kernels_built_background, kernels_run;
    double busy_s; /* time spent waiting for the device, or on its work: device_work_begin() */
    bool work_timed; /* see machine_work_time() */
    const char *options;
    struct claims {
        cl_mem memory; /* NULL: not needed yet */
        size_t lots;
        unsigned turn;   /* which set is the next kernel's */
    } claims;            /* which thread computes what: claims.c */
    bool is_pocl;        /* on a CPU */
    struct awake *awake; /* NULL: processors may halt between kernels */
    struct crew
        *crew; /* as many threads as units, for what the front end does; NULL: it is alone */
    struct aside code; /* fetches the machine's own code */
    bool queued; /* commands that nobody has waited for may be in the queue, or in theirs: */
    struct sub_devices *subs; /* NULL: it is not divided */
    bool keeps_programs;      /* on disk */
    struct fence {
        cl_event reached;
        uint64_t kernels; /* run before it */
    } fences
        [FENCES]; /* see device_pace(): those that nobody has waited for, the oldest first */
    int fences_count;
};

enum machine_status device_open(struct machine *m, const struct machine_config *config);
void device_close(struct machine *m);
struct device_shape shape_of(const struct device *d, const struct settings *s);

/* Whether the driver works here. In a child after fork() the front end does what it can by
 * itself. */
static inline bool device_is_ours(const struct device *d)
{
    return d->process == process_now();
}

/* ---- contexts.c ---- */

/* A context of these devices: the one that the last machine of this process left, or a new
 * one. NULL and an error of OpenCL's where none can be made. */
cl_context device_context(const struct device *d, const cl_device_id *ids, cl_uint count,
                          cl_int *error);
/* Takes the device's context from it, for the next machine. */
void device_context_leave(const struct device *d);

/* ---- sub_devices.c, sub_open.c: a device that is divided among several machines ----
 *
 * Their queues know nothing of each other. So before the device's own commands its sub-devices'
 * are waited for, and before theirs its own; and each array goes back to the pool of the one
 * that got its memory. */

enum { SUB_DEVICES_MOST = 64 };
/* Before the context is made: divides the device, if it can be. */
void device_divide(struct machine *m, int count);
int device_subs_count(const struct device *d);
/* The ids of the device and all sub-devices; returns how many. */
cl_uint device_ids(const struct device *d, cl_device_id *ids);
/* Opens a machine's device, which is one of another machine's sub-devices. */
enum machine_status device_sub_open(struct machine *m, struct machine *of, int which);
void device_sub_close(struct machine *m, struct machine *of, int which);
/* Sub-devices are about to be given commands, or have been. */
enum machine_status device_subs_begin(struct machine *m);
void device_subs_queued(struct machine *m);
/* Waits for all that is in their queues. */
cl_int device_subs_wait(struct device *d);
void device_subs_finish(struct device *d);

/* ---- claims.c ---- */

/* Claims are there for kernels that take some. False: error set. */
bool device_claims_ready(struct machine *m);
/* What such a kernel of so many work-groups is told; 0: it claims nothing. */
int device_claim(const struct device *d, size_t places);
/* It has been started, and was told another number than 0. */
void device_claimed(struct device *d);

/* ---- check.c ---- */

/* What a child after fork() cannot do. */
enum machine_status device_is_not_ours(struct machine *m);

enum machine_status device_check(struct machine *m, cl_int error, const char *what);

/* ---- buffers.c ---- */

struct device_buffer *device_buffer_get(struct machine *m,
                                        size_t bytes); /* refs 1; NULL: error set */

/* On CPUs the first column begins a cache line. */
struct device_buffer *device_rows_get(struct machine *m, struct rows rows);
bool device_rows_fit(const struct device_buffer *b, struct rows rows);
/* For commands. An array that only the front end looks at needs none. NULL: no memory, and the
 * command that is given it fails. */
cl_mem device_mem(const struct device_buffer *b);
cl_int device_argument(cl_kernel kernel, cl_uint at, const struct device_buffer *b);
void device_buffer_ref(struct device_buffer *b);
/* Nobody holds it: its memory goes back to the pool. */
void device_buffer_end(struct machine *m, struct device_buffer *b);
static inline void device_buffer_unref(struct machine *m, struct device_buffer *b)
{
    if (!--b->refs)
        device_buffer_end(m, b);
}

void device_pool_empty(struct device *d);
/* Another array like this one may soon be needed: memory for it is got ready by the way. */
void device_expect(struct device *d, struct rows rows);

/* ---- programs.c ---- */

bool device_programs_begin(struct device *d); /* false: no memory */

void device_programs_finish(struct device *d);
/* Gets the kernel of that name in a program of these parts, from memory, from disk, or by
 * building it. All parts but the last are the same for many programs. It is the device's, and
 * may go where device_kernels_forget() is called, unless it is held. NULL: error set. */
enum { DEVICE_PARTS = 8 };
struct device_kernel *device_kernel(struct machine *m, const char *const parts[DEVICE_PARTS],
                                    const char *options, const char *name);
/* The same for a hand-written kernel, whose text is complete. */
struct device_kernel *device_library_kernel(struct machine *m, const char *text,
                                            const char *options, const char *name);
/* The build options of a program, and its text for PoCL. Clang takes longer to read PoCL's
 * header of all OpenCL functions than the machine's text. So an include guard skips the
 * header, and functions.cl declares the functions in use. The caller frees the text; NULL:
 * no memory. */
enum { DEVICE_OPTIONS_BYTES = 300 };
void device_options(const struct device *d, const char *options, bool header,
                    char out[DEVICE_OPTIONS_BYTES]);
char *device_text_without_header(const char *const parts[DEVICE_PARTS]);
/* Whether the kernel can be started in work-groups of that many items. */
bool device_takes_group(const struct device *d, const struct device_kernel *kernel, int items);
/* The program of such parts, in any thread. NULL: it cannot be built here; device_kernel() says
 * why. */
cl_program device_program_build(const struct device *d, const char *const parts[DEVICE_PARTS],
                                const char *options);
/* The kernel of that name in a program that was built so, which is the device's from now on.
 * NULL: error set. */
struct device_kernel *device_program_take(struct machine *m, cl_program program,
                                          const char *const parts[DEVICE_PARTS],
                                          const char *options, const char *name);
/* Whether the kernel is in memory or on disk, and need not be built. */
bool device_kernel_at_hand(struct machine *m, const char *const parts[DEVICE_PARTS],
                           const char *options, const char *name);

/* NULL: nothing happens. As often as it is held it has to be let go of. */
void device_kernel_hold(struct device_kernel *kernel);
void device_kernel_let_go(struct device_kernel *kernel);
/* Whether there are so many that some should go. */
bool device_kernels_are_many(const struct machine *m);
/* If those go that were used before then, there is some room: device_kernel.used. */
uint64_t device_kernels_old(const struct machine *m);
/* They go, but for those that somebody holds. Nobody else may know them any more. */
void device_kernels_forget(struct machine *m, uint64_t used_before);

/* ---- started.c ---- */

/* A kernel of that id (device_kernel.id) has been started. */
void device_started(uint64_t id);
/* Whether more kernels may be made for plans: the driver has room for them. */
bool device_takes_kernels(const struct machine *m);

/* ---- queue.c ---- */

/* Starts the kernel in work-groups of that size; error is the status of setting its
 * arguments. local NULL: the driver decides, except on a CPU, where a group is one item. A
 * kernel's first start waits for its end: the driver may still compile it in a thread, and a
 * program that exits meanwhile would crash. */
enum machine_status device_launch(struct machine *m, struct device_kernel *kernel, cl_int error,
                                  cl_uint dimensions, const size_t *global, const size_t *local,
                                  const char *what);
/* Around what the front end computes in the device's place: where it is timed, that counts as
 * busy, too. device_work_begin() returns the starting time; nothing in between waits for the
 * device. */
static inline double device_work_begin(const struct machine *m)
{
    return m->device->work_timed ? clock_s() : 0;
}
static inline void device_work_end(struct machine *m, double start)
{
    if (m->device->work_timed)
        m->device->busy_s += clock_s() - start;
}
/* Around a call that waits for the device: the time counts as busy. device_wait_begin()
 * returns the starting time. */
double device_wait_begin(struct machine *m);
enum machine_status device_wait_end(struct machine *m, cl_int error, double start,
                                    const char *what);
/* Fills a whole buffer with a pattern; copies one buffer to the beginning of another.
 * Neither waits. */
enum machine_status device_fill(struct machine *m, const struct device_buffer *b,
                                const void *pattern, size_t pattern_bytes, const char *what);
enum machine_status device_copy(struct machine *m, const struct device_buffer *from,
                                const struct device_buffer *to, size_t bytes, const char *what);
/* Bytes of a buffer from `at` on, to and from the front end; wait for what is in the queue. */
enum machine_status device_read(struct machine *m, const struct device_buffer *b, size_t at,
                                void *to, size_t bytes, const char *what);
enum machine_status device_write(struct machine *m, const struct device_buffer *b, size_t at,
                                 const void *from, size_t bytes, const char *what);
void device_flush(struct machine *m); /* what is in the queue begins */
/* Waits until all that is in the queue is done: the front end may look at buffers
 * (device_buffer.host) then. */
enum machine_status device_settle(struct machine *m);
/* The same, for a look of that name, which those who watch hear of. */
enum machine_status device_settle_for(struct machine *m, const char *what);

/* Whether the front end can do by itself what a kernel would do with arrays such as this one:
 * it is in its memory, and the device has done all that is in its queue. LUTETIA_NEAR=0:
 * never. */
bool device_is_near(struct machine *m, const struct device_buffer *b);
/* Work for more than one thread begins, or goes on. */
void device_stays_awake(struct machine *m);
/* In how many parts the crew does what takes one thread so long. LUTETIA_NEAR=2: in several,
 * however short. */
int device_parts(const struct machine *m, double seconds);
/* The same of work that is shared out at other costs. */
int device_parts_at(const struct machine *m, double seconds, const struct crew_costs *costs);

/* Copies arrays of the front end's, by the crew where they are long. */
void device_move(struct machine *m, void *to, const void *from, size_t bytes);

/* Called after kernels were started. Waits if the front end is `ahead` kernels ahead of the
 * device, because each waiting kernel takes memory. */
enum machine_status device_pace(struct machine *m, uint64_t ahead);

#endif
