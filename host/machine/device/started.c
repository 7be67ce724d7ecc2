/* started.c - how many different kernels this process has started, in all its machines.
 *
 * PoCL maps a compiled kernel into memory when it is first started, and never lets go of it
 * (3.1: five mappings each, some 23 kB). Linux allows 65,530 mappings; at one more PoCL ends
 * the process. */
#include <stdatomic.h>

#include "base/parts.h"
#include "device/device.h"

enum { PLACES = 1 << 15 };

/* By its hash each id is in the first free place. */
static _Atomic uint64_t ids[PLACES];
static _Atomic uint32_t count;

void device_started(uint64_t id)
{
    for (uint32_t tried = 0; id && tried < PLACES; tried++) {
        uint64_t there = 0;
        _Atomic uint64_t *place = &ids[(id + tried) % PLACES];
        if (atomic_compare_exchange_strong(place, &there, id)) {
            atomic_fetch_add(&count, 1);
            return;
        }
        if (there == id)
            return;
    }
}

bool device_takes_kernels(const struct machine *m)
{
    const bool room = !m->device->is_pocl || atomic_load(&count) < m->settings.kernels_ever;
    return room && device_is_ours(m->device);
}
