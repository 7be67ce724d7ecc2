/* sound.c - see sound.h. */
#include "sound.h"
#include "fluid.h"

#include <midi_internal.h>

#include <input_file.h>
#include <output_file.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { PERIODS = 8 }; /* blocks that wait to be heard: 12 ms in all */

struct sound {
    const struct fluid *fluid;
    void *settings, *synth, *driver;
    void *taken;      /* a sequencer, whose time is what the driver has taken; NULL: a file */
    char listens[64]; /* the driver's name; "": any that works */
};

struct sound_def sound_def_default(void)
{
    return (struct sound_def){.rate_hz = 44100, .gain = 0.6, .tail_s = 30};
}

/* Checks that a file is a SoundFont, because FluidSynth prints messages of its own if it is
 * not. */
static enum midi_status font_check(const char *path)
{
    char head[12] = "";
    const char *why;
    FILE *file = input_file_open(path, &why);
    if (!file)
        return midi_fail(MIDI_NO_DEVICE, "%s: no SoundFont can be read there: %s", path, why);
    const bool read = fread(head, 1, sizeof head, file) == sizeof head;
    fclose(file);
    return read && !memcmp(head, "RIFF", 4) && !memcmp(head + 8, "sfbk", 4)
               ? MIDI_OK
               : midi_fail(MIDI_NO_DEVICE, "%s: no SoundFont, or a damaged one", path);
}

enum midi_status sound_font_find(const char *font, const char **found)
{
    static const char *const usual[] = {
        "/usr/share/sounds/sf2/TimGM6mb.sf2", "/usr/share/sounds/sf2/default-GM.sf2",
        "/usr/share/sounds/sf3/default-GM.sf3", "/usr/share/soundfonts/default.sf2"};
    const char *named = getenv("LUTETIA_SOUNDFONT");
    *found = font ? font : named && *named ? named : NULL;
    if (*found)
        return font_check(*found);
    for (size_t i = 0; i < sizeof usual / sizeof *usual; i++)
        if (access(usual[i], R_OK) == 0) {
            *found = usual[i];
            return font_check(usual[i]);
        }
    return midi_fail(MIDI_NO_DEVICE,
                     "sound needs a SoundFont: install timgm6mb-soundfont, or name one in "
                     "LUTETIA_SOUNDFONT");
}

static enum midi_status settings_make(struct sound *s, const struct sound_def *def)
{
    const struct fluid *f = s->fluid;
    s->settings = f->new_fluid_settings();
    if (!s->settings)
        return midi_fail(MIDI_NO_MEMORY, "no memory for a synthesizer");
    f->fluid_settings_setnum(s->settings, "synth.sample-rate", def->rate_hz);
    f->fluid_settings_setnum(s->settings, "synth.gain", def->gain);
    f->fluid_settings_setint(s->settings, "synth.reverb.active", def->room);
    f->fluid_settings_setint(s->settings, "synth.chorus.active", def->room);
    f->fluid_settings_setint(s->settings, "synth.lock-memory", 0);
    f->fluid_settings_setint(s->settings, "audio.period-size", SOUND_BLOCK);
    f->fluid_settings_setint(s->settings, "audio.periods", PERIODS);
    f->fluid_settings_setint(s->settings, "audio.jack.autoconnect", 1);
    f->fluid_settings_setint(s->settings, "audio.realtime-prio", 0);
    f->fluid_settings_setstr(s->settings, "audio.file.type", "wav");
    f->fluid_settings_setstr(s->settings, "audio.file.format", "s16");
    return MIDI_OK;
}

enum midi_status sound_create(const struct sound_def *def, struct sound **out)
{
    const struct fluid *fluid;
    const char *font;
    *out = NULL;
    if (def->rate_hz < 8000 || def->rate_hz > 96000 || !(def->gain >= 0 && def->gain <= 10))
        return midi_fail(
            MIDI_BAD_ARGUMENT,
            "sound has 8000..96000 samples a second and a gain of 0..10 (got %d, %g)",
            def->rate_hz, def->gain);
    enum midi_status status = fluid_load(&fluid);
    if (status == MIDI_OK)
        status = sound_font_find(def->font, &font);
    if (status != MIDI_OK)
        return status;
    struct sound *s = calloc(1, sizeof *s);
    if (!s)
        return midi_fail(MIDI_NO_MEMORY, "no memory for a synthesizer");
    s->fluid = fluid;
    status = settings_make(s, def);
    if (status == MIDI_OK) {
        s->synth = fluid->new_fluid_synth(s->settings);
        if (!s->synth)
            status = midi_fail(MIDI_NO_MEMORY, "FluidSynth makes no synthesizer");
    }
    if (status == MIDI_OK && !fluid_font_load(fluid, s->synth, font))
        status = midi_fail(MIDI_NO_DEVICE, "%s: no SoundFont, or a damaged one", font);
    if (status != MIDI_OK) {
        sound_destroy(s);
        return status;
    }
    *out = s;
    return MIDI_OK;
}

void sound_destroy(struct sound *s)
{
    if (!s)
        return;
    if (s->driver)
        s->fluid->delete_fluid_audio_driver(s->driver);
    if (s->taken)
        s->fluid->delete_fluid_sequencer(s->taken);
    if (s->synth)
        s->fluid->delete_fluid_synth(s->synth);
    if (s->settings)
        s->fluid->delete_fluid_settings(s->settings);
    free(s);
}

