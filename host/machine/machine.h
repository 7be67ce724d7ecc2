/* machine.h - a Connection Machine: virtual processors, fields of bits, a lazy value graph.
 *
 *     struct machine *m;
 *     struct machine_config config = machine_config_default();
 *     if (machine_create(&config, &m) != MACHINE_OK)
 *         die(machine_error(m));
 *     int dims[2] = {480, 640};
 *     int set = machine_vpset_create(m, dims, 2);
 *     machine_vpset_select(m, set);
 *     uint32_t f = machine_field_allocate(m, set, 32, MACHINE_HEAP);
 *     struct machine_value *x = machine_field_value(m, f, MACHINE_F32, MACHINE_WHERE_ACTIVE);
 *     machine_field_store(m, f, machine_binary(m, MACHINE_FADD, x, x), MACHINE_WHERE_ACTIVE);
 *     machine_field_download(m, f, MACHINE_F32, host_array);
 *
 * No call between create and download computes: each call records what a value now is. Values
 * that are observed are computed by as few generated kernels as the cost model allows. See
 * docs/engine.md.
 *
 * Values. A `struct machine_value *` is one number for each virtual processor of a VP set, or
 * one number for all of them (a constant). It is immutable and borrowed: valid until the next
 * machine_begin(), and longer only as the content of a field or flag. The caller calls
 * machine_begin() before each instruction.
 *
 * Types. Bits of width 1..128 (signedness belongs to the operations), IEEE single and double,
 * and floats of other formats (see machine_float_type()). Reading a field with another type or
 * width than it was written with reinterprets its bits; bit 0 is the lowest. Every float
 * operation that gives a NaN gives the quiet NaN with its sign set and payload 0 (0xffc00000,
 * 0xfff8000000000000); moves keep NaNs' bits.
 *
 * Errors. Functions that can fail return a status, or NULL / 0 with machine_status_last() set;
 * the detail is in machine_error(). A failed call changes nothing.
 *
 * Threads. One machine belongs to one thread at a time. With PoCL, a process that is no child
 * of the program may compile better kernels meanwhile (LUTETIA_BACKGROUND=0: none). After
 * fork() both processes have the machine, the child without kernels (forks.h).
 */
#ifndef LUTETIA_MACHINE_H
#define LUTETIA_MACHINE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "machine_layout.h"
#include "machine_op.h"

struct machine;
struct machine_value;

enum machine_status {
    MACHINE_OK = 0,
    MACHINE_BAD_ARGUMENT, /* a width, axis, size or handle that is out of range */
    MACHINE_NO_DEVICE,    /* no OpenCL platform, or none that fits the choice */
    MACHINE_NO_MEMORY,    /* of the host or of the device */
    MACHINE_BUILD_FAILED, /* a kernel did not compile: the log is in machine_error() */
    MACHINE_DEVICE_FAILED /* the device reported an error while running */
};

/* ---- types ---- */

enum machine_kind { MACHINE_BITS, MACHINE_FLOAT };
struct machine_type {
    uint8_t kind;  /* enum machine_kind */
    uint8_t width; /* bits 1..128; float 32 or 64 */
    uint8_t s, e;  /* significand and exponent of another format; else 0, 0 */
};
#define MACHINE_UINT(bits) ((struct machine_type){MACHINE_BITS, (uint8_t)(bits), 0, 0})
#define MACHINE_BIT ((struct machine_type){MACHINE_BITS, 1, 0, 0})
#define MACHINE_F32 ((struct machine_type){MACHINE_FLOAT, 32, 0, 0})
#define MACHINE_F64 ((struct machine_type){MACHINE_FLOAT, 64, 0, 0})

/* Floats of other formats. s bits of significand, 1..52, and e of exponent, 2..11, are laid
 * out as IEEE's are, with bias 2^(e - 1) - 1, subnormals, infinities and NaNs. Each number
 * of such a format is a double, and values of the format are doubles (width 64, s and e
 * set). Uploads, downloads, reading and writing use doubles; those written are rounded. In
 * fields the numbers have s + e + 1 bits. Operations round once, to nearest even: FADD,
 * FSUB, FMUL, FDIV, FSQRT and conversions from integers round the exact result, others round
 * the double's result. Reductions add in double and round the sum. */
