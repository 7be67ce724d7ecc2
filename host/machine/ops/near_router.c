/* near_router.c - see near_router.h.
 *
 * A block of senders at a time: their addresses become places in the array of the other set,
 * without those who do not send; then the messages go, in the order of the senders. So no loop
 * has a branch that could not be predicted. Of a send each part has some of the destinations,
 * and passes all senders; of a get, some of the blocks.
 *
 *     addresses      5  1  -  7        (-: not active)
 *     hops           place 5, lane 0 | place 1, lane 1 | place 7, lane 3 */
#include "ops/near_router.h"

#include <stdlib.h>
#include <string.h>

#include "base/arrays.h"
#include "base/errors.h"
#include "base/scalar.h"
#include "base/types.h"
#include "ops/near_few.h"
#include "values/geometry.h"

enum { BLOCK = ROUTE_BLOCK };

typedef unsigned __int128 u128;

/* The destinations of a part: their indices. */
struct range {
    uint64_t first, end;
};

struct hops {
    size_t count;
    uint32_t place[BLOCK + 16]; /* in the other set's array */
    uint16_t lane[BLOCK + 16];  /* in the block */
};

/* ---- addresses ---- */

/* Of n senders from that element on; looks: also whether a message goes to no processor. */
static void hops_find(const struct near_route *r, const struct range *to, size_t at, int n,
                      bool looks, struct hops *h)
{
    uint32_t index[BLOCK];
    const struct vpset *s = r->to;
    const unsigned char *context = r->context ? r->context->host : NULL;
    const struct lanes_filter p = {index, (uint32_t)to->first, (uint32_t)(to->end - to->first),
                                   s->rows == 1 ? (uint32_t)s->halo : 0};
    near_addresses(r, at, n, index);
    if (looks)
        near_look_beyond(r, at, n, index);
    h->count = r->lanes->filter(&p, context ? context + at : NULL, n, h->place, h->lane);
    if (s->rows > 1)
        r->lanes->places(h->place, h->count,
                         &(struct lanes_rows){(uint32_t)s->width, (uint32_t)s->halo,
                                              (uint32_t)(s->pitch - (size_t)s->width)});
}

/* Blocks of the senders' rows, one after the other. */
struct block {
    int n, follow; /* how many more there are in the row */
    size_t at;     /* of its first element */
};

static uint64_t blocks_along(const struct near_route *r)
{
    return ((uint64_t)r->from->width + BLOCK - 1) / BLOCK;
}

static uint64_t blocks_count(const struct near_route *r)
{
    return r->from->rows * blocks_along(r);
}

static struct block block_get(const struct near_route *r, uint64_t i)
{
    const struct vpset *s = r->from;
    const uint64_t along = blocks_along(r), row = i / along;
    const int x = (int)(i % along) * BLOCK;
    const int n = s->width - x < BLOCK ? s->width - x : BLOCK;
    return (struct block){.n = n,
                          .follow = s->width - x - n,
                          .at = (size_t)row * s->pitch + (size_t)s->halo + (size_t)x};
}

static struct range blocks_of_part(const struct near_route *r, int part)
{
    const uint64_t count = blocks_count(r), parts = (uint64_t)r->parts;
    return (struct range){count * (uint64_t)part / parts, count * (uint64_t)(part + 1) / parts};
}

void near_rows_repeat(const struct vpset *s, size_t bytes, struct device_buffer *b)
{
    size_t width = (size_t)s->width * bytes, halo = (size_t)s->halo * bytes;
    for (uint64_t row = 0; row < s->rows && halo; row++) {
        char *begin = (char *)b->host + (size_t)row * s->pitch * bytes + halo;
        memcpy(begin - halo, begin + width - halo, halo);
        memcpy(begin + width, begin, halo);
    }
}

/* ---- messages ---- */

#define MOVE(T)                                                                                \
    {                                                                                          \
        const T *in = (const T *)from + at;                                                    \
        T *to = out;                                                                           \
        for (size_t i = 0; i < h->count; i++)                                                  \
            to[h->place[i]] = in[h->lane[i]];                                                  \
    }

static void messages_move(const struct hops *h, size_t bytes, const void *from, size_t at,
                          void *out)
{
    switch (bytes) {
    case 1:
        MOVE(uint8_t)
        break;
    case 2:
        MOVE(uint16_t)
        break;
    case 4:
        MOVE(uint32_t)
        break;
    case 8:
        MOVE(uint64_t)
        break;
    default:
        MOVE(u128)
    }
}

