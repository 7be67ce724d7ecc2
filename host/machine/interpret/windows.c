/* windows.c - see windows.h. */
#include "interpret/windows.h"

#include <string.h>

enum { RUN = 16 };

static bool run_holds(const uint8_t *bits)
{
    uint64_t low, high;
    memcpy(&low, bits, sizeof low);
    memcpy(&high, bits + sizeof low, sizeof high);
    return (low | high) != 0;
}

static struct window held(const uint8_t *bits, int lanes)
{
    const int whole = lanes / RUN * RUN;
    int from = 0, end = lanes;
    bool rest = false;
    while (from < whole && !run_holds(bits + from))
        from += RUN;
    for (int i = whole; i < lanes && !rest; i++)
        rest = bits[i];
    if (rest)
        return (struct window){from, end};
    for (end = whole; end > from && !run_holds(bits + end - RUN);)
        end -= RUN;
    return (struct window){from, end};
}

/* Where both hold, at least. */
static struct window chosen(const struct guard_choice *c, void *const *at, int lanes)
{
    struct window all = {0, lanes};
    for (int k = 0; k < c->count && all.from < all.end; k++) {
        const uint8_t *bits = at[c->bits[k]];
        const struct window w = !c->one[k] ? held(bits, lanes)
                                : *bits    ? (struct window){0, lanes}
                                           : (struct window){0, 0};
        all.from = w.from > all.from ? w.from : all.from;
        all.end = w.end < all.end ? w.end : all.end;
    }
    return all.from < all.end ? all : (struct window){0, 0};
}

static bool is_same(const struct guard_choice *a, const struct guard_choice *b)
{
    bool same = a->count == b->count;
    for (int k = 0; k < a->count && same; k++)
        same = a->bits[k] == b->bits[k] && a->one[k] == b->one[k];
    return same;
}

struct window window_of(const struct guard *g, void *const *at, int lanes)
{
    const struct window a = chosen(&g->choices[0], at, lanes);
    if (is_same(&g->choices[0], &g->choices[1]))
        return a;
    const struct window b = chosen(&g->choices[1], at, lanes);
    if (b.from == b.end)
        return a;
    if (a.from == a.end)
        return b;
    return (struct window){a.from < b.from ? a.from : b.from, a.end > b.end ? a.end : b.end};
}

static char *further(const struct byte_code *p, void *const *at, int place, int lanes)
{
    return (char *)at[place] + (size_t)lanes * p->places[place].bytes;
}

void window_step(const struct byte_code *p, const struct lanes_step *s, void *const *at,
                 struct window w, int lanes)
{
    enum { TO = 3 };
    if (s->one || s->list || s->op == LANES_CROSS || s->op == LANES_DRAW) {
        s->run(s, at, s->one ? 1 : lanes);
        return;
    }
    if (s->op == LANES_REPEAT) { /* from the first lane on */
        s->run(s, at, w.end);
        return;
    }
    struct lanes_step part = *s;
    void *of[4] = {NULL, NULL, NULL, further(p, at, s->to, w.from)};
    uint32_t place = 0;
    const int inputs = lanes_inputs(s->op);
    for (int k = 0; k < inputs; k++) {
        of[k] = lanes_is_apart(s, k) ? at[s->in[k]] : further(p, at, s->in[k], w.from);
        part.in[k] = (uint16_t)k;
    }
    if (s->op == LANES_FETCH && s->in_a_row) { /* only the first lane's place is known */
        place = *(const uint32_t *)at[s->in[0]] + (uint32_t)w.from;
        of[0] = &place;
    }
    part.to = TO;
    part.run(&part, of, w.end - w.from);
}
