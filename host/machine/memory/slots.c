/* slots.c - the content of fields.
 *
 * Content is kept as slots: each slot is the bits [offset, offset + bits) with one value;
 * bits in no slot are 0. Reading exactly a slot's bits returns its value; any other range is
 * composed of pieces.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/errors.h"
#include "memory/lifetimes.h"
#include "memory/memory.h"
#include "values/graph.h"
#include "watch/watch.h"

void slot_set(struct machine *m, struct slot *slot, struct machine_value *v)
{
    graph_ref(v);
    v->stored = true;
    values_before_change(m);
    if (slot->value && m->watch && slot->value != v && !node_is_leaf(slot->value) &&
        !node_is_cheap(slot->value))
        watch_overwritten(m);
    if (slot->value)
        graph_unref(m, slot->value);
    slot->value = v;
}

struct machine_value *slot_zero(struct machine *m, int width)
{
    return machine_constant(m, MACHINE_UINT(width), (struct machine_scalar){0, 0});
}

int slot_search(const struct field *f, uint32_t offset)
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
            piece = slot_zero(m, (int)(next - at));
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
    values_before_change(m);
    if (f->slots_count == f->slots_capacity) {
        int capacity = f->slots_capacity ? 2 * f->slots_capacity : 2;
        struct slot *slots = realloc(f->slots, (size_t)capacity * sizeof *slots);
        NEEDS_MEMORY(slots);
        f->slots = slots;
        f->slots_capacity = capacity;
    }
    int i = slot_at(f, offset);
    memmove(&f->slots[i + 1], &f->slots[i], (size_t)(f->slots_count - i) * sizeof *f->slots);
    f->slots_count++;
    f->slots[i] =
        (struct slot){.offset = offset, .bits = bits, .epoch_created = m->values->epoch};
    lifetimes_accessed(m, &f->slots[i], false);
    return &f->slots[i];
}

/* Removes slots from [offset, offset + bits); their parts outside stay. */
static void carve(struct machine *m, struct field *f, uint32_t offset, uint32_t bits)
{
    uint32_t end = offset + bits;
    int first = slot_at(f, offset), last = first;
    while (last < f->slots_count && f->slots[last].offset < end)
        last++;
    if (first == last)
        return;
    values_before_change(m);
    struct slot low = f->slots[first], high = f->slots[last - 1];
    struct machine_value *below =
        low.offset < offset ? machine_extract(m, low.value, 0, (int)(offset - low.offset))
                            : NULL;
    struct machine_value *above = high.offset + high.bits > end
                                      ? machine_extract(m, high.value, (int)(end - high.offset),
                                                        (int)(high.offset + high.bits - end))
                                      : NULL;
    for (int i = first; i < last; i++) {
        lifetimes_accessed(m, &f->slots[i], true);
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
    values_before_change(m);
    if (to > from)
        carve(m, f, from, to - from);
    while (f->slots_count + count > f->slots_capacity) {
        int capacity = f->slots_capacity ? 2 * f->slots_capacity : 2;
        struct slot *grown = realloc(f->slots, (size_t)capacity * sizeof *grown);
        NEEDS_MEMORY(grown);
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
    graph_borrow(m, v); /* the value may be held only by a slot that is being carved away */
    if (!slot) {
        carve(m, f, offset, v->type.width);
        slot = slot_insert(m, f, offset, v->type.width);
    }
    slot_set(m, slot, v);
    return MACHINE_OK;
}

void memory_where(const struct machine *m, const struct machine_value *v, char *out,
                  size_t size)
{
    static const char *const flags[] = {"context", "test", "overflow"};
    *out = '\0';
    for (int i = 1; i < m->values->sets_count; i++)
        for (int flag = 0; m->values->sets[i].used && flag < 3; flag++)
            if (m->memory->flags[i].of[flag].value == v)
                snprintf(out, size, "%s of VP set %d", flags[flag], i);
    for (int i = 0; i < m->memory->fields_count && !*out; i++)
        for (int k = 0; k < m->memory->fields[i]->slots_count && !*out; k++)
            if (m->memory->fields[i]->slots[k].value == v)
                snprintf(out, size, "field %u",
                         m->memory->fields[i]->base + m->memory->fields[i]->slots[k].offset);
}
