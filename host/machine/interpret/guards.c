/* guards.c - what a context leaves out: see byte_code.h.
 *
 *     m = i > k and j = k            a bit, known before
 *     GUARD m, 2                     the next two steps are performed for the lanes of the
 *                                    block from the first where m holds to the last; where
 *                                    there is
 *     x = f / p                      none they are left out
 *     y = x * g                      nothing but the selection takes it
 *     f' = m ? y : f                 so no other lane is y's
 *
 * From the last step to the first it is found for whom each register's content is: for the
 * first choice of selections by one condition or by two, or for others as well. A condition is
 * the bit of a selection. Where it is the and of two that are known before it is, these two are
 * looked at. */
#include <stdlib.h>
#include <string.h>

#include "base/arrays.h"
#include "interpret/byte_code.h"

/* CONDITIONS_MOST: selections beyond are taken for ones of their own. */
enum { DEAR = 4, CONDITIONS_MOST = 64 };

/* Conditions, by the first selection that has each: none; one (first == second); two; or others
 * as well. */
struct whose {
    int first, second; /* first <= second */
    bool others;
};
static const struct whose nobody = {-1, -1, false}, others = {-1, -1, true};

/* A bit: the step that makes it. */
struct known {
    int place, step; /* step -1: it is in an array */
    bool one;        /* all lanes are as the first */
};
/* What a selection asks. place -1: a number, or what no step makes. */
struct condition {
    struct known whole, parts[2]; /* parts: what it is the and of; place -1: it is none */
    int first;                    /* the first selection that asks the same */
};

struct guarding {
    struct byte_code *p;
    struct whose *content; /* of a place, from here on */
    struct whose *of_step;
    struct condition *conditions; /* by step */
    int *maker;                   /* of a place: the step that it is from, so far; -1: none */
    struct lanes_step *steps;
    int count, capacity;
    int guards_capacity;
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

/* ---- conditions ---- */

static struct known known_of(const struct guarding *g, int place)
{
    const struct byte_code *p = g->p;
    const int step = g->maker[place];
    if (p->places[place].kind ==
        PLACE_ARRAY) /* one that a step stores is known from there on */
        return (struct known){place, step, false};
    if (!is_register(p, place) || step < 0)
        return (struct known){-1, -1, false};
    return (struct known){place, step, p->steps[step].one};
}

/* The step at hand is over. */
static void made(struct guarding *g, int step)
{
    if (g->p->steps[step].op != LANES_REPEAT) /* its lanes are as the first was */
        g->maker[g->p->steps[step].to] = step;
}

static bool known_equal(struct known a, struct known b)
{
    return a.place == b.place && a.step == b.step;
}

static bool asks_same(const struct condition *a, const struct condition *b)
{
    return known_equal(a->whole, b->whole) ||
           (a->parts[0].place >= 0 && a->parts[1].place >= 0 &&
            known_equal(a->parts[0], b->parts[0]) && known_equal(a->parts[1], b->parts[1]));
}

static void condition_find(struct guarding *g, int i, const int *selections, int count)
{
    const struct known none = {-1, -1, false};
    struct condition *c = &g->conditions[i];
    *c = (struct condition){known_of(g, g->p->steps[i].in[0]), {none, none}, i};
    if (c->whole.step >= 0 && g->p->steps[c->whole.step].op == MACHINE_AND) {
        c->parts[0] = g->conditions[c->whole.step].parts[0];
        c->parts[1] = g->conditions[c->whole.step].parts[1];
    }
    for (int k = 0; k < count && c->first == i && c->whole.place >= 0; k++)
        if (asks_same(&g->conditions[selections[k]], c))
            c->first = selections[k];
}

/* Of each selection what it asks; of an and what it joins. */
static void conditions_find(struct guarding *g, int *selections)
{
    int count = 0;
    for (int i = 0; i < g->p->steps_count; i++) {
        const struct lanes_step *s = &g->p->steps[i];
        if (s->op == NODE_SELECT) {
            condition_find(g, i, selections, count);
            if (g->conditions[i].first == i && count < CONDITIONS_MOST)
                selections[count++] = i;
        } else if (s->op == MACHINE_AND && s->type.width == 1) {
            g->conditions[i].parts[0] = known_of(g, s->in[0]);
            g->conditions[i].parts[1] = known_of(g, s->in[1]);
        } else if (s->op == MACHINE_AND) {
            g->conditions[i].parts[0] = g->conditions[i].parts[1] =
                (struct known){-1, -1, false};
        }
        made(g, i);
    }
}

/* ---- for whom ---- */

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
            const struct condition *c = &g->conditions[i];
            struct whose taker = whose;
            if (s->op == NODE_SELECT && k == 1 && c->whole.place >= 0)
                taker = (struct whose){c->first, c->first, false};
            if (s->op == LANES_CROSS) /* other lanes, too */
                taker = others;
            if (is_register(g->p, place))
                g->content[place] = joined(g->content[place], taker);
        }
    }
}

