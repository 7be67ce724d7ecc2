/* microphone_ring.c - what the kinds of microphones put, and what is taken. */
#include "microphone_internal.h"

void microphone_put(struct microphone *m, const float *samples, size_t count)
{
    const size_t at = atomic_load_explicit(&m->written, memory_order_relaxed);
    const size_t held = at - atomic_load_explicit(&m->read, memory_order_acquire);
    const size_t fits = count < RING_SAMPLES - held ? count : RING_SAMPLES - held;
    for (size_t i = 0; i < fits; i++)
        m->ring[(at + i) & (RING_SAMPLES - 1)] = samples[i];
    atomic_store_explicit(&m->written, at + fits, memory_order_release);
    if (fits < count)
        atomic_fetch_add(&m->lost, count - fits);
}

size_t microphone_take(struct microphone *m, float *samples, size_t room)
{
    const size_t at = atomic_load_explicit(&m->read, memory_order_relaxed);
    const size_t held = atomic_load_explicit(&m->written, memory_order_acquire) - at;
    const size_t count = held < room ? held : room;
    for (size_t i = 0; i < count; i++)
        samples[i] = m->ring[(at + i) & (RING_SAMPLES - 1)];
    atomic_store_explicit(&m->read, at + count, memory_order_release);
    return count;
}
