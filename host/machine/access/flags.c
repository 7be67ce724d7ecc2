/* flags.c - reading and storing flags; recording overflows. */
#include <stdlib.h>
#include <string.h>

#include "access/settle.h"
#include "base/errors.h"
#include "base/types.h"
#include "memory/memory.h"
#include "run/evaluate.h"
#include "run/notes.h"
#include "values/graph.h"
#include "values/make.h"
#include "values/simplify.h"

/* ---- flags ---- */

struct machine_value *machine_flag_value(struct machine *m, enum machine_flag flag,
                                         enum machine_scope scope)
{
    settle(m);
    struct vpset *s = vpset_get(m, m->values->set_current);
    if (!s)
        return NULL;
    slot_accessed(m, &flags_of(m, s)->of[flag], false);
    struct machine_value *v = graph_borrow(m, flag_resolved(m, s, flag));
    if (scope == MACHINE_WHERE_ACTIVE && flag != MACHINE_CONTEXT)
        v = simplify_under(m, v, flags_of(m, s)->of[MACHINE_CONTEXT].value, 12);
    return v ? graph_borrow(m, v) : NULL;
}

static bool flag_suits(struct machine *m, const struct machine_value *value)
{
    if (!type_equal(value->type, MACHINE_BIT))
        machine_fail(m, MACHINE_BAD_ARGUMENT, "a flag is one bit");
    else if (value->set && value->set != m->values->set_current)
        machine_fail(m, MACHINE_BAD_ARGUMENT, "the value belongs to another VP set");
    else
        return true;
    return false;
}

enum machine_status machine_flag_store(struct machine *m, enum machine_flag flag,
                                       struct machine_value *value, enum machine_scope scope)
{
    settle(m);
    struct vpset *s = vpset_get(m, m->values->set_current);
    if (!value || !s)
        return m->status;
    if (!flag_suits(m, value))
        return m->status;
    struct slot *slot = &flags_of(m, s)->of[flag];
    slot_accessed(m, slot, true);
    if (flag == MACHINE_OVERFLOW) {
        if (scope == MACHINE_WHERE_ACTIVE)
            flag_resolved(m, s, flag);
        else
            flag_overflow_forget(m, s);
    }
    if (scope == MACHINE_WHERE_ACTIVE)
        value =
            machine_select(m, flags_of(m, s)->of[MACHINE_CONTEXT].value, value, slot->value);
    if (!value)
        return m->status;
    slot_set(m, slot, value);
    return evaluate_after_store(m, value);
}

static int overflow_op(enum machine_op op, bool is_signed)
{
    switch ((int)op) {
    case MACHINE_ADD:
        return is_signed ? NODE_OVERFLOW_SADD : NODE_OVERFLOW_UADD;
    case MACHINE_SUB:
        return is_signed ? NODE_OVERFLOW_SSUB : NODE_OVERFLOW_USUB;
    case MACHINE_MUL:
        return is_signed ? NODE_OVERFLOW_SMUL : NODE_OVERFLOW_UMUL;
    case MACHINE_NEG:
        return NODE_OVERFLOW_SNEG;
    case MACHINE_FADD:
        return NODE_OVERFLOW_FADD;
    case MACHINE_FSUB:
        return NODE_OVERFLOW_FSUB;
    case MACHINE_FMUL:
        return NODE_OVERFLOW_FMUL;
    case MACHINE_FDIV:
        return NODE_OVERFLOW_FDIV;
    default:
        return 0;
    }
}

static void overflow_remember(struct machine *m, struct vpset *s, int node,
                              struct machine_value *a, struct machine_value *b)
{
    settle(m);
    values_before_change(m);
    struct machine_value *context = flags_of(m, s)->of[MACHINE_CONTEXT].value;
    if (flags_of(m, s)->overflow.op && flags_of(m, s)->overflow.context != context) {
        flag_resolved(m, s, MACHINE_OVERFLOW);
        if (!value_is_one_bit(context))
            flags_of(m, s)->overflow_needed = true;
    }
    if (!flags_of(m, s)->overflow_begun) {
        flags_of(m, s)->overflow_begun = true;
        flags_of(m, s)->overflow_whole = value_is_one_bit(context);
    }
    slot_accessed(m, &flags_of(m, s)->of[MACHINE_OVERFLOW], true);
    graph_ref(a);
    if (b)
        graph_ref(b);
    graph_ref(context);
    flag_overflow_forget(m, s);
    flags_of(m, s)->overflow =
        (struct lazy_overflow){.op = (uint8_t)node, .a = a, .b = b, .context = context};
}

enum machine_status machine_overflow_record(struct machine *m, enum machine_op op,
                                            bool is_signed, struct machine_value *a,
                                            struct machine_value *b)
{
    struct vpset *s = vpset_get(m, m->values->set_current);
    int node = overflow_op(op, is_signed);
    if (!s || !a || !node || (node_ops[node].inputs == 2 && !b))
        return machine_fail(m, MACHINE_BAD_ARGUMENT, "this operation has no overflow");
    if ((a->set && a->set != m->values->set_current) ||
        (b && b->set && b->set != m->values->set_current))
        return machine_fail(m, MACHINE_BAD_ARGUMENT, "the value belongs to another VP set");
    if (op == MACHINE_NEG && !is_signed) { /* 0 - a */
        b = a;
        a = slot_zero(m, a->type.width);
        node = NODE_OVERFLOW_USUB;
    }
    overflow_remember(m, s, node, a, b);
    return MACHINE_OK;
}

enum machine_status machine_overflow_record_result(struct machine *m,
                                                   struct machine_value *result,
                                                   struct machine_value *operand)
{
    struct vpset *s = vpset_get(m, m->values->set_current);
    if (!s || !result || !operand)
        return m->status;
    if (result->type.kind != MACHINE_FLOAT || !type_equal(result->type, operand->type))
        return machine_fail(m, MACHINE_BAD_ARGUMENT, "this operation has no overflow");
    overflow_remember(m, s, NODE_OVERFLOW_RESULT, result, operand);
    return MACHINE_OK;
}

enum machine_status machine_overflow_record_value(struct machine *m,
                                                  struct machine_value *overflows)
{
    struct vpset *s = vpset_get(m, m->values->set_current);
    if (!s || !overflows)
        return m->status;
    if (!flag_suits(m, overflows))
        return m->status;
    overflow_remember(m, s, NODE_SELECT, overflows, NULL);
    return MACHINE_OK;
}
