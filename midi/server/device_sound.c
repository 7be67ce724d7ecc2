/* device_sound.c - a synthesizer in the server: FluidSynth, played or written to a WAV file. */
#include "device_kinds.h"

#include <midi_internal.h>
#include <sound_keeper.h>

#include <stdlib.h>

struct synthesizer {
    struct sound *sound;
    struct sound_keeper *keeper; /* of a sound server that comes back */
    struct midi_parser parser;
};

static enum midi_status sound_open(struct server_device *d)
{
    struct sound_def def = sound_def_default();
    struct synthesizer *s = calloc(1, sizeof *s);
    if (!s)
        return midi_fail(MIDI_NO_MEMORY, "no memory");
    d->own = s;
    def.room = true;
    midi_parser_init(&s->parser);
    enum midi_status status = sound_create(&def, &s->sound);
    if (status == MIDI_OK)
        status = sound_listen(s->sound, d->argument[0] ? d->argument : NULL);
    if (status == MIDI_OK)
        status = sound_keeper_begin(s->sound, &s->keeper);
    /* Trying again ten times a second would delay the instruments, so a failure is
     * permanent, and reported at the start. */
    return status == MIDI_OK ? MIDI_OK : MIDI_BAD_ARGUMENT;
}

static void sound_close(struct server_device *d)
{
    struct synthesizer *s = d->own;
    if (!s)
        return;
    sound_keeper_end(s->keeper);
    sound_destroy(s->sound);
    free(s);
    d->own = NULL;
}

static void message_take(void *context, const struct midi_message *m)
{
    sound_message(context, m);
}

static size_t sound_write(struct server_device *d, const uint8_t *bytes, size_t count)
{
    struct synthesizer *s = d->own;
    midi_parser_take(&s->parser, 0, bytes, count, message_take, s->sound);
    return count;
}

const struct device_kind device_kind_sound = {
    .name = "sound",
    .argument = "[DRIVER|NAME.wav]",
    .help = "a synthesizer (FluidSynth): pulseaudio, alsa, jack; or into a WAV file",
    .plays = true,
    .stays = true,
    .open = sound_open,
    .close = sound_close,
    .write = sound_write,
};
