/* internal.h - what the files of the machine share.
 *
 *   vpsets.c    VP sets: geometries and addresses                     (uses fields, slices, run)
 *   fields.c    fields and flags: which value is where                (uses simplify)
 *   simplify.c  makes values; the rules that keep the graph small     (uses graph)
 *   places.c    ... neighbours', coordinates, random numbers          (uses graph)
 *   integers.c  makes integers' quotients, powers, shifts, counts     (uses simplify)
 *   node_ops.c  what each operation is called, takes and costs        (a table)
 *   graph.c     nodes: hash-consing, reference counts, release        (uses device for buffers)
 *   plan.c      chooses what is stored and what is computed again     (pure; no OpenCL)
 *   body.c      the text of what a kernel computes                    (pure; no OpenCL)
 *   emit.c      the text of a kernel of rows                          (pure; no OpenCL)
 *   strips_schedule.c  ... of several stages, line by line: which rows, when
 *   strips_text.c      ... the text of it                             (pure; no OpenCL)
 *   tiles_size.c  ... on scalar work-items: how large tiles of the sheet are
 *   tiles_text.c       ... the text of it                             (pure; no OpenCL)
 *   narrow.c    the text of operations in lanes of 8 or 16 bits       (pure)
 *   spell.c     the text of one operation                             (pure)
 *   soft.c      floats of other formats than single and double        (uses graph)
 *   math.c      transcendental operations on the front end            (pure)
 *   run.c       evaluation: what to compute, and when                 (uses all of these)
 *   plan_kernels.c  plans kept: their kernels, made, made better, run (uses plan, emit, background)
 *   background.c  kernels compiled while others run                   (uses device)
 *   compiler.c  ... by a program of its own
 *   replay.c    calls seen before: noted, and performed all at once   (uses run, states, loops)
 *   states.c    ... what fields and flags held then                   (uses graph)
 *   loops.c     ... which of them repeat, and how many turns at once  (uses run)
 *   observe.c   reading, writing, reducing                            (uses run)
 *   watch.c     what happens when, for a trace and for explanations   (uses trace, explain)
 *   trace.c     a file of what happens when
 *   explain.c   what vanished, what was cut, what each kernel does
 *   scan.c      scans and spreads: kernels written by hand            (uses run)
 *   rank.c      ranks: a radix sort                                   (uses scan)
 *   router.c    sends and gets                                        (uses run)
 *   alias.c     aliases: the same memory seen from another VP set     (uses reshape)
 *   slices.c    slices of values; loops over them rolled up           (uses run, graph)
 *   reshape.c   content on its way between aliases                    (uses slices, run)
 *   reshape.h   what these three share, and how aliases work
 *   call.h      starting a kernel that is not generated
 *   scalar.h    numbers on the front end
 *   device.c    OpenCL: devices, buffers, programs
 *   cache.c     programs and tunings on disk
 *   tuning.c    how code is generated for a device, as `lutetia tune` found it
 *   settings.c  what can be forced by environment variables
 *   machine.c   creation, errors, configuration
 */
#ifndef LUTETIA_MACHINE_INTERNAL_H
#define LUTETIA_MACHINE_INTERNAL_H

#include <CL/cl.h>
#include <pthread.h>
#include <stdio.h>

#include "base/scalar.h"
#include "machine.h"

