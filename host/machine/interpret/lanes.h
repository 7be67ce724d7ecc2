/* lanes.h - the operations of the interpreter: each a loop over the lanes of a block.
 *
 * Lanes are held as in memory: bits in the least of 8, 16, 32, 64 or 128 bits that have room
 * for them, unused high bits 0; a single bit as 0 or 1; floats as they are. So an operand may
 * be a register, which is in the nearest cache, or a part of an array itself.
 *
 *     lanes_function *add = lanes_find(MACHINE_ADD, LANES_U32);
 *     add(&step, at, n);          at[step.to][i] = at[step.in[0]][i] + at[step.in[1]][i], for n
 *                                 lanes
 *
 * fast_loops.h has the loops; it is compiled once for each instruction set. What has no loop
 * there is done lane by lane (lane_by_folding.c). Both give the same bits as generated
 * kernels. */
#ifndef LUTETIA_MACHINE_LANES_H
#define LUTETIA_MACHINE_LANES_H

#include "base/node_ops.h"

typedef unsigned __int128 lanes_wide;

/* How a lane is held. */
enum lanes_class {
    LANES_U8,
    LANES_U16,
    LANES_U32,
    LANES_U64,
    LANES_U128,
    LANES_F32,
    LANES_F64,
    LANES_CLASSES,
    LANES_INTEGERS = LANES_F32
};
static inline enum lanes_class lanes_class_of(struct machine_type type)
{
    if (type.kind == MACHINE_FLOAT)
        return type.width == 32 ? LANES_F32 : LANES_F64;
    return type.width <= 8    ? LANES_U8
           : type.width <= 16 ? LANES_U16
           : type.width <= 32 ? LANES_U32
           : type.width <= 64 ? LANES_U64
                              : LANES_U128;
}
/* The same bytes as bits. */
static inline enum lanes_class lanes_bits_of(enum lanes_class c)
{
    return c == LANES_F32 ? LANES_U32 : c == LANES_F64 ? LANES_U64 : c;
}
size_t lanes_bytes(enum lanes_class c);
/* The bits of a type. */
static inline lanes_wide lanes_mask(struct machine_type type)
{
    return ~(lanes_wide)0 >> (128 - type.width);
}

/* Operations of the interpreter beside those of the graph. */
enum lanes_op {
    LANES_COPY = NODE_OP_COUNT, /* of bits */
    LANES_STREAM,               /* likewise, past the caches: see lanes_settle */
    LANES_JOIN,                 /* a | b << detail */
    LANES_CANONICAL,            /* NaNs of `to` become the one that operations give */
    LANES_FIT,                  /* `to`, doubles, rounded to the format of type */
    /* in: places of 32 bits; an array, which is not the lanes'; how many places there are. 0
     * where there is none */
    LANES_FETCH,
    /* a row-major index becomes a send address: PLOG2 is detail, the ratio is mask */
    LANES_PLACE,
    /* in: an index of 32 bits; the operands of `list` that it names: see lanes_picks.h */
    LANES_PICK,
    /* in: an aligned run of CROSS_NEAR lanes, or several; bits, of 32. The lanes whose numbers
     * differ in those below CROSS_NEAR */
    LANES_CROSS,
    LANES_REPEAT, /* `to`: all lanes as the first, each so much more as `detail` says */
    /* in[0]: which guard. Its lanes are those of the next `detail` steps: guards.c,
     * windows.h */
    LANES_GUARD,
    /* in: x, y, z of floats. detail 0: z + x y, 1: z - x y, 2: x y + z, 3: x y - z; the product
     * is rounded, too. axis: bit k: of in[k], k < 2, only the first lane is there, as are
     * all */
    LANES_PRODUCT_SUM,
    LANES_DRAW, /* a row-major index becomes a random number: see NODE_RANDOM */
    LANES_OP_COUNT
};

struct lanes_step;
typedef void lanes_function(const struct lanes_step *s, void *const *at, int n);

struct lanes_step {
    lanes_function *run;
    uint16_t op;              /* enum machine_op, node_op or lanes_op */
    uint16_t to, in[3];       /* places: which of at[] */
    struct machine_type from; /* of in[0] */
    struct machine_type type; /* of the result */
    int32_t detail;
    uint8_t axis;
    bool one;        /* lanes of a block are all the same: only the first is computed */
    bool in_a_row;   /* of a fetch: its places go up by one, and only the first is looked at */
    uint8_t ahead;   /* arrays that no step before has taken: bit k of in[k], and those below */
    lanes_wide mask; /* the bits of the result that may be 1 */
    uint16_t *list;  /* of a pick: places of `detail` keys and values in turn, and of what is
                     * left; NULL */
};
enum { AHEAD_TO = 8, AHEAD_LIST = 16, AHEAD_ALL = 31 }; /* of `to`; of values in `list` */

/* How many of in[] an operation takes; a pick takes those of its list, too. */
static inline int lanes_inputs(int op)
{
    return op < NODE_OP_COUNT                                          ? node_ops[op].inputs
           : op == LANES_FETCH || op == LANES_PRODUCT_SUM              ? 3
           : op == LANES_JOIN || op == LANES_DRAW || op == LANES_CROSS ? 2
                                                                       : 1;
}

/* The places that a step takes lane by lane, and some that it takes otherwise: how many; the
 * k-th; whether that is one of the others. */
static inline int lanes_taken(const struct lanes_step *s)
{
    return s->list ? 2 * s->detail + 2 : !s->run ? 0 : lanes_inputs(s->op);
}
static inline int lanes_taken_place(const struct lanes_step *s, int k)
{
    return !s->list ? s->in[k] : k == 0 ? s->in[0] : s->list[k - 1];
}
static inline bool lanes_is_apart(const struct lanes_step *s, int k)
{
    return (s->op == LANES_FETCH && k > 0) || (s->op == LANES_CROSS && k == 1) ||
           (s->op == LANES_DRAW && k == 1) ||
           (s->op == LANES_PRODUCT_SUM && k < 2 && s->axis >> k & 1);
}