#define MACHINE_SOFT(s, e)                                                                     \
    ((struct machine_type){MACHINE_FLOAT, 64, (uint8_t)(s), (uint8_t)(e)})
/* The type of floats with s and e: the native types for 23, 8 and 52, 11. */
struct machine_type machine_float_type(int s, int e);
/* How many bits of a field a value of the type takes. */
int machine_type_bits(struct machine_type type);

/* A number on the front end: bits (lo, then hi from bit 64 on), or a float as its bits in lo.
 */
struct machine_scalar {
    uint64_t lo, hi;
};

/* ---- how code is generated for a device ---- */

/* Tuning parameters. None of them changes a bit of a result. */
enum machine_knob {
    MACHINE_VECTOR,  /* lanes of 32 bits in a work-item: 1, 4, 8 or 16 */
    MACHINE_RUN,     /* columns that a work-item goes along */
    MACHINE_STREAMS, /* 1: large arrays are stored past the caches */
    MACHINE_TURNS,   /* the most turns of a loop that are evaluated at once; 1: one by one */
    MACHINE_COLUMNS, /* columns of a strip, in which several turns go through the caches */
    MACHINE_STRIPS_EACH, /* strips for each compute unit, about */
    MACHINE_KNOBS
};
/* The cost model's numbers, in nanoseconds: plans follow from them, and no bit of a result. */
enum machine_cost {
    MACHINE_COST_OP,   /* one vector instruction; on a GPU, an instruction for an element */
    MACHINE_COST_BYTE, /* one byte to or from memory */
    MACHINE_COST_NEAR_BYTE, /* one byte to or from a cache, or a GPU's local memory */
    MACHINE_COST_LAUNCH,    /* one launch of a kernel */
    MACHINE_COSTS
};
struct machine_tuning {
    int of[MACHINE_KNOBS];         /* -1: the usual value for the kind of device */
    double cost_ns[MACHINE_COSTS]; /* 0: the usual value */
};
const char *machine_knob_name(enum machine_knob knob); /* "vector" */
bool machine_knob_allows(enum machine_knob knob, int value);
const char *machine_cost_name(enum machine_cost cost); /* "near byte" */
bool machine_cost_allows(enum machine_cost cost, double ns);
struct machine_tuning machine_tuning_usual(void);

/* ---- the machine ---- */

struct machine_config {
    const char *device;   /* part of a platform's or device's name, or an index; NULL:
                           * LUTETIA_DEVICE, else the first */
    int processors_count; /* physical processors, a power of two; 0: LUTETIA_PROCESSORS, else
                             65536 */
    int eager;            /* evaluate after every store; -1: LUTETIA_EAGER */
    const char *dump_dir; /* folder for graphs and kernels; NULL: LUTETIA_DUMP, else none */
    const char *trace;    /* trace file; NULL: LUTETIA_TRACE, else none. If it cannot be
                        * written, one line on the standard error says so */
    int explain;          /* 1: collect the facts for machine_explain() */
    const struct machine_tuning
        *tuning; /* NULL: what machine_tuning_keep() stored for the device */
};
struct machine_config machine_config_default(void);

/* Owns. After a failure *out may be set for its error text; machine_destroy() frees it, too. */
enum machine_status machine_create(const struct machine_config *config, struct machine **out);
void machine_destroy(struct machine *m); /* NULL is fine */

/* For exit handlers: waits for running kernels, which still use the driver and their buffers,
 * and releases nothing. Returns at once where waiting is impossible: in another thread, or if
 * the exit comes from inside an evaluation (a compiler called exit()). NULL is fine. */
void machine_leave(struct machine *m);

/* Whether it pays to perform something and to empty the machine before the program begins:
 * nothing is compiled for it, and nobody watches. */
bool machine_warms_up(const struct machine *m);
/* Destroys all VP sets, fields, values and plans: the machine is as it was made. */
enum machine_status machine_empty(struct machine *m);

