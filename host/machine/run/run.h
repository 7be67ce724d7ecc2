/* run.h - when something is evaluated: see run.c. */
#ifndef LUTETIA_MACHINE_RUN_H
#define LUTETIA_MACHINE_RUN_H

#include "values/values.h"

struct replay;
enum { PENDING_MOST = 4096, PENDING_LOOP = 16384, HEIGHT_DEFERRED = 96, HEIGHT_MOST = 1500 };
enum { TRACE_LENGTH = 128 };

/* When something is evaluated, and calls that are foreseen. */
struct run {
    bool eager;
    struct replay *replay;   /* NULL: nothing is noted */
    int calls_noted;         /* and not performed yet */
    int turns_in_row;        /* of loops that were foreseen, with nothing else in between */
    int turns_between_looks; /* so many there were when somebody looked or did something else */
    int looks_alike;         /* so often, one after the other, there were as many */
    uint64_t trace[TRACE_LENGTH]; /* the last stores, for finding the place in a loop */
    uint64_t trace_hash, trace_power, flush_hash;
    uint32_t trace_count;
    bool sliced;              /* there has been a slice: see slices.c */
    bool rolling;             /* in roll_waiting() */
    uint64_t roll_after;      /* values waiting before the next try */
    bool flush_due, flushing; /* before the next instruction; just now */
    bool hold_flush;          /* none becomes due */
    bool building; /* many turns are being performed, to be evaluated at once; it is worth it */
    uint64_t flush_place;             /* trace_hash where it became due */
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
bool run_in_call(const struct machine *m);
bool run_thorough(const struct machine *m); /* evaluations are to leave nothing to compute */

void run_resolve(struct machine *m); /* ... no lazy overflow either */

enum machine_status evaluate(struct machine *m, struct machine_value **wanted, int count,
                             bool all);

#endif
