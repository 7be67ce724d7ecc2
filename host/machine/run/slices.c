/* slices.c - values divided into slices: see reshape.h. */
#include "run/slices.h"

#include "memory/call_set.h"
#include "run/near_shapes.h"
#include "run/run.h"
#include "sequencers/sequencers.h"
#include "values/graph.h"

enum machine_status slices_take(struct machine *m, const struct vpset *from,
                                const struct vpset *to, const struct slices_taken *t,
                                const struct device_buffer *in,
                                struct device_buffer *const out[SLICES_BLOCK])
{
    const struct device_buffer *any = out[__builtin_ctz(t->wanted)];
    if (near_slices(m, from, to, t, in, out))
        return MACHINE_OK;
    struct kernel_call c = slices_call(m, t->type, "slices");
    call_set(&c, m, from);
    call_set(&c, m, to);
    call_uint(&c, call_processors_run(m));
    call_uint(&c, t->k);
    call_uint(&c, t->first);
    call_uint(&c, t->count);
    call_uint(&c, t->wanted);
    call_buffer(&c, in);
    for (int i = 0; i < SLICES_BLOCK; i++)
        call_buffer(&c, out[i] ? out[i] : any);
    return call_processors(&c, m, (size_t)to->ratio, "reshaping");
}

bool slice_unpack(struct machine *m, struct machine_value *slice)
{
    struct machine_value *fine = slice->in[0], *out[SLICES_BLOCK] = {NULL};
    const struct vpset *f = &m->values->sets[fine->set], *s = &m->values->sets[slice->set];
    uint32_t k = (uint32_t)slice->imm.lo, wanted = 0;
    int first = slice->detail / SLICES_BLOCK * SLICES_BLOCK, count = (int)k - first;
    struct machine_value key = *slice;
    struct device_buffer *b[SLICES_BLOCK] = {NULL};
    count = count < SLICES_BLOCK ? count : SLICES_BLOCK;
    for (int i = 0; i < count; i++) {
        key.detail = first + i;
        out[i] = first + i == slice->detail ? slice : graph_find(m, &key);
        if (!out[i] || out[i]->buffer)
            continue;
        b[i] = device_rows_get(m, geometry_rows(s, slice->type));
        if (!b[i]) {
            for (; i >= 0; i--)
                if (b[i])
                    device_buffer_unref(m, b[i]);
            return false;
        }
        wanted |= 1u << i;
    }
    const struct slices_taken taken = {k, (uint32_t)first, (uint32_t)count, wanted,
                                       slice->type};
    enum machine_status status = m->sequencers ? sequencers_whole(m, fine->buffer) : MACHINE_OK;
    status = status ? status : slices_take(m, f, s, &taken, fine->buffer, b);
    for (int i = 0; i < SLICES_BLOCK; i++)
        if (b[i] && status)
            device_buffer_unref(m, b[i]);
        else if (b[i])
            graph_materialised(m, out[i], b[i]);
    return status == MACHINE_OK;
}

struct machine_value *slice_make(struct machine *m, struct machine_value *fine, int set,
                                 uint32_t k, uint32_t i)
{
    if (fine->op == NODE_CONSTANT || (k == 1 && fine->set == set))
        return fine;
    m->run->sliced = true;
    struct machine_value key = {.op = NODE_SLICE,
                                .type = fine->type,
                                .set = (uint16_t)set,
                                .detail = (int32_t)i,
                                .imm = {k, 0},
                                .in = {fine, NULL, NULL}};
    return graph_node(m, &key);
}

bool slices_forget_set(struct machine *m, int set)
{
    for (uint32_t i = 0; i < m->values->table_size; i++)
        for (struct machine_value *v = m->values->table[i]; v; v = v->next)
            if (v->op == NODE_SLICE && !v->buffer && (v->set == set || v->in[0]->set == set) &&
                !slice_unpack(m, v))
                return false;
    for (uint32_t i = 0; i < m->values->table_size; i++)
        for (struct machine_value *v = m->values->table[i], *next; v; v = next) {
            next = v->next;
            if ((v->op == NODE_SLICE && (v->set == set || v->in[0]->set == set)) ||
                (v->buffer && v->set == set)) {
                graph_forget(m, v);
                next = m->values->table[i]; /* its input may have been released with it */
            }
        }
    return true;
}
