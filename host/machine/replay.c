/* replay.c - calls seen before: taken note of, and performed all at once.
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
 * copy (leave). Calls noted that turn out to lead elsewhere are performed after all (catch_up): they
 * change nothing that a program could have seen meanwhile, for whoever looks catches up first.
 *
 * What a call does follows from its words, the current VP set, the state, and which fields there are: when
 * those die or change their VP sets' geometry everything noted is forgotten. Where there are aliases,
 * nothing is noted. */
#include <stdlib.h>
#include <string.h>

#include "watch.h"

/* The part of a place that is of a lazy overflow; others are flags and lengths. */
#define OVERFLOW_PART (UINT32_MAX - 255)

enum { STATES_MOST = 16, EDGES_MOST = 8, CALLS_MOST = 8192, HASHES_SEEN = 64 };

/* A loop that has turned so often is tried with so many turns at once. */
enum { TURNS_SEEN = 6, TURNS_MOST = 8, TRY_AGAIN = 8192 };

/* What an evaluation ran, and what became of the buffers. */
struct deed {
    struct plan *plan; /* NULL: there is none */
    uint32_t version;  /* of the plan */
    uint64_t stores;
    int nodes_count;               /* of the plan's signature */
    int32_t *from;                 /* each node's buffer in the first state; -1: none */
    struct machine_value **values; /* each node that is a number, or keeps its own buffer */
    int32_t *next; /* each buffer of the second state: in the first one, or ~node of the plan */
};

struct edge {
    struct machine_call *calls;
    int calls_count;
    bool alone; /* the evaluation came of itself after the last call; nobody looked */
    int to;     /* state */
    struct deed deed;
    /* Of a loop, which is alone and leads back to its state: many turns of it in one evaluation. */
    struct deed turns;
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
enum { HISTORY = 4096, WINDOW = 8, WINDOWS = 1024, LOOP_SURE = 128 };

struct history {
    uint64_t hashes[HISTORY], window;
    uint32_t count, period, match;
    struct {
        uint64_t window;
        uint32_t at;
    } met[WINDOWS];
};

struct replay {
    struct history history;
    uint32_t since; /* calls performed one by one since the last evaluation */
    struct state states[STATES_MOST];
    int states_count, active; /* -1: none */
    uint64_t seen[HASHES_SEEN];
    uint32_t seen_count;

    /* Of the active state: its calls, in a loop's case again and again, are noted; `at` is the next one. */
    struct edge *edge;
    int at;
    int turns_most; /* evaluated at once */
    bool thorough;  /* evaluations leave nothing to compute: all turns of a loop begin alike */
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
    int depth; /* calls being performed, one in another */
    bool catching_up;
    struct edge made; /* by the evaluation under way */
    bool making;

