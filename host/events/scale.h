/* scale.h - members at another scale: numbers as their rows say, forms by the module's functions. */
#ifndef LUTETIA_EVENTS_SCALE_H
#define LUTETIA_EVENTS_SCALE_H

#include "members.h"

struct event_scaling {
    double length;       /* lengths for one */
    double pace;         /* steps for one */
    const void *context; /* for the module's forms */
};

/* A number that is brought within its range again stays right as far as it can. False: no memory. */
bool members_scale(const struct members *members, void *of,
                   const struct event_scaling *scaling);

#endif
