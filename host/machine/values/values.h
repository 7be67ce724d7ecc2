/* values.h - values: the nodes of the graph. */
#ifndef LUTETIA_MACHINE_VALUES_H
#define LUTETIA_MACHINE_VALUES_H

#include "base/node_ops.h"
#include "base/parts.h"
#include "values/geometry.h"

/* A walk that meets such a node again has gone in a circle. */
#define NODE_UNDER_WAY UINT32_MAX

struct machine_value {
    uint8_t op;
    uint8_t origin; /* its original op; op becomes NODE_BUFFER once it is computed */
    struct machine_type type;
    uint8_t axis;
    uint8_t generator; /* cost where nothing is read from memory, else GENERATOR_NONE */
    bool maybe_nan;    /* it may hold an operation's NaN that is not *the* NaN until it is
                        * stored */
    bool strange_nan;  /* it may hold NaNs of the program, with any bits */
    uint16_t set;      /* VP set; 0: one number for all */
    uint16_t height;   /* longest path to something materialised */
    bool interned;
    bool kept : 1; /* kept by a state: see run/replay.h. Not counted as pending */
    /* it is each processor's own send address but for `turned`; no field writes over its
     * array */
    bool own_address : 1;
    bool told : 1;   /* observers have been told its fate */
    bool stored : 1; /* it has been put into a field or flag */
    uint32_t turned; /* the bits of an address in which an own_address differs from it */
    int32_t detail;
    uint32_t refs;
    uint32_t hash;
    uint32_t mark;  /* of the last walk that came by: values.mark */
    uint32_t birth; /* the evaluation before which its oldest part still to compute was made */
    /* Index in the evaluation at hand; NODE_UNDER_WAY: its operands are being walked. */
    uint32_t local;
    uint32_t serial; /* order of making; operands are older */
    /* What it may have to be stored in before it is computed: see waiting_kb(). */
    uint32_t waiting_kb;
    struct machine_value *next; /* in its hash chain, or in the free list */
    struct machine_value *in[3];
    struct machine_scalar imm;
    struct device_buffer *buffer;
};

/* How often each rule applied, by which values need not be computed: simplify.c,
 * memory/flags.c, run/evaluate.c. */
struct vanished {
    uint64_t overwritten, nested, under_context, numbers, known, overflows, expressions;
};

/* The graph, the VP sets that values belong to, and what is counted. */
struct values {
    /* The table of nodes: graph.c. */
    struct machine_value **table;
    uint32_t table_size, table_count;
    struct machine_value *free; /* nodes that are in use no more */
    /* Nodes that the instruction has let go of, the last one first; they are reused after
     * it. */
    struct machine_value *let_go, *let_go_first;
    void **blocks; /* of nodes */
    int blocks_count, blocks_capacity;
    uint64_t live, pending;          /* nodes; those of them that wait to be computed */
    uint64_t pending_kb;             /* what these may have to be stored in, in all */
    uint32_t serial;                 /* of the node made last */
    struct machine_value **borrowed; /* until the next instruction */
    int borrowed_count, borrowed_capacity;
    struct machine_value **release_stack;
    int release_count, release_capacity;

    int simplify_budget; /* nodes that simplify_under() may still visit in this instruction */
    uint32_t epoch;      /* evaluations so far, from 1 on */
    uint32_t mark;       /* of the walk under way */
    struct vanished vanished;

    /* Called before the contents of fields and flags change, or a kept node does, so that
     * states are left. NULL: there are no states. */
    void (*before_change)(struct machine *m);

    /* Computes an operation of a small set at once, into memory, instead of making it a node:
     * interpret/at_once.c. NULL from it: it must be a node. NULL: all are nodes. */
    struct machine_value *(*at_once)(struct machine *m, struct machine_value *key);

    struct vpset *sets; /* 1 .. sets_count - 1; sets[0] is none */
    int sets_count, set_current;
    int processors_count, processors_log2; /* physical ones */
    uint64_t random_seed, random_draws;
};

/* The error that there is no such set; NULL. */
struct vpset *vpset_missing(struct machine *m, int vpset);
/* NULL and an error if there is none. */
static inline struct vpset *vpset_get(struct machine *m, int vpset)
{
    const struct values *v = m->values;
    return vpset > 0 && vpset < v->sets_count && v->sets[vpset].used ? &v->sets[vpset]
                                                                     : vpset_missing(m, vpset);
}

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
