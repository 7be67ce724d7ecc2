/* replay.h - calls seen before: taken note of, and performed all at once.
 *
 * A program that repeats a step makes the same calls again, and they make the same graph again. So once
 * a step has been recorded and evaluated between two states of the machine that look alike, the next time
 * its calls are only compared with those expected; with the last one the plan that was made for them runs
 * again, on other buffers.
 *
 *     state   what all fields and flags hold, as a graph whose leaves are numbered buffers: which
 *             buffers they are is no part of it. Found again by its signature.
 *     edge    the calls that lead from a state to a state (often the same one), and what their
 *             evaluation ran: for each argument of its kernels, which buffer of the first state or which
 *             number, and for each buffer of the second, where it comes from.
 *
 *          calls 1..n      evaluation
 *     S ---------------- > ---------- > T        S, T: found by signature when the evaluation is over
 *
 * A state keeps a graph of its own. While the machine is in it, that graph is what fields and flags hold:
 * running an edge then only moves buffers from leaf to leaf (S = T), or puts T's graph in the place of
 * S's. As soon as anything else is done to the graph the state leaves it to the machine and makes itself a
 * copy (leave). Calls noted that turn out to lead elsewhere are performed after all (perform_calls): they
 * change nothing that a program could have seen meanwhile, for whoever looks catches up first.
 *
 * What a call does follows from its words, the current VP set, the state, and which fields there are: when
 * those die or change their VP sets' geometry everything noted is forgotten. Where there are aliases,
 * nothing is noted.
 *
 *   states.c   the graphs that fields and flags hold, found again by signature
 *   history.c  calls that repeat
 *   record.c   what an evaluation made of the calls before it: edges
 *   perform.c  an edge run once, or its calls performed one by one
 *   turns.c    how many turns of a loop are worth evaluating at once
 *   notes.c    calls that are foreseen */
#ifndef LUTETIA_MACHINE_REPLAY_H
#define LUTETIA_MACHINE_REPLAY_H

#include "build/plans.h"
#include "memory/lifetimes.h"
#include "run/run.h"

enum { STATES_MOST = 16, EDGES_MOST = 8, CALLS_MOST = 8192, HASHES_SEEN = 64 };

/* What an evaluation ran, and what became of the buffers. */
struct deed {
    struct plan *plan; /* NULL: there is none */
    uint32_t version;  /* of the plan */
    uint64_t stores;
    int nodes_count;               /* of the plan's signature */
    int32_t *from;                 /* each node's buffer in the first state; -1: none */
    struct machine_value **values; /* each node that is a number, or keeps its own buffer */
    bool *dies;                    /* each node: its buffer is in no later state */
    bool *kept;                    /* ... what the plan has stored is in the second state */
    int32_t *next; /* each buffer of the second state: in the first one, or ~node of the plan */
    /* Buffers of the first state that the plan does not take, and that are not in the second. */
    int32_t *spare;
    int spare_count;
};

struct edge {
    struct machine_call *calls;
    int calls_count;
    bool alone; /* the evaluation came of itself after the last call; nobody looked */
    int to;     /* state */
    struct deed deed;
    /* Of a loop, which is alone and leads back to its state: many turns of it in one evaluation. */
    struct deed turns;
    int turns_count; /* of them; 0: not decided, 1: none are worth it */
    int turns_most;  /* more cannot be one kernel; 0: that is not known */
    /* Plans whose kernels are being built: of many turns; of one that leaves nothing to compute. NULL: none. */
    struct plan *rehearsed, *rehearsed_thorough;
    bool wants_thorough; /* the latter is to be rehearsed with the next turn */
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
        *roots; /* what flags, slots and lazy overflows hold, in order: see each_root() */
    int roots_count;
    uint8_t
        *overflows;  /* op of each VP set's lazy overflow, from 0 on; they are the last roots */
    uint64_t places; /* hash of which flags and slots there are */
    struct leaf *leaves;
    int leaves_count, buffers_count;
    struct device_buffer *
        *buffers; /* while it is the active one; the leaves hold the references */
    struct edge edges[EDGES_MOST];
    int edges_count, edge_last;
};

/* The last calls that were performed one by one, by hash, to see that they repeat: those that the last few
 * were met with before tell a period, and a whole period more that it is one. */
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
    /* Calls so far where a turn ends: when most are dead; when somebody first looked. 0: that is not known. */
    uint32_t turn_at, looked_at;
    /* Each turn is evaluated, however little it is: several together take no fewer kernels. Loops of which that is known, as
     * sums of their calls' hashes. */
    bool one_by_one, one_by_one_known;
    uint64_t sums[LOOPS_ONE_BY_ONE];
    uint32_t sums_count;
    struct {
        uint64_t window;
        uint32_t at;
    } met[WINDOWS];
};

struct replay {
    struct history history;
    uint32_t since; /* calls performed one by one since the last evaluation */
    bool looked;    /* ... which was for somebody who looked */
    struct state states[STATES_MOST];
    int states_count, active; /* -1: none */
    uint64_t seen[HASHES_SEEN];
    uint32_t seen_count;

    /* Of the active state: its calls, in a loop's case again and again, are noted; `at` is the next one. */
    struct edge *edge;
    int at;
    bool thorough; /* evaluations leave nothing to compute: all turns of a loop begin alike */
    int building_calls;  /* in the turns that are being performed */
    uint64_t not_before; /* evaluations: many turns are tried again then */
    uint64_t built_at;   /* evaluations when many turns ran last */

