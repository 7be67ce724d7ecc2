/* states.c - the contents of all fields and flags, as graphs that are found again by signature.
 *
 * A state keeps a graph of its own, whose leaves are numbered buffers. While a state is active,
 * fields and flags hold its graph, whose leaves have buffers. Before anything else changes the
 * graph, the state leaves it to the machine and makes itself a copy.
 *
 *     walk      all that can be reached from fields and flags, inputs first, with its signature
 *     template  a state's copy of what was walked
 */
#include <stdlib.h>
#include <string.h>

#include "base/arrays.h"
#include "base/errors.h"
#include "memory/memory.h"
#include "run/replay.h"
#include "values/graph.h"

/* Distinguishes places of recorded overflows; other places are flags and lengths. */
#define OVERFLOW_PART (UINT32_MAX - 255)

/* ---- walks ---- */

/* Calls `visit` for every place that holds a value, always in the same order: flags, slots,
 * and recorded overflows, which have three places for each VP set, NULL if unused. */
struct root_visit {
    struct machine *m;
    void (*visit)(struct root_visit *visit, struct machine_value **place, uint32_t id,
                  uint32_t part);
    struct walk *walk;             /* walk_root() */
    struct machine_value **values; /* or else: one for each place */
    int count;
};

static void each_root(struct root_visit *v)
{
    struct machine *m = v->m;
    for (int i = 1; i < m->values->sets_count; i++)
        for (int flag = 0; m->values->sets[i].used && flag < 3; flag++)
            v->visit(v, &m->memory->flags[i].of[flag].value, (uint32_t)i, (uint32_t)flag);
    for (int i = 0; i < m->memory->fields_count; i++) {
        struct field *f = m->memory->fields[i];
        for (int k = 0; k < f->slots_count; k++)
            v->visit(v, &f->slots[k].value, f->base + f->slots[k].offset, f->slots[k].bits);
    }
    for (int i = 1; i < m->values->sets_count; i++) {
        struct lazy_overflow *o = &m->memory->flags[i].overflow;
        struct machine_value **places[3] = {&o->a, &o->b, &o->context};
        for (int k = 0; k < 3; k++)
            v->visit(v, places[k], (uint32_t)i, OVERFLOW_PART);
    }
}

/* Clears overflows whose VP set has none recorded any more. */
static void overflows_tidy(struct machine *m)
{
    for (int i = 1; i < m->values->sets_count; i++)
        if (!m->memory->flags[i].overflow.op)
            m->memory->flags[i].overflow = (struct lazy_overflow){.op = 0};
}

static bool is_leaf(const struct machine_value *v)
{
    return v->op == NODE_BUFFER;
}

static bool is_own_leaf(const struct walk *w, const struct machine_value *v)
{
    return is_leaf(v) && (v->kept || !w->of_state);
}

/* Whether imm holds numbers that the signature must include, so that it is unambiguous where
 * a node ends. */
static bool has_numbers(const struct machine_value *v)
{
    return v->op == NODE_CONSTANT || v->op == NODE_RANDOM || v->op == NODE_SLICE;
}

static void say(struct walk *w, uint32_t word)
{
    if (w->length == w->signature_capacity)
        w->signature = array_grown(w->signature, &w->signature_capacity, sizeof *w->signature);
    w->signature[w->length++] = word;
}