/* Stays in release builds: a broken invariant of ours, never of the caller. */
#define INVARIANT(condition)                                                                   \
    ((condition) ? (void)0 : machine_invariant_failed(#condition, __FILE__, __LINE__))
_Noreturn void machine_invariant_failed(const char *what, const char *file, int line);

/* ---- nodes ---- */

enum node_op {
    /* 0 .. MACHINE_OP_COUNT_PUBLIC - 1 are enum machine_op */
    NODE_CONSTANT = MACHINE_OP_COUNT_PUBLIC, /* imm */
    NODE_BUFFER,                             /* materialised: see buffer */
    NODE_COORDINATE,                         /* axis */
    NODE_INDEX,                              /* row-major */
    NODE_SEND_ADDRESS,
    NODE_RANDOM,      /* imm.lo key, imm.hi limit (0: all bits); detail 1: limit fits 32 bits */
    NODE_SELECT,      /* in: condition, a, b */
    NODE_SHIFT,       /* axis, detail = distance */
    NODE_ZERO_EXTEND, /* also truncates */
    NODE_SIGN_EXTEND,
    NODE_EXTRACT, /* detail = offset */
    NODE_CONCAT,  /* in: low, high */
    NODE_REINTERPRET,
    NODE_U_TO_F,
    NODE_S_TO_F,
    NODE_F_TO_U,
    NODE_F_TO_S,
    NODE_F_TO_F,
    NODE_PACK,          /* a float of another format -> its bits; soft.c */
    NODE_UNPACK,        /* and back */
    NODE_OVERFLOW_UADD, /* operands -> bit: the result does not fit */
    NODE_OVERFLOW_USUB,
    NODE_OVERFLOW_UMUL,
    NODE_OVERFLOW_SADD,
    NODE_OVERFLOW_SSUB,
    NODE_OVERFLOW_SMUL,
    NODE_OVERFLOW_SNEG,
    NODE_OVERFLOW_FADD,
    NODE_OVERFLOW_FSUB,
    NODE_OVERFLOW_FMUL,
    NODE_OVERFLOW_FDIV,
    NODE_OVERFLOW_RESULT, /* in: result, operand: infinite from finite */
    NODE_SLICE, /* in: a value of another VP set, in memory; imm.lo k, detail i: see reshape.h */
    NODE_OP_COUNT
};

struct node_op_info {
    const char *name; /* in dumps, and of the prelude's function */
    uint8_t inputs;   /* operands */
    uint8_t cost;     /* vector instructions, about */
    uint8_t nan;      /* enum nan */
};
/* May an operation's result be a NaN with bits that are not *the* NaN's (NAN_32, NAN_64)? Devices that keep NaNs give
 * that one for the last kind of operations, of operands with no other. */
enum nan { NAN_NEVER, NAN_ANY, NAN_KEPT };
extern const struct node_op_info node_ops[NODE_OP_COUNT];

/* Before and after each buffer there is so much more memory, which nobody's numbers are in: kernels in strips load
 * vectors of which some lanes are beyond a row's ends. A multiple of any device's alignment. */
enum { DEVICE_GUARD_BYTES = 4096, LINE_BYTES = 64 };

/* A buffer of so many bytes, in which the first column of the first row is so many bytes on. */
struct rows {
    size_t bytes, first;
};

struct device_buffer {
    cl_mem mem;
    size_t bytes, first; /* see struct rows */
    uint32_t refs; /* a buffer goes back to the pool at 0; the queue is in order, so at once */
    uint32_t mark, number; /* of replay.c */
};

#define GENERATOR_NONE 255 /* reads memory, or is dear: stored like any value */
#define GENERATOR_CHEAP                                                                        \
    24 /* a function of coordinates and constants this cheap is never stored */

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
    bool kept : 1; /* a state's own: see replay.c. Does not count as waiting */
    bool told : 1; /* explain.c knows what became of it */
    int32_t detail;
    uint32_t refs;
    uint32_t hash;
    uint32_t mark;  /* visit stamp of run.c */
    uint32_t birth; /* the evaluation before which the oldest thing in it still to compute was
                       made */
    uint32_t local; /* index in the evaluation at hand */
    struct machine_value *next; /* in its hash chain, or in the free list */
    struct machine_value *in[3];
    struct machine_scalar imm;
    struct device_buffer *buffer;
};

/* Held by fields and flags. */
struct slot {
    struct machine_value *value;
    uint32_t offset, bits;   /* within the field; a flag: 0, 1 */
    uint32_t epoch_created;  /* evaluations so far when it was first stored */
    uint32_t epoch_accessed; /* ... when it was last accessed for the first time since an
                                evaluation */
    bool overwritten_first;  /* that first access overwrote it: a temporary */
    uint32_t call_accessed;  /* calls performed so far when it was last accessed: see loops.c */
};

/* Where an alias has its bits: VP r's first one is start + r div parts * outer + r mod parts * inner in
 * the memory of the field that it is an alias of. */
struct view {
    uint32_t start, parts, outer, inner;
};

struct field {
    uint32_t base; /* its id */
    uint32_t bits;
    int vpset;
    enum machine_region region;
    uint64_t serial;    /* order of allocation */
    struct slot *slots; /* ascending offsets, no overlap; what is missing is 0 */
    int slots_count, slots_capacity;
    struct field *root; /* an alias: the field whose memory it is, which is no alias itself */
    struct view view;   /* an alias: where */
    bool current;       /* an alias: its slots are what the memory holds */
    struct field *aliases, *next_alias; /* of a root: all of them */
    struct field *newest; /* of a root: the alias that was stored into since, or NULL */
};

struct lazy_overflow {
    uint8_t op; /* a NODE_OVERFLOW_*; NODE_SELECT: a is the bit; 0: none */
    struct machine_value *a, *b, *context;
};

struct vpset {
    bool used;
    uint16_t generation; /* of those that had this id */
    int rank;
    int dimensions[MACHINE_AXES_MAX];
    uint64_t count, rows; /* rows: product of all axes but the last */
    int width;            /* the last axis: what vectors run along */
    int halo;             /* columns repeated on both sides of a row */
    size_t pitch;         /* elements from row to row */
    uint64_t ratio;
    enum machine_order order;
};

/* What a VP set's processors have besides fields, by the set's id. */
struct flags {
    struct slot of[3]; /* by enum machine_flag */
    struct lazy_overflow overflow;
};

/* ---- what can be forced ---- */

#define SETTING_FREE UINT64_MAX /* the device decides */
enum { PENDING_MANY = 384 };    /* values waiting: enough for an evaluation */

/* By environment variables: settings.c. */
struct settings {
    uint64_t eager, replay;
    uint64_t flush_after; /* values waiting */
    /* Processors that a plan runs on before its kernels are optimised, and before they get boxes. */
    uint64_t optimise_after, box_after;
    uint64_t background; /* better kernels are compiled while others run */
    uint64_t knob[MACHINE_KNOBS];
    uint64_t strips, in_place, scatter, narrow, keeps_nan;
    uint64_t tile; /* width << 16 | height */
    uint64_t processors;
    uint64_t tuned;   /* 0: what is kept of a tuning is not looked at */
    uint64_t keep;    /* programs on disk */
    uint64_t verbose; /* says on the standard error what is wrong with it */
};

/* ---- the device ---- */

struct device_shape {              /* what generated code should look like there */
    int vector;                    /* lanes of 32 bits in a work-item; 1 on a GPU */
    int halo;                      /* columns of padding, where vectors are used */
    double op_ns;                  /* cost model: one vector instruction, for an element */
    double byte_ns;                /* ... one byte to or from memory */
    double near_byte_ns;           /* ... to or from a cache, or local memory */
    int near_bytes;                /* of a cache, which rings should not fill */
    int strip_columns;             /* the most, a multiple of the vector */
    bool no_strips, always_strips; /* or tiles: see plan.c; for tests */
    int run_columns;               /* of a work-item: a multiple of the vector, but on a GPU */
    int strips_each;               /* for each unit */
    int units;                     /* that compute at the same time */
    int group;                     /* of a tile: work-items; 0: there are no tiles */
    int local_bytes;               /* of local memory, for a work-group */
    int tile_width, tile_height;   /* forced; 0: free */
    int turns;                     /* of a loop at once */
    bool narrow;                   /* kernels may have lanes of 8 or 16 bits */
    bool keeps_nan;                /* see enum nan */
    bool streams;                  /* large arrays are stored past the caches */
    double launch_ns;              /* ... a launch */
};

struct program_entry;

struct device {
    cl_platform_id platform;
    cl_device_id id;
    cl_context context;
    cl_command_queue queue;
    char name[256], platform_name[128], driver[128];
    bool is_cpu, has_double;
    int units; /* that compute at the same time */
    uint64_t memory_bytes, memory_max_alloc_bytes;
    struct device_shape shape;
    struct device_buffer **pool;
    int pool_count, pool_capacity;
    uint64_t pool_bytes, held_bytes;
    unsigned skew;                  /* of the next buffer's beginning */
    struct program_entry *programs; /* hash table by text: see device.c */
    uint64_t kernels_built, kernels_built_background, kernels_run;
    double busy_s;        /* waiting for it */
    int inside;           /* calls that build, launch or wait: see machine_leave() */
    cl_kernel *unstarted; /* built, and not run yet */
    int unstarted_count, unstarted_capacity;
    const char *options;
    bool is_pocl;           /* on a CPU */
    bool keeps_programs;    /* on disk */
    cl_event fence;         /* see device_pace(); NULL: none yet */
    uint64_t fence_kernels; /* run before it */
};

struct plan;
struct background;

/* How often each rule found something that need not be computed: simplify.c, fields.c, run.c. */
struct vanished {
    uint64_t overwritten, nested, under_context, numbers, known, overflows, expressions;
};

enum { TRACE_LENGTH = 128 };

/* A plan's kernels: of one turn of a loop; of many, which must be one kernel. */
enum rehearsal { REHEARSING_NOTHING, REHEARSING_ONE, REHEARSING_TURNS };

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

    int simplify_budget; /* nodes that simplify_under() may still look at in this instruction */
    uint32_t epoch;      /* evaluations so far, from 1 on */
    uint32_t mark;       /* of the walk under way */
    struct vanished vanished;

    struct vpset *sets; /* 1 .. sets_count - 1; sets[0] is none */
    int sets_count, set_current;
    int processors_count, processors_log2; /* physical ones */
    uint64_t random_seed, random_draws;
};

