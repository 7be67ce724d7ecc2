/* materialise.c - puts values into memory: computed, filled, or uploaded. */
#include "run/materialise.h"

#include <stdlib.h>
#include <string.h>

#include "base/errors.h"
#include "base/scalar.h"
#include "base/types.h"
#include "memory/memory.h"
#include "run/evaluate.h"
#include "run/evaluation.h"
#include "sequencers/sequencers.h"
#include "values/graph.h"
#include "watch/watch.h"

/* Whether a NaN of any kind is among so many: loops without branches, which compilers make
 * vectors of. */
static bool nan_among(size_t bytes, const unsigned char *in, size_t count)
{
    unsigned found = 0;
    if (bytes == 4)
        for (size_t i = 0; i < count; i++) {
            uint32_t x;
            memcpy(&x, in + i * sizeof x, sizeof x);
            found |= (x & INT32_MAX) > UINT32_C(0x7f800000);
        }
    else
        for (size_t i = 0; i < count; i++) {
            uint64_t x;
            memcpy(&x, in + i * sizeof x, sizeof x);
            found |= (x & INT64_MAX) > UINT64_C(0x7ff0000000000000);
        }
    return found;
}

/* Strange NaNs are rare: pieces without any are passed over. */
bool materialise_has_strange_nan(struct machine_type type, const void *in, uint64_t count)
{
    enum { PIECE = 1024 };
    const unsigned char *at = in;
    size_t bytes = type_bytes(type);
    for (uint64_t done = 0; type.kind == MACHINE_FLOAT && done < count; done += PIECE) {
        size_t here = count - done < PIECE ? (size_t)(count - done) : PIECE;
        bool look = nan_among(bytes, at, here);
        for (size_t i = 0; look && i < here; i++) {
            uint64_t x = 0; /* the host is little-endian, as OpenCL's devices are */
            memcpy(&x, at + i * bytes, bytes);
            if (scalar_is_strange_nan(type, x))
                return true;
        }
        at += here * bytes;
    }
    return false;
}

static struct machine_value *upload_in_blocks(struct machine *m, int set,
                                              struct machine_type type, const void *in)
{
    struct device_buffer *b = sequencers_upload(m, set, type, in);
    struct machine_value *v = b ? graph_buffer_node(m, type, set, b) : NULL;
    if (v)
        v->strange_nan = materialise_has_strange_nan(type, in, m->values->sets[set].count);
    return v;
}

struct machine_value *materialise_upload(struct machine *m, int set, struct machine_type type,
                                         const void *in)
{
    const struct vpset *s = &m->values->sets[set];
    size_t element = type_bytes(type), bytes = geometry_bytes(s, type);
    if (m->sequencers && sequencers_cut(m, set))
        return upload_in_blocks(m, set, type, in);
    struct device_buffer *b = device_rows_get(m, geometry_rows(s, type));
    bool near = b && b->host && m->settings.near;
    if (near && m->watch)
        watch_bytes(m, bytes); /* of the wait that follows */
    if (near && device_settle_for(m, "writing a field")) {
        device_buffer_unref(m, b);
        return NULL;
    }
    unsigned char *copy = !b || near ? NULL : calloc(1, bytes), *image = near ? b->host : copy;
    if (!image) {
        if (b)
            device_buffer_unref(m, b);
        if (!m->status)
            machine_fail(m, MACHINE_NO_MEMORY,
                         "not enough memory to write a field of %zu bytes", bytes);
        return NULL;
    }
    size_t width = (size_t)s->width * element, halo = (size_t)s->halo * element;
    for (uint64_t row = 0; row < s->rows; row++) {
        unsigned char *to = image + row * s->pitch * element + halo;
        memcpy(to, (const unsigned char *)in + row * width, width);
        memcpy(to - halo, to + width - halo, halo);
        memcpy(to + width, to, halo);
    }
    enum machine_status status =
        near ? MACHINE_OK : device_write(m, b, 0, image, bytes, "writing a field");
    free(copy);
    if (status) {
        device_buffer_unref(m, b);
        return NULL;
    }
    struct machine_value *v = graph_buffer_node(m, type, set, b);
    v->strange_nan = materialise_has_strange_nan(type, in, s->count);
    return v;
}

