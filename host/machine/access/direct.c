/* direct.c - machine_direct(): the short way for the commonest calls on small sets.
 *
 * Operands are whole slots that are in memory. So nothing is cut, joined, selected or recorded,
 * and no rule could apply. */
#include "machine_direct.h"

#include "base/types.h"
#include "memory/memory.h"
#include "run/evaluate.h"
#include "values/graph.h"
#include "values/make.h"

/* The slot of exactly that type's bits; NULL: there is none, or the field has aliases. */
static struct slot *slot_of(struct machine *m, uint32_t id, struct machine_type type)
{
    const struct field *f = m->memory->found[field_line(id)];
    uint32_t offset;
    if (!f || id - f->base >= f->bits) {
        struct machine_field_info info;
        if (!machine_field_lookup(m, id, &info) || !(f = field_find(m, id, &offset)))
            return NULL;
    }
    if (f->vpset != m->values->set_current || f->root || f->aliases)
        return NULL;
    return slot_exact(f, id - f->base, (uint32_t)type.width);
}

static struct machine_value *content(struct machine *m, struct slot *slot,
                                     struct machine_type type)
{
    struct machine_value *v = slot ? slot->value : NULL;
    if (!v || (!v->buffer && !node_is_cheap(v)) || !type_equal(v->type, type))
        return NULL;
    slot_accessed(m, slot, false);
    return v;
}

static bool is_usual(const struct machine *m, const struct machine_direct *d)
{
    return m->values->at_once && m->values->set_current && !m->settings.lenient &&
           op_suits(d->op, 2, d->type) && !op_is_integer((int)d->op) &&
           !op_is_math((int)d->op) && d->type.width > 1 && !d->type.s &&
           (node_ops[d->op].gives == GIVES_BIT) == !d->dest;
}

static bool slot_put(struct machine *m, struct slot *slot, struct machine_value *v)
{
    slot_accessed(m, slot, true);
    slot_set(m, slot, v);
    return evaluate_after_store(m, v) == MACHINE_OK;
}

bool machine_direct(struct machine *m, const struct machine_direct *d)
{
    if (!is_usual(m, d))
        return false;
    struct flags *flags = &m->memory->flags[m->values->set_current];
    struct slot *to = d->dest ? slot_of(m, d->dest, d->type) : &flags->of[MACHINE_TEST];
    struct machine_value *a = content(m, slot_of(m, d->a, d->type), d->type), *b = NULL;
    if (!to || !a || !value_is_one_bit(flags->of[MACHINE_CONTEXT].value))
        return false;
    if (d->b)
        b = content(m, slot_of(m, d->b, d->type), d->type);
    else
        b = make_number(m, d->type, d->number);
    if (!b)
        return false;
    struct machine_value key = {
        .op = (uint8_t)d->op,
        .type = d->dest ? d->type : MACHINE_BIT,
        .set = (uint16_t)m->values->set_current,
        .in = {a, b},
    };
    struct machine_value *v = m->values->at_once(m, &key);
    if (!v)
        return false;
    if (d->overflow)
        machine_overflow_record(m, d->op, d->is_signed, a, b);
    return slot_put(m, to, v);
}