/* Fields and flags. */
struct memory {
    struct flags *flags;   /* by VP set, as many as values->sets */
    struct field **fields; /* ascending base */
    int fields_count, fields_capacity;
    int last_found; /* index of a field */
    uint32_t next_base;
    uint64_t serial;
};

/* Plans kept, and their kernels. */
struct plans {
    struct plan **table; /* by signature; NULL: there has been none */
    int table_size;
    struct background *background; /* background.c; NULL: nothing was wanted so far */
    struct plan *improving;        /* whose better kernels are being compiled there */
    enum rehearsal rehearsing;     /* evaluations see to their plan's kernels, and run none */
    bool silent; /* what calls do is told to nobody: they will be performed once more */
    struct plan *rehearsed; /* by the last rehearsal; NULL: there was nothing to compute */
    char *dump_dir;         /* NULL: nothing is dumped */
    int dump_count;
    uint64_t built, kernels_in_place, kernels_in_strips, kernels_in_tiles;
    double predicted_s; /* of the plans that ran */
};

/* When something is evaluated, and calls that are foreseen. */
struct run {
    bool eager;
    struct replay *replay;   /* NULL: nothing is noted */
    int calls_noted;         /* and not performed yet */
    int turns_in_row;        /* of loops that were foreseen, with nothing else in between */
    int turns_between_looks; /* so many there were when somebody looked or did something else */
    int looks_alike;         /* so often, one after the other, there were as many */
    uint64_t trace[TRACE_LENGTH]; /* the last stores, for finding the place in a loop */
    uint64_t trace_hash, trace_power, flush_hash;
    uint32_t trace_count;
    bool sliced;              /* there has been a slice: see slices.c */
    bool rolling;             /* in reshape_roll() */
    uint64_t roll_after;      /* values waiting before the next try */
    bool flush_due, flushing; /* before the next instruction; just now */
    bool hold_flush;          /* none becomes due */
    bool building; /* many turns are being performed, to be evaluated at once; it is worth it */
    uint64_t flush_place;             /* trace_hash where it became due */
    enum machine_status flush_status; /* of one that failed: said at the next store */
    uint64_t stores, stores_evaluated, flushes, calls_foreseen;
};

