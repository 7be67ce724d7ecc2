/* near_addresses.h - where the messages of sends and gets go that the front end performs by itself. */
#ifndef LUTETIA_MACHINE_NEAR_ADDRESSES_H
#define LUTETIA_MACHINE_NEAR_ADDRESSES_H

#include "base/crew.h"
#include "interpret/lanes.h"
#include "values/values.h"

/* Where messages go, or come from: senders, and the row-major indices of the processors they address. The arrays are the front end's,
 * and the device is not at them. */
struct near_route {
    const struct vpset *from, *to;
    const struct device_buffer *address, *context; /* context NULL: all send */
    size_t address_bytes;                          /* of an element */
    uint32_t mask;                                 /* the bits of an address that count */
    struct crew *crew;                             /* which does it in so many parts */
    int parts;
    bool there;        /* each address is of a processor, also where nobody sends */
    bool distinct;     /* ... and no two are of the same */
    size_t near_bytes; /* of a cache: what is in a larger array is fetched ahead */
    const struct lanes_table *lanes;
};

/* Senders that are looked at together. */
enum { ROUTE_BLOCK = 512 };
/* Of n senders from that element on: where they send to, whether they do or not. */
void near_addresses(const struct near_route *r, size_t at, int n, uint32_t *to);

#endif
