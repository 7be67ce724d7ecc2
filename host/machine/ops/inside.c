/* inside.c - see machine_inside.h. */
#include "machine_inside.h"

#include "access/settle.h"
#include "device/device.h"
#include "memory/memory.h"
#include "ops/observe.h"
#include "sequencers/sequencers.h"
#include "values/graph.h"

const char *machine_busy(const struct machine *m)
{
    if (!pthread_equal(m->owner, pthread_self()))
        return "it belongs to another thread";
    if (m->inside || m->run->evaluating)
        return "it is in the midst of an evaluation";
    return NULL;
}

bool machine_forks(const struct machine *m)
{
    return m->device->is_pocl;
}

struct machine_waiting machine_waiting(const struct machine *m)
{
    return (struct machine_waiting){m->values->pending, (uint64_t)m->run->calls_noted};
}

struct machine_type machine_field_stored(struct machine *m, uint32_t field, uint32_t bits)
{
    uint32_t offset;
    const struct field *f = field_find(m, field, &offset);
    const struct slot *slot = f ? slot_exact(f, offset, bits) : NULL;
    return slot && slot->value->type.kind == MACHINE_FLOAT ? slot->value->type
                                                           : MACHINE_UINT(bits);
}

bool machine_field_at(const struct machine *m, int i, struct machine_field_info *out)
{
    return i >= 0 && i < m->memory->fields_count &&
           machine_field_lookup(m, m->memory->fields[i]->base, out);
}

bool machine_field_waits(const struct machine *m, uint32_t field)
{
    for (int i = 0; i < m->memory->fields_count; i++) {
        const struct field *f = m->memory->fields[i];
        for (int k = 0; f->base == field && k < f->slots_count; k++)
            if (f->slots[k].value->op != NODE_CONSTANT && !f->slots[k].value->buffer)
                return true;
    }
    return false;
}

enum machine_status machine_flag_download(struct machine *m, int vpset, enum machine_flag flag,
                                          uint8_t *out)
{
    settle(m);
    struct vpset *s = vpset_get(m, vpset);
    if (!s)
        return m->status;
    const int current = m->values->set_current;
    m->values->set_current = vpset;
    struct machine_value *v = graph_borrow(m, flag_resolved(m, s, flag));
    const enum machine_status status =
        v ? observe_out(m, vpset, v, out, "reading a flag") : m->status;
    m->values->set_current = current;
    return status;
}

struct machine_blocks machine_blocks(const struct machine *m)
{
    const struct sequencers *q = m->sequencers;
    return q ? (struct machine_blocks){q->run, q->divided, q->gathered, q->exchanged,
                                       q->machines_count}
             : (struct machine_blocks){0};
}