static void walk_node(struct machine *m, struct walk *w, struct machine_value *v)
{
    INVARIANT(v->refs);
    if (v->mark == m->values->mark) {
        INVARIANT(v->local != NODE_UNDER_WAY);
        return;
    }
    v->mark = m->values->mark;
    v->local = NODE_UNDER_WAY;
    bool leaf = is_leaf(v);
    INVARIANT(!leaf || v->buffer);
    int inputs = leaf ? 0 : node_ops[v->op].inputs;
    for (int i = 0; i < inputs; i++)
        walk_node(m, w, v->in[i]);
    if (v->op == NODE_SLICE)
        w->good = false;
    if (w->count == w->capacity)
        w->nodes = array_grown(w->nodes, &w->capacity, sizeof *w->nodes);
    v->local = (uint32_t)w->count;
    w->nodes[w->count++] = v;
    say(w, (uint32_t)v->op | (uint32_t)v->type.kind << 8 | (uint32_t)v->type.width << 16 |
               (uint32_t)v->axis << 24);
    say(w, v->set | (uint32_t)m->values->sets[v->set].generation << 16);
    say(w, v->type.s | (uint32_t)v->type.e << 8 | (uint32_t)v->maybe_nan << 16 |
               (uint32_t)v->strange_nan << 17 | (uint32_t)v->own_address << 18);
    if (v->own_address)
        say(w, v->turned);
    if (leaf && !is_own_leaf(w, v))
        return;
    if (leaf) {
        struct device_buffer *b = v->buffer;
        w->good = w->good && !b->follows;
        if (b->mark != m->values->mark) {
            b->mark = m->values->mark;
            b->number = (uint32_t)w->buffers_count;
            if (w->buffers_count == w->buffers_capacity)
                w->buffers = array_grown(w->buffers, &w->buffers_capacity,
                                         sizeof(struct device_buffer *));
            w->buffers[w->buffers_count++] = b;
        }
        say(w, b->number);
        return;
    }
    say(w, (uint32_t)v->detail);
    for (int i = 0; i < inputs; i++)
        say(w, v->in[i]->local);
    if (has_numbers(v)) {
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
    say(w, part == OVERFLOW_PART ? part + visit->m->memory->flags[id].overflow.op : part);
    say(w, (*place)->local);
    if (part != OVERFLOW_PART)
        w->places =
            (w->places ^ id ^ (uint64_t)part << 32) * 0x9e3779b97f4a7c15u + (w->places >> 29);
}

void states_walk(struct machine *m, struct walk *w)
{
    *w = (struct walk){.good = true};
    m->values->mark++;
    for (int i = 0; i < m->memory->fields_count; i++)
        w->good = w->good && !m->memory->fields[i]->root;
    if (!w->good)
        return;
    struct root_visit visit = {.m = m, .visit = walk_root, .walk = w};
    overflows_tidy(m);
    each_root(&visit);
    w->roots_count = visit.count;
}

void walk_finish(struct walk *w)
{
    free(w->nodes);
    free(w->buffers);
    free(w->signature);
}

/* ---- templates ---- */

/* Copies the graph walked, with leaves of its own that have no buffers yet. copies[i] is the
 * copy of nodes[i]. */
static void template_copy(struct machine *m, struct state *s, const struct walk *w)
{
    struct machine_value **copies = array_zeroed((size_t)w->count, sizeof *copies);
    s->leaves = array_zeroed((size_t)w->count, sizeof *s->leaves);
    s->leaves_count = 0;
    for (int i = 0; i < w->count; i++) {
        struct machine_value *v = w->nodes[i];
        if (is_own_leaf(w, v)) {
            copies[i] = graph_buffer_node(m, v->type, v->set, NULL);
            copies[i]->strange_nan = v->strange_nan;
            copies[i]->own_address = v->own_address;
            copies[i]->turned = v->turned;
            graph_keep(m, copies[i], true);
            s->leaves[s->leaves_count++] = (struct leaf){copies[i], v->buffer->number};
            continue;
        }
        struct machine_value key = *v;
        bool same = true;
        for (int k = 0; k < (is_leaf(v) ? 0 : node_ops[v->op].inputs); k++) {
            INVARIANT(v->in[k]->local < (uint32_t)i); /* inputs before users */
            key.in[k] = copies[v->in[k]->local];
            same = same && key.in[k] == v->in[k];
        }
        copies[i] = same ? v : graph_node(m, &key);
        if (!same) {
            copies[i]->birth = v->birth;
            copies[i]->told = true; /* no value of the program: not reported */
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

/* Gives the state a graph of its own, equal to that which fields and flags hold. */
static void template_make(struct machine *m, struct state *s, const struct walk *w)
{
    struct root_visit visit = {.m = m, .visit = collect_root, .values = s->roots};
    each_root(&visit);
    for (int i = 1; i < m->values->sets_count; i++)
        s->overflows[i] = m->memory->flags[i].overflow.op;
    template_copy(m, s, w);
}

static void template_release(struct machine *m, struct state *s)
{
    for (int i = 0; i < s->roots_count; i++)
        if (s->roots[i])
            graph_unref(m, s->roots[i]);
    free(s->roots);
    free(s->leaves);
}

/* ---- the active state ---- */

static void leaf_set(struct machine *m, struct machine_value *leaf, struct device_buffer *b)
{
    struct device_buffer *old = leaf->buffer;
    if (b)
        device_buffer_ref(b);
    leaf->buffer = b;
    if (old)
        device_buffer_unref(m, old);
}

void state_buffers_put(struct machine *m, struct state *s, struct device_buffer *const *buffers)
{
    for (int i = 0; i < s->leaves_count; i++)
        leaf_set(m, s->leaves[i].node, buffers ? buffers[s->leaves[i].number] : NULL);
    if (buffers)
        memcpy(s->buffers, buffers, (size_t)s->buffers_count * sizeof *buffers);
}

static void put_root(struct root_visit *visit, struct machine_value **place, uint32_t id,
                     uint32_t part)
{
    (void)id;
    (void)part;
    struct machine_value *old = *place;
    *place = visit->values[visit->count++];
    if (*place)
        graph_ref(*place); /* the machine's; the state keeps its own */
    if (old)
        graph_unref(visit->m, old);
}

void state_activate(struct machine *m, int index, struct device_buffer *const *buffers)
{
    struct replay *p = m->run->replay;
    struct state *s = &p->states[index];
    state_buffers_put(m, s, buffers);
    struct root_visit visit = {.m = m, .visit = put_root, .values = s->roots};
    overflows_tidy(m);
    each_root(&visit);
    INVARIANT(visit.count == s->roots_count);
    for (int i = 1; i < m->values->sets_count; i++)
        m->memory->flags[i].overflow.op = s->overflows[i];
    p->active = index;
    p->edge =
        s->edges_count && !run_mode_catches_up(m->run->mode) ? &s->edges[s->edge_last] : NULL;
    p->at = m->run->calls_noted = 0;
}

void state_leave(struct machine *m)
{
    struct replay *p = m->run->replay;
    int index = p->active;
    struct state *s = &p->states[index], old = *s;
    p->active = -1;
    p->edge = NULL;
    struct walk w = {.good = true, .of_state = true};
    m->values->mark++;
    for (int i = 0; i < s->roots_count; i++)
        if (s->roots[i])
            walk_node(m, &w, s->roots[i]);
    s->roots = array_zeroed((size_t)s->roots_count, sizeof(struct machine_value *));
    memcpy(s->roots, old.roots, (size_t)s->roots_count * sizeof(struct machine_value *));
    INVARIANT(w.buffers_count == s->buffers_count);
    template_copy(m, s, &w);
    for (int i = 0; i < w.count; i++)
        graph_keep(m, w.nodes[i], false);
    walk_finish(&w);
    states_from_forget(m);
    if (p->depth)
        states_from(m, index);
    template_release(m, &old);
}

void states_before_change(struct machine *m)
{
    struct replay *p = m->run->replay;
    if (!p)
        return;
    INVARIANT(m->run->calls_noted == 0);
    if (p->active >= 0)
        state_leave(m);
    else if (!p->depth && p->from >= 0)
        states_from_forget(m);
}

/* ---- all of them ---- */

static void state_finish(struct machine *m, struct state *s)
{
    template_release(m, s);
    for (int i = 0; i < s->edges_count; i++)
        edge_finish(m, &s->edges[i]);
    free(s->signature);
    free(s->overflows);
    free(s->buffers);
}

void states_forget(struct machine *m)
{
    struct replay *p = m->run->replay;
    INVARIANT(m->run->calls_noted == 0);
    if (p->active >= 0)
        state_leave(m);
    states_from_forget(m);
    p->edge = NULL;
    for (int i = 0; i < p->states_count; i++)
        state_finish(m, &p->states[i]);
    p->states_count = 0;
}

static bool hash_seen(struct replay *p, uint64_t hash)
{
    for (int i = 0; i < HASHES_SEEN; i++)
        if (p->seen[i] == hash)
            return true;
    p->seen[p->seen_count++ % HASHES_SEEN] = hash;
    return false;
}

int state_find(struct machine *m, struct walk *w)
{
    struct replay *p = m->run->replay;
    uint64_t hash = words_hash(w->signature, (size_t)w->length);
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
                        .roots = array_zeroed((size_t)w->roots_count, sizeof *s->roots),
                        .roots_count = w->roots_count,
                        .overflows = array_zeroed((size_t)m->values->sets_count, 1),
                        .places = w->places,
                        .buffers = array_zeroed((size_t)w->buffers_count, sizeof *s->buffers),
                        .buffers_count = w->buffers_count};
    w->signature = NULL;
    template_make(m, s, w);
    return p->states_count++;
}

void deed_finish(struct machine *m, struct deed *d)
{
    for (int i = 0; d->values && i < d->nodes_count; i++)
        if (d->values[i])
            graph_unref(m, d->values[i]);
    free(d->from);
    free(d->values);
    free(d->next);
    free(d->dies);
    free(d->kept);
    free(d->spare);
    *d = (struct deed){.plan = NULL};
}

void edge_finish(struct machine *m, struct edge *e)
{
    deed_finish(m, &e->deed);
    deed_finish(m, &e->turns);
    free(e->calls);
}

void states_from(struct machine *m, int index)
{
    struct replay *p = m->run->replay;
    const struct state *s = &p->states[index];
    p->from = index;
    p->from_stores = m->run->stores;
    p->from_buffers = array_zeroed((size_t)s->buffers_count, sizeof(struct device_buffer *));
    p->from_buffers_count = s->buffers_count;
    memcpy(p->from_buffers, s->buffers,
           (size_t)s->buffers_count * sizeof(struct device_buffer *));
    for (int i = 0; i < s->buffers_count; i++)
        device_buffer_ref(s->buffers[i]);
}

void states_from_forget(struct machine *m)
{
    struct replay *p = m->run->replay;
    for (int i = 0; i < p->from_buffers_count; i++)
        if (p->from_buffers[i])
            device_buffer_unref(m, p->from_buffers[i]);
    free(p->from_buffers);
    p->from_buffers = NULL;
    p->from_buffers_count = 0;
    p->from = -1;
}
