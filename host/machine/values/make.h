/* make.h - makes values: constants, and operations that no rule simplifies. */
#ifndef LUTETIA_MACHINE_MAKE_H
#define LUTETIA_MACHINE_MAKE_H

#include "values/values.h"

#define MAKE_BIT_TYPE ((struct machine_type){.kind = MACHINE_BITS, .width = 1})
struct machine_value *make_bad(struct machine *m, const char *what);
/* Keeps a value until the next instruction, also if it is a part of an operand. */
struct machine_value *make_handed(struct machine *m, struct machine_value *v);
struct machine_value *make_number(struct machine *m, struct machine_type type,
                                  struct machine_scalar x);
struct machine_value *make_bit(struct machine *m, int x);
struct machine_value *make_node(struct machine *m, int op, struct machine_type type, int detail,
                                struct machine_value *a, struct machine_value *b,
                                struct machine_value *c);
struct machine_value *make_reinterpreted(struct machine *m, struct machine_value *a,
                                         struct machine_type type);
struct machine_value *make_overflow(struct machine *m, enum node_op op, struct machine_value *a,
                                    struct machine_value *b);
/* Makes a node of the graph, without folding. */
struct machine_value *make_operation(struct machine *m, enum machine_op op,
                                     struct machine_type type, struct machine_value *a,
                                     struct machine_value *b);

static inline unsigned __int128 scalar_wide(struct machine_scalar x)
{
    return (unsigned __int128)x.hi << 64 | x.lo;
}

static inline struct machine_scalar scalar_narrow(unsigned __int128 x)
{
    return (struct machine_scalar){(uint64_t)x, (uint64_t)(x >> 64)};
}

static inline bool value_is_number(const struct machine_value *v)
{
    return v->op == NODE_CONSTANT;
}

static inline bool value_is_zero_bit(const struct machine_value *v)
{
    return value_is_number(v) && v->type.width == 1 && v->imm.lo == 0;
}

static inline bool value_is_one_bit(const struct machine_value *v)
{
    return value_is_number(v) && v->type.width == 1 && v->imm.lo == 1;
}

static inline bool type_is_bits(int width)
{
    return width >= 1 && width <= 128;
}

#endif
