/* sound_render.c - songs to WAV files: see sound.h. */
#include "sound.h"
#include "wav_file.h"

#include <midi_internal.h>

#include <output_file.h>
#include <patience.h>

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { SECONDS_MAX = 36000 };

/* A song on its way through a synthesizer of its own. */
struct part {
    struct sound *sound;
    struct midi_song *song;
    struct midi_parser parser;
    size_t next, count; /* of its events */
};

enum { PARTS = 2 };

struct render {
    const char *path; /* for errors */
    struct part parts[PARTS];
    int parts_count;
    struct wav_file wav;
    int16_t samples[2 * SOUND_BLOCK];
};

static void render_take(void *context, const struct midi_message *m)
{
    sound_message(context, m);
}

static enum midi_status io_failed(const struct render *r)
{
    return midi_fail(MIDI_IO_FAILED, "%s: cannot write: %s", r->path,
                     output_file_explain(errno));
}

static enum midi_status block_add(struct render *r)
{
    if (patience_over())
        return midi_fail(MIDI_IO_FAILED, "stopped");
    sound_block(r->parts[0].sound, r->samples);
    for (int p = 1; p < r->parts_count; p++) {
        int16_t more[2 * SOUND_BLOCK];
        sound_block(r->parts[p].sound, more);
        for (int i = 0; i < 2 * SOUND_BLOCK; i++) {
            const int sum = r->samples[i] + more[i];
            r->samples[i] = (int16_t)(sum > INT16_MAX   ? INT16_MAX
                                      : sum < INT16_MIN ? INT16_MIN
                                                        : sum);
        }
    }
    return wav_file_add(&r->wav, r->samples, SOUND_BLOCK) ? MIDI_OK : io_failed(r);
}

/* Plays what is due before that time. */
static void part_play(struct part *p, double until_s)
{
    for (; p->next < p->count; p->next++) {
        const struct midi_song_event e = midi_song_event(p->song, p->next);
        if ((double)e.time_ns / 1e9 >= until_s)
            return;
        midi_song_play(&e, &p->parser, render_take, p->sound);
    }
}

static enum midi_status songs_render(struct render *r, double seconds)
{
    const double block_s = (double)SOUND_BLOCK / r->wav.rate_hz;
    const long blocks = (long)ceil(seconds / block_s);
    enum midi_status status = MIDI_OK;
    for (long i = 0; i < blocks && status == MIDI_OK; i++) {
        for (int p = 0; p < r->parts_count; p++)
            part_play(&r->parts[p], ((double)i + 0.5) * block_s); /* the nearer block */
        status = block_add(r);
    }
    return status;
}

/* Ends the notes that a song leaves on, and those that a pedal holds: who would? */
static void notes_end(struct sound *sound)
{
    static const uint8_t ends[] = {64, 66, 69, 123}; /* pedals, and all notes off */
    for (uint8_t channel = 0; channel < 16; channel++)
        for (size_t i = 0; i < sizeof ends; i++) {
            const struct midi_message m =
                midi_message_make(0, (uint8_t)(MIDI_CONTROL | channel), ends[i], 0);
            sound_message(sound, &m);
        }
}

/* Of a block: FluidSynth's rounding adds noise of one bit, of each part. */
static bool is_silent(const struct render *r)
{
    const int noise = r->parts_count;
    for (int p = 0; p < r->parts_count; p++)
        if (sound_voices(r->parts[p].sound))
            return false;
    for (int i = 0; i < 2 * SOUND_BLOCK; i++)
        if (abs(r->samples[i]) > noise)
            return false;
    return true;
}

/* Until nothing was heard for a tenth of a second, and no voice is left that could be: an echo
 * has pauses. */
static enum midi_status tail_render(struct render *r, double most_s)
{
    const double block_s = (double)SOUND_BLOCK / r->wav.rate_hz, quiet_s = 0.1;
    double silent_s = 0;
    enum midi_status status = MIDI_OK;
    for (int p = 0; p < r->parts_count; p++)
        notes_end(r->parts[p].sound);
    for (double s = 0; s < most_s && silent_s < quiet_s && status == MIDI_OK; s += block_s) {
        status = block_add(r);
        silent_s = is_silent(r) ? silent_s + block_s : 0;
    }
    return status;
}

static enum midi_status part_begin(struct render *r, const struct sound_def *def,
                                   struct midi_song *song)
{
    struct part *p = &r->parts[r->parts_count];
    *p = (struct part){.song = song, .count = midi_song_info(song).events_count};
    midi_parser_init(&p->parser);
    const enum midi_status status = sound_create(def, &p->sound);
    r->parts_count += status == MIDI_OK;
    return status;
}

static double song_seconds(struct midi_song *song)
{
    return song ? (double)midi_song_info(song).end_ns / 1e9 : 0;
}

static enum midi_status render_into(const struct sound_def *def, struct midi_song *song,
                                    double seconds, FILE *stream, const char *path)
{
    struct render r = {.path = path};
    const bool whole = !(seconds > 0);
    if (whole)
        seconds = fmax(song_seconds(song), song_seconds(def->beside));
    if (!(seconds <= SECONDS_MAX))
        return midi_fail(MIDI_BAD_ARGUMENT, "sound is rendered for at most %d hours",
                         SECONDS_MAX / 3600);
    enum midi_status status = part_begin(&r, def, song);
    if (status == MIDI_OK && def->beside)
        status = part_begin(&r, def, def->beside);
    if (status == MIDI_OK && !wav_file_begin(&r.wav, stream, def->rate_hz))
        status = io_failed(&r);
    if (status == MIDI_OK)
        status = songs_render(&r, seconds);
    if (status == MIDI_OK && whole)
        status = tail_render(&r, def->tail_s);
    if (status == MIDI_OK && !wav_file_end(&r.wav))
        status = io_failed(&r);
    for (int p = 0; p < r.parts_count; p++)
        sound_destroy(r.parts[p].sound);
    return status;
}

enum midi_status sound_render(const struct sound_def *def, struct midi_song *song,
                              double seconds, const char *path)
{
    struct output_file out;
    if (!output_file_open(&out, path))
        return midi_fail(MIDI_IO_FAILED, "%s: cannot write: %s", path, out.why);
    enum midi_status status = render_into(def, song, seconds, out.stream, path);
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
    FILE *held = tmpfile();
    if (!held)
        return midi_fail(MIDI_IO_FAILED, "no file can be made in the temporary folder: %s",
                         strerror(errno));
    enum midi_status status = render_into(def, song, seconds, held, what);
    if (status == MIDI_OK) {
        snprintf(name, sizeof name, "/proc/self/fd/%d", fileno(held));
        *file = open(name, O_RDONLY | O_CLOEXEC);
        if (*file < 0)
            status = midi_fail(MIDI_IO_FAILED, "%s: %s", what, strerror(errno));
    }
    fclose(held);
    return status;
}
