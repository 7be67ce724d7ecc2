/* shapes.c - other shapes of the same bits, and conversions. */
#include "base/parts.h"
#include "base/types.h"
#include "values/make.h"
#include "values/simplify.h"

static struct machine_value *as_bits(struct machine *m, struct machine_value *a)
{
    return machine_reinterpret(m, a, MACHINE_UINT(a->type.width));
}

static struct machine_value *resized(struct machine *m, struct machine_value *a, int width,
                                     bool is_signed)
{
    if (!a)
        return NULL;
    if (!type_is_bits(width) || a->type.kind != MACHINE_BITS)
        return make_bad(m, "only bits can be made wider or narrower, to 1..128 of them");
    if (width == a->type.width)
        return a;
    if (width < a->type.width)
        return machine_extract(m, a, 0, width);
    if (value_is_number(a)) {
        unsigned __int128 x = scalar_wide(a->imm);
        if (is_signed && (x >> (a->type.width - 1) & 1))
            x |= ~(unsigned __int128)0 << (a->type.width - 1);
        return make_number(m, MACHINE_UINT(width), scalar_narrow(x));
    }
    return make_node(m, is_signed ? NODE_SIGN_EXTEND : NODE_ZERO_EXTEND, MACHINE_UINT(width), 0,
                     a, NULL, NULL);
}

struct machine_value *machine_resize(struct machine *m, struct machine_value *a, int width,
                                     bool is_signed)
{
    return make_handed(m, resized(m, a, width, is_signed));
}

static struct machine_value *extracted(struct machine *m, struct machine_value *a, int offset,
                                       int width)
{
    if (!a)
        return NULL;
    if (offset < 0 || width < 1 || offset + width > a->type.width)
        return make_bad(m, "the bits to extract are not all there");
    a = as_bits(m, a);
    if (width == a->type.width)
        return a;
    if (value_is_number(a))
        return make_number(m, MACHINE_UINT(width),
                           scalar_narrow(scalar_wide(a->imm) >> offset));
    if (simplify_chooses_number(a, 4))
        return machine_select(m, a->in[0], machine_extract(m, a->in[1], offset, width),
                              machine_extract(m, a->in[2], offset, width));
    if (!a->buffer && a->op == NODE_EXTRACT)
        return machine_extract(m, a->in[0], offset + a->detail, width);
    if (!a->buffer && a->op == NODE_CONCAT) {
        int low = a->in[0]->type.width;
        if (offset + width <= low)
            return machine_extract(m, a->in[0], offset, width);
        if (offset >= low)
            return machine_extract(m, a->in[1], offset - low, width);
    }
    if (!a->buffer && (a->op == NODE_ZERO_EXTEND || a->op == NODE_SIGN_EXTEND) &&
        offset + width <= a->in[0]->type.width)
        return machine_extract(m, a->in[0], offset, width);
    return make_node(m, NODE_EXTRACT, MACHINE_UINT(width), offset, a, NULL, NULL);
}

struct machine_value *machine_extract(struct machine *m, struct machine_value *a, int offset,
                                      int width)
{
    return make_handed(m, extracted(m, a, offset, width));
}

struct machine_value *machine_concat(struct machine *m, struct machine_value *low,
                                     struct machine_value *high)
{
    if (!low || !high)
        return NULL;
    int width = low->type.width + high->type.width;
    if (width > 128)
        return make_bad(m, "a value has at most 128 bits");
    low = as_bits(m, low);
    high = as_bits(m, high);
    if (value_is_number(low) && value_is_number(high))
        return make_number(
            m, MACHINE_UINT(width),
            scalar_narrow(scalar_wide(high->imm) << low->type.width | scalar_wide(low->imm)));
    if (!low->buffer && !high->buffer && low->op == NODE_EXTRACT && high->op == NODE_EXTRACT &&
        low->in[0] == high->in[0] && low->detail + low->type.width == high->detail)
        return machine_extract(m, low->in[0], low->detail, width);
    return make_node(m, NODE_CONCAT, MACHINE_UINT(width), 0, low, high, NULL);
}

struct machine_value *machine_to_float(struct machine *m, struct machine_value *a,
                                       struct machine_type type, bool is_signed)
{
    if (!a)
        return NULL;
    if (type.kind != MACHINE_FLOAT || (type.width != 32 && type.width != 64) ||
        !type_good(type))
        return make_bad(m, "a float is 32 or 64 bits");
    if (type_equal(a->type, type))
        return a;
    int op = a->type.kind == MACHINE_FLOAT ? NODE_F_TO_F
             : is_signed                   ? NODE_S_TO_F
                                           : NODE_U_TO_F;
    return make_node(m, op, type, 0, a, NULL, NULL);
}

struct machine_value *machine_to_bits(struct machine *m, struct machine_value *a, int width,
                                      bool is_signed)
{
    if (!a)
        return NULL;
    if (a->type.kind != MACHINE_FLOAT || !type_is_bits(width))
        return make_bad(m, "a float becomes 1..128 bits");
    return make_node(m, is_signed ? NODE_F_TO_S : NODE_F_TO_U, MACHINE_UINT(width), 0, a, NULL,
                     NULL);
}