/* One member a layer, each above those before it. */
struct machine {
    enum machine_status status;
    char error[1024];
    pthread_t owner;
    struct settings settings;
    struct watch *watch; /* NULL: nobody looks */
    struct device *device;
    struct values *values;
    struct plans *plans;
    struct memory *memory;
    struct run *run;
};

/* Of a VP set that has an id. */
static inline struct flags *flags_of(const struct machine *m, const struct vpset *s)
{
    return &m->memory->flags[s - m->values->sets];
}

/* machine.c */
enum machine_status machine_fail(struct machine *m, enum machine_status status,
                                 const char *format, ...) __attribute__((format(printf, 3, 4)));
double machine_clock_s(void);
/* Memory for what is small beside the fields: it is not expected to run out, and when it does there is no
 * state to return to. grown: twice as much room in an array; allocated: zeros. */
void *machine_grown(void *old, int *capacity, size_t element);
/* As grown, where there is such a state: then *failed, and the array is as it was. */
void *machine_more(void *old, int *capacity, size_t element, bool *failed);
void *machine_allocated(size_t count, size_t element);
/* A hash of so many words, the same on every machine. */
uint64_t machine_words_hash(const uint32_t *words, size_t count);

/* settings.c */
enum machine_status settings_read(struct machine *m);
bool settings_number(const char *text, uint64_t *out); /* false: the text is no number */
const char *settings_knob_may_be(enum machine_knob knob);

/* tuning.c */
enum { TUNING_BYTES_MOST = 4096 };
/* What a file of so many bytes says; bytes[length] is 0. False: why is in one line, with the line's number; out is
 * what is usual. platform, name and driver: the device that it must be for. */
bool tuning_parse(const char *bytes, size_t length, const struct device *d,
                  struct machine_tuning *out, char *why, size_t why_size);
/* The device is known: what nobody forces is what has been kept for it, or what config says. */
void tuning_apply(struct machine *m, const struct machine_config *config);

/* graph.c */
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
static inline bool node_is_leaf(const struct machine_value *v)
{
    return v->buffer || v->op == NODE_CONSTANT;
}
static inline bool node_is_cheap(const struct machine_value *v)
{
    return v->generator <= GENERATOR_CHEAP;
}
static inline bool type_equal(struct machine_type a, struct machine_type b)
{
    return a.kind == b.kind && a.width == b.width && a.s == b.s && a.e == b.e;
}

/* soft.c: floats of other formats */
bool soft_type_good(struct machine_type type); /* s and e are what they may be, or 0 */
/* The bits of a field for a value of such a type, and back. */
struct machine_value *soft_packed(struct machine *m, struct machine_value *v);
struct machine_value *soft_unpacked(struct machine *m, struct machine_value *bits,
                                    struct machine_type type);