enum machine_status machine_status_last(const struct machine *m);
const char *machine_error(const struct machine *m); /* the last failure, one line; "" if none */
void machine_error_clear(struct machine *m);

/* Starts an instruction: releases the values that were handed out before. */
void machine_begin(struct machine *m);

/* ---- calls seen before ---- */

/* An instruction as its caller knows it: which one, and the numbers passed to it. Its effect
 * must depend only on these, the current VP set, the existing fields, and the contents of
 * fields and flags. If a caller writes
 *
 *     struct machine_call call = {.again = perform_add, .words_count = 2, .words = {dest, source}};
 *     if (machine_call_foreseen(m, &call))
 *         return;
 *     ... machine_begin(), values, stores ...
 *     machine_call_performed(m);
 *
 * then repeated steps run without being recorded again. True means that the call is as
 * expected; it will have been performed before anything is observed. If later calls are not
 * as expected, again() is called to perform it after all.
 */
enum { MACHINE_CALL_WORDS = 8 };
struct machine_call {
    void (*again)(const struct machine_call *call);
    const char *name; /* the name in traces and reports; a literal */
    int vpset;        /* set by the machine */
    uint32_t words_count;
    uint64_t words[MACHINE_CALL_WORDS];
};
bool machine_call_foreseen(struct machine *m, struct machine_call *call);
void machine_call_performed(struct machine *m);
/* Says that the call failed, and that the error has been reported. */
void machine_call_failed(struct machine *m);
/* Says that calls have another effect from now on (a mode of the caller has changed). */
void machine_calls_forget(struct machine *m);

/* Computes what is pending, live and expected to be read again (not temporaries); does not
 * wait. Results never depend on calling it. */
enum machine_status machine_flush(struct machine *m);
/* The same, and waits for the device. */
enum machine_status machine_finish(struct machine *m);

enum { MACHINE_CACHE_FOLDER_MAX = 512 };
/* The folder of kernels and tunings: $XDG_CACHE_HOME/lutetia or ~/.cache/lutetia, else a
 * temporary folder that is removed when the process ends. *why (may be NULL) gets the reason
 * for a temporary folder, else NULL. False: there is no folder. */
bool machine_cache_folder(char out[static MACHINE_CACHE_FOLDER_MAX], const char **why);

int machine_processors_count(const struct machine *m);
const char *machine_device_name(const struct machine *m);

/* The knobs and costs in effect: what the environment forces (docs/engine-reference.md), else
 * config's or the stored tuning, else the usual values. No knob is -1, no cost 0. */
struct machine_tuning machine_tuning_get(const struct machine *m);
/* Measures costs on the machine's device, in some seconds; 0: could not be measured. Called
 * between instructions. Errors: as of fields and evaluations. */
enum machine_status machine_costs_measure(struct machine *m, double ns[MACHINE_COSTS]);
/* Stores a tuning for all machines on that device from now on, in all programs, at once and
 * whole. Errors: MACHINE_BAD_ARGUMENT (the file, and why): the old one stays. */
enum machine_status machine_tuning_keep(struct machine *m, const struct machine_tuning *tuning);
/* Says in one line whether there is a stored tuning for the device, in which file, and
 * whether it is used: */
enum machine_tuned { MACHINE_UNTUNED, MACHINE_TUNED, MACHINE_TUNED_BADLY };
enum machine_tuned machine_tuning_describe(const struct machine *m, char *out, size_t size);
const char *machine_device_driver(const struct machine *m); /* its version */

