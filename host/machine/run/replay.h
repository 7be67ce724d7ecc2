/* replay.h - calls seen before are noted, and performed all at once.
 *
 * A program that repeats a step makes the same calls again, and they make the same graph again.
 * Once a step has been recorded and evaluated between two equal states of the machine, its
 * calls are only compared with the expected ones the next time. At the last of them, the plan
 * that was made for the step runs again, on other buffers.
 *
 *     state   what all fields and flags hold, as a graph whose leaves are numbered buffers:
 *             which buffers they are is no part of it. Found again by its signature.
 *     edge    the calls that lead from a state to a state (often the same one), and what their
 *             evaluation ran: for each argument of its kernels, which buffer of the first state
 *             or which number, and for each buffer of the second, where it comes from.
 *
 *          calls 1..n      evaluation
 *     S ---------------- > ---------- > T        S, T: found by signature when the evaluation
 *                                                is over
 *
 * A state keeps a graph of its own. While the machine is in it, that graph is what fields and
 * flags hold: running an edge then only moves buffers from leaf to leaf (S = T), or puts T's
 * graph in the place of S's. As soon as anything else is done to the graph the state leaves it
 * to the machine and makes itself a copy (leave). If noted calls turn out to lead elsewhere,
 * they are performed after all (perform_calls). The program cannot notice the delay, because
 * every observation performs the noted calls first.
 *
 * The effect of a call depends on its words, the current VP set, the state, and the existing
 * fields. When fields are deallocated or a VP set changes its geometry, everything noted is
 * forgotten. While there are aliases, nothing is noted.
 *
 *   states.c   the graphs that fields and flags hold, found again by signature
 *   history.c  calls that repeat
 *   record.c   what an evaluation made of the calls before it: edges
 *   perform.c  an edge run once, or its calls performed one by one
 *   turns.c    how many turns of a loop are worth evaluating at once
 *   notes.c    calls that are foreseen
 */
#ifndef LUTETIA_MACHINE_REPLAY_H
#define LUTETIA_MACHINE_REPLAY_H

#include "memory/lifetimes.h"
#include "plans/plans.h"
#include "run/run.h"

enum { STATES_MOST = 16, EDGES_MOST = 8, CALLS_MOST = 8192, HASHES_SEEN = 64 };

/* What an evaluation ran, and what became of each buffer. */
struct deed {
    struct plan *plan; /* NULL: nothing ran */
    uint32_t version;  /* of the plan */
    uint64_t stores;
    int nodes_count;               /* nodes of the plan's signature */
    int32_t *from;                 /* by node: its buffer in the first state; -1: none */
    struct machine_value **values; /* by node: its value, if it is a constant or keeps its
                                    * own buffer */
    bool *dies;                    /* by node: its buffer is in no later state */
    bool *kept;                    /* by node: what the plan stored is in the second state */
    int32_t *next; /* by buffer of the second state: its number in the first state, or ~node
                    * of the plan */
    /* Buffers of the first state that the plan does not read, and that are not in the
     * second. */
    int32_t *spare;
    int spare_count;
};

struct edge {
    struct machine_call *calls;
    int calls_count;
    bool alone; /* the evaluation was due by itself after the last call; the program did not
                 * look */
    int to;     /* state */
    struct deed deed;
    /* For a loop (alone, and leading back to its state): many turns of it in one evaluation. */
    struct deed turns;
    int turns_count; /* turns at once; 0: not decided, 1: many do not pay */
    int turns_most;  /* more turns do not fit one kernel; 0: not known */
    /* Plans whose kernels are being built: for many turns, and for one turn that leaves
     * nothing to compute. NULL: none. */
    struct plan *rehearsed, *rehearsed_thorough;
    bool wants_thorough; /* rehearse a thorough turn with the next one */
    uint64_t runs;
};

struct leaf {
    struct machine_value *node;
    uint32_t number; /* of its buffer */
};

