/* saved_sets.c - geometries and VP sets under the ids that they had. */
#include <stdlib.h>
#include <string.h>

#include "paris_saved.h"

bool paris_geometry_saved(CM_geometry_id_t id, struct paris_saved_geometry *out)
{
    const struct paris_geometry *g = paris_geometry_find(id);
    if (!g)
        return false;
    *out = (struct paris_saved_geometry){.id = id, .rank = g->rank, .count = g->count};
    memcpy(out->length, g->dimensions, sizeof out->length);
    memcpy(out->weight, g->weight, sizeof out->weight);
    memcpy(out->ordering, g->ordering, sizeof out->ordering);
    return true;
}

/* Geometries are numbered in their order: what lies between them is made, and given back. */
static bool geometry_restore(const struct paris_saved_geometry *saved)
{
    struct paris_geometry g = {.rank = saved->rank};
    memcpy(g.dimensions, saved->length, sizeof g.dimensions);
    memcpy(g.weight, saved->weight, sizeof g.weight);
    memcpy(g.ordering, saved->ordering, sizeof g.ordering);
    if (!paris_geometry_complete(&g))
        return false;
    CM_geometry_id_t id;
    do
        id = paris_geometry_add(&g);
    while (id && id < saved->id);
    return id == saved->id;
}

/* The ids of geometries that are none. */
static void geometries_between_forget(const struct paris_saved_geometry *geometries,
                                      uint64_t count)
{
    int id = 1;
    for (uint64_t i = 0; i < count; i++)
        for (; id <= geometries[i].id; id++)
            if (id < geometries[i].id)
                paris_the.geometries[id - 1].rank = 0;
}

bool paris_sets_restore(const struct paris_saved_geometry *geometries,
                        uint64_t geometries_count, const struct paris_saved_set *sets,
                        uint64_t sets_count, int defaults)
{
    for (int set = 1; set < paris_the.sets_count; set++)
        if (paris_the.set_geometry[set])
            machine_vpset_destroy(paris_the.machine, set);
    paris_sets_forget();
    for (uint64_t i = 0; i < geometries_count; i++)
        if (!geometry_restore(&geometries[i]))
            return false;
    const int any = geometries_count ? geometries[0].id : 0;
    int id = 0;
    for (uint64_t i = 0; i < sets_count; i++)
        do
            id = paris_set_make(id + 1 < sets[i].id ? any : sets[i].geometry);
        while (id && id < sets[i].id);
    if (!id)
        return false;
    for (uint64_t i = 0, before = 1; i < sets_count; before = (uint64_t)sets[i++].id + 1)
        for (int set = (int)before; set < sets[i].id; set++) {
            machine_vpset_destroy(paris_the.machine, set);
            paris_the.geometries[any - 1].sets--;
            paris_the.set_geometry[set] = 0;
        }
    geometries_between_forget(geometries, geometries_count);
    paris_set_default_is(defaults);
    return true;
}