struct machine_stats {
    uint64_t stores;                   /* values stored into fields and flags */
    uint64_t values_live;              /* nodes in the graph now */
    uint64_t calls_foreseen;           /* calls that were performed without being recorded */
    uint64_t flushes;                  /* evaluations */
    uint64_t plans_built;              /* evaluations of a new shape */
    uint64_t kernels_built;            /* compiled, or loaded from the disk cache */
    uint64_t kernels_built_background; /* of these, in the background (LUTETIA_BACKGROUND) */
    uint64_t kernels_run;
    uint64_t interpreted; /* stages of plans that ran without a kernel (LUTETIA_INTERPRET) */
    uint64_t kernels_in_place;  /* of these: over old values that nobody wants any more */
    uint64_t kernels_in_strips; /* of these: several stages at once */
    uint64_t kernels_in_tiles;  /* likewise, in local memory */
    double predicted_s; /* what evaluations take by the cost model: docs/engine-reference.md */
    uint64_t bytes_held, bytes_peak; /* device memory in use by values: now, at most so far */
    double busy_s; /* in which the front end waited for the device, or did its work */
};
void machine_stats_get(const struct machine *m, struct machine_stats *out);

/* Calls machine_begin(), and tells observers the instruction's name, a literal. */
void machine_instruction(struct machine *m, const char *name);

/* For `lutetia info`: calls `each` for each OpenCL device; returns their number. */
int machine_devices_list(void (*each)(void *context, int index, const char *platform,
                                      const char *device, const char *version,
                                      int compute_units, uint64_t memory_bytes),
                         void *context);

/* ---- VP sets ---- */

/* Shape: dimensions[0..rank-1], each 1 or more, axis 0 varies slowest in memory (row-major).
 * Returns an id from 1 on, or 0. A VP set starts with context 1, test and overflow 0. */
int machine_vpset_create(struct machine *m, const int *dimensions, int rank);
/* Where they live is told by machine_layout.h; machine_vpset_create() is NEWS order. */
int machine_vpset_create_ordered(struct machine *m, const int *dimensions, int rank,
                                 enum machine_order order);
/* layout: machine_layout_make() of these dimensions and machine_processors_count(). */
int machine_vpset_create_laid_out(struct machine *m, const int *dimensions, int rank,
                                  const struct machine_layout *layout);
/* Gives the same processors another geometry of the same size. A processor is identified by
 * its send address, and keeps its content. */
enum machine_status machine_vpset_arrange(struct machine *m, int vpset, const int *dimensions,
                                          int rank, const struct machine_layout *layout);
enum machine_status machine_vpset_destroy(struct machine *m,
                                          int vpset); /* destroys its fields, too */
enum machine_status machine_vpset_select(struct machine *m,
                                         int vpset); /* selects the set for new values */
int machine_vpset_current(const struct machine *m);
int machine_vpset_rank(const struct machine *m, int vpset);
int machine_vpset_length(const struct machine *m, int vpset, int axis);
uint64_t machine_vpset_count(const struct machine *m, int vpset); /* virtual processors */
uint64_t machine_vpset_ratio(const struct machine *m, int vpset);
/* The number of bits of a send address of the set, which has P * R addresses; at least 1. */
int machine_address_bits(const struct machine *m, int vpset);
uint64_t machine_send_address(const struct machine *m, int vpset, uint64_t index);
/* The row-major index of a send address; UINT64_MAX if there is no such processor. */
uint64_t machine_index(const struct machine *m, int vpset, uint64_t send_address);

/* ---- fields ---- */

enum machine_region { MACHINE_STACK, MACHINE_HEAP };
#define MACHINE_NO_FIELD 0u

/* A field id is a bit address in its own address space: id + k is the part of the field that
 * begins k bits further on. New fields are zero. MACHINE_NO_FIELD: it failed. */
uint32_t machine_field_allocate(struct machine *m, int vpset, uint32_t bits,
                                enum machine_region region);
enum machine_status machine_field_deallocate(struct machine *m,
                                             uint32_t field); /* heap fields; exact id */
/* Deallocates the stack field and every stack field allocated after it (in any VP set). */
enum machine_status machine_field_deallocate_through(struct machine *m, uint32_t field);

struct machine_field_info {
    uint32_t base;   /* id of the whole field */
    uint32_t bits;   /* of the whole field */
    uint32_t offset; /* of the id asked about, within it */
    int vpset;
    enum machine_region region;
};
/* False if there is no such field (any more). Does not set the error. */
bool machine_field_lookup(const struct machine *m, uint32_t field,
                          struct machine_field_info *out);