    struct device_buffer **scratch;
    int scratch_capacity;
};

static void *grown(void *old, int *capacity, size_t element)
{
    int wanted = *capacity ? *capacity * 2 : 64;
    void *new = realloc(old, (size_t)wanted * element);
    INVARIANT(new != NULL);
    *capacity = wanted;
    return new;
}

static void *allocated(size_t count, size_t element)
{
    void *new = calloc(count ? count : 1, element);
    INVARIANT(new != NULL);
    return new;
}

bool replay_init(struct machine *m)
{
    const char *wish = getenv("LUTETIA_REPLAY");
    if (m->eager || (wish && *wish == '0'))
        return true;
    m->replay = calloc(1, sizeof *m->replay);
    if (!m->replay)
        return false;
    m->replay->active = m->replay->from = -1;
    const char *turns = getenv("LUTETIA_TURNS");
    m->replay->turns_most = turns && *turns ? atoi(turns) : TURNS_MOST;
    return true;
}

/* ---- the graph that fields and flags hold ---- */

struct walk;

/* Calls visit with every place that holds a value, always in the same order: of flags, of slots, and of lazy
 * overflows, which have three for each VP set, NULL where there is none. */
struct root_visit {
    struct machine *m;
    void (*visit)(struct root_visit *visit, struct machine_value **place, uint32_t id,
                  uint32_t part);
    struct walk *walk;
    struct machine_value **values;
    int count;
    uint64_t places;
};

static void each_root(struct root_visit *v)
{
    struct machine *m = v->m;
    for (int i = 1; i < m->sets_count; i++)
        for (int flag = 0; m->sets[i].used && flag < 3; flag++)
            v->visit(v, &m->sets[i].flags[flag].value, (uint32_t)i, (uint32_t)flag);
    for (int i = 0; i < m->fields_count; i++) {
        struct field *f = m->fields[i];
        for (int k = 0; k < f->slots_count; k++)
            v->visit(v, &f->slots[k].value, f->base + f->slots[k].offset, f->slots[k].bits);
    }
    for (int i = 1; i < m->sets_count; i++) {
        struct lazy_overflow *o = &m->sets[i].overflow;
        struct machine_value **places[3] = {&o->a, &o->b, &o->context};
        for (int k = 0; k < 3; k++)
            v->visit(v, places[k], (uint32_t)i, OVERFLOW_PART);
    }
}

/* What is no overflow any more is nothing. */
static void overflows_tidy(struct machine *m)
{
    for (int i = 1; i < m->sets_count; i++)
        if (!m->sets[i].overflow.op)
            m->sets[i].overflow = (struct lazy_overflow){.op = 0};
}

struct walk {
    struct machine_value **nodes; /* inputs before users */
    int count, capacity;
    struct device_buffer **buffers; /* in the order in which they are met */
    int buffers_count, buffers_capacity;
    uint32_t *signature;
    int length, signature_capacity;
    bool good; /* nothing in it that cannot be in a state */
    bool
        of_state; /* leaves that no state keeps are none of it: made of numbers alone, and computed since */
};

static bool is_leaf(const struct machine_value *v)
{
    return v->op == NODE_BUFFER;
}

static bool is_own_leaf(const struct walk *w, const struct machine_value *v)
{
    return is_leaf(v) && (v->kept || !w->of_state);
}

static void say(struct walk *w, uint32_t word)
{
    if (w->length == w->signature_capacity)
        w->signature = grown(w->signature, &w->signature_capacity, sizeof *w->signature);
    w->signature[w->length++] = word;
}

static void walk_node(struct machine *m, struct walk *w, struct machine_value *v)
{
    if (v->mark == m->mark)
        return;
    v->mark = m->mark;
    bool leaf = is_leaf(v);
    int inputs = leaf ? 0 : node_ops[v->op].inputs;
    for (int i = 0; i < inputs; i++)
        walk_node(m, w, v->in[i]);
    if (v->op == NODE_SLICE)
        w->good = false;
    if (w->count == w->capacity)
        w->nodes = grown(w->nodes, &w->capacity, sizeof *w->nodes);
    v->local = (uint32_t)w->count;
    w->nodes[w->count++] = v;
    say(w, (uint32_t)v->op | (uint32_t)v->type.kind << 8 | (uint32_t)v->type.width << 16 |
               (uint32_t)v->axis << 24);
    say(w, v->set | (uint32_t)m->sets[v->set].generation << 16);
    say(w, v->type.s | (uint32_t)v->type.e << 8 | (uint32_t)v->maybe_nan << 16);
    if (leaf && !is_own_leaf(w, v))
        return;
    if (leaf) {
        struct device_buffer *b = v->buffer;
        if (b->mark != m->mark) {
            b->mark = m->mark;
            b->number = (uint32_t)w->buffers_count;
            if (w->buffers_count == w->buffers_capacity)
                w->buffers =
                    grown(w->buffers, &w->buffers_capacity, sizeof(struct device_buffer *));
            w->buffers[w->buffers_count++] = b;
        }
        say(w, b->number);
        return;
    }
    say(w, (uint32_t)v->detail);
    for (int i = 0; i < inputs; i++)
        say(w, v->in[i]->local);
    if (v->imm.lo | v->imm.hi) {
        say(w, (uint32_t)v->imm.lo);
        say(w, (uint32_t)(v->imm.lo >> 32));
        say(w, (uint32_t)v->imm.hi);
        say(w, (uint32_t)(v->imm.hi >> 32));
    }
}

static void walk_root(struct root_visit *visit, struct machine_value **place, uint32_t id,
                      uint32_t part)
{
    struct walk *w = visit->walk;
    visit->count++;
    if (!*place)
        return;
    walk_node(visit->m, w, *place);
    say(w, id | UINT32_C(0x80000000));
    say(w, part == OVERFLOW_PART ? part + visit->m->sets[id].overflow.op : part);
    say(w, (*place)->local);
    if (part != OVERFLOW_PART)
        visit->places = (visit->places ^ id ^ (uint64_t)part << 32) * 0x9e3779b97f4a7c15u +
                        (visit->places >> 29);
}

/* All that can be reached, and its signature. */
static struct root_visit walk_all(struct machine *m, struct walk *w)
{
    struct root_visit visit = {.m = m, .visit = walk_root, .walk = w};
    *w = (struct walk){.good = true};
    m->mark++;
    for (int i = 0; i < m->fields_count; i++)
        w->good = w->good && !m->fields[i]->root;
    if (w->good) {
        overflows_tidy(m);
        each_root(&visit);
    }
    return visit;
}

static void walk_finish(struct walk *w)
{
    free(w->nodes);
    free(w->buffers);
    free(w->signature);
}

/* ---- states ---- */

/* A graph like the one walked, with leaves of its own that have no buffers yet. The walk's nodes keep
 * their places: copies[i] is that of nodes[i]. */
static void template_copy(struct machine *m, struct state *s, const struct walk *w)
{
    struct machine_value **copies = allocated((size_t)w->count, sizeof *copies);
    s->leaves = allocated((size_t)w->count, sizeof *s->leaves);
    s->leaves_count = 0;
    for (int i = 0; i < w->count; i++) {
        struct machine_value *v = w->nodes[i];
        if (is_own_leaf(w, v)) {
            copies[i] = graph_buffer_node(m, v->type, v->set, NULL);
            graph_keep(m, copies[i], true);
            s->leaves[s->leaves_count++] = (struct leaf){copies[i], v->buffer->number};
            continue;
        }
        struct machine_value key = *v;
        bool same = true;
        for (int k = 0; k < (is_leaf(v) ? 0 : node_ops[v->op].inputs); k++) {
            key.in[k] = copies[v->in[k]->local];
            same = same && key.in[k] == v->in[k];
        }
        copies[i] = same ? v : graph_node(m, &key);
        if (!same) {
            copies[i]->birth = v->birth;
            copies[i]->told = true; /* the program did not make it */
            graph_keep(m, copies[i], true);
        }
    }
    for (int i = 0; i < s->roots_count; i++)
        if (s->roots[i]) {
            s->roots[i] = copies[s->roots[i]->local];
            graph_ref(s->roots[i]);
        }
    free(copies);
}

static void collect_root(struct root_visit *visit, struct machine_value **place, uint32_t id,
                         uint32_t part)
{
    (void)id;
    (void)part;
    visit->values[visit->count++] = *place;
}

/* The state has a graph of its own, like that which fields and flags hold. */
static void template_make(struct machine *m, struct state *s, const struct walk *w)
{
    struct root_visit visit = {.m = m, .visit = collect_root, .values = s->roots};
    each_root(&visit);
    for (int i = 1; i < m->sets_count; i++)
        s->overflows[i] = m->sets[i].overflow.op;
    template_copy(m, s, w);
}

static void leaf_set(struct machine *m, struct machine_value *leaf, struct device_buffer *b)
{
    struct device_buffer *old = leaf->buffer;
    if (b)
        device_buffer_ref(b);
    leaf->buffer = b;
    if (old)
        device_buffer_unref(m, old);
}

static void put_root(struct root_visit *visit, struct machine_value **place, uint32_t id,
                     uint32_t part)
{
    (void)id;
    (void)part;
    struct machine_value *old = *place;
    *place = visit->values[visit->count++];
    if (*place)
        graph_ref(*place);
    if (old)
        graph_unref(visit->m, old);
}

/* Fields and flags hold the state's graph from now on; they are those that it was made of. */
static void activate(struct machine *m, int index, struct device_buffer *const *buffers)
{
    struct replay *p = m->replay;
    struct state *s = &p->states[index];
    for (int i = 0; i < s->leaves_count; i++)
        leaf_set(m, s->leaves[i].node, buffers[s->leaves[i].number]);
    memcpy(s->buffers, buffers, (size_t)s->buffers_count * sizeof *buffers);
    struct root_visit visit = {.m = m, .visit = put_root, .values = s->roots};
    overflows_tidy(m);
    each_root(&visit);
    INVARIANT(visit.count == s->roots_count);
    for (int i = 1; i < m->sets_count; i++)
        m->sets[i].overflow.op = s->overflows[i];
    p->active = index;
    p->edge = s->edges_count && !p->catching_up ? &s->edges[s->edge_last] : NULL;
    p->at = m->calls_noted = 0;
}

static void deed_finish(struct machine *m, struct deed *d)
{
    for (int i = 0; d->values && i < d->nodes_count; i++)
        if (d->values[i])
            graph_unref(m, d->values[i]);
    free(d->from);
    free(d->values);
    free(d->next);
    *d = (struct deed){.plan = NULL};
}

static void edge_finish(struct machine *m, struct edge *e)
{
    deed_finish(m, &e->deed);
    deed_finish(m, &e->turns);
    free(e->calls);
}

static void template_release(struct machine *m, struct state *s)
{
    for (int i = 0; i < s->roots_count; i++)
        if (s->roots[i])
            graph_unref(m, s->roots[i]);
    free(s->roots);
    free(s->leaves);
}

static void from_forget(struct machine *m)
{
    struct replay *p = m->replay;
    for (int i = 0; i < p->from_buffers_count; i++)
        device_buffer_unref(m, p->from_buffers[i]);
    free(p->from_buffers);
    p->from_buffers = NULL;
    p->from_buffers_count = 0;
    p->from = -1;
}

/* The graph is the machine's alone from now on; the active state makes itself another. */
static void leave(struct machine *m)
{
    struct replay *p = m->replay;
    int index = p->active;
    struct state *s = &p->states[index], old = *s;
    p->active = -1;
    p->edge = NULL;
    struct walk w = {.good = true, .of_state = true};
    m->mark++;
    for (int i = 0; i < s->roots_count; i++)
        if (s->roots[i])
            walk_node(m, &w, s->roots[i]);
    s->roots = allocated((size_t)s->roots_count, sizeof(struct machine_value *));
    memcpy(s->roots, old.roots, (size_t)s->roots_count * sizeof(struct machine_value *));
    INVARIANT(w.buffers_count == s->buffers_count);
    template_copy(m, s, &w);
    for (int i = 0; i < w.count; i++)
        graph_keep(m, w.nodes[i], false);
    walk_finish(&w);
    from_forget(m);
    if (p->depth) {
        p->from = index;
        p->from_stores = m->stores;
        p->from_buffers = allocated((size_t)s->buffers_count, sizeof(struct device_buffer *));
        p->from_buffers_count = s->buffers_count;
        memcpy(p->from_buffers, s->buffers,
               (size_t)s->buffers_count * sizeof(struct device_buffer *));
        for (int i = 0; i < s->buffers_count; i++)
            device_buffer_ref(s->buffers[i]);
    }
    template_release(m, &old);
}

void replay_changes(struct machine *m)
{
    struct replay *p = m->replay;
    if (!p)
        return;
    INVARIANT(m->calls_noted == 0);
    if (p->active >= 0)
        leave(m);
    else if (!p->depth && p->from >= 0)
        from_forget(m);
}

static void state_finish(struct machine *m, struct state *s)
{
    template_release(m, s);
    for (int i = 0; i < s->edges_count; i++)
        edge_finish(m, &s->edges[i]);
    free(s->signature);
    free(s->overflows);
    free(s->buffers);
}

static void forget(struct machine *m)
{
    struct replay *p = m->replay;
    INVARIANT(m->calls_noted == 0);
    if (p->active >= 0)
        leave(m);
    from_forget(m);
    p->edge = NULL;
    for (int i = 0; i < p->states_count; i++)
        state_finish(m, &p->states[i]);
    p->states_count = 0;
}

void replay_finish(struct machine *m)
{
    struct replay *p = m->replay;
    if (!p)
        return;
    m->calls_noted = 0; /* nobody is going to look */
    forget(m);
    free(p->log);
    free(p->scratch);
    free(p);
    m->replay = NULL;
}

void replay_forget(struct machine *m)
{
    if (!m->replay || !m->replay->states_count)
        return;
    replay_settle(m);
    forget(m);
}

/* ---- performing what was noted ---- */

static bool is_loop(const struct machine *m, const struct edge *e)
{
    return e->alone && e->to == m->replay->active;
}

/* How many turns of it are noted before any is performed. */
static int turns_noted(const struct machine *m, const struct edge *e)
{
    const struct replay *p = m->replay;
    if (!is_loop(m, e) || !p->thorough || e->runs < TURNS_SEEN)
        return 1;
    int turns = plan_turns(e->deed.plan);
    turns = turns < p->turns_most ? turns : p->turns_most;
    return turns * e->calls_count <= CALLS_MOST ? turns : 1;
}

/* False: that cannot be done now. */
static bool deed_do(struct machine *m, const struct deed *d, int to)
{
    struct replay *p = m->replay;
    struct state *s = &p->states[p->active], *t = &p->states[to];
    if (!d->plan || plan_version(m, d->plan) != d->version)
        return false;
    graph_give_back(m);
    if (d->nodes_count + t->buffers_count > p->scratch_capacity) {
        p->scratch_capacity = d->nodes_count + t->buffers_count;
        free(p->scratch);
        p->scratch = allocated((size_t)p->scratch_capacity, sizeof *p->scratch);
    }
    struct device_buffer **buffers = p->scratch, **next = p->scratch + d->nodes_count;
    for (int i = 0; i < d->nodes_count; i++)
        buffers[i] = d->from[i] >= 0 ? s->buffers[d->from[i]]
                     : d->values[i]  ? d->values[i]->buffer
                                     : NULL;
    if (plan_run(m, d->plan, buffers,
                 d->values)) /* it is going to be tried, and said, once more */
        return false;
    for (int k = 0; k < t->buffers_count; k++) {
        next[k] = d->next[k] >= 0 ? s->buffers[d->next[k]] : buffers[~d->next[k]];
        device_buffer_ref(next[k]);
    }
    int count;
    const int *stored = plan_stored(d->plan, &count);
    for (int i = 0; i < count; i++)
        device_buffer_unref(m, buffers[stored[i]]);
    p->since = 0;
    m->stores += d->stores;
    m->stores_evaluated = m->stores;
    m->flushes++;
    p->log_count = 0;
    if (s == t) {
        for (int i = 0; i < s->leaves_count; i++)
            leaf_set(m, s->leaves[i].node, next[s->leaves[i].number]);
        memcpy(s->buffers, next, (size_t)s->buffers_count * sizeof *next);
    } else {
        activate(m, to, next);
        for (int i = 0; i < s->leaves_count; i++)
            leaf_set(m, s->leaves[i].node, NULL);
    }
    for (int k = 0; k < t->buffers_count; k++)
        device_buffer_unref(m, next[k]);
    return true;
}

/* The calls noted are performed, one by one. */
static void catch_up(struct machine *m)
{
    struct replay *p = m->replay;
    int count = m->calls_noted, set = m->set_current;
    struct machine_call *calls = allocated((size_t)count, sizeof *calls);
    for (int i = 0; i < count; i++)
        calls[i] = p->edge->calls[i % p->edge->calls_count];
    m->calls_noted = p->at = 0;
    p->edge = NULL;
    p->catching_up = true;
    for (int i = 0; i < count; i++) {
        m->set_current = calls[i].vpset;
        calls[i].again(&calls[i]);
    }
    m->set_current = set;
    p->catching_up = false;
    free(calls);
    if (p->active >= 0 && p->states[p->active].edges_count) {
        struct state *s = &p->states[p->active];
        p->edge = &s->edges[s->edge_last];
    }
}

/* Loops that are worth it are to be evaluated many turns at a time. For that all turns must begin alike, and those
 * that are known do not. */
static bool become_thorough(struct machine *m, const struct edge *e)
{
    struct replay *p = m->replay;
    if (p->thorough || p->turns_most < 2 || m->flushes < p->not_before ||
        e->runs < TURNS_SEEN || !e->alone)
        return false;
    int turns = plan_turns(e->deed.plan);
    turns = turns < p->turns_most ? turns : p->turns_most;
    if (turns < 2 || m->turns_in_row < 2 * turns) /* who looks more often gains nothing */
        return false;
    p->thorough = true;
    p->built_at = m->flushes;
    forget(m);
    return true;
}

/* Where many turns have not run for long, temporaries are left alone again. */
static void stay_thorough(struct machine *m, bool turns)
{
    struct replay *p = m->replay;
    if (turns)
        p->built_at = m->flushes;
    else if (p->thorough && m->flushes - p->built_at > 64) {
        p->thorough = false;
        forget(m);
    }
}

/* Many turns of the loop, for the first time: performed call by call, and evaluated at the end. */
static void build_turns(struct machine *m)
{
    struct replay *p = m->replay;
    int active = p->active, at = (int)(p->edge - p->states[active].edges);
    m->building = m->hold_flush = true;
    p->building_calls = m->calls_noted;
    catch_up(m);
    m->hold_flush = false;
    m->flush_due = true;
    run_flush_due(m);
    m->building = false;
    bool back = p->active == active && p->states[active].edges_count > at;
    if (back && p->states[active].edges[at].turns.plan)
        return;
    p->thorough = false; /* in vain */
    p->not_before = m->flushes + TRY_AGAIN;
    forget(m);
}

/* All turns of the edge that have been noted, but for the last one that is not whole. False: it cannot be
 * done, and nothing of what is still noted has been. */
static bool turns_do(struct machine *m)
{
    struct replay *p = m->replay;
    struct edge *e = p->edge;
    int turns = turns_noted(m, e), whole = m->calls_noted / e->calls_count;
    double start = watch_clock(m);
    if (turns > 1 && whole >= turns) {
        if (!e->turns.plan) {
            build_turns(m);
            return true;
        }
        if (!deed_do(m, &e->turns, e->to))
            return false;
        m->calls_noted -= turns * e->calls_count;
        m->turns_in_row += turns;
        m->calls_foreseen += (uint64_t)turns * (uint64_t)e->calls_count;
        if (m->watch)
            watch_replayed(m, start, e->calls, e->calls_count, turns, e->alone);
        whole -= turns;
        stay_thorough(m, true);
    }
    for (; whole > 0; whole--) {
        int left = m->calls_noted - e->calls_count;
        struct state *s = &p->states[p->active];
        start = watch_clock(m);
        if (!deed_do(m, &e->deed, e->to))
            return false;
        m->calls_foreseen += (uint64_t)e->calls_count;
        m->calls_noted = left;
        m->turns_in_row++;
        if (m->watch)
            watch_replayed(m, start, e->calls, e->calls_count, 1, e->alone);
        s->edge_last = (int)(e - s->edges);
        e->runs++;
    }
    if (m->calls_noted == 0) {
        p->at = 0;
        if (!become_thorough(m, e))
            stay_thorough(m, false);
    }
    return true;
}

static bool same_call(const struct machine_call *a, const struct machine_call *b)
{
    if (a->again != b->again || a->vpset != b->vpset || a->words_count != b->words_count)
        return false;
    for (uint32_t i = 0; i < a->words_count; i++)
        if (a->words[i] != b->words[i])
            return false;
    return true;
}

static bool begins_alike(const struct edge *a, const struct edge *b, int count)
{
    if (a->calls_count < count || b->calls_count < count)
        return false;
    for (int i = 0; i < count; i++)
        if (!same_call(&a->calls[i], &b->calls[i]))
            return false;
    return true;
}

/* Another edge with the calls noted so far, and this one next (NULL: no more than those, for somebody is
 * going to look). */
static struct edge *other_edge(struct machine *m, const struct machine_call *call)
{
    struct replay *p = m->replay;
    struct state *s = &p->states[p->active];
    for (int i = 0; i < s->edges_count; i++) {
        struct edge *e = &s->edges[i];
        if (e != p->edge && begins_alike(e, p->edge, m->calls_noted) &&
            (call
                 ? e->calls_count > m->calls_noted && same_call(&e->calls[m->calls_noted], call)
                 : e->calls_count == m->calls_noted && !e->alone))
            return e;
    }
    return NULL;
}

void replay_perform(struct machine *m)
{
    struct replay *p = m->replay;
    if (m->calls_noted > p->edge->calls_count && !turns_do(m)) {
        catch_up(m);
        return;
    }
    if (!m->calls_noted)
        return;
    struct edge *e = p->edge->calls_count == m->calls_noted ? p->edge : other_edge(m, NULL);
    if (e) {
        p->edge = e;
        if (turns_do(m))
            return;
    }
    catch_up(m);
}

/* ---- loops ---- */

#define WINDOW_FACTOR 0x9e3779b97f4a7c15u

static void history_add(struct history *h, const struct machine_call *call)
{
    uint64_t hash = (uint64_t)(uintptr_t)call->again ^ (uint64_t)call->vpset << 48, leaving = 1;
    for (uint32_t i = 0; i < call->words_count; i++)
        hash = (hash ^ hash >> 29 ^ call->words[i]) * 0xbf58476d1ce4e5b9u;
    hash ^= hash >> 32;
    for (int i = 0; i < WINDOW; i++)
        leaving *= WINDOW_FACTOR;
    uint32_t at = h->count++;
    if (h->period && h->hashes[(at - h->period) % HISTORY] == hash)
        h->match++;
    else
        h->period = h->match = 0;
    uint64_t old = at >= WINDOW ? h->hashes[(at - WINDOW) % HISTORY] : 0;
    h->window = h->window * WINDOW_FACTOR + hash - old * leaving;
    h->hashes[at % HISTORY] = hash;
    uint32_t slot = (uint32_t)(h->window >> 40) % WINDOWS;
    if (!h->period && h->met[slot].window == h->window &&
        at - h->met[slot].at < HISTORY - WINDOW)
        h->period = at - h->met[slot].at;
    h->met[slot].window = h->window;
    h->met[slot].at = at;
}

/* A whole period, or much of a long one, has come again. */
bool replay_in_loop(const struct machine *m)
{
    const struct history *h = m->replay ? &m->replay->history : NULL;
    return h && h->period && h->match >= (h->period < LOOP_SURE ? h->period : LOOP_SURE);
}

/* After a call: a turn of the loop is complete, or several if they are short. */
static bool turn_ends(const struct machine *m)
{
    const struct replay *p = m->replay;
    return replay_in_loop(m) && p->since % p->history.period == 0 &&
           m->nodes_pending >= m->flush_after / 8;
}

/* ---- calls ---- */

static bool take_note(struct machine *m, const struct machine_call *call)
{
    struct replay *p = m->replay;
    struct edge *e = p->edge;
    if (!e || p->at >= e->calls_count || !same_call(call, &e->calls[p->at]))
        return false;
    m->calls_noted++;
    if (++p->at == e->calls_count && e->alone) {
        p->at = 0;
        if (m->calls_noted >= turns_noted(m, e) * e->calls_count && !turns_do(m))
            catch_up(m);
    }
    return true;
}

/* The call is not the next one of the edge: but perhaps that of another. */
static bool take_note_elsewhere(struct machine *m, const struct machine_call *call)
{
    struct replay *p = m->replay;
    if (p->edge && m->calls_noted > p->edge->calls_count && !turns_do(m))
        return false;
    struct edge *other = p->edge ? other_edge(m, call) : NULL;
    if (!other)
        return false;
    p->edge = other;
    p->at = m->calls_noted;
    return take_note(m, call);
}

static bool foreseen(struct machine *m, struct machine_call *call)
{
    struct replay *p = m->replay;
    if (!p)
        return false;
    if (p->depth) {
        p->depth++;
        return false;
    }
    call->vpset = m->set_current;
    if (take_note(m, call) || take_note_elsewhere(m, call))
        return true;
    replay_settle(m);
    if (m->flush_due)
        run_flush_due(m);
    if (!p->catching_up && take_note(m, call))
        return true;
    history_add(&p->history, call);
    p->since++;
    if (p->active >= 0 || p->from >= 0) {
        if (p->log_count == CALLS_MOST)
            from_forget(m);
        else if (p->log_count == p->log_capacity)
            p->log = grown(p->log, &p->log_capacity, sizeof *p->log);
        if (p->log_count < CALLS_MOST)
            p->log[p->log_count++] = *call;
    }
    p->depth = 1;
    return false;
}

bool machine_call_foreseen(struct machine *m, struct machine_call *call)
{
    bool known = foreseen(m, call);
    if (m->watch)
        watch_call(m, call->name, known);
    return known;
}

void machine_call_performed(struct machine *m)
{
    struct replay *p = m->replay;
    if (m->watch)
        watch_performed(m);
    if (p && p->depth && --p->depth == 0 && !m->hold_flush && turn_ends(m))
        m->flush_due = true;
}

void machine_call_failed(struct machine *m)
{
    if (m->watch)
        watch_call_failed(m);
    if (!m->replay)
        return;
    m->replay->depth = 0;
    from_forget(m);
    m->replay->log_count = 0;
}

void machine_calls_forget(struct machine *m)
{
    replay_forget(m);
}

bool replay_thorough(const struct machine *m)
{
    return m->replay && m->replay->thorough;
}

void replay_resolve(struct machine *m)
{
    struct replay *p = m->replay;
    if (!replay_thorough(m))
        return;
    p->depth++; /* it belongs to the calls before */
    for (int i = 1; i < m->sets_count; i++)
        if (m->sets[i].used)
            flag_resolved(m, &m->sets[i], MACHINE_OVERFLOW);
    p->depth--;
}

bool replay_in_call(const struct machine *m)
{
    return m->replay && m->replay->depth;
}

/* ---- finding states and edges ---- */

void replay_impure(struct machine *m)
{
    struct replay *p = m->replay;
    if (!p)
        return;
    if (p->active >= 0)
        leave(m);
    from_forget(m);
}

/* Which of the buffers of the state before it is, by mark. */
static void number_buffers(struct machine *m, struct device_buffer *const *buffers, int count)
{
    m->mark++;
    for (int i = 0; i < count; i++) {
        buffers[i]->mark = m->mark;
        buffers[i]->number = (uint32_t)i;
    }
}

static bool sources_find(struct machine *m, struct deed *d, struct machine_value *const *nodes,
                         struct device_buffer *const *buffers)
{
    const struct replay *p = m->replay;
    number_buffers(m, p->from_buffers, p->from_buffers_count);
    for (int i = 0; i < d->nodes_count; i++) {
        struct machine_value *v = nodes[i];
        d->from[i] = -1;
        if (v->op == NODE_CONSTANT || (buffers[i] && !is_leaf(v))) {
            d->values[i] = v;
            graph_ref(v);
        } else if (buffers[i]) {
            if (buffers[i]->mark != m->mark)
                return false;
            d->from[i] = (int32_t)buffers[i]->number;
        }
    }
    return true;
}

void replay_evaluates(struct machine *m, struct plan *plan, struct machine_value *const *nodes,
                      int count, struct device_buffer *const *buffers)
{
    struct replay *p = m->replay;
    if (!p)
        return;
    if (p->depth)
        from_forget(m);
    if (p->from < 0)
        return;
    struct edge e = {
        .calls_count = p->log_count,
        .alone = m->flushing,
        .deed = {.plan = plan,
                 .version = plan_version(m, plan),
                 .stores = m->stores - p->from_stores,
                 .nodes_count = count,
                 .from = allocated((size_t)count, sizeof *e.deed.from),
                 .values = allocated((size_t)count, sizeof(struct machine_value *))}};
    p->making = sources_find(m, &e.deed, nodes, buffers);
    if (p->making)
        p->made = e;
    else
        edge_finish(m, &e);
}

/* The edge that has been made leads to the state walked. */
static bool edge_complete(struct machine *m, const struct walk *w, int to,
                          struct device_buffer *const *buffers,
                          struct machine_value *const *wanted, int wanted_count)
{
    struct replay *p = m->replay;
    struct edge *e = &p->made;
    int count;
    if (p->states[p->from].places != p->states[to].places)
        return false;
    const int *stored = plan_stored(e->deed.plan, &count);
    number_buffers(m, w->buffers, w->buffers_count);
    for (int i = 0; i < wanted_count;
         i++) /* what was computed for somebody must be in the state */
        for (int k = 0; k < count; k++)
            if (wanted[i]->buffer == buffers[stored[k]] && wanted[i]->buffer->mark != m->mark)
                return false;
    number_buffers(m, p->from_buffers, p->from_buffers_count);
    for (int k = 0; k < count; k++) {
        buffers[stored[k]]->mark = m->mark;
        buffers[stored[k]]->number = ~(uint32_t)stored[k];
    }
    int32_t *next = allocated((size_t)w->buffers_count, sizeof *next);
    e->deed.next = next;
    for (int k = 0; k < w->buffers_count; k++) {
        if (w->buffers[k]->mark != m->mark)
            return false;
        next[k] = (int32_t)w->buffers[k]->number;
    }
    e->to = to;
    e->calls = allocated((size_t)e->calls_count, sizeof *e->calls);
    memcpy(e->calls, p->log, (size_t)e->calls_count * sizeof *e->calls);
    return true;
}

/* Many turns of a loop of that state: they are no edge of their own. */
static bool turns_add(struct machine *m, struct state *s, int to)
{
    struct replay *p = m->replay;
    if (!m->building || s != &p->states[to])
        return false;
    for (int i = 0; i < s->edges_count; i++) {
        struct edge *e = &s->edges[i];
        bool same = e->alone && e->to == to && p->made.calls_count == p->building_calls;
        for (int k = 0; same && k < p->made.calls_count; k++)
            same = same_call(&e->calls[k % e->calls_count], &p->made.calls[k]);
        if (!same)
            continue;
        deed_finish(m, &e->turns);
        e->turns = p->made.deed;
        p->made.deed = (struct deed){.plan = NULL};
        return true;
    }
    return false;
}

/* In the place of one with the same calls, or of the oldest. */
static void edge_add(struct machine *m, struct state *s, const struct edge *e)
{
    int at = -1;
    for (int i = 0; i < s->edges_count && at < 0; i++)
        if (s->edges[i].calls_count == e->calls_count && s->edges[i].alone == e->alone &&
            begins_alike(&s->edges[i], e, e->calls_count))
            at = i;
    if (at < 0 && s->edges_count < EDGES_MOST)
        s->edges[at = s->edges_count++] = (struct edge){0};
    if (at < 0) {
        edge_finish(m, &s->edges[0]);
        memmove(&s->edges[0], &s->edges[1], (EDGES_MOST - 1) * sizeof s->edges[0]);
        s->edges[at = EDGES_MOST - 1] = (struct edge){0};
    }
    edge_finish(m, &s->edges[at]);
    s->edges[at] = *e;
    s->edge_last = at;
}

static bool hash_seen(struct replay *p, uint64_t hash)
{
    for (int i = 0; i < HASHES_SEEN; i++)
        if (p->seen[i] == hash)
            return true;
    p->seen[p->seen_count++ % HASHES_SEEN] = hash;
    return false;
}

/* The state walked, made if it was seen before without being one; -1: not yet. */
static int state_find(struct machine *m, struct walk *w, const struct root_visit *visit)
{
    struct replay *p = m->replay;
    uint64_t hash = 0xcbf29ce484222325u;
    for (int i = 0; i < w->length; i++) {
        hash = (hash ^ w->signature[i]) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 32;
    }
    for (int i = 0; i < p->states_count; i++)
        if (p->states[i].hash == hash && p->states[i].length == (uint32_t)w->length &&
            !memcmp(p->states[i].signature, w->signature,
                    (size_t)w->length * sizeof *w->signature))
            return i;
    if (!hash_seen(p, hash))
        return -1;
    struct state *s = &p->states[p->states_count];
    *s = (struct state){.signature = w->signature,
                        .length = (uint32_t)w->length,
                        .hash = hash,
                        .roots = allocated((size_t)visit->count, sizeof *s->roots),
                        .roots_count = visit->count,
                        .overflows = allocated((size_t)m->sets_count, 1),
                        .places = visit->places,
                        .buffers = allocated((size_t)w->buffers_count, sizeof *s->buffers),
                        .buffers_count = w->buffers_count};
    w->signature = NULL;
    template_make(m, s, w);
    return p->states_count++;
}

void replay_evaluated(struct machine *m, struct device_buffer *const *buffers,
                      struct machine_value *const *wanted, int wanted_count)
{
    struct replay *p = m->replay;
    if (!p)
        return;
    if (!p->depth)
        p->since = 0;
    if (p->active >= 0) /* it changed nothing that is kept */
        return;
    if (p->depth) { /* in the middle of a call: what follows is no state's beginning */
        from_forget(m);
        return;
    }
    struct walk w;
    struct root_visit visit = walk_all(m, &w);
    if (w.good && p->states_count == STATES_MOST) {
        replay_failed(m);
        forget(m);
    }
    int to = w.good ? state_find(m, &w, &visit) : -1;
    bool complete =
        to >= 0 && p->making && edge_complete(m, &w, to, buffers, wanted, wanted_count);
    if (complete && !turns_add(m, &p->states[p->from], to) && !m->building) {
        edge_add(m, &p->states[p->from], &p->made);
        p->making = false;
    }
    from_forget(m);
    p->log_count = 0;
    if (to >= 0)
        activate(m, to, w.buffers);
    walk_finish(&w);
    replay_failed(m);
}

void replay_failed(struct machine *m)
{
    struct replay *p = m->replay;
    if (p && p->making)
        edge_finish(m, &p->made);
    if (p)
        p->making = false;
}
