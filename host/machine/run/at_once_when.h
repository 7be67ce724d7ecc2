/* at_once_when.h - when operations are computed as they are called: interpret/at_once.h. */
#ifndef LUTETIA_MACHINE_AT_ONCE_WHEN_H
#define LUTETIA_MACHINE_AT_ONCE_WHEN_H

#include "run/replay.h"

/* What the machine's settings and device allow. */
enum at_once_may at_once_may(const struct machine *m);
void at_once_choose(struct machine *m);

/* Called before a call is performed that nobody foresaw: decides for this call, and what
 * follows until the next one. */
static inline void at_once_decide(struct machine *m)
{
    struct replay *p = m->run->replay;
    if (p->at_once == AT_ONCE_UNKNOWN)
        p->at_once = at_once_may(m);
    if (p->at_once != AT_ONCE_NEVER)
        at_once_choose(m);
}

#endif
