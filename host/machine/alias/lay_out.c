/* lay_out.c - converts a value to the rows of another geometry. */
#include "alias/alias.h"
#include "memory/call_set.h"
#include "run/materialise.h"
#include "run/slices.h"
#include "values/graph.h"

struct machine_value *lay_out_value(struct machine *m, struct machine_value *v, int set,
                                    const struct vpset *to)
{
    v = materialise(m, set, v);
    struct device_buffer *b = v ? device_rows_get(m, geometry_rows(to, v->type)) : NULL;
    if (!b)
        return NULL;
    struct kernel_call c = slices_call(m, v->type, "slices");
    call_set(&c, m, &m->values->sets[set]);
    call_set(&c, m, to);
    call_uint(&c, call_processors_run(m));
    call_uint(&c, 1); /* one slice: the whole value */
    call_uint(&c, 0);
    call_uint(&c, 1);
    call_uint(&c, 1);
    call_buffer(&c, v->buffer);
    for (int i = 0; i < SLICES_BLOCK; i++)
        call_buffer(&c, b);
    enum machine_status status = call_processors(&c, m, (size_t)to->ratio, "reshaping");
    if (!status) {
        struct machine_value *out = graph_buffer_node(m, v->type, set, b);
        out->strange_nan = v->strange_nan;
        return out;
    }
    device_buffer_unref(m, b);
    return NULL;
}
