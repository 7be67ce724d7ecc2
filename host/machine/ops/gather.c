/* gather.c - see gather.h. */
#include "ops/gather.h"

#include <string.h>

#include "base/scalar.h"
#include "base/types.h"
#include "run/materialise.h"
#include "values/graph.h"

static bool held_once(const struct machine *m, const struct machine_value *v)
{
    return v->refs <= graph_borrowed(m, v) + 1;
}

static bool is_own_leaf(const struct machine *m, const struct machine_value *v)
{
    return v->op == NODE_BUFFER && v->buffer && v->buffer->host && v->buffer->refs == 1 &&
           !v->buffer->blocks && held_once(m, v);
}

bool gather_is_own(const struct machine *m, const struct field *f, uint32_t offset,
                   const struct machine_value *v)
{
    return v->op == NODE_BUFFER && v->buffer->host && v->buffer->refs == 1 &&
           !v->buffer->blocks && !v->own_address &&
           v->refs <= graph_borrowed(m, v) + (uint32_t)field_holds(f, offset, v);
}

/* Nobody else looks at it, so numbers can be put into it. */
static bool gathers(const struct machine *m, const struct field *f, uint32_t offset,
                    const struct machine_value *v)
{
    return v->op == NODE_SELECT && !v->buffer && field_holds(f, offset, v) && held_once(m, v) &&
           v->in[0] != v->in[1] && is_own_leaf(m, v->in[0]) && is_own_leaf(m, v->in[1]);
}

/* All 0; NULL: error set. */
static struct machine_value *leaf(struct machine *m, int set, struct machine_type type)
{
    struct device_buffer *b = device_rows_get(m, geometry_rows(&m->values->sets[set], type));
    if (!b)
        return NULL;
    if (!b->host || device_settle(m)) {
        device_buffer_unref(m, b);
        return NULL;
    }
    memset(b->host, 0, b->bytes);
    return graph_buffer_node(m, type, set, b);
}

static struct machine_value *begin(struct machine *m, const struct field *f,
                                   struct machine_value *v)
{
    struct machine_value *mask = leaf(m, f->vpset, MACHINE_BIT),
                         *numbers = mask ? leaf(m, f->vpset, v->type) : NULL,
                         *all = numbers ? machine_select(m, mask, numbers, v) : NULL;
    bool good = all && all->op == NODE_SELECT && !all->buffer && all->in[0] == mask &&
                all->in[1] == numbers && all->in[2] == v;
    return good ? all : NULL;
}

bool gather_write(struct machine *m, struct field *f, uint32_t offset, struct machine_value *v,
                  uint64_t index, struct machine_scalar number, enum machine_status *status)
{
    if (!m->settings.near || !m->device->is_pocl || m->settings.eager || v->buffer ||
        v->op == NODE_CONSTANT || v->type.s ||
        materialise_has_strange_nan(v->type, &number.lo, 1))
        return false;
    bool more = gathers(m, f, offset, v);
    struct machine_value *all = more ? v : begin(m, f, v);
    if (!all || device_settle(m))
        return false;
    size_t places[3], element = type_bytes(v->type);
    int count = geometry_places(&m->values->sets[f->vpset], index, places);
    for (int i = 0; i < count; i++) {
        *((unsigned char *)all->in[0]->buffer->host + places[i]) = 1;
        materialise_put((unsigned char *)all->in[1]->buffer->host + places[i] * element,
                        scalar_cut(number, v->type.width), element);
    }
    *status = more && !f->root && !f->aliases
                  ? MACHINE_OK
                  : machine_field_store(m, f->base + offset, all, MACHINE_EVERYWHERE);
    return true;
}
