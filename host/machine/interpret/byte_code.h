/* byte_code.h - what the interpreter performs: the nodes of one stage and VP set as byte code.
 *
 *     place    what an operand is           moves from block to block?
 *     ARRAY    a part of an array           yes
 *     MOVED    of an array, NEWS further    yes; a register where rows have to be put together
 *     CROSSED  of an array, where the       yes
 *              index differs in some bits
 *     REGISTER lanes in the nearest cache   no
 *     LINE     a part of an array, or a     by the get that finds it
 *              register
 *     NUMBER   a register full of a number  no
 *     DRAW     a random draw's key, limit   no
 *     WHOLE    an array, of any VP set      no
 *
 * Steps name places by their number. */
#ifndef LUTETIA_MACHINE_BYTE_CODE_H
#define LUTETIA_MACHINE_BYTE_CODE_H

#include "codegen/codegen.h"
#include "interpret/lanes.h"

/* Lanes of a block, at most: a register is up to 4 KiB (of wide ones 8), a few of which are in
 * use. What a near cross looks at is in the block. */
enum { BLOCK_LANES = CROSS_NEAR };

enum place_kind {
    PLACE_ARRAY,
    PLACE_MOVED,
    PLACE_CROSSED,
    PLACE_REGISTER,
    PLACE_LINE,
    PLACE_NUMBER,
    PLACE_DRAW,
    PLACE_WHOLE
};

struct place {
    uint8_t kind;     /* enum place_kind */
    uint8_t bytes;    /* of a lane */
    int32_t node;     /* of an array, whole or not, a number, a draw */
    size_t offset;    /* of a register among the registers */
    int32_t *further; /* of a MOVED: along each axis; owned */
    int32_t bits;     /* of a CROSSED: the number of them, a node */
};

/* A condition: where all of these bits hold. */
struct guard_choice {
    uint16_t bits[2]; /* places */
    bool one[2];      /* all lanes are as the first, which alone is there */
    uint8_t count;
};
/* Where either holds. */
struct guard {
    struct guard_choice choices[2];
};

struct byte_code {
    struct place *places;
    int places_count, places_capacity;
    struct lanes_step *steps; /* with run NULL: a coordinate or index, see blocks.c */
    int steps_count, steps_capacity;
    struct guard *guards; /* of LANES_GUARD */
    int guards_count;
    size_t registers_bytes;
    struct kernel_argument *arguments; /* arrays: inputs, outputs */
    int arguments_count, arguments_capacity;
    int ops, cost;  /* as of struct kernel_text */
    double lane_s;  /* how long a lane takes, about */
    int lane_bytes; /* of arrays, that it reads and writes */
    bool far;       /* its arrays are in no cache */
    bool moves;     /* there is a MOVED */
    bool crosses;   /* lanes of a computed block are crossed */
    bool each;      /* there is a step lane by lane */
    bool streams;   /* it stores past the caches */
    bool lines;     /* it gets from places that are the same or go up by one along a row */
    bool failed;    /* no memory */
};

/* Decides what is stored and in which stage (plan_node.stage, stored): what neighbours look at,
 * and what a later stage does. */
void byte_code_stages(struct plan_graph *g);
/* What stores those nodes, all of that stage and set. shape: what steps cost. at_hand: the
 * front end's threads perform it, which may store past the caches, and pick. NULL: no
 * memory. */
struct byte_code *byte_code_make(const struct device_shape *shape, const struct plan_graph *g,
                                 const int *stores, int count, const struct vpset *set,
                                 int processors_log2, bool at_hand);
/* Takes what place.further has; 0 if there is no memory. */
int byte_code_place_add(struct byte_code *p, struct place place);
/* Room for a block of lanes among the registers; each begins a line of the caches. */
size_t byte_code_room(struct byte_code *p, enum lanes_class c);
/* Adds an array, kind and node as of struct kernel_argument, unless it is there. */
void byte_code_argument_add(struct byte_code *p, int kind, int node);
/* A place of its own for lanes of so many bytes; of that kind. */
int byte_code_place(struct byte_code *p, enum place_kind kind, int bytes);
/* Lets each array be fetched ahead by the first step that takes it. */
void byte_code_ahead(struct byte_code *p);
/* Of a set whose blocks are parts of rows: what is the same along a row is computed for one
 * lane of a block. */
void byte_code_along(struct byte_code *p, const struct vpset *set);
/* What only a selection takes, where its bit holds, is left out of blocks where the bit holds
 * nowhere, and of lanes beyond the first and last where it holds. */
void byte_code_guards(struct byte_code *p);
void byte_code_free(struct byte_code *p);

#endif
