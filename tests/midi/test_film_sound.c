/* test_film_sound.c - `lutetia spring --sound`: the first clank is heard at its time in the
 * network, within a picture's time. Songs and devices also become sound. Skips where FluidSynth
 * or its SoundFont is not installed. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <events.h>
#include <fluid.h>
#include <network_file.h>
#include <sound.h>
#include <step.h>

#include "../display/scratch.h"
#include "../lutetia/child.h"
#include "../skip.h"
#include "server_support.h"
#include "wav.h"

#include <math.h>
#include <unistd.h>

static const char *lutetia, *network;

static bool able(void)
{
    const struct fluid *fluid;
    const char *font;
    if (fluid_load(&fluid) == MIDI_OK && sound_font_find(NULL, &font) == MIDI_OK)
        return true;
    print_message("%s\n", midi_error());
    return false;
}

static void must_run(struct child *child)
{
    child_run(child);
    if (child->status != 0)
        fail_msg("exit %d: %s", child->status, child->errors);
}

/* The time of the first audible clank; *events_count: the number of events in that many
 * seconds. */
static double first_clank_s(double seconds, int *events_count)
{
    struct dyn_network *n;
    struct dyn_event e;
    double first_s = -1;
    *events_count = 0;
    if (dyn_network_read(network, &n) != DYN_OK)
        fail_msg("%s", dyn_error());
    for (int i = 0; i < (int)(240 * seconds); i++)
        assert_int_equal(dyn_network_step(n, 1.0 / 240, 1), DYN_OK);
    while (dyn_events_take(n, &e, 1) == 1) {
        ++*events_count;
        if (first_s < 0 && e.kind == DYN_CLANK && dyn_clank_velocity(e.strength) > 20)
            first_s = e.time_s;
    }
    dyn_network_destroy(n);
    return first_s;
}

static void films_sound_when_letters_hit(void **unused)
{
    (void)unused;
    enum { FPS = 30, SECONDS = 2 };
    int events_count;
    double heard_s[32];
    if (!able())
        skip_because("FluidSynth or a SoundFont is not installed");
    const double first_s = first_clank_s(SECONDS, &events_count);
    assert_true(first_s > 0 && events_count > 3);
    char still[300], sound[300];
    snprintf(still, sizeof still, "%s", scratch_path("still.png"));
    snprintf(sound, sizeof sound, "%s", scratch_path("film.wav"));
    struct child child = {.arguments = {lutetia, "spring", "--network", network, "--still",
                                        still, "--size", "64x64", "--seconds", "2", "--sound",
                                        sound}};
    must_run(&child);
    struct wav w = wav_read(sound);
    const int count = wav_onsets(&w, heard_s, 32);
    assert_true(count > 0);
    if (fabs(heard_s[0] - first_s) > 1.0 / FPS)
        fail_msg("heard at %g, happened at %g", heard_s[0], first_s);
    assert_true(fabs((double)w.count / w.rate_hz - SECONDS - 1.0 / FPS) <
                0.5 / FPS); /* and the last picture */
    free(w.samples);
    child.arguments[4] = "--sound"; /* a window, and no film */
    child.arguments[5] = sound;
    child.arguments[6] = NULL;
    child_run(&child);
    assert_int_equal(child.status, 2);
    assert_non_null(strstr(child.errors, "--sound goes with"));
}

static void songs_are_rendered(void **unused)
{
    (void)unused;
    double heard_s[8];
    if (!able())
        skip_because("FluidSynth or a SoundFont is not installed");
    char song_path[300], sound[300];
    snprintf(song_path, sizeof song_path, "%s", scratch_path("song.mid"));
    snprintf(sound, sizeof sound, "%s", scratch_path("song.wav"));
    const struct midi_song_def def = midi_song_def_default();
    struct midi_song *song;
    assert_int_equal(midi_song_create(&def, &song), MIDI_OK);
    for (int i = 0; i < 4; i++) {
        struct midi_message m = midi_message_make(
            (uint64_t)(300 * (i / 2) + 150 * (i & 1)) * 1000000, i & 1 ? 0x89 : 0x99, 37, 100);
        assert_int_equal(midi_song_record(song, 0, &m, 0), MIDI_OK);
    }
    assert_int_equal(midi_song_write(song, song_path), MIDI_OK);
    midi_song_destroy(song);
    struct child child = {
        .arguments = {lutetia, "midi", "render", song_path, "-o", sound, "-t", "0.6"}};
    must_run(&child);
    struct wav w = wav_read(sound);
    assert_int_equal(wav_onsets(&w, heard_s, 8), 2);
    assert_true(fabs(heard_s[1] - heard_s[0] - 0.3) < 0.005);
    free(w.samples);
}

/* The first picture with ink in it; -1: none. */
static int first_inked(const char *raw, int width, int height)
{
    FILE *file = fopen(raw, "rb");
    uint8_t *gray = malloc((size_t)width * (size_t)height);
    int found = -1;
    assert_non_null(file);
    assert_non_null(gray);
    for (int i = 0;
         found < 0 && fread(gray, (size_t)width, (size_t)height, file) == (size_t)height; i++)
        for (int k = 0; k < width * height && found < 0; k++)
            found = gray[k] < 100 ? i : -1;
    free(gray);
    fclose(file);
    return found;
}