uint64_t soft_rounded(uint64_t x, struct machine_type type);     /* a double's bits */
uint64_t soft_packed_bits(uint64_t x, struct machine_type type); /* ... as in a field */
static inline struct machine_scalar soft_rounded_scalar(struct machine_scalar x,
                                                        struct machine_type type)
{
    if (type.s)
        x.lo = soft_rounded(x.lo, type);
    return x;
}
static inline int node_cost(int op, struct machine_type type)
{
    bool rounds = type.s && node_ops[op].inputs && op != NODE_SELECT;
    return node_ops[op].cost + (rounds ? type.s <= 24 && type.e <= 9 ? 8 : 40 : 0);
}

/* simplify.c */
struct machine_value *simplify_under(struct machine *m, struct machine_value *v,
                                     struct machine_value *context, int depth);
struct machine_value *node_overflow(struct machine *m, enum node_op op, struct machine_value *a,
                                    struct machine_value *b);

/* math.c: the transcendental operations on the front end, with the device's bits; b is ignored
 * where there is one operand. false: op is none of them. */
bool math_evaluate(int op, double a, double b, double *out);
bool math_fold(int op, struct machine_type type, struct machine_scalar a,
               struct machine_scalar b, struct machine_scalar *out);
static inline bool op_is_math(int op)
{
    return op >= MACHINE_FEXP && op <= MACHINE_FSCALE;
}
/* A node of the graph, folded by nobody. */
struct machine_value *node_make(struct machine *m, enum machine_op op, struct machine_type type,
                                struct machine_value *a, struct machine_value *b);

/* integers.c */
static inline bool op_is_integer(int op)
{
    return op >= MACHINE_UDIV && op <= MACHINE_ISQRT;
}
struct machine_value *integer_value(struct machine *m, enum machine_op op,
                                    struct machine_value *a, struct machine_value *b);

/* vpsets.c */
struct vpset *vpset_get(struct machine *m, int vpset); /* NULL and an error if there is none */
void vpsets_finish(struct machine *m);

/* fields.c */
void fields_finish(struct machine *m);
void slot_set(struct machine *m, struct slot *slot, struct machine_value *v);
/* There is no overflow to be worked out any more. */
void flag_overflow_clear(struct machine *m, struct lazy_overflow *o);
struct machine_value *flag_resolved(struct machine *m, struct vpset *s, enum machine_flag flag);
/* That very value is the content from the offset on. */
bool field_holds(const struct field *f, uint32_t offset, const struct machine_value *v);
/* The whole content of [offset, offset + type.width) of a field, as it is. */
struct machine_value *field_content(struct machine *m, struct field *f, uint32_t offset,
                                    uint32_t bits);
struct field *field_find(struct machine *m, uint32_t id, uint32_t *offset);
enum machine_status field_replace(struct machine *m, struct field *f, uint32_t offset,
                                  struct machine_value *v);

/* plan.c: see there */
struct plan_node {
    uint8_t op;
    struct machine_type type;
    uint8_t axis;
    uint8_t generator;
    bool maybe_nan;
    bool leaf;     /* a buffer */
    bool constant; /* an argument */
    bool target;
    uint16_t set;
    int32_t detail;
    int32_t in[3];
    int32_t instead[3]; /* another node that may stand for in[k] here, if it is in memory; else
                           -1 */
    /* decided */
    int stage;
    bool stored;
};
struct plan_graph {
    struct plan_node *nodes; /* inputs before users */
    int count;
    bool boxes;     /* write kernels that tell inside from outside: see body.c */
    bool strips;    /* decided: all stages in one kernel, see strips.h and tiles.h */
    bool no_strips; /* but not so */
    int turns_most; /* of a loop, in one kernel; 1: that cannot be, or does not pay */
    double cost_ns; /* of one run, by the model */
};
void plan_choose(struct plan_graph *g, const struct vpset *sets,
                 const struct device_shape *shape);
/* What a kernel finds in memory: leaves, and what an earlier stage stored. */
static inline bool plan_loads(const struct plan_node *n, int stage)
{
    return n->leaf || (n->stored && n->stage < stage);
}

/* What node n, evaluated in a kernel of that stage, takes as its operand k. */
static inline int plan_input(const struct plan_graph *g, const struct plan_node *n, int k,
                             int stage)
{
    int instead = n->instead[k];
    return instead >= 0 && plan_loads(&g->nodes[instead], stage) &&
                   !plan_loads(&g->nodes[n->in[k]], stage)
               ? instead
               : n->in[k];
}

/* More arrays than a processor foresees at once. */
enum { ARRAYS_MANY = 16 };

/* Strips are not cut narrower than that. */
enum { STRIPS_LEAST_COLUMNS = 128 };

