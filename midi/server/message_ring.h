/* message_ring.h - bytes with times from one thread to another, neither of which ever waits.
 *
 * One thread puts, one takes. What does not fit is refused and counted. */
#ifndef LUTETIA_MIDI_MESSAGE_RING_H
#define LUTETIA_MIDI_MESSAGE_RING_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { RING_BYTES = 1 << 15 };

struct message_ring {            /* zeros: empty */
    _Atomic uint32_t put, taken; /* bytes ever; they wrap */
    _Atomic uint32_t refused;
    uint8_t bytes[RING_BYTES];
};

bool ring_put(struct message_ring *r, uint64_t time_ns, const uint8_t *bytes, size_t count);
/* How many bytes the next one has, which are copied; 0: none is there. room: at least what is put at most. */
size_t ring_take(struct message_ring *r, uint64_t *time_ns, uint8_t *bytes, size_t room);

#endif
