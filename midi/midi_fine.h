/* midi_fine.h - controllers of 14 bits: pairs of controllers (0 to 31 with 32 to 63), and
 * parameters without a registered number (NRPN).
 *
 *     struct midi_fine fine = {0};
 *     struct midi_fine_value value;
 *     if (midi_fine_take(&fine, &message, &value))                  // each message
 *         turn(value.is_parameter, value.number, value.value / (double)MIDI_FINE_MOST);
 *
 * A pair's first controller says the upper seven bits, the second one the lower; a parameter is
 * chosen by controllers 99 and 98, and its value is the pair 6 and 38. Upper bits that come
 * alone stand for lower ones of 0, as the MIDI specification has it.
 *
 * Errors: none. Ownership: the struct is the caller's. Threads: one at a time.
 */
#ifndef LUTETIA_MIDI_FINE_H
#define LUTETIA_MIDI_FINE_H

#include "midi_message.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { MIDI_FINE_MOST = 16383, MIDI_FINE_PAIRS = 32 };

struct midi_fine { /* zeros: nothing has come */
    struct {
        uint8_t upper[MIDI_FINE_PAIRS]; /* 0x80 | bits; 0: none yet */
        uint8_t number[2];              /* of the parameter, the same; 0: none is chosen */
    } channels[16];
};

struct midi_fine_value {
    bool is_parameter;
    int channel, number; /* of the pair's first controller, 0..31; of the parameter, 0..16383 */
    int value;           /* 0..MIDI_FINE_MOST */
    bool is_whole;       /* the lower bits have come */
};

/* False: the message says no such value. */
bool midi_fine_take(struct midi_fine *fine, const struct midi_message *m,
                    struct midi_fine_value *out);

/* Whether a controller chooses a parameter or is its value, and so is no knob of its own. */
bool midi_fine_chooses(const struct midi_fine *fine, const struct midi_message *m);

#ifdef __cplusplus
}
#endif

#endif
