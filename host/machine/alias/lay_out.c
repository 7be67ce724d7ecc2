/* lay_out.c - converts a value to the rows of another geometry. */
#include "alias/alias.h"
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
    struct device_buffer *const out[SLICES_BLOCK] = {b};
    const struct slices_taken whole = {1, 0, 1, 1, v->type};
    enum machine_status status =
        slices_take(m, &m->values->sets[set], to, &whole, v->buffer, out);
    if (!status) {
        struct machine_value *laid = graph_buffer_node(m, v->type, set, b);
        laid->strange_nan = v->strange_nan;
        return laid;
    }
    device_buffer_unref(m, b);
    return NULL;
}
