/* VP sets, and the one that is current. */
#include <stdlib.h>
#include <string.h>

#include "paris_state.h"

CM_vp_set_id_t CM_current_vp_set = 0;
CM_geometry_id_t CM_current_geometry = 0;
unsigned int CM_current_send_address_length = 0;
unsigned int CM_virtual_to_physical_processor_ratio = 0;

static int default_set;

static bool set_valid(CM_vp_set_id_t set)
{
    return set >= 1 && set < paris_the.sets_count && paris_the.set_geometry[set];
}

static bool set_check(CM_vp_set_id_t set)
{
    paris_machine();
    if (set_valid(set))
        return true;
    paris_fail("vp_set: %d is not a VP set (any more): make it with CM_allocate_vp_set", set);
    return false;
}

static bool set_select(CM_vp_set_id_t set)
{
    if (machine_vpset_select(paris_the.machine, set) != MACHINE_OK) {
        paris_fail_machine();
        return false;
    }
    const struct paris_geometry *g = &paris_the.geometries[paris_the.set_geometry[set] - 1];
    CM_current_vp_set = set;
    CM_current_geometry = paris_the.set_geometry[set];
    CM_current_send_address_length = paris_address_bits(g);
    CM_virtual_to_physical_processor_ratio = (unsigned int)g->ratio;
    return true;
}

CM_vp_set_id_t CM_allocate_vp_set(CM_geometry_id_t geometry)
{
    struct machine *m = paris_begin("CM_allocate_vp_set");
    const struct paris_geometry *g = paris_geometry_of(geometry);
    if (!g)
        return 0;
    int set = machine_vpset_create_ordered(m, g->dimensions, g->rank, paris_geometry_order(g));
    if (!set) {
        paris_fail_machine();
        return 0;
    }
    if (set >= paris_the.sets_count) {
        int count = 2 * set + 8;
        int *grown = realloc(paris_the.set_geometry, (size_t)count * sizeof *grown);
        if (!grown) {
            machine_vpset_destroy(m, set);
            paris_fail_memory("not enough memory for another VP set");
            return 0;
        }
        memset(grown + paris_the.sets_count, 0,
               (size_t)(count - paris_the.sets_count) * sizeof *grown);
        paris_the.set_geometry = grown;
        paris_the.sets_count = count;
    }
    paris_the.set_geometry[set] = geometry;
    paris_the.geometries[geometry - 1].sets++;
    paris_the.pristine = false;
    return set;
}

void CM_deallocate_vp_set(CM_vp_set_id_t vp_set)
{
    struct machine *m = paris_begin("CM_deallocate_vp_set");
    if (!set_check(vp_set))
        return;
    if (vp_set == default_set) {
        paris_fail("vp_set: the default VP set stays as long as the machine");
        return;
    }
    if (vp_set == CM_current_vp_set) {
        if (paris_the.safety) {
            paris_fail("vp_set: it is the current one: call CM_set_vp_set with another first");
            return;
        }
        if (!set_select(default_set))
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
        set_select(vp_set);
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
    if (machine_vpset_arrange(m, vp_set, g->dimensions, g->rank, paris_geometry_order(g)) !=
        MACHINE_OK) {
        paris_fail_machine();
        return;
    }
    old->sets--;
    paris_the.geometries[geometry - 1].sets++;
    paris_the.set_geometry[vp_set] = geometry;
    paris_the.pristine = false;
    if (vp_set == CM_current_vp_set)
        set_select(vp_set);
}

CM_geometry_id_t CM_vp_set_geometry(CM_vp_set_id_t vp_set)
{
    paris_the.call = "CM_vp_set_geometry";
    return set_check(vp_set) ? paris_the.set_geometry[vp_set] : 0;
}

int CM_is_vp_set_valid(CM_vp_set_id_t vp_set)
{
    return set_valid(vp_set);
}

/* ---- beginning and end ---- */

void paris_sets_forget(void)
{
    free(paris_the.geometries);
    free(paris_the.set_geometry);
    paris_the.geometries = NULL;
    paris_the.set_geometry = NULL;
    paris_the.geometries_count = 0;
    paris_the.sets_count = 0;
    paris_the.leds = CM_no_field;
    default_set = 0;
    CM_current_vp_set = 0;
    CM_current_geometry = 0;
}

/* The default VP set: one virtual processor for each physical one, on two axes as equal as can
 * be. */
void paris_sets_reset(void)
{
    struct machine *m = paris_the.machine;
    for (int set = 1; set < paris_the.sets_count; set++)
        if (paris_the.set_geometry[set])
            machine_vpset_destroy(m, set);
    paris_sets_forget();
    int half = (int)CM_physical_processors_length / 2;
    int dimensions[2] = {1 << half, 1 << ((int)CM_physical_processors_length - half)};
    CM_geometry_id_t geometry = CM_create_geometry((CM_vector_t){.ints = dimensions}, 2);
    default_set = geometry ? CM_allocate_vp_set(geometry) : 0;
    if (default_set)
        set_select(default_set);
    paris_the.pristine = true;
}
