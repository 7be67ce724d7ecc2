/* graph.c - the value graph: nodes made once (hash-consing), counted references, release.
 *
 * A node is immutable until it is evaluated; then its values are in a buffer, it is taken out
 * of the table and lets its inputs go. Nodes live in blocks that are kept until the machine
 * goes. */
#include "values/graph.h"

#include <stdlib.h>
#include <string.h>

#include "base/arrays.h"
#include "base/errors.h"
#include "base/scalar.h"
#include "base/types.h"
#include "watch/watch.h"

enum { NODES_IN_BLOCK = 512, TABLE_FIRST = 4096 };

bool graph_init(struct machine *m)
{
    m->values->table_size = TABLE_FIRST;
    m->values->table = calloc(m->values->table_size, sizeof *m->values->table);
    return m->values->table != NULL;
}

void graph_finish(struct machine *m)
{
    graph_give_back(m);
    for (int i = 0; i < m->values->blocks_count; i++)
        free(m->values->blocks[i]);
    free(m->values->blocks);
    free(m->values->table);
    free(m->values->borrowed);
    free(m->values->release_stack);
}

/* A node that was let go of has no references and no array, and is reused after the
 * instruction, not within it: what still points to it then finds a node without references,
 * which is checked wherever a reference is taken, and not another value. Under ASan each node
 * is allocated separately, so that every use after release is found. */
#if defined(LUTETIA_FUZZ) || defined(__SANITIZE_ADDRESS__)

static struct machine_value *node_new(struct machine *m)
{
    struct machine_value *v = calloc(1, sizeof *v);
    NEEDS_MEMORY(v);
    m->values->live++;
    return v;
}

static void node_free(struct machine *m, struct machine_value *v)
{
    free(v);
    m->values->live--;
}

static void nodes_reuse(struct machine *m)
{
    (void)m;
}

#else

static struct machine_value *node_new(struct machine *m)
{
    if (!m->values->free) {
        if (m->values->blocks_count == m->values->blocks_capacity)
            m->values->blocks = array_grown(m->values->blocks, &m->values->blocks_capacity,
                                            sizeof *m->values->blocks);
        struct machine_value *block = calloc(NODES_IN_BLOCK, sizeof *block);
        NEEDS_MEMORY(block);
        m->values->blocks[m->values->blocks_count++] = block;
        for (int i = 0; i < NODES_IN_BLOCK; i++) {
            block[i].next = m->values->free;
            m->values->free = &block[i];
        }
    }
    struct machine_value *v = m->values->free;
    m->values->free = v->next;
    m->values->live++;
    return v;
}

static void node_free(struct machine *m, struct machine_value *v)
{
    v->buffer = NULL;
    v->next = m->values->let_go;
    if (!v->next)
        m->values->let_go_first = v;
    m->values->let_go = v;
    m->values->live--;
}

/* Puts the nodes that the instruction has let go of before the free ones, as they are in the
 * list. */
static void nodes_reuse(struct machine *m)
{
    if (!m->values->let_go)
        return;
    m->values->let_go_first->next = m->values->free;
    m->values->free = m->values->let_go;
    m->values->let_go = NULL;
}

#endif

void graph_borrowed_grow(struct machine *m)
{
    m->values->borrowed = array_grown(m->values->borrowed, &m->values->borrowed_capacity,
                                      sizeof *m->values->borrowed);
}

uint32_t graph_borrowed(const struct machine *m, const struct machine_value *v)
{
    uint32_t held = 0;
    for (int i = 0; i < m->values->borrowed_count; i++)
        held += m->values->borrowed[i] == v;
    return held;
}

void graph_give_back(struct machine *m)
{
    for (int i = 0; i < m->values->borrowed_count; i++)
        graph_unref(m, m->values->borrowed[i]);
    m->values->borrowed_count = 0;
    nodes_reuse(m);
}

static uint32_t hash_of(const struct machine_value *k)
{
    uint64_t h = k->op | (uint64_t)k->type.kind << 8 | (uint64_t)k->type.width << 16 |
                 (uint64_t)k->axis << 24 | (uint64_t)(uint32_t)k->detail << 32;
    h ^= (uint64_t)k->type.s << 48 | (uint64_t)k->type.e << 56;
    h = (h ^ k->set) * 0x9e3779b97f4a7c15u;
    for (int i = 0; i < 3; i++)
        h = (h ^ (h >> 29) ^ (uint64_t)(uintptr_t)k->in[i]) * 0xbf58476d1ce4e5b9u;
    h = (h ^ (h >> 32) ^ k->imm.lo) * 0x94d049bb133111ebu;
    h = (h ^ (h >> 30) ^ k->imm.hi) * 0x9e3779b97f4a7c15u;
    return (uint32_t)(h >> 32);
}

