/* near_active.h - the part of a line that a scan has to look at. */
#ifndef LUTETIA_MACHINE_NEAR_ACTIVE_H
#define LUTETIA_MACHINE_NEAR_ACTIVE_H

#include "ops/near_loops.h"

/* From the first active element of a line along a row to the last: others add nothing, and what
 * they get is not defined. Of segments all, since they begin where nobody is active, too. */
struct stretch near_active_part(const struct stretch *s);

#endif
