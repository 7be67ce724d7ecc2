/* values.h - values: the nodes of the graph. */
#ifndef LUTETIA_MACHINE_VALUES_H
#define LUTETIA_MACHINE_VALUES_H

#include "base/node_ops.h"
#include "base/parts.h"
#include "values/geometry.h"

struct machine_value {
    uint8_t op;
    uint8_t origin; /* the op that it was made as; op becomes NODE_BUFFER once it is computed */
    struct machine_type type;
    uint8_t axis;
    uint8_t generator; /* cost where nothing is read from memory, else GENERATOR_NONE */
    bool maybe_nan;    /* an operation's NaN in it may not be *the* NaN until it is stored */
    bool strange_nan;  /* the program's own NaNs may be in it, with any bits */
    uint16_t set;      /* VP set; 0: one number for all */
    uint16_t height;   /* longest path to something materialised */
    bool interned;
    bool kept : 1; /* a state's own: see run/replay.h. Does not count as waiting */
    bool told : 1; /* those who watch know what became of it */
    int32_t detail;
    uint32_t refs;
    uint32_t hash;
    uint32_t mark;  /* of the last walk that came by: values.mark */
    uint32_t birth; /* the evaluation before which the oldest thing in it still to compute was
                       made */
    uint32_t local; /* index in the evaluation at hand */
    struct machine_value *next; /* in its hash chain, or in the free list */
    struct machine_value *in[3];
    struct machine_scalar imm;
    struct device_buffer *buffer;
};

/* How often each rule found something that need not be computed: rules.c, memory/flags.c, run/evaluate.c. */
struct vanished {
    uint64_t overwritten, nested, under_context, numbers, known, overflows, expressions;
};

/* The graph, the VP sets that values belong to, and what is counted. */
struct values {
    /* The table of nodes: graph.c. */
    struct machine_value **table;
    uint32_t table_size, table_count;
    struct machine_value *free; /* nodes that are in use no more */
    void **blocks;              /* of nodes */
    int blocks_count, blocks_capacity;
    uint64_t live, pending;          /* nodes; those of them that wait to be computed */
    struct machine_value **borrowed; /* until the next instruction */
    int borrowed_count, borrowed_capacity;
    struct machine_value **release_stack;
    int release_count, release_capacity;

    int simplify_budget; /* nodes that rules_under() may still look at in this instruction */
    uint32_t epoch;      /* evaluations so far, from 1 on */
    uint32_t mark;       /* of the walk under way */
    struct vanished vanished;

    /* Before what fields and flags hold changes, or a node that is kept: those who keep states of it leave. NULL: none do. */
    void (*before_change)(struct machine *m);

    struct vpset *sets; /* 1 .. sets_count - 1; sets[0] is none */
    int sets_count, set_current;
    int processors_count, processors_log2; /* physical ones */
    uint64_t random_seed, random_draws;
};

static inline void values_before_change(struct machine *m)
{
    if (m->values->before_change)
        m->values->before_change(m);
}

static inline bool node_is_leaf(const struct machine_value *v)
{
    return v->buffer || v->op == NODE_CONSTANT;
}

static inline bool node_is_cheap(const struct machine_value *v)
{
    return v->generator <= GENERATOR_CHEAP;
}

#endif
