/* at_once.h - an operation of a small set, computed when it is called.
 *
 * Where a program does not repeat, a plan for a few hundred numbers costs many times the work
 * on them. So nothing is recorded there: the operation's loop runs over the whole arrays, on
 * the caller's thread, and the result is in memory when the call returns. The loops are the
 * byte code's (lanes.h), hence the bits, too. When this is done: run/at_once_when.c. */
#ifndef LUTETIA_MACHINE_AT_ONCE_H
#define LUTETIA_MACHINE_AT_ONCE_H

#include "values/values.h"

/* The result of the operation that key describes, in memory; borrowed. NULL: it has to be a
 * node, because
 *  - it is a test of places, or only shows some of an operand's bits, which stay nodes; or it
 *    has no loop of its own;
 *  - an operand waits to be computed, or is not where the front end can look. There is no
 *    error. */
struct machine_value *at_once_operation(struct machine *m, struct machine_value *key);

/* What stays a node all the same, when somebody looks at it, or it is stored: in memory
 * afterwards? If not, it has to be evaluated some time. */
bool at_once_looked(struct machine *m, struct machine_value *v);
bool at_once_stored(struct machine *m, struct machine_value *v);

#endif
