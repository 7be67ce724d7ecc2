/* test_sound.c - events to sound: three bounces give three onsets at their times, louder for
 * faster bounces. Skips where FluidSynth or its SoundFont is not installed. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <sys/types.h>

#include <stdio.h>

#include <unistd.h>

#include <fcntl.h>

#include <fluid.h>
#include <sound.h>
#include <sound_events.h>
#include <wav_file.h>

#include "../display/scratch.h"
#include "../sample.h"
#include "../skip.h"
#include "wav.h"

#include <math.h>

static bool able(void)
{
    const struct fluid *fluid;
    const char *font;
    if (fluid_load(&fluid) == MIDI_OK && sound_font_find(NULL, &font) == MIDI_OK)
        return true;
    print_message("%s\n", midi_error());
    return false;
}

/* The times and speeds of the first three bounces of a ball, by the formulas of the springs'
 * floor. */
static void bounces(double times_s[3], double speeds[3])
{
    const double gravity = 9.8, height = 1, restitution = 0.7;
    double speed = sqrt(2 * gravity * height), t = speed / gravity;
    for (int i = 0; i < 3; i++) {
        speed *= restitution;
        times_s[i] = t;
        speeds[i] = speed;
        t += 2 * speed / gravity;
    }
}

static void bounces_are_onsets(void **unused)
{
    (void)unused;
    if (!able())
        skip_because("FluidSynth or a SoundFont is not installed");
    static const double starts_s[2] = {0.1, 0.3337};
    for (int kind = 0; kind < SOUND_KINDS; kind++)
        for (int start = 0; start < 2; start++) {
            double times_s[3], speeds[3], heard_s[16];
            struct sound_def def = sound_def_default();
            struct midi_song *song = sound_events_song();
            assert_non_null(song);
            bounces(times_s, speeds);
            for (int i = 0; i < 3; i++) {
                times_s[i] += starts_s[start];
                const struct sound_event e = {.kind = (enum sound_kind)kind,
                                              .time_s = times_s[i],
                                              .velocity = (int)fmin(127, 20 * speeds[i]),
                                              .height = 0.5};
                assert_int_equal(sound_event_add(song, &e), MIDI_OK);
            }
            const char *path = scratch_path("bounces.wav");
            if (sound_render(&def, song, 2.5, path) != MIDI_OK)
                fail_msg("%s", midi_error());
            midi_song_destroy(song);
            struct wav w = wav_read(path);
            assert_int_equal(w.rate_hz, 44100);
            assert_true(labs(w.count - (long)(2.5 * 44100)) <= SOUND_BLOCK);
            const int count = wav_onsets(&w, heard_s, 16);
            int before = 32768;
            if (count != 3)
                fail_msg("%s: %d onsets", sound_kind_name((enum sound_kind)kind), count);
            for (int i = 0; i < 3; i++) {
                if (fabs(heard_s[i] - times_s[i]) > 0.005)
                    fail_msg("%s %d is heard at %g, must be at %g",
                             sound_kind_name((enum sound_kind)kind), i, heard_s[i], times_s[i]);
                const int loud = wav_peak(&w, times_s[i], times_s[i] + 0.15);
                assert_true(loud < before); /* slower each time */
                before = loud;
            }
            free(w.samples);
        }
}

static void the_same_song_is_the_same_sound(void **unused)
{
    (void)unused;
    if (!able())
        skip_because("FluidSynth or a SoundFont is not installed");
    struct wav w[2];
    for (int i = 0; i < 2; i++) {
        struct sound_def def = sound_def_default();
        struct midi_song *song = sound_events_song();
        const struct sound_event e = {SOUND_TWANG, 0.01, 100, 0.3, i ? 0.9 : -0.9};
        assert_int_equal(sound_event_add(song, &e), MIDI_OK);
        const char *path = scratch_path("one.wav");
        def.rate_hz = 22050;
        assert_int_equal(sound_render(&def, song, 0.3, path), MIDI_OK);
        midi_song_destroy(song);
        w[i] = wav_read(path);
    }
    /* The second sound is on the other side: left and right are exchanged. */
    assert_int_equal(w[0].count, w[1].count);
    double left[2] = {0, 0}, right[2] = {0, 0};
    for (int i = 0; i < 2; i++)
        for (long k = 0; k < w[i].count; k++) {
            left[i] += abs(w[i].samples[2 * k]);
            right[i] += abs(w[i].samples[2 * k + 1]);
        }
    assert_true(left[0] > 3 * right[0] && right[1] > 3 * left[1]);
    free(w[0].samples);
    free(w[1].samples);
}

