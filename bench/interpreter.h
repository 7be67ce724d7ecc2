/* interpreter.h - a stack machine of vectors, as languages on the Connection Machine were: its
 * programs, and plain C that runs them.
 *
 * There are STACK_VECTORS vectors of n words of 32 bits. A program is a list of operations on
 * whole vectors; those that look at one number add it to a sum, which is the program's result.
 * It begins with numbers that depend on the turn, so that no turn's values are known from the
 * one before. */
#ifndef LUTETIA_BENCH_INTERPRETER_H
#define LUTETIA_BENCH_INTERPRETER_H

#include <stdbool.h>
#include <stdint.h>

enum { STACK_VECTORS = 8, STACK_OPERATIONS = 64, STACK_SEGMENT = 37 };

enum stack_op {
    STACK_START, /* to = index * number + turn */
    STACK_ADD,   /* to = a + b, and so on */
    STACK_SUBTRACT,
    STACK_MULTIPLY,
    STACK_MIN,
    STACK_MAX,
    STACK_XOR,
    STACK_ADD_NUMBER,     /* to = a + number */
    STACK_WHERE_LESS,     /* to = a where a < b */
    STACK_SCAN,           /* to = sums of a up to here */
    STACK_SCAN_SEGMENTED, /* ... from the last multiple of STACK_SEGMENT on */
    STACK_PERMUTE,        /* to[permutation] = a */
    STACK_PACK,           /* to = the odd ones of a in a row, then 0 */
    STACK_SUM,            /* of a */
    STACK_READ,           /* a[number] */
    STACK_WRITE,          /* to[number] = number */
    STACK_OPS_COUNT
};

struct stack_step {
    enum stack_op op;
    int to, a, b; /* vectors; to is another than a and b */
    uint32_t number;
};

struct stack_program {
    struct stack_step steps[STACK_OPERATIONS];
    int n;
};

/* A random one. */
void stack_program_make(struct stack_program *p, uint64_t seed, int n);
/* A random permutation of 0 to n - 1, always the same. */
void stack_permutation(uint32_t *permutation, int n);

/* interpreter_plain.c: in plain C, by so many threads. */
struct stack_plain;
struct stack_plain *stack_plain_create(const struct stack_program *p,
                                       int threads); /* NULL: no memory */
uint32_t stack_plain_run(struct stack_plain *s, uint32_t turn);
void stack_plain_destroy(struct stack_plain *s);

/* interpreter.c: on Paris and in plain C they come to the same, for some turns; in
 * bench_error() it says if not. */
bool interpreter_same(uint64_t seed, int n, int turns);

#endif