/* Which arrays that a kernel stores may take the place of which that it reads: see strips.h. */
enum { BORDERS_MOST = 16 };
struct in_place {
    int leaves[BORDERS_MOST]; /* nodes whose borders can be copied */
    int leaves_count;
    struct {
        int output, leaf; /* nodes */
        int border;       /* of the leaf, in leaves */
    } * pairs;
    int pairs_count, pairs_capacity;
    int above, below; /* rows of a border */
    int bytes;        /* of an element of each leaf, all together */
    bool pays;        /* all arrays together are larger than what is near anyway */
};

/* emit.c */
enum kernel_argument_kind {
    ARGUMENT_INPUT,
    ARGUMENT_OUTPUT,
    ARGUMENT_CONSTANT,
    ARGUMENT_SECOND,
    ARGUMENT_BORDERS, /* of strips: which arrays are written in place */
    ARGUMENT_SCRATCH  /* of strips */
};
struct kernel_argument {
    uint8_t kind; /* enum kernel_argument_kind; SECOND: imm.hi of the node */
    uint8_t size; /* of a constant, bytes */
    int32_t node;
};
struct kernel_text {
    char *text; /* without the prelude */
    char options[160];
    struct kernel_argument *arguments;
    int arguments_count;
    int vector;
    bool wide, soft, formats, wraps, math;
    bool has_boxes;     /* or would have, if asked for */
    int ops, loads;     /* emitted */
    size_t strip_bytes; /* memory that each strip needs; 0: not in strips */
    int strip_margin;   /* rows that each computes besides its own */
    int strip_columns;  /* of all but the last, which has what is left, too */
    int group;          /* of a tile: work-items; 0: not in tiles */
    int tile_width, tile_height;
    struct in_place in_place;
    int cost; /* node_cost() of these operations, and of coordinates and random numbers */
};
/* One kernel that stores the given nodes, all of one stage and VP set. false: out of memory. */
bool emit_kernel(const struct plan_graph *g, const int *stores, int stores_count,
                 const struct vpset *set, const struct device_shape *shape,
                 struct kernel_text *out);
/* strips_text.c: one for all stages; nodes of one VP set with two axes. false: it cannot be done so. */
bool emit_strips(const struct plan_graph *g, const int *stores, int count,
                 const struct vpset *set, const struct device_shape *shape,
                 struct kernel_text *out);
/* tiles_text.c: likewise, on scalar work-items. */
bool emit_tiles(const struct plan_graph *g, const int *stores, int count,
                const struct vpset *set, const struct device_shape *shape,
                struct kernel_text *out);
void kernel_text_finish(struct kernel_text *k);
size_t type_bytes(struct machine_type type); /* in a buffer */

/* run.c */
/* Evaluates targets (may be none) and whatever else should be: all: everything that is live. */
enum machine_status run_evaluate(struct machine *m, struct machine_value **targets, int count,
                                 bool all);
enum machine_status run_after_store(struct machine *m, const struct machine_value *v);
/* What became due at a store is done between instructions. */
void run_flush_due(struct machine *m);
void run_init(struct machine *m);

/* plan_kernels.c */
/* A plan, kept until the machine goes. version: another one where other kernels have been made for it;
 * UINT32_MAX while better ones are due, which run_evaluate() sees to. stored: the nodes that get a buffer. */
struct plan;
uint32_t plan_version(const struct machine *m, const struct plan *p);
/* Its kernels are still being compiled in the background. */
bool plan_waits(const struct machine *m, const struct plan *p);
/* It is as good as it will be, and takes a kernel or more of each VP set for each of so many turns. */
bool plan_saves_nothing(const struct plan *p, int turns);
/* It is of many turns, and they cannot be one kernel. */
bool plan_is_hopeless(const struct plan *p);
/* Between evaluations: a plan whose better kernels are all there gets them. Loads at most one of them. */
void plans_see_to(struct machine *m);
const int *plan_stored(const struct plan *p, int *count);
int plan_turns(const struct plan *p); /* how many of it may be cheaper in one kernel; 1: one */

/* plan_run.c */
/* What is known of buffers before a run that has been foreseen. */
struct fates {
    /* Of a node: nobody will look at its buffer afterwards, if this is the only reference. What is stored may take its
     * place. */
    const bool *dies;
    /* Of a node that is stored: who asked wants it; else it is let go of when it has been used. */
    const bool *kept;
    /* What nobody will look at any more, nor this plan, where there is no other reference: room for what is stored. */
    struct device_buffer *const *spare;
    int spare_count;
};
/* buffers: of each node that is in memory; those stored are put there, and belong to the caller. nodes: those
 * that are numbers. fates: NULL: nothing is known. On failure none is put. */
enum machine_status plan_run(struct machine *m, struct plan *p, struct device_buffer **buffers,
                             struct machine_value *const *nodes, const struct fates *fates);
