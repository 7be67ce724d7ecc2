/* run.h - when something is evaluated: see run.c. */
#ifndef LUTETIA_MACHINE_RUN_H
#define LUTETIA_MACHINE_RUN_H

#include "values/values.h"

struct replay;
enum { PENDING_MOST = 4096, PENDING_LOOP = 16384, HEIGHT_DEFERRED = 96, HEIGHT_MOST = 1500 };
enum { TRACE_LENGTH = 128 };

/* What calls and evaluations are for.
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
    RUN_FREE,        /* calls are performed as they come; evaluations become due */
    RUN_CATCHING_UP, /* calls that were noted are performed, one by one; evaluations become due */
    RUN_REHEARSING_CALLS, /* they are performed, to be taken back: nobody is told, no evaluation becomes due */
    RUN_REHEARSING,       /* ... and planned: the plan's kernels are seen to, and none runs */
    RUN_REHEARSING_TURNS, /* ... for many turns of a loop */
    RUN_BUILDING_CALLS, /* many turns are performed, to be evaluated at once: no evaluation becomes due */
    RUN_BUILDING /* ... and evaluated: it is worth the best kernels */
};
static inline bool run_mode_catches_up(enum run_mode mode)
{
    return mode == RUN_CATCHING_UP || mode == RUN_REHEARSING_CALLS ||
           mode == RUN_BUILDING_CALLS;
}
/* No evaluation becomes due. */
static inline bool run_mode_holds(enum run_mode mode)
{
    return mode == RUN_REHEARSING_CALLS || mode == RUN_BUILDING_CALLS;
}
static inline bool run_mode_builds(enum run_mode mode)
{
    return mode == RUN_BUILDING_CALLS || mode == RUN_BUILDING;
}

/* When something is evaluated, and calls that are foreseen. */
struct run {
    struct replay *replay;   /* NULL: nothing is noted */
    int calls_noted;         /* and not performed yet */
    int turns_in_row;        /* of loops that were foreseen, with nothing else in between */
    int turns_between_looks; /* so many there were when somebody looked or did something else */
    int looks_alike;         /* so often, one after the other, there were as many */
    uint64_t trace[TRACE_LENGTH]; /* the last stores, for finding the place in a loop */
    uint64_t trace_hash, trace_power, flush_hash;
    uint32_t trace_count;
    bool sliced;         /* there has been a slice: see slices.c */
    uint64_t roll_after; /* values waiting before the next try */
    bool flush_due;      /* an evaluation, before the next instruction */
    enum run_mode mode;
    struct plan *rehearsed; /* by the last rehearsal; NULL: there was nothing to compute */
    uint64_t flush_place;   /* trace_hash where it became due */
    enum machine_status flush_status; /* of one that failed: said at the next store */
    uint64_t stores, stores_evaluated, flushes, calls_foreseen;
};

/* Evaluates targets (may be none) and whatever else should be: all: everything that is live. */
enum machine_status run_evaluate(struct machine *m, struct machine_value **targets, int count,
                                 bool all);
enum machine_status run_after_store(struct machine *m, const struct machine_value *v);
/* What became due at a store is done between instructions. */
void run_flush_due(struct machine *m);
void run_init(struct machine *m);

#endif
