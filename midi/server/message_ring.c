/* message_ring.c - see message_ring.h. */
#include "message_ring.h"

enum { HEAD = RING_HEAD }; /* the time, and the number of bytes that follow */

static void byte_put(struct message_ring *r, uint32_t at, uint64_t value, int count)
{
    for (int i = 0; i < count; i++)
        r->bytes[(at + (uint32_t)i) % RING_BYTES] = (uint8_t)(value >> 8 * i);
}

static uint64_t byte_get(const struct message_ring *r, uint32_t at, int count)
{
    uint64_t value = 0;
    for (int i = count - 1; i >= 0; i--)
        value = value << 8 | r->bytes[(at + (uint32_t)i) % RING_BYTES];
    return value;
}

bool ring_put(struct message_ring *r, uint64_t time_ns, const uint8_t *bytes, size_t count)
{
    const uint32_t put = atomic_load_explicit(&r->put, memory_order_relaxed);
    const uint32_t taken = atomic_load_explicit(&r->taken, memory_order_acquire);
    if (!count || count > 0xffff || HEAD + count > RING_BYTES - (put - taken)) {
        atomic_fetch_add_explicit(&r->refused, 1, memory_order_relaxed);
        return false;
    }
    byte_put(r, put, time_ns, 8);
    byte_put(r, put + 8, count, 2);
    for (size_t i = 0; i < count; i++)
        r->bytes[(put + HEAD + i) % RING_BYTES] = bytes[i];
    atomic_store_explicit(&r->put, put + HEAD + (uint32_t)count, memory_order_release);
    return true;
}

size_t ring_look(const struct message_ring *r, uint64_t *time_ns, uint8_t *bytes, size_t room)
{
    const uint32_t taken = atomic_load_explicit(&r->taken, memory_order_relaxed);
    if (taken == atomic_load_explicit(&r->put, memory_order_acquire))
        return 0;
    *time_ns = byte_get(r, taken, 8);
    const size_t count = byte_get(r, taken + 8, 2);
    for (size_t i = 0; i < count && i < room; i++)
        bytes[i] = r->bytes[(taken + HEAD + i) % RING_BYTES];
    return count;
}

size_t ring_take(struct message_ring *r, uint64_t *time_ns, uint8_t *bytes, size_t room)
{
    const size_t count = ring_look(r, time_ns, bytes, room);
    if (count)
        atomic_fetch_add_explicit(&r->taken, HEAD + (uint32_t)count, memory_order_release);
    return count < room ? count : room;
}

size_t ring_used(const struct message_ring *r)
{
    const uint32_t taken = atomic_load_explicit(&r->taken, memory_order_acquire);
    return atomic_load_explicit(&r->put, memory_order_acquire) - taken;
}
