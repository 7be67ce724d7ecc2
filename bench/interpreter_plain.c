/* interpreter_plain.c - programs of interpreter.h in plain C: a loop for each operation. */
#include "interpreter.h"

#include <stdlib.h>
#include <string.h>

enum { THREADS_MOST = 2, THREADS_FROM = 4096 };

struct stack_plain {
    struct stack_program program;
    int threads;
    uint32_t *vectors[STACK_VECTORS], *permutation;
};

static uint64_t next(uint64_t *state)
{
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

static int below(uint64_t *state, int limit)
{
    return (int)(next(state) % (uint64_t)limit);
}

void stack_program_make(struct stack_program *p, uint64_t seed, int n)
{
    /* How often, of 32: seven of ten are elementwise. */
    static const uint8_t often[STACK_OPS_COUNT] = {0, 5, 4, 2, 2, 2, 4, 2,
                                                   2, 2, 1, 1, 1, 1, 2, 1};
    uint64_t state = seed;
    p->n = n;
    for (int i = 0; i < STACK_OPERATIONS; i++) {
        int op = STACK_START, chance = below(&state, 32);
        while (i >= STACK_VECTORS && (chance -= often[op]) >= 0)
            op++;
        struct stack_step *s = &p->steps[i];
        s->op = (enum stack_op)op;
        s->to = i < STACK_VECTORS ? i : below(&state, STACK_VECTORS);
        s->a = (s->to + 1 + below(&state, STACK_VECTORS - 1)) % STACK_VECTORS;
        s->b = (s->to + 1 + below(&state, STACK_VECTORS - 1)) % STACK_VECTORS;
        s->number = (uint32_t)next(&state) | 1;
        if (s->op == STACK_READ || s->op == STACK_WRITE)
            s->number %= (uint32_t)n;
    }
}

void stack_permutation(uint32_t *permutation, int n)
{
    uint64_t state = 77;
    for (int i = 0; i < n; i++)
        permutation[i] = (uint32_t)i;
    for (int i = n - 1; i > 0; i--) {
        int k = below(&state, i + 1);
        uint32_t kept = permutation[i];
        permutation[i] = permutation[k];
        permutation[k] = kept;
    }
}

struct stack_plain *stack_plain_create(const struct stack_program *p, int threads)
{
    struct stack_plain *s = calloc(1, sizeof *s);
    if (!s)
        return NULL;
    s->program = *p;
    s->threads = p->n < THREADS_FROM ? 1 : threads < THREADS_MOST ? threads : THREADS_MOST;
    s->permutation = malloc((size_t)p->n * sizeof(uint32_t));
    bool good = s->permutation != NULL;
    for (int i = 0; i < STACK_VECTORS; i++) {
        s->vectors[i] = calloc((size_t)p->n, sizeof(uint32_t));
        good = good && s->vectors[i];
    }
    if (!good) {
        stack_plain_destroy(s);
        return NULL;
    }
    stack_permutation(s->permutation, p->n);
    return s;
}

void stack_plain_destroy(struct stack_plain *s)
{
    for (int i = 0; s && i < STACK_VECTORS; i++)
        free(s->vectors[i]);
    if (s)
        free(s->permutation);
    free(s);
}

/* Sums up to each, from `from` to `to`; the last one. */
static uint32_t scan(uint32_t *restrict d, const uint32_t *restrict a, int from, int to,
                     uint32_t sum)
{
    for (int i = from; i < to; i++)
        d[i] = sum += a[i];
    return sum;
}

static void scan_all(const struct stack_plain *s, uint32_t *d, const uint32_t *a)
{
    int n = s->program.n, half = n / 2;
    uint32_t sum = 0;
    if (s->threads == 1) {
        scan(d, a, 0, n, 0);
        return;
    }
#pragma omp parallel for reduction(+ : sum) num_threads(2)
    for (int i = 0; i < half; i++)
        sum += a[i];
#pragma omp parallel for num_threads(2) schedule(static, 1)
    for (int part = 0; part < 2; part++)
        scan(d, a, part ? half : 0, part ? n : half, part ? sum : 0);
}

static void scan_segments(const struct stack_plain *s, uint32_t *d, const uint32_t *a)
{
    int n = s->program.n;
    if (s->threads == 1) {
        for (int from = 0; from < n; from += STACK_SEGMENT)
            scan(d, a, from, n - from < STACK_SEGMENT ? n : from + STACK_SEGMENT, 0);
        return;
    }
#pragma omp parallel for num_threads(2)
    for (int from = 0; from < n; from += STACK_SEGMENT)
        scan(d, a, from, n - from < STACK_SEGMENT ? n : from + STACK_SEGMENT, 0);
}

static void pack(const struct stack_plain *s, uint32_t *restrict d, const uint32_t *restrict a)
{
    int n = s->program.n, k = 0;
    for (int i = 0; i < n; i++) {
        d[k] = a[i];
        k += (int)(a[i] & 1);
    }
    memset(d + k, 0, (size_t)(n - k) * sizeof *d);
}

/* The loop for each lane; one thread is not OpenMP's. */
#define EACH(STATEMENT)                                                                        \
    do {                                                                                       \
        if (threads == 1)                                                                      \
            for (int i = 0; i < n; i++)                                                        \
                STATEMENT;                                                                     \
        else                                                                                   \
            _Pragma("omp parallel for num_threads(2)") for (int i = 0; i < n; i++) STATEMENT;  \
    } while (0)

static uint32_t sum_of(const uint32_t *a, int n, int threads)
{
    uint32_t sum = 0;
    if (threads == 1) {
        for (int i = 0; i < n; i++)
            sum += a[i];
        return sum;
    }
#pragma omp parallel for reduction(+ : sum) num_threads(2)
    for (int i = 0; i < n; i++)
        sum += a[i];
    return sum;
}

static uint32_t step(const struct stack_plain *s, const struct stack_step *t, uint32_t turn)
{
    const int n = s->program.n, threads = s->threads;
    uint32_t *restrict d = s->vectors[t->to];
    const uint32_t *a = s->vectors[t->a], *b = s->vectors[t->b], *to = s->permutation;
    const uint32_t number = t->number;
    switch (t->op) {
    case STACK_START:
        EACH(d[i] = (uint32_t)i * number + turn);
        return 0;
    case STACK_ADD:
        EACH(d[i] = a[i] + b[i]);
        return 0;
    case STACK_SUBTRACT:
        EACH(d[i] = a[i] - b[i]);
        return 0;
    case STACK_MULTIPLY:
        EACH(d[i] = a[i] * b[i]);
        return 0;
    case STACK_MIN:
        EACH(d[i] = a[i] < b[i] ? a[i] : b[i]);
        return 0;
    case STACK_MAX:
        EACH(d[i] = a[i] > b[i] ? a[i] : b[i]);
        return 0;
    case STACK_XOR:
        EACH(d[i] = a[i] ^ b[i]);
        return 0;
    case STACK_ADD_NUMBER:
        EACH(d[i] = a[i] + number);
        return 0;
    case STACK_WHERE_LESS:
        EACH(d[i] = a[i] < b[i] ? a[i] : d[i]);
        return 0;
    case STACK_SCAN:
        scan_all(s, d, a);
        return 0;
    case STACK_SCAN_SEGMENTED:
        scan_segments(s, d, a);
        return 0;
    case STACK_PERMUTE:
        EACH(d[to[i]] = a[i]);
        return 0;
    case STACK_PACK:
        pack(s, d, a);
        return 0;
    case STACK_SUM:
        return sum_of(a, n, threads);
    case STACK_READ:
        return a[number];
    case STACK_WRITE:
    case STACK_OPS_COUNT:
        d[number] = number;
    }
    return 0;
}

uint32_t stack_plain_run(struct stack_plain *s, uint32_t turn)
{
    uint32_t result = 0;
    for (int i = 0; i < STACK_OPERATIONS; i++)
        result = result * 31 + step(s, &s->program.steps[i], turn);
    for (int i = 0; i < STACK_VECTORS; i++) /* all that is left */
        result = result * 31 + step(s, &(struct stack_step){.op = STACK_SUM, .a = i}, turn);
    return result;
}