static bool same_key(const struct machine_value *v, const struct machine_value *k)
{
    return v->op == k->op && type_equal(v->type, k->type) && v->axis == k->axis &&
           v->set == k->set && v->detail == k->detail && v->in[0] == k->in[0] &&
           v->in[1] == k->in[1] && v->in[2] == k->in[2] && v->imm.lo == k->imm.lo &&
           v->imm.hi == k->imm.hi;
}

static void table_grow(struct machine *m)
{
    uint32_t size = m->values->table_size * 2;
    struct machine_value **table = calloc(size, sizeof *table);
    NEEDS_MEMORY(table);
    for (uint32_t i = 0; i < m->values->table_size; i++)
        for (struct machine_value *v = m->values->table[i], *next; v; v = next) {
            next = v->next;
            v->next = table[v->hash & (size - 1)];
            table[v->hash & (size - 1)] = v;
        }
    free(m->values->table);
    m->values->table = table;
    m->values->table_size = size;
}

static void table_remove(struct machine *m, struct machine_value *v)
{
    struct machine_value **link = &m->values->table[v->hash & (m->values->table_size - 1)];
    while (*link != v)
        link = &(*link)->next;
    *link = v->next;
    v->interned = false;
    m->values->table_count--;
}

/* A pending value that is requested again counts as made now, if all of its inputs do.
 * Otherwise values that a turn of a loop makes from temporaries of the turn before would
 * look old. */
static void bear(struct machine_value *v, uint32_t epoch)
{
    v->birth = epoch;
    for (int i = 0; i < node_ops[v->op].inputs; i++) {
        const struct machine_value *in = v->in[i];
        if (!node_is_leaf(in) && !node_is_cheap(in) && in->birth < v->birth)
            v->birth = in->birth;
    }
}

void graph_derive_nan(const struct machine *m, struct machine_value *v)
{
    bool keeps = m->device->shape.keeps_nan;
    bool nan = false, strange = false;
    v->maybe_nan = v->strange_nan = false;
    if (v->type.kind != MACHINE_FLOAT)
        return;
    for (int i = 0; i < node_ops[v->op].inputs; i++) {
        nan = nan || v->in[i]->maybe_nan;
        strange = strange || v->in[i]->strange_nan;
    }
    switch ((enum op_nan)node_ops[v->op].nan) {
    case NAN_NEVER:
        break;
    case NAN_ANY:
        v->maybe_nan = true;
        break;
    case NAN_KEPT:
        v->maybe_nan = nan || strange || !keeps;
        break;
    case NAN_SECOND:
        v->maybe_nan = v->in[1]->op == NODE_CONSTANT ? scalar_is_nan(v->type, v->in[1]->imm.lo)
                                                     : nan || strange || !keeps;
        break;
    case NAN_PASSED:
        v->maybe_nan = nan;
        v->strange_nan = strange;
        break;
    case NAN_NUMBER:
        v->strange_nan = scalar_is_strange_nan(v->type, v->imm.lo);
        break;
    case NAN_STRANGE:
        v->strange_nan = true;
        break;
    }
}

uint8_t graph_generator(const struct machine_value *v)
{
    unsigned generator = (unsigned)node_cost(v->op, v->type);
    for (int i = 0; i < node_ops[v->op].inputs; i++)
        generator += v->in[i]->generator;
    return generator > GENERATOR_NONE ? GENERATOR_NONE : (uint8_t)generator;
}

/* An own address is still known when some of its bits are turned, and when it is longer or
 * shorter but whole. */
static void derive_address(const struct machine *m, struct machine_value *v)
{
    const bool turns = v->op == MACHINE_XOR,
               resizes = v->op == NODE_ZERO_EXTEND || (v->op == NODE_EXTRACT && v->detail == 0);
    if (!turns && !resizes)
        return;
    const int k = turns && v->in[0]->op == NODE_CONSTANT;
    const struct machine_value *own = v->in[k];
    if (!own->own_address || (turns && v->in[1 - k]->op != NODE_CONSTANT))
        return;
    const int bits = m->values->sets[own->set].address_bits;
    if (v->type.width < bits || bits > 32)
        return;
    const uint64_t turned = turns ? v->in[1 - k]->imm.lo & ((UINT64_C(1) << bits) - 1) : 0;
    v->own_address = true;
    v->turned = own->turned ^ (uint32_t)turned;
}

