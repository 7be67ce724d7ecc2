/* The lights on the machine's front: a hidden field of the VP set that latched last holds their
 * pattern. */
#include <stdlib.h>

#include "paris_state.h"

static bool leds_here(struct machine *m)
{
    struct machine_field_info info;
    if (machine_field_lookup(m, paris_the.leds, &info)) {
        if (info.vpset == CM_current_vp_set)
            return true;
        machine_field_deallocate(m, paris_the.leds);
    }
    paris_the.leds = machine_field_allocate(m, CM_current_vp_set, 1, MACHINE_HEAP);
    if (paris_the.leds == MACHINE_NO_FIELD)
        paris_fail_machine();
    return paris_the.leds != MACHINE_NO_FIELD;
}

static void latch(const char *name, CM_field_id_t source, enum machine_scope scope)
{
    struct machine *m = paris_begin(name);
    if (!leds_here(m))
        return;
    struct machine_value *v = paris_load_bit(m, source, "source", scope);
    if (v && machine_field_store(m, paris_the.leds, v, scope) != MACHINE_OK)
        paris_fail_machine();
}

void CM_latch_leds(CM_field_id_t source)
{
    latch("CM_latch_leds", source, MACHINE_WHERE_ACTIVE);
}

void CM_latch_leds_always(CM_field_id_t source)
{
    latch("CM_latch_leds_always", source, MACHINE_EVERYWHERE);
}

uint64_t paris_leds_read(uint8_t *out, uint64_t limit)
{
    struct machine_field_info info;
    if (!paris_the.machine || !machine_field_lookup(paris_the.machine, paris_the.leds, &info))
        return 0;
    uint64_t count = machine_vpset_count(paris_the.machine, info.vpset);
    uint8_t *all = malloc(count);
    if (!all || machine_field_download(paris_the.machine, paris_the.leds, MACHINE_BIT, all) !=
                    MACHINE_OK)
        count = 0;
    for (uint64_t i = 0; i < count && i < limit; i++)
        out[i] = all[i];
    free(all);
    return count;
}
