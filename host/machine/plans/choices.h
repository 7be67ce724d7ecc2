/* choices.h - what a large plan stores is chosen in a thread, while the plan runs as it is.
 *
 *     the caller      is due: begin | runs ... | runs ... | is due: the kernels' text, compile them ...
 *     the thread                    | plan_choose()  done |
 *
 * The search's time grows with the product of a graph's size and its shifts: some 4,000 values
 * take a tenth of a second. A graph that takes a millisecond or two is searched where its plan
 * is made. */
#ifndef LUTETIA_MACHINE_CHOICES_H
#define LUTETIA_MACHINE_CHOICES_H

#include "base/aside.h"
#include "plan/plan.h"

struct machine;
struct plan;
struct plan_request;

/* A graph as plan_choose() leaves it: in rows; and where the plan may be in strips, as it is
 * then. */
struct choice {
    struct plan_graph rows, strips; /* strips.nodes NULL: they were not asked for */
    struct vpset *sets;
    const struct device_shape *shape;
    atomic_bool stop;
};

/* One at a time. */
struct choosing {
    struct plan *plan; /* whose; NULL: none */
    struct choice *choice;
    struct aside aside;
};

/* Whether the search takes long enough for a thread, and there may be one. */
bool choice_takes_long(struct machine *m, const struct plan_request *q);
/* Whether a plan's kernels can be made now: there is a choice, or it takes no time. False: it
 * has begun. */
bool choice_is_at_hand(struct machine *m, struct plan *p, const struct plan_request *q,
                       bool strips);
/* The decided nodes of the plan's choice are copied into the graph. False: there is none of
 * that kind. */
bool choice_take(const struct choice *c, struct plan_graph *g);
/* Whether a search is under way. One that is done becomes its plan's choice. */
bool choice_is_awaited(struct machine *m);
void choice_free(struct choice *c);
/* Ends what is under way. */
void choosing_stop(struct machine *m);

#endif
