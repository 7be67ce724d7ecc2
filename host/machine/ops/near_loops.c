/* near_loops.c - see near_loops.h.
 *
 * Each loop is there for each combination, with and without a context and segments, so that it
 * tests nothing inside. Integers are combined from a line's one end to the other: their order
 * makes no difference. Floats are combined run by run, as the kernel does. */
#include "ops/near_loops.h"

#include <string.h>

#include "base/errors.h"
#include "base/scalar.h"
#include "interpret/lanes.h"
#include "ops/near_active.h"

typedef uint32_t u32;
typedef uint64_t u64;
typedef unsigned __int128 u128;
typedef float f32;
typedef double f64;

#define ALWAYS static inline __attribute__((always_inline))

/* ---- what is combined ---- */

#define INTEGERS(T)                                                                            \
    ALWAYS T join_##T(enum lines_op op, T a, T b)                                              \
    {                                                                                          \
        return op == LINES_ADD   ? a + b                                                       \
               : op == LINES_MIN ? (b < a ? b : a)                                             \
               : op == LINES_OR  ? (a | b)                                                     \
                                 : (a ^ b);                                                     \
    }                                                                                          \
    /* Without a branch, which could not be predicted. */                                      \
    ALWAYS T or_##T(bool first, T a, T b)                                                      \
    {                                                                                          \
        const T mask = (T)0 - first;                                                           \
        return (a & mask) | (b & ~mask);                                                       \
    }                                                                                          \
    ALWAYS T take_##T(T v, T flip)                                                             \
    {                                                                                          \
        return v ^ flip;                                                                       \
    }                                                                                          \
    ALWAYS T show_##T(T v, T flip, T cut)                                                      \
    {                                                                                          \
        return (v & cut) ^ flip;                                                               \
    }                                                                                          \
    ALWAYS T number_##T(struct machine_scalar x)                                               \
    {                                                                                          \
        return (T)((u128)x.hi << 64 | x.lo);                                                   \
    }

INTEGERS(u32)
INTEGERS(u64)
INTEGERS(u128)

#define FLOATS(T, BITS, QUIET)                                                                 \
    ALWAYS T join_##T(enum lines_op op, T a, T b)                                              \
    {                                                                                          \
        return op == LINES_ADD ? a + b : a * b;                                                \
    }                                                                                          \
    ALWAYS T or_##T(bool first, T a, T b)                                                      \
    {                                                                                          \
        return first ? a : b;                                                                  \
    }                                                                                          \
    ALWAYS T take_##T(T v, T flip)                                                             \
    {                                                                                          \
        (void)flip;                                                                            \
        return v;                                                                              \
    }                                                                                          \
    ALWAYS T number_##T(struct machine_scalar x)                                               \
    {                                                                                          \
        const BITS bits = (BITS)x.lo;                                                          \
        T v;                                                                                   \
        memcpy(&v, &bits, sizeof v);                                                           \
        return v;                                                                              \
    }                                                                                          \
    ALWAYS T show_##T(T v, T flip, T cut)                                                      \
    {                                                                                          \
        (void)flip;                                                                            \
        (void)cut;                                                                             \
        return v == v ? v : number_##T((struct machine_scalar){QUIET, 0});                     \
    }

FLOATS(f32, u32, NAN_32)
FLOATS(f64, u64, NAN_64)

/* ---- the loops ---- */

#define NUMBERS(T)                                                                             \
    const struct line_scan *j = s->j;                                                          \
    const T none = number_##T(j->identity), flip = number_##T(j->flip),                        \
            cut = number_##T(j->cut);                                                          \
    const T *in = j->in->host;                                                                 \
    T *out = j->out->host;                                                                     \
    (void)cut, (void)flip, (void)none

