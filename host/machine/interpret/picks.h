/* picks.h - chains of choices that byte code performs as one step.
 *
 *     select (i == 0, a, select (i == 1, b, ... rest))     a pick: for each lane the array that
 *                                                          i names, as CM_aref wants it
 *     select (c, select (d, a, rest), rest)                 an inner choice: select (c & d, a,
 *                                                           rest)
 *
 * A compiler of kernels finds the inner choice itself, and has registers for all choices of a
 * chain. */
#ifndef LUTETIA_MACHINE_PICKS_H
#define LUTETIA_MACHINE_PICKS_H

#include "plan/plan.h"

enum { PICK_LEAST = 6, PICK_MOST = 64 };

/* The value that stands beside the first key that equals the index; `rest` if none does. All
 * members but count are nodes; keys are constants. */
struct pick {
    int index, rest, count;
    int keys[PICK_MOST], values[PICK_MOST];
};

struct picks;

/* wanted: else there are only inner choices. NULL: no memory. */
struct picks *picks_create(const struct plan_graph *g, int stage, bool wanted);
void picks_free(struct picks *p);
/* The pick that ends in this node; NULL: there is none. Callers ask from the last node to the
 * first, so that each chain is found at its end. */
const struct pick *picks_find(struct picks *p, int node);
const struct pick *picks_at(const struct picks *p, int node); /* found before */
/* The node of the inner choice, which nobody else takes; -1: there is none. */
int picks_inner(const struct picks *p, int node);

/* Which operand of a sum or difference of floats is a product that nobody else takes; -1:
 * neither. */
int picks_product(const struct picks *p, int node);

#endif
