/* spring_reach.c - see spring_reach.h. */
#include "spring_reach.h"

#include <spring_controls.h>
#include <step.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { STEPS_HZ = 240, MASSES_MOST = 20000 };
static const double seconds_most = 12;

static struct font_box box_of(const struct dyn_network *n)
{
    struct font_box box = {INFINITY, INFINITY, -INFINITY, -INFINITY};
    const struct dyn_state *states = dyn_network_states(n);
    for (int i = 0; i < dyn_masses_count(n); i++) {
        box.x0 = fmin(box.x0, states[i].x);
        box.x1 = fmax(box.x1, states[i].x);
        box.y0 = fmin(box.y0, states[i].y);
        box.y1 = fmax(box.y1, states[i].y);
    }
    return box;
}

static enum dyn_status world_set(struct dyn_network *n, const char *const *sets, int count,
                                 bool floorless)
{
    struct dyn_world world = *dyn_network_world(n);
    enum dyn_status status = DYN_OK;
    for (int i = 0; i < count && status == DYN_OK; i++) {
        char name[64];
        const char *equals = strchr(sets[i], '=');
        if (!equals || equals - sets[i] >= (ptrdiff_t)sizeof name)
            continue; /* which is said where all are set */
        snprintf(name, sizeof name, "%.*s", (int)(equals - sets[i]), sets[i]);
        for (int row = 0; row < dyn_controls_count && status == DYN_OK; row++) {
            double value;
            if (strcmp(dyn_controls[row].name, name) != 0)
                continue;
            status = dyn_control_parse(&dyn_controls[row], equals + 1, &value);
            if (status == DYN_OK)
                status = dyn_control_write(&dyn_controls[row], &world, value);
        }
    }
    if (floorless)
        world.floor_on = 0;
    return status == DYN_OK ? dyn_network_world_set(n, &world) : status;
}

enum stage_status spring_reach(const struct dyn_network *network, const char *const *sets,
                               int sets_count, bool floorless, struct font_box *box)
{
    struct dyn_network *ahead = NULL;
    *box = box_of(network);
    if (dyn_masses_count(network) > MASSES_MOST || !(box->x1 >= box->x0))
        return STAGE_OK;
    const double size = fmax(box->x1 - box->x0, box->y1 - box->y0),
                 seconds = fmin(seconds_most, 3 + 2 * sqrt(size));
    enum dyn_status status = dyn_network_create(&ahead);
    if (status == DYN_OK)
        status = dyn_network_copy(ahead, network);
    if (status == DYN_OK)
        status = world_set(ahead, sets, sets_count, floorless);
    for (int i = 0; i < (int)(seconds * STEPS_HZ) && status == DYN_OK; i++) {
        status = dyn_network_step(ahead, 1.0 / STEPS_HZ, 1);
        const struct font_box now = box_of(ahead);
        *box = (struct font_box){fmin(box->x0, now.x0), fmin(box->y0, now.y0),
                                 fmax(box->x1, now.x1), fmax(box->y1, now.y1)};
    }
    dyn_network_destroy(ahead);
    return status == DYN_OK
               ? STAGE_OK
               : stage_fail(status == DYN_NO_MEMORY ? STAGE_NO_MEMORY : STAGE_BAD_ARGUMENT,
                            "%s", dyn_error());
}
