/* pieces.c - what of all that waits was stored into a field or flag first: see room.c. */
#include "memory/memory.h"
#include "run/room.h"

/* The oldest of those below v, and v itself; HEIGHT_MOST limits the recursion. */
static void look(struct machine *m, struct machine_value *v, bool stored,
                 struct machine_value **first)
{
    if (node_is_leaf(v) || (v->mark == m->values->mark && !stored))
        return;
    const bool known = v->mark == m->values->mark;
    v->mark = m->values->mark;
    for (int i = 0; i < node_ops[v->op].inputs && !known; i++)
        look(m, v->in[i], v->in[i]->stored, first);
    if (stored && !node_is_cheap(v) && v->op != NODE_SLICE &&
        (!*first || v->serial < (*first)->serial))
        *first = v;
}

struct machine_value *pieces_next(struct machine *m, struct machine_value *const *wanted,
                                  int count)
{
    struct machine_value *first = NULL;
    m->values->mark++;
    for (int i = 0; i < count; i++)
        look(m, wanted[i], true, &first);
    for (int i = 1; i < m->values->sets_count; i++) {
        const struct flags *f = &m->memory->flags[i];
        if (!m->values->sets[i].used)
            continue;
        for (int flag = 0; flag < 3; flag++)
            look(m, f->of[flag].value, true, &first);
        struct machine_value *const of[3] = {f->overflow.a, f->overflow.b, f->overflow.context};
        for (int k = 0; f->overflow.op && k < 3; k++)
            if (of[k])
                look(m, of[k], of[k]->stored, &first);
    }
    for (int i = 0; i < m->memory->fields_count; i++)
        for (int k = 0; k < m->memory->fields[i]->slots_count; k++)
            look(m, m->memory->fields[i]->slots[k].value, true, &first);
    return first;
}

/* The bytes of the arrays that v alone holds. */
static uint64_t held_by(const struct machine_value *v)
{
    uint64_t bytes = 0;
    for (int i = 0; i < node_ops[v->op].inputs; i++) {
        const struct machine_value *in = v->in[i];
        if (in->refs > 1)
            continue;
        if (!in->buffer)
            bytes += held_by(in);
        else if (in->buffer->refs == 1)
            bytes += in->buffer->bytes;
    }
    return bytes;
}

struct machine_value *pieces_before(const struct machine *m, const struct machine_value *v)
{
    struct machine_value *taken = v->op == NODE_SELECT && !v->buffer ? v->in[1] : NULL;
    if (!taken || taken->refs < 2 || node_is_leaf(taken) || node_is_cheap(taken) ||
        taken->op == NODE_SLICE)
        return NULL;
    return held_by(taken) > m->values->sets[v->set].count * type_bytes(taken->type) ? taken
                                                                                    : NULL;
}