/* The VP set of the field that the id is in; 0: it is in none. */
int machine_field_vpset(const struct machine *m, uint32_t field);

/* ---- lenient ----
 *
 * With it, what is read or stored past a field's end is in the field of the same VP set and
 * region that was allocated next after it; past the last one bits are 0, and what is stored
 * there is lost. Without, as a machine begins unless LUTETIA_LENIENT=1, that is an error. */
void machine_lenient_set(struct machine *m, bool on);
bool machine_lenient(const struct machine *m);
/* Whether so many bits from there run past a field's end, and a lenient machine goes on. */
bool machine_field_runs_over(const struct machine *m, uint32_t field, uint32_t bits);

/* ---- aliases ---- */

/* Makes a field that is the same memory, from that bit of the field on, seen from the VP set.
 * Memory belongs to physical processors: of a field of L bits in a set of VP ratio R each has
 * R * L bits, VP after VP.
 *  - The set has the same ratio: its VPs see their own bits, L - offset of them.
 *  - k times the ratio: the L - offset bits of each VP are shared out among k, (L - offset) / k
 *    to each.
 *  - a k-th of it: each VP sees the bits of k one after the other, without the first offset.
 *  - other ratios: the bits of the processor are shared out, one VP after the other.
 * Stores through one are visible through all. Bits of VPs beyond the set's size (if it is no
 * multiple of the processors) are 0 and are not kept. An alias of an alias is an alias of the
 * same memory. An alias is deallocated with its memory, or with its VP set. Its id takes
 * offsets as any field's. MACHINE_NO_FIELD: it could not be made. */
uint32_t machine_alias_make(struct machine *m, uint32_t field, int vpset);
/* Makes the alias one of another field, in its own VP set. */
enum machine_status machine_alias_change(struct machine *m, uint32_t alias, uint32_t field);
enum machine_status machine_alias_remove(struct machine *m, uint32_t alias);
bool machine_is_alias(struct machine *m, uint32_t field);

/* ---- values ---- */

/* WHERE_ACTIVE: the caller uses the value only for stores under the present context, so its
 * content in inactive processors does not matter. EVERYWHERE: that content matters
 * (neighbours will read it, or a store ignores the context). */
enum machine_scope { MACHINE_WHERE_ACTIVE, MACHINE_EVERYWHERE };

struct machine_value *machine_field_value(struct machine *m, uint32_t field,
                                          struct machine_type type, enum machine_scope scope);
/* WHERE_ACTIVE stores under the context, EVERYWHERE ignores it. Its type is the width. */
enum machine_status machine_field_store(struct machine *m, uint32_t field,
                                        struct machine_value *value, enum machine_scope scope);

enum machine_flag { MACHINE_CONTEXT, MACHINE_TEST, MACHINE_OVERFLOW };
/* Of the current VP set. */
struct machine_value *machine_flag_value(struct machine *m, enum machine_flag flag,
                                         enum machine_scope scope);
enum machine_status machine_flag_store(struct machine *m, enum machine_flag flag,
                                       struct machine_value *value, enum machine_scope scope);

struct machine_type machine_value_type(const struct machine_value *v);
/* Whether the value is known to be 0 everywhere: the constant, or bits never written. */
bool machine_value_is_zero(const struct machine_value *v);

/* Constants: bits above the width are ignored. */
struct machine_value *machine_constant(struct machine *m, struct machine_type type,
                                       struct machine_scalar bits);
/* A front-end number rounded to a float of 32 or 64 bits; every NaN becomes *the* NaN. */
struct machine_scalar machine_float_bits(struct machine_type type, double x);
/* Rounded to the type. */
struct machine_value *machine_constant_float(struct machine *m, struct machine_type type,
                                             double x);

/* The low bits, up to the width, of a NEWS coordinate, a send address, a row-major index. */
struct machine_value *machine_coordinate(struct machine *m, int axis, int width);
struct machine_value *machine_self_address(struct machine *m, int width);
struct machine_value *machine_self_index(struct machine *m, int width);

