/* near_pack.c - see near_pack.h.
 *
 * Each part has some of the elements. How many are active in each says where each begins to
 * write.
 *
 *     context    1 0 1 1 | 0 0 1 0 | 1 1 0 1       3, 1, 3: the parts write from 0, 3, 4 on */
#include "ops/near_pack.h"

#include <string.h>

#include "base/arrays.h"
#include "interpret/lanes.h"

enum { PARTS_MOST = 64 };

struct packing {
    const uint8_t *context;
    const char *from; /* NULL: a number */
    char *to;
    size_t bytes, count;
    int parts;
    const char *old;               /* of packs: what lies behind them; NULL: a number, */
    uint64_t fill[2];              /* ... this one */
    uint32_t number, first, mask;  /* of ranks */
    size_t begins[PARTS_MOST + 1]; /* how many are active before each part */
};

static size_t first_of(const struct packing *p, int part)
{
    return p->count * (size_t)part / (size_t)p->parts;
}

static void part_count(void *of, int part, int worker)
{
    struct packing *p = of;
    const uint8_t *context = p->context;
    const size_t end = first_of(p, part + 1);
    size_t active = 0;
    (void)worker;
    for (size_t i = first_of(p, part); i < end;) {
        const size_t most = end - i < 255 ? end : i + 255;
        uint8_t few = 0; /* so as many lanes as there are bytes in a vector */
        for (; i < most; i++)
            few = (uint8_t)(few + (context[i] != 0));
        active += few;
    }
    p->begins[part + 1] = active;
}

static void part_pack(void *of, int part, int worker)
{
    const struct packing *p = of;
    const size_t first = first_of(p, part), begin = p->begins[part];
    (void)worker;
    lanes_table()->pack(p->from + first * p->bytes, p->context + first,
                        first_of(p, part + 1) - first, p->bytes, p->to + begin * p->bytes,
                        p->begins[part + 1] - begin);
}

/* What lies behind all that is packed: of `old`. */
static void part_rest(void *of, int part, int worker)
{
    const struct packing *p = of;
    const size_t packed = p->begins[p->parts], rest = p->count - packed,
                 first = packed + rest * (size_t)part / (size_t)p->parts,
                 end = packed + rest * (size_t)(part + 1) / (size_t)p->parts;
    (void)worker;
    if (p->old)
        memcpy(p->to + first * p->bytes, p->old + first * p->bytes, (end - first) * p->bytes);
    else
        array_fill(p->to + first * p->bytes, p->fill, p->bytes, end - first);
}

static void part_number(void *of, int part, int worker)
{
    const struct packing *p = of;
    const size_t first = first_of(p, part);
    const struct lanes_ranks r = {
        p->context + first, p->from ? (const uint32_t *)(const void *)p->from + first : NULL,
        (uint32_t *)(void *)p->to + first, p->number, p->mask};
    (void)worker;
    lanes_table()->ranks(&r, first_of(p, part + 1) - first,
                         (uint32_t)p->begins[part] + p->first);
}

/* Counts what is active in each part, and before it. */
static void parts_count(struct crew *crew, struct packing *p)
{
    p->begins[0] = 0;
    crew_run(crew, p->parts, part_count, p);
    for (int i = 0; i < p->parts; i++)
        p->begins[i + 1] += p->begins[i];
}

static void row_repeat(char *row, size_t width, size_t halo)
{
    memcpy(row - halo, row + width - halo, halo);
    memcpy(row + width, row, halo);
}

void near_pack(struct crew *crew, int parts, const struct vpset *s, size_t bytes,
               const struct device_buffer *context, const struct device_buffer *from,
               const struct machine_value *old, struct device_buffer *out)
{
    const size_t column = (size_t)s->halo, halo = column * bytes, width = (size_t)s->width;
    struct packing p = {.context = (const uint8_t *)context->host + column,
                        .from = (const char *)from->host + halo,
                        .to = (char *)out->host + halo,
                        .old = old->buffer ? (const char *)old->buffer->host + halo : NULL,
                        .fill = {old->imm.lo, old->imm.hi},
                        .bytes = bytes,
                        .count = width,
                        .parts = parts < PARTS_MOST ? parts : PARTS_MOST};
    parts_count(crew, &p);
    crew_run(crew, p.parts, part_pack, &p);
    crew_run(crew, p.parts, part_rest, &p);
    row_repeat(p.to, width * bytes, halo);
}

void near_enumerate(struct crew *crew, int parts, const struct vpset *s,
                    const struct device_buffer *context, const struct machine_value *old,
                    uint32_t first, uint32_t mask, struct device_buffer *out)
{
    const size_t bytes = sizeof(uint32_t), column = (size_t)s->halo, halo = column * bytes;
    struct packing p = {.context = (const uint8_t *)context->host + column,
                        .from = old->buffer ? (const char *)old->buffer->host + halo : NULL,
                        .to = (char *)out->host + halo,
                        .bytes = bytes,
                        .count = (size_t)s->width,
                        .parts = parts < PARTS_MOST ? parts : PARTS_MOST,
                        .number = (uint32_t)old->imm.lo,
                        .first = first,
                        .mask = mask};
    parts_count(crew, &p);
    crew_run(crew, p.parts, part_number, &p);
    row_repeat(p.to, p.count * bytes, halo);
}
