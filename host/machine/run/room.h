/* room.h - memory: what waits is bounded by bytes, and gives way where memory is short. See
 * room.c. */
#ifndef LUTETIA_MACHINE_ROOM_H
#define LUTETIA_MACHINE_ROOM_H

#include "device/device.h"
#include "run/run.h"

enum {
    ROOM_ARRAYS = 4, /* of the largest, that an instruction may need besides what fields hold */
    ROOM_PART = 8,   /* of the memory may always wait */
    ROOM_LOG2 = 28   /* besides, so many bytes */
};

/* Whether values that wait should be computed because of the arrays that they hold and will
 * need. */
static inline bool room_is_wanted(const struct machine *m)
{
    const uint64_t held = m->device->held_bytes;
    return held > m->run->room_held ||
           held + (m->values->pending_kb << 10) > m->run->room_bytes;
}

/* Whether the next instructions might find no memory unless all that waits is computed now. */
static inline bool room_is_short(const struct machine *m)
{
    const struct device *d = m->device;
    return d->held_bytes > d->memory_bytes / 4 &&
           d->held_bytes + ROOM_ARRAYS * d->largest_bytes > d->memory_bytes;
}

/* Whether so many bytes more fit. */
static inline bool room_has(const struct machine *m, uint64_t bytes)
{
    return m->device->held_bytes + bytes <= m->device->memory_bytes;
}

/* Whether the arrays in use, what fields hold and what neighbours look at would not fit, if all
 * that waits were computed now. */
bool room_would_lack(const struct machine *m);
static inline bool room_is_exceeded(const struct machine *m)
{
    const uint64_t pending = m->values->pending_kb << 10;
    return pending && m->device->held_bytes + 2 * pending > m->device->memory_bytes / 4 &&
           room_would_lack(m);
}

void room_init(struct machine *m);

/* Called after an evaluation: how much may wait until the next one. */
static inline void room_measure(struct machine *m)
{
    const struct device *d = m->device;
    const uint64_t twice = 2 * d->held_bytes + (UINT64_C(1) << ROOM_LOG2),
                   part = d->memory_bytes / ROOM_PART;
    m->run->room_held = twice;
    m->run->room_bytes = twice > part ? twice : part;
}

/* Computes all that waits, what was stored first before the rest, so that arrays become free as
 * early as they can. False: nothing waits, or it cannot be done now. */
bool room_make(struct machine *m);

/* ---- pieces.c ---- */

/* The value that was stored into a field or flag first, of those that wait and of which fields,
 * flags or these values consist. NULL: none. */
struct machine_value *pieces_next(struct machine *m, struct machine_value *const *wanted,
                                  int count);

/* A choice between a new value and an old one is stored, but what comes later may take the new
 * value without the choice. If that holds arrays that nobody else needs, and more than it
 * takes, it is computed before the choice. NULL: it is not so. */
struct machine_value *pieces_before(const struct machine *m, const struct machine_value *v);

#endif
