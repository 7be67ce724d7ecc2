/* midi_notes.c - see midi_notes.h. */
#include "midi_notes.h"

#include <string.h>

enum { SUSTAIN = 64, ALL_SOUND_OFF = 120, RESET_CONTROLLERS = 121, ALL_NOTES_OFF = 123 };

static void control_take(struct midi_notes *n, int channel, int control, int value)
{
    if (control == SUSTAIN && value >= 64)
        n->pedals |= (uint16_t)(1u << channel);
    else if (control == SUSTAIN || control == RESET_CONTROLLERS)
        n->pedals &= (uint16_t) ~(1u << channel);
    else if (control == ALL_SOUND_OFF || control >= ALL_NOTES_OFF) /* modes end notes, too */
        memset(n->on[channel], 0, sizeof n->on[channel]);
}

void midi_notes_take(struct midi_notes *n, const struct midi_message *m)
{
    const int channel = midi_message_channel(m);
    if (m->bytes[0] == MIDI_RESET) {
        *n = (struct midi_notes){0};
    } else if (midi_message_strikes(m)) {
        n->on[channel][m->bytes[1] >> 6] |= UINT64_C(1) << (m->bytes[1] & 63);
    } else if (midi_message_releases(m)) {
        n->on[channel][m->bytes[1] >> 6] &= ~(UINT64_C(1) << (m->bytes[1] & 63));
    } else if (channel >= 0 && (m->bytes[0] & 0xf0) == MIDI_CONTROL) {
        control_take(n, channel, m->bytes[1], m->bytes[2]);
    }
}

int midi_notes_count(const struct midi_notes *n)
{
    int count = 0;
    for (int c = 0; c < MIDI_CHANNELS; c++)
        count += __builtin_popcountll(n->on[c][0]) + __builtin_popcountll(n->on[c][1]);
    return count;
}

void midi_notes_release(struct midi_notes *n, uint64_t time_ns, midi_take *take, void *context)
{
    const struct midi_notes was = *n;
    *n = (struct midi_notes){0};
    for (int c = 0; c < MIDI_CHANNELS; c++) {
        for (int note = 0; note < MIDI_NOTES; note++)
            if (was.on[c][note >> 6] >> (note & 63) & 1) {
                const struct midi_message m =
                    midi_message_make(time_ns, (uint8_t)(MIDI_NOTE_OFF | c), (uint8_t)note, 64);
                take(context, &m);
            }
        if (was.pedals >> c & 1) {
            const struct midi_message m =
                midi_message_make(time_ns, (uint8_t)(MIDI_CONTROL | c), SUSTAIN, 0);
            take(context, &m);
        }
    }
}

void midi_notes_silence(uint64_t time_ns, midi_take *take, void *context)
{
    for (int c = 0; c < MIDI_CHANNELS; c++) {
        const uint8_t status = (uint8_t)(MIDI_CONTROL | c);
        struct midi_message m = midi_message_make(time_ns, status, SUSTAIN, 0);
        take(context, &m);
        m = midi_message_make(time_ns, status, ALL_NOTES_OFF, 0);
        take(context, &m);
    }
}