void plans_finish(struct machine *m);

/* replay.c */
bool replay_init(struct machine *m);
void replay_finish(struct machine *m);
/* Calls noted are performed: before anything looks at what fields and flags hold, or changes it. */
void replay_perform(struct machine *m);
static inline void replay_settle(struct machine *m)
{
    if (m->run->calls_noted)
        replay_perform(m);
}
/* Before the content of a field or flag changes, or a node that is kept. */
void replay_changes(struct machine *m);
/* Something was done that depends on more than the call and the state. */
void replay_impure(struct machine *m);
/* Before fields die, or VP sets change their shape. */
void replay_forget(struct machine *m);
bool replay_in_call(const struct machine *m);
bool replay_in_loop(const struct machine *m); /* then evaluations become due after calls */
/* In the call that is being performed. */
void loops_slot_accessed(struct machine *m, struct slot *slot, bool overwrites);
bool replay_thorough(const struct machine *m); /* evaluations are to leave nothing to compute */
void replay_looked(struct machine *m);         /* somebody has, or something else begins */
void replay_resolve(struct machine *m);        /* ... no lazy overflow either */
/* Calls are noted that lead from a state to the next evaluation. */
bool replay_follows(const struct machine *m);
/* An evaluation is about to run the plan for these nodes; has run it (buffers: with those stored); or
 * could not. */
void replay_evaluates(struct machine *m, struct plan *plan, struct machine_value *const *nodes,
                      int count, struct device_buffer *const *buffers);
void replay_evaluated(struct machine *m, struct device_buffer *const *buffers,
                      struct machine_value *const *wanted, int wanted_count);
void replay_failed(struct machine *m);

/* observe.c */
/* The value with its numbers in a buffer of the VP set, laid out as kernels want them (a number:
 * everywhere the same). Does not wait. NULL: error set. */
struct machine_value *observe_materialise(struct machine *m, int set, struct machine_value *v);
/* Of a buffer for one value of that type: its rows, and 16 elements more where they have a halo. */
size_t observe_buffer_bytes(const struct vpset *s, struct machine_type type);
struct rows observe_rows(const struct vpset *s, struct machine_type type);

/* scan.c */
/* Lines of elements in a buffer: see kernels/scan.cl. */
struct lines {
    cl_ulong base;
    cl_long step;
    cl_ulong inner_stride, outer_stride;
    size_t inner, outer; /* rows of lines */
    cl_int length, columns, width, halo, along;
};
struct lines lines_of(const struct vpset *s, int axis, bool downward);
static inline size_t lines_count(const struct lines *l)
{
    return l->outer * l->inner * (size_t)l->columns;
}
/* Each 32-bit number of dense lines becomes the sum of those before it. */
enum machine_status lines_sum_up(struct machine *m, struct device_buffer *b, size_t lines,
                                 size_t length);
/* machine_scan() in another context. */
struct machine_value *scan_where(struct machine *m, const struct machine_scan *how,
                                 struct machine_value *value, struct machine_value *context);
/* Where segments begin when lines are gone through in that direction; NULL: only at the ends. */
struct machine_value *scan_boundaries(struct machine *m, const struct machine_scan *how);
/* false: error set. */
bool scan_arguments_good(struct machine *m, const struct vpset *s, int axis,
                         const struct machine_value *value, const struct machine_value *bits);
/* What has the same bits in memory already, where something has. */
struct machine_value *in_memory(struct machine_value *v);
/* Bits in the order of the floats; NaNs become nan. */
struct machine_value *float_order(struct machine *m, struct machine_value *v, uint64_t nan);
/* Puts the values into buffers of the VP set, all in one evaluation. false: error set. */
bool values_materialise(struct machine *m, int set, struct machine_value **values, int count);

/* fields.c */
/* The slots between two bit offsets are given up for these, whose values' references go to the field. */
void field_slots_put(struct machine *m, struct field *f, uint32_t from, uint32_t to,
                     const struct slot *slots, int count);
void field_unlink_alias(struct field *alias);
/* The field that begins at the id; NULL if none does. */
struct field *field_exact(struct machine *m, uint32_t id);
/* Whether the field may have so many bits without running into the next one's ids. */
bool field_room(const struct machine *m, const struct field *f, uint32_t bits);
void field_destroy(struct machine *m, struct field *f);

/* alias.c */
/* Called before slots of f are looked at, or replaced (writes; whole: all of them, everywhere): brings
 * what was stored through another alias of its memory. */
bool reshape_bring(struct machine *m, struct field *f, bool writes, bool whole);
/* The root takes over what its newest alias holds. */
bool reshape_settle(struct machine *m, struct field *root);