/* Random numbers, uniform on 0..limit-1 (limit 0: on all of 2^width); each call draws anew.
 * They depend only on the seed, the number of the draw and the row-major index, and are the
 * same on every device. With mix() the finaliser of splitmix64 and g = 0x9e3779b97f4a7c15,
 * draw k (from 1) of index n is z = mix(mix(mix(seed) + k*g) + n*g), and the result the high
 * width bits of z, or (z >> 32)*limit >> 32 for a limit under 2^32, or the high 64 bits of
 * z*limit. Beyond 64 bits: two draws, low bits first; with a limit the high part is 0. */
struct machine_value *machine_random(struct machine *m, int width, uint64_t limit);
void machine_random_seed(struct machine *m, uint64_t seed);

/* Whether the operation is a function of floats in kernels/math.cl: exp, sine, power, ... */
bool machine_op_is_function(int op);
struct machine_value *machine_unary(struct machine *m, enum machine_op op,
                                    struct machine_value *a);
struct machine_value *machine_binary(struct machine *m, enum machine_op op,
                                     struct machine_value *a, struct machine_value *b);
/* USHIFT, SSHIFT, ROTATE by a signed count of any width. A count beyond the value's width is
 * clamped to the width; for ROTATE it is taken modulo the width. */
struct machine_value *machine_bits_shift(struct machine *m, enum machine_op op,
                                         struct machine_value *a, struct machine_value *count);
/* condition ? a : b for each processor; a and b have one type. */
struct machine_value *machine_select(struct machine *m, struct machine_value *condition,
                                     struct machine_value *a, struct machine_value *b);

/* Bits resized to another width. */
struct machine_value *machine_resize(struct machine *m, struct machine_value *a, int width,
                                     bool is_signed);
/* The width bits of a that begin at offset. */
struct machine_value *machine_extract(struct machine *m, struct machine_value *a, int offset,
                                      int width);
/* (high : low), low's width + high's width at most 128. */
struct machine_value *machine_concat(struct machine *m, struct machine_value *low,
                                     struct machine_value *high);
/* The same bits with another type of the same width. */
struct machine_value *machine_reinterpret(struct machine *m, struct machine_value *a,
                                          struct machine_type type);
/* Bits to float, rounded to nearest even; float to float. */
struct machine_value *machine_to_float(struct machine *m, struct machine_value *a,
                                       struct machine_type type, bool is_signed);
/* Float to bits, toward zero; out of range, the nearest end of the range; a NaN gives 0. */
struct machine_value *machine_to_bits(struct machine *m, struct machine_value *a, int width,
                                      bool is_signed);

/* Each processor has the value of the one whose coordinate on the axis is greater by
 * distance (any sign); wraps round. The operand must be read EVERYWHERE. */
struct machine_value *machine_shift(struct machine *m, struct machine_value *a, int axis,
                                    int distance);

/* Sets the overflow flag of active processors to "op(a, b) does not fit". The flag is
 * recorded, and computed only if it is read. op: ADD, SUB, MUL, NEG (b NULL) on bits; FADD,
 * FSUB, FMUL, FDIV (infinite from finite). */
enum machine_status machine_overflow_record(struct machine *m, enum machine_op op,
                                            bool is_signed, struct machine_value *a,
                                            struct machine_value *b);

/* The same for an existing float: overflow of active processors becomes "result is infinite,
 * and operand is neither infinite nor a NaN". */
enum machine_status machine_overflow_record_result(struct machine *m,
                                                   struct machine_value *result,
                                                   struct machine_value *operand);
/* The same for a given bit, which is computed only if the flag is read. */
enum machine_status machine_overflow_record_value(struct machine *m,
                                                  struct machine_value *overflows);

/* Computes these values now, so that later operations find them in memory. Results never
 * depend on it; a long chain of equal parts becomes one kernel that runs often. */
enum machine_status machine_settle(struct machine *m, struct machine_value **values, int count);

/* ---- the router ---- */

