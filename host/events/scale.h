/* scale.h - scaling members: numbers as their rows say, other members by the module's
 * functions. */
#ifndef LUTETIA_EVENTS_SCALE_H
#define LUTETIA_EVENTS_SCALE_H

#include "members.h"

struct event_scaling {
    double length;       /* the factor of lengths */
    double pace;         /* steps for one */
    const void *context; /* passed to the module's functions */
};

/* Scales all members; results are clamped to their ranges. False: no memory. */
bool members_scale(const struct members *members, void *of,
                   const struct event_scaling *scaling);

#endif
