/* message_ring.h - a lock-free queue of bytes with times from one thread to another.
 *
 * One thread puts, one takes. Messages that do not fit are refused and counted: who takes looks
 * at the count, and tells it.
 */
#ifndef LUTETIA_MIDI_MESSAGE_RING_H
#define LUTETIA_MIDI_MESSAGE_RING_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { RING_BYTES = 1 << 18, RING_HEAD = 10 /* beside each message's bytes */ };

struct message_ring {            /* zeros: empty */
    _Atomic uint32_t put, taken; /* bytes ever; they wrap */
    _Atomic uint32_t refused;
    uint8_t bytes[RING_BYTES];
};

bool ring_put(struct message_ring *r, uint64_t time_ns, const uint8_t *bytes, size_t count);
/* Copies the next message and returns its length; 0: none. room: at least the length of the
 * longest message put. */
size_t ring_take(struct message_ring *r, uint64_t *time_ns, uint8_t *bytes, size_t room);
/* The same, and the message stays. */
size_t ring_look(const struct message_ring *r, uint64_t *time_ns, uint8_t *bytes, size_t room);
/* Bytes of the ring that messages take. */
size_t ring_used(const struct message_ring *r);

#endif