/* The last moment that is louder than the rounding's noise of one bit. */
static double wav_ends_s(const struct wav *w)
{
    long last = 0;
    for (long i = 0; i < w->channels * w->count; i++)
        if (abs(w->samples[i]) > 1)
            last = i;
    return (double)last / w->channels / w->rate_hz;
}

/* A cymbal that goes on after the song, an organ's note that nobody ends, and a pause within
 * the song. */
static void songs_are_rendered_to_silence(void **unused)
{
    (void)unused;
    static const struct {
        uint8_t bytes[3][3]; /* at 0 */
        double ends_s;       /* of the track */
        double least_s, most_s;
    } songs[] = {{{{0xc9, 0, 0}, {0x99, 49, 127}, {0x89, 49, 0}}, 0.1, 1.8, 12},
                 {{{0xc0, 16, 0}, {0xb0, 64, 127}, {0x90, 60, 100}}, 0.5, 0.5, 5},
                 {{{0xc0, 0, 0}, {0x90, 60, 100}, {0x80, 60, 0}}, 9, 0.1, 9.3}};
    if (!able())
        skip_because("FluidSynth or a SoundFont is not installed");
    for (size_t i = 0; i < sizeof songs / sizeof *songs; i++) {
        const struct midi_song_def song_def = midi_song_def_default();
        struct sound_def def = sound_def_default();
        struct midi_song *song;
        assert_int_equal(midi_song_create(&song_def, &song), MIDI_OK);
        for (int k = 0; k < 3; k++) {
            const uint8_t *b = songs[i].bytes[k];
            const struct midi_message m = midi_message_make(0, b[0], b[1], b[2]);
            assert_int_equal(midi_song_record(song, 0, &m, 0), MIDI_OK);
        }
        assert_int_equal(
            midi_song_end(song, 0, midi_song_tick(song, (uint64_t)(1e9 * songs[i].ends_s))),
            MIDI_OK);
        const char *path = scratch_path("whole.wav");
        def.room = true;
        if (sound_render(&def, song, 0, path) != MIDI_OK)
            fail_msg("%s", midi_error());
        struct wav w = wav_read(path);
        const double all_s = (double)w.count / w.rate_hz, last_s = wav_ends_s(&w);
        if (!(last_s > songs[i].least_s && last_s < all_s - 0.09 && all_s > songs[i].ends_s &&
              all_s < songs[i].most_s))
            fail_msg("song %zu of %g s: heard until %g of %g", i, songs[i].ends_s, last_s,
                     all_s);
        free(w.samples);
        def.tail_s = 0.25; /* the bound */
        assert_int_equal(sound_render(&def, song, 0, path), MIDI_OK);
        w = wav_read(path);
        assert_true((double)w.count / w.rate_hz < songs[i].ends_s + 0.26);
        free(w.samples);
        midi_song_destroy(song);
    }
}

/* Sizes that 32 bits cannot tell are in an RF64's ds64. */
static void long_files_tell_their_sizes(void **unused)
{
    (void)unused;
    static const uint64_t moments[] = {0, 1, 1000, 1073741804, 1073741805, UINT64_C(1) << 33};
    for (size_t i = 0; i < sizeof moments / sizeof *moments; i++) {
        uint8_t head[80];
        struct wav_file wav;
        FILE *file = tmpfile();
        assert_non_null(file);
        assert_true(wav_file_begin(&wav, file, 48000));
        wav.moments = moments[i]; /* as if they had been written */
        assert_true(wav_file_end(&wav));
        rewind(file);
        assert_int_equal(fread(head, 1, sizeof head, file), sizeof head);
        fclose(file);
        const uint64_t bytes = 4 * moments[i];
        const bool is_long = bytes + 72 > 0xffffffff;
        assert_memory_equal(head, is_long ? "RF64" : "RIFF", 4);
        assert_memory_equal(head + 12, is_long ? "ds64" : "JUNK", 4);
        assert_int_equal(wav_little(head + 4, 4), is_long ? 0xffffffff : bytes + 72);
        assert_int_equal(wav_little(head + 76, 4), is_long ? 0xffffffff : bytes);
        uint64_t said[3];
        for (int k = 0; k < 3; k++)
            said[k] = wav_little(head + 20 + 8 * k, 4) |
                      (uint64_t)wav_little(head + 24 + 8 * k, 4) << 32;
        assert_true(!is_long ||
                    (said[0] == bytes + 72 && said[1] == bytes && said[2] == moments[i]));
    }
}