enum machine_combiner {
    MACHINE_COMBINE_OVERWRITE, /* the last one; any type */
    MACHINE_COMBINE_AND,
    MACHINE_COMBINE_OR,
    MACHINE_COMBINE_XOR,
    MACHINE_COMBINE_ADD, /* modulo 2^width */
    MACHINE_COMBINE_UMIN,
    MACHINE_COMBINE_UMAX,
    MACHINE_COMBINE_SMIN,
    MACHINE_COMBINE_SMAX,
    MACHINE_COMBINE_FADD,
    MACHINE_COMBINE_FMIN,
    MACHINE_COMBINE_FMAX
};
/* Each active processor of the current VP set sends source to dest in the processor at the
 * send address; dest may be in another VP set, whose context does not matter. The result is
 * as if the senders, one after the other in the order of their row-major indices, did dest =
 * combine (dest, their source) with the machine's operation of that name. So with OVERWRITE
 * the sender with the highest index wins, and sums of floats begin with the old dest. Only
 * the low machine_address_bits() (of dest's set) of an address count. Messages to a
 * processor that does not exist are lost. notify: a bit field of dest's set, which becomes 1
 * where a message arrived and 0 elsewhere; or MACHINE_NO_FIELD. */
enum machine_status machine_send(struct machine *m, uint32_t dest,
                                 struct machine_value *send_address,
                                 struct machine_value *source, enum machine_combiner combiner,
                                 uint32_t notify);
/* Reads the field in the processor at each active processor's send address; 0 if there is no
 * such processor, undefined in inactive processors. The field may be in another VP set. */
struct machine_value *machine_get(struct machine *m, struct machine_value *send_address,
                                  uint32_t source, struct machine_type type);
/* Counts the active processors whose address is of no processor of vpset; waits. */
enum machine_status machine_addresses_check(struct machine *m,
                                            struct machine_value *send_address, int vpset,
                                            uint64_t *wrong);

/* ---- along axes: scans, spreads, ranks ---- */

enum machine_scan_op {
    MACHINE_SCAN_COPY, /* the first; any type */
    MACHINE_SCAN_AND,
    MACHINE_SCAN_OR,
    MACHINE_SCAN_XOR,
    MACHINE_SCAN_ADD, /* modulo 2^width */
    MACHINE_SCAN_UMIN,
    MACHINE_SCAN_UMAX,
    MACHINE_SCAN_SMIN,
    MACHINE_SCAN_SMAX,
    MACHINE_SCAN_FADD,
    MACHINE_SCAN_FMUL,
    MACHINE_SCAN_FMIN, /* ignore NaNs; -0 is less than 0 */
    MACHINE_SCAN_FMAX
};
enum machine_segments {
    MACHINE_UNSEGMENTED,
    MACHINE_START_BIT,  /* segments begin where an active processor has a 1, in the scan's
                         * direction */
    MACHINE_SEGMENT_BIT /* segments begin where a processor, active or not, has a 1: it is
                         * the segment's first, with the least coordinate, in both directions */
};
struct machine_scan {
    enum machine_scan_op op;
    int axis;
    bool downward;  /* from the greatest coordinate to the least */
    bool exclusive; /* excludes the processor's own value */
    enum machine_segments segments;
    struct machine_value *bits; /* of the segments; taken EVERYWHERE */
};
/* In each active processor, the combination of the active processors from the beginning of
 * its segment to itself, along the axis. Exclusive: the identity if there is none (COPY: 0).
 * The value is taken WHERE_ACTIVE; the result in inactive processors is undefined. The order
 * of float addition and multiplication is fixed. The axis is divided into runs of 512
 * processors, counted from the end where the scan begins. Within a run, values are combined
 * one after the other, from 0 (or 1), and anew from each beginning of a segment. A processor
 * before the first beginning in its run also gets, as the left operand, the combination of
 * the earlier runs' totals, one after the other from the segment's beginning. */
struct machine_value *machine_scan(struct machine *m, const struct machine_scan *how,
                                   struct machine_value *value);
/* So many bits of dest become what machine_scan() adds up to of a 1 in each, by whatever op. */
enum machine_status machine_enumerate(struct machine *m, const struct machine_scan *how,
                                      uint32_t dest, int width);
