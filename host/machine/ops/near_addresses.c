/* near_addresses.c - see near_addresses.h. */
#include "ops/near_addresses.h"

typedef unsigned __int128 u128;

#define ADDRESSES(T)                                                                           \
    for (int i = 0; i < n; i++)                                                                \
    to[i] = (uint32_t)((const T *)in)[at + (size_t)i] & mask

void near_addresses(const struct near_route *r, size_t at, int n, uint32_t *to)
{
    const void *in = r->address->host;
    const uint32_t mask = r->mask;
    switch (r->address_bytes) {
    case 1:
        ADDRESSES(uint8_t);
        break;
    case 2:
        ADDRESSES(uint16_t);
        break;
    case 4:
        ADDRESSES(uint32_t);
        break;
    case 8:
        ADDRESSES(uint64_t);
        break;
    default:
        ADDRESSES(u128);
    }
}