void materialise_put(unsigned char *to, struct machine_scalar x, size_t element)
{
    memcpy(to, &x.lo, element < 8 ? element : 8);
    if (element > 8)
        memcpy(to + 8, &x.hi, 8);
}

/* The same number everywhere. */
static struct machine_value *number_filled(struct machine *m, int set,
                                           const struct machine_value *v, bool in_blocks)
{
    unsigned char pattern[16];
    materialise_put(pattern, v->imm, type_bytes(v->type));
    struct device_buffer *b =
        in_blocks ? sequencers_fill(m, set, v->type, pattern)
                  : device_rows_get(m, geometry_rows(&m->values->sets[set], v->type));
    if (!b)
        return NULL;
    if (!in_blocks && device_fill(m, b, pattern, type_bytes(v->type), "filling a field")) {
        device_buffer_unref(m, b);
        return NULL;
    }
    struct machine_value *number = graph_buffer_node(m, v->type, set, b);
    number->strange_nan = v->strange_nan;
    return number;
}

struct machine_value *materialise(struct machine *m, int set, struct machine_value *v)
{
    graph_borrow(m, v);
    if (v->op == NODE_CONSTANT && !v->buffer)
        return number_filled(m, set, v, false);
    if (!v->buffer ? evaluate_values(m, &v, 1, false)
                   : m->sequencers && sequencers_whole(m, v->buffer))
        return NULL;
    return v;
}

bool materialise_all(struct machine *m, int set, struct machine_value **values, int count)
{
    for (int i = 0; i < count; i++)
        if (values[i]->op == NODE_CONSTANT && !(values[i] = materialise(m, set, values[i])))
            return false;
    for (int i = 0; i < count; i++)
        if (!values[i]->buffer)
            return evaluate_values(m, values, count, false) == MACHINE_OK;
    for (int i = 0; m->sequencers && i < count; i++)
        if (sequencers_whole(m, values[i]->buffer))
            return false;
    return true;
}

struct machine_value *materialise_blocks(struct machine *m, int set, struct machine_value *v)
{
    if (!sequencers_cut(m, set))
        return materialise(m, set, v);
    graph_borrow(m, v);
    if (v->op == NODE_CONSTANT && !v->buffer)
        return number_filled(m, set, v, true);
    return v->buffer || !evaluate_in_blocks(m, &v, 1, false) ? v : NULL;
}

bool materialise_all_blocks(struct machine *m, int set, struct machine_value **values,
                            int count)
{
    if (!sequencers_cut(m, set))
        return materialise_all(m, set, values, count);
    for (int i = 0; i < count; i++)
        if (values[i]->op == NODE_CONSTANT &&
            !(values[i] = materialise_in_blocks(m, set, values[i])))
            return false;
    for (int i = 0; i < count; i++)
        if (!values[i]->buffer)
            return evaluate_in_blocks(m, values, count, false) == MACHINE_OK;
    return true;
}

static bool is_instead(const struct machine_value *held, const struct machine_value *v,
                       const struct machine_value *context)
{
    return held->op == NODE_SELECT && !held->buffer && held->in[0] == context &&
           held->in[1] == v && type_equal(held->type, v->type);
}

struct machine_value *materialise_instead(struct machine *m, struct machine_value *v,
                                          const struct machine_value *context)
{
    if (v->buffer || v->op == NODE_CONSTANT)
        return v;
    for (int i = 0; i < m->memory->fields_count; i++)
        for (int k = 0; k < m->memory->fields[i]->slots_count; k++) {
            const struct slot *slot = &m->memory->fields[i]->slots[k];
            if (is_instead(slot->value, v, context) && evaluation_wants(m, slot))
                return graph_borrow(m, slot->value);
        }
    return v;
}
