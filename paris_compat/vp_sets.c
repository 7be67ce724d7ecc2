/* vp_sets.c - VP sets as data: the existing ones, the default one, and the current one. */
#include <stdlib.h>
#include <string.h>

#include "paris_saved.h"

CM_vp_set_id_t CM_current_vp_set = 0;
CM_geometry_id_t CM_current_geometry = 0;
unsigned int CM_current_send_address_length = 0;
unsigned int CM_virtual_to_physical_processor_ratio = 0;

static int default_set;

bool paris_set_valid(CM_vp_set_id_t set)
{
    return set >= 1 && set < paris_the.sets_count && paris_the.set_geometry[set];
}

CM_vp_set_id_t paris_set_default(void)
{
    return default_set;
}

bool paris_set_select(CM_vp_set_id_t set)
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

CM_vp_set_id_t paris_set_make(CM_geometry_id_t geometry)
{
    struct machine *m = paris_the.machine;
    const struct paris_geometry *g = paris_geometry_find(geometry);
    int set = machine_vpset_create_laid_out(m, g->dimensions, g->rank, &g->layout);
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

void paris_set_default_is(CM_vp_set_id_t set)
{
    default_set = set;
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

/* The default VP set: one virtual processor for each physical one, on two axes as equal in
 * length as possible. */
void paris_sets_reset(void)
{
    struct machine *m = paris_the.machine;
    for (int set = 1; set < paris_the.sets_count; set++)
        if (paris_the.set_geometry[set])
            machine_vpset_destroy(m, set);
    paris_sets_forget();
    int half = (int)CM_physical_processors_length / 2;
    struct paris_geometry g = {
        .rank = 2,
        .dimensions = {1 << half, 1 << ((int)CM_physical_processors_length - half)},
        .weight = {1, 1},
        .ordering = {CM_news_order, CM_news_order}};
    CM_geometry_id_t geometry = paris_geometry_complete(&g) ? paris_geometry_add(&g) : 0;
    default_set = geometry ? paris_set_make(geometry) : 0;
    if (default_set)
        paris_set_select(default_set);
    paris_the.pristine = true;
}