    /* Calls performed since the last evaluation, in a state that was `from` then. */
    struct machine_call *log;
    int log_count, log_capacity;
    int from; /* -1: not known, or something else than calls has happened since */
    struct device_buffer **from_buffers; /* referenced */
    int from_buffers_count;
    uint64_t from_stores;
    int depth;        /* calls being performed, one in another */
    struct edge made; /* by the evaluation under way */
    bool making;
    bool forgets; /* all states, after it: the loop was evaluated otherwise in them */

    struct device_buffer **scratch;
    int scratch_capacity;
};

/* What can be reached from fields and flags. */
struct walk {
    struct machine_value **nodes; /* inputs before users */
    int count, capacity;
    struct device_buffer **buffers; /* in the order in which they are met */
    int buffers_count, buffers_capacity;
    uint32_t *signature;
    int length, signature_capacity;
    int roots_count;
    uint64_t places; /* hash of which flags and slots there are */
    bool good;       /* nothing in it that cannot be in a state */
    /* Leaves that no state keeps are none of it: made of numbers alone, and computed since. */
    bool of_state;
};

/* ---- states.c ---- */

/* All that can be reached, and its signature; buffers and nodes are numbered. */
void states_walk(struct machine *m, struct walk *w);
void walk_finish(struct walk *w);
/* The state walked, made if it was seen before without being one; -1: not yet. */
int state_find(struct machine *m, struct walk *w);
/* Fields and flags hold the state's graph from now on; they are those that it was made of. */
void state_activate(struct machine *m, int index, struct device_buffer *const *buffers);
/* Other buffers for the state's leaves; NULL: none. */
void state_buffers_put(struct machine *m, struct state *s,
                       struct device_buffer *const *buffers);
/* The graph is the machine's alone from now on; the active state makes itself another. */
void state_leave(struct machine *m);
/* There are no states any more. */
void states_forget(struct machine *m);
void deed_finish(struct machine *m, struct deed *d);
void edge_finish(struct machine *m, struct edge *e);
/* Calls from now on lead from that state; or from none. */
void states_from(struct machine *m, int index);
void states_from_forget(struct machine *m);
/* Before the content of a field or flag changes, or a node that is kept. */
void states_before_change(struct machine *m);

/* ---- history.c ---- */

/* A call is going to be performed. */
void history_call(struct machine *m, const struct machine_call *call);
/* After a call: a turn of the loop is complete, or several if they are short. */
bool history_turn_ends(const struct machine *m);
/* What has been recorded since the last evaluation is going to be evaluated so. due: nobody asked for it. True: several turns of a loop, which are
 * evaluated one by one from now on. */
bool history_evaluates(struct machine *m, const struct plan *plan, bool due);
void history_looked(struct machine *m); /* somebody has, or something else begins */

bool history_in_loop(const struct machine *m); /* then evaluations become due after calls */

/* ---- record.c ---- */

bool record_init(struct machine *m);
void record_finish(struct machine *m);
/* Something was done that depends on more than the call and the state. */
void record_impure(struct machine *m);
/* Calls are noted that lead from a state to the next evaluation. */
bool record_follows(const struct machine *m);
/* An evaluation is about to run the plan for these nodes; has run it (buffers: with those stored); or
 * could not. due: nobody asked for it. */
void record_evaluates(struct machine *m, struct plan *plan, struct machine_value *const *nodes,
                      int count, struct device_buffer *const *buffers, bool due);
void record_evaluated(struct machine *m, struct device_buffer *const *buffers,
                      struct machine_value *const *wanted, int wanted_count, bool due);
void record_failed(struct machine *m);
bool record_same_call(const struct machine_call *a, const struct machine_call *b);
bool record_begins_alike(const struct edge *a, const struct edge *b, int count);

/* ---- perform.c ---- */

/* False: that cannot be done now. */
bool perform_deed(struct machine *m, const struct deed *d, int to);
/* The calls noted are performed, one by one, in that mode; then the machine is free again. */
void perform_calls(struct machine *m, enum run_mode mode);

/* ---- turns.c ---- */

/* How many turns of it are noted before any is performed. */
int turns_noted(struct machine *m, struct edge *e);
/* Many turns of the loop, for the first time: performed call by call, and evaluated at the end. */
void turns_build(struct machine *m);
/* Their kernels are seen to. AT_HAND: they can be built so without waiting for the background; WAIT: turns go on one by
 * one, for nothing has been performed; PERFORMED: all that was noted has been, and many turns are not worth it. */
enum loop_turns { TURNS_AT_HAND, TURNS_WAIT, TURNS_PERFORMED };
enum loop_turns turns_see_to(struct machine *m);
/* So for one turn that leaves nothing to compute. False: all that was noted has been performed. */
bool turns_thorough_see_to(struct machine *m);
/* After turns of it, one by one (many: or many at once): whether evaluations are to be thorough. */
void turns_turned(struct machine *m, struct edge *e, bool many);
/* All turns of the edge that have been noted, but for the last one that is not whole. False: it cannot be
 * done, and nothing of what is still noted has been. */
bool turns_do(struct machine *m);

#endif
