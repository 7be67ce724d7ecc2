/* settings.h - the values of the environment variables: see settings.c. */
#ifndef LUTETIA_MACHINE_SETTINGS_H
#define LUTETIA_MACHINE_SETTINGS_H

#include "machine.h"

#define SETTING_FREE UINT64_MAX /* not set: the device decides, or the code that uses it */

/* Set by environment variables: settings.c. */
struct settings {
    uint64_t eager, replay;
    uint64_t flush_after; /* pending values that make an evaluation due: run/pending.h */
    /* The number of processors that a plan runs on before its kernels are optimised, and
     * before they get boxes. */
    uint64_t optimise_after, box_after;
    /* plans run as byte code: 0 never, 1 until kernels pay, 2 always, 3 always and on the
     * device */
    uint64_t interpret;
    uint64_t numbers; /* numbers in kernels are arguments: 0 never, 1 where they can be */
    /* operations of small sets are computed when called: 0 never, 1 where nothing repeats, 2
     * always */
    uint64_t at_once;
    uint64_t background; /* better kernels are compiled while others run */
    uint64_t kernels;    /* in memory at most, in units: device/programs.c */
    /* after so many started in this process plans are interpreted: device/started.c */
    uint64_t kernels_ever;
    uint64_t knob[MACHINE_KNOBS];
    double cost_ns[MACHINE_COSTS]; /* measured for this device (device/tuning.c); 0: not */
    uint64_t strips, in_place, scatter, gather, keeps_nan;
    /* processors do not halt while there is work: base/awake.h; free: in a virtual machine,
     * where the system may be asked */
    uint64_t awake;
    uint64_t claims;  /* device_shape.claims */
    uint64_t near;    /* the front end looks at memory that is its own by itself */
    uint64_t lenient; /* what is past a field's end is what lies after it: access/beyond.h */
    uint64_t tile;    /* width << 16 | height */
    uint64_t processors;
    uint64_t memory; /* bytes that arrays may take together; free: what the device has */
    uint64_t blocks, blocks_apart, blocks_from,
        /* of large VP sets; those of so many processors are cut; what blocks repeat:
         * sequencers/ */
        ghosts;
    uint64_t tuned; /* 0: a stored tuning is ignored */
    uint64_t keep;  /* keep programs on disk */
};

enum machine_status settings_read(struct machine *m);
/* The variables that are set, a line each: NAME=VALUE. What does not fit is left out. */
void settings_text(char *out, size_t size);
bool settings_number(const char *text, uint64_t *out); /* false: the text is no number */

const char *settings_knob_may_be(enum machine_knob knob);

#endif
