/* with_ranks.c - see with_ranks.h. */
#include "with_ranks.h"

#include <stdio.h>
#include <string.h>

#include "base/errors.h"
#include "device/device.h"
#include "ranks/ranks.h"
#include "served.h"
#include "values/values.h"

static const struct machine *owner; /* NULL: nobody has the ranks */
static char device[256];            /* as the program chose it; "": it did not */

/* A starter has made several processes, and this one has not become a rank. */
static enum machine_status refuse(struct machine *m)
{
    struct ranks_starter starter;
    if (!ranks_wanted(&starter))
        return MACHINE_OK;
    return machine_fail(
        m, MACHINE_NO_DEVICE,
        "%s is %d, but this program cannot be one of several processes: only "
        "programs that are linked with libparis can, `lutetia run` and `lutetia "
        "paint`; with LUTETIA_RANKS=0 each process is a program of its own",
        starter.name, starter.count);
}

enum machine_status ranks_settings(struct machine *m, const struct machine_config *config)
{
    const int count = ranks_count();
    if (count == 1)
        return refuse(m);
    m->settings.blocks_apart = 0;
    if (ranks_mine() || owner || !ranks_are_ours()) {
        m->settings.blocks = 1;
        return MACHINE_OK;
    }
    if (m->settings.blocks != 1 && m->settings.blocks != (uint64_t)count)
        return machine_fail(
            m, MACHINE_BAD_ARGUMENT,
            "LUTETIA_BLOCKS is %d, but each of %d ranks has one block: leave it "
            "out",
            (int)m->settings.blocks, count);
    m->settings.blocks = (uint64_t)count;
    owner = m;
    snprintf(device, sizeof device, "%s", config->device ? config->device : "");
    return MACHINE_OK;
}

bool ranks_are_of(const struct machine *m)
{
    return owner == m;
}

enum machine_status ranks_machines_make(struct machine *m, bool *near)
{
    const struct ranks_command c = {
        RANKS_CREATE, sizeof device, {(uint64_t)m->values->processors_count}};
    *near = m->settings.near && m->device->is_pocl;
    if (!ranks_are_ours())
        return MACHINE_OK;
    ranks_command_all(c, device);
    ranks_flush();
    for (int i = 1; i < ranks_count(); i++) {
        struct served_made made;
        ranks_reply_take(i, &made, sizeof made);
        *near = *near && made.near;
        if (made.status && !m->status)
            machine_fail(m, (enum machine_status)made.status, "rank %d: %s", i, made.error);
        if (!made.status && made.memory_bytes < m->device->memory_bytes)
            m->device->memory_bytes = made.memory_bytes;
    }
    return m->status;
}

void ranks_machines_destroy(struct machine *m)
{
    (void)m;
    ranks_command_all((struct ranks_command){RANKS_DESTROY, 0, {0}}, NULL);
}

void ranks_are_free(const struct machine *m)
{
    if (owner == m)
        owner = NULL;
}
