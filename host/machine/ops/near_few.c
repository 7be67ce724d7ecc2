/* near_few.c - see near_few.h.
 *
 * Each part has some of the senders, one after the other, and tables of its own with an element
 * for each processor and one more, where the messages go that nobody gets. So no branch depends
 * on an address. A processor that gets many messages in a row would have each wait for the one
 * before, so the tables are four, in turn. What is in them is combined at the end: the order of
 * whole numbers makes no difference.
 *
 *     senders of part 0        3  3  1  9           3 processors: 9 is nobody
 *     table 0, 1, 2, 3         0 . . . .            3 becomes the place "nobody", as 9 does */
#include "ops/near_few.h"

#include <stdlib.h>

#include "base/arrays.h"
#include "base/errors.h"
#include "base/scalar.h"
#include "base/types.h"

enum { TABLES = 4 };

typedef unsigned __int128 u128;

struct few {
    const struct near_route *r;
    enum machine_combiner combiner;
    struct machine_type type;
    size_t bytes; /* of an element */
    const char *source;
    bool same;
    char *tables; /* of all parts */
    size_t table_bytes;
    int tables_count; /* of a part */
};

/* Messages to table[k] of a part, in turn; b: what is sent. */
#define SEND_ONE(T, EXPRESSION, k)                                                             \
    {                                                                                          \
        T *d = table[k] + index[i + k];                                                        \
        const T a = *d, b = in[i + k];                                                         \
        *d = (T)(EXPRESSION);                                                                  \
    }
#define SEND(T, EXPRESSION)                                                                    \
    {                                                                                          \
        for (; i + TABLES <= n; i += TABLES) {                                                 \
            SEND_ONE(T, EXPRESSION, 0)                                                         \
            SEND_ONE(T, EXPRESSION, 1)                                                         \
            SEND_ONE(T, EXPRESSION, 2)                                                         \
            SEND_ONE(T, EXPRESSION, 3)                                                         \
        }                                                                                      \
        for (; i < n; i++)                                                                     \
            SEND_ONE(T, EXPRESSION, 0)                                                         \
        break;                                                                                 \
    }

#define BY_COMBINER(T, WHAT)                                                                   \
    switch (combiner) {                                                                        \
    case MACHINE_COMBINE_AND:                                                                  \
        WHAT(T, a &b)                                                                          \
    case MACHINE_COMBINE_OR:                                                                   \
        WHAT(T, a | b)                                                                         \
    case MACHINE_COMBINE_XOR:                                                                  \
        WHAT(T, a ^ b)                                                                         \
    case MACHINE_COMBINE_ADD: /* what does not fit is cut at the end */                        \
        WHAT(T, a + b)                                                                         \
    case MACHINE_COMBINE_UMIN:                                                                 \
        WHAT(T, b < a ? b : a)                                                                 \
    case MACHINE_COMBINE_UMAX:                                                                 \
        WHAT(T, b > a ? b : a)                                                                 \
    case MACHINE_COMBINE_SMIN:                                                                 \
        WHAT(T, (T)(b ^ sign) < (T)(a ^ sign) ? b : a)                                         \
    case MACHINE_COMBINE_SMAX:                                                                 \
        WHAT(T, (T)(b ^ sign) > (T)(a ^ sign) ? b : a)                                         \
    case MACHINE_COMBINE_OVERWRITE: /* no whole numbers are combined so */                     \
    case MACHINE_COMBINE_FADD:                                                                 \
    case MACHINE_COMBINE_FMIN:                                                                 \
    case MACHINE_COMBINE_FMAX:                                                                 \
        INVARIANT(false);                                                                      \
    }

#define FUNCTIONS(T)                                                                           \
    static void send_##T(const struct few *f, char *tables, const uint32_t *index,             \
                         const char *source, int n)                                            \
    {                                                                                          \
        const struct machine_scalar bit = scalar_sign(f->type.width);                          \
        const T sign = (T)((u128)bit.hi << 64 | bit.lo),                                       \
                *in = (const T *)(const void *)source;                                         \
        const enum machine_combiner combiner = f->combiner;                                    \
        T *table[TABLES];                                                                      \
        int i = 0;                                                                             \
        for (int k = 0; k < TABLES; k++)                                                       \
            table[k] = (T *)(void *)(tables + (size_t)(k % f->tables_count) * f->table_bytes); \
        BY_COMBINER(T, SEND)                                                                   \
    }                                                                                          \
    /* A table's elements to where their processors' are. */                                   \
    static void join_##T(const struct few *f, const char *table, void *out)                    \
    {                                                                                          \
        const struct machine_scalar bit = scalar_sign(f->type.width),                          \
                                    ones = scalar_ones(f->type.width);                         \
        const T sign = (T)((u128)bit.hi << 64 | bit.lo),                                       \
                mask = (T)((u128)ones.hi << 64 | ones.lo),                                     \
                *in = (const T *)(const void *)table;                                          \
        const struct vpset *s = f->r->to;                                                      \
        const enum machine_combiner combiner = f->combiner;                                    \
        for (uint64_t row = 0; row < s->rows; row++) {                                         \
            T *to = (T *)out + (size_t)row * s->pitch + s->halo;                               \
            for (int x = 0; x < s->width; x++, in++) {                                         \
                const T a = to[x], b = *in;                                                    \
                BY_COMBINER(T, JOIN)                                                           \
            }                                                                                  \
        }                                                                                      \
    }
