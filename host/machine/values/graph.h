/* graph.h - the value graph: nodes made once, counted, released. */
#ifndef LUTETIA_MACHINE_GRAPH_H
#define LUTETIA_MACHINE_GRAPH_H

#include "base/errors.h"
#include "values/values.h"

bool graph_init(struct machine *m);
void graph_finish(struct machine *m);
/* Returns the node with these contents, which exists once; borrowed. The node takes its own
 * references to its inputs. */
struct machine_value *graph_node(struct machine *m, const struct machine_value *key);
struct machine_value *graph_buffer_node(struct machine *m, struct machine_type type, int set,
                                        struct device_buffer *buffer);
/* The same if there is one, else NULL. */
struct machine_value *graph_find(struct machine *m, const struct machine_value *key);
/* What v is made of by leaving out or adding high bits, as far as at least so many low ones
 * stay. */
struct machine_value *graph_low_bits(struct machine_value *v, int bits);
/* What follows from its operation and operands: which NaNs it may hold, and its cost where
 * nothing is read from memory. */
void graph_derive_nan(const struct machine *m, struct machine_value *v);
uint8_t graph_generator(const struct machine_value *v);
/* Redefines a pending node by another way of computing the same values. Two nodes with the
 * same key may then exist. */
void graph_become(struct machine *m, struct machine_value *v, const struct machine_value *key);
/* Drops the definition of a node that has a buffer. */
void graph_forget(struct machine *m, struct machine_value *v);

/* ---- references: inline, because each recorded call takes and drops a dozen ---- */

static inline void graph_ref(struct machine_value *v)
{
    INVARIANT(v->refs); /* a value that was let go of is not taken up again */
    v->refs++;
}
/* Releases a node whose last reference is gone. */
void graph_release(struct machine *m, struct machine_value *v);
static inline void graph_unref(struct machine *m, struct machine_value *v)
{
    if (!--v->refs)
        graph_release(m, v);
}
/* Makes room for one more borrowed value. */
void graph_borrowed_grow(struct machine *m);
/* A reference that lasts until the next instruction. Every value that an instruction uses after
 * an evaluation needs one: the evaluation lets go of the operands of what it computes, and a
 * state that is entered puts nodes of its own in the place of what fields and flags held. */
static inline struct machine_value *graph_borrow(struct machine *m, struct machine_value *v)
{
    struct values *all = m->values;
    INVARIANT(v->refs);
    if (all->borrowed_count == all->borrowed_capacity)
        graph_borrowed_grow(m);
    all->borrowed[all->borrowed_count++] = v;
    v->refs++;
    return v;
}
/* The value of which v is the same bits as another type, borrowed: where only bits count, its
 * array serves as well. */
struct machine_value *graph_same_bits(struct machine *m, struct machine_value *v);
void graph_give_back(struct machine *m); /* releases everything that was borrowed */
/* How many of a value's references are the instruction's. */
uint32_t graph_borrowed(const struct machine *m, const struct machine_value *v);

/* Whether it is a state's own. */
void graph_keep(struct machine *m, struct machine_value *v, bool kept);
/* The node's values are now in the buffer; its definition is dropped (unless it is a cheap
 * generator). */
void graph_materialised(struct machine *m, struct machine_value *v,
                        struct device_buffer *buffer);

#endif
