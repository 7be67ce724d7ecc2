/* claims.c - the claims of kernels/claims.cl, by which a thread of the device computes the same
 * places in each kernel. */
#include "base/parts.h"
#include "device/device.h"

enum {
    LOTS_MOST = 64,
    APART = LINE_BYTES / sizeof(cl_int),
    OF = 80,
    WORDS = OF + 2 * LOTS_MOST * APART
};
/* Both numbers of a lot's claims have 16 bits, also if each work-group tries in vain first. */
enum { PLACES_MOST = 1 << 15 };

bool device_claims_ready(struct machine *m)
{
    struct claims *c = &m->device->claims;
    cl_int words[WORDS] = {m->device->units < LOTS_MOST ? m->device->units : LOTS_MOST},
           error = CL_SUCCESS;
    if (c->memory)
        return true;
    c->lots = (size_t)words[0];
    c->memory = clCreateBuffer(m->device->context, CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR,
                               sizeof words, words, &error);
    return device_check(m, error, "memory for the claims of places") == MACHINE_OK;
}

int device_claim(const struct device *d, size_t places)
{
    const size_t lots = d->claims.lots, length = (places + lots - 1) / lots;
    return places > 1 && places < PLACES_MOST ? (int)(length << 1 | d->claims.turn) : 0;
}

void device_claimed(struct device *d)
{
    d->claims.turn ^= 1;
}