/* Where a segment begins before this element, and whether the element is active. */
struct flags {
    bool begins, active;
};
ALWAYS struct flags flags_at(const unsigned char *context, const unsigned char *bits, size_t at,
                             size_t back, bool masked, bool segmented, bool starts)
{
    struct flags f = {.active = !masked || context[at]};
    f.begins = segmented && ((bits[at - back] != 0) & (f.active | !starts));
    return f;
}

/* What a loop takes of the stretch: arrays, and how they lie. */
#define STRETCH                                                                                \
    const unsigned char *context = j->context ? j->context->host : NULL,                       \
                        *bits = j->bits ? j->bits->host : NULL;                                \
    const size_t step = (size_t)s->step, whole = j->backward ? step : 0;                       \
    const bool starts = j->starts;                                                             \
    const int end = s->end;                                                                    \
    size_t at = s->at, back = s->begin ? whole : 0;                                            \
    (void)context, (void)bits, (void)starts

/* n lines, or LOOPS_RUNS runs of one line, from what acc says on; first: where a segment first
 * begins in each; write: what has been combined, to out (of runs as it is: what finishes them
 * makes NaNs the NaN). */
#define SCAN_OF(T)                                                                             \
    ALWAYS void scan_##T(const struct stretch *s, enum lines_op op, bool masked,               \
                         bool segmented, bool exclusive, bool write, int n, T *acc,            \
                         int *first)                                                           \
    {                                                                                          \
        NUMBERS(T);                                                                            \
        STRETCH;                                                                               \
        const bool runs = n == LOOPS_RUNS;                                                     \
        const int run = runs ? end - s->begin : 0;                                             \
        const size_t apart = runs ? (size_t)run * step : 1;                                    \
        for (int k = s->begin; k < end; k++, at += step, back = whole)                         \
            for (int i = 0; i < n; i++) {                                                      \
                const size_t here = at + (size_t)i * apart;                                    \
                const int place = k + i * run;                                                 \
                const struct flags f = flags_at(context, bits, here, runs && i ? whole : back, \
                                                masked, segmented, starts);                    \
                if (segmented && ((T)0.5 != 0 || !write)) /* of floats; of a chunk */          \
                    first[i] = f.begins && place < first[i] ? place : first[i];                \
                const T old = or_##T(f.begins, none, acc[i]), own = take_##T(in[here], flip),  \
                        joined = join_##T(op, old, or_##T(!f.active, none, own)),              \
                        shown = exclusive ? old : joined;                                      \
                acc[i] = joined;                                                               \
                if (write)                                                                     \
                    out[here] = runs ? shown : show_##T(shown, flip, cut);                     \
            }                                                                                  \
    }

SCAN_OF(u32)
SCAN_OF(u64)
SCAN_OF(u128)
SCAN_OF(f32)
SCAN_OF(f64)

/* The first active element of each segment; has: acc is one. */
#define COPY_OF(T)                                                                             \
    ALWAYS void copy_##T(const struct stretch *s, bool segmented, bool write, int n, T *acc,   \
                         bool *has, int *first)                                                \
    {                                                                                          \
        NUMBERS(T);                                                                            \
        STRETCH;                                                                               \
        for (int k = s->begin; k < end; k++, at += step, back = whole)                         \
            for (int i = 0; i < n; i++) {                                                      \
                const size_t here = at + (size_t)i;                                            \
                const struct flags f =                                                         \
                    flags_at(context, bits, here, back, context != NULL, segmented, starts);   \
                const bool had = has[i] & !f.begins;                                           \
                const T old = f.begins ? none : acc[i];                                        \
                first[i] = f.begins && k < first[i] ? k : first[i];                            \
                acc[i] = (f.active & !had) ? in[here] : old;                                   \
                has[i] = had | f.active;                                                       \
                if (write)                                                                     \
                    out[here] = j->exclusive ? old : acc[i];                                   \
            }                                                                                  \
    }

COPY_OF(u32)
COPY_OF(u64)
COPY_OF(u128)

/* ---- the loop for a scan ---- */

