/* near_rank.c - see near_rank.h: a radix sort from the lowest digit up, of keys with their
 * places in the line. */
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

/* ---- a line that all share ----
 *
 * As in kernels/sort.cl: each part of the line counts its digits; the counts, by digit and then
 * by part, are summed up and say where each part's first key of each digit goes; each part puts
 * its keys there in order, so that equal digits keep theirs. */

/* Of keys: the word itself, pairs of the digit before, the word at the places of such pairs. */
enum source { WORD, PAIR, GATHER };

struct sharing {
    const uint32_t *word; /* of the line's first processor */
    uint32_t *ranks;
    size_t n, step;
    int parts, shift, bits;
    enum source source;
    bool last; /* digit: ranks are written */
    pair *from, *to;
    /* of each part: how many keys have a digit, then where the next one goes */
    uint32_t (*place)[1 << DIGIT_MOST];
};

static size_t part_begin(const struct sharing *s, int part)
{
    return s->n * (size_t)part / (size_t)s->parts;
}

static inline uint32_t digit_of(struct sharing s, pair key)
{
    return (uint32_t)(key >> 32) >> s.shift & ((1u << s.bits) - 1);
}

static inline pair key_at(struct sharing s, size_t k)
{
    return (pair)s.word[k * s.step] << 32 | k;
}

static void part_count(void *of, int part, int worker)
{
    (void)worker;
    const struct sharing s = *(const struct sharing *)of;
    const size_t end = part_begin(&s, part + 1);
    uint32_t *place = s.place[part];
    memset(place, 0, sizeof s.place[part]);
    if (s.source == WORD)
        for (size_t k = part_begin(&s, part); k < end; k++)
            place[digit_of(s, key_at(s, k))]++;
    else if (s.source == PAIR)
        for (size_t k = part_begin(&s, part); k < end; k++)
            place[digit_of(s, s.from[k])]++;
    else
        for (size_t k = part_begin(&s, part); k < end; k++) {
            uint32_t at = (uint32_t)s.from[k];
            s.from[k] = key_at(s, at);
            place[digit_of(s, s.from[k])]++;
        }
}

static void part_put(void *of, int part, int worker)
{
    (void)worker;
    const struct sharing s = *(const struct sharing *)of;
    const size_t end = part_begin(&s, part + 1);
    uint32_t *place = s.place[part];
    for (size_t k = part_begin(&s, part); k < end; k++) {
        pair key = s.source == WORD ? key_at(s, k) : s.from[k];
        uint32_t at = place[digit_of(s, key)]++;
        if (s.last)
            s.ranks[(size_t)(uint32_t)key * s.step] = at;
        else
            s.to[at] = key;
    }
}

/* False: all keys have the same digit. */
static bool places_make(struct sharing *s)
{
    bool several = false;
    uint32_t sum = 0;
    for (size_t digit = 0; digit < (size_t)1 << s->bits; digit++) {
        uint32_t before = sum;
        for (int part = 0; part < s->parts; part++) {
            uint32_t here = s->place[part][digit];
            s->place[part][digit] = sum;
            sum += here;
        }
        several |= sum != before && sum - before != s->n;
    }
    return several;
}

static void shared_digit(const struct device *d, struct sharing *s)
{
    crew_run(d->crew, s->parts, part_count, s);
    if (s->source == GATHER)
        s->source = PAIR;
    if (!places_make(s) && !s->last)
        return;
    crew_run(d->crew, s->parts, part_put, s);
    pair *kept = s->from;
    s->from = s->to;
    s->to = kept;
    s->source = PAIR;
}

bool near_rank_shared(const struct device *d, int parts, const struct lines *l,
                      const struct near_word *words, int count, struct device_buffer *pairs,
                      struct device_buffer *out)
{
    const size_t columns = (size_t)l->columns, n = (size_t)l->length;
    const int digit = shape_sort_digit(&d->shape, l->length);
    /* Each part goes to all places that a digit has: few parts, so that each puts many keys
     * beside each other. */
    const int most = 2 * crew_size(d->crew);
    struct sharing s = {.n = n, .step = (size_t)l->step, .parts = parts < most ? parts : most};
    if (!(s.place = malloc((size_t)s.parts * sizeof *s.place)))
        return false;
    for (size_t i = 0; i < lines_count(l); i++) {
        size_t row = near_lines_row(l, i / columns) + i % columns;
        s.from = pairs->host;
        s.to = s.from + n;
        s.ranks = (uint32_t *)out->host + row;
        s.source = WORD;
        for (int w = 0; w < count; w++) {
            int passes = (words[w].bits - 1) / digit + 1;
            s.word = words[w].word + row;
            s.source = s.source == WORD
                           ? WORD
                           : GATHER; /* all keys' words may have been the same so far */
            for (int k = 0; k < passes; k++) {
                s.shift = words[w].bits * k / passes;
                s.bits = words[w].bits * (k + 1) / passes - s.shift;
                s.last = w == count - 1 && k == passes - 1;
                shared_digit(d, &s);
            }
        }
    }
    near_lines_repeat(l, out->host, sizeof *s.ranks);
    free(s.place);
    return true;
}

/* ---- lines that each do by itself ---- */

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
