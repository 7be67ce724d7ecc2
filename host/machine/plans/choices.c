/* choices.c - see choices.h. */
#include "plans/choices.h"

#include <stdlib.h>
#include <string.h>

#include "plans/background.h"
#include "plans/plans.h"

void choice_free(struct choice *c)
{
    if (!c)
        return;
    free(c->rows.nodes);
    free(c->strips.nodes);
    free(c->sets);
    free(c);
}

bool choice_takes_long(struct machine *m, const struct plan_request *q)
{
    size_t shifts = 0;
    for (int i = 0; i < q->reach->count; i++)
        shifts += q->reach->nodes[i]->op == NODE_SHIFT && !q->reach->nodes[i]->buffer;
    return shifts * (size_t)q->reach->count > m->device->shape.choose_aside && background_on(m);
}

static struct choice *choice_make(const struct machine *m, const struct plan_request *q,
                                  bool strips)
{
    struct choice *c = calloc(1, sizeof *c);
    const size_t bytes = (size_t)m->values->sets_count * sizeof *c->sets;
    bool good = c && (c->sets = malloc(bytes)) && plan_graph_init(&c->rows, q) &&
                (!strips || plan_graph_init(&c->strips, q));
    if (!good) {
        choice_free(c);
        return NULL;
    }
    memcpy(c->sets, m->values->sets, bytes);
    c->shape = &m->device->shape;
    c->rows.no_strips = true;
    c->rows.stop = c->strips.stop = &c->stop;
    return c;
}

static void choose(void *of)
{
    struct choice *c = of;
    plan_choose(&c->rows, c->sets, c->shape);
    if (c->strips.nodes)
        plan_choose(&c->strips, c->sets, c->shape);
}

/* What is done becomes the plan's. */
static void choosing_end(struct machine *m)
{
    struct choosing *s = &m->plans->choosing;
    m->plans->rehearsals_chosen += s->plan->empty;
    aside_end(&s->aside);
    choice_free(s->plan->choice);
    s->plan->choice = s->choice;
    *s = (struct choosing){0};
}

void choosing_stop(struct machine *m)
{
    struct choosing *s = &m->plans->choosing;
    if (!s->plan)
        return;
    atomic_store(&s->choice->stop, true);
    aside_end(&s->aside);
    choice_free(s->choice);
    *s = (struct choosing){0};
}

bool choice_is_awaited(struct machine *m)
{
    struct choosing *s = &m->plans->choosing;
    if (s->plan && aside_is_lost(&s->aside))
        choosing_stop(m);
    if (aside_is_done(&s->aside))
        choosing_end(m);
    return s->plan != NULL;
}

bool choice_is_at_hand(struct machine *m, struct plan *p, const struct plan_request *q,
                       bool strips)
{
    struct choosing *s = &m->plans->choosing;
    if (choice_is_awaited(m))
        return false;
    if (p->choice && (!strips || p->choice->strips.nodes))
        return true;
    if (!choice_takes_long(m, q))
        return true;
    s->choice = choice_make(m, q, strips);
    if (!s->choice || !aside_begin(&s->aside, choose, s->choice)) {
        choice_free(s->choice);
        *s = (struct choosing){0};
        return true;
    }
    s->plan = p;
    return false;
}

bool choice_take(const struct choice *c, struct plan_graph *g)
{
    const struct plan_graph *from = !c ? NULL : g->no_strips ? &c->rows : &c->strips;
    if (!from || !from->nodes)
        return false;
    struct plan_node *nodes = g->nodes;
    const bool boxes = g->boxes;
    memcpy(nodes, from->nodes, (size_t)from->count * sizeof *nodes);
    *g = *from;
    g->nodes = nodes;
    g->boxes = boxes;
    g->stop = NULL;
    return true;
}