/* Sums of whole numbers: neither flipped nor cut. */
#define SUMS_OF(T)                                                                             \
    ALWAYS void sums_##T(const struct stretch *s, bool segmented, bool exclusive, T *acc)      \
    {                                                                                          \
        NUMBERS(T);                                                                            \
        STRETCH;                                                                               \
        T sum = acc[0];                                                                        \
        for (int k = s->begin; k < end; k++, at += step) {                                     \
            const T own = in[at], old = or_##T(segmented && bits[at], 0, sum);                 \
            sum = old + own;                                                                   \
            out[at] = exclusive ? old : sum;                                                   \
        }                                                                                      \
        acc[0] = sum;                                                                          \
        (void)back;                                                                            \
    }

SUMS_OF(u32)
SUMS_OF(u64)
SUMS_OF(u128)

static const enum reduction_op reductions[] = {[LINES_ADD] = REDUCE_ADD,
                                               [LINES_MIN] = REDUCE_LEAST,
                                               [LINES_OR] = REDUCE_OR,
                                               [LINES_XOR] = REDUCE_XOR};

bool near_loops_by_vectors(const struct line_scan *j, ptrdiff_t step)
{
    return lanes_table()->scan && j->element->bytes == 4 && j->element->kind == 0 &&
           !j->backward && step == 1 && j->op != LINES_COPY;
}

/* Forwards along a row: sixteen at a time, where there is a loop for that. */
static bool vectors_u32(const struct stretch *s, u32 *acc)
{
    const struct line_scan *j = s->j;
    if (!near_loops_by_vectors(j, s->step))
        return false;
    const struct lanes_scan v = {
        .in = (const u32 *)j->in->host + s->at,
        .out = (u32 *)j->out->host + s->at,
        .context = j->context ? (const uint8_t *)j->context->host + s->at : NULL,
        .bits = j->bits ? (const uint8_t *)j->bits->host + s->at : NULL,
        .op = reductions[j->op],
        .exclusive = j->exclusive,
        .starts = j->starts,
        .streams = j->streams,
        .none = (u32)j->identity.lo,
        .flip = (u32)j->flip.lo,
        .cut = (u32)j->cut.lo};
    *acc = lanes_table()->scan(&v, (size_t)(s->end - s->begin), *acc);
    return true;
}

ALWAYS bool vectors_u64(const struct stretch *s, u64 *acc)
{
    (void)s, (void)acc;
    return false;
}

ALWAYS bool vectors_u128(const struct stretch *s, u128 *acc)
{
    (void)s, (void)acc;
    return false;
}

#define SUMS_BY_FLAGS(T)                                                                       \
    if (j->bits)                                                                               \
        j->exclusive ? sums_##T(s, true, true, acc) : sums_##T(s, true, false, acc);           \
    else                                                                                       \
        j->exclusive ? sums_##T(s, false, true, acc) : sums_##T(s, false, false, acc)

#define BY_FLAGS(T, n, op, write)                                                              \
    do {                                                                                       \
        const bool e = j->exclusive;                                                           \
        if (j->context && j->bits)                                                             \
            scan_##T(s, op, true, true, e, write, n, acc, first);                              \
        else if (j->context)                                                                   \
            scan_##T(s, op, true, false, e, write, n, acc, first);                             \
        else if (j->bits)                                                                      \
            scan_##T(s, op, false, true, e, write, n, acc, first);                             \
        else if (e)                                                                            \
            scan_##T(s, op, false, false, true, write, n, acc, first);                         \
        else                                                                                   \
            scan_##T(s, op, false, false, false, write, n, acc, first);                        \
    } while (0)

