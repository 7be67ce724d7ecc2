/* test_sound_back.c - a sound server that goes away and comes back is heard again: PulseAudio
 * with a sink that leads nowhere. Skips where there is none, or no FluidSynth. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <midi_message.h>
#include <sound_keeper.h>

#include "../clock.h"
#include "../display/scratch.h"
#include "../skip.h"
#include "sound_server.h"

#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

static char socket_path[300], recorded_path[300];

/* The greatest sample of two seconds of what the sink gets, while notes are played. */
static int heard(struct sound *sound)
{
    char *const words[] = {
        "parec",        "-d",          "room.monitor",      "--raw", "--format=s16le",
        "--channels=1", "--rate=8000", "--latency-msec=50", NULL};
    const pid_t recorder = program_begin(words, recorded_path, "/dev/null");
    int most = 0;
    for (int i = 0; i < 20; i++) {
        const struct midi_message on = midi_message_make(0, MIDI_NOTE_ON, 72, 120),
                                  off = midi_message_make(0, MIDI_NOTE_OFF, 72, 64);
        sound_message(sound, &on);
        poll(NULL, 0, 80);
        sound_message(sound, &off);
        poll(NULL, 0, 20);
    }
    kill(recorder, SIGTERM); /* it writes what it has */
    waitpid(recorder, NULL, 0);
    FILE *file = fopen(recorded_path, "rb");
    int16_t sample;
    while (file && fread(&sample, sizeof sample, 1, file) == 1)
        most = abs(sample) > most ? abs(sample) : most;
    if (file)
        fclose(file);
    return most;
}

static const char *said_wait(struct sound_keeper *keeper)
{
    const double until_s = clock_now_s() + 15;
    const char *said = NULL;
    while (!(said = sound_keeper_said(keeper)) && clock_now_s() < until_s)
        poll(NULL, 0, 50);
    return said ? said : "nothing";
}

static void a_server_that_comes_back_is_heard(void **state)
{
    (void)state;
    struct sound_def def = sound_def_default();
    struct sound *sound;
    struct sound_keeper *keeper;
    char address[320];
    snprintf(socket_path, sizeof socket_path, "%s", scratch_path("sound.socket"));
    snprintf(recorded_path, sizeof recorded_path, "%s", scratch_path("recorded"));
    snprintf(address, sizeof address, "unix:%s", socket_path);
    setenv("PULSE_SERVER", address, 1);
    setenv("HOME", scratch_path("."), 1);
    unsetenv("XDG_RUNTIME_DIR");
    pid_t server = sound_server_begin(socket_path);
    if (!sound_server_wait(server, socket_path)) {
        program_end(server);
        skip_because("no pulseaudio runs here");
    }
    const enum midi_status made = sound_create(&def, &sound);
    if (made != MIDI_OK || sound_listen(sound, "pulseaudio") != MIDI_OK) {
        program_end(server);
        sound_destroy(sound);
        skip_because("%s", midi_error());
    }
    assert_int_equal(sound_keeper_begin(sound, &keeper), MIDI_OK);
    assert_non_null(keeper);
    const int before = heard(sound);
    if (before == 0) { /* no parec, or one that cannot record here */
        sound_keeper_end(keeper);
        program_end(server);
        sound_destroy(sound);
        skip_because("nothing can be recorded from pulseaudio here");
    }
    assert_null(sound_keeper_said(keeper));
    for (int times = 0; times < 2; times++) {
        program_end(server);
        unlink(socket_path);
        assert_non_null(strstr(said_wait(keeper), "gone"));
        assert_null(sound_keeper_said(keeper));
        poll(NULL, 0, 1200); /* it is asked for meanwhile, and is not there */
        server = sound_server_begin(socket_path);
        assert_true(sound_server_wait(server, socket_path));
        assert_non_null(strstr(said_wait(keeper), "back"));
        const int after = heard(sound);
        printf("heard %d before, %d afterwards\n", before, after);
        assert_true(after > 500);
    }
    /* ended while there is none */
    program_end(server);
    unlink(socket_path);
    assert_non_null(strstr(said_wait(keeper), "gone"));
    sound_keeper_end(keeper);
    sound_destroy(sound);
}

/* Who plays into a file needs no keeper. */
static void files_have_no_keeper(void **state)
{
    (void)state;
    struct sound_def def = sound_def_default();
    struct sound *sound;
    struct sound_keeper *keeper;
    if (sound_create(&def, &sound) != MIDI_OK)
        skip_because("%s", midi_error());
    assert_int_equal(sound_listen(sound, scratch_path("a.wav")), MIDI_OK);
    assert_int_equal(sound_keeper_begin(sound, &keeper), MIDI_OK);
    assert_null(keeper);
    assert_null(sound_keeper_said(keeper));
    sound_keeper_end(keeper);
    sound_destroy(sound);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(files_have_no_keeper),
                                       cmocka_unit_test(a_server_that_comes_back_is_heard)};
    return cmocka_run_group_tests_name("sound back", tests, NULL, NULL);
}
