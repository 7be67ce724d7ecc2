/* hand_graph.h - graphs for tests of planner and codegen, made at random or node by node,
 * without a program. */
#ifndef LUTETIA_TESTS_HAND_GRAPH_H
#define LUTETIA_TESTS_HAND_GRAPH_H

#include "plan/plan.h"

enum { HAND_NODES_MOST = 400 };

struct hand_graph {
    struct plan_graph g;
    struct plan_node nodes[HAND_NODES_MOST];
    uint32_t chance;
    int kind; /* which types there are */
};

/* Draws the next random number, 0 .. n - 1. */
int hand_below(struct hand_graph *h, int n);
void hand_begin(struct hand_graph *h, uint32_t seed);
/* Each returns the node's number. */
int hand_leaf(struct hand_graph *h, struct machine_type type);
int hand_number(struct hand_graph *h, struct machine_type type);
int hand_coordinate(struct hand_graph *h, int axis, int width);
int hand_node(struct hand_graph *h, int op, struct machine_type type, int a, int b, int c);
int hand_shift(struct hand_graph *h, int a, int axis, int distance);
/* Adds count random nodes, of all operations and many types, on a VP set of that rank. The last
 * ones are targets. */
void hand_by_chance(struct hand_graph *h, int count, int rank);
/* Removes the nodes that no target needs: planner and codegen are never given any. */
void hand_prune(struct hand_graph *h);

struct vpset hand_set(int rank, const int *dimensions, int halo);
/* The device shape of a CPU with vectors of 8. */
struct device_shape hand_shape(void);

#endif
