/* reach.h - the nodes that a request reaches, and its signature, by which its plan is found.
 *
 * Inline: an evaluation adds each node that it comes to. */
#ifndef LUTETIA_MACHINE_REACH_H
#define LUTETIA_MACHINE_REACH_H

#include "plans/plans.h"

static inline bool reach_has_room(const struct reach *r)
{
    return r->count < r->capacity && r->length + REACH_WORDS <= (uint32_t)r->signature_capacity;
}

/* A node, whose operands have been added (inputs: how many; of an array none). False: no
 * memory. */
static inline bool reach_add(const struct machine *m, struct reach *r, struct machine_value *v,
                             int inputs)
{
    if (!reach_has_room(r) && !reach_grow(r))
        return false;
    v->local = (uint32_t)r->count;
    r->nodes[r->count++] = v;
    uint32_t *s = r->signature;
    s[r->length++] = (uint32_t)(v->buffer ? NODE_BUFFER : v->op) | (uint32_t)v->type.kind << 8 |
                     (uint32_t)v->type.width << 16 | (uint32_t)v->axis << 24;
    if (v->type.s) {
        s[r->length - 1] |= 0x8000;
        s[r->length++] = v->type.s | (uint32_t)v->type.e << 8;
    }
    if (v->op != NODE_CONSTANT)
        s[r->length++] = v->set | (uint32_t)m->values->sets[v->set].generation << 16;
    if (!v->buffer) {
        s[r->length++] = (uint32_t)v->detail;
        for (int i = 0; i < inputs; i++)
            s[r->length++] = v->in[i]->local;
    }
    /* for min and max with a constant, whether that is a NaN is known when recording */
    s[r->length++] = v->maybe_nan;
    return true;
}

#endif