static void what_is_missing_is_named(void **unused)
{
    (void)unused;
    const struct fluid *fluid;
    struct sound_def def = sound_def_default();
    struct sound *sound;
    const char *font;
    assert_int_equal(sound_font_find("/nowhere/font.sf2", &font), MIDI_NO_DEVICE);
    assert_non_null(strstr(midi_error(), "/nowhere/font.sf2"));
    setenv("LUTETIA_SOUNDFONT", "/nowhere/else.sf2", 1);
    assert_int_equal(sound_font_find(NULL, &font), MIDI_NO_DEVICE);
    assert_non_null(strstr(midi_error(), "/nowhere/else.sf2"));
    unsetenv("LUTETIA_SOUNDFONT");
    def.rate_hz = 1;
    assert_int_equal(sound_create(&def, &sound), MIDI_BAD_ARGUMENT);
    if (fluid_load(&fluid) != MIDI_OK)
        skip_because("FluidSynth is not installed");
    const char *text = scratch_path("font.sf2");
    FILE *file = fopen(text, "w");
    fputs("no font", file);
    fclose(file);
    def = sound_def_default();
    def.font = text;
    assert_int_equal(sound_create(&def, &sound), MIDI_NO_DEVICE);
    assert_non_null(strstr(midi_error(), "no SoundFont, or a damaged one"));
    if (!able())
        skip_because("there is no SoundFont");
    struct midi_song *song = sound_events_song();
    def.font = NULL;
    assert_int_equal(sound_render(&def, song, 1, "/nowhere/out.wav"), MIDI_IO_FAILED);
    assert_int_equal(sound_render(&def, song, 1e9, scratch_path("long.wav")),
                     MIDI_BAD_ARGUMENT);
    midi_song_destroy(song);
    assert_int_equal(sound_create(&def, &sound), MIDI_OK);
    assert_int_equal(sound_listen(sound, "trumpet"), MIDI_NO_DEVICE);
    assert_non_null(strstr(midi_error(), "trumpet"));
    sound_destroy(sound);
}

/* A SoundFont whose tables are damaged, or which is cut off, is refused, or sounds as it can;
 * nothing is printed but by us. (security.md 31) */
static void damaged_fonts_are_refused_quietly(void **unused)
{
    (void)unused;
    enum { FONTS = 12 };
    const char *font, *path = scratch_path("damaged.sf2"), *said = scratch_path("said");
    struct sound_def def = sound_def_default();
    uint64_t seed = 3;
    int refused = 0;
    if (!able() || sound_font_find(NULL, &font) != MIDI_OK)
        skip_because("there is no SoundFont");
    FILE *from = fopen(font, "rb");
    assert_non_null(from);
    assert_int_equal(fseek(from, 0, SEEK_END), 0);
    const size_t count = (size_t)ftell(from);
    uint8_t *bytes = malloc(count);
    assert_non_null(bytes);
    rewind(from);
    assert_int_equal(fread(bytes, 1, count, from), count);
    fclose(from);
    fflush(stderr);
    const int kept = dup(STDERR_FILENO), other = open(said, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(other, STDERR_FILENO);
    for (int i = 0; i < FONTS; i++) {
        struct sound *sound;
        const uint64_t any = sample_word(&seed);
        const size_t at = 12 + any % 400, tail = count - 1 - any % 20000;
        const uint8_t head_was = bytes[at], tail_was = bytes[tail];
        bytes[i % 3 ? tail : at] ^= (uint8_t)(1 + (any >> 32) % 255);
        FILE *file = fopen(path, "wb");
        assert_true(file && fwrite(bytes, 1, i % 4 == 3 ? tail : count, file) > 0 &&
                    fclose(file) == 0);
        bytes[at] = head_was;
        bytes[tail] = tail_was;
        def.font = path;
        if (sound_create(&def, &sound) == MIDI_OK)
            sound_destroy(sound);
        else
            refused++;
    }
    dup2(kept, STDERR_FILENO);
    close(kept);
    const off_t printed = lseek(other, 0, SEEK_END);
    close(other);
    free(bytes);
    assert_int_equal(printed, 0);
    assert_in_range(refused, 1, FONTS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bounces_are_onsets),
        cmocka_unit_test(the_same_song_is_the_same_sound),
        cmocka_unit_test(songs_are_rendered_to_silence),
        cmocka_unit_test(long_files_tell_their_sizes),
        cmocka_unit_test(what_is_missing_is_named),
        cmocka_unit_test(damaged_fonts_are_refused_quietly),
    };
    return cmocka_run_group_tests_name("sound", tests, NULL, NULL);
}
