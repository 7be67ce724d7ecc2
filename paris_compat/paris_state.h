/* paris_state.h - shared by the files of the Paris library: the state, operands, and the path
 * of an instruction.
 *
 * An entry point (generated from instructions.tab) describes its operands and calls the
 * function of its family:
 *
 *     CM_f_add_2_1L (dest, source, s, e)
 *     -> paris_binary (&self, paris_f (dest, ...), paris_f (dest, ...), paris_f (source, ...))
 *             paris_begin   names the call for messages and starts the machine's instruction
 *             paris_load    checks an operand and gives its value; NULL: it is wrong, and said
 *             machine_...   values from values; NULL goes through
 *             paris_store   checks dest and stores; says what is wrong where the value is NULL
 *
 * paris_fail() reports an error to the error handler once, and the call ends without effect.
 */
#ifndef PARIS_STATE_H
#define PARIS_STATE_H

#if defined(__GNUC__)
#define PARIS_COLD __attribute__((cold, noinline))
#define PARIS_PRINTF(a, b) __attribute__((format(printf, a, b)))
/* The public header sets no visibility: it is C of 1990. */
#pragma GCC visibility push(default)
#endif
#include <cm/paris.h>
#if defined(__GNUC__)
#pragma GCC visibility pop
#endif

#include "base/scalar.h"
#include "machine_direct.h"
#include "paris_internal.h"

/* One entry point. */
struct paris_instruction {
    const char *name;
    uint8_t op;       /* enum machine_op, a truth table, or another number, depending on the
                       * family */
    uint8_t overflow; /* 1: records overflow */
    uint8_t swap;     /* 1: the sources change places */
    uint8_t scope;    /* enum machine_scope of the store */
};

enum { PARIS_OP_ABS = 255 };
enum { PARIS_OP_TO_GRAY = 254, PARIS_OP_SIGNUM = 253 }; /* of paris_integer_unary() */
enum paris_news { PARIS_NEWS_GET, PARIS_NEWS_SEND };

#define PARIS_INTEGER_MAX CM_maximum_integer_length
#define PARIS_PIECE 64 /* longer bit fields are moved in pieces of this many bits */

/* ---- operands ---- */

struct paris_operand {
    char letter; /* u, s, f, or b: plain bits */
    bool is_constant;
    CM_field_id_t field;
    unsigned int len; /* of u, s, b; the significand of f */
    unsigned int e;   /* the exponent of f */
    union {
        unsigned long bits;
        double number;
    } value;
};