static void derive(const struct machine *m, struct machine_value *v, uint32_t epoch)
{
    const struct node_op_info *info = &node_ops[v->op];
    unsigned height = 0;
    bear(v, epoch);
    for (int i = 0; i < info->inputs; i++) {
        const struct machine_value *in = v->in[i];
        if (in->height + 1u > height && !node_is_leaf(in))
            height = in->height + 1u;
    }
    v->generator = graph_generator(v);
    v->height = height > UINT16_MAX ? UINT16_MAX : (uint16_t)height;
    graph_derive_nan(m, v);
    derive_address(m, v);
}

/* Whether the value waits to be computed; slices are views, which cost nothing until they
 * are observed. */
static bool is_pending(const struct machine_value *v)
{
    return v->op != NODE_CONSTANT && v->op != NODE_SLICE;
}

/* Neighbours look at what is computed, so that may have to be stored. */
static uint32_t waiting_kb(const struct machine *m, const struct machine_value *v)
{
    if ((v->op != NODE_SHIFT && v->op != NODE_CROSS) || node_is_leaf(v->in[0]) ||
        node_is_cheap(v->in[0]))
        return 0;
    return (uint32_t)(m->values->sets[v->set].count * type_bytes(v->type) >> 10);
}

/* It waits to be computed, or does so no more. */
static void pend(struct machine *m, const struct machine_value *v, bool waits)
{
    m->values->pending += waits ? 1 : UINT64_MAX;
    m->values->pending_kb += waits ? v->waiting_kb : -(uint64_t)v->waiting_kb;
}

static struct machine_value *find(struct machine *m, const struct machine_value *key,
                                  uint32_t hash)
{
    for (struct machine_value *v = m->values->table[hash & (m->values->table_size - 1)]; v;
         v = v->next)
        if (v->hash == hash && same_key(v, key))
            return v;
    return NULL;
}

struct machine_value *graph_find(struct machine *m, const struct machine_value *key)
{
    return find(m, key, hash_of(key));
}

struct machine_value *graph_low_bits(struct machine_value *v, int bits)
{
    while (!v->buffer &&
           (v->op == NODE_ZERO_EXTEND || (v->op == NODE_EXTRACT && v->detail == 0)) &&
           v->type.width >= bits && v->in[0]->type.kind == MACHINE_BITS)
        v = v->in[0];
    return v;
}

/* A new node's one reference is that of the instruction. */
static struct machine_value *handed_out(struct machine *m, struct machine_value *v)
{
    if (m->values->borrowed_count == m->values->borrowed_capacity)
        graph_borrowed_grow(m);
    m->values->borrowed[m->values->borrowed_count++] = v;
    return v;
}

struct machine_value *graph_same_bits(struct machine *m, struct machine_value *v)
{
    while (v->op == NODE_REINTERPRET && !v->buffer)
        v = v->in[0];
    return graph_borrow(m, v);
}

struct machine_value *graph_node(struct machine *m, const struct machine_value *key)
{
    uint32_t hash = hash_of(key);
    struct machine_value *known = find(m, key, hash);
    if (known) {
        m->values->vanished.known += node_ops[known->op].inputs > 0;
        if (!known->buffer)
            bear(known, m->values->epoch);
        return graph_borrow(m, known);
    }
    if (m->values->table_count >= m->values->table_size)
        table_grow(m);
    struct machine_value *v = node_new(m);
    *v = *key;
    v->origin = v->op;
    v->refs = 1;
    v->hash = hash;
    v->mark = 0;
    v->kept = v->told = v->stored = false;
    v->serial = ++m->values->serial;
    v->waiting_kb = waiting_kb(m, v);
    v->buffer = NULL;
    for (int i = 0; i < 3; i++)
        if (v->in[i])
            graph_ref(v->in[i]);
    derive(m, v, m->values->epoch);
    v->interned = true;
    v->next = m->values->table[hash & (m->values->table_size - 1)];
    m->values->table[hash & (m->values->table_size - 1)] = v;
    m->values->table_count++;
    if (is_pending(v))
        pend(m, v, true);
    return handed_out(m, v);
}