struct state {
    uint32_t *signature;
    uint32_t length;
    uint64_t hash;
    struct machine_value *
        *roots; /* the values of flags, slots and recorded overflows, in order: see
                 * each_root() */
    int roots_count;
    uint8_t *overflows; /* op of each VP set's recorded overflow, from 0 on; they are the last
                      * roots */
    uint64_t places;    /* hash of the set of existing flags and slots */
    struct leaf *leaves;
    int leaves_count, buffers_count;
    struct device_buffer *
        *buffers; /* while this state is active; its leaves hold the references */
    struct edge edges[EDGES_MOST];
    int edges_count, edge_last;
};

/* The hashes of the last calls that were performed one by one, to find repetitions: if the
 * last few calls were met before, the distance is a candidate for the period; a whole
 * further period confirms it. */
enum {
    HISTORY = LIFETIMES,
    WINDOW = 8,
    WINDOWS = 1024,
    LOOP_SURE = 128,
    LOOPS_ONE_BY_ONE = 16
};

struct history {
    uint64_t hashes[HISTORY], window;
    uint32_t count, period, match;
    /* Calls so far where a turn ends: where most bytes are dead; where the program first
     * looked. 0: not known. */
    uint32_t turn_at, looked_at;
    /* Each turn is evaluated, however short, because several together take no fewer kernels.
     * Below: loops of which this is known, as sums of their calls' hashes. */
    bool one_by_one, one_by_one_known;
    uint64_t sums[LOOPS_ONE_BY_ONE];
    uint32_t sums_count;
    struct {
        uint64_t window;
        uint32_t at;
    } met[WINDOWS];
};

/* Whether operations are computed as they are called: at_once_when.c. */
enum at_once_may { AT_ONCE_UNKNOWN, AT_ONCE_NEVER, AT_ONCE_SOMETIMES, AT_ONCE_ALWAYS };

struct replay {
    struct history history;
    uint32_t since; /* calls performed one by one since the last evaluation */
    bool looked;    /* ... which was for an observation */
    struct state states[STATES_MOST];
    int states_count, active; /* -1: none */
    uint64_t seen[HASHES_SEEN];
    uint32_t seen_count;

    /* Of the active state: the edge whose calls are noted (a loop's again and again); `at`
     * is the next call. */
    struct edge *edge;
    int at;
    bool thorough; /* evaluations leave nothing to compute, so that all turns of a loop begin
                    * alike */
    int building_calls;  /* calls so far of the turns that are being performed */
    uint64_t not_before; /* the number of evaluations at which many turns are tried again */
    uint64_t built_at;   /* the number of evaluations when many turns last ran */

    /* The calls performed since the last evaluation, which left the state `from`. */
    struct machine_call *log;
    int log_count, log_capacity;
    int from; /* -1: not known, or something other than calls has happened since */
    struct device_buffer **from_buffers; /* referenced; NULL: nobody needs it any more */
    int from_buffers_count;
    uint64_t from_stores;
    int depth;        /* nesting depth of calls being performed */
    struct edge made; /* the edge made by the evaluation under way */
    bool making;
    bool forgets; /* all states are forgotten after it, because the loop was evaluated
                   * otherwise in them */

    /* Evaluations after which a state was looked for, and no call was foreseen since: see
     * record.c. */
    int in_vain;
    uint64_t foreseen; /* calls foreseen by then */
    enum at_once_may at_once;
    uint64_t foreseen_at_once, unforeseen; /* calls foreseen; calls performed since then */
    bool is_short;                         /* the plan of the last evaluation is */

    struct device_buffer **scratch;
    int scratch_capacity;
};

/* Everything reachable from fields and flags. */
struct walk {
    struct machine_value **nodes; /* inputs before users */
    int count, capacity;
    struct device_buffer **buffers; /* in the order in which they are met */
    int buffers_count, buffers_capacity;
    uint32_t *signature;
    int length, signature_capacity;
    int roots_count;
    uint64_t places; /* hash of the set of existing flags and slots */
    bool good;       /* everything in it can be part of a state */
    /* Values that no state keeps are not part of it: those made only of constants, and
     * computed since. */
    bool of_state;
};

/* ---- states.c ---- */