#define JOIN(T, EXPRESSION)                                                                    \
    {                                                                                          \
        to[x] = (T)((T)(EXPRESSION)&mask);                                                     \
        break;                                                                                 \
    }

FUNCTIONS(uint8_t)
FUNCTIONS(uint16_t)
FUNCTIONS(uint32_t)
FUNCTIONS(uint64_t)
FUNCTIONS(u128)

#define BY_BYTES(bytes, FUNCTION, ...)                                                         \
    switch (bytes) {                                                                           \
    case 1:                                                                                    \
        FUNCTION##_uint8_t(__VA_ARGS__);                                                       \
        break;                                                                                 \
    case 2:                                                                                    \
        FUNCTION##_uint16_t(__VA_ARGS__);                                                      \
        break;                                                                                 \
    case 4:                                                                                    \
        FUNCTION##_uint32_t(__VA_ARGS__);                                                      \
        break;                                                                                 \
    case 8:                                                                                    \
        FUNCTION##_uint64_t(__VA_ARGS__);                                                      \
        break;                                                                                 \
    default:                                                                                   \
        FUNCTION##_u128(__VA_ARGS__);                                                          \
    }

/* Some of the senders. Those of a part lie one after the other, which the processor's own
 * fetching ahead follows. */
static void part_few(void *of, int part, int worker)
{
    const struct few *f = of;
    const struct near_route *r = f->r;
    const struct vpset *s = r->from;
    char *tables = f->tables + (size_t)part * (size_t)f->tables_count * f->table_bytes;
    uint64_t from = s->count * (uint64_t)part / (uint64_t)r->parts,
             end = s->count * (uint64_t)(part + 1) / (uint64_t)r->parts;
    uint32_t index[ROUTE_BLOCK];
    (void)worker;
    for (int n; from < end; from += (uint64_t)n) {
        const int x = (int)(from % (uint64_t)s->width);
        const size_t at =
            (size_t)(from / (uint64_t)s->width) * s->pitch + (size_t)s->halo + (size_t)x;
        n = s->width - x < ROUTE_BLOCK ? s->width - x : ROUTE_BLOCK;
        n = end - from < (uint64_t)n ? (int)(end - from) : n;
        near_aims(r, at, n, index);
        near_look_beyond(r, at, n, index);
        const char *source = f->same ? f->source : f->source + at * f->bytes;
        BY_BYTES(f->bytes, send, f, tables, index, source, n)
    }
}

/* What sends change nothing. */
static struct machine_scalar identity_of(enum machine_combiner combiner, int width)
{
    const struct machine_scalar zero = {0, 0}, ones = scalar_ones(width),
                                sign = scalar_sign(width);
    switch (combiner) {
    case MACHINE_COMBINE_AND:
    case MACHINE_COMBINE_UMIN:
        return ones;
    case MACHINE_COMBINE_SMIN:
        return (struct machine_scalar){ones.lo ^ sign.lo, ones.hi ^ sign.hi};
    case MACHINE_COMBINE_SMAX:
        return sign;
    case MACHINE_COMBINE_OR:
    case MACHINE_COMBINE_XOR:
    case MACHINE_COMBINE_ADD:
    case MACHINE_COMBINE_UMAX:
        return zero;
    case MACHINE_COMBINE_OVERWRITE: /* no whole numbers are combined so */
    case MACHINE_COMBINE_FADD:
    case MACHINE_COMBINE_FMIN:
    case MACHINE_COMBINE_FMAX:
        break;
    }
    INVARIANT(false);
}

bool near_send_few(const struct near_route *r, enum machine_combiner combiner,
                   struct machine_type type, const void *source, bool same, void *out)
{
    struct few f = {.r = r,
                    .combiner = combiner,
                    .type = type,
                    .bytes = type_bytes(type),
                    .source = source,
                    .same = same};
    if (r->to->count > TABLE_BYTES / f.bytes || r->to->count * TABLE_SENDERS > r->from->count)
        return false;
    f.table_bytes =
        (((size_t)r->to->count + 1) * f.bytes + LINE_BYTES - 1) / LINE_BYTES * LINE_BYTES;
    f.tables_count = f.table_bytes <= TABLE_NEAR_BYTES ? TABLES : 1;
    const size_t tables = (size_t)r->parts * (size_t)f.tables_count;
    const struct machine_scalar none = identity_of(combiner, type.width);
    f.tables = aligned_alloc(LINE_BYTES, tables * f.table_bytes);
    if (!f.tables)
        return false;
    array_fill(f.tables, (const uint64_t[2]){none.lo, none.hi}, f.bytes,
               tables * f.table_bytes / f.bytes);
    crew_run(r->crew, r->parts, part_few, &f);
    for (size_t i = 0; i < tables; i++)
        BY_BYTES(f.bytes, join, &f, f.tables + i * f.table_bytes, out)
    free(f.tables);
    return true;
}
