/* watch_struct.h - shared by watch.c and commands.c. */
#ifndef LUTETIA_MACHINE_WATCH_STRUCT_H
#define LUTETIA_MACHINE_WATCH_STRUCT_H

#include "watch/sums.h"

/* COMMANDS_MOST: with more commands whose times are not known, the oldest are waited for. */
enum { COMMANDS_MOST = 4096, DETAILS_BYTES = 600 };

struct command {
    cl_event done;
    struct kernel_note *note;
    double before, after; /* our clock, before and after the call that queued it */
    uint64_t bytes;       /* hand-written kernels, fills and copies: bytes of all arrays;
                           * generated kernels: 0 */
};

struct watch {
    int machine; /* the machine's number in the trace; 0: no trace */
    struct watch_sums *explain;
    bool explains;          /* explanations are on; a trace alone needs only the kernels'
                             * names */
    bool background;        /* the trace has that track */
    bool silent;            /* observers are not told: see watch_silent() */
    cl_command_queue queue; /* NULL: no device yet */

    int depth;        /* nesting depth of calls being performed */
    const char *call; /* the outermost */
    double call_start, noted_start;

    struct kernel_note *next; /* the kernel of the next launch; NULL: hand-written */
    size_t next_bytes;
    struct command *commands; /* a ring */
    int commands_first, commands_count;
    double offset, device_end; /* offset of the clocks; when the last command ended, by our
                                * clock */
    bool offset_known;

    uint64_t waited_bytes;
};

/* Reads the times of commands that have ended. wait: first waits for all. */
void commands_settle(struct machine *m, bool wait);
void watch_span_named(struct machine *m, enum watch_phase phase, const char *name, double start,
                      double end, const char *details);

#endif