#define INTEGERS_BY_OP(T, n, write)                                                            \
    switch (j->op) {                                                                           \
    case LINES_COPY:                                                                           \
        copy_##T(s, j->bits != NULL, write, n, acc, has, first);                               \
        break;                                                                                 \
    case LINES_ADD:                                                                            \
        if (n == 1 && write && !j->context && !j->backward && cut == (T) ~(T)0)                \
            SUMS_BY_FLAGS(T);                                                                  \
        else                                                                                   \
            BY_FLAGS(T, n, LINES_ADD, write);                                                  \
        break;                                                                                 \
    case LINES_MIN:                                                                            \
        BY_FLAGS(T, n, LINES_MIN, write);                                                      \
        break;                                                                                 \
    case LINES_OR:                                                                             \
        BY_FLAGS(T, n, LINES_OR, write);                                                       \
        break;                                                                                 \
    case LINES_XOR:                                                                            \
        BY_FLAGS(T, n, LINES_XOR, write);                                                      \
        break;                                                                                 \
    case LINES_MULTIPLY: /* only floats are multiplied */                                      \
        INVARIANT(false);                                                                      \
    }

/* What a line's whole comes to, beside one another for neighbouring lines. */
#define INTEGERS_LINES(T, NAME, N)                                                             \
    static void NAME(const struct stretch *all, int run, size_t line)                          \
    {                                                                                          \
        const struct stretch part = N == 1 ? near_active_part(all) : *all, *s = &part;         \
        NUMBERS(T);                                                                            \
        T acc[N];                                                                              \
        bool has[N] = {false};                                                                 \
        int first[N];                                                                          \
        (void)run, (void)in, (void)out;                                                        \
        for (int i = 0; i < N; i++) {                                                          \
            acc[i] = none;                                                                     \
            first[i] = INT32_MAX;                                                              \
        }                                                                                      \
        if (j->sums)                                                                           \
            INTEGERS_BY_OP(T, N, false)                                                        \
        else if (N > 1 || !vectors_##T(s, acc))                                                \
            INTEGERS_BY_OP(T, N, true)                                                         \
        for (int i = 0; i < N && j->sums; i++)                                                 \
            ((T *)j->sums->host)[line + (size_t)i] = show_##T(acc[i], flip, cut);              \
    }

INTEGERS_LINES(u32, line_u32, 1)
INTEGERS_LINES(u64, line_u64, 1)
INTEGERS_LINES(u128, line_u128, 1)
INTEGERS_LINES(u32, lines_u32, LOOPS_LANES)
INTEGERS_LINES(u64, lines_u64, LOOPS_LANES)

/* n numbers side by side from that element on, in any order, where the context (NULL:
 * everywhere) holds. */
#define SUM_OF(T)                                                                              \
    static T sum_##T(const struct line_scan *j, const T *in, const unsigned char *context,     \
                     size_t n)                                                                 \
    {                                                                                          \
        const struct lanes_sum s = {.op = reductions[j->op],                                   \
                                    .element = sizeof(T),                                      \
                                    .plain = true,                                             \
                                    .none = j->identity.lo,                                    \
                                    .flip = j->flip.lo};                                       \
        return (T)lanes_table()->sum(&s, in, context, n);                                      \
    }

SUM_OF(u32)
SUM_OF(u64)

static u128 sum_u128(const struct line_scan *j, const u128 *in, const unsigned char *context,
                     size_t n)
{
    const u128 none = number_u128(j->identity), flip = number_u128(j->flip);
    u128 acc = none;
    for (size_t i = 0; i < n; i++)
        acc = join_u128(j->op, acc, !context || context[i] ? in[i] ^ flip : none);
    return acc;
}

/* What a chunk comes to depends on its last segment alone: the stretch from there on, or all of
 * it. */
static struct stretch segment_last(const struct stretch *s)
{
    const struct line_scan *j = s->j;
    struct stretch last = *s;
    if (!j->bits)
        return last;
    STRETCH;
    (void)end;
    for (int k = s->end - 1; k >= s->begin; k--) {
        at = s->at + (size_t)(k - s->begin) * step;
        back = k ? whole : 0;
        if (flags_at(context, bits, at, back, context != NULL, true, starts).begins) {
            last.begin = k;
            last.at = at;
            break;
        }
    }
    return last;
}

