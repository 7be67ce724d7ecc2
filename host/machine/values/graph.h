/* graph.h - the value graph: nodes made once, counted, released. */
#ifndef LUTETIA_MACHINE_GRAPH_H
#define LUTETIA_MACHINE_GRAPH_H

#include "values/values.h"

bool graph_init(struct machine *m);
void graph_finish(struct machine *m);
/* The one node that is this; borrowed. Inputs are taken as references of the node's own. */
struct machine_value *graph_node(struct machine *m, const struct machine_value *key);
struct machine_value *graph_buffer_node(struct machine *m, struct machine_type type, int set,
                                        struct device_buffer *buffer);
/* The same if there is one, else NULL. */
struct machine_value *graph_find(struct machine *m, const struct machine_value *key);
/* A node that waits comes about in another way from now on, which is known to give the same numbers. There
 * may be two nodes of one key then. */
void graph_become(struct machine *m, struct machine_value *v, const struct machine_value *key);
/* A node with a buffer is from now on no more than that. */
void graph_forget(struct machine *m, struct machine_value *v);
void graph_ref(struct machine_value *v);
void graph_unref(struct machine *m, struct machine_value *v);
struct machine_value *graph_borrow(struct machine *m, struct machine_value *v);
void graph_give_back(struct machine *m); /* all that was borrowed */

/* Whether it is a state's own. */
void graph_keep(struct machine *m, struct machine_value *v, bool kept);
/* The node now has its values in buffer, and forgets how they came about (unless it is a cheap
 * generator). */
void graph_materialised(struct machine *m, struct machine_value *v,
                        struct device_buffer *buffer);

#endif
