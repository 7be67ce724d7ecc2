/* near_shapes.c - see near_shapes.h. */
#include "run/near_shapes.h"

#include <stdlib.h>
#include <string.h>

#include "base/errors.h"
#include "machine_layout.h"
#include "watch/watch.h"

typedef unsigned __int128 u128;

static const uint32_t NOBODY = UINT32_MAX;

/* Where the processors of a set live, and where in an array of it they are. */
struct homes {
    const struct vpset *set;
    uint32_t *steps;   /* by VP: from the index of (p, 0) to that of (p, r) */
    bool subgrids;     /* ... without carry */
    bool dealt;        /* (p, 0) is p; else p * ratio, or with subgrids what that stands for */
    uint32_t bits[32]; /* subgrids: the index that each bit of an address stands for */
};

static uint32_t linear(const uint32_t *bits, uint32_t x)
{
    uint32_t sum = 0;
    for (; x; x &= x - 1)
        sum ^= bits[__builtin_ctz(x)];
    return sum;
}

static bool homes_make(const struct machine *m, struct homes *h, const struct vpset *s)
{
    *h = (struct homes){.set = s,
                        .steps = malloc((size_t)s->ratio * sizeof *h->steps),
                        .subgrids = s->layout.blocks,
                        .dealt = !s->layout.blocks && s->layout.order != MACHINE_SEND_ORDER};
    for (int i = 0; h->subgrids && UINT64_C(1) << i < s->count; i++)
        h->bits[i] = (uint32_t)machine_layout_index(&s->layout, UINT64_C(1) << i);
    for (uint32_t r = 0; h->steps && r < s->ratio; r++)
        h->steps[r] = h->subgrids ? linear(h->bits, r)
                      : h->dealt  ? r << m->values->processors_log2
                                  : r;
    return h->steps != NULL;
}

/* The index of (p, 0); NOBODY: the processor has no VP. */
static uint32_t base_of(const struct homes *h, uint64_t p)
{
    const uint64_t first = h->dealt ? p : p * h->set->ratio;
    return first >= h->set->count ? NOBODY
           : h->subgrids          ? linear(h->bits, (uint32_t)first)
                                  : (uint32_t)first;
}

static inline uint32_t index_of(const struct homes *h, uint32_t base, uint32_t r)
{
    if (base == NOBODY || r >= h->set->ratio)
        return NOBODY;
    const uint32_t n = h->subgrids ? base ^ h->steps[r] : base + h->steps[r];
    return n < h->set->count ? n : NOBODY;
}

/* How an array of the set lies in memory. Loops have copies of their own: what they store
 * cannot change these. */
struct grid {
    uint32_t width, halo;
    size_t pitch;
};

static struct grid grid_of(const struct vpset *s)
{
    return (struct grid){(uint32_t)s->width, (uint32_t)s->halo, s->pitch};
}

/* An element of an array; column: in its row. */
static inline size_t place_of(const struct grid *g, uint32_t n, uint32_t *column)
{
    const uint32_t row = n < g->width ? 0 : n / g->width;
    *column = n - row * g->width;
    return row * g->pitch + g->halo + *column;
}

/* Stores an element, and its copy at the other end of its row. */
#define STORE(T, g, array, n, v)                                                               \
    do {                                                                                       \
        uint32_t column_;                                                                      \
        T *at_ = (T *)(array) + place_of(g, n, &column_);                                      \
        const T value_ = (T)(v);                                                               \
        *at_ = value_;                                                                         \
        if (column_ < (g)->halo)                                                               \
            at_[(g)->width] = value_;                                                          \
        if (column_ + (g)->halo >= (g)->width)                                                 \
            at_[-(ptrdiff_t)(g)->width] = value_;                                              \
    } while (0)

#define LOAD(T, g, array, n) ((n) == NOBODY ? 0 : ((const T *)(array))[place_in(g, n)])

static inline size_t place_in(const struct grid *g, uint32_t n)
{
    uint32_t column;
    return place_of(g, n, &column);
}

