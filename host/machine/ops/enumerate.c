/* enumerate.c - how many active processors there are before each.
 *
 * Along a single axis the front end counts by itself, from the context alone, and puts the
 * ranks where they belong: into the field's own array, if nobody else looks at it. Otherwise it
 * is a scan that adds 1, which is stored under the context. */
#include "base/scalar.h"
#include "base/types.h"
#include "memory/memory.h"
#include "ops/gather.h"
#include "ops/message.h"
#include "ops/near.h"
#include "ops/near_pack.h"
#include "run/materialise.h"
#include "values/graph.h"
#include "values/make.h"

static bool is_near(struct machine *m, const struct vpset *s, const struct machine_scan *how,
                    int width)
{
    const struct machine_value *context = flags_of(m, s)->of[MACHINE_CONTEXT].value;
    return m->settings.near && m->device->is_pocl && s->rank == 1 && how->axis == 0 &&
           s->count < UINT32_MAX && how->segments == MACHINE_UNSEGMENTED && !how->downward &&
           type_bytes(MACHINE_UINT(width)) == sizeof(uint32_t) && !value_is_number(context);
}

/* Where the ranks go: the field's own array, or a new one. */
static struct device_buffer *room_for(struct machine *m, const struct vpset *s,
                                      const struct field *f, uint32_t offset,
                                      struct machine_value *old)
{
    if (!gather_is_own(m, f, offset, old))
        return message_array(m, s, old->type);
    device_buffer_ref(old->buffer);
    return old->buffer;
}

/* What the field holds then, in all processors. NULL: it cannot be done so, or there is an
 * error. */
static struct machine_value *ranks_near(struct machine *m, const struct machine_scan *how,
                                        uint32_t dest, struct machine_type type)
{
    const int set = m->values->set_current;
    struct machine_value *old = machine_field_value(m, dest, type, MACHINE_EVERYWHERE);
    uint32_t offset;
    const struct field *f = old ? field_find(m, dest, &offset) : NULL;
    if (!f || f->vpset != set)
        return NULL;
    struct machine_value *wanted[2] = {flag_held(m, set, MACHINE_CONTEXT), old};
    if (!materialise_all(m, set, wanted, old->op == NODE_CONSTANT && !old->buffer ? 1 : 2))
        return NULL;
    const struct machine_value *context = wanted[0];
    const struct vpset *s = &m->values->sets[set];
    known_ranks_forget(m); /* they may be what the field holds */
    struct device_buffer *out = room_for(m, s, f, offset, wanted[1]);
    double start;
    struct machine_value *v = NULL;
    if (out && near_begin(m, out, &start)) {
        const int parts =
            device_parts(m, 1e-9 * m->device->shape.scan_vector_ns * (double)s->count);
        near_enumerate(m->device->crew, parts, s, context->buffer, wanted[1], !how->exclusive,
                       (uint32_t)scalar_ones(type.width).lo, out);
        near_end(m, "scanning", start);
        v = out == wanted[1]->buffer ? wanted[1] : graph_buffer_node(m, type, set, out);
    }
    if (out && (!v || v == wanted[1]))
        device_buffer_unref(m, out);
    return v;
}

enum machine_status machine_enumerate(struct machine *m, const struct machine_scan *how,
                                      uint32_t dest, int width)
{
    const struct machine_type type = MACHINE_UINT(width);
    const struct vpset *s = vpset_get(m, m->values->set_current);
    struct machine_scan adds = *how;
    adds.op = MACHINE_SCAN_ADD;
    if (!s)
        return m->status;
    struct machine_value *v = is_near(m, s, how, width) ? ranks_near(m, how, dest, type) : NULL;
    if (v && how->exclusive && (width == 32 || (s->count - 1) >> width == 0))
        known_ranks_note(m, v,
                         m->memory->flags[m->values->set_current].of[MACHINE_CONTEXT].value);
    if (v)
        return machine_field_store(m, dest, v, MACHINE_EVERYWHERE);
    v = machine_constant(m, MACHINE_UINT(32), (struct machine_scalar){1, 0});
    v = v ? machine_scan(m, &adds, v) : NULL;
    v = v ? machine_resize(m, v, width, false) : NULL;
    return v ? machine_field_store(m, dest, v, MACHINE_WHERE_ACTIVE) : m->status;
}