/* ---- guards ---- */

/* A loop over floats or a get takes longer than the guard, and two others do. */
static bool is_worth_it(const struct byte_code *p, int from, int end)
{
    int cost = 0;
    for (int i = from; i < end; i++) {
        const struct lanes_step *s = &p->steps[i];
        const bool is_dear = s->from.kind == MACHINE_FLOAT || s->op == LANES_FETCH;
        cost += s->one ? 0 : is_dear ? DEAR : DEAR / 2;
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

/* Whether the bit is known before the step at hand, and still there. */
static bool is_there(const struct guarding *g, struct known bit)
{
    return bit.place >= 0 && (bit.step < 0 || g->maker[bit.place] == bit.step);
}

static void bit_add(const struct guarding *g, struct guard_choice *choice, struct known bit)
{
    if (!is_there(g, bit))
        return;
    choice->bits[choice->count] = (uint16_t)bit.place;
    choice->one[choice->count++] = bit.one;
}

/* What is known of a condition before the step at hand: the bit, or those that it is the and
 * of. False: nothing. */
static bool choice_make(const struct guarding *g, const struct condition *c,
                        struct guard_choice *choice)
{
    *choice = (struct guard_choice){0};
    bit_add(g, choice, c->whole);
    for (int k = 0; k < 2 && !is_there(g, c->whole); k++)
        bit_add(g, choice, c->parts[k]);
    return choice->count > 0;
}

/* The guard of steps that are for these. False: there is none before the step at hand. */
static bool guard_make(const struct guarding *g, struct whose whose, struct guard *guard)
{
    return !whose.others && choice_make(g, &g->conditions[whose.first], &guard->choices[0]) &&
           choice_make(g, &g->conditions[whose.second], &guard->choices[1]);
}

static void guard_put(struct guarding *g, const struct guard *guard, int steps)
{
    struct byte_code *p = g->p;
    if (p->guards_count == g->guards_capacity)
        p->guards = array_more(p->guards, &g->guards_capacity, sizeof *p->guards, &p->failed);
    if (p->failed || p->guards_count > UINT16_MAX)
        return;
    const struct lanes_step step = {
        .op = LANES_GUARD, .in = {(uint16_t)p->guards_count, 0, 0}, .detail = steps};
    p->guards[p->guards_count++] = *guard;
    step_put(g, &step);
}

/* Steps in a row that are for the same selections, when their bits are known, get a guard. */
static void guards_put(struct guarding *g)
{
    const struct byte_code *p = g->p;
    int guarded = 0; /* up to there */
    for (int i = 0; i < p->steps_count; i++) {
        struct guard guard;
        int end = i;
        if (i >= guarded && guard_make(g, g->of_step[i], &guard)) {
            while (end < p->steps_count && is_same(g->of_step[end], g->of_step[i]))
                end++;
            guarded = end;
            if (is_worth_it(p, i, end))
                guard_put(g, &guard, end - i);
        }
        step_put(g, &p->steps[i]);
        made(g, i);
    }
}

void byte_code_guards(struct byte_code *p)
{
    bool any = false;
    for (int i = 0; i < p->steps_count; i++)
        any = any || p->steps[i].op == NODE_SELECT;
    if (!any || p->failed)
        return;
    const size_t places = (size_t)p->places_count, steps = (size_t)p->steps_count;
    struct guarding g = {.p = p,
                         .content = malloc(places * sizeof *g.content),
                         .of_step = malloc(steps * sizeof *g.of_step),
                         .conditions = malloc(steps * sizeof *g.conditions),
                         .maker = malloc(places * sizeof *g.maker)};
    int selections[CONDITIONS_MOST];
    p->failed = !g.content || !g.of_step || !g.conditions || !g.maker;
    for (size_t i = 0; i < places && !p->failed; i++)
        g.content[i] = nobody;
    if (!p->failed) {
        memset(g.maker, 0xff, places * sizeof *g.maker);
        conditions_find(&g, selections);
        owners_find(&g);
        memset(g.maker, 0xff, places * sizeof *g.maker);
        guards_put(&g);
    }
    free(g.content);
    free(g.of_step);
    free(g.conditions);
    free(g.maker);
    if (p->failed) {
        free(g.steps);
        return;
    }
    free(p->steps);
    p->steps = g.steps;
    p->steps_count = g.count;
    p->steps_capacity = g.capacity;
}
