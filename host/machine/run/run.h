/* run.h - the state of this folder, and what calls and evaluations are performed for. */
#ifndef LUTETIA_MACHINE_RUN_H
#define LUTETIA_MACHINE_RUN_H

#include "values/values.h"

struct replay;
/* The heights of expressions: up to the first a temporary is not computed; at the second an
 * evaluation is due. */
enum { HEIGHT_DEFERRED = 96, HEIGHT_MOST = 1500 };
enum { TRACE_LENGTH = 128 };

/* What calls and evaluations are performed for.
 *
 *       +--------------------- RUN_FREE <------------------------------------+
 *       | what was noted          | many turns might      | they do          |
 *       | leads elsewhere         | pay (turns.c)         |                  |
 *       v                         v                       v                  |
 *   RUN_CATCHING_UP    RUN_REHEARSING_CALLS      RUN_BUILDING_CALLS          |
 *       |                         |                       |                  |    calls are performed
 *       |                         v                       v                  |
 *       |            RUN_REHEARSING(_TURNS)          RUN_BUILDING            |    they are evaluated
 *       |                         |                       |                  |
 *       +-------------------------+-----------------------+------------------+
 */
enum run_mode {
    RUN_FREE,             /* calls are performed as they come; evaluations can become due */
    RUN_CATCHING_UP,      /* noted calls are performed one by one; evaluations can become due */
    RUN_REHEARSING_CALLS, /* calls are performed, and will be undone: observers are not told,
                           * no evaluation becomes due */
    RUN_REHEARSING,       /* ... and planned: the plan's kernels are prepared, none runs */
    RUN_REHEARSING_TURNS, /* ... for many turns of a loop */
    RUN_BUILDING_CALLS,   /* many turns are performed, to be evaluated together: no evaluation
                         * becomes due */
    RUN_BUILDING          /* ... and evaluated, with the best kernels */
};
static inline bool run_mode_catches_up(enum run_mode mode)
{
    return mode == RUN_CATCHING_UP || mode == RUN_REHEARSING_CALLS ||
           mode == RUN_BUILDING_CALLS;
}
/* Whether evaluations are held back in that mode. */
static inline bool run_mode_holds(enum run_mode mode)
{
    return mode == RUN_REHEARSING_CALLS || mode == RUN_BUILDING_CALLS;
}
static inline bool run_mode_builds(enum run_mode mode)
{
    return mode == RUN_BUILDING_CALLS || mode == RUN_BUILDING;
}

/* When values are evaluated, and foreseen calls. */
struct run {
    struct replay *replay;        /* NULL: calls are not noted */
    int calls_noted;              /* noted and not performed yet */
    int turns_in_row;             /* foreseen turns of loops, with nothing else in between */
    int turns_between_looks;      /* ... when the program last looked, or did something else */
    int looks_alike;              /* how often in a row that number was the same */
    uint64_t trace[TRACE_LENGTH]; /* hash of the last stores, to find the same place in a
                                   * loop */
    uint64_t trace_hash, trace_power, flush_hash;
    uint32_t trace_count;
    bool sliced;         /* a slice was made at some time: see slices.c */
    uint64_t wait_for;   /* pending values that are worth an evaluation; 0: as usual */
    uint64_t roll_after; /* pending values before roll_waiting() is tried again */
    bool flush_due;      /* an evaluation is due before the next instruction */
    enum run_mode mode;
    struct plan *rehearsed; /* by the last rehearsal; NULL: nothing to compute */
    uint64_t room_held;     /* arrays that are held are to take no more */
    /* arrays that are held, and those that may have to be stored, are to take no more: see
     * room.c */
    uint64_t room_bytes;
    bool evaluating;      /* an evaluation is under way, or foreseen calls are */
    bool in_pieces;       /* ... of all, what was stored first before the rest, by itself */
    uint64_t flush_place; /* trace_hash where it became due */
    enum machine_status flush_status; /* of a failed evaluation: returned by the next store */
    bool sent_beyond;                 /* a message went to no processor, and nobody has asked */
    bool beyond_told;                 /* ... somebody has, and nobody looks any more */
    uint64_t sends_far;               /* by kernels: see beyond_look() */
    uint64_t stores, stores_evaluated, flushes, calls_foreseen;
};

#endif
