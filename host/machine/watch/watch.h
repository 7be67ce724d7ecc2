/* watch.h - hooks for observers of the machine at work: the trace (LUTETIA_TRACE) and
 * machine_explain().
 *
 *     double start = watch_clock(m);
 *     ... make a plan ...
 *     if (m->watch)
 *         watch_span(m, WATCH_PLAN, start, "\"nodes\":%d", count);
 *
 * Without observers m->watch is NULL, and each hook costs only that test.
 *
 *   watch.c     receives what the hooks report
 *   commands.c  reads the device's own times of its commands
 *   trace.c     writes it to a file as it happens
 *   sums.c      adds it up, for machine_explain()
 *
 * The tracks of the trace's file, with nested spans below each other:
 *
 *     front end   CM_f_add_2_1L   note   replay            evaluate                                      wait
 *                                        launch            targets, signature, look-up, launch
 *                                                                       plan, generate, build
 *     device                             kernels, fills, copies
 *     background                         build (where kernels are compiled so: background.c)
 */
#ifndef LUTETIA_MACHINE_WATCH_H
#define LUTETIA_MACHINE_WATCH_H

#include <CL/cl.h>

#include "base/clock.h"
#include "base/parts.h"
#include "machine_explained.h"

struct watch_sums;

enum watch_phase {
    WATCH_RECORD,    /* an instruction, simplification included */
    WATCH_ROLL,      /* rolling up loops over a processor's elements */
    WATCH_EVALUATE,  /* contains the phases down to LAUNCH */
    WATCH_TARGETS,   /* finding what has to be computed */
    WATCH_SIGNATURE, /* walking the nodes that are reached */
    WATCH_LOOKUP,    /* of the plan; for a new plan, it contains the phases down to BUILD */
    WATCH_PLAN,
    WATCH_GENERATE,
    WATCH_BUILD,       /* by the driver's compiler */
    WATCH_BUILD_LOAD,  /* loading a binary of the disk cache */
    WATCH_BUILD_FIRST, /* a kernel's first start, which waits for its end */
    WATCH_LAUNCH,      /* a plan's kernels are put into the queue */
    WATCH_INTERPRET,   /* ... or performed by the front end itself */
    WATCH_NOTE,        /* calls seen before, noted; the program's own time between them too */
    WATCH_REPLAY,      /* ... and performed */
    WATCH_WAIT,        /* for the device */
    WATCH_PHASES_COUNT
};

/* What observers know of a kernel: sums.h. */
struct kernel_note;
bool watch_open(struct machine *m, const struct machine_config *config);
/* Called when the machine has its device: the queue; 64 bytes of device memory to write to;
 * a name for the trace. */
void watch_ready(struct machine *m, cl_command_queue queue, cl_mem scratch, const char *title);
/* Called when the device is idle: all its times are known. */
void watch_leave(struct machine *m);
void watch_close(struct machine *m);

/* The time, if there are observers. */
static inline double watch_clock(const struct machine *m)
{
    return m->watch ? clock_s() : 0;
}

/* All functions below are called only if m->watch is not NULL. */

/* A span from start to now. details: JSON members for the trace; NULL: none. */
void watch_span(struct machine *m, enum watch_phase phase, double start, const char *details,
                ...) __attribute__((format(printf, 4, 5)));
/* Calls: one was noted (first: the first of a sequence); one is about to be performed; one
 * was performed. That many turns of noted calls were performed (more: others are still
 * noted). An instruction that is no call. */
void watch_noted(struct machine *m, bool first);
void watch_call(struct machine *m, const char *name);
void watch_performed(struct machine *m);
void watch_call_failed(struct machine *m);
void watch_replayed(struct machine *m, double start, const struct machine_call *calls,
                    int count, int turns, bool alone, bool more);
void watch_instruction(struct machine *m, const char *name);
/* Stops or resumes reporting what calls do: rehearsed calls will be performed again. */
void watch_silent(struct machine *m, bool silent);

enum watch_why { WATCH_LOOKED_AT, WATCH_MUCH_WAITED, WATCH_AT_ONCE, WATCH_ASKED_TO };
void watch_evaluated(struct machine *m, double start, enum watch_why why, int targets);

/* Values: one was released without being computed; one in a field or flag was overwritten
 * before it was computed; that many will be computed, and that many of them stored. */
void watch_vanished(struct machine *m, int op);
void watch_overwritten(struct machine *m);
void watch_computed(struct machine *m, int count, int stored);
void watch_background(struct machine *m, const char *what, double start, double end,
                      const char *options);
/* Commands: first the kernel that the next device_launch() starts, generated or
 * hand-written, and the bytes of the latter's arrays. Then where to put the command's event,
 * and what the command was (not after an error). */
void watch_launch(struct machine *m, struct kernel_note *note);
/* One that the front end performed itself, from start to now. */
void watch_interpreted(struct machine *m, struct kernel_note *note, double start);
/* ... that no plan has made: a scan, a send. */
void watch_near(struct machine *m, const char *what, double start);
void watch_arrays(struct machine *m, size_t bytes);
cl_event *watch_command(struct machine *m, double start); /* 0: now */

/* id: the kernel's, which stays the same when it goes and comes back. */
void watch_launched(struct machine *m, cl_int error, cl_kernel kernel, uint64_t id,
                    const char *what);
void watch_moves(struct machine *m, cl_int error, const char *what, size_t bytes);
/* The front end waited; watch_bytes() is called before with the number of bytes transferred. */
void watch_bytes(struct machine *m, size_t bytes);
void watch_waited(struct machine *m, double start, const char *what);

extern const char *const watch_phase_names[WATCH_PHASES_COUNT];
struct watch_sums *watch_sums(const struct machine *m); /* if m->watch is not NULL */

struct watch_sums *watch_explain(const struct machine *m); /* NULL: explanations are off */

/* Waits until all commands have ended, and reads their times. */
void watch_settle(struct machine *m);

#endif
