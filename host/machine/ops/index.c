/* index.c - see index.h. */
#include "ops/index.h"

#include "values/graph.h"
#include "values/make.h"

#define INDEX_NOBODY 0xf0000000u /* more than any place, and a halo more is no less */

struct machine_value *index_number(struct machine *m, uint64_t x)
{
    return make_number(m, MACHINE_UINT(INDEX_BITS), (struct machine_scalar){x, 0});
}

/* ratio * quotient + rest == x, and rest < ratio. */
static bool index_divide(struct machine *m, struct machine_value *x, uint64_t by,
                         struct machine_value **quotient, struct machine_value **rest)
{
    const struct machine_type type = MACHINE_UINT(INDEX_BITS);
    int log2 = 0;
    while (UINT64_C(1) << log2 < by)
        log2++;
    if (UINT64_C(1) << log2 == by && log2 < INDEX_BITS) {
        *rest = log2 ? machine_resize(m, machine_extract(m, x, 0, log2), INDEX_BITS, false)
                     : index_number(m, 0);
        *quotient = machine_resize(m, machine_extract(m, x, log2, INDEX_BITS - log2),
                                   INDEX_BITS, false);
        return *rest && *quotient;
    }
    struct machine_value *number = index_number(m, by);
    *quotient = make_operation(m, MACHINE_UDIV, type, x, number);
    struct machine_value *whole =
        *quotient ? make_operation(m, MACHINE_MUL, type, *quotient, number) : NULL;
    *rest = whole ? make_operation(m, MACHINE_SUB, type, x, whole) : NULL;
    return *rest != NULL;
}

/* x, or an index that nobody has where the condition does not hold. */
static struct machine_value *index_where(struct machine *m, struct machine_value *condition,
                                         struct machine_value *x)
{
    return condition && x ? machine_select(m, condition, x, index_number(m, INDEX_NOBODY))
                          : NULL;
}

static struct machine_value *index_below(struct machine *m, struct machine_value *x,
                                         uint64_t most)
{
    return make_operation(m, MACHINE_ULT, MACHINE_BIT, x, index_number(m, most));
}

/* times x + y */
static struct machine_value *index_sum(struct machine *m, struct machine_value *x,
                                       uint64_t times, struct machine_value *y)
{
    const struct machine_type type = MACHINE_UINT(INDEX_BITS);
    x = times == 1 ? x : make_operation(m, MACHINE_MUL, type, x, index_number(m, times));
    return x && y ? make_operation(m, MACHINE_ADD, type, x, y) : NULL;
}

struct machine_value *index_address_bare(struct machine_value *address, int bits)
{
    struct machine_value *v = graph_low_bits(address, bits);
    while (!v->buffer && v->op == NODE_CONCAT && v->in[0]->type.width >= bits)
        v = graph_low_bits(v->in[0], bits);
    return v;
}

bool index_is_address(const struct vpset *s)
{
    return !s->layout.blocks && (s->layout.order == MACHINE_SEND_ORDER || s->ratio == 1);
}

struct machine_value *index_of_address(struct machine *m, int set,
                                       struct machine_value *address)
{
    const struct vpset *s = &m->values->sets[set];
    int bits = machine_address_bits(m, set), width = address->type.width;
    struct machine_value *x = machine_extract(m, address, 0, bits < width ? bits : width),
                         *high, *low;
    x = machine_resize(m, x, INDEX_BITS, false);
    if (!x || index_is_address(s))
        return x;
    if (s->layout.blocks)
        return machine_layout_index_value(m, &s->layout, x);
    int processors_log2 = m->values->processors_log2;
    if (!index_divide(m, x, s->ratio, &high, &low))
        return NULL;
    struct machine_value *there = index_below(m, high, UINT64_C(1) << processors_log2);
    return index_where(m, there, index_sum(m, low, UINT64_C(1) << processors_log2, high));
}

struct machine_value *index_place(struct machine *m, const struct vpset *s,
                                  struct machine_value *x)
{
    struct machine_value *row, *column, *halo = index_number(m, (uint64_t)s->halo);
    if (!x || s->rows == 1)
        return x ? index_sum(m, x, 1, halo) : NULL;
    if (!index_divide(m, x, (uint64_t)s->width, &row, &column))
        return NULL;
    column = index_sum(m, column, 1, halo);
    return index_where(m, index_below(m, x, s->count), index_sum(m, row, s->pitch, column));
}
