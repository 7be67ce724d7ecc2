/* watch_struct.h - what watch.c and commands.c share. */
#ifndef LUTETIA_MACHINE_WATCH_STRUCT_H
#define LUTETIA_MACHINE_WATCH_STRUCT_H

#include "watch/sums.h"

/* Commands whose times are not known yet, beyond which they are waited for. */
enum { COMMANDS_MOST = 4096, DETAILS_BYTES = 600 };

struct command {
    cl_event done;
    struct kernel_note *note;
    double before, after; /* our clock, around the call that queued it */
    uint64_t bytes;       /* by hand, fills and copies: of all arrays; generated: 0 */
};

struct watch {
    int machine; /* in the trace; 0: none is written */
    struct watch_sums *explain;
    bool explains;          /* asked for; a trace wants the kernels' names alone */
    bool background;        /* it has that track */
    bool silent;            /* nobody is told: see watch_silent() */
    cl_command_queue queue; /* NULL: there is no device yet */

    int depth;        /* calls being performed, one in another */
    const char *call; /* the outermost */
    double call_start, noted_start;

    struct kernel_note *next; /* the next launch's; NULL: by hand */
    size_t next_bytes;
    struct command *commands; /* a ring */
    int commands_first, commands_count;
    double offset, device_end; /* of the clocks; where the last command ended, ours */
    bool offset_known;

    uint64_t waited_bytes;
};

/* Takes the times of commands that have ended. wait: of all, when they have. */
void commands_settle(struct machine *m, bool wait);
void watch_span_named(struct machine *m, enum watch_phase phase, const char *name, double start,
                      double end, const char *details);

#endif
