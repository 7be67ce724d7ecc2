/* midi_fine.c - see midi_fine.h. */
#include "midi_fine.h"

enum {
    DATA = 6,
    INCREMENT = 96,
    DECREMENT = 97,
    PARAMETER_LOWER = 98,
    PARAMETER_UPPER = 99,
    REGISTERED_LOWER = 100,
    REGISTERED_UPPER = 101,
    NONE = 127, /* both bytes of a number: no parameter */
    SET = 0x80
};

static bool is_control(const struct midi_message *m)
{
    return midi_message_channel(m) >= 0 && (m->bytes[0] & 0xf0) == MIDI_CONTROL;
}

static bool is_chosen(const uint8_t number[2])
{
    return number[0] && number[1] && (number[0] != (SET | NONE) || number[1] != (SET | NONE));
}

bool midi_fine_take(struct midi_fine *fine, const struct midi_message *m,
                    struct midi_fine_value *out)
{
    if (!is_control(m))
        return false;
    const int channel = midi_message_channel(m), control = m->bytes[1];
    uint8_t *upper = fine->channels[channel].upper, *number = fine->channels[channel].number;
    if (control == PARAMETER_UPPER || control == PARAMETER_LOWER) {
        number[control == PARAMETER_LOWER] = (uint8_t)(SET | m->bytes[2]);
        upper[DATA] = 0; /* another parameter's */
        return false;
    }
    if (control == REGISTERED_UPPER || control == REGISTERED_LOWER) {
        number[0] = number[1] = upper[DATA] = 0;
        return false;
    }
    if (control >= 2 * MIDI_FINE_PAIRS)
        return false;
    const int pair = control % MIDI_FINE_PAIRS;
    const bool is_whole = control >= MIDI_FINE_PAIRS;
    if (!is_whole)
        upper[pair] = (uint8_t)(SET | m->bytes[2]);
    if (!upper[pair])
        return false; /* lower bits of nothing */
    const bool is_parameter = pair == DATA && is_chosen(number);
    *out = (struct midi_fine_value){
        .is_parameter = is_parameter,
        .channel = channel,
        .number = is_parameter ? (number[0] & 127) << 7 | (number[1] & 127) : pair,
        .value = (upper[pair] & 127) << 7 | (is_whole ? m->bytes[2] : 0),
        .is_whole = is_whole};
    return true;
}

bool midi_fine_chooses(const struct midi_fine *fine, const struct midi_message *m)
{
    if (!is_control(m))
        return false;
    const int control = m->bytes[1];
    return (control >= INCREMENT && control <= REGISTERED_UPPER) ||
           (control % MIDI_FINE_PAIRS == DATA && control < 2 * MIDI_FINE_PAIRS &&
            is_chosen(fine->channels[midi_message_channel(m)].number));
}