#define PARIS_OPERAND(letter, type)                                                            \
    static inline struct paris_operand paris_##letter(CM_field_id_t field, unsigned int len)   \
    {                                                                                          \
        return (struct paris_operand){#letter[0], false, field, len, 0, {.bits = 0}};          \
    }                                                                                          \
    static inline struct paris_operand paris_##letter##_constant(type value, unsigned int len) \
    {                                                                                          \
        return (struct paris_operand){#letter[0], true, 0,                                     \
                                      len,        0,    {.bits = (unsigned long)value}};       \
    }
PARIS_OPERAND(u, unsigned long)
PARIS_OPERAND(s, long)
PARIS_OPERAND(b, unsigned long)

static inline struct paris_operand paris_f(CM_field_id_t field, unsigned int s, unsigned int e)
{
    return (struct paris_operand){'f', false, field, s, e, {.bits = 0}};
}

static inline struct paris_operand paris_f_constant(double value, unsigned int s,
                                                    unsigned int e)
{
    return (struct paris_operand){'f', true, 0, s, e, {.number = value}};
}

static inline unsigned int paris_operand_bits(struct paris_operand a)
{
    return a.letter == 'f' ? a.len + a.e + 1 : a.len;
}

/* False: there is no such type; the error has been reported. */
bool paris_type(struct paris_operand a, const char *role, struct machine_type *type);

/* ---- the state ---- */

struct paris_geometry {
    int rank; /* 0: not in use */
    int dimensions[MACHINE_AXES_MAX];
    int weight[MACHINE_AXES_MAX];
    uint8_t ordering[MACHINE_AXES_MAX];
    uint64_t count; /* virtual processors */
    uint64_t ratio;
    struct machine_layout layout;
    int sets; /* VP sets that have it */
    unsigned int serial;
};

struct paris_state {
    struct machine *machine;
    const char *call; /* the name of the instruction under way, for messages */
    unsigned int safety;
    bool lenient;                      /* accept what the real machine accepted: safety.c */
    bool pristine;                     /* nothing allocated since CM_init */
    struct paris_geometry *geometries; /* by id - 1 */
    int geometries_count;
    int *set_geometry; /* geometry of each VP set, by the machine's id; 0: unused */
    int sets_count;
    CM_field_id_t leds; /* hidden field of the VP set that latched last */
    /* Called after a machine was made (comes), and before it is destroyed; NULL: nobody
     * asks. */
    void (*machine_changes)(bool comes);
    /* Called after each call while a debugger watches fields (debug.c); NULL: none does. */
    void (*watches_look)(const char *call);
};
extern struct paris_state paris_the;

/* Makes the machine. False: that cannot be; paris_error() has the reason. */
bool paris_machine_make(void);
/* paris_reset() with as many processors. */
bool paris_reset_to(unsigned int processors);
void paris_machine_forget(void);
/* Says once that messages of the last send went to no processor. */
void paris_tell_lost(struct machine *m, struct machine_value *send_address, int vp_set);
/* Performs something on the first machine of a process, which was made just now, and empties
 * it: warm_up.c. False: no memory. */
bool paris_warm_up(void);

/* ---- the way an instruction goes ---- */

/* Tells the error handler "<call>: <message>". */
void paris_fail(const char *format, ...) PARIS_PRINTF(1, 2) PARIS_COLD;
/* The same where memory was short (CM_error_memory). */
void paris_fail_memory(const char *format, ...) PARIS_PRINTF(1, 2) PARIS_COLD;
/* Reports the machine's error. */
void paris_fail_machine(void) PARIS_COLD;
/* Prints the last error, with control characters made visible. */
void paris_error_print(void) PARIS_COLD;
/* Keeps the reason why there is no machine, for paris_error(), without reporting it. m: from
 * machine_create(); NULL is fine. */
void paris_fail_without(const struct machine *m) PARIS_COLD;

/* Begins the instruction of this name. */
static inline struct machine *paris_begin(const char *name)
{
    struct machine *m = paris_the.machine ? paris_the.machine : paris_machine();
    machine_instruction(m, name); /* may perform calls that were only noted */
    paris_the.call = name;
    return m;
}

/* Begins an instruction that neither changes nor reads fields and flags. */
static inline struct machine *paris_inquire(const char *name)
{
    struct machine *m = paris_the.machine ? paris_the.machine : paris_machine();
    paris_the.call = name;
    return m;
}

/* For each instruction: see machine_call_foreseen(). */
static inline bool paris_foreseen(struct machine_call *call)
{
    const bool noted =
        machine_call_foreseen(paris_the.machine ? paris_the.machine : paris_machine(), call);
    if (noted && paris_the.watches_look)
        paris_the.watches_look(call->name);
    return noted;
}
static inline void paris_performed(void)
{
    if (paris_the.machine)
        machine_call_performed(paris_the.machine);
    if (paris_the.watches_look)
        paris_the.watches_look(paris_the.call);
}
/* A hand-written instruction with one field; if `only`, it does nothing but compute. */
#define PARIS_OF_A_FIELD(instruction, field, only, body)                                       \
    static void again_##instruction(const struct machine_call *call)                           \
    {                                                                                          \
        instruction((CM_field_id_t)call->words[0]);                                            \
    }                                                                                          \
    void instruction(CM_field_id_t field)                                                      \
    {                                                                                          \
        struct machine_call call = {.again = again_##instruction,                              \
                                    .name = #instruction,                                      \
                                    .words_count = 1,                                          \
                                    .words = {(uint64_t)(field)}};                             \
        bool noted = (only);                                                                   \
        if (noted && paris_foreseen(&call))                                                    \
            return;                                                                            \
        body;                                                                                  \
        if (noted)                                                                             \
            paris_performed();                                                                 \
    }

/* A double and its bits. */
union paris_both {
    double number;
    uint64_t word;
};
static inline uint64_t paris_word(double x)
{
    return (union paris_both){.number = x}.word;
}
static inline double paris_double(uint64_t word)
{
    return (union paris_both){.word = word}.number;
}

/* A constant operand as an integer of 128 bits. */
static inline struct machine_scalar paris_constant_bits(struct paris_operand a)
{
    return a.letter == 's' ? scalar_signed((long)a.value.bits)
                           : (struct machine_scalar){a.value.bits, 0};
}

/* The operand's value in the current VP set; NULL: an error, which has been reported. */
struct machine_value *paris_load(struct machine *m, struct paris_operand a, const char *role,
                                 enum machine_scope scope);
/* The values of an instruction's two sources. False: an error, which has been reported. */
bool paris_load_two(struct machine *m, const struct paris_instruction *self,
                    struct paris_operand dest, struct paris_operand a, struct paris_operand b,
                    struct machine_value **x, struct machine_value **y);
/* The same for integers, dest looked at too, and both made as long as the longest of the three.
 * y_signed: whether b has a sign. */
bool paris_load_widest(struct machine *m, const struct paris_instruction *self,
                       struct paris_operand dest, struct paris_operand a,
                       struct paris_operand b, bool y_signed, struct machine_value **x,
                       struct machine_value **y);
/* dest = a op b where that is possible at once (machine_direct()), all of one type. dest of no
 * field: the test flag. False: nothing was done, and nothing has been reported. */
bool paris_direct(struct machine *m, enum machine_op op, bool overflow,
                  struct paris_operand dest, struct paris_operand a, struct paris_operand b);
/* value may be NULL. False: nothing was stored; the error has been reported. */
bool paris_store(struct machine *m, struct paris_operand dest, struct machine_value *value,
                 enum machine_scope scope);
/* The same for one bit. */
struct machine_value *paris_load_bit(struct machine *m, CM_field_id_t field, const char *role,
                                     enum machine_scope scope);
bool paris_store_bit(struct machine *m, CM_field_id_t field, struct machine_value *value,
                     enum machine_scope scope);
/* Sets a flag of all or of active processors. */
bool paris_flag_put(struct machine *m, enum machine_flag flag, struct machine_value *value,
                    enum machine_scope scope);

/* The checks of safety mode; without it they return true (but fields longer than an integer
 * are always checked). False: the error has been reported. */
bool paris_check_field(CM_field_id_t field, unsigned int bits, const char *role);
/* The same in whatever mode. */
bool paris_check_field_wholly(CM_field_id_t field, unsigned int bits, const char *role);
bool paris_check_operand(struct paris_operand a, const char *role);
bool paris_check_overlap(struct paris_operand dest, struct paris_operand source);
/* Checks dest for an instruction with these sources (one: the same twice); *type: its type. */
bool paris_check_dest(struct paris_operand dest, struct paris_operand a, struct paris_operand b,
                      struct machine_type *type);
/* In lenient mode: prints once on the standard error what is accepted, and returns true. */
bool paris_let_pass(const char *format, ...) PARIS_PRINTF(1, 2);
/* Whether a lenient machine continues past the field's end; prints it once. */
bool paris_runs_over(CM_field_id_t field, unsigned int bits, const char *role);
/* Sets the mode on a machine that has just been made. */
void paris_safety_begin(struct machine *m);

/* These fail in either mode. */
bool paris_check_axis(unsigned int axis);
const struct paris_geometry *paris_geometry_of(CM_geometry_id_t id);

/* ---- integers of several lengths: values.c; NULL goes through ---- */

static inline unsigned int paris_longest(unsigned int a, unsigned int b)
{
    return a > b ? a : b;
}
/* Cut off to that width. */
struct machine_value *paris_number(struct machine *m, int width, int64_t x);
struct machine_value *paris_resize(struct machine *m, struct machine_value *v,
                                   unsigned int width, bool is_signed);
/* 1 where v differs from its low len bits, extended. */
struct machine_value *paris_lost(struct machine *m, struct machine_value *v, unsigned int len,
                                 bool is_signed);
/* |x| of a signed number; that of the least number is itself. */
struct machine_value *paris_absolute(struct machine *m, struct machine_value *x);

/* The function of the two bits whose truth table this is, from (0,0) in bit 3 to (1,1) in bit
 * 0. */
struct machine_value *paris_boolean(struct machine *m, unsigned int truth,
                                    struct machine_value *a, struct machine_value *b);

/* ---- geometries and VP sets as data: geometry.c, vp_sets.c ---- */

struct paris_geometry *paris_geometry_find(CM_geometry_id_t id); /* NULL: there is none */
const struct paris_geometry *paris_geometry_current(void);
/* Returns an id for g; 0: no memory; the error has been reported. */
CM_geometry_id_t paris_geometry_add(const struct paris_geometry *g);
/* Computes the count and the VP ratio of g's dimensions. False: they are invalid; the error
 * has been reported. */
bool paris_geometry_complete(struct paris_geometry *g);
/* The number of bits that distinguish that many things; at least 1. */
unsigned int paris_count_bits(uint64_t count);

bool paris_set_valid(CM_vp_set_id_t set);
CM_vp_set_id_t paris_set_default(void);
/* Makes a VP set of an existing geometry; 0: an error, which has been reported. */
CM_vp_set_id_t paris_set_make(CM_geometry_id_t geometry);
/* Makes an existing set current. */
bool paris_set_select(CM_vp_set_id_t set);

/* The machine's row-major index and Paris's send address. */
uint64_t paris_address_of_index(const struct paris_geometry *g, uint64_t index);
/* UINT64_MAX if there is no such processor. */
uint64_t paris_index_of_address(const struct paris_geometry *g, uint64_t send_address);
/* The same; a lenient machine takes it modulo the number of processors, and prints that
 * once. */
uint64_t paris_index_let_pass(const struct paris_geometry *g, uint64_t send_address);
unsigned int paris_address_bits(const struct paris_geometry *g);
/* How many bits of dest get an address of so many. Fields for addresses are usually longer than
 * the addresses. Then all 32 bits are stored, with zeros above: the same content, as a single
 * value. */
unsigned int paris_address_room(struct machine *m, CM_field_id_t dest, unsigned int bits);
void paris_sets_reset(void); /* no geometries, and only the default VP set */
void paris_sets_forget(void);

/* ---- the families ---- */

void paris_binary(const struct paris_instruction *self, struct paris_operand dest,
                  struct paris_operand a, struct paris_operand b);
void paris_unary(const struct paris_instruction *self, struct paris_operand dest,
                 struct paris_operand a);
/* floats.c: the values of self->op, for each function that performs some. */
enum paris_float_part_op {
    PARIS_SIGNUM,
    PARIS_EXPONENT,
    PARIS_EXPONENT_FIELD,
    PARIS_SIGNIFICAND
};
enum paris_float_pair_op {
    PARIS_MULT_ADD,
    PARIS_MULT_SUB,
    PARIS_MULT_SUBF,
    PARIS_ADD_MULT,
    PARIS_SUB_MULT,
    PARIS_SUBF_MULT
};
enum paris_float_test_op {
    PARIS_IS_NAN,
    PARIS_IS_INFINITY,
    PARIS_IS_FINITE,
    PARIS_IS_ZERO,
    PARIS_IS_NEGATIVE,
    PARIS_IS_NORMAL,
    PARIS_IS_SUBNORMAL
};
enum paris_float_swap_op { PARIS_IEEE_TO_VAX, PARIS_VAX_TO_IEEE };
/* Records the overflow of machine_op_is_function(): infinite from finite, and for the
 * remainders a divisor of 0. b NULL: one operand. */
bool paris_float_overflow(struct machine *m, int op, struct machine_value *a,
                          struct machine_value *b, struct machine_value *result);
/* op: MACHINE_FPOW or MACHINE_FSCALE; b is an integer. */
void paris_float_by_integer(const struct paris_instruction *self, struct paris_operand dest,
                            struct paris_operand a, struct paris_operand b);
void paris_float_pair(const struct paris_instruction *self, struct paris_operand dest,
                      struct paris_operand a, struct paris_operand b, struct paris_operand c);
void paris_float_part(const struct paris_instruction *self, struct paris_operand dest,
                      struct paris_operand a);
void paris_float_made(const struct paris_instruction *self, struct paris_operand dest,
                      struct paris_operand a);
void paris_float_vax(const struct paris_instruction *self, struct paris_operand dest,
                     struct paris_operand a);
void paris_float_test(const struct paris_instruction *self, struct paris_operand a);
void paris_float_swap(const struct paris_instruction *self, struct paris_operand dest,
                      struct paris_operand source);
/* integers.c */
void paris_integer(const struct paris_instruction *self, struct paris_operand dest,
                   struct paris_operand a, struct paris_operand b);
void paris_power(const struct paris_instruction *self, struct paris_operand dest,
                 struct paris_operand a, struct paris_operand b);
void paris_integer_unary(const struct paris_instruction *self, struct paris_operand dest,
                         struct paris_operand a);
void paris_shift(const struct paris_instruction *self, struct paris_operand dest,
                 struct paris_operand a, struct paris_operand count);
void paris_rotate(const struct paris_instruction *self, struct paris_operand dest,
                  struct paris_operand a, struct paris_operand count);
/* bits.c */
void paris_swap(const struct paris_instruction *self, struct paris_operand dest,
                struct paris_operand source);
void paris_move_reversed(const struct paris_instruction *self, struct paris_operand dest,
                         struct paris_operand source);
void paris_compare(const struct paris_instruction *self, struct paris_operand a,
                   struct paris_operand b);
void paris_move(const struct paris_instruction *self, struct paris_operand dest,
                struct paris_operand a);
void paris_to_float(const struct paris_instruction *self, struct paris_operand dest,
                    struct paris_operand a);
void paris_to_bits(const struct paris_instruction *self, struct paris_operand dest,
                   struct paris_operand a);
void paris_logical(const struct paris_instruction *self, struct paris_operand dest,
                   struct paris_operand a, struct paris_operand b);
void paris_flag_constant(const struct paris_instruction *self, enum machine_flag flag,
                         unsigned int value);
void paris_flag_load(const struct paris_instruction *self, enum machine_flag flag,
                     CM_field_id_t source);
void paris_flag_store(const struct paris_instruction *self, enum machine_flag flag,
                      CM_field_id_t dest);
void paris_flag_logical_field(const struct paris_instruction *self, enum machine_flag flag,
                              CM_field_id_t source);
void paris_flag_logical_flag(const struct paris_instruction *self, enum machine_flag flag,
                             enum machine_flag other);
void paris_news(const struct paris_instruction *self, CM_field_id_t dest, CM_field_id_t source,
                unsigned int axis, unsigned int direction, unsigned int len);
/* Scans and related instructions; parts: 1 for a float, 2 for a complex number, both parts
 * alike. */
void paris_scan(const struct paris_instruction *self, int parts, struct paris_operand dest,
                struct paris_operand source, unsigned int axis, unsigned int direction,
                unsigned int inclusion, unsigned int smode, CM_field_id_t sbit);
void paris_spread(const struct paris_instruction *self, int parts, struct paris_operand dest,
                  struct paris_operand source, unsigned int axis, unsigned int coordinate);
void paris_multispread(const struct paris_instruction *self, int parts,
                       struct paris_operand dest, struct paris_operand source,
                       unsigned int axis_mask);
void paris_reduce(const struct paris_instruction *self, int parts, struct paris_operand dest,
                  struct paris_operand source, unsigned int axis, unsigned int to_coordinate,
                  unsigned int from_coordinate);
void paris_rank(const struct paris_instruction *self, struct paris_operand dest,
                struct paris_operand source, unsigned int axis, unsigned int direction,
                unsigned int smode, CM_field_id_t sbit);
void paris_my_coordinate(const struct paris_instruction *self, CM_field_id_t dest,
                         unsigned int axis, unsigned int len);
void paris_processor_write(const struct paris_instruction *self, CM_sendaddr_t send_address,
                           struct paris_operand dest, struct paris_operand value);
/* self->op is 1 if the result is a long. */
unsigned long paris_processor_read_u(const struct paris_instruction *self,
                                     CM_sendaddr_t send_address, struct paris_operand source);
long paris_processor_read_s(const struct paris_instruction *self, CM_sendaddr_t send_address,
                            struct paris_operand source);
double paris_processor_read_f(const struct paris_instruction *self, CM_sendaddr_t send_address,
                              struct paris_operand source);
unsigned long paris_global_u(const struct paris_instruction *self, struct paris_operand source);
unsigned long paris_global_b(const struct paris_instruction *self, struct paris_operand source);
long paris_global_s(const struct paris_instruction *self, struct paris_operand source);
double paris_global_f(const struct paris_instruction *self, struct paris_operand source);
unsigned int paris_global_count(const struct paris_instruction *self, enum machine_flag flag);
int paris_global_any(const struct paris_instruction *self, enum machine_flag flag);
int paris_global_all(const struct paris_instruction *self, enum machine_flag flag);

/* ---- the router, coordinates: router.c, coordinates.c ---- */

void paris_send(const struct paris_instruction *self, struct paris_operand dest,
                CM_field_id_t send_address, struct paris_operand source, CM_field_id_t notify);
void paris_get(const struct paris_instruction *self, CM_field_id_t dest,
               CM_field_id_t send_address, CM_field_id_t source, unsigned int len);
void paris_power_two(const struct paris_instruction *self, CM_field_id_t dest,
                     CM_field_id_t source, unsigned int axis, unsigned int log2_distance,
                     unsigned int direction, unsigned int len);
void paris_cross_move(const struct paris_instruction *self, CM_field_id_t dest,
                      CM_field_id_t source, unsigned int len);
/* self->op is 1 if the coordinate is a constant. */
void paris_coordinate_make(const struct paris_instruction *self, CM_geometry_id_t geometry,
                           CM_field_id_t dest, unsigned int axis, CM_field_id_t coordinate,
                           unsigned int slen);
void paris_coordinate_deposit(const struct paris_instruction *self, CM_geometry_id_t geometry,
                              CM_field_id_t dest, unsigned int axis, unsigned int coordinate,
                              unsigned int slen);
void paris_coordinate_extract(const struct paris_instruction *self, CM_geometry_id_t geometry,
                              CM_field_id_t dest, unsigned int axis, CM_field_id_t send_address,
                              unsigned int dlen);
/* As paris_check_field(), for fields of any VP set. */
bool paris_check_field_anywhere(CM_field_id_t field, unsigned int bits, const char *role);

/* A block of a front-end array, and its processors. */
struct paris_block {
    const int *offset, *start, *end, *axis, *dimensions;
    unsigned int rank, format;
    bool pairs, second; /* of complex arrays: elements are pairs; this is their second part */
};
#define PARIS_BLOCK                                                                            \
    ((struct paris_block){offset_vector.ints, start_vector.ints, end_vector.ints,              \
                          axis_vector.ints, dimension_vector.ints, rank, format, false,        \
                          false})
void paris_array_write(const struct paris_instruction *self, const void *array,
                       struct paris_block block, struct paris_operand dest);
void paris_array_read(const struct paris_instruction *self, void *array,
                      struct paris_block block, struct paris_operand source);

#include "paris_complex.h"

#endif
