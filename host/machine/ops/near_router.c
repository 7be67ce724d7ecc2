/* near_router.c - see near_router.h.
 *
 * A block of senders at a time: their addresses become places in the array of the other set, without those who do not send; then
 * the messages go, in the order of the senders. So no loop has a branch that could not be predicted. Of a send each part has some of
 * the destinations, and passes all senders; of a get, some of the blocks.
 *
 *     addresses      5  1  -  7        (-: not active)
 *     hops           place 5, lane 0 | place 1, lane 1 | place 7, lane 3 */
#include "ops/near_router.h"

#include <string.h>

#include "base/scalar.h"
#include "base/types.h"
#include "values/geometry.h"

enum { BLOCK = 512 };

typedef unsigned __int128 u128;

/* The destinations of a part: their indices. */
struct range {
    uint64_t first, end;
};

struct hops {
    size_t count;
    uint32_t place[BLOCK]; /* in the other set's array */
    uint16_t lane[BLOCK];  /* in the block */
    uint64_t wrong;        /* active, and to a processor that does not exist */
    bool whole;            /* lane[i] is i */
};

/* Divides by a number that stays the same, up to 2^31: see kernels/router.cl. */
struct divisor {
    uint64_t factor;
    unsigned shift;
    uint32_t by;
};

static struct divisor divisor_of(uint64_t by)
{
    struct divisor d = {.by = (uint32_t)by, .shift = 31};
    while (UINT64_C(1) << (d.shift - 31) < by)
        d.shift++;
    d.factor = (UINT64_C(1) << d.shift) / by + 1;
    return d;
}

static inline uint32_t over(uint32_t n, struct divisor d)
{
    return (uint32_t)(n * d.factor >> d.shift);
}

/* ---- addresses ---- */

#define ADDRESSES(T)                                                                           \
    for (int i = 0; i < n; i++)                                                                \
    to[i] = (uint32_t)((const T *)in)[at + (size_t)i] & mask

static void addresses_read(const struct near_route *r, size_t at, int n, uint32_t *to)
{
    const void *in = r->address->host;
    const uint32_t mask = r->mask;
    switch (r->address_bytes) {
    case 1:
        ADDRESSES(uint8_t);
        break;
    case 2:
        ADDRESSES(uint16_t);
        break;
    case 4:
        ADDRESSES(uint32_t);
        break;
    case 8:
        ADDRESSES(uint64_t);
        break;
    default:
        ADDRESSES(u128);
    }
}

/* The active ones whose processor exists, one after the other. */
static void hops_pick(const struct near_route *r, const struct range *to, size_t at, int n,
                      const uint32_t *index, struct hops *h)
{
    const unsigned char *context = r->context ? r->context->host : NULL;
    const uint32_t first = (uint32_t)to->first, count = (uint32_t)(to->end - to->first);
    size_t picked = 0, active = 0;
    for (int i = 0; i < n; i++) {
        const bool on = !context || context[at + (size_t)i];
        h->place[picked] = index[i];
        h->lane[picked] = (uint16_t)i;
        active += on;
        picked += on & (index[i] - first < count);
    }
    h->count = picked;
    h->wrong = active - picked;
    h->whole = picked == (size_t)n;
}

static void places_find(const struct vpset *s, struct hops *h)
{
    const uint32_t halo = (uint32_t)s->halo, further = (uint32_t)(s->pitch - (size_t)s->width);
    if (s->rows == 1) {
        for (size_t i = 0; i < h->count; i++)
            h->place[i] += halo;
        return;
    }
    const struct divisor d = divisor_of((uint64_t)s->width);
    for (size_t i = 0; i < h->count; i++) {
        h->place[i] += halo + over(h->place[i], d) * further;
    }
}

/* Of n senders from that element on. */
static void hops_find(const struct near_route *r, const struct range *to, size_t at, int n,
                      struct hops *h)
{
    uint32_t index[BLOCK];
    addresses_read(r, at, n, index);
    hops_pick(r, to, at, n, index, h);
    places_find(r->to, h);
}

/* Blocks of the senders' rows, one after the other. All zero: before the first. */
struct block {
    uint64_t row;
    int x, n;
    size_t at; /* of its first element */
};

static bool block_next(const struct near_route *r, struct block *b)
{
    const struct vpset *s = r->from;
    b->x += b->n;
    if (b->x == s->width) {
        b->x = 0;
        b->row++;
    }
    b->n = s->width - b->x < BLOCK ? s->width - b->x : BLOCK;
    b->at = (size_t)b->row * s->pitch + (size_t)s->halo + (size_t)b->x;
    return b->row < s->rows;
}

/* The other end of each row, on both sides. */
static void rows_repeat(const struct vpset *s, size_t bytes, struct device_buffer *b)
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
        default:                                                                               \
            JOIN(T, (T)(b ^ sign) > (T)(a ^ sign) ? b : a);                                    \
        }                                                                                      \
    }

