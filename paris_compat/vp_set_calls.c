/* vp_set_calls.c - the calls that create, select and rearrange VP sets. */
#include "paris_state.h"

static bool set_check(CM_vp_set_id_t set)
{
    paris_machine();
    if (paris_set_valid(set))
        return true;
    paris_fail("vp_set: %d is not a VP set (any more): make it with CM_allocate_vp_set", set);
    return false;
}

CM_vp_set_id_t CM_allocate_vp_set(CM_geometry_id_t geometry)
{
    paris_begin("CM_allocate_vp_set");
    return paris_geometry_of(geometry) ? paris_set_make(geometry) : 0;
}

void CM_deallocate_vp_set(CM_vp_set_id_t vp_set)
{
    struct machine *m = paris_begin("CM_deallocate_vp_set");
    if (!set_check(vp_set))
        return;
    if (vp_set == paris_set_default()) {
        paris_fail("vp_set: the default VP set stays as long as the machine");
        return;
    }
    if (vp_set == CM_current_vp_set) {
        if (paris_the.safety) {
            paris_fail("vp_set: it is the current one: call CM_set_vp_set with another first");
            return;
        }
        if (!paris_set_select(paris_set_default()))
            return;
    }
    if (machine_vpset_destroy(m, vp_set) != MACHINE_OK) {
        paris_fail_machine();
        return;
    }
    paris_the.geometries[paris_the.set_geometry[vp_set] - 1].sets--;
    paris_the.set_geometry[vp_set] = 0;
}

void CM_set_vp_set(CM_vp_set_id_t vp_set)
{
    paris_inquire("CM_set_vp_set");
    if (set_check(vp_set))
        paris_set_select(vp_set);
}

void CM_set_vp_set_geometry(CM_vp_set_id_t vp_set, CM_geometry_id_t geometry)
{
    struct machine *m = paris_begin("CM_set_vp_set_geometry");
    const struct paris_geometry *g = paris_geometry_of(geometry);
    if (!g || !set_check(vp_set))
        return;
    struct paris_geometry *old = &paris_the.geometries[paris_the.set_geometry[vp_set] - 1];
    if (g->count != old->count) {
        paris_fail("geometry: %d has %llu processors, the VP set %llu: they must be as many",
                   geometry, (unsigned long long)g->count, (unsigned long long)old->count);
        return;
    }
    if (machine_vpset_arrange(m, vp_set, g->dimensions, g->rank, &g->layout) != MACHINE_OK) {
        paris_fail_machine();
        return;
    }
    old->sets--;
    paris_the.geometries[geometry - 1].sets++;
    paris_the.set_geometry[vp_set] = geometry;
    paris_the.pristine = false;
    if (vp_set == CM_current_vp_set)
        paris_set_select(vp_set);
}

CM_geometry_id_t CM_vp_set_geometry(CM_vp_set_id_t vp_set)
{
    paris_the.call = "CM_vp_set_geometry";
    return set_check(vp_set) ? paris_the.set_geometry[vp_set] : 0;
}

int CM_is_vp_set_valid(CM_vp_set_id_t vp_set)
{
    return paris_set_valid(vp_set);
}
