/* gets.c - see gets.h. */
#include "ops/gets.h"

#include "ops/index.h"
#include "values/graph.h"

struct machine_value *gets_node(struct machine *m, struct machine_value *address,
                                struct machine_value *source, int set)
{
    const struct vpset *from = &m->values->sets[set];
    struct machine_value *place = index_place(m, from, index_of_address(m, set, address));
    uint64_t places =
        (uint64_t)from->halo + (from->rows == 1 ? from->count : from->rows * from->pitch);
    if (!place)
        return NULL;
    struct machine_value key = {.op = NODE_GATHER,
                                .type = source->type,
                                .set = (uint16_t)m->values->set_current,
                                .in = {place, source, index_number(m, places)}};
    return graph_node(m, &key);
}

bool gets_can(const struct machine *m, const struct machine_value *source, int set)
{
    const struct vpset *from = &m->values->sets[set];
    return !m->settings.eager && m->settings.gather && source->type.width <= 64 &&
           from->rows * from->pitch <= INT32_MAX;
}
