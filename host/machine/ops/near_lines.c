/* near_lines.c - see near_lines.h.
 *
 *     along a row      one line at a time, an element after the other
 *     across rows      LANES neighbouring lines at a time, a row after the other
 *
 * Each loop is there for each combination, with and without a context and segments, so that it tests nothing inside. Integers are
 * combined from a line's one end to the other: their order makes no difference. Floats are combined run by run, as the kernel does. */
#include "ops/near_lines.h"

#include <string.h>

#include "base/scalar.h"

enum { LANES = 16, FILL_BYTES = 4096 };

typedef uint32_t u32;
typedef uint64_t u64;
typedef unsigned __int128 u128;
typedef float f32;
typedef double f64;

/* The lines that are scanned together, and how far: elements begin to end of each. */
struct stretch {
    const struct line_scan *j;
    size_t at; /* of element begin */
    ptrdiff_t step;
    int begin, end;
};

#define ALWAYS static inline __attribute__((always_inline))

/* ---- what is combined ---- */

#define INTEGERS(T)                                                                            \
    ALWAYS T join_##T(int op, T a, T b)                                                        \
    {                                                                                          \
        return op == LINES_ADD   ? a + b                                                       \
               : op == LINES_MIN ? (b < a ? b : a)                                             \
               : op == LINES_OR  ? (a | b)                                                     \
                                 : (a ^ b);                                                     \
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
    ALWAYS T join_##T(int op, T a, T b)                                                        \
    {                                                                                          \
        return op == LINES_ADD ? a + b : a * b;                                                \
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
ALWAYS struct flags flags_at(const struct line_scan *j, size_t at, size_t back, bool masked,
                             bool segmented)
{
    const unsigned char *context = masked ? j->context->host : NULL,
                        *bits = segmented ? j->bits->host : NULL;
    struct flags f = {.active = !masked || context[at]};
    f.begins = segmented && bits[at - back] && (f.active || !j->starts);
    return f;
}

/* n lines, from what acc says on; first: where a segment first begins in each; write: what has been combined, to out. */
#define SCAN_OF(T)                                                                             \
    ALWAYS void scan_##T(const struct stretch *s, int op, bool masked, bool segmented,         \
                         bool exclusive, bool write, int n, T *acc, int *first)                \
    {                                                                                          \
        NUMBERS(T);                                                                            \
        const size_t whole = j->backward ? (size_t)s->step : 0;                                \
        size_t at = s->at, back = s->begin ? whole : 0;                                        \
        for (int k = s->begin; k < s->end; k++, at += (size_t)s->step, back = whole)           \
            for (int i = 0; i < n; i++) {                                                      \
                const size_t here = at + (size_t)i;                                            \
                const struct flags f = flags_at(j, here, back, masked, segmented);             \
                if (segmented && (T)0.5 != 0) /* of floats */                                  \
                    first[i] = f.begins && k < first[i] ? k : first[i];                        \
                const T old = f.begins ? none : acc[i], own = take_##T(in[here], flip),        \
                        joined = join_##T(op, old, f.active ? own : none),                     \
                        shown = exclusive ? old : joined;                                      \
                acc[i] = joined;                                                               \
                if (write)                                                                     \
                    out[here] = show_##T(shown, flip, cut);                                    \
            }                                                                                  \
    }

SCAN_OF(u32)
SCAN_OF(u64)
SCAN_OF(u128)
SCAN_OF(f32)
SCAN_OF(f64)

/* The first active element of each segment. */
#define COPY_OF(T)                                                                             \
    ALWAYS void copy_##T(const struct stretch *s, bool segmented, int n)                       \
    {                                                                                          \
        NUMBERS(T);                                                                            \
        const size_t whole = j->backward ? (size_t)s->step : 0;                                \
        size_t at = s->at, back = s->begin ? whole : 0;                                        \
        T acc[LANES];                                                                          \
        bool has[LANES] = {false};                                                             \
        for (int i = 0; i < n; i++)                                                            \
            acc[i] = none;                                                                     \
        for (int k = s->begin; k < s->end; k++, at += (size_t)s->step, back = whole)           \
            for (int i = 0; i < n; i++) {                                                      \
                const size_t here = at + (size_t)i;                                            \
                const struct flags f = flags_at(j, here, back, j->context != NULL, segmented); \
                const bool had = has[i] & !f.begins;                                           \
                const T old = f.begins ? none : acc[i];                                        \
                acc[i] = f.active & !had ? in[here] : old;                                     \
                has[i] = had | f.active;                                                       \
                out[here] = j->exclusive ? old : acc[i];                                       \
            }                                                                                  \
    }

COPY_OF(u32)
COPY_OF(u64)
COPY_OF(u128)

/* ---- the loop for a scan ---- */

#define BY_FLAGS(T, n, op)                                                                     \
    do {                                                                                       \
        const bool e = j->exclusive, w = !j->sums;                                             \
        if (j->context && j->bits)                                                             \
            scan_##T(s, op, true, true, e, w, n, acc, first);                                  \
        else if (j->context)                                                                   \
            scan_##T(s, op, true, false, e, w, n, acc, first);                                 \
        else if (j->bits)                                                                      \
            scan_##T(s, op, false, true, e, w, n, acc, first);                                 \
        else if (!w)                                                                           \
            scan_##T(s, op, false, false, false, false, n, acc, first);                        \
        else if (e)                                                                            \
            scan_##T(s, op, false, false, true, true, n, acc, first);                          \
        else                                                                                   \
            scan_##T(s, op, false, false, false, true, n, acc, first);                         \
    } while (0)

#define INTEGERS_BY_OP(T, n)                                                                   \
    switch (j->op) {                                                                           \
    case LINES_COPY:                                                                           \
        copy_##T(s, j->bits != NULL, n);                                                       \
        break;                                                                                 \
    case LINES_ADD:                                                                            \
        BY_FLAGS(T, n, LINES_ADD);                                                             \
        break;                                                                                 \
    case LINES_MIN:                                                                            \
        BY_FLAGS(T, n, LINES_MIN);                                                             \
        break;                                                                                 \
    case LINES_OR:                                                                             \
        BY_FLAGS(T, n, LINES_OR);                                                              \
        break;                                                                                 \
    default:                                                                                   \
        BY_FLAGS(T, n, LINES_XOR);                                                             \
    }

/* What a line's whole comes to, beside one another for neighbouring lines. */
#define INTEGERS_LINES(T, NAME, N)                                                             \
    static void NAME(const struct stretch *s, int run, size_t line)                            \
    {                                                                                          \
        NUMBERS(T);                                                                            \
        T acc[N];                                                                              \
        int first[N];                                                                          \
        (void)run, (void)in, (void)out;                                                        \
        for (int i = 0; i < N; i++) {                                                          \
            acc[i] = none;                                                                     \
            first[i] = INT32_MAX;                                                              \
        }                                                                                      \
        INTEGERS_BY_OP(T, N)                                                                   \
        for (int i = 0; i < N && j->sums; i++)                                                 \
            ((T *)j->sums->host)[line + (size_t)i] = show_##T(acc[i], flip, cut);              \
    }

INTEGERS_LINES(u32, line_u32, 1)
INTEGERS_LINES(u64, line_u64, 1)
INTEGERS_LINES(u128, line_u128, 1)
INTEGERS_LINES(u32, lines_u32, LANES)
INTEGERS_LINES(u64, lines_u64, LANES)

/* Run by run. What the runs before come to is combined with a run's elements before a segment begins. */
#define FLOATS_LINES(T, NAME, N)                                                               \
    static void NAME(const struct stretch *all, int run, size_t line)                          \
    {                                                                                          \
        struct stretch one = *all, *s = &one;                                                  \
        NUMBERS(T);                                                                            \
        T carry[N];                                                                            \
        for (int i = 0; i < N; i++)                                                            \
            carry[i] = none;                                                                   \
        for (; s->begin < all->end; s->begin += run, s->at += (size_t)(run * s->step)) {       \
            T acc[N];                                                                          \
            int first[N];                                                                      \
            s->end = all->end - s->begin < run ? all->end : s->begin + run;                    \
            for (int i = 0; i < N; i++) {                                                      \
                acc[i] = none;                                                                 \
                first[i] = INT32_MAX;                                                          \
            }                                                                                  \
            if (j->op == LINES_ADD)                                                            \
                BY_FLAGS(T, N, LINES_ADD);                                                     \
            else                                                                               \
                BY_FLAGS(T, N, LINES_MULTIPLY);                                                \
            size_t at = s->at;                                                                 \
            for (int k = s->begin; k < s->end && all->end > run && !j->sums;                   \
                 k++, at += (size_t)s->step)                                                   \
                for (int i = 0; i < N; i++) {                                                  \
                    const T v = out[at + (size_t)i], joined = join_##T(j->op, carry[i], v);    \
                    out[at + (size_t)i] = k < first[i] ? show_##T(joined, flip, cut) : v;      \
                }                                                                              \
            for (int i = 0; i < N; i++)                                                        \
                carry[i] = first[i] < s->end ? acc[i] : join_##T(j->op, carry[i], acc[i]);     \
        }                                                                                      \
        (void)in;                                                                              \
        for (int i = 0; i < N && j->sums; i++)                                                 \
            ((T *)j->sums->host)[line + (size_t)i] = show_##T(carry[i], flip, cut);            \
    }

FLOATS_LINES(f32, line_f32, 1)
FLOATS_LINES(f64, line_f64, 1)
FLOATS_LINES(f32, lines_f32, LANES)
FLOATS_LINES(f64, lines_f64, LANES)

/* ---- all lines ---- */

typedef void lines_loop(const struct stretch *s, int run, size_t line);

static lines_loop *loop_of(const struct element *e, bool many)
{
    if (e->kind == 1)
        return e->bytes == 4 ? (many ? lines_f32 : line_f32) : many ? lines_f64 : line_f64;
    return e->bytes == 4   ? (many ? lines_u32 : line_u32)
           : e->bytes == 8 ? (many ? lines_u64 : line_u64)
                           : line_u128;
}

/* The other end of the row whose column 0 is at that element, on both sides. */
static void row_repeat(const struct lines *l, char *out, size_t bytes, size_t column)
{
    char *row = out + column * bytes;
    size_t width = (size_t)l->width * bytes, halo = (size_t)l->halo * bytes;
    memcpy(row - halo, row + width - halo, halo);
    memcpy(row + width, row, halo);
}

/* All rows of the lines that lie in rows from there on. */
static void rows_repeat(const struct lines *l, char *out, size_t bytes, size_t row)
{
    if (!l->halo)
        return;
    if (l->along)
        row_repeat(l, out, bytes, l->step > 0 ? row : row - (size_t)(l->length - 1));
    for (int k = 0; k < l->length && !l->along; k++)
        row_repeat(l, out, bytes, row + (size_t)(k * l->step));
}

void near_lines_scan(const struct lines *l, const struct line_scan *j, int run)
{
    size_t line = 0;
    for (size_t outer = 0; outer < l->outer; outer++)
        for (size_t inner = 0; inner < l->inner; inner++) {
            size_t row = l->base + inner * l->inner_stride + outer * l->outer_stride;
            for (int column = 0, n; column < l->columns; column += n) {
                n = l->columns - column >= LANES && j->element->kind != 2 ? LANES : 1;
                const struct stretch s = {.j = j,
                                          .at = row + (size_t)column,
                                          .step = (ptrdiff_t)l->step,
                                          .end = l->length};
                loop_of(j->element, n > 1)(&s, run, line + (size_t)column);
            }
            line += (size_t)l->columns;
            if (!j->sums)
                rows_repeat(l, j->out->host, j->element->bytes, row);
        }
}

/* ---- lines filled ---- */

static void fill_row(char *to, const char *element, size_t bytes, size_t count)
{
    size_t done = count ? 1 : 0;
    memcpy(to, element, done * bytes);
    for (size_t more; done < count; done += more) {
        more = done * bytes < FILL_BYTES ? done : FILL_BYTES / bytes;
        more = count - done < more ? count - done : more;
        memcpy(to + done * bytes, to, more * bytes);
    }
}

void near_lines_fill(const struct lines *l, size_t bytes, const struct device_buffer *from,
                     struct origin origin, struct device_buffer *out)
{
    char *to = out->host;
    for (size_t outer = 0; outer < l->outer; outer++)
        for (size_t inner = 0; inner < l->inner; inner++) {
            size_t row = l->base + inner * l->inner_stride + outer * l->outer_stride;
            const char *element =
                (const char *)from->host +
                (origin.base + inner * origin.inner + outer * origin.outer) * bytes;
            if (l->along) {
                size_t first = l->step > 0 ? row : row - (size_t)(l->length - 1);
                fill_row(to + first * bytes, element, bytes, (size_t)l->length);
            }
            for (int k = 0; k < l->length && !l->along; k++)
                memcpy(to + (row + (size_t)(k * l->step)) * bytes, element,
                       (size_t)l->columns * bytes);
            rows_repeat(l, to, bytes, row);
        }
}
