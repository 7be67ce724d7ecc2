/* sound.c - see sound.h. */
#include "sound.h"
#include "fluid.h"

#include <midi_internal.h>

#include <input_file.h>
#include <output_file.h>
#include <patience.h>

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { SECONDS_MAX = 36000 };

enum { PERIODS = 8 }; /* blocks that wait to be heard: 12 ms in all */

struct sound {
    const struct fluid *fluid;
    void *settings, *synth, *driver, *renderer;
};

struct sound_def sound_def_default(void)
{
    return (struct sound_def){.rate_hz = 44100, .gain = 0.6, .tail_s = 1.5};
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
    if (s->renderer)
        s->fluid->delete_fluid_file_renderer(s->renderer);
    if (s->driver)
        s->fluid->delete_fluid_audio_driver(s->driver);
    if (s->synth)
        s->fluid->delete_fluid_synth(s->synth);
    if (s->settings)
        s->fluid->delete_fluid_settings(s->settings);
    free(s);
}

enum midi_status sound_listen(struct sound *s, const char *driver)
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
    s->driver = s->fluid->new_fluid_audio_driver(s->settings, s->synth);
    return s->driver
               ? MIDI_OK
               : midi_fail(MIDI_NO_DEVICE,
                           "no sound comes out of %s: is a sound server running? A file can "
                           "take it: sound:NAME.wav",
                           driver ? driver : "this machine");
}

/* Whether a sound server of PulseAudio's kind listens: its library would start one otherwise, which nobody ends. */
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

enum midi_status sound_listen_any(struct sound *s)
{
    static const char *const drivers[] = {"jack", "pulseaudio", "alsa"};
    for (size_t i = 0; i < sizeof drivers / sizeof *drivers; i++)
        if ((strcmp(drivers[i], "pulseaudio") != 0 || pulse_there()) &&
            sound_listen(s, drivers[i]) == MIDI_OK)
            return MIDI_OK;
    return midi_fail(MIDI_NO_DEVICE,
                     "no sound comes out of this machine: JACK, PulseAudio or ALSA is needed");
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

/* ---- to a file ---- */

static void render_take(void *context, const struct midi_message *m)
{
    sound_message(context, m);
}

static enum midi_status blocks_render(struct sound *s, struct midi_song *song, int rate_hz,
                                      double seconds)
{
    const size_t events_count = midi_song_info(song).events_count;
    const double block_s = (double)SOUND_BLOCK / rate_hz;
    const long blocks = (long)ceil(seconds / block_s);
    struct midi_parser parser;
    midi_parser_init(&parser);
    size_t next = 0;
    for (long i = 0; i < blocks; i++) {
        while (next < events_count) {
            const struct midi_song_event e = midi_song_event(song, next);
            if ((double)e.time_ns / 1e9 >= ((double)i + 0.5) * block_s) /* the nearer block */
                break;
            midi_song_play(&e, &parser, render_take, s);
            next++;
        }
        if (patience_over())
            return midi_fail(MIDI_IO_FAILED, "stopped");
        if (s->fluid->fluid_file_renderer_process_block(s->renderer) != 0)
            return midi_fail(MIDI_IO_FAILED, "sound cannot be written: is the disk full?");
    }
    return MIDI_OK;
}

/* Into a file that is there, by a name that FluidSynth opens; `path` is what errors call it. */
static enum midi_status render_into(const struct sound_def *def, struct midi_song *song,
                                    double seconds, const char *name, const char *path)
{
    struct sound *s;
    enum midi_status status = sound_create(def, &s);
    if (status != MIDI_OK)
        return status;
    s->fluid->fluid_settings_setstr(s->settings, "audio.file.name", name);
    s->renderer = s->fluid->new_fluid_file_renderer(s->synth);
    status = s->renderer ? blocks_render(s, song, def->rate_hz, seconds)
                         : midi_fail(MIDI_IO_FAILED, "%s: FluidSynth cannot write it", path);
    sound_destroy(s); /* destroying it writes the file's header */
    return status;
}

/* How long the song takes, unless it is asked for less or more. */
static enum midi_status seconds_find(const struct sound_def *def, struct midi_song *song,
                                     double *seconds)
{
    if (!(*seconds > 0))
        *seconds = (double)midi_song_info(song).end_ns / 1e9 + def->tail_s;
    if (*seconds > 0 && *seconds <= SECONDS_MAX)
        return MIDI_OK;
    return midi_fail(MIDI_BAD_ARGUMENT, "sound is rendered for at most %d hours",
                     SECONDS_MAX / 3600);
}

enum midi_status sound_render(const struct sound_def *def, struct midi_song *song,
                              double seconds, const char *path)
{
    struct output_file out;
    enum midi_status status = seconds_find(def, song, &seconds);
    if (status != MIDI_OK)
        return status;
    if (!output_file_open(&out, path))
        return midi_fail(MIDI_IO_FAILED, "%s: cannot write: %s", path, out.why);
    status = render_into(def, song, seconds, out.part, path);
    if (status != MIDI_OK)
        output_file_abandon(&out);
    else if (!output_file_commit(&out))
        status = midi_fail(MIDI_IO_FAILED, "%s: cannot write: %s", path, out.why);
    return status;
}

/* The file has no name, so nothing is left of it, however the process ends. */
enum midi_status sound_render_open(const struct sound_def *def, struct midi_song *song,
                                   double seconds, int *file)
{
    static const char what[] = "a sound in the temporary folder";
    char name[40];
    *file = -1;
    enum midi_status status = seconds_find(def, song, &seconds);
    if (status != MIDI_OK)
        return status;
    FILE *held = tmpfile();
    if (!held)
        return midi_fail(MIDI_IO_FAILED, "no file can be made in the temporary folder: %s",
                         strerror(errno));
    snprintf(name, sizeof name, "/proc/self/fd/%d", fileno(held));
    status = render_into(def, song, seconds, name, what);
    if (status == MIDI_OK) {
        *file = open(name, O_RDONLY | O_CLOEXEC);
        if (*file < 0)
            status = midi_fail(MIDI_IO_FAILED, "%s: %s", what, strerror(errno));
    }
    fclose(held);
    return status;
}