/* A chunk by itself, nothing written; then what goes before each; then each from there on. */
#define INTEGERS_CHUNKS(T)                                                                     \
    static void chunk_sum_##T(const struct stretch *all, struct chunk *c)                      \
    {                                                                                          \
        const struct stretch last = segment_last(all), *s = &last;                             \
        NUMBERS(T);                                                                            \
        T acc[1] = {none};                                                                     \
        bool has[1] = {false};                                                                 \
        int first[1] = {INT32_MAX};                                                            \
        (void)out;                                                                             \
        const size_t n = (size_t)(s->end - s->begin),                                          \
                     least = s->step > 0 ? s->at : s->at - n + 1;                              \
        if (!j->bits && j->op != LINES_COPY)                                                   \
            acc[0] = sum_##T(                                                                  \
                j, in + least,                                                                 \
                j->context ? (const unsigned char *)j->context->host + least : NULL, n);       \
        else                                                                                   \
            INTEGERS_BY_OP(T, 1, false)                                                        \
        *c = (struct chunk){.first = first[0], .total_has = has[0]};                           \
        c->total.as_##T = acc[0];                                                              \
    }                                                                                          \
    static void chunk_join_##T(const struct line_scan *j, struct chunk *c, int count)          \
    {                                                                                          \
        T carry = number_##T(j->identity);                                                     \
        bool has = false;                                                                      \
        for (int i = 0; i < count; i++, c++) {                                                 \
            const bool begins = c->first != INT32_MAX;                                         \
            c->carry.as_##T = carry;                                                           \
            c->carry_has = has;                                                                \
            if (j->op != LINES_COPY)                                                           \
                carry = begins ? c->total.as_##T : join_##T(j->op, carry, c->total.as_##T);    \
            else if (begins || !has)                                                           \
                carry = c->total.as_##T;                                                       \
            has = begins || !has ? c->total_has : has;                                         \
        }                                                                                      \
    }                                                                                          \
    static void chunk_scan_##T(const struct stretch *all, struct chunk *c)                     \
    {                                                                                          \
        const struct stretch part = near_active_part(all), *s = &part;                         \
        NUMBERS(T);                                                                            \
        T acc[1] = {c->carry.as_##T};                                                          \
        bool has[1] = {c->carry_has};                                                          \
        int first[1] = {INT32_MAX};                                                            \
        (void)in, (void)out, (void)none;                                                       \
        if (!vectors_##T(s, acc))                                                              \
            INTEGERS_BY_OP(T, 1, true)                                                         \
    }

INTEGERS_CHUNKS(u32)
INTEGERS_CHUNKS(u64)
INTEGERS_CHUNKS(u128)

/* ---- floats: run by run ---- */

/* One run by itself, of N lines. */
#define FLOATS_RUN(T, N, write)                                                                \
    for (int i = 0; i < N; i++) {                                                              \
        acc[i] = none;                                                                         \
        first[i] = INT32_MAX;                                                                  \
    }                                                                                          \
    if (j->op == LINES_ADD)                                                                    \
        BY_FLAGS(T, N, LINES_ADD, write);                                                      \
    else                                                                                       \
        BY_FLAGS(T, N, LINES_MULTIPLY, write)

/* What the runs before come to is combined with a run's elements before a segment begins. */
#define FLOATS_FINISH(T, N)                                                                    \
    ALWAYS void finish_##T##_##N(const struct stretch *s, const T *carry, const int *first)    \
    {                                                                                          \
        NUMBERS(T);                                                                            \
        (void)in;                                                                              \
        size_t at = s->at;                                                                     \
        const int count = s->end - s->begin, before = first[0] - s->begin;                     \
        T *run = out + at;                                                                     \
        if (N == 1 && s->step == 1 && j->op == LINES_ADD) { /* by vectors */                   \
            for (int k = 0; k < (before < count ? before : count); k++)                        \
                run[k] = show_##T(carry[0] + run[k], flip, cut);                               \
            for (int k = before; k < count; k++)                                               \
                run[k] = show_##T(run[k], flip, cut);                                          \
            return;                                                                            \
        }                                                                                      \
        for (int k = s->begin; k < s->end; k++, at += (size_t)s->step)                         \
            for (int i = 0; i < N; i++) {                                                      \
                const T v = out[at + (size_t)i];                                               \
                out[at + (size_t)i] =                                                          \
                    show_##T(k < first[i] ? join_##T(j->op, carry[i], v) : v, flip, cut);      \
            }                                                                                  \
    }

FLOATS_FINISH(f32, 1)
FLOATS_FINISH(f64, 1)
FLOATS_FINISH(f32, 16)
FLOATS_FINISH(f64, 16)

/* Some runs of one line: each by itself, and then what goes before each. */
#define FLOATS_RUNS(T)                                                                         \
    static void runs_##T(const struct stretch *s, T *total, int *begins)                       \
    {                                                                                          \
        NUMBERS(T);                                                                            \
        T acc[LOOPS_RUNS]; /* of its own, so that it need not be in memory */                  \
        int first[LOOPS_RUNS];                                                                 \
        (void)in, (void)out;                                                                   \
        const size_t all = LOOPS_RUNS * (size_t)(s->end - s->begin);                           \
        for (size_t i = all; s->step == 1 && i < 2 * all; i += LINE_BYTES / sizeof(T)) {       \
            __builtin_prefetch(in + s->at + i);                                                \
            __builtin_prefetch(out + s->at + i, 1);                                            \
        }                                                                                      \
        FLOATS_RUN(T, LOOPS_RUNS, true);                                                       \
        memcpy(total, acc, sizeof acc);                                                        \
        memcpy(begins, first, sizeof first);                                                   \
    }                                                                                          \
    static T runs_finish_##T(const struct stretch *first_run, T carry)                         \
    {                                                                                          \
        struct stretch s = *first_run;                                                         \
        const int run = s.end - s.begin;                                                       \
        T acc[LOOPS_RUNS];                                                                     \
        int first[LOOPS_RUNS];                                                                 \
        runs_##T(first_run, acc, first);                                                       \
        for (int i = 0; i < LOOPS_RUNS; i++) {                                                 \
            finish_##T##_1(&s, &carry, &first[i]);                                             \
            carry = first[i] < s.end ? acc[i] : join_##T(s.j->op, carry, acc[i]);              \
            s.begin += run, s.end += run, s.at += (size_t)(run * s.step);                      \
        }                                                                                      \
        return carry;                                                                          \
    }

FLOATS_RUNS(f32)
FLOATS_RUNS(f64)

#define FLOATS_LINES(T, NAME, N)                                                               \
    static void NAME(const struct stretch *all, int run, size_t line)                          \
    {                                                                                          \
        struct stretch one = *all, *s = &one;                                                  \
        NUMBERS(T);                                                                            \
        T carry[N], acc[N];                                                                    \
        int first[N];                                                                          \
        (void)in, (void)out;                                                                   \
        for (int i = 0; i < N; i++)                                                            \
            carry[i] = none;                                                                   \
        for (; N == 1 && !j->sums && all->end - s->begin >= LOOPS_RUNS * run;                  \
             s->begin += LOOPS_RUNS * run, s->at += (size_t)(LOOPS_RUNS * run * s->step)) {    \
            s->end = s->begin + run;                                                           \
            carry[0] = runs_finish_##T(s, carry[0]);                                           \
        }                                                                                      \
        for (; s->begin < all->end; s->begin += run, s->at += (size_t)(run * s->step)) {       \
            s->end = all->end - s->begin < run ? all->end : s->begin + run;                    \
            if (j->sums) {                                                                     \
                FLOATS_RUN(T, N, false);                                                       \
            } else {                                                                           \
                FLOATS_RUN(T, N, true);                                                        \
                if (all->end > run)                                                            \
                    finish_##T##_##N(s, carry, first);                                         \
            }                                                                                  \
            for (int i = 0; i < N; i++)                                                        \
                carry[i] = first[i] < s->end ? acc[i] : join_##T(j->op, carry[i], acc[i]);     \
        }                                                                                      \
        for (int i = 0; i < N && j->sums; i++)                                                 \
            ((T *)j->sums->host)[line + (size_t)i] = show_##T(carry[i], flip, cut);            \
    }

FLOATS_LINES(f32, line_f32, 1)
FLOATS_LINES(f64, line_f64, 1)
FLOATS_LINES(f32, lines_f32, 16)
FLOATS_LINES(f64, lines_f64, 16)

/* Chunks of floats are runs: each by itself, written; then what goes before each; then it is
 * combined with that. */
#define FLOATS_CHUNKS(T)                                                                       \
    static void chunk_sum_##T(const struct stretch *s, struct chunk *c)                        \
    {                                                                                          \
        NUMBERS(T);                                                                            \
        T acc[1];                                                                              \
        int first[1];                                                                          \
        (void)in, (void)out;                                                                   \
        FLOATS_RUN(T, 1, true);                                                                \
        *c = (struct chunk){.first = first[0]};                                                \
        c->total.as_##T = acc[0];                                                              \
    }                                                                                          \
    static void chunk_sums_##T(const struct stretch *s, struct chunk *c)                       \
    {                                                                                          \
        T acc[LOOPS_RUNS];                                                                     \
        int first[LOOPS_RUNS];                                                                 \
        runs_##T(s, acc, first);                                                               \
        for (int i = 0; i < LOOPS_RUNS; i++) {                                                 \
            c[i] = (struct chunk){.first = first[i]};                                          \
            c[i].total.as_##T = acc[i];                                                        \
        }                                                                                      \
    }                                                                                          \
    static void chunk_join_##T(const struct line_scan *j, struct chunk *c, int count)          \
    {                                                                                          \
        T carry = number_##T(j->identity);                                                     \
        for (int i = 0; i < count; i++, c++) {                                                 \
            c->carry.as_##T = carry;                                                           \
            carry = c->first != INT32_MAX ? c->total.as_##T                                    \
                                          : join_##T(j->op, carry, c->total.as_##T);           \
        }                                                                                      \
    }                                                                                          \
    static void chunk_scan_##T(const struct stretch *s, struct chunk *c)                       \
    {                                                                                          \
        finish_##T##_1(s, &c->carry.as_##T, &c->first);                                        \
    }

FLOATS_CHUNKS(f32)
FLOATS_CHUNKS(f64)

/* For elements as in kernels/scan.cl. */
static const struct loops loops[] = {
    {line_u32, lines_u32, chunk_sum_u32, chunk_scan_u32, chunk_join_u32, NULL},
    {line_u64, lines_u64, chunk_sum_u64, chunk_scan_u64, chunk_join_u64, NULL},
    {line_u128, NULL, chunk_sum_u128, chunk_scan_u128, chunk_join_u128, NULL},
    {line_f32, lines_f32, chunk_sum_f32, chunk_scan_f32, chunk_join_f32, chunk_sums_f32},
    {line_f64, lines_f64, chunk_sum_f64, chunk_scan_f64, chunk_join_f64, chunk_sums_f64},
};

const struct loops *near_loops_of(const struct element *e)
{
    return &loops[e->kind == 1    ? (e->bytes == 4 ? 3 : 4)
                  : e->bytes == 4 ? 0
                  : e->bytes == 8 ? 1
                                  : 2];
}
