/* test_midi_command.c - `lutetia midi` and a program that uses the library: played notes are
 * heard and recorded, and errors get a message. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <midi_song.h>

#include "../display/scratch.h"
#include "../lutetia/child.h"
#include "server_support.h"

#include <sched.h>
#include <signal.h>
#include <sys/wait.h>

static const char *lutetia;

static void run(struct child *child, int status, const char *says)
{
    child->arguments[0] = lutetia;
    child->arguments[1] = "midi";
    child_run(child);
    const char *said = status ? child->errors : child->output;
    if (child->status != status || !strstr(said, says))
        fail_msg("exit %d for %d, and it said: %s%s", child->status, status, child->output,
                 child->errors);
    if (status == 1)
        assert_ptr_equal(strchr(child->errors, '\n') + 1,
                         child->errors + strlen(child->errors));
}

#define MIDI(...)                                                                              \
    &(struct child)                                                                            \
    {                                                                                          \
        .arguments = { NULL, NULL, __VA_ARGS__ }                                               \
    }

static void words_are_sent_and_status_is_told(void **unused)
{
    (void)unused;
    struct served s = served_begin((const char *[]){"loop", NULL}, 0, NULL);
    struct midi_client *c = client_of(&s, "listener", "");
    run(MIDI("send", "note-on 1 c4 100", "bend 2 -5", "-s", s.path), 0, "");
    struct midi_message m = next_message(c, NULL);
    check_text(&m, "note-on 1 c4 100");
    m = next_message(c, NULL);
    check_text(&m, "bend 2 -5");
    m = next_message(c, NULL); /* because its player has left */
    check_text(&m, "note-off 1 c4 64");
    run(MIDI("devices", "-s", s.path), 0, "loop loop in,out up\n");
    run(MIDI("status", "-s", s.path), 0, "listener: sent 3");
    run(MIDI("devices", "kinds"), 0, "serial:PATH[@SPEED]");
    run(MIDI("send", "clock", "-d", "piano", "-s", s.path), 1, "no device 'piano'");
    run(MIDI("monitor", "-f", "loud=1", "-s", s.path), 1, "no filter 'loud'");
    run(MIDI("serve", "-s", s.path), 1, "listens there already");
    midi_client_close(c);
    served_end(&s);
    run(MIDI("status", "-s", s.path), 1, "`lutetia midi serve` starts one");
}

/* Writes a song of that many notes, 10 ms apart. */
static void song_write(const char *path, int notes)
{
    const struct midi_song_def def = midi_song_def_default();
    struct midi_song *song;
    assert_int_equal(midi_song_create(&def, &song), MIDI_OK);
    for (int i = 0; i < 2 * notes; i++) {
        struct midi_message m =
            midi_message_make((uint64_t)(5 * i) * 1000000, i & 1 ? 0x80 : 0x90,
                              (uint8_t)(40 + i / 2), (uint8_t)(20 + i));
        assert_int_equal(midi_song_record(song, 0, &m, 0), MIDI_OK);
    }
    assert_int_equal(midi_song_write(song, path), MIDI_OK);
    midi_song_destroy(song);
}

static pid_t in_background(const char *const *words)
{
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        char *arguments[16] = {NULL};
        for (int i = 0; words[i]; i++)
            arguments[i] = strdup(words[i]);
        execv(arguments[0], arguments);
        _exit(127);
    }
    return child;
}