struct machine_value *graph_buffer_node(struct machine *m, struct machine_type type, int set,
                                        struct device_buffer *buffer)
{
    struct machine_value *v = node_new(m);
    *v = (struct machine_value){.op = NODE_BUFFER,
                                .origin = NODE_BUFFER,
                                .type = type,
                                .generator = GENERATOR_NONE,
                                .set = (uint16_t)set,
                                .strange_nan = type.kind == MACHINE_FLOAT,
                                .refs = 1,
                                .buffer = buffer};
    return handed_out(m, v);
}

/* Iterative: chains can be long. */
void graph_release(struct machine *m, struct machine_value *v)
{
    m->values->release_count = 0;
    for (;;) {
        if (v->interned) {
            if (m->watch && !v->told && !v->buffer && v->op != NODE_CONSTANT &&
                v->op != NODE_SLICE)
                watch_vanished(m, v->op);
            table_remove(m, v);
            if (is_pending(v) && !v->buffer && !v->kept)
                pend(m, v, false);
        }
        if (v->buffer)
            device_buffer_unref(m, v->buffer);
        for (int i = 0; i < 3; i++)
            if (v->in[i] && --v->in[i]->refs == 0) {
                if (m->values->release_count == m->values->release_capacity)
                    m->values->release_stack =
                        array_grown(m->values->release_stack, &m->values->release_capacity,
                                    sizeof *m->values->release_stack);
                m->values->release_stack[m->values->release_count++] = v->in[i];
            }
        node_free(m, v);
        if (!m->values->release_count)
            return;
        v = m->values->release_stack[--m->values->release_count];
    }
}

void graph_keep(struct machine *m, struct machine_value *v, bool kept)
{
    if (v->kept == kept)
        return;
    v->kept = kept;
    if (v->interned && is_pending(v) && !v->buffer)
        pend(m, v, !kept);
}

/* Called before a node changes; fails for nodes that a state keeps. */
static void let_go(struct machine *m, const struct machine_value *v)
{
    if (v->kept)
        values_before_change(m);
    INVARIANT(!v->kept);
}

void graph_forget(struct machine *m, struct machine_value *v)
{
    INVARIANT(v->buffer && v->interned);
    let_go(m, v);
    table_remove(m, v);
    struct machine_value *in[3];
    memcpy(in, v->in, sizeof in);
    memset(v->in, 0, sizeof v->in);
    v->op = NODE_BUFFER;
    v->detail = 0;
    v->axis = 0;
    v->imm = (struct machine_scalar){0, 0};
    v->generator = GENERATOR_NONE;
    v->height = 0;
    v->maybe_nan = false;
    for (int i = 0; i < 3; i++)
        if (in[i])
            graph_unref(m, in[i]);
}

void graph_become(struct machine *m, struct machine_value *v, const struct machine_value *key)
{
    INVARIANT(!v->buffer && v->interned && type_equal(v->type, key->type) &&
              v->set == key->set);
    let_go(m, v);
    struct machine_value *in[3];
    memcpy(in, v->in, sizeof in);
    table_remove(m, v);
    if (is_pending(v))
        pend(m, v, false);
    v->op = key->op;
    v->axis = key->axis;
    v->detail = key->detail;
    v->imm = key->imm;
    v->hash = hash_of(key);
    for (int i = 0; i < 3; i++)
        if ((v->in[i] = key->in[i]))
            graph_ref(v->in[i]);
    derive(m, v, m->values->epoch);
    v->serial = ++m->values->serial;
    v->waiting_kb = waiting_kb(m, v);
    if (is_pending(v))
        pend(m, v, true);
    v->interned = true;
    v->next = m->values->table[v->hash & (m->values->table_size - 1)];
    m->values->table[v->hash & (m->values->table_size - 1)] = v;
    m->values->table_count++;
    for (int i = 0; i < 3; i++)
        if (in[i])
            graph_unref(m, in[i]);
}

void graph_materialised(struct machine *m, struct machine_value *v,
                        struct device_buffer *buffer)
{
    INVARIANT(!v->buffer && v->interned);
    let_go(m, v);
    v->buffer = buffer;
    if (is_pending(v))
        pend(m, v, false);
    if (node_is_cheap(v) || v->op == NODE_SLICE)
        return; /* stays in the table: an equal node will be the same one */
    graph_forget(m, v);
}
