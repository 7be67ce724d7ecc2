/* guards.c - what a context leaves out: see byte_code.h.
 *
 *     m = i > k and j = k            a bit, known before
 *     GUARD m, 2                     where m holds in no lane of the block, the next two steps are left out
 *     x = f / p                      nothing but the selection takes it
 *     y = x * g
 *     f' = m ? y : f                 so no lane is y's
 *
 * From the last step to the first it is found for whom each register's content is: for the first choice of one selection or two, or for others as well. */
#include <stdlib.h>

#include "base/arrays.h"
#include "interpret/byte_code.h"

enum { DEAR = 4 };

/* Selections: none; one (first == second); two; or others as well. */
struct whose {
    int first, second; /* first <= second */
    bool others;
};
static const struct whose nobody = {-1, -1, false}, others = {-1, -1, true};

struct guarding {
    struct byte_code *p;
    struct whose *content; /* of a place, from here on */
    struct whose *of_step;
    struct lanes_step *steps;
    int count, capacity;
};

static bool is_nobody(struct whose w)
{
    return w.first < 0 && !w.others;
}

static bool is_same(struct whose a, struct whose b)
{
    return a.first == b.first && a.second == b.second && a.others == b.others;
}

/* Both. */
static struct whose joined(struct whose a, struct whose b)
{
    if (is_nobody(a) || is_same(a, b))
        return b;
    if (is_nobody(b))
        return a;
    const struct whose both = {a.first < b.first ? a.first : b.first,
                               a.second > b.second ? a.second : b.second, false};
    const bool two = !a.others && !b.others &&
                     (a.first == both.first || a.first == both.second) &&
                     (a.second == both.first || a.second == both.second) &&
                     (b.first == both.first || b.first == both.second) &&
                     (b.second == both.first || b.second == both.second);
    return two ? both : others;
}

static bool is_register(const struct byte_code *p, int place)
{
    return p->places[place].kind == PLACE_REGISTER;
}

static void owners_find(struct guarding *g)
{
    for (int i = g->p->steps_count - 1; i >= 0; i--) {
        const struct lanes_step *s = &g->p->steps[i];
        const bool keeps = is_register(g->p, s->to);
        struct whose whose = keeps ? g->content[s->to] : others;
        g->of_step[i] = whose = is_nobody(whose) ? others : whose;
        if (keeps)
            g->content[s->to] = nobody;
        for (int k = 0; k < lanes_taken(s); k++) {
            const int place = lanes_taken_place(s, k);
            const struct whose chosen = {i, i, false};
            if (is_register(g->p, place))
                g->content[place] =
                    joined(g->content[place], s->op == NODE_SELECT && k == 1 ? chosen : whose);
        }
    }
}

/* The step after which a selection's bit is known, and whether in its first lane only. False: it is a number. */
static bool bit_known(const struct byte_code *p, int selection, int *after, bool *one)
{
    const int bit = p->steps[selection].in[0];
    *after = -1;
    *one = false;
    if (!is_register(p, bit))
        return p->places[bit].kind == PLACE_ARRAY;
    int i = selection - 1;
    while (i >= 0 && (p->steps[i].to != bit || p->steps[i].op == LANES_REPEAT))
        i--;
    *after = i;
    *one = i >= 0 && p->steps[i].one;
    return i >= 0;
}

static bool is_worth_it(const struct byte_code *p, int from, int end)
{
    int cost = 0;
    for (int i = from; i < end; i++) {
        const struct lanes_step *s = &p->steps[i];
        cost += s->one ? 0 : s->op == MACHINE_FDIV || s->op == LANES_FETCH ? DEAR : DEAR / 2;
    }
    return cost >= DEAR;
}

static void step_put(struct guarding *g, const struct lanes_step *s)
{
    if (g->count == g->capacity)
        g->steps = array_more(g->steps, &g->capacity, sizeof *g->steps, &g->p->failed);
    if (!g->p->failed)
        g->steps[g->count++] = *s;
}

/* The guard of steps that are for these. False: there is none before that step. */
static bool guard_make(const struct byte_code *p, struct whose whose, int before,
                       struct lanes_step *guard)
{
    int after[2];
    bool one[2];
    if (whose.others || !bit_known(p, whose.first, &after[0], &one[0]) ||
        !bit_known(p, whose.second, &after[1], &one[1]) || after[0] >= before ||
        after[1] >= before)
        return false;
    *guard = (struct lanes_step){
        .op = LANES_GUARD,
        .in = {p->steps[whose.first].in[0], p->steps[whose.second].in[0], 0},
        .one = one[0],
        .in_a_row = one[1]};
    return true;
}

/* Steps in a row that are for the same selections, when their bits are known, get a guard. */
static void guards_put(struct guarding *g)
{
    const struct byte_code *p = g->p;
    int guarded = 0; /* up to there */
    for (int i = 0; i < p->steps_count; i++) {
        struct lanes_step guard;
        int end = i;
        if (i >= guarded && guard_make(p, g->of_step[i], i, &guard)) {
            while (end < p->steps_count && is_same(g->of_step[end], g->of_step[i]))
                end++;
            guard.detail = end - i;
            guarded = end;
            if (is_worth_it(p, i, end))
                step_put(g, &guard);
        }
        step_put(g, &p->steps[i]);
    }
}

void byte_code_guards(struct byte_code *p)
{
    bool any = false;
    for (int i = 0; i < p->steps_count; i++)
        any = any || p->steps[i].op == NODE_SELECT;
    if (!any || p->failed)
        return;
    struct guarding g = {.p = p,
                         .content = malloc((size_t)p->places_count * sizeof *g.content),
                         .of_step = malloc((size_t)p->steps_count * sizeof *g.of_step)};
    p->failed = !g.content || !g.of_step;
    for (int i = 0; i < p->places_count && !p->failed; i++)
        g.content[i] = nobody;
    if (!p->failed) {
        owners_find(&g);
        guards_put(&g);
    }
    free(g.content);
    free(g.of_step);
    if (p->failed) {
        free(g.steps);
        return;
    }
    free(p->steps);
    p->steps = g.steps;
    p->steps_count = g.count;
    p->steps_capacity = g.capacity;
}