/* Walks everything reachable, computes its signature, and numbers buffers and nodes. */
void states_walk(struct machine *m, struct walk *w);
void walk_finish(struct walk *w);
/* Returns the state walked, creating it if its signature was seen before; -1: not yet. */
int state_find(struct machine *m, struct walk *w);
/* Makes the state active: from now on fields and flags hold its graph, from which it was
 * made. */
void state_activate(struct machine *m, int index, struct device_buffer *const *buffers);
/* Sets the buffers of the state's leaves; NULL: none. */
void state_buffers_put(struct machine *m, struct state *s,
                       struct device_buffer *const *buffers);
/* Leaves the active state: its graph now belongs to the machine, and the state copies it. */
void state_leave(struct machine *m);
/* Forgets all states. */
void states_forget(struct machine *m);
void deed_finish(struct machine *m, struct deed *d);
void edge_finish(struct machine *m, struct edge *e);
/* Calls from now on lead from that state; -1: from none. */
void states_from(struct machine *m, int index);
void states_from_forget(struct machine *m);
/* Called before the content of a field or flag changes, or a kept node. */
void states_before_change(struct machine *m);

/* ---- history.c ---- */

/* Called before a call is performed. */
void history_call(struct machine *m, const struct machine_call *call);
/* Called after a call. Whether a turn of the loop is complete, or several, if turns are
 * short. */
bool history_turn_ends(const struct machine *m);
/* Called before what was recorded since the last evaluation is evaluated. due: not
 * requested. True: these are several turns of a loop, which will be evaluated one by one
 * from now on. */
bool history_evaluates(struct machine *m, const struct plan *plan, bool due);
void history_looked(struct machine *m); /* the program observed something, or a new sequence
                                         * begins */

bool history_in_loop(const struct machine *m); /* evaluations then become due after calls */

/* ---- record.c ---- */

bool record_init(struct machine *m);
void record_finish(struct machine *m);
/* Called when the effect depended on more than the call and the state. */
void record_impure(struct machine *m);
/* Whether calls are recorded from a state to the next evaluation. */
bool record_follows(const struct machine *m);
/* Called when an evaluation is about to run the plan for these nodes; when it has (buffers
 * include the stored ones); when it failed. due: not requested. */
void record_evaluates(struct machine *m, struct plan *plan, struct machine_value *const *nodes,
                      int count, struct device_buffer *const *buffers, bool due);
void record_evaluated(struct machine *m, struct device_buffer *const *buffers,
                      struct machine_value *const *wanted, int wanted_count, bool due);
void record_failed(struct machine *m);
bool record_same_call(const struct machine_call *a, const struct machine_call *b);
bool record_begins_alike(const struct edge *a, const struct edge *b, int count);

/* ---- perform.c ---- */

/* False: impossible now. */
bool perform_deed(struct machine *m, const struct deed *d, int to);
/* Performs the noted calls one by one, in that mode; then the mode is RUN_FREE again. */
void perform_calls(struct machine *m, enum run_mode mode);

/* ---- turns.c ---- */

/* How many turns of the edge are noted before any is performed. */
int turns_noted(struct machine *m, struct edge *e);
/* Runs many turns of the loop for the first time: performed call by call, and evaluated at
 * the end. */
void turns_build(struct machine *m);
/* Prepares the kernels of many turns. AT_HAND: the kernels are available without waiting for
 * the background. WAIT: nothing was performed; turns go on one by one. PERFORMED: everything
 * noted was performed; many turns do not pay. */
enum loop_turns { TURNS_AT_HAND, TURNS_WAIT, TURNS_PERFORMED };
enum loop_turns turns_see_to(struct machine *m);
/* The same for one turn that leaves nothing to compute. False: everything noted was
 * performed. */
bool turns_thorough_see_to(struct machine *m);
/* Called after turns one by one (many: or many at once). Decides whether evaluations are to
 * be thorough. */
void turns_turned(struct machine *m, struct edge *e, bool many);
/* Runs all turns of the edge that were noted, except an incomplete last one. False:
 * impossible, and none of what is still noted was performed. */
bool turns_do(struct machine *m);

#endif