/* Of operands of that class; of a select and of what is beside the graph, of that result. NULL:
 * there is no loop. */
lanes_function *lanes_find(int op, enum lanes_class c);
/* Conversions: NODE_ZERO_EXTEND (and EXTRACT), SIGN_EXTEND, U_TO_F, S_TO_F, F_TO_U, F_TO_S,
 * F_TO_F. */
lanes_function *lanes_find_conversion(int op, enum lanes_class from, enum lanes_class to);

/* Lane by lane, any operation: the slow twin of all loops. lane_by_folding.c */
lanes_function lane_each;

/* n numbers of 32 bits: first, and one more each time. */
typedef void lanes_count_function(uint32_t *to, uint32_t first, int n);
/* n elements of so many bytes that are all the same. */
typedef void lanes_fill_function(void *to, const void *element, size_t bytes, size_t n);
/* Of n processors' indices those from `first` on, `count` of them, where the context (NULL:
 * everywhere) holds: `place` and `lane` become their indices, so much further, and their lanes,
 * one after the other. n is 512 at most; both have room for 16 more. Returns how many. */
struct lanes_filter {
    const uint32_t *index;
    uint32_t first, count;
    uint32_t further; /* added to each of these indices */
};
typedef size_t lanes_filter_function(const struct lanes_filter *p, const uint8_t *context,
                                     int n, uint32_t *place, uint16_t *lane);
/* Addresses of 1, 2, 4, 8 or 16 bytes each become indices: the bits of mask, and `nobody` where
 * that is greater or the context (NULL: everywhere) does not hold. */
struct lanes_aim {
    const void *address;
    const uint8_t *context;
    size_t bytes;
    uint32_t mask, nobody;
};
typedef void lanes_aim_function(const struct lanes_aim *a, int n, uint32_t *index);
/* The greatest of n numbers where the context (NULL: everywhere) holds; 0 of none. */
typedef uint32_t lanes_greatest_function(const uint32_t *x, const uint8_t *context, int n);
/* The elements of so many bytes where the context holds, one after the other; nothing is
 * written from element `room` on. Returns how many. */
typedef size_t lanes_pack_function(const void *from, const uint8_t *context, size_t n,
                                   size_t bytes, void *to, size_t room);
/* n numbers of 32 bits: what was there, NULL: a number; but where the context holds, `rank` and
 * one more each time, as far as the bits of mask. to may be old. */
struct lanes_ranks {
    const uint8_t *context;
    const uint32_t *old;
    uint32_t *to;
    uint32_t number, mask;
};
typedef void lanes_ranks_function(const struct lanes_ranks *r, size_t n, uint32_t rank);
/* n indices below 2^31 become places in an array of such rows, halos between them. */
struct lanes_rows {
    uint32_t width, halo, further;
};
typedef void lanes_places_function(uint32_t *place, size_t n, const struct lanes_rows *r);
/* As in kernels/reduce.cl. */
enum reduction_op {
    REDUCE_AND,
    REDUCE_OR,
    REDUCE_XOR,
    REDUCE_ADD,
    REDUCE_LEAST,
    REDUCE_GREATEST
};
/* A part of a line of numbers of 32 bits: see near_loops.h. before: what the numbers before
 * come to; returns that of all, neither cut nor flipped. */
struct lanes_scan {
    const uint32_t *in;
    uint32_t *out;
    const uint8_t *context, *bits; /* NULL: all are active; no segments */
    enum reduction_op op;          /* REDUCE_ADD, LEAST, OR or XOR */
    bool exclusive, starts;
    bool streams; /* past the caches, where a line of them begins: see lanes_settle */
    uint32_t none, flip, cut;
};
typedef uint32_t lanes_scan_function(const struct lanes_scan *s, size_t n, uint32_t before);
/* Whole numbers joined with one another, where the context (NULL: everywhere) holds. */
struct lanes_sum {
    enum reduction_op op;
    size_t element; /* bytes: 1, 2, 4 or 8 */
    /* they are as long as the result, or added without a sign; else they are made longer */
    bool plain;
    uint64_t none; /* what is joined where the context does not hold */
    uint64_t flip; /* turned over: exclusive or */
    uint64_t
        sign; /* the highest bit of those that are made longer with their sign; 0: without */
};
typedef uint64_t lanes_sum_function(const struct lanes_sum *s, const void *numbers,
                                    const uint8_t *context, size_t n);

/* What was written past the caches is there for other threads from here on. */
typedef void lanes_settle_function(void);

/* The tables of one instruction set. */
struct lanes_table {
    lanes_function *of[LANES_OP_COUNT][LANES_CLASSES];
    lanes_function *convert[NODE_OP_COUNT][LANES_CLASSES][LANES_CLASSES];
    lanes_count_function *count;
    lanes_fill_function *fill;
    lanes_aim_function *aim;
    lanes_filter_function *filter;
    lanes_greatest_function *greatest;
    lanes_pack_function *pack;
    lanes_ranks_function *ranks;
    lanes_sum_function *sum;
    lanes_places_function *places;
    lanes_scan_function *scan; /* NULL: none by vectors */
    lanes_settle_function *settle;
};
/* The widest that this processor has. */
const struct lanes_table *lanes_table(void);
extern const struct lanes_table lanes_table_plain;
#ifdef LANES_X86
extern const struct lanes_table lanes_table_avx2, lanes_table_avx512;
#endif

#endif
