/* fields.c - fields and flags: which value is where.
 *
 * A field is a row of bits in each processor. What is stored in it is kept as slots, each the
 * bits [offset, offset + bits) with one value; bits in no slot are 0. An access of just a
 * slot's bits gives its value; any other is put together from pieces. Ids are addresses in a
 * space of 2^31 bits that is not used again until it has been gone through, so an id that has
 * died stays dead for long. */
#include "watch/watch.h"

#include <stdlib.h>
#include <string.h>

#define ID_SPACE 0x7fff0000u

/* ---- fields ---- */

/* The first field whose base is above id. */
static int fields_above(const struct machine *m, uint32_t id)
{
    int low = 0, high = m->memory->fields_count;
    while (low < high) {
        int middle = (low + high) / 2;
        if (m->memory->fields[middle]->base <= id)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

void field_unlink_alias(struct field *alias)
{
    struct field **link = &alias->root->aliases;
    while (*link != alias)
        link = &(*link)->next_alias;
    *link = alias->next_alias;
}

/* An alias leaves what it holds to its root; with a root its aliases go. */
static void field_release(struct machine *m, int index)
{
    struct field *f = m->memory->fields[index];
    if (f->root) {
        if (f->root->newest == f)
            reshape_settle(m, f->root);
        f->root->newest = f->root->newest == f ? NULL : f->root->newest;
        field_unlink_alias(f);
    }
    f->newest = NULL;
    while (f->aliases)
        field_release(m, fields_above(m, f->aliases->base) - 1);
    index = fields_above(m, f->base) - 1;
    for (int i = 0; i < f->slots_count; i++)
        graph_unref(m, f->slots[i].value);
    free(f->slots);
    free(f);
    m->memory->fields_count--;
    memmove(&m->memory->fields[index], &m->memory->fields[index + 1],
            (size_t)(m->memory->fields_count - index) * sizeof *m->memory->fields);
}

void fields_finish(struct machine *m)
{
    for (int i = 0; i < m->memory->fields_count; i++)
        m->memory->fields[i]->newest = NULL; /* nobody is going to look */
    while (m->memory->fields_count)
        field_release(m, m->memory->fields_count - 1);
    free(m->memory->fields);
}

/* Where a new field of that many bits goes: on from the last one, and round once the space is
 * used up. */
static uint32_t find_room(struct machine *m, uint32_t bits)
{
    uint32_t room =
        (bits + 128) / 64 * 64; /* a gap between fields: an id never runs into the next one */
    for (int round = 0; round < 2; round++) {
        uint32_t base = m->memory->next_base;
        for (int i = fields_above(m, base); base <= ID_SPACE - room; i++) {
            if (i > 0 &&
                m->memory->fields[i - 1]->base + m->memory->fields[i - 1]->bits >= base)
                base = (m->memory->fields[i - 1]->base + m->memory->fields[i - 1]->bits + 128) /
                       64 * 64;
            if (base > ID_SPACE - room)
                break;
            if (i >= m->memory->fields_count || m->memory->fields[i]->base >= base + room) {
                m->memory->next_base = base + room;
                return base;
            }
        }
        m->memory->next_base = 64;
    }
    return MACHINE_NO_FIELD;
}

uint32_t machine_field_allocate(struct machine *m, int vpset, uint32_t bits,
                                enum machine_region region)
{
    if (!vpset_get(m, vpset))
        return MACHINE_NO_FIELD;
    if (bits > ID_SPACE / 4) {
        machine_fail(m, MACHINE_BAD_ARGUMENT, "a field has 0..%u bits (got %u)", ID_SPACE / 4,
                     bits);
        return MACHINE_NO_FIELD;
    }
    uint32_t base = find_room(m, bits);
    struct field *f = base ? calloc(1, sizeof *f) : NULL;
    if (f && m->memory->fields_count == m->memory->fields_capacity) {
        int capacity = m->memory->fields_capacity ? 2 * m->memory->fields_capacity : 64;
        struct field **fields = realloc(m->memory->fields, (size_t)capacity * sizeof *fields);
        if (fields) {
            m->memory->fields = fields;
            m->memory->fields_capacity = capacity;
        } else {
            free(f);
            f = NULL;
        }
    }
    if (!f) {
        machine_fail(m, MACHINE_NO_MEMORY, "there is no room for another field of %u bits",
                     bits);
        return MACHINE_NO_FIELD;
    }
    *f = (struct field){.base = base,
                        .bits = bits,
                        .vpset = vpset,
                        .region = region,
                        .serial = m->memory->serial++};
    int at = fields_above(m, base);
    memmove(&m->memory->fields[at + 1], &m->memory->fields[at],
            (size_t)(m->memory->fields_count - at) * sizeof *m->memory->fields);
    m->memory->fields[at] = f;
    m->memory->fields_count++;
    return base;
}

struct field *field_find(struct machine *m, uint32_t id, uint32_t *offset)
{
    int i = m->memory->last_found;
    if (!(i < m->memory->fields_count && m->memory->fields[i]->base <= id &&
          id - m->memory->fields[i]->base < m->memory->fields[i]->bits))
        i = fields_above(m, id) - 1;
    if (i < 0 || id - m->memory->fields[i]->base >= m->memory->fields[i]->bits) {
        machine_fail(m, MACHINE_BAD_ARGUMENT, "there is no field %u (any more)", id);
        return NULL;
    }
    m->memory->last_found = i;
    *offset = id - m->memory->fields[i]->base;
    return m->memory->fields[i];
}

bool machine_field_lookup(const struct machine *m, uint32_t field,
                          struct machine_field_info *out)
{
    int i = fields_above(m, field) - 1;
    if (i < 0 || (field - m->memory->fields[i]->base >= m->memory->fields[i]->bits &&
                  (m->memory->fields[i]->bits || field != m->memory->fields[i]->base)))
        return false;
    const struct field *f = m->memory->fields[i];
    *out = (struct machine_field_info){.base = f->base,
                                       .bits = f->bits,
                                       .offset = field - f->base,
                                       .vpset = f->vpset,
                                       .region = f->region};
    return true;
}

struct field *field_exact(struct machine *m, uint32_t id)
{
    int i = fields_above(m, id) - 1;
    return i >= 0 && m->memory->fields[i]->base == id ? m->memory->fields[i] : NULL;
}

bool field_room(const struct machine *m, const struct field *f, uint32_t bits)
{
    int i = fields_above(m, f->base);
    uint32_t end = f->base + (bits + 128) / 64 * 64;
    return bits <= ID_SPACE / 4 && end <= ID_SPACE &&
           (i >= m->memory->fields_count || end <= m->memory->fields[i]->base) &&
           (end <= m->memory->next_base || f->base >= m->memory->next_base);
}

void field_destroy(struct machine *m, struct field *f)
{
    field_release(m, fields_above(m, f->base) - 1);
}

static int exact_index(struct machine *m, uint32_t id, enum machine_region region)
{
    int i = fields_above(m, id) - 1;
    if (i >= 0 && m->memory->fields[i]->base == id && m->memory->fields[i]->region == region &&
        !m->memory->fields[i]->root)
        return i;
    machine_fail(m, MACHINE_BAD_ARGUMENT, "%u is not a field on the %s (any more)", id,
                 region == MACHINE_STACK ? "stack" : "heap");
    return -1;
}

enum machine_status machine_field_deallocate(struct machine *m, uint32_t field)
{
    int i = exact_index(m, field, MACHINE_HEAP);
    if (i < 0)
        return m->status;
    replay_forget(m);
    field_release(m, i);
    return MACHINE_OK;
}

enum machine_status machine_field_deallocate_through(struct machine *m, uint32_t field)
{
    int first = exact_index(m, field, MACHINE_STACK);
    if (first < 0)
        return m->status;
    replay_forget(m);
    uint64_t serial = m->memory->fields[first]->serial;
    for (int i = m->memory->fields_count - 1; i >= 0; i--)
        if (i < m->memory->fields_count && m->memory->fields[i]->region == MACHINE_STACK &&
            !m->memory->fields[i]->root && m->memory->fields[i]->serial >= serial)
            field_release(m, i);
    return MACHINE_OK;
}

/* ---- slots ---- */

void slot_set(struct machine *m, struct slot *slot, struct machine_value *v)
{
    graph_ref(v);
    replay_changes(m);
    if (slot->value && m->watch)
        watch_overwritten(m, slot->value, v);
    if (slot->value)
        graph_unref(m, slot->value);
    slot->value = v;
}

static struct machine_value *zero(struct machine *m, int width)
{
    return machine_constant(m, MACHINE_UINT(width), (struct machine_scalar){0, 0});
}

/* The first slot that ends beyond offset. */
static int slot_at(const struct field *f, uint32_t offset)
{
    int low = 0, high = f->slots_count;
    while (low < high) {
        int middle = (low + high) / 2;
        if (f->slots[middle].offset + f->slots[middle].bits <= offset)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static void slot_accessed(struct machine *m, struct slot *slot, bool overwrites)
{
    loops_slot_accessed(m, slot, overwrites);
    if (slot->epoch_accessed == m->values->epoch)
        return;
    slot->epoch_accessed = m->values->epoch;
    slot->overwritten_first = overwrites && slot->epoch_created != m->values->epoch;
}

static struct slot *slot_exact(const struct field *f, uint32_t offset, uint32_t bits)
{
    int i = slot_at(f, offset);
    return i < f->slots_count && f->slots[i].offset == offset && f->slots[i].bits == bits
               ? &f->slots[i]
               : NULL;
}

bool field_holds(const struct field *f, uint32_t offset, const struct machine_value *v)
{
    const struct slot *slot = slot_exact(f, offset, v->type.width);
    return slot && slot->value == v;
}

struct machine_value *field_content(struct machine *m, struct field *f, uint32_t offset,
                                    uint32_t bits)
{
    struct slot *slot = slot_exact(f, offset, bits);
    if (slot)
        return graph_borrow(m, slot->value);
    struct machine_value *sum = NULL;
    uint32_t at = offset, end = offset + bits;
    for (int i = slot_at(f, offset); at < end; i++) {
        uint32_t next =
            i < f->slots_count && f->slots[i].offset < end ? f->slots[i].offset : end;
        struct machine_value *piece;
        if (next > at) {
            piece = zero(m, (int)(next - at));
            sum = sum ? machine_concat(m, sum, piece) : piece;
            at = next;
        }
        if (at < end) {
            slot = &f->slots[i];
            uint32_t stop = slot->offset + slot->bits < end ? slot->offset + slot->bits : end;
            piece = machine_extract(m, slot->value, (int)(at - slot->offset), (int)(stop - at));
            sum = sum ? machine_concat(m, sum, piece) : piece;
            at = stop;
        }
        if (!sum)
            return NULL;
    }
    return sum;
}

static struct slot *slot_insert(struct machine *m, struct field *f, uint32_t offset,
                                uint32_t bits)
{
    replay_changes(m);
    if (f->slots_count == f->slots_capacity) {
        int capacity = f->slots_capacity ? 2 * f->slots_capacity : 2;
        struct slot *slots = realloc(f->slots, (size_t)capacity * sizeof *slots);
        INVARIANT(slots != NULL);
        f->slots = slots;
        f->slots_capacity = capacity;
    }
    int i = slot_at(f, offset);
    memmove(&f->slots[i + 1], &f->slots[i], (size_t)(f->slots_count - i) * sizeof *f->slots);
    f->slots_count++;
    f->slots[i] =
        (struct slot){.offset = offset, .bits = bits, .epoch_created = m->values->epoch};
    loops_slot_accessed(m, &f->slots[i], false);
    return &f->slots[i];
}

/* Makes [offset, offset + bits) free of slots; what of them lies outside stays. */
static void carve(struct machine *m, struct field *f, uint32_t offset, uint32_t bits)
{
    uint32_t end = offset + bits;
    int first = slot_at(f, offset), last = first;
    while (last < f->slots_count && f->slots[last].offset < end)
        last++;
    if (first == last)
        return;
    replay_changes(m);
    struct slot low = f->slots[first], high = f->slots[last - 1];
    struct machine_value *below =
        low.offset < offset ? machine_extract(m, low.value, 0, (int)(offset - low.offset))
                            : NULL;
    struct machine_value *above = high.offset + high.bits > end
                                      ? machine_extract(m, high.value, (int)(end - high.offset),
                                                        (int)(high.offset + high.bits - end))
                                      : NULL;
    for (int i = first; i < last; i++) {
        loops_slot_accessed(m, &f->slots[i], true);
        graph_unref(m, f->slots[i].value);
    }
    f->slots_count -= last - first;
    memmove(&f->slots[first], &f->slots[last],
            (size_t)(f->slots_count - first) * sizeof *f->slots);
    if (below)
        slot_set(m, slot_insert(m, f, low.offset, offset - low.offset), below);
    if (above)
        slot_set(m, slot_insert(m, f, end, high.offset + high.bits - end), above);
}

void field_slots_put(struct machine *m, struct field *f, uint32_t from, uint32_t to,
                     const struct slot *slots, int count)
{
    replay_changes(m);
    if (to > from)
        carve(m, f, from, to - from);
    while (f->slots_count + count > f->slots_capacity) {
        int capacity = f->slots_capacity ? 2 * f->slots_capacity : 2;
        struct slot *grown = realloc(f->slots, (size_t)capacity * sizeof *grown);
        INVARIANT(grown != NULL);
        f->slots = grown;
        f->slots_capacity = capacity;
    }
    if (count == 0)
        return;
    int i = slot_at(f, from);
    memmove(&f->slots[i + count], &f->slots[i],
            (size_t)(f->slots_count - i) * sizeof *f->slots);
    memcpy(&f->slots[i], slots, (size_t)count * sizeof *slots);
    f->slots_count += count;
}

enum machine_status field_replace(struct machine *m, struct field *f, uint32_t offset,
                                  struct machine_value *v)
{
    struct slot *slot = slot_exact(f, offset, v->type.width);
    graph_borrow(m, v); /* it may be what a slot that is carved away holds, and nobody else */
    if (!slot) {
        carve(m, f, offset, v->type.width);
        slot = slot_insert(m, f, offset, v->type.width);
    }
    slot_set(m, slot, v);
    return MACHINE_OK;
}

static struct field *field_part(struct machine *m, uint32_t id, struct machine_type type,
                                uint32_t *offset)
{
    struct field *f = field_find(m, id, offset);
    if (!f)
        return NULL;
    if (type.width < 1 || type.width > 128 || !soft_type_good(type) ||
        (type.kind == MACHINE_FLOAT && type.width != 32 && type.width != 64)) {
        machine_fail(m, MACHINE_BAD_ARGUMENT,
                     "a value's width must be 1..128 bits, a float's 32 or 64");
        return NULL;
    }
    int bits = machine_type_bits(type);
    if (*offset + (uint32_t)bits > f->bits) {
        machine_fail(m, MACHINE_BAD_ARGUMENT,
                     "%d bits from bit %u on run over the end of a field of %u bits", bits,
                     *offset, f->bits);
        return NULL;
    }
    return f;
}

struct machine_value *machine_field_value(struct machine *m, uint32_t field,
                                          struct machine_type type, enum machine_scope scope)
{
    replay_settle(m);
    uint32_t offset;
    if (type.s && soft_type_good(type))
        return soft_unpacked(
            m, machine_field_value(m, field, MACHINE_UINT(machine_type_bits(type)), scope),
            type);
    struct field *f = field_part(m, field, type, &offset);
    if (!f || !reshape_bring(m, f, false, false))
        return NULL;
    for (int i = slot_at(f, offset);
         i < f->slots_count && f->slots[i].offset < offset + type.width; i++)
        slot_accessed(m, &f->slots[i], false);
    struct machine_value *v = field_content(m, f, offset, type.width);
    if (v && scope == MACHINE_WHERE_ACTIVE && f->vpset == m->values->set_current)
        v = simplify_under(m, v, m->memory->flags[f->vpset].of[MACHINE_CONTEXT].value, 12);
    v = machine_reinterpret(m, v, type);
    return v ? graph_borrow(m, v) : NULL; /* a part of the content may outlive it */
}

enum machine_status machine_field_store(struct machine *m, uint32_t field,
                                        struct machine_value *value, enum machine_scope scope)
{
    replay_settle(m);
    if (value && value->type.s)
        value = soft_packed(m, value);
    if (!value)
        return m->status;
    uint32_t offset;
    struct field *f = field_part(m, field, value->type, &offset);
    if (!f)
        return m->status;
    if (value->set && value->set != f->vpset)
        return machine_fail(m, MACHINE_BAD_ARGUMENT,
                            "the value and the field belong to different VP sets");
    if (value->op == NODE_REINTERPRET && !value->buffer)
        value = value->in[0]; /* the same bits; a float that is moved as bits stays a float */
    if (!reshape_bring(m, f, true,
                       scope == MACHINE_EVERYWHERE && offset == 0 &&
                           value->type.width == f->bits))
        return m->status;
    struct slot *slot = slot_exact(f, offset, value->type.width);
    if (slot)
        slot_accessed(m, slot, true);
    if (scope == MACHINE_WHERE_ACTIVE) {
        struct machine_value *context = m->memory->flags[f->vpset].of[MACHINE_CONTEXT].value;
        struct machine_value *old = field_content(m, f, offset, value->type.width);
        old = machine_reinterpret(m, old, value->type);
        value = old ? machine_select(m, context, value, old) : NULL;
        if (!value)
            return m->status;
    }
    field_replace(m, f, offset, value);
    return run_after_store(m, value);
}

/* ---- flags ---- */

void flag_overflow_clear(struct machine *m, struct lazy_overflow *o)
{
    if (!o->op)
        return;
    replay_changes(m);
    graph_unref(m, o->a);
    if (o->b)
        graph_unref(m, o->b);
    graph_unref(m, o->context);
    o->op = 0;
}

/* Nobody has looked at it. */
static void overflow_forget(struct machine *m, struct vpset *s)
{
    m->values->vanished.overflows += flags_of(m, s)->overflow.op != 0;
    flag_overflow_clear(m, &flags_of(m, s)->overflow);
}

struct machine_value *flag_resolved(struct machine *m, struct vpset *s, enum machine_flag flag)
{
    struct lazy_overflow *o = &flags_of(m, s)->overflow;
    if (flag == MACHINE_OVERFLOW && o->op) {
        struct slot *slot = &flags_of(m, s)->of[MACHINE_OVERFLOW];
        struct machine_value *new =
            o->op == NODE_SELECT ? o->a : node_overflow(m, (enum node_op)o->op, o->a, o->b);
        struct machine_value *all =
            new ? machine_select(m, o->context, new, slot->value) : NULL;
        if (all)
            slot_set(m, slot, all);
        flag_overflow_clear(m, o);
    }
    return flags_of(m, s)->of[flag].value;
}

struct machine_value *machine_flag_value(struct machine *m, enum machine_flag flag,
                                         enum machine_scope scope)
{
    replay_settle(m);
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
    replay_settle(m);
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
            overflow_forget(m, s);
    }
    if (scope == MACHINE_WHERE_ACTIVE)
        value =
            machine_select(m, flags_of(m, s)->of[MACHINE_CONTEXT].value, value, slot->value);
    if (!value)
        return m->status;
    slot_set(m, slot, value);
    return run_after_store(m, value);
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
    replay_settle(m);
    replay_changes(m);
    struct machine_value *context = flags_of(m, s)->of[MACHINE_CONTEXT].value;
    if (flags_of(m, s)->overflow.op && flags_of(m, s)->overflow.context != context)
        flag_resolved(m, s, MACHINE_OVERFLOW);
    slot_accessed(m, &flags_of(m, s)->of[MACHINE_OVERFLOW], true);
    graph_ref(a);
    if (b)
        graph_ref(b);
    graph_ref(context);
    overflow_forget(m, s);
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
        a = zero(m, a->type.width);
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
