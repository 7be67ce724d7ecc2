/* slices.c - values divided into slices: see reshape.h. */
#include "run/slices.h"

#include "memory/call_set.h"
#include "run/near_shapes.h"
#include "run/run.h"
#include "values/graph.h"

bool slice_unpack(struct machine *m, struct machine_value *slice)
{
    struct machine_value *fine = slice->in[0], *out[SLICES_BLOCK] = {NULL};
    const struct vpset *f = &m->values->sets[fine->set], *s = &m->values->sets[slice->set];
    uint32_t k = (uint32_t)slice->imm.lo, wanted = 0;
    int first = slice->detail / SLICES_BLOCK * SLICES_BLOCK, count = (int)k - first;
    struct machine_value key = *slice;
    struct device_buffer *b[SLICES_BLOCK] = {NULL}, *any = NULL;
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
        any = b[i];
        wanted |= 1u << i;
    }
    enum machine_status status = MACHINE_OK;
    if (!near_slices(m, fine->set, slice->set, k, (uint32_t)first, (uint32_t)count, wanted,
                     type_bytes(slice->type), fine->buffer, b)) {
        struct kernel_call c = slices_call(m, slice->type, "slices");
        call_set(&c, m, f);
        call_set(&c, m, s);
        call_uint(&c, call_processors_run(m));
        call_uint(&c, k);
        call_uint(&c, (uint64_t)first);
        call_uint(&c, (uint64_t)count);
        call_uint(&c, wanted);
        call_buffer(&c, fine->buffer);
        for (int i = 0; i < SLICES_BLOCK; i++)
            call_buffer(&c, b[i] ? b[i] : any);
        status = call_processors(&c, m, (size_t)s->ratio, "reshaping");
    }
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