/* In each processor, the combination of all active ones that differ from it only on the axes of
 * the mask (bit 0: axis 0). The order is that of a scan upward along the greatest axis of the
 * mask, then of its results along the next axis, and so on. COPY is not allowed. */
struct machine_value *machine_spread(struct machine *m, enum machine_scan_op op, uint32_t axes,
                                     struct machine_value *value);
/* In each processor, the EVERYWHERE value of the one with that coordinate on its line. */
struct machine_value *machine_spread_coordinate(struct machine *m, int axis, int coordinate,
                                                struct machine_value *value);
/* In each processor, the EVERYWHERE value of that with the row-major index, active or not. */
struct machine_value *machine_spread_index(struct machine *m, uint64_t index,
                                           struct machine_value *value);
/* In each active processor, 32 bits: its position along the axis if the active processors of
 * its segment were sorted by value into the segment's first places. Equal values keep their
 * order; downward, the greatest comes first. Floats: -0 equals 0, NaNs come last in both
 * directions. Segments begin at bits, counted upward in both directions. */
struct machine_value *machine_rank(struct machine *m, int axis, bool downward, bool is_signed,
                                   enum machine_segments segments, struct machine_value *bits,
                                   struct machine_value *value);

/* ---- observation ---- */

enum machine_reduction {
    MACHINE_REDUCE_AND,
    MACHINE_REDUCE_OR,
    MACHINE_REDUCE_XOR,
    MACHINE_REDUCE_ADD, /* modulo 2^width */
    MACHINE_REDUCE_UMIN,
    MACHINE_REDUCE_UMAX,
    MACHINE_REDUCE_SMIN,
    MACHINE_REDUCE_SMAX,
    MACHINE_REDUCE_FADD,
    MACHINE_REDUCE_FMIN,
    MACHINE_REDUCE_FMAX
};
/* Over the active processors; the identity where none is (FMIN +inf, FMAX -inf, UMIN all
 * ones, ...). The order of float addition is fixed: in each run of up to 4096 along the last
 * axis, sixteen partial sums by column mod 16 (columns counted from the run's start), each
 * in column order from +0, inactive skipped; these are added pairwise, i with i+8, then i+4,
 * i+2, i+1; then the runs' sums, in row-major order of the runs, pairwise: while more than
 * one is left, sum 2i and 2i+1 become sum i, an odd last one stays as it is. FMIN and FMAX
 * use the same order, ignore NaNs, and of equal numbers (0 and -0) keep the first. */
enum machine_status machine_reduce(struct machine *m, enum machine_reduction op,
                                   struct machine_value *value, struct machine_scalar *out);

/* Whole fields as dense row-major arrays. Shape: one element a processor of 1, 2, 4, 8 or 16
 * bytes (the smallest that holds the width), host byte order, unused high bits 0. Upload
 * ignores the context, and copies before it returns. */
size_t machine_element_bytes(struct machine_type type);
enum machine_status machine_field_download(struct machine *m, uint32_t field,
                                           struct machine_type type, void *out);
enum machine_status machine_field_upload(struct machine *m, uint32_t field,
                                         struct machine_type type, const void *in);
/* A block of them: rows (all axes but the last together) and columns (the last one). The front
 * end's rows lie `pitch` bytes apart. Likewise otherwise; only the block is touched where the
 * device's memory is the front end's. */
struct machine_block {
    uint64_t row, rows;
    int column, columns;
};
enum machine_status machine_block_download(struct machine *m, uint32_t field,
                                           struct machine_type type,
                                           const struct machine_block *of, void *out,
                                           size_t pitch);
enum machine_status machine_block_upload(struct machine *m, uint32_t field,
                                         struct machine_type type,
                                         const struct machine_block *of, const void *in,
                                         size_t pitch);
/* One processor, by row-major index; writing ignores the context. */
enum machine_status machine_field_read(struct machine *m, uint32_t field,
                                       struct machine_type type, uint64_t index,
                                       struct machine_scalar *out);
enum machine_status machine_field_write(struct machine *m, uint32_t field,
                                        struct machine_type type, uint64_t index,
                                        struct machine_scalar value);

#endif
