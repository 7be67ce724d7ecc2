/* watch.h - hooks for those who look at the machine at work: a trace (LUTETIA_TRACE) and explanations.
 *
 *     double start = watch_clock(m);
 *     ... make a plan ...
 *     if (m->watch)
 *         watch_span(m, WATCH_PLAN, start, "\"nodes\":%d", count);
 *
 * Nobody looks: m->watch is NULL, and each hook is that test.
 *
 *   watch.c     takes what the hooks say
 *   commands.c  takes the device's own times of its commands
 *   trace.c     writes it to a file as it happens
 *   sums.c      adds it up, for machine_explain()
 *
 * What the file has on its tracks, and what is inside of what:
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
    WATCH_RECORD,    /* an instruction; simplifying is part of it */
    WATCH_ROLL,      /* loops over a processor's elements rolled up */
    WATCH_EVALUATE,  /* what follows down to LAUNCH */
    WATCH_TARGETS,   /* what has to be computed */
    WATCH_SIGNATURE, /* the nodes that are reached */
    WATCH_LOOKUP,    /* of the plan; it holds what follows down to BUILD where there is none */
    WATCH_PLAN,
    WATCH_GENERATE,
    WATCH_BUILD,       /* by the driver's compiler */
    WATCH_BUILD_LOAD,  /* of the disk cache's binary */
    WATCH_BUILD_FIRST, /* a kernel's first start, which waits for its end */
    WATCH_LAUNCH,      /* a plan's kernels are put into the queue */
    WATCH_INTERPRET,   /* ... or performed by the front end itself */
    WATCH_NOTE,        /* calls seen before, noted; the program's own time between them too */
    WATCH_REPLAY,      /* ... and performed */
    WATCH_WAIT,        /* for the device */
    WATCH_PHASES_COUNT
};

/* A kernel as those who watch know it: sums.h. */
struct kernel_note;
bool watch_open(struct machine *m, const struct machine_config *config);
/* The machine has its device: its queue; 64 bytes of its memory, which are written to; a name for the trace. */
void watch_ready(struct machine *m, cl_command_queue queue, cl_mem scratch, const char *title);
/* The device is at rest: what it did is known now. */
void watch_leave(struct machine *m);
void watch_close(struct machine *m);

/* When it is, where somebody looks. */
static inline double watch_clock(const struct machine *m)
{
    return m->watch ? clock_s() : 0;
}

/* All that follow are called only where m->watch is not NULL. */

/* From start to now. details: JSON members for the trace; NULL: none. */
void watch_span(struct machine *m, enum watch_phase phase, double start, const char *details,
                ...) __attribute__((format(printf, 4, 5)));
/* Calls: one is noted (first: none was before it); one is now going to be performed; a performed one's end. So many turns of
 * some that were noted have been performed (more: others are still noted). An instruction that is no call. */
void watch_noted(struct machine *m, bool first);
void watch_call(struct machine *m, const char *name);
void watch_performed(struct machine *m);
void watch_call_failed(struct machine *m);
void watch_replayed(struct machine *m, double start, const struct machine_call *calls,
                    int count, int turns, bool alone, bool more);
void watch_instruction(struct machine *m, const char *name);
/* From now on: what calls do is told to nobody, for they will be performed once more; or it is. */
void watch_silent(struct machine *m, bool silent);

enum watch_why { WATCH_LOOKED_AT, WATCH_MUCH_WAITED, WATCH_AT_ONCE, WATCH_ASKED_TO };
void watch_evaluated(struct machine *m, double start, enum watch_why why, int targets);

/* Values: one that nobody has computed is let go of; one in a field or flag, not computed yet, gives way to another; so many
 * are going to be computed, so many of them stored. */
void watch_vanished(struct machine *m, int op);
void watch_overwritten(struct machine *m);
void watch_computed(struct machine *m, int count, int stored);
void watch_background(struct machine *m, double start, double end, const char *options);
/* Commands. Which kernel the next device_launch() starts: a generated one, or one by hand that was given so
 * many bytes of arrays. Then where its event goes, and what it was; after an error, nothing. */
void watch_launch(struct machine *m, struct kernel_note *note);
/* One that the front end performed itself, from start to now. */
void watch_interpreted(struct machine *m, struct kernel_note *note, double start);
void watch_arrays(struct machine *m, size_t bytes);
cl_event *watch_command(struct machine *m, double start); /* 0: now */

void watch_launched(struct machine *m, cl_int error, cl_kernel kernel, const char *what);
void watch_moves(struct machine *m, cl_int error, const char *what, size_t bytes);
/* The front end waited; how much it got or gave, said before. */
void watch_bytes(struct machine *m, size_t bytes);
void watch_waited(struct machine *m, double start, const char *what);

extern const char *const watch_phase_names[WATCH_PHASES_COUNT];
struct watch_sums *watch_sums(const struct machine *m); /* where m->watch is not NULL */

struct watch_sums *watch_explain(const struct machine *m); /* NULL: nobody asked for it */

/* Waits until all commands have ended, and takes their times. */
void watch_settle(struct machine *m);

#endif
