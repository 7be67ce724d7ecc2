/* near_addresses.h - where the messages of sends and gets go that the front end performs by
 * itself. */
#ifndef LUTETIA_MACHINE_NEAR_ADDRESSES_H
#define LUTETIA_MACHINE_NEAR_ADDRESSES_H

#include <stdatomic.h>

#include "base/crew.h"
#include "interpret/lanes.h"
#include "values/values.h"

/* Where messages go, or come from: senders, and the row-major indices of the processors they
 * address. The arrays are the front end's, and the device is not at them. */
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
    /* becomes true where a message goes to no processor; NULL: nobody wants to know */
    atomic_bool *beyond;
};

/* Senders that are looked at together. */
enum { ROUTE_BLOCK = 512 };
/* Of n senders from that element on: where they send to, whether they do or not. */
static inline void near_addresses(const struct near_route *r, size_t at, int n, uint32_t *to)
{
    const struct lanes_aim a = {(const char *)r->address->host + at * r->address_bytes, NULL,
                                r->address_bytes, r->mask, UINT32_MAX};
    r->lanes->aim(&a, n, to);
}
/* ... and the number of processors where they do not, or where there is none. */
static inline void near_aims(const struct near_route *r, size_t at, int n, uint32_t *to)
{
    const struct lanes_aim a = {(const char *)r->address->host + at * r->address_bytes,
                                r->context ? (const uint8_t *)r->context->host + at : NULL,
                                r->address_bytes, r->mask, (uint32_t)r->to->count};
    r->lanes->aim(&a, n, to);
}
/* Looks whether a message of these senders goes to no processor; to: their near_addresses() or
 * near_aims(). */
static inline void near_look_beyond(const struct near_route *r, size_t at, int n,
                                    const uint32_t *to)
{
    const uint8_t *context = r->context ? (const uint8_t *)r->context->host + at : NULL;
    if (r->beyond && !r->there && r->lanes->greatest(to, context, n) >= r->to->count)
        atomic_store_explicit(r->beyond, true, memory_order_relaxed);
}

#endif
