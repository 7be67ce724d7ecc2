/* program.h - a random Paris program as data: a few VP sets and a list of instructions.
 *
 *     struct program p;
 *     program_generate(&p, seed, length);
 *     // drops instructions that cannot run (a deallocated field)
 *     program_normalise(&p);
 *     struct trace a = {0}, b = {0};
 *     oracle_run(&p, &a, 0);
 *     paris_run(&p, &b, eager);
 *     if (trace_differ(&a, &b, &where)) …
 *
 * Fields are numbered slots, so that an instruction can be removed without renumbering the
 * others. program_normalise() drops an instruction whose slot does not hold the field that it
 * needs. All executors run normalised programs only.
 */
#ifndef LUTETIA_TESTS_RANDOM_PROGRAM_H
#define LUTETIA_TESTS_RANDOM_PROGRAM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "table.h"

enum shape {
    ALLOCATE,
    DEALLOCATE,
    SELECT_SET,
    OBSERVE,
    WRITE_ARRAY,
    WRITE_FLOATS,
    WRITE_PROCESSOR,
    READ_PROCESSOR,
    WRITE_PROCESSOR_FLOAT,
    RANDOM,
    INT_1,
    INT_MOVE,
    INT_2,
    INT_3,
    INT_3_3L,
    INT_CONSTANT_2,
    INT_CONSTANT_3,
    INT_MOVE_2L,
    INT_MOVE_CONSTANT,
    INT_COMPARE,
    INT_COMPARE_2L,
    INT_COMPARE_CONSTANT,
    INT_COMPARE_ZERO,
    INT_TO_FLOAT,
    FLOAT_TO_INT,
    INT_GLOBAL,
    FLOAT_1,
    FLOAT_MOVE,
    FLOAT_2,
    FLOAT_3,
    FLOAT_CONSTANT_2,
    FLOAT_CONSTANT_3,
    FLOAT_MOVE_2L,
    FLOAT_MOVE_CONSTANT,
    FLOAT_COMPARE,
    FLOAT_COMPARE_CONSTANT,
    FLOAT_COMPARE_ZERO,
    FLOAT_GLOBAL,
    FLAG,
    BIT_LOAD,
    BIT_STORE,
    NEWS,
    COORDINATE
};

enum number { NUMBER_U, NUMBER_S, NUMBER_F, NUMBER_B };

enum op {
    OP_NONE,
    OP_STACK,
    OP_HEAP,
    OP_ADD,
    OP_SUBTRACT,
    OP_MULTIPLY,
    OP_DIVIDE,
    OP_MOD,
    OP_SHIFT,
    OP_MIN,
    OP_MAX,
    OP_AND,
    OP_IOR,
    OP_XOR,
    OP_NOT,
    OP_MOVE,
    OP_ZERO,
    OP_NEGATE,
    OP_ABS,
    OP_SQRT,
    OP_EQ,
    OP_NE,
    OP_LT,
    OP_LE,
    OP_GT,
    OP_GE,
    OP_CONVERT,
    OP_TRUNCATE,
    OP_FLOOR,
    OP_CEILING,
    OP_ROUND,
    OP_SET_CONTEXT,
    OP_CLEAR_CONTEXT,
    OP_INVERT_CONTEXT,
    OP_AND_CONTEXT_TEST,
    OP_LOAD_CONTEXT,
    OP_STORE_CONTEXT,
    OP_AND_CONTEXT,
    OP_LOAD_TEST,
    OP_STORE_TEST,
    OP_LOAD_OVERFLOW,
    OP_STORE_OVERFLOW,
    OP_SET_BIT,
    OP_CLEAR_BIT,
    OP_GET_NEWS,
    OP_SEND_NEWS
};

#define PROGRAM_ENUM(name, shape, number, op, always) ROW_##name,
enum row { RANDOM_ROWS(PROGRAM_ENUM) ROW_COUNT };

struct row_info {
    const char *name;
    uint8_t shape, number, op, always;
};
extern const struct row_info row_table[ROW_COUNT];

enum {
    PROGRAM_SLOTS = 16,
    PROGRAM_SETS = 3,
    PROGRAM_AXES = 4,
    PROGRAM_LENGTH_MAX = 2400,
    PROGRAM_FIELD_BITS_MAX = 160
};

struct operand {
    uint8_t slot;
    uint8_t offset; /* bits */
    uint8_t bits;   /* read or written there */
};

struct instruction {
    uint16_t row;
    struct operand d, a, b; /* destination, sources; a float's bits are 32 or 64 */
    int64_t constant;
    double real;
    uint8_t axis, direction, set;
    uint32_t where; /* a processor's number, or where an array's data start in their stream */
};

struct geometry {
    int rank;
    int lengths[PROGRAM_AXES];
};

struct program {
    uint64_t seed; /* also the seed of the machine's random numbers */
    int sets_count;
    struct geometry sets[PROGRAM_SETS];
    int count;
    struct instruction code[PROGRAM_LENGTH_MAX];
};

uint64_t geometry_count(const struct geometry *g);

void program_generate(struct program *p, uint64_t seed, int length);
/* Draws a program that is mostly one long loop; sheet: over fields of two axes, wide enough for
 * strips. */
void program_generate_loop(struct program *p, uint64_t seed, bool sheet);
/* Drops instructions that cannot run; call it before the executors. */
void program_normalise(struct program *p);
/* Prints a C program with CM_ calls. */
void program_print(const struct program *p, FILE *out);

/* ---- data that programs write: a function of the instruction alone ---- */

uint64_t data_word(uint32_t stream, uint64_t index);
/* Ordinary numbers and awkward ones: zeros, subnormals, infinities, NaN. */
double data_real(uint32_t stream, uint64_t index);

/* ---- what a run showed ---- */

struct trace {
    uint64_t *words;
    /* the instruction that added each word; the program's length for words of the final
     * state */
    uint32_t *steps;
    size_t count, size;
    int step; /* set by the executor */
};
void trace_add(struct trace *t, uint64_t word);
/* Adds a float that a reduction returned; all NaNs count as the same. */
void trace_real(struct trace *t, double x);
void trace_finish(struct trace *t);
/* Sets *where to the index of the first difference; false: there is none. */
bool trace_differ(const struct trace *a, const struct trace *b, size_t *where);

/* ---- executors: all append the same words for the same program ---- */

enum sabotage {
    SABOTAGE_NONE,
    SABOTAGE_SUBTRACT,
    SABOTAGE_CONTEXT,
    SABOTAGE_NEWS,
    SABOTAGE_COUNT
};

/* Runs on plain bit arrays; `sabotage` makes one operation wrong on purpose. */
void oracle_run(const struct program *p, struct trace *out, enum sabotage sabotage);
/* Runs by C/Paris calls. */
void paris_run(const struct program *p, struct trace *out, bool eager);

/* Sets these environment variables (NAME=value, ending with NULL) for all later machines, and
 * unsets those of the previous call. */
void paris_force(const char *const *variables);

struct paris_counts {
    long kernels_built;
    long kernels_of_stages; /* launches of kernels with several stages, in strips or tiles */
    long calls_foreseen;    /* calls of a step seen before, which were not recorded again */
};
/* The counts of all fused programs so far. */
struct paris_counts paris_counts(void);

/* ---- shrinking ---- */

typedef bool (*program_fails)(void *context, const struct program *p);
/* Makes the failing program p as small as removals and simplifications can. Returns the number
 * of runs. */
int program_shrink(struct program *p, program_fails fails, void *context);

#endif