/* slices.c */
/* Gives a slice its buffer; others that are found on the way too. */
bool reshape_unpack(struct machine *m, struct machine_value *slice);
/* The same numbers for the same processors in rows of another geometry; v is of the set as it is. */
struct machine_value *reshape_lay_out(struct machine *m, struct machine_value *v, int set,
                                      const struct vpset *to);
/* Finds loops over the elements of a processor among what waits in fields, and computes each as one value.
 * *partial: there are some that have only begun. */
bool reshape_roll(struct machine *m, bool *partial);
/* No slice is left that is of the VP set, or of a value of it; no other value of the set has a name
 * and a buffer. */
bool reshape_forget_set(struct machine *m, int set);

/* cache.c */
#define CACHE_HASH_BEGIN UINT64_C(0xcbf29ce484222325)
uint64_t cache_hash(uint64_t h, const char *s);
/* Opens a regular file of the cache for reading; NULL where there is none, and for pipes, links and devices. */
FILE *cache_file_read(const char *path);
unsigned char *cache_program_read(const struct device *d, const char *key, size_t *size);
void cache_program_write(const struct device *d, const char *key, cl_program program);
bool cache_program_is_there(const struct device *d, const char *key);
bool cache_mark_is_there(const struct device *d, const char *key);
void cache_mark_write(const struct device *d, const char *key);

/* device.c */
enum machine_status device_open(struct machine *m, const struct machine_config *config);
void device_close(struct machine *m);
/* What is usual on a GPU, but for what the device tells. */
struct device_shape device_shape_gpu(void);
struct device_buffer *device_buffer_get(struct machine *m,
                                        size_t bytes); /* refs 1; NULL: error set */
/* On CPUs the first column is where a line of the caches begins. */
struct device_buffer *device_rows_get(struct machine *m, struct rows rows);
bool device_rows_fit(const struct device_buffer *b, struct rows rows);
void device_buffer_ref(struct device_buffer *b);
void device_buffer_unref(struct machine *m, struct device_buffer *b);
/* The kernel of that name in a program of these parts, all but the last the same for many; from
 * memory, from disk, or built. Belongs to the device. NULL: error set. */
enum { DEVICE_PARTS = 7 };
cl_kernel device_kernel(struct machine *m, const char *const parts[DEVICE_PARTS],
                        const char *options, const char *name);
/* The same for one that is written by hand, in a text of its own. */
cl_kernel device_library_kernel(struct machine *m, const char *text, const char *options,
                                const char *name);
/* What it is known by: its whole text, and how it is built. The caller's to free; NULL: no memory. */
char *device_kernel_key(const struct device *d, const char *const parts[DEVICE_PARTS],
                        const char *options, const char *name);
/* All options that its program is built with. And what PoCL is given: without the header of all OpenCL functions, which
 * clang reads for longer than what the machine says. It is told that it has read it, and functions.cl declares those in
 * use. The text is the caller's to free; NULL: no memory. */
enum { DEVICE_OPTIONS_BYTES = 300 };
void device_options(const struct device *d, const char *options, bool header,
                    char out[DEVICE_OPTIONS_BYTES]);
char *device_text_without_header(const char *const parts[DEVICE_PARTS]);
/* Starts it, unless error says that its arguments are wrong, in work-groups of that size; local NULL: the driver
 * decides, and on a CPU one is one item. The first time, waits: the compiler may still be at it in a thread of the
 * driver's, and a program that ended meanwhile would pull it down. */
enum machine_status device_launch(struct machine *m, cl_kernel kernel, cl_int error,
                                  cl_uint dimensions, const size_t *global, const size_t *local,
                                  const char *what);
/* The kernel can be started in work-groups of so many items. */
bool device_takes_group(const struct device *d, cl_kernel kernel, int items);
/* It need not be built: it is in memory, or on disk. */
bool device_kernel_at_hand(struct machine *m, const char *const parts[DEVICE_PARTS],
                           const char *options, const char *name);
enum machine_status device_check(struct machine *m, cl_int error, const char *what);
/* Around a call that waits for the device, whose time counts as busy; begin gives when it began. */
double device_wait_begin(struct machine *m);
enum machine_status device_wait_end(struct machine *m, cl_int error, double start,
                                    const char *what);
/* A whole buffer becomes repetitions of the pattern; from its beginning a copy. Do not wait. */
enum machine_status device_fill(struct machine *m, const struct device_buffer *b,
                                const void *pattern, size_t pattern_bytes, const char *what);
enum machine_status device_copy(struct machine *m, const struct device_buffer *from,
                                const struct device_buffer *to, size_t bytes, const char *what);
void device_flush(struct machine *m); /* what is in the queue begins */
/* After kernels were started: waits where the front end is hundreds of them ahead of the device,
 * for each that waits in the queue takes memory. */
enum machine_status device_pace(struct machine *m);

#endif
