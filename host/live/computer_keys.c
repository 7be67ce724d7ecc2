/* computer_keys.c - see computer_keys.h. */
#include "computer_keys.h"

#include <string.h>

enum { VELOCITY = 84, VELOCITY_MOST = 127, OCTAVE = 12 };

/* Semitones above the lowest key; -1: it is none of them. */
static int semitone_of(int key)
{
    static const char low[] = "ZSXDCVGBHNJM", high[] = "Q2W3ER5T6Y7UI9O0P";
    const char *at;
    if (key <= 0 || key > 0x7f)
        return -1;
    if ((at = strchr(low, key)))
        return (int)(at - low);
    if ((at = strchr(high, key)))
        return OCTAVE + (int)(at - high);
    return -1;
}

bool computer_keys_take(struct computer_keys *keys, const struct input_event *event,
                        struct midi_message *m)
{
    const int semitone = semitone_of(event->key), note = keys->lowest + semitone;
    const bool down = event->kind == INPUT_KEY_DOWN;
    if ((!down && event->kind != INPUT_KEY_UP) || semitone < 0 || note >= MIDI_NOTES)
        return false;
    if (down == keys->down[note] || (down && event->modifiers & (INPUT_CONTROL | INPUT_ALT)))
        return false;
    keys->down[note] = down;
    const int velocity = event->modifiers & INPUT_SHIFT ? VELOCITY_MOST : VELOCITY;
    *m = midi_message_make((uint64_t)(event->time_s * 1e9), down ? MIDI_NOTE_ON : MIDI_NOTE_OFF,
                           (uint8_t)note, (uint8_t)(down ? velocity : 64));
    return true;
}

bool computer_keys_release(struct computer_keys *keys, struct midi_message *m)
{
    for (int i = 0; i < MIDI_NOTES; i++)
        if (keys->down[i]) {
            keys->down[i] = false;
            *m = midi_message_make((uint64_t)(input_now_s() * 1e9), MIDI_NOTE_OFF, (uint8_t)i,
                                   64);
            return true;
        }
    return false;
}