#define JOIN(T, EXPRESSION)                                                                    \
    for (size_t i = 0; i < h->count; i++) {                                                    \
        T *d = (T *)out + h->place[i];                                                         \
        const T a = *d, b = ((const T *)from)[at + h->lane[i]];                                \
        *d = (EXPRESSION);                                                                     \
    }                                                                                          \
    break

#define INTEGERS_JOIN(T)                                                                       \
    {                                                                                          \
        const T sign = (T)((u128)sign_bit.hi << 64 | sign_bit.lo),                             \
                mask = (T)((u128)ones.hi << 64 | ones.lo);                                     \
        switch (combiner) {                                                                    \
        case MACHINE_COMBINE_AND:                                                              \
            JOIN(T, a &b);                                                                     \
        case MACHINE_COMBINE_OR:                                                               \
            JOIN(T, a | b);                                                                    \
        case MACHINE_COMBINE_XOR:                                                              \
            JOIN(T, a ^ b);                                                                    \
        case MACHINE_COMBINE_ADD:                                                              \
            JOIN(T, (T)((a + b) & mask));                                                      \
        case MACHINE_COMBINE_UMIN:                                                             \
            JOIN(T, b < a ? b : a);                                                            \
        case MACHINE_COMBINE_UMAX:                                                             \
            JOIN(T, b > a ? b : a);                                                            \
        case MACHINE_COMBINE_SMIN:                                                             \
            JOIN(T, (T)(b ^ sign) < (T)(a ^ sign) ? b : a);                                    \
        case MACHINE_COMBINE_SMAX:                                                             \
            JOIN(T, (T)(b ^ sign) > (T)(a ^ sign) ? b : a);                                    \
        case MACHINE_COMBINE_OVERWRITE: /* no whole numbers are combined so */                 \
        case MACHINE_COMBINE_FADD:                                                             \
        case MACHINE_COMBINE_FMIN:                                                             \
        case MACHINE_COMBINE_FMAX:                                                             \
            INVARIANT(false);                                                                  \
        }                                                                                      \
    }

static void integers_join(const struct hops *h, enum machine_combiner combiner,
                          struct machine_type type, const void *from, size_t at, void *out)
{
    const struct machine_scalar sign_bit = scalar_sign(type.width),
                                ones = scalar_ones(type.width);
    switch (type_bytes(type)) {
    case 1:
        INTEGERS_JOIN(uint8_t)
        break;
    case 2:
        INTEGERS_JOIN(uint16_t)
        break;
    case 4:
        INTEGERS_JOIN(uint32_t)
        break;
    case 8:
        INTEGERS_JOIN(uint64_t)
        break;
    default:
        INTEGERS_JOIN(u128)
    }
}

static inline float quiet_float(float x)
{
    const uint32_t bits = NAN_32;
    float nan;
    memcpy(&nan, &bits, sizeof nan);
    return x == x ? x : nan;
}

static inline double quiet_double(double x)
{
    const uint64_t bits = NAN_64;
    double nan;
    memcpy(&nan, &bits, sizeof nan);
    return x == x ? x : nan;
}

