/* near_rank.c - see near_rank.h: a radix sort from the lowest digit up, of keys with their places in the line. */
#include "ops/near_rank.h"

#include <stdlib.h>
#include <string.h>

#include "device/device.h"
#include "ops/near_lines.h"

enum { DIGIT_MOST = 11 };

/* A key's word above, its place in the line below. */
typedef uint64_t pair;

struct ranking {
    const struct lines *l;
    const struct near_word *words;
    int count, parts, digit;
    size_t lines;
    uint32_t *ranks;
    pair *pairs[CREW_MOST]; /* of each thread: twice a line's */
};

/* One digit; false: all have the same one, and nothing has been moved. */
static bool digit_sort(const pair *from, pair *to, size_t n, int shift, int bits)
{
    size_t place[1 << DIGIT_MOST] = {0}, sum = 0;
    const uint32_t mask = (1u << bits) - 1;
    for (size_t i = 0; i < n; i++)
        place[(uint32_t)(from[i] >> 32) >> shift & mask]++;
    if (place[(uint32_t)(from[0] >> 32) >> shift & mask] == n)
        return false;
    for (uint32_t d = 0; d <= mask; d++) {
        size_t here = place[d];
        place[d] = sum;
        sum += here;
    }
    for (size_t i = 0; i < n; i++)
        to[place[(uint32_t)(from[i] >> 32) >> shift & mask]++] = from[i];
    return true;
}

static void line_rank(const struct ranking *g, size_t row, pair *pairs)
{
    const size_t n = (size_t)g->l->length, step = (size_t)g->l->step;
    pair *from = pairs, *to = pairs + n;
    for (size_t k = 0; k < n; k++)
        from[k] = k;
    for (int i = 0; i < g->count; i++) {
        const struct near_word *w = &g->words[i];
        for (size_t k = 0; k < n; k++)
            from[k] = (uint32_t)from[k] | (pair)w->word[row + (size_t)(uint32_t)from[k] * step]
                                              << 32;
        for (int shift = 0, bits; shift < w->bits; shift += bits) {
            bits = w->bits - shift < g->digit ? w->bits - shift : g->digit;
            if (digit_sort(from, to, n, shift, bits)) {
                pair *kept = from;
                from = to;
                to = kept;
            }
        }
    }
    for (size_t k = 0; k < n; k++)
        g->ranks[row + (size_t)(uint32_t)from[k] * step] = (uint32_t)k;
}

static void part_rank(void *of, int part, int worker)
{
    const struct ranking *g = of;
    size_t first = g->lines * (size_t)part / (size_t)g->parts,
           end = g->lines * (size_t)(part + 1) / (size_t)g->parts,
           columns = (size_t)g->l->columns;
    for (size_t i = first; i < end; i++)
        line_rank(g, near_lines_row(g->l, i / columns) + i % columns, g->pairs[worker]);
}

bool near_rank(const struct device *d, int parts, const struct lines *l,
               const struct near_word *words, int count, struct device_buffer *out)
{
    struct ranking g = {.l = l,
                        .words = words,
                        .count = count,
                        .parts = parts,
                        .digit = shape_sort_digit(&d->shape, l->length),
                        .lines = lines_count(l),
                        .ranks = out->host};
    bool good = true;
    for (int i = 0; i < crew_size(d->crew) && good && (i == 0 || parts > 1); i++)
        good = (g.pairs[i] = malloc(2 * (size_t)l->length * sizeof(pair))) != NULL;
    if (good) {
        crew_run(d->crew, parts, part_rank, &g);
        near_lines_repeat(l, out->host, sizeof *g.ranks);
    }
    for (int i = 0; i < CREW_MOST; i++)
        free(g.pairs[i]);
    return good;
}
