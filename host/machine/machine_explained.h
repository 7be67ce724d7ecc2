/* machine_explained.h - what a machine did, and why: facts for those who asked for them (machine_config.explain).
 *
 *     const struct machine_explained *e = machine_explain(m, true);
 *     for (int i = 0; e && i < e->kernels_count; i++)
 *         printf("%s: %.3f s\n", e->kernels[i].name, e->kernels[i].time_s);
 */
#ifndef LUTETIA_MACHINE_EXPLAINED_H
#define LUTETIA_MACHINE_EXPLAINED_H

#include "machine.h"

/* A row of a table: of what, how often, and, where that is said, how long and how much. */
struct machine_explained_row {
    const char *name;
    uint64_t count;
    double time_s;
    uint64_t bytes;
};

/* Why a value was put into memory. */
enum machine_cut {
    MACHINE_CUT_LOOKED_AT, /* somebody asked for it: the front end, a scan, the router */
    MACHINE_CUT_LIVE,      /* the content of a field or flag that may be looked at */
    MACHINE_CUT_NEIGHBOURS, /* others load it at an offset, cheaper than computing it there again */
    MACHINE_CUT_LATER       /* a later kernel needs it */
};

struct machine_explained_store {
    enum machine_cut why;
    struct machine_type type;
    const char *operation; /* that gave it, under the context or not */
    bool in_ring;   /* some of its rows, or tiles, at a time, in no array: strips.h, tiles.h */
    char where[40]; /* the field or flag that held it when the kernel was made; else "" */
};

/* A kernel, on processors of one VP set. Bytes are those of what is read or written at all, once for each
 * processor that it belongs to. */
struct machine_explained_kernel {
    const char *name;    /* of a generated one: what it stores */
    bool generated;      /* else by hand, and what follows is 0 to `made` */
    int vpset;           /* as it was called then */
    uint64_t processors; /* in one run */
    int operations; /* for a processor, those computed again at neighbours too; of operands: no coordinates */
    int operations_cost; /* ... as the cost model has them */
    int arrays_read, arrays_written;
    int bytes_read, bytes_written; /* for a processor */
    int shifts_computed;           /* neighbours' values that were computed again, not loaded */
    int stages, rings; /* in strips: one after the other; values in rings of rows. Else 1, 0 */
    int tile_width, tile_height; /* in tiles, then rings are of tiles; else 0 */
    bool split;                  /* of one that would have had too many arguments */
    const char *made;            /* how well: "quick", "optimised", "boxed" */
    const struct machine_explained_store *stores;
    int stores_count;
    uint64_t runs;
    uint64_t bytes;      /* in all runs; by hand: of all arrays that it was given */
    uint64_t runs_timed; /* whose times the device told */
    double time_s;       /* of these, together */
    /* What one run takes at least: to copy as many bytes, measured when machine_explain() was called (0: it
     * was not), and for the operations by the cost model. */
    double copy_s, operations_s;
};

enum { MACHINE_VANISHED_OPS_MOST = 128 };

struct machine_explained {
    const char *device;
    int processors_count;
    /* Instructions, in the order in which each first came: count, recorded ones; bytes, those foreseen. */
    const struct machine_explained_row *calls;
    int calls_count;
    uint64_t calls_recorded, calls_foreseen;
    uint64_t stores; /* into fields and flags; those foreseen too */
    /* Values recorded: computed in some kernel; of these, put into memory; nobody ever asked for. What is left
     * out is foreseen calls' values, which were not recorded again, and what still waits. */
    uint64_t values_computed, values_stored, values_vanished;
    struct machine_explained_row vanished[MACHINE_VANISHED_OPS_MOST]; /* by operation */
    int vanished_count;
    struct machine_explained_row
        reasons[8]; /* why values vanished: how often each rule found something */
    int reasons_count;
    struct machine_explained_row evaluations[8]; /* what made them happen */
    int evaluations_count;
    uint64_t plans_built, plans_improved;
    struct machine_explained_row
        phases[24]; /* where the front end's time went; one may be in another */
    int phases_count;
    struct machine_explained_row transfers[24]; /* waits of the front end: for what */
    int transfers_count;
    const struct machine_explained_kernel *kernels; /* most time first, then most runs */
    int kernels_count;
    uint64_t copy_bytes;     /* read and written by the largest copy that was measured */
    double copy_bytes_per_s; /* ... how fast; 0: none was */
};

/* What has happened so far, without calls that are noted and wait. Waits for the device; measures how fast it copies
 * the first time that there is something to compare it with, if measure. Valid until the next call or the machine's
 * end. NULL: the configuration did not ask for it, or not enough memory, or the exit comes from where
 * machine_leave() must not wait. */
const struct machine_explained *machine_explain(struct machine *m, bool measure);

/* Called between instructions from now on, where the machine is asked to explain. */
void machine_explain_between(struct machine *m, void (*between)(void));

#endif
