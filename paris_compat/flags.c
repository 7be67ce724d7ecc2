/* The flags, and single bits. Operations on the context act on all processors: their
 * generated rows have the scope EVERYWHERE. */
#include "paris_state.h"

static struct machine_value *bit_constant(struct machine *m, unsigned int value)
{
    return machine_constant(m, MACHINE_BIT, (struct machine_scalar){value, 0});
}

void paris_flag_constant(const struct paris_instruction *self, enum machine_flag flag,
                         unsigned int value)
{
    struct machine *m = paris_begin(self->name);
    paris_flag_put(m, flag, bit_constant(m, value), self->scope);
}

void paris_flag_load(const struct paris_instruction *self, enum machine_flag flag,
                     CM_field_id_t source)
{
    struct machine *m = paris_begin(self->name);
    struct machine_value *v = paris_load_bit(m, source, "source", self->scope);
    if (v)
        paris_flag_put(m, flag, v, self->scope);
}

void paris_flag_store(const struct paris_instruction *self, enum machine_flag flag,
                      CM_field_id_t dest)
{
    struct machine *m = paris_begin(self->name);
    paris_store_bit(m, dest, machine_flag_value(m, flag, self->scope), self->scope);
}

void paris_flag_logical_field(const struct paris_instruction *self, enum machine_flag flag,
                              CM_field_id_t source)
{
    struct machine *m = paris_begin(self->name);
    struct machine_value *b = paris_load_bit(m, source, "source", self->scope);
    if (!b)
        return;
    struct machine_value *a = machine_flag_value(m, flag, self->scope);
    paris_flag_put(m, flag, paris_boolean(m, self->op, a, b), self->scope);
}

void paris_flag_logical_flag(const struct paris_instruction *self, enum machine_flag flag,
                             enum machine_flag other)
{
    struct machine *m = paris_begin(self->name);
    struct machine_value *a = machine_flag_value(m, flag, self->scope);
    struct machine_value *b = machine_flag_value(m, other, self->scope);
    paris_flag_put(m, flag, paris_boolean(m, self->op, a, b), self->scope);
}

/* ---- single bits ---- */

static void bit_put(const char *name, CM_field_id_t dest, unsigned int value,
                    enum machine_scope scope)
{
    struct machine *m = paris_begin(name);
    paris_store_bit(m, dest, bit_constant(m, value), scope);
}

static void bit_invert(const char *name, CM_field_id_t dest, enum machine_scope scope)
{
    struct machine *m = paris_begin(name);
    struct machine_value *v = paris_load_bit(m, dest, "dest", scope);
    if (v)
        paris_store_bit(m, dest, machine_unary(m, MACHINE_NOT, v), scope);
}

PARIS_OF_A_FIELD(CM_set_bit, dest, true, bit_put("CM_set_bit", dest, 1, MACHINE_WHERE_ACTIVE))
PARIS_OF_A_FIELD(CM_set_bit_always, dest, true,
                 bit_put("CM_set_bit_always", dest, 1, MACHINE_EVERYWHERE))
PARIS_OF_A_FIELD(CM_clear_bit, dest, true,
                 bit_put("CM_clear_bit", dest, 0, MACHINE_WHERE_ACTIVE))
PARIS_OF_A_FIELD(CM_clear_bit_always, dest, true,
                 bit_put("CM_clear_bit_always", dest, 0, MACHINE_EVERYWHERE))
PARIS_OF_A_FIELD(CM_invert_bit, dest, true,
                 bit_invert("CM_invert_bit", dest, MACHINE_WHERE_ACTIVE))
PARIS_OF_A_FIELD(CM_invert_bit_always, dest, true,
                 bit_invert("CM_invert_bit_always", dest, MACHINE_EVERYWHERE))

static void flags_clear(const char *name, enum machine_scope scope)
{
    struct machine *m = paris_begin(name);
    struct machine_value *zero = bit_constant(m, 0);
    if (paris_flag_put(m, MACHINE_TEST, zero, scope))
        paris_flag_put(m, MACHINE_OVERFLOW, zero, scope);
}

void CM_clear_all_flags(void)
{
    flags_clear("CM_clear_all_flags", MACHINE_WHERE_ACTIVE);
}

void CM_clear_all_flags_always(void)
{
    flags_clear("CM_clear_all_flags_always", MACHINE_EVERYWHERE);
}
