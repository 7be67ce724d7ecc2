/* sound_events.c - see sound_events.h. */
#include "sound_events.h"

#include <midi_internal.h>

#include <math.h>
#include <string.h>

enum { PAN = 10, DRUMS = 9, AGOGO = 113, WOODBLOCK = 115, CLEAN_GUITAR = 27 };

/* Channels and programs from 0; notes from the lowest to the highest. The clap is note 39 of
 * a drum kit. */
static const struct {
    const char *name;
    uint8_t channel, program, lowest, highest;
    uint16_t hold_ms;
} kinds[SOUND_KINDS] = {
    [SOUND_CLANK] = {"clank", 0, AGOGO, 48, 84, 150},
    [SOUND_CLICK] = {"click", 1, WOODBLOCK, 72, 96, 60},
    [SOUND_TWANG] = {"twang", 2, CLEAN_GUITAR, 40, 76, 250},
    [SOUND_SNAP] = {"snap", DRUMS, 0, 39, 39, 60},
};

int sound_kind_read(const char *name)
{
    for (int i = 0; i < SOUND_KINDS; i++)
        if (!strcmp(kinds[i].name, name))
            return i;
    return -1;
}

const char *sound_kind_name(enum sound_kind kind)
{
    return kinds[kind].name;
}

uint64_t sound_event_ns(enum sound_kind kind)
{
    return kinds[kind].hold_ms * UINT64_C(1000000);
}

struct midi_message sound_kind_program(enum sound_kind kind)
{
    return midi_message_make(0, (uint8_t)(MIDI_PROGRAM | kinds[kind].channel),
                             kinds[kind].program, 0);
}

static uint8_t within(double value, double least, double most)
{
    return (uint8_t)lrint(fmin(fmax(value, least), most)); /* fmax() replaces a NaN by the
                                                            * least */
}

void sound_event_messages(const struct sound_event *e, uint64_t time_ns,
                          struct midi_message messages[static 3])
{
    const uint8_t channel = kinds[e->kind].channel;
    const double lowest = kinds[e->kind].lowest, highest = kinds[e->kind].highest;
    const uint8_t note = within(lowest + e->height * (highest - lowest), lowest, highest);
    messages[0] = midi_message_make(time_ns, (uint8_t)(MIDI_CONTROL | channel), PAN,
                                    within(64 + 63 * e->side, 0, 127));
    messages[1] = midi_message_make(time_ns, (uint8_t)(MIDI_NOTE_ON | channel), note,
                                    within(e->velocity, 1, 127));
    messages[2] = midi_message_make(time_ns + sound_event_ns(e->kind),
                                    (uint8_t)(MIDI_NOTE_OFF | channel), note, 64);
}

struct midi_song *sound_events_song(void)
{
    const struct midi_song_def def = midi_song_def_default();
    struct midi_song *song;
    enum midi_status status = midi_song_create(&def, &song);
    for (int i = 0; i < SOUND_KINDS && status == MIDI_OK; i++) {
        const struct midi_message m = sound_kind_program((enum sound_kind)i);
        status = midi_song_record(song, i, &m, 0);
    }
    if (status == MIDI_OK)
        return song;
    midi_song_destroy(song);
    return NULL;
}

enum midi_status sound_event_add(struct midi_song *song, const struct sound_event *e)
{
    struct midi_message messages[3];
    enum midi_status status = MIDI_OK;
    if (!(e->time_s >= 0 && e->time_s < 1e6))
        return midi_fail(MIDI_BAD_ARGUMENT, "an event is at 0..1000000 s (got %g)", e->time_s);
    sound_event_messages(e, (uint64_t)(1e9 * e->time_s), messages);
    for (int i = 0; i < 3 && status == MIDI_OK; i++)
        status = midi_song_record(song, (int)e->kind, &messages[i], 0);
    return status;
}