static inline u128 element_of(const struct grid *g, const void *array, size_t bytes, uint32_t n)
{
    switch (bytes) {
    case 1:
        return LOAD(uint8_t, g, array, n);
    case 2:
        return LOAD(uint16_t, g, array, n);
    case 4:
        return LOAD(uint32_t, g, array, n);
    case 8:
        return LOAD(uint64_t, g, array, n);
    default:
        return LOAD(u128, g, array, n);
    }
}

/* ---- what is shared out ---- */

struct shape_work {
    struct homes fine, coarse;
    uint64_t processors;
    int parts_count;
    uint32_t k, first, count, wanted, parts, width;
    size_t whole, element;
    const void *in[SLICES_BLOCK];
    void *out[SLICES_BLOCK];
    struct near_view view;
    bool put;
};

/* The physical processors of a part. */
static uint64_t part_begin(const struct shape_work *w, int part)
{
    return w->processors * (uint64_t)part / (uint64_t)w->parts_count;
}

/* elements: moved, in all. */
static void share(struct machine *m, struct shape_work *w, crew_part *part, double elements,
                  const char *what)
{
    double start = m->watch ? clock_s() : device_work_begin(m);
    w->processors = (uint64_t)m->values->processors_count;
    w->parts_count = device_parts(m, 1e-9 * m->device->shape.reshape_ns * elements);
    if ((uint64_t)w->parts_count > w->processors)
        w->parts_count = (int)w->processors;
    crew_run(m->device->crew, w->parts_count, part, w);
    device_work_end(m, start);
    if (m->watch)
        watch_near(m, what, start);
}

/* ---- slices ---- */

#define SLICES(T)                                                                              \
    static void slices_##T(const struct shape_work *w, uint64_t p, uint64_t end)               \
    {                                                                                          \
        const struct homes fine = w->fine, coarse = w->coarse;                                 \
        const struct grid from = grid_of(fine.set), to = grid_of(coarse.set);                  \
        const uint32_t k = w->k, first = w->first, count = w->count, wanted = w->wanted;       \
        const uint32_t ratio = (uint32_t)coarse.set->ratio;                                    \
        const T *in = w->in[0];                                                                \
        void *out[SLICES_BLOCK];                                                               \
        memcpy(out, w->out, sizeof out);                                                       \
        for (; p < end; p++) {                                                                 \
            const uint32_t there = base_of(&fine, p), here = base_of(&coarse, p);              \
            for (uint32_t j = 0; j < ratio; j++) {                                             \
                const uint32_t n = index_of(&coarse, here, j);                                 \
                for (uint32_t i = 0; n != NOBODY && i < count; i++) {                          \
                    if (!(wanted >> i & 1))                                                    \
                        continue;                                                              \
                    const uint32_t q = index_of(&fine, there, j * k + first + i);              \
                    STORE(T, &to, out[i], n, LOAD(T, &from, in, q));                           \
                }                                                                              \
            }                                                                                  \
        }                                                                                      \
    }
SLICES(uint8_t)
SLICES(uint16_t)
SLICES(uint32_t)
SLICES(uint64_t)
SLICES(u128)

