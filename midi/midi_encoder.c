/* midi_encoder.c - see midi_encoder.h. */
#include "midi_encoder.h"

#include <string.h>

size_t midi_encoder_put(struct midi_encoder *e, const struct midi_message *m,
                        uint8_t bytes[MIDI_ENCODED_MAX])
{
    size_t count = 0;
    if (!midi_message_good(m))
        return 0;
    const enum midi_kind kind = midi_message_kind(m);
    if (kind == MIDI_KIND_REAL_TIME) {
        bytes[0] = m->bytes[0];
        return 1;
    }
    const bool goes_on = kind == MIDI_KIND_SYSEX && m->bytes[0] != MIDI_SYSEX;
    if (goes_on && !e->in_sysex)
        return 0;
    if (e->in_sysex && !goes_on)
        bytes[count++] = MIDI_SYSEX_END;
    e->in_sysex = midi_message_open(m);
    size_t from = 0;
    if (kind == MIDI_KIND_CHANNEL) {
        from = e->running_status && e->running == m->bytes[0] && !count;
        e->running = m->bytes[0];
    } else {
        e->running = 0;
    }
    memcpy(bytes + count, m->bytes + from, m->count - from);
    return count + m->count - from;
}
