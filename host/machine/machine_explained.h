/* machine_explained.h - what a machine did, and why: the facts collected with
 * machine_config.explain.
 *
 *     const struct machine_explained *e = machine_explain(m, true);
 *     for (int i = 0; e && i < e->kernels_count; i++)
 *         printf("%s: %.3f s\n", e->kernels[i].name, e->kernels[i].time_s);
 */
#ifndef LUTETIA_MACHINE_EXPLAINED_H
#define LUTETIA_MACHINE_EXPLAINED_H

#include "machine.h"

/* A row of a table: a name, a count, and, for some tables, a time and a number of bytes. */
struct machine_explained_row {
    const char *name;
    uint64_t count;
    double time_s;
    uint64_t bytes;
};

/* Why a value was put into memory. */
enum machine_cut {
    MACHINE_CUT_LOOKED_AT,  /* the front end, a scan or the router asked for it */
    MACHINE_CUT_LIVE,       /* it is the content of a field or flag, which may be observed */
    MACHINE_CUT_NEIGHBOURS, /* neighbours load it; computing it again at an offset would cost
                             * more */
    MACHINE_CUT_LATER       /* a later kernel needs it */
};

struct machine_explained_store {
    enum machine_cut why;
    struct machine_type type;
    const char *operation; /* the operation that gave it, ignoring selects by the context */
    bool in_ring;          /* not in an array, but in rings or tiles: strips.h, tiles.h */
    char where[40]; /* the field or flag that held it when the kernel was made; else "" */
};

/* The ways of computing what an evaluation wants that the planner compares: plan_way.tab. */
enum machine_plan_way {
#define PLAN_WAY(way, name) way,
#include "plan_way.tab"
#undef PLAN_WAY
    MACHINE_PLAN_WAYS
};

/* What one run of each takes, by the cost model, as plan/plans_compared.c notes it; 0: it was
 * not considered, or is not possible. */
struct machine_explained_plan {
    enum machine_plan_way chosen;
    bool forced; /* somebody asked for it (LUTETIA_STRIPS) */
    double cost_s[MACHINE_PLAN_WAYS];
};

/* A kernel, on processors of one VP set. Each array read or written counts once, with an
 * element for each processor. */
struct machine_explained_kernel {
    const char *name;    /* generated kernels: what it stores */
    bool generated;      /* if false, written by hand, and the members up to `made` are 0 */
    int vpset;           /* the VP set's name at that time */
    uint64_t processors; /* in one run */
    int operations;      /* for each processor, including neighbours' values computed again; of
                     * operations on operands, without coordinates */
    int operations_cost; /* ... as the cost model counts them */
    int arrays_read, arrays_written;
    int bytes_read, bytes_written; /* for a processor */
    int shifts_computed;           /* neighbours' values that were computed again, not loaded */
    int stages, rings;           /* in strips: stages, and values in rings of rows; else 1, 0 */
    int tile_width, tile_height; /* in tiles, where rings are tiles; else 0 */
    bool split;                  /* of a kernel that was split because it had too many
                                  * arguments */
    const char *made;            /* how well: "quick", "optimised", "boxed" */
    const struct machine_explained_store *stores;
    int stores_count;
    uint64_t runs;
    uint64_t bytes;      /* in all runs; by hand: of all arrays passed to it */
    uint64_t runs_timed; /* runs whose times the device reported */
    double time_s;       /* of these, together */
    /* The least times of one run: for copying as many bytes, measured when machine_explain()
     * was called (0: not measured), and for the operations by the cost model. */
    double copy_s, operations_s;
    /* What one run takes by the cost model: 0 of one by hand, and of one that was split. The
     * plan that the kernel was made for, and what it was preferred to. */
    double predicted_s;
    struct machine_explained_plan plan;
};

/* How a plan's run was performed. */
enum machine_tier {
    MACHINE_TIER_INTERPRETED,
    MACHINE_TIER_QUICK,
    MACHINE_TIER_OPTIMISED,
    MACHINE_TIER_BOXED,
    MACHINE_TIERS
};

/* Why a plan runs as it does. */
enum machine_plan_why {
    MACHINE_PLAN_SHORT, /* interpreted: done before a kernel would begin */
    /* interpreted: kernels would have saved less than a compiler takes */
    MACHINE_PLAN_NOT_WORTH,
    MACHINE_PLAN_COMPILING, /* interpreted: kernels are being compiled */
    MACHINE_PLAN_SHARED,    /* kernels that take its numbers as arguments */
    MACHINE_PLAN_OWN,       /* kernels with its numbers in their text */
    MACHINE_PLAN_WHYS
};

/* The numbers in which plans that are otherwise the same may differ. */
enum machine_number {
    MACHINE_NUMBER_POSITION, /* of bits in a field */
    MACHINE_NUMBER_WIDTH,    /* in bits */
    MACHINE_NUMBER_DISTANCE, /* along an axis */
    MACHINE_NUMBER_VPSET,
    MACHINE_NUMBERS
};

struct machine_explained_range {
    bool differs;
    int32_t least, most;
};

/* Plans that are the same but for numbers. */
struct machine_explained_family {
    char name[80]; /* what the first one stores */
    int nodes;     /* of each */
    uint64_t plans;
    uint64_t runs[MACHINE_TIERS];
    uint64_t why[MACHINE_PLAN_WHYS]; /* plans */
    struct machine_explained_range differ[MACHINE_NUMBERS];
};

enum { MACHINE_VANISHED_OPS_MOST = 128 };

struct machine_explained {
    const char *device;
    const char *costs_from; /* where the cost model's numbers about it come from */
    int processors_count;
    /* Instructions, in the order of first use. count: those recorded; bytes: those foreseen. */
    const struct machine_explained_row *calls;
    int calls_count;
    uint64_t calls_recorded, calls_foreseen;
    uint64_t stores; /* into fields and flags, including foreseen ones */
    /* Numbers of recorded values: computed in some kernel; of these, stored in memory; never
     * needed. Not included are values of foreseen calls, which were not recorded again, and
     * values still pending. */
    uint64_t values_computed, values_stored, values_vanished;
    struct machine_explained_row vanished[MACHINE_VANISHED_OPS_MOST]; /* by operation */
    int vanished_count;
    struct machine_explained_row
        reasons[8]; /* why values vanished: how often each rule applied */
    int reasons_count;
    struct machine_explained_row evaluations[8]; /* reasons of evaluations */
    int evaluations_count;
    uint64_t plans_built, plans_improved;
    uint64_t kernels_gone; /* compiled kernels that had to leave memory for others */
    const struct machine_explained_family *families; /* of plans that are kept, by runs */
    int families_count;
    struct machine_explained_row
        phases[24]; /* where the front end's time went; phases may be nested */
    int phases_count;
    struct machine_explained_row transfers[24]; /* what the front end waited for */
    int transfers_count;
    const struct machine_explained_kernel *kernels; /* by time, then by runs, greatest first */
    int kernels_count;
    uint64_t copy_bytes;     /* bytes read and written by the largest copy that was measured */
    double copy_bytes_per_s; /* the speed of that copy; 0: none was measured */
};

/* The facts so far, without calls that are noted but not performed. Waits for the device. If
 * measure is set, measures copies of new sizes. Valid until the next call or the machine's
 * end. NULL: machine_config.explain is off, or memory is short, or machine_leave() must not
 * wait here. */
const struct machine_explained *machine_explain(struct machine *m, bool measure);

/* `between` is called between instructions from now on, if the machine explains. */
void machine_explain_between(struct machine *m, void (*between)(void));

#endif