/* In the film a key's letter and its sound begin together. */
static void letters_and_sound_come_together(void **unused)
{
    (void)unused;
    enum { FPS = 30, WIDTH = 96, HEIGHT = 48 };
    double heard_s[8];
    if (!able() || system("command -v ffmpeg >/dev/null") != 0)
        skip_because("FluidSynth, a SoundFont or ffmpeg is not installed");
    char song_path[300], film[300], raw[300], sound[300], command[1400];
    snprintf(song_path, sizeof song_path, "%s", scratch_path("keys.mid"));
    snprintf(film, sizeof film, "%s", scratch_path("keys.mp4"));
    snprintf(raw, sizeof raw, "%s", scratch_path("keys.raw"));
    snprintf(sound, sizeof sound, "%s", scratch_path("keys.wav"));
    const struct midi_song_def def = midi_song_def_default();
    struct midi_song *song;
    assert_int_equal(midi_song_create(&def, &song), MIDI_OK);
    for (int i = 0; i < 2; i++) {
        struct midi_message m =
            midi_message_make((uint64_t)(500 + 300 * i) * 1000000, i ? 0x89 : 0x99, 37, 120);
        assert_int_equal(midi_song_record(song, 0, &m, 0), MIDI_OK);
    }
    assert_int_equal(midi_song_write(song, song_path), MIDI_OK);
    midi_song_destroy(song);
    struct child child = {.arguments = {lutetia, "keys", song_path, "--video", film,
                                        "--picture", "96x48", "--text", "O", "--font",
                                        "DejaVuSans", "--attack", "0"}};
    must_run(&child);
    assert_string_equal(child.errors, "");
    snprintf(command, sizeof command,
             "ffmpeg -v error -i '%s' -f rawvideo -pix_fmt gray '%s' && "
             "ffmpeg -v error -i '%s' -ac 2 -ar 44100 '%s'",
             film, raw, film, sound);
    assert_int_equal(system(command), 0);
    struct wav w = wav_read(sound);
    assert_int_equal(wav_onsets(&w, heard_s, 8), 1);
    const int inked = first_inked(raw, WIDTH, HEIGHT);
    if (inked < 0 || fabs(heard_s[0] - (double)inked / FPS) > 1.0 / FPS)
        fail_msg("heard at %g, seen in picture %d", heard_s[0], inked);
    free(w.samples);
}

static void a_device_sounds(void **unused)
{
    (void)unused;
    double heard_s[8];
    char device[320], sound[300];
    if (!able())
        skip_because("FluidSynth or a SoundFont is not installed");
    snprintf(sound, sizeof sound, "%s", scratch_path("live.wav"));
    snprintf(device, sizeof device, "synth=sound:%s", sound);
    struct served s = served_begin((const char *[]){device, NULL}, 0, NULL);
    struct midi_client *c = client_of(&s, "player", NULL);
    struct midi_message m = midi_message_make(0, 0x99, 37, 110);
    assert_int_equal(midi_client_send(c, midi_client_device(c, "synth"), &m), MIDI_OK);
    usleep(300000);
    midi_client_close(c);
    served_end(&s);
    struct wav w = wav_read(sound);
    assert_int_equal(wav_onsets(&w, heard_s, 8), 1);
    free(w.samples);
}

/* A word that a song plays is heard with the song, which has instruments of its own, and the
 * film is as long as the song and a second. */
static void songs_are_heard_with_what_they_play(void **unused)
{
    (void)unused;
    static const double notes_s[2] = {0.2, 1.1};
    char map[300], song[300], sound[300];
    double heard_s[16];
    if (!able())
        skip_because("FluidSynth or a SoundFont is not installed");
    snprintf(map, sizeof map, "%s", scratch_path("nothing.lua"));
    snprintf(song, sizeof song, "%s", scratch_path("two.mid"));
    snprintf(sound, sizeof sound, "%s", scratch_path("two.wav"));
    FILE *file = fopen(map, "w");
    fputs("function message(m) end\n", file);
    fclose(file);
    const struct midi_song_def def = midi_song_def_default();
    struct midi_song *two;
    assert_int_equal(midi_song_create(&def, &two), MIDI_OK);
    for (int i = 0; i < 4; i++) {
        const struct midi_message m = midi_message_make(
            (uint64_t)(1e9 * (notes_s[i / 2] + 0.1 * (i % 2))), i % 2 ? 0x80 : 0x90, 72, 110);
        assert_int_equal(midi_song_record(two, 0, &m, 0), MIDI_OK);
    }
    assert_int_equal(midi_song_write(two, song), MIDI_OK);
    const double end_s = (double)midi_song_info(two).end_ns / 1e9;
    midi_song_destroy(two);
    for (int falls = 0; falls < 2; falls++) {
        must_run(
            &(struct child){.arguments = {lutetia, "spring", "a", "--map", map, "--song", song,
                                          "--sound", sound, "--still", scratch_path("two.png"),
                                          "--size", "32x32", "--at", falls ? "0,1.5" : "0,1",
                                          "--set", falls ? "gravity=9.8" : "gravity=0"}});
        struct wav w = wav_read(sound);
        assert_true(fabs((double)w.count / w.rate_hz - end_s - 1) < 0.04);
        const int count = wav_onsets(&w, heard_s, 16);
        int found = 0;
        for (int n = 0; n < 2; n++)
            for (int i = 0; i < count; i++)
                found += fabs(heard_s[i] - notes_s[n]) < 0.006;
        if (falls ? found < 1 || count < 3 : found != 2 || count != 2)
            fail_msg("%d of 2 notes among %d onsets", found, count);
        free(w.samples);
    }
}

int main(void)
{
    lutetia = getenv("LUTETIA");
    network = getenv("NETWORK");
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(films_sound_when_letters_hit),
        cmocka_unit_test(songs_are_rendered),
        cmocka_unit_test(letters_and_sound_come_together),
        cmocka_unit_test(songs_are_heard_with_what_they_play),
        cmocka_unit_test(a_device_sounds),
    };
    return lutetia && network ? cmocka_run_group_tests_name("film sound", tests, NULL, NULL)
                              : 1;
}