/* Calls the function that is made for elements of that size. */
#define BY_ELEMENT(bytes, function, ...)                                                       \
    ((bytes) == 1   ? function##_uint8_t(__VA_ARGS__)                                          \
     : (bytes) == 2 ? function##_uint16_t(__VA_ARGS__)                                         \
     : (bytes) == 4 ? function##_uint32_t(__VA_ARGS__)                                         \
     : (bytes) == 8 ? function##_uint64_t(__VA_ARGS__)                                         \
                    : function##_u128(__VA_ARGS__))

static void slices_part(void *of, int part, int worker)
{
    const struct shape_work *w = of;
    (void)worker;
    BY_ELEMENT(w->element, slices, w, part_begin(w, part), part_begin(w, part + 1));
}

/* ---- weaving ---- */

/* Words of one part are as long as elements. */
#define WEAVE(T)                                                                               \
    static void weave_##T(const struct shape_work *w, uint64_t p, uint64_t end)                \
    {                                                                                          \
        const struct homes fine = w->fine, coarse = w->coarse;                                 \
        const struct grid from = grid_of(coarse.set), to = grid_of(fine.set);                  \
        const uint32_t k = w->k, first = w->first, count = w->count, parts = w->parts;         \
        const uint32_t ratio = (uint32_t)coarse.set->ratio, width = w->width;                  \
        const size_t whole = w->whole;                                                         \
        const T mask = (T)(width >= 8 * sizeof(T) ? ~(u128)0 : ((u128)1 << width) - 1);        \
        T *const out = w->out[0];                                                              \
        const void *in[SLICES_BLOCK];                                                          \
        memcpy(in, w->in, sizeof in);                                                          \
        for (; p < end; p++) {                                                                 \
            const uint32_t there = base_of(&fine, p), here = base_of(&coarse, p);              \
            for (uint32_t j = 0; j < ratio; j++) {                                             \
                const uint32_t n = index_of(&coarse, here, j);                                 \
                uint32_t e = first;                                                            \
                for (uint32_t i = 0; i < count && parts == 1; i++, e++) {                      \
                    const uint32_t q = index_of(&fine, there, j * k + e);                      \
                    if (q != NOBODY)                                                           \
                        STORE(T, &to, out, q, LOAD(T, &from, in[i], n));                       \
                }                                                                              \
                for (uint32_t i = 0; i < count && parts > 1; i++) {                            \
                    u128 word = element_of(&from, in[i], whole, n);                            \
                    for (uint32_t t = 0; t < parts && e < k; t++, e++, word >>= width) {       \
                        const uint32_t q = index_of(&fine, there, j * k + e);                  \
                        if (q != NOBODY)                                                       \
                            STORE(T, &to, out, q, (T)word &mask);                              \
                    }                                                                          \
                }                                                                              \
            }                                                                                  \
        }                                                                                      \
    }
WEAVE(uint8_t)
WEAVE(uint16_t)
WEAVE(uint32_t)
WEAVE(uint64_t)
WEAVE(u128)

static void weave_part(void *of, int part, int worker)
{
    const struct shape_work *w = of;
    (void)worker;
    BY_ELEMENT(w->element, weave, w, part_begin(w, part), part_begin(w, part + 1));
}

/* ---- an image of the memory ---- */

static uint64_t image_read(const uint32_t *image, uint32_t at, uint32_t width)
{
    uint64_t v = 0;
    for (uint32_t done = 0, n; done < width; done += n) {
        const uint32_t bit = (at + done) % 32;
        n = 32 - bit < width - done ? 32 - bit : width - done;
        v |= (uint64_t)(image[(at + done) / 32] >> bit & ((UINT64_C(1) << n) - 1)) << done;
    }
    return v;
}

static void image_write(uint32_t *image, uint32_t at, uint32_t width, uint64_t v)
{
    for (uint32_t done = 0, n; done < width; done += n) {
        const uint32_t bit = (at + done) % 32, i = (at + done) / 32;
        n = 32 - bit < width - done ? 32 - bit : width - done;
        const uint32_t mask = (uint32_t)((UINT64_C(1) << n) - 1) << bit;
        image[i] = (image[i] & ~mask) | ((uint32_t)(v >> done) << bit & mask);
    }
}

static void element_put(const struct grid *g, void *array, size_t bytes, uint32_t n, u128 v)
{
    if (bytes == 1)
        STORE(uint8_t, g, array, n, v);
    else if (bytes == 2)
        STORE(uint16_t, g, array, n, v);
    else if (bytes == 4)
        STORE(uint32_t, g, array, n, v);
    else if (bytes == 8)
        STORE(uint64_t, g, array, n, v);
    else
        STORE(u128, g, array, n, v);
}

static void image_processor(const struct shape_work *w, uint64_t p)
{
    const struct near_view *v = &w->view;
    const struct grid g = grid_of(w->coarse.set);
    const uint32_t base = base_of(&w->coarse, p), low = v->width < 64 ? v->width : 64;
    uint32_t *memory = (uint32_t *)w->out[0] + (size_t)p * v->words;
    for (uint32_t r = 0; r < w->coarse.set->ratio; r++) {
        const uint32_t n = index_of(&w->coarse, base, r),
                       at = v->start + r / v->parts * v->outer + r % v->parts * v->inner;
        if (w->put) {
            const u128 x = element_of(&g, w->in[0], w->element, n);
            image_write(memory, at, low, (uint64_t)x);
            image_write(memory, at + 64, v->width - low, (uint64_t)(x >> 64));
        } else if (n != NOBODY) {
            const u128 high = image_read(memory, at + 64, v->width - low);
            element_put(&g, w->out[1], w->element, n, high << 64 | image_read(memory, at, low));
        }
    }
}

static void image_part(void *of, int part, int worker)
{
    const struct shape_work *w = of;
    (void)worker;
    for (uint64_t p = part_begin(w, part); p < part_begin(w, part + 1); p++)
        image_processor(w, p);
}

/* ---- the calls ---- */

static bool homes_of_both(const struct machine *m, struct shape_work *w,
                          const struct vpset *fine, const struct vpset *coarse)
{
    return homes_make(m, &w->coarse, coarse) && (!fine || homes_make(m, &w->fine, fine));
}

static void homes_free(struct shape_work *w)
{
    free(w->fine.steps);
    free(w->coarse.steps);
}

bool near_slices(struct machine *m, const struct vpset *fine, const struct vpset *coarse,
                 const struct slices_taken *t, const struct device_buffer *in,
                 struct device_buffer *const out[SLICES_BLOCK])
{
    struct shape_work w = {.k = t->k,
                           .first = t->first,
                           .count = t->count,
                           .wanted = t->wanted,
                           .element = type_bytes(t->type),
                           .in = {in->host}};
    bool good = device_is_near(m, in) && homes_of_both(m, &w, fine, coarse);
    for (uint32_t i = 0; i < t->count; i++)
        w.out[i] = out[i] ? out[i]->host : NULL;
    if (good)
        share(m, &w, slices_part,
              (double)__builtin_popcount(t->wanted) * (double)w.coarse.set->count, "slices");
    homes_free(&w);
    return good;
}

bool near_weave(struct machine *m, const struct vpset *fine, const struct vpset *coarse,
                uint32_t k, uint32_t first, uint32_t count, uint32_t parts, uint32_t width,
                size_t whole, const struct device_buffer *const in[SLICES_BLOCK],
                size_t element, const struct device_buffer *out)
{
    struct shape_work w = {.k = k,
                           .first = first,
                           .count = count,
                           .parts = parts,
                           .width = width,
                           .whole = whole,
                           .element = element,
                           .out = {out->host}};
    bool good = device_is_near(m, out) && homes_of_both(m, &w, fine, coarse);
    for (uint32_t i = 0; i < count; i++)
        w.in[i] = in[i]->host;
    if (good)
        share(m, &w, weave_part, (double)count * parts * (double)w.coarse.set->count, "weave");
    homes_free(&w);
    return good;
}

bool near_image(struct machine *m, const struct vpset *set, const struct near_view *view,
                bool put, size_t element, const struct device_buffer *value,
                const struct device_buffer *image)
{
    struct shape_work w = {.view = *view,
                           .put = put,
                           .element = element,
                           .in = {value->host},
                           .out = {image->host, value->host}};
    bool good = device_is_near(m, image) && homes_of_both(m, &w, NULL, set);
    if (good)
        share(m, &w, image_part, (double)w.coarse.set->count, put ? "put" : "get");
    homes_free(&w);
    return good;
}
