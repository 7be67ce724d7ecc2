/* The lights on the machine's front: a hidden field of the VP set that latched last holds their
 * pattern. If LUTETIA_LEDS is set, each latch is recorded.
 *
 * There are 4096 lights, 64 in a row, one for each chip of a full machine, and a chip has a
 * patch of neighbours of the grid: of a VP set with n rows and m columns (its last axis; all
 * others together are the rows) the light in row r and column c stands for rows r*n/64 up to
 * (r+1)*n/64, one at least, and the like of columns, and is on where a virtual processor of
 * them latched a 1. Along a single axis of n, light l stands for l*n/4096 up to
 * (l+1)*n/4096. So the front shows a picture of the set, whatever its size and the number of
 * physical processors.
 */
#include <stdlib.h>
#include <string.h>

#include "leds.h"
#include "paris_state.h"

static unsigned int system_mode; /* 0: programs have the lights */
static struct paris_pattern pattern;

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

static void record(void)
{
    uint8_t lights[PARIS_LIGHTS_BYTES];
    if (!leds_recording())
        return;
    if (system_mode)
        paris_pattern_step(&pattern, lights);
    else if (!paris_lights_read(lights))
        return;
    leds_record(lights);
}

static void latch(const char *name, CM_field_id_t source, enum machine_scope scope)
{
    struct machine *m = paris_begin(name);
    if (!leds_here(m))
        return;
    struct machine_value *v = paris_load_bit(m, source, "source", scope);
    if (!v)
        return;
    if (machine_field_store(m, paris_the.leds, v, scope) != MACHINE_OK)
        paris_fail_machine();
    else
        record();
}

PARIS_OF_A_FIELD(CM_latch_leds, source, !leds_recording(),
                 latch("CM_latch_leds", source, MACHINE_WHERE_ACTIVE))
PARIS_OF_A_FIELD(CM_latch_leds_always, source, !leds_recording(),
                 latch("CM_latch_leds_always", source, MACHINE_EVERYWHERE))

void CM_set_system_leds_mode(unsigned int mode)
{
    paris_begin("CM_set_system_leds_mode");
    if (mode > PARIS_PATTERNS_LAST) {
        paris_fail("mode: must be 0 (the program's lights) or a pattern 1..%d (got %u)",
                   PARIS_PATTERNS_LAST, mode);
        return;
    }
    system_mode = mode;
    pattern = paris_pattern_begin(mode);
    struct machine_field_info info;
    if (mode || machine_field_lookup(paris_the.machine, paris_the.leds, &info))
        record();
}

unsigned int CM_system_leds_mode(void)
{
    return system_mode;
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

/* Whether a bit of these rows and columns is 1; an empty span stands for its first element. */
static bool patch_on(const uint8_t *bits, uint64_t columns, const uint64_t row[2],
                     const uint64_t column[2])
{
    uint64_t r = row[0];
    do {
        uint64_t c = column[0];
        do {
            if (bits[r * columns + c])
                return true;
        } while (++c < column[1]);
    } while (++r < row[1]);
    return false;
}

static void lights_share(const uint8_t *bits, uint64_t rows, uint64_t columns, uint8_t *lights)
{
    bool line = rows == 1;
    uint64_t side = line ? PARIS_LIGHTS : PARIS_LIGHTS_COLUMNS;
    memset(lights, 0, PARIS_LIGHTS_BYTES);
    for (uint64_t l = 0; l < PARIS_LIGHTS; l++) {
        uint64_t r = l / side, c = l % side;
        uint64_t row[2] = {r * rows / side, (r + 1) * rows / side};
        uint64_t column[2] = {c * columns / side, (c + 1) * columns / side};
        lights[l / 8] |= (uint8_t)(patch_on(bits, columns, row, column) << l % 8);
    }
}

bool paris_lights_read(uint8_t lights[PARIS_LIGHTS_BYTES])
{
    struct machine *m = paris_the.machine;
    struct machine_field_info info;
    if (!m || !machine_field_lookup(m, paris_the.leds, &info))
        return false;
    uint64_t count = machine_vpset_count(m, info.vpset);
    uint64_t columns =
        (uint64_t)machine_vpset_length(m, info.vpset, machine_vpset_rank(m, info.vpset) - 1);
    uint8_t *bits = malloc(count);
    if (!bits) {
        paris_fail_memory("not enough memory to read the lights");
        return false;
    }
    bool good = paris_leds_read(bits, count) == count;
    if (good)
        lights_share(bits, count / columns, columns, lights);
    else
        paris_fail_machine();
    free(bits);
    return good;
}
