/* fields.c - fields: allocated, found, released.
 *
 * A field is a row of bits in each processor. Ids are addresses in a space of 2^31 bits,
 * assigned in ascending order until the space is used up. So the id of a deallocated field
 * stays invalid for a long time.
 */
#include <stdlib.h>
#include <string.h>

#include "base/errors.h"
#include "memory/memory.h"
#include "values/graph.h"

#define ID_SPACE 0x7fff0000u

enum { GAP_LENIENT = 4096 }; /* how far an offset may lead past a field's end */

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

void field_release(struct machine *m, int index)
{
    struct field *f = m->memory->fields[index];
    memset(m->memory->found, 0, sizeof m->memory->found);
    if (f->root) {
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
        m->memory->fields[i]->newest = NULL; /* the content is not needed any more */
    while (m->memory->fields_count)
        field_release(m, m->memory->fields_count - 1);
    free(m->memory->fields);
}

/* Where a new field of that many bits goes: on from the last one, and round once the space is
 * used up. */
static uint32_t find_room(struct machine *m, uint32_t room)
{
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
    /* A gap between fields: an id never runs into the next one. */
    uint32_t room = (bits + 128) / 64 * 64 + (m->settings.lenient ? GAP_LENIENT : 0);
    uint32_t base = find_room(m, room);
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
                        .room = room,
                        .vpset = vpset,
                        .region = region,
                        .serial = m->memory->serial++};
    int at = fields_above(m, base);
    memmove(&m->memory->fields[at + 1], &m->memory->fields[at],
            (size_t)(m->memory->fields_count - at) * sizeof *m->memory->fields);
    m->memory->fields[at] = f;
    m->memory->fields_count++;
    if (region == MACHINE_HEAP && bits)
        device_expect(m->device, geometry_rows(&m->values->sets[vpset],
                                               MACHINE_UINT(bits < 128 ? (int)bits : 128)));
    return base;
}

struct field *field_search(struct machine *m, uint32_t id, uint32_t *offset)
{
    int i = fields_above(m, id) - 1;
    if (i < 0 || id - m->memory->fields[i]->base >= m->memory->fields[i]->bits) {
        machine_fail(m, MACHINE_BAD_ARGUMENT, "there is no field %u (any more)", id);
        return NULL;
    }
    m->memory->found[field_line(id)] = m->memory->fields[i];
    *offset = id - m->memory->fields[i]->base;
    return m->memory->fields[i];
}

bool machine_field_lookup(const struct machine *m, uint32_t field,
                          struct machine_field_info *out)
{
    const struct field *f = m->memory->found[field_line(field)];
    if (!f || field - f->base >= f->bits) {
        int i = fields_above(m, field) - 1;
        f = i < 0 ? NULL : m->memory->fields[i];
        if (!f || (field - f->base >= f->bits && (f->bits || field != f->base)))
            return false;
    }
    *out = (struct machine_field_info){.base = f->base,
                                       .bits = f->bits,
                                       .offset = field - f->base,
                                       .vpset = f->vpset,
                                       .region = f->region};
    return true;
}

struct field *field_near(const struct machine *m, uint32_t id, uint32_t *offset)
{
    int i = fields_above(m, id) - 1;
    if (i < 0 || id - m->memory->fields[i]->base >= m->memory->fields[i]->room)
        return NULL;
    *offset = id - m->memory->fields[i]->base;
    return m->memory->fields[i];
}

int machine_field_vpset(const struct machine *m, uint32_t id)
{
    struct field *f = m->memory->found[field_line(id)];
    if (!f || id - f->base >= f->bits) {
        int i = fields_above(m, id) - 1;
        if (i < 0)
            return 0;
        f = m->memory->fields[i];
        m->memory->found[field_line(id)] = f; /* what looks next looks there */
    }
    return id - f->base < (m->settings.lenient ? f->room : f->bits) ? f->vpset : 0;
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

int field_exact_index(struct machine *m, uint32_t id, enum machine_region region)
{
    int i = fields_above(m, id) - 1;
    if (i >= 0 && m->memory->fields[i]->base == id && m->memory->fields[i]->region == region &&
        !m->memory->fields[i]->root)
        return i;
    machine_fail(m, MACHINE_BAD_ARGUMENT, "%u is not a field on the %s (any more)", id,
                 region == MACHINE_STACK ? "stack" : "heap");
    return -1;
}
