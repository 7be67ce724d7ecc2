/* flags.c - flags, and overflows that have not been observed yet. */
#include "memory/memory.h"
#include "values/graph.h"
#include "values/make.h"

void flag_overflow_clear(struct machine *m, struct lazy_overflow *o)
{
    if (!o->op)
        return;
    values_before_change(m);
    graph_unref(m, o->a);
    if (o->b)
        graph_unref(m, o->b);
    graph_unref(m, o->context);
    o->op = 0;
}

void flag_overflow_forget(struct machine *m, struct vpset *s)
{
    m->values->vanished.overflows += flags_of(m, s)->overflow.op != 0;
    flag_overflow_clear(m, &flags_of(m, s)->overflow);
}

struct machine_value *flag_resolved(struct machine *m, struct vpset *s, enum machine_flag flag)
{
    struct lazy_overflow *o = &flags_of(m, s)->overflow;
    if (flag == MACHINE_OVERFLOW && o->op) {
        struct slot *slot = &flags_of(m, s)->of[MACHINE_OVERFLOW];
        const int current = m->values->set_current;
        m->values->set_current =
            (int)(s - m->values->sets); /* an overflow of numbers is this set's */
        struct machine_value *new =
            o->op == NODE_SELECT ? o->a : make_overflow(m, (enum node_op)o->op, o->a, o->b);
        struct machine_value *all =
            new ? machine_select(m, o->context, new, slot->value) : NULL;
        if (all)
            slot_set(m, slot, all);
        m->values->set_current = current;
        flag_overflow_clear(m, o);
    }
    return flags_of(m, s)->of[flag].value;
}
