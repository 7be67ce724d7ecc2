/* near_few.h - whole numbers sent to few processors and combined there: see near_few.c. */
#ifndef LUTETIA_MACHINE_NEAR_FEW_H
#define LUTETIA_MACHINE_NEAR_FEW_H

#include "ops/near_addresses.h"

/* source: of senders; same: it is ROUTE_BLOCK times what all send. False: nothing has been
 * done, there are too many or no memory. */
bool near_send_few(const struct near_route *r, enum machine_combiner combiner,
                   struct machine_type type, const void *source, bool same, void *out);

#endif