#define FLOATS_JOIN(T)                                                                         \
    switch (combiner) {                                                                        \
    case MACHINE_COMBINE_FADD:                                                                 \
        JOIN(T, quiet_##T(a + b));                                                             \
    case MACHINE_COMBINE_FMIN:                                                                 \
        JOIN(T, quiet_##T(a < b ? a : b));                                                     \
    case MACHINE_COMBINE_FMAX:                                                                 \
        JOIN(T, quiet_##T(a > b ? a : b));                                                     \
    case MACHINE_COMBINE_OVERWRITE: /* no floats are combined so */                            \
    case MACHINE_COMBINE_AND:                                                                  \
    case MACHINE_COMBINE_OR:                                                                   \
    case MACHINE_COMBINE_XOR:                                                                  \
    case MACHINE_COMBINE_ADD:                                                                  \
    case MACHINE_COMBINE_UMIN:                                                                 \
    case MACHINE_COMBINE_UMAX:                                                                 \
    case MACHINE_COMBINE_SMIN:                                                                 \
    case MACHINE_COMBINE_SMAX:                                                                 \
        INVARIANT(false);                                                                      \
    }

static void floats_join(const struct hops *h, enum machine_combiner combiner,
                        struct machine_type type, const void *from, size_t at, void *out)
{
    if (type.width == 32)
        FLOATS_JOIN(float)
    else
        FLOATS_JOIN(double)
}

#define MOVE_ALL(T)                                                                            \
    {                                                                                          \
        const T *in = (const T *)source + from;                                                \
        T *to = (T *)out + r->to->halo;                                                        \
        int i = 0;                                                                             \
        for (; i < fetched; i++) {                                                             \
            __builtin_prefetch(to + (index[i + MESSAGES_AHEAD] & mask), 1, 3);                 \
            to[index[i] & mask] = in[i];                                                       \
        }                                                                                      \
        for (; i < n; i++)                                                                     \
            to[index[i] & mask] = in[i];                                                       \
    }

/* All of a block's messages to a set of one row. False: somebody does not send, or to nobody;
 * nothing has been done. */
static bool messages_move_all(const struct near_route *r, const struct block *b, size_t bytes,
                              const void *source, size_t from, void *out)
{
    uint32_t found[BLOCK + MESSAGES_AHEAD];
    const uint32_t *index = found, mask = r->mask;
    const int n = b->n, known = b->follow < MESSAGES_AHEAD ? n + b->follow : n + MESSAGES_AHEAD;
    const size_t at = b->at;
    if (r->context || r->to->rows > 1)
        return false;
    if (r->there && r->address_bytes == sizeof *index)
        index = (const uint32_t *)r->address->host + at;
    else
        near_addresses(r, at, known, found);
    if (!r->there && r->lanes->greatest(found, NULL, known) >= r->to->count)
        return false;
    const int fetched = known > MESSAGES_AHEAD && r->to->count * bytes > r->near_bytes
                            ? known - MESSAGES_AHEAD
                            : 0;
    switch (bytes) {
    case 1:
        MOVE_ALL(uint8_t)
        break;
    case 2:
        MOVE_ALL(uint16_t)
        break;
    case 4:
        MOVE_ALL(uint32_t)
        break;
    case 8:
        MOVE_ALL(uint64_t)
        break;
    default:
        MOVE_ALL(u128)
    }
    return true;
}

/* One part of a send, of a get, or of a count. */
struct routing {
    const struct near_route *r;
    enum machine_combiner combiner;
    struct machine_type type;
    size_t bytes;
    const void *source;
    bool same; /* all send the same, which a block of the source is full of */
    void *out;
    unsigned char *arrived;
    uint64_t wrong[CREW_MOST]; /* for each thread */
};

/* Where a block's messages are. */
static size_t messages_at(const struct routing *g, const struct block *b)
{
    return g->same ? 0 : b->at;
}

static void part_send(void *of, int part, int worker)
{
    const struct routing *g = of;
    const struct near_route *r = g->r;
    /* Each part has some of the destinations, or where no two messages go to the same one, some
     * of the senders. */
    const uint64_t count = r->to->count, parts = r->distinct ? 1 : (uint64_t)r->parts,
                   own = r->distinct ? 0 : (uint64_t)part;
    const struct range to = {count * own / parts, count * (own + 1) / parts},
                       blocks = r->distinct ? blocks_of_part(r, part)
                                            : (struct range){0, blocks_count(r)};
    struct hops h;
    (void)worker;
    for (uint64_t i = blocks.first; i < blocks.end; i++) {
        const struct block b = block_get(r, i);
        bool moves = g->combiner == MACHINE_COMBINE_OVERWRITE;
        const size_t from = messages_at(g, &b);
        if (moves && !g->arrived && parts == 1 &&
            messages_move_all(r, &b, g->bytes, g->source, from, g->out))
            continue;
        hops_find(r, &to, b.at, b.n, part == 0 || r->distinct, &h);
        if (moves)
            messages_move(&h, g->bytes, g->source, from, g->out);
        else if (g->type.kind == MACHINE_FLOAT)
            floats_join(&h, g->combiner, g->type, g->source, from, g->out);
        else
            integers_join(&h, g->combiner, g->type, g->source, from, g->out);
        for (size_t k = 0; g->arrived && k < h.count; k++)
            g->arrived[h.place[k]] = 1;
    }
}

void near_send(const struct near_route *r, enum machine_combiner combiner,
               struct machine_type type, const struct machine_value *source,
               struct device_buffer *out, struct device_buffer *arrived)
{
    _Alignas(16) unsigned char number[BLOCK * 16];
    const bool same = source->op == NODE_CONSTANT && !source->buffer;
    if (same)
        array_fill(number, (const uint64_t[2]){source->imm.lo, source->imm.hi},
                   type_bytes(type), BLOCK);
    struct routing g = {.r = r,
                        .combiner = combiner,
                        .type = type,
                        .bytes = type_bytes(type),
                        .source = same ? number : source->buffer->host,
                        .same = same,
                        .out = out->host,
                        .arrived = arrived ? arrived->host : NULL};
    const bool whole = combiner != MACHINE_COMBINE_OVERWRITE && type.kind != MACHINE_FLOAT;
    if (arrived || !whole || !near_send_few(r, combiner, type, g.source, same, g.out))
        crew_run(r->crew, r->parts, part_send, &g);
    near_rows_repeat(r->to, g.bytes, out);
    if (arrived)
        near_rows_repeat(r->to, 1, arrived);
}

/* ---- gets ---- */

#define FETCH(T)                                                                               \
    {                                                                                          \
        T *to = (T *)out + at;                                                                 \
        for (size_t i = 0; i < h->count; i++)                                                  \
            to[h->lane[i]] = ((const T *)from)[h->place[i]];                                   \
    }

static void messages_fetch(const struct hops *h, size_t bytes, const void *from, size_t at,
                           void *out)
{
    switch (bytes) {
    case 1:
        FETCH(uint8_t)
        break;
    case 2:
        FETCH(uint16_t)
        break;
    case 4:
        FETCH(uint32_t)
        break;
    case 8:
        FETCH(uint64_t)
        break;
    default:
        FETCH(u128)
    }
}

static void part_get(void *of, int part, int worker)
{
    const struct routing *g = of;
    const struct range all = {0, g->r->to->count};
    struct hops h;
    const struct range blocks = blocks_of_part(g->r, part);
    (void)worker;
    for (uint64_t i = blocks.first; i < blocks.end; i++) {
        const struct block b = block_get(g->r, i);
        hops_find(g->r, &all, b.at, b.n, false, &h);
        if (h.count < (size_t)b.n)
            memset((char *)g->out + b.at * g->bytes, 0, (size_t)b.n * g->bytes);
        messages_fetch(&h, g->bytes, g->source, b.at, g->out);
    }
}

void near_get(const struct near_route *r, size_t bytes, const struct device_buffer *source,
              struct device_buffer *out)
{
    struct routing g = {.r = r, .bytes = bytes, .source = source->host, .out = out->host};
    crew_run(r->crew, r->parts, part_get, &g);
    near_rows_repeat(r->from, bytes, out);
}

static void part_count(void *of, int part, int worker)
{
    struct routing *g = of;
    const unsigned char *context = g->r->context ? g->r->context->host : NULL;
    const struct range all = {0, g->r->to->count};
    struct hops h;
    const struct range blocks = blocks_of_part(g->r, part);
    for (uint64_t i = blocks.first; i < blocks.end; i++) {
        const struct block b = block_get(g->r, i);
        hops_find(g->r, &all, b.at, b.n, false, &h);
        uint64_t active = context ? 0 : (uint64_t)b.n;
        for (int k = 0; context && k < b.n; k++)
            active += context[b.at + (size_t)k] != 0;
        g->wrong[worker] += active - h.count;
    }
}

uint64_t near_wrong(const struct near_route *r)
{
    struct routing g = {.r = r};
    uint64_t wrong = 0;
    crew_run(r->crew, r->parts, part_count, &g);
    for (int i = 0; i < CREW_MOST; i++)
        wrong += g.wrong[i];
    return wrong;
}

bool near_all_there(const struct near_route *r)
{
    uint32_t index[BLOCK];
    for (uint64_t i = 0; i < blocks_count(r); i++) {
        const struct block b = block_get(r, i);
        near_addresses(r, b.at, b.n, index);
        if (r->lanes->greatest(index, NULL, b.n) >= r->to->count)
            return false;
    }
    return true;
}

bool near_are_distinct(const struct near_route *r)
{
    uint32_t index[BLOCK];
    const uint64_t count = r->to->count;
    uint64_t *taken = r->from->count > count ? NULL : calloc(count / 64 + 1, sizeof *taken);
    uint64_t twice = taken ? 0 : 1;
    for (uint64_t i = 0; i < blocks_count(r) && !twice; i++) {
        const struct block b = block_get(r, i);
        near_addresses(r, b.at, b.n, index);
        for (int k = 0; k < b.n; k++) {
            const uint64_t bit = UINT64_C(1) << index[k] % 64;
            twice |= taken[index[k] / 64] & bit;
            taken[index[k] / 64] |= bit;
        }
    }
    free(taken);
    return !twice;
}
