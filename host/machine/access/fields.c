/* fields.c - what a field holds: looked at and stored. */
#include "access/beyond.h"
#include "access/settle.h"
#include "alias/alias.h"
#include "base/errors.h"
#include "base/types.h"
#include "run/evaluate.h"
#include "run/notes.h"
#include "values/graph.h"
#include "values/make.h"
#include "values/simplify.h"
#include "values/soft.h"

enum machine_status machine_field_deallocate(struct machine *m, uint32_t field)
{
    int i = field_exact_index(m, field, MACHINE_HEAP);
    if (i < 0)
        return m->status;
    notes_forget(m);
    field_release(m, i);
    return MACHINE_OK;
}

enum machine_status machine_field_deallocate_through(struct machine *m, uint32_t field)
{
    int first = field_exact_index(m, field, MACHINE_STACK);
    if (first < 0)
        return m->status;
    notes_forget(m);
    uint64_t serial = m->memory->fields[first]->serial;
    for (int i = m->memory->fields_count - 1; i >= 0; i--)
        if (i < m->memory->fields_count && m->memory->fields[i]->region == MACHINE_STACK &&
            !m->memory->fields[i]->root && m->memory->fields[i]->serial >= serial)
            field_release(m, i);
    return MACHINE_OK;
}

static struct field *field_part(struct machine *m, uint32_t id, struct machine_type type,
                                uint32_t *offset)
{
    struct field *f = field_find(m, id, offset);
    if (!f)
        return NULL;
    if (type.width < 1 || type.width > 128 || !type_good(type) ||
        (type.kind == MACHINE_FLOAT && type.width != 32 && type.width != 64)) {
        machine_fail(m, MACHINE_BAD_ARGUMENT,
                     "a value's width must be 1..128 bits, a float's 32 or 64");
        return NULL;
    }
    int bits = type_field_bits(type);
    if (*offset + (uint32_t)bits > f->bits) {
        machine_fail(m, MACHINE_BAD_ARGUMENT,
                     "%d bits from bit %u on run over the end of a field of %u bits", bits,
                     *offset, f->bits);
        return NULL;
    }
    return f;
}

/* The two that follow, past a field's end: in pieces, each in a field. */
static struct machine_value *value_beyond(struct machine *m, uint32_t id,
                                          struct machine_type type, enum machine_scope scope)
{
    struct machine_value *sum = NULL;
    uint32_t bits = (uint32_t)type_field_bits(type);
    for (uint32_t at = 0, n; at < bits; at += n) {
        n = bits - at;
        uint32_t part = beyond_part(m, id, at, &n);
        struct machine_value *piece =
            part ? machine_field_value(m, part, MACHINE_UINT((int)n), scope)
                 : slot_zero(m, (int)n);
        sum = sum && piece ? machine_concat(m, sum, piece) : piece;
        if (!sum)
            return NULL;
    }
    return machine_reinterpret(m, sum, type);
}

static enum machine_status store_beyond(struct machine *m, uint32_t id,
                                        struct machine_value *value, enum machine_scope scope)
{
    uint32_t bits = (uint32_t)value->type.width;
    value = machine_reinterpret(m, value, MACHINE_UINT((int)bits));
    for (uint32_t at = 0, n; at < bits && value; at += n) {
        n = bits - at;
        uint32_t part = beyond_part(m, id, at, &n);
        struct machine_value *piece = machine_extract(m, value, (int)at, (int)n);
        if (!piece || (part && machine_field_store(m, part, piece, scope)))
            return m->status;
    }
    return value ? MACHINE_OK : m->status;
}

struct machine_value *machine_field_value(struct machine *m, uint32_t field,
                                          struct machine_type type, enum machine_scope scope)
{
    settle(m);
    uint32_t offset;
    if (type.s && type_good(type))
        return soft_unpacked(
            m, machine_field_value(m, field, MACHINE_UINT(type_field_bits(type)), scope), type);
    if (m->settings.lenient && beyond_field(m, field, (uint32_t)type_field_bits(type)))
        return value_beyond(m, field, type, scope);
    struct field *f = field_part(m, field, type, &offset);
    if (!f || !alias_bring(m, f, false, false))
        return NULL;
    for (int i = slot_at(f, offset);
         i < f->slots_count && f->slots[i].offset < offset + type.width; i++)
        slot_accessed(m, &f->slots[i], false);
    struct machine_value *v = field_content(m, f, offset, type.width);
    if (v && scope == MACHINE_WHERE_ACTIVE && f->vpset == m->values->set_current)
        v = simplify_under(m, v, m->memory->flags[f->vpset].of[MACHINE_CONTEXT].value, 12);
    v = machine_reinterpret(m, v, type);
    return v ? graph_borrow(m, v) : NULL; /* the result may be a part of the content that
                                           * outlives it */
}

enum machine_status machine_field_store(struct machine *m, uint32_t field,
                                        struct machine_value *value, enum machine_scope scope)
{
    settle(m);
    if (value && value->type.s)
        value = soft_packed(m, value);
    if (!value)
        return m->status;
    if (m->settings.lenient && beyond_field(m, field, (uint32_t)value->type.width))
        return store_beyond(m, field, value, scope);
    uint32_t offset;
    struct field *f = field_part(m, field, value->type, &offset);
    if (!f)
        return m->status;
    if (value->set && value->set != f->vpset)
        return machine_fail(m, MACHINE_BAD_ARGUMENT,
                            "the value and the field belong to different VP sets");
    value = graph_same_bits(m, value); /* a float that is moved as bits stays a float */
    if (!alias_bring(m, f, true,
                     scope == MACHINE_EVERYWHERE && offset == 0 &&
                         value->type.width == f->bits))
        return m->status;
    struct slot *slot = slot_exact(f, offset, value->type.width);
    if (slot)
        slot_accessed(m, slot, true);
    struct machine_value *context = m->memory->flags[f->vpset].of[MACHINE_CONTEXT].value;
    if (scope == MACHINE_WHERE_ACTIVE && !value_is_one_bit(context)) {
        struct machine_value *old = field_content(m, f, offset, value->type.width);
        old = machine_reinterpret(m, old, value->type);
        value = old ? machine_select(m, context, value, old) : NULL;
        if (!value)
            return m->status;
    }
    field_replace(m, f, offset, value);
    return evaluate_after_store(m, value);
}