static void integers_join(const struct hops *h, int combiner, struct machine_type type,
                          const void *from, size_t at, void *out)
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
    default:                                                                                   \
        JOIN(T, quiet_##T(a > b ? a : b));                                                     \
    }

static void floats_join(const struct hops *h, int combiner, struct machine_type type,
                        const void *from, size_t at, void *out)
{
    if (type.width == 32)
        FLOATS_JOIN(float)
    else
        FLOATS_JOIN(double)
}

#define MOVE_ALL(T)                                                                            \
    {                                                                                          \
        const T *in = (const T *)from + at;                                                    \
        T *to = (T *)out + r->to->halo;                                                        \
        for (int i = 0; i < n; i++)                                                            \
            to[index[i]] = in[i];                                                              \
    }

/* All of a block's messages to a set of one row. False: somebody does not send, or to nobody; nothing has been done. */
static bool messages_move_all(const struct near_route *r, const struct block *b, size_t bytes,
                              const void *from, void *out)
{
    uint32_t index[BLOCK], greatest = 0;
    const int n = b->n;
    const size_t at = b->at;
    if (r->context || r->to->rows > 1)
        return false;
    addresses_read(r, at, n, index);
    for (int i = 0; i < n; i++)
        greatest = index[i] > greatest ? index[i] : greatest;
    if (greatest >= r->to->count)
        return false;
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
    int combiner;
    struct machine_type type;
    size_t bytes;
    const void *source;
    void *out;
    unsigned char *arrived;
    uint64_t wrong[CREW_MOST]; /* for each thread */
};

static void part_send(void *of, int part, int worker)
{
    const struct routing *g = of;
    const struct near_route *r = g->r;
    const uint64_t count = r->to->count, parts = (uint64_t)r->parts;
    const struct range to = {count * (uint64_t)part / parts,
                             count * (uint64_t)(part + 1) / parts};
    struct hops h;
    (void)worker;
    for (struct block b = {0}; block_next(r, &b);) {
        bool moves = g->combiner == MACHINE_COMBINE_OVERWRITE;
        if (moves && !g->arrived && parts == 1 &&
            messages_move_all(r, &b, g->bytes, g->source, g->out))
            continue;
        hops_find(r, &to, b.at, b.n, &h);
        if (moves)
            messages_move(&h, g->bytes, g->source, b.at, g->out);
        else if (g->type.kind == MACHINE_FLOAT)
            floats_join(&h, g->combiner, g->type, g->source, b.at, g->out);
        else
            integers_join(&h, g->combiner, g->type, g->source, b.at, g->out);
        for (size_t i = 0; g->arrived && i < h.count; i++)
            g->arrived[h.place[i]] = 1;
    }
}

void near_send(const struct near_route *r, int combiner, struct machine_type type,
               const struct device_buffer *source, struct device_buffer *out,
               struct device_buffer *arrived)
{
    struct routing g = {.r = r,
                        .combiner = combiner,
                        .type = type,
                        .bytes = type_bytes(type),
                        .source = source->host,
                        .out = out->host,
                        .arrived = arrived ? arrived->host : NULL};
    crew_run(r->crew, r->parts, part_send, &g);
    rows_repeat(r->to, g.bytes, out);
    if (arrived)
        rows_repeat(r->to, 1, arrived);
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

/* The blocks of a part: every parts-th, from that one on. */
static bool block_of_part(const struct near_route *r, struct block *b, int part)
{
    int before = b->n ? r->parts : part + 1;
    while (before--)
        if (!block_next(r, b))
            return false;
    return true;
}

static void part_get(void *of, int part, int worker)
{
    const struct routing *g = of;
    const struct range all = {0, g->r->to->count};
    struct hops h;
    (void)worker;
    for (struct block b = {0}; block_of_part(g->r, &b, part);) {
        hops_find(g->r, &all, b.at, b.n, &h);
        if (!h.whole)
            memset((char *)g->out + b.at * g->bytes, 0, (size_t)b.n * g->bytes);
        messages_fetch(&h, g->bytes, g->source, b.at, g->out);
    }
}

void near_get(const struct near_route *r, size_t bytes, const struct device_buffer *source,
              struct device_buffer *out)
{
    struct routing g = {.r = r, .bytes = bytes, .source = source->host, .out = out->host};
    crew_run(r->crew, r->parts, part_get, &g);
    rows_repeat(r->from, bytes, out);
}

static void part_count(void *of, int part, int worker)
{
    struct routing *g = of;
    const struct range all = {0, g->r->to->count};
    struct hops h;
    for (struct block b = {0}; block_of_part(g->r, &b, part);) {
        hops_find(g->r, &all, b.at, b.n, &h);
        g->wrong[worker] += h.wrong;
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