/* A sequencer without events: FluidSynth moves its time on as it makes samples. Without one
 * nobody knows whether the sound server is there. */
static void taken_count(struct sound *s)
{
    if (!s->taken)
        s->taken = s->fluid->new_fluid_sequencer2(0);
    if (s->taken)
        s->fluid->fluid_sequencer_register_fluidsynth(s->taken, s->synth);
}

bool sound_is_live(const struct sound *s)
{
    return s->driver && s->taken;
}

unsigned sound_taken_ms(const struct sound *s)
{
    return s->taken ? s->fluid->fluid_sequencer_get_tick(s->taken) : 0;
}

static enum midi_status driver_open(struct sound *s, const char *driver)
{
    const size_t count = driver ? strlen(driver) : 0;
    const bool file = count > 4 && !strcmp(driver + count - 4, ".wav");
    const char *wrong = file ? output_file_wrong(driver) : NULL; /* FluidSynth follows links */
    if (wrong)
        return midi_fail(MIDI_IO_FAILED, "%s: cannot write: %s", driver, wrong);
    if (file)
        s->fluid->fluid_settings_setstr(s->settings, "audio.file.name", driver);
    else
        fluid_hush_drivers();
    if (driver && s->fluid->fluid_settings_setstr(s->settings, "audio.driver",
                                                  file ? "file" : driver) != 0)
        return midi_fail(
            MIDI_NO_DEVICE,
            "FluidSynth has no sound driver '%.40s' here; pulseaudio, alsa and jack "
            "are usual, and a name that ends with .wav is a file",
            driver);
    if (!file && !s->taken)
        taken_count(s);
    s->driver = s->fluid->new_fluid_audio_driver(s->settings, s->synth);
    return s->driver
               ? MIDI_OK
               : midi_fail(MIDI_NO_DEVICE,
                           "no sound comes out of %s: is a sound server running? A file can "
                           "take it: sound:NAME.wav",
                           driver ? driver : "this machine");
}

/* Whether a sound server of PulseAudio's kind listens: its library would start one otherwise,
 * which nobody ends. */
static bool pulse_there(void)
{
    char path[200];
    const char *folder = getenv("XDG_RUNTIME_DIR");
    if (getenv("PULSE_SERVER"))
        return true;
    if (folder)
        snprintf(path, sizeof path, "%s/pulse/native", folder);
    else
        snprintf(path, sizeof path, "/run/user/%ld/pulse/native", (long)getuid());
    return access(path, W_OK) == 0 || access("/run/pulse/native", W_OK) == 0;
}

enum midi_status sound_listen(struct sound *s, const char *driver)
{
    snprintf(s->listens, sizeof s->listens, "%s", driver ? driver : "");
    return driver_open(s, driver);
}

enum midi_status sound_listen_any(struct sound *s)
{
    static const char *const drivers[] = {"jack", "pulseaudio", "alsa"};
    s->listens[0] = '\0';
    for (size_t i = 0; i < sizeof drivers / sizeof *drivers; i++)
        if ((strcmp(drivers[i], "pulseaudio") != 0 || pulse_there()) &&
            driver_open(s, drivers[i]) == MIDI_OK)
            return MIDI_OK;
    return midi_fail(MIDI_NO_DEVICE,
                     "no sound comes out of this machine: JACK, PulseAudio or ALSA is needed");
}

enum midi_status sound_listen_again(struct sound *s)
{
    enum { CHANNELS = 16, ALL_SOUND_OFF = 120 };
    if (s->driver)
        s->fluid->delete_fluid_audio_driver(s->driver);
    s->driver = NULL;
    for (int i = 0; i < CHANNELS; i++)
        s->fluid->fluid_synth_cc(s->synth, i, ALL_SOUND_OFF, 0);
    return s->listens[0] ? driver_open(s, s->listens) : sound_listen_any(s);
}

void sound_message(struct sound *s, const struct midi_message *m)
{
    const struct fluid *f = s->fluid;
    const int channel = m->bytes[0] & 15, a = m->bytes[1], b = m->bytes[2];
    switch (m->bytes[0] & 0xf0) {
    case MIDI_NOTE_OFF:
        f->fluid_synth_noteoff(s->synth, channel, a);
        break;
    case MIDI_NOTE_ON:
        f->fluid_synth_noteon(s->synth, channel, a, b); /* FluidSynth treats velocity 0 as
                                                         * note-off, too */
        break;
    case MIDI_POLY_PRESSURE:
        f->fluid_synth_key_pressure(s->synth, channel, a, b);
        break;
    case MIDI_CONTROL:
        f->fluid_synth_cc(s->synth, channel, a, b);
        break;
    case MIDI_PROGRAM:
        f->fluid_synth_program_change(s->synth, channel, a);
        break;
    case MIDI_PRESSURE:
        f->fluid_synth_channel_pressure(s->synth, channel, a);
        break;
    case MIDI_BEND:
        f->fluid_synth_pitch_bend(s->synth, channel, a | b << 7);
        break;
    default:
        if (m->bytes[0] == MIDI_RESET)
            f->fluid_synth_system_reset(s->synth);
    }
}

void sound_block(struct sound *s, int16_t samples[2 * SOUND_BLOCK])
{
    s->fluid->fluid_synth_write_s16(s->synth, SOUND_BLOCK, samples, 0, 2, samples, 1, 2);
}

bool sound_voices(struct sound *s)
{
    return s->fluid->fluid_synth_get_active_voice_count(s->synth) > 0;
}
