/* paris_saved.h - geometries and VP sets as a saved machine has them: checkpoint.c writes and
 * reads them, vp_sets.c makes them again. */
#ifndef PARIS_SAVED_H
#define PARIS_SAVED_H

#include "paris_state.h"

struct paris_saved_geometry {
    int id, rank;
    int length[MACHINE_AXES_MAX], weight[MACHINE_AXES_MAX];
    uint8_t ordering[MACHINE_AXES_MAX];
    uint64_t count; /* processors */
};
struct paris_saved_set {
    int id, geometry;
    uint64_t count;
};

/* The set is what paris_set_default() gives. */
void paris_set_default_is(CM_vp_set_id_t set);
/* False: there is no such geometry. */
bool paris_geometry_saved(CM_geometry_id_t id, struct paris_saved_geometry *out);
/* In place of all that there are: these, by ascending ids. False: paris_error() says why
 * not. */
bool paris_sets_restore(const struct paris_saved_geometry *geometries,
                        uint64_t geometries_count, const struct paris_saved_set *sets,
                        uint64_t sets_count, int defaults);

#endif