static void ended_well(pid_t child)
{
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

/* Waits until there are that many clients. */
static void wait_clients(struct midi_client *c, const char *name)
{
    char text[8000] = "";
    for (int i = 0; i < 500 && !strstr(text, name); i++) {
        assert_int_equal(midi_client_command(c, "status", text, sizeof text), MIDI_OK);
        usleep(10000);
    }
    assert_non_null(strstr(text, name));
}

static void what_is_played_is_recorded(void **unused)
{
    (void)unused;
    enum { NOTES = 12 };
    char played[300], recorded[300];
    struct served s = served_begin((const char *[]){"loop", NULL}, 0, NULL);
    struct midi_client *c = client_of(&s, "look", NULL);
    snprintf(played, sizeof played, "%s", scratch_path("played.mid"));
    snprintf(recorded, sizeof recorded, "%s", scratch_path("recorded.mid"));
    song_write(played, NOTES);
    pid_t recorder = in_background(
        (const char *[]){lutetia, "midi", "record", recorded, "-n", "24", "-s", s.path, NULL});
    wait_clients(c, "midi record");
    run(MIDI("play", played, "-s", s.path), 0, "");
    ended_well(recorder);
    struct midi_song *a, *b;
    assert_int_equal(midi_song_read(played, &a), MIDI_OK);
    assert_int_equal(midi_song_read(recorded, &b), MIDI_OK);
    const struct midi_song_info info = midi_song_info(b);
    assert_int_equal(info.events_count, 2 * NOTES + 1);
    const struct midi_song_event name = midi_song_event(b, 0);
    assert_memory_equal(name.bytes, "loop", 4);
    const uint64_t first_ns = midi_song_event(b, 1).time_ns;
    for (size_t i = 0; i < 2 * NOTES; i++) {
        const struct midi_song_event x = midi_song_event(a, i), y = midi_song_event(b, i + 1);
        assert_memory_equal(x.bytes, y.bytes, 3);
        assert_true(y.time_ns - first_ns < x.time_ns + 400000000); /* a busy machine is late */
    }
    midi_song_destroy(a);
    midi_song_destroy(b);
    midi_client_close(c);
    served_end(&s);
}

/* Whether programs of this user may run in real time. */
static bool real_time_allowed(void)
{
    int status;
    const pid_t child = fork();
    if (child == 0) {
        const struct sched_param priority = {.sched_priority = 40};
        _exit(sched_setscheduler(0, SCHED_FIFO, &priority) == 0 ? 0 : 1);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/* A player has the server's priority from its first note on, unless that is not wanted. */
static void songs_are_played_in_real_time(void **unused)
{
    (void)unused;
    char path[300];
    const bool allowed = real_time_allowed();
    struct served s = served_begin((const char *[]){"loop", NULL}, 0, NULL);
    snprintf(path, sizeof path, "%s", scratch_path("long.mid"));
    song_write(path, 60);
    for (int usual = 0; usual < 2; usual++) {
        struct midi_client *c = client_of(&s, "look", "");
        const pid_t player =
            in_background((const char *[]){lutetia, "midi", "play", path, "-s", s.path,
                                           usual ? "--usual-priority" : NULL, NULL});
        next_event(c, MIDI_CLIENT_MESSAGE);
        kill(player, SIGSTOP); /* so that the song cannot be over before one has looked */
        const int policy = sched_getscheduler(player) & ~SCHED_RESET_ON_FORK;
        kill(player, SIGCONT);
        ended_well(player);
        midi_client_close(c);
        assert_int_equal(policy, allowed && !usual ? SCHED_FIFO : SCHED_OTHER);
    }
    served_end(&s);
}

/* Builds examples/midi_octave.c as any program that uses the library, and runs it. */
static void programs_use_the_library(void **unused)
{
    (void)unused;
    struct served s = served_begin((const char *[]){"keys=loop", "synth=loop", NULL}, 0, NULL);
    struct midi_client *c = client_of(&s, "look", NULL);
    assert_int_equal(midi_client_listen(c, "synth", ""), MIDI_OK);
    pid_t octave =
        in_background((const char *[]){getenv("OCTAVE"), "keys", "synth", s.path, NULL});
    wait_clients(c, "octave");
    struct midi_message m = midi_message_make(0, 0x90, 60, 100);
    struct midi_client_event e = {.kind = MIDI_CLIENT_NOTHING};
    for (int i = 0; i < 500 && e.kind != MIDI_CLIENT_MESSAGE; i++) { /* until it listens */
        assert_int_equal(midi_client_send(c, midi_client_device(c, "keys"), &m), MIDI_OK);
        assert_int_equal(midi_client_next(c, 20, &e), MIDI_OK);
    }
    check_text(&e.message, "note-on 1 c5 100");
    midi_client_close(c);
    served_end(&s);
    ended_well(octave);
}

static void keys(struct child *child, int status, const char *says)
{
    child->arguments[0] = lutetia;
    child->arguments[1] = "keys";
    child_run(child);
    if (child->status != status || !strstr(status ? child->errors : child->output, says))
        fail_msg("exit %d for %d, and it said: %s%s", child->status, status, child->output,
                 child->errors);
}

static void songs_become_letters(void **unused)
{
    (void)unused;
    char song[300], poster[300], still[300], sheet[300], frames[300], last[320];
    snprintf(song, sizeof song, "%s", scratch_path("letters.mid"));
    snprintf(poster, sizeof poster, "%s", scratch_path("poster.png"));
    snprintf(still, sizeof still, "%s", scratch_path("still.png"));
    snprintf(sheet, sizeof sheet, "%s", scratch_path("sheet.png"));
    snprintf(frames, sizeof frames, "%s", scratch_path("frames"));
    song_write(song, 6);
    keys(MIDI(song, "-o", poster, "--still", still, "--sheet", sheet, "--text", "type",
              "--font", "DejaVuSans"),
         0, "");
    assert_int_equal(access(poster, R_OK) | access(still, R_OK) | access(sheet, R_OK), 0);
    /* the film lasts 60 ms and three times the release: five pictures at ten a second */
    keys(MIDI(song, "--frames", frames, "--fps", "10", "--release", "0.1", "--picture", "96x40",
              "--font", "DejaVuSans"),
         0, "");
    snprintf(last, sizeof last, "%s/keys-000004.png", frames);
    assert_int_equal(access(last, R_OK), 0);
    snprintf(last, sizeof last, "%s/keys-000005.png", frames);
    assert_int_not_equal(access(last, R_OK), 0);
    keys(MIDI(song, "--text", " ", "-o", poster), 2, "no letter");
    keys(MIDI(song, "--map", "/nowhere/map", "-o", poster), 1, "/nowhere/map");
    keys(MIDI("/nowhere/song.mid"), 1, "/nowhere/song.mid");
    keys(MIDI(song, "--size", "9,3"), 2, "least and the most");
    keys(MIDI("-o", poster), 2, "of a song");
}

static void wrong_lines_are_refused(void **unused)
{
    (void)unused;
    const char *text = scratch_path("text.mid");
    FILE *file = fopen(text, "w");
    fputs("a song of words", file);
    fclose(file);
    run(MIDI("dance"), 2, "known are serve");
    run(MIDI("send", "note-on 1 z 100"), 2, "c#4");
    run(MIDI("send"), 2, "note-on 1 c4 100");
    run(MIDI("play"), 2, "one Standard MIDI File");
    run(MIDI("play", text), 1, "MThd");
    run(MIDI("record"), 2, "file to write");
    run(MIDI("serve", "piano:x", "-s", scratch_path("nowhere")), 1, "known kinds are raw");
    run(MIDI("serve", "--tcp", "5000", "-s", scratch_path("nowhere")), 2, "LUTETIA_MIDI_TOKEN");
    run(MIDI("status", "-s", "/nowhere/socket"), 1, "no MIDI server at /nowhere/socket");
    run(MIDI("monitor", "-n", "x"), 2, "--count");
}

/* What the libraries of sound cards complain about is not the user's matter. Where there is a
 * card or a JACK server it plays. */
static void no_sound_card_is_one_line(void **unused)
{
    (void)unused;
    static const char *const devices[] = {"s=sound:alsa", "s=sound:jack",
                                          "s=sound:/nowhere/x.wav"};
    for (int i = 0; i < 3; i++) {
        struct child child = {.arguments = {"/usr/bin/timeout", "10", lutetia, "midi", "serve",
                                            devices[i], "--server", scratch_path("no card")}};
        child_run(&child);
        if (child.status == 124 && i < 2)
            continue;
        assert_int_equal(child.status, 1);
        if (strncmp(child.errors, "lutetia midi serve: ", 20) != 0 ||
            strchr(child.errors, '\n') != child.errors + strlen(child.errors) - 1)
            fail_msg("%s: %s", devices[i], child.errors);
    }
}

int main(void)
{
    lutetia = getenv("LUTETIA");
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(words_are_sent_and_status_is_told),
        cmocka_unit_test(what_is_played_is_recorded),
        cmocka_unit_test(songs_are_played_in_real_time),
        cmocka_unit_test(programs_use_the_library),
        cmocka_unit_test(songs_become_letters),
        cmocka_unit_test(wrong_lines_are_refused),
        cmocka_unit_test(no_sound_card_is_one_line),
    };
    return lutetia && getenv("OCTAVE")
               ? cmocka_run_group_tests_name("midi command", tests, NULL, NULL)
               : 1;
}
